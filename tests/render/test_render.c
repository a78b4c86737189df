// The whole renderer: energy, determinism, instances, curves, film planes, interruption.
#include "tiny_world.h"

#include "base/random.h"
#include "image/image.h"
#include "render/accel/accel.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

static Vec3 center_color(const Film *film)
{
    return film->color[film->height / 2 * film->width + film->width / 2];
}

// ---- energy

// A white body under a uniformly white sky cannot be told from it.
static void white_under_white_sky_is_white(void **state)
{
    (void)state;
    World *world = tiny_world(16, 16, 16, 1.0f);
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(1.0f);
    world->render.max_depth = world->render.roulette_depth = 60;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 12, true), 0, 0);
    add_mesh(world, quad_mesh(vec3(-4, -1, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 1);
    Film *film = trace(world, 2, NULL);
    for (int i = 0; i < 16 * 16; i++) {
        ASSERT_NEAR(luminance(film->color[i]), 1.0, 0.01);
    }
    film_free(film);
    world_free(world);
}

// Inside a closed grey sphere that glows with radiance E everywhere, light is E / (1 - albedo).
static void closed_furnace(void **state)
{
    (void)state;
    World *world = tiny_world(16, 16, 64, 0.5f);
    world->material[0].kind = MATERIAL_EMISSION;
    world->material[0].radiance = vec3_splat(1.0f);
    world->material[1] = material_default(MATERIAL_DIFFUSE);
    world->material[1].color = vec3_splat(0.5f);
    world->material[1].roughness = 0.0f;
    world->material_count = 2;
    world->render.max_depth = world->render.roulette_depth = 40;
    // The furnace: a diffuse ball in the middle of a glowing shell: it must vanish but for its
    // albedo.
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 20.0f, 16, false), 0, 0);
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 24, true), 1, 1);
    Film *film = trace(world, 2, NULL);
    ASSERT_NEAR(center_color(film).x, 0.5, 0.01);
    ASSERT_NEAR(film->color[0].x, 1.0, 1e-4);
    film_free(film);
    world_free(world);
}

// Roulette and depth keep the mean.
static void roulette_is_unbiased(void **state)
{
    (void)state;
    double mean[2], error = 0.0;
    for (int k = 0; k < 2; k++) {
        World *world = tiny_world(16, 16, 256, 0.7f);
        world->sky.kind = SKY_CONSTANT;
        world->sky.color = vec3_splat(1.0f);
        world->sky.visible = false;
        world->render.max_depth = 30;
        world->render.roulette_depth = k ? 1 : 30;
        add_mesh(world, sphere_mesh(vec3(-0.6f, 0, 0), 0.6f, 16, true), 0, 0);
        add_mesh(world, sphere_mesh(vec3(0.6f, 0, 0), 0.6f, 16, true), 0, 0);
        Film *film = trace(world, 2, NULL);
        mean[k] = mean_luminance(film);
        error += mean_error(film);
        film_free(film);
        world_free(world);
    }
    ASSERT_NEAR(mean[0], mean[1], 3.0 * error);
    assert_true(error < 0.01 * mean[0]);
}

// ---- determinism

static void assert_same_film(const Film *a, const Film *b)
{
    size_t n = (size_t)a->width * (size_t)a->height;
    assert_memory_equal(a->color, b->color, n * sizeof(Vec3));
    assert_memory_equal(a->light, b->light, n * sizeof(Vec3));
    assert_memory_equal(a->sky, b->sky, n * sizeof(Vec3));
    assert_memory_equal(a->light_share, b->light_share, n * sizeof(float));
    assert_memory_equal(a->sky_share, b->sky_share, n * sizeof(float));
    assert_memory_equal(a->albedo, b->albedo, n * sizeof(Vec3));
    assert_memory_equal(a->normal, b->normal, n * sizeof(Vec3));
    assert_memory_equal(a->position, b->position, n * sizeof(Vec3));
    assert_memory_equal(a->depth, b->depth, n * sizeof(float));
    assert_memory_equal(a->alpha, b->alpha, n * sizeof(float));
    assert_memory_equal(a->object, b->object, n * sizeof(float));
    assert_memory_equal(a->samples, b->samples, n * sizeof(float));
    assert_memory_equal(a->variance, b->variance, n * sizeof(float));
}

