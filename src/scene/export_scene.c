#include "scene/export_scene.h"

#include "base/file_replace.h"
#include "base/memory.h"
#include "config/hint.h"
#include "export/pieces.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/export_grids.h"
#include "scene/export_points.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool scene_export_check(const char *file, Error *e)
{
    const ExportFormat *format = export_format(file);
    if (format) {
        return file_replace_fits(file, format->extra, e);
    }
    char endings[256] = "";
    for (int i = 0, used = 0; i < export_format_count(); i++) {
        used += snprintf(endings + used, sizeof endings - (size_t)used, "%s%s", i > 0 ? " " : "",
                         export_format_at(i)->ending);
    }
    return error_set(e, ERROR_INPUT, "'%s' has no known file extension; use one of %s", file,
                     endings);
}

// Owned data of a source.
typedef struct Parts {
    World *world;
    OutTree **tree;
    FlowParams *flow;
    HeightField **land;
    GridFile *grids;
    PointSet **points;
    const char **name;
} Parts;

static void clear_parts(Parts *parts, int object_count)
{
    for (int i = 0; i < object_count; i++) {
        if (parts->tree) {
            out_tree_free(parts->tree[i]);
        }
        if (parts->land) {
            height_field_free(parts->land[i]);
        }
        if (parts->points) {
            points_free(parts->points[i]);
        }
    }
    world_free(parts->world);
    grid_file_free(parts->grids);
    free(parts->tree);
    free(parts->flow);
    free(parts->land);
    free(parts->points);
    free(parts->name);
}

// What flows through each object's out-tree.
static FlowParams *make_flows(const Scene *scene, Error *e)
{
    FlowParams *flow = memory_alloc(scene->object_count, sizeof *flow, e);
    for (int i = 0; flow && i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        flow[i] = flow_params_default();
        if (object->kind->flow) {
            object->kind->flow(object->params, &flow[i]);
        }
    }
    return flow;
}

// Grows the out-trees of all objects that grow, or of land only.
static bool make_trees(const Scene *scene, bool all, Parts *parts, const Run *run, Error *e)
{
    parts->tree = memory_alloc_zero(scene->object_count, sizeof(OutTree *), e);
    bool done = parts->tree;
    for (int i = 0; done && i < scene->object_count; i++) {
        const Kind *kind = scene->objects[i].kind;
        if (kind->grow && (all || kind->heights)) {
            parts->tree[i] = scene_grow_object(scene, i, run, e);
            done = parts->tree[i];
        }
    }
    return done;
}

static bool make_lands(const Scene *scene, Parts *parts, const Run *run, Error *e)
{
    parts->land = memory_alloc_zero(scene->object_count, sizeof(HeightField *), e);
    bool done = parts->land;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (scene->objects[i].kind->heights) {
            parts->land[i] = scene_heights(scene, i, parts->tree[i], run, e);
            done = parts->land[i];
        }
    }
    return done;
}

static bool make_points(const Scene *scene, Parts *parts, const Run *run, Error *e)
{
    parts->points = memory_alloc_zero(scene->object_count, sizeof(PointSet *), e);
    bool done = parts->points;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (scene->objects[i].kind->points) {
            parts->points[i] = scene_points(scene, i, run, e);
            done = parts->points[i];
        }
    }
    return done;
}

static bool make_parts(const Scene *scene, unsigned needs, Parts *parts, const Run *run, Error *e)
{
    parts->name = memory_alloc(scene->object_count, sizeof *parts->name, e);
    bool done = parts->name;
    for (int i = 0; done && i < scene->object_count; i++) {
        parts->name[i] = scene->objects[i].name;
    }
    if (done && needs & EXPORT_WORLD) {
        parts->world = scene_build(scene, run, NULL, e);
        done = parts->world;
    }
    if (done && needs & (EXPORT_TREES | EXPORT_LAND)) {
        parts->flow = make_flows(scene, e);
        done = parts->flow && make_trees(scene, needs & EXPORT_TREES, parts, run, e) &&
               (!(needs & EXPORT_LAND) || make_lands(scene, parts, run, e));
    }
    if (done && needs & EXPORT_GRIDS) {
        parts->grids = scene_grids(scene, run, e);
        done = parts->grids;
    }
    if (done && needs & EXPORT_POINTS) {
        done = make_points(scene, parts, run, e);
    }
    return done;
}

