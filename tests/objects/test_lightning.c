#include "base/random.h"
#include "making.h"
#include "objects/lightning/lightning.h"
#include "outtree/chains.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static OutTree *grow_to(const LightningParams *params, uint64_t seed, float share, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *tree = grow_kind(&kind_lightning, params,
                              &(Recipe){.seed = seed, .label = "bolt", .run = &run}, share, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static OutTree *grow(const LightningParams *params, uint64_t seed)
{
    return grow_to(params, seed, 1.0f, 1);
}

static int64_t find_node_at(const OutTree *tree, Vec3 p)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (vec3_distance(tree->position[i], p) < 0.01f) {
            return i;
        }
    }
    return -1;
}

static void the_main_channel_runs_from_cloud_to_strike(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        LightningParams params = lightning_params_default();
        params.position = vec3(300, 5, -40);
        params.lean = 0.0f;
        OutTree *tree = grow(&params, seed);
        float core = lightning_radius(&params, tree);
        assert_true(vec3_distance(tree->position[0], vec3(300, 1005, -40)) < 0.01f);
        int64_t node = find_node_at(tree, params.position);
        assert_true(node >= 0);
        int64_t main = 0;
        for (; node >= 0; node = tree->parent[node], main++) {
            assert_float_equal(tree->radius[node], core, 1e-4f);
        }
        int64_t thick = 0;
        for (int64_t i = 0; i < tree->count; i++) {
            thick += tree->radius[i] > 0.75f * core; // all others are dimmer and thinner
        }
        assert_int_equal(thick, main);
        assert_true(main > 300 && tree->count > 2 * main);
        out_tree_free(tree);
    }
}

static void side_branches_go_down_and_fade(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    params.lean = 0.0f;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        OutTree *tree = grow(&params, seed);
        ChainSet *chains = out_tree_chains(tree, NULL);
        for (int64_t c = 1; c < chains->count; c++) {
            const int32_t *node = chains->node + chains->first[c];
            int64_t count = chains->first[c + 1] - chains->first[c];
            int32_t from = node[0], to = node[count - 1];
            Vec3 way = vec3_sub(tree->position[to], tree->position[from]);
            // growth keeps within 60 degrees of straight down; short twigs may wander a bit further
            assert_true(vec3_length(way) < 30.0f || way.y < -0.2f * vec3_length(way));
            for (int64_t k = 2; k < count; k++) {
                assert_true(tree->radius[node[k]] <= tree->radius[node[k - 1]]);
            }
        }
        assert_true(chains->count > 20);
        chains_free(chains);
        out_tree_free(tree);
    }
}

// A node's share of the main channel's power, from its radius.
static double power_share(const LightningParams *params, const OutTree *tree, int64_t node)
{
    double thin = (double)(tree->radius[node] / lightning_radius(params, tree));
    return pow(thin, 1.0 / (double)params->taper);
}

// With all of the channels beyond it, a branch's power falls at forks and toward tips, whatever the
// exponent of its radius. A drain of 0.25 and more of the bolt's 1,000 m.
static void check_drain(float drain, int least_graded, int least_full)
{
    LightningParams params = lightning_params_default();
    params.lean = 0.0f;
    params.taper = 0.11f;
    params.drain *= drain;
    OutTree *tree = grow(&params, 2);
    double *beyond = calloc((size_t)tree->count, sizeof *beyond);
    int graded = 0, full = 0;
    for (int64_t i = tree->count - 1; i > 0; i--) {
        int32_t parent = tree->parent[i];
        double length = (double)vec3_distance(tree->position[i], tree->position[parent]);
        beyond[parent] += beyond[i] + length;
    }
    for (int64_t i = 1; i < tree->count; i++) {
        double share = power_share(&params, tree, i), drained = beyond[i] / (250.0 * (double)drain);
        drained = fmin(fmax(drained, 0.02), 1.0);
        if (share > 0.99) { // the main channel
            continue;
        }
        assert_true(fabs(share - 0.2 * drained) < 0.002);
        graded += drained > 0.05 && drained < 0.95;
        full += drained == 1.0;
    }
    assert_true(graded > least_graded && full > least_full);
    free(beyond);
    out_tree_free(tree);
}

static void branches_drain_what_lies_beyond(void **state)
{
    (void)state;
    check_drain(1.0f, 200, 20);
    check_drain(3.0f, 100, -1);
}

static void the_same_seed_gives_the_same_bolt_for_any_threads(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    OutTree *one = grow_to(&params, 4, 1.0f, 1), *two = grow_to(&params, 4, 1.0f, 2);
    OutTree *three = grow_to(&params, 4, 1.0f, 3), *other = grow(&params, 5);
    assert_true(out_tree_hash(one) == out_tree_hash(two));
    assert_true(out_tree_hash(one) == out_tree_hash(three));
    assert_true(out_tree_hash(one) != out_tree_hash(other));
    out_tree_free(one);
    out_tree_free(two);
    out_tree_free(three);
    out_tree_free(other);
}

