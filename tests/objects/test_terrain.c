#include "base/random.h"
#include "image/image.h"
#include "land/height_drainage.h"
#include "land/height_maps.h"
#include "land/height_measure.h"
#include "making.h"
#include "objects/terrain/envelope.h"
#include "objects/terrain/noise.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static TerrainParams small_terrain(void)
{
    TerrainParams params = terrain_params_default();
    params.resolution = 128;
    params.rivers.count = 900;
    return params;
}

static OutTree *grow(const TerrainParams *params, uint64_t seed, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *tree = grow_kind(&kind_terrain, params,
                              &(Recipe){.seed = seed, .label = "land", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

// What follows from the rivers of a grown terrain.
static Grown grown_terrain(const TerrainParams *params, const OutTree *tree, const Recipe *recipe)
{
    Grown grown = {.tree = out_tree_copy(tree, NULL)};
    Error e = {0};
    if (!terrain_finish(params, recipe, NULL, &grown, &e)) {
        fail_msg("%s", e.message);
    }
    return grown;
}

static HeightField *heights(const TerrainParams *params, const OutTree *tree, uint64_t seed,
                            int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Grown grown =
        grown_terrain(params, tree, &(Recipe){.seed = seed, .label = "land", .run = &run});
    HeightField *field = terrain_heights(params, &grown, &run, &e);
    grown_clear(&grown);
    if (!field) {
        fail_msg("%s", e.message);
    }
    return field;
}

// ---- noise

static void noise_has_mean_0_and_variance_1(void **state)
{
    (void)state;
    double sum = 0.0, squares = 0.0;
    enum { SAMPLES = 60000 };
    for (int i = 0; i < SAMPLES; i++) { // far apart: independent
        float x = 3.37f * (float)(i % 250) - 300.0f, y = 3.11f * (float)(i / 250) - 200.0f;
        double n = (double)sparse_noise(x, y, 5);
        sum += n;
        squares += n * n;
    }
    assert_true(fabs(sum / SAMPLES) < 0.02);
    assert_true(fabs(squares / SAMPLES - 1.0) < 0.04);
}

// Power at a frequency, by the Fourier sum along lines.
static double power_at(double frequency)
{
    enum { LINES = 60, LENGTH = 32, STEPS = 8 };
    double power = 0.0;
    for (int line = 0; line < LINES; line++) {
        double re = 0.0, im = 0.0;
        for (int i = 0; i < LENGTH * STEPS; i++) {
            double x = (double)i / STEPS;
            double window = 0.5 - 0.5 * cos(6.283185307 * x / LENGTH);
            double n = window * (double)sparse_noise((float)x, 7.3f * (float)line, 8);
            re += n * cos(6.283185307 * frequency * x);
            im += n * sin(6.283185307 * frequency * x);
        }
        power += re * re + im * im;
    }
    return power;
}

static void noise_keeps_to_its_band(void **state)
{
    (void)state;
    double inside = power_at(0.75);
    assert_true(power_at(2.2) < 0.02 * inside);
    assert_true(power_at(3.5) < 0.002 * inside);
}

// At places close together, on a way back, and far apart, about 0 and below it.
static void many_places_at_once_have_the_same_bits(void **state)
{
    (void)state;
    enum { COUNT = 300 };
    for (int line = 0; line < 40; line++) {
        float step = line % 4 == 0 ? 0.013f : line % 4 == 1 ? -0.21f : line % 4 == 2 ? 0.9f : 7.7f;
        float x[COUNT], y[COUNT], sum[COUNT], want[COUNT];
        for (int i = 0; i < COUNT; i++) {
            x[i] = -3.0f + step * (float)i;
            y[i] = 2.1f * (float)(line - 20) + 0.3f * step * (float)(i % 50);
            want[i] = sparse_noise_fractal(x[i], y[i], 7, 0.62f, 0.1f * (float)(line % 3), 9);
        }
        sparse_noise_fractal_along(x, y, COUNT, 7, 0.62f, 0.1f * (float)(line % 3), 9, sum);
        assert_memory_equal(sum, want, sizeof want);
    }
}

static void kernels_are_poisson_distributed(void **state)
{
    (void)state;
    double sum = 0.0, squares = 0.0;
    int none = 0;
    enum { CELLS = 40000 };
    for (int i = 0; i < CELLS; i++) {
        double n = sparse_noise_count(random_key(77, (uint64_t)i));
        sum += n;
        squares += n * n;
        none += n == 0.0;
    }
    double mean = sum / CELLS, variance = squares / CELLS - mean * mean;
    assert_true(fabs(mean - (double)SPARSE_NOISE_DENSITY) < 0.04);
    assert_true(fabs(variance - (double)SPARSE_NOISE_DENSITY) < 0.1);
    assert_true(fabs((double)none / CELLS - exp(-(double)SPARSE_NOISE_DENSITY)) < 0.004);
}

// ---- the envelope

static Trough random_trough(uint64_t key)
{
    float angle = random_range(random_key(key, 3), 0.0f, 6.28f);
    return (Trough){.x = random_range(random_key(key, 1), -50.0f, 50.0f),
                    .z = random_range(random_key(key, 2), -50.0f, 50.0f),
                    .dx = cosf(angle),
                    .dz = sinf(angle),
                    .length = random_range(random_key(key, 4), 0.0f, 20.0f),
                    .h0 = random_range(random_key(key, 5), 0.0f, 8.0f),
                    .slope = random_range(random_key(key, 6), 0.0f, 0.45f),
                    .gradient = random_range(random_key(key, 7), 0.5f, 1.5f),
                    .width = random_range(random_key(key, 8), 0.0f, 5.0f)};
}

static void a_trough_is_the_least_over_its_river(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 300; k++) {
        Trough t = random_trough(random_key(1, k));
        float x = random_range(random_key(k, 11), -60.0f, 60.0f);
        float z = random_range(random_key(k, 12), -60.0f, 60.0f);
        float least = 1e30f;
        for (int i = 0; i <= 4000; i++) { // every point of the river carries its own trough
            float s = t.length * (float)i / 4000.0f;
            float dx = x - t.x - s * t.dx, dz = z - t.z - s * t.dz;
            float h = t.h0 + t.slope * s +
                      t.gradient * sqrtf(dx * dx + dz * dz + t.width * t.width) -
                      t.width * sqrtf(t.gradient * t.gradient - t.slope * t.slope);
            least = h < least ? h : least;
        }
        assert_true(fabsf(trough_height(&t, x, z) - least) < 2e-3f);
    }
}

static void the_envelope_is_that_of_brute_force(void **state)
{
    (void)state;
    enum { COUNT = 400 };
    Trough trough[COUNT];
    for (uint64_t k = 0; k < COUNT; k++) {
        trough[k] = random_trough(random_key(2, k));
    }
    Error e = {0};
    for (int threads = 1; threads <= 3; threads++) {
        Run run = run_default();
        run.threads = threads;
        TroughEnvelope *envelope = trough_envelope_new(trough, COUNT, 100.0f, 4.0f, &run, &e);
        assert_non_null(envelope);
        for (uint64_t k = 0; k < 3000; k++) {
            float x = random_range(random_key(k, 21), -53.9f, 53.9f);
            float z = random_range(random_key(k, 22), -53.9f, 53.9f);
            int32_t lowest = -1, expected = -1;
            float best = 1e30f;
            for (int i = 0; i < COUNT; i++) {
                float h = trough_height(&trough[i], x, z);
                if (h < best) {
                    best = h;
                    expected = i;
                }
            }
            assert_true(trough_envelope_at(envelope, x, z, &lowest) == best);
            assert_true(trough_height(&trough[lowest], x, z) == best);
            assert_true(lowest == expected || trough_height(&trough[expected], x, z) == best);
        }
        trough_envelope_free(envelope);
    }
}

// ---- rivers

static void rivers_fall_to_outlets_on_the_border(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    OutTree *tree = grow(&params, 3, 1);
    Error e = {0};
    assert_true(out_tree_check(tree, &e));
    int roots = 0;
    float half = 0.5f * params.size;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        int32_t parent = tree->parent[i];
        if (parent < 0) {
            roots++;
            float reach = fabsf(p.x) > fabsf(p.z) ? fabsf(p.x) : fabsf(p.z);
            assert_true(fabsf(reach - half) < 1.0f && p.y == 0.0f);
            continue;
        }
        assert_true(p.y > tree->position[parent].y);
        assert_true(tree->radius[parent] > tree->radius[i]); // water only gathers
    }
    assert_int_equal(roots, params.rivers.outlets);
    // All land drains to some outlet.
    double area = 0.0, scale = (double)params.rivers.water * (double)params.rivers.water;
    for (int64_t i = 0; i < tree->count; i++) {
        area += tree->parent[i] < 0 ? (double)tree->radius[i] * (double)tree->radius[i] / scale : 0;
    }
    assert_true(fabs(area / ((double)params.size * (double)params.size) - 1.0) < 1e-3);
    out_tree_free(tree);
}

static void the_same_bits_for_any_threads(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.erosion.streams = 0.5f;
    params.erosion.thermal = 0.5f;
    params.terraces = (TerrainTerraceParams){12, 0.8f, 0.0f};
    OutTree *tree = grow(&params, 6, 1), *two = grow(&params, 6, 2), *three = grow(&params, 6, 3);
    assert_true(out_tree_hash(tree) == out_tree_hash(two));
    assert_true(out_tree_hash(tree) == out_tree_hash(three));
    HeightField *a = heights(&params, tree, 6, 1), *b = heights(&params, two, 6, 2);
    HeightField *c = heights(&params, three, 6, 3), *other = heights(&params, tree, 7, 2);
    assert_true(height_field_hash(a) == height_field_hash(b));
    assert_true(height_field_hash(a) == height_field_hash(c));
    assert_true(height_field_hash(a) != height_field_hash(other));
    HeightField *fields[4] = {a, b, c, other};
    OutTree *trees[3] = {tree, two, three};
    for (int i = 0; i < 4; i++) {
        height_field_free(fields[i]);
    }
    for (int i = 0; i < 3; i++) {
        out_tree_free(trees[i]);
    }
}

// ---- heights

// Every sample that a river runs through has a way to the rim that never climbs, and no sample is a
// pit, whatever is laid over the land.
static void every_river_drains_and_nothing_is_a_pit(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        TerrainParams params = small_terrain();
        params.noise.iterations = k == 0 ? 0 : 6;
        params.noise.amplitude = k == 1 ? 0.5f : params.noise.amplitude;
        params.erosion.streams = k >= 2 ? 1.0f : 0.0f;
        params.erosion.thermal = k >= 2 ? 1.0f : 0.0f;
        params.terraces.count = k == 3 ? 9 : 0;
        params.terraces.strength = 1.0f;
        OutTree *tree = grow(&params, 8, 1);
        HeightField *field = heights(&params, tree, 8, 1);
        Error e = {0};
        MeasureList list = {0};
        assert_true(height_field_measure(field, 0.0, &list, &e));
        assert_true(measures_find(&list, "pits")->value == 0.0);
        assert_true(measures_find(&list, "rivers_that_drain")->value == 1.0);
        measures_clear(&list);
        height_field_free(field);
        out_tree_free(tree);
    }
}

