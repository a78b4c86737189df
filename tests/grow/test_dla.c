// Diffusion-limited aggregation: contacts, the grid's distances against brute force, symmetry of
// the first hits, fractal dimension.
#include "testing.h"

#include "base/random.h"
#include "grow/aggregate/dla.h"
#include "grow/aggregate/dla_grid.h"

#include <math.h>
#include <string.h>

static OutTree *grow(int dimension, int64_t count, uint64_t seed)
{
    DlaParams params = dla_params_default();
    params.dimension = dimension;
    params.count = count;
    params.seed = seed;
    Error e = {0};
    Run run = run_default();
    OutTree *tree = dla_grow(&params, &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    assert_int_equal(tree->count, count);
    return tree;
}

static void particles_touch_and_never_overlap(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        OutTree *tree = grow(dimension, 1500, 3);
        for (int64_t i = 1; i < tree->count; i++) {
            Vec3 p = tree->position[i];
            assert_float_equal(vec3_distance(p, tree->position[tree->parent[i]]), 1.0f, 1e-4);
            assert_true(dimension == 3 || p.z == 0.0f);
            for (int64_t j = 0; j < i; j++) {
                assert_true(vec3_distance(p, tree->position[j]) > 0.9999f);
            }
        }
        out_tree_free(tree);
    }
}

// Every distance is a bound, and exact where a particle is named.
static void the_grid_never_overestimates(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        enum { COUNT = 300 };
        double position[COUNT][3];
        DlaGrid grid;
        Error e = {0};
        assert_true(dla_grid_init(&grid, dimension, 60.0, COUNT, (const double(*)[3])position, &e));
        for (int i = 0; i < COUNT; i++) {
            for (int k = 0; k < 3; k++) {
                uint64_t key = random_key(random_key(8, (uint64_t)i), (uint64_t)k);
                position[i][k] = k < dimension ? (double)random_range(key, -20, 20) : 0.0;
            }
            dla_grid_add(&grid, i);
        }
        int named = 0;
        for (int i = 0; i < 20000; i++) {
            double p[3] = {0}, true2 = INFINITY;
            for (int k = 0; k < dimension; k++) {
                uint64_t key = random_key(random_key(9, (uint64_t)i), (uint64_t)k);
                p[k] = (double)random_range(key, -60, 60) * (i % 3 == 0 ? 1.0 : 0.4);
            }
            for (int j = 0; j < COUNT; j++) {
                double d2 = 0.0;
                for (int k = 0; k < 3; k++) {
                    d2 += (p[k] - position[j][k]) * (p[k] - position[j][k]);
                }
                true2 = d2 < true2 ? d2 : true2;
            }
            int32_t nearest;
            double d = dla_grid_distance(&grid, p, &nearest);
            assert_true(d > 0.0 && d <= sqrt(true2) + 1e-9);
            assert_true(d >= 0.1 * sqrt(true2) || d > 2.9); // and it is not timid
            if (nearest >= 0) {
                assert_float_equal(d, sqrt(true2), 1e-9);
                named++;
            }
        }
        assert_true(named > 100);
        dla_grid_free(&grid);
    }
}

