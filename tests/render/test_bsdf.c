// Energy, densities, reciprocity and sampling of every material.
#include "render/material/bsdf.h"

#include "base/random.h"
#include "render/material/bsdf_ggx.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct Case {
    const char *name;
    int number; // of its material in the set
    Material material;
    bool inside;
} Case;

enum { CASE_LIMIT = 64 };

static Material white(MaterialKind kind, float roughness)
{
    Material m = material_default(kind);
    m.color = vec3_splat(1.0f);
    m.roughness = roughness;
    m.transmittance = vec3_splat(0.0f);
    return m;
}

// Every kind over its roughness, white, so that all light must come back.
static int make_cases(Case *cases)
{
    static const float roughness[] = {0.04f, 0.15f, 0.3f, 0.5f, 0.75f, 1.0f};
    int n = 0;
    cases[n++] = (Case){"lambert", 0, white(MATERIAL_DIFFUSE, 0.0f), false};
    for (int i = 0; i < 6; i++) {
        float r = roughness[i];
        cases[n++] = (Case){"diffuse", 0, white(MATERIAL_DIFFUSE, r), false};
        cases[n++] = (Case){"conductor", 0, white(MATERIAL_CONDUCTOR, r), false};
        cases[n++] = (Case){"principled", 0, white(MATERIAL_PRINCIPLED, r), false};
        cases[n] = (Case){"metallic", 0, white(MATERIAL_PRINCIPLED, r), false};
        cases[n++].material.metallic = 0.7f;
        cases[n++] = (Case){"glass", 0, white(MATERIAL_DIELECTRIC, r), false};
        cases[n++] = (Case){"in glass", 0, white(MATERIAL_DIELECTRIC, r), true};
        cases[n] = (Case){"leaf", 0, white(MATERIAL_LEAF, r), false};
        cases[n].material.color = vec3_splat(0.6f);
        cases[n++].material.transmittance = vec3_splat(0.4f);
        cases[n] = cases[n - 1];
        cases[n].name = "under leaf";
        cases[n].material.transmittance = vec3_splat(0.9f); // more than there is
        cases[n++].inside = true;
    }
    return n;
}

// All cases and their materials, made once.
typedef struct Cases {
    int count;
    Case list[CASE_LIMIT];
    MaterialSet *set;
} Cases;

static int set_up(void **state)
{
    static Cases cases;
    Material materials[CASE_LIMIT];
    cases.count = make_cases(cases.list);
    for (int i = 0; i < cases.count; i++) {
        cases.list[i].number = i;
        materials[i] = cases.list[i].material;
    }
    cases.set = material_set_new(materials, NULL, cases.count, NULL, NULL);
    *state = &cases;
    return cases.set ? 0 : -1;
}

static int tear_down(void **state)
{
    material_set_free(((Cases *)*state)->set);
    return 0;
}

static SurfacePoint flat_point(bool inside)
{
    return (SurfacePoint){.geometric_normal = vec3(0, 0, 1),
                          .normal = vec3(0, 0, 1),
                          .tangent_u = vec3(1, 0, 0),
                          .tangent_v = vec3(0, 1, 0),
                          .backface = inside};
}

static SurfacePoint case_point(const Case *c)
{
    SurfacePoint point = flat_point(c->inside);
    point.material = c->number;
    return point;
}

static Vec3 at_cosine(float cosine, float turn)
{
    float s = sqrtf(1.0f - cosine * cosine);
    return vec3(s * cosf(2.0f * PI_F * turn), s * sinf(2.0f * PI_F * turn), cosine);
}

static Vec3 sphere_direction(uint64_t key)
{
    float z = 2.0f * random_unit(random_key(key, 0)) - 1.0f;
    return at_cosine(z, random_unit(random_key(key, 1)));
}

