#include "objects/common/snow_boughs.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/boughs.h"
#include "objects/common/snow_spray.h"

#include <stdlib.h>

enum { STREAM_PILLOWS = 20 }; // of an object

// A spray at its place on a bough.
typedef struct Placed {
    int32_t bough;
    int32_t part;
    int64_t instance;
} Placed;

typedef struct BoughSnow {
    const SnowParams *params;
    const SnowReach *reach;
    const Placing *placing;
    int64_t first; // part of the geometry
    int parts;
    SprayBearers *of_part;
    Placed *placed; // by bough
    int64_t placed_count, placed_capacity;
    SnowBearer *bearer; // of the bough at hand
    int64_t bearer_count, bearer_capacity;
    SnowPile pile;
} BoughSnow;

static const Part *part_of(const BoughSnow *snow, int part)
{
    return &snow->placing->geometry->part[snow->first + part];
}

static int compare_placed(const void *a, const void *b)
{
    const Placed *s = a, *t = b;
    if (s->bough != t->bough) {
        return s->bough < t->bough ? -1 : 1;
    }
    if (s->part != t->part) {
        return s->part < t->part ? -1 : 1;
    }
    return s->instance < t->instance ? -1 : s->instance > t->instance;
}

// Finds every spray's bough.
static bool sort_sprays(BoughSnow *snow, const Boughs *boughs, Error *e)
{
    Spray spray;
    for (int k = 0; k < snow->parts; k++) {
        const Part *part = part_of(snow, k);
        if (!snow_spray_of(part, &spray)) {
            continue;
        }
        if (!snow_spray_bearers(part->mesh, &snow->of_part[k], e)) {
            return false;
        }
        for (int64_t i = 0; i < part->instance_count; i++) {
            Vec3 stem = transform_point(&part->instance[i], vec3(0, 0, 0));
            Placed placed = {boughs_nearest(boughs, stem), k, i};
            if (!run_goes_on(snow->placing->recipe->run, i, e) ||
                !memory_reserve(&snow->placed, &snow->placed_capacity, snow->placed_count + 1,
                                sizeof placed, e)) {
                return false;
            }
            snow->placed[snow->placed_count++] = placed;
        }
    }
    if (snow->placed_count > 0) {
        qsort(snow->placed, (size_t)snow->placed_count, sizeof *snow->placed, compare_placed);
    }
    return true;
}

// Adds what of the spray bears snow to that of its bough.
static bool add_bearers(BoughSnow *snow, const Placed *placed, Error *e)
{
    const SprayBearers *all = &snow->of_part[placed->part];
    const Transform *t = &part_of(snow, placed->part)->instance[placed->instance];
    float scale = vec3_length(transform_vector(t, vec3(0, 1, 0)));
    if (!memory_reserve(&snow->bearer, &snow->bearer_capacity, snow->bearer_count + all->count,
                        sizeof *snow->bearer, e)) {
        return false;
    }
    for (int64_t i = 0; i < all->count; i++) {
        snow->bearer[snow->bearer_count++] =
            (SnowBearer){transform_point(t, all->bearer[i].p), scale * scale * all->bearer[i].area};
    }
    return true;
}

static bool pile_up(BoughSnow *snow, Error *e)
{
    uint64_t seed = random_key(snow->placing->recipe->seed, STREAM_PILLOWS);
    bool done = true;
    for (int64_t i = 0; done && i < snow->placed_count;) {
        int32_t bough = snow->placed[i].bough;
        snow->bearer_count = 0;
        for (; done && i < snow->placed_count && snow->placed[i].bough == bough; i++) {
            done = add_bearers(snow, &snow->placed[i], e);
        }
        done = done && run_goes_on(snow->placing->recipe->run, 0, e) &&
               snow_add_pillows(&snow->pile, snow->bearer, snow->bearer_count, snow->params,
                                snow->reach, random_key(seed, (uint64_t)bough), e);
    }
    return done;
}

static void bough_snow_clear(BoughSnow *snow)
{
    for (int k = 0; snow->of_part && k < snow->parts; k++) {
        free(snow->of_part[k].bearer);
    }
    free(snow->of_part);
    free(snow->placed);
    free(snow->bearer);
    snow_pile_clear(&snow->pile);
}

Mesh *snow_on_boughs(const OutTree *tree, const SnowParams *params, const SnowReach *reach,
                     int64_t first, const Placing *placing, SnowCrumbs *crumbs, Error *e)
{
    BoughSnow snow = {.params = params,
                      .reach = reach,
                      .placing = placing,
                      .first = first,
                      .parts = (int)(placing->geometry->count - first)};
    Boughs boughs = {0};
    snow.of_part = memory_alloc_zero(snow.parts, sizeof *snow.of_part, e);
    bool done = snow.of_part && boughs_init(&boughs, tree, e) && sort_sprays(&snow, &boughs, e) &&
                pile_up(&snow, e);
    Mesh *mesh = done ? snow_pile_mesh(&snow.pile, e) : NULL;
    *crumbs = snow.pile.crumbs;
    snow.pile.crumbs = (SnowCrumbs){0};
    boughs_free(&boughs);
    bough_snow_clear(&snow);
    return mesh;
}
