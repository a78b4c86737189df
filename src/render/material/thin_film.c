#include "render/material/thin_film.h"

#include "base/color.h"
#include "base/memory.h"
#include "render/material/material_ops.h"
#include "render/material/pattern_noise.h"
#include "render/sky/atmosphere.h"

#include <math.h>
#include <stdlib.h>

// Nodes by optical path n d cos(t) and by the square root of one side's reflectance: the colour
// depends on these two alone and is smooth in both.
enum { PATHS = 1001, SIDES = 33, WAVELENGTHS = 81 };

static const double PATH_STEP = 4.0; // nm

struct ThinFilmTable {
    Vec3 color[PATHS][SIDES];
};

// Reflectances of one side for light polarised across and in the plane of incidence; *inner: the
// cosine inside the film.
static void side_reflectances(double ior, double cosine, double *across, double *in_plane,
                              double *inner)
{
    double sine = sqrt(fmax(0.0, 1.0 - cosine * cosine)) / ior;
    *inner = sqrt(fmax(0.0, 1.0 - sine * sine));
    double s = (cosine - ior * *inner) / (cosine + ior * *inner);
    double p = (ior * cosine - *inner) / (ior * cosine + *inner);
    *across = s * s;
    *in_plane = p * p;
}

// Reflectance of both sides at one wavelength, all inner reflections summed (Airy). side:
// reflectance of one side; half_phase = 2 pi n d cos(t) / wavelength.
static double airy(double side, double half_phase_sine2)
{
    double finesse = 4.0 * side / fmax((1.0 - side) * (1.0 - side), 1e-12);
    double f = finesse * half_phase_sine2;
    return f / (1.0 + f);
}

float thin_film_mean(float ior, float cosine)
{
    double across, in_plane, inner;
    side_reflectances((double)ior, (double)cosine, &across, &in_plane, &inner);
    // the mean of f / (1 + f) over all phases is 1 - 1 / sqrt(1 + finesse) = 2 r / (1 + r)
    return (float)(across / (1.0 + across) + in_plane / (1.0 + in_plane));
}

static Vec3 table_color(double path, double side, double weight[][3], const double total[3])
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < WAVELENGTHS; i++) {
        double sine = sin(2.0 * M_PI * path / (380.0 + 5.0 * i));
        double reflectance = airy(side, sine * sine);
        for (int c = 0; c < 3; c++) {
            sum[c] += weight[i][c] * reflectance;
        }
    }
    return vec3(clampf((float)(sum[0] / total[0]), 0.0f, 1.0f),
                clampf((float)(sum[1] / total[1]), 0.0f, 1.0f),
                clampf((float)(sum[2] / total[2]), 0.0f, 1.0f));
}

ThinFilmTable *thin_film_table_new(Error *e)
{
    ThinFilmTable *table = memory_alloc(1, sizeof *table, e);
    double weight[WAVELENGTHS][3], total[3] = {0.0, 0.0, 0.0};
    if (!table) {
        return NULL;
    }
    for (int i = 0; i < WAVELENGTHS; i++) {
        wavelength_to_rgb(380.0 + 5.0 * i, weight[i]);
        for (int c = 0; c < 3; c++) {
            total[c] += weight[i][c];
        }
    }
    for (int i = 0; i < PATHS; i++) {
        for (int j = 0; j < SIDES; j++) {
            double root = (double)j / (SIDES - 1);
            table->color[i][j] = table_color(PATH_STEP * i, root * root, weight, total);
        }
    }
    return table;
}

void thin_film_table_free(ThinFilmTable *table)
{
    free(table);
}

static Vec3 look_up(const ThinFilmTable *table, double path, double side)
{
    float x = clampf((float)(path / PATH_STEP), 0.0f, PATHS - 1.001f);
    float y = clampf((float)sqrt(side) * (SIDES - 1), 0.0f, SIDES - 1.001f);
    int i = (int)x, j = (int)y;
    float s = x - (float)i, t = y - (float)j;
    Vec3 low = vec3_lerp(table->color[i][j], table->color[i + 1][j], s);
    Vec3 high = vec3_lerp(table->color[i][j + 1], table->color[i + 1][j + 1], s);
    return vec3_lerp(low, high, t);
}

