// The form meander: a river that winds in its floodplain. While it moves, each sample records when
// the channel left it, which makes cut banks, point bars with scrolls, and old ground.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>

static const double AGE = 150.0;   // time (Meander.time) of age 1
static const double STAMP = 0.16;  // time between two records of the channel
static const double BARS = 6.0;    // time in which a point bar grows to the floodplain
static const double SCROLLS = 2.2; // time from one scroll to the next
static const double FILL = 60.0;   // time in which an oxbow fills
static const float BANK = 0.045f;  // of the width: height of the banks above the water
static const float DEPTH = 0.06f;  // of the width: greatest depth

typedef struct Plain {
    const Terrain *terrain;
    const TerrainParams *p;
    HeightField *field;
    float *left;  // time at which the channel left; < 0 = it never came
    float *river; // m to the middle of the river, as far as known
    float *lake;  // likewise, to that of an oxbow
    float *cut;   // when that was cut off
} Plain;

static double to_piece(MeanderNode a, MeanderNode b, double x, double z)
{
    double dx = b.x - a.x, dz = b.z - a.z, squared = dx * dx + dz * dz;
    double t = squared > 0.0 ? ((x - a.x) * dx + (z - a.z) * dz) / squared : 0.0;
    t = fmin(fmax(t, 0.0), 1.0);
    double u = a.x + t * dx - x, v = a.z + t * dz - z;
    return sqrt(u * u + v * v);
}

// Samples within `reach` of a piece of channel: least distance in `near`, if given, and `value`
// where that is less than before.
static void stamp(const HeightField *f, MeanderNode a, MeanderNode b, double reach, float *near,
                  float *value, float v)
{
    double cell = (double)f->cell.x, corner = (double)f->origin.x, last = f->columns - 1;
    int first_column = (int)fmax(floor((fmin(a.x, b.x) - reach - corner) / cell), 0.0);
    int last_column = (int)fmin(ceil((fmax(a.x, b.x) + reach - corner) / cell), last);
    int first_row = (int)fmax(floor((fmin(a.z, b.z) - reach - corner) / cell), 0.0);
    int last_row = (int)fmin(ceil((fmax(a.z, b.z) + reach - corner) / cell), last);
    for (int row = first_row; row <= last_row; row++) {
        for (int column = first_column; column <= last_column; column++) {
            int64_t i = (int64_t)row * f->columns + column;
            double d = to_piece(a, b, corner + column * cell, corner + row * cell);
            if (d > reach || (near && (float)d >= near[i])) {
                continue;
            }
            if (near) {
                near[i] = (float)d;
            }
            if (value) {
                value[i] = v;
            }
        }
    }
}

// Nodes run along z from anywhere; the square is from -half to half.
static void stamp_line(const Plain *plain, const MeanderNode *node, int64_t count, bool closed,
                       double reach, float *near, float *value, float v)
{
    double size = (double)plain->p->size;
    for (int64_t i = 0; i < count - (closed ? 0 : 1); i++) {
        MeanderNode a = node[i], b = node[(i + 1) % count];
        b.z += i + 1 == count ? size : 0.0;
        double turns = floor(a.z / size + 0.5);
        for (int k = -1; k <= 1; k++) {
            double move = (k - turns) * size;
            stamp(plain->field, (MeanderNode){a.x, a.z + move}, (MeanderNode){b.x, b.z + move},
                  reach, near, value, v);
        }
    }
}

static bool wander(Plain *plain, Meander *m, const Run *run, Error *e)
{
    double whole = AGE * (double)plain->p->meander.age;
    int64_t parts = (int64_t)(whole / STAMP) + 1;
    for (int64_t n = 0; n < parts; n++) {
        run_progress(run, "river", (double)n / (double)parts);
        if (!meander_run(m, STAMP, run, e)) {
            return false;
        }
        stamp_line(plain, m->node, m->count, true, 0.5 * m->width, NULL, plain->left,
                   (float)m->time);
    }
    double reach = 1.5 * m->width;
    stamp_line(plain, m->node, m->count, true, reach, plain->river, NULL, 0.0f);
    for (int64_t i = 0; i < m->oxbows; i++) {
        if (m->time - m->oxbow[i].time < FILL) {
            stamp_line(plain, m->oxbow[i].node, m->oxbow[i].count, false, 0.75 * m->width,
                       plain->lake, plain->cut, (float)m->oxbow[i].time);
        }
    }
    return true;
}

// m above the floodplain of the hills beside it.
static float hills(const Plain *plain, float x, float z)
{
    const TerrainParams *p = plain->p;
    uint64_t key = random_key(plain->terrain->seed, STREAM_PLAIN);
    float half = 0.5f * p->size, scale = 8.0f / p->size;
    float n = sparse_noise_fractal(scale * x, scale * z, 5, 0.5f, 0.0f, key);
    float edge = half * p->meander.plain + 0.02f * p->size * n;
    float t = (fabsf(x) - edge) / (half * (1.15f - p->meander.plain));
    t = clampf(t, 0.0f, 1.0f);
    return p->relief * t * t * (3.0f - 2.0f * t) * (0.8f + 0.2f * n);
}

