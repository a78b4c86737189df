#include "objects/forest/tree_places.h"

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
    STREAM_SIZE = 5,
    STREAM_SPECIES = 6,
    STREAM_INDIVIDUAL = 7
};

enum { PROBES = 8, EDGE_PROBES = 2, OPEN_PROBES = 6 }; // open land in so many directions
#define PROBE 1.7f                                     // of the spacing
#define JITTER 0.3f                                    // of the spacing
#define WOOD_WAVELENGTH 90.0f                          // m, from wood to wood where they clump
#define SUNK 0.08f                                     // m, so that no foot hangs over a slope

typedef struct Wood {
    const ForestParams *forest;
    const Individuals *all;
    const Surroundings *around;
    uint64_t seed;
    float spacing, least_cosine;
} Wood;

static bool within(Vec3 center, float radius, float x, float z)
{
    float dx = x - center.x, dz = z - center.z;
    return dx * dx + dz * dz < radius * radius;
}

static bool is_steep(const Wood *wood, float x, float z)
{
    const Land *land = &wood->around->land;
    float h = 0.5f * wood->spacing;
    float dx = (land_height(land, x + h, z) - land_height(land, x - h, z)) / (2.0f * h);
    float dz = (land_height(land, x, z + h) - land_height(land, x, z - h)) / (2.0f * h);
    return 1.0f / sqrtf(1.0f + dx * dx + dz * dz) < wood->least_cosine;
}

static bool is_wooded(const Wood *wood, float x, float z)
{
    const ForestParams *forest = wood->forest;
    if (within(forest->glade_center, forest->glade, x, z) ||
        !within(forest->center, forest->radius, x, z)) {
        return false;
    }
    float noise = noise_plane_fractal((x - forest->center.x) / WOOD_WAVELENGTH,
                                      (z - forest->center.z) / WOOD_WAVELENGTH, 3, wood->seed);
    Vec3 foot = vec3(x, land_height(&wood->around->land, x, z), z);
    return noise >= forest->clumping - 1.0f && !is_steep(wood, x, z) &&
           !flood_covers(wood->around->flood, foot);
}

// In how many directions the land is open, and the mean of these.
static int find_open(const Wood *wood, float x, float z, Vec3 *toward)
{
    int open = 0;
    *toward = vec3(0, 0, 0);
    for (int i = 0; i < PROBES; i++) {
        float sine, cosine, reach = PROBE * wood->spacing;
        exact_sincos(2.0f * PI_F * (float)i / PROBES, &sine, &cosine);
        if (!is_wooded(wood, x + reach * sine, z + reach * cosine)) {
            *toward = vec3_add(*toward, vec3(sine, 0, cosine));
            open++;
        }
    }
    return open;
}

// One of the individuals of this situation and species, or of this species alone.
static int choose(const Wood *wood, Situation situation, uint64_t key)
{
    const Individuals *all = wood->all;
    int species = tree_mix_choose(wood->forest->species, wood->forest->species_count,
                                  random_unit(random_key(key, STREAM_SPECIES)));
    for (int any = 0; any < 2; any++) {
        int count = 0;
        for (int pass = 0, chosen = 0; pass < 2; pass++) {
            int number = 0;
            for (int i = 0; i < all->count; i++) {
                const Individual *one = &all->one[i];
                if (!one->kept || one->species != species ||
                    (!any && one->situation != situation)) {
                    continue;
                }
                if (pass > 0 && number == chosen) {
                    return i;
                }
                number++;
            }
            count = number;
            chosen = (int)(random_unit(random_key(key, STREAM_INDIVIDUAL)) * (float)count);
        }
    }
    return 0; // not reached: each species has an individual in the open
}

static Transform place_at(const Wood *wood, float x, float z, float sine, float cosine,
                          uint64_t key)
{
    float size = random_range(random_key(key, STREAM_SIZE), 0.9f, 1.06f);
    Vec3 foot = vec3(x, land_height(&wood->around->land, x, z) - SUNK, z);
    return transform_from_axes(vec3(size * cosine, 0, -size * sine), vec3(0, size, 0),
                               vec3(size * sine, 0, size * cosine), foot);
}

static bool add_tree(TreePlaces *places, const Wood *wood, float x, float z, uint64_t key, Error *e)
{
    Vec3 toward;
    int open = find_open(wood, x, z, &toward);
    bool edge = open >= EDGE_PROBES && vec3_dot(toward, toward) > 0.1f;
    Situation situation =
        open >= OPEN_PROBES ? SITUATION_OPEN : (edge ? SITUATION_EDGE : SITUATION_INNER);
    float sine, cosine;
    exact_sincos(random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F), &sine, &cosine);
    if (situation == SITUATION_EDGE) { // +Z of the individual to the open land
        toward = vec3_normalize(toward);
        sine = toward.x;
        cosine = toward.z;
    }
    if (!memory_reserve(&places->place, &places->place_capacity, places->count + 1,
                        sizeof *places->place, e) ||
        !memory_reserve(&places->individual, &places->individual_capacity, places->count + 1,
                        sizeof *places->individual, e)) {
        return false;
    }
    places->individual[places->count] = choose(wood, situation, key);
    places->place[places->count++] = place_at(wood, x, z, sine, cosine, key);
    return true;
}

bool tree_places_init(TreePlaces *places, const ForestParams *forest, const Individuals *all,
                      uint64_t seed, const Surroundings *around, const Run *run, Error *e)
{
    float sine;
    Wood wood = {forest, all, around, seed, forest_params_resolve(forest).spacing, 0.0f};
    exact_sincos(forest->max_slope * RADIANS_PER_DEGREE, &sine, &wood.least_cosine);
    *places = (TreePlaces){0};
    float row = 0.8660254f * wood.spacing;
    int64_t rows = (int64_t)(forest->radius / row) + 1;
    int64_t columns = (int64_t)(forest->radius / wood.spacing) + 1;
    for (int64_t j = -rows; j <= rows; j++) {
        for (int64_t i = -columns; i <= columns; i++) {
            uint64_t key = random_key(random_key(seed, (uint64_t)j), (uint64_t)i);
            float x = (float)i + (j & 1 ? 0.5f : 0.0f), z = (float)j;
            x += random_range(random_key(key, STREAM_X), -JITTER, JITTER);
            z += random_range(random_key(key, STREAM_Z), -JITTER, JITTER);
            x = forest->center.x + wood.spacing * x;
            z = forest->center.z + row * z;
            bool taken = random_unit(random_key(key, STREAM_DENSITY)) < forest->density &&
                         is_wooded(&wood, x, z);
            if (!run_goes_on(run, i + columns, e) ||
                (taken && !add_tree(places, &wood, x, z, key, e))) {
                tree_places_free(places);
                return false;
            }
        }
    }
    return true;
}

void tree_places_free(TreePlaces *places)
{
    free(places->place);
    free(places->individual);
    *places = (TreePlaces){0};
}
