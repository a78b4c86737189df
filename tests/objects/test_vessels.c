// Blood vessels: both trees in the organ, apart from each other, by Murray's laws.
#include "making.h"
#include "objects/vessels/stem.h"
#include "objects/vessels/vessels.h"
#include "outtree/segment_grid.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static Shape organ_shape(float size)
{
    return (Shape){.kind = SHAPE_ELLIPSOID,
                   .size = vec3(1.2f * size, 0.8f * size, size),
                   .transform = transform_identity()};
}

static VesselsParams organ(Shape *shape, int64_t terminals)
{
    VesselsParams params = vessels_params_default();
    params.element.shapes = shape;
    params.element.shape_count = 1;
    params.terminals = terminals;
    return params;
}

static OutTree *grow(const VesselsParams *params, int threads, float grow_to)
{
    Run run = run_default();
    run.threads = threads;
    Recipe recipe = {.seed = 8, .label = "object 'test'", .run = &run};
    Error e = {0};
    OutTree *tree = grow_kind(&kind_vessels, params, &recipe, grow_to, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

static int64_t count_terminals(const OutTree *tree, int32_t colony)
{
    int64_t count = 0;
    bool *inner = calloc((size_t)tree->count, sizeof *inner);
    assert_non_null(inner);
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        count += !inner[i] && tree->colony[i] == colony;
        if (tree->parent[i] >= 0) {
            inner[tree->parent[i]] = true;
        }
    }
    free(inner);
    return count;
}

// Every artery against every vein.
static float least_gap(const OutTree *tree)
{
    float gap = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        for (int64_t k = 0; k < tree->count && tree->colony[i] == VESSELS_ARTERIES; k++) {
            if (tree->colony[k] == VESSELS_VEINS && tree->parent[i] >= 0 && tree->parent[k] >= 0) {
                float d = segment_distance(tree->position[tree->parent[i]], tree->position[i],
                                           tree->position[tree->parent[k]], tree->position[k]);
                gap = fminf(gap, d - tree->radius[i] - tree->radius[k]);
            }
        }
    }
    return gap;
}

static float finest(const OutTree *tree)
{
    float radius = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        radius = fminf(radius, tree->radius[i]);
    }
    return radius;
}

static void arteries_and_veins_fill_the_organ_apart(void **state)
{
    (void)state;
    Shape shape = organ_shape(0.1f);
    VesselsParams params = organ(&shape, 600);
    OutTree *tree = grow(&params, 1, 1.0f);
    assert_int_equal(count_terminals(tree, VESSELS_ARTERIES), 300);
    assert_int_equal(count_terminals(tree, VESSELS_VEINS), 300);
    float gap = least_gap(tree);
    assert_true(gap > 0.99f * params.gap * finest(tree));

    MeasureList list = {0};
    Grown grown = grown_of(tree);
    assert_true(vessels_measure(&params, &grown, NULL, &list, NULL));
    assert_true(fabs(measures_find(&list, "artery_vein_gap")->value - (double)gap) < 1e-6);
    assert_true(measures_find(&list, "flow_residual")->value < 2e-6);
    // where subtrees have no room to turn, the daughters are bent
    assert_true(measures_find(&list, "murray_angle_exact_share")->value > 0.98);
    measures_clear(&list);

    Run run = run_default();
    EnvelopeParams shapes = {.shapes = &shape, .shape_count = 1, .voxel = 0};
    Envelope *envelope = envelope_new(&shapes, &run, NULL);
    assert_non_null(envelope);
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->birth[i] == 0) { // a stem, which comes from outside
            continue;
        }
        for (int k = 0; k <= 4; k++) {
            Vec3 p =
                vec3_lerp(tree->position[tree->parent[i]], tree->position[i], 0.25f * (float)k);
            assert_true(envelope_distance(envelope, p) < 0.0f);
        }
        assert_true(envelope_distance(envelope, tree->position[i]) <= -tree->radius[i]);
    }
    envelope_free(envelope);
    out_tree_free(tree);
}

