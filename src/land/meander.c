#include "land/meander.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LOCAL = -1.0;   // weights of the curvature here and of that upstream
static const double UPSTREAM = 2.5; // (Howard and Knutson 1984)
static const double DECAY = 0.75;   // by the width, of the weight of places upstream
static const double SPACING = 0.5;  // of nodes, widths
static const double NECK = 1.3;     // widths between middles at which a bend is cut off
static const double CHUTE = 14.0;   // more of them where floods cut through soft ground
static const double STEP = 0.04;    // explicit steps are stable below SPACING^2 / 2

double meander_growth(double wavelength)
{
    double k = 6.283185307179586 / wavelength;
    return k * k * (LOCAL + UPSTREAM * DECAY * DECAY / (DECAY * DECAY + k * k));
}

Meander *meander_new(double width, double length, double bend, uint64_t seed, Error *e)
{
    enum { HARMONICS = 24 };
    Meander *m = memory_alloc_zero(1, sizeof *m, e);
    if (!m) {
        return NULL;
    }
    m->width = width;
    m->length = length;
    m->seed = random_key(seed, 1);
    m->count = (int64_t)(length / (SPACING * width));
    m->count = m->count < 8 ? 8 : m->count;
    m->node = memory_alloc(m->count, sizeof *m->node, e);
    m->speed = memory_alloc(m->count, sizeof *m->speed, e);
    m->capacity = m->count;
    for (int64_t i = 0; m->node && m->speed && i < m->count; i++) {
        double share = (double)i / (double)m->count, x = 0.0;
        for (int n = 1; n <= HARMONICS && n * 4 < m->count; n++) {
            double turns = n * share + (double)random_unit(random_key(seed, 100 + (uint64_t)n));
            double sine, cosine;
            exact_sincos_double((turns - floor(turns)) * 6.283185307179586, &sine, &cosine);
            x += 0.3 * bend * width * sine;
        }
        m->node[i] = (MeanderNode){x, share * length};
    }
    if (!m->node || !m->speed) {
        meander_free(m);
        return NULL;
    }
    return m;
}

void meander_free(Meander *m)
{
    for (int64_t i = 0; m && i < m->oxbows; i++) {
        free(m->oxbow[i].node);
    }
    if (m) {
        free(m->oxbow);
        free(m->speed);
        free(m->node);
        free(m);
    }
}

// Node i of the line without end.
static MeanderNode node_at(const Meander *m, int64_t i)
{
    int64_t turns = i >= 0 ? i / m->count : -((m->count - 1 - i) / m->count);
    MeanderNode node = m->node[i - turns * m->count];
    node.z += (double)turns * m->length;
    return node;
}

static double distance(MeanderNode a, MeanderNode b)
{
    double x = b.x - a.x, z = b.z - a.z;
    return sqrt(x * x + z * z);
}

// ---- the banks

// Smooth noise, -1..1, of cells four widths wide.
static double bank_noise(const Meander *m, MeanderNode p)
{
    double rows = floor(m->length / (4.0 * m->width)) + 1.0, across = p.x / (4.0 * m->width);
    double along = p.z / m->length;
    along = (along - floor(along)) * rows;
    double u = across - floor(across), v = along - floor(along), sum = 0.0;
    u = u * u * (3.0 - 2.0 * u);
    v = v * v * (3.0 - 2.0 * v);
    for (int k = 0; k < 4; k++) {
        int64_t column = (int64_t)floor(across) + k % 2;
        int64_t row = ((int64_t)floor(along) + k / 2) % (int64_t)rows;
        uint64_t key = random_key(random_key(m->seed, (uint64_t)column), (uint64_t)row);
        double weight = (k % 2 ? u : 1.0 - u) * (k / 2 ? v : 1.0 - v);
        sum += weight * (double)random_range(key, -1.0f, 1.0f);
    }
    return sum;
}

static double erodibility(const Meander *m, MeanderNode p)
{
    double soft = 1.0 + m->contrast * bank_noise(m, p);
    double room = (m->reach - fabs(p.x)) / (2.0 * m->width);
    return m->reach > 0.0 ? soft * fmin(fmax(room, 0.0), 1.0) : soft;
}

