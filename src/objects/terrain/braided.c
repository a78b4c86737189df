// The form braided: a river that braids on a plain of gravel between terraces and the feet of
// mountains. The river grows on a coarse grid, which sets its threads and bars; finer grids add
// small channels in ever less time. Slopes beside the valley are worn on a grid of their own, with
// its floor as base level.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/braid_lines.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <math.h>

enum { LEAST_CELLS = 64, SIDE_CELLS = 512, HARMONICS = 4 };

// Measured: the width of the plain by that of a thread, over width * slope / mean depth of the
// flow; see tests/objects/test_braided.c.
static const double THREADS = 0.54;
static const float PATCH = 0.25f;  // variance of the gravel's erodibility: coarse and fine sheets
static const double BANK = 0.6;    // slope of the risers of terraces
static const double HARD = 0.12;   // erodibility of terraces, which roots hold
static const double SHEETS = 0.13; // height of sheets of gravel, share of the mean depth
static const double OLD = 100.0;   // turnovers: age of gravel that water has not yet reached

double terrain_braid_depth(const TerrainParams *params)
{
    const BraidedParams *p = &params->braided;
    return (double)(p->width * p->slope) * THREADS / (double)p->threads;
}

// A curve of period `size`, mean 0 and about unit height.
static double wander(const Terrain *terrain, uint64_t stream, double z)
{
    uint64_t key = random_key(random_key(terrain->seed, STREAM_PLAIN), stream);
    double sum = 0.0;
    for (int n = 1; n <= HARMONICS; n++) {
        double phase = (double)random_range(random_key(key, (uint64_t)n), 0.0f, 1.0f);
        double turns = n * z / (double)terrain->params->size + phase, sine, cosine;
        exact_sincos_double((turns - floor(turns)) * 6.283185307179586, &sine, &cosine);
        sum += sine / n;
    }
    return sum;
}

// m from the edge of the plain, positive outside.
static double beyond_plain(const Terrain *terrain, double x, double z)
{
    double width = (double)terrain_params_resolve(terrain->params).braided.width;
    double middle = 0.08 * width * wander(terrain, 0, z), away = fabs(x - middle);
    return away - 0.5 * width * (1.0 + 0.09 * wander(terrain, x > middle ? 1 : 2, z));
}

// m from the edge of the plain to that of terrace k (counted from 0), and to the slopes if k is
// their number.
static double terrace_edge(const Terrain *terrain, int k, double x, double z)
{
    TerrainParams p = terrain_params_resolve(terrain->params);
    uint64_t stream = 3 + 2 * (uint64_t)k + (x > 0.0 ? 1 : 0);
    double tread = (double)p.braided.width * 0.16;
    if (k == 0) {
        return 0.0;
    }
    float u = (float)(x / tread), v = (float)(z / tread);
    uint64_t key = random_key(random_key(terrain->seed, STREAM_PLAIN), stream);
    float fray = sparse_noise_fractal(0.7f * u, 0.7f * v, 4, 0.5f, 0.0f, key);
    return tread * (k + 0.4 * wander(terrain, stream, z) + 0.10 * (double)fray);
}

static double terraces_at(const Terrain *terrain, double away, double x, double z)
{
    const BraidedParams *p = &terrain->params->braided;
    double step = (double)p->terrace_height, height = 0.0;
    for (int k = 0; k < p->terraces; k++) {
        double share = (away - terrace_edge(terrain, k, x, z)) * BANK / step;
        share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
        height += step * share * (k == 0 ? 1.0 : 0.7);
    }
    return height;
}

static bool is_floor(const Terrain *terrain, double x, double z)
{
    double edge = terrace_edge(terrain, terrain->params->braided.terraces, x, z);
    return beyond_plain(terrain, x, z) <= edge;
}

// ---- slopes

