// A renderer that is brought up to date makes the picture that a new one would; a sky that turns
// with the camera stays where it is.
#include "tiny_world.h"

static World *scene(SkyKind kind)
{
    World *world = tiny_world(24, 16, 16, 0.6f);
    world->camera.position = vec3(0, 1, 6);
    world->camera.fov = 70;
    Sky sky = {.kind = kind,
               .color = {0.4f, 0.5f, 0.6f},
               .sun_elevation = 25,
               .sun_azimuth = 160,
               .sun_size = 8,
               .sun_strength = 1,
               .turbidity = 3,
               .ground_albedo = 0.2f,
               .clouds = 0.6f,
               .moon = 1,
               .moon_elevation = 20,
               .moon_azimuth = 175,
               .moon_size = 9,
               .stars = 1,
               .city_glow = 0.5f,
               .strength = 1,
               .visible = true};
    world->sky = sky;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 32, true), 0, 0);
    add_light(
        world,
        (Light){.kind = LIGHT_SPHERE, .radiance = {5, 5, 5}, .center = {2, 2, 2}, .radius = 0.3f});
    return world;
}

static double difference(const Film *a, const Film *b)
{
    double sum = 0.0;
    for (int i = 0; i < a->width * a->height; i++) {
        sum += (double)vec3_distance(a->color[i], b->color[i]);
    }
    return sum / mean_luminance(a) / (a->width * a->height);
}

typedef void Edit(World *world);

static void turn_sky(World *world)
{
    world->sky.rotation += 75.0f;
}

static void lower_sun(World *world)
{
    world->sky.sun_elevation = 5.0f;
}

static void paint(World *world)
{
    world->material[0].color = vec3(0.9f, 0.1f, 0.1f);
}

static void make_film(World *world) // rays pass it otherwise: the structures cannot stay
{
    world->material[0] = material_default(MATERIAL_THIN_FILM);
}

static void move_lamp(World *world)
{
    world->light[0].center.x = -2.0f;
}

static void lower_camera(World *world)
{
    world->camera.position.y = -1.0f;
    world->render.samples = 4;
}

static void an_update_is_as_good_as_a_new_renderer(void **state)
{
    (void)state;
    const struct {
        Edit *edit;
        unsigned changed;
    } cases[] = {{turn_sky, RENDERER_SKY_TURNED}, {lower_sun, RENDERER_LIGHT},
                 {paint, RENDERER_MATERIALS},     {make_film, RENDERER_MATERIALS},
                 {move_lamp, RENDERER_LAMPS},     {lower_camera, 0},
                 {turn_sky, RENDERER_SKY_TURNED}};
    World *world = scene(SKY_SUN_SKY);
    Run run = run_default();
    Renderer *renderer = renderer_new(world, NULL, &run, NULL);
    assert_non_null(renderer);
    Film *film = film_new(24, 16, NULL), *before = trace(world, 1, NULL);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cases[i].edit(world);
        RenderStats stats;
        assert_true(renderer_update(renderer, cases[i].changed, &run, NULL));
        assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, NULL));
        Film *fresh = trace(world, 1, NULL);
        assert_memory_equal(film->color, fresh->color, sizeof(Vec3) * 24 * 16);
        assert_true(difference(before, fresh) > 1e-3); // the edit was no empty one
        film_free(before);
        before = fresh;
    }
    film_free(before);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

static void glow(World *world) // emitters know the full mesh alone
{
    world->material[0] = material_default(MATERIAL_EMISSION);
}

static void make_glass(World *world) // curves of glass are round, opaque ones are tubes
{
    world->material[0] = material_default(MATERIAL_DIELECTRIC);
}

static void make_diffuse(World *world)
{
    world->material[0] = material_default(MATERIAL_DIFFUSE);
}