static World *varied_world(void)
{
    World *world = tiny_world(50, 37, 24, 0.6f);
    world->sky.kind = SKY_SUN_SKY;
    world->film.filter = FILTER_BLACKMAN_HARRIS;
    world->film.filter_radius = 1.5f;
    world->camera.aperture = 0.1f;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 0.8f, 12, true), 0, 0);
    add_mesh(world, quad_mesh(vec3(-4, -1, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 1);
    return world;
}

static void same_bits_for_any_thread_count(void **state)
{
    (void)state;
    World *world = varied_world();
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        world->render.max_noise = adaptive ? 0.05f : 0.0f;
        RenderStats stats;
        Film *one = trace(world, 1, &stats), *two = trace(world, 2, NULL),
             *three = trace(world, 3, NULL);
        assert_same_film(one, two);
        assert_same_film(one, three);
        assert_true(adaptive ? stats.samples < 24 : stats.samples == 24);
        assert_true(adaptive ? stats.paths < 50 * 37 * 24 : stats.paths == 50 * 37 * 24);
        film_free(one);
        film_free(two);
        film_free(three);
    }
    world_free(world);
}

// A crop moves the tiles about, but its pixels are those of the whole picture.
static void crop_gives_the_same_pixels(void **state)
{
    (void)state;
    World *world = varied_world();
    Film *whole = trace(world, 2, NULL);
    memcpy(world->film.crop, (float[4]){0.3f, 0.2f, 0.8f, 0.9f}, sizeof world->film.crop);
    Film *crop = trace(world, 2, NULL);
    int covered = 0;
    for (int i = 0; i < 50 * 37; i++) {
        int x = i % 50, y = i / 50;
        bool inside = x >= 15 && x < 40 && y >= 7 && y < 33;
        if (inside) {
            assert_memory_equal(&whole->color[i], &crop->color[i], sizeof(Vec3));
            covered++;
        }
        assert_true(crop->samples[i] == (inside ? 24.0f : 0.0f));
    }
    assert_int_equal(covered, 25 * 26);
    film_free(whole);
    film_free(crop);
    world_free(world);
}

static bool same_hit(const Hit *a, const Hit *b)
{
    return a->geometry == b->geometry && a->primitive == b->primitive &&
           fabsf(a->t - b->t) < 4e-6f * b->t && fabsf(a->u - b->u) < 1e-4f &&
           fabsf(a->v - b->v) < 1e-4f;
}

// Rays in packets meet what they meet alone. Some may differ that graze an edge.
static void packets_meet_what_rays_meet(void **state)
{
    (void)state;
    enum { RAYS = 37, ROUNDS = 400 };
    World *world = varied_world();
    Run run = run_default();
    Error e = {0};
    MaterialSet *materials =
        material_set_new(world->material, NULL, world->material_count, NULL, &e);
    Accel *accel = accel_new(world, materials, NULL, &run, &e);
    assert_non_null(accel);
    int hits = 0, blocks = 0, different = 0;
    for (int round = 0; round < ROUNDS; round++) {
        Ray ray[RAYS];
        Hit hit[RAYS], alone;
        bool met[RAYS], blocked[RAYS];
        int count = 1 + round % RAYS;
        for (int i = 0; i < count; i++) {
            uint64_t key = random_key((uint64_t)round, (uint64_t)i);
            Vec3 to = vec3(2.0f * random_unit(random_key(key, 0)) - 1.0f,
                           2.0f * random_unit(random_key(key, 1)) - 1.0f,
                           -4.0f * random_unit(random_key(key, 2)));
            ray[i] = (Ray){.origin = {0, 0, 5}, .direction = vec3_normalize(to), .far = INFINITY};
        }
        accel_intersect_many(accel, ray, count, hit, met);
        accel_occluded_many(accel, ray, count, blocked);
        for (int i = 0; i < count; i++) {
            bool same = accel_intersect(accel, &ray[i], &alone) == met[i] &&
                        (!met[i] || same_hit(&hit[i], &alone)) &&
                        accel_occluded(accel, &ray[i]) == blocked[i];
            different += !same;
            hits += met[i];
            blocks += blocked[i];
        }
    }
    assert_true(hits > ROUNDS && blocks > ROUNDS);
    assert_true(different < 5);
    accel_free(accel);
    material_set_free(materials);
    world_free(world);
}

static void seed_changes_noise_only(void **state)
{
    (void)state;
    World *world = varied_world();
    Film *a = trace(world, 2, NULL);
    world->render.seed++;
    Film *b = trace(world, 2, NULL);
    assert_memory_not_equal(a->color, b->color, 50 * 37 * sizeof(Vec3));
    ASSERT_NEAR(mean_luminance(a), mean_luminance(b), 4.0 * (mean_error(a) + mean_error(b)));
    film_free(a);
    film_free(b);
    world_free(world);
}

