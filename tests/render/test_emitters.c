// Glowing geometry as lights: against closed forms, sampling against densities, the tree against
// brute force, and both ways of finding light against each other.
#include "tiny_world.h"

#include "base/random.h"
#include "mesh/curves.h"
#include "render/accel/accel.h"

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

static void make_glowing(World *world, int index, float radiance)
{
    world->material[index] = material_default(MATERIAL_EMISSION);
    world->material[index].radiance = vec3_splat(radiance);
    world->material_count = index + 1;
}

// Looks straight down at one point of a plane through a very long lens, past what glows.
static World *plane_world(int samples)
{
    World *world = tiny_world(8, 8, samples, 1.0f);
    world->render.max_depth = 1;
    world->camera =
        (Camera){.position = {0.0f, 0.3f, 0.0f}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov = 0.5f};
    add_mesh(world, quad_mesh(vec3(-40, 0, 40), vec3(80, 0, 0), vec3(0, 0, -80)), 0, 0);
    make_glowing(world, 1, 1.0f);
    return world;
}

static CurveSet *chain(int points, const Vec3 *position, const float *radius)
{
    CurveSet *curves = curves_new(points, 1, NULL);
    assert_non_null(curves);
    memcpy(curves->position, position, sizeof *position * (size_t)points);
    memcpy(curves->radius, radius, sizeof *radius * (size_t)points);
    curves->first[1] = points;
    return curves;
}

static void add_curves(World *world, CurveSet *curves, int material)
{
    add_part(world, (Part){.kind = PART_CURVES, .curves = curves, .material = material});
}

// Unit radiance from a square 2 x 2 one metre above: as for a lamp of that shape.
static void quad_irradiance_closed_form(void **state)
{
    (void)state;
    World *world = plane_world(256);
    add_mesh(world, quad_mesh(vec3(-1, 1, -1), vec3(2, 0, 0), vec3(0, 0, 2)), 1, 1);
    Film *film = trace(world, 2, NULL);
    double a = 1.0 / sqrt(2.0), corner = 2.0 * a * atan(a) / (2.0 * (double)PI_F);
    ASSERT_NEAR(mean_luminance(film), 4.0 * corner, 0.004);
    film_free(film);
    world_free(world);
}

// An endless cylinder of radius r, radiance L, its axis h above a plane and parallel to it, lights
// the point below with pi L r / h; a white diffuse plane then has the radiance L r / h.
static void cylinder_irradiance_closed_form(void **state)
{
    (void)state;
    World *world = plane_world(256);
    add_curves(world, chain(2, (Vec3[]){{-40, 1, 0}, {40, 1, 0}}, (float[]){0.05f, 0.05f}), 1);
    Film *film = trace(world, 2, NULL);
    ASSERT_NEAR(mean_luminance(film), 0.05, 0.0003 + 3.0 * mean_error(film));
    assert_true(mean_error(film) < 0.0005);
    film_free(film);
    world_free(world);
}

// Glow doubles along the chain: from 0 at one end to 2 at the other, it lights the middle as 1.
static void glow_scales_the_radiance(void **state)
{
    (void)state;
    World *world = plane_world(256);
    CurveSet *curves =
        chain(3, (Vec3[]){{-40, 1, 0}, {0, 1, 0}, {40, 1, 0}}, (float[]){0.05f, 0.05f, 0.05f});
    curves->glow = memory_alloc(3, sizeof(float), NULL);
    memcpy(curves->glow, (float[]){0.0f, 1.0f, 2.0f}, 3 * sizeof(float));
    add_curves(world, curves, 1);
    Film *film = trace(world, 2, NULL);
    ASSERT_NEAR(mean_luminance(film), 0.05, 0.0003 + 3.0 * mean_error(film));
    film_free(film);
    world_free(world);
}

// ---- sampling one piece

// Mean of 1 / pdf over samples: the solid angle under which the piece is seen. It must equal the
// share of uniform directions that a ray finds it in.
static void expect_solid_angle(const Emitter *emitter, Vec3 from, double wanted, double tolerance)
{
    enum { N = 300 };
    double sum = 0.0;
    for (int i = 0; i < N * N; i++) {
        float u[2] = {((float)(i % N) + 0.5f) / N, ((float)(i / N) + 0.5f) / N};
        EmitterSample s;
        if (emitter_sample(emitter, from, u, &s)) {
            sum += 1.0 / (double)s.pdf;
            ASSERT_NEAR(emitter_pdf(emitter, from, s.position) / s.pdf, 1.0, 0.02);
        }
    }
    ASSERT_NEAR(sum / (N * N) / wanted, 1.0, tolerance);
}

