// Waves over a bed: they slow down where the water is shallow, so they turn toward the shore
// (refraction), grow higher and steeper (shoaling), and break where they are too high for the
// depth.
//
// The time that waves need from the open sea is a solution of the eikonal equation (fast sweeping,
// Zhao 2005), one for the period of each tile. A tile is looked up where its waves would be after
// that time in deep water.
#include "base/memory.h"
#include "objects/sea/sea.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_SAMPLES = 384, SWEEPS = 3, SMOOTHINGS = 2, MOST_DRIFT = 400 };

// The significant height that surf of this depth keeps: Thornton and Guza 1983 (root mean square
// height of 0.42 of the depth, Rayleigh-distributed).
#define SURF_RATIO 0.6f
#define LEAST_DEPTH 0.05f // m: where the travel time is still told
#define DRIFT 14.0f       // m, standard deviation: how far foam of the surf drifts
#define RUN_UP 0.12f      // share of the open sea's height by which surf washes over the shore line

typedef struct Bed {
    const SeaParams *params;
    const WaveSpectrum *spectrum;
    WavesShore *shore;
    float *time; // s, owned: from where waves along `way` pass through x = z = 0
    Vec2 way;
    double height; // m: significant, of the open sea
} Bed;

static int64_t count_of(const WavesShore *shore)
{
    return (int64_t)shore->columns * shore->rows;
}

static WavesShore *shore_new(const HeightField *land, Error *e)
{
    float width = land->cell.x * (float)(land->columns - 1);
    float length = land->cell.y * (float)(land->rows - 1);
    float larger = width > length ? width : length;
    float cell = larger / (float)(MOST_SAMPLES - 1);
    cell = cell > land->cell.x ? cell : land->cell.x;
    WavesShore *shore = memory_alloc_zero(1, sizeof *shore, e);
    if (!shore) {
        return NULL;
    }
    *shore = (WavesShore){.columns = (int)(width / cell) + 2,
                          .rows = (int)(length / cell) + 2,
                          .cell = cell,
                          .origin = land->origin};
    int64_t count = count_of(shore);
    shore->depth = memory_alloc(count, sizeof(float), e);
    shore->share = shore->depth ? memory_alloc(count, WAVES_TILES * sizeof(float), e) : NULL;
    shore->shift = shore->share ? memory_alloc_zero(count, WAVES_TILES * sizeof(float), e) : NULL;
    shore->breaking = shore->shift ? memory_alloc(count, sizeof(float), e) : NULL;
    shore->drift = shore->breaking ? memory_alloc(count, sizeof(float), e) : NULL;
    if (!shore->drift) {
        waves_shore_free(shore);
        return NULL;
    }
    return shore;
}

static Vec2 place_of(const WavesShore *shore, int column, int row)
{
    return (Vec2){shore->origin.x + (float)column * shore->cell,
                  shore->origin.y + (float)row * shore->cell};
}

static void sound(const Bed *bed, const HeightField *land)
{
    const WavesShore *shore = bed->shore;
    for (int row = 0; row < shore->rows; row++) {
        for (int column = 0; column < shore->columns; column++) {
            Vec2 at = place_of(shore, column, row);
            shore->depth[(int64_t)row * shore->columns + column] =
                bed->params->level - height_field_smooth_at(land, at.x, at.y);
        }
    }
}

// ---- travel time

// The time at a sample from its neighbours', whose waves need `slowness` s for a sample.
static float upwind(const Bed *bed, int column, int row, float slowness)
{
    const WavesShore *shore = bed->shore;
    const float *time = bed->time + (int64_t)row * shore->columns + column;
    float left = column > 0 ? time[-1] : INFINITY;
    float right = column < shore->columns - 1 ? time[1] : INFINITY;
    float above = row > 0 ? time[-shore->columns] : INFINITY;
    float below = row < shore->rows - 1 ? time[shore->columns] : INFINITY;
    float a = left < right ? left : right, b = above < below ? above : below;
    float low = a < b ? a : b, high = a < b ? b : a;
    if (high - low >= slowness) {
        return low + slowness;
    }
    float off = high - low;
    return 0.5f * (low + high + sqrtf(2.0f * slowness * slowness - off * off));
}

static void sweep(Bed *bed, const float *slowness, bool leftward, bool upward)
{
    const WavesShore *shore = bed->shore;
    for (int j = 0; j < shore->rows; j++) {
        int row = upward ? shore->rows - 1 - j : j;
        for (int i = 0; i < shore->columns; i++) {
            int column = leftward ? shore->columns - 1 - i : i;
            int64_t at = (int64_t)row * shore->columns + column;
            float time = upwind(bed, column, row, slowness[at]);
            bed->time[at] = time < bed->time[at] ? time : bed->time[at];
        }
    }
}

// Waves come in over the rims that face them.
static void let_in(Bed *bed, float deep_speed)
{
    const WavesShore *shore = bed->shore;
    for (int row = 0; row < shore->rows; row++) {
        for (int column = 0; column < shore->columns; column++) {
            bool faces = (column == 0 && bed->way.x > 0.0f) ||
                         (column == shore->columns - 1 && bed->way.x < 0.0f) ||
                         (row == 0 && bed->way.y > 0.0f) ||
                         (row == shore->rows - 1 && bed->way.y < 0.0f);
            int64_t at = (int64_t)row * shore->columns + column;
            Vec2 p = place_of(shore, column, row);
            bool wet = shore->depth[at] > LEAST_DEPTH;
            bed->time[at] =
                faces && wet ? (p.x * bed->way.x + p.y * bed->way.y) / deep_speed : INFINITY;
        }
    }
}

