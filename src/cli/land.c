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

void land_describe(const RamifyScene *scene, int index, const char *map, const RamifyLand *land)
{
    RamifyLandInfo info;
    ramify_land_info(land, &info);
    const char *name = ramify_scene_object_name(scene, index);
    if (map) {
        fprintf(stderr, "%s: %s %g to %g\n", name, map, (double)info.low, (double)info.high);
    } else {
        fprintf(stderr, "%s: heights %.1f to %.1f m, hash %016" PRIx64 "\n", name, (double)info.low,
                (double)info.high, info.hash);
    }
}

// Replaces land by its map.
static bool take_map(RamifyLand **land, const char *name, RamifyError *e)
{
    RamifyLand *map = ramify_land_map(*land, name, e);
    ramify_land_free(*land);
    *land = map;
    return map;
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
            done = lands[i] && (!options->map || take_map(&lands[i], options->map, e));
        }
    }
    done = done &&
           ramify_export_lands(scene, (const RamifyLand *const *)lands, options->output, run, e);
    for (int i = 0; lands && i < count; i++) {
        if (done && lands[i] && !options->quiet) {
            land_describe(scene, i, options->map, lands[i]);
        }
        ramify_land_free(lands[i]);
    }
    free(lands);
    return done;
}
