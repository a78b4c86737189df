// Noise and the patterns made of it.
#include "render/material/pattern.h"

#include "base/color.h"
#include "base/random.h"
#include "base/strata.h"
#include "render/material/bsdf.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static Vec3 random_point(uint64_t key, float size)
{
    return vec3(random_range(random_key(key, 0), -size, size),
                random_range(random_key(key, 1), -size, size),
                random_range(random_key(key, 2), -size, size));
}

static void test_noise_range(void **state)
{
    (void)state;
    double sum = 0.0, squares = 0.0;
    float low = 1.0f, high = -1.0f;
    const int count = 100000;
    for (int i = 0; i < count; i++) {
        float n = noise_solid(random_point((uint64_t)i, 500.0f), 3, NULL);
        sum += (double)n;
        squares += (double)(n * n);
        low = fminf(low, n);
        high = fmaxf(high, n);
        float f = noise_fractal(random_point((uint64_t)i, 50.0f), 4, 3);
        assert_true(fabsf(f) < 1.6f);
    }
    assert_true(fabs(sum / count) < 0.01);
    assert_true(sqrt(squares / count) > 0.15 && sqrt(squares / count) < 0.45);
    assert_true(low > -1.3f && high < 1.3f && high > 0.6f && low < -0.6f);
    assert_float_equal(noise_solid(vec3(3, -7, 12), 3, NULL), 0.0f, 1e-6f);
    assert_true(noise_solid(vec3(0.3f, 0.4f, 0.6f), 1, NULL) !=
                noise_solid(vec3(0.3f, 0.4f, 0.6f), 2, NULL));
}

// Continuous over cell walls, and the gradient is that of the value.
static void test_noise_gradient(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 2000; i++) {
        Vec3 p = random_point(i, 20.0f), g;
        if (i % 4 == 0) {
            p.x = roundf(p.x);
        }
        float n = noise_solid(p, 9, &g);
        assert_float_equal(n, noise_solid(p, 9, NULL), 0.0f);
        const float h = 2e-3f;
        float dx = noise_solid(vec3(p.x + h, p.y, p.z), 9, NULL) -
                   noise_solid(vec3(p.x - h, p.y, p.z), 9, NULL);
        float dy = noise_solid(vec3(p.x, p.y + h, p.z), 9, NULL) -
                   noise_solid(vec3(p.x, p.y - h, p.z), 9, NULL);
        float dz = noise_solid(vec3(p.x, p.y, p.z + h), 9, NULL) -
                   noise_solid(vec3(p.x, p.y, p.z - h), 9, NULL);
        assert_float_equal(dx / (2 * h), g.x, 0.01f);
        assert_float_equal(dy / (2 * h), g.y, 0.01f);
        assert_float_equal(dz / (2 * h), g.z, 0.01f);
    }
}

static void test_cells(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 5000; i++) {
        Vec3 p = random_point(i, 30.0f), q = vec3_add(p, vec3(0, 1e-3f, 0));
        CellPoint a = noise_cells(p, 5), b = noise_cells(q, 5);
        assert_true(a.border >= 0.0f && a.border < 1.5f);
        assert_float_equal(vec3_length(a.normal), 1.0f, 1e-3f);
        // walking through a border changes the cell; the distance to it is continuous there
        if (a.cell != b.cell) {
            assert_true(a.border < 2e-3f && b.border < 2e-3f);
        }
    }
}

static SurfacePoint trunk_point(float angle, float along, float radius)
{
    Vec3 n = vec3(cosf(angle), 0, sinf(angle)), around = vec3(-n.z, 0, n.x);
    float side = angle < 0.0f ? -1.0f : 1.0f;
    SurfacePoint p = {.normal = n,
                      .geometric_normal = n,
                      .uv = {fabsf(angle) * radius, along},
                      .tangent_u = vec3_scale(around, side),
                      .tangent_v = vec3(0, 1, 0),
                      .radius = radius,
                      .footprint = 5e-4f};
    p.position = p.object_position = vec3_madd(vec3(0, along, 0), radius, n);
    return p;
}

static Material bark(void)
{
    Material m = material_default(MATERIAL_PRINCIPLED);
    m.pattern = PATTERN_BARK;
    m.pattern_depth = 0.012f;
    m.color = vec3(0.2f, 0.17f, 0.14f);
    m.color2 = vec3(0.03f, 0.024f, 0.02f);
    return m;
}

static PatternShade shade_of(const Material *m, const SurfacePoint *p)
{
    PatternShade shade = {m->color, m->transmittance, p->normal, 0.0f, m->roughness};
    pattern_apply(m, p, &shade);
    assert_true(vec3_finite(shade.color) && vec3_finite(shade.normal));
    assert_float_equal(vec3_length(shade.normal), 1.0f, 1e-3f);
    assert_true(vec3_dot(shade.normal, p->normal) > 0.2f);
    assert_true(shade.color.x >= 0.0f && shade.color.x < 1.0f);
    return shade;
}

// A grown mesh's u runs both ways round and meets itself twice: neither colour nor bump may show
// it, but where a crease of the bark just happens to lie.
static void has_no_seam(BarkKind kind)
{
    Material m = bark();
    m.bark = kind;
    int creases = 0;
    for (int i = 0; i < 400; i++) {
        float along = 0.013f * (float)i;
        for (int seam = 0; seam < 2; seam++) {
            float angle = seam ? 3.14159f : 1e-6f;
            SurfacePoint a = trunk_point(angle, along, 0.4f), b = trunk_point(-angle, along, 0.4f);
            PatternShade left = shade_of(&m, &a), right = shade_of(&m, &b);
            assert_true(vec3_distance(left.color, right.color) < 0.01f);
            creases += vec3_distance(left.normal, right.normal) > 0.05f;
        }
    }
    // a plate may end with a sharp step just there; no other bark has such
    assert_true(creases <= (kind == BARK_PLATES ? 1 : 0));
}

static void test_bark_has_no_seam(void **state)
{
    (void)state;
    for (int kind = BARK_FURROWED; kind <= BARK_GNARLED; kind++) {
        has_no_seam((BarkKind)kind);
    }
}

typedef struct Spread {
    double mean, deviation, tilt;
    double around, along; // mean change of brightness over 1 cm
} Spread;

static Spread measure_material(const Material *m, float radius, float footprint)
{
    Spread s = {0};
    const int count = 4000;
    double squares = 0.0;
    for (int i = 0; i < count; i++) {
        float angle = random_range(random_key(1, (uint64_t)i), -3.0f, 3.0f);
        float foot = m->bark == BARK_FURROWED ? 0.0f : 12.0f; // above what lies at the foot
        float along = foot + random_range(random_key(2, (uint64_t)i), 0.0f, 5.0f);
        SurfacePoint p = trunk_point(angle, along, radius);
        SurfacePoint q = trunk_point(angle + 0.01f / radius, along, radius);
        SurfacePoint r = trunk_point(angle, along + 0.01f, radius);
        p.footprint = q.footprint = r.footprint = footprint;
        PatternShade shade = shade_of(m, &p);
        double c = (double)shade.color.y;
        s.mean += c / count;
        squares += c * c / count;
        s.tilt += (double)(1.0f - vec3_dot(shade.normal, p.normal)) / count;
        s.around += fabs((double)shade_of(m, &q).color.y - c) / count;
        s.along += fabs((double)shade_of(m, &r).color.y - c) / count;
    }
    s.deviation = sqrt(fmax(0.0, squares - s.mean * s.mean));
    return s;
}

