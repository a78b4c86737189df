// The gravel: bed load along the flow and down the slope of the bed.
#include "land/braid_parts.h"

#define BEND_MOST 0.6f // tangent of the load's deviation in the sharpest bends
#define STEEPEST 1.0f  // slope of banks beyond which they cave in no faster

// Roots hold old banks.
static inline float softness(float erodible, float age)
{
    const float half = 8.0f; // turnovers in which plants take half of what they can hold
    return erodible * (1.0f - (float)BRAID_ROOTS * age / (age + half));
}

// The direction of the flow in a row, into the work arrays of the flow: unit vectors, 0 where it is
// dry or at rest.
static void direct_row(Braid *b, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, south = (int64_t)((row + 1) % side) * side;
    const float *x = b->flow_x + here, *z = b->flow_z + here, *zs = b->flow_z + south;
    float *to_x = b->next_x + here, *to_z = b->next_z + here, dry = (float)(BRAID_DRY * b->mean);
    int begin = b->span[row].begin, end = b->span[row].end;
#pragma omp simd
    for (int c = begin; c < end; c++) {
        float qx = 0.5f * (x[c] + (c + 1 < side ? x[c + 1] : 0.0f)), qz = 0.5f * (z[c] + zs[c]);
        float amount = sqrtf(qx * qx + qz * qz);
        float scale = amount > 0.0f && b->depth[here + c] > dry ? 1.0f / amount : 0.0f;
        to_x[c] = qx * scale;
        to_z[c] = qz * scale;
    }
}

// Half the difference of two neighbours' directions along one axis; one that is dry counts as the
// cell's own.
static inline float turn_between(float before, float own, float after, float wet_before,
                                 float wet_after)
{
    float first = wet_before > 0.0f ? before : own, last = wet_after > 0.0f ? after : own;
    return 0.5f * (last - first);
}

// In bends the flow near the bed heads inward (by BRAID_SPIRAL * depth / radius),
// and takes the load along: outer banks wear, points grow. Turns the load of a row.
static void bend_row(Braid *b, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, north = (int64_t)((row + side - 1) % side) * side;
    int64_t south = (int64_t)((row + 1) % side) * side;
    const float *x = b->next_x, *z = b->next_z, *depth = b->depth + here;
    float *load_x = b->load + here, *load_z = load_x + braid_count(b);
    const float *load_all = load_z + braid_count(b);
    float scale = (float)(BRAID_SPIRAL / b->cell);
    int begin = b->span[row].begin, end = b->span[row].end;
    begin = begin > 1 ? begin : 1;
    end = end < side - 1 ? end : side - 1;
#pragma omp simd
    for (int c = begin; c < end; c++) {
        int64_t i = here + c, w = i - 1, e = i + 1, n = north + c, s = south + c;
        float dx = x[i], dz = z[i];
        float wet_w = fabsf(x[w]) + fabsf(z[w]), wet_e = fabsf(x[e]) + fabsf(z[e]);
        float wet_n = fabsf(x[n]) + fabsf(z[n]), wet_s = fabsf(x[s]) + fabsf(z[s]);
        float along_x = dx * turn_between(z[w], dz, z[e], wet_w, wet_e) +
                        dz * turn_between(z[n], dz, z[s], wet_n, wet_s);
        float along_z = dx * turn_between(x[w], dx, x[e], wet_w, wet_e) +
                        dz * turn_between(x[n], dx, x[s], wet_n, wet_s);
        float turn = scale * depth[c] * (dx * along_x - dz * along_z);
        turn = turn > BEND_MOST ? BEND_MOST : turn < -BEND_MOST ? -BEND_MOST : turn;
        load_x[c] -= turn * load_all[c] * dz;
        load_z[c] += turn * load_all[c] * dx;
    }
}