static bool add_bounds(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    Aabb *bounds = user;
    *bounds = aabb_union(*bounds, export_piece_bounds(piece));
    return true;
}

static bool make_report(const ExportSource *source, const Run *run, ExportReport *report, Error *e)
{
    ExportTally tally = export_all_tally(source);
    report->vertices = tally.vertices;
    report->triangles = tally.triangles;
    return export_all_pieces(source, 0, 1.0f, 1.0f, run, add_bounds, &report->bounds, e);
}

static bool write_scene(const Scene *scene, const char *file, const ExportOptions *options,
                        const Run *run, ExportReport *report, Error *e)
{
    const ExportFormat *format = export_format(file);
    Parts parts = {0};
    bool done = make_parts(scene, format->needs, &parts, run, e);
    if (done) {
        ExportSource source = {.title = scene->file,
                               .options = *options,
                               .world = parts.world,
                               .object_count = scene->object_count,
                               .object_name = parts.name,
                               .tree = (const OutTree *const *)parts.tree,
                               .flow = parts.flow,
                               .land = (const HeightField *const *)parts.land,
                               .grids = parts.grids,
                               .points = (const PointSet *const *)parts.points};
        done = format->write(&source, file, run, e) &&
               (!report || !parts.world || make_report(&source, run, report, e));
    }
    clear_parts(&parts, scene->object_count);
    return done;
}

// Index of the object with this name; -1 and e when there is none.
static int find_object(const Scene *scene, const char *name, Error *e)
{
    int found = scene_find_object(scene, name);
    if (found >= 0) {
        return found;
    }
    const char **known = memory_alloc(scene->object_count, sizeof *known, e);
    if (known) {
        char hint[512];
        for (int i = 0; i < scene->object_count; i++) {
            known[i] = scene->objects[i].name;
        }
        hint_format(name, known, scene->object_count, hint, sizeof hint);
        error_set(e, ERROR_INPUT, "the scene has no object '%s'; %s", name, hint);
        free(known);
    }
    return -1;
}

bool scene_export(const Scene *scene, const char *file, const ExportOptions *options,
                  const Run *run, ExportReport *report, Error *e)
{
    if (report) {
        *report = (ExportReport){.bounds = aabb_empty()};
    }
    if (!scene_export_check(file, e)) {
        return false;
    }
    if (options->object_count == 0) {
        return write_scene(scene, file, options, run, report, e);
    }
    // Objects do not depend on each other, so a scene with only these objects is sufficient.
    Scene few = *scene;
    few.objects = memory_alloc(options->object_count, sizeof *few.objects, e);
    few.object_count = 0;
    few.whole = scene; // has the ground they stand on
    bool done = few.objects;
    for (int i = 0; done && i < options->object_count; i++) {
        int index = find_object(scene, options->object[i], e);
        done = index >= 0;
        if (done) {
            few.objects[few.object_count++] = scene->objects[index];
        }
    }
    done = done && write_scene(&few, file, options, run, report, e);
    free(few.objects);
    return done;
}

bool scene_write_grown(const Scene *scene, const OutTree *const *trees,
                       const HeightField *const *lands, const char *file, const Run *run, Error *e)
{
    const ExportFormat *format = scene_export_check(file, e) ? export_format(file) : NULL;
    if (!format) {
        return false;
    }
    if (format->needs != (trees ? EXPORT_TREES : EXPORT_LAND)) {
        return error_set(e, ERROR_INPUT, "'%s' cannot hold %s", file,
                         trees ? "out-trees; .swc, .json and .graphml can"
                               : "heights; .png, .exr, .asc and .tif can");
    }
    const char **name = memory_alloc(scene->object_count, sizeof *name, e);
    FlowParams *flow = make_flows(scene, e);
    for (int i = 0; name && i < scene->object_count; i++) {
        name[i] = scene->objects[i].name;
    }
    ExportSource source = {.title = scene->file,
                           .object_count = scene->object_count,
                           .object_name = name,
                           .tree = trees,
                           .flow = flow,
                           .land = lands};
    bool done = name && flow && format->write(&source, file, run, e);
    free(flow);
    free(name);
    return done;
}
