// Land that a tree of ridges lifts, trees from files and pictures, and noise alone.
#include "base/random.h"
#include "image/image.h"
#include "image/tone_curve.h"
#include "land/height_measure.h"
#include "making.h"
#include "objects/terrain/lift.h"
#include "objects/terrain/terrain.h"
#include "outtree/out_tree_io.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// ---- making

static char swc_file[64], image_file[64];

static int name_files(void **state)
{
    (void)state;
    snprintf(swc_file, sizeof swc_file, "/tmp/ramify-ridges-%d.swc", (int)getpid());
    snprintf(image_file, sizeof image_file, "/tmp/ramify-ridges-%d.png", (int)getpid());
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    unlink(swc_file);
    unlink(image_file);
    return 0;
}

static TerrainParams plain_terrain(TerrainForm form)
{
    TerrainParams params = terrain_params_default();
    params.form = form;
    params.size = 1024.0f;
    params.relief = 100.0f;
    params.resolution = 128;
    params.rivers.count = 300;
    params.rivers.water = 0.0f;
    params.noise.iterations = 0;
    return params;
}

static Grown grow_threads(const TerrainParams *params, int threads, HeightField **field)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Recipe recipe = {.seed = 5, .label = "land", .run = &run};
    Grown grown;
    if (!kind_grow(&kind_terrain, params, &recipe, 1.0f, NULL, &grown, &e)) {
        fail_msg("%s", e.message);
    }
    *field = terrain_heights(params, &grown, &run, &e);
    if (!*field) {
        fail_msg("%s", e.message);
    }
    return grown;
}

static HeightField *land_of(const TerrainParams *params)
{
    HeightField *field;
    Grown grown = grow_threads(params, 1, &field);
    grown_clear(&grown);
    return field;
}

// The place of sample i.
static Vec2 place_of(const HeightField *field, int64_t i)
{
    int64_t row = i / field->columns;
    return (Vec2){field->origin.x + (float)(i % field->columns) * field->cell.x,
                  field->origin.y + (float)row * field->cell.y};
}

typedef struct Difference {
    double rms, most;
} Difference;

static Difference difference_of(const HeightField *a, const HeightField *b)
{
    Difference d = {0};
    assert_true(height_field_count(a) == height_field_count(b));
    for (int64_t i = 0; i < height_field_count(a); i++) {
        double off = fabs((double)(a->height[i] - b->height[i]));
        d.rms += off * off;
        d.most = off > d.most ? off : d.most;
    }
    d.rms = sqrt(d.rms / (double)height_field_count(a));
    return d;
}

// A tree drawn by hand: x, z and radius (m) of each node, and its parent.
typedef struct HandNode {
    float x, z, radius;
    int parent;
} HandNode;

static const HandNode HAND[] = {
    {-60.0f, 20.0f, 24.0f, -1}, {140.0f, -40.0f, 20.0f, 0},   {330.0f, 60.0f, 8.0f, 1},
    {210.0f, -260.0f, 8.0f, 1}, {-270.0f, 150.0f, 14.0f, 0},  {-380.0f, 330.0f, 6.0f, 4},
    {-400.0f, -40.0f, 6.0f, 4}, {-120.0f, -300.0f, 10.0f, 0},
};
enum { HAND_COUNT = sizeof HAND / sizeof HAND[0] };

static OutTree *hand_tree(const HandNode *node, int count)
{
    OutTree *tree = out_tree_new(NULL);
    for (int i = 0; i < count; i++) {
        out_tree_add_node(tree, vec3(node[i].x, 7.0f, node[i].z), node[i].parent, 0, 0, (uint64_t)i,
                          NULL);
        tree->radius[i] = node[i].radius;
    }
    return tree;
}

static void write_swc(const OutTree *tree)
{
    Error e = {0};
    if (!out_tree_write_swc(tree, swc_file, &e)) {
        fail_msg("%s", e.message);
    }
}

// Is the place within the line of some piece of the tree?
static bool is_painted(const OutTree *tree, float x, float z)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int64_t below = tree->parent[i] < 0 ? i : tree->parent[i];
        Vec3 a = tree->position[below], b = tree->position[i];
        float dx = b.x - a.x, dz = b.z - a.z, squared = dx * dx + dz * dz;
        float t = squared > 0.0f ? ((x - a.x) * dx + (z - a.z) * dz) / squared : 0.0f;
        t = clampf(t, 0.0f, 1.0f);
        float away = hypotf(x - a.x - t * dx, z - a.z - t * dz);
        if (away <= lerpf(tree->radius[below], tree->radius[i], t)) {
            return true;
        }
    }
    return false;
}

