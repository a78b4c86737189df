// A rocky coast: the form coast. Rolling land with valleys, graded to a lower sea, is drowned; then
// waves cut it back (land/shore.h), first on a coarse grid, then on finer ones, each for a later
// part of the time.
#include "objects/terrain/coast.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/joints.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CELLS = 256, SETS = 2 };

typedef struct Coast {
    const Terrain *terrain;
    TerrainParams params; // resolved
    ShoreParams shore;
    LandscapeRates slopes; // of cliffs, per unit of time: the whole work of the waves
    double line;           // m seaward of the middle: the shore before waves cut
} Coast;

static void sea_direction(TerrainSide side, ShoreParams *shore)
{
    shore->sea_x = side == SIDE_EAST ? 1 : side == SIDE_WEST ? -1 : 0;
    shore->sea_z = side == SIDE_NORTH ? -1 : side == SIDE_SOUTH || side == SIDE_ALL ? 1 : 0;
}

static double tangent(float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * 0.017453292f, &sine, &cosine);
    return (double)(sine / cosine);
}

static Coast coast_of(const Terrain *terrain)
{
    Coast c = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    const CoastParams *coast = &c.params.coast;
    const EvolutionParams *evolution = &c.params.evolution;
    c.shore = (ShoreParams){.waves = (double)coast->waves,
                            .wave_height = (double)coast->wave_height,
                            .tide = (double)coast->tide,
                            .grain = 0.001 * (double)coast->grain,
                            .sand = (double)coast->sand,
                            .speed = (double)coast->retreat};
    sea_direction(coast->sea, &c.shore);
    c.slopes = (LandscapeRates){.retreat = 0.08 * c.shore.speed * (double)evolution->weathering,
                                .rubble = 0.5 * (double)evolution->rubble,
                                .repose = tangent(evolution->repose),
                                .soil = 0.4 * (double)evolution->soil,
                                .creep = 6.0 * (double)evolution->soil};
    c.line = 0.05 * (double)c.params.size + 0.35 * c.shore.speed;
    return c;
}

// ---- rock

// Two sets of joints, one about across the shore, each with the direction of its normal.
typedef struct Jointing {
    JointSet set[SETS];
    double x[SETS], z[SETS];
} Jointing;

static Jointing jointing_of(const Coast *c)
{
    uint64_t key = random_key(c->terrain->seed, STREAM_JOINTS);
    double spacing = (double)c->params.coast.joint_spacing, sine, cosine;
    Jointing jointing;
    for (int i = 0; i < SETS; i++) {
        uint64_t own = random_key(key, 10 + (uint64_t)i);
        double turn = (double)random_range(random_key(own, 1), -0.35f, 0.35f) + 1.3 * i;
        exact_sincos_double(turn, &sine, &cosine);
        // At turn 0 the joints run from the sea inland.
        jointing.x[i] = c->shore.sea_z != 0 ? cosine : -sine;
        jointing.z[i] = c->shore.sea_z != 0 ? sine : cosine;
        jointing.set[i] = (JointSet){spacing, 0.07 * spacing, 0.35f, 0.0, own};
    }
    return jointing;
}

