// The form dunes: which winds blow in turn and how much sand lies there decide the kind. Dunes grow
// on a coarse grid; the last wind goes on for a few steps on each finer one, which keeps brinks
// sharp.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/internal.h"

#include <math.h>

#define DEGREE 0.017453292519943295
#define COVER 1.0     // m of sand that are half of the record of its depth
#define REPOSE 0.6619 // tan 33.5 degrees

enum { MOST_WINDS = 3, LEAST_CELLS = 64, MOST_CELLS = 512 };

// Winds that blow in turn, all equally long.
typedef struct WindRegime {
    DuneWind wind[MOST_WINDS];
    int count;
    double turn; // how long each blows, units of time
} WindRegime;

static DuneWind wind_from(double azimuth, double saturation)
{
    double sine, cosine, turns = azimuth / 360.0;
    exact_sincos_double((turns - floor(turns)) * 360.0 * DEGREE, &sine, &cosine);
    return (DuneWind){.x = -sine, .z = cosine, .threshold = 0.3, .saturation = saturation};
}

// Dunes from crest to crest are about 64 saturation lengths long.
static WindRegime regime_of(const TerrainParams *resolved)
{
    const DuneParams *dunes = &resolved->dunes;
    double from = (double)dunes->wind, length = (double)dunes->spacing / 64.0;
    double half = 0.5 * (double)dunes->spread;
    switch (dunes->kind) {
    case DUNE_LINEAR:
        return (WindRegime){
            .wind = {wind_from(from - half, length), wind_from(from + half, length)},
            .count = 2,
            .turn = 55.0 * length * length};
    case DUNE_STAR:
        return (WindRegime){.wind = {wind_from(from + 120.0, length),
                                     wind_from(from + 240.0, length), wind_from(from, length)},
                            .count = 3,
                            .turn = 80.0 * length * length};
    case DUNE_BARCHAN:
    case DUNE_TRANSVERSE:
        break;
    }
    return (WindRegime){
        .wind = {wind_from(from, length)}, .count = 1, .turn = 100.0 * length * length};
}

DuneWind terrain_last_wind(const TerrainParams *params)
{
    TerrainParams resolved = terrain_params_resolve(params);
    WindRegime regime = regime_of(&resolved);
    return regime.wind[regime.count - 1];
}

// A heap of sand of this radius, m, at a place of the repeating square.
static void heap_sand(Dunes *dunes, double x, double z, double radius)
{
    int reach = (int)(2.0 * radius / dunes->cell) + 1, mask = dunes->side - 1;
    int column = (int)(x / dunes->cell), row = (int)(z / dunes->cell);
    for (int dz = -reach; dz <= reach; dz++) {
        for (int dx = -reach; dx <= reach; dx++) {
            double away = (double)(dx * dx + dz * dz) * dunes->cell * dunes->cell;
            double height = exact_exp(-away / (radius * radius)) - 0.02;
            int64_t i = (int64_t)((row + dz) & mask) * dunes->side + ((column + dx) & mask);
            dunes->sand[i] += height > 0.0 ? 0.25 * radius * height : 0.0;
        }
    }
}

// Barchans begin as heaps of many sizes, all others as an uneven sheet.
static void lay_sand(Dunes *dunes, const TerrainParams *resolved, uint64_t seed)
{
    const DuneParams *params = &resolved->dunes;
    uint64_t key = random_key(seed, STREAM_SAND);
    double size = (double)resolved->size, spacing = (double)params->spacing;
    double depth = (double)params->sand;
    if (params->kind != DUNE_BARCHAN) {
        for (int64_t i = 0; i < dunes_count(dunes); i++) {
            double u = (double)random_range(random_key(key, (uint64_t)i), -0.1f, 0.1f);
            dunes->sand[i] = depth * (1.0 + u);
        }
        return;
    }
    int heaps = 1 + (int)(1.2 * size * size / (spacing * spacing));
    for (int n = 0; n < heaps; n++) {
        uint64_t own = random_key(key, (uint64_t)n);
        double x = size * (double)random_range(random_key(own, 0), 0.0f, 1.0f);
        double z = size * (double)random_range(random_key(own, 1), 0.0f, 1.0f);
        double t = (double)random_range(random_key(own, 2), 0.0f, 1.0f);
        heap_sand(dunes, x, z, spacing * (0.15 + 0.25 * t * t));
    }
    double scale = depth * size * size / dunes_volume(dunes);
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        dunes->sand[i] *= scale;
    }
}