static Spread measure_kind(BarkKind kind, float radius, float footprint)
{
    Material m = bark();
    m.bark = kind;
    return measure_material(&m, radius, footprint);
}

static Spread measure_bark(float radius, float footprint)
{
    return measure_kind(BARK_FURROWED, radius, footprint);
}

// Furrows run along the stem, are deep and dark, fade with distance, and leave twigs smooth.
static void test_bark_relief(void **state)
{
    (void)state;
    Spread trunk = measure_bark(0.4f, 5e-4f), twig = measure_bark(0.004f, 5e-4f);
    Spread distant = measure_bark(0.4f, 0.5f), branch = measure_bark(0.04f, 5e-4f);
    assert_true(trunk.around > 1.5 * trunk.along);
    assert_true(trunk.deviation > 0.25 * trunk.mean);
    assert_true(trunk.tilt > 0.05);
    assert_true(twig.tilt < 1e-6 && twig.deviation < 0.1 * twig.mean);
    assert_true(distant.tilt < 1e-6 && distant.deviation < 0.4 * trunk.deviation);
    assert_true(fabs(distant.mean / trunk.mean - 1.0) < 0.1);
    assert_true(branch.tilt > 0.02 && branch.deviation > 0.15 * branch.mean);
}

// Ridges keep their metric size whatever the stem's radius.
static void test_bark_scale(void **state)
{
    (void)state;
    Spread thin = measure_bark(0.2f, 5e-4f), thick = measure_bark(0.8f, 5e-4f);
    assert_true(fabs(thin.around / thick.around - 1.0) < 0.15);
    assert_true(fabs(thin.along / thick.along - 1.0) < 0.15);
}

// The furrows of a miniature tree open on branches that would be smooth twigs of a large one.
static void test_miniature_bark(void **state)
{
    (void)state;
    Material m = bark();
    m.pattern_depth = 0.002f;
    m.pattern_scale = 0.02f;
    Spread large = measure_material(&m, 0.008f, 1e-4f);
    m.pattern_scale = 0.005f;
    Spread small = measure_material(&m, 0.008f, 1e-4f), twig = measure_material(&m, 0.001f, 1e-4f);
    assert_true(large.tilt < 1e-6 && large.deviation < 0.1 * large.mean);
    assert_true(small.tilt > 0.02 && small.deviation > 0.15 * small.mean);
    assert_true(twig.tilt < 1e-6 && twig.deviation < 0.1 * twig.mean);
}

// Marks run along the stem or across it as in nature, in metres, and fade with distance.
static void test_bark_kinds(void **state)
{
    (void)state;
    static const struct {
        BarkKind kind;
        double least, most; // change around over change along
    } kinds[] = {{BARK_PLATES, 1.05, 3.0},  {BARK_BIRCH, 0.3, 0.9},   {BARK_SMOOTH, 0.1, 0.95},
                 {BARK_FIBROUS, 3.0, 50.0}, {BARK_FLAKES, 1.02, 2.0}, {BARK_BANDS, 0.1, 0.7},
                 {BARK_SCALES, 1.02, 2.5},  {BARK_CANES, 0.05, 0.6},  {BARK_GNARLED, 1.02, 2.5}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        Spread trunk = measure_kind(kinds[i].kind, 0.25f, 5e-4f);
        Spread thick = measure_kind(kinds[i].kind, 0.5f, 5e-4f);
        Spread distant = measure_kind(kinds[i].kind, 0.25f, 0.5f);
        double direction = trunk.around / trunk.along;
        assert_true(direction > kinds[i].least && direction < kinds[i].most);
        assert_true(trunk.tilt > 1e-4 && distant.tilt < 1e-6);
        assert_true(fabs(distant.mean / trunk.mean - 1.0) < 0.15);
        assert_true(fabs(thick.around / trunk.around - 1.0) < 0.25);
        assert_true(fabs(thick.along / trunk.along - 1.0) < 0.25);
    }
}

// Mean colour of a stem of this radius between two heights.
static Vec3 mean_between(const Material *m, float radius, float low, float high)
{
    Vec3 sum = {0};
    const int count = 2000;
    for (int i = 0; i < count; i++) {
        SurfacePoint p = trunk_point(random_range(random_key(3, (uint64_t)i), -3.1f, 3.1f),
                                     random_range(random_key(4, (uint64_t)i), low, high), radius);
        sum = vec3_add(sum, shade_of(m, &p).color);
    }
    return vec3_scale(sum, 1.0f / (float)count);
}

static Material pine_bark(void)
{
    Material m = bark();
    m.bark = BARK_PLATES;
    m.color = vec3(0.16f, 0.135f, 0.115f);
    m.color2 = vec3(0.44f, 0.2f, 0.08f);
    return m;
}

// Plates are grey-brown, the papery bark above bark_height is orange; without it plates go on.
static void test_old_bark_ends(void **state)
{
    (void)state;
    Material m = pine_bark();
    Vec3 low = mean_between(&m, 0.25f, 0.5f, 2.0f), high = mean_between(&m, 0.25f, 5.0f, 9.0f);
    assert_true(fabsf(high.x / high.z - low.x / low.z) < 0.2f * low.x / low.z);
    m.bark_height = 3.0f;
    low = mean_between(&m, 0.25f, 0.5f, 2.0f);
    high = mean_between(&m, 0.25f, 5.0f, 9.0f);
    assert_true(high.x / high.z > 1.4f * low.x / low.z && high.x > 1.3f * low.x);
}

// A thin root is no papery limb: it is as dull as soil. As thin a limb far up is orange.
static void test_roots_are_dull(void **state)
{
    (void)state;
    Material m = pine_bark();
    Vec3 root = {0}, limb = {0};
    for (int i = 0; i < 500; i++) {
        SurfacePoint p = trunk_point(0.5f, 0.5f + 0.001f * (float)i, 0.05f);
        p.normal = p.geometric_normal = vec3(0, 1, 0);
        p.tangent_u = vec3(0, 0, 1);
        p.tangent_v = vec3(1, 0, 0);
        root = vec3_add(root, shade_of(&m, &p).color);
        p.uv.y += 6.0f;
        limb = vec3_add(limb, shade_of(&m, &p).color);
    }
    assert_true(limb.x / limb.z > 1.8f * root.x / root.z && limb.x > 2.0f * root.x);
}

static Material birch_bark(void)
{
    Material m = bark();
    m.bark = BARK_BIRCH;
    m.color = vec3(0.66f, 0.645f, 0.61f);
    m.scars = 0.5f;
    return m;
}

