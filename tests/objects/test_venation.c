// Leaves: veins with radii, geometry of blade and veins, the texture.
#include "making.h"
#include "testing.h"

#include "objects/venation/vein_curves.h"
#include "objects/venation/venation.h"

#include <math.h>
#include <stdlib.h>

static OutTree *grow(const VenationParams *params)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 3, .label = "leaf", .run = &run};
    OutTree *tree = grow_kind(&kind_venation, params, &recipe, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static VenationParams small_params(void)
{
    VenationParams params = venation_params_default();
    params.detail = 25;
    return params;
}

static void a_leaf_has_a_blade_and_a_curve_for_each_piece_of_vein(void **state)
{
    (void)state;
    VenationParams params = small_params();
    OutTree *tree = grow(&params);
    assert_float_equal(tree->radius[0], 0.008f * params.outline.length, 1e-6);
    Geometry geometry = {0};
    Error e = {0};
    Placing placing = placing_in(&geometry, NULL);
    Grown grown = grown_of(tree);
    assert_true(venation_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 2);
    const CurveSet *veins = geometry.part[0].curves;
    assert_int_equal(veins->curve_count, tree->count - 1);
    assert_int_equal(veins->first[veins->curve_count], veins->point_count);
    Aabb blade = mesh_bounds(geometry.part[1].mesh);
    for (int64_t i = 0; i < veins->point_count; i++) { // in the blade, but for the petiole
        assert_true(veins->position[i].x > blade.low.x - 1e-3f);
        assert_true(veins->position[i].x < blade.high.x + 1e-3f);
        assert_true(veins->position[i].y < blade.high.y + 1e-3f);
    }
    geometry_clear(&geometry);
    params.blade = false;
    assert_true(venation_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 1);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static CurveSet *curves_of(const OutTree *tree, const VenationParams *params)
{
    Transform place = transform_compose(vec3(0, 0, 0), vec3(0, 0, 0), vec3_splat(1.0f));
    Error e = {0};
    Relief flat = {.params = params};
    CurveSet *curves = venation_curves(tree, params, &flat, &place, &e);
    assert_non_null(curves);
    return curves;
}

// Sum of squared turns between pieces that follow each other, and of steps in their radii.
static void count_roughness(const OutTree *tree, const CurveSet *curves, double *turns,
                            double *steps)
{
    int64_t *piece = malloc(sizeof *piece * (size_t)tree->count), number = 0;
    *turns = *steps = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        piece[i] = parent >= 0 ? number++ : -1;
        bool only = parent >= 0 && piece[parent] >= 0 && tree->radius[i] == tree->radius[parent];
        const Vec3 *p = curves->position;
        if (only) {
            int64_t a = 2 * piece[parent], b = 2 * piece[i];
            Vec3 before = vec3_normalize(vec3_sub(p[a + 1], p[a]));
            Vec3 after = vec3_normalize(vec3_sub(p[b + 1], p[b]));
            *turns += 1.0 - (double)vec3_dot(before, after);
        }
        if (parent >= 0 && tree->radius[i] > 0.8f * tree->radius[parent]) { // goes on
            *steps += fabs((double)curves->radius[2 * piece[i]] / (double)tree->radius[parent] - 1);
        }
    }
    free(piece);
}

static void smoothing_rounds_bends_and_keeps_joins(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.curl = params.fold = 0.0f;
    OutTree *tree = grow(&params);
    CurveSet *rough = curves_of(tree, &params);
    params.smoothing = 3;
    CurveSet *smooth = curves_of(tree, &params);
    double turns[2], steps[2];
    count_roughness(tree, rough, &turns[0], &steps[0]);
    count_roughness(tree, smooth, &turns[1], &steps[1]);
    assert_true(turns[0] > 0.0 && turns[1] < 0.8 * turns[0]);
    assert_true(steps[0] > 0.0 && steps[1] < 0.5 * steps[0]);
    int64_t joins = 0;
    for (int64_t i = 1; i < rough->point_count; i += 2) { // a tip that met another stays there
        for (int64_t j = 1; j < i; j += 2) {
            bool meet = vec3_distance(rough->position[i], rough->position[j]) == 0.0f;
            assert_true(!meet || vec3_distance(smooth->position[i], smooth->position[j]) == 0.0f);
            joins += meet;
        }
    }
    assert_true(joins > 20);
    curves_free(rough);
    curves_free(smooth);
    out_tree_free(tree);
}

static void the_texture_shows_the_midrib_in_the_middle(void **state)
{
    (void)state;
    VenationParams params = small_params();
    OutTree *tree = grow(&params);
    enum { WIDTH = 64, HEIGHT = 128 };
    float *pixel = malloc(sizeof *pixel * WIDTH * HEIGHT), dark = 0.0f;
    assert_true(venation_paint(&params, tree, WIDTH, HEIGHT, pixel, NULL));
    for (int row = HEIGHT / 4; row < HEIGHT; row++) {
        assert_true(pixel[row * WIDTH + WIDTH / 2] > 0.05f);
        for (int column = 0; column < WIDTH; column++) {
            float value = pixel[row * WIDTH + column];
            assert_true(value >= 0.0f && value <= 1.0f);
            dark += value == 0.0f;
        }
    }
    assert_true(dark > 0.4f * WIDTH * HEIGHT * 3 / 4); // and blade between the veins
    free(pixel);
    out_tree_free(tree);
}

static double measured(const OutTree *tree, const VenationParams *params, const char *name)
{
    MeasureList list = {0};
    Grown grown = grown_of(tree);
    assert_true(venation_measure(params, &grown, NULL, &list, NULL));
    double value = measures_find(&list, name)->value;
    measures_clear(&list);
    return value;
}

static void the_net_is_measured_against_the_blade(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.outline = (LeafOutline){.length = 0.1f, .width = 0.06f, .widest = 0.5f, .tip = 1.0f};
    double ellipse = M_PI / 4.0 * 100.0 * 60.0; // mm^2
    OutTree *net = grow(&params);
    double areoles = measured(net, &params, "areoles");
    assert_true(areoles > 20.0);
    assert_true(fabs(measured(net, &params, "areole_area") * areoles / ellipse - 1.0) < 1e-3);
    params.closed = false;
    OutTree *open = grow(&params);
    assert_true(measured(open, &params, "areoles") == 0.0);
    assert_true(isnan(measured(open, &params, "areole_area")));
    double length = 0.0;
    for (int64_t i = 1; i < open->count; i++) {
        length += (double)vec3_distance(open->position[i], open->position[open->parent[i]]);
    }
    length = 1000.0 * (length - (double)params.petiole);
    assert_true(fabs(measured(open, &params, "vein_density") * ellipse / length - 1.0) < 1e-3);
    out_tree_free(net);
    out_tree_free(open);
}

// The midrib lies at the bottom of its furrow, all the relief deep, and so does the blade above it;
// half an areole beside the net's finest veins the blade is hardly lower than without relief.
static void the_blade_bulges_between_veins(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.relief = 0.0008f;
    params.curl = params.fold = 0.0f;
    OutTree *tree = grow(&params);
    VenationParams full = venation_params_resolve(&params);
    Relief relief;
    Error e = {0};
    assert_true(relief_init(&relief, &full, tree, &e));
    Transform place = transform_identity();
    Mesh *blade = venation_blade(&full, &relief, &place, &e);
    assert_non_null(blade);
    float low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < blade->vertex_count; i++) {
        Vec3 p = blade->position[i];
        assert_true(p.z <= 0.0f && p.z >= -params.relief);
        if (p.y > 0.004f && p.y < 0.01f && fabsf(p.x) < 0.0002f) {
            low = fminf(low, p.z);
        }
        high = fmaxf(high, p.z);
    }
    assert_true(low < -0.9f * params.relief);
    assert_true(high > -0.02f * params.relief);
    float root = relief_at(&relief, vec3(0, 0.005f, 0));
    assert_true(root < -0.9f * params.relief);
    assert_true(relief_at(&relief, vec3(0, -0.01f, 0)) == 0.0f); // the stalk
    mesh_free(blade);
    relief_clear(&relief);
    out_tree_free(tree);
}

