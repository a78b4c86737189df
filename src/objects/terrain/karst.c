// Tower karst: the form karst. A plateau of jointed limestone is dissolved (land/karst.h): dolines
// grow to cockpits between cones (fengcong), these come down to the water table, and the plain that
// widens from there leaves towers (fenglin). A river from elsewhere may cross it.
#include "objects/terrain/karst.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/joints.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>

enum { STEPS = 60, SETS = 3 };

typedef struct Karst {
    const Terrain *terrain;
    TerrainParams params; // resolved
    KarstRates rates;     // per time from a plateau to a plain with towers
    uint64_t key;
} Karst;

static Karst karst_of(const Terrain *terrain)
{
    Karst k = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    const KarstParams *karst = &k.params.karst;
    double spacing = (double)karst->spacing, weathering = (double)k.params.evolution.weathering;
    k.key = random_key(terrain->seed, STREAM_KARST);
    k.rates = (KarstRates){.lowering = 0.62 * (double)k.params.relief,
                           .focus = 2.2 * (double)karst->focus,
                           .reach = 0.22 * spacing,
                           .rounding = 14.0,
                           .edge = 0.045 * spacing,
                           .corrosion = 0.19 * spacing * weathering};
    return k;
}

// Noise of the given wavelength (m) at a part of a row.
static void noise(double wavelength, int octaves, uint64_t key, const RowPart *part, float *n)
{
    RowNoise own = {wavelength, 1.0, octaves, 0.55f, key};
    row_noise(&own, part, n);
}

// ---- rock

// The sets of joints, each with the direction of its normal.
typedef struct Jointing {
    JointSet set[SETS];
    double sine[SETS], cosine[SETS];
} Jointing;

static Jointing jointing_of(const Karst *k)
{
    double spacing = 1.5 * (double)k->params.karst.spacing;
    double first = (double)random_range(random_key(k->key, 5), 0.0f, 3.1f);
    Jointing jointing;
    for (int i = 0; i < SETS; i++) {
        uint64_t own = random_key(k->key, 10 + (uint64_t)i);
        double turn = first + 1.05 * i + (double)random_range(random_key(own, 1), -0.2f, 0.2f);
        exact_sincos_double(turn, &jointing.sine[i], &jointing.cosine[i]);
        jointing.set[i] = (JointSet){spacing, 0.1 * spacing, 0.25f, 0.35, own};
    }
    return jointing;
}

// How fast the rock dissolves, relative to sound rock: joints, and blocks between them.
static void set_weakness(const Karst *k, const Jointing *jointing, const RowPart *part,
                         float *weakness)
{
    double spacing = (double)k->params.karst.spacing, cell = part->land->cell;
    float broad[ROW_PART], fine[ROW_PART], bend[ROW_PART];
    noise(4.0 * spacing, 3, random_key(k->key, 1), part, broad);
    noise(0.7 * spacing, 4, random_key(k->key, 2), part, fine);
    noise(1.6 * spacing, 3, random_key(k->key, 3), part, bend);
    double z = part->land->corner + part->row * cell;
    for (int i = 0; i < part->count; i++) {
        double x = part->land->corner + (part->first + i) * cell, most = 0.0;
        double wind = 0.22 * spacing * (double)bend[i];
        uint64_t block = random_key(k->key, 4);
        for (int set = 0; set < SETS; set++) {
            double across = jointing->cosine[set] * x + jointing->sine[set] * z + wind;
            Joint joint = joint_at(&jointing->set[set], across, cell);
            most = joint.share > most ? joint.share : most;
            block = random_key(block, (uint64_t)joint.block);
        }
        double open = 0.75 + 0.5 * (double)fine[i]; // joints open and close along their way
        most *= open < 0.0 ? 0.0 : open > 1.3 ? 1.3 : open;
        double own = (double)random_range(block, -0.25f, 0.25f);
        double rock = exact_exp(0.15 * (double)broad[i] + 0.2 * (double)fine[i] + own);
        rock = rock < 0.35 ? 0.35 : rock > 2.0 ? 2.0 : rock;
        weakness[i] = (float)(0.75 * rock + 2.6 * most);
    }
}

// ---- the river

// x of the middle of the river, which runs from north to south, at a row.
static double river_middle(const Karst *k, const Landscape *land, int row)
{
    double size = (double)k->params.size, z = land->corner + row * land->cell;
    float bend = sparse_noise_fractal((float)(z / (0.45 * size)), 0.0f, 2, 0.55f, 0.0f,
                                      random_key(k->key, 20));
    return 0.07 * size * (double)bend;
}