// Every terminal artery has a vein's terminal nearby: that is where the blood goes over.
static void terminals_of_both_meet(void **state)
{
    (void)state;
    Shape shape = organ_shape(1.0f);
    VesselsParams params = organ(&shape, 600);
    OutTree *tree = grow(&params, 1, 1.0f);
    bool *inner = calloc((size_t)tree->count, sizeof *inner);
    assert_non_null(inner);
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            inner[tree->parent[i]] = true;
        }
    }
    double sum = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        float nearest = INFINITY;
        for (int64_t k = 0; k < tree->count && !inner[i] && tree->colony[i] == 0; k++) {
            if (!inner[k] && tree->colony[k] == 1) {
                nearest = fminf(nearest, vec3_distance(tree->position[i], tree->position[k]));
            }
        }
        sum += isfinite(nearest) ? (double)nearest : 0.0;
    }
    double spacing = cbrt(4.0 / 3.0 * 3.14159 * 1.2 * 0.8 / 300.0);
    assert_true(sum / 300.0 < spacing);
    free(inner);
    out_tree_free(tree);
}

static void size_threads_and_time_change_nothing_else(void **state)
{
    (void)state;
    Shape shape = organ_shape(0.1f), large = organ_shape(0.8f);
    VesselsParams params = organ(&shape, 300), larger = organ(&large, 300);
    OutTree *tree = grow(&params, 1, 1.0f);
    for (int threads = 2; threads <= 3; threads++) {
        OutTree *other = grow(&params, threads, 1.0f);
        assert_true(out_tree_hash(other) == out_tree_hash(tree));
        out_tree_free(other);
    }
    OutTree *eightfold = grow(&larger, 1, 1.0f);
    assert_int_equal(count_terminals(eightfold, 0), 150);
    assert_true(fabsf(eightfold->radius[0] / tree->radius[0] - 8.0f) < 0.4f);

    OutTree *young = grow(&params, 1, 0.5f);
    assert_true(young->count < tree->count && young->count > 20);
    assert_true(least_gap(young) > 0.0f);
    assert_true(young->radius[0] <= tree->radius[0]);
    MurrayFit fit;
    OutTree *arteries = vessels_colony(young, VESSELS_ARTERIES, NULL);
    assert_true(out_tree_murray_fit(arteries, params.law, &fit, NULL) && fit.residual < 2e-6);
    out_tree_free(arteries);
    out_tree_free(young);
    out_tree_free(eightfold);
    out_tree_free(tree);
}

static void a_body_is_supplied_to_its_ends(void **state)
{
    (void)state;
    Shape shape = {
        .kind = SHAPE_BODY, .size = vec3(1.75f, 1, 1), .transform = transform_identity()};
    VesselsParams params = organ(&shape, 1200);
    params.element.voxel = 0.012f;
    OutTree *tree = grow(&params, 2, 1.0f);
    for (int32_t colony = 0; colony < 2; colony++) {
        Aabb box = aabb_empty();
        for (int64_t i = 0; i < tree->count; i++) {
            if (tree->colony[i] == colony) {
                box = aabb_add(box, tree->position[i]);
            }
        }
        assert_true(box.low.y < 0.08f && box.high.y > 1.65f);  // feet and head
        assert_true(box.low.x < -0.36f && box.high.x > 0.36f); // hands
    }
    Run run = run_default();
    EnvelopeParams shapes = {.shapes = &shape, .shape_count = 1, .voxel = 0.012f};
    Envelope *envelope = envelope_new(&shapes, &run, NULL);
    assert_non_null(envelope);
    for (int64_t i = 0; i < tree->count; i++) { // the great vessels too
        assert_true(envelope_contains(envelope, tree->position[i]));
    }
    envelope_free(envelope);
    MeasureList list = {0};
    Grown grown = grown_of(tree);
    assert_true(vessels_measure(&params, &grown, NULL, &list, NULL));
    assert_true(measures_find(&list, "artery_vein_gap")->value > 0.0);
    measures_clear(&list);
    out_tree_free(tree);
}

// Share of the envelope's lattice points in a box from which a vessel is nearer than `reach`, m.
static double share_reached(const OutTree *tree, const Envelope *envelope, Vec3 low, Vec3 high,
                            float reach)
{
    enum { SIDE = 12 };
    SegmentGrid *grid = segment_grid_new(tree, NULL);
    assert_non_null(grid);
    int64_t inside = 0, reached = 0;
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        const int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        Vec3 share = vec3((float)at[0] + 0.5f, (float)at[1] + 0.5f, (float)at[2] + 0.5f);
        Vec3 p = vec3_add(low, vec3_mul(vec3_scale(share, 1.0f / SIDE), vec3_sub(high, low)));
        if (envelope_contains(envelope, p)) {
            inside++;
            reached += segment_grid_touches(grid, p, p, reach, 0.0f);
        }
    }
    segment_grid_free(grid);
    assert_true(inside > 50);
    return (double)reached / (double)inside;
}

