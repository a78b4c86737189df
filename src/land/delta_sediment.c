// Sand and mud of a delta. Parcels go one after another, for each changes the bed for the next.
#include "base/random.h"
#include "land/delta_parts.h"

#include <math.h>
#include <string.h>

enum { STREAM_SEDIMENT = 2 };

// Of speeds, in that of the river: Liang et al., table 1.
static const double SAND_SCOUR = 1.05;
static const double MUD_SCOUR = 1.5;
static const double MUD_SETTLES = 0.3;
static const double MUD_FALL = 0.25;  // of the mud in still water, share that settles in a cell
static const double MUD_LOADED = 2.0; // of what the river brings: more is not scoured
static const double MOST = 0.25;      // of the depth: change of a bed by a parcel
static const double ROLL = 0.1;       // sand across the slopes of the bed, by that which goes by
static const double NEW_MEAN = 0.02;  // of a step in what the water carried of late

// m^3.
typedef struct Parcel {
    double volume, start;
    bool sand;
} Parcel;

// ---- a cell

// Speed as a power, of sand: that which the flow can carry grows with its cube.
static double cube(double speed)
{
    return speed * speed * speed;
}

static void change_bed(Delta *d, int64_t i, Parcel *parcel, double settles)
{
    double area = d->cell * d->cell, most = MOST * d->work->depth[i] * area;
    settles = settles > 0.0 ? fmin(fmin(settles, parcel->volume), most) : fmax(settles, -most);
    parcel->volume -= settles;
    d->bed[i] += settles / area;
    delta_update(d, i);
}

// What came by beyond what the flow can carry settles.
static void drop_sand(Delta *d, int64_t i, Parcel *parcel, double capacity)
{
    double speed = d->speed[i];
    d->work->sand[i] += parcel->volume;
    double over = d->work->sand[i] - capacity * cube(speed);
    if (over > 0.0) {
        change_bed(d, i, parcel, over);
    } else if (speed > SAND_SCOUR) {
        double scour = cube(speed / SAND_SCOUR) - 1.0;
        change_bed(d, i, parcel, fmax(-parcel->start * scour, over));
    }
}

static void drop_mud(Delta *d, int64_t i, Parcel *parcel)
{
    double speed = d->speed[i];
    d->work->mud[i] += parcel->volume;
    if (speed < MUD_SETTLES) {
        double share = speed / MUD_SETTLES;
        change_bed(d, i, parcel, MUD_FALL * parcel->volume * (1.0 - share * share));
    } else if (speed > MUD_SCOUR && parcel->volume < MUD_LOADED * parcel->start) {
        double share = speed / MUD_SCOUR;
        change_bed(d, i, parcel, -parcel->start * (share * share - 1.0));
    }
}

// ---- parcels

// capacity: m^3 of sand that the river's flow carries through a cell in a step.
static void walk(Delta *d, Parcel parcel, int number, double capacity)
{
    DeltaPull pull = {.inertia = 1.0, .squared = parcel.sand, .x = d->flow_x, .z = d->flow_z};
    uint64_t key = random_key(random_key(d->seed, STREAM_SEDIMENT), (uint64_t)d->step);
    key = random_key(key, (uint64_t)number);
    int64_t cell = d->inlet[number % d->inlets] + d->columns;
    for (int n = 0; n < d->work->longest && parcel.volume > 0.0; n++) {
        if (d->work->out[cell]) {
            d->left += parcel.volume;
            return;
        }
        if (d->kind[cell] == DELTA_OPEN) {
            if (parcel.sand) {
                drop_sand(d, cell, &parcel, capacity);
            } else {
                drop_mud(d, cell, &parcel);
            }
        } else {
            d->work->mud[cell] += parcel.sand ? 0.0 : parcel.volume;
        }
        int k = delta_next(d, &pull, cell, (double)random_unit(random_key(key, (uint64_t)n)));
        if (k < 0) {
            break;
        }
        int64_t next = cell + (int64_t)delta_ways[k].row * d->columns + delta_ways[k].column;
        cell = next;
    }
    // What is left of one that goes around in circles leaves, too.
    d->left += parcel.volume;
}

static void remember_mud(Delta *d, double each)
{
    for (int64_t i = 0; i < delta_count(d); i++) {
        d->mud[i] += NEW_MEAN * (each * d->work->mud[i] - d->mud[i]);
    }
}

void delta_carry(Delta *d, const DeltaRates *rates)
{
    DeltaWork *w = d->work;
    double wide = d->inlets * d->cell, brings = rates->bring * d->depth * wide * wide;
    int64_t count = delta_count(d);
    memset(w->sand, 0, (size_t)count * sizeof *w->sand);
    memset(w->mud, 0, (size_t)count * sizeof *w->mud);
    int sands = (int)(0.5 + DELTA_GRAINS * fmin(fmax(rates->sand, 0.1), 0.9));
    for (int n = 0; n < DELTA_GRAINS; n++) {
        bool sand = n < sands;
        int kin = sand ? sands : DELTA_GRAINS - sands;
        double volume = brings * (sand ? rates->sand : 1.0 - rates->sand) / kin;
        Parcel parcel = {.volume = volume, .start = volume, .sand = sand};
        d->given += volume;
        walk(d, parcel, n, brings * rates->sand / d->inlets);
    }
    double mud = brings * (1.0 - rates->sand) / d->inlets;
    remember_mud(d, mud > 0.0 ? 1.0 / mud : 0.0);
}

// ---- slopes of the bed

// m^3 from cell i to cell n, one of its neighbours along an axis.
static double rolls(const Delta *d, int64_t i, int64_t n)
{
    if (d->kind[i] != DELTA_OPEN || d->kind[n] != DELTA_OPEN) {
        return 0.0;
    }
    double moving = 0.5 * (d->work->sand[i] + d->work->sand[n]);
    return ROLL * moving * (d->bed[i] - d->bed[n]) / d->cell;
}

void delta_roll(Delta *d, const DeltaRates *rates)
{
    double *change = d->work->sum, area = d->cell * d->cell;
    (void)rates;
    memset(change, 0, (size_t)delta_count(d) * sizeof *change);
    for (int64_t i = 0; i + d->columns < delta_count(d); i++) {
        double east = i % d->columns + 1 < d->columns ? rolls(d, i, i + 1) : 0.0;
        double south = rolls(d, i, i + d->columns);
        change[i] -= east + south;
        change[i + 1] += east;
        change[i + d->columns] += south;
    }
    for (int64_t i = 0; i < delta_count(d); i++) {
        if (change[i] != 0.0) {
            d->bed[i] += change[i] / area;
            delta_update(d, i);
        }
    }
}
