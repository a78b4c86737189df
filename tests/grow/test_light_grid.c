// Sky light on the voxel grid against rays cast through the same leaves.
#include "grow/light/shade_grid.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "testing.h"

enum { CLUSTERS = 40, FLAKES = 300, RAYS = 2000, PROBES = 300 };

#define SPAN 30.0f   // of the region, internodes
#define CELL 1.5f    // as growth by light has it
#define DENSITY 0.2f // area of leaves across the light in a unit of volume: dense clusters

typedef struct Cluster {
    Vec3 center;
    float radius;
} Cluster;

static void make_clusters(Cluster cluster[CLUSTERS])
{
    for (int i = 0; i < CLUSTERS; i++) {
        uint64_t key = random_key(3, (uint64_t)i);
        cluster[i] = (Cluster){vec3(random_range(random_key(key, 0), 4, SPAN - 4),
                                    random_range(random_key(key, 1), 4, SPAN - 4),
                                    random_range(random_key(key, 2), 4, SPAN - 4)),
                               random_range(random_key(key, 3), 2.5f, 4.0f)};
    }
}

static ShadeGrid *clusters_grid(const Cluster cluster[CLUSTERS])
{
    Aabb box = {vec3(0, 0, 0), vec3_splat(SPAN)};
    ShadeGrid *grid = shade_grid_new(box, CELL, 1000000, NULL);
    assert_non_null(grid);
    for (int i = 0; i < CLUSTERS; i++) {
        float r = cluster[i].radius, volume = 4.0f / 3.0f * PI_F * r * r * r;
        for (int k = 0; k < FLAKES; k++) {
            uint64_t key = random_key(random_key(7, (uint64_t)i), (uint64_t)k);
            float share = random_unit(random_key(key, 1)), at = r * exact_pow(share, 1.0f / 3.0f);
            Vec3 p = vec3_madd(cluster[i].center, at, random_direction(random_key(key, 2)));
            shade_grid_add_leaves(grid, p, DENSITY * volume / FLAKES);
        }
    }
    assert_true(shade_grid_solve(grid, 2, NULL));
    return grid;
}

// Way of a ray from p inside of a ball.
static float chord(const Cluster *ball, Vec3 p, Vec3 d)
{
    Vec3 from = vec3_sub(ball->center, p);
    float along = vec3_dot(from, d), off2 = vec3_dot(from, from) - along * along;
    float half2 = ball->radius * ball->radius - off2;
    if (half2 <= 0.0f) {
        return 0.0f;
    }
    float half = sqrtf(half2), near = along - half, far = along + half;
    return far <= 0.0f ? 0.0f : far - (near > 0.0f ? near : 0.0f);
}

// Light of an overcast sky at p by rays: their radiance is that of CIE's sky.
static float cast(const Cluster cluster[CLUSTERS], Vec3 p, uint64_t seed)
{
    float sum = 0.0f, weights = 0.0f;
    for (int k = 0; k < RAYS; k++) {
        Vec3 d = random_direction(random_key(seed, (uint64_t)k));
        d.y = fabsf(d.y);
        float depth = 0.0f, weight = 1.0f + 2.0f * d.y;
        for (int i = 0; i < CLUSTERS; i++) {
            depth += DENSITY * chord(&cluster[i], p, d);
        }
        sum += weight * (float)exact_exp(-(double)depth);
        weights += weight;
    }
    return sum / weights;
}

// The light at points inside and between clusters of leaves, from nearly none to nearly all. The
// measured error is stated in docs/architecture.md.
static void the_grid_agrees_with_rays(void **state)
{
    (void)state;
    Cluster cluster[CLUSTERS];
    make_clusters(cluster);
    ShadeGrid *grid = clusters_grid(cluster);
    double squares = 0.0, bias = 0.0, worst = 0.0;
    float least = 1.0f, most = 0.0f;
    for (int i = 0; i < PROBES; i++) {
        uint64_t key = random_key(11, (uint64_t)i);
        Vec3 p = vec3(random_range(random_key(key, 0), 2, SPAN - 2),
                      random_range(random_key(key, 1), 1, SPAN - 2),
                      random_range(random_key(key, 2), 2, SPAN - 2));
        float rays = cast(cluster, p, key);
        double error = (double)(shade_grid_light(grid, p) - rays);
        squares += error * error;
        bias += error;
        worst = fabs(error) > worst ? fabs(error) : worst;
        least = rays < least ? rays : least;
        most = rays > most ? rays : most;
    }
    print_message("light by rays %.2f .. %.2f; error of the grid: mean %.3f, standard %.3f, "
                  "largest %.3f\n",
                  (double)least, (double)most, bias / PROBES, sqrt(squares / PROBES), worst);
    assert_true(least < 0.3f && most > 0.8f);
    assert_true(fabs(bias / PROBES) < 0.03);
    assert_true(sqrt(squares / PROBES) < 0.05);
    assert_true(worst < 0.15);
    shade_grid_free(grid);
}

