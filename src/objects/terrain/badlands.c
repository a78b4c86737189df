// Badlands: soft bare beds that every storm cuts, the form badlands. Land rises as fast as streams
// cut it down, from a coarse grid to ever finer ones, on which all water that runs off a slope
// cuts, not only that of valleys: so gullies branch down to rills of a few cells, with knife edges
// between them. Walls stand no steeper than their beds bear. Last, washes fill the floors of the
// valleys, since what the rills bring is more than the valley's slope carries (Schumm 1956, Howard
// 1994).
#include "base/exact_math.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <math.h>

enum { FIRST_CELLS = 128, CELLS_PER_RILL = 8, COARSE_STEPS = 48, FINE_STEPS = 4 };

typedef struct Badlands {
    const Terrain *terrain;
    TerrainParams params; // resolved
    LandscapeRates rates; // per lifetime
    double steepest;      // tangent of the steepest wall, relative to what its bed bears
} Badlands;

static void set_rates(Badlands *b)
{
    double incision = TERRAIN_INCISION * (double)b->params.evolution.streams;
    b->rates = (LandscapeRates){.uplift = 6.0 * (double)b->params.relief,
                                .incision = incision,
                                .loose = incision,
                                .seed = random_key(b->terrain->seed, STREAM_WATER_WAYS)};
    float sine, cosine;
    exact_sincos(b->params.badlands.slope * 0.017453292f, &sine, &cosine);
    b->steepest = (double)(sine / cosine);
}

static int last_cells(const TerrainParams *p)
{
    int most = p->evolution.cells < p->resolution ? p->evolution.cells : p->resolution;
    double rill = fmax((double)p->badlands.rills, 1e-3);
    double wanted = CELLS_PER_RILL * (double)p->size / rill;
    int cells = FIRST_CELLS;
    while (cells < most && cells < wanted) {
        cells *= 2;
    }
    return cells < most ? cells : most;
}

int terrain_badland_cells(const TerrainParams *params)
{
    TerrainParams p = terrain_params_resolve(params);
    return last_cells(&p);
}

// Land that rises faster is land whose streams cut less: in balance the slopes of both are the
// same.
static void raise_strokes(const Badlands *b, Landscape *land)
{
    const UpliftParams *uplift = &b->params.uplift;
    for (int64_t i = 0; uplift->stroke_count > 0 && i < (int64_t)land->side * land->side; i++) {
        int64_t column = i % land->side, row = i / land->side;
        double x = (double)column + 0.5, z = (double)row + 0.5;
        land->weakness[i] /= terrain_stroke_uplift(uplift, (float)(x / land->side) - 0.5f,
                                                   (float)(z / land->side) - 0.5f);
    }
}

// No two gullies are alike, although the rock is.
static void prepare(const Badlands *b, Landscape *land, const Run *run)
{
    const WeaknessNoise noise = {.unit = 0.12 * (double)b->params.size,
                                 .scale = 1.0f,
                                 .octaves = 6,
                                 .gain = 0.7f,
                                 .strength = 0.45f,
                                 .least = 0.3f};
    terrain_open_outlets(b->terrain, b->params.badlands.outlets, land);
    terrain_set_weakness(land, &noise, random_key(b->terrain->seed, STREAM_WEAKNESS), run);
    raise_strokes(b, land);
}

static void roughen(const Badlands *b, Landscape *land)
{
    terrain_roughen(land, b->params.relief, 0.15 * (double)b->params.size, 1.6f,
                    random_key(b->terrain->seed, STREAM_PLATEAU));
}

// One grid's share of the work: `lifetime` of cutting in `steps`. Mud creeps over as much of a
// slope as gives the finest rills CELLS_PER_RILL cells.
static bool cut(Badlands *b, Landscape *land, double lifetime, int steps, const Run *run, Error *e)
{
    double rill = fmax(CELLS_PER_RILL * land->cell, (double)b->params.badlands.rills);
    double length = rill / TERRAIN_VALLEY_SPACING, soil = (double)b->params.evolution.soil;
    double creep = TERRAIN_INCISION * length * length * soil, time = lifetime / steps;
    b->rates.least_area = 2.0 * land->cell * land->cell;
    terrain_add_lumps(land, 0.5 * land->cell, 7.0 * land->cell, b->terrain->seed, run);
    for (int i = 0; i < steps; i++) {
        run_progress(run, "erosion", (double)i / steps);
        // Streams come last: they clear what has crept into them.
        if (!landscape_round(land, creep * time, run, e) ||
            !landscape_limit_slopes(land, b->steepest, e) ||
            !landscape_cut_streams(land, &b->rates, time, run, e)) {
            return false;
        }
    }
    return landscape_limit_slopes(land, b->steepest, e);
}

