// Fracture: pieces are closed and together make the base less its cracks; sheets against brute
// force.
#include "testing.h"

#include "base/random.h"
#include "mesh/pieces.h"
#include "model/crack.h"
#include "model/fracture.h"
#include "shape/mesh_close.h"

#include <math.h>

static FractureParams small_params(void)
{
    FractureParams params = fracture_params_default();
    params.attractors = 60;
    params.resolution = 64;
    params.weathering = 0.0f;
    return params;
}

static MeshPieces break_ball(const FractureParams *params, int threads, double *base,
                             double *removed)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Recipe recipe = {.seed = 2, .label = "ball", .grow_to = 1.0f, .run = &run};
    OutTree *network = fracture_grow(params, &recipe, &e);
    MeshPieces pieces;
    if (!network || !fracture_pieces(network, params, &recipe, &pieces, base, removed, &e)) {
        fail_msg("%s", e.message);
    }
    out_tree_free(network);
    return pieces;
}

static double total_volume(const MeshPieces *pieces)
{
    double sum = 0.0;
    for (int64_t i = 0; i < pieces->count; i++) {
        sum += mesh_signed_volume(pieces->piece[i]);
    }
    return sum;
}

static void pieces_are_closed_and_keep_the_volume(void **state)
{
    (void)state;
    FractureParams params = small_params();
    for (int hollow = 0; hollow < 2; hollow++) {
        params.hollow = hollow ? 0.3f : 0.0f;
        double base, removed;
        MeshPieces pieces = break_ball(&params, 2, &base, &removed);
        assert_true(pieces.count > 4);
        for (int64_t i = 0; i < pieces.count; i++) {
            MeshTopology t;
            assert_true(mesh_topology(pieces.piece[i], &t, NULL));
            assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
            assert_int_equal(t.component_count, 1);
            // and none is nearly all of it
            assert_true(mesh_signed_volume(pieces.piece[i]) < 0.7 * base);
        }
        double ball = 4.0 / 3.0 * M_PI * (hollow ? 1.0 - 0.7 * 0.7 * 0.7 : 1.0);
        assert_true(fabs(base / ball - 1.0) < 0.01);
        assert_true(removed > 0.02 * base);
        assert_true(fabs((total_volume(&pieces) + removed) / base - 1.0) < 0.02);
        mesh_pieces_clear(&pieces);
    }
}

static void threads_do_not_show(void **state)
{
    (void)state;
    FractureParams params = small_params();
    params.resolution = 40;
    MeshPieces one = break_ball(&params, 1, NULL, NULL);
    for (int threads = 2; threads <= 3; threads++) {
        MeshPieces many = break_ball(&params, threads, NULL, NULL);
        assert_int_equal(many.count, one.count);
        for (int64_t i = 0; i < one.count; i++) {
            assert_int_equal(many.piece[i]->vertex_count, one.piece[i]->vertex_count);
            assert_memory_equal(many.piece[i]->position, one.piece[i]->position,
                                sizeof(Vec3) * (size_t)one.piece[i]->vertex_count);
        }
        mesh_pieces_clear(&many);
    }
    mesh_pieces_clear(&one);
}

static void measures_are_those_of_the_pieces(void **state)
{
    (void)state;
    FractureParams params = small_params();
    params.resolution = 40;
    double base, removed, largest = 0.0;
    MeshPieces pieces = break_ball(&params, 1, &base, &removed);
    for (int64_t i = 0; i < pieces.count; i++) {
        largest = fmax(largest, mesh_signed_volume(pieces.piece[i]));
    }
    Run run = run_default();
    Recipe recipe = {.seed = 2, .label = "ball", .grow_to = 1.0f, .run = &run};
    OutTree *network = fracture_grow(&params, &recipe, NULL);
    MeasureList list = {0};
    assert_true(fracture_measure(network, &params, &recipe, &list, NULL));
    assert_int_equal(measures_find(&list, "pieces")->value, pieces.count);
    assert_true(measures_find(&list, "largest_piece")->value == largest / base);
    assert_true(fabs(measures_find(&list, "removed")->value - removed / base) < 0.02);
    measures_clear(&list);
    out_tree_free(network);
    mesh_pieces_clear(&pieces);
}

static void a_mesh_of_two_balls_has_two_pieces(void **state)
{
    (void)state;
    Mesh *mesh = mesh_new(3, 8, 8, MESH_NORMAL, NULL); // two tetrahedra, their vertices mixed
    const uint32_t face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    for (int f = 0; f < 8; f++) {
        for (int k = 0; k < 3; k++) {
            mesh->index[3 * f + k] = 2 * face[f / 2][k] + (uint32_t)(f % 2);
        }
    }
    const Vec3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 8; i++) {
        mesh->position[i] = vec3_add(corner[i / 2], vec3(5.0f * (float)(i % 2), 0, 0));
    }
    MeshPieces pieces;
    assert_true(mesh_split(mesh, &pieces, NULL));
    assert_int_equal(pieces.count, 2);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(pieces.piece[i]->vertex_count, 4);
        assert_int_equal(pieces.piece[i]->face_count, 4);
        assert_float_equal((float)mesh_signed_volume(pieces.piece[i]), 1.0f / 6.0f, 1e-6f);
    }
    mesh_pieces_clear(&pieces);
    mesh_free(mesh);
}

static Vec3 random_point(uint64_t key)
{
    return vec3(random_range(random_key(key, 0), -1, 1), random_range(random_key(key, 1), -1, 1),
                random_range(random_key(key, 2), -1, 1));
}

// The least distance to a fine grid of points of the triangle is never below, and hardly above.
static void triangles_are_as_far_as_their_nearest_point(void **state)
{
    (void)state;
    for (uint64_t t = 0; t < 40; t++) {
        Vec3 a = random_point(random_key(t, 1)), b = random_point(random_key(t, 2));
        Vec3 c = random_point(random_key(t, 3)), p = random_point(random_key(t, 4));
        float least = INFINITY;
        enum { FINE = 150 };
        for (int i = 0; i <= FINE; i++) {
            for (int j = 0; i + j <= FINE; j++) {
                float u = (float)i / FINE, v = (float)j / FINE;
                Vec3 q = vec3_madd(vec3_madd(vec3_scale(a, 1 - u - v), u, b), v, c);
                least = fminf(least, vec3_distance(p, q));
            }
        }
        float d = triangle_distance(p, a, b, c);
        assert_true(d <= least + 1e-5f && d >= least - 0.02f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_closed_and_keep_the_volume),
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(measures_are_those_of_the_pieces),
        cmocka_unit_test(a_mesh_of_two_balls_has_two_pieces),
        cmocka_unit_test(triangles_are_as_far_as_their_nearest_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