// Paints the tree's pieces, as wide as their radii, over a land of this size.
static void write_image(const OutTree *tree, float size, int side, bool invert)
{
    Error e = {0};
    Image *image = image_new(side, side, 1, &e);
    for (int i = 0; i < side * side; i++) {
        int row = i / side;
        float x = (((float)(i % side) + 0.5f) / (float)side - 0.5f) * size;
        float z = (((float)row + 0.5f) / (float)side - 0.5f) * size;
        image->pixel[i] = is_painted(tree, x, z) != invert ? 1.0f : 0.0f;
    }
    assert_true(image_write_grey16(image_file, image, NULL, &e));
    image_free(image);
}

// ---- the curve and its bands

static const LiftStop STOPS[] = {{0.0f, 1.0f}, {0.2f, 0.5f}, {0.5f, 0.3f}, {0.9f, 0.05f}};
enum { STOP_COUNT = sizeof STOPS / sizeof STOPS[0] };

static void a_lift_goes_through_its_points_and_falls_between_them(void **state)
{
    (void)state;
    LiftCurve curve = lift_curve(STOPS, STOP_COUNT);
    for (int i = 0; i < STOP_COUNT; i++) {
        assert_true(fabsf(lift_curve_at(&curve, STOPS[i].distance) - STOPS[i].height) < 1e-6f);
    }
    float last = lift_curve_at(&curve, 0.0f);
    for (int i = 1; i < 900; i++) {
        float h = lift_curve_at(&curve, (float)i * 0.001f);
        assert_true(h <= last && last - h < 0.006f); // no step
        last = h;
    }
    assert_true(lift_curve_at(&curve, 0.901f) == 0.0f);
    LiftCurve line = lift_curve((LiftStop[]){{0.0f, 1.0f}, {1.0f, 0.0f}}, 2);
    assert_true(fabsf(lift_curve_at(&line, 0.3f) - 0.7f) < 1e-6f);
}

static RidgeBand random_band(uint64_t key)
{
    float angle = random_range(random_key(key, 3), 0.0f, 6.28f);
    return (RidgeBand){.x = random_range(random_key(key, 1), -50.0f, 50.0f),
                       .z = random_range(random_key(key, 2), -50.0f, 50.0f),
                       .dx = cosf(angle),
                       .dz = sinf(angle),
                       .length = random_range(random_key(key, 4), 0.0f, 20.0f),
                       .share0 = random_range(random_key(key, 5), 0.0f, 1.0f),
                       .share1 = random_range(random_key(key, 6), 0.05f, 1.0f)};
}

// The ridge's point where distance / share is least has the place's share of the curve.
static void a_band_is_swept_along_its_ridge(void **state)
{
    (void)state;
    LiftCurve curve = lift_curve(STOPS, STOP_COUNT);
    for (uint64_t k = 0; k < 300; k++) {
        RidgeBand b = random_band(random_key(1, k));
        float x = b.x + random_range(random_key(k, 11), -20.0f, 20.0f);
        float z = b.z + random_range(random_key(k, 12), -20.0f, 20.0f);
        float least = 3e38f, share = 0.0f;
        for (int i = 0; i <= 20000; i++) {
            float t = (float)i / 20000.0f, s = t * b.length, own = lerpf(b.share0, b.share1, t);
            float u = hypotf(x - b.x - s * b.dx, z - b.z - s * b.dz) / (12.0f * own);
            if (u < least) {
                least = u;
                share = own;
            }
        }
        float expected = share * lift_curve_at(&curve, least);
        assert_true(fabsf(ridge_band_lift(&b, &curve, 12.0f, x, z) - expected) < 2e-3f);
    }
}