// How readily streams cut the rock: less far from the valley, so that the mountains rise toward
// their divides, and by the mountain, so that some tower over others. fine: noise.
static float side_weakness(const Terrain *terrain, float fine, double x, double z)
{
    double size = (double)terrain->params->size;
    double edge = terrace_edge(terrain, terrain->params->braided.terraces, x, z);
    float far = (float)((beyond_plain(terrain, x, z) - edge) / (0.3 * size));
    uint64_t key = random_key(random_key(terrain->seed, STREAM_WEAKNESS), 1);
    float massif =
        sparse_noise_fractal((float)(5.0 * x / size), (float)(5.0 * z / size), 2, 0.5f, 0.0f, key);
    float toward = lerpf(1.6f, 0.7f, smoothstepf(0.0f, 1.0f, far));
    return clampf(toward * (1.0f - 0.5f * massif) * (1.0f + 0.6f * fine), 0.2f, 3.0f);
}

// Steep slopes that streams have cut down to the valley's floor, in balance with uplift.
static Landscape *wear_sides(const Terrain *terrain, const Run *run, Error *e)
{
    enum { STEPS = 80 };
    TerrainParams p = terrain_params_resolve(terrain->params);
    int cells = p.evolution.cells < SIDE_CELLS ? p.evolution.cells : SIDE_CELLS;
    Landscape *land = landscape_new(cells, (double)p.size, NULL, e);
    if (!land) {
        return NULL;
    }
    uint64_t key = random_key(terrain->seed, STREAM_WEAKNESS);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double x = land->corner + (double)(i % land->side) * land->cell;
        int64_t row = i / land->side;
        double z = land->corner + (double)row * land->cell;
        float u = (float)(x / (double)p.size), v = (float)(z / (double)p.size);
        float n = sparse_noise_fractal(14.0f * u, 14.0f * v, 5, 0.6f, 0.0f, key);
        land->rock[i] = 0.02 * (double)p.relief * (double)(2.0f + 0.3f * n);
        land->weakness[i] = side_weakness(terrain, n, x, z);
        if (is_floor(terrain, x, z)) {
            landscape_set_base(land, i, 0.0);
        }
    }
    double length = 0.005 * (double)p.size; // sets the distance of valleys
    double incision = 45.0 * (double)p.evolution.streams;
    LandscapeRates rates = {.uplift = 6.0 * (double)p.relief,
                            .incision = incision,
                            .loose = incision,
                            .least_area = 4.0 * land->cell * land->cell,
                            .repose = 1.2,
                            .soil = 12.0 * (double)p.relief,
                            .creep = 80.0 * length * length * (double)p.evolution.soil,
                            .seed = random_key(terrain->seed, STREAM_WATER_WAYS)};
    for (int i = 0; i < STEPS; i++) {
        run_progress(run, "erosion", (double)i / STEPS);
        if (!landscape_step(land, &rates, 1.0 / STEPS, true, run, e)) {
            landscape_free(land);
            return NULL;
        }
    }
    return land;
}

// Heights above the valley's floor.
static HeightField *grow_sides(const Terrain *terrain, const Run *run, Error *e)
{
    Landscape *land = wear_sides(terrain, run, e);
    HeightField *sides = land ? landscape_heights(land, e) : NULL;
    landscape_free(land);
    float low, high;
    if (sides) {
        height_field_range(sides, &low, &high);
        float scale = high > 0.0f ? terrain_params_resolve(terrain->params).relief / high : 1.0f;
        for (int64_t i = 0; i < height_field_count(sides); i++) {
            sides->height[i] *= scale;
        }
    }
    return sides;
}

// ---- the river

static void lay_plain(const Terrain *terrain, Braid *b)
{
    uint64_t key = random_key(terrain->seed, STREAM_SAND);
    uint64_t coarse = random_key(terrain->seed, STREAM_WEAKNESS);
    double half = 0.5 * (double)terrain->params->size, bar = 1.5 * b->mean / b->slope;
    for (int64_t i = 0; i < braid_count(b); i++) {
        double x = ((double)(i % b->side) + 0.5) * b->cell - half;
        int64_t row = i / b->side;
        double z = ((double)row + 0.5) * b->cell - half;
        double away = beyond_plain(terrain, x, z);
        double u = (double)random_range(random_key(key, (uint64_t)i), -0.4f, 0.4f);
        b->bed[i] = b->mean * u * (away < 0.0 ? 1.0 : 0.2) + terraces_at(terrain, away, x, z);
        b->depth[i] = away < 0.0 ? (float)b->mean : 0.0f;
        b->age[i] = (float)OLD;
        float patch =
            sparse_noise_fractal((float)(x / bar), (float)(z / bar), 3, 0.6f, 0.0f, coarse);
        b->erodible[i] = away < 0.0 ? clampf(0.85f + PATCH * patch, 0.5f, 1.0f) : (float)HARD;
        if (!is_floor(terrain, x, z)) {
            b->erodible[i] = 0.0f;
        }
    }
}