// ---- migration

// Of the circle through three nodes, positive where the line turns left.
static double curvature(const Meander *m, int64_t i)
{
    MeanderNode a = node_at(m, i - 1), b = node_at(m, i), c = node_at(m, i + 1);
    double turn = (b.z - a.z) * (c.x - b.x) - (b.x - a.x) * (c.z - b.z);
    double sides = distance(a, b) * distance(b, c) * distance(a, c);
    return sides > 0.0 ? 2.0 * turn / sides : 0.0;
}

// The memory of the curvature upstream begins two turns upstream, where nothing is left of it.
void meander_bends(const Meander *m, double *bend)
{
    double weighted = 0.0, last = -curvature(m, -1);
    for (int64_t i = 0; i < 2 * m->count; i++) {
        double here = -curvature(m, i);
        double gap = distance(node_at(m, i - 1), node_at(m, i)) / m->width;
        double kept = exact_exp(-DECAY * gap);
        weighted = kept * weighted + (1.0 - kept) * 0.5 * (here + last);
        last = here;
        bend[i % m->count] = m->width * weighted;
    }
}

static void find_speeds(Meander *m)
{
    meander_bends(m, m->speed);
    for (int64_t i = 0; i < m->count; i++) {
        double here = -curvature(m, i) * m->width;
        m->speed[i] = m->width * (LOCAL * here + UPSTREAM * m->speed[i]);
    }
}

void meander_move(Meander *m, double step)
{
    find_speeds(m);
    MeanderNode first = m->node[0], before = node_at(m, -1);
    for (int64_t i = 0; i < m->count; i++) {
        MeanderNode here = m->node[i];
        MeanderNode after =
            i + 1 < m->count ? m->node[i + 1] : (MeanderNode){first.x, first.z + m->length};
        double x = after.x - before.x, z = after.z - before.z, long_ = sqrt(x * x + z * z);
        double by = long_ > 0.0 ? step * m->speed[i] * erodibility(m, here) / long_ : 0.0;
        m->node[i] = (MeanderNode){here.x + by * z, here.z - by * x};
        before = here;
    }
    m->time += step;
}

// ---- nodes