static void the_lift_is_that_of_brute_force(void **state)
{
    (void)state;
    enum { COUNT = 400 };
    RidgeBand band[COUNT];
    for (uint64_t k = 0; k < COUNT; k++) {
        band[k] = random_band(random_key(2, k));
    }
    const LiftStop dip[] = {{0.0f, 0.4f}, {0.3f, 1.0f}, {0.6f, 0.2f}, {1.0f, 0.3f}};
    LiftCurve curve = lift_curve(dip, 4);
    Error e = {0};
    for (int threads = 1; threads <= 3; threads++) {
        Run run = run_default();
        run.threads = threads;
        RidgeLift *lift = ridge_lift_new(band, COUNT, &curve, 6.0f, 100.0f, 4.0f, &run, &e);
        assert_non_null(lift);
        for (uint64_t k = 0; k < 3000; k++) {
            float x = random_range(random_key(k, 21), -53.9f, 53.9f);
            float z = random_range(random_key(k, 22), -53.9f, 53.9f);
            float best = 0.0f;
            for (int i = 0; i < COUNT; i++) {
                float h = ridge_band_lift(&band[i], &curve, 6.0f, x, z);
                best = h > best ? h : best;
            }
            assert_true(ridge_lift_at(lift, x, z) == best);
        }
        ridge_lift_free(lift);
    }
}

// ---- land

// A straight ridge of even width: the land is the lift's curve of the distance to it, in m.
static void land_falls_from_a_straight_ridge_as_its_curve_does(void **state)
{
    (void)state;
    const HandNode ends[] = {{-300.0f, 100.0f, 5.0f, -1}, {260.0f, -80.0f, 5.0f, 0}};
    OutTree *ridge = hand_tree(ends, 2);
    write_swc(ridge);
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    LiftStop stops[STOP_COUNT];
    memcpy(stops, STOPS, sizeof stops);
    params.ridges.source.file = swc_file;
    params.ridges.lift = stops;
    params.ridges.lift_count = STOP_COUNT;
    params.ridges.width = 0.25f; // 256 m
    LiftCurve curve = lift_curve(stops, STOP_COUNT);
    for (int sign = 1; sign >= -1; sign -= 2) {
        for (int i = 0; i < STOP_COUNT; i++) {
            stops[i].height = (float)sign * STOPS[i].height; // -1: a valley in a plain
        }
        HeightField *field = land_of(&params);
        int64_t lifted = 0;
        for (int64_t i = 0; i < height_field_count(field); i++) {
            Vec2 p = place_of(field, i);
            float t = ((p.x + 300.0f) * 560.0f + (p.y - 100.0f) * -180.0f) /
                      (560.0f * 560.0f + 180.0f * 180.0f);
            t = clampf(t, 0.0f, 1.0f);
            float away = hypotf(p.x + 300.0f - 560.0f * t, p.y - 100.0f + 180.0f * t);
            float expected = (float)sign * 100.0f * lift_curve_at(&curve, away / 256.0f);
            lifted += expected != 0.0f;
            assert_true(fabsf(field->height[i] - expected) < 0.02f ||
                        fabsf(away - 0.9f * 256.0f) < 0.01f); // the step at the curve's end
        }
        assert_true(lifted > 3000);
        height_field_free(field);
    }
    out_tree_free(ridge);
}

// Grown ridges are the highest land: at each node the land is as high as the crest, which falls
// from the start to the tips, and nowhere is it higher than the relief.
static void grown_ridges_are_the_highest(void **state)
{
    (void)state;
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    params.resolution = 512;
    HeightField *field;
    Grown grown = grow_threads(&params, 1, &field);
    const OutTree *tree = grown.tree;
    assert_true(tree->count > 200);
    int64_t covered = 0, crests = 0, flanks = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        float here = height_field_at(field, p.x, p.z);
        assert_true(here > p.y - 2.5f * field->cell.x * 0.7f);
        assert_true(tree->parent[i] >= 0 ? p.y <= tree->position[tree->parent[i]].y
                                         : fabsf(p.y - 100.0f) < 1e-3f);
        covered += here > p.y + 2.0f; // on the flank of a higher ridge
        if (here > p.y + 2.0f || tree->parent[i] < 0 || p.y < 10.0f) {
            continue;
        }
        Vec3 q = tree->position[tree->parent[i]];
        Vec3 side = vec3_normalize(vec3(p.z - q.z, 0.0f, q.x - p.x));
        float reach = 0.3f * tree->radius[i];
        float left = height_field_at(field, p.x + reach * side.x, p.z + reach * side.z);
        float right = height_field_at(field, p.x - reach * side.x, p.z - reach * side.z);
        bool highest = left < here && right < here;
        crests += highest;
        flanks += !highest; // where another ridge leaves
    }
    assert_true(crests > 100 && crests > 4 * flanks);
    assert_true(covered < tree->count / 3);
    float low, high;
    height_field_range(field, &low, &high);
    assert_true(low == 0.0f && high <= 100.0f && high > 95.0f);
    // Around the ellipse that they grow in lies the plain.
    assert_true(field->height[0] == 0.0f && field->height[512] == 0.0f);
    height_field_free(field);
    grown_clear(&grown);
}