// Rivers lie in the land: at every node the land is at the river's height, and higher to both
// sides. None hangs above a valley or runs along a ridge.
static void no_river_hangs_or_runs_on_a_ridge(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.resolution = 512;
    params.rivers.water = 1e-6f; // no bed
    OutTree *tree = grow(&params, 4, 1);
    HeightField *field = heights(&params, tree, 4, 1);
    int64_t nodes = 0, off = 0, ridge = 0;
    float cell = field->cell.x, half = 0.5f * params.size, steep = 0.65f * 1.8f;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        if (tree->parent[i] < 0 || fabsf(p.x) > 0.95f * half || fabsf(p.z) > 0.95f * half) {
            continue;
        }
        Vec3 q = tree->position[tree->parent[i]];
        float along = sqrtf((p.x - q.x) * (p.x - q.x) + (p.z - q.z) * (p.z - q.z));
        float ax = (p.z - q.z) / along, az = (q.x - p.x) / along, reach = 4.0f * cell;
        float here = height_field_at(field, p.x, p.z);
        float left = height_field_at(field, p.x + reach * ax, p.z + reach * az);
        float right = height_field_at(field, p.x - reach * ax, p.z - reach * az);
        nodes++;
        off += fabsf(here - p.y) > 1.5f * steep * cell;
        ridge += here > left + 0.1f * cell && here > right + 0.1f * cell;
    }
    assert_true(nodes > 500);
    assert_true(off <= nodes / 50);
    assert_true(ridge <= nodes / 500); // a tip whose gully is narrower than the cells
    height_field_free(field);
    out_tree_free(tree);
}

