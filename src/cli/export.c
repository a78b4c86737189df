// ramify export: converts a scene to another program's file.
#include "base/json.h"
#include "cli/command.h"

#include <stdio.h>
#include <string.h>

static bool read_options(const Options *options, RamifyExportOptions *own, RamifyError *e)
{
    static const char *const instances[] = {"auto", "nodes", "gpu", "flat"};
    static const char *const colors[] = {"all", "pattern", "growth", "none"};
    int how = command_choice("instances", options->instances, instances, 4, e);
    int what = how >= 0 ? command_choice("colors", options->colors, colors, 4, e) : -1;
    if (what < 0) {
        return false;
    }
    *own = (RamifyExportOptions){.objects = options->objects,
                                 .object_count = options->object_count,
                                 .instances = how,
                                 .colors = what,
                                 .tube_sides = options->tube_sides};
    return true;
}

static void print_report(const char *file, const RamifyExportReport *report)
{
    printf("{\"file\": ");
    json_put_string(stdout, file);
    printf(", \"bytes\": %lld, \"vertices\": %lld, \"triangles\": %lld", (long long)report->bytes,
           (long long)report->vertices, (long long)report->triangles);
    printf(", \"low\": [%.9g, %.9g, %.9g], \"high\": [%.9g, %.9g, %.9g]", (double)report->low[0],
           (double)report->low[1], (double)report->low[2], (double)report->high[0],
           (double)report->high[1], (double)report->high[2]);
    printf(", \"memory\": %lld}\n", (long long)ramify_memory_peak());
}

bool command_export(const Options *options, RamifyError *e)
{
    RamifyExportOptions own;
    if (!options->output) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "no file to write is named; add -o FILE with the ending of a format");
    }
    RamifyScene *scene = read_options(options, &own, e) &&
                                 ramify_export_check(options->output, e) &&
                                 output_check(options->output, e)
                             ? command_scene(options, e)
                             : NULL;
    if (!scene) {
        return false;
    }
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    RamifyExportReport report = {0};
    bool done =
        ramify_export(scene, options->output, &own, &run, options->json ? &report : NULL, e);
    progress_end(&progress);
    if (done && options->json) {
        print_report(options->output, &report);
    } else if (done && !options->quiet) {
        fprintf(stderr, "%s\n", options->output);
    }
    ramify_scene_free(scene);
    return done;
}
