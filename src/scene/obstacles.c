#include "scene/obstacles.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

// How far a surface is searched beyond the distance to be kept, as a share of the obstacle's size.
#define REACH_SHARE 0.05f

typedef struct Obstacle {
    const Nearest *surface;        // borrowed
    float distance, within, reach; // m
} Obstacle;

struct Obstacles {
    Obstacle *obstacle;
    int count;
};

static bool prepare(Obstacle *obstacle, const Scene *scene, const ClearOf *of, Surfaces *surfaces,
                    const Run *run, Error *e)
{
    float size, most = of->within > of->distance ? of->within : of->distance;
    obstacle->surface = surfaces_of(surfaces, scene_find_object(scene, of->object), &size, run, e);
    if (!obstacle->surface) {
        return false;
    }
    obstacle->distance = of->distance;
    obstacle->within = of->within;
    obstacle->reach = most + REACH_SHARE * size + 1e-6f;
    return true;
}

bool obstacles_new(const Scene *scene, int index, Surfaces *surfaces, const Run *run,
                   Obstacles **obstacles, Error *e)
{
    const SceneObject *object = &scene->objects[index];
    *obstacles = NULL;
    if (object->clear_of_count == 0) {
        return true;
    }
    Obstacles *made = memory_alloc_zero(1, sizeof *made, e);
    bool done = made && (made->obstacle =
                             memory_alloc_zero(object->clear_of_count, sizeof *made->obstacle, e));
    for (int i = 0; done && i < object->clear_of_count; i++) {
        done = prepare(&made->obstacle[i], scene, &object->clear_of[i], surfaces, run, e);
        made->count += done;
    }
    if (!done) {
        obstacles_free(made);
        return false;
    }
    *obstacles = made;
    return true;
}

void obstacles_free(Obstacles *obstacles)
{
    if (obstacles) {
        free(obstacles->obstacle);
        free(obstacles);
    }
}

float obstacles_clearance(const Obstacles *obstacles, Vec3 p, Vec3 *away)
{
    float least = INFINITY;
    *away = vec3(0, 0, 0);
    for (int i = 0; i < obstacles->count; i++) {
        const Obstacle *obstacle = &obstacles->obstacle[i];
        Vec3 direction;
        float distance = nearest_distance(obstacle->surface, p, obstacle->reach, &direction) -
                         obstacle->distance;
        if (distance < least) {
            least = distance;
            *away = direction;
        }
    }
    return least;
}

bool obstacles_allow(const Obstacles *obstacles, Vec3 p)
{
    for (int i = 0; i < obstacles->count; i++) {
        const Obstacle *obstacle = &obstacles->obstacle[i];
        Vec3 away;
        float distance = nearest_distance(obstacle->surface, p, obstacle->reach, &away);
        if (distance < obstacle->distance ||
            (obstacle->within > 0.0f && distance > obstacle->within)) {
            return false;
        }
    }
    return true;
}