// Balls whose coarse form differs much, and a thin rod.
static World *world_of_forms(void)
{
    World *world = scene(SKY_SUN_SKY);
    Part balls = {.kind = PART_MESH,
                  .mesh = sphere_mesh(vec3(0, 0, 0), 0.5f, 16, true),
                  .coarse[0] = {sphere_mesh(vec3(0, 0, 0), 0.4f, 6, true), 1e-6f},
                  .instance = memory_alloc(2, sizeof(Transform), NULL),
                  .instance_count = 2};
    assert_non_null(balls.instance);
    for (int i = 0; i < 2; i++) {
        balls.instance[i] =
            transform_compose(vec3(i ? 2.0f : -2.0f, 0, 1), vec3(0, 0, 0), vec3_splat(1));
    }
    add_part(world, balls);
    CurveSet *rod = curves_new(2, 1, NULL);
    assert_non_null(rod);
    rod->position[0] = vec3(-3, 1.5f, 0);
    rod->position[1] = vec3(3, 1.6f, 0);
    rod->radius[0] = rod->radius[1] = 0.1f;
    rod->first[0] = 0;
    rod->first[1] = 2;
    add_part(world, (Part){.kind = PART_CURVES, .curves = rod});
    return world;
}

static void materials_decide_what_form_is_drawn(void **state)
{
    (void)state;
    Edit *const edits[] = {glow, make_diffuse, make_glass, make_diffuse};
    World *world = world_of_forms();
    Run run = run_default();
    Renderer *renderer = renderer_new(world, NULL, &run, NULL);
    assert_non_null(renderer);
    Film *film = film_new(24, 16, NULL);
    for (size_t i = 0; i < sizeof edits / sizeof edits[0]; i++) {
        edits[i](world);
        RenderStats stats;
        assert_true(renderer_update(renderer, RENDERER_MATERIALS, &run, NULL));
        assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, NULL));
        Film *fresh = trace(world, 1, NULL);
        assert_memory_equal(film->color, fresh->color, sizeof(Vec3) * 24 * 16);
        film_free(fresh);
    }
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

static Vec3 about_y(Vec3 p, float degrees)
{
    float c = cosf(degrees * RADIANS_PER_DEGREE), s = sinf(degrees * RADIANS_PER_DEGREE);
    return vec3(p.x * c + p.z * s, p.y, p.z * c - p.x * s);
}

static void sky_and_camera_turn_together(void **state)
{
    (void)state;
    const SkyKind kinds[] = {SKY_SUN_SKY, SKY_NIGHT};
    for (int i = 0; i < 2; i++) {
        World *world = scene(kinds[i]);
        Film *still = trace(world, 1, NULL);
        world->camera.position = about_y(world->camera.position, 130.0f);
        world->light[0].center = about_y(world->light[0].center, 130.0f);
        Film *half = trace(world, 1, NULL); // the sky stands still
        world->sky.rotation = 130.0f;
        Film *turned = trace(world, 1, NULL);
        assert_true(difference(still, half) > 0.05);
        assert_true(difference(still, turned) < 0.02); // rounding moves some paths
        film_free(still);
        film_free(half);
        film_free(turned);
        world_free(world);
    }
}

static void noise_seed_changes_noise_alone(void **state)
{
    (void)state;
    World *world = scene(SKY_SUN_SKY);
    Film *a = trace(world, 1, NULL);
    world->render.noise_seed = 5;
    Film *b = trace(world, 1, NULL);
    double off = fabs(mean_luminance(a) - mean_luminance(b));
    assert_memory_not_equal(a->color, b->color, sizeof(Vec3) * 24 * 16);
    assert_true(off < 6.0 * (mean_error(a) + mean_error(b)));
    film_free(a);
    film_free(b);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_update_is_as_good_as_a_new_renderer),
        cmocka_unit_test(materials_decide_what_form_is_drawn),
        cmocka_unit_test(sky_and_camera_turn_together),
        cmocka_unit_test(noise_seed_changes_noise_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