// The last storms cut rills into walls that stood even, deeper than mud creeps in between.
static bool cut_rills(Badlands *b, Landscape *land, const Run *run, Error *e)
{
    enum { STORMS = 4 };
    const double drains = 50.0; // m^2: of a rill of the depth asked for, on a wall of 45 degrees
    const double stands = 1.35; // walls of fresh rills, beside old ones
    double depth = (double)b->params.badlands.depth;
    LandscapeRates rates = b->rates;
    rates.uplift = 0.0;
    rates.least_area = 8.0 * land->cell * land->cell;
    double time = depth / (sqrt(drains) * landscape_erodibility(0.2) * rates.incision * STORMS);
    if (depth > 0.0) {
        terrain_add_lumps(land, 0.15 * depth, CELLS_PER_RILL * land->cell, b->terrain->seed, run);
    }
    for (int i = 0; depth > 0.0 && i < STORMS; i++) {
        run_progress(run, "rills", (double)i / STORMS);
        if (!landscape_cut_streams(land, &rates, time, run, e) ||
            !landscape_round(land, 0.012 * land->cell * land->cell, run, e)) {
            return false;
        }
    }
    return landscape_limit_slopes(land, stands * b->steepest, e);
}

static bool lay_washes(const Badlands *b, Landscape *land, const Run *run, Error *e)
{
    const LandscapeWash wash = {.slope = (double)b->params.badlands.wash,
                                .least_area = 800.0,
                                .across = 0.02,
                                .seed = b->rates.seed};
    return b->params.badlands.wash <= 0.0f || landscape_lay_wash(land, &wash, run, e);
}

// Frees the land on failure.
static Landscape *kept(Landscape *land, bool done)
{
    if (!done) {
        landscape_free(land);
        return NULL;
    }
    return land;
}

Landscape *terrain_evolve_badlands(Terrain *terrain, const Run *run, Error *e)
{
    Badlands b = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    int last = last_cells(&b.params), cells = last < FIRST_CELLS ? last : FIRST_CELLS;
    int steps = COARSE_STEPS;
    set_rates(&b);
    Landscape *land = landscape_new(cells, (double)b.params.size, terrain->strata, e);
    if (land) {
        roughen(&b, land);
    }
    for (double lifetime = 2.0; land; lifetime *= 0.5) {
        prepare(&b, land, run);
        land = kept(land, cut(&b, land, lifetime, steps, run, e));
        if (!land || land->side > last) {
            break;
        }
        // Nearly linear in the uplift.
        b.rates.uplift *= landscape_scale_relief(land, (double)b.params.relief);
        Landscape *finer = landscape_refined(land, run, e);
        landscape_free(land);
        land = finer;
        steps = steps / 2 > FINE_STEPS ? steps / 2 : FINE_STEPS;
    }
    return land ? kept(land, cut_rills(&b, land, run, e) && lay_washes(&b, land, run, e)) : NULL;
}

// Wetness tells the pattern where water runs: up to 0.5 in rills and gullies, 1 on the washes.
bool terrain_wet_washes(HeightField *field, Error *e)
{
    Drainage *drainage = drainage_new(field, e);
    int64_t count = height_field_count(field);
    for (int64_t i = 0; drainage && i < count; i++) {
        float width = (float)drainage->area[i] / field->cell.x; // m: catchment by m of contour
        float gully = 0.5f * smoothstepf(2.7f, 6.0f, (float)exact_log(width));
        field->wetness[i] = lerpf(gully, 1.0f, smoothstepf(0.02f, 0.3f, field->loose[i]));
    }
    bool done = drainage;
    drainage_free(drainage);
    return done;
}