// The same land at twice and four times the resolution: where samples coincide heights agree.
static void more_resolution_shows_the_same_land(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    OutTree *tree = grow(&params, 2, 1);
    HeightField *coarse = heights(&params, tree, 2, 1);
    params.resolution = 512;
    HeightField *fine = heights(&params, tree, 2, 1);
    float low, high;
    height_field_range(fine, &low, &high);
    double squares = 0.0;
    int64_t differing = 0, count = height_field_count(coarse);
    for (int64_t i = 0; i < count; i++) {
        int64_t column = i % 129, row = i / 129;
        float d = coarse->height[i] - fine->height[4 * row * 513 + 4 * column];
        squares += (double)(d * d);
        differing += fabsf(d) > 1e-4f * (high - low);
    }
    // Only where a river's line crosses a coarse sample, or a hollow was filled.
    assert_true(sqrt(squares / (double)count) < 0.01 * (double)(high - low));
    assert_true(differing < count / 4);
    height_field_free(coarse);
    height_field_free(fine);
    out_tree_free(tree);
}

// A terrain of ten times the size is the same one, ten times as large.
static void it_grows_with_its_size(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    OutTree *small = grow(&params, 5, 1);
    params.size *= 16.0f; // a power of two: the same digits
    OutTree *large = grow(&params, 5, 1);
    assert_int_equal(small->count, large->count);
    float most = 0.0f;
    for (int64_t i = 0; i < small->count; i++) {
        float d = vec3_distance(vec3_scale(small->position[i], 16.0f), large->position[i]);
        most = d > most ? d : most;
    }
    assert_true(most < 1e-3f * params.size);
    out_tree_free(small);
    out_tree_free(large);
}