// Cells on which the saturation length is at least 0.6 of a cell.
static int first_cells(const TerrainParams *resolved, int last)
{
    double need = 0.6 * 64.0 * (double)(resolved->size / resolved->dunes.spacing);
    int cells = LEAST_CELLS;
    while (cells < need && cells < MOST_CELLS && cells < last) {
        cells *= 2;
    }
    return cells;
}

static bool grow_dunes(Dunes *dunes, const TerrainParams *resolved, const WindRegime *regime,
                       const Run *run, Error *e)
{
    double length = regime->wind[0].saturation;
    double time = (double)resolved->dunes.age * 1000.0 * length * length;
    int turns = regime->count * (1 + (int)(time / (regime->turn * regime->count)));
    for (int i = 0; i < turns; i++) {
        run_progress(run, "wind", (double)i / turns);
        if (!dunes_blow(dunes, &regime->wind[i % regime->count], regime->turn, REPOSE, run, e)) {
            return false;
        }
    }
    return true;
}

// A few steps of the last wind, then slopes come to rest.
static bool sharpen(Dunes *dunes, const DuneWind *wind, const Run *run, Error *e)
{
    enum { STEPS = 16, SWEEPS = 60 };
    double time = STEPS * dunes_step_limit(dunes, wind);
    return dunes_blow(dunes, wind, time, REPOSE, run, e) &&
           dunes_slide(dunes, REPOSE, SWEEPS, run, e);
}

Dunes *terrain_blow_dunes(const Terrain *terrain, const Run *run, Error *e)
{
    TerrainParams resolved = terrain_params_resolve(terrain->params);
    int last = resolved.resolution < resolved.evolution.cells ? resolved.resolution
                                                              : resolved.evolution.cells;
    int cells = first_cells(&resolved, last);
    Dunes *dunes = dunes_new(cells, (double)resolved.size, e);
    WindRegime regime = regime_of(&resolved);
    for (int k = 0; k < regime.count; k++) { // coarser grids have coarser dunes
        double least = 0.6 * (double)resolved.size / cells;
        regime.wind[k].saturation = fmax(regime.wind[k].saturation, least);
    }
    const DuneWind *wind = &regime.wind[regime.count - 1];
    if (dunes) {
        lay_sand(dunes, &resolved, terrain->seed);
    }
    bool done = dunes && grow_dunes(dunes, &resolved, &regime, run, e);
    while (done && dunes->side < last) {
        run_progress(run, "wind", (double)dunes->side / last);
        Dunes *finer = dunes_refined(dunes, e);
        dunes_free(dunes);
        dunes = finer;
        done = dunes && sharpen(dunes, wind, run, e);
    }
    done = done && dunes_straighten(dunes, run, e) && dunes_slide(dunes, REPOSE, 100, run, e) &&
           dunes_find_shear(dunes, wind, run, e);
    if (!done) {
        dunes_free(dunes);
        return NULL;
    }
    return dunes;
}

// The wind goes around hills; its record tells by its length how deep the sand is.
void terrain_sample_dunes(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    const Dunes *dunes = terrain->dunes;
    DuneWind wind = terrain_last_wind(terrain->params);
    double half = 0.5 * (double)terrain->params->size, u = (double)x + half, v = (double)z + half;
    double height = fmax(dunes_at(dunes, u, v), 0.0);
    int64_t mask = dunes->side - 1;
    int64_t column = (int64_t)(u / dunes->cell) & mask, row = (int64_t)(v / dunes->cell) & mask;
    const double *shear = dunes->shear + 2 * (row * dunes->side + column);
    double turn = shear[0] > 0.2 ? fmin(fmax(shear[1] / shear[0], -0.7), 0.7) : 0.0;
    double to_x = wind.x - turn * wind.z, to_z = wind.z + turn * wind.x;
    double cover = height / (height + COVER), scale = cover / sqrt(1.0 + turn * turn);
    field->height[i] = (float)height;
    field->loose[i] = (float)height;
    field->wind[i] = (Vec2){(float)(to_x * scale), (float)(to_z * scale)};
}