// Fills b->share with how soft the ground is, for move_row.
static void load_row(Braid *b, float scale, float aged, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, south = (int64_t)((row + 1) % side) * side;
    const float *x = b->flow_x + here, *z = b->flow_z + here, *zs = b->flow_z + south;
    float *load_x = b->load + here, *load_z = load_x + braid_count(b);
    float *load_all = load_z + braid_count(b), *age = b->age + here;
    float least = 0.05f * (float)b->mean;
    int begin = b->span[row].begin, end = b->span[row].end;
    for (int c = 0; c < begin; c++) {
        age[c] += aged;
    }
    for (int c = end; c < side; c++) {
        age[c] += aged;
    }
#pragma omp simd
    for (int c = begin; c < end; c++) {
        float depth = b->depth[here + c] > least ? b->depth[here + c] : least;
        float qx = 0.5f * (x[c] + (c + 1 < side ? x[c + 1] : 0.0f)), qz = 0.5f * (z[c] + zs[c]);
        float amount = sqrtf(qx * qx + qz * qz), speed = amount / depth;
        float shear = scale * speed * speed, load = braid_load_of(shear);
        float along = amount > 0.0f ? load / amount : 0.0f;
        b->shear[here + c] = shear;
        load_x[c] = along * qx;
        load_z[c] = along * qz;
        load_all[c] = load;
        age[c] = load > 0.0f ? 0.0f : age[c] + aged;
        b->share[here + c] = softness(b->erodible[here + c], age[c]);
    }
}

void braid_find_load(Braid *b, int threads)
{
    // Shear over that of even flow: speed^2 over Froude^2 * g * mean.
    float scale = (float)(1.0 / (BRAID_FROUDE * BRAID_FROUDE * BRAID_GRAVITY * b->mean));
    float aged = (float)braid_update_turnovers(b);
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            load_row(b, scale, aged, row);
            direct_row(b, row);
        }
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            bend_row(b, row);
        }
    }
}

// The load through the sides of `count` cells along an axis, from each cell of index from + n to
// that of index to + n. load: along the axis, of the cell that it leaves. Rows are worked on by
// several threads, so each side has its own place to write to.
static void load_between(const Braid *b, int64_t from, int64_t to, int count, const float *load,
                         float *through)
{
    const float *load_all = b->load + 2 * braid_count(b), *ground = b->ground;
    const float *erodible = b->erodible, *soft = b->share;
    float aside = (float)(BRAID_DEFLECTION / b->slope), cell = (float)b->cell;
#pragma omp simd
    for (int n = 0; n < count; n++) {
        int64_t i = from + n, j = to + n;
        float first = load[i] * erodible[i], second = load[j] * erodible[j];
        float carried = first + second > 0.0f ? first : second;
        float most = load_all[i] > load_all[j] ? load_all[i] : load_all[j];
        float fall = (ground[i] - ground[j]) / cell;
        fall = fall > STEEPEST ? STEEPEST : fall < -STEEPEST ? -STEEPEST : fall;
        float softer = fall > 0.0f ? soft[i] : soft[j];
        through[n] = carried + aside * softer * most * fall;
    }
}

// The load through the west and the north sides of a row's cells, into the work arrays of the
// flow.
static void load_through_row(Braid *b, int row)
{
    int side = b->side, begin = b->span[row].begin, end = b->span[row].end;
    int64_t here = (int64_t)row * side, north = (int64_t)((row + side - 1) % side) * side;
    int west = begin > 1 ? begin : 1;
    b->next_x[here] = 0.0f;
    load_between(b, here + west - 1, here + west, end - west, b->load, b->next_x + here + west);
    load_between(b, north + begin, here + begin, end - begin, b->load + braid_count(b),
                 b->next_z + here + begin);
}

static void move_row(Braid *b, double scale, int row)
{
    int side = b->side, begin = b->span[row].begin, end = b->span[row].end;
    int64_t here = (int64_t)row * side, south = (int64_t)((row + 1) % side) * side;
    const float *x = b->next_x + here, *z = b->next_z + here, *zs = b->next_z + south;
#pragma omp simd
    for (int c = begin; c < end; c++) {
        double in = (double)z[c] - (double)zs[c] + (double)x[c];
        in -= c + 1 < side ? (double)x[c + 1] : 0.0;
        b->bed[here + c] += scale * in;
        b->ground[here + c] = (float)b->bed[here + c];
    }
}

void braid_move_bed(Braid *b, int threads)
{
    double scale = braid_change(b) * b->mean / (double)braid_load_of((float)BRAID_REFERENCE);
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            load_through_row(b, row);
        }
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            move_row(b, scale, row);
        }
    }
}