static void relief_is_what_was_asked(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.relief = 1500.0f;
    params.noise.iterations = 0;
    OutTree *tree = grow(&params, 5, 1);
    HeightField *field = heights(&params, tree, 5, 1);
    float low, high;
    height_field_range(field, &low, &high);
    assert_true(fabsf(high - 1500.0f) < 40.0f && low > -20.0f);
    height_field_free(field);
    out_tree_free(tree);
}

static void painted_uplift_makes_the_mountains(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    UpliftStroke stroke = {{0.2f, 0.2f}, {0.2f, 0.2f}, 0.25f, 4.0f};
    params.uplift = (UpliftParams){.base = 1.0f, .strokes = &stroke, .stroke_count = 1};
    OutTree *tree = grow(&params, 5, 1);
    HeightField *field = heights(&params, tree, 5, 1);
    int best = 0;
    for (int i = 0; i < 129 * 129; i++) {
        best = field->height[i] > field->height[best] ? i : best;
    }
    float x = (float)(best % 129) / 128.0f - 0.5f, z = (float)(best / 129) / 128.0f - 0.5f;
    assert_true(sqrtf((x - 0.2f) * (x - 0.2f) + (z - 0.2f) * (z - 0.2f)) < 0.2f);
    height_field_free(field);
    out_tree_free(tree);
}

// A picture that is bright in the north-west quarter only: there stands the land; and its rows run
// from the north, its columns from the west.
static void an_uplift_picture_makes_the_mountains(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    char file[] = "/tmp/ramify_test_uplift.png";
    float pixels[6] = {1.0f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f};
    Error e = {0};
    const Image image = {.width = 3, .height = 2, .channels = 1, .pixel = pixels};
    assert_true(image_write_grey16(file, &image, NULL, &e));
    params.uplift = (UpliftParams){.base = 1.0f, .image = file};
    OutTree *tree = grow(&params, 5, 1);
    HeightField *field = heights(&params, tree, 5, 1);
    unlink(file);
    double sum[4] = {0};
    for (int i = 0; i < 129 * 129; i++) {
        sum[(i / 129 > 64) * 2 + (i % 129 > 64)] += (double)field->height[i];
    }
    for (int quarter = 1; quarter < 4; quarter++) {
        assert_true(sum[0] > 1.5 * sum[quarter]);
    }
    height_field_free(field);
    out_tree_free(tree);
}

