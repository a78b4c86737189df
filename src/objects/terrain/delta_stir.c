// What a delta's water carries, in fine detail: eddies stir the plumes of its mouths, ribbons of
// more and less mud are drawn out along the flow, and marsh tints what stands in it with peat.
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/delta.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FINE = 6, STEPS = 34, SHELTER = 3 }; // samples a cell; steps back; cells

static const float STEP = 0.5f; // cells

typedef struct Stir {
    const DeltaLand *land;
    const float *shelter; // of each cell of the model: share of land about it
    float amount;
    uint64_t seed;
} Stir;

// Eddies of three sizes: the curl of a potential, so that water neither gathers nor is lost.
static Vec2 eddies_at(const Stir *s, Vec2 at)
{
    const float size[3] = {15.0f, 7.0f, 3.1f}, strength[3] = {1.0f, 0.75f, 0.45f}, d = 0.06f;
    Vec2 sum = {0.0f, 0.0f};
    for (int k = 0; k < 3; k++) {
        uint64_t key = random_key(s->seed, (uint64_t)k);
        float x = at.x / size[k], z = at.y / size[k];
        float here = noise_plane(x, z, key);
        sum.x += strength[k] * (noise_plane(x, z + d, key) - here) / d;
        sum.y -= strength[k] * (noise_plane(x + d, z, key) - here) / d;
    }
    return sum;
}

// m of water, of the river's depth.
static float depth_at(const DeltaLand *land, Vec2 at)
{
    return (delta_land_at(land, land->level, at.x, at.y) -
            delta_land_at(land, land->ground, at.x, at.y)) /
           (float)land->model->depth;
}

// Eddies need room: none are in channels and at shores.
static float room_at(const Stir *s, Vec2 at)
{
    float levee = delta_land_at(s->land, s->land->levee, at.x, at.y);
    return s->amount * (1.0f - smoothstepf(0.0f, 0.8f, levee)) *
           smoothstepf(0.0f, 0.35f, depth_at(s->land, at));
}

// Where water has come from, by eddies alone, and by the flow, too.
static void trace_back(const Stir *s, Vec2 at, Vec2 *stirred, Vec2 *origin)
{
    const DeltaLand *land = s->land;
    *stirred = *origin = at;
    for (int n = 0; n < STEPS; n++) {
        float room = 0.55f * STEP * room_at(s, *stirred);
        if (room > 0.0f) {
            Vec2 eddy = eddies_at(s, *stirred);
            *stirred = (Vec2){stirred->x - room * eddy.x, stirred->y - room * eddy.y};
        }
        room = 0.55f * STEP * room_at(s, *origin);
        Vec2 eddy = room > 0.0f ? eddies_at(s, *origin) : (Vec2){0.0f, 0.0f};
        float x = delta_land_at(land, land->way_x, origin->x, origin->y);
        float z = delta_land_at(land, land->way_z, origin->x, origin->y);
        *origin =
            (Vec2){origin->x - STEP * x - room * eddy.x, origin->y - STEP * z - room * eddy.y};
    }
}

// Mud, of the river's; above 1, peat: 2 = none but that.
static float stirred_load(const Stir *s, Vec2 at)
{
    const DeltaLand *land = s->land;
    Vec2 stirred, origin;
    trace_back(s, at, &stirred, &origin);
    float load = delta_land_at(land, land->load, stirred.x, stirred.y);
    uint64_t key = random_key(s->seed, 11);
    float broad = noise_plane_fractal(origin.x / 5.0f, origin.y / 5.0f, 2, key);
    float ribbon = noise_plane_fractal(origin.x / 1.3f, origin.y / 1.3f, 4, random_key(key, 1));
    load = fminf(load, 1.0f) * (1.0f + s->amount * (0.55f * broad + 0.55f * ribbon - 0.12f));
    load = clampf(load, 0.0f, 1.0f);
    load = lerpf(load, delta_settled(load), s->amount);
    float levee = delta_land_at(land, land->levee, at.x, at.y);
    float shelter = delta_land_at(land, s->shelter, stirred.x, stirred.y) + 0.12f * ribbon;
    float peat =
        s->amount * smoothstepf(0.42f, 0.72f, shelter) * (1.0f - smoothstepf(0.25f, 0.9f, levee));
    return lerpf(load, 2.0f, peat);
}

// Over a square.
static float mean_about(const Delta *d, const float *field, int64_t i)
{
    int64_t column = delta_column(d, i), row = delta_row(d, i), count = 0;
    float sum = 0.0f;
    for (int64_t r = row - SHELTER; r <= row + SHELTER; r++) {
        for (int64_t c = column - SHELTER; c <= column + SHELTER; c++) {
            if (c >= 0 && r >= 0 && c < d->columns && r < d->rows) {
                sum += field[r * d->columns + c];
                count++;
            }
        }
    }
    return sum / (float)count;
}

static bool is_land(const Delta *d, int64_t i)
{
    return d->kind[i] == DELTA_PLAIN ||
           (d->kind[i] == DELTA_OPEN && d->level[i] - d->bed[i] <= DELTA_FALL * d->depth);
}

// Means over squares of means over squares.
static bool find_shelter(const Delta *d, float *shelter, Error *e)
{
    float *own = memory_alloc(delta_count(d), sizeof *own, e);
    for (int64_t i = 0; own && i < delta_count(d); i++) {
        shelter[i] = is_land(d, i) ? 1.0f : 0.0f;
    }
    for (int n = 0; own && n < 2; n++) {
        memcpy(own, shelter, (size_t)delta_count(d) * sizeof *own);
        for (int64_t i = 0; i < delta_count(d); i++) {
            shelter[i] = mean_about(d, own, i);
        }
    }
    bool done = own;
    free(own);
    return done;
}

bool delta_stir(DeltaLand *land, float amount, uint64_t seed, const Run *run, Error *e)
{
    land->fine_columns = land->model->columns * FINE + 1;
    land->fine_rows = land->model->rows * FINE + 1;
    int64_t count = (int64_t)land->fine_columns * land->fine_rows;
    float *shelter = memory_alloc(delta_count(land->model), sizeof *shelter, e);
    land->fine_load = shelter ? memory_alloc(count, sizeof(float), e) : NULL;
    bool done = land->fine_load && find_shelter(land->model, shelter, e);
    if (done) {
        Stir s = {land, shelter, amount, seed};
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
        for (int row = 0; row < land->fine_rows; row++) {
            for (int column = 0; column < land->fine_columns; column++) {
                Vec2 at = {(float)column / FINE, (float)row / FINE};
                bool wet = depth_at(land, at) > -0.15f;
                land->fine_load[(int64_t)row * land->fine_columns + column] =
                    wet ? stirred_load(&s, at) : 2.0f;
            }
        }
    }
    free(shelter);
    return done;
}

// Bilinear.
float delta_stirred_at(const DeltaLand *land, Vec2 at)
{
    float u = clampf(FINE * at.x, 0.0f, (float)(land->fine_columns - 1));
    float v = clampf(FINE * at.y, 0.0f, (float)(land->fine_rows - 1));
    int c = (int)u, r = (int)v;
    c = c > land->fine_columns - 2 ? land->fine_columns - 2 : c;
    r = r > land->fine_rows - 2 ? land->fine_rows - 2 : r;
    const float *p = land->fine_load + (int64_t)r * land->fine_columns + c, *q;
    q = p + land->fine_columns;
    u -= (float)c;
    v -= (float)r;
    return lerpf(lerpf(p[0], p[1], u), lerpf(q[0], q[1], u), v);
}
