// Hollow branch sculptures: one closed piece full of loops, on the surface, at any size and on any
// number of threads.
#include "making.h"
#include "testing.h"

#include "objects/sculpture/sculpture.h"
#include "outtree/join.h"

static OutTree *grow_at(SculptureParams *params, Vec3 place, float size, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Shape ball = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}};
    ball.transform = transform_compose(place, vec3(0, 0, 0), vec3_splat(size));
    params->element.shapes = &ball;
    params->element.shape_count = 1;
    Recipe recipe = {.seed = 4, .label = "ball", .run = &run};
    OutTree *tree = grow_kind(&kind_sculpture, params, &recipe, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static OutTree *grow(SculptureParams *params, float size, int threads)
{
    return grow_at(params, vec3(0, 0, 0), size, threads);
}

static void a_sculpture_is_one_closed_shell_with_loops(void **state)
{
    (void)state;
    SculptureParams params = sculpture_params_default();
    params.attractors = 250;
    params.clusters = 5;
    OutTree *tree = grow(&params, 1.0f, 2);
    int64_t pieces, loops, roots = 0;
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    for (int64_t i = 0; i < tree->count; i++) {
        float r = vec3_length(tree->position[i]);
        assert_true(r > 0.9f && r < 1.06f); // bars are chords of the ball
        roots += tree->parent[i] < 0;
    }
    assert_int_equal(roots, 5);
    Geometry geometry = {0};
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    Grown grown = grown_of(tree);
    assert_true(sculpture_geometry(&params, &grown, &placing, &e));
    MeshTopology t;
    assert_true(mesh_topology(geometry.part[0].mesh, &t, &e));
    assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
    assert_int_equal(t.component_count, 1);
    assert_true(t.euler_number < -20);            // 2 - 2 x holes of the shell
    assert_true(2 - t.euler_number <= 2 * loops); // bars that touch fill the smallest loops
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static void threads_do_not_show_and_size_does_not_matter(void **state)
{
    (void)state;
    SculptureParams params = sculpture_params_default();
    params.attractors = 200;
    OutTree *one = grow(&params, 1.0f, 1), *two = grow(&params, 1.0f, 2);
    OutTree *three = grow(&params, 1.0f, 3), *large = grow(&params, 16.0f, 1);
    assert_true(out_tree_hash(one) == out_tree_hash(two));
    assert_true(out_tree_hash(one) == out_tree_hash(three));
    assert_int_equal(one->count, large->count); // a power of two scales without rounding
    assert_float_equal(large->radius[0], 16.0f * one->radius[0], 1e-4);
    out_tree_free(one);
    out_tree_free(two);
    out_tree_free(three);
    out_tree_free(large);
}

// The field sweeps by the polar angle on the envelope's own sphere, wherever that is.
static void polar_angles_count_about_the_middle_of_the_envelope(void **state)
{
    (void)state;
    SculptureParams params = sculpture_params_default();
    params.attractors = 200;
    params.clusters = 1;
    FieldParams field = field_params_default(FIELD_NUCLEI);
    field.turn = 120.0f;
    field.spherical = true;
    field.surface = true;
    params.element.fields = &field;
    params.element.field_count = 1;
    OutTree *here = grow_at(&params, vec3(0, 0, 0), 1.0f, 1);
    OutTree *there = grow_at(&params, vec3(4, 0, -3), 1.0f, 1);
    assert_int_equal(here->count, there->count);
    for (int64_t i = 0; i < here->count; i++) {
        Vec3 back = vec3_sub(there->position[i], vec3(4, 0, -3));
        assert_true(vec3_distance(here->position[i], back) < 1e-4f);
    }
    out_tree_free(here);
    out_tree_free(there);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sculpture_is_one_closed_shell_with_loops),
        cmocka_unit_test(polar_angles_count_about_the_middle_of_the_envelope),
        cmocka_unit_test(threads_do_not_show_and_size_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
