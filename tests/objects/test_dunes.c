// Dunes: wind over a wavy bed, volume, threads, the repeating square, slopes, how barchans move.
#include "land/dunes.h"
#include "land/dunes_measure.h"
#include "land/height_mesh.h"
#include "making_terrain.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define REPOSE 0.6619
static const double TURN = 6.283185307179586;

static Run run_with(int threads)
{
    Run run = run_default();
    run.threads = threads;
    return run;
}

// A heap in the middle of a bare plain; cells are metres.
static Dunes *heap(int side, double radius)
{
    Dunes *dunes = dunes_new(side, side, NULL);
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        double x = (double)(i % side) - 0.5 * side, z = (double)(i / side) - 0.5 * side;
        dunes->sand[i] = fmax(0.3 * radius * (exp(-(x * x + z * z) / (radius * radius)) - 0.02), 0);
    }
    return dunes;
}

static void blow(Dunes *dunes, const DuneWind *wind, double time, int threads)
{
    Error e = {0};
    Run run = run_with(threads);
    if (!dunes_blow(dunes, wind, time, REPOSE, &run, &e)) {
        fail_msg("%s", e.message);
    }
}

// A (|k| + i B k) h of waves along the wind, A k_x^2 / |k| (1 + i B) h of oblique ones.
static void shear_over_waves_has_its_closed_form(void **state)
{
    (void)state;
    enum { SIDE = 128 };
    Run run = run_with(1);
    for (int v = 0; v <= 2; v++) {
        Dunes *dunes = dunes_new(SIDE, SIDE, NULL);
        double kx = TURN * 2 / SIDE, kz = TURN * v / SIDE, k = sqrt(kx * kx + kz * kz), a = 0.1;
        for (int64_t i = 0; i < dunes_count(dunes); i++) {
            dunes->sand[i] = 1.0 + a * cos(kx * (double)(i % SIDE) + kz * (double)(i / SIDE));
        }
        DuneWind wind = {.x = 1.0, .threshold = 0.3, .saturation = 1.0};
        assert_true(dunes_find_shear(dunes, &wind, &run, NULL));
        double gain = DUNES_SHEAR_GAIN * a * kx * kx / k;
        for (int64_t i = 0; i < dunes_count(dunes); i++) {
            double phase = kx * (double)(i % SIDE) + kz * (double)(i / SIDE);
            double wanted = 1.0 + gain * (cos(phase) - DUNES_SHEAR_SHIFT * sin(phase));
            if (fabs(dunes->shear[2 * i] - wanted) > 0.01 * gain) { // the grid costs 0.4 %
                fail_msg("shear %g, not %g, of wave %d", dunes->shear[2 * i], wanted, v);
            }
        }
        dunes_free(dunes);
    }
}

static Dunes *three_winds(int threads, int shift)
{
    enum { SIDE = 128 };
    Dunes *start = heap(SIDE, 20.0), *dunes = dunes_new(SIDE, SIDE, NULL);
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        int64_t x = (i % SIDE + shift) % SIDE, z = (i / SIDE + 2 * shift) % SIDE;
        dunes->sand[z * SIDE + x] = start->sand[i];
    }
    dunes_free(start);
    for (int n = 0; n < 3; n++) {
        double angle = 0.4 + TURN / 3.0 * n;
        DuneWind wind = {cos(angle), sin(angle), 0.3, 0.8};
        blow(dunes, &wind, 3.0, threads);
    }
    return dunes;
}

static void volume_stays_and_threads_do_not_matter(void **state)
{
    (void)state;
    Dunes *start = heap(128, 20.0), *one = three_winds(1, 0), *four = three_winds(4, 0);
    double volume = dunes_volume(start), lost = fabs(dunes_volume(one) - volume) / volume;
    if (!(lost < 1e-6)) {
        fail_msg("%g of the volume is lost", lost);
    }
    size_t bytes = sizeof(double) * (size_t)dunes_count(one);
    assert_memory_equal(one->sand, four->sand, bytes);
    assert_true(memcmp(one->sand, start->sand, bytes) != 0);
    for (int64_t i = 0; i < dunes_count(one); i++) {
        assert_true(one->sand[i] > -0.05);
    }
    Dunes *finer = dunes_refined(one, NULL);
    assert_true(fabs(dunes_volume(finer) - volume) < 1e-6 * volume);
    dunes_free(start);
    dunes_free(one);
    dunes_free(four);
    dunes_free(finer);
}

