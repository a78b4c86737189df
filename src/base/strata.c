#include "base/strata.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float DEGREE = 0.017453292f;

float strata_stable_slope(float hardness)
{
    return 32.0f + 48.0f * smoothstepf(0.2f, 0.75f, hardness);
}

static float tangent(float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * DEGREE, &sine, &cosine);
    return sine / cosine;
}

// The unit vector in plan toward an azimuth: north is -z, east +x.
static Vec2 toward(float azimuth)
{
    float sine, cosine;
    exact_sincos(azimuth * DEGREE, &sine, &cosine);
    return (Vec2){sine, -cosine};
}

static void stack_beds(Strata *strata, const StrataParams *params)
{
    float level = 0.0f;
    for (int i = 0; i < params->bed_count; i++) {
        StrataBed *bed = &strata->bed[i];
        *bed = params->beds[i];
        bed->slope = bed->slope > 0.0f ? bed->slope : strata_stable_slope(bed->hardness);
        strata->steepness[i] = tangent(bed->slope);
        strata->run[i + 1] = strata->run[i] - (double)bed->thickness / (double)strata->steepness[i];
        level -= bed->thickness;
        strata->floor[i] = level;
    }
    strata->bed_count = params->bed_count;
    strata->floor[params->bed_count - 1] = -INFINITY;
}

static void lay_faults(Strata *strata, const StrataParams *params, float size)
{
    for (int i = 0; i < params->fault_count; i++) {
        const StrataFault *fault = &params->faults[i];
        Vec2 right = toward(fault->azimuth + 90.0f);
        strata->fault[i] = (StrataLine){.x = fault->at[0] * size,
                                        .z = fault->at[1] * size,
                                        .right_x = right.x,
                                        .right_z = right.y,
                                        .drop = fault->drop};
    }
    strata->fault_count = params->fault_count;
}

static Vec3 mean_color(const StrataParams *params)
{
    Vec3 sum = {0};
    float thickness = 0.0f;
    for (int i = 0; i < params->bed_count; i++) {
        sum = vec3_madd(sum, params->beds[i].thickness, params->beds[i].color);
        thickness += params->beds[i].thickness;
    }
    return vec3_scale(sum, 1.0f / thickness);
}

Strata *strata_new(const StrataParams *params, Vec3 origin, float size, Error *e)
{
    if (params->bed_count < 1 || params->bed_count > STRATA_MOST_BEDS ||
        params->fault_count > STRATA_MOST_FAULTS) {
        error_set(e, ERROR_INPUT, "%d beds and %d faults; 1 to %d beds and up to %d are possible",
                  params->bed_count, params->fault_count, STRATA_MOST_BEDS, STRATA_MOST_FAULTS);
        return NULL;
    }
    Strata *strata = memory_alloc_zero(1, sizeof *strata, e);
    if (!strata) {
        return NULL;
    }
    strata->origin = origin;
    strata->mean_color = mean_color(params);
    stack_beds(strata, params);
    lay_faults(strata, params, size);
    Vec2 down = toward(params->dip_azimuth);
    float fall = tangent(params->dip);
    strata->fall_x = down.x * fall;
    strata->fall_z = down.y * fall;
    if (params->folds.wavelength > 0.0f) {
        Vec2 across = toward(params->folds.azimuth);
        float wave = 6.2831853f / params->folds.wavelength;
        strata->fold_x = across.x * wave;
        strata->fold_z = across.y * wave;
        strata->fold_height = params->folds.amplitude;
    }
    return strata;
}

Strata *strata_copy(const Strata *strata, Error *e)
{
    Strata *copy = memory_alloc(1, sizeof *copy, e);
    if (copy) {
        *copy = *strata;
    }
    return copy;
}

void strata_free(Strata *strata)
{
    free(strata);
}

float strata_base(const Strata *strata, float x, float z)
{
    x -= strata->origin.x;
    z -= strata->origin.z;
    float base = strata->origin.y - strata->fall_x * x - strata->fall_z * z;
    if (strata->fold_height != 0.0f) {
        float sine, cosine;
        exact_sincos(strata->fold_x * x + strata->fold_z * z, &sine, &cosine);
        base += strata->fold_height * sine;
    }
    for (int i = 0; i < strata->fault_count; i++) {
        const StrataLine *fault = &strata->fault[i];
        float right = (x - fault->x) * fault->right_x + (z - fault->z) * fault->right_z;
        base -= right > 0.0f ? fault->drop : 0.0f;
    }
    return base;
}

int strata_bed(const Strata *strata, float level)
{
    int low = 0, high = strata->bed_count - 1; // the first bed whose floor is at or below level
    while (low < high) {
        int middle = (low + high) / 2;
        if (strata->floor[middle] <= level) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

double strata_run(const Strata *strata, double level)
{
    int bed = strata_bed(strata, (float)level);
    double upper = bed > 0 ? (double)strata->floor[bed - 1] : 0.0;
    return strata->run[bed] + (level - upper) / (double)strata->steepness[bed];
}

double strata_level(const Strata *strata, double run)
{
    int low = 0, high = strata->bed_count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (strata->run[middle + 1] <= run) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    double upper = low > 0 ? (double)strata->floor[low - 1] : 0.0;
    return upper + (run - strata->run[low]) * (double)strata->steepness[low];
}
