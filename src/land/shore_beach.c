// Beaches. Sand drifts along the shore to where waves are weak, until the shore's beach stands the
// farther out the less energy comes: so width = beach - spread * energy, and the pool of sand tells
// `beach`. Its face falls from the berm at the slope that waves and grains make, to the platform.
#include "base/memory.h"
#include "land/shore_parts.h"

#include <math.h>
#include <stdlib.h>

// m of beach between places of energy 0 and 1: three times its face.
static double spread_of(const Shore *shore)
{
    return 3.0 * (shore->berm + shore->high) / shore_beach_slope(&shore->params, 1.0);
}

double shore_beach_width(const Shore *shore, const WavesAt *waves)
{
    return shore->beach - spread_of(shore) * waves->shore;
}

// What the sand at each sample depends on, but for Shore.beach.
typedef struct Beds {
    float *out;  // m by which the waves hold the beach back; INFINITY where no sand can lie
    float *fall; // tangent of the beach's face
    double *row; // room for sums
} Beds;

static bool beds_init(Beds *b, const Shore *shore, const Landscape *land, const Run *run, Error *e)
{
    const double far = 300.0; // m from the cliff: the deep
    int64_t count = landscape_count(land);
    *b = (Beds){.out = memory_alloc(count, sizeof *b->out, e),
                .fall = memory_alloc(count, sizeof *b->fall, e),
                .row = memory_alloc(land->side, sizeof *b->row, e)};
    if (!b->out || !b->fall || !b->row) {
        return false;
    }
    double spread = spread_of(shore);
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            b->out[i] = INFINITY;
            if (shore->front[i] <= 0.0 && shore->front[i] > -far) {
                WavesAt waves = shore_waves_at(shore, land, column, row);
                b->out[i] = (float)(spread * waves.shore);
                b->fall[i] = (float)shore_beach_slope(&shore->params, waves.shore);
            }
        }
    }
    return true;
}

// Makes the face as steep as it should be where the beach's edge runs obliquely to the cliff, too.
static void ease(Beds *b, const Shore *shore, const Landscape *land, int threads)
{
    int side = land->side;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 1; row < side - 1; row++) {
        for (int column = 1; column < side - 1; column++) {
            int64_t i = (int64_t)row * side + column;
            double x =
                (double)(b->out[i + 1] - b->out[i - 1]) - shore->front[i + 1] + shore->front[i - 1];
            double z = (double)(b->out[i + side] - b->out[i - side]) - shore->front[i + side] +
                       shore->front[i - side];
            double steep = 0.5 * sqrt(x * x + z * z) / land->cell;
            if (b->out[i] < INFINITY && steep > 1.0 && steep < 20.0) {
                b->fall[i] = (float)((double)b->fall[i] / steep);
            }
        }
    }
}

static void beds_clear(Beds *b)
{
    free(b->out);
    free(b->fall);
    free(b->row);
}

// Lays the sand of this beach; m^3.
static double fill(Shore *shore, const Landscape *land, double beach, const Beds *b, int threads)
{
    const double behind = 0.02; // slope of the wind's sand behind the berm
    shore->beach = beach;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < land->side; row++) {
        b->row[row] = 0.0;
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            shore->sand[i] = 0.0;
            if (b->out[i] < INFINITY) {
                double beyond = -shore->front[i] - (beach - (double)b->out[i]);
                double top = shore->berm - (beyond > 0.0 ? (double)b->fall[i] : behind) * beyond;
                double depth = top - land->rock[i] - land->loose[i];
                shore->sand[i] = depth > 0.0 ? depth : 0.0;
                b->row[row] += shore->sand[i];
            }
        }
    }
    double sum = 0.0;
    for (int row = 0; row < land->side; row++) {
        sum += b->row[row];
    }
    return sum * land->cell * land->cell;
}

bool shore_find_beach(Shore *shore, const Landscape *land, int rounds, const Run *run, Error *e)
{
    Beds beds;
    bool done = beds_init(&beds, shore, land, run, e);
    if (done) {
        ease(&beds, shore, land, run->threads);
        double low = -shore->berm / shore_beach_slope(&shore->params, 1.0) - 300.0;
        double high = 2.0 * spread_of(shore);
        for (int k = 0; k < rounds; k++) {
            double middle = 0.5 * (low + high);
            bool much = fill(shore, land, middle, &beds, run->threads) > shore->pool;
            high = much ? middle : high;
            low = much ? low : middle;
        }
        fill(shore, land, low, &beds, run->threads); // at most the pool
    }
    beds_clear(&beds);
    return done;
}

bool shore_lay_beach(Shore *shore, Landscape *land, const Run *run, Error *e)
{
    enum { ROUNDS = 36 };
    if (!shore_find_waves(shore, land, e) || !shore_find_beach(shore, land, ROUNDS, run, e)) {
        return false;
    }
    double laid = 0.0, own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->loose[i] += shore->sand[i];
        laid += shore->sand[i] * own;
    }
    land->outflow += shore->pool - laid;
    shore->pool = 0.0;
    return true;
}
