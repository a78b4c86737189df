// Ribs of a column: grooves of the asked depth between crests that keep the radius.
#include "objects/tree/ribs.h"
#include "skin/skin.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

#define RADIUS 0.25f

static Mesh *column(void)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int i = 0; i < 12; i++) {
        Vec3 p = vec3(0, 0.2f * (float)i, 0);
        int64_t made = out_tree_add_node(tree, p, i - 1, i, 0, (uint64_t)i + 1, NULL);
        assert_int_equal(made, i);
        tree->radius[made] = RADIUS;
        tree->normal[made] = vec3(0, 0, 1);
    }
    SkinParams skin = skin_params_default();
    skin.min_radius = 0.0f;
    skin.sides = 32;
    Run run = run_default();
    Error e = {0};
    Mesh *mesh = skin_tree(tree, &skin, &run, &e);
    assert_non_null(mesh);
    out_tree_free(tree);
    return mesh;
}

typedef struct RingPoint {
    float angle, away;
} RingPoint;

static int compare(const void *a, const void *b)
{
    float p = ((const RingPoint *)a)->angle, q = ((const RingPoint *)b)->angle;
    return (p > q) - (p < q);
}

// The vertices of one ring in order; returns their number.
static int ring_of(const Mesh *mesh, RingPoint *ring, int most)
{
    float at = -1.0f;
    int count = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        at = at < 0.0f && p.y > 1.0f && p.y < 1.3f ? p.y : at;
        if (at >= 0.0f && fabsf(p.y - at) < 1e-4f && count < most) {
            ring[count++] = (RingPoint){atan2f(p.z, p.x), sqrtf(p.x * p.x + p.z * p.z)};
        }
    }
    qsort(ring, (size_t)count, sizeof *ring, compare);
    return count;
}

static void grooves_lie_between_crests(void **state)
{
    (void)state;
    enum { RIBS = 16, MOST = 1000 };
    TreeParams params = tree_params_default();
    params.trunk.ribs = RIBS;
    params.trunk.rib_depth = 0.2f;
    Mesh *mesh = column();
    assert_true(tree_ribs(mesh, &params, NULL));
    RingPoint ring[MOST];
    int count = ring_of(mesh, ring, MOST), grooves = 0;
    float low = INFINITY, high = 0.0f;
    for (int i = 0; i < count; i++) {
        float here = ring[i].away;
        low = fminf(low, here);
        high = fmaxf(high, here);
        grooves += here < ring[(i + 1) % count].away && here < ring[(i + count - 1) % count].away;
    }
    assert_int_equal(grooves, RIBS);
    assert_float_equal(high, RADIUS, 0.03f * RADIUS);
    assert_float_equal(low, 0.8f * RADIUS, 0.03f * RADIUS);
    mesh_free(mesh);
}

static void without_ribs_nothing_moves(void **state)
{
    (void)state;
    TreeParams params = tree_params_default();
    Mesh *mesh = column(), *plain = column();
    assert_true(tree_ribs(mesh, &params, NULL));
    assert_memory_equal(mesh->position, plain->position,
                        sizeof *mesh->position * (size_t)mesh->vertex_count);
    mesh_free(mesh);
    mesh_free(plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grooves_lie_between_crests),
        cmocka_unit_test(without_ribs_nothing_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
