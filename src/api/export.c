#include "api/handles.h"

#include "mesh/curve_tubes.h"
#include "scene/export_scene.h"

#include <string.h>
#include <sys/stat.h>

static ExportOptions own_options(const RamifyExportOptions *options)
{
    static const ExportInstances instances[] = {[RAMIFY_INSTANCES_AUTO] = EXPORT_INSTANCES_AUTO,
                                                [RAMIFY_INSTANCES_NODES] = EXPORT_INSTANCES_NODES,
                                                [RAMIFY_INSTANCES_GPU] = EXPORT_INSTANCES_GPU,
                                                [RAMIFY_INSTANCES_FLAT] = EXPORT_INSTANCES_FLAT};
    static const ExportColors colors[] = {[RAMIFY_COLORS_ALL] = EXPORT_COLORS_ALL,
                                          [RAMIFY_COLORS_PATTERN] = EXPORT_COLORS_PATTERN,
                                          [RAMIFY_COLORS_GROWTH] = EXPORT_COLORS_GROWTH,
                                          [RAMIFY_COLORS_NONE] = EXPORT_COLORS_NONE};
    return (ExportOptions){.object = options->objects,
                           .object_count = options->object_count,
                           .instances = instances[options->instances],
                           .colors = colors[options->colors],
                           .tube_sides = options->tube_sides};
}

static bool check_options(const RamifyExportOptions *options, Error *e)
{
    bool sides = options->tube_sides == 0 ||
                 (options->tube_sides >= 3 && options->tube_sides <= CURVE_TUBE_SIDES_MOST);
    if ((unsigned)options->instances > RAMIFY_INSTANCES_FLAT ||
        (unsigned)options->colors > RAMIFY_COLORS_NONE || options->object_count < 0 || !sides) {
        return error_set(e, ERROR_INPUT,
                         "an export option is out of range; instances and colors must be of their "
                         "lists, tube_sides 0 or 3 to %d",
                         CURVE_TUBE_SIDES_MOST);
    }
    return true;
}

static void fill_report(const char *file, const ExportReport *own, RamifyExportReport *report)
{
    struct stat status;
    bool any = own->vertices > 0;
    const Vec3 low = own->bounds.low, high = own->bounds.high;
    *report = (RamifyExportReport){.vertices = own->vertices, .triangles = own->triangles};
    if (any) {
        memcpy(report->low, &low, sizeof report->low);
        memcpy(report->high, &high, sizeof report->high);
    }
    report->bytes = stat(file, &status) == 0 ? (int64_t)status.st_size : 0;
}

bool ramify_export(const RamifyScene *scene, const char *file, const RamifyExportOptions *options,
                   const RamifyRun *run, RamifyExportReport *report, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    const RamifyExportOptions none = {0};
    ExportReport made;
    options = options ? options : &none;
    if (!check_options(options, &e)) {
        return api_fail(error, &e);
    }
    ExportOptions chosen = own_options(options);
    if (!scene_export(scene_of(scene), file, &chosen, &own, report ? &made : NULL, &e)) {
        return api_fail(error, &e);
    }
    if (report) {
        fill_report(file, &made, report);
    }
    return true;
}

bool ramify_export_trees(const RamifyScene *scene, const RamifyTree *const *trees, const char *file,
                         const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return scene_write_grown(scene_of(scene), (const OutTree *const *)(const void *)trees, NULL,
                             file, &own, &e) ||
           api_fail(error, &e);
}

bool ramify_export_lands(const RamifyScene *scene, const RamifyLand *const *lands, const char *file,
                         const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return scene_write_grown(scene_of(scene), NULL, (const HeightField *const *)(const void *)lands,
                             file, &own, &e) ||
           api_fail(error, &e);
}

bool ramify_export_check(const char *file, RamifyError *error)
{
    Error e = {0};
    return scene_export_check(file, &e) || api_fail(error, &e);
}

int ramify_export_format_count(void)
{
    return export_format_count();
}

const char *ramify_export_format_ending(int index)
{
    return export_format_at(index)->ending;
}

const char *ramify_export_format_doc(int index)
{
    return export_format_at(index)->doc;
}
