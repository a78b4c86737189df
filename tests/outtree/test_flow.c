// Flow by Poiseuille's law against closed forms: one tube, forks, conservation, power.
#include "base/random.h"
#include "outtree/flow.h"
#include "testing.h"

#include <math.h>

#define PI 3.14159265358979323846

#define assert_near(a, b, relative) \
    assert_true(fabs((double)(a) - (double)(b)) <= (relative)*fabs((double)(b)))

static int64_t add(OutTree *tree, Vec3 p, int64_t parent, float radius)
{
    int64_t node = out_tree_add_node(tree, p, parent, 0, 0, (uint64_t)tree->count, NULL);
    assert_true(node >= 0);
    tree->radius[node] = radius;
    return node;
}

static Flow flow_of(const OutTree *tree, const FlowParams *params)
{
    Flow flow;
    Error e = {0};
    if (!flow_init(&flow, tree, params, &e)) {
        fail_msg("%s", e.message);
    }
    return flow;
}

static void one_tube_obeys_poiseuille(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    const float radius = 1e-3f;
    int64_t node = add(tree, vec3(0, 0, 0), -1, radius);
    for (int i = 1; i <= 5; i++) {
        node = add(tree, vec3(0, 0.01f * (float)i, 0), node, radius);
    }
    FlowParams params = flow_params_default();
    Flow flow = flow_of(tree, &params);
    double r = (double)radius, q = 0.2 * PI * r * r, mu = 3.5e-3;
    assert_near(flow.flow[5], q, 1e-6);
    assert_near(flow.pressure[0] - flow.pressure[5], 8.0 * mu * 0.05 * q / (PI * r * r * r * r),
                1e-6);
    assert_near(flow_wall_shear(flow.viscosity[5], flow.flow[5], r), 4.0 * mu * 0.2 / r,
                1e-6); // 4 mu v / r
    flow_free(&flow);
    params.returning = 0; // the same tube as a vein
    flow = flow_of(tree, &params);
    assert_near(flow.pressure[5] - flow.pressure[0], 8.0 * mu * 0.05 * q / (PI * r * r * r * r),
                1e-6);
    assert_near(flow.pressure[0], 700.0, 1e-6);
    flow_free(&flow);
    out_tree_free(tree);
}

// A mother, 20 mm, with two daughters of 10 and 30 mm, of radii 2, 1 and 1 mm.
static OutTree *fork_tree(float second_radius)
{
    OutTree *tree = out_tree_new(NULL);
    add(tree, vec3(0, 0, 0), -1, 2e-3f);
    add(tree, vec3(0, 0.02f, 0), 0, 2e-3f);
    add(tree, vec3(0.01f, 0.02f, 0), 1, 1e-3f);
    add(tree, vec3(-0.03f, 0.02f, 0), 1, second_radius);
    return tree;
}

static void forks_divide_the_flow(void **state)
{
    (void)state;
    OutTree *tree = fork_tree(1e-3f);
    FlowParams params = flow_params_default();
    Flow flow = flow_of(tree, &params);
    assert_near(flow.flow[2], 3.0 * flow.flow[3], 1e-6); // a third of the resistance
    assert_near(flow.pressure[2], flow.pressure[3], 1e-12);
    assert_near(flow.flow[2] + flow.flow[3], flow.flow[1], 1e-12);
    flow_free(&flow);
    params.ends = FLOW_EQUAL_FLOW;
    flow = flow_of(tree, &params);
    assert_near(flow.flow[2], 0.5 * flow.flow[0], 1e-12);
    assert_near(flow.flow[3], 0.5 * flow.flow[0], 1e-12);
    assert_near((flow.pressure[1] - flow.pressure[3]) / (flow.pressure[1] - flow.pressure[2]), 3.0,
                1e-5);
    flow_free(&flow);
    out_tree_free(tree);
    tree = fork_tree(0.5e-3f); // 3 times as long, half as wide: 48 times the resistance
    params.ends = FLOW_EQUAL_PRESSURE;
    flow = flow_of(tree, &params);
    assert_near(flow.flow[2] / flow.flow[3], 48.0, 1e-5);
    flow_free(&flow);
    out_tree_free(tree);
}