// Cells a side on which the length mean depth / slope, over which the flow answers to its bed, is
// at least three cells.
static int first_cells(const TerrainParams *p, int last)
{
    enum { CELLS_PER_BAR = 3 };
    double need = CELLS_PER_BAR * (double)(p->size * p->braided.slope) / terrain_braid_depth(p);
    int cells = LEAST_CELLS;
    while (cells < need && cells < last) {
        cells *= 2;
    }
    return cells;
}

// Floods and times between them, in turn.
static bool flow(Braid *b, double turnovers, int floods, const Run *run, Error *e)
{
    for (int n = 0; n < floods; n++) {
        BraidRates flood = {.discharge = 1.3, .turnovers = 0.6 * turnovers / floods, .moves = true};
        BraidRates after = {.discharge = 0.6, .turnovers = 0.4 * turnovers / floods, .moves = true};
        if (!braid_run(b, &flood, run, e) || !braid_run(b, &after, run, e)) {
            return false;
        }
    }
    return true;
}

// The water falls to its stage, then runs off the bars.
static bool fall_to_stage(Braid *b, const TerrainParams *p, const Run *run, Error *e)
{
    double stage = (double)p->braided.stage;
    BraidRates falling = {.discharge = 0.5 * (0.6 + stage), .turnovers = 0.3, .moves = true};
    BraidRates low = {.discharge = stage, .turnovers = 1.2, .moves = false};
    return braid_run(b, &falling, run, e) && braid_run(b, &low, run, e);
}

// The river on its finest grid.
static Braid *grow_river(const Terrain *terrain, const Run *run, Error *e)
{
    static const double turnovers[] = {80.0, 50.0, 8.0, 1.5, 0.4, 0.1};
    TerrainParams p = terrain_params_resolve(terrain->params);
    int last = p.resolution < p.evolution.cells ? p.resolution : p.evolution.cells;
    int level = 0, levels = (int)(sizeof turnovers / sizeof *turnovers);
    Braid *b = braid_new(first_cells(&p, last), (double)p.size, (double)p.braided.width,
                         (double)p.braided.slope, terrain_braid_depth(&p), e);
    if (b) {
        lay_plain(terrain, b);
    }
    bool done = b && flow(b, turnovers[0] * (double)p.braided.age, 8, run, e);
    while (done && b->side < last && level + 1 < levels) {
        Braid *finer = braid_refined(b, e);
        braid_free(b);
        b = finer;
        level++;
        double age = level == 1 ? (double)p.braided.age : 1.0;
        done = b && flow(b, turnovers[level] * age, level == 1 ? 5 : 1, run, e);
    }
    if (!done || !fall_to_stage(b, &p, run, e)) {
        braid_free(b);
        return NULL;
    }
    return b;
}

bool terrain_grow_braided(Terrain *terrain, const Run *run, Error *e)
{
    terrain->braid = grow_river(terrain, run, e);
    if (!terrain->braid) {
        return false;
    }
    // Puddles much smaller than a bar are not shown.
    double bar = terrain->braid->mean / terrain->braid->slope / terrain->braid->cell;
    terrain->level = braid_level_new(terrain->braid, (int64_t)(0.1 * bar * bar), e);
    terrain->lines = terrain->level ? braid_lines_new(terrain->braid, e) : NULL;
    terrain->sides = terrain->lines ? grow_sides(terrain, run, e) : NULL;
    return terrain->sides;
}

// ---- the land