// ---- where the tree comes from

static void an_imported_tree_gives_the_land_of_the_grown_one(void **state)
{
    (void)state;
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    HeightField *field;
    Grown grown = grow_threads(&params, 1, &field);
    write_swc(grown.tree);
    params.ridges.source.file = swc_file;
    HeightField *imported = land_of(&params);
    assert_true(difference_of(field, imported).most < 0.01);
    // In another unit: x and z are scaled, and radii matter only in proportion.
    for (int64_t i = 0; i < grown.tree->count; i++) {
        grown.tree->position[i] = vec3_scale(grown.tree->position[i], 1000.0f);
    }
    write_swc(grown.tree);
    params.ridges.source.scale = 0.001f;
    HeightField *scaled = land_of(&params);
    assert_true(difference_of(field, scaled).most < 0.01);
    height_field_free(field);
    height_field_free(imported);
    height_field_free(scaled);
    grown_clear(&grown);
}

static void a_painted_tree_gives_the_land_of_the_same_tree(void **state)
{
    (void)state;
    OutTree *tree = hand_tree(HAND, HAND_COUNT);
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    write_swc(tree);
    params.ridges.source.file = swc_file;
    HeightField *given = land_of(&params);
    params.ridges.source.file = NULL;
    params.ridges.source.image = image_file;
    for (int invert = 0; invert < 2; invert++) {
        write_image(tree, params.size, 1024, invert);
        params.ridges.source.invert = invert;
        HeightField *painted = land_of(&params);
        Difference d = difference_of(given, painted);
        if (!(d.rms < 1.0 && d.most < 15.0)) { // of 100 m; the most beside a sharp crest
            fail_msg("the painted land is off by %g m, at most %g m", d.rms, d.most);
        }
        height_field_free(painted);
    }
    height_field_free(given);
    out_tree_free(tree);
}

// Rivers that are read or painted fall to the border as grown ones do.
static void rivers_come_from_files_and_pictures(void **state)
{
    (void)state;
    static const HandNode RIVER[] = {
        {0.0f, 512.0f, 6.0f, -1},   {-40.0f, 200.0f, 6.0f, 0},  {60.0f, -60.0f, 6.0f, 1},
        {300.0f, -200.0f, 5.0f, 2}, {-40.0f, -330.0f, 5.0f, 2}, {-330.0f, 60.0f, 5.0f, 1},
    };
    OutTree *tree = hand_tree(RIVER, 6);
    write_swc(tree);
    write_image(tree, 1024.0f, 1024, false);
    TerrainParams params = plain_terrain(TERRAIN_RIVERS);
    params.uplift.noise = 0.0f;
    params.rivers.source.file = swc_file;
    HeightField *given;
    Grown grown = grow_threads(&params, 1, &given);
    params.rivers.source = (TreeSource){.image = image_file, .scale = 1.0f};
    HeightField *painted = land_of(&params);
    HeightField *fields[2] = {given, painted};
    for (int k = 0; k < 2; k++) {
        MeasureList list = {0};
        Error e = {0};
        assert_true(height_field_measure(fields[k], 0.0, &list, &e));
        assert_true(measures_find(&list, "pits")->value == 0.0);
        assert_true(measures_find(&list, "rivers_that_drain")->value == 1.0);
        measures_clear(&list);
        assert_true(height_field_at(fields[k], 0.0f, 511.0f) < 1.0f); // the outlet
    }
    for (int64_t i = 0; i < grown.tree->count; i++) {
        Vec3 p = grown.tree->position[i];
        int64_t parent = grown.tree->parent[i];
        assert_true(parent < 0 ? p.z == 512.0f : p.y > grown.tree->position[parent].y);
        assert_true(height_field_at(given, p.x, p.z) < p.y + 8.0f);
    }
    Difference d = difference_of(given, painted);
    if (!(d.rms < 3.0)) { // of 100 m
        fail_msg("the painted land is off by %g m, at most %g m", d.rms, d.most);
    }
    height_field_free(given);
    height_field_free(painted);
    grown_clear(&grown);
    out_tree_free(tree);
}

