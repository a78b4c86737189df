// Creeks of a delta's marsh and its stirred water: widths by the area drained, gaps in levees, the
// look-up, land that creeks drain, plumes with fronts, peat away from the sea.
#include "base/random.h"
#include "land/creeks.h"
#include "making.h"
#include "making_terrain.h"
#include "objects/terrain/delta.h"
#include "testing.h"

#include <math.h>
#include <string.h>

enum { SIDE = 60 };

typedef struct Plain {
    uint8_t ground[SIDE * SIDE];
    float cost[SIDE * SIDE];
} Plain;

// Marsh of one cost throughout; the last row is water.
static CreekPlain even_plain(Plain *p)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        p->ground[i] = i / SIDE == SIDE - 1 ? CREEK_WATER : CREEK_MARSH;
        p->cost[i] = 1.0f;
    }
    return (CreekPlain){.columns = SIDE,
                        .rows = SIDE,
                        .ground = p->ground,
                        .cost = p->cost,
                        .least = 4.0f,
                        .width = 0.4f,
                        .most = 100.0f};
}

static Creeks *grown(const CreekPlain *plain)
{
    Error e = {0};
    Creeks *creeks = creeks_grow(plain, &e);
    if (!creeks) {
        fail_msg("%s", e.message);
    }
    return creeks;
}

static float widest(const Creeks *creeks)
{
    float half = 0.0f;
    for (int64_t k = 0; k < creeks->count; k++) {
        half = fmaxf(half, creeks->reach[k].half_from);
    }
    return half;
}

// A strip of marsh one sample wide: the sample above the water drains all of it.
static void width_grows_with_the_area(void **state)
{
    (void)state;
    static Plain p;
    CreekPlain plain = even_plain(&p);
    for (int i = 0; i < SIDE * (SIDE - 1); i++) {
        p.ground[i] = i % SIDE == 30 ? CREEK_MARSH : CREEK_NONE;
    }
    Creeks *creeks = grown(&plain);
    double wanted = 0.5 * 0.4 * pow((SIDE - 1) / 4.0, 0.375);
    print_message("half %.4f, wanted %.4f\n", (double)widest(creeks), wanted);
    assert_true(fabs((double)widest(creeks) / wanted - 1.0) < 1e-4);
    assert_int_equal(creeks->count, SIDE - 1 - 3); // the first three drain less than 4 samples
    creeks_free(creeks);
    plain.most = 0.3f;
    creeks = grown(&plain);
    assert_true(widest(creeks) == 0.15f);
    creeks_free(creeks);
}

// Along a levee that costs a thousand times as much, with one gap, all creeks leave by the gap.
static void creeks_pass_levees_at_gaps(void **state)
{
    (void)state;
    enum { LEVEE = 50, GAP = 17 };
    static Plain p;
    CreekPlain plain = even_plain(&p);
    for (int i = 0; i < SIDE; i++) {
        p.cost[LEVEE * SIDE + i] = i == GAP ? 1.0f : 1000.0f;
    }
    plain.least = 12.0f;
    Creeks *creeks = grown(&plain);
    int through = 0;
    for (int64_t k = 0; k < creeks->count; k++) {
        CreekReach r = creeks->reach[k];
        if (r.from.y <= LEVEE + 0.5f && r.to.y > LEVEE + 0.5f) {
            through++;
            assert_true(fabsf(r.to.x - GAP) < 1.5f);
        }
    }
    assert_true(through == 1);
    creeks_free(creeks);
}

// The look-up by blocks finds what a search of all reaches finds.
static void look_up_finds_the_nearest(void **state)
{
    (void)state;
    static Plain p;
    CreekPlain plain = even_plain(&p);
    for (int i = 0; i < SIDE * SIDE; i++) {
        p.cost[i] = random_range(random_key(7, (uint64_t)i), 0.1f, 2.0f);
    }
    Creeks *creeks = grown(&plain);
    int inside = 0;
    for (uint64_t n = 0; n < 4000; n++) {
        Vec2 at = {random_range(random_key(8, n), 0.0f, SIDE - 1),
                   random_range(random_key(9, n), 0.0f, SIDE - 1)};
        float least = INFINITY, half, side = creeks_beside(creeks, at, &half);
        for (int64_t k = 0; k < creeks->count; k++) {
            CreekReach r = creeks->reach[k];
            float x = r.to.x - r.from.x, z = r.to.y - r.from.y, squared = x * x + z * z;
            float t = ((at.x - r.from.x) * x + (at.y - r.from.y) * z) / squared;
            t = squared > 0.0f ? clampf(t, 0.0f, 1.0f) : 0.0f;
            x = at.x - r.from.x - t * x;
            z = at.y - r.from.y - t * z;
            least = fminf(least, sqrtf(x * x + z * z) / lerpf(r.half_from, r.half_to, t));
        }
        assert_true(least > CREEK_REACH ? side > CREEK_REACH : fabsf(side - least) < 1e-4f);
        inside += side < 1.0f;
    }
    print_message("%d of 4000 places lie in %d reaches\n", inside, (int)creeks->count);
    assert_true(inside > 100 && inside < 2500);
    creeks_free(creeks);
}