// ---- geometry

static Transform turned(float scale, Vec3 at)
{
    return transform_compose(at, vec3(20, 40, 60), vec3(scale, scale * 1.3f, scale));
}

// The same bodies as instances and baked: the same picture up to rounding. The renderer copies
// small meshes out and instances large ones.
static void check_instances(int faces_around)
{
    enum { COUNT = 5 };
    Film *film[2];
    for (int baked = 0; baked < 2; baked++) {
        World *world = tiny_world(32, 32, 32, 0.6f);
        world->sky.kind = SKY_CONSTANT;
        world->sky.visible = false;
        Transform *instance = memory_alloc(COUNT, sizeof *instance, NULL);
        for (int i = 0; i < COUNT; i++) {
            instance[i] = turned(0.3f, vec3(0.4f * (float)i - 0.8f, 0.2f * (float)(i % 2), 0));
        }
        for (int i = 0; i < (baked ? COUNT : 1); i++) {
            Mesh *mesh = sphere_mesh(vec3(0, 0.5f, 0), 1.0f, faces_around, true);
            if (baked) {
                assert_true(mesh_transform(mesh, &instance[i], NULL));
                add_mesh(world, mesh, 0, 0);
            } else {
                add_part(world, (Part){.kind = PART_MESH,
                                       .mesh = mesh,
                                       .instance = instance,
                                       .instance_count = COUNT});
            }
        }
        film[baked] = trace(world, 2, NULL);
        world_free(world);
        if (baked) {
            free(instance);
        }
    }
    for (int i = 0; i < 32 * 32; i++) {
        ASSERT_NEAR(film[0]->alpha[i], film[1]->alpha[i], 0.04);
        ASSERT_NEAR(luminance(film[0]->color[i]), luminance(film[1]->color[i]), 0.1);
    }
    ASSERT_NEAR(mean_luminance(film[0]), mean_luminance(film[1]), 1e-3);
    film_free(film[0]);
    film_free(film[1]);
}

static void small_instances_equal_baked_meshes(void **state)
{
    (void)state;
    check_instances(8);
}

static void large_instances_equal_baked_meshes(void **state)
{
    (void)state;
    check_instances(16);
}

// Light through a slab of coloured glass: Beer-Lambert over the way inside, and Fresnel's share at
// both faces (4 % each, with what is reflected to and fro).
static void absorption_in_glass(void **state)
{
    (void)state;
    World *world = tiny_world(4, 4, 256, 0.5f);
    world->camera.fov = 0.5f;
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(1.0f);
    world->material[0] = material_default(MATERIAL_DIELECTRIC);
    world->material[0].ior = 1.5f;
    world->material[0].roughness = 0.0f;
    world->material[0].absorption = vec3(0.0f, 0.5f, 2.0f);
    world->render.max_depth = world->render.roulette_depth = 20;
    add_mesh(world, quad_mesh(vec3(-9, -9, 0), vec3(18, 0, 0), vec3(0, 18, 0)), 0, 0);
    add_mesh(world, quad_mesh(vec3(-9, -9, -1), vec3(0, 18, 0), vec3(18, 0, 0)), 0, 0);
    Film *film = trace(world, 2, NULL);
    const double absorption[3] = {0.0, 0.5, 2.0}, r = 0.04;
    const Vec3 c = center_color(film);
    const float channel[3] = {c.x, c.y, c.z};
    for (int k = 0; k < 3; k++) {
        double t = exp(-absorption[k]);
        double through = (1 - r) * (1 - r) * t / (1 - r * r * t * t);
        double back = r + (1 - r) * (1 - r) * t * t * r / (1 - r * r * t * t);
        ASSERT_NEAR(channel[k], through + back, 0.015);
    }
    film_free(film);
    world_free(world);
}

