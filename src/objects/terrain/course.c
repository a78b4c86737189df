// Courses of rivers across a plateau. A river's direction swings as a sine of the way along it
// (Langbein and Leopold 1966), each bend a little different from the last.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <stdlib.h>

enum { PIECES = 768 }; // of a course

enum { NUMBER_SIDE = 1, NUMBER_PHASE, NUMBER_AMPLITUDE, NUMBER_ENDS };

typedef struct Course {
    float sinuosity;
    float bends;   // along the valley
    Vec2 from, to; // outlet and spring, m
    float half;    // of the water's width, m
    uint64_t seed;
} Course;

// Places along the course, PIECES + 1, from the outlet up: the integral of the swinging direction,
// turned and scaled so that its ends lie where they should. At both ends the river runs straight,
// across the border.
static void trace_course(const Course *course, Vec2 *place)
{
    float phase = 6.2831853f * random_unit(random_key(course->seed, NUMBER_PHASE));
    // Langbein and Leopold: sinuosity of the largest angle to the valley.
    float swing = 2.2f * sqrtf((course->sinuosity - 1.0f) / course->sinuosity);
    place[0] = (Vec2){0.0f, 0.0f};
    for (int i = 0; i < PIECES; i++) {
        float t = ((float)i + 0.5f) / PIECES, u = course->bends * t;
        float uneven = sparse_noise(0.8f * u, 3.0f, random_key(course->seed, NUMBER_AMPLITUDE));
        float wander = sparse_noise(0.35f * u, 7.0f, random_key(course->seed, NUMBER_AMPLITUDE));
        float ends = smoothstepf(0.0f, 0.06f, t) * smoothstepf(1.0f, 0.94f, t);
        float sine, cosine;
        exact_sincos(6.2831853f * (u + 0.15f * wander) + phase, &sine, &cosine);
        float angle = ends * (swing * (1.0f + 0.3f * clampf(uneven, -1.5f, 1.5f)) * sine +
                              0.25f * clampf(wander, -1.5f, 1.5f) * (swing > 0.0f));
        exact_sincos(angle, &sine, &cosine);
        place[i + 1] = (Vec2){place[i].x + cosine, place[i].y + sine};
    }
    Vec2 end = place[PIECES];
    float squared = end.x * end.x + end.y * end.y;
    float dx = course->to.x - course->from.x, dz = course->to.y - course->from.y;
    float a = (end.x * dx + end.y * dz) / squared, b = (end.x * dz - end.y * dx) / squared;
    for (int i = 0; i <= PIECES; i++) {
        Vec2 p = place[i];
        place[i] = (Vec2){course->from.x + a * p.x - b * p.y, course->from.y + b * p.x + a * p.y};
    }
}

static bool add_course(OutTree *tree, const Course *course, int number, float border, Error *e)
{
    Vec2 place[PIECES + 1];
    trace_course(course, place);
    int64_t below = -1;
    for (int i = 0; i <= PIECES; i++) {
        Vec3 p = {clampf(place[i].x, -border, border), 0.0f, clampf(place[i].y, -border, border)};
        below =
            out_tree_add_node(tree, p, below, i, number, random_key(course->seed, (uint64_t)i), e);
        if (below < 0) {
            return false;
        }
        tree->radius[below] = course->half;
    }
    return true;
}

// Streams of the plain run from border to border, in turn along z and along x.
static Course plain_stream(const TerrainParams *params, int number, uint64_t seed)
{
    float border = 0.5f * params->size;
    int rank = number / 2, ranks = (params->mesas.streams + 1) / 2; // among those of its direction
    float share = ((float)rank + 0.5f) / (float)ranks - 0.5f;
    float from = share + random_range(random_key(seed, NUMBER_ENDS), -0.12f, 0.12f);
    float to = share + random_range(random_key(seed, NUMBER_ENDS + 1), -0.12f, 0.12f);
    bool along_x = number % 2 != 0;
    Vec2 outlet = {border, from * params->size}, spring = {-border, to * params->size};
    if (!along_x) {
        outlet = (Vec2){outlet.y, outlet.x};
        spring = (Vec2){spring.y, spring.x};
    }
    return (Course){1.25f, 3.0f, outlet, spring, 0.0f, seed};
}

bool terrain_grow_courses(OutTree **tree, const TerrainParams *given, const Recipe *recipe,
                          Error *e)
{
    TerrainParams params = terrain_params_resolve(given);
    float border = 0.5f * params.size;
    uint64_t seed = random_key(recipe->seed, STREAM_COURSE);
    *tree = out_tree_new(e);
    bool done = *tree;
    if (params.form == TERRAIN_CANYON) {
        float aside =
            0.08f * params.size * (2.0f * random_unit(random_key(seed, NUMBER_SIDE)) - 1.0f);
        Course course = {.sinuosity = params.canyon.sinuosity,
                         .bends = 1.0f / params.canyon.meander,
                         .from = {aside, border},
                         .to = {-aside, -border},
                         .half = 0.5f * params.canyon.river,
                         .seed = seed};
        return done && add_course(*tree, &course, 0, border, e);
    }
    for (int i = 0; done && i < params.mesas.streams; i++) {
        Course course = plain_stream(&params, i, random_key(seed, (uint64_t)i + 16));
        done = add_course(*tree, &course, i, border, e);
    }
    return done;
}

bool terrain_fill_courses(Terrain *terrain, const Run *run, Error *e)
{
    (void)run;
    OutTree *tree = terrain->tree;
    terrain->area = memory_alloc(tree->count, sizeof *terrain->area, e);
    for (int64_t i = 0; terrain->area && i < tree->count; i++) {
        terrain->area[i] = 1.0f;
        tree->position[i].y = terrain_course_height(terrain->params, tree, i);
    }
    return terrain->area;
}