// Where the square begins matters little: 2 % of a heap 6 m high. The flux through the border is
// that of the last sweep.
static void the_square_has_no_seam(void **state)
{
    (void)state;
    enum { SHIFT = 29 };
    Dunes *one = three_winds(2, 0), *other = three_winds(2, SHIFT);
    double worst = 0.0;
    for (int64_t i = 0; i < dunes_count(one); i++) {
        int64_t x = (i % 128 + SHIFT) % 128, z = (i / 128 + 2 * SHIFT) % 128;
        worst = fmax(worst, fabs(one->sand[i] - other->sand[z * 128 + x]));
    }
    if (!(worst < 0.12)) {
        fail_msg("a shifted square differs by %g m", worst);
    }
    dunes_free(one);
    dunes_free(other);
}

// ---- barchans

// Mean place of the sand along the wind, in turns of the square.
static double place_of(const Dunes *dunes)
{
    double s = 0.0, c = 0.0;
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        double angle = TURN * (double)(i % dunes->side) / dunes->side;
        s += dunes->sand[i] * sin(angle);
        c += dunes->sand[i] * cos(angle);
    }
    return atan2(s, c) / TURN;
}

static double highest(const Dunes *dunes, int64_t *where)
{
    double high = 0.0;
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        *where = dunes->sand[i] > high ? i : *where;
        high = fmax(high, dunes->sand[i]);
    }
    return high;
}

// How many cells farther downwind than the crest sand lies: the horns.
static int horns(const Dunes *dunes, int64_t crest)
{
    int side = dunes->side, most = 0;
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        int ahead = (int)((i % side - crest % side + side) % side);
        int aside = abs((int)(i / side - crest / side));
        bool sand = dunes->sand[i] > 0.3;
        most = sand && ahead < side / 2 && aside > 6 && ahead > most ? ahead : most;
    }
    return most;
}

static void barchans_move_downwind_the_slower_the_higher(void **state)
{
    (void)state;
    enum { SIDE = 128 };
    const double radius[] = {12.0, 18.0};
    double speed[2], height[2];
    DuneWind wind = {.x = 1.0, .threshold = 0.3, .saturation = 0.7};
    for (int n = 0; n < 2; n++) {
        Dunes *dunes = heap(SIDE, radius[n]);
        blow(dunes, &wind, 90.0, 1);
        double from = place_of(dunes);
        int64_t crest = 0;
        blow(dunes, &wind, 15.0, 1);
        double moved = place_of(dunes) - from;
        speed[n] = (moved - floor(moved)) * SIDE / 15.0;
        height[n] = highest(dunes, &crest);
        assert_true(horns(dunes, crest) > 8);
        dunes_free(dunes);
    }
    assert_true(speed[0] > 0.0 && speed[1] > 0.0 && height[1] > 1.25 * height[0]);
    double ratio = speed[0] * height[0] / (speed[1] * height[1]);
    if (!(ratio > 0.7 && ratio < 1.4)) {
        fail_msg("speed x height: ratio %g", ratio);
    }
}

// ---- crests

// Ridges with slopes of 0.2 and 0.6 whose crests run at an angle to the grid, each moved aside by
// `wobble` cells.
static double ridge(double x, double z, double wobble)
{
    double across = 0.28 * x - 0.96 * z,
           off = across - 128.0 * floor(across / 128.0) - 64.0 + wobble;
    return 60.0 + (off < 0.0 ? 0.2 * off : -0.6 * off);
}

