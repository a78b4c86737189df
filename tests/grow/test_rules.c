// The rules beyond the mean: sectors, snapping, growth on a surface, apical dominance; and that an
// edit stays where it was made.
#include "grow/growth_fixture.h"

#include "base/exact_math.h"

static Vec3 heading_of(const OutTree *tree, int64_t node)
{
    return vec3_normalize(vec3_sub(tree->position[node], tree->position[tree->parent[node]]));
}

static float angle_between(Vec3 a, Vec3 b)
{
    return exact_atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b)) / RADIANS_PER_DEGREE;
}

static float distance_to_multiple(float degrees, float angle)
{
    float rest = degrees / angle;
    rest -= (float)(int)(rest + 0.5f);
    return fabsf(rest) * angle;
}

static void sectors_on_a_plane_make_children_at_their_axes(void **state)
{
    (void)state;
    PointSet *points = points_on_plane(3000, 3);
    ColonizeParams params = params_auto(points, 0.55f, 1.1f, 3.2f);
    params.rule = GROW_SECTORS;
    params.on_surface = true;
    params.sector_axis = true;
    params.max_angle = 90.0f;
    OutTree *tree = tree_from(vec3(-1, 0, 0));
    out_tree_add_node(tree, vec3(-0.99f, 0, 0), 0, 0, 0, out_tree_child_id(77, 0), NULL);
    grow_with(tree, points, &params, 1);
    assert_true(tree->count > 500);
    int sides = 0;
    for (int64_t i = 2; i < tree->count; i++) {
        if (tree->parent[i] < 1) {
            continue;
        }
        float degrees = angle_between(heading_of(tree, i), heading_of(tree, tree->parent[i]));
        assert_true(degrees < 61.0f);
        assert_true(distance_to_multiple(degrees, 60.0f) < 0.5f);
        assert_float_equal(tree->position[i].y, 0.0f, 1e-6f);
        sides += degrees > 30.0f;
    }
    assert_true(sides > 100);
    out_tree_free(tree);
    points_free(points);
}

static void a_nucleus_makes_a_six_armed_star(void **state)
{
    (void)state;
    PointSet *points = points_on_plane(4000, 4);
    ColonizeParams params = params_auto(points, 0.55f, 1.1f, 3.2f);
    params.rule = GROW_SECTORS;
    params.on_surface = true;
    params.sector_axis = true;
    OutTree *tree = tree_from(vec3(0, 0, 0));
    grow_with(tree, points, &params, 1);
    int arms = 0;
    for (int64_t i = 1; i < tree->count; i++) {
        arms += tree->parent[i] == 0;
    }
    assert_int_equal(arms, 6);
    out_tree_free(tree);
    points_free(points);
}

static void sectors_in_space_grow_once_each(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(4000, 4);
    ColonizeParams params = params_auto(points, 0.5f, 1.0f, 4.0f);
    params.rule = GROW_SECTORS;
    params.sector_axis = true;
    params.sector_angle = 45.0f;
    OutTree *tree = tree_from(vec3(0, -1, 0));
    grow_with(tree, points, &params, 2);
    assert_true(tree->count > 500);
    for (int64_t i = 2; i < tree->count; i++) {
        if (tree->parent[tree->parent[i]] < 0) {
            continue;
        }
        float degrees = angle_between(heading_of(tree, i), heading_of(tree, tree->parent[i]));
        assert_true(distance_to_multiple(degrees, 45.0f) < 0.5f);
        for (int64_t j = i + 1; j < tree->count; j++) {
            assert_true(tree->parent[i] != tree->parent[j] ||
                        vec3_distance(tree->position[i], tree->position[j]) > 0.1f * params.step);
        }
    }
    params.sector_angle = 3.0f;
    Run run = run_default();
    Error e = {0};
    assert_false(colonize(tree, points, &params, &run, NULL, &e));
    assert_string_equal(e.message, "sector angle 3 makes more than 64 sectors; use a larger angle");
    out_tree_free(tree);
    points_free(points);
}

static void snapping_makes_nodes_of_attractors(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(1500, 7);
    ColonizeParams params = params_auto(points, 0.5f, 0.3f, 4.0f);
    params.rule = GROW_SNAP;
    OutTree *tree = tree_from(vec3(0, -1, 0));
    GrowReport report = grow_with(tree, points, &params, 2);
    assert_true(report.new_nodes > 1000);
    assert_int_equal(report.attractors_left, 0);
    bool *used = calloc((size_t)points->count, sizeof *used);
    for (int64_t i = 1; i < tree->count; i++) {
        int64_t a = 0;
        while (a < points->count &&
               memcmp(&points->position[a], &tree->position[i], sizeof(Vec3)) != 0) {
            a++;
        }
        assert_true(a < points->count);
        assert_false(used[a]);
        used[a] = true;
        float length = vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
        assert_true(length >= params.kill && length < params.influence);
    }
    free(used);
    out_tree_free(tree);
    points_free(points);
}

