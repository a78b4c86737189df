// The field of lamps in clouds against closed forms and against paths alone.
#include "tiny_world.h"

#include "base/color.h"
#include "base/random.h"
#include "render/integrator.h"
#include "render/lamp_field.h"
#include "render/light/emission.h"

#define assert_close(value, wanted, tolerance)                                      \
    do {                                                                            \
        double v_ = (double)(value), w_ = (double)(wanted);                         \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                              \
            fail_msg("%s = %.6g, not %.6g within %.2g", #value, v_, w_, tolerance); \
        }                                                                           \
    } while (0)

static Light ball(Vec3 center, float radius, Vec3 radiance)
{
    return (Light){.kind = LIGHT_SPHERE, .center = center, .radius = radius, .radiance = radiance};
}

static void add_cloud(World *world, Cloud cloud)
{
    world->cloud = memory_alloc_zero(1, sizeof cloud, NULL);
    assert_non_null(world->cloud);
    world->cloud[0] = cloud;
    world->cloud_count = 1;
}

// What a field is made from.
typedef struct Setup {
    World *world;
    MaterialSet *materials;
    Accel *accel;
    Lights *lights;
    CloudSet *clouds;
    Tracer tracer;
} Setup;

static Setup set_up(World *world)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    bool used[4] = {false};
    Setup s = {.world = world};
    s.materials = material_set_new(world->material, used, world->material_count, &run, &e);
    assert_non_null(s.materials);
    s.accel = accel_new(world, s.materials, NULL, &run, &e);
    assert_non_null(s.accel);
    s.lights = lights_new(world, 1.0f, &run, &e);
    assert_non_null(s.lights);
    if (world->cloud_count > 0) {
        s.clouds = clouds_new(world->cloud, world->cloud_count, world->cloud_seed, &run, &e);
        assert_non_null(s.clouds);
    }
    s.tracer = (Tracer){.world = world,
                        .accel = s.accel,
                        .lights = s.lights,
                        .materials = s.materials,
                        .has_glow = true,
                        .clouds = s.clouds,
                        .droplets = droplet_phase(20.0f)};
    tracer_set_media(&s.tracer, aabb_empty());
    return s;
}

static void tear_down(Setup *s)
{
    clouds_free(s->clouds);
    lights_free(s->lights);
    accel_free(s->accel);
    material_set_free(s->materials);
    world_free(s->world);
}

static LampField *field_of(const Setup *s)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    LampField *field;
    if (!lamp_field_make(&field, &s->tracer, 3, &run, &e)) {
        fail_msg("%s", e.message);
    }
    return field;
}

// A sheet that is even from a quarter of its thickness nearly up to its top.
static Cloud thick_sheet(void)
{
    Cloud sheet = cloud_default(CLOUD_STRATUS);
    sheet.base = 0.0f;
    sheet.thickness = 8000.0f;
    sheet.size = 2500.0f;
    sheet.cover = 1.0f;
    sheet.extinction = 0.04f;
    sheet.resolution = 128;
    return sheet;
}

// Fluence at r mean free paths from a point of unit power in an endless medium that scatters evenly
// and absorbs nothing, times the square of a mean free path: (3 + I) / (4 pi r), where I is the
// integral over v in 0 .. 1 of g(v) exp(-r / v) / v^2 and 1 / g(v) = (1 - v artanh v)^2 +
// (pi v / 2)^2 (Case, de Hoffmann and Placzek, "Introduction to the Theory of Neutron Diffusion",
// 1953).
static double endless_fluence(double r)
{
    enum { STEPS = 20000 };
    const double pi = 3.14159265358979;
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double v = ((double)i + 0.5) / STEPS, a = 1.0 - v * atanh(v), b = 0.5 * pi * v;
        sum += exp(-r / v) / (v * v) / (a * a + b * b) / STEPS;
    }
    return (3.0 + sum) / (4.0 * pi * r);
}

