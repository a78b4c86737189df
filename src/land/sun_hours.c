// The sun's places are counted by azimuth and altitude once; a sample then only needs its horizon
// in each of these azimuths. Horizons come from sweeps of parallel lines over the field, each with
// the upper hull of what lies ahead (Timonen and Westerholm, "Scalable Height Field
// Self-Shadowing", Computer Graphics Forum 29(2), 2010), so the work is linear in the samples.
#include "land/sun_hours.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

enum { DIRECTIONS = 64, ALTITUDES = 1024, DAYS = 365, EQUINOX = 80 };

static const double TURN = 6.283185307179586;

// Hours a day in which the sun is above an altitude, by its azimuth (clockwise from north) and the
// altitude's sine.
typedef struct SunPlaces {
    float hours[DIRECTIONS][ALTITUDES + 1];
} SunPlaces;

static void count_place(SunPlaces *places, double east, double north, double sine, double hours)
{
    double azimuth = (double)exact_atan2((float)east, (float)north) / TURN;
    double at = (azimuth < 0.0 ? azimuth + 1.0 : azimuth) * DIRECTIONS;
    int k = (int)at, bin = (int)(sine * ALTITUDES);
    bin = bin < ALTITUDES ? bin : ALTITUDES - 1;
    places->hours[k % DIRECTIONS][bin] += (float)(hours * (1.0 - (at - k)));
    places->hours[(k + 1) % DIRECTIONS][bin] += (float)(hours * (at - k));
}

// One day, in steps at whose middles the sun is looked for; hours: of the whole day.
static void count_day(SunPlaces *places, double latitude, int day, int steps, double hours)
{
    double sine, cosine, season, unused;
    exact_sincos_double(latitude * TURN / 360.0, &sine, &cosine);
    exact_sincos_double(TURN * ((day - EQUINOX + DAYS) % DAYS) / DAYS, &season, &unused);
    double declination = 0.39779 * season; // its sine: of the ecliptic's obliquity, 23.44 degrees
    double across = sqrt(1.0 - declination * declination);
    for (int i = 0; i < steps; i++) {
        double s, c;
        exact_sincos_double(TURN * ((i + 0.5) / steps - 0.5), &s, &c);
        double up = sine * declination + cosine * across * c;
        double north = cosine * declination - sine * across * c;
        if (up > 0.0) {
            count_place(places, -across * s, north, up, hours / steps);
        }
    }
}

// Turns counts of each altitude into those above it.
static void sum_from_above(SunPlaces *places)
{
    for (int k = 0; k < DIRECTIONS; k++) {
        for (int bin = ALTITUDES - 1; bin >= 0; bin--) {
            places->hours[k][bin] += places->hours[k][bin + 1];
        }
    }
}

static void find_places(SunPlaces *places, double latitude, int day)
{
    memset(places, 0, sizeof *places);
    if (day > 0) {
        count_day(places, latitude, day, 8640, 24.0);
    } else {
        for (int d = 1; d <= DAYS; d++) {
            count_day(places, latitude, d, 720, 24.0 / DAYS);
        }
    }
    sum_from_above(places);
}

// Hours that a horizon of this slope leaves of one azimuth.
static float hours_above(const float hours[ALTITUDES + 1], float slope)
{
    slope = slope > 0.0f ? slope : 0.0f;
    float at = (float)ALTITUDES * slope / sqrtf(1.0f + slope * slope);
    int bin = at < (float)(ALTITUDES - 1) ? (int)at : ALTITUDES - 1;
    return lerpf(hours[bin], hours[bin + 1], at - (float)bin);
}

// ---- one azimuth

// Parallel lines, one step long from sample to sample of the main axis. Line b is at
// b + slant * main on the other axis.
typedef struct Sweep {
    const HeightField *field;
    const float *hours;     // of the azimuth
    int count, others;      // samples on the main axis and across
    int64_t stride, across; // of them
    bool ahead;             // the sun is toward growing indices of the main axis
    float slant;            // samples across for each along
    float step;             // m
    float *sum;
} Sweep;

static Sweep sweep_of(const HeightField *field, double sine, double cosine)
{
    double u = sine / (double)field->cell.x, v = -cosine / (double)field->cell.y; // samples a metre
    Sweep s = {.field = field};
    if (fabs(u) >= fabs(v)) {
        s.count = field->columns, s.others = field->rows;
        s.stride = 1, s.across = field->columns;
        s.ahead = u > 0.0, s.slant = (float)(v / u), s.step = (float)(1.0 / fabs(u));
    } else {
        s.count = field->rows, s.others = field->columns;
        s.stride = field->columns, s.across = 1;
        s.ahead = v > 0.0, s.slant = (float)(u / v), s.step = (float)(1.0 / fabs(v));
    }
    return s;
}

