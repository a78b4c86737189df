#include "objects/forest/stand_places.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <stdlib.h>

// Of a place of the lattice.
enum {
    STREAM_X = 1,
    STREAM_Z = 2,
    STREAM_TURN = 3,
    STREAM_DENSITY = 4,
    STREAM_CLUMPING = 5,
    STREAM_HEIGHT = 6,
    STREAM_STAND = 7
};

#define WOOD_WAVELENGTH 90.0f // m, from wood to wood where they clump

// Slope of the land along x and z at (x, z), by differences over h (m) to both sides.
static void land_slope(const Land *land, float x, float z, float h, float *dx, float *dz)
{
    *dx = (land_height(land, x + h, z) - land_height(land, x - h, z)) / (2.0f * h);
    *dz = (land_height(land, x, z + h) - land_height(land, x, z - h)) / (2.0f * h);
}

static bool is_free(const ForestParams *params, uint64_t seed, uint64_t key, float x, float z)
{
    float gx = x - params->glade_center.x, gz = z - params->glade_center.z;
    float cx = x - params->center.x, cz = z - params->center.z;
    float glade = params->glade > 0.0f ? params->glade + forest_stand_radius(params) : 0.0f;
    if (gx * gx + gz * gz < glade * glade || cx * cx + cz * cz > params->radius * params->radius ||
        random_unit(random_key(key, STREAM_DENSITY)) >= params->density) {
        return false;
    }
    float wood = noise_plane_fractal(cx / WOOD_WAVELENGTH, cz / WOOD_WAVELENGTH, 3, seed);
    return random_unit(random_key(key, STREAM_CLUMPING)) >= params->clumping || wood > 0.0f;
}

// Is there water within the stand's radius?
static bool is_wet(const ForestParams *params, const Surroundings *around, float x, float z)
{
    enum { AROUND = 8, RINGS = 3 };
    for (int i = 0; around->flood && i < AROUND * RINGS; i++) {
        float r = forest_stand_radius(params) * (float)(1 + i % RINGS) / RINGS, sine, cosine;
        exact_sincos(2.0f * PI_F * (float)i / (AROUND * RINGS), &sine, &cosine);
        float px = x + r * sine, pz = z + r * cosine;
        if (flood_covers(around->flood, vec3(px, land_height(&around->land, px, pz), pz))) {
            return true;
        }
    }
    return false;
}

static bool add_place(StandPlaces *places, Transform place, int stand, Error *e)
{
    if (!memory_reserve(&places->place, &places->place_capacity, places->count + 1,
                        sizeof *places->place, e) ||
        !memory_reserve(&places->stand, &places->stand_capacity, places->count + 1,
                        sizeof *places->stand, e)) {
        return false;
    }
    places->place[places->count] = place;
    places->stand[places->count++] = stand;
    return true;
}

// Places stands on a triangular lattice with a pitch of about the crowns' extent.
bool stand_places_init(StandPlaces *places, const ForestParams *params, uint64_t seed,
                       const Surroundings *around, const Run *run, Error *e)
{
    *places = (StandPlaces){0};
    float pitch = 1.86f * forest_stand_radius(params), row = 0.8660254f * pitch;
    int64_t rows = (int64_t)(params->radius / row) + 1;
    int64_t columns = (int64_t)(params->radius / pitch) + 1;
    float most_sine, least_cosine;
    exact_sincos(params->max_slope * RADIANS_PER_DEGREE, &most_sine, &least_cosine);
    bool done = true;
    for (int64_t j = -rows; done && j <= rows; j++) {
        for (int64_t i = -columns; done && i <= columns; i++) {
            if (!(done = run_goes_on(run, i + columns, e))) {
                break;
            }
            uint64_t key = random_key(random_key(seed, (uint64_t)j), (uint64_t)i);
            float x = params->center.x + pitch * ((float)i + (j & 1 ? 0.5f : 0.0f));
            float z = params->center.z + row * (float)j, sine, cosine;
            x += random_range(random_key(key, STREAM_X), -0.06f, 0.06f) * pitch;
            z += random_range(random_key(key, STREAM_Z), -0.06f, 0.06f) * pitch;
            float dx, dz;
            land_slope(&around->land, x, z, 0.5f * forest_stand_radius(params), &dx, &dz);
            if (!is_free(params, seed, key, x, z) ||
                1.0f / sqrtf(1.0f + dx * dx + dz * dz) < least_cosine ||
                is_wet(params, around, x, z)) {
                continue;
            }
            exact_sincos(random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F), &sine,
                         &cosine);
            float tall = random_range(random_key(key, STREAM_HEIGHT), 0.88f, 1.06f);
            // trunks stay vertical, their feet follow the slope
            Transform place =
                transform_from_axes(vec3(cosine, dx * cosine - dz * sine, -sine), vec3(0, tall, 0),
                                    vec3(sine, dx * sine + dz * cosine, cosine),
                                    vec3(x, land_height(&around->land, x, z), z));
            int stand = (int)(random_unit(random_key(key, STREAM_STAND)) * (float)params->stands);
            done = add_place(places, place, stand, e);
        }
    }
    if (!done) {
        stand_places_free(places);
    }
    return done;
}

void stand_places_free(StandPlaces *places)
{
    free(places->place);
    free(places->stand);
    *places = (StandPlaces){0};
}