// Planes at a distance h above and below, through which light is lost, take about ln 2 / h from
// 1 / r (images of the source), a little less because they act 0.71 mean free paths outside.
// medium: scattering per metre of one that fills the air as well, evenly and without loss.
static void assert_fluence(float medium, int last)
{
    World *world = tiny_world(4, 4, 1, 0.5f);
    world->medium = (Medium){.kind = medium > 0.0f ? MEDIUM_EVERYWHERE : MEDIUM_NONE,
                             .scattering = vec3_splat(medium),
                             .extent = 9000.0f};
    const float radius = 10.0f;
    const Vec3 center = {0, 5000, 0};
    add_light(world, ball(center, radius, vec3(8.0f, 4.0f, 2.0f)));
    add_cloud(world, thick_sheet());
    Setup s = set_up(world);
    double extinction =
        (double)(medium + clouds_extinction(s.clouds, center) *
                              (1.0f - droplet_phase_mean_cosine(&s.tracer.droplets)));
    LampField *field = field_of(&s);
    assert_non_null(field);
    double power = (double)PI_F * 4.0 * (double)PI_F * (double)(radius * radius) * 8.0;
    double h = (2800.0 * extinction + 0.71);
    for (int r = 2; r <= last; r++) {
        double lost = 3.0 * log(2.0) / (4.0 * (double)PI_F * h);
        double wanted =
            power * extinction * extinction * (endless_fluence(r) - lost) / (4.0 * (double)PI_F);
        double sum[3] = {0.0};
        enum { PLACES = 500 };
        for (uint64_t k = 0; k < PLACES; k++) {
            Vec3 mean, off = vec3_scale(random_direction(k), (float)(r / extinction));
            assert_true(lamp_field_at(field, vec3_add(center, off), &mean));
            sum[0] += (double)mean.x / PLACES;
            sum[1] += (double)mean.y / PLACES;
            sum[2] += (double)mean.z / PLACES;
        }
        assert_close(sum[0] / wanted, 1.0, 0.06);
        assert_close(sum[1] / sum[0], 0.5, 1e-3);
        assert_close(sum[2] / sum[0], 0.25, 1e-3);
    }
    lamp_field_free(field);
    tear_down(&s);
}

static void even_cloud_has_the_fluence_of_transport_theory(void **state)
{
    (void)state;
    assert_fluence(0.0f, 4);
}

// Beyond the sheet the medium goes on, where the planes of the closed form lose light: it holds
// near the lamp.
static void a_medium_adds_to_the_extinction_of_the_cloud(void **state)
{
    (void)state;
    assert_fluence(0.0028f, 3);
}

// The mean over all draws is the flux of all lights; it leaves a quad's front as a cosine does.
static void emission_has_the_flux_of_the_lights(void **state)
{
    (void)state;
    World *world = tiny_world(4, 4, 1, 0.5f);
    add_light(world, ball(vec3(0, 0, 0), 2.0f, vec3(1.0f, 2.0f, 0.0f)));
    Light quad = {.kind = LIGHT_QUAD,
                  .radiance = {0.0f, 0.0f, 7.0f},
                  .corner = {9, 0, 0},
                  .edge_u = {3, 0, 0},
                  .edge_v = {0, 2, 0}};
    add_light(world, quad);
    Setup s = set_up(world);
    EmissionTable *table = emission_table_new(s.lights, NULL);
    assert_non_null(table);
    enum { DRAWS = 100000 };
    double flux[3] = {0.0}, cosine = 0.0, blue = 0.0;
    for (uint64_t k = 0; k < DRAWS; k++) {
        Emission light = emission_draw(table, random_key(1, k));
        double power = (double)emission_power(table) / DRAWS;
        flux[0] += power * (double)light.color.x;
        flux[1] += power * (double)light.color.y;
        flux[2] += power * (double)light.color.z;
        cosine += light.color.z > 0.0f ? (double)light.direction.z : 0.0;
        blue += light.color.z > 0.0f ? 1.0 : 0.0;
    }
    double of_ball = (double)PI_F * 4.0 * (double)PI_F * 4.0, of_quad = (double)PI_F * 6.0 * 7.0;
    assert_close(flux[0], of_ball, 0.01 * of_ball);
    assert_close(flux[1], 2.0 * of_ball, 0.01 * of_ball);
    assert_close(flux[2], of_quad, 0.05 * of_quad);
    assert_close(cosine / blue, 2.0 / 3.0, 0.02);
    emission_table_free(table);
    tear_down(&s);
}