static double caught(const ShadeGrid *grid)
{
    double sum = 0.0;
    for (int64_t i = 0; i < grid->count; i++) {
        sum += (double)grid->leaf[i] * (double)grid->light[i];
    }
    return sum;
}

// However many leaves there are, together they catch no more than what comes in; many catch most.
static void no_light_is_caught_twice(void **state)
{
    (void)state;
    Aabb box = {vec3(0, 0, 0), vec3(20, 12, 16)};
    double before = 0.0;
    float density = 0.01f;
    for (int power = 0; power < 5; power++, density *= 10.0f) {
        ShadeGrid *grid = shade_grid_new(box, CELL, 1000000, NULL);
        for (int64_t i = 0; i < grid->count; i++) {
            grid->leaf[i] = density * random_range(random_key(1, (uint64_t)i), 0.5f, 1.5f);
        }
        assert_true(shade_grid_solve(grid, 1, NULL));
        double share = caught(grid) / shade_grid_incoming(grid);
        assert_true(share > before && share < 1.0 + 1e-5);
        before = share;
        shade_grid_free(grid);
    }
    assert_true(before > 0.95);
}

// More leaves above never make it brighter, anywhere.
static void leaves_never_make_light(void **state)
{
    (void)state;
    Aabb box = {vec3(0, 0, 0), vec3(16, 16, 16)};
    ShadeGrid *few = shade_grid_new(box, CELL, 1000000, NULL);
    ShadeGrid *many = shade_grid_new(box, CELL, 1000000, NULL);
    for (int i = 0; i < 300; i++) {
        Vec3 p =
            vec3_scale(vec3_add(random_direction(random_key(2, (uint64_t)i)), vec3(1, 1, 1)), 8.0f);
        shade_grid_add_leaves(many, p, 2.0f);
        if (i % 2) {
            shade_grid_add_leaves(few, p, 2.0f);
        }
    }
    assert_true(shade_grid_solve(few, 1, NULL) && shade_grid_solve(many, 1, NULL));
    for (int64_t i = 0; i < few->count; i++) {
        assert_true(many->light[i] <= few->light[i] + 1e-6f);
    }
    shade_grid_free(few);
    shade_grid_free(many);
}

static void a_lone_leaf_has_all_light(void **state)
{
    (void)state;
    Aabb box = {vec3(0, 0, 0), vec3(10, 10, 10)};
    ShadeGrid *grid = shade_grid_new(box, CELL, 1000000, NULL);
    Vec3 p = vec3(5, 5, 5);
    shade_grid_add_leaves(grid, p, 0.001f);
    assert_true(shade_grid_solve(grid, 1, NULL));
    assert_float_equal(shade_grid_light(grid, p), 1.0f, 1e-3f);
    Vec3 up = vec3_normalize(shade_grid_brightest(grid, p));
    assert_true(up.y > 0.999f);
    shade_grid_free(grid);
}

// Beside a wall half of the sky is hidden, and the brightest part lies away from it.
static void what_is_taken_casts_shade(void **state)
{
    (void)state;
    Aabb box = {vec3(0, 0, 0), vec3(40, 40, 40)};
    ShadeGrid *grid = shade_grid_new(box, CELL, 1000000, NULL);
    int64_t row = grid->size[0];
    for (int64_t i = 0; i < grid->count; i++) {
        grid->taken[i] = (float)(i % row) * grid->cell >= 24.0f;
    }
    assert_true(shade_grid_solve(grid, 2, NULL));
    Vec3 p = vec3(21, 3, 20);
    assert_true(fabsf(shade_grid_light(grid, p) - 0.5f) < 0.1f);
    assert_true(shade_grid_light(grid, vec3(3, 3, 20)) > shade_grid_light(grid, p) + 0.1f);
    assert_true(shade_grid_brightest(grid, p).x < -0.1f);
    shade_grid_free(grid);
}

static void the_grid_keeps_to_its_limit(void **state)
{
    (void)state;
    Aabb box = {vec3(0, 0, 0), vec3(1000, 900, 800)};
    ShadeGrid *grid = shade_grid_new(box, 1.0f, 50000, NULL);
    assert_non_null(grid);
    assert_true(grid->count <= 50000 && grid->count > 20000);
    shade_grid_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grid_agrees_with_rays), cmocka_unit_test(no_light_is_caught_twice),
        cmocka_unit_test(leaves_never_make_light),   cmocka_unit_test(a_lone_leaf_has_all_light),
        cmocka_unit_test(what_is_taken_casts_shade), cmocka_unit_test(the_grid_keeps_to_its_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