// Any tree: flow in = flow out, ends at one pressure, the power put in is that lost in the tubes.
static void flow_and_power_are_conserved(void **state)
{
    (void)state;
    enum { NODES = 2000 };
    OutTree *tree = out_tree_new(NULL);
    add(tree, vec3(0, 0, 0), -1, 3e-3f);
    for (int i = 1; i < NODES; i++) {
        uint64_t key = random_key(5, (uint64_t)i);
        int64_t parent = (int64_t)(random_key(key, 1) % (uint64_t)i);
        Vec3 way = vec3(1e-3f * (float)(random_key(key, 2) % 97), 1e-4f, 2e-3f);
        add(tree, vec3_add(tree->position[parent], way), parent,
            1e-5f * (float)(20 + random_key(key, 3) % 180));
    }
    FlowParams params = flow_params_default();
    params.viscosity = FLOW_MEASURED;
    Flow flow = flow_of(tree, &params);
    double out[NODES] = {0}, lost = 0.0, end = NAN;
    for (int i = 1; i < NODES; i++) {
        int32_t parent = tree->parent[i];
        out[parent] += flow.flow[i];
        lost += flow.flow[i] * (flow.pressure[parent] - flow.pressure[i]);
    }
    for (int i = 0; i < NODES; i++) {
        if (out[i] > 0.0) {
            assert_near(out[i], flow.flow[i], 1e-9);
        } else {
            end = isnan(end) ? flow.pressure[i] : end;
            assert_near(flow.pressure[0] - flow.pressure[i], flow.pressure[0] - end, 1e-9);
        }
    }
    assert_near(lost, flow.flow[0] * (flow.pressure[0] - end), 1e-9);
    flow_free(&flow);
    out_tree_free(tree);
}

// Cubes of the radii add up and all ends are alike: then the shear is the same everywhere.
static void murrays_tree_has_one_wall_shear(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    add(tree, vec3(0, 0, 0), -1, 0);
    for (int64_t i = 1; i < 200; i++) { // combs and fans
        int64_t parent = i % 3 == 0 ? i / 3 : i - 1;
        add(tree, vec3(0.01f * (float)i, 0.002f * (float)(i % 7), 0), parent, 0);
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) { // the sum of the cubes is the number of ends
        float ends = tree->radius[i] > 0.0f ? tree->radius[i] : 1.0f;
        if (i > 0) {
            tree->radius[tree->parent[i]] += ends;
        }
        tree->radius[i] = 1e-4f * cbrtf(ends);
    }
    FlowParams params = flow_params_default();
    params.ends = FLOW_EQUAL_FLOW;
    Flow flow = flow_of(tree, &params);
    double first = flow_wall_shear(flow.viscosity[1], flow.flow[1], (double)tree->radius[1]);
    for (int64_t i = 2; i < tree->count; i++) {
        assert_near(flow_wall_shear(flow.viscosity[i], flow.flow[i], (double)tree->radius[i]),
                    first, 1e-5);
    }
    flow_free(&flow);
    out_tree_free(tree);
}

// Pries 1994 by the C library, and the limits that the law must have.
static void viscosity_is_as_measured(void **state)
{
    (void)state;
    FlowParams params = flow_params_default();
    params.viscosity = FLOW_MEASURED;
    for (double d = 4.0; d < 2000.0; d *= 1.7) {
        double c = 1.0 / (1.0 + 1e-11 * pow(d, 12.0));
        c = (0.8 + exp(-0.075 * d)) * (c - 1.0) + c;
        double h = pow(0.7, c) - 1.0, h45 = pow(0.55, c) - 1.0, wall = pow(d / (d - 1.1), 2.0);
        double at_45 = 6.0 * exp(-0.085 * d) + 3.2 - 2.44 * exp(-0.06 * pow(d, 0.645));
        params.hematocrit = 0.3f;
        assert_near(flow_viscosity(&params, 0.5e-6 * d),
                    1.2e-3 * (1.0 + (at_45 - 1.0) * h / h45 * wall) * wall, 1e-5);
    }
    params.hematocrit = 0.45f; // wide vessels: 3.2 times plasma
    assert_near(flow_viscosity(&params, 5e-3), 3.2 * 1.2e-3, 2e-3);
    params.hematocrit = 0.0f; // plasma alone
    assert_near(flow_viscosity(&params, 5e-3), 1.2e-3, 1e-3);
    params.hematocrit = 0.45f; // capillaries are more viscous in vivo than arterioles
    assert_true(flow_viscosity(&params, 3e-6) > 2.0 * flow_viscosity(&params, 20e-6));
    params.viscosity = FLOW_CONSTANT;
    assert_true(flow_viscosity(&params, 3e-6) == 3.5e-3);
}

static void vessels_need_a_radius(void **state)
{
    (void)state;
    OutTree *tree = fork_tree(0.0f);
    FlowParams params = flow_params_default();
    Flow flow;
    Error e = {0};
    assert_false(flow_init(&flow, tree, &params, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_tube_obeys_poiseuille),
        cmocka_unit_test(forks_divide_the_flow),
        cmocka_unit_test(flow_and_power_are_conserved),
        cmocka_unit_test(murrays_tree_has_one_wall_shear),
        cmocka_unit_test(viscosity_is_as_measured),
        cmocka_unit_test(vessels_need_a_radius),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