static void smooth(const WavesShore *shore, float *value, float *scratch)
{
    for (int64_t i = 0; i < count_of(shore); i++) {
        scratch[i] = value[i];
    }
    for (int row = 1; row < shore->rows - 1; row++) {
        for (int column = 1; column < shore->columns - 1; column++) {
            const float *p = scratch + (int64_t)row * shore->columns + column;
            const float *above = p - shore->columns, *below = p + shore->columns;
            value[(int64_t)row * shore->columns + column] =
                0.25f * p[0] + 0.125f * (p[-1] + p[1] + above[0] + below[0]) +
                0.0625f * (above[-1] + above[1] + below[-1] + below[1]);
        }
    }
}

// The shift of a tile whose waves have this frequency.
static bool refract(Bed *bed, int tile, double omega, Error *e)
{
    const WavesShore *shore = bed->shore;
    int64_t count = count_of(shore);
    float *slowness = memory_alloc(count, sizeof *slowness, e);
    if (!slowness) {
        return false;
    }
    double open = (double)bed->params->depth;
    float deep_speed = (float)(omega / wave_number(omega, open));
    for (int64_t i = 0; i < count; i++) {
        float depth = shore->depth[i] > LEAST_DEPTH ? shore->depth[i] : LEAST_DEPTH;
        double k = wave_number(omega, open > 0.0 && (double)depth > open ? open : (double)depth);
        slowness[i] = shore->cell * (float)(k / omega);
    }
    let_in(bed, deep_speed);
    for (int i = 0; i < 4 * SWEEPS; i++) {
        sweep(bed, slowness, i & 1, i & 2);
    }
    for (int i = 0; i < SMOOTHINGS; i++) {
        smooth(shore, bed->time, slowness);
    }
    for (int64_t i = 0; i < count; i++) {
        Vec2 p = place_of(shore, (int)(i % shore->columns), (int)(i / shore->columns));
        float shift = bed->time[i] * deep_speed - (p.x * bed->way.x + p.y * bed->way.y);
        shore->shift[i * WAVES_TILES + tile] = isfinite(shift) ? shift : 0.0f;
    }
    free(slowness);
    return true;
}

// ---- height

// Green's law by the group speed, for waves of a frequency.
static float shoaling(const Bed *bed, double omega, float depth)
{
    double open = (double)bed->params->depth;
    double deep = wave_group_speed(wave_number(omega, open), open);
    double here = (double)(depth > LEAST_DEPTH ? depth : LEAST_DEPTH);
    return (float)sqrt(deep / wave_group_speed(wave_number(omega, here), here));
}

// Significant height of a tile in deep water, m.
static float tile_height(const WaveTile *tile)
{
    return 4.0f * (float)sqrt(waves_mean_square(tile, WAVE_HEIGHT));
}

static void limit_heights(const Bed *bed, const Waves *waves)
{
    const WavesShore *shore = bed->shore;
    float run_up = RUN_UP * (float)bed->height, own[WAVES_TILES];
    for (int t = 0; t < WAVES_TILES; t++) {
        own[t] = fmaxf(tile_height(&waves->tile[t]), 1e-6f);
    }
    for (int64_t i = 0; i < count_of(shore); i++) {
        float depth = shore->depth[i];
        float height = (float)bed->height * shoaling(bed, bed->spectrum->peak, depth);
        float most = SURF_RATIO * (depth > 0.0f ? depth : 0.0f);
        float washed = clampf((depth + run_up) / run_up, 0.0f, 1.0f) * SURF_RATIO * run_up;
        most = most > washed ? most : washed;
        float *share = shore->share + i * WAVES_TILES;
        share[0] = (height < most ? height : most) / (float)bed->height;
        for (int t = 1; t < WAVES_TILES; t++) { // far from breaking
            share[t] = fminf(0.5f * most / own[t], 1.0f);
        }
        shore->breaking[i] = 1.0f - smoothstepf(0.6f, 1.15f, most / height);
    }
}

// How near the surf is: its share smoothed over the way that foam drifts before it is gone.
static bool spread_foam(WavesShore *shore, Error *e)
{
    float *scratch = memory_alloc(count_of(shore), sizeof *scratch, e);
    if (!scratch) {
        return false;
    }
    for (int64_t i = 0; i < count_of(shore); i++) {
        shore->drift[i] = shore->breaking[i];
    }
    // Each smoothing adds half a sample squared to the variance.
    float wide = DRIFT / shore->cell;
    int times = (int)(2.0f * wide * wide);
    for (int i = 0; i < (times < MOST_DRIFT ? times : MOST_DRIFT); i++) {
        smooth(shore, shore->drift, scratch);
    }
    free(scratch);
    return true;
}

WavesShore *sea_shore(const SeaParams *params, const HeightField *land, const Waves *waves,
                      const Run *run, Error *e)
{
    (void)run;
    WaveSpectrum spectrum = sea_spectrum(params);
    Bed bed = {.params = params,
               .spectrum = &spectrum,
               .shore = shore_new(land, e),
               .way = waves->way,
               .height = 4.0 * sqrt(wave_spectrum_variance(&spectrum))};
    if (!bed.shore) {
        return NULL;
    }
    sound(&bed, land);
    limit_heights(&bed, waves);
    bed.time = memory_alloc(count_of(bed.shore), sizeof *bed.time, e);
    bool done = bed.time && spread_foam(bed.shore, e);
    for (int i = 0; done && i < WAVES_TILES; i++) {
        double longest = 6.28318530717958647692 / (double)waves->tile[i].longest;
        double omega =
            i == 0 ? spectrum.peak : wave_frequency(2.0 * longest, (double)params->depth);
        done = refract(&bed, i, omega, e);
    }
    free(bed.time);
    if (!done) {
        waves_shore_free(bed.shore);
        return NULL;
    }
    return bed.shore;
}