// 0 where the river's plain is, from which water has reached the rock beside it, else infinite.
static void set_reached(const Karst *k, const RowPart *part, double *reached)
{
    double river = (double)k->params.karst.river;
    if (!(river > 0.0)) {
        for (int i = 0; i < part->count; i++) {
            reached[i] = (double)INFINITY;
        }
        return;
    }
    float n[ROW_PART];
    noise(6.0 * river, 3, random_key(k->key, 21), part, n);
    double middle = river_middle(k, part->land, part->row);
    for (int i = 0; i < part->count; i++) {
        double x = part->land->corner + (part->first + i) * part->land->cell;
        double wide = 1.0 + 0.5 * (double)n[i];
        double half = 0.5 * river + river * (wide < 0.1 ? 0.1 : wide);
        reached[i] = fabs(x - middle) < half ? 0.0 : (double)INFINITY;
    }
}

// ---- the land

static void lay_land(const Karst *k, Landscape *land, double *reached, const Run *run)
{
    double spacing = (double)k->params.karst.spacing, relief = (double)k->params.relief;
    const Jointing jointing = jointing_of(k);
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int first = 0; first < land->side; first += ROW_PART) {
            RowPart part = row_part(land, row, first);
            int64_t at = (int64_t)row * land->side + first;
            float rolling[ROW_PART];
            noise(5.0 * spacing, 3, random_key(k->key, 30), &part, rolling);
            for (int i = 0; i < part.count; i++) {
                land->rock[at + i] = relief * (1.0 + 0.1 * (double)rolling[i]);
            }
            set_weakness(k, &jointing, &part, land->weakness + at);
            set_reached(k, &part, reached + at);
        }
    }
}

// Cliffs stand about as steep as their beds bear, here less, there more.
static bool fell(const Karst *k, Landscape *land, const Run *run, Error *e)
{
    double *steepness = memory_alloc(landscape_count(land), sizeof *steepness, e);
    if (!steepness) {
        return false;
    }
    double wavelength = 0.35 * (double)k->params.karst.spacing;
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int first = 0; first < land->side; first += ROW_PART) {
            RowPart part = row_part(land, row, first);
            double *of_part = steepness + (int64_t)row * land->side + first;
            float n[ROW_PART];
            noise(wavelength, 4, random_key(k->key, 31), &part, n);
            for (int i = 0; i < part.count; i++) {
                double factor = exact_exp(0.55 * (double)n[i]);
                of_part[i] = factor < 0.35 ? 0.35 : factor > 2.5 ? 2.5 : factor;
            }
        }
    }
    bool done = karst_fell(land, steepness, e);
    free(steepness);
    return done;
}

// Alluvium on the plain, and the river's bed in it. The river has brought what lies there.
static void lay_part(const Karst *k, Landscape *land, const RowPart *part)
{
    double relief = (double)k->params.relief, half = 0.5 * (double)k->params.karst.river;
    double own = land->cell * land->cell, middle = river_middle(k, land, part->row);
    float n[ROW_PART];
    noise(0.5 * (double)k->params.karst.spacing, 3, random_key(k->key, 40), part, n);
    for (int column = 0; column < part->count; column++) {
        int64_t i = (int64_t)part->row * land->side + part->first + column;
        if (land->rock[i] > 0.0) {
            continue;
        }
        double x = land->corner + (part->first + column) * land->cell;
        double d = half > 0.0 ? fabs(x - middle) / half : 9.0;
        double bank = (d - 1.0) / 0.25;
        bank = bank < 0.0 ? 0.0 : bank > 1.0 ? 1.0 : bank;
        if (d < 1.0) {
            double deep = KARST_BED * relief * (1.0 - d * d);
            land->rock[i] -= deep;
            land->outflow += deep * own;
        }
        double rough = 1.0 + 0.12 * (double)n[column];
        land->loose[i] = KARST_ALLUVIUM * relief * bank * rough;
        land->outflow -= land->loose[i] * own;
    }
}

static void lay_plain(const Karst *k, Landscape *land)
{
    for (int row = 0; row < land->side; row++) {
        for (int first = 0; first < land->side; first += ROW_PART) {
            RowPart part = row_part(land, row, first);
            lay_part(k, land, &part);
        }
    }
}

Landscape *terrain_evolve_karst(Terrain *terrain, const Run *run, Error *e)
{
    Karst k = karst_of(terrain);
    int cells = k.params.resolution < k.params.evolution.cells ? k.params.resolution
                                                               : k.params.evolution.cells;
    Landscape *land = landscape_new(cells, (double)k.params.size, terrain->strata, e);
    double *reached = land ? memory_alloc(landscape_count(land), sizeof *reached, e) : NULL;
    bool done = reached;
    if (done) {
        lay_land(&k, land, reached, run);
        done =
            karst_dissolve(land, &k.rates, (double)k.params.karst.stage, STEPS, reached, run, e) &&
            fell(&k, land, run, e) &&
            karst_round(land, 0.014 * (double)k.params.karst.spacing, 5, run, e);
    }
    free(reached);
    if (!done) {
        landscape_free(land);
        return NULL;
    }
    lay_plain(&k, land);
    return land;
}
