// Cells and stripes on surfaces, and the corals' patterns made of them.
#include "render/material/pattern.h"

#include "base/random.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static Vec3 random_vector(uint64_t key, float size)
{
    return vec3(random_range(random_key(key, 0), -size, size),
                random_range(random_key(key, 1), -size, size),
                random_range(random_key(key, 2), -size, size));
}

// A position, a surface through it and a unit direction along that.
typedef struct Place {
    Vec3 p, normal, along;
} Place;

static Place random_place(uint64_t i)
{
    Place place = {.p = random_vector(i, 30.0f)};
    place.normal = vec3_normalize(random_vector(i + 100000, 1.0f));
    Vec3 aside = random_vector(i + 200000, 1.0f);
    place.along = vec3_normalize(vec3_madd(aside, -vec3_dot(aside, place.normal), place.normal));
    return place;
}

// The border is where walking toward it enters the next cell, and no direction leaves the cell
// before.
static void test_cells_on(void **state)
{
    (void)state;
    int entered = 0, kept = 0;
    const int count = 4000;
    for (uint64_t i = 0; i < (uint64_t)count; i++) {
        Place at = random_place(i);
        CellPoint cell = noise_cells_on(at.p, at.normal, 5);
        assert_true(cell.border >= 0.0f && cell.border < 1.0f);
        assert_float_equal(vec3_length(cell.normal), 1.0f, 1e-3f);
        assert_float_equal(vec3_dot(cell.normal, at.normal), 0.0f, 1e-3f);
        Vec3 over = vec3_madd(at.p, -(cell.border + 2e-3f), cell.normal);
        entered += noise_cells_on(over, at.normal, 5).cell == cell.next;
        Vec3 before = vec3_madd(at.p, 0.98f * cell.border, at.along);
        kept += noise_cells_on(before, at.normal, 5).cell == cell.cell;
    }
    assert_true(entered > count * 99 / 100);
    assert_true(kept > count * 99 / 100);
}

// Within a cell the border comes nearer by no more than one walks: a rim drawn along it is whole.
static void test_cells_on_have_no_steps(void **state)
{
    (void)state;
    const float step = 0.01f;
    for (uint64_t i = 0; i < 20000; i++) {
        Place at = random_place(i);
        CellPoint a = noise_cells_on(at.p, at.normal, 5);
        CellPoint b = noise_cells_on(vec3_madd(at.p, step, at.along), at.normal, 5);
        assert_true(a.cell != b.cell || fabsf(a.border - b.border) < 1.02f * step);
    }
}

// The gradient is that of the phase, and stripes are a wavelength apart.
static void test_stripes(void **state)
{
    (void)state;
    double sum = 0.0;
    int count = 0;
    for (uint64_t i = 0; i < 4000; i++) {
        Place at = random_place(i);
        const float h = 1e-3f, wavelength = 0.4f;
        Stripes s = noise_stripes_on(at.p, at.normal, wavelength, 7);
        assert_float_equal(s.cosine * s.cosine + s.sine * s.sine, 1.0f, 1e-4f);
        assert_true(s.strength >= 0.0f && s.strength < 1.0001f);
        if (s.strength < 0.1f) {
            continue;
        }
        Stripes a = noise_stripes_on(vec3_madd(at.p, -h, at.along), at.normal, wavelength, 7);
        Stripes b = noise_stripes_on(vec3_madd(at.p, h, at.along), at.normal, wavelength, 7);
        float turn =
            atan2f(b.sine * a.cosine - b.cosine * a.sine, b.cosine * a.cosine + b.sine * a.sine);
        float length = vec3_length(s.gradient);
        assert_float_equal(turn / (2.0f * h), vec3_dot(s.gradient, at.along),
                           0.3f + 0.03f * length);
        sum += (double)length;
        count++;
    }
    assert_true(count > 3000);
    assert_float_equal((float)(sum / count), 2.0f * PI_F / 0.4f, 2.5f);
}

static PatternShade shade_at(const Material *m, Vec3 p, Vec3 normal)
{
    SurfacePoint point = {.position = p,
                          .object_position = p,
                          .normal = normal,
                          .geometric_normal = normal,
                          .birth = 0.0f,
                          .footprint = 1e-6f};
    PatternShade shade = {.color = m->color, .normal = normal};
    pattern_apply(m, &point, &shade);
    return shade;
}

// Ridges have the colour, valleys color2; normals lean, and from afar both fade into their mean.
static void test_brain(void **state)
{
    (void)state;
    Material m = {.color = vec3(1, 0, 0),
                  .color2 = vec3(0, 0, 1),
                  .pattern = PATTERN_BRAIN,
                  .pattern_scale = 0.01f,
                  .pattern_depth = 0.003f};
    int ridges = 0, valleys = 0, leaning = 0;
    for (uint64_t i = 0; i < 2000; i++) {
        Place at = random_place(i);
        PatternShade shade = shade_at(&m, vec3_scale(at.p, 0.02f), at.normal);
        float red = shade.color.x / fmaxf(shade.color.x + shade.color.z, 1e-6f);
        ridges += red > 0.9f;
        valleys += red < 0.1f;
        assert_float_equal(vec3_length(shade.normal), 1.0f, 1e-3f);
        leaning += vec3_dot(shade.normal, at.normal) < 0.9f;
    }
    assert_in_range(ridges, 600, 1500);
    assert_in_range(valleys, 300, 1000);
    assert_true(leaning > 200);
    SurfacePoint far = {
        .normal = vec3(0, 1, 0), .geometric_normal = vec3(0, 1, 0), .footprint = 1.0f};
    PatternShade shade = {.color = m.color, .normal = far.normal};
    pattern_apply(&m, &far, &shade);
    assert_float_equal(vec3_dot(shade.normal, far.normal), 1.0f, 1e-6f);
    assert_true(shade.color.x > 0.2f && shade.color.z > 0.2f);
}

