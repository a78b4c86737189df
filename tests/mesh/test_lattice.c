// Graphs of bars as one surface: closed whatever loops they have, of the asked thickness, the same
// on any number of threads.
#include "testing.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/lattice.h"

#include <math.h>
#include <string.h>

static Mesh *surface(const Lattice *lattice, float voxel, int smoothing, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Mesh *mesh = lattice_surface(lattice, voxel, smoothing, &run, &e);
    if (!mesh) {
        fail_msg("%s", e.message);
    }
    return mesh;
}

static void add_ring(Lattice *lattice, Vec3 center, float radius, float thick)
{
    enum { PIECES = 40 };
    for (int i = 0; i < PIECES; i++) {
        float s0, c0, s1, c1;
        exact_sincos(2.0f * PI_F * (float)i / PIECES, &s0, &c0);
        exact_sincos(2.0f * PI_F * (float)(i + 1) / PIECES, &s1, &c1);
        Bar bar = {vec3_madd(center, radius, vec3(c0, s0, 0)),
                   vec3_madd(center, radius, vec3(c1, s1, 0)), thick, thick};
        assert_true(lattice_add(lattice, bar, NULL));
    }
}

static double volume(const Mesh *mesh)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        sum += (double)vec3_dot(mesh->position[c[0]],
                                vec3_cross(mesh->position[c[1]], mesh->position[c[2]]));
    }
    return sum / 6.0;
}

static void rings_are_closed_and_as_thick_as_asked(void **state)
{
    (void)state;
    for (int smoothing = 0; smoothing <= 6; smoothing += 6) {
        Lattice lattice = {0};
        add_ring(&lattice, vec3(0, 0, 0), 1.0f, 0.15f);
        Mesh *mesh = surface(&lattice, 0.03f, smoothing, 1);
        MeshTopology t;
        assert_true(mesh_topology(mesh, &t, NULL));
        assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
        assert_int_equal(t.component_count, 1);
        assert_int_equal(t.euler_number, 0);
        double torus = 2.0 * M_PI * M_PI * 0.15 * 0.15;
        assert_true(fabs(volume(mesh) / torus - 1.0) < 0.03);
        mesh_free(mesh);
        lattice_clear(&lattice);
    }
}

static void rings_that_touch_become_one(void **state)
{
    (void)state;
    Lattice lattice = {0};
    add_ring(&lattice, vec3(0, 0, 0), 1.0f, 0.12f);
    add_ring(&lattice, vec3(2.1f, 0, 0), 1.0f, 0.12f);
    Mesh *mesh = surface(&lattice, 0.04f, 3, 1);
    MeshTopology t;
    assert_true(mesh_topology(mesh, &t, NULL));
    assert_int_equal(t.open_edges, 0);
    assert_int_equal(t.component_count, 1);
    assert_int_equal(t.euler_number, -2); // a figure of eight
    mesh_free(mesh);
    lattice_clear(&lattice);
}

static void threads_do_not_show(void **state)
{
    (void)state;
    Lattice lattice = {0};
    for (uint64_t i = 0; i < 60; i++) {
        Vec3 a = random_direction(random_key(1, i)), b = random_direction(random_key(2, i));
        Bar bar = {a, vec3_lerp(a, b, 0.3f), 0.08f, 0.05f};
        assert_true(lattice_add(&lattice, bar, NULL));
    }
    Mesh *one = surface(&lattice, 0.03f, 4, 1);
    for (int threads = 2; threads <= 3; threads++) {
        Mesh *many = surface(&lattice, 0.03f, 4, threads);
        assert_int_equal(many->vertex_count, one->vertex_count);
        assert_int_equal(many->face_count, one->face_count);
        assert_memory_equal(many->position, one->position,
                            sizeof(Vec3) * (size_t)one->vertex_count);
        assert_memory_equal(many->index, one->index,
                            3 * sizeof(uint32_t) * (size_t)one->face_count);
        mesh_free(many);
    }
    mesh_free(one);
    lattice_clear(&lattice);
}

static void nothing_makes_an_empty_mesh(void **state)
{
    (void)state;
    Lattice lattice = {0};
    Mesh *mesh = surface(&lattice, 0.1f, 2, 1);
    assert_int_equal(mesh->face_count, 0);
    mesh_free(mesh);
    Error e = {0};
    Run run = run_default();
    assert_null(lattice_surface(&lattice, 0.0f, 0, &run, &e));
    assert_non_null(strstr(e.message, "voxel"));
}

// A body of a few micrometres is the same body, smaller.
static void size_does_not_matter(void **state)
{
    (void)state;
    const float scale = 0x1p-20f;
    Lattice large = {0}, small = {0};
    add_ring(&large, vec3(0, 0, 0), 1.0f, 0.2f);
    add_ring(&large, vec3(1, 0, 0.1f), 0.8f, 0.15f);
    for (int64_t i = 0; i < large.count; i++) {
        Bar bar = large.bar[i];
        assert_true(lattice_add(&small,
                                (Bar){vec3_scale(bar.a, scale), vec3_scale(bar.b, scale),
                                      scale * bar.radius_a, scale * bar.radius_b},
                                NULL));
    }
    Mesh *wide = surface(&large, 0.05f, 2, 2), *tiny = surface(&small, 0.05f * scale, 2, 2);
    assert_true(wide->face_count > 1000);
    assert_int_equal(tiny->face_count, wide->face_count);
    for (int64_t i = 0; i < wide->vertex_count; i++) {
        assert_true(vec3_distance(vec3_scale(tiny->position[i], 1.0f / scale), wide->position[i]) <
                    1e-5f);
    }
    mesh_free(wide);
    mesh_free(tiny);
    lattice_clear(&large);
    lattice_clear(&small);
}

// Hair-thin bars in a large body are refused at once, not counted out until memory ends, or where
// no grid has so many cells.
static void what_cannot_fit_is_refused(void **state)
{
    (void)state;
    Lattice lattice = {0};
    add_ring(&lattice, vec3(0, 0, 0), 1.0f, 0.2f);
    const float voxel[3] = {1e-7f, 1e-20f, 1e-38f};
    for (int i = 0; i < 3; i++) {
        Error e = {0};
        Run run = run_default();
        assert_null(lattice_surface(&lattice, voxel[i], 2, &run, &e));
        assert_int_equal(e.code, i < 1 ? ERROR_MEMORY : ERROR_INPUT);
    }
    lattice_clear(&lattice);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_are_closed_and_as_thick_as_asked),
        cmocka_unit_test(rings_that_touch_become_one),
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(nothing_makes_an_empty_mesh),
        cmocka_unit_test(size_does_not_matter),
        cmocka_unit_test(what_cannot_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