// Three numbers of a sequence with little gaps (Roberts' R3), so that few samples say much.
static void quasi(int i, float u[3])
{
    static const double step[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    for (int k = 0; k < 3; k++) {
        double x = 0.5 + step[k] * (double)(i + 1);
        u[k] = fminf((float)(x - floor(x)), 0.99999994f);
    }
}

// Mean weight of the samples: the directional albedo. error: its standard deviation, for
// independent samples.
static double furnace(const Bsdf *bsdf, Vec3 wo, int count, double *error)
{
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        float u[3];
        BsdfSample sample;
        quasi(i, u);
        if (bsdf_sample(bsdf, wo, u, &sample)) {
            assert_true(vec3_finite(sample.weight) && sample.weight.y >= 0.0f);
            sum += (double)sample.weight.y;
            squares += (double)sample.weight.y * (double)sample.weight.y;
        }
    }
    *error = sqrt(fmax(0.0, squares / count - sum / count * (sum / count)) / count);
    return sum / count;
}

static const float COSINES[] = {0.02f, 0.1f, 0.3f, 0.6f, 0.9f, 1.0f};

static void test_white_furnace(void **state)
{
    const Cases *all = *state;
    const Case *cases = all->list;
    for (int i = 0; i < all->count; i++) {
        const MaterialSet *set = all->set;
        SurfacePoint point = case_point(&cases[i]);
        for (int k = 0; k < 6; k++) {
            Vec3 wo = at_cosine(COSINES[k], 0.1f);
            Bsdf bsdf = bsdf_at(set, &point, wo);
            double error, albedo = furnace(&bsdf, wo, 8000, &error);
            if (fabs(albedo - 1.0) > 0.003 + 3.0 * error) {
                fail_msg("%s, roughness %g, cosine %g: albedo %.4f", cases[i].name,
                         (double)cases[i].material.roughness, (double)COSINES[k], albedo);
            }
        }
    }
}

// Veins in a blade and dead rims show on a leaf without a pattern, too.
static void a_plain_leaf_shows_what_is_painted_on_it(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    m.pattern = PATTERN_NONE;
    m.variation = 0.0f;
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    SurfacePoint point = flat_point(false);
    Bsdf plain = bsdf_at(set, &point, at_cosine(0.5f, 0.0f));
    assert_memory_equal(&plain.color, &m.color, sizeof m.color);
    point.young = 1.0f;
    Bsdf vein = bsdf_at(set, &point, at_cosine(0.5f, 0.0f));
    assert_true(vein.transmittance.y > 1.2f * plain.transmittance.y);
    point.young = 0.0f, point.withered = 0.7f; // brown
    Bsdf rim = bsdf_at(set, &point, at_cosine(0.5f, 0.0f));
    assert_true(rim.color.x > rim.color.y && rim.transmittance.y < 0.5f * plain.transmittance.y);
    material_set_free(set);
}

// Bubbles below a river's foam have the colour of its water: that of light which has come through
// 3 m of it.
static void bubbles_have_the_waters_colour(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_WATER);
    m.absorption = vec3(1.2f, 0.0f, 0.3f);
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    SurfacePoint point = flat_point(false);
    point.foam = 0.8f;
    Bsdf bsdf = bsdf_at(set, &point, at_cosine(0.5f, 0.0f));
    assert_true(bsdf.foam > 0.3f && bsdf.foam < 0.6f);
    assert_float_equal(bsdf.foam_color.x / bsdf.foam_color.y, expf(-3.6f), 1e-4f);
    assert_float_equal(bsdf.foam_color.z / bsdf.foam_color.y, expf(-0.9f), 1e-4f);
    material_set_free(set);
}

// Foam sends a share of what it scatters on through itself: the two sides add up to its colour, and
// the densities of its directions to 1.
static void foam_passes_light_on(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_WATER);
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    SurfacePoint point = flat_point(false);
    Vec3 wo = at_cosine(0.6f, 0.0f);
    Bsdf bsdf = bsdf_at(set, &point, wo);
    bsdf.foam = 1.0f;
    bsdf.foam_color = vec3_splat(0.8f);
    bsdf.foam_normal = bsdf.normal;
    bsdf.foam_through = 0.25f;
    bsdf.delta = false;
    bsdf.alpha = 0.1f;
    enum { SIDE = 200 };
    double light[2] = {0}, density = 0.0;
    for (int i = 0; i < SIDE; i++) {
        for (int k = 0; k < SIDE; k++) {
            float cosine = 2.0f * ((float)i + 0.5f) / SIDE - 1.0f;
            float pdf, angle = 6.2831853f * ((float)k + 0.5f) / SIDE;
            Vec3 f = bsdf_eval(&bsdf, wo, at_cosine(cosine, angle), &pdf);
            double area = 12.566370614 / (SIDE * SIDE);
            light[cosine < 0.0f] += (double)f.x * area;
            density += (double)pdf * area;
        }
    }
    assert_float_equal(light[0], 0.6, 0.002);
    assert_float_equal(light[1], 0.2, 0.002);
    assert_float_equal(density, 1.0, 0.002);
    material_set_free(set);
}