// How fast waves cut the rock, relative to that of its bed: joints, and blocks between them.
static void set_part(const Coast *c, const Jointing *jointing, const RowPart *part, float *weakness)
{
    uint64_t key = random_key(c->terrain->seed, STREAM_JOINTS);
    double contrast = (double)c->params.coast.joints, cell = part->land->cell;
    double spacing = (double)c->params.coast.joint_spacing;
    RowNoise of_land = {(double)c->params.size, 4.0, 3, 0.6f, random_key(key, 1)};
    RowNoise of_joints = {spacing, 0.6, 4, 0.6f, random_key(key, 2)};
    float broad[ROW_PART], fine[ROW_PART];
    row_noise(&of_land, part, broad);
    row_noise(&of_joints, part, fine);
    double z = part->land->corner + part->row * cell;
    for (int i = 0; i < part->count; i++) {
        double x = part->land->corner + (part->first + i) * cell, most = 0.0;
        double bend = 0.25 * spacing * (double)fine[i];
        uint64_t block = random_key(key, 3);
        for (int set = 0; set < SETS; set++) {
            double across = jointing->x[set] * x + jointing->z[set] * z + bend;
            Joint joint = joint_at(&jointing->set[set], across, cell);
            most = joint.share > most ? joint.share : most;
            block = random_key(block, (uint64_t)joint.block);
        }
        // They open and close along their way.
        double open = 0.7 + 0.4 * (double)fine[i];
        most *= open < 0.0 ? 0.0 : open > 1.2 ? 1.2 : open;
        double own = (double)random_range(block, -1.1f, 0.9f);
        double rock =
            exact_exp(contrast * (0.45 * (double)broad[i] + 0.25 * (double)fine[i] + own));
        rock = rock < 0.15 ? 0.15 : rock > 3.0 ? 3.0 : rock;
        weakness[i] = (float)(rock + 8.0 * contrast * most);
    }
}

static void set_weakness(const Coast *c, Landscape *land, const Run *run)
{
    const Jointing jointing = jointing_of(c);
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int first = 0; first < land->side; first += ROW_PART) {
            RowPart part = row_part(land, row, first);
            set_part(c, &jointing, &part, land->weakness + (int64_t)row * land->side + first);
        }
    }
}

// ---- the land before waves cut it

// m inland of the first shore.
static double inland_of(const Coast *c, const Landscape *land, int64_t i)
{
    double x = land->corner + (double)(i % land->side) * land->cell;
    int64_t row = i / land->side;
    double z = land->corner + (double)row * land->cell;
    double along = c->shore.sea_z != 0 ? x : z, size = (double)c->params.size;
    float bend = sparse_noise_fractal((float)(3.0 * along / size), 0.5f, 4, 0.5f, 0.0f,
                                      random_key(c->terrain->seed, STREAM_COURSE));
    double bends = (double)c->params.coast.joints > 0.0 ? 0.03 * size * (double)bend : 0.0;
    return c->line + bends - c->shore.sea_x * x - c->shore.sea_z * z;
}

static double rolling_at(const Coast *c, double x, double z, double inland)
{
    uint64_t key = random_key(c->terrain->seed, STREAM_PLATEAU);
    double size = (double)c->params.size, relief = (double)c->params.relief;
    float broad =
        sparse_noise_fractal((float)(2.2 * x / size), (float)(2.2 * z / size), 5, 0.42f, 0.0f, key);
    double rise = inland / (0.6 * size); // from the cliffs to the hills behind
    rise = rise < 0.0 ? 0.0 : rise > 1.0 ? 1.0 : rise;
    return relief * (0.58 + 0.30 * rise + 0.11 * (double)broad);
}

// Streams cut valleys down to a sea that is lower than today's.
static bool cut_valleys(const Coast *c, Landscape *land, const Run *run, Error *e)
{
    enum { STEPS = 40 };
    double size = (double)c->params.size, relief = (double)c->params.relief;
    LandscapeRates rates = {.incision = 2.2 * (double)c->params.evolution.streams,
                            .loose = 3.0 * (double)c->params.evolution.streams,
                            .least_area = 4e-4 * size * size,
                            .deposition = 0.2 * (double)c->params.evolution.deposition,
                            .repose = 0.45,
                            .soil = 0.4 * relief,
                            .creep = 4e-3 * size * size,
                            .seed = random_key(c->terrain->seed, STREAM_WATER_WAYS)};
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (inland_of(c, land, i) <= 0.0) {
            landscape_set_base(land, i, -0.12 * relief);
        }
    }
    for (int k = 0; k < STEPS; k++) {
        run_progress(run, "valleys", (double)k / STEPS);
        if (!landscape_step(land, &rates, 1.0 / STEPS, k % 4 == 0, run, e)) {
            return false;
        }
    }
    memset(land->base, 0, (size_t)landscape_count(land));
    return true;
}

