#include "scene/cloud_grounds.h"

#include "base/memory.h"
#include "land/cold_pool.h"
#include "render/cloud/clouds.h"

#include <stdlib.h>
#include <string.h>

static const HeightField *find_land(const Geometry *geometry, int object)
{
    for (int64_t i = 0; i < geometry->count; i++) {
        if (geometry->part[i].object == object && geometry->part[i].land) {
            return geometry->part[i].land;
        }
    }
    return NULL;
}

// A floor from a square level, whose samples it takes.
static CloudFloor *floor_of(HeightField *level, Error *e)
{
    CloudFloor *floor = memory_alloc(1, sizeof *floor, e);
    if (floor) {
        *floor = (CloudFloor){.side = level->columns,
                              .x = level->origin.x,
                              .z = level->origin.y,
                              .cell = level->cell.x,
                              .periodic = level->periodic,
                              .height = level->height};
        height_field_range(level, &floor->least, &floor->most);
        level->height = NULL;
    }
    return floor;
}

static bool pool(Cloud *cloud, const HeightField *land, const Run *run, Error *e)
{
    ColdPoolParams params = {.radius = cloud->pool,
                             .depth = cloud->thickness,
                             .drift = cloud->drift,
                             .wind = cloud->wind};
    HeightField *level = cold_pool_level(land, &params, run, e);
    cloud->floor = level ? floor_of(level, e) : NULL;
    height_field_free(level);
    return cloud->floor;
}

// What the parts of an object throw up.
static bool gather_spray(Cloud *cloud, const Geometry *geometry, int object, Error *e)
{
    cloud->spray = memory_alloc_zero(1, sizeof *cloud->spray, e);
    bool done = cloud->spray;
    for (int64_t i = 0; done && i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        done = part->object != object || !part->spray || spray_join(cloud->spray, part->spray, e);
    }
    return done;
}

// Gives a copy of the part's falling water to the cloud of that number.
static bool take_water(World *world, int index, const Part *part, Error *e)
{
    SprayParcels *water = memory_alloc_zero(1, sizeof *water, e);
    world->cloud[index].spray = water;
    return water && spray_join(water, part->water, e);
}

// The cloud takes the falling water of one part, and a further one that of each further part: falls
// lie far apart, and each needs a fine grid.
static bool gather_water(World *world, int index, int object, Error *e)
{
    int64_t capacity = world->cloud_count;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        if (part->object != object || !part->water || part->water->count == 0) {
            continue;
        }
        int at = index;
        if (world->cloud[index].spray) {
            at = world->cloud_count;
            if (!memory_reserve(&world->cloud, &capacity, at + 1, sizeof *world->cloud, e)) {
                return false;
            }
            world->cloud[at] = world->cloud[index];
            world->cloud_count++;
        }
        if (!take_water(world, at, part, e)) {
            return false;
        }
    }
    if (!world->cloud[index].spray) {
        error_set(e, ERROR_INPUT, "object '%s' has no falling water: it has no waterfall",
                  world->cloud[index].over);
    }
    return world->cloud[index].spray;
}

static bool raise_spray(World *world, int index, int object, Error *e)
{
    Cloud *cloud = &world->cloud[index];
    if (cloud->of == SPRAY_WATER) {
        return gather_water(world, index, object, e) || error_key(e, "clouds.%d.over", index);
    }
    if (!gather_spray(cloud, &world->geometry, object, e)) {
        return error_key(e, "clouds.%d", index);
    }
    if (cloud->spray->count == 0) {
        error_set(e, ERROR_INPUT,
                  "object '%s' throws up no spray: it has neither a waterfall nor surf before "
                  "steep land",
                  cloud->over);
        return error_key(e, "clouds.%d.over", index);
    }
    return true;
}

bool scene_ground_clouds(World *world, const Scene *scene, const Run *run, Error *e)
{
    for (int i = 0; i < scene->cloud_count; i++) { // falling water adds further ones
        Cloud *cloud = &world->cloud[i];
        int object = cloud->over ? scene_find_object(scene, cloud->over) : -1;
        if (object < 0) { // none is asked for, or the scene is a part without the terrain
            continue;
        }
        if (cloud->kind == CLOUD_SPRAY) {
            if (!raise_spray(world, i, object, e)) {
                return false;
            }
            continue;
        }
        const HeightField *land = find_land(&world->geometry, object);
        if (!land) {
            error_set(e, ERROR_INPUT,
                      "object '%s' is no terrain that shows its land; fog lies "
                      "over such ones alone",
                      cloud->over);
            return error_key(e, "clouds.%d.over", i);
        }
        if (!pool(cloud, land, run, e)) {
            return error_key(e, "clouds.%d", i);
        }
    }
    return true;
}

// ---- estimate

double scene_cloud_memory(const Scene *scene)
{
    double sum = 0.0;
    for (int i = 0; i < scene->cloud_count; i++) {
        Cloud cloud = scene->clouds[i];
        int object = cloud.over ? scene_find_object(scene, cloud.over) : -1;
        LandExtent extent;
        CloudFloor floor;
        const Kind *kind = object >= 0 ? scene->objects[object].kind : NULL;
        if (kind && kind->extent) {
            kind->extent(scene->objects[object].params, &extent);
            floor = (CloudFloor){.side = 2, .cell = extent.side, .most = extent.relief};
            cloud.floor = &floor;
        }
        sum += (double)clouds_bytes(&cloud, 1);
    }
    return sum;
}