// Eight times the size changes no bit but exponents; ten times, only what rounding changes.
static void a_larger_bolt_has_the_same_form(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    OutTree *small = grow(&params, 7);
    params.height *= 8.0f;
    OutTree *large = grow(&params, 7);
    assert_int_equal(large->count, small->count);
    assert_memory_equal(large->parent, small->parent, sizeof(int32_t) * (size_t)small->count);
    for (int64_t i = 0; i < small->count; i++) {
        assert_true(vec3_distance(large->position[i], vec3_scale(small->position[i], 8.0f)) < 0.1f);
        assert_float_equal(large->radius[i], 8.0f * small->radius[i], 1e-4f);
    }
    out_tree_free(large);
    params.height *= 10.0f / 8.0f;
    large = grow(&params, 7);
    double ratio = (double)large->count / (double)small->count;
    assert_true(ratio > 0.9 && ratio < 1.1);
    Aabb a = out_tree_bounds(small), b = out_tree_bounds(large);
    Vec3 x = vec3_sub(a.high, a.low), y = vec3_sub(b.high, b.low);
    assert_true(fabsf(y.x / x.x - 10.0f) < 1.0f && fabsf(y.y / x.y - 10.0f) < 0.1f);
    out_tree_free(large);
    out_tree_free(small);
}

static void a_leader_is_dim_until_it_strikes(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    float lowest = 1000.0f;
    for (int i = 1; i <= 4; i++) {
        OutTree *tree = grow_to(&params, 3, 0.25f * (float)i, 1);
        float core = lightning_radius(&params, tree), thickest = 0.0f;
        float bottom = out_tree_bounds(tree).low.y;
        for (int64_t k = 0; k < tree->count; k++) {
            thickest = fmaxf(thickest, tree->radius[k]);
        }
        assert_true(bottom < lowest - 50.0f); // it comes down step by step
        assert_true(i == 4 ? thickest == core : thickest < 0.7f * core);
        lowest = bottom;
        out_tree_free(tree);
    }
    out_tree_free(grow_to(&params, 3, 0.0f, 1));
}

static void flashes_fork_and_stand_side_by_side(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    params.bolts = 3;
    params.ground_points = 2;
    params.streamers = 2;
    OutTree *tree = grow(&params, 2);
    int roots = 0, streamers = 0, ends = 0;
    ChainSet *chains = out_tree_chains(tree, NULL);
    for (int64_t c = 0; c < chains->count; c++) {
        int32_t tip = chains->node[chains->first[c + 1] - 1];
        bool streamer = tree->colony[tip] >= params.bolts;
        roots += chains->parent[c] < 0 && !streamer;
        streamers += chains->parent[c] < 0 && streamer;
        ends += tree->radius[tip] == lightning_radius(&params, tree);
        if (chains->parent[c] < 0 && streamer) { // rises from the ground
            int32_t foot = chains->node[chains->first[c]];
            assert_true(fabsf(tree->position[foot].y) < 0.01f);
            assert_true(tree->position[tip].y > 15.0f);
        }
    }
    assert_int_equal(roots, 3);
    assert_int_equal(streamers, 6);
    assert_int_equal(ends, 6);
    chains_free(chains);
    out_tree_free(tree);
}

// Means over several bolts are in nature's ranges.
static void bolts_measure_as_photographs_do(void **state)
{
    (void)state;
    enum { BOLTS = 10 };
    double turning = 0.0, dimension = 0.0;
    LightningParams params = lightning_params_default();
    for (uint64_t seed = 1; seed <= BOLTS; seed++) {
        OutTree *tree = grow(&params, seed);
        MeasureList list = {0};
        Grown grown = grown_of(tree);
        assert_true(lightning_measure(&params, &grown, NULL, &list, NULL));
        turning += measures_find(&list, "channel_turning")->value / BOLTS;
        dimension += measures_find(&list, "seen_dimension")->value / BOLTS;
        measures_clear(&list);
        out_tree_free(tree);
    }
    assert_true(turning > 15.5 && turning < 17.5); // Hill (1968): 16 to 17 degrees
    assert_true(dimension > 1.27 && dimension < 1.43);
}

// A staircase of right angles turns by 90 degrees a step when seen from the front, a straight one
// by nothing.
static void turning_is_measured_on_known_ways(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    for (int zigzag = 0; zigzag < 2; zigzag++) {
        OutTree *tree = out_tree_new(NULL);
        Vec3 p = vec3(0, 1000, 0);
        for (int i = 0; i <= 60; i++) {
            out_tree_add_node(tree, p, i - 1, i, 0, (uint64_t)i, NULL);
            tree->radius[i] = 1.0f;
            p = zigzag && i % 2 ? vec3_add(p, vec3(20, 0, 0)) : vec3_add(p, vec3(0, -20, 0));
        }
        MeasureList list = {0};
        Grown grown = grown_of(tree);
        assert_true(lightning_measure(&params, &grown, NULL, &list, NULL));
        double turning = measures_find(&list, "channel_turning")->value;
        // views of 0, 45, 90 and 135 degrees: 90, 90, none seen, 90, of the turns seen
        assert_true(zigzag ? turning > 60.0 && turning < 91.0 : turning < 0.01);
        assert_true(fabs(measures_find(&list, "seen_dimension")->value - 1.0) < 0.12);
        measures_clear(&list);
        out_tree_free(tree);
    }
}

