// The soap film: reflectance against sums of beams, colours, energy, and shadow rays through it.
#include "render/tiny_world.h"

#include "base/random.h"
#include "render/material/bsdf.h"
#include "render/material/thin_film.h"
#include "render/sky/atmosphere.h"

#include <complex.h>
#include <math.h>

// Beam after beam as complex amplitudes: what each side mirrors, what goes round once more inside.
static double beams(double thickness, double ior, double cosine, double wavelength, bool in_plane,
                    int count)
{
    double inner = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    double r = in_plane ? (ior * cosine - inner) / (ior * cosine + inner)
                        : (cosine - ior * inner) / (cosine + ior * inner);
    double complex round_trip = cexp(I * 4.0 * M_PI * ior * thickness * inner / wavelength);
    double complex sum = r, beam = (1.0 - r * r) * -r * round_trip;
    for (int i = 1; i < count; i++) {
        sum += beam;
        beam *= r * r * round_trip;
    }
    return creal(sum * conj(sum));
}

// Unpolarised light of one wavelength.
static double reflectance(double thickness, double cosine, double wavelength)
{
    return 0.5 * (beams(thickness, 1.33, cosine, wavelength, false, 60) +
                  beams(thickness, 1.33, cosine, wavelength, true, 60));
}

static void color_is_the_sum_of_all_beams(void **state)
{
    (void)state;
    const double cosines[] = {1.0, 0.8, 0.5, 0.3},
                 thicknesses[] = {40.0, 100.0, 275.0, 480.0, 910.0};
    ThinFilmTable *table = thin_film_table_new(NULL);
    assert_non_null(table);
    for (int c = 0; c < 4; c++) {
        for (int t = 0; t < 5; t++) {
            double sum[3] = {0.0}, total[3] = {0.0};
            for (double wavelength = 380.0; wavelength <= 780.0; wavelength += 1.0) {
                double weight[3];
                wavelength_to_rgb(wavelength, weight);
                double mirrored = reflectance(thicknesses[t], cosines[c], wavelength);
                for (int i = 0; i < 3; i++) {
                    sum[i] += weight[i] * mirrored;
                    total[i] += weight[i];
                }
            }
            Vec3 got = thin_film_color(table, (float)thicknesses[t], 1.33f, (float)cosines[c]);
            const float channel[3] = {got.x, got.y, got.z};
            for (int i = 0; i < 3; i++) {
                double expected = fmin(fmax(sum[i] / total[i], 0.0), 1.0);
                assert_float_equal(channel[i], expected, 2e-3);
            }
        }
    }
    thin_film_table_free(table);
}

static void mean_is_the_mean_over_thicknesses(void **state)
{
    (void)state;
    const double cosines[] = {1.0, 0.5, 0.15};
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        double inner = sqrt(1.0 - (1.0 - cosines[c] * cosines[c]) / (1.33 * 1.33));
        for (int i = 0; i < 1000; i++) { // a whole period
            double thickness = 500.0 / (2.0 * 1.33 * inner) * i / 1000.0;
            sum += reflectance(thickness, cosines[c], 500.0) / 1000.0;
        }
        assert_float_equal(thin_film_mean(1.33f, (float)cosines[c]), sum, 1e-5);
    }
}

static void colors(void **state)
{
    (void)state;
    ThinFilmTable *table = thin_film_table_new(NULL);
    assert_non_null(table);
    for (int i = 0; i < 400; i++) {
        uint64_t key = random_key(3, (uint64_t)i);
        float thickness = random_range(random_key(key, 0), 0.0f, 900.0f);
        float cosine = random_range(random_key(key, 1), 0.02f, 1.0f);
        Vec3 c = thin_film_color(table, thickness, 1.33f, cosine);
        assert_true(c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x <= 1 && c.y <= 1 && c.z <= 1);
        Vec3 none = thin_film_color(table, 0.0f, 1.33f, cosine);
        assert_true(none.x == 0.0f && none.y == 0.0f && none.z == 0.0f);
    }
    // Newton's series upright: black, white, yellow, blue-violet (e.g. Isenberg 1992)
    Vec3 black = thin_film_color(table, 8.0f, 1.33f, 1.0f);
    Vec3 white = thin_film_color(table, 100.0f, 1.33f, 1.0f);
    Vec3 yellow = thin_film_color(table, 165.0f, 1.33f, 1.0f);
    Vec3 blue = thin_film_color(table, 225.0f, 1.33f, 1.0f);
    assert_true(black.y < 0.005f);
    assert_true(white.y > 0.06f && fabsf(white.x - white.z) < 0.35f * white.y);
    assert_true(yellow.x > 1.5f * yellow.z && yellow.y > 1.5f * yellow.z);
    assert_true(blue.z > 1.5f * blue.y);
    // thick films lose their colour
    Vec3 grey = thin_film_color(table, 1990.0f, 1.33f, 1.0f);
    assert_true(fabsf(grey.y - thin_film_mean(1.33f, 1.0f)) < 0.012f);
    thin_film_table_free(table);
}

