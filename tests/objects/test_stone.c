// Stones: closed bodies of the size, height and depth that are asked for.
#include "objects/stone/stone.h"
#include "testing.h"

static void is_closed_and_outward(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 6; seed++) {
        StoneParams stone = stone_params_default();
        stone.roundness = 0.2f * (float)(seed - 1);
        Error e = {0};
        Mesh *mesh = stone_mesh(&stone, seed, &e);
        assert_non_null(mesh);
        MeshTopology topology;
        assert_true(mesh_topology(mesh, &topology, &e));
        assert_int_equal(topology.open_edges, 0);
        assert_int_equal(topology.overused_edges, 0);
        assert_int_equal(topology.misoriented_edges, 0);
        assert_int_equal(topology.euler_number, 2);
        uint8_t *closed = calloc((size_t)mesh->face_count, 1);
        assert_true(mesh_closed_faces(mesh, closed, &e)); // and faces outward
        for (int64_t i = 0; i < mesh->face_count; i++) {
            assert_int_equal(closed[i], 1);
        }
        free(closed);
        mesh_free(mesh);
    }
}

static void has_its_extents(void **state)
{
    (void)state;
    StoneParams stone = stone_params_default();
    stone.size = 2.0f;
    stone.width = 0.5f;
    stone.height = 0.4f;
    stone.sink = 0.25f;
    Error e = {0};
    Mesh *mesh = stone_mesh(&stone, 7, &e);
    assert_non_null(mesh);
    Aabb box = mesh_bounds(mesh);
    assert_true(fabsf(box.high.x - box.low.x - 2.0f) < 1e-4f);
    assert_true(fabsf(box.high.z - box.low.z - 1.0f) < 1e-4f);
    assert_true(fabsf(box.high.y - box.low.y - 0.8f) < 1e-4f);
    assert_true(fabsf(box.low.y + 0.2f) < 1e-4f); // a quarter of 0.8 m is below the ground
    mesh_free(mesh);
}

// Share of the mesh's edges along which it bends by more than 20 degrees, by the normals of the
// faces at vertices' ends: sharp blocks have some, pebbles none.
static double sharp_share(const Mesh *mesh)
{
    int64_t sharp = 0, all = 0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *v = mesh->index + 4 * f;
        for (int k = 0; k < 4; k++) {
            sharp += vec3_dot(mesh->normal[v[k]], mesh->normal[v[(k + 1) % 4]]) < 0.94f;
            all++;
        }
    }
    return (double)sharp / (double)all;
}

static void is_as_round_as_asked(void **state)
{
    (void)state;
    double share[2];
    for (int i = 0; i < 2; i++) {
        StoneParams stone = stone_params_default();
        stone.roundness = (float)i;
        stone.roughness = 0.0f;
        stone.width = stone.height = 1.0f;
        Error e = {0};
        Mesh *mesh = stone_mesh(&stone, 3, &e);
        assert_non_null(mesh);
        share[i] = sharp_share(mesh);
        mesh_free(mesh);
    }
    assert_true(share[0] > 0.05);
    assert_true(share[1] < 0.002);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_closed_and_outward),
        cmocka_unit_test(has_its_extents),
        cmocka_unit_test(is_as_round_as_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
