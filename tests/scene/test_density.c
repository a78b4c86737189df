// Densities of attractors from files: growth goes where a grid or a picture says.
#include "image/image.h"
#include "scene/build.h"
#include "shape/envelope.h"
#include "shape/grid_file.h"

#include "scene_fixture.h"

static OutTree *grow(const Scene *scene)
{
    Run run = run_default();
    Error e = {0};
    OutTree *tree = scene_grow_object(scene, 0, &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

// A picture that is white in its left half.
static void write_picture(const Fixture *fixture)
{
    char file[128];
    Error e = {0};
    Image *image = image_new(64, 64, 3, &e);
    for (int i = 0; i < 64 * 64 * 3; i++) {
        image->pixel[i] = i / 3 % 64 < 32 ? 1.0f : 0.0f;
    }
    snprintf(file, sizeof file, "%s/half.png", fixture->folder);
    assert_true(image_write_display(file, image, NULL, &e));
    image_free(image);
}

#define DISC(X, TURN, MORE)                                                                   \
    "objects:\n  - name: a\n    outtree:\n      envelope: [{shape: box, size: [1, 0.02, 1], " \
    "position: [" X ", 0, 0], rotation: [0, " TURN ", 0]}]\n"                                 \
    "      placed: {points: [{position: [" X ", 0, 0]}]}\n"                                   \
    "      growth: {levels: [{attractors: 1500}]}\n"                                          \
    "      points: {density: {file: half.png, scale: 2, position: [" X                        \
    ", 0, 0], rotation: [0, " TURN ", 0]" MORE "}}\n"

// Shares of the nodes left of the middle.
static double share_left(const OutTree *tree, float middle)
{
    int64_t left = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        left += tree->position[i].x < middle + 0.05f;
    }
    return (double)left / (double)tree->count;
}

static void growth_follows_a_picture(void **state)
{
    write_picture(*state);
    Scene *scene = fixture_read(*state, DISC("0", "0", ""));
    Scene *inverted = fixture_read(*state, DISC("0", "0", ", invert: true"));
    Scene *moved = fixture_read(*state, DISC("3", "180", ""));
    OutTree *a = grow(scene), *b = grow(inverted), *c = grow(moved);
    assert_true(a->count > 300);
    assert_true(share_left(a, 0.0f) > 0.97);
    assert_true(share_left(b, -0.1f) < 0.03);
    assert_true(share_left(c, 2.9f) < 0.03); // turned by 180 degrees
    assert_int_equal(a->count, c->count);    // and otherwise the same
    out_tree_free(a);
    out_tree_free(b);
    out_tree_free(c);
    scene_free(scene);
    scene_free(inverted);
    scene_free(moved);
}

static void write_ball(const Fixture *fixture)
{
    char file[128];
    Run run = run_default();
    Error e = {0};
    Shape shape = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1, .voxel = 0.02f};
    Envelope *envelope = envelope_new(&params, &run, &e);
    GridFile *grids = grid_file_new(&e);
    snprintf(file, sizeof file, "%s/ball.vdb", fixture->folder);
    assert_true(envelope_add_to(envelope, "ball", grids, &run, &e));
    assert_true(grid_file_write(grids, file, &e));
    grid_file_free(grids);
    envelope_free(envelope);
}

static void growth_follows_a_grid(void **state)
{
    write_ball(*state);
    Scene *scene = fixture_read(
        *state,
        "objects:\n  - name: a\n    outtree:\n      envelope: [{shape: box, size: 1}]\n      "
        "placed: {points: [{position: [0, 0, 0]}]}\n      growth: {levels: [{attractors: 1500}]}\n"
        "      points: {density: {file: ball.vdb, grid: ball, scale: 0.5}}\n");
    OutTree *tree = grow(scene);
    assert_true(tree->count > 300);
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(vec3_length(tree->position[i]) < 0.52f);
    }
    out_tree_free(tree);
    scene_free(scene);
}

static void an_unknown_grid_has_its_place(void **state)
{
    write_ball(*state);
    Scene *scene = fixture_read(
        *state,
        "objects:\n  - name: a\n    outtree:\n      envelope: [{shape: box, size: 1}]\n      "
        "placed: {points: [{position: [0, 0, 0]}]}\n      points:\n        density:\n"
        "          file: ball.vdb\n          grid: bull\n");
    Run run = run_default();
    Error e = {0};
    assert_null(scene_grow_object(scene, 0, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "called 'bull'; the file has: ball"));
    assert_int_equal(e.line, 9);
    scene_free(scene);
}

// The values of a ball's level set rise outward: near its surface growth goes straight out.
static void growth_follows_the_vectors_of_a_grid(void **state)
{
    write_ball(*state);
    double reach[2];
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "objects:\n  - name: a\n    outtree:\n      envelope: [{shape: box, size: 1}]\n"
                 "      placed: {points: [{position: [0, 0, 0]}]}\n"
                 "      fields: [{kind: volume, file: ball.vdb, weight: %s}]\n"
                 "      growth: {field_weight: 3, levels: [{attractors: 1500}]}\n",
                 i == 0 ? "1" : "0");
        Scene *scene = fixture_read(*state, text);
        OutTree *tree = grow(scene);
        double along = 0.0, count = 0.0;
        for (int64_t k = 1; k < tree->count; k++) {
            Vec3 from = tree->position[tree->parent[k]];
            Vec3 way = vec3_normalize(vec3_sub(tree->position[k], from));
            if (fabsf(vec3_length(from) - 1.0f) < 0.05f) { // where the level set has a gradient
                along += (double)vec3_dot(way, vec3_normalize(from));
                count += 1.0;
            }
        }
        assert_true(count > 5.0);
        reach[i] = along / count;
        out_tree_free(tree);
        scene_free(scene);
    }
    assert_true(reach[0] > 0.95);
    assert_true(reach[1] < 0.9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(growth_follows_a_picture, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(growth_follows_a_grid, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(growth_follows_the_vectors_of_a_grid, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(an_unknown_grid_has_its_place, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