static void samples_cover_the_solid_angle(void **state)
{
    (void)state;
    // a triangle that spans an octant
    Emitter triangle = emitter_triangle(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), true, 0);
    expect_solid_angle(&triangle, vec3(0, 0, 0), 0.5 * (double)PI_F, 0.003);
    // a long cylinder seen from near: a strip of half angle asin(r / h)
    Emitter cone = emitter_cone(vec3(-500, 0, 0), vec3(500, 0, 0), 0.3f, 0.3f, 1, 1, 0);
    expect_solid_angle(&cone, vec3(0, 1, 0), 4.0 * asin(0.3), 0.005);
    // from afar: length times width over squared distance
    Emitter rod = emitter_cone(vec3(-1, 0, 0), vec3(1, 0, 0), 0.01f, 0.01f, 1, 1, 0);
    expect_solid_angle(&rod, vec3(0, 50, 0), 2.0 * 0.02 / 2500.0, 0.002);
    // a tapered one, seen across: the silhouette is a trapezium
    Emitter taper = emitter_cone(vec3(-1, 0, 0), vec3(1, 0, 0), 0.4f, 0.1f, 1, 1, 0);
    expect_solid_angle(&taper, vec3(0, 400, 0), 2.0 * 0.5 / (400.0 * 400.0) * (1.0 - 0.15 * 0.15),
                       0.02);
    // half a ball from its pole: from so near not all of it is seen
    Emitter cap = emitter_cap(vec3(0, 0, 0), 1.0f, vec3(0, 1, 0), 1.0f, 0);
    expect_solid_angle(&cap, vec3(0, 2, 0), 2.0 * (double)PI_F * (1.0 - sqrt(0.75)), 0.003);
}

// Pivoted samples, reweighted by the ratio of the densities, cover the same.
static void pivots_cover_the_solid_angle(void **state)
{
    (void)state;
    enum { N = 400 };
    Emitter cone = emitter_cone(vec3(-2, 0, 0), vec3(3, 0, 0), 0.3f, 0.2f, 1, 1, 0);
    Vec3 from = vec3(0.3f, 1, 0);
    double plain = 0.0, pivoted = 0.0;
    for (int i = 0; i < N * N; i++) {
        float u[2] = {((float)(i % N) + 0.5f) / N, ((float)(i / N) + 0.5f) / N};
        EmitterSample s;
        if (emitter_sample(&cone, from, u, &s)) {
            plain += 1.0 / (double)s.pdf / (N * N);
        }
        if (emitter_sample_pivoted(&cone, from, u, &s)) {
            pivoted += 1.0 / (double)(s.pdf * s.pivot_ratio) / (N * N);
        }
    }
    ASSERT_NEAR(pivoted / plain, 1.0, 0.005);
}

// ---- the tree

enum { MANY = 10000 };

// Small rods scattered in a box, a few of them far brighter.
static Emitter *scattered(int count)
{
    Emitter *emitter = memory_alloc(count, sizeof *emitter, NULL);
    assert_non_null(emitter);
    for (int i = 0; i < count; i++) {
        uint64_t key = random_key(99, (uint64_t)i);
        Vec3 p = vec3(random_range(random_key(key, 0), -10, 10),
                      random_range(random_key(key, 1), 0.2f, 6),
                      random_range(random_key(key, 2), -10, 10));
        Vec3 q = vec3_madd(p, 0.05f, random_direction(random_key(key, 3)));
        float glow = i % 100 == 0 ? 20.0f : 1.0f;
        emitter[i] = i % 3 ? emitter_cone(p, q, 0.01f, 0.008f, glow, glow, 0)
                           : emitter_triangle(p, q, vec3_add(q, vec3(0, 0.02f, 0.01f)), true, 0);
    }
    return emitter;
}

static LightTree *tree_over(const Emitter *emitter, int count)
{
    LightBounds *bounds = memory_alloc(count, sizeof *bounds, NULL);
    assert_non_null(bounds);
    for (int i = 0; i < count; i++) {
        bounds[i] = emitter_bounds(&emitter[i], 1.0f);
    }
    Run run = run_default();
    LightTree *tree = light_tree_new(bounds, count, &run, NULL);
    assert_non_null(tree);
    free(bounds);
    return tree;
}

