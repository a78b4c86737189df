// Objects that are carried from the form in which they grew.
#include "scene/build.h"
#include "scene/builder.h"

#include "render/world.h"
#include "scene_fixture.h"

#define OAK                                                                                      \
    "objects:\n  - name: oak\n    tree: {position: [1, 0, 2], height: 6, crown: {growth: "       \
    "{levels: [{attractors: 150}, {attractors: 700}]}}, leaves: {max_count: 0}, skin: {levels: " \
    "0}}\n"

static OutTree *grow(const Scene *scene)
{
    Run run = run_default();
    run.threads = 2;
    Error e = {0};
    OutTree *tree = scene_grow_object(scene, 0, &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

// Every node is where the motion takes it, within a hundredth of a millimetre.
static void assert_carried(void **state, const char *deform, const Transform *t)
{
    char text[1024];
    snprintf(text, sizeof text, OAK "    deform: [{kind: affine, %s}]\n", deform);
    Scene *rest = fixture_read(*state, OAK), *scene = fixture_read(*state, text);
    OutTree *a = grow(rest), *b = grow(scene);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->radius, b->radius, (size_t)a->count * sizeof *a->radius);
    for (int64_t i = 0; i < a->count; i++) {
        assert_true(vec3_distance(transform_point(t, a->position[i]), b->position[i]) < 1e-5f);
        assert_float_equal(vec3_length(b->normal[i]), 1.0f, 1e-4f);
    }
    out_tree_free(a);
    out_tree_free(b);
    scene_free(rest);
    scene_free(scene);
}

static void turns_and_shears_carry_every_node(void **state)
{
    Transform turn = transform_compose(vec3(0, 0, 0), vec3(3, 0, 0), vec3(1, 1, 1));
    assert_carried(state, "rotation: [3, 0, 0]", &turn);
    Transform shear = transform_identity();
    shear.m[0][1] = 0.02f;
    assert_carried(state, "shear: [0.02, 0, 0]", &shear);
}

// A keyed deformation does not grow the object again, and gives the bits of a fresh build.
static void keyed_deformations_keep_the_growth(void **state)
{
    Scene *first = fixture_read(
        *state, OAK "    deform: [{kind: bend, toward: [0, 0, 1], angle: 10, length: 6}]\n");
    Error e = {0};
    SceneChange change = {.path = "objects.oak.deform.0.angle", .value = "25", .source = "test"};
    Scene *second = scene_changed(first, &change, 1, &e);
    assert_non_null(second);
    Run run = run_default();
    SceneBuilder *builder = scene_builder_new(true, &e);
    BuildStats stats = {0}, fresh = {0};
    assert_non_null(scene_builder_build(builder, first, &run, &stats, &e));
    assert_false(scene_builder_fits(builder, second));
    World *world = scene_builder_build(builder, second, &run, &stats, &e);
    World *anew = scene_build(second, &run, &fresh, &e);
    assert_non_null(world);
    assert_non_null(anew);
    assert_int_equal(world->geometry.count, anew->geometry.count);
    for (int64_t i = 0; i < anew->geometry.count; i++) {
        const Mesh *a = world->geometry.part[i].mesh, *b = anew->geometry.part[i].mesh;
        assert_int_equal(a != NULL, b != NULL);
        if (a) {
            assert_int_equal(a->vertex_count, b->vertex_count);
            assert_memory_equal(a->position, b->position,
                                (size_t)a->vertex_count * sizeof *a->position);
        }
    }
    world_free(anew);
    scene_builder_free(builder);
    scene_free(second);
    scene_free(first);
}

static void plain_meshes_are_carried(void **state)
{
    Scene *scene =
        fixture_read(*state, "objects:\n  - name: ball\n    shape: {envelope: [{shape: sphere}]}\n"
                             "    deform: [{kind: affine, scale: [2, 1, 1], move: [5, 0, 0]}]\n");
    Run run = run_default();
    Error e = {0};
    World *world = scene_build(scene, &run, NULL, &e);
    assert_non_null(world);
    Aabb box = mesh_bounds(world->geometry.part[0].mesh);
    assert_float_equal(box.low.x, 3.0f, 0.02f);
    assert_float_equal(box.high.x, 7.0f, 0.02f);
    assert_float_equal(box.high.y, 1.0f, 0.02f);
    world_free(world);
    scene_free(scene);
}

static void what_cannot_be_carried_is_refused(void **state)
{
    fixture_refuse(*state,
                   "objects:\n  - name: land\n    ground: {}\n    deform: [{kind: twist}]\n",
                   "objects of kind ground cannot be deformed", 4);
    fixture_refuse(*state, OAK "    deform: [{kind: bend, toward: [0, 2, 0]}]\n",
                   "must lean across it", 4);
    fixture_refuse(*state, OAK "    deform: [{kind: twist, axis: [0, 0, 0]}]\n",
                   "must have a direction", 4);
    fixture_refuse(*state, OAK "    deform: [{kind: mesh, rest: a.obj, posed: b.obj}]\n", "a.obj",
                   4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(turns_and_shears_carry_every_node, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(keyed_deformations_keep_the_growth, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(plain_meshes_are_carried, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(what_cannot_be_carried_is_refused, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