// Mirrors: the same with delta lobes.
static void test_mirrors(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Material m = white(k ? MATERIAL_DIELECTRIC : MATERIAL_CONDUCTOR, 0.0f);
        MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
        SurfacePoint point = flat_point(false);
        Vec3 wo = at_cosine(0.5f, 0.0f), seen = vec3_splat(0.0f);
        Bsdf bsdf = bsdf_at(set, &point, wo);
        int transmitted = 0;
        for (int i = 0; i < 4000; i++) {
            float u[3];
            BsdfSample s;
            quasi(i, u);
            assert_true(bsdf_sample(&bsdf, wo, u, &s));
            assert_true(s.delta && s.pdf == 0.0f);
            assert_float_equal(s.weight.x, 1.0f, 1e-6f);
            seen = s.transmitted ? seen : s.wi;
            transmitted += s.transmitted;
            float pdf;
            assert_float_equal(bsdf_eval(&bsdf, wo, s.wi, &pdf).x, 0.0f, 0.0f);
            assert_float_equal(pdf, 0.0f, 0.0f);
            if (s.transmitted) { // Snell
                assert_float_equal(sqrtf(1.0f - s.wi.z * s.wi.z) * 1.5f, sqrtf(0.75f), 1e-5f);
            }
        }
        assert_float_equal(seen.x, -wo.x, 1e-6f);
        assert_float_equal(seen.z, wo.z, 1e-6f);
        // Fresnel at 60 degrees into glass: 8.92 %
        assert_float_equal((float)transmitted / 4000.0f, k ? 0.9108f : 0.0f, 0.002f);
        material_set_free(set);
    }
}

// The density over the whole sphere by midpoint rule; what samples lose makes up the rest.
static double density_integral(const Bsdf *bsdf, Vec3 wo, double *kept)
{
    const int rows = 600, columns = 600;
    double sum = 0.0, value = 0.0;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            float z = -1.0f + 2.0f * ((float)i + 0.5f) / (float)rows, pdf;
            Vec3 wi = at_cosine(z, ((float)j + 0.5f) / (float)columns);
            value += (double)bsdf_eval(bsdf, wo, wi, &pdf).y;
            sum += (double)pdf;
        }
    }
    double cell = 4.0 * (double)PI_F / (rows * columns);
    *kept = value * cell;
    return sum * cell;
}

static void test_densities(void **state)
{
    const Cases *all = *state;
    const Case *cases = all->list;
    for (int i = 0; i < all->count; i++) {
        if (cases[i].material.roughness > 0.0f && cases[i].material.roughness < 0.25f) {
            continue; // too narrow for the grid
        }
        const MaterialSet *set = all->set;
        SurfacePoint point = case_point(&cases[i]);
        Vec3 wo = at_cosine(0.6f, 0.3f);
        Bsdf bsdf = bsdf_at(set, &point, wo);
        int drawn = 0;
        for (int k = 0; k < 4000; k++) {
            float u[3];
            BsdfSample sample;
            quasi(k, u);
            drawn += bsdf_sample(&bsdf, wo, u, &sample);
        }
        double error, kept, integral = density_integral(&bsdf, wo, &kept);
        if (fabs(integral - drawn / 4000.0) > 0.01) {
            fail_msg("%s, roughness %g: density sums to %.4f, %.4f were drawn", cases[i].name,
                     (double)cases[i].material.roughness, integral, drawn / 4000.0);
        }
        assert_float_equal((float)kept, (float)furnace(&bsdf, wo, 8000, &error), 0.01f);
    }
}