static TerrainParams small_delta(void)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_DELTA;
    params.size = 2048.0f;
    params.resolution = 512;
    params.delta.width = 100.0f;
    params.delta.age = 0.7f;
    return params;
}

// Trees of creeks take the place of those where two levels of noise meet, 0.14 of the river's
// depth: ground rises by no more than these, sinks along the new ones, and the water reaches far
// into it.
static void creeks_cut_the_marsh(void **state)
{
    (void)state;
    TerrainParams plain = small_delta(), cut = plain;
    cut.delta.creeks = 1.0f;
    Grown grown;
    HeightField *before = make_heights(&plain, 5, 0, NULL, NULL);
    HeightField *after = make_heights(&cut, 5, 2, NULL, &grown);
    HeightField *again = make_heights(&cut, 5, 1, NULL, NULL);
    size_t bytes = (size_t)height_field_count(after) * sizeof(float);
    assert_memory_equal(after->height, again->height, bytes);
    const DeltaLand *land = ((const Terrain *)grown.state)->delta;
    int64_t lowered = 0, wet = 0;
    float raised = 0.0f;
    for (int64_t i = 0; i < height_field_count(after); i++) {
        float change = after->height[i] - before->height[i];
        raised = fmaxf(raised, change);
        lowered += change < -0.1f;
        wet += after->height[i] < after->water[i] && before->height[i] >= before->water[i];
    }
    double share = (double)lowered / (double)height_field_count(after);
    print_message("%d reaches lower %.1f %% of the square; %d samples more under water\n",
                  (int)land->creeks->count, 100.0 * share, (int)wet);
    assert_true(land->creeks->count > 1000 && share > 0.01 && share < 0.2 && wet > 1000);
    assert_true(raised <= 0.1401f * (float)land->model->depth);
    height_field_free(before);
    height_field_free(after);
    height_field_free(again);
    grown_clear(&grown);
}

// Of the water of the south: the mean of its mud, and the share of places at fronts.
// settles: take mud as if it did.
static void sea(const Terrain *terrain, bool settles, double *mean, double *front)
{
    enum { EACH = 220 };
    int64_t count = 0, steep = 0;
    *mean = 0.0;
    for (int k = 0; k < EACH * EACH; k++) {
        float x = -900.0f + 8.0f * (float)(k % EACH), z = 100.0f + 4.0f * (float)(k / EACH);
        float here = terrain_delta_load(terrain, x, z);
        float there = terrain_delta_load(terrain, x + 6.0f, z);
        assert_true(here >= 0.0f && here <= 2.0f);
        if (here <= 1.0f && there <= 1.0f) {
            *mean += (double)(settles ? delta_settled(here) : here);
            steep += fabsf(there - here) > 0.05f;
            count++;
        }
    }
    *mean /= (double)count;
    *front = (double)steep / (double)count;
}

// Eddies carry the mud of plumes about, they neither make nor lose much of it, but draw its borders
// out into fronts. Peat is in the marsh alone.
static void eddies_make_fronts(void **state)
{
    (void)state;
    TerrainParams plain = small_delta(), stirred = plain;
    stirred.delta.stirred = 1.0f;
    Grown grown[2];
    height_field_free(make_heights(&plain, 5, 0, NULL, &grown[0]));
    height_field_free(make_heights(&stirred, 5, 0, NULL, &grown[1]));
    double mean[2], front[2];
    for (int k = 0; k < 2; k++) {
        sea(grown[k].state, k == 0, &mean[k], &front[k]);
        print_message("mud %.3f, fronts on %.1f %%\n", mean[k], 100.0 * front[k]);
    }
    assert_true(fabs(mean[1] / mean[0] - 1.0) < 0.25);
    assert_true(front[1] > 0.03 && front[0] < 0.01);
    const Terrain *terrain = grown[1].state;
    const Delta *d = terrain->delta->model;
    int64_t peat = 0;
    for (int64_t i = 0; i < delta_count(d); i++) {
        float x = (float)(terrain->delta->corner + d->cell * ((double)delta_column(d, i) + 0.5));
        float z = (float)(terrain->delta->corner + d->cell * ((double)delta_row(d, i) + 0.5));
        peat += terrain_delta_load(terrain, x, z) > 1.5f;
        assert_true(delta_row(d, i) < d->rows - 8 || terrain_delta_load(terrain, x, z) <= 1.0f);
    }
    assert_true(peat > 50);
    grown_clear(&grown[0]);
    grown_clear(&grown[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(width_grows_with_the_area), cmocka_unit_test(creeks_pass_levees_at_gaps),
        cmocka_unit_test(look_up_finds_the_nearest), cmocka_unit_test(creeks_cut_the_marsh),
        cmocka_unit_test(eddies_make_fronts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