// A lamp in a sheet of cloud, seen from below. curve: a glowing line in coloured haze instead of
// the ball, in a sheet of ash.
static World *lit_sheet(int samples, bool field, bool curve)
{
    World *world = tiny_world(12, 8, samples, 0.5f);
    world->camera.position = vec3(0, 1300, 0);
    world->camera.target = vec3(0, 1600, 60);
    world->camera.fov = 60;
    world->render.lamp_field = field;
    Cloud sheet = cloud_default(CLOUD_STRATUS);
    sheet.cover = 1.0f;
    sheet.thickness = 300.0f;
    sheet.extinction = 0.2f;
    sheet.resolution = 128;
    add_cloud(world, sheet);
    if (curve) {
        world->cloud[0].albedo = vec3(0.98f, 0.96f, 0.93f);
        CurveSet *curves = curves_new(5, 1, NULL);
        assert_non_null(curves);
        for (int i = 0; i < 5; i++) {
            curves->position[i] = vec3(-40.0f + 20.0f * (float)i, 1640.0f, 3.0f * (float)(i % 2));
            curves->radius[i] = 1.0f;
        }
        curves->first[0] = 0;
        curves->first[1] = 5;
        world->material[1] = material_default(MATERIAL_EMISSION);
        world->material[1].radiance = vec3(40.0f, 30.0f, 20.0f);
        world->material_count = 2;
        add_part(world, (Part){.kind = PART_CURVES, .curves = curves, .material = 1});
        world->medium = (Medium){.kind = MEDIUM_EVERYWHERE,
                                 .scattering = {0.0012f, 0.0018f, 0.0024f},
                                 .absorption = {0.001f, 0.0f, 0.0006f},
                                 .anisotropy = 0.5f,
                                 .extent = 1000.0f};
    } else {
        add_light(world, ball(vec3(0, 1640, 0), 12.0f, vec3(4.0f, 3.0f, 2.0f)));
    }
    return world;
}

// Deep in a cloud a lamp has no edge: its samples are not kept apart as those of a light.
static void a_hidden_lamp_is_not_kept_apart(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        World *world = lit_sheet(16, false, false);
        if (k == 0) { // below the sheet: the same lamp is
            world->light[0].center.y = 1400.0f;
        }
        Film *film = trace(world, 2, NULL);
        float most = 0.0f;
        for (int i = 0; i < film->width * film->height; i++) {
            most = fmaxf(most, film->light_share[i]);
        }
        assert_true(k == 0 ? most > 0.5f : most == 0.0f);
        film_free(film);
        world_free(world);
    }
}

static void assert_same_by_one_thread(const World *world, const Film *film)
{
    Film *one = trace(world, 1, NULL);
    size_t bytes = sizeof one->color[0] * (size_t)(one->width * one->height);
    assert_memory_equal(one->color, film->color, bytes);
    film_free(one);
}

static void assert_pictures_agree(bool curve)
{
    World *with = lit_sheet(32, true, curve), *without = lit_sheet(128, false, curve);
    Film *by_field = trace(with, 3, NULL), *by_paths = trace(without, 2, NULL);
    if (!curve) {
        assert_same_by_one_thread(with, by_field);
    }
    double a = mean_luminance(by_field), b = mean_luminance(by_paths);
    double error = hypot(mean_error(by_field), mean_error(by_paths));
    if (fabs(a - b) > 3.0 * error + 0.03 * b) {
        fail_msg("with the field %.5g, by paths %.5g +- %.2g", a, b, error);
    }
    // less noise at equal samples, though the lamp is only a few mean free paths deep
    if (!(mean_error(by_field) * sqrt(32.0) < 0.8 * mean_error(by_paths) * sqrt(128.0))) {
        fail_msg("errors: with the field %.3g, by paths %.3g", mean_error(by_field),
                 mean_error(by_paths));
    }
    film_free(by_field);
    film_free(by_paths);
    world_free(with);
    world_free(without);
}