// A quarter opaque: a quarter of the rays stop, of camera rays and of shadow rays alike.
static void alpha_texture_cuts(void **state)
{
    (void)state;
    char name[] = "/tmp/ramify_test_XXXXXX.exr";
    int file = mkstemps(name, 4);
    assert_true(file >= 0);
    close(file);
    Image *image = image_new(4, 4, 4, NULL);
    assert_non_null(image);
    for (int i = 0; i < 64; i++) {
        image->pixel[i] = 0.25f;
    }
    ImageLayer layer = {"", "RGBA", image};
    assert_true(image_write_exr(name, &layer, 1, NULL, NULL));
    image_free(image);
    World *world = tiny_world(16, 16, 64, 0.0f);
    world->camera.fov = 0.5f;
    world->material[0].alpha_texture = name;
    world->material[1] = material_default(MATERIAL_DIFFUSE);
    world->material[1].color = vec3_splat(1.0f);
    world->material[1].roughness = 0.0f;
    world->material_count = 2;
    Mesh *veil = quad_mesh(vec3(-9, -9, 0), vec3(18, 0, 0), vec3(0, 18, 0));
    veil->uv = memory_alloc_zero(4, sizeof(Vec2), NULL);
    assert_non_null(veil->uv);
    veil->uv[1].x = veil->uv[2].x = veil->uv[2].y = veil->uv[3].y = 1.0f;
    add_mesh(world, veil, 0, 0);
    add_mesh(world, quad_mesh(vec3(-9, -9, -1), vec3(18, 0, 0), vec3(0, 18, 0)), 1, 1);
    add_light(world, (Light){.kind = LIGHT_SPHERE,
                             .radiance = vec3_splat(1e4f / PI_F),
                             .center = {0, 0, 99},
                             .radius = 1.0f});
    Film *film = trace(world, 2, NULL);
    double through = 0.0;
    for (int i = 0; i < 16 * 16; i++) {
        through += (double)film->albedo[i].x / (16 * 16);
    }
    ASSERT_NEAR(through, 0.75, 0.015);
    // Irradiance behind the veil: 1e4 / 1e4 * 0.75; seen through the veil: * 0.75 / pi.
    ASSERT_NEAR(mean_luminance(film) * (double)PI_F, 0.75 * 0.75, 0.02);
    film_free(film);
    world_free(world);
    unlink(name);
}

static CurveSet *straight_curve(Vec3 from, Vec3 to, float radius, int points)
{
    CurveSet *curves = curves_new(points, 1, NULL);
    assert_non_null(curves);
    for (int i = 0; i < points; i++) {
        curves->position[i] = vec3_lerp(from, to, (float)i / (float)(points - 1));
        curves->radius[i] = radius;
    }
    curves->first[0] = 0;
    curves->first[1] = points;
    return curves;
}

// A round curve is a cylinder: as wide as it should be, lit as one, alone and as an instance.
static void curves_are_hit(void **state)
{
    (void)state;
    for (int instanced = 0; instanced < 2; instanced++) {
        World *world = tiny_world(64, 64, 16, 1.0f);
        world->sky.kind = SKY_CONSTANT;
        world->sky.color = vec3_splat(1.0f);
        world->sky.visible = false;
        world->camera.fov = 20.0f;
        world->camera.position = vec3(0, 0, 100);
        world->camera.fov = 2.0f / 100.0f / RADIANS_PER_DEGREE; // 2 m across
        Part part = {.kind = PART_CURVES, .object = 4};
        float scale = instanced ? 0.5f : 1.0f;
        part.curves = straight_curve(vec3(0, -5, 0), vec3(0, 5, 0), 0.4f / scale, 6);
        if (instanced) {
            part.instance = memory_alloc(1, sizeof *part.instance, NULL);
            part.instance[0] = transform_compose(vec3(0, 0, 0), vec3(0, 30, 0), vec3_splat(scale));
            part.instance_count = 1;
        }
        add_part(world, part);
        Film *film = trace(world, 2, NULL);
        double alpha = 0.0;
        for (int i = 0; i < 64 * 64; i++) {
            alpha += (double)film->alpha[i] / (64 * 64);
            if (film->alpha[i] >= 1.0f) {
                ASSERT_NEAR(film->color[i].x, 1.0, 0.02); // white furnace on a convex body
                ASSERT_NEAR(film->object[i], 5.0, 0.0);
            }
        }
        ASSERT_NEAR(alpha, 0.4, 0.005);
        ASSERT_NEAR(film->depth[32 * 64 + 32], 99.6, 0.01);
        ASSERT_NEAR(film->normal[32 * 64 + 32].z, 1.0, 0.01);
        film_free(film);
        world_free(world);
    }
}

