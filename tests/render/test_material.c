// Materials with pictures: colour and opacity from files, and what is said when they are missing.
#include "render/material/bsdf.h"

#include "image/image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct Files {
    char color[64], opacity[64];
} Files;

static Files files;

// Left half red, right half mid grey; opacity: lower half clear.
static int write_files(void **state)
{
    (void)state;
    snprintf(files.color, sizeof files.color, "/tmp/ramify-color-%ld.png", (long)getpid());
    snprintf(files.opacity, sizeof files.opacity, "/tmp/ramify-opacity-%ld.png", (long)getpid());
    Image *color = image_new(64, 64, 3, NULL), *opacity = image_new(64, 64, 4, NULL);
    for (int i = 0; i < 64 * 64; i++) {
        float grey = 128.0f / 255.0f;
        bool left = i % 64 < 32;
        float c[3] = {left ? 1.0f : grey, left ? 0.0f : grey, left ? 0.0f : grey};
        memcpy(color->pixel + 3 * i, c, sizeof c);
        float o[4] = {1.0f, 1.0f, 1.0f, i / 64 < 32 ? 1.0f : 0.0f};
        memcpy(opacity->pixel + 4 * i, o, sizeof o);
    }
    bool done = image_write_display(files.color, color, NULL, NULL) &&
                image_write_display(files.opacity, opacity, NULL, NULL);
    image_free(color);
    image_free(opacity);
    return done ? 0 : -1;
}

static int remove_files(void **state)
{
    (void)state;
    unlink(files.color);
    unlink(files.opacity);
    return 0;
}

static SurfacePoint point_at(float u, float v)
{
    return (SurfacePoint){.normal = vec3(0, 0, 1),
                          .geometric_normal = vec3(0, 0, 1),
                          .tangent_u = vec3(1, 0, 0),
                          .tangent_v = vec3(0, 1, 0),
                          .uv = {u, v},
                          .has_uv = true};
}

static void test_texture(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.color = vec3(1.0f, 1.0f, 0.5f);
    m.texture = files.color;
    m.alpha_texture = files.opacity;
    Error e = {0};
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, &e);
    assert_non_null(set);
    SurfacePoint left = point_at(0.25f, 0.5f), right = point_at(1.75f, -0.5f);
    Vec3 red = bsdf_at(set, &left, vec3(0, 0, 1)).color;
    Vec3 grey = bsdf_at(set, &right, vec3(0, 0, 1)).color;
    assert_float_equal(red.x, 1.0f, 0.01f);
    assert_float_equal(red.y, 0.0f, 0.01f);
    assert_float_equal(grey.x, 0.2159f, 0.01f); // 128 / 255 made linear
    assert_float_equal(grey.z, 0.1080f, 0.01f); // times the material's colour
    right.footprint = 4.0f;                     // all of the picture in one pixel
    Vec3 mean = bsdf_at(set, &right, vec3(0, 0, 1)).color;
    assert_true(mean.x > 0.4f && mean.x < 0.75f && mean.y < 0.2f);
    // v points up: the picture's upper half is opaque
    assert_float_equal(material_opacity(set, 0, (Vec2){0.5f, 0.75f}), 1.0f, 0.01f);
    assert_float_equal(material_opacity(set, 0, (Vec2){0.5f, 0.25f}), 0.0f, 0.01f);
    material_set_free(set);
}

// A leaf's picture tints what passes as it tints what comes back, on both sides.
static void test_leaf_texture(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    m.color = vec3(0.8f, 0.8f, 0.8f);
    m.transmittance = vec3(0.1f, 0.15f, 0.19f);
    m.texture = files.color;
    Error e = {0};
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, &e);
    assert_non_null(set);
    for (int under = 0; under < 2; under++) {
        SurfacePoint left = point_at(0.25f, 0.5f), right = point_at(0.75f, 0.5f);
        left.backface = right.backface = under == 1;
        Vec3 red = bsdf_at(set, &left, vec3(0, 0, 1)).transmittance;
        Vec3 grey = bsdf_at(set, &right, vec3(0, 0, 1)).transmittance;
        assert_true(red.x > 0.07f && red.y < 0.01f && red.z < 0.01f);
        assert_float_equal(grey.y, 0.2159f * 0.15f, 0.002f);
        assert_float_equal(grey.z, 0.2159f * 0.19f, 0.002f);
        Vec3 albedo = bsdf_at(set, &left, vec3(0, 0, 1)).albedo;
        assert_true(albedo.x <= 1.0f + 1e-6f && albedo.y <= 1.0f && albedo.z <= 1.0f);
    }
    material_set_free(set);
}

static void test_missing(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Material m[2] = {material_default(MATERIAL_LEAF), material_default(MATERIAL_LEAF)};
        strcpy(m[1].name, "oak leaf");
        m[1].texture = k ? NULL : "/nowhere/leaf.png";
        m[1].alpha_texture = k ? "/nowhere/leaf.png" : NULL;
        Error e = {0};
        assert_null(material_set_new(m, NULL, 2, NULL, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, "material 'oak leaf': texture '/nowhere/leaf.png'"));
    }
}

// Numbers out of their range do not make more light than there is.
static void test_wild_numbers(void **state)
{
    (void)state;
    for (int kind = MATERIAL_DIFFUSE; kind <= MATERIAL_EMISSION; kind++) {
        Material m = material_default((MaterialKind)kind);
        m.color = vec3(3.0f, -1.0f, 0.5f);
        m.transmittance = vec3(2.0f, 2.0f, -2.0f);
        m.roughness = 7.0f;
        m.metallic = 5.0f;
        m.specular = 1.0f;
        m.ior = kind % 2 ? 1.0f : 0.0f;
        MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
        assert_non_null(set);
        SurfacePoint p = point_at(0, 0);
        Vec3 wo = vec3(0.6f, 0, 0.8f), sum = vec3_splat(0.0f);
        Bsdf bsdf = bsdf_at(set, &p, wo);
        const int count = 4000;
        for (int i = 0; i < count; i++) {
            float u[3] = {(float)i / (float)count, fmodf(0.618034f * (float)i, 1.0f),
                          fmodf(0.754878f * (float)i, 1.0f)};
            BsdfSample sample;
            if (bsdf_sample(&bsdf, wo, u, &sample)) {
                assert_true(vec3_finite(sample.weight));
                sum = vec3_madd(sum, 1.0f / (float)count, sample.weight);
            }
        }
        if (!(sum.x < 1.05f && sum.y < 1.05f && sum.z < 1.05f && sum.y > -0.001f)) {
            fail_msg("kind %d: %g %g %g", kind, (double)sum.x, (double)sum.y, (double)sum.z);
        }
        material_set_free(set);
    }
}

static void test_none(void **state)
{
    (void)state;
    MaterialSet *set = material_set_new(NULL, NULL, 0, NULL, NULL);
    assert_non_null(set);
    material_set_free(set);
    material_set_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texture), cmocka_unit_test(test_leaf_texture),
        cmocka_unit_test(test_missing), cmocka_unit_test(test_wild_numbers),
        cmocka_unit_test(test_none),
    };
    return cmocka_run_group_tests(tests, write_files, remove_files);
}