// Quadratic B-spline: the mean around a place, smooth at all places. u and v in cells.
static double smooth_at(const Braid *b, const double *field, double u, double v)
{
    int column = (int)floor(u), row = (int)floor(v);
    double s = u - column - 0.5, t = v - row - 0.5, sum = 0.0;
    double across[3] = {0.5 * (0.5 - s) * (0.5 - s), 0.75 - s * s, 0.5 * (0.5 + s) * (0.5 + s)};
    double along[3] = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
    for (int k = 0; k < 9; k++) {
        int c = column + k % 3 - 1, r = (row + k / 3 - 1 + b->side) % b->side;
        c = c < 0 ? 0 : c >= b->side ? b->side - 1 : c;
        sum += across[k % 3] * along[k / 3] * field[(int64_t)r * b->side + c];
    }
    return sum;
}

// How old the ground is: gravel by the time since water moved it, then terraces, then slopes.
static float age_at(const Terrain *terrain, int64_t i, float side, double x, double z)
{
    const Braid *b = terrain->braid;
    float age = 0.6f * b->age[i] / (b->age[i] + 12.0f);
    double away = beyond_plain(terrain, x, z);
    if (b->erodible[i] < 1.0f && b->age[i] > 0.5f * (float)OLD && away > 0.0) {
        age = side > 1.0f ? 1.0f : 0.8f;
    }
    return age;
}

// m: low sheets and chutes of the last floods, finer than the river's grid, drawn out along it.
// Water of the lowest stage goes around them.
static double sheets_at(const Terrain *terrain, double x, double z)
{
    const Braid *b = terrain->braid;
    double bar = 0.4 * b->mean / b->slope;
    uint64_t key = random_key(random_key(terrain->seed, STREAM_SAND), 1);
    float bend = sparse_noise((float)(0.6 * x / bar), (float)(0.4 * z / bar), key);
    float u = (float)(x / bar) + 0.5f * bend, v = (float)(0.35 * z / bar);
    return SHEETS * b->mean * (double)sparse_noise_fractal(u, v, 4, 0.6f, 0.0f, key);
}

void terrain_sample_braided(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    const Braid *b = terrain->braid;
    double half = 0.5 * (double)terrain->params->size, last = b->side - 1e-6;
    double u = fmin(((double)x + half) / b->cell, last),
           v = fmin(((double)z + half) / b->cell, last);
    int64_t cell = (int64_t)v * b->side + (int64_t)u;
    float side = height_field_smooth_at(terrain->sides, x, z);
    side = side > 0.0f ? side : 0.0f;
    double loose = side > 0.0f ? 0.0 : (double)b->erodible[cell];
    double bed = smooth_at(b, b->bed, u, v) + loose * sheets_at(terrain, (double)x, (double)z);
    double plane = -b->slope * (double)z;
    field->height[i] = (float)(bed + plane) + side;
    field->age[i] = age_at(terrain, cell, side, (double)x, (double)z);
    field->loose[i] = field->age[i] < 0.9f ? (float)(2.0 * b->mean) : 0.0f;
    BraidWater water = braid_water_at(terrain->level, u, v);
    if (water.known) {
        double level = water.level, above = bed - level;
        double fade = 1.0 - water.away;
        field->wetness[i] = (float)(fade * fmin(fmax(1.0 - above / (2.0 * b->mean), 0.0), 1.0));
        field->water[i] = (float)(level + plane);
    } else {
        field->water[i] = -INFINITY;
    }
}

// Shear stress as a share of 1 + itself.
float terrain_braid_roughness(const Terrain *terrain, float x, float z)
{
    const Braid *b = terrain->braid;
    float half = 0.5f * terrain->params->size, last = (float)b->side - 1.0f;
    int column = (int)clampf((x + half) / (float)b->cell, 0.0f, last);
    int row = (int)clampf((z + half) / (float)b->cell, 0.0f, last);
    float shear = b->shear[(int64_t)row * b->side + column];
    return shear / (1.0f + shear);
}

float terrain_braid_line(const Terrain *terrain, float x, float z)
{
    const Braid *b = terrain->braid;
    double half = 0.5 * (double)terrain->params->size;
    return braid_line_at(b, terrain->lines, ((double)x + half) / b->cell,
                         ((double)z + half) / b->cell);
}