static void roots_away_from_the_border_are_led_to_it(void **state)
{
    (void)state;
    const HandNode brook[] = {{300.0f, 20.0f, 1.0f, -1}, {-200.0f, 0.0f, 1.0f, 0}};
    OutTree *tree = hand_tree(brook, 2);
    write_swc(tree);
    TerrainParams params = plain_terrain(TERRAIN_RIVERS);
    params.rivers.source.file = swc_file;
    HeightField *field;
    Grown grown = grow_threads(&params, 1, &field);
    assert_true(vec3_distance(grown.tree->position[0], vec3(512.0f, 0.0f, 20.0f)) < 1e-3f);
    assert_true(grown.tree->count > 100); // short enough for areas to grow along them
    height_field_free(field);
    grown_clear(&grown);
    out_tree_free(tree);
}

static void pictures_without_lines_are_refused(void **state)
{
    (void)state;
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    params.ridges.source.image = image_file;
    for (int k = 0; k < 3; k++) { // nothing, everything, everything taken for dark
        Error e = {0};
        Image *image = image_new(64, 64, 1, &e);
        for (int i = 0; i < 64 * 64; i++) {
            image->pixel[i] = k == 1 ? 1.0f : 0.0f;
        }
        assert_true(image_write_grey16(image_file, image, NULL, &e));
        image_free(image);
        params.ridges.source.invert = k == 2;
        Run run = run_default();
        Recipe recipe = {.seed = 5, .label = "land", .run = &run};
        assert_null(grow_kind(&kind_terrain, &params, &recipe, 1.0f, &e));
        assert_non_null(strstr(e.message, k == 0 ? "cover nothing" : "cover more than half"));
        assert_string_equal(e.key, "ridges.image");
    }
}

// ---- a painted map

// The lift that is painted: a cone and a ramp.
static float painted_lift(float x, float z)
{
    float cone = 1.0f - hypotf(x - 100.0f, z + 50.0f) / 400.0f;
    float ramp = 0.3f * (x + 512.0f) / 1024.0f;
    return cone > ramp ? cone : ramp;
}

static Vec3 scale_color(float height)
{
    int i = 0;
    while (i < TERRAIN_ALTITUDES - 2 && height > terrain_altitudes[i + 1].at) {
        i++;
    }
    const ColorStop *a = &terrain_altitudes[i], *b = a + 1;
    Vec3 low = {tone_srgb_from_linear(a->color.x), tone_srgb_from_linear(a->color.y),
                tone_srgb_from_linear(a->color.z)};
    Vec3 high = {tone_srgb_from_linear(b->color.x), tone_srgb_from_linear(b->color.y),
                 tone_srgb_from_linear(b->color.z)};
    return vec3_lerp(low, high, (height - a->at) / (b->at - a->at));
}

// The colours of the scale, or greys with a scale of black and white, are the heights painted.
static void the_colours_of_a_map_are_heights(void **state)
{
    (void)state;
    enum { SIDE = 256 };
    ColorStop greys[] = {{0.0f, {0.0f, 0.0f, 0.0f}}, {1.0f, {1.0f, 1.0f, 1.0f}}};
    for (int grey = 0; grey < 2; grey++) {
        Error e = {0};
        Image *image = image_new(SIDE, SIDE, 3, &e);
        for (int i = 0; i < SIDE * SIDE; i++) {
            int row = i / SIDE;
            float x = (((float)(i % SIDE) + 0.5f) / SIDE - 0.5f) * 1024.0f;
            float z = (((float)row + 0.5f) / SIDE - 0.5f) * 1024.0f, lift = painted_lift(x, z);
            Vec3 c = grey ? vec3_splat(lift) : scale_color(lift);
            memcpy(image->pixel + (ptrdiff_t)3 * i, (float[]){c.x, c.y, c.z}, 3 * sizeof(float));
        }
        assert_true(image_write_display(image_file, image, NULL, &e));
        image_free(image);
        TerrainParams params = plain_terrain(TERRAIN_MAP);
        params.map.image = image_file;
        params.map.colors = grey ? greys : NULL;
        params.map.color_count = grey ? 2 : 0;
        HeightField *field = land_of(&params);
        double squares = 0.0;
        for (int64_t i = 0; i < height_field_count(field); i++) {
            Vec2 p = place_of(field, i);
            double off = (double)(field->height[i] - 100.0f * painted_lift(p.x, p.y));
            squares += off * off;
        }
        double rms = sqrt(squares / (double)height_field_count(field));
        if (!(rms < 0.4)) { // of 100 m, in 8 bits
            fail_msg("the map's land is off by %g m", rms);
        }
        height_field_free(field);
    }
}

