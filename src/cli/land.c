#include "cli/land.h"

#include "cli/command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static bool is_land(const RamifyScene *scene, int index)
{
    RamifyObjectInfo object;
    ramify_scene_object(scene, index, &object);
    return object.is_land;
}

int land_count(const RamifyScene *scene)
{
    int count = 0;
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        count += is_land(scene, i);
    }
    return count;
}

static bool write_file(const Options *options, const RamifyScene *scene, int index,
                       const RamifyLand *land, RamifyError *e)
{
    if (land_count(scene) == 1) {
        return ramify_land_write(land, options->output, e);
    }
    char *file = output_of_object(options->output, ramify_scene_object_name(scene, index), e);
    bool done = file && ramify_land_write(land, file, e);
    free(file);
    return done;
}

static bool write_land(const Options *options, const RamifyScene *scene, int index,
                       const RamifyTree *tree, const RamifyRun *run, RamifyError *e)
{
    RamifyLand *land = ramify_land(scene, index, tree, run, e);
    bool done = land && write_file(options, scene, index, land, e);
    if (done && !options->quiet) {
        RamifyLandInfo info;
        ramify_land_info(land, &info);
        fprintf(stderr, "%s: heights %.1f to %.1f m, hash %016" PRIx64 "\n",
                ramify_scene_object_name(scene, index), (double)info.low, (double)info.high,
                info.hash);
    }
    ramify_land_free(land);
    return done;
}

bool land_write(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                const RamifyRun *run, RamifyError *e)
{
    bool done = true;
    for (int i = 0; done && i < ramify_scene_object_count(scene); i++) {
        done = !is_land(scene, i) || write_land(options, scene, i, trees[i], run, e);
    }
    return done;
}