// The foot of an old birch is black, a young one's is not; bark_height tells how far it is.
static void test_birch_foot(void **state)
{
    (void)state;
    Material m = birch_bark();
    float foot = mean_between(&m, 0.15f, 0.15f, 0.35f).y, above = mean_between(&m, 0.15f, 4, 8).y;
    assert_true(foot < 0.35f * above && above > 0.3f);
    assert_true(mean_between(&m, 0.03f, 0.15f, 0.35f).y > 0.6f * above);
    m.bark_height = 3.0f;
    assert_true(mean_between(&m, 0.15f, 0.8f, 1.2f).y < 0.45f * above);
}

// Old stems are broken into plates, between which stretches are young; thin limbs are all young.
static void test_gnarled_bark_is_of_all_ages(void **state)
{
    (void)state;
    Spread old = measure_kind(BARK_GNARLED, 0.3f, 5e-4f);
    Spread limb = measure_kind(BARK_GNARLED, 0.03f, 5e-4f);
    assert_true(old.tilt > 2.0 * limb.tilt && limb.tilt > 1e-4);
    Material m = bark();
    m.bark = BARK_GNARLED;
    int smooth = 0, rough = 0;
    for (int i = 0; i < 200; i++) {
        double tilt = 0.0; // mean of a patch of 6 by 6 cm
        float angle = random_range(random_key(5, (uint64_t)i), -2.9f, 2.9f);
        float along = random_range(random_key(6, (uint64_t)i), 1.0f, 8.0f);
        for (int k = 0; k < 36; k++) {
            SurfacePoint p = trunk_point(angle + 0.01f / 0.3f * (float)(k % 6),
                                         along + 0.01f * (float)(k / 6), 0.3f);
            tilt += (double)(1.0f - vec3_dot(shade_of(&m, &p).normal, p.normal)) / 36.0;
        }
        smooth += tilt < 0.4 * old.tilt;
        rough += tilt > 0.8 * old.tilt;
    }
    assert_true(smooth > 3 && smooth < 80 && rough > 60);
}

// Marks lie on one side of the stem, even if the middle of their cell is near its axis.
static void test_birch_has_no_rings(void **state)
{
    (void)state;
    Material m = birch_bark();
    for (int i = 0; i < 1000; i++) {
        float white = 0.0f;
        for (int k = 0; k < 16; k++) {
            SurfacePoint p = trunk_point(0.39f * (float)k - 3.1f, 3.0f + 0.011f * (float)i, 0.12f);
            white = fmaxf(white, shade_of(&m, &p).color.y);
        }
        assert_true(white > 0.25f);
    }
}

// Two birches have marks at different heights; along one stem they keep their form: the drift
// changes by less than half of the way.
static void test_birches_differ(void **state)
{
    (void)state;
    Material m = birch_bark();
    double both = 0.0, one = 0.0;
    for (int i = 0; i < 3000; i++) {
        SurfacePoint p = trunk_point(0.4f, 3.0f + 0.003f * (float)i, 0.15f), q = p;
        q.object_position = vec3_add(q.object_position, vec3(7.0f, 0.0f, -5.0f));
        double a = (double)shade_of(&m, &p).color.y - 0.5,
               b = (double)shade_of(&m, &q).color.y - 0.5;
        both += fabs(a - b);
        one += fabs(a);
        StemPlace here = {0}, beside = {0};
        Vec3 at = random_point((uint64_t)i, 200.0f);
        stem_drift(&here, at);
        stem_drift(&beside, vec3_add(at, vec3(0.07f, 0.3f, 0.07f)));
        assert_true(vec3_distance(here.drift, beside.drift) < 0.5f * 0.1f);
    }
    assert_true(both > 0.15 * one);
}

// The slope of plates is that of their height, but for what bends their borders.
static void test_plates_slope(void **state)
{
    (void)state;
    double both = 0.0, first = 0.0, second = 0.0;
    for (int i = 0; i < 20000; i++) {
        float along = random_range(random_key(5, (uint64_t)i), 0.0f, 20.0f);
        float angle = random_range(random_key(6, (uint64_t)i), -3.0f, 3.0f), step = 2e-4f;
        float height[2];
        SurfacePoint p = trunk_point(angle, along, 0.3f);
        StemPlace place = stem_place(&p, 0.0f);
        BarkLook middle = {0};
        bark_add_plates(&middle, &place, 0.09f, 0.3f, vec3(0, 0, 0), 41);
        for (int k = 0; k < 2; k++) {
            Vec3 at = vec3_madd(place.p, k ? step : -step, place.along_u);
            StemPlace aside = place;
            aside.p = at;
            BarkLook look = {0};
            bark_add_plates(&look, &aside, 0.09f, 0.3f, vec3(0, 0, 0), 41);
            height[k] = look.height;
        }
        double measured = fmin(200.0, fmax(-200.0, (double)((height[1] - height[0]) / (2 * step))));
        double told = fmin(200.0, fmax(-200.0, (double)middle.slope_u));
        both += measured * told;
        first += measured * measured;
        second += told * told;
    }
    assert_true(both / sqrt(first * second) > 0.8);
}

static void without_branch(BarkKind kind)
{
    Material m = bark();
    m.bark = kind;
    SurfacePoint p = {.normal = vec3(0, 1, 0), .geometric_normal = vec3(0, 1, 0)};
    shade_of(&m, &p);
    p.normal = p.geometric_normal = vec3(0.6f, 0, 0.8f);
    p.object_position = vec3(100, 200, -300);
    shade_of(&m, &p);
}

// Imported meshes know no branch.
static void test_bark_without_branch(void **state)
{
    (void)state;
    for (int kind = BARK_FURROWED; kind <= BARK_GNARLED; kind++) {
        without_branch((BarkKind)kind);
    }
}

static void test_ground(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_GROUND;
    m.pattern_depth = 0.02f;
    m.color = vec3(0.08f, 0.12f, 0.03f);
    m.color2 = vec3(0.13f, 0.09f, 0.06f);
    int green = 0, earth = 0;
    for (int i = 0; i < 4000; i++) {
        Vec3 at = random_point((uint64_t)i, 40.0f);
        SurfacePoint p = {.normal = vec3(0, 1, 0), .geometric_normal = vec3(0, 1, 0)};
        p.position = p.object_position = vec3(at.x, 0, at.z);
        Vec3 c = shade_of(&m, &p).color;
        green += c.y > c.x;
        earth += c.x > c.y;
    }
    assert_true(green > 2400 && earth > 40);
}

// A point on the midrib of a leaf 6 by 10 cm, from near.
static SurfacePoint on_midrib(void)
{
    return (SurfacePoint){.normal = vec3(0, 0, 1),
                          .geometric_normal = vec3(0, 0, 1),
                          .tangent_u = vec3(0.06f, 0, 0),
                          .tangent_v = vec3(0, 0.1f, 0),
                          .uv = {0.5f, 0.4f},
                          .footprint = 1e-5f};
}