// ---- noise

// Without rivers and ridges all height is the octaves': none, or of the variance of their sum.
static void noise_alone_is_the_sum_of_its_octaves(void **state)
{
    (void)state;
    TerrainParams params = plain_terrain(TERRAIN_NOISE);
    params.resolution = 256;
    params.noise.wavelength = 1.0f / 32.0f; // 1024 waves: m 32 long
    params.noise.ridged = 0.0f;
    params.noise.amplitude = 0.2f;
    static const int OCTAVES[] = {0, 1, 2, 4};
    double rough[4];
    for (int k = 0; k < 4; k++) {
        params.noise.iterations = OCTAVES[k];
        HeightField *field = land_of(&params);
        double sum = 0.0, squares = 0.0, steps = 0.0, variance = 0.0;
        int64_t count = height_field_count(field);
        for (int64_t i = 0; i < count; i++) {
            double h = (double)field->height[i];
            sum += h;
            squares += h * h;
            steps += i % 257 > 0 ? fabs(h - (double)field->height[i - 1]) : 0.0;
        }
        for (int o = 0; o < OCTAVES[k]; o++) {
            variance += pow(0.25, o) * 6.4 * 6.4;
        }
        rough[k] = steps / (double)count;
        assert_true(fabs(sum / (double)count) < 0.5);
        assert_true(k == 0 ? squares == 0.0 : fabs(squares / (double)count / variance - 1.0) < 0.1);
        assert_true(k == 0 || rough[k] > 1.1 * rough[k - 1]); // each adds detail
        height_field_free(field);
    }
}

// Around ridges the noise adds nothing to the plain.
static void noise_keeps_off_the_plain(void **state)
{
    (void)state;
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    params.ridges.extent[0] = params.ridges.extent[1] = 0.4f;
    params.noise.iterations = 4;
    HeightField *rough = land_of(&params);
    params.noise.iterations = 0;
    HeightField *smooth = land_of(&params);
    int64_t plain = 0, changed = 0;
    for (int64_t i = 0; i < height_field_count(rough); i++) {
        Vec2 p = place_of(rough, i);
        bool outside = hypotf(p.x, p.y) > 0.45f * params.size;
        plain += outside;
        assert_true(!outside || rough->height[i] == 0.0f);
        changed += rough->height[i] != smooth->height[i];
    }
    assert_true(plain > 2000 && changed > 1000);
    height_field_free(rough);
    height_field_free(smooth);
}

// ---- size

static void land_scales_with_its_size(void **state)
{
    (void)state;
    for (int form = TERRAIN_RIDGES; form <= TERRAIN_NOISE; form++) {
        TerrainParams params = plain_terrain((TerrainForm)form);
        if (form == TERRAIN_MAP) {
            continue; // its size is the picture's
        }
        params.relief = 0.0f;
        params.noise.iterations = 4;
        HeightField *small = land_of(&params);
        params.size *= 16.0f;
        HeightField *large = land_of(&params);
        float low, high, most = 0.0f;
        height_field_range(large, &low, &high);
        for (int64_t i = 0; i < height_field_count(small); i++) {
            float off = fabsf(16.0f * small->height[i] - large->height[i]);
            most = off > most ? off : most;
        }
        assert_true(high > low && most < 1e-4f * (high - low));
        height_field_free(small);
        height_field_free(large);
    }
}

// ---- threads

