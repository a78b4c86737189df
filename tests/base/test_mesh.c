#include "base/mesh.h"
#include "testing.h"

#include <math.h>
#include <string.h>

// The cube [-1, 1]^3 `count` times, 3 m apart.
static Mesh *make_cubes(int count)
{
    static const uint32_t face[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                        {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    Mesh *mesh = mesh_new(4, 8 * count, 6 * count, 0, NULL);
    assert_non_null(mesh);
    for (int c = 0; c < count; c++) {
        for (int i = 0; i < 8; i++) {
            mesh->position[8 * c + i] = vec3(i & 4 ? 1 : -1, i & 2 ? 1 : -1, i & 1 ? 1 : -1);
            mesh->position[8 * c + i].x += 3.0f * (float)c;
        }
        for (int f = 0; f < 24; f++) {
            mesh->index[24 * c + f] = face[f / 4][f % 4] + 8 * (uint32_t)c;
        }
    }
    return mesh;
}

static Mesh *make_torus(int n)
{
    Mesh *mesh = mesh_new(4, n * n, n * n, 0, NULL);
    assert_non_null(mesh);
    for (int i = 0; i < n * n; i++) {
        int x = i % n, y = i / n;
        uint32_t corner[4] = {(uint32_t)i, (uint32_t)(y * n + (x + 1) % n),
                              (uint32_t)((y + 1) % n * n + (x + 1) % n),
                              (uint32_t)((y + 1) % n * n + x)};
        memcpy(mesh->index + 4 * i, corner, sizeof corner);
    }
    return mesh;
}

static double volume(const Mesh *mesh)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + f * mesh->face_size;
        for (int k = 1; k + 1 < mesh->face_size; k++) {
            sum += (double)vec3_dot(mesh->position[c[0]],
                                    vec3_cross(mesh->position[c[k]], mesh->position[c[k + 1]]));
        }
    }
    return sum / 6.0;
}

static MeshTopology topology_of(const Mesh *mesh)
{
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, NULL));
    return topology;
}

static void closed_surfaces_are_recognised(void **state)
{
    (void)state;
    Mesh *cubes = make_cubes(3), *torus = make_torus(5);
    MeshTopology t = topology_of(cubes);
    assert_int_equal(t.edge_count, 36);
    assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges + t.degenerate_faces, 0);
    assert_int_equal(t.component_count, 3);
    assert_int_equal(t.euler_number, 6);
    t = topology_of(torus);
    assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges + t.degenerate_faces, 0);
    assert_int_equal(t.component_count, 1);
    assert_int_equal(t.euler_number, 0);
    mesh_free(cubes);
    mesh_free(torus);
}

static void faults_are_counted(void **state)
{
    (void)state;
    Mesh *mesh = make_cubes(2);
    mesh->face_count--; // a hole
    MeshTopology t = topology_of(mesh);
    assert_int_equal(t.open_edges, 4);
    assert_int_equal(t.euler_number, 3);
    mesh->face_count++;
    uint32_t swapped = mesh->index[1]; // a face the wrong way round
    mesh->index[1] = mesh->index[3];
    mesh->index[3] = swapped;
    t = topology_of(mesh);
    assert_int_equal(t.misoriented_edges, 4);
    assert_int_equal(t.open_edges, 0);
    memcpy(mesh->index + 4, mesh->index + 24, 4 * sizeof(uint32_t)); // a face twice
    t = topology_of(mesh);
    assert_int_equal(t.overused_edges, 4);
    assert_int_equal(t.open_edges, 4);
    mesh->index[1] = mesh->index[0];
    assert_int_equal(topology_of(mesh).degenerate_faces, 1);
    mesh_free(mesh);
}

static void vertices_without_faces_do_not_count(void **state)
{
    (void)state;
    Mesh *mesh = make_cubes(2);
    mesh->face_count = 6;
    MeshTopology t = topology_of(mesh);
    assert_int_equal(t.component_count, 1);
    assert_int_equal(t.euler_number, 2);
    mesh->face_count = 0;
    t = topology_of(mesh);
    assert_int_equal(t.component_count, 0);
    mesh_free(mesh);
}

static void normals_of_a_cube_point_along_its_diagonals(void **state)
{
    (void)state;
    Mesh *mesh = make_cubes(1);
    assert_true(mesh_compute_normals(mesh, NULL));
    for (int i = 0; i < 8; i++) {
        Vec3 diagonal = vec3_normalize(mesh->position[i]);
        assert_true(vec3_distance(mesh->normal[i], diagonal) < 1e-6f);
    }
    mesh_free(mesh);
}

static void a_mirror_keeps_the_outside_outside(void **state)
{
    (void)state;
    Mesh *mesh = make_cubes(1);
    assert_true(mesh_compute_normals(mesh, NULL));
    Transform mirror = transform_compose(vec3(5, 0, 0), vec3(20, 30, 40), vec3(-2, 1, 3));
    assert_true(mesh_transform(mesh, &mirror, NULL));
    assert_true(fabs(volume(mesh) - 48.0) < 1e-3);
    for (int i = 0; i < 8; i++) {
        assert_true(vec3_dot(mesh->normal[i], vec3_sub(mesh->position[i], vec3(5, 0, 0))) > 0.0f);
    }
    Transform flat = transform_compose(vec3(0, 0, 0), vec3(0, 0, 0), vec3(1, 0, 1));
    Error e = {0};
    assert_false(mesh_transform(mesh, &flat, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    mesh_free(mesh);
}

// Seams split vertices without opening the surface; one open, flat or inverted piece does not make
// the others open.
static void closed_faces_enclose_a_body(void **state)
{
    (void)state;
    Mesh *mesh = make_cubes(4);
    uint8_t closed[24];
    Mesh *split = mesh_new(4, 24, 6, 0, NULL); // the first cube, six faces of their own
    assert_non_null(split);
    for (uint32_t i = 0; i < 24; i++) {
        split->position[i] = mesh->position[mesh->index[i]];
        split->index[i] = i;
    }
    assert_true(mesh_closed_faces(split, closed, NULL));
    for (int f = 0; f < 6; f++) {
        assert_int_equal(closed[f], 1);
    }
    memcpy(mesh->index + 24, mesh->index + 28, 4 * sizeof(uint32_t)); // the second lacks a face
    for (int f = 12; f < 18; f++) {                                   // the third is inside out
        uint32_t *c = mesh->index + 4 * f, swap = c[1];
        c[1] = c[3];
        c[3] = swap;
    }
    for (int i = 24; i < 32; i++) { // the fourth is flat
        mesh->position[i].y = 0.0f;
    }
    assert_true(mesh_closed_faces(mesh, closed, NULL));
    for (int f = 0; f < 24; f++) {
        assert_int_equal(closed[f], f < 6);
    }
    mesh_free(split);
    mesh_free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_surfaces_are_recognised),
        cmocka_unit_test(closed_faces_enclose_a_body),
        cmocka_unit_test(faults_are_counted),
        cmocka_unit_test(vertices_without_faces_do_not_count),
        cmocka_unit_test(normals_of_a_cube_point_along_its_diagonals),
        cmocka_unit_test(a_mirror_keeps_the_outside_outside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