static MeanderNode spline(const Meander *m, int64_t i, double t)
{
    MeanderNode p[4];
    double w[4] = {0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (3.0 * t - 5.0),
                   0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
    MeanderNode sum = {0.0, 0.0};
    for (int k = 0; k < 4; k++) {
        p[k] = node_at(m, i + k - 1);
        sum.x += w[k] * p[k].x;
        sum.z += w[k] * p[k].z;
    }
    return sum;
}

static double river_length(const Meander *m)
{
    double sum = 0.0;
    for (int64_t i = 0; i < m->count; i++) {
        sum += distance(node_at(m, i), node_at(m, i + 1));
    }
    return sum;
}

bool meander_resample(Meander *m, Error *e)
{
    double whole = river_length(m);
    int64_t count = (int64_t)(whole / (SPACING * m->width) + 0.5);
    count = count < 8 ? 8 : count;
    MeanderNode *node = memory_alloc(count, sizeof *node, e);
    double *speed = memory_alloc(count, sizeof *speed, e);
    if (!node || !speed) {
        free(node);
        free(speed);
        return false;
    }
    double from = 0.0, gap = distance(node_at(m, 0), node_at(m, 1));
    int64_t piece = 0;
    for (int64_t i = 0; i < count; i++) {
        double at = whole * (double)i / (double)count;
        while (piece + 1 < m->count && from + gap < at) {
            from += gap;
            piece++;
            gap = distance(node_at(m, piece), node_at(m, piece + 1));
        }
        node[i] = spline(m, piece, gap > 0.0 ? fmin((at - from) / gap, 1.0) : 0.0);
    }
    free(m->node);
    free(m->speed);
    m->node = node;
    m->speed = speed;
    m->count = m->capacity = count;
    return true;
}

// ---- cutoffs

// Makes node i the first.
static bool turn_to(Meander *m, int64_t first, Error *e)
{
    MeanderNode *node = memory_alloc(m->count, sizeof *node, e);
    for (int64_t i = 0; node && i < m->count; i++) {
        node[i] = node_at(m, first + i);
    }
    if (node) {
        free(m->node);
        m->node = node;
    }
    return node;
}

// Takes the nodes between i and j away: a bend that is still water now.
static bool cut_off(Meander *m, int64_t i, int64_t j, Error *e)
{
    int64_t count = j - i - 1;
    MeanderNode *node = memory_alloc(count, sizeof *node, e);
    if (!node ||
        !memory_reserve(&m->oxbow, &m->oxbow_capacity, m->oxbows + 1, sizeof *m->oxbow, e) ||
        !turn_to(m, i, e)) {
        free(node);
        return false;
    }
    memcpy(node, m->node + 1, (size_t)count * sizeof *node);
    m->oxbow[m->oxbows++] = (Oxbow){.node = node, .count = count, .time = m->time};
    memmove(m->node + 1, m->node + 1 + count, (size_t)(m->count - 1 - count) * sizeof *node);
    m->count -= count;
    return true;
}

// m between middles at which the bend that begins here is cut off: a neck that the river has cut
// through, or a wider one of soft ground across which a flood has cut a chute.
static double neck_at(const Meander *m, MeanderNode p)
{
    double soft = m->contrast * bank_noise(m, p);
    return m->width * (NECK + CHUTE * (soft > 0.0 ? soft * soft : 0.0));
}

// The first node after i that is nearer than a neck; 0 = none. A node d away is not reached before
// the line has had the length for it.
static int64_t neck_after(const Meander *m, int64_t i)
{
    MeanderNode here = m->node[i];
    const double neck = NECK * m->width, widest = neck_at(m, here), longest = 0.8 * m->width;
    int64_t least = (int64_t)(3.0 * NECK / SPACING);
    for (int64_t j = i + least; j < i + m->count - 8;) {
        double d = distance(here, node_at(m, j)), around = (double)(j - i) * SPACING * m->width;
        if (d < neck || d < fmin(widest, around / 4.0)) {
            return j;
        }
        j += 1 + (int64_t)(fmax(d - widest, 0.0) / longest);
    }
    return 0;
}

bool meander_cut(Meander *m, Error *e)
{
    for (int64_t i = 0; i < m->count;) {
        int64_t j = neck_after(m, i);
        if (j == 0) {
            i++;
        } else if (!cut_off(m, i, j, e)) {
            return false;
        } else {
            i = 0;
        }
    }
    return true;
}

bool meander_run(Meander *m, double time, const Run *run, Error *e)
{
    int64_t steps = (int64_t)(time / STEP + 0.5);
    for (int64_t n = 0; n < steps; n++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        meander_move(m, STEP);
        if (n % 4 == 3 && (!meander_cut(m, e) || !meander_resample(m, e))) {
            return false;
        }
    }
    return true;
}

// ---- measures

double meander_sinuosity(const Meander *m)
{
    return river_length(m) / m->length;
}

double meander_wavelength(const Meander *m)
{
    const double bent = 0.1; // curvature times width of what counts as a bend
    int hand = 0;
    int64_t changes = 0;
    for (int64_t i = 0; i < 2 * m->count; i++) { // the first turn finds the hand to begin with
        double c = curvature(m, i % m->count) * m->width;
        int now = c > bent ? 1 : c < -bent ? -1 : hand;
        changes += i >= m->count && now != hand;
        hand = now;
    }
    return changes > 0 ? 2.0 * m->length / m->width / (double)changes : 0.0;
}

static double side_of(MeanderNode a, MeanderNode b, MeanderNode p)
{
    return (b.z - a.z) * (p.x - a.x) - (b.x - a.x) * (p.z - a.z);
}

int64_t meander_crossings(const Meander *m)
{
    int64_t found = 0;
    for (int64_t i = 0; i < m->count; i++) {
        MeanderNode a = node_at(m, i), b = node_at(m, i + 1);
        for (int64_t j = i + 2; j < i + m->count - 1; j++) {
            MeanderNode c = node_at(m, j), d = node_at(m, j + 1);
            found += side_of(a, b, c) * side_of(a, b, d) < 0.0 &&
                     side_of(c, d, a) * side_of(c, d, b) < 0.0;
        }
    }
    return found;
}