// Over some seeds Hack's exponent lies on average where nature's does, give or take the scatter of
// a mean of four; and so does the hypsometric integral.
static void basins_are_those_of_nature(void **state)
{
    (void)state;
    enum { SEEDS = 4 };
    double hack = 0.0, integral = 0.0;
    for (uint64_t seed = 11; seed < 11 + SEEDS; seed++) {
        TerrainParams params = terrain_params_default();
        params.resolution = 256;
        OutTree *tree = grow(&params, seed, 1);
        HeightField *field = heights(&params, tree, seed, 1);
        Error e = {0};
        MeasureList list = {0};
        assert_true(height_field_measure(field, 0.0, &list, &e));
        double h = measures_find(&list, "hack_exponent")->value;
        double i = measures_find(&list, "hypsometric_integral")->value;
        if (!(h > 0.51 && h < 0.64 && i > 0.3 && i < 0.6)) {
            fail_msg("seed %d: Hack %g, hypsometric integral %g", (int)seed, h, i);
        }
        hack += h / SEEDS;
        integral += i / SEEDS;
        measures_clear(&list);
        height_field_free(field);
        out_tree_free(tree);
    }
    if (!(hack > 0.545 && hack < 0.605 && integral > 0.35 && integral < 0.6)) {
        fail_msg("Hack %g, hypsometric integral %g", hack, integral);
    }
}

// Horton's ratios and the concavity of grown land lie where those of nature do.
static void measures_are_those_of_nature(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    params.resolution = 256;
    OutTree *tree = grow(&params, 1, 1);
    HeightField *field = heights(&params, tree, 1, 1);
    Error e = {0};
    MeasureList list = {0};
    assert_true(height_field_measure(field, 0.0, &list, &e));
    const char *const names[] = {"horton_bifurcation_ratio", "horton_length_ratio",
                                 "horton_area_ratio", "concavity", "hypsometric_integral"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const Measure *m = measures_find(&list, names[i]);
        if (!(m->value >= m->low && m->value <= m->high)) {
            fail_msg("%s is %g", names[i], m->value);
        }
    }
    measures_clear(&list);
    height_field_free(field);
    out_tree_free(tree);
}

// Sums of heights of two lands, and of what the first records.
static void erosion_records_what_it_moves(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.form = TERRAIN_NOISE;
    params.noise.iterations = 6;
    OutTree *tree = grow(&params, 5, 1);
    HeightField *before = heights(&params, tree, 5, 1);
    assert_null(before->change);
    params.erosion = (TerrainErosionParams){.streams = 1.0f, .thermal = 2.0f, .talus = 20.0f};
    HeightField *after = heights(&params, tree, 5, 1);
    Run run = run_default();
    HeightField *deposit = height_map(after, &(HeightMap){.kind = HEIGHT_MAP_DEPOSIT}, &run, NULL);
    HeightField *wear = height_map(after, &(HeightMap){.kind = HEIGHT_MAP_WEAR}, &run, NULL);
    double moved = 0.0, recorded = 0.0, all = 0.0;
    for (int64_t i = 0; i < height_field_count(after); i++) {
        moved += (double)after->height[i] - (double)before->height[i];
        recorded += (double)deposit->height[i] - (double)wear->height[i];
        all += (double)deposit->height[i] + (double)wear->height[i];
    }
    double mean = all / (double)height_field_count(after);
    assert_true(mean > 1.0); // m: else there is nothing to record
    assert_true(fabs(moved - recorded) < 1e-6 * all);
    HeightField *fields[4] = {before, after, deposit, wear};
    for (int i = 0; i < 4; i++) {
        height_field_free(fields[i]);
    }
    out_tree_free(tree);
}

// What the rivers have left of a plateau, and the rubble on it.
static void a_canyon_records_what_has_gone(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.form = TERRAIN_CANYON;
    params.size = 3000.0f;
    params.relief = 300.0f;
    OutTree *tree = grow(&params, 5, 1);
    HeightField *field = heights(&params, tree, 5, 1);
    Run run = run_default();
    HeightField *deposit = height_map(field, &(HeightMap){.kind = HEIGHT_MAP_DEPOSIT}, &run, NULL);
    HeightField *wear = height_map(field, &(HeightMap){.kind = HEIGHT_MAP_WEAR}, &run, NULL);
    HeightField *bedrock = height_map(field, &(HeightMap){.kind = HEIGHT_MAP_BEDROCK}, &run, NULL);
    float deepest = 0.0f;
    int bare = 0, covered = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        assert_true(deposit->height[i] >= 0.0f && wear->height[i] > -1e-3f);
        deepest = fmaxf(deepest, wear->height[i]);
        bare += bedrock->height[i] == 1.0f;
        covered += bedrock->height[i] == 0.0f;
        assert_true(bedrock->height[i] > 0.0f || deposit->height[i] >= 0.5f);
    }
    assert_true(deepest > 270.0f && deepest < 360.0f);
    assert_true(bare > 0 && covered > 0);
    HeightField *fields[4] = {field, deposit, wear, bedrock};
    for (int i = 0; i < 4; i++) {
        height_field_free(fields[i]);
    }
    out_tree_free(tree);
}