// Smooth normals and few faces: the terminator must not show the facets. Along a row over the lit
// side brightness falls without steps.
static void no_shadow_terminator(void **state)
{
    (void)state;
    World *world = tiny_world(96, 96, 64, 1.0f);
    world->camera.position = vec3(0, 0, 50);
    world->camera.fov = 2.2f;
    world->render.max_depth = 1;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 0.9f, 8, true), 0, 0);
    add_light(world, (Light){.kind = LIGHT_SPHERE,
                             .radiance = vec3_splat(1e4f),
                             .center = {200, 0, 0},
                             .radius = 0.5f});
    Film *film = trace(world, 2, NULL);
    double scale = 1e4 * 0.25 / (200.0 * 200.0);
    for (int x = 50; x < 70; x++) { // from the terminator to the lit side
        for (int y = 40; y < 56; y++) {
            int i = y * 96 + x;
            double cosine = fmax(0.0, (double)film->normal[i].x);
            ASSERT_NEAR((double)film->color[i].x / scale, cosine, 0.03 + 0.1 * cosine);
        }
    }
    film_free(film);
    world_free(world);
}

// ---- film

static void empty_world_is_transparent_black(void **state)
{
    (void)state;
    World *world = tiny_world(8, 8, 2, 0.5f);
    world->material_count = 0;
    Film *film = trace(world, 1, NULL);
    for (int i = 0; i < 64; i++) {
        assert_true(film->alpha[i] == 0.0f && film->color[i].x == 0.0f && film->object[i] == 0.0f);
        assert_true(isinf(film->depth[i]));
    }
    film_free(film);
    world_free(world);
}

// Alpha is coverage; a hidden sky still lights; a visible one is opaque.
static void alpha_is_coverage(void **state)
{
    (void)state;
    World *world = tiny_world(40, 40, 16, 0.5f);
    world->camera.position = vec3(0, 0, 10);
    world->camera.fov = 2.0f * atanf(0.1f) / RADIANS_PER_DEGREE; // 2 m across at the origin
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(1.0f);
    world->sky.visible = false;
    add_mesh(world, quad_mesh(vec3(-1, -1, 0), vec3(1.0f, 0, 0), vec3(0, 2, 0)), 0, 2);
    Film *film = trace(world, 1, NULL);
    assert_true(film->alpha[20 * 40 + 5] == 1.0f && film->alpha[20 * 40 + 35] == 0.0f);
    ASSERT_NEAR(film->color[20 * 40 + 5].x, 0.5, 1e-3);
    assert_true(film->color[20 * 40 + 35].x == 0.0f);
    assert_true(film->object[20 * 40 + 5] == 3.0f);
    ASSERT_NEAR(film->albedo[20 * 40 + 5].y, 0.5, 1e-6);
    film_free(film);
    world->sky.visible = true;
    film = trace(world, 1, NULL);
    assert_true(film->alpha[20 * 40 + 35] == 1.0f && film->color[20 * 40 + 35].x == 1.0f);
    assert_true(film->albedo[20 * 40 + 35].x == 1.0f); // as the denoiser wants it
    film_free(film);
    world_free(world);
}

static void depth_and_position_of_a_plane(void **state)
{
    (void)state;
    World *world = tiny_world(33, 33, 1, 0.5f);
    add_mesh(world, quad_mesh(vec3(-9, -8, -1), vec3(18, 0, 0), vec3(0, 18, 0)), 0, 0);
    world->film.filter_radius = 1e-6f; // all samples in the middle of the pixel
    Film *film = trace(world, 1, NULL);
    float step = 2.0f * tanf(15.0f * RADIANS_PER_DEGREE) / 33.0f;
    for (int y = 0; y < 33; y++) {
        for (int x = 0; x < 33; x++) {
            int i = y * 33 + x;
            float a = ((float)x - 16.0f) * step, b = (16.0f - (float)y) * step;
            ASSERT_NEAR(film->depth[i], 6.0f * sqrtf(1.0f + a * a + b * b), 2e-5);
            ASSERT_NEAR(film->position[i].x, 6.0f * a, 2e-5);
            ASSERT_NEAR(film->position[i].y, 6.0f * b, 2e-5);
            ASSERT_NEAR(film->position[i].z, -1.0, 2e-5);
            ASSERT_NEAR(film->normal[i].z, 1.0, 1e-5);
        }
    }
    film_free(film);
    world_free(world);
}