static void surface_growth_stays_on_the_surface(void **state)
{
    (void)state;
    PointSet *points = points_on_sphere(6000, 11);
    ColonizeParams params = params_auto(points, 0.5f, 1.2f, 4.0f);
    params.on_surface = true;
    params.noise = 0.1f;
    params.max_children = 2;
    OutTree *tree = tree_from(vec3(0, -1, 0));
    tree->normal[0] = vec3(0, -1, 0);
    grow_with(tree, points, &params, 1);
    assert_true(tree->count > 1500);
    for (int64_t i = 0; i < tree->count; i++) {
        assert_float_equal(vec3_length(tree->position[i]), 1.0f, 0.4f * params.step);
        assert_true(vec3_dot(tree->normal[i], vec3_normalize(tree->position[i])) > 0.98f);
        assert_float_equal(vec3_length(tree->normal[i]), 1.0f, 1e-5f);
    }
    out_tree_free(tree);
    points_free(points);
}

static void normals_in_space_lie_across_the_direction(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(1000, 11);
    ColonizeParams params = params_auto(points, 0.5f, 1.2f, 4.0f);
    OutTree *tree = tree_from(vec3(0, -1, 0));
    grow_with(tree, points, &params, 1);
    for (int64_t i = 1; i < tree->count; i++) {
        assert_float_equal(vec3_dot(tree->normal[i], heading_of(tree, i)), 0.0f, 1e-4f);
        assert_float_equal(vec3_length(tree->normal[i]), 1.0f, 1e-5f);
    }
    out_tree_free(tree);
    points_free(points);
}

static int64_t forks(const OutTree *tree)
{
    int64_t laterals = 0;
    int *children = calloc((size_t)tree->count, sizeof *children);
    for (int64_t i = 1; i < tree->count; i++) {
        laterals += children[tree->parent[i]]++ > 0;
    }
    free(children);
    return laterals;
}

static void apical_dominance_thins_out_laterals(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(3000, 13);
    ColonizeParams params = params_auto(points, 0.5f, 1.2f, 4.0f);
    int64_t count[3];
    for (int i = 0; i < 3; i++) {
        params.apical = 0.5f * (float)i;
        OutTree *tree = tree_from(vec3(0, -1, 0));
        grow_with(tree, points, &params, 1);
        count[i] = forks(tree);
        out_tree_free(tree);
    }
    assert_true(count[0] > 200);
    assert_true(count[1] < count[0] && count[1] > 20);
    assert_int_equal(count[2], 0);
    points_free(points);
}

static int64_t find_id(const OutTree *tree, uint64_t id)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->id[i] == id) {
            return i;
        }
    }
    return -1;
}

// Two colonies out of each other's reach: taking attractors from one leaves the other, noise and
// all, as it was, though every index in it moves.
static void an_edit_elsewhere_changes_nothing_here(void **state)
{
    (void)state;
    PointSet *both = points_empty(8.37758, 3), *edited = points_empty(8.37758, 3);
    PointSet *ball = points_in_ball(1500, 21);
    for (int64_t i = 0; i < ball->count; i++) {
        points_put(both, ball->position[i], vec3(0, 1, 0));
        if (i % 3 == 0) {
            points_put(edited, ball->position[i], vec3(0, 1, 0));
        }
    }
    for (int64_t i = 0; i < ball->count; i++) {
        Vec3 p = vec3_add(ball->position[i], vec3(5, 0, 0));
        points_put(both, p, vec3(0, 1, 0));
        points_put(edited, p, vec3(0, 1, 0));
    }
    ColonizeParams params = params_auto(both, 0.5f, 1.2f, 5.0f);
    params.noise = 0.3f;
    params.apical = 0.2f;
    OutTree *tree[2];
    for (int i = 0; i < 2; i++) {
        tree[i] = tree_from(vec3(0, -1, 0));
        out_tree_add_node(tree[i], vec3(5, -1, 0), -1, 0, 1, 99, NULL);
        grow_with(tree[i], i == 0 ? both : edited, &params, 1);
    }
    int64_t compared = 0, there = 0;
    for (int64_t i = 0; i < tree[0]->count; i++) {
        if (tree[0]->colony[i] == 1) {
            int64_t j = find_id(tree[1], tree[0]->id[i]);
            assert_true(j >= 0);
            assert_memory_equal(&tree[0]->position[i], &tree[1]->position[j], sizeof(Vec3));
            compared++;
        }
    }
    for (int64_t j = 0; j < tree[1]->count; j++) {
        there += tree[1]->colony[j] == 1;
    }
    assert_true(compared > 300);
    assert_int_equal(compared, there);
    assert_true(tree[0]->count - compared != tree[1]->count - there);
    out_tree_free(tree[0]);
    out_tree_free(tree[1]);
    points_free(both);
    points_free(edited);
    points_free(ball);
}