// The weight of a sample is eval over density at that direction.
static void test_weights_agree(void **state)
{
    const Cases *all = *state;
    const Case *cases = all->list;
    for (int i = 0; i < all->count; i++) {
        const MaterialSet *set = all->set;
        SurfacePoint point = case_point(&cases[i]);
        Vec3 wo = at_cosine(0.4f, 0.7f);
        point.normal = vec3_normalize(vec3(0.5f, -0.2f, 1.0f));
        Bsdf bsdf = bsdf_at(set, &point, wo);
        for (int k = 0; k < 500; k++) {
            float u[3], pdf;
            BsdfSample s;
            quasi(k, u);
            if (!bsdf_sample(&bsdf, wo, u, &s)) {
                continue;
            }
            Vec3 f = bsdf_eval(&bsdf, wo, s.wi, &pdf);
            assert_true(s.transmitted == (s.wi.z < 0.0f));
            assert_float_equal(vec3_length(s.wi), 1.0f, 1e-4f);
            assert_float_equal(pdf / s.pdf, 1.0f, 1e-3f);
            assert_float_equal(f.y / pdf, s.weight.y, 2e-3f * (1.0f + s.weight.y));
        }
    }
}

enum { ROWS = 8, COLUMNS = 12, CELLS = 2 * ROWS * COLUMNS, DRAWS = 40000 };

static int cell_of(Vec3 d)
{
    int row = (int)(0.5f * (1.0f + d.z) * (2.0f * ROWS)), column;
    float turn = atan2f(d.y, d.x) / (2.0f * PI_F);
    column = (int)((turn < 0.0f ? turn + 1.0f : turn) * COLUMNS);
    row = row < 2 * ROWS ? row : 2 * ROWS - 1;
    return row * COLUMNS + (column < COLUMNS ? column : COLUMNS - 1);
}

static void expect_cells(const Bsdf *bsdf, Vec3 wo, double *expected)
{
    const int fine = 40;
    for (int cell = 0; cell < CELLS; cell++) {
        double sum = 0.0;
        for (int k = 0; k < fine * fine; k++) {
            float z = ((float)(cell / COLUMNS) + ((float)(k / fine) + 0.5f) / (float)fine) / ROWS;
            float turn = ((float)(cell % COLUMNS) + ((float)(k % fine) + 0.5f) / (float)fine);
            float pdf;
            bsdf_eval(bsdf, wo, at_cosine(z - 1.0f, turn / COLUMNS), &pdf);
            sum += (double)pdf;
        }
        expected[cell] = sum / (fine * fine) * 4.0 * (double)PI_F / CELLS * DRAWS;
    }
}

// Chi-squared of the drawn directions against the density, also with a tilted shading normal, where
// lobes fold over the horizon.
static void chi_squared(const MaterialSet *set, const Case *c, bool tilted)
{
    SurfacePoint point = case_point(c);
    Vec3 wo = at_cosine(0.5f, 0.2f);
    if (tilted) {
        point.normal = vec3_normalize(vec3(0.6f, 0.3f, 1.0f));
    }
    Bsdf bsdf = bsdf_at(set, &point, wo);
    double expected[CELLS];
    int seen[CELLS] = {0};
    expect_cells(&bsdf, wo, expected);
    for (int i = 0; i < DRAWS; i++) {
        uint64_t key = random_key(7, (uint64_t)i);
        float u[3] = {random_unit(random_key(key, 0)), random_unit(random_key(key, 1)),
                      random_unit(random_key(key, 2))};
        BsdfSample sample;
        if (bsdf_sample(&bsdf, wo, u, &sample)) {
            seen[cell_of(sample.wi)]++;
        }
    }
    double statistic = 0.0, rest_expected = 0.0, rest_seen = 0.0;
    int degrees = 0;
    for (int i = 0; i < CELLS; i++) {
        if (expected[i] < 8.0) {
            rest_expected += expected[i];
            rest_seen += seen[i];
            continue;
        }
        statistic += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
        degrees++;
    }
    statistic += rest_expected > 8.0
                     ? (rest_seen - rest_expected) * (rest_seen - rest_expected) / rest_expected
                     : 0.0;
    // 5 sigma of the Wilson-Hilferty normal
    double cube = cbrt(statistic / degrees), variance = 2.0 / (9.0 * degrees);
    double sigma = (cube - (1.0 - variance)) / sqrt(variance);
    if (sigma > 5.0) {
        fail_msg("%s, roughness %g%s: chi-squared %.1f over %d cells", c->name,
                 (double)c->material.roughness, tilted ? ", tilted" : "", statistic, degrees);
    }
}