// A mirror shows a wall beside it: albedo and normal are the wall's, place and depth the mirror's.
static void albedo_and_normal_follow_mirrors(void **state)
{
    (void)state;
    World *world = tiny_world(16, 16, 4, 0.3f);
    world->camera.fov = 4.0f;
    world->material_count = 2;
    world->material[1] = material_default(MATERIAL_CONDUCTOR);
    world->material[1].color = vec3(1.0f, 1.0f, 1.0f);
    world->material[1].roughness = 0.0f;
    add_mesh(world, quad_mesh(vec3(-1, -1, -1), vec3(2, 0, -2), vec3(0, 2, 0)), 1, 1);
    add_mesh(world, quad_mesh(vec3(4, -9, -20), vec3(0, 0, 40), vec3(0, 18, 0)), 0, 0);
    Film *film = trace(world, 2, NULL);
    int middle = 8 * 16 + 8;
    ASSERT_NEAR(film->albedo[middle].x, 0.3, 1e-4);
    ASSERT_NEAR(film->normal[middle].x, -1.0, 1e-4);
    ASSERT_NEAR(film->depth[middle], 7.0, 0.05);
    ASSERT_NEAR(film->object[middle], 2.0, 0.0);
    film_free(film);
    world_free(world);
}

// A pane of glass before a wall: what passes both faces has the wall's albedo, what they reflect is
// white as the sky.
static void albedo_follows_glass(void **state)
{
    (void)state;
    World *world = tiny_world(16, 16, 256, 0.3f);
    world->camera.fov = 4.0f;
    world->material_count = 2;
    world->material[1] = material_default(MATERIAL_DIELECTRIC);
    world->material[1].ior = 1.5f;
    world->material[1].roughness = 0.0f;
    add_mesh(world, quad_mesh(vec3(-1, -1, 1.0f), vec3(2, 0, 0), vec3(0, 2, 0)), 1, 1);
    add_mesh(world, quad_mesh(vec3(1, -1, 0.9f), vec3(-2, 0, 0), vec3(0, 2, 0)), 1, 1);
    add_mesh(world, quad_mesh(vec3(-9, -9, -1), vec3(18, 0, 0), vec3(0, 18, 0)), 0, 0);
    Film *film = trace(world, 2, NULL);
    double albedo = 0.0;
    for (int i = 0; i < 16 * 16; i++) {
        albedo += (double)film->albedo[i].x / (16 * 16);
    }
    double reflected = 2.0 * 0.04 / 1.04; // by two faces of 0.04, all orders
    ASSERT_NEAR(albedo, 0.3 * (1.0 - reflected) + reflected, 0.005);
    film_free(film);
    world_free(world);
}

// Width of the blur of a vertical edge, pixels: how many are neither covered nor free.
static int blurred_columns(float aperture, float edge_depth)
{
    World *world = tiny_world(64, 4, 64, 0.5f);
    world->camera.aperture = aperture;
    world->camera.focus_distance = 5.0f;
    world->camera.fov = 4.0f;
    add_mesh(world, quad_mesh(vec3(0.0f, -9, edge_depth), vec3(9, 0, 0), vec3(0, 18, 0)), 0, 0);
    Film *film = trace(world, 2, NULL);
    int count = 0;
    for (int x = 0; x < 64; x++) {
        count += film->alpha[2 * 64 + x] > 0.02f && film->alpha[2 * 64 + x] < 0.98f;
    }
    film_free(film);
    world_free(world);
    return count;
}

// In the plane of focus an edge is sharp, behind it as wide as the lens says: aperture times the
// distance from the plane over the distance.
static void thin_lens_focus(void **state)
{
    (void)state;
    assert_true(blurred_columns(0.0f, 0.0f) <= 2);
    assert_true(blurred_columns(0.2f, 0.0f) <= 2);
    // At z = -5, 10 m away, the edge is spread over 2.0 * 5 / 5 = 2 m of a picture 11 m wide: 11
    // columns, of which the outermost are almost covered or free.
    assert_in_range(blurred_columns(2.0f, -5.0f), 7, 14);
}

// Shift moves the picture by heights of the film without turning the camera.
static void lens_shift(void **state)
{
    (void)state;
    World *world = tiny_world(20, 20, 1, 0.5f);
    world->film.filter_radius = 1e-6f;
    world->camera.shift_y = 0.5f;
    add_mesh(world, quad_mesh(vec3(-9, -9, 0), vec3(18, 0, 0), vec3(0, 18, 0)), 0, 0);
    Film *film = trace(world, 1, NULL);
    float half = 5.0f * tanf(15.0f * RADIANS_PER_DEGREE);
    ASSERT_NEAR(film->position[19 * 20].y, half * (1.0f / 20.0f), 1e-4); // lowest row: the axis
    film_free(film);
    world_free(world);
}