static void erosion_lowers_what_is_too_steep(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.relief = 1000.0f;
    OutTree *tree = grow(&params, 5, 1);
    HeightField *before = heights(&params, tree, 5, 1);
    params.erosion = (TerrainErosionParams){.thermal = 3.0f, .talus = 30.0f};
    HeightField *after = heights(&params, tree, 5, 1);
    int steep[2] = {0, 0};
    HeightField *fields[2] = {before, after};
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 129 * 128; i++) {
            if (i % 129 != 128) {
                float drop = fabsf(fields[k]->height[i + 1] - fields[k]->height[i]);
                steep[k] += drop > 0.65f * fields[k]->cell.x; // 33 degrees
            }
        }
    }
    assert_true(steep[1] < steep[0] * 3 / 4);
    height_field_free(before);
    height_field_free(after);
    out_tree_free(tree);
}

static void land_water_and_forest_become_parts(void **state)
{
    (void)state;
    TerrainParams params = small_terrain();
    params.water_level = 0.1f;
    params.rivers.water = 0.02f;
    params.forest.count = 800;
    params.position = vec3(100.0f, 50.0f, -30.0f);
    OutTree *tree = grow(&params, 5, 1);
    Geometry geometry = {0};
    Error e = {0};
    Run run = run_default();
    Vec3 eye = {0.0f, 600.0f, 0.0f};
    Recipe recipe = {.seed = 5, .label = "land", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    placing.material++; // from 1 on
    placing.around.eye = &eye;
    Grown grown = grown_terrain(&params, tree, &recipe);
    assert_true(terrain_geometry(&params, &grown, &placing, &e));
    grown_clear(&grown);
    int64_t trees = 0, parts[4] = {0};
    for (int64_t i = 0; i < geometry.count; i++) {
        const Part *part = &geometry.part[i];
        assert_in_range(part->material, 1, 3);
        parts[part->material]++;
        trees += part->instance_count;
        Aabb box = mesh_bounds(part->mesh);
        assert_true(part->material == 3 || box.low.x > 100.0f - 0.51f * params.size);
    }
    assert_int_equal(parts[1], 1);
    assert_int_equal(parts[2], 2); // the lake and the rivers
    assert_true(trees > 50 && trees <= 800);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

// ---- water

// Triangles of a land mesh by the square of a grid over the plane that they touch.
typedef struct LandIndex {
    const Mesh *mesh;
    Aabb box;
    int32_t *first, *next; // next: of entries
    int32_t *triangle;
    int64_t count, capacity;
} LandIndex;

enum { INDEX_SIDE = 128 };

static int index_cell(float x, float low, float high)
{
    int i = (int)((x - low) / (high - low) * INDEX_SIDE);
    return i < 0 ? 0 : i >= INDEX_SIDE ? INDEX_SIDE - 1 : i;
}

static LandIndex index_land(const Mesh *mesh)
{
    LandIndex land = {.mesh = mesh, .box = mesh_bounds(mesh)};
    land.first = malloc(sizeof(int32_t) * INDEX_SIDE * INDEX_SIDE);
    memset(land.first, 0xff, sizeof(int32_t) * INDEX_SIDE * INDEX_SIDE);
    for (int64_t t = 0; t < mesh->face_count; t++) {
        Aabb box = {mesh->position[mesh->index[3 * t]], mesh->position[mesh->index[3 * t]]};
        for (int k = 1; k < 3; k++) {
            Vec3 p = mesh->position[mesh->index[3 * t + k]];
            box.low = vec3_min(box.low, p);
            box.high = vec3_max(box.high, p);
        }
        int c0 = index_cell(box.low.x, land.box.low.x, land.box.high.x);
        int c1 = index_cell(box.high.x, land.box.low.x, land.box.high.x);
        int r0 = index_cell(box.low.z, land.box.low.z, land.box.high.z);
        int r1 = index_cell(box.high.z, land.box.low.z, land.box.high.z);
        for (int r = r0; r <= r1; r++) {
            for (int c = c0; c <= c1; c++) {
                if (land.count == land.capacity) {
                    land.capacity = 2 * land.capacity + 1024;
                    size_t bytes = sizeof(int32_t) * (size_t)land.capacity;
                    land.next = realloc(land.next, bytes);
                    land.triangle = realloc(land.triangle, bytes);
                }
                land.triangle[land.count] = (int32_t)t;
                land.next[land.count] = land.first[r * INDEX_SIDE + c];
                land.first[r * INDEX_SIDE + c] = (int32_t)land.count++;
            }
        }
    }
    return land;
}

static void free_index(LandIndex *land)
{
    free(land->first);
    free(land->next);
    free(land->triangle);
}

// Height of the land's mesh under a place.
static float land_under(const LandIndex *land, Vec3 p)
{
    int c = index_cell(p.x, land->box.low.x, land->box.high.x);
    int r = index_cell(p.z, land->box.low.z, land->box.high.z);
    for (int32_t i = land->first[r * INDEX_SIDE + c]; i >= 0; i = land->next[i]) {
        const uint32_t *corner = land->mesh->index + (int64_t)3 * land->triangle[i];
        Vec3 a = land->mesh->position[corner[0]], b = land->mesh->position[corner[1]],
             d = land->mesh->position[corner[2]];
        float area = (b.x - a.x) * (d.z - a.z) - (b.z - a.z) * (d.x - a.x);
        float u = ((p.x - a.x) * (d.z - a.z) - (p.z - a.z) * (d.x - a.x)) / area;
        float v = ((b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x)) / area;
        if (u >= -1e-4f && v >= -1e-4f && u + v <= 1.0002f) {
            return a.y + u * (b.y - a.y) + v * (d.y - a.y);
        }
    }
    fail_msg("no land under (%g, %g)", (double)p.x, (double)p.z);
    return 0.0f;
}

// Half the width of the widest river whose water a place lies in or within a cell of.
static float width_near(const OutTree *tree, Vec3 p, float cell)
{
    float widest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 b = tree->position[i], a = tree->parent[i] < 0 ? b : tree->position[tree->parent[i]];
        float lower = tree->parent[i] < 0 ? tree->radius[i] : tree->radius[tree->parent[i]];
        float dx = b.x - a.x, dz = b.z - a.z, squared = dx * dx + dz * dz;
        if (fabsf(p.x - b.x) > fabsf(dx) + lower + cell) {
            continue;
        }
        float t = squared > 0.0f ? ((p.x - a.x) * dx + (p.z - a.z) * dz) / squared : 0.0f;
        t = clampf(t, 0.0f, 1.0f);
        float away = hypotf(p.x - a.x - t * dx, p.z - a.z - t * dz);
        float width = lerpf(lower, tree->radius[i], t);
        widest = away < width + cell && width > widest ? width : widest;
    }
    return widest;
}

typedef struct WaterCase {
    int resolution;
    float water, sea, relief, thermal, streams, terraces;
    int octaves;
    bool eye;
} WaterCase;

static const WaterCase WATER_CASES[] = {
    {128, 0.02f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 6, false},
    {256, 0.01f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 6, true},
    {256, 0.01f, 0.0f, 650.0f, 1.0f, 1.0f, 0.0f, 6, true},
    {128, 0.02f, 0.1f, 2000.0f, 1.0f, 1.0f, 0.9f, 0, false},
    {512, 0.005f, 0.1f, 2000.0f, 1.0f, 1.0f, 1.0f, 6, true},
    {256, 0.03f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0, true}, // as wide as its valley, on flat land
};

static Geometry water_scene(const WaterCase *c, OutTree **tree)
{
    TerrainParams params = small_terrain();
    params.resolution = c->resolution;
    params.rivers.water = c->water;
    params.water_level = c->sea;
    params.relief = c->relief;
    params.noise.iterations = c->octaves;
    params.erosion.thermal = c->thermal;
    params.erosion.streams = c->streams;
    params.terraces = (TerrainTerraceParams){c->terraces > 0.0f ? 8 : 0, c->terraces, 0.0f};
    *tree = grow(&params, 4, 1);
    Geometry geometry = {0};
    Error e = {0};
    Run run = run_default();
    run.threads = 1;
    Vec3 eye = {0.0f, 2500.0f, 9000.0f};
    Recipe recipe = {.seed = 4, .label = "land", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    placing.material++; // from 1 on
    placing.around.eye = c->eye ? &eye : NULL;
    Grown grown = grown_terrain(&params, *tree, &recipe);
    assert_true(terrain_geometry(&params, &grown, &placing, &e));
    grown_clear(&grown);
    assert_int_equal(geometry.count, c->sea > 0.0f ? 3 : 2);
    return geometry;
}

// Does face i of a mesh of quads look down? Those cut off at the border have no area.
static bool looks_down(const Mesh *mesh, int64_t i)
{
    const uint32_t *corner = mesh->index + 4 * i;
    Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]];
    Vec3 c = mesh->position[corner[2]], d = mesh->position[corner[3]];
    return vec3_cross(vec3_sub(c, a), vec3_sub(d, b)).y < -1.0f;
}