// A lone particle is hit from all sides alike; of two that touch, each is hit as often, and the far
// ends more often than the middle: the first particle's share of hits in each of 8 sectors.
static void hits_follow_the_harmonic_measure(void **state)
{
    (void)state;
    enum { CLUSTERS = 4000 };
    int sector[8] = {0}, first = 0, outer = 0;
    for (int i = 0; i < CLUSTERS; i++) {
        OutTree *tree = grow(2, 3, 1000 + (uint64_t)i);
        Vec3 a = tree->position[1], b = tree->position[2];
        int bin = (int)((atan2(a.y, a.x) / M_PI + 1.0) * 4.0);
        sector[bin < 8 ? bin : 7]++;
        first += tree->parent[2] == 0;
        // along the pair's axis from its middle: beyond a centre or between the two
        float along = vec3_dot(a, b) - 0.5f;
        outer += fabsf(along) > 0.5f;
        out_tree_free(tree);
    }
    double chi2 = 0.0, mean = CLUSTERS / 8.0;
    for (int i = 0; i < 8; i++) {
        chi2 += (sector[i] - mean) * (sector[i] - mean) / mean;
    }
    assert_true(chi2 < 24.3); // 7 degrees of freedom, 0.1 %
    double sigma = sqrt(CLUSTERS) / 2.0;
    assert_true(fabs(first - CLUSTERS / 2.0) < 3.3 * sigma);
    // The harmonic measure from infinity of the outside of two discs of radius 1 whose centres
    // stand 1 apart, beyond the centres: 0.8245, by boundary elements on the logarithmic potential.
    double share = (double)outer / CLUSTERS;
    assert_true(fabs(share - 0.8245) < 3.3 * sqrt(0.8245 * 0.1755 / CLUSTERS));
}

static void clusters_have_the_known_dimension(void **state)
{
    (void)state;
    double plane = 0.0, space = 0.0;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        OutTree *flat = grow(2, 30000, seed), *solid = grow(3, 12000, seed);
        plane += dla_dimension(flat) / 3.0;
        space += dla_dimension(solid) / 3.0;
        out_tree_free(flat);
        out_tree_free(solid);
    }
    assert_true(plane > 1.64 && plane < 1.78);
    assert_true(space > 2.36 && space < 2.6);
}

static OutTree *line(int64_t count, bool plane)
{
    OutTree *tree = out_tree_new(NULL);
    for (int64_t i = 0; i < count; i++) { // a line, or turns of a square spiral
        float x = (float)i, y = 0.0f;
        if (plane) { // sunflower: n points within a radius of sqrt(n)
            x = sqrtf((float)i) * cosf(2.3999632f * (float)i);
            y = sqrtf((float)i) * sinf(2.3999632f * (float)i);
        }
        assert_true(out_tree_add_node(tree, vec3(x, y, 0), i - 1, (int32_t)i, 0, 1, NULL) >= 0);
    }
    return tree;
}

static void dimension_of_a_line_and_a_disc(void **state)
{
    (void)state;
    OutTree *one = line(4000, false), *two = line(4000, true);
    assert_float_equal(dla_dimension(one), 1.0, 0.01);
    assert_float_equal(dla_dimension(two), 2.0, 0.02);
    out_tree_free(one);
    out_tree_free(two);
}

static void the_same_seed_gives_the_same_cluster(void **state)
{
    (void)state;
    OutTree *a = grow(3, 2000, 5), *b = grow(3, 2000, 5), *c = grow(3, 2000, 6);
    assert_true(out_tree_hash(a) == out_tree_hash(b));
    assert_true(out_tree_hash(a) != out_tree_hash(c));
    // The first particles of a longer run are the same.
    OutTree *d = grow(3, 1000, 5);
    assert_true(memcmp(a->position, d->position, 1000 * sizeof(Vec3)) == 0);
    out_tree_free(a);
    out_tree_free(b);
    out_tree_free(c);
    out_tree_free(d);
}

static void bad_numbers_are_named(void **state)
{
    (void)state;
    DlaParams params = dla_params_default();
    Error e = {0};
    Run run = run_default();
    params.dimension = 4;
    assert_null(dla_grow(&params, &run, &e));
    assert_non_null(strstr(e.message, "must be 2 or 3"));
    params = dla_params_default();
    params.diameter = 0.0f;
    assert_null(dla_grow(&params, &run, &e));
    assert_non_null(strstr(e.message, "diameter"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(particles_touch_and_never_overlap),
        cmocka_unit_test(the_grid_never_overestimates),
        cmocka_unit_test(hits_follow_the_harmonic_measure),
        cmocka_unit_test(clusters_have_the_known_dimension),
        cmocka_unit_test(dimension_of_a_line_and_a_disc),
        cmocka_unit_test(the_same_seed_gives_the_same_cluster),
        cmocka_unit_test(bad_numbers_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
