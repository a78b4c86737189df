// Rounded hills under soil: the form hills. Land rises as fast as streams cut down and soil creeps
// away, until the three balance: convex tops, one valley about every `spacing`. What spaces the
// valleys is the length sqrt(D / K) of creep D and incision K (Perron et al. 2009).
#include "base/exact_math.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <math.h>

enum { CELLS_PER_VALLEY = 20 };

typedef struct Hills {
    const Terrain *terrain;
    TerrainParams params; // resolved
    LandscapeRates rates; // of uplift and streams, per lifetime of the hills
    double creep;         // D, m^2 per lifetime
} Hills;

static void set_rates(Hills *h)
{
    const EvolutionParams *evolution = &h->params.evolution;
    double length = (double)h->params.hills.spacing / TERRAIN_VALLEY_SPACING;
    double incision = TERRAIN_INCISION * (double)evolution->streams;
    h->rates = (LandscapeRates){.uplift = 6.0 * (double)h->params.relief,
                                .incision = incision,
                                .loose = incision,
                                .least_area = 6.0 * length * length,
                                .repose = 1.0,
                                .seed = random_key(h->terrain->seed, STREAM_WATER_WAYS)};
    h->creep = TERRAIN_INCISION * length * length * (double)evolution->soil;
}

// Rock differs from place to place, so that no two hills are alike.
static void set_weakness(const Hills *h, Landscape *land, const Run *run)
{
    const WeaknessNoise noise = {.unit = 1.5 * (double)h->params.hills.spacing,
                                 .scale = 1.0f,
                                 .octaves = 4,
                                 .gain = 0.6f,
                                 .strength = 0.7f,
                                 .least = 0.25f};
    terrain_set_weakness(land, &noise, random_key(h->terrain->seed, STREAM_WEAKNESS), run);
}

static void roughen(const Hills *h, Landscape *land)
{
    terrain_roughen(land, h->params.relief, 3.0 * (double)h->params.hills.spacing, 0.3f,
                    random_key(h->terrain->seed, STREAM_PLATEAU));
}

static bool evolve(const Hills *h, Landscape *land, double share, const Run *run, Error *e)
{
    // In a step streams move less than a cell up a slope, so that creep keeps pace.
    double length = sqrt(h->creep / h->rates.incision);
    int steps = 1 + (int)(share * h->rates.incision * length / (0.4 * land->cell));
    for (int i = 0; i < steps; i++) {
        run_progress(run, "erosion", (double)i / steps);
        // Soil never lacks: soft rock turns to it fast. Streams come last: they clear what has
        // crept into them.
        if (!landscape_round(land, h->creep * (share / steps), run, e) ||
            !landscape_step(land, &h->rates, share / steps, true, run, e)) {
            return false;
        }
    }
    return true;
}

// The land on a grid of twice as many cells. Frees the old one.
static Landscape *refined(Landscape *land, const Run *run, Error *e)
{
    Landscape *finer = landscape_refined(land, run, e);
    landscape_free(land);
    return finer;
}

// Storm water in bare ground: on ever finer grids, streams without creep for a short time.
static Landscape *cut_rills(Hills *h, Landscape *land, const Run *run, Error *e)
{
    const double steepest = 1.4; // of mudstone in the walls of rills: 54 degrees
    int last = h->params.resolution < h->params.evolution.cells ? h->params.resolution
                                                                : h->params.evolution.cells;
    h->creep *= 0.04;
    h->rates.uplift = 0.0;
    h->rates.least_area *= 0.04;
    while (land && 1.4 * (land->side - 1) < last) {
        land = refined(land, run, e);
        if (!land) {
            return NULL;
        }
        terrain_open_outlets(h->terrain, h->params.hills.outlets, land);
        set_weakness(h, land, run);
        if (!evolve(h, land, 0.012 * (double)h->params.hills.rills, run, e)) {
            landscape_free(land);
            return NULL;
        }
        landscape_fell(land, steepest);
    }
    return land;
}

// The depth of soil under which rock turns to soil as fast as the land lowers: the same everywhere,
// as all of it lowers at one rate (Heimsath et al. 1997).
static void lay_soil(Landscape *land)
{
    const double depth = 0.7; // m
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (!land->base[i]) {
            land->rock[i] -= depth;
            land->loose[i] = depth;
        }
    }
}

int terrain_hill_cells(const TerrainParams *params)
{
    TerrainParams p = terrain_params_resolve(params);
    double cells = CELLS_PER_VALLEY * (double)(p.size / p.hills.spacing);
    int most = p.evolution.cells;
    return cells < 64.0 ? 64 : cells > (double)most ? most : 2 * (int)(0.5 * cells + 0.5);
}

static Landscape *finish(Hills *h, Landscape *land, const Run *run, Error *e)
{
    if (h->params.hills.rills > 0.0f) {
        land = cut_rills(h, land, run, e);
    }
    if (land) {
        lay_soil(land);
    }
    return land;
}

Landscape *terrain_evolve_hills(Terrain *terrain, const Run *run, Error *e)
{
    Hills h = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    set_rates(&h);
    int cells = terrain_hill_cells(terrain->params);
    Landscape *land = landscape_new(cells / 2, (double)h.params.size, terrain->strata, e);
    if (land) {
        roughen(&h, land);
    }
    for (double lifetimes = 2.0; land; lifetimes = 1.0) {
        terrain_open_outlets(terrain, h.params.hills.outlets, land);
        set_weakness(&h, land, run);
        if (!evolve(&h, land, lifetimes, run, e)) {
            landscape_free(land);
            return NULL;
        }
        // Heights are linear in the uplift.
        h.rates.uplift *= landscape_scale_relief(land, (double)h.params.relief);
        if (land->side > cells) {
            return finish(&h, land, run, e);
        }
        land = refined(land, run, e);
    }
    return NULL;
}

bool terrain_wet_hollows(HeightField *field, Error *e)
{
    Drainage *drainage = drainage_new(field, e);
    int64_t count = height_field_count(field);
    for (int64_t i = 0; drainage && i < count; i++) {
        // Catchment by the metre of contour: 30 m on a slope, 300 m and more in a hollow.
        float width = (float)drainage->area[i] / field->cell.x;
        field->wetness[i] = smoothstepf(3.2f, 7.5f, (float)exact_log(width));
    }
    bool done = drainage;
    drainage_free(drainage);
    return done;
}