// Where a line passes a step of the main axis: `share` of the way from one sample across to the
// next. The slant is split alike for all lines, so that rounding shifts none against its neighbour.
typedef struct Crossing {
    int main, low;
    float share;
} Crossing;

static Crossing crossing_of(const Sweep *s, int line, int main)
{
    float way = s->slant * (float)main, whole = floorf(way);
    return (Crossing){main, line + (int)whole, way - whole};
}

// The height there: between two samples, or the one that there is.
static float height_at_crossing(const Sweep *s, Crossing at)
{
    const float *h = s->field->height + at.main * s->stride;
    int next = at.low + 1 < s->others ? at.low + 1 : at.low, low = at.low < 0 ? next : at.low;
    float from = h[low * s->across], to = h[next * s->across];
    return !isfinite(from) ? to : !isfinite(to) ? from : lerpf(from, to, at.share);
}

// Gives a line's hours to the samples beside it, each in proportion to its nearness.
static void give(const Sweep *s, Crossing at, float hours)
{
    float *sum = s->sum + at.main * s->stride;
    if (at.low >= 0) {
        sum[at.low * s->across] += (1.0f - at.share) * hours;
    }
    if (at.low + 1 < s->others) {
        sum[(at.low + 1) * s->across] += at.share * hours;
    }
}

typedef struct HullPoint {
    int at; // steps from the line's sunward end
    float height;
} HullPoint;

static float rise(HullPoint from, HullPoint to, float step)
{
    return (to.height - from.height) / ((float)(from.at - to.at) * step);
}

// From the sunward end on. hull: room for a line's points.
static void sweep_line(const Sweep *s, int line, HullPoint *hull)
{
    int last = -1;
    for (int i = 0; i < s->count; i++) {
        int main = s->ahead ? s->count - 1 - i : i;
        Crossing at = crossing_of(s, line, main);
        if (at.low < -1 || at.low >= s->others) {
            continue;
        }
        HullPoint here = {i, height_at_crossing(s, at)};
        if (!isfinite(here.height)) {
            continue;
        }
        while (last > 0 && rise(here, hull[last], s->step) <= rise(here, hull[last - 1], s->step)) {
            last--;
        }
        float slope = last >= 0 ? rise(here, hull[last], s->step) : 0.0f;
        give(s, at, hours_above(s->hours, slope));
        hull[++last] = here;
    }
}

// Lines two apart share no samples: even ones first, then odd ones, so sums have one order.
static void sweep_lines(const Sweep *s, HullPoint *hull, int threads)
{
    float way = s->slant * (float)(s->count - 1);
    int low = (int)floorf(-fmaxf(way, 0.0f)) - 1;
    int high = (int)ceilf((float)s->others - fminf(way, 0.0f)) + 1;
    for (int odd = 0; odd < 2; odd++) {
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
        for (int line = low + odd; line <= high; line += 2) {
            sweep_line(s, line, hull + (int64_t)omp_get_thread_num() * s->count);
        }
    }
}

static bool sweep_all(const HeightField *field, const SunPlaces *places, HullPoint *hull,
                      float *hours, const Run *run, Error *e)
{
    for (int k = 0; k < DIRECTIONS; k++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        double sine, cosine;
        exact_sincos_double(TURN * k / DIRECTIONS, &sine, &cosine);
        Sweep s = sweep_of(field, sine, cosine);
        s.hours = places->hours[k];
        s.sum = hours;
        if (s.hours[0] > 0.0f) {
            sweep_lines(&s, hull, run->threads);
        }
    }
    return true;
}

bool sun_hours(const HeightField *field, float latitude, int day, float *hours, const Run *run,
               Error *e)
{
    int longest = field->columns > field->rows ? field->columns : field->rows;
    SunPlaces *places = memory_alloc(1, sizeof *places, e);
    HullPoint *hull = memory_alloc((int64_t)run->threads * longest, sizeof *hull, e);
    bool done = places && hull;
    if (done) {
        find_places(places, (double)latitude, day);
        memset(hours, 0, sizeof *hours * (size_t)height_field_count(field));
        done = sweep_all(field, places, hull, hours, run, e);
    }
    for (int64_t i = 0; done && i < height_field_count(field); i++) {
        hours[i] = isfinite(field->height[i]) ? hours[i] : NAN;
    }
    free(hull);
    free(places);
    return done;
}