static void straight_crests_lose_the_steps_of_the_grid(void **state)
{
    (void)state;
    enum { SIDE = 256, NEAR = 24 };
    Run run = run_with(1);
    Dunes *dunes = dunes_new(SIDE, SIDE, NULL), *exact = dunes_new(SIDE, SIDE, NULL);
    double before = 0.0, after = 0.0, profile = 0.0;
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        double x = (double)(i % SIDE), z = (double)(i / SIDE);
        double wobble = 0.4 * sin(TURN * (0.96 * x + 0.28 * z) / 5.0);
        dunes->sand[i] = ridge(x, z, wobble);
        exact->sand[i] = ridge(x, z, 0.0);
    }
    double volume = dunes_volume(dunes);
    double *wobbly = malloc(sizeof(double) * (size_t)dunes_count(dunes));
    memcpy(wobbly, dunes->sand, sizeof(double) * (size_t)dunes_count(dunes));
    assert_true(dunes_straighten(dunes, &run, NULL));
    assert_true(fabs(dunes_volume(dunes) - volume) < 1e-9 * volume);
    for (int z = 128 - NEAR; z < 128 + NEAR;
         z++) { // away from the seam, where the ridge breaks off
        for (int x = 128 - NEAR; x < 128 + NEAR; x++) {
            int64_t i = (int64_t)z * SIDE + x;
            before += (wobbly[i] - exact->sand[i]) * (wobbly[i] - exact->sand[i]);
            after += (dunes->sand[i] - exact->sand[i]) * (dunes->sand[i] - exact->sand[i]);
            profile = fmax(profile, fabs(dunes->sand[i] - exact->sand[i]));
        }
    }
    if (!(after < 0.1 * before && profile < 0.2)) { // the brink stays sharp to a fifth of a cell
        fail_msg("error %g of %g, %g m at most", after, before, profile);
    }
    free(wobbly);
    dunes_free(dunes);
    dunes_free(exact);
}

// ---- the form

static HeightField *heights(uint64_t seed, DuneKind kind, int threads, MeasureList *list)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_DUNES;
    params.size = 640.0f;
    params.resolution = 128;
    params.dunes.kind = kind;
    params.dunes.spacing = 390.0f; // on 64 cells
    params.dunes.wind = 250.0f;
    return make_heights(&params, seed, threads, list, NULL);
}

static void dunes_have_natural_slopes(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2; seed++) {
        MeasureList list = {0};
        height_field_free(heights(seed, DUNE_TRANSVERSE, 1, &list));
        double slip = measured(&list, "slip_slope"), windward = measured(&list, "windward_slope");
        double height = measured(&list, "dune_height"), length = measured(&list, "dune_length");
        assert_true(slip > 32.0 && slip < 34.5);
        if (!(windward > 7.0 && windward < 15.0)) {
            fail_msg("windward slope %g degrees", windward);
        }
        assert_true(height / length > 0.05 && height / length < 0.16);
        measures_clear(&list);
    }
}

static void the_same_bits_for_any_threads(void **state)
{
    (void)state;
    HeightField *one = heights(4, DUNE_STAR, 1, NULL), *four = heights(4, DUNE_STAR, 4, NULL);
    assert_true(height_field_hash(one) == height_field_hash(four));
    int side = one->columns;
    for (int n = 0; n < side; n++) { // and the rims meet
        assert_true(one->height[n] == one->height[(int64_t)(side - 1) * side + n]);
        assert_true(one->height[n * side] == one->height[n * side + side - 1]);
    }
    HeightMeshParams params = {.error = 0.01f};
    Mesh *mesh = height_mesh_new(one, &params, NULL);
    Vec3 first = vec3(0, 0, 0);
    for (int64_t i = 0; i < mesh->vertex_count; i++) { // all four corners are one place
        Vec3 p = mesh->position[i];
        if (fabsf(fabsf(p.x) - 320.0f) < 0.1f && fabsf(fabsf(p.z) - 320.0f) < 0.1f) {
            first = first.y > 0.0f ? first : mesh->normal[i];
            assert_true(vec3_distance(mesh->normal[i], first) < 1e-3f);
        }
    }
    mesh_free(mesh);
    height_field_free(one);
    height_field_free(four);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shear_over_waves_has_its_closed_form),
        cmocka_unit_test(volume_stays_and_threads_do_not_matter),
        cmocka_unit_test(the_square_has_no_seam),
        cmocka_unit_test(barchans_move_downwind_the_slower_the_higher),
        cmocka_unit_test(straight_crests_lose_the_steps_of_the_grid),
        cmocka_unit_test(dunes_have_natural_slopes),
        cmocka_unit_test(the_same_bits_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
