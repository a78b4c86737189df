// Mountains that rise, that rivers cut, and that glaciers then wear: the form alps. Rivers and
// uplift come near their steady state on a coarse grid; ice ages follow, with frost on the faces
// above the ice; when the ice has gone, what it carried fills the basins that it dug, and streams,
// rockfall and scree work on finer grids for ever shorter times.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/glacier.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>

enum { RIVER_CELLS = 128, ICE_CELLS = 256 };

typedef struct Range {
    const Terrain *terrain;
    TerrainParams params; // resolved
    double size, repose;
} Range;

// ---- the block

// Rock is weak along joints and shear zones: noise at all scales, for the grid at hand.
static void set_weakness(const Range *r, Landscape *land, const Run *run)
{
    uint64_t key = random_key(r->terrain->seed, STREAM_WEAKNESS);
    const WeaknessNoise noise = {r->size, 9.0f, 6, 0.72f, 0.5f, 0.2f};
    terrain_set_weakness(land, &noise, key, run);
}

// Walls break along joints and crushed zones, which are larger and fewer than what leads rivers:
// between them stand ribs and buttresses.
static void set_joints(const Range *r, Landscape *land, const Run *run)
{
    int octaves = 4;
    for (int cells = ICE_CELLS; cells < land->side - 1; cells *= 2) {
        octaves++; // down to two cells
    }
    const WeaknessNoise noise = {r->size, 13.0f, octaves, 0.62f, 1.0f, 0.2f};
    terrain_set_weakness(land, &noise, random_key(r->terrain->seed, STREAM_JOINTS), run);
}

// Rivers in a rising block, nearly in steady state. Stream power is linear in heights, so the
// result is scaled to the relief. Ground as steep as rock can be is left to later stages.
static bool cut_by_rivers(const Range *r, Landscape *land, const Run *run, Error *e)
{
    enum { STEPS = 120 };
    uint64_t key = random_key(r->terrain->seed, STREAM_PLATEAU);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        float x = (float)(i % land->side) / (float)land->side;
        int64_t row = i / land->side;
        float z = (float)row / (float)land->side;
        float n = sparse_noise_fractal(5.0f * x, 5.0f * z, 6, 0.6f, 0.0f, key);
        land->rock[i] = 1e-3 * r->size * (double)(2.0f + 0.3f * n);
    }
    terrain_open_outlets(r->terrain, r->params.alps.outlets, land);
    double own = land->cell * land->cell;
    LandscapeRates rates = {.uplift = 0.12 * r->size,
                            .incision = 45.0,
                            .loose = 45.0,
                            .least_area = 8.0 * own, // slopes above it are plane
                            .repose = 100.0,
                            .seed = random_key(r->terrain->seed, STREAM_WATER_WAYS)};
    for (int i = 0; i < STEPS; i++) {
        if (!landscape_step(land, &rates, 1.0 / STEPS, true, run, e)) {
            return false;
        }
    }
    landscape_scale_relief(land, 1.12 * (double)r->params.relief);
    return true;
}

// ---- ice

static bool wear_by_ice(const Range *r, Landscape *land, const Run *run, Error *e)
{
    enum { STEPS = 50, YEARS = 40 };
    const AlpsParams *alps = &r->params.alps;
    double relief = (double)r->params.relief;
    GlacierParams ice = {.line = (double)alps->ice_line * relief,
                         .gradient = 0.006,
                         .most = 1.2,
                         .steepest = 1.2,
                         .erosion = 2.5e-4 * (double)alps->ice * relief / 2400.0,
                         .till = 0.25};
    LandscapeRates frost = {.retreat = 2.0,
                            .rubble = 0.5,
                            .repose = r->repose,
                            .seed = random_key(r->terrain->seed, STREAM_WATER_WAYS)};
    Glacier *glacier = alps->ice > 0.0f ? glacier_new(land, e) : NULL;
    bool done = glacier || alps->ice <= 0.0f;
    for (int i = 0; glacier && done && i < STEPS; i++) {
        run_progress(run, "ice", (double)i / STEPS);
        done = glacier_flow(glacier, land, &ice, i == 0 ? 8.0 * YEARS : YEARS, run, e) &&
               glacier_wear(glacier, land, &ice, 800.0, e) &&
               landscape_slopes_only(land, &frost, 1.0, run, e);
    }
    glacier_free(glacier);
    return done;
}