static void discharges_stay_over_their_surface(void **state)
{
    (void)state;
    Shape shapes[2] = {{.kind = SHAPE_SPHERE, .transform = transform_identity()},
                       {.kind = SHAPE_BOX, .size = {0.4f, 1.6f, 0.4f}}};
    shapes[1].transform = transform_identity();
    for (int count = 1; count <= 2; count++) {
        LightningParams params = lightning_params_default();
        params.element.points.place = SCATTER_SURFACE;
        params.element.shapes = shapes;
        params.element.shape_count = count;
        params.bolts = 2;
        params.lift = 1e-5f; // what lies off the surface then is the growth's own error
        OutTree *tree = grow(&params, 6);
        EnvelopeParams shape = {.shapes = shapes, .shape_count = count, .voxel = 0.0f};
        Run run = run_default();
        Envelope *envelope = envelope_new(&shape, &run, NULL);
        // a sphere is known exactly, a level set to a share of its voxels of 25 mm
        float tolerance = count == 1 ? 1e-5f : 0.004f;
        for (int64_t i = 0; i < tree->count; i++) {
            float height = envelope_distance(envelope, tree->position[i]);
            assert_true(fabsf(height - params.lift) < tolerance);
        }
        assert_true(tree->count > 1500);
        envelope_free(envelope);
        OutTree *again = grow_to(&params, 6, 1.0f, 3);
        assert_true(out_tree_hash(again) == out_tree_hash(tree));
        out_tree_free(again);
        out_tree_free(tree);
    }
}

static void the_glow_carries_the_power_at(float taper)
{
    LightningParams params = lightning_params_default();
    params.power = 5000.0f;
    params.taper = taper;
    OutTree *tree = grow(&params, 1);
    Geometry geometry = {0};
    float luminance = 0.8f, core = lightning_radius(&params, tree), brightest = 0.0f;
    float dimmest = 5000.0f;
    const Material material = {.radiance = vec3_splat(luminance)};
    Placing placing = placing_in(&geometry, NULL);
    placing.around.material = &material;
    Grown grown = grown_of(tree);
    assert_true(lightning_geometry(&params, &grown, &placing, NULL));
    assert_int_equal(geometry.count, 1);
    const CurveSet *curves = geometry.part[0].curves;
    for (int64_t i = 0; i < curves->point_count; i++) {
        assert_true(curves->glow[i] > 0.0f && curves->radius[i] > 0.0f);
        assert_true(curves->radius[i] <= core);
        brightest = fmaxf(brightest, curves->glow[i]);
        float power = PI_F * luminance * curves->glow[i] * 2.0f * PI_F * curves->radius[i];
        // a branch has a fifth of the power, its tip a fiftieth of that
        assert_true(power > 5000.0f * 0.2f * 0.0199f && power < 5001.0f);
        dimmest = fminf(dimmest, power);
    }
    assert_float_equal(dimmest, 5000.0f * 0.2f * 0.02f, 0.5f);
    // a cylinder sends out pi times its radiance from each of 2 pi r square metres a metre
    assert_float_equal(PI_F * luminance * brightest * 2.0f * PI_F * core, 5000.0f, 1.0f);
    assert_int_equal(curves->first[curves->curve_count], curves->point_count);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static void the_glow_carries_the_power(void **state)
{
    (void)state;
    the_glow_carries_the_power_at(1.0f / 3.0f);
    the_glow_carries_the_power_at(0.1f);
    the_glow_carries_the_power_at(1.0f);
}

static void cancelled_growth_says_so(void **state)
{
    (void)state;
    LightningParams params = lightning_params_default();
    int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    Error e = {0};
    assert_null(grow_kind(&kind_lightning, &params,
                          &(Recipe){.seed = 1, .label = "bolt", .run = &run}, 1.0f, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_main_channel_runs_from_cloud_to_strike),
        cmocka_unit_test(side_branches_go_down_and_fade),
        cmocka_unit_test(branches_drain_what_lies_beyond),
        cmocka_unit_test(the_same_seed_gives_the_same_bolt_for_any_threads),
        cmocka_unit_test(a_larger_bolt_has_the_same_form),
        cmocka_unit_test(a_leader_is_dim_until_it_strikes),
        cmocka_unit_test(flashes_fork_and_stand_side_by_side),
        cmocka_unit_test(bolts_measure_as_photographs_do),
        cmocka_unit_test(turning_is_measured_on_known_ways),
        cmocka_unit_test(discharges_stay_over_their_surface),
        cmocka_unit_test(the_glow_carries_the_power),
        cmocka_unit_test(cancelled_growth_says_so),
    };
    return cmocka_run_group_tests_name("lightning", tests, NULL, NULL);
}
