// Crests without the steps of the grid: the mean along each crest. Its direction is that of the
// structure tensor, as in coherence-enhancing diffusion (Weickert 1999, Int. J. Comput. Vis. 31).
#include "base/exact_math.h"
#include "base/memory.h"
#include "land/dunes_parts.h"

#include <stdlib.h>
#include <string.h>

#define FLAT 1e-4 // square of a slope that is too gentle to tell a direction

enum { PASSES = 10, REACH = 10 };
static const double SPREAD = 4.0; // cells: standard deviation of the weights along a crest

// Products of slopes: 3 a sample, xx, xz, zz.
static void find_products(const Dunes *dunes, double *tensor, const Run *run)
{
    int side = dunes->side, mask = side - 1;
    const double *h = dunes->sand;
#pragma omp parallel for schedule(static) num_threads(dunes_threads(dunes, run))
    for (int row = 0; row < side; row++) {
        int64_t at = (int64_t)row * side, north = (int64_t)((row - 1) & mask) * side;
        int64_t south = (int64_t)((row + 1) & mask) * side;
        for (int x = 0; x < side; x++) {
            double dx = (h[at + ((x + 1) & mask)] - h[at + ((x - 1) & mask)]) / (2.0 * dunes->cell);
            double dz = (h[south + x] - h[north + x]) / (2.0 * dunes->cell);
            double *t = &tensor[3 * (at + x)];
            t[0] = dx * dx;
            t[1] = dx * dz;
            t[2] = dz * dz;
        }
    }
}

// One binomial pass along an axis: `step` samples from one to the next.
static void blur_once(const Dunes *dunes, const double *from, double *to, bool down, const Run *run)
{
    int side = dunes->side, mask = side - 1;
#pragma omp parallel for schedule(static) num_threads(dunes_threads(dunes, run))
    for (int row = 0; row < side; row++) {
        for (int x = 0; x < side; x++) {
            int64_t i = (int64_t)row * side + x;
            int64_t a = down ? (int64_t)((row - 1) & mask) * side + x
                             : (int64_t)row * side + ((x - 1) & mask);
            int64_t b = down ? (int64_t)((row + 1) & mask) * side + x
                             : (int64_t)row * side + ((x + 1) & mask);
            for (int k = 0; k < 3; k++) {
                to[3 * i + k] = 0.25 * (from[3 * a + k] + from[3 * b + k]) + 0.5 * from[3 * i + k];
            }
        }
    }
}

// The mean along the crest at a sample, as far as slopes around it have one direction.
static double mean_along(const Dunes *dunes, const double tensor[3], int column, int row,
                         const double weight[REACH + 1])
{
    double here = dunes->sand[(int64_t)row * dunes->side + column];
    double d = tensor[0] - tensor[2], b = 2.0 * tensor[1], r = sqrt(d * d + b * b);
    double down_x = d >= 0.0 ? d + r : b, down_z = d >= 0.0 ? b : r - d;
    double size = sqrt(down_x * down_x + down_z * down_z);
    if (!(size > 0.0)) {
        return here;
    }
    double x = column * dunes->cell, z = row * dunes->cell;
    double step_x = -down_z / size * dunes->cell, step_z = down_x / size * dunes->cell;
    double sum = weight[0] * here, coherence = r / (tensor[0] + tensor[2] + FLAT);
    for (int k = 1; k <= REACH; k++) {
        sum += weight[k] * (dunes_at(dunes, x + k * step_x, z + k * step_z) +
                            dunes_at(dunes, x - k * step_x, z - k * step_z));
    }
    return here + coherence * coherence * (sum - here);
}

// Weights of the samples on each side; all of them, the middle once, add up to 1.
static void fill_weights(double weight[REACH + 1])
{
    double sum = 0.0;
    for (int k = 0; k <= REACH; k++) {
        weight[k] = exact_exp(-0.5 * k * k / (SPREAD * SPREAD));
        sum += k == 0 ? weight[k] : 2.0 * weight[k];
    }
    for (int k = 0; k <= REACH; k++) {
        weight[k] /= sum;
    }
}

bool dunes_straighten(Dunes *dunes, const Run *run, Error *e)
{
    int64_t count = dunes_count(dunes);
    double *tensor = memory_alloc(3 * count, sizeof *tensor, e);
    double *work = tensor ? memory_alloc(3 * count, sizeof *work, e) : NULL;
    if (!work) {
        free(tensor);
        return false;
    }
    double weight[REACH + 1], before = dunes_volume(dunes);
    fill_weights(weight);
    find_products(dunes, tensor, run);
    for (int pass = 0; pass < PASSES; pass++) {
        blur_once(dunes, tensor, work, false, run);
        blur_once(dunes, work, tensor, true, run);
    }
#pragma omp parallel for schedule(static) num_threads(dunes_threads(dunes, run))
    for (int row = 0; row < dunes->side; row++) {
        for (int x = 0; x < dunes->side; x++) {
            int64_t i = (int64_t)row * dunes->side + x;
            work[i] = fmax(mean_along(dunes, &tensor[3 * i], x, row, weight), 0.0);
        }
    }
    memcpy(dunes->sand, work, (size_t)count * sizeof *work);
    double after = dunes_volume(dunes);
    for (int64_t i = 0; after > 0.0 && i < count; i++) {
        dunes->sand[i] *= before / after;
    }
    free(tensor);
    free(work);
    return true;
}
