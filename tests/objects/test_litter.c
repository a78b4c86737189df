// Fallen leaves on the ground: where they lie and whose they are.
#include "making.h"
#include "objects/common/foliage.h"
#include "objects/ground/ground.h"
#include "objects/tree/tree.h"
#include "testing.h"

#include <math.h>

enum { LEAVES = 20000, SEED = 9 };

static GroundParams bare_ground(void)
{
    GroundParams params = ground_params_default();
    params.radius = 60.0f;
    params.grass_tufts = 0;
    params.fallen_leaves = LEAVES;
    params.fallen_radius = 10.0f;
    return params;
}

static void make(const GroundParams *params, Geometry *geometry)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = SEED, .label = "ground", .run = &run};
    Placing placing = placing_in(geometry, &recipe);
    if (!ground_geometry(params, NULL, &placing, &e)) {
        fail_msg("%s", e.message);
    }
}

// The mean of a power of the leaves' distances from (x, z), m.
static double mean_distance(const Geometry *geometry, double x, double z, double power)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t p = 0; p < geometry->count; p++) {
        const Part *part = &geometry->part[p];
        for (int64_t i = 0; part->material == GROUND_FALLEN && i < part->instance_count; i++) {
            const Transform *t = &part->instance[i];
            sum += pow(hypot((double)t->m[0][3] - x, (double)t->m[2][3] - z), power);
            count++;
        }
    }
    assert_int_equal(count, LEAVES);
    return sum / (double)count;
}

// A share u of the leaves lies within R u^(1/2) where they lie evenly, within R u where they gather
// most: mean distances of 2/3 and 1/2 R, mean squares of 1/2 and 1/3 R^2.
static void leaves_lie_evenly_or_gather(void **state)
{
    (void)state;
    const double radius = 10.0;
    for (int gathers = 0; gathers <= 1; gathers++) {
        GroundParams params = bare_ground();
        params.fallen_center = vec3(7.0f, 0.0f, -4.0f);
        params.fallen_gathering = (float)gathers;
        Geometry geometry = {0};
        make(&params, &geometry);
        double mean = radius * (gathers ? 0.5 : 2.0 / 3.0);
        double square = radius * radius * (gathers ? 1.0 / 3.0 : 0.5);
        assert_true(fabs(mean_distance(&geometry, 7.0, -4.0, 1.0) - mean) < 0.07);
        assert_true(fabs(mean_distance(&geometry, 7.0, -4.0, 2.0) - square) < 1.0);
        geometry_clear(&geometry);
    }
}

// Length of a mesh along y, m: from a leaf's stalk to its tip.
static float mesh_length(const Mesh *mesh)
{
    float low = INFINITY, high = -INFINITY;
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        low = fminf(low, mesh->position[v].y);
        high = fmaxf(high, mesh->position[v].y);
    }
    return high - low;
}

// Three leaves of 20 cm for each one of 5 cm.
static void leaves_are_of_the_trees_given(void **state)
{
    (void)state;
    TreeParams large = tree_params_default(), small = tree_params_default();
    large.leaves.length = 0.2f;
    small.leaves.length = 0.05f;
    TreeShare of[2] = {{.share = 3.0f, .tree = &large}, {.share = 1.0f, .tree = &small}};
    GroundParams params = bare_ground();
    params.fallen_of = of;
    params.fallen_of_count = 2;
    Geometry geometry = {0};
    make(&params, &geometry);
    int64_t long_ones = 0, all = 0;
    for (int64_t p = 0; p < geometry.count; p++) {
        const Part *part = &geometry.part[p];
        if (part->material == GROUND_FALLEN) {
            all += part->instance_count;
            long_ones += mesh_length(part->mesh) > 0.1f ? part->instance_count : 0;
        }
    }
    assert_int_equal(all, LEAVES);
    assert_int_equal(long_ones, LEAVES * 3 / 4);
    geometry_clear(&geometry);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaves_lie_evenly_or_gather),
        cmocka_unit_test(leaves_are_of_the_trees_given),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