static void a_bodys_hands_and_feet_are_filled(void **state)
{
    (void)state;
    Shape shape = {.kind = SHAPE_BODY, .size = vec3(1, 1, 1), .transform = transform_identity()};
    VesselsParams params = organ(&shape, 300);
    params.element.voxel = 0.004f;
    OutTree *tree = grow(&params, 2, 1.0f);
    Run run = run_default();
    EnvelopeParams shapes = {.shapes = &shape, .shape_count = 1, .voxel = 0.004f};
    Envelope *envelope = envelope_new(&shapes, &run, NULL);
    assert_non_null(envelope);
    for (int side = -1; side <= 1; side += 2) {
        Vec3 hand[2] = {{side > 0 ? 0.20f : -0.28f, 0.39f, -0.03f},
                        {side > 0 ? 0.28f : -0.20f, 0.50f, 0.05f}};
        Vec3 foot[2] = {{side > 0 ? 0.04f : -0.11f, 0.0f, -0.05f},
                        {side > 0 ? 0.11f : -0.04f, 0.05f, 0.10f}};
        double hands = share_reached(tree, envelope, hand[0], hand[1], 0.01f);
        double feet = share_reached(tree, envelope, foot[0], foot[1], 0.01f);
        assert_true(hands > 0.9 && feet > 0.55);
    }
    envelope_free(envelope);
    out_tree_free(tree);
}

// A thin wall about a cavity, with few coarse levels: shrunk, they would lie in the cavity.
static void a_hollow_organ_is_filled(void **state)
{
    (void)state;
    Shape wall[2] = {organ_shape(0.05f), organ_shape(0.046f)};
    wall[1].op = SHAPE_DIFFERENCE;
    GreatVessel great[4];
    for (int i = 0; i < 4; i++) {
        float z = i < 2 ? 0.006f : -0.006f, x = i % 2 == 0 ? 0.058f : -0.058f;
        great[i] = (GreatVessel){.vein = i >= 2,
                                 .from = {0, 0.0385f, z},
                                 .to = {x, 0, z},
                                 .by = {x, 0.0385f, z},
                                 .bent = true};
    }
    VesselsParams params = organ(wall, 400);
    params.element.shape_count = 2;
    params.element.voxel = 0.001f;
    params.root_radius = 0.0015f;
    params.great = great;
    params.great_count = 4;
    OutTree *tree = grow(&params, 2, 1.0f);
    assert_true(count_terminals(tree, VESSELS_ARTERIES) > 60);
    assert_true(count_terminals(tree, VESSELS_VEINS) > 60);
    out_tree_free(tree);
}

static void skins_and_curves_come_out_of_both(void **state)
{
    (void)state;
    Shape shape = organ_shape(0.1f);
    VesselsParams params = organ(&shape, 60);
    OutTree *tree = grow(&params, 1, 1.0f);
    Run run = run_default();
    Recipe recipe = {.run = &run};
    Grown grown = grown_of(tree);
    for (int skinned = 0; skinned < 2; skinned++) {
        Geometry geometry = {0};
        params.curve_radius = skinned ? 0.5f * tree->radius[0] : 0.0f;
        Placing placing = placing_in(&geometry, &recipe);
        placing.material += 3; // from 3 on
        assert_true(vessels_geometry(&params, &grown, &placing, NULL));
        assert_int_equal(geometry.count, skinned ? 4 : 2);
        assert_int_equal(geometry.part[0].material, 3);
        assert_int_equal(geometry.part[geometry.count - 1].material, 4);
        assert_true(geometry_counts(&geometry).curve_segments > 20);
        geometry_clear(&geometry);
    }
    out_tree_free(tree);
}

// However few terminals there are: the stems never take a tree away.
static void few_terminals_leave_both_trees(void **state)
{
    (void)state;
    for (int64_t terminals = 60; terminals <= 180; terminals += 60) {
        Shape shape = organ_shape(0.04f);
        VesselsParams params = organ(&shape, terminals);
        OutTree *tree = grow(&params, 2, 1.0f);
        assert_true(2 * count_terminals(tree, VESSELS_ARTERIES) > terminals / 2);
        assert_true(2 * count_terminals(tree, VESSELS_VEINS) > terminals / 2);
        assert_true(least_gap(tree) > 0.0f);
        out_tree_free(tree);
    }
}