static void test_leaf_veins(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    m.pattern = PATTERN_LEAF;
    SurfacePoint p = on_midrib();
    PatternShade midrib = shade_of(&m, &p);
    double blade = 0.0, through = 0.0, red = 0.0;
    for (int i = 0; i < 1000; i++) {
        p.uv = (Vec2){random_unit(random_key(1, (uint64_t)i)),
                      random_unit(random_key(2, (uint64_t)i))};
        PatternShade s = shade_of(&m, &p);
        blade += (double)s.color.y / 1000.0;
        through += (double)s.transmittance.y / 1000.0;
        red += (double)s.transmittance.x / 1000.0;
    }
    assert_true((double)midrib.color.y > 1.15 * blade);
    // against the light dark, and yellower
    assert_true((double)midrib.transmittance.y < 0.55 * through);
    assert_true((double)midrib.transmittance.x / (double)midrib.transmittance.y >
                1.1 * red / through);
}

// Pale veins: from above the midrib stands out far more, the blade far from it has its fine veins
// alone, and the light that passes does not change.
static void test_leaf_pale_veins(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF), pale;
    m.pattern = PATTERN_LEAF;
    m.color = m.color2 = vec3(0.03f, 0.06f, 0.015f);
    pale = m;
    pale.pale_veins = 1.0f;
    SurfacePoint p = on_midrib();
    assert_true(shade_of(&pale, &p).color.y > 2.5f * shade_of(&m, &p).color.y);
    double before = 0.0, after = 0.0;
    for (int i = 0; i < 1000; i++) {
        p.uv = (Vec2){0.75f + 0.25f * random_unit(random_key(1, (uint64_t)i)),
                      random_unit(random_key(2, (uint64_t)i))};
        PatternShade plain = shade_of(&m, &p), lit = shade_of(&pale, &p);
        before += (double)plain.color.y;
        after += (double)lit.color.y;
        assert_float_equal(lit.transmittance.y, plain.transmittance.y, 0.0f);
    }
    assert_true(after > 1.02 * before && after < 1.4 * before); // side veins alone
}

// How many veins a circle of this radius about the stalk's end crosses.
static int veins_crossed(const Material *m, float radius)
{
    enum { STEPS = 4000 };
    SurfacePoint p = on_midrib();
    int crossed = 0;
    bool before = false;
    for (int i = 0; i <= STEPS; i++) {
        float turn = 2.0f * PI_F * ((float)i + 0.5f) / STEPS;
        p.uv = (Vec2){0.5f + radius * sinf(turn), 0.5f + radius * cosf(turn)};
        bool vein = shade_of(m, &p).transmittance.y < 0.5f * m->transmittance.y;
        crossed += i > 0 && vein && !before;
        before = vein;
    }
    return crossed;
}

// A pad's veins are as many as asked for, and fork toward its rim.
static void test_leaf_rays(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    m.pattern = PATTERN_LEAF;
    for (m.rays = 8.0f; m.rays < 20.0f; m.rays += 5.0f) {
        assert_int_equal(veins_crossed(&m, 0.08f), (int)m.rays);
        int rim = veins_crossed(&m, 0.47f);
        assert_true(rim > 3 * (int)m.rays && rim <= 4 * (int)m.rays);
    }
}

// Dead spots are brown, and take up little of some leaves.
static void test_leaf_spots(void **state)
{
    (void)state;
    enum { LEAVES = 40, POINTS = 500 };
    Material m = material_default(MATERIAL_LEAF);
    m.pattern = PATTERN_LEAF;
    SurfacePoint p = {.normal = vec3(0, 0, 1),
                      .geometric_normal = vec3(0, 0, 1),
                      .tangent_u = vec3(0.06f, 0, 0),
                      .tangent_v = vec3(0, 0.1f, 0),
                      .footprint = 1e-5f};
    int brown = 0, whole = 0;
    for (uint64_t leaf = 0; leaf < LEAVES; leaf++) {
        p.variation = random_unit(random_key(5, leaf));
        int before = brown;
        for (uint64_t i = 0; i < POINTS; i++) {
            uint64_t key = random_key(leaf, i);
            p.uv = (Vec2){random_unit(random_key(key, 1)), random_unit(random_key(key, 2))};
            Vec3 c = shade_of(&m, &p).color;
            brown += c.x > c.y;
        }
        whole += brown == before;
    }
    double share = (double)brown / (LEAVES * POINTS);
    if (share < 0.0005 || share > 0.02 || whole < LEAVES / 5 || whole > LEAVES * 4 / 5) {
        fail_msg("%g of the blades are brown, %d of %d leaves are whole", share, whole, LEAVES);
    }
}

// Light that passes a blotch takes on the second colour too; over many blades the mean is that of a
// material whose second colour is its own.
static void test_leaf_blotches_tint_light_that_passes(void **state)
{
    (void)state;
    Material plain = material_default(MATERIAL_LEAF);
    plain.pattern = PATTERN_LEAF;
    plain.color2 = plain.color;
    Material spotted = plain;
    spotted.color2 = vec3(3.0f * plain.color.x, 0.5f * plain.color.y, plain.color.z);
    SurfacePoint p = {.normal = vec3(0, 0, 1),
                      .geometric_normal = vec3(0, 0, 1),
                      .tangent_u = vec3(0.06f, 0, 0),
                      .tangent_v = vec3(0, 0.1f, 0),
                      .footprint = 1e-5f};
    double sum[2] = {0}, own[2] = {0};
    float least = INFINITY, most = 0.0f;
    for (int i = 0; i < 20000; i++) {
        p.uv = (Vec2){random_unit(random_key(1, (uint64_t)i)),
                      random_unit(random_key(2, (uint64_t)i))};
        p.variation = random_unit(random_key(3, (uint64_t)i));
        Vec3 a = shade_of(&plain, &p).transmittance, b = shade_of(&spotted, &p).transmittance;
        own[0] += (double)a.x;
        own[1] += (double)a.y;
        sum[0] += (double)b.x;
        sum[1] += (double)b.y;
        least = fminf(least, b.x / b.y);
        most = fmaxf(most, b.x / b.y);
        assert_float_equal(b.z, a.z, 1e-6f);
    }
    assert_true(most > 1.5f * least);
    assert_true(fabs(sum[0] / own[0] - 1.0) < 0.005 && fabs(sum[1] / own[1] - 1.0) < 0.005);
}

// Instances differ as far as `variation` says, and not at all without it.
static void test_variation(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    SurfacePoint p = {.normal = vec3(0, 0, 1), .geometric_normal = vec3(0, 0, 1)};
    float low = 1.0f, high = 0.0f;
    for (int k = 0; k < 2; k++) {
        m.variation = 0.4f * (float)k;
        low = 1.0f;
        high = 0.0f;
        for (int i = 0; i < 200; i++) {
            p.variation = (float)i / 200.0f;
            float value = shade_of(&m, &p).color.y / m.color.y;
            low = fminf(low, value);
            high = fmaxf(high, value);
        }
        assert_true(k || (low == 1.0f && high == 1.0f));
    }
    assert_true(low < 0.9f && low > 0.8f && high > 1.1f && high < 1.2f);
}

static SurfacePoint on_stone(Vec3 p, float footprint)
{
    return (SurfacePoint){.position = p,
                          .object_position = p,
                          .normal = vec3(0, 1, 0),
                          .geometric_normal = vec3(0, 1, 0),
                          .footprint = footprint};
}