static void test_histograms(void **state)
{
    const Cases *all = *state;
    const Case *cases = all->list;
    for (int i = 0; i < all->count; i++) {
        float r = cases[i].material.roughness;
        if (r <= 0.0f || (r > 0.4f && r < 0.7f)) {
            chi_squared(all->set, &cases[i], false);
            chi_squared(all->set, &cases[i], true);
        }
    }
}

// f(a, b) = f(b, a) for reflection; between the two sides f / index^2 is what is symmetric.
static void test_reciprocity(void **state)
{
    const Cases *all = *state;
    const Case *cases = all->list;
    for (int i = 0; i < all->count; i++) {
        const MaterialSet *set = all->set;
        SurfacePoint point = case_point(&cases[i]);
        for (uint64_t k = 0; k < 200; k++) {
            Vec3 a = sphere_direction(random_key(1, k)), b = sphere_direction(random_key(2, k));
            a.z = fabsf(a.z);
            b.z = fabsf(b.z);
            if (a.z < 0.01f || b.z < 0.01f) {
                continue;
            }
            Bsdf at_a = bsdf_at(set, &point, a), at_b = bsdf_at(set, &point, b);
            float pdf;
            float ab = bsdf_eval(&at_a, a, b, &pdf).y / b.z;
            float ba = bsdf_eval(&at_b, b, a, &pdf).y / a.z;
            if (fabsf(ab - ba) > 2e-3f * (ab + ba) + 5e-5f) {
                fail_msg("%s, roughness %g: %g one way, %g the other", cases[i].name,
                         (double)cases[i].material.roughness, (double)ab, (double)ba);
            }
        }
    }
}

static void test_transmission_reciprocity(void **state)
{
    (void)state;
    Material m = white(MATERIAL_DIELECTRIC, 0.7f);
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    SurfacePoint outside = flat_point(false), inside = flat_point(true);
    inside.normal = inside.geometric_normal = vec3(0, 0, -1);
    for (uint64_t k = 0; k < 200; k++) {
        Vec3 a = sphere_direction(random_key(3, k)), b = sphere_direction(random_key(4, k));
        a.z = fmaxf(fabsf(a.z), 0.02f);
        b.z = -fmaxf(fabsf(b.z), 0.02f);
        a = vec3_normalize(a);
        b = vec3_normalize(b);
        Bsdf at_a = bsdf_at(set, &outside, a), at_b = bsdf_at(set, &inside, b);
        float pdf;
        float ab = bsdf_eval(&at_a, a, b, &pdf).y / -b.z / (1.5f * 1.5f);
        float ba = bsdf_eval(&at_b, b, a, &pdf).y / a.z;
        assert_true(fabsf(ab - ba) <= 5e-3f * (ab + ba) + 1e-6f);
    }
    material_set_free(set);
}

// Bumps never darken or leak: with any shading normal the furnace stays white, and an opaque
// material never sends light below the surface.
static void test_bumped_furnace(void **state)
{
    const Cases *all = *state;
    const Case *cases = all->list;
    for (int i = 0; i < all->count; i++) {
        const MaterialSet *set = all->set;
        bool opaque = cases[i].material.kind != MATERIAL_LEAF &&
                      cases[i].material.kind != MATERIAL_DIELECTRIC;
        for (int k = 0; k < 4; k++) {
            SurfacePoint point = case_point(&cases[i]);
            point.normal = vec3_normalize(vec3(0.4f * (float)k, -0.3f, 1.0f));
            Vec3 wo = at_cosine(0.15f, 0.5f); // away from the tilt: beyond its horizon at k = 3
            Bsdf bsdf = bsdf_at(set, &point, wo);
            assert_true(vec3_dot(bsdf.normal, wo) > 0.0f);
            double error, albedo = furnace(&bsdf, wo, 4000, &error);
            if (fabs(albedo - 1.0) > 0.01 + 3.0 * error) {
                fail_msg("%s, roughness %g, tilt %d: albedo %.4f", cases[i].name,
                         (double)cases[i].material.roughness, k, albedo);
            }
            float pdf;
            Vec3 below = bsdf_eval(&bsdf, wo, vec3(0.6f, 0.0f, -0.8f), &pdf);
            assert_true(!opaque || (below.y == 0.0f && pdf == 0.0f));
        }
    }
}