// Distance from a place to the nearest node of a colony.
static float distance_to(const OutTree *tree, int32_t colony, Vec3 place)
{
    float least = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] == colony) {
            least = fminf(least, vec3_distance(tree->position[i], place));
        }
    }
    return least;
}

static void growth_starts_from_placed_vessels(void **state)
{
    (void)state;
    Shape shape = organ_shape(0.05f);
    GreatVessel great[] = {
        {.from = {0, -0.08f, 0}, .to = {0, -0.01f, 0}},
        {.from = {0.01f, -0.02f, 0}, .to = {0.045f, 0, 0}, .by = {0.02f, 0.01f, 0}, .bent = true},
        {.from = {0, -0.03f, 0}, .to = {-0.045f, 0, 0}},
        {.vein = true, .from = {0, -0.08f, 0.02f}, .to = {0, 0.01f, 0.02f}}};
    VesselsParams params = organ(&shape, 300);
    params.great = great;
    params.great_count = 4;
    OutTree *tree = grow(&params, 1, 1.0f);
    for (int i = 0; i < 4; i++) { // they begin and end where they were placed
        int32_t colony = great[i].vein ? VESSELS_VEINS : VESSELS_ARTERIES;
        assert_true(distance_to(tree, colony, great[i].to) < 1e-6f);
        assert_true(distance_to(tree, colony, great[i].from) < (i % 3 == 0 ? 1e-6f : 2e-3f));
    }
    // half way along the curve: (from + 2 by + to) / 4
    assert_true(distance_to(tree, VESSELS_ARTERIES, vec3(0.02375f, 0, 0)) < 2e-3f);
    int roots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        roots += tree->parent[i] < 0;
    }
    assert_int_equal(roots, 2);
    assert_true(count_terminals(tree, VESSELS_ARTERIES) > 100);
    OutTree *same = grow(&params, 2, 1.0f);
    assert_true(out_tree_hash(same) == out_tree_hash(tree));
    out_tree_free(same);
    out_tree_free(tree);
}

static void note_warning(void *user, const char *message)
{
    snprintf(user, 400, "%s", message);
}

static void great_vessels_that_touch_are_told(void **state)
{
    (void)state;
    for (int touching = 0; touching < 2; touching++) {
        Shape shape = organ_shape(0.05f);
        float aside = touching ? 0.0005f : 0.02f;
        GreatVessel great[] = {
            {.from = {0, -0.08f, 0}, .to = {0, -0.01f, 0}},
            {.vein = true, .from = {aside, -0.08f, 0}, .to = {aside, -0.01f, 0}}};
        VesselsParams params = organ(&shape, 60);
        params.great = great;
        params.great_count = 2;
        char heard[400] = "";
        Run run = run_default();
        run.warn = note_warning;
        run.user = heard;
        Recipe recipe = {.seed = 8, .label = "object 'test'", .run = &run};
        OutTree *tree = grow_kind(&kind_vessels, &params, &recipe, 1.0f, NULL);
        assert_non_null(tree);
        assert_true((strstr(heard, "great vessels of arteries and veins touch") != NULL) ==
                    touching);
        out_tree_free(tree);
    }
}

// Flow of the root, its orders: measures of the whole kind.
static void flow_is_measured(void **state)
{
    (void)state;
    Shape shape = organ_shape(0.04f);
    VesselsParams params = organ(&shape, 1000);
    params.flow.velocity = 0.3f;
    OutTree *tree = grow(&params, 2, 1.0f);
    Grown grown = grown_of(tree);
    Run run = run_default();
    Recipe recipe = {.seed = 8, .label = "object 'test'", .run = &run};
    MeasureList list = {0};
    assert_true(vessels_measure(&params, &grown, &recipe, &list, NULL));
    double r = (double)tree->radius[0], inflow = 0.3 * 3.14159265358979 * r * r * 6e7;
    assert_true(fabs(measures_find(&list, "artery_inflow")->value / inflow - 1.0) < 1e-5);
    assert_true(measures_find(&list, "vein_pressure_drop")->value > 0.0);
    double low = measures_find(&list, "artery_wall_shear_low")->value;
    assert_true(low > 0.0 && low < measures_find(&list, "artery_wall_shear_high")->value);
    assert_true(measures_find(&list, "artery_orders")->value >= 4.0);
    assert_true(measures_find(&list, "artery_order_number")->value > 2.0);
    assert_true(measures_find(&list, "vein_order_diameter")->value > 1.2);
    assert_true(measures_find(&list, "vein_segments_in_series")->value >= 1.0);
    measures_clear(&list);
    out_tree_free(tree);
}