// The relief is about as deep as asked, bounded, and made of the larger features alone where pixels
// are coarse; colours stay between those of its minerals.
static void test_stone(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_STONE;
    m.color = vec3_splat(0.3f);
    m.color2 = vec3_splat(0.1f);
    m.pattern_scale = 0.5f;
    m.pattern_depth = 0.02f;
    double squares = 0.0, coarse_squares = 0.0, sum = 0.0;
    const int count = 4000;
    for (uint64_t i = 0; i < (uint64_t)count; i++) {
        Vec3 p = random_point(i, 10.0f);
        SurfacePoint near = on_stone(p, 0.0005f), far = on_stone(p, 1.0f);
        float height = pattern_height(&m, &near);
        assert_true(fabsf(height) < 0.025f);
        sum += (double)height;
        squares += (double)(height * height);
        coarse_squares += (double)powf(pattern_height(&m, &far), 2.0f);
        PatternShade shade = {.color = m.color, .normal = vec3(0, 1, 0)};
        pattern_apply(&m, &near, &shade);
        assert_true(shade.color.x >= 0.1f * 0.35f * 0.5f && shade.color.x <= 0.3f * 1.2f * 1.5f);
        assert_true(fabsf(vec3_length(shade.normal) - 1.0f) < 1e-4f && shade.normal.y > 0.0f);
    }
    double deviation = sqrt(squares / count);
    assert_true(deviation > 0.1 * 0.02 && deviation < 0.4 * 0.02);
    assert_true(fabs(sum / count) < 0.1 * 0.02); // about its mean, less the joints
    assert_true(coarse_squares == 0.0);
}

// Moss covers level places, not overhangs, and more of it where more is asked for.
static void test_stone_moss(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_STONE;
    m.color = m.color2 = vec3_splat(0.2f);
    m.pattern_depth = 0.02f;
    double greener[3] = {0};
    for (int k = 0; k < 3; k++) {
        m.moss = k == 0 ? 0.3f : 0.7f;
        for (uint64_t i = 0; i < 2000; i++) {
            SurfacePoint point = on_stone(random_point(i, 10.0f), 0.001f);
            if (k == 2) {
                point.normal = point.geometric_normal = vec3(0, -1, 0);
            }
            PatternShade shade = {.color = m.color, .normal = point.normal};
            pattern_apply(&m, &point, &shade);
            greener[k] += (double)(shade.color.y > 1.2f * shade.color.x) / 2000.0;
        }
    }
    assert_true(greener[1] > greener[0] + 0.1);
    assert_true(greener[2] < 0.2 * greener[1]);
}

// The normals of a karst wall turn across it, from flute to flute, more than down it.
static void test_karst_is_fluted(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_KARST;
    m.pattern_depth = 1.0f;
    double turned[2] = {0};
    for (uint64_t i = 0; i < 4000; i++) {
        Vec3 p = random_point(i, 200.0f), n[3];
        for (int k = 0; k < 3; k++) {
            Vec3 at = k == 0 ? p : vec3_add(p, k == 1 ? vec3(2, 0, 0) : vec3(0, 2, 0));
            SurfacePoint point = on_stone(at, 0.6f);
            point.normal = point.geometric_normal = vec3(0, 0, 1);
            point.site = (Vec2){0.1f, 0.0f}; // 100 m above the plain
            PatternShade shade = {.color = m.color, .normal = point.normal};
            pattern_apply(&m, &point, &shade);
            n[k] = shade.normal;
        }
        turned[0] += (double)fabsf(n[1].x - n[0].x) / 4000.0;
        turned[1] += (double)fabsf(n[2].x - n[0].x) / 4000.0;
    }
    printf("    turned by %.3f across, by %.3f down\n", turned[0], turned[1]);
    assert_true(turned[0] > 1.9 * turned[1]);
}

// The relief of a wall of badlands changes across its fall, from runnel to runnel, more than down
// it, whatever way it faces.
static void test_runnels_follow_the_fall(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_BADLANDS;
    m.pattern_depth = 0.5f;
    m.pattern_scale = 10.0f;
    static const float azimuth[] = {0.0f, 0.2f, 0.55f, 1.3f, 2.5f};
    for (int a = 0; a < 5; a++) {
        float x = cosf(azimuth[a]), z = sinf(azimuth[a]), s = 0.70710678f;
        Vec3 normal = vec3(s * x, s, s * z), fall = vec3(s * x, -s, s * z), level = vec3(-z, 0, x);
        double change[2] = {0};
        for (uint64_t i = 0; i < 2000; i++) {
            Vec3 p = random_point(i, 200.0f);
            float height[3];
            for (int k = 0; k < 3; k++) {
                Vec3 at = k == 0 ? p : vec3_madd(p, 0.5f, k == 1 ? level : fall);
                SurfacePoint point = on_stone(at, 0.15f);
                point.normal = point.geometric_normal = normal;
                height[k] = pattern_height(&m, &point);
            }
            change[0] += (double)fabsf(height[1] - height[0]) / 2000.0;
            change[1] += (double)fabsf(height[2] - height[0]) / 2000.0;
        }
        printf("    %.3f m in 0.5 m across, %.3f m down\n", change[0], change[1]);
        assert_true(change[0] > 1.9 * change[1]);
    }
}

// Height of dried clay at a point, and how dark its cracks are, by the pattern's relief and colour.
typedef struct DriedSample {
    double height, value; // m; luminance
} DriedSample;

static DriedSample dried_at(const Material *m, Vec3 p, Vec3 normal, float wet, float footprint)
{
    SurfacePoint point = on_stone(p, footprint);
    point.normal = point.geometric_normal = normal;
    point.site.y = wet;
    PatternShade shade = {.color = m->color, .normal = normal};
    pattern_apply(m, &point, &shade);
    return (DriedSample){(double)pattern_height(m, &point), (double)luminance(shade.color)};
}

