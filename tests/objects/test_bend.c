// Bending meshes: lengths along the axis stay, ends turn by what is asked, nothing else changes.
#include "testing.h"

#include "objects/mesh/bend.h"

#include <math.h>
#include <string.h>

enum { STEPS = 200 };

// A strip along x from -2 to 1: its axis and its edge at z = 0.1.
static Mesh *strip(void)
{
    Mesh *mesh = mesh_new(4, 2 * (STEPS + 1), STEPS, MESH_NORMAL, NULL);
    for (int i = 0; i <= STEPS; i++) {
        float x = -2.0f + 3.0f * (float)i / STEPS;
        mesh->position[2 * i] = vec3(x, 0.3f, 0);
        mesh->position[2 * i + 1] = vec3(x, 0.3f, 0.1f);
        mesh->normal[2 * i] = mesh->normal[2 * i + 1] = vec3(0, 0, 1);
    }
    for (uint32_t i = 0; i < STEPS; i++) {
        const uint32_t quad[4] = {2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2};
        memcpy(mesh->index + 4 * i, quad, sizeof quad);
    }
    return mesh;
}

static Vec3 across(const Mesh *mesh, int i)
{
    return vec3_scale(vec3_sub(mesh->position[2 * i + 1], mesh->position[2 * i]), 10.0f);
}

static void the_axis_keeps_its_length_and_its_ends_turn(void **state)
{
    (void)state;
    const float front = 40.0f, back = 65.0f, degree = 0.01745329f;
    Mesh *mesh = strip();
    mesh_bend(mesh, front, back);
    float length = 0.0f;
    for (int i = 0; i <= STEPS; i++) {
        length += i > 0 ? vec3_distance(mesh->position[2 * i], mesh->position[2 * i - 2]) : 0.0f;
        assert_float_equal(mesh->position[2 * i].y, 0.3f, 0.0f);
        assert_float_equal(vec3_length(across(mesh, i)), 1.0f, 1e-4f);
        assert_true(vec3_distance(across(mesh, i), mesh->normal[2 * i]) < 1e-4f);
    }
    assert_float_equal(length, 3.0f, 1e-3f);
    Vec3 head = mesh->normal[2 * STEPS], tail = mesh->normal[0], middle = mesh->normal[STEPS];
    assert_true(vec3_distance(middle, vec3(0, 0, 1)) < 1e-3f);
    assert_true(vec3_distance(head, vec3(-sinf(front * degree), 0, cosf(front * degree))) < 1e-4f);
    assert_true(vec3_distance(tail, vec3(sinf(back * degree), 0, cosf(back * degree))) < 1e-4f);
    assert_true(mesh->position[0].z > 0.3f && mesh->position[2 * STEPS].z > 0.3f);
    mesh_free(mesh);
}

static void no_bend_changes_no_bit(void **state)
{
    (void)state;
    Mesh *mesh = strip(), *same = strip();
    mesh_bend(mesh, 0.0f, 0.0f);
    assert_memory_equal(mesh->position, same->position, (size_t)mesh->vertex_count * sizeof(Vec3));
    mesh_bend(mesh, 0.0f, 30.0f); // and only the half that is asked for
    for (int i = STEPS / 2 + 1; i <= STEPS; i++) {
        assert_true(vec3_distance(mesh->position[2 * i], same->position[2 * i]) < 1e-6f);
    }
    assert_true(vec3_distance(mesh->position[0], same->position[0]) > 0.3f);
    mesh_free(mesh);
    mesh_free(same);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_axis_keeps_its_length_and_its_ends_turn),
        cmocka_unit_test(no_bend_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
