// Forests: stands that share their light, set over the land.
#include "making.h"
#include "objects/forest/forest.h"
#include "testing.h"

#include <math.h>

static GrowLevel levels[] = {{40, 0.12f, 0.45f, 4.0f, 0.88f, 0.28f, 0.35f, 0.5f},
                             {600, 0.22f, 0.75f, 2.5f, 0.96f, 0.28f, 0.15f, 0.5f}};

static ForestParams small_forest(void)
{
    ForestParams params = forest_params_default();
    params.stand_trees = 4;
    params.stands = 2;
    params.radius = 60.0f;
    params.ferns = 60;
    params.leaves.max_count = 400;
    params.element.levels = levels;
    params.element.level_count = 2;
    return params;
}

static OutTree *grow(const ForestParams *params, float grow_to, int threads)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    OutTree *tree = grow_kind(&kind_forest, params,
                              &(Recipe){.seed = 9, .label = "forest", .run = &run}, grow_to, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static void every_tree_gets_its_share_of_the_light(void **state)
{
    (void)state;
    ForestParams params = small_forest();
    OutTree *tree = grow(&params, 1.0f, 1), *same = grow(&params, 1.0f, 3);
    assert_true(out_tree_hash(tree) == out_tree_hash(same));
    assert_true(out_tree_check(tree, NULL));
    int64_t roots = 0, nodes[8] = {0};
    for (int64_t i = 0; i < tree->count; i++) {
        assert_in_range(tree->colony[i], 0, 7);
        nodes[tree->colony[i]]++;
        roots += tree->parent[i] < 0;
        assert_true(tree->parent[i] < 0 || tree->colony[tree->parent[i]] == tree->colony[i]);
        assert_true(tree->position[i].y < 1.1f * params.height);
    }
    assert_int_equal(roots, 8);
    for (int i = 0; i < 8; i++) {
        assert_true(nodes[i] > 50); // more than its trunk
    }
    out_tree_free(tree);
    out_tree_free(same);
}

// Trees that grew together keep apart; the same trees grown each alone and put side by side do not.
static void crowns_that_grew_together_keep_apart(void **state)
{
    (void)state;
    ForestParams params = small_forest();
    params.stands = 1;
    OutTree *together = grow(&params, 1.0f, 1);
    double gap, mixed;
    assert_true(forest_crown_gap(together, &params, &gap, NULL));
    // another stand's trees in the same light: shift the second stand onto the first
    params.stands = 2;
    OutTree *two = grow(&params, 1.0f, 1);
    float shift = 0.0f, count = 0.0f;
    for (int64_t i = 0; i < two->count; i++) {
        if (two->parent[i] < 0) {
            shift += two->colony[i] >= 4 ? two->position[i].x : -two->position[i].x;
            count += 0.5f;
        }
    }
    for (int64_t i = 0; i < two->count; i++) {
        if (two->colony[i] >= 4) {
            two->position[i].x -= shift / count;
            two->colony[i] -= 2; // half of them count as the first stand's
        }
    }
    assert_true(forest_crown_gap(two, &params, &mixed, NULL));
    assert_true(gap > 1.3 * mixed);
    out_tree_free(together);
    out_tree_free(two);
}

static float hill(const void *user, float x, float z)
{
    (void)z;
    (void)user;
    return x > 0.0f ? 2.0f * x : 0.0f; // 63 degrees to the right, level to the left
}

static void stands_follow_slope_glade_and_density(void **state)
{
    (void)state;
    ForestParams params = small_forest();
    params.glade = 10.0f;
    params.glade_center = vec3(-20, 0, 0);
    OutTree *tree = grow(&params, 1.0f, 1);
    Run run = run_default();
    Geometry geometry = {0};
    Recipe recipe = {.seed = 9, .label = "forest", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    placing.around.land = (Land){hill, NULL};
    Grown grown = grown_of(tree);
    assert_true(forest_geometry(&params, &grown, &placing, NULL));
    int64_t stands = 0;
    for (int64_t p = 0; p < geometry.count; p++) {
        const Part *part = &geometry.part[p];
        assert_true(part->instance_count > 0);
        for (int64_t i = 0; i < part->instance_count; i++) {
            Vec3 at = transform_point(&part->instance[i], vec3(0, 0, 0));
            if (part->material == FOREST_FERN) {
                continue;
            }
            stands += part->material == FOREST_BARK;
            assert_true(at.x < 3.0f); // the slope is felt a little before it begins
            assert_true(fabsf(at.y - hill(NULL, at.x, at.z)) < 1e-3f);
            assert_true(vec3_distance(at, params.glade_center) > params.glade);
            assert_true(vec3_length(at) < params.radius * 1.01f);
            // upright, whatever the slope
            Vec3 up = transform_vector(&part->instance[i], vec3(0, 1, 0));
            assert_true(up.x == 0.0f && up.z == 0.0f && up.y > 0.8f);
        }
    }
    assert_true(stands > 10);
    geometry_clear(&geometry);
    params.density = 0.0f;
    assert_true(forest_geometry(&params, &grown, &placing, NULL));
    for (int64_t p = 0; p < geometry.count; p++) {
        assert_true(geometry.part[p].material == FOREST_FERN);
    }
    geometry_clear(&geometry);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tree_gets_its_share_of_the_light),
        cmocka_unit_test(crowns_that_grew_together_keep_apart),
        cmocka_unit_test(stands_follow_slope_glade_and_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
