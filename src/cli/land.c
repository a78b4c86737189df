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

static void describe(const RamifyScene *scene, int index, const RamifyLand *land)
{
    RamifyLandInfo info;
    ramify_land_info(land, &info);
    fprintf(stderr, "%s: heights %.1f to %.1f m, hash %016" PRIx64 "\n",
            ramify_scene_object_name(scene, index), (double)info.low, (double)info.high, info.hash);
}

bool land_write(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                const RamifyRun *run, RamifyError *e)
{
    int count = ramify_scene_object_count(scene);
    RamifyLand **lands = allocate(count, sizeof(RamifyLand *), e);
    bool done = lands;
    for (int i = 0; done && i < count; i++) {
        if (is_land(scene, i)) {
            lands[i] = ramify_land(scene, i, trees[i], run, e);
            done = lands[i];
        }
    }
    done = done &&
           ramify_export_lands(scene, (const RamifyLand *const *)lands, options->output, run, e);
    for (int i = 0; lands && i < count; i++) {
        if (done && lands[i] && !options->quiet) {
            describe(scene, i, lands[i]);
        }
        ramify_land_free(lands[i]);
    }
    free(lands);
    return done;
}
