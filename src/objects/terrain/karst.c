// Tower karst: the form karst. A plateau of jointed limestone is dissolved (land/karst.h): dolines
// grow to cockpits between cones (fengcong), these come down to the water table, and the plain that
// widens from there leaves towers (fenglin). A river from elsewhere may cross it.
#include "objects/terrain/karst.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
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

static float noise(double x, double z, double wavelength, int octaves, uint64_t key)
{
    return sparse_noise_fractal((float)(x / wavelength), (float)(z / wavelength), octaves, 0.55f,
                                0.0f, key);
}

// ---- rock

// 0..1: how much of a joint of a set is at a place; *block: the last line before it.
static double joint_at(double across, double spacing, double cell, uint64_t key, int64_t *block)
{
    double at = across / spacing, width = 0.1 * spacing, most = 0.0;
    double seen = width > 0.8 * cell ? 1.0 : width / (0.8 * cell);
    width = width > 0.8 * cell ? width : 0.8 * cell;
    int64_t near = (int64_t)floor(at);
    *block = near - 2;
    for (int64_t n = near - 1; n <= near + 1; n++) {
        uint64_t own = random_key(key, (uint64_t)n);
        double place = (double)n + 0.5 + (double)random_range(random_key(own, 1), -0.25f, 0.25f);
        double open = 0.35 + 0.65 * (double)random_unit(random_key(own, 2)),
               d = (at - place) * spacing / width;
        double share = open * exact_exp(-d * d) * seen;
        most = share > most ? share : most;
        *block = at >= place ? n : *block;
    }
    return most;
}

// How fast the rock dissolves at a place, relative to sound rock: joints, and blocks between them.
static double weakness(const Karst *k, double x, double z, double cell)
{
    double spacing = (double)k->params.karst.spacing, most = 0.0, sine, cosine;
    double broad = (double)noise(x, z, 4.0 * spacing, 3, random_key(k->key, 1));
    double fine = (double)noise(x, z, 0.7 * spacing, 4, random_key(k->key, 2));
    double wind = 0.22 * spacing * (double)noise(x, z, 1.6 * spacing, 3, random_key(k->key, 3));
    uint64_t block = random_key(k->key, 4);
    double first = (double)random_range(random_key(k->key, 5), 0.0f, 3.1f);
    for (int set = 0; set < SETS; set++) {
        uint64_t own = random_key(k->key, 10 + (uint64_t)set);
        double turn = first + 1.05 * set + (double)random_range(random_key(own, 1), -0.2f, 0.2f);
        exact_sincos_double(turn, &sine, &cosine);
        int64_t line;
        double share = joint_at(cosine * x + sine * z + wind, 1.5 * spacing, cell, own, &line);
        most = share > most ? share : most;
        block = random_key(block, (uint64_t)line);
    }
    double open = 0.75 + 0.5 * fine; // joints open and close along their way
    most *= open < 0.0 ? 0.0 : open > 1.3 ? 1.3 : open;
    double own = (double)random_range(block, -0.25f, 0.25f);
    double rock = exact_exp(0.15 * broad + 0.2 * fine + own);
    rock = rock < 0.35 ? 0.35 : rock > 2.0 ? 2.0 : rock;
    return 0.75 * rock + 2.6 * most;
}

// ---- the river

// m from the middle of the river, which runs from north to south.
static double river_distance(const Karst *k, double x, double z)
{
    double size = (double)k->params.size;
    double bend = (double)noise(z, 0.0, 0.45 * size, 2, random_key(k->key, 20));
    return fabs(x - 0.07 * size * bend);
}

static double plain_half(const Karst *k, double x, double z)
{
    double river = (double)k->params.karst.river;
    double wide = 1.0 + 0.5 * (double)noise(x, z, 6.0 * river, 3, random_key(k->key, 21));
    return 0.5 * river + river * (wide < 0.1 ? 0.1 : wide);
}

// ---- the land

static void lay_land(const Karst *k, Landscape *land, double *reached, const Run *run)
{
    double spacing = (double)k->params.karst.spacing, relief = (double)k->params.relief;
    bool river = k->params.karst.river > 0.0f;
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double x = land->corner + column * land->cell, z = land->corner + row * land->cell;
            double rolling = (double)noise(x, z, 5.0 * spacing, 3, random_key(k->key, 30));
            land->weakness[i] = (float)weakness(k, x, z, land->cell);
            land->rock[i] = relief * (1.0 + 0.1 * rolling);
            bool wet = river && river_distance(k, x, z) < plain_half(k, x, z);
            reached[i] = wet ? 0.0 : (double)INFINITY;
        }
    }
}

// Cliffs stand about as steep as their beds bear, here less, there more.
static bool fell(const Karst *k, Landscape *land, Error *e)
{
    int64_t count = landscape_count(land);
    double *steepness = memory_alloc(count, sizeof *steepness, e);
    double wavelength = 0.35 * (double)k->params.karst.spacing;
    for (int64_t i = 0; steepness && i < count; i++) {
        int64_t row = i / land->side;
        double x = land->corner + (double)(i % land->side) * land->cell;
        double z = land->corner + (double)row * land->cell;
        double n = (double)noise(x, z, wavelength, 4, random_key(k->key, 31));
        double factor = exact_exp(0.55 * n);
        steepness[i] = factor < 0.35 ? 0.35 : factor > 2.5 ? 2.5 : factor;
    }
    bool done = steepness && karst_fell(land, steepness, e);
    free(steepness);
    return done;
}

// Alluvium on the plain, and the river's bed in it. The river has brought what lies there.
static void lay_plain(const Karst *k, Landscape *land)
{
    double relief = (double)k->params.relief, half = 0.5 * (double)k->params.karst.river;
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (land->rock[i] > 0.0) {
            continue;
        }
        int64_t row = i / land->side;
        double x = land->corner + (double)(i % land->side) * land->cell;
        double z = land->corner + (double)row * land->cell;
        double d = half > 0.0 ? river_distance(k, x, z) / half : 9.0;
        double bank = (d - 1.0) / 0.25;
        bank = bank < 0.0 ? 0.0 : bank > 1.0 ? 1.0 : bank;
        if (d < 1.0) {
            double deep = KARST_BED * relief * (1.0 - d * d);
            land->rock[i] -= deep;
            land->outflow += deep * own;
        }
        double rough = 1.0 + 0.12 * (double)noise(x, z, 0.5 * (double)k->params.karst.spacing, 3,
                                                  random_key(k->key, 40));
        land->loose[i] = KARST_ALLUVIUM * relief * bank * rough;
        land->outflow -= land->loose[i] * own;
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
            fell(&k, land, e) &&
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