static void the_same_bits_for_any_threads(void **state)
{
    (void)state;
    OutTree *tree = hand_tree(HAND, HAND_COUNT);
    write_swc(tree);
    write_image(tree, 1024.0f, 512, false);
    enum { CASES = 6 };
    for (int k = 0; k < CASES; k++) {
        TerrainParams params = plain_terrain(k == 0   ? TERRAIN_NOISE
                                             : k == 4 ? TERRAIN_RIVERS
                                             : k == 5 ? TERRAIN_MAP
                                                      : TERRAIN_RIDGES);
        params.noise.iterations = 5;
        params.erosion.streams = k == 1 ? 1.0f : 0.0f;
        params.ridges.source.file = k == 2 ? swc_file : NULL;
        params.ridges.source.image = k == 3 ? image_file : NULL;
        params.rivers.source.image = params.map.image = image_file;
        uint64_t land = 0, tree_hash = 0;
        for (int threads = 1; threads <= 3; threads++) {
            HeightField *field;
            Grown grown = grow_threads(&params, threads, &field);
            uint64_t hash = height_field_hash(field), nodes = out_tree_hash(grown.tree);
            assert_true(threads == 1 || (hash == land && nodes == tree_hash));
            land = hash;
            tree_hash = nodes;
            height_field_free(field);
            grown_clear(&grown);
        }
    }
    out_tree_free(tree);
}

// ---- parts

// The map is the plane with the land's altitudes, and the tree lies on it.
static void the_stages_are_drawn_flat(void **state)
{
    (void)state;
    TerrainParams params = plain_terrain(TERRAIN_RIDGES);
    params.water_level = 0.1f;
    params.position = vec3(10.0f, 20.0f, 30.0f);
    for (int show = SHOW_LAND; show <= SHOW_TREE; show++) {
        params.show = (TerrainShow)show;
        HeightField *field;
        Grown grown = grow_threads(&params, 1, &field);
        Geometry geometry = {0};
        Error e = {0};
        Run run = run_default();
        Recipe recipe = {.seed = 5, .label = "land", .run = &run};
        Placing placing = placing_in(&geometry, &recipe);
        assert_true(terrain_geometry(&params, &grown, &placing, &e));
        Aabb box = mesh_bounds(geometry.part[0].mesh);
        bool flat = box.low.y == 20.0f && box.high.y == 20.0f;
        assert_true(flat == (show != SHOW_LAND));
        float highest = 0.0f;
        for (int64_t i = 0; i < geometry.part[0].mesh->vertex_count; i++) {
            float altitude = geometry.part[0].mesh->site[i].x;
            highest = altitude > highest ? altitude : highest;
        }
        assert_true(highest > 0.9f);
        assert_int_equal(geometry.count, show == SHOW_MAP ? 1 : 2); // land and lake, or lines
        assert_true((geometry.part[geometry.count - 1].kind == PART_CURVES) == (show == SHOW_TREE));
        assert_true(show != SHOW_TREE || geometry.part[1].material == TERRAIN_LINES);
        geometry_clear(&geometry);
        height_field_free(field);
        grown_clear(&grown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lift_goes_through_its_points_and_falls_between_them),
        cmocka_unit_test(a_band_is_swept_along_its_ridge),
        cmocka_unit_test(the_lift_is_that_of_brute_force),
        cmocka_unit_test(land_falls_from_a_straight_ridge_as_its_curve_does),
        cmocka_unit_test(grown_ridges_are_the_highest),
        cmocka_unit_test(an_imported_tree_gives_the_land_of_the_grown_one),
        cmocka_unit_test(a_painted_tree_gives_the_land_of_the_same_tree),
        cmocka_unit_test(rivers_come_from_files_and_pictures),
        cmocka_unit_test(roots_away_from_the_border_are_led_to_it),
        cmocka_unit_test(pictures_without_lines_are_refused),
        cmocka_unit_test(the_colours_of_a_map_are_heights),
        cmocka_unit_test(noise_alone_is_the_sum_of_its_octaves),
        cmocka_unit_test(noise_keeps_off_the_plain),
        cmocka_unit_test(land_scales_with_its_size),
        cmocka_unit_test(the_same_bits_for_any_threads),
        cmocka_unit_test(the_stages_are_drawn_flat),
    };
    return cmocka_run_group_tests(tests, name_files, remove_files);
}