// For any number of threads.
static void a_field_shows_what_paths_find(void **state)
{
    (void)state;
    assert_pictures_agree(false);
    assert_pictures_agree(true);
}

// Along a line through the field and out of it: inside what lookups tell, outside the same at the
// rim, and a quarter of it at twice the distance.
static void beyond_the_field_light_thins_out(void **state)
{
    (void)state;
    World *world = lit_sheet(1, true, false);
    Setup s = set_up(world);
    LampField *field = field_of(&s);
    assert_non_null(field);
    const Vec3 lamp = {0, 1640, 0};
    Vec3 mean;
    float last = 0.0f, rim = 0.0f;
    for (int i = 0; rim == 0.0f; i++) {
        Vec3 p = vec3_add(lamp, vec3(2.0f * (float)i, 0, 0));
        float around = lamp_field_around(field, p);
        assert_true(around > 0.0f);
        if (lamp_field_at(field, p, &mean)) {
            assert_close(around, luminance(mean), 0.0);
        } else {
            assert_close(around / last, 1.0, 0.05);
            rim = p.x;
        }
        last = around;
    }
    float twice = lamp_field_around(field, vec3(2.0f * rim, lamp.y, lamp.z));
    assert_close(twice / last, 0.25, 0.03);
    assert_true(lamp_field_around(NULL, lamp) == 0.0f);
    lamp_field_free(field);
    tear_down(&s);
}

// Sum of the lengths of the normals that guide a denoiser, looking up into a sheet of cloud at x.
static double normals_at(float x, float lamp)
{
    World *world = lit_sheet(1, true, false);
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(1e-3f);
    world->light[0].radiance = vec3_splat(lamp);
    world->camera.position.x += x;
    world->camera.target.x += x;
    Film *film = trace(world, 2, NULL);
    double sum = 0.0;
    for (int i = 0; i < film->width * film->height; i++) {
        sum += (double)vec3_length(film->normal[i]);
    }
    film_free(film);
    world_free(world);
    return sum;
}

// Nor does it guide a denoiser by the form of its border: under the lamp, and beyond the field, as
// far as it outshines the sky.
static void what_glows_from_within_has_no_form(void **state)
{
    (void)state;
    const float place[2] = {0.0f, 900.0f};
    for (int k = 0; k < 2; k++) {
        double dark = normals_at(place[k], 1e-9f), lit = normals_at(place[k], 1e6f);
        assert_true(dark > 1.0);
        if (!(lit < 0.05 * dark)) {
            fail_msg("at %g m: normals of %.3g, without the lamp %.3g", (double)place[k], lit,
                     dark);
        }
    }
}

// A lamp far below the clouds, or none.
static void there_is_none_where_it_does_not_pay(void **state)
{
    (void)state;
    World *world = tiny_world(4, 4, 1, 0.5f);
    Cloud fog = cloud_default(CLOUD_FOG);
    fog.extinction = 1e-5f;
    fog.resolution = 128;
    add_cloud(world, fog);
    add_light(world, ball(vec3(0, 0, 0), 2.0f, vec3_splat(1.0f)));
    Setup s = set_up(world);
    assert_null(field_of(&s));
    Vec3 mean;
    assert_false(lamp_field_at(NULL, vec3(0, 0, 0), &mean));
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(emission_has_the_flux_of_the_lights),
        cmocka_unit_test(even_cloud_has_the_fluence_of_transport_theory),
        cmocka_unit_test(a_medium_adds_to_the_extinction_of_the_cloud),
        cmocka_unit_test(a_hidden_lamp_is_not_kept_apart),
        cmocka_unit_test(a_field_shows_what_paths_find),
        cmocka_unit_test(beyond_the_field_light_thins_out),
        cmocka_unit_test(what_glows_from_within_has_no_form),
        cmocka_unit_test(there_is_none_where_it_does_not_pay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