// Far things fade into the horizon's colour.
static void haze_fades_with_distance(void **state)
{
    (void)state;
    World *world = tiny_world(4, 4, 64, 0.0f);
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3(1.0f, 2.0f, 4.0f);
    world->sky.haze_distance = 10.0f;
    world->camera.fov = 0.5f;
    add_mesh(world, quad_mesh(vec3(-9, -9, -5), vec3(18, 0, 0), vec3(0, 18, 0)), 0, 0);
    Film *film = trace(world, 1, NULL);
    ASSERT_NEAR(center_color(film).z, 4.0 * (1.0 - exp(-1.0)), 1e-3);
    ASSERT_NEAR(film->albedo[2 * 4 + 2].x, 1.0 - exp(-1.0), 1e-3); // of a black wall behind a veil
    film_free(film);
    world_free(world);
}

// A black wall 10 m before a reflecting one, which is 5 m away, fades over 15 m, also where the
// reflection is a little blurred, as by ripples.
static void haze_is_mirrored(void **state)
{
    (void)state;
    const float roughness[] = {0.0f, 0.1f};
    for (int i = 0; i < 2; i++) {
        World *world = tiny_world(4, 4, 64, 0.0f);
        world->sky.kind = SKY_CONSTANT;
        world->sky.color = vec3_splat(1.0f);
        world->sky.haze_distance = 10.0f;
        world->camera.fov = 0.5f;
        world->material[1] = material_default(MATERIAL_CONDUCTOR);
        world->material[1].color = vec3_splat(1.0f);
        world->material[1].roughness = roughness[i];
        world->material_count = 2;
        add_mesh(world, quad_mesh(vec3(-9, -9, 0), vec3(18, 0, 0), vec3(0, 18, 0)), 1, 1);
        add_mesh(world, quad_mesh(vec3(99, -99, 10), vec3(-198, 0, 0), vec3(0, 198, 0)), 0, 0);
        Film *film = trace(world, 1, NULL);
        ASSERT_NEAR(center_color(film).y, 1.0 - exp(-1.5), 0.02); // a lobe has wide tails
        film_free(film);
        world_free(world);
    }
}

// ---- interruption and errors

typedef struct Stop {
    volatile int cancelled;
    int passes, last;
} Stop;

static void cancel_after_two_passes(void *user, const Film *film, int samples)
{
    Stop *stop = user;
    (void)film;
    stop->last = samples;
    stop->cancelled = ++stop->passes == 2;
}

static void cancel_leaves_a_whole_picture(void **state)
{
    (void)state;
    World *world = varied_world();
    Stop stop = {0, 0, 0};
    Run run = run_default();
    run.threads = 2;
    run.cancelled = &stop.cancelled;
    Renderer *renderer = renderer_new(world, "sse4.2", &run, NULL);
    assert_non_null(renderer);
    Film *film = film_new(50, 37, NULL);
    assert_non_null(film);
    RenderStats stats;
    assert_true(
        renderer_render(renderer, film, &run, cancel_after_two_passes, &stop, &stats, NULL));
    assert_int_equal(stop.last, 4);
    assert_int_equal(stats.samples, 4);
    for (int i = 0; i < 50 * 37; i++) {
        assert_true(film->samples[i] >= 4.0f && film->alpha[i] > 0.0f);
    }
    // Asked to stop before it began, it makes nothing of it, whatever the film held.
    Error e = {0};
    assert_false(renderer_render(renderer, film, &run, NULL, NULL, &stats, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

static void cancel_at_a_report(void *user, const char *stage, double done)
{
    Stop *stop = user;
    (void)done;
    if (strcmp(stage, "trace") == 0 && ++stop->passes >= 3) {
        __atomic_store_n(&stop->cancelled, 1, __ATOMIC_RELAXED); // other threads read it
    }
}

// After the request a thread finishes at most the pixel it is at, also in the first pass.
static void cancel_ends_the_first_pass(void **state)
{
    (void)state;
    World *world = varied_world();
    world->film.width = 320;
    world->film.height = 160;
    Stop stop = {0, 0, 0};
    Run run = run_default();
    Renderer *renderer = renderer_new(world, "sse4.2", &run, NULL);
    Film *film = film_new(320, 160, NULL);
    assert_non_null(renderer);
    assert_non_null(film);
    RenderStats stats;
    assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, NULL)); // a whole one
    run.threads = 2;
    run.cancelled = &stop.cancelled;
    run.progress = cancel_at_a_report;
    run.user = &stop;
    assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, NULL));
    assert_int_equal(stats.samples, 0);
    int64_t seen = 0;
    for (int i = 0; i < 320 * 160; i++) {
        seen += film->samples[i] > 0.0f;
        if (film->samples[i] <= 0.0f && (film->color[i].x != 0.0f || film->alpha[i] != 0.0f)) {
            fail_msg("pixel %d shows what an earlier picture had there", i);
        }
    }
    assert_int_equal(seen, stats.paths);
    assert_true(seen > 0 && seen < 320 * 160);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