static void test_leaf_sides(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_LEAF);
    MaterialSet *set = material_set_new(&m, NULL, 1, NULL, NULL);
    SurfacePoint above = flat_point(false), below = flat_point(true);
    Vec3 wo = at_cosine(0.8f, 0.0f);
    Bsdf upper = bsdf_at(set, &above, wo), under = bsdf_at(set, &below, wo);
    assert_true(under.color.x > upper.color.x && under.color.z > upper.color.z);
    assert_true(upper.albedo.y < 1.0f && under.albedo.y < 1.0f);
    float pdf;
    Vec3 through = bsdf_eval(&upper, wo, vec3(0, 0, -1), &pdf);
    assert_true(through.y > through.x && through.x > through.z && pdf > 0.0f);
    material_set_free(set);
}

// A colour of its own shows from below alone.
static void test_leaf_underside(void **state)
{
    (void)state;
    Material m[2] = {material_default(MATERIAL_LEAF), material_default(MATERIAL_LEAF)};
    m[1].underside_color = vec3(0.3f, 0.05f, 0.04f);
    MaterialSet *set = material_set_new(m, NULL, 2, NULL, NULL);
    SurfacePoint above = flat_point(false), below = flat_point(true);
    Vec3 wo = at_cosine(0.8f, 0.0f);
    Bsdf plain = bsdf_at(set, &above, wo);
    above.material = below.material = 1;
    Bsdf upper = bsdf_at(set, &above, wo), under = bsdf_at(set, &below, wo);
    assert_memory_equal(&upper.color, &plain.color, sizeof plain.color);
    assert_float_equal(under.color.x, 0.3f, 1e-6f);
    assert_float_equal(under.color.y, 0.05f, 1e-6f);
    material_set_free(set);
}

static void test_emission_and_glass_body(void **state)
{
    (void)state;
    Material m[2] = {material_default(MATERIAL_EMISSION), material_default(MATERIAL_DIELECTRIC)};
    m[0].radiance = vec3(3, 2, 1);
    m[1].absorption = vec3(0.1f, 0.2f, 0.3f);
    MaterialSet *set = material_set_new(m, NULL, 2, NULL, NULL);
    SurfacePoint point = flat_point(false);
    Vec3 wo = vec3(0, 0, 1);
    Bsdf lamp = bsdf_at(set, &point, wo);
    float u[3] = {0.3f, 0.4f, 0.5f};
    BsdfSample sample;
    assert_true(bsdf_is_emissive(&lamp) && lamp.emission.x == 3.0f);
    assert_false(bsdf_sample(&lamp, wo, u, &sample));
    point.material = 1;
    assert_float_equal(bsdf_at(set, &point, wo).absorption.y, 0.0f, 0.0f);
    point.backface = true;
    Bsdf inside = bsdf_at(set, &point, wo);
    assert_float_equal(inside.absorption.y, 0.2f, 0.0f);
    assert_float_equal(inside.eta, 1.0f / 1.5f, 1e-6f);
    assert_float_equal(material_opacity(set, 1, (Vec2){0.5f, 0.5f}), 1.0f, 0.0f);
    material_set_free(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_white_furnace),
        cmocka_unit_test(a_plain_leaf_shows_what_is_painted_on_it),
        cmocka_unit_test(bubbles_have_the_waters_colour),
        cmocka_unit_test(foam_passes_light_on),
        cmocka_unit_test(test_mirrors),
        cmocka_unit_test(test_densities),
        cmocka_unit_test(test_weights_agree),
        cmocka_unit_test(test_histograms),
        cmocka_unit_test(test_reciprocity),
        cmocka_unit_test(test_transmission_reciprocity),
        cmocka_unit_test(test_bumped_furnace),
        cmocka_unit_test(test_leaf_sides),
        cmocka_unit_test(test_leaf_underside),
        cmocka_unit_test(test_emission_and_glass_body),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