static Vec3 quad_middle(const Mesh *mesh, int64_t i)
{
    Vec3 p = vec3_splat(0.0f);
    for (int64_t j = 0; j < 4; j++) {
        p = vec3_madd(p, 0.25f, mesh->position[mesh->index[4 * i + j]]);
    }
    return p;
}

// The water of a river is nowhere higher over the land than its bed is deep, nor under it, on the
// land as it is drawn, whatever erosion, terraces and noise made of it.
static void rivers_lie_in_their_beds(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof WATER_CASES / sizeof WATER_CASES[0]; k++) {
        OutTree *tree;
        Geometry geometry = water_scene(&WATER_CASES[k], &tree);
        LandIndex land = index_land(geometry.part[0].mesh);
        const Mesh *water = geometry.part[geometry.count - 1].mesh;
        float cell = 12000.0f / (float)WATER_CASES[k].resolution;
        assert_true(water->vertex_count > 1000);
        for (int64_t i = 0; i < water->vertex_count; i++) {
            Vec3 p = water->position[i];
            float over = p.y - land_under(&land, p), width = width_near(tree, p, cell);
            if (!(over < 0.32f * width && over > -0.04f * width)) {
                fail_msg("case %d: %g m over the land in a river of half width %g", (int)k,
                         (double)over, (double)width);
            }
        }
        int64_t under = 0, down = 0;
        for (int64_t i = 0; i < water->face_count; i++) {
            Vec3 p = quad_middle(water, i);
            under += p.y < land_under(&land, p) - 0.05f * width_near(tree, p, cell);
            down += looks_down(water, i);
        }
        assert_true(under <= water->face_count / 400); // in cascades: no gaps elsewhere
        assert_int_equal(down, 0);
        free_index(&land);
        geometry_clear(&geometry);
        out_tree_free(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise_has_mean_0_and_variance_1),
        cmocka_unit_test(noise_keeps_to_its_band),
        cmocka_unit_test(many_places_at_once_have_the_same_bits),
        cmocka_unit_test(kernels_are_poisson_distributed),
        cmocka_unit_test(a_trough_is_the_least_over_its_river),
        cmocka_unit_test(the_envelope_is_that_of_brute_force),
        cmocka_unit_test(rivers_fall_to_outlets_on_the_border),
        cmocka_unit_test(the_same_bits_for_any_threads),
        cmocka_unit_test(every_river_drains_and_nothing_is_a_pit),
        cmocka_unit_test(no_river_hangs_or_runs_on_a_ridge),
        cmocka_unit_test(more_resolution_shows_the_same_land),
        cmocka_unit_test(it_grows_with_its_size),
        cmocka_unit_test(relief_is_what_was_asked),
        cmocka_unit_test(painted_uplift_makes_the_mountains),
        cmocka_unit_test(an_uplift_picture_makes_the_mountains),
        cmocka_unit_test(basins_are_those_of_nature),
        cmocka_unit_test(measures_are_those_of_nature),
        cmocka_unit_test(erosion_lowers_what_is_too_steep),
        cmocka_unit_test(erosion_records_what_it_moves),
        cmocka_unit_test(a_canyon_records_what_has_gone),
        cmocka_unit_test(land_water_and_forest_become_parts),
        cmocka_unit_test(rivers_lie_in_their_beds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