// Dried clay stands in pieces a few centimetres high between cracks, dark where they are deep, on
// walls and on washes; a pixel wider than its pieces and a wall without cracks show none of it.
static void test_clay_dries_to_pieces(void **state)
{
    (void)state;
    Material wet = material_default(MATERIAL_DIFFUSE);
    wet.pattern = PATTERN_BADLANDS;
    wet.pattern_depth = 0.4f;
    wet.pattern_scale = 10.0f;
    Material dry = wet;
    dry.cracks = 1.0f;
    static const Vec3 NORMAL[] = {{0.6f, 0.8f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    for (int k = 0; k < 2; k++) {
        const int count = 4000;
        double low = 0.0, high = 0.0, deep = 0.0, top = 0.0, squares = 0.0;
        int deep_count = 0, top_count = 0;
        for (int i = 0; i < count; i++) {
            Vec3 p = random_point((uint64_t)i, 40.0f);
            DriedSample a = dried_at(&wet, p, NORMAL[k], (float)k, 0.001f);
            DriedSample b = dried_at(&dry, p, NORMAL[k], (float)k, 0.001f);
            DriedSample far_a = dried_at(&wet, p, NORMAL[k], (float)k, 0.5f);
            DriedSample far_b = dried_at(&dry, p, NORMAL[k], (float)k, 0.5f);
            assert_true(far_a.height == far_b.height && far_a.value == far_b.value);
            double h = b.height - a.height, tone = b.value / a.value;
            low = fmin(low, h);
            high = fmax(high, h);
            squares += h * h / count;
            deep += h < -0.02 ? tone : 0.0;
            deep_count += h < -0.02;
            top += h > 0.0 ? tone : 0.0;
            top_count += h > 0.0;
        }
        printf("    %s: %.3f to %.3f m, +-%.4f; cracks %.2f, tops %.2f as light\n",
               k == 0 ? "wall" : "wash", low, high, sqrt(squares), deep / deep_count,
               top / top_count);
        assert_true(low > -0.12 && low < -0.02 && high < 0.06 && high > 0.01);
        assert_true(sqrt(squares) > 0.004);
        assert_true(deep_count > count / 200 && top_count > count / 50);
        assert_true(deep / deep_count < 0.9 * top / top_count);
    }
}

// A mat of moss has a relief of its own, also where the stone has none and is not displaced.
static void test_moss_is_no_paint(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_STONE;
    m.color = m.color2 = vec3_splat(0.2f);
    m.pattern_depth = 0.0f;
    double tilted[2] = {0};
    for (int k = 0; k < 2; k++) {
        m.moss = k == 0 ? 0.0f : 0.85f;
        for (uint64_t i = 0; i < 2000; i++) {
            SurfacePoint point = on_stone(random_point(i, 10.0f), 0.006f);
            PatternShade shade = {.color = m.color, .normal = point.normal};
            pattern_apply(&m, &point, &shade);
            tilted[k] += (double)(shade.normal.y < 0.97f) / 2000.0; // 14 degrees
        }
    }
    printf("    tilted: %.3f of bare stone, %.3f of mossy stone\n", tilted[0], tilted[1]);
    assert_true(tilted[0] == 0.0 && tilted[1] > 0.2);
}

// Stones lie before the mortar between them, on all sides of a wall, and differ in tone.
static void test_masonry(void **state)
{
    (void)state;
    static const Vec3 SIDES[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_MASONRY;
    m.color = vec3_splat(0.3f);
    m.color2 = vec3_splat(0.12f);
    m.pattern_scale = 0.2f;
    m.pattern_depth = 0.03f;
    for (int side = 0; side < 3; side++) {
        int mortar = 0;
        float dark = 1.0f, bright = 0.0f;
        const int count = 4000;
        for (uint64_t i = 0; i < (uint64_t)count; i++) {
            SurfacePoint point = on_stone(random_point(i, 5.0f), 0.0005f);
            point.normal = point.geometric_normal = SIDES[side];
            float height = pattern_height(&m, &point);
            assert_true(height > -0.025f && height < 0.03f);
            mortar += height < -0.01f;
            PatternShade shade = {.color = m.color, .normal = point.normal};
            pattern_apply(&m, &point, &shade);
            dark = fminf(dark, shade.color.x);
            bright = fmaxf(bright, shade.color.x);
            assert_true(vec3_dot(shade.normal, point.normal) > 0.0f);
        }
        // joints of a tenth of a course between stones of 1 by 1.7: about 15 % of the face
        assert_in_range(mortar, count / 20, count / 3);
        assert_true(dark < 0.1f && bright > 0.27f);
    }
}

// Dressed stone is weathered like the wall's stones, but has no joints: nothing as deep as mortar
// in one place of fifty. Rain has darkened it in streaks, which are longer down than across.
static void test_dressed_stone(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_DRESSED;
    m.color = vec3_splat(0.3f);
    m.color2 = vec3_splat(0.12f);
    m.pattern_scale = 0.2f;
    m.pattern_depth = 0.03f;
    int deep = 0;
    const int count = 4000;
    double change[2] = {0}, squares = 0.0, sum = 0.0;
    for (uint64_t i = 0; i < (uint64_t)count; i++) {
        Vec3 p = vec3_add(random_point(i, 5.0f), vec3(0, 20, 0)); // above the damp foot
        float tone[3];
        for (int k = 0; k < 3; k++) { // here, aside, below
            Vec3 at = vec3_madd(p, k > 0 ? 0.3f : 0.0f, k == 1 ? vec3(1, 0, 0) : vec3(0, -1, 0));
            SurfacePoint point = on_stone(at, 0.0005f);
            point.normal = point.geometric_normal = vec3(0, 0, 1);
            float height = pattern_height(&m, &point);
            assert_true(height > -0.025f && height < 0.03f);
            deep += k == 0 && height < -0.01f;
            sum += k == 0 ? (double)height : 0.0;
            squares += k == 0 ? (double)(height * height) : 0.0;
            PatternShade shade = {.color = m.color, .normal = point.normal};
            pattern_apply(&m, &point, &shade);
            tone[k] = shade.color.x;
        }
        change[0] += fabs((double)(tone[1] - tone[0]));
        change[1] += fabs((double)(tone[2] - tone[0]));
    }
    assert_true(deep < count / 50);
    double mean = sum / count;
    assert_true(sqrt(squares / count - mean * mean) > 0.05 * 0.03); // of the depth
    assert_true(change[0] > 1.1 * change[1]);
}

static void test_noise_pattern(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_NOISE;
    m.pattern_depth = 0.01f;
    float low = 1.0f, high = 0.0f;
    for (int i = 0; i < 1000; i++) {
        SurfacePoint p = {.normal = vec3(0, 0, 1), .geometric_normal = vec3(0, 0, 1)};
        p.object_position = random_point((uint64_t)i, 3.0f);
        float c = shade_of(&m, &p).color.x;
        assert_true(c >= 0.0999f && c <= 0.5001f);
        low = fminf(low, c);
        high = fmaxf(high, c);
    }
    assert_true(low < 0.2f && high > 0.4f);
}

// A leaf's transmittance follows its colour from point to point.
static void test_noise_tints_light_that_passes_a_leaf(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    m.pattern = PATTERN_NOISE;
    m.color2 = vec3(0.5f * m.color.x, m.color.y, 2.0f * m.color.z);
    float least = INFINITY, most = 0.0f;
    for (int i = 0; i < 1000; i++) {
        SurfacePoint p = {.normal = vec3(0, 0, 1), .geometric_normal = vec3(0, 0, 1)};
        p.object_position = random_point((uint64_t)i, 3.0f);
        PatternShade shade = shade_of(&m, &p);
        float share = shade.transmittance.x / m.transmittance.x;
        assert_float_equal(share, shade.color.x / m.color.x, 1e-5f);
        assert_float_equal(shade.transmittance.y, m.transmittance.y, 1e-6f);
        least = fminf(least, share), most = fmaxf(most, share);
    }
    assert_true(least < 0.6f && most > 0.9f && most <= 1.0f + 1e-5f);
}

// Snow has no walls, which would be diced to dust, and its bumps are those of its relief; the
// tracks of a fox are small and deep.
static void test_snow(void **state)
{
    (void)state;
    const float depth = 0.3f, step = 0.001f;
    enum { PLACES = 60000 };
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_SNOW;
    m.pattern_depth = depth;
    m.displacement = DISPLACEMENT_ON;
    Material tracked = m;
    tracked.scars = 1.0f;
    int prints = 0;
    float steepest = 0.0f, deepest = 0.0f;
    double mean = 0.0, off = 0.0, slopes = 0.0;
    for (int i = 0; i < PLACES; i++) {
        SurfacePoint p = {.normal = vec3(0, 1, 0), .geometric_normal = vec3(0, 1, 0)};
        p.smooth_normal = p.facet_normal = p.normal;
        p.object_position = random_point((uint64_t)i, 9.0f);
        p.object_position.y = 0.0f;
        p.footprint = 1e-3f;
        SurfacePoint beside = p;
        beside.object_position.x += step;
        float height = pattern_height(&m, &p), print = pattern_height(&tracked, &p) - height;
        float slope = (pattern_height(&tracked, &beside) - height - print) / step;
        steepest = fmaxf(steepest, fabsf(slope));
        deepest = fminf(deepest, print);
        prints += print < -0.02f;
        mean += (double)height / PLACES;
        p.footprint = beside.footprint = 0.03f; // too large for grains
        beside.object_position.x = p.object_position.x + 0.25f * p.footprint;
        Vec3 n = shade_of(&m, &p).normal;
        slope = (pattern_height(&m, &beside) - pattern_height(&m, &p)) / (0.25f * p.footprint);
        slopes += (double)fabsf(slope) / PLACES;
        off += fabs((double)(-n.x / n.y - slope)) / PLACES;
        assert_true(fabsf(height) < depth);
    }
    print_message(
        "mean %.4f, steepest %.2f, prints %.4f, deepest %.3f, bumps off by %.4f of %.4f\n", mean,
        (double)steepest, (double)prints / PLACES, (double)deepest, off, slopes);
    assert_true(fabs(mean) < 0.1 * (double)depth);
    assert_true(steepest < 8.0f);
    assert_true(deepest < -0.05f && deepest > -0.11f);
    assert_true(prints > PLACES / 2000 && prints < PLACES / 100);
    assert_true(off < 0.2 * slopes);
}

static float clay_height(const Material *m, const SurfacePoint *point, Vec3 p)
{
    SurfacePoint at = *point;
    at.object_position = p;
    return pattern_height(m, &at);
}

// What is too fine for the geometry is bumps, all of it and once: for relief as of pixels five
// times as wide, the bumps are the slope less that of the wide pixel.
static void test_bumps_are_what_the_geometry_leaves_out(void **state)
{
    (void)state;
    enum { PLACES = 2000 };
    const float step = 0.004f;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_BADLANDS;
    m.pattern_scale = 10.0f;
    m.pattern_depth = 0.5f;
    double fine = 0.0, left_out = 0.0, off = 0.0;
    for (int i = 0; i < PLACES; i++) {
        SurfacePoint p = on_stone(random_point((uint64_t)i, 9.0f), 0.01f), wide = p;
        wide.footprint = 0.05f;
        p.displaced = 1.0f;
        p.coarsening = 5.0f;
        Vec3 slope = pattern_slope(&m, &p, clay_height, step);
        Vec3 shown = pattern_slope(&m, &wide, clay_height, step);
        Vec3 bump = pattern_bump(&m, &p, clay_height, step);
        fine += (double)vec3_length(slope) / PLACES;
        left_out += (double)vec3_length(bump) / PLACES;
        off += (double)vec3_distance(vec3_add(bump, shown), slope) / PLACES;
        p.coarsening = 1.0f;
        assert_float_equal(vec3_length(pattern_bump(&m, &p, clay_height, step)), 0.0f, 0.0f);
        p.displaced = 0.0f;
        assert_float_equal(vec3_distance(pattern_bump(&m, &p, clay_height, step), slope), 0.0f,
                           1e-6f);
    }
    print_message("slope %.3f, left out %.3f, off %.6f\n", fine, left_out, off);
    assert_true(off < 1e-4 * fine);
    assert_true(left_out > 0.2 * fine); // crumbs are finer than the geometry's edges
}

// The wind cuts sastrugi that are steep against it and flat in the lee, about the old surface.
static void test_sastrugi(void **state)
{
    (void)state;
    enum { PLACES = 40000 };
    const float depth = 0.3f, step = 0.01f;
    Material plain = material_default(MATERIAL_DIFFUSE);
    plain.pattern = PATTERN_SNOW;
    plain.pattern_depth = depth;
    Material cut = plain;
    cut.ribs = 1.0f;
    double mean = 0.0, squares = 0.0, cubes = 0.0, across = 0.0;
    for (int i = 0; i < PLACES; i++) {
        SurfacePoint p = {.normal = vec3(0, 1, 0), .footprint = 1e-3f};
        p.object_position = random_point((uint64_t)i, 20.0f);
        SurfacePoint lee = p, aside = p;
        lee.object_position = vec3_madd(p.object_position, step, vec3(0.83f, 0.0f, 0.56f));
        aside.object_position = vec3_madd(p.object_position, step, vec3(-0.56f, 0.0f, 0.83f));
        float here = pattern_height(&cut, &p) - pattern_height(&plain, &p);
        float rise = pattern_height(&cut, &lee) - pattern_height(&plain, &lee) - here;
        float beside = pattern_height(&cut, &aside) - pattern_height(&plain, &aside) - here;
        double slope = (double)(rise / step), flank = (double)(beside / step);
        assert_true(fabsf(here) < 0.11f * depth);
        mean += (double)here / PLACES;
        squares += slope * slope / PLACES;
        cubes += slope * slope * slope / PLACES;
        across += flank * flank / PLACES;
    }
    double skewness = cubes / (squares * sqrt(squares));
    print_message("mean %.4f, slope along the wind %.3f, skewness %.2f, across it %.3f\n", mean,
                  sqrt(squares), skewness, sqrt(across));
    assert_true(fabs(mean) < 0.02 * (double)depth);
    assert_true(skewness > 1.0);
    assert_true(across > 2.0 * squares);
}

// Places of level ice where a pixel of this size (m) is seen.
static SurfacePoint ice_at(int i, float footprint)
{
    SurfacePoint p = {.normal = vec3(0, 1, 0), .geometric_normal = vec3(0, 1, 0)};
    p.object_position = random_point((uint64_t)i, 2.0f);
    p.object_position.y = 0.0f;
    p.footprint = footprint;
    return p;
}

// Large pixels see the mean of the grains that small ones see, and most are where it is dull.
static void test_ice(void **state)
{
    (void)state;
    enum { PLACES = 40000 };
    Material m = material_default(MATERIAL_PRINCIPLED);
    m.pattern = PATTERN_ICE;
    m.pattern_scale = 0.1f;
    m.roughness = 0.1f;
    double near = 0.0, far = 0.0, white[2] = {0};
    int places[2] = {0};
    float least = 1.0f, most = 0.0f;
    for (int i = 0; i < PLACES; i++) {
        SurfacePoint fine = ice_at(i, 1e-5f), coarse = ice_at(i, 3e-3f);
        PatternShade a = shade_of(&m, &fine), b = shade_of(&m, &coarse);
        assert_true(a.foam >= 0.0f && a.foam <= 1.0f && a.roughness >= m.roughness);
        near += (double)a.foam / PLACES;
        far += (double)b.foam / PLACES;
        least = fminf(least, a.roughness), most = fmaxf(most, a.roughness);
        int dull = a.roughness > 0.3f;
        places[dull]++;
        white[dull] += (double)a.foam;
    }
    white[0] /= places[0], white[1] /= places[1];
    print_message("white %.4f near, %.4f far; clear %.4f, dull %.4f; roughness %.2f to %.2f\n",
                  near, far, white[0], white[1], (double)least, (double)most);
    assert_true(fabs(near / far - 1.0) < 0.08);
    assert_true(white[0] > 0.0 && white[1] > 3.0 * white[0]);
    assert_true(least == m.roughness && most > 0.4f);
}

// The roughness of the place reaches the surface's lobe: a dull patch is that of a dull material.
static void test_ice_is_dull_in_patches(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_PRINCIPLED);
    m.pattern = PATTERN_ICE;
    m.roughness = 0.1f;
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    assert_non_null(set);
    float least = 1.0f, most = 0.0f;
    for (int i = 0; i < 400; i++) {
        SurfacePoint p = ice_at(i, 1e-4f);
        Bsdf b;
        bsdf_fill(set, &p, vec3(0.6f, 0.8f, 0.0f), &b);
        float roughness = shade_of(&m, &p).roughness;
        assert_float_equal(b.alpha, roughness * roughness, 1e-6f);
        least = fminf(least, b.alpha), most = fmaxf(most, b.alpha);
    }
    assert_true(most > 5.0f * least);
    material_set_free(set);
}

// A wall of 45 degrees through three beds, the middle one a ledge, seen from near. What is looked
// for is at steps of 2 mm down a vertical profile.
typedef struct Contact {
    float at;   // m: height of the largest step of colour over 4 cm
    float step; // as a share of the difference between the beds
    float edge; // m: height where the relief steps most
} Contact;

static Contact contact_at(const Material *m, const Strata *strata, float x)
{
    enum { STEPS = 1200, APART = 20 };
    float red[STEPS], height[STEPS], highest = 0.0f;
    Contact c = {0};
    for (int i = 0; i < STEPS; i++) {
        float y = 0.002f * (float)(i - STEPS / 2) - 0.8f;
        SurfacePoint point = on_stone(vec3(x, y, 0.0f), 0.002f);
        point.normal = point.geometric_normal = vec3(0.0f, 0.70710678f, 0.70710678f);
        point.strata = strata;
        point.displaced = 1.0f;
        PatternShade shade = {.color = m->color, .normal = point.normal};
        pattern_apply(m, &point, &shade);
        red[i] = shade.color.x;
        height[i] = pattern_height(m, &point);
        if (i >= APART && red[i] - red[i - APART] > c.step * 0.3f) {
            c.step = (red[i] - red[i - APART]) / 0.3f;
            c.at = y - 0.001f * APART;
        }
        if (i >= APART && height[i] - height[i - APART] > highest) {
            highest = height[i] - height[i - APART];
            c.edge = y - 0.001f * APART;
        }
    }
    return c;
}

// Beds meet within a few centimetres, in a line that is not ruled; a hard bed stands out from its
// very contact with the soft one below.
static void test_contacts_are_sharp_and_ledges_end_at_them(void **state)
{
    (void)state;
    enum { COLUMNS = 120 };
    StrataBed bed[] = {{.thickness = 5, .hardness = 0.2f, .color = {0.45f, 0.4f, 0.3f}},
                       {.thickness = 0.8f, .hardness = 0.5f, .color = {0.5f, 0.5f, 0.5f}},
                       {.thickness = 5, .hardness = 0.2f, .color = {0.2f, 0.1f, 0.1f}}};
    bed[1].ledge = 0.3f;
    Error e = {0};
    Strata *strata = strata_new(&(StrataParams){.beds = bed, .bed_count = 3},
                                vec3(0.0f, 5.0f, 0.0f), 100.0f, &e);
    assert_non_null(strata);
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_BADLANDS;
    m.pattern_scale = 10.0f;
    m.pattern_depth = 0.5f;
    int sharp = 0, ledges = 0;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < COLUMNS; i++) {
        Contact c = contact_at(&m, strata, 0.31f * (float)i);
        bool clear = c.step > 0.45f;
        sharp += clear;
        ledges += clear && fabsf(c.at - c.edge) < 0.06f;
        sum += clear ? (double)c.at : 0.0;
        squares += clear ? (double)c.at * (double)c.at : 0.0;
    }
    double mean = sum / sharp, spread = sqrt(squares / sharp - mean * mean);
    printf("    %d of %d sharp, at %.2f +- %.2f m; %d with a ledge there\n", sharp, COLUMNS, mean,
           spread, ledges);
    assert_true(sharp > COLUMNS / 2);
    assert_true(fabs(mean + 0.8) < 0.3 && spread > 0.02 && spread < 0.5);
    assert_true(ledges > sharp / 2);
    strata_free(strata);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_noise_range),
        cmocka_unit_test(test_noise_gradient),
        cmocka_unit_test(test_cells),
        cmocka_unit_test(test_bark_has_no_seam),
        cmocka_unit_test(test_bark_relief),
        cmocka_unit_test(test_bark_scale),
        cmocka_unit_test(test_miniature_bark),
        cmocka_unit_test(test_bark_kinds),
        cmocka_unit_test(test_old_bark_ends),
        cmocka_unit_test(test_roots_are_dull),
        cmocka_unit_test(test_birch_foot),
        cmocka_unit_test(test_gnarled_bark_is_of_all_ages),
        cmocka_unit_test(test_birch_has_no_rings),
        cmocka_unit_test(test_birches_differ),
        cmocka_unit_test(test_bumps_are_what_the_geometry_leaves_out),
        cmocka_unit_test(test_plates_slope),
        cmocka_unit_test(test_bark_without_branch),
        cmocka_unit_test(test_ground),
        cmocka_unit_test(test_leaf_veins),
        cmocka_unit_test(test_leaf_pale_veins),
        cmocka_unit_test(test_leaf_rays),
        cmocka_unit_test(test_leaf_spots),
        cmocka_unit_test(test_leaf_blotches_tint_light_that_passes),
        cmocka_unit_test(test_variation),
        cmocka_unit_test(test_stone),
        cmocka_unit_test(test_stone_moss),
        cmocka_unit_test(test_karst_is_fluted),
        cmocka_unit_test(test_runnels_follow_the_fall),
        cmocka_unit_test(test_clay_dries_to_pieces),
        cmocka_unit_test(test_contacts_are_sharp_and_ledges_end_at_them),
        cmocka_unit_test(test_moss_is_no_paint),
        cmocka_unit_test(test_masonry),
        cmocka_unit_test(test_dressed_stone),
        cmocka_unit_test(test_noise_pattern),
        cmocka_unit_test(test_noise_tints_light_that_passes_a_leaf),
        cmocka_unit_test(test_snow),
        cmocka_unit_test(test_sastrugi),
        cmocka_unit_test(test_ice),
        cmocka_unit_test(test_ice_is_dull_in_patches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