// Cosine between the vessel that arrives at the node nearest to `place` and the one that leaves it
// toward `to`.
static float leaving_cosine(const OutTree *tree, Vec3 place, Vec3 to)
{
    float best = -1.0f;
    int64_t origin = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (vec3_distance(tree->position[i], place) <
            vec3_distance(tree->position[origin], place)) {
            origin = i;
        }
    }
    Vec3 along = vec3_sub(tree->position[origin], tree->position[tree->parent[origin]]);
    float straightest = -1.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 way = vec3_sub(tree->position[i], tree->position[origin]);
        float aside = vec3_dot(vec3_normalize(way), vec3_normalize(vec3_sub(to, place)));
        if (tree->parent[i] == origin && aside > straightest) {
            straightest = aside;
            best = vec3_dot(vec3_normalize(along), vec3_normalize(way));
        }
    }
    return best;
}

// A vessel that leaves another at a right angle turns off over its sweep: it begins in the other's
// direction and still ends where it is to.
static void swept_vessels_leave_with_the_flow(void **state)
{
    (void)state;
    Shape shape = organ_shape(0.1f);
    for (int swept = 0; swept < 2; swept++) {
        GreatVessel great[] = {{.from = vec3(-0.15f, 0, 0), .to = vec3(0.06f, 0, 0)},
                               {.from = vec3(-0.03f, 0, 0), .to = vec3(-0.03f, 0.05f, 0)}};
        great[1].sweep = swept ? 0.03f : 0.0f;
        VesselsParams params = organ(&shape, 40);
        params.veins = false;
        params.turn = false;
        params.great = great;
        params.great_count = 2;
        OutTree *tree = grow(&params, 1, 1.0f);
        float cosine = leaving_cosine(tree, great[1].from, great[1].to);
        if (swept) {
            assert_true(cosine > 0.95f);
        } else {
            assert_true(fabsf(cosine) < 0.3f);
        }
        assert_true(distance_to(tree, VESSELS_ARTERIES, great[1].to) < 1e-6f);
        out_tree_free(tree);
    }
}

// The arch of a body's aorta gives off the brachiocephalic, from which right arm and carotid come,
// then the left carotid, then the left arm's vessel: two of the three are on the left.
static void a_bodys_arch_has_three_branches(void **state)
{
    (void)state;
    Shape shape = {.kind = SHAPE_BODY, .size = vec3(1, 1, 1), .transform = transform_identity()};
    OutTree *tree = out_tree_new(NULL);
    assert_true(vessels_plant_great(tree, &shape, VESSELS_ARTERIES, 1, NULL));
    int branches = 0, left = 0;
    for (int64_t i = 1; i < tree->count; i++) {
        Vec3 p = tree->position[tree->parent[i]];
        bool arch = tree->parent[i] != i - 1 && fabsf(p.x - 0.008f) < 0.008f && p.y > 0.75f;
        branches += arch;
        int64_t end = i; // far enough along the branch to tell its side
        while (arch && end + 1 < tree->count && end < i + 8 && tree->parent[end + 1] == end) {
            end++;
        }
        left += arch && tree->position[end].x > p.x;
    }
    assert_int_equal(branches, 3);
    assert_int_equal(left, 2);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arteries_and_veins_fill_the_organ_apart),
        cmocka_unit_test(terminals_of_both_meet),
        cmocka_unit_test(size_threads_and_time_change_nothing_else),
        cmocka_unit_test(a_body_is_supplied_to_its_ends),
        cmocka_unit_test(a_bodys_hands_and_feet_are_filled),
        cmocka_unit_test(a_hollow_organ_is_filled),
        cmocka_unit_test(skins_and_curves_come_out_of_both),
        cmocka_unit_test(few_terminals_leave_both_trees),
        cmocka_unit_test(growth_starts_from_placed_vessels),
        cmocka_unit_test(great_vessels_that_touch_are_told),
        cmocka_unit_test(flow_is_measured),
        cmocka_unit_test(swept_vessels_leave_with_the_flow),
        cmocka_unit_test(a_bodys_arch_has_three_branches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
