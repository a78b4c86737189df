// The gravel: bed load along the flow and down the slope of the bed.
#include "land/braid_parts.h"

#define STEEPEST 1.0f // slope of banks beyond which they cave in no faster

static void load_row(Braid *b, float scale, float aged, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, south = (int64_t)((row + 1) % side) * side;
    const float *x = b->flow_x + here, *z = b->flow_z + here, *zs = b->flow_z + south;
    float least = 0.05f * (float)b->mean;
    for (int c = 0; c < side; c++) {
        int64_t i = here + c;
        float depth = b->depth[i] > least ? b->depth[i] : least;
        float qx = 0.5f * (x[c] + (c + 1 < side ? x[c + 1] : 0.0f)), qz = 0.5f * (z[c] + zs[c]);
        float amount = sqrtf(qx * qx + qz * qz), speed = amount / depth;
        float shear = scale * speed * speed, load = braid_load_of(shear);
        float along = amount > 0.0f ? load / amount : 0.0f;
        b->shear[i] = shear;
        b->load[3 * i] = along * qx;
        b->load[3 * i + 1] = along * qz;
        b->load[3 * i + 2] = load;
        b->age[i] = load > 0.0f ? 0.0f : b->age[i] + aged;
    }
}

void braid_find_load(Braid *b, int threads)
{
    // Shear over that of even flow: speed^2 over Froude^2 * g * mean.
    float scale = (float)(1.0 / (BRAID_FROUDE * BRAID_FROUDE * BRAID_GRAVITY * b->mean));
    float aged = (float)braid_update_turnovers(b);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < b->side; row++) {
        load_row(b, scale, aged, row);
    }
}

// Roots hold old banks.
static inline float softness(const Braid *b, int64_t i)
{
    const float half = 8.0f; // turnovers in which plants take half of what they can hold
    return b->erodible[i] * (1.0f - (float)BRAID_ROOTS * b->age[i] / (b->age[i] + half));
}

// The load through the side between cells i and j, i before j along axis 0 = x or 1 = z.
static inline double load_between(const Braid *b, int64_t i, int64_t j, int axis, float flow)
{
    int64_t from = flow > 0.0f ? i : j;
    float carried = b->load[3 * from + axis] * b->erodible[from];
    float most = b->load[3 * i + 2] > b->load[3 * j + 2] ? b->load[3 * i + 2] : b->load[3 * j + 2];
    float fall = (b->ground[i] - b->ground[j]) / (float)b->cell;
    fall = fall > STEEPEST ? STEEPEST : fall < -STEEPEST ? -STEEPEST : fall;
    float soft = softness(b, fall > 0.0f ? i : j);
    float aside = (float)(BRAID_DEFLECTION / b->slope);
    return (double)(carried + aside * soft * most * fall);
}

static void move_row(Braid *b, double scale, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, north = (int64_t)((row + side - 1) % side) * side;
    int64_t south = (int64_t)((row + 1) % side) * side;
    for (int c = 0; c < side; c++) {
        int64_t i = here + c;
        double in = load_between(b, north + c, i, 1, b->flow_z[i]) -
                    load_between(b, i, south + c, 1, b->flow_z[south + c]);
        in += c > 0 ? load_between(b, i - 1, i, 0, b->flow_x[i]) : 0.0;
        in -= c + 1 < side ? load_between(b, i, i + 1, 0, b->flow_x[i + 1]) : 0.0;
        b->bed[i] += scale * in;
    }
}

void braid_move_bed(Braid *b, int threads)
{
    double scale = braid_change(b) * b->mean / (double)braid_load_of((float)BRAID_REFERENCE);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < b->side; row++) {
        move_row(b, scale, row);
    }
    braid_take_ground(b);
}
