#include "scene/scene_flood.h"

#include "base/hash.h"
#include "base/random.h"
#include "config/compare.h"
#include "render/material/material.h"
#include "render/medium/medium.h"
#include "scene/build.h"
#include "scene/spec.h"

#include <math.h>

// Is it water: a pattern of ripples, or a dielectric with about the index of water?
static bool is_water(const Material *material)
{
    return material &&
           (material->pattern == PATTERN_WATER ||
            (material_has(material, TRAIT_BODY) && material->ior > 1.3f && material->ior < 1.36f));
}

static bool is_body_of_water(const Scene *scene, const SceneObject *object)
{
    const Kind *kind = object->kind;
    if (kind->is_water) {
        return kind->is_water(object->params);
    }
    return kind->cover && object->material[0] &&
           is_water(scene_material(scene, object->material[0]));
}

static bool covers(const void *user, Vec3 foot)
{
    const SceneFlood *flood = user;
    return foot.y < flood->level || (flood->cover && cover_hides(flood->cover, foot));
}

bool scene_flood_init(SceneFlood *flood, const Scene *scene, const Run *run, Error *e)
{
    scene = scene->whole ? scene->whole : scene;
    *flood = (SceneFlood){.level = -INFINITY, .flood = {covers, flood}};
    if (scene->medium && scene->medium->kind == MEDIUM_WATER) {
        flood->level = scene->medium->height;
    }
    for (int i = 0; i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        if (!is_body_of_water(scene, object)) {
            continue;
        }
        flood->cover = flood->cover ? flood->cover : cover_new(e);
        uint64_t seed = scene_object_seed(scene, i);
        if (!flood->cover || !object->kind->cover(object->params, seed, flood->cover, run, e)) {
            scene_flood_clear(flood);
            return false;
        }
    }
    if (flood->cover && !cover_finish(flood->cover, e)) {
        scene_flood_clear(flood);
        return false;
    }
    return true;
}

void scene_flood_clear(SceneFlood *flood)
{
    cover_free(flood->cover);
    flood->cover = NULL;
}

uint64_t scene_flood_hash(const Scene *scene)
{
    scene = scene->whole ? scene->whole : scene;
    uint64_t hash = 0;
    if (scene->medium && scene->medium->kind == MEDIUM_WATER) {
        hash = table_hash(HASH_START, &medium_table, scene->medium, NULL);
    }
    for (int i = 0; i < scene->object_count; i++) {
        if (is_body_of_water(scene, &scene->objects[i])) {
            hash = table_hash(hash, &object_table, &scene->objects[i], NULL);
            hash = random_key(hash, scene_object_seed(scene, i));
        }
    }
    return hash;
}
