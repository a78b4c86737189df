// Measures of a volcano's cone and crater, for targets.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/terrain/volcano.h"

#include <math.h>
#include <stdlib.h>

enum { RAYS = 128, RAY_SAMPLES = 40 };

typedef struct Cone {
    const Landscape *land;
    double x, z, rim, fall; // m
} Cone;

static double height_at(const Cone *c, int ray, double r)
{
    double sine, cosine, loose;
    exact_sincos_double(6.283185307179586 * ray / RAYS, &sine, &cosine);
    return landscape_at(c->land, c->x + r * cosine, c->z + r * sine, &loose);
}

static double ring(const Cone *c, double r)
{
    double sum = 0.0;
    for (int k = 0; k < RAYS; k++) {
        sum += height_at(c, k, r);
    }
    return sum / RAYS;
}

// Degrees, from ring to ring.
static double slope(const Cone *c, double from, double to)
{
    double gradient = (ring(c, from) - ring(c, to)) / (to - from);
    return (double)exact_atan2((float)gradient, 1.0f) * 57.29577951308232;
}

typedef struct Crater {
    double width; // m: mean diameter of the rim
    double depth; // m: of the floor below the mean rim
    double sill;  // height of the rim's lowest point above the floor, share of the depth
} Crater;

// The rim is the highest point of each ray out to twice its given radius.
static Crater find_crater(const Cone *c)
{
    double floor = ring(c, 0.15 * c->rim), lowest = INFINITY, sum = 0.0, radii = 0.0;
    for (int k = 0; k < RAYS; k++) {
        double high = -INFINITY, at = 0.0;
        for (int j = 0; j <= RAY_SAMPLES; j++) {
            double r = 1.6 * c->rim * j / RAY_SAMPLES, h = height_at(c, k, r);
            at = h > high ? r : at;
            high = h > high ? h : high;
        }
        lowest = high < lowest ? high : lowest;
        sum += high / RAYS;
        radii += at / RAYS;
    }
    return (Crater){2.0 * radii, sum - floor, (lowest - floor) / (sum - floor)};
}

bool terrain_measure_volcano(const Terrain *terrain, MeasureList *list, Error *e)
{
    TerrainParams params = terrain_params_resolve(terrain->params);
    const VolcanoParams *v = &params.volcano;
    Cone cone = {.land = terrain->evolved,
                 .x = (double)(v->at[0] * params.size),
                 .z = (double)(v->at[1] * params.size),
                 .rim = 0.5 * (double)v->crater,
                 .fall = volcano_fall(&params)};
    Crater crater = find_crater(&cone);
    double upper = 1.5 * cone.rim, nan = (double)NAN;
    int64_t count = height_field_count(terrain->ground), lava = 0;
    for (int64_t i = 0; i < count; i++) {
        lava += terrain->ground->height[i] > 0.02f;
    }
    // Means about the cone; slopes of stratovolcanoes after Karatson et al. 2010.
    return measures_add(list, "summit_slope", slope(&cone, upper, upper + 0.3 * cone.fall),
                        "degrees", 25, 35, e) &&
           measures_add(list, "flank_slope", slope(&cone, cone.fall, 1.3 * cone.fall), "degrees", 8,
                        18, e) &&
           measures_add(list, "foot_slope", slope(&cone, 2.0 * cone.fall, 2.4 * cone.fall),
                        "degrees", 1.5, 7, e) &&
           measures_add(list, "crater_width", crater.width, "m", nan, nan, e) &&
           measures_add(list, "crater_depth", crater.depth, "m", nan, nan, e) &&
           measures_add(list, "rim_sill", crater.sill, "", nan, nan, e) &&
           measures_add(list, "lava_share", (double)lava / (double)count, "", nan, nan, e);
}