// Highest order in the tree, told from the angles of the sectors (60 degrees) or from who came
// first; a root's children have order 0.
static int highest_order(const OutTree *tree, bool by_angle)
{
    int *order = calloc((size_t)tree->count, sizeof *order), highest = 0;
    bool *has_child = calloc((size_t)tree->count, sizeof *has_child);
    assert_non_null(order);
    assert_non_null(has_child);
    for (int64_t i = 1; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool side = by_angle && tree->parent[parent] >= 0
                        ? angle_between(heading_of(tree, i), heading_of(tree, parent)) > 30.0f
                        : has_child[parent];
        has_child[parent] = true;
        order[i] = order[parent] + (side && tree->parent[parent] >= 0);
        highest = order[i] > highest ? order[i] : highest;
    }
    free(order);
    free(has_child);
    return highest;
}

static void orders_of_branching_are_limited(void **state)
{
    (void)state;
    PointSet *points = points_on_plane(3000, 3), *finer = points_on_plane(9000, 4);
    PointSet *finest = points_on_plane(27000, 5);
    ColonizeParams params = params_auto(points, 0.55f, 1.1f, 3.2f);
    params.on_surface = true;
    params.max_angle = 90.0f;
    for (int rule = 0; rule < 2; rule++) {
        params.rule = rule == 0 ? GROW_MEAN : GROW_SECTORS;
        params.sector_axis = rule == 1;
        for (int limit = 0; limit < 4; limit++) {
            params.max_order = limit;
            OutTree *tree = tree_from(vec3(-1, 0, 0));
            out_tree_add_node(tree, vec3(-0.99f, 0, 0), 0, 0, 0, out_tree_child_id(77, 0), NULL);
            grow_with(tree, points, &params, 1);
            int highest = highest_order(tree, rule == 1);
            assert_true(limit == 0 ? highest > 3 : highest == limit);
            // growth that goes on from a grown tree knows the orders in it
            ColonizeParams fine = params;
            fine.step *= 0.55f, fine.kill *= 0.55f, fine.influence *= 0.55f;
            grow_with(tree, finer, &fine, 1);
            assert_true(limit == 0 || highest_order(tree, rule == 1) == limit);
            fine.new_orders = true; // or is told to begin to count anew
            fine.step *= 0.55f, fine.kill *= 0.55f, fine.influence *= 0.55f;
            grow_with(tree, finest, &fine, 1);
            assert_true(limit == 0 || highest_order(tree, rule == 1) > limit);
            out_tree_free(tree);
        }
    }
    points_free(points);
    points_free(finer);
    points_free(finest);
}

static void no_child_leaves_the_cone(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(2000, 5);
    ColonizeParams params = params_auto(points, 0.5f, 1.2f, 4.0f);
    params.noise = 0.5f;
    Vec3 down = vec3(0, -1, 0);
    for (int limited = 0; limited < 2; limited++) {
        params.cone_axis = vec3(0, -3, 0);
        params.cone_angle = limited ? 70.0f : 0.0f;
        OutTree *tree = tree_from(vec3(0, 1, 0));
        grow_with(tree, points, &params, 1);
        assert_true(tree->count > 100);
        float widest = 0.0f;
        for (int64_t i = 1; i < tree->count; i++) {
            widest = fmaxf(widest, angle_between(heading_of(tree, i), down));
        }
        assert_true(limited ? widest < 70.1f && widest > 69.0f : widest > 100.0f);
        out_tree_free(tree);
    }
    points_free(points);
}

static void additive_mode_is_the_printed_formula(void **state)
{
    (void)state;
    PointSet *points = points_empty(1.0, 3);
    points_put(points, vec3(0, 1, 0), vec3(0, 1, 0));
    FieldParams field = field_params_default(FIELD_UNIFORM);
    field.vector = vec3(3, 0, 0);
    Run run = run_default();
    GuideField *uniform =
        guide_field_new(&field, 1, &(FieldSite){.bounds = aabb_empty()}, &run, NULL);
    ColonizeParams params = colonize_params_default();
    params.step = 0.1f, params.kill = 0.2f, params.influence = 2.0f;
    params.field = uniform;
    params.field_weight = 0.5f;
    params.field_mode = FIELD_ADDITIVE;
    params.max_steps = 1;
    OutTree *tree = tree_from(vec3(0, 0, 0));
    grow_with(tree, points, &params, 1);
    assert_float_equal(tree->position[1].x, 0.05f, 1e-6f);
    assert_float_equal(tree->position[1].y, 0.1f, 1e-6f);
    assert_float_equal(tree->position[1].z, 0.0f, 1e-6f);
    out_tree_free(tree);
    points_free(points);
    guide_field_free(uniform);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sectors_on_a_plane_make_children_at_their_axes),
        cmocka_unit_test(a_nucleus_makes_a_six_armed_star),
        cmocka_unit_test(sectors_in_space_grow_once_each),
        cmocka_unit_test(snapping_makes_nodes_of_attractors),
        cmocka_unit_test(surface_growth_stays_on_the_surface),
        cmocka_unit_test(normals_in_space_lie_across_the_direction),
        cmocka_unit_test(apical_dominance_thins_out_laterals),
        cmocka_unit_test(an_edit_elsewhere_changes_nothing_here),
        cmocka_unit_test(orders_of_branching_are_limited),
        cmocka_unit_test(no_child_leaves_the_cone),
        cmocka_unit_test(additive_mode_is_the_printed_formula),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
