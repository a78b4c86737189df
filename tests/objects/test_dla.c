// Diffusion-limited aggregates as objects: size, thickness, one closed surface.
#include "making.h"
#include "testing.h"

#include "objects/dla/dla.h"

static OutTree *grow(const DlaModel *params, float grow_to)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 3, .label = "dendrite", .run = &run};
    OutTree *tree = grow_kind(&kind_dla, params, &recipe, grow_to, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static float extent(const OutTree *tree)
{
    Aabb box = out_tree_bounds(tree);
    return fmaxf(box.high.x - box.low.x, box.high.y - box.low.y);
}

static void a_cluster_has_the_asked_size_and_is_one_surface(void **state)
{
    (void)state;
    DlaModel params = dla_model_default();
    params.particles = 800;
    params.size = 0.5f;
    OutTree *tree = grow(&params, 1.0f);
    assert_int_equal(tree->count, 800);
    assert_float_equal(extent(tree), 0.5f, 1e-4);
    for (int64_t i = 1; i < tree->count; i++) {
        assert_true(tree->radius[i] <= tree->radius[tree->parent[i]]);
    }
    Geometry geometry = {0};
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 3, .label = "dendrite", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    Grown grown = grown_of(tree);
    assert_true(dla_model_geometry(&params, &grown, &placing, &e));
    MeshTopology t;
    assert_true(mesh_topology(geometry.part[0].mesh, &t, &e));
    assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
    assert_int_equal(t.component_count, 1);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static void growth_in_progress_is_the_beginning_of_the_whole(void **state)
{
    (void)state;
    DlaModel params = dla_model_default();
    params.particles = 800;
    OutTree *whole = grow(&params, 1.0f), *half = grow(&params, 0.5f);
    assert_int_equal(half->count, 400);
    assert_memory_equal(half->position, whole->position, 400 * sizeof(Vec3));
    out_tree_free(whole);
    out_tree_free(half);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cluster_has_the_asked_size_and_is_one_surface),
        cmocka_unit_test(growth_in_progress_is_the_beginning_of_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