static void nothing_is_lost(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_THIN_FILM);
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    assert_non_null(set);
    for (int i = 0; i < 200; i++) {
        uint64_t key = random_key(5, (uint64_t)i);
        SurfacePoint point = {.geometric_normal = {0, 0, 1},
                              .normal = {0, 0, 1},
                              .object_position = random_direction(key),
                              .backface = i & 1};
        float c = random_range(random_key(key, 1), 0.01f, 1.0f);
        Vec3 wo = vec3(sqrtf(1.0f - c * c), 0, c);
        Bsdf bsdf = bsdf_at(set, &point, wo);
        BsdfSample mirrored, passed;
        assert_true(bsdf_sample(&bsdf, wo, (float[3]){0, 0, 0.0f}, &mirrored));
        assert_true(bsdf_sample(&bsdf, wo, (float[3]){0, 0, 0.999999f}, &passed));
        assert_true(mirrored.delta && passed.delta && passed.transmitted && !mirrored.transmitted);
        Vec3 sum = vec3_add(vec3_scale(mirrored.weight, bsdf.probability),
                            vec3_scale(passed.weight, 1.0f - bsdf.probability));
        assert_float_equal(sum.x, 1.0f, 1e-5f);
        assert_float_equal(sum.y, 1.0f, 1e-5f);
        assert_float_equal(sum.z, 1.0f, 1e-5f);
        assert_float_equal(vec3_dot(passed.wi, wo), -1.0f, 1e-5f);
        assert_float_equal(mirrored.wi.x, -wo.x, 1e-5f);
        assert_float_equal(mirrored.wi.z, wo.z, 1e-5f);
    }
    material_set_free(set);
}

// Light is neither made nor lost: under a white sky a bubble cannot be seen.
static void bubble_under_white_sky_vanishes(void **state)
{
    (void)state;
    World *world = tiny_world(12, 12, 256, 0.5f);
    world->material[0] = material_default(MATERIAL_THIN_FILM);
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(1.0f);
    world->sky.visible = true;
    world->render.max_depth = world->render.roulette_depth = 40;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 16, true), 0, 0);
    Film *film = trace(world, 2, NULL);
    assert_true(fabs(mean_luminance(film) - 1.0) < 0.01);
    film_free(film);
    world_free(world);
}

// A dark matt sheet seen and lit through a film is darker by what the film mirrors each way.
static void lamp_shines_through_the_film(void **state)
{
    (void)state;
    double mean[2];
    for (int film = 0; film < 2; film++) {
        World *world = tiny_world(24, 24, 256, 0.02f);
        world->camera.fov = 4.0f;
        world->material_count = 2;
        world->material[1] = material_default(MATERIAL_THIN_FILM);
        world->material[1].film_thickness = 2000.0f; // no colour: shadow rays do not know it
        world->material[1].film_swirl = world->material[1].film_drainage = 0.0f;
        add_mesh(world, quad_mesh(vec3(-2, -2, 0), vec3(4, 0, 0), vec3(0, 4, 0)), 0, 0);
        add_light(world, (Light){.kind = LIGHT_SPHERE,
                                 .radiance = vec3_splat(40.0f),
                                 .center = vec3(2.0f, 2.2f, 3.0f),
                                 .radius = 0.3f});
        if (film) {
            add_mesh(world, quad_mesh(vec3(-9, -9, 1), vec3(18, 0, 0), vec3(0, 18, 0)), 1, 1);
        }
        Film *picture = trace(world, 2, NULL);
        mean[film] = mean_luminance(picture);
        film_free(picture);
        world_free(world);
    }
    float lamp = thin_film_mean(1.33f, 3.0f / sqrtf(9.0f + 4.0f + 4.84f));
    float eye = thin_film_mean(1.33f, 1.0f);
    double expected = (double)((1.0f - lamp) * (1.0f - eye));
    assert_true(expected < 0.93);
    assert_true(fabs(mean[1] / mean[0] / expected - 1.0) < 0.015);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(color_is_the_sum_of_all_beams),
        cmocka_unit_test(mean_is_the_mean_over_thicknesses),
        cmocka_unit_test(colors),
        cmocka_unit_test(nothing_is_lost),
        cmocka_unit_test(bubble_under_white_sky_vanishes),
        cmocka_unit_test(lamp_shines_through_the_film),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
