#include "base/memory.h"
#include "catmull_clark.h"
#include "mesh/refine.h"
#include "skin/skin.h"
#include "testing.h"
#include "tree_samples.h"

#include <math.h>

static Mesh *make_cube(void)
{
    static const uint32_t face[24] = {0, 2, 6, 4, 1, 5, 7, 3, 0, 4, 5, 1,
                                      2, 3, 7, 6, 0, 1, 3, 2, 4, 6, 7, 5};
    Mesh *mesh = mesh_new(4, 8, 6, MESH_RADIUS | MESH_UV, NULL);
    assert_non_null(mesh);
    for (int i = 0; i < 8; i++) {
        mesh->position[i] = vec3(i & 4 ? 1 : -1, i & 2 ? 1 : -1, i & 1 ? 1 : -1);
        mesh->radius[i] = 0.25f;
        mesh->uv[i] = (Vec2){mesh->position[i].x, mesh->position[i].z};
    }
    memcpy(mesh->index, face, sizeof face);
    return mesh;
}

static Mesh *subdivide(const Mesh *cage, int levels, int threads)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    uint8_t *level = memory_alloc(cage->face_count, 1, &e);
    assert_non_null(level);
    memset(level, levels, (size_t)cage->face_count);
    Mesh *mesh = mesh_refine(cage, level, &run, &e);
    free(level);
    if (!mesh) {
        fail_msg("%s", e.message);
    }
    return mesh;
}

static void a_cube_s_limit_is_the_closed_form(void **state)
{
    (void)state;
    Mesh *cube = make_cube();
    for (int levels = 1; levels <= 4; levels++) {
        Mesh *mesh = subdivide(cube, levels, 1);
        assert_int_equal(mesh->face_count, 6 << (2 * levels));
        assert_int_equal(mesh->vertex_count, mesh->face_count + 2);
        MeshTopology t;
        assert_true(mesh_topology(mesh, &t, NULL));
        assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
        assert_int_equal(t.euler_number, 2);
        for (int i = 0; i < 8; i++) {
            // (9 P + 4 sum e + sum f) / 24 with sum e = P and sum f = -P: P / 2, for every level.
            Vec3 p = cube->position[i];
            assert_true(vec3_distance(mesh->position[i], vec3_scale(p, 0.5f)) < 1e-6f);
            assert_true(vec3_distance(mesh->normal[i], vec3_normalize(p)) < 1e-5f);
            assert_true(fabsf(mesh->radius[i] - 0.25f) < 1e-6f);
            assert_true(fabsf(mesh->uv[i].x - 0.5f * p.x) < 1e-6f);
        }
        for (int64_t i = 0; i < mesh->vertex_count; i++) {
            assert_true(vec3_dot(mesh->normal[i], mesh->position[i]) > 0.0f);
        }
        mesh_free(mesh);
    }
    mesh_free(cube);
}

static float distance_to_nearest(Vec3 p, const Vec3 *set, int64_t count)
{
    float best = INFINITY;
    for (int64_t i = 0; i < count; i++) {
        best = fminf(best, vec3_distance(p, set[i]));
    }
    return best;
}

static void refinement_is_catmull_clark_by_the_book(void **state)
{
    (void)state;
    OutTree *tree = sample_walk(11, 14, 0.3f, 0.3f, true);
    SkinParams params = skin_params_default();
    Run run = run_default();
    Mesh *cage = skin_cage(tree, &params, &run, NULL);
    assert_non_null(cage);
    assert_in_range(cage->face_count, 50, 1500);
    Mesh *ours = subdivide(cage, 1, 1), *book = book_subdivide(cage);
    assert_int_equal(ours->vertex_count, book->vertex_count);
    Vec3 *limit = book_vertices(book, true);
    for (int64_t i = 0; i < cage->vertex_count; i++) { // cage vertices keep their numbers
        assert_true(vec3_distance(limit[i], ours->position[i]) < 1e-5f);
    }
    for (int64_t i = 0; i < ours->vertex_count; i++) {
        assert_true(distance_to_nearest(ours->position[i], limit, book->vertex_count) < 1e-5f);
    }
    free(limit);
    mesh_free(ours);
    mesh_free(book);
    mesh_free(cage);
    out_tree_free(tree);
}