static void a_cancelled_tree_is_not_built(void **state)
{
    (void)state;
    enum { COUNT = 1000 };
    LightBounds bounds[COUNT];
    for (int i = 0; i < COUNT; i++) {
        Vec3 p = {(float)i, 0, 0};
        Emitter emitter = emitter_triangle(p, vec3_add(p, vec3(1, 0, 0)), vec3(0, 1, 0), true, 0);
        bounds[i] = emitter_bounds(&emitter, 1.0f);
    }
    volatile int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    Error e = {0};
    assert_null(light_tree_new(bounds, COUNT, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
}

// Probabilities sum to one, and each is how often its light is drawn.
static void tree_draws_as_it_says(void **state)
{
    (void)state;
    enum { FEW = 300, DRAWS = 200000 };
    Emitter *emitter = scattered(FEW);
    LightTree *tree = tree_over(emitter, FEW);
    LightReceiver points[] = {
        {{0, 0, 0}, {0, 1, 0}}, {{3, 2, -4}, {0, 0, 0}}, {{40, 5, 0}, {-1, 0, 0}}};
    LightSegment segment = {{-12, 2, 0.1f}, {1, 0, 0}, 0.0f, 30.0f};
    for (int k = 0; k < 4; k++) {
        double sum = 0.0, drawn[FEW] = {0.0}, worst = 0.0;
        for (int i = 0; i < DRAWS; i++) {
            float p, u = ((float)i + 0.5f) / DRAWS;
            int64_t light = k < 3 ? light_tree_sample(tree, &points[k], u, &p)
                                  : light_tree_sample_segment(tree, &segment, u, &p);
            assert_true(light >= 0);
            drawn[light] += 1.0 / DRAWS;
        }
        for (int i = 0; i < FEW; i++) {
            float p = k < 3 ? light_tree_probability(tree, &points[k], i)
                            : light_tree_probability_segment(tree, &segment, i);
            sum += (double)p;
            worst = fmax(worst, fabs((double)p - drawn[i]));
        }
        ASSERT_NEAR(sum, 1.0, 1e-4);
        ASSERT_NEAR(worst, 0.0, 2e-4);
    }
    light_tree_free(tree);
    free(emitter);
}

// Irradiance at a receiver: the sum over all lights by brute force, and the mean and variance of
// single draws, by the tree and by even choice.
static double contribution(const Emitter *emitter, const LightReceiver *at, const float u[2])
{
    EmitterSample s;
    if (!emitter_sample(emitter, at->position, u, &s)) {
        return 0.0;
    }
    return (double)(s.glow * fmaxf(vec3_dot(s.direction, at->normal), 0.0f) / s.pdf);
}

static void tree_beats_even_choice(void **state)
{
    (void)state;
    enum { DRAWS = 200000 };
    Emitter *emitter = scattered(MANY);
    LightTree *tree = tree_over(emitter, MANY);
    LightReceiver at = {{2, 0, 1}, {0, 1, 0}};
    double brute = 0.0, mean[2] = {0.0}, square[2] = {0.0};
    for (int i = 0; i < 16 * MANY; i++) {
        float u[2] = {random_unit(random_key(5, (uint64_t)i)),
                      random_unit(random_key(6, (uint64_t)i))};
        brute += contribution(&emitter[i % MANY], &at, u) / 16.0;
    }
    for (int i = 0; i < DRAWS; i++) {
        uint64_t key = random_key(7, (uint64_t)i);
        float u[2] = {random_unit(random_key(key, 0)), random_unit(random_key(key, 1))};
        float v = random_unit(random_key(key, 2)), p;
        int64_t light = light_tree_sample(tree, &at, v, &p);
        double by_tree = light < 0 ? 0.0 : contribution(&emitter[light], &at, u) / (double)p;
        double evenly = contribution(&emitter[(int)(v * MANY)], &at, u) * MANY;
        mean[0] += by_tree / DRAWS;
        mean[1] += evenly / DRAWS;
        square[0] += by_tree * by_tree / DRAWS;
        square[1] += evenly * evenly / DRAWS;
    }
    double deviation[2] = {sqrt(square[0] - mean[0] * mean[0]),
                           sqrt(square[1] - mean[1] * mean[1])};
    ASSERT_NEAR(mean[0] / brute, 1.0, 0.02);
    print_message("deviation of one draw over the mean: tree %.2f, even choice %.2f\n",
                  deviation[0] / brute, deviation[1] / brute);
    assert_true(deviation[0] < 0.4 * deviation[1]);
    light_tree_free(tree);
    free(emitter);
}

// ---- both ways of finding light

// A net of glowing curves, thick ones, over a ball on a floor.
static World *net_world(int samples)
{
    World *world = tiny_world(16, 16, samples, 0.8f);
    world->render.max_depth = 3;
    world->camera.position = vec3(0, 2, 5);
    add_mesh(world, quad_mesh(vec3(-4, -1, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 0);
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 0.7f, 16, true), 0, 1);
    make_glowing(world, 1, 3.0f);
    for (int i = 0; i < 6; i++) {
        float x = -2.5f + (float)i;
        add_curves(world,
                   chain(4, (Vec3[]){{x, 1, -3}, {x + 0.4f, 1.5f, -1}, {x, 1.2f, 1}, {x, 2, 3}},
                         (float[]){0.3f, 0.2f, 0.15f, 0.1f}),
                   1);
    }
    return world;
}

// Directions drawn by the surface alone, without light sampling: every hit counts in full.
static double by_chance(const World *world, double *error)
{
    Run run = run_default();
    Error e = {0};
    MaterialSet *materials =
        material_set_new(world->material, NULL, world->material_count, NULL, &e);
    Accel *accel = accel_new(world, materials, NULL, &run, &e);
    assert_non_null(accel);
    enum { N = 400000 };
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < N; i++) {
        uint64_t key = random_key(31, (uint64_t)i);
        float z = sqrtf(random_unit(random_key(key, 0))),
              a = 2.0f * PI_F * random_unit(random_key(key, 1));
        float r = sqrtf(1.0f - z * z);
        Ray ray = {.origin = {0.9f, -0.99999f, 0.8f},
                   .direction = {r * cosf(a), z, r * sinf(a)},
                   .far = INFINITY};
        Hit hit;
        bool glow = accel_intersect(accel, &ray, &hit) && accel_place(accel, &hit).part >= 2;
        sum += glow ? 3.0 : 0.0;
        square += glow ? 9.0 : 0.0;
    }
    accel_free(accel);
    material_set_free(materials);
    *error = sqrt((square / N - sum * sum / N / N) / N);
    return 0.8 * sum / N;
}

static void weighted_light_equals_chance(void **state)
{
    (void)state;
    World *world = net_world(256);
    world->render.max_depth = 1;
    world->camera.position = vec3(0.9f, -0.5f, 0.8f);
    world->camera.target = vec3(0.9f, -1.0f, 0.8f);
    world->camera.up = vec3(0, 0, 1);
    world->camera.fov = 0.1f;
    double chance_error, chance = by_chance(world, &chance_error);
    Film *film = trace(world, 2, NULL);
    // Fat curves overlap a little in their joints, which light sampling does not know of.
    ASSERT_NEAR(mean_luminance(film), chance,
                0.015 * chance + 3.0 * (chance_error + mean_error(film)));
    film_free(film);
    world_free(world);
}

static void same_bits_for_any_thread_count(void **state)
{
    (void)state;
    World *world = net_world(8);
    Film *one = trace(world, 1, NULL), *three = trace(world, 3, NULL);
    assert_memory_equal(one->color, three->color, sizeof(Vec3) * 16 * 16);
    film_free(one);
    film_free(three);
    world_free(world);
}

// Instanced curves and copied meshes light as they do in place.
static void instances_glow_alike(void **state)
{
    (void)state;
    double mean[2];
    for (int k = 0; k < 2; k++) {
        World *world = plane_world(64);
        for (int part = 0; part < 2; part++) {
            Vec3 low = k ? vec3(0, 0, 0) : vec3(part ? 0.5f : -1.5f, 1.5f, 0.5f);
            Part glowing = {.kind = part ? PART_MESH : PART_CURVES, .material = 1};
            if (part) {
                glowing.mesh = quad_mesh(low, vec3(1, 0, 0), vec3(0, 0.3f, 0));
            } else {
                glowing.curves = chain(
                    3,
                    (Vec3[]){low, vec3_add(low, vec3(0.5f, 0, 0.1f)), vec3_add(low, vec3(1, 0, 0))},
                    (float[]){0.1f, 0.05f, 0.1f});
            }
            if (k) {
                glowing.instance = memory_alloc(1, sizeof(Transform), NULL);
                glowing.instance_count = 1;
                glowing.instance[0] = transform_compose(vec3(part ? 0.5f : -1.5f, 1.5f, 0.5f),
                                                        vec3_splat(0), vec3_splat(1));
            }
            add_part(world, glowing);
        }
        Film *film = trace(world, 2, NULL);
        mean[k] = mean_luminance(film);
        film_free(film);
        world_free(world);
    }
    assert_true(mean[0] > 0.01);
    ASSERT_NEAR(mean[1] / mean[0], 1.0, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cancelled_tree_is_not_built),
        cmocka_unit_test(quad_irradiance_closed_form),
        cmocka_unit_test(cylinder_irradiance_closed_form),
        cmocka_unit_test(glow_scales_the_radiance),
        cmocka_unit_test(samples_cover_the_solid_angle),
        cmocka_unit_test(pivots_cover_the_solid_angle),
        cmocka_unit_test(tree_draws_as_it_says),
        cmocka_unit_test(tree_beats_even_choice),
        cmocka_unit_test(weighted_light_equals_chance),
        cmocka_unit_test(same_bits_for_any_thread_count),
        cmocka_unit_test(instances_glow_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