static void note_pass(void *user, const Film *film, int samples)
{
    int *passes = user;
    assert_true(film->samples[0] == (float)samples);
    passes[++passes[0]] = samples;
}

static void passes_grow(void **state)
{
    (void)state;
    World *world = varied_world();
    Run run = run_default();
    run.threads = 2;
    Renderer *renderer = renderer_new(world, NULL, &run, NULL);
    Film *film = film_new(50, 37, NULL);
    assert_non_null(renderer);
    assert_non_null(film);
    int passes[32] = {0};
    RenderStats stats;
    assert_true(renderer_render(renderer, film, &run, note_pass, passes, &stats, NULL));
    const int wanted[] = {4, 1, 4, 16, 24};
    assert_memory_equal(passes, wanted, sizeof wanted);
    assert_true(stats.memory > 0 && stats.rays > stats.paths && stats.seconds > 0.0);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

static void errors_are_told(void **state)
{
    (void)state;
    World *world = varied_world();
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    assert_null(renderer_new(world, "z80", &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "sse4.2"));
    world->sky.kind = SKY_ENVIRONMENT;
    world->sky.file = "/nowhere/missing.hdr";
    assert_null(renderer_new(world, NULL, &run, &e));
    assert_non_null(strstr(e.message, "missing.hdr"));
    world->sky.kind = SKY_NONE;
    world->film.crop[0] = 0.9f;
    world->film.crop[2] = 0.1f;
    Renderer *renderer = renderer_new(world, NULL, &run, &e);
    assert_non_null(renderer);
    Film *film = film_new(50, 37, NULL);
    RenderStats stats;
    assert_false(renderer_render(renderer, film, &run, NULL, NULL, &stats, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_null(film_new(0, 5, &e));
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

// In a process of its own, with 16 MB more than it has mapped: Embree's threads need more.
static int start_with_little(void)
{
    long long pages = 0;
    FILE *statm = fopen("/proc/self/statm", "r");
    if (!statm || fscanf(statm, "%lld", &pages) != 1) { // NOLINT
        return 2;
    }
    fclose(statm);
    World *world = tiny_world(4, 4, 1, 0.5f);
    rlim_t limit = (rlim_t)(pages * sysconf(_SC_PAGESIZE) + 16000000);
    setrlimit(RLIMIT_AS, &(struct rlimit){limit, limit});
    Error e = {0};
    Run run = {.threads = 2};
    return !renderer_new(world, NULL, &run, &e) && e.code == ERROR_MEMORY ? 0 : 1;
}

static void too_little_memory_is_no_bad_input(void **state)
{
    (void)state;
#ifdef __SANITIZE_ADDRESS__
    skip(); // its memory is reserved beforehand
#endif
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        _exit(start_with_little());
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_little_memory_is_no_bad_input), // before any thread is there
        cmocka_unit_test(white_under_white_sky_is_white),
        cmocka_unit_test(closed_furnace),
        cmocka_unit_test(roulette_is_unbiased),
        cmocka_unit_test(same_bits_for_any_thread_count),
        cmocka_unit_test(crop_gives_the_same_pixels),
        cmocka_unit_test(packets_meet_what_rays_meet),
        cmocka_unit_test(seed_changes_noise_only),
        cmocka_unit_test(small_instances_equal_baked_meshes),
        cmocka_unit_test(large_instances_equal_baked_meshes),
        cmocka_unit_test(absorption_in_glass),
        cmocka_unit_test(alpha_texture_cuts),
        cmocka_unit_test(curves_are_hit),
        cmocka_unit_test(no_shadow_terminator),
        cmocka_unit_test(empty_world_is_transparent_black),
        cmocka_unit_test(alpha_is_coverage),
        cmocka_unit_test(depth_and_position_of_a_plane),
        cmocka_unit_test(albedo_and_normal_follow_mirrors),
        cmocka_unit_test(albedo_follows_glass),
        cmocka_unit_test(thin_lens_focus),
        cmocka_unit_test(lens_shift),
        cmocka_unit_test(haze_fades_with_distance),
        cmocka_unit_test(haze_is_mirrored),
        cmocka_unit_test(cancel_leaves_a_whole_picture),
        cmocka_unit_test(cancel_ends_the_first_pass),
        cmocka_unit_test(passes_grow),
        cmocka_unit_test(errors_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