// Fills basins with what streams bring as the ice goes: flat floors. The volume comes from what has
// left. Where lakes are wanted, basins keep a share of their depth.
static bool fill_basins(Landscape *land, double share, Error *e)
{
    HeightField *field = landscape_heights(land, e);
    Drainage *flooded = field ? drainage_flood(field, land->base, e) : NULL;
    for (int64_t i = 0; flooded && i < landscape_count(land); i++) {
        double fill = share * ((double)flooded->filled[i] - (land->rock[i] + land->loose[i]));
        if (!land->base[i] && fill > 0.0) {
            land->loose[i] += fill;
            land->outflow -= fill * land->cell * land->cell;
        }
    }
    bool done = flooded;
    drainage_free(flooded);
    height_field_free(field);
    return done;
}

// ---- after the ice

static bool weather(const Range *r, Landscape *land, double share, const Run *run, Error *e)
{
    enum { STEPS = 14 };
    const EvolutionParams *evolution = &r->params.evolution;
    double age = (double)r->params.alps.age, cell = land->cell;
    bool carves = evolution->debris > 0.0f;
    LandscapeRates rates = {.incision = 0.10 * (1.0 - 0.7 * age) * (double)evolution->streams,
                            .loose = 0.4 * (double)evolution->streams,
                            .least_area = 2.0e4,
                            .debris = 40.0 * (1.0 - age) * (double)evolution->debris,
                            .least_debris = 5.0e3,
                            .joints = carves ? 0.8 * (1.0 - age) : 0.0,
                            .deposition = (double)evolution->deposition,
                            .retreat = 25.0 * (1.0 + 3.0 * age) * (double)evolution->weathering,
                            .rubble = 0.45 + (double)evolution->rubble,
                            .repose = r->repose,
                            .soil = (0.3 + 12.0 * age) * (double)evolution->soil,
                            .creep = (30.0 + 6.0e4 * age * age) * (double)evolution->soil};
    rates.rubble = rates.rubble < 1.0 ? rates.rubble : 1.0;
    uint64_t ways = random_key(r->terrain->seed, STREAM_WATER_WAYS);
    double most = 0.3 * cell / rates.retreat; // no face moves by half a cell
    int steps = 1 + (int)(share / most);
    steps = steps > STEPS ? steps : STEPS;
    if (carves) {
        set_joints(r, land, run);
    }
    for (int i = 0; i < steps; i++) {
        run_progress(run, "erosion", (double)i / steps);
        // Debris spreads over its fans by turns.
        rates.seed = carves ? random_key(ways, (uint64_t)i / 2) : ways;
        if (!landscape_step(land, &rates, share / steps, i % 2 == 0, run, e)) {
            return false;
        }
    }
    return true;
}

// The land on a grid of twice as many cells, with its outlets. Frees the old one.
static Landscape *refine(const Range *r, Landscape *land, const Run *run, Error *e)
{
    Landscape *finer = landscape_refined(land, run, e);
    landscape_free(land);
    if (finer) {
        terrain_open_outlets(r->terrain, r->params.alps.outlets, finer);
        set_weakness(r, finer, run);
    }
    return finer;
}

Landscape *terrain_evolve_alps(Terrain *terrain, const Run *run, Error *e)
{
    Range r = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    float sine, cosine;
    exact_sincos(r.params.evolution.repose * 0.017453292f, &sine, &cosine);
    r.size = (double)r.params.size;
    r.repose = (double)(sine / cosine);
    int last = r.params.resolution < r.params.evolution.cells ? r.params.resolution
                                                              : r.params.evolution.cells;
    last = last > ICE_CELLS ? last : ICE_CELLS;
    Landscape *land = landscape_new(RIVER_CELLS, r.size, NULL, e);
    if (land) {
        set_weakness(&r, land, run);
    }
    if (land && !cut_by_rivers(&r, land, run, e)) {
        landscape_free(land);
        return NULL;
    }
    double share = 1.0, filled = r.params.lakes.count > 0 ? (double)r.params.lakes.silt : 1.0;
    for (int cells = RIVER_CELLS; land; cells *= 2) {
        if (land->strata != terrain->strata) {
            land->strata = terrain->strata;
            landscape_lay_stack(land);
        }
        bool done =
            cells != ICE_CELLS || (wear_by_ice(&r, land, run, e) && fill_basins(land, filled, e));
        done = done && (cells < ICE_CELLS || weather(&r, land, share, run, e));
        if (done && cells >= last) {
            return land;
        }
        if (!done) {
            landscape_free(land);
            return NULL;
        }
        share *= cells >= ICE_CELLS ? 0.5 : 1.0;
        land = refine(&r, land, run, e);
    }
    return NULL;
}