// Embedded veins have no curves, and thicker ones sink in as they taper; where they run, the blade
// is paler than anywhere in an areole, and areoles differ, but not by much.
static void thin_veins_lie_in_the_blade(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.embedded = 0.0003f;
    OutTree *tree = grow(&params);
    VenationParams full = venation_params_resolve(&params);
    int64_t thick = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        thick += tree->parent[i] >= 0 && tree->radius[i] >= full.embedded;
    }
    CurveSet *curves = curves_of(tree, &full);
    assert_int_equal(curves->curve_count, thick);
    assert_true(thick > 0 && thick < tree->count - 1);
    float thinnest = INFINITY; // where a tube sinks into the blade
    for (int64_t i = 0; i < curves->point_count; i++) {
        thinnest = fminf(thinnest, curves->radius[i]);
    }
    assert_true(thinnest > 0.0f && thinnest < 0.4f * full.embedded);
    Relief relief;
    Error e = {0};
    assert_true(relief_init(&relief, &full, tree, &e));
    Transform place = transform_identity();
    Mesh *blade = venation_blade(&full, &relief, &place, &e);
    assert_non_null(blade);
    assert_non_null(blade->young);
    int64_t veins = 0, greenest = 0, paler = 0;
    for (int64_t i = 0; i < blade->vertex_count; i++) {
        float young = blade->young[i];
        assert_true(young >= 0.0f && young <= 1.0f);
        veins += young > 0.5f;
        greenest += young < 0.1f;
        paler += young > 0.2f && young < 0.3f;
    }
    assert_true(veins > blade->vertex_count / 50 && veins < blade->vertex_count / 2);
    assert_true(greenest > blade->vertex_count / 20 && paler > blade->vertex_count / 20);
    mesh_free(blade);
    curves_free(curves);
    relief_clear(&relief);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smoothing_rounds_bends_and_keeps_joins),
        cmocka_unit_test(a_leaf_has_a_blade_and_a_curve_for_each_piece_of_vein),
        cmocka_unit_test(the_texture_shows_the_midrib_in_the_middle),
        cmocka_unit_test(the_net_is_measured_against_the_blade),
        cmocka_unit_test(the_blade_bulges_between_veins),
        cmocka_unit_test(thin_veins_lie_in_the_blade),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
