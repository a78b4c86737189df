#include "render/material/thin_film.h"

#include "base/memory.h"
#include "render/sky/atmosphere.h"

#include <math.h>
#include <stdlib.h>

// Nodes by optical path n d cos(t) and by the square root of one side's reflectance: along both the
// colour is smooth, and it depends on nothing else.
enum { PATHS = 1001, SIDES = 33, WAVELENGTHS = 81 };

static const double PATH_STEP = 4.0; // nm

struct ThinFilmTable {
    Vec3 color[PATHS][SIDES];
};

// One side's reflectances for light polarised across and in the plane of incidence; *inner gets the
// cosine within the film.
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

// What both sides together mirror of one wavelength, all inner reflections summed (Airy): side is
// one side's reflectance, half_phase = 2 pi n d cos(t) / wavelength.
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