// Share of a wall of this slant whose colour fulfils what is asked.
static float share_where(const Material *m, Vec3 normal, bool (*asked)(Vec3 color))
{
    int count = 0, met = 0;
    for (int i = 0; i < 60; i++) {
        for (int k = 0; k < 60; k++) {
            Vec3 p = vec3(0.031f * (float)i, 0.4f, 0.031f * (float)k);
            met += asked(shade_at(m, p, normal).color);
            count++;
        }
    }
    return (float)met / (float)count;
}

static bool is_blue(Vec3 c)
{
    return c.z > 2.0f * c.x;
}

static bool is_pink(Vec3 c)
{
    return c.x > 1.5f * c.y && c.z > c.y;
}

static bool is_pale(Vec3 c)
{
    return c.x > 0.25f && c.y > 0.2f;
}

// All of a boulder lives without moss; with more of it more is dead, undersides first; what is dead
// turns pink with lichen; scars are pale marks on living tissue.
static void test_reef(void **state)
{
    (void)state;
    Material m = {.color = vec3(0.05f, 0.05f, 0.4f),
                  .color2 = vec3(0.1f, 0.1f, 0.6f),
                  .pattern = PATTERN_REEF,
                  .pattern_scale = 0.0015f};
    Vec3 up = vec3(0, 1, 0), down = vec3(0, -1, 0);
    assert_true(share_where(&m, up, is_blue) == 1.0f);
    float last = 1.0f;
    for (int i = 1; i <= 4; i++) {
        m.moss = 0.25f * (float)i;
        float lives = share_where(&m, up, is_blue);
        assert_true(lives < last);
        assert_true(share_where(&m, down, is_blue) < lives + 0.02f);
        last = lives;
    }
    assert_true(last < 0.02f);
    assert_true(share_where(&m, up, is_pink) < 0.02f);
    m.lichen = 1.0f;
    assert_true(share_where(&m, up, is_pink) > 0.3f);
    m.moss = m.lichen = 0.0f;
    assert_true(share_where(&m, up, is_pale) == 0.0f);
    m.scars = 1.0f;
    float bitten = share_where(&m, up, is_pale);
    assert_true(bitten > 0.01f && bitten < 0.3f);
}

// Young tissue has color2, old tissue color, and a leaf lets light through in the same proportion.
// The grain leans the normal up close, not from afar, and not without a depth.
static void test_youth(void **state)
{
    (void)state;
    Material m = {.kind = MATERIAL_LEAF,
                  .color = vec3(0.4f, 0.2f, 0.1f),
                  .color2 = vec3(0.6f, 0.5f, 0.5f),
                  .transmittance = vec3(0.2f, 0.1f, 0.05f),
                  .pattern = PATTERN_YOUTH};
    Vec3 up = vec3(0, 1, 0);
    int leaning = 0;
    for (uint64_t i = 0; i < 500; i++) {
        SurfacePoint point = {.position = random_vector(i, 0.3f),
                              .normal = up,
                              .geometric_normal = up,
                              .birth = i % 2 ? 1.0f : 0.0f,
                              .footprint = 1e-6f};
        m.pattern_depth = 0.0f;
        PatternShade shade = {m.color, m.transmittance, up, 0.0f, 0.5f};
        pattern_apply(&m, &point, &shade);
        Vec3 own = i % 2 ? m.color2 : m.color;
        assert_float_equal(shade.color.x / shade.color.z, own.x / own.z, 1e-3f);
        assert_float_equal(shade.transmittance.x / m.transmittance.x, shade.color.x / m.color.x,
                           1e-3f);
        assert_float_equal(shade.transmittance.z / m.transmittance.z, shade.color.z / m.color.z,
                           1e-3f);
        assert_true(vec3_dot(shade.normal, up) == 1.0f);
        m.pattern_scale = 0.0004f;
        m.pattern_depth = 0.0002f;
        shade = (PatternShade){m.color, m.transmittance, up, 0.0f, 0.5f};
        pattern_apply(&m, &point, &shade);
        leaning += vec3_dot(shade.normal, up) < 0.95f;
        point.footprint = 0.01f;
        shade = (PatternShade){m.color, m.transmittance, up, 0.0f, 0.5f};
        pattern_apply(&m, &point, &shade);
        assert_true(vec3_dot(shade.normal, up) == 1.0f);
    }
    assert_true(leaning > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cells_on), cmocka_unit_test(test_cells_on_have_no_steps),
        cmocka_unit_test(test_stripes),  cmocka_unit_test(test_reef),
        cmocka_unit_test(test_brain),    cmocka_unit_test(test_youth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