// A cage of many patches: refined whole, its vertices must not depend on where patches end.
static void patches_leave_no_trace(void **state)
{
    (void)state;
    OutTree *tree = sample_walk(2, 700, 0.05f, 0.15f, true);
    SkinParams params = skin_params_default();
    Run run = run_default();
    Mesh *cage = skin_cage(tree, &params, &run, NULL);
    assert_non_null(cage);
    assert_true(cage->face_count > 3 * 2048);
    Mesh *one = subdivide(cage, 2, 1), *three = subdivide(cage, 2, 3);
    size_t bytes = (size_t)one->vertex_count * sizeof(Vec3);
    assert_memory_equal(one->position, three->position, bytes);
    assert_memory_equal(one->normal, three->normal, bytes);
    // Level 3 uses other patches; the limit surface at the cage's vertices is the same.
    Mesh *fine = subdivide(cage, 3, 2);
    int64_t off = 0;
    for (int64_t i = 0; i < cage->vertex_count; i++) {
        off += vec3_distance(fine->position[i], one->position[i]) > 2e-5f;
    }
    assert_int_equal(off, 0);
    mesh_free(cage);
    mesh_free(one);
    mesh_free(three);
    mesh_free(fine);
    out_tree_free(tree);
}

static void graded_levels_leave_no_cracks(void **state)
{
    (void)state;
    OutTree *tree = sample_walk(4, 60, 0.2f, 0.2f, true);
    SkinParams params = skin_params_default();
    Run run = run_default();
    Mesh *cage = skin_cage(tree, &params, &run, NULL);
    assert_non_null(cage);
    uint8_t *level = malloc((size_t)cage->face_count);
    assert_non_null(level);
    for (int64_t f = 0; f < cage->face_count; f++) {
        level[f] = (uint8_t)(1 + random_mix((uint64_t)f) % 3);
    }
    Mesh *mesh = mesh_refine(cage, level, &run, NULL), *even = subdivide(cage, 3, 1);
    assert_non_null(mesh);
    assert_int_equal(mesh->face_size, 3);
    assert_true(2 * even->face_count > mesh->face_count);
    MeshTopology t;
    assert_true(mesh_topology(mesh, &t, NULL));
    assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
    assert_int_equal(t.degenerate_faces, 0);
    assert_int_equal(t.euler_number, 2);
    int64_t off = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i += mesh->vertex_count / 300 + 1) {
        off += distance_to_nearest(mesh->position[i], even->position, even->vertex_count) > 2e-5f;
    }
    assert_int_equal(off, 0);
    free(level);
    mesh_free(mesh);
    mesh_free(even);
    mesh_free(cage);
    out_tree_free(tree);
}

static void level_0_is_the_cage_with_normals(void **state)
{
    (void)state;
    OutTree *tree = sample_walk(4, 60, 0.1f, 0.2f, false);
    SkinParams params = skin_params_default();
    params.levels = 0;
    Run run = run_default();
    Mesh *cage = skin_cage(tree, &params, &run, NULL), *skin = skin_tree(tree, &params, &run, NULL);
    assert_non_null(cage);
    assert_non_null(skin);
    assert_int_equal(skin->vertex_count, cage->vertex_count);
    assert_int_equal(skin->face_count, cage->face_count);
    size_t vertices = (size_t)cage->vertex_count, corners = (size_t)cage->face_count * 4;
    assert_memory_equal(skin->position, cage->position, vertices * sizeof(Vec3));
    assert_memory_equal(skin->radius, cage->radius, vertices * sizeof(float));
    assert_memory_equal(skin->index, cage->index, corners * sizeof(uint32_t));
    for (int64_t i = 0; i < skin->vertex_count; i++) {
        assert_float_equal(vec3_length(skin->normal[i]), 1.0f, 1e-5f);
    }
    mesh_free(skin);
    mesh_free(cage);
    out_tree_free(tree);
}

static void borders_are_kept(void **state)
{
    (void)state;
    Mesh *sheet = make_cube();
    sheet->face_count = 5;
    Mesh *mesh = subdivide(sheet, 2, 1);
    MeshTopology t;
    assert_true(mesh_topology(mesh, &t, NULL));
    assert_int_equal(t.open_edges, 16);
    assert_int_equal(t.misoriented_edges, 0);
    mesh_free(mesh);
    mesh_free(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_s_limit_is_the_closed_form),
        cmocka_unit_test(refinement_is_catmull_clark_by_the_book),
        cmocka_unit_test(patches_leave_no_trace),
        cmocka_unit_test(graded_levels_leave_no_cracks),
        cmocka_unit_test(level_0_is_the_cage_with_normals),
        cmocka_unit_test(borders_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