// Ground that the channel left `since` ago, above the water.
static float bar(float since, float width)
{
    float grown = since / (since + (float)BARS), sine, cosine;
    exact_sincos(since * 6.2831853f / (float)SCROLLS, &sine, &cosine);
    float fades = (float)BARS * 3.0f / (since + (float)BARS * 3.0f);
    return BANK * width * (0.08f + 0.92f * grown + 0.16f * sine * grown * fades);
}

static void lay_sample(const Plain *plain, const Meander *m, int64_t i)
{
    HeightField *f = plain->field;
    int64_t row = i / f->columns;
    float x = f->origin.x + (float)(i % f->columns) * f->cell.x;
    float z = f->origin.y + (float)row * f->cell.y, width = (float)m->width;
    uint64_t key = random_key(plain->terrain->seed, STREAM_NOISE);
    float rough = sparse_noise_fractal(x / width, z / width, 4, 0.5f, 0.0f, key);
    float since = plain->left[i] < 0.0f ? (float)AGE : (float)m->time - plain->left[i];
    float hill = hills(plain, x, z);
    float ground = bar(since, width) + 0.004f * width * rough * (since / (since + 2.0f)) + hill;
    ground = fmaxf(ground, 0.002f * width);
    float age = 0.74f * since / (since + 9.0f);
    float u = plain->river[i] / (0.5f * width), o = plain->lake[i] / (0.5f * width);
    bool wet = false;
    if (u < 1.0f) {
        ground = -DEPTH * width * (1.0f - u * u);
        age = 0.0f;
        wet = true;
    } else if (o < 1.0f && plain->left[i] < plain->cut[i] + 0.5f) {
        float filled = ((float)m->time - plain->cut[i]) / (float)FILL;
        float narrow = o / fmaxf(1.0f - filled, 0.05f);
        ground = fminf(ground, BANK * width * 0.7f * (o * o - 1.0f) + 0.3f * BANK * width * filled);
        ground = narrow < 1.0f ? -DEPTH * width * 0.6f * (1.0f - narrow * narrow)
                               : fmaxf(ground, 0.003f * width);
        wet = narrow < 1.0f;
    }
    float plane = -plain->p->meander.slope * z;
    f->height[i] = ground + plane;
    f->age[i] = hill > 0.02f * plain->p->relief ? 0.8f : age;
    f->water[i] = u < 3.0f || o < 1.5f ? plane : -INFINITY;
    f->wetness[i] = wet ? 1.0f : clampf(1.0f - ground / (0.5f * BANK * width), 0.0f, 0.9f);
    f->loose[i] = hill > 0.0f ? 0.5f : DEPTH * width;
}

static bool make_arrays(Plain *plain, Error *e)
{
    const TerrainParams *p = plain->p;
    float cell = p->size / (float)p->resolution, corner = -0.5f * p->size;
    HeightField *f = height_field_new(p->resolution + 1, p->resolution + 1, (Vec2){cell, cell},
                                      (Vec2){corner, corner}, e);
    plain->field = f;
    if (!f) {
        return false;
    }
    int64_t count = height_field_count(f);
    float **arrays[] = {&f->wetness,   &f->age,      &f->water,    &f->loose,
                        &plain->river, &plain->lake, &plain->left, &plain->cut};
    for (int k = 0; k < 8; k++) {
        *arrays[k] = memory_alloc(count, sizeof(float), e);
        if (!*arrays[k]) {
            return false;
        }
        for (int64_t i = 0; k >= 4 && i < count; i++) {
            (*arrays[k])[i] = k < 6 ? 1e30f : -1.0f;
        }
    }
    return true;
}

bool terrain_grow_meander(Terrain *terrain, const Run *run, Error *e)
{
    TerrainParams p = terrain_params_resolve(terrain->params);
    Plain plain = {.terrain = terrain, .p = &p};
    uint64_t key = random_key(terrain->seed, STREAM_MEANDER);
    Meander *m = meander_new((double)p.meander.width, (double)p.size, 0.3, key, e);
    terrain->meander = m;
    bool done = m && make_arrays(&plain, e);
    terrain->plain = plain.field;
    if (done) {
        m->contrast = 0.5;
        m->reach = 0.5 * (double)(p.size * p.meander.plain) - m->width;
        done = wander(&plain, m, run, e);
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int64_t i = 0; i < (done ? height_field_count(plain.field) : 0); i++) {
        lay_sample(&plain, m, i);
    }
    free(plain.left);
    free(plain.river);
    free(plain.lake);
    free(plain.cut);
    return done;
}

void terrain_sample_meander(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    const HeightField *plain = terrain->plain;
    (void)x;
    (void)z;
    field->height[i] = plain->height[i];
    field->wetness[i] = plain->wetness[i];
    field->age[i] = plain->age[i];
    field->water[i] = plain->water[i];
    field->loose[i] = plain->loose[i];
}

// Leopold and Wolman 1960: meanders are 7 to 15 widths long.
bool terrain_measure_meander(const Terrain *terrain, MeasureList *list, Error *e)
{
    const Meander *m = terrain->meander;
    int64_t open = 0;
    for (int64_t i = 0; i < m->oxbows; i++) {
        open += m->time - m->oxbow[i].time < FILL;
    }
    return measures_add(list, "sinuosity", meander_sinuosity(m), "", 1.3, 4, e) &&
           measures_add(list, "wavelength_ratio", meander_wavelength(m), "", 5, 15, e) &&
           measures_add(list, "oxbows", (double)open, "", (double)NAN, (double)NAN, e);
}