Vec3 thin_film_color(const ThinFilmTable *table, float thickness, float ior, float cosine)
{
    double across, in_plane, inner;
    side_reflectances((double)ior, (double)cosine, &across, &in_plane, &inner);
    double path = (double)ior * (double)thickness * inner;
    return vec3_scale(vec3_add(look_up(table, path, across), look_up(table, path, in_plane)), 0.5f);
}

// ---- the material: light is mirrored in interference colours or goes straight on; nothing is lost

// The film is thinner above, where it has drained, and thicker below, with streaks that swirl
// around each other.
static float thickness_at(const Material *m, const SurfacePoint *point)
{
    float up = point->backface ? -point->normal.y : point->normal.y; // as the mesh has it
    float drained = 1.0f - 0.75f * m->film_drainage * up;
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.02f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale);
    Vec3 flow =
        vec3(noise_fractal(p, 3, 31), 0.5f * noise_fractal(p, 3, 32), noise_fractal(p, 3, 33));
    Vec3 q = vec3_madd(vec3(p.x, 2.2f * p.y, p.z), 1.6f, flow);
    float swirl = noise_fractal(q, 4, 34);
    float thickness = m->film_thickness * drained * (1.0f + 0.8f * m->film_swirl * swirl);
    return clampf(thickness, 0.0f, THIN_FILM_MOST_NM);
}

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    const Material *m = &entry->material;
    b->delta = true;
    b->specular = thin_film_color(entry->films, thickness_at(m, point), m->ior, cos_o);
    Vec3 passed = vec3_sub(vec3_splat(1.0f), b->specular);
    b->transmittance = vec3_mul(b->color, passed);
    float r = sqrtf(luminance(b->specular)), t = sqrtf(luminance(passed));
    b->probability = r / (r + t); // least noise if both sides are about equally bright
    b->albedo = vec3_splat(1.0f);
}

static bool sample_delta(const Bsdf *b, Vec3 wo, const float u[3], BsdfSample *sample)
{
    sample->transmitted = u[2] >= b->probability;
    if (sample->transmitted) {
        sample->wi = vec3_neg(wo);
        sample->weight = vec3_scale(b->transmittance, 1.0f / (1.0f - b->probability));
    } else {
        sample->wi = vec3_sub(vec3_scale(b->normal, 2.0f * vec3_dot(b->normal, wo)), wo);
        sample->weight = vec3_scale(b->specular, 1.0f / b->probability);
    }
    return true;
}

static bool tabulate(MaterialEntry *entry, MaterialSet *set, Error *e)
{
    set->films = set->films ? set->films : thin_film_table_new(e);
    entry->films = set->films;
    return entry->films != NULL;
}

static float shadow_opacity(const Material *m, float cosine)
{
    return thin_film_mean(m->ior, cosine);
}

static void describe(const Material *m, Appearance *a)
{
    a->roughness = 0.0f;
    a->ior = m->ior;
    a->film_thickness = m->film_thickness;
    a->film_variation = fmaxf(m->film_swirl, m->film_drainage);
}

static void defaults(Material *m) // soapy water
{
    m->color = vec3_splat(1.0f);
    m->ior = 1.33f;
    m->film_thickness = 480.0f;
    m->film_drainage = 0.6f;
    m->film_swirl = 0.35f;
}

const MaterialOps thin_film_ops = {.traits = TRAIT_THIN,
                                   .defaults = defaults,
                                   .describe = describe,
                                   .tabulate = tabulate,
                                   .prepare = prepare,
                                   .sample_delta = sample_delta,
                                   .shadow_opacity = shadow_opacity};