static bool lay_land(const Coast *c, Landscape *land, const Run *run, Error *e)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double x = land->corner + column * land->cell, z = land->corner + row * land->cell;
            land->rock[i] = rolling_at(c, x, z, inland_of(c, land, i));
        }
    }
    return cut_valleys(c, land, run, e);
}

// The sea rises to height 0 over a floor that falls from the shore.
static Shore *drown(const Coast *c, Landscape *land, Error *e)
{
    Shore *shore = shore_new(&c->shore, land, e);
    for (int64_t i = 0; shore && i < landscape_count(land); i++) {
        double inland = inland_of(c, land, i), top = land->rock[i] + land->loose[i];
        if (inland <= 0.0) {
            land->rock[i] = shore_platform(shore, -inland) + 0.015 * inland;
            land->loose[i] = 0.0;
            shore->front[i] = inland;
        } else {
            double above = 3.0 * (top - shore->high); // about the distance to the flood
            shore->front[i] = above < inland ? above : inland;
        }
    }
    land->outflow = 0.0; // it all begins here
    return shore;
}

// ---- time

static bool wear(const Coast *c, Landscape *land, Shore *shore, double time, const Run *run,
                 Error *e)
{
    enum { LEAST_STEPS = 8 };
    int steps = 1 + (int)(time / shore_step_limit(shore, land));
    steps = steps > LEAST_STEPS ? steps : LEAST_STEPS;
    for (int k = 0; k < steps; k++) {
        run_progress(run, "waves", (double)k / steps);
        if (!shore_step(shore, land, &c->slopes, time / steps, run, e)) {
            return false;
        }
    }
    return true;
}

static bool refine(const Coast *c, Landscape **land, Shore **shore, const Run *run, Error *e)
{
    Landscape *finer = landscape_refined(*land, run, e);
    Shore *next = finer ? shore_refined(*shore, finer, e) : NULL;
    landscape_free(*land);
    shore_free(*shore);
    *land = finer;
    *shore = next;
    if (next) {
        set_weakness(c, finer, run);
    }
    return next;
}

// Falls of rock come to rest, turf creeps.
static bool settle(const Coast *c, Landscape *land, const Run *run, Error *e)
{
    enum { TIMES = 6 };
    for (int k = 0; k < TIMES; k++) {
        if (!landscape_slopes_only(land, &c->slopes, 0.01, run, e)) {
            return false;
        }
    }
    return true;
}

// HeightField.ground on the landscape's grid: see coast.h.
static HeightField *ground_of(const Shore *shore, const Landscape *land, Error *e)
{
    HeightField *ground = landscape_heights(land, e);
    for (int64_t i = 0; ground && i < landscape_count(land); i++) {
        ground->height[i] = (float)shore->front[i];
    }
    return ground;
}

Landscape *terrain_evolve_coast(Terrain *terrain, const Run *run, Error *e)
{
    static const double until[] = {0.6, 0.85, 0.95, 0.99}; // time at which a finer grid takes over
    Coast c = coast_of(terrain);
    int last = c.params.resolution < c.params.evolution.cells ? c.params.resolution
                                                              : c.params.evolution.cells;
    int cells = last < FIRST_CELLS ? last : FIRST_CELLS;
    Landscape *land = landscape_new(cells, (double)c.params.size, terrain->strata, e);
    Shore *shore = land && lay_land(&c, land, run, e) ? drown(&c, land, e) : NULL;
    if (shore) {
        set_weakness(&c, land, run);
    }
    bool done = shore;
    double time = 0.0;
    for (int level = 0; done; level++, cells *= 2) {
        double end = cells < last && level < 4 ? until[level] : 1.0;
        done = wear(&c, land, shore, end - time, run, e);
        time = end;
        if (cells >= last) {
            break;
        }
        done = done && refine(&c, &land, &shore, run, e);
    }
    done = done && settle(&c, land, run, e) && shore_lay_beach(shore, land, run, e) &&
           (terrain->ground = ground_of(shore, land, e));
    shore_free(shore);
    if (!done) {
        landscape_free(land);
        return NULL;
    }
    return land;
}
