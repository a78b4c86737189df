// Where the land at a place is read when it breaks into blocks of one size.
#include "land/jointing_parts.h"

#include "base/noise.h"
#include "base/random.h"

#include <math.h>

// Keys of a scale.
enum { KEY_BEDS = 2, KEY_BLOCK, KEY_BEND, KEY_OPEN = KEY_BEND + JOINT_SETS };

// The interval about a place on a line that is cut at irregular distances.
typedef struct Interval {
    int64_t number, low_cut, high_cut;
    float low, high; // distances to its ends, m
} Interval;

// A place in plan in its block.
typedef struct Place {
    float x, z;
    float line[JOINT_SETS]; // m across each set
    Interval about[JOINT_SETS];
} Place;

// ---- blocks

static float cut_at(int64_t number, uint64_t key)
{
    return (float)number + 0.8f * (random_unit(random_key(key, (uint64_t)number)) - 0.5f);
}

// Every other cut is missing at times, so that blocks differ much in size.
static Interval interval_at(float place, float spacing, uint64_t key)
{
    float at = place / spacing;
    int64_t i = (int64_t)floorf(at);
    i -= i & 1;
    float first = cut_at(i, key), last = cut_at(i + 2, key);
    if (at < first) {
        i -= 2;
        last = first;
        first = cut_at(i, key);
    } else if (at >= last) {
        i += 2;
        first = last;
        last = cut_at(i + 2, key);
    }
    bool whole = random_unit(random_key(random_key(key, (uint64_t)i), 1)) < 0.4f;
    float middle = whole ? last : cut_at(i + 1, key);
    bool before = at < middle;
    float low = before ? first : middle, high = before ? middle : last;
    return (Interval){.number = before ? i : i + 1,
                      .low_cut = before ? i : i + 1,
                      .high_cut = before && !whole ? i + 1 : i + 2,
                      .low = spacing * (at - low),
                      .high = spacing * (high - at)};
}

// Joints of the second set end at those of the first.
static uint64_t cuts_key(const JointScale *s, int set, const Interval *first)
{
    return set == 0 ? random_key(s->key, 0)
                    : random_key(random_key(s->key, 1), (uint64_t)first->number);
}

// Joints are not ruled lines.
static float across(const JointScale *s, int set, float x, float z)
{
    float straight = s->normal[set].x * x + s->normal[set].y * z, wave = 3.0f * s->spacing;
    if (s->params->bends <= 0.0f) {
        return straight;
    }
    uint64_t key = random_key(s->key, KEY_BEND + (uint64_t)set);
    float bend =
        2.0f * s->params->bends * s->spacing * noise_plane_fractal(x / wave, z / wave, 2, key);
    return straight + bend;
}

// ---- the land

// In samples from the corner. Double: a window of the land has the same bits.
static double clamped(float place, float corner, float cell, int last)
{
    double at = ((double)place - (double)corner) / (double)cell;
    return at < 0.0 ? 0.0 : at > (double)last ? (double)last : at;
}

static int64_t sample_near(const HeightField *field, float x, float z)
{
    double u = clamped(x, field->origin.x, field->cell.x, field->columns - 1);
    double v = clamped(z, field->origin.y, field->cell.y, field->rows - 1);
    return (int64_t)(v + 0.5) * field->columns + (int64_t)(u + 0.5);
}

static float rock_at(const JointScale *s, float x, float z)
{
    const HeightField *field = s->field;
    double u = clamped(x, field->origin.x, field->cell.x, field->columns - 1);
    double v = clamped(z, field->origin.y, field->cell.y, field->rows - 1);
    int64_t column = (int64_t)u, row = (int64_t)v, last = field->columns - 2;
    column = column < last ? column : last;
    row = row < field->rows - 2 ? row : field->rows - 2;
    float right = (float)(u - (double)column), down = (float)(v - (double)row);
    const float *h = s->rock + row * field->columns + column;
    float north = lerpf(h[0], h[1], right);
    float south = lerpf(h[field->columns], h[field->columns + 1], right);
    return lerpf(north, south, down);
}

// ---- a block

// What a block is: where its profile lies, and what moves it.
typedef struct Block {
    uint64_t key;
    float x, z;         // the place that is read, before the block moves
    float out_x, out_z; // unit: across its face, downhill
    float out;          // m by which the whole block stands back
    float base;         // m: of its beds
    float throws;       // m
    float mask;
} Block;

// Blocks differ in how far they turn, but for 0 and 1.
static float turned(float facets, uint64_t key)
{
    return random_range(key, facets * facets, facets);
}

static Block block_at(const JointScale *s, const Place *place, float mask)
{
    const JointingParams *params = s->params;
    const Interval *about = place->about;
    // Along each set, to the middle between the other's joints.
    float middle[JOINT_SETS], to[JOINT_SETS];
    for (int set = 0; set < JOINT_SETS; set++) {
        middle[set] = 0.5f * (about[set].high - about[set].low);
    }
    to[0] = middle[1] / (s->along[0].x * s->normal[1].x + s->along[0].y * s->normal[1].y);
    to[1] = middle[0] / (s->along[1].x * s->normal[0].x + s->along[1].y * s->normal[0].y);
    float x = place->x + to[0] * s->along[0].x + to[1] * s->along[1].x;
    float z = place->z + to[0] * s->along[0].y + to[1] * s->along[1].y;
    int64_t i = sample_near(s->field, x, z);
    float dx = s->dx[i], dz = s->dz[i], rise[JOINT_SETS];
    uint64_t key = random_key(random_key(random_key(s->key, KEY_BLOCK), (uint64_t)about[0].number),
                              (uint64_t)about[1].number);
    for (int set = 0; set < JOINT_SETS; set++) {
        rise[set] = s->normal[set].x * dx + s->normal[set].y * dz;
    }
    float favour = random_range(random_key(key, 1), 0.75f, 1.33f);
    int face = fabsf(rise[0]) * favour > fabsf(rise[1]) ? 0 : 1;
    float turn = turned(params->facets, random_key(key, 2)) * mask * to[face];
    float down = rise[face] > 0.0f ? -1.0f : 1.0f;
    float own = random_range(random_key(key, 3), -1.0f, 1.0f);
    return (Block){.key = key,
                   .x = place->x + turn * s->along[face].x,
                   .z = place->z + turn * s->along[face].y,
                   .out_x = down * s->normal[face].x,
                   .out_z = down * s->normal[face].y,
                   .out = 0.6f * own * params->relief * s->spacing * mask,
                   .throws = random_range(random_key(key, 4), -1.0f, 1.0f) * s->throws * mask,
                   .base = s->strata ? strata_base(s->strata, place->x, place->z) : 0.0f,
                   .mask = mask};
}

// The height of a block of beds that stand out or back: at each level the rock is solid where the
// bed there, moved, is.
static float stacked(const JointScale *s, const Block *block)
{
    enum { MOST = 24 };
    float most = 0.4f * s->params->relief * s->spacing * block->mask;
    float up = block->out - most;
    float top = rock_at(s, block->x + up * block->out_x, block->z + up * block->out_z);
    if (!isfinite(top)) { // a gap in surveyed land
        return top;
    }
    uint64_t key = random_key(s->key, KEY_BEDS);
    Interval bed = interval_at(top - block->base, s->thick, key);
    float level = top - block->base, height = top;
    for (int i = 0; i < MOST; i++) {
        uint64_t own = random_key(random_key(block->key, 5), (uint64_t)bed.number);
        float out = block->out + most * random_range(own, -1.0f, 1.0f);
        height = rock_at(s, block->x + out * block->out_x, block->z + out * block->out_z);
        float floor = level - bed.low + block->base;
        if (height >= floor) {
            float roof = level + bed.high + block->base;
            return fminf(height, i > 0 ? roof : height);
        }
        level = level - bed.low - 1e-3f * s->thick;
        bed = interval_at(level, s->thick, key);
    }
    return height;
}

// m, along a joint that cuts into the wall, by which the wall has been cleared back at a place.
static float cleared(const JointScale *s, const Place *place, int set)
{
    const Interval *about = &place->about[set];
    bool up = about->high < about->low;
    float away = up ? about->high : about->low;
    uint64_t key = random_key(cuts_key(s, set, &place->about[0]), KEY_OPEN);
    key = random_key(key, (uint64_t)(up ? about->high_cut : about->low_cut));
    float open = random_range(key, -0.6f, 1.0f), width = (0.06f + 0.12f * open) * s->spacing;
    if (open <= 0.0f || away >= width) {
        return 0.0f;
    }
    return s->params->gullies * s->spacing * open * (1.0f - away / width);
}

static float height_in(const JointScale *s, const Place *place, float mask)
{
    Block block = block_at(s, place, mask);
    int64_t i = sample_near(s->field, place->x, place->z);
    float dx = s->dx[i], dz = s->dz[i], size = sqrtf(dx * dx + dz * dz);
    for (int set = 0; size > 0.0f && set < JOINT_SETS; set++) {
        Vec2 way = s->along[set];
        float rise = (way.x * dx + way.y * dz) / size;
        float steep = smoothstepf(0.4f, 0.85f, fabsf(rise)) * mask;
        float back = steep > 0.0f ? steep * cleared(s, place, set) : 0.0f;
        block.x -= (rise > 0.0f ? back : -back) * way.x;
        block.z -= (rise > 0.0f ? back : -back) * way.y;
    }
    return stacked(s, &block) + block.throws;
}

// ---- a sample

// The neighbour of a place's interval, beyond its nearer end; its distances are of the place.
static Interval beyond(const Interval *own, float line, float spacing, uint64_t key)
{
    const float past = 1e-3f * spacing;
    bool up = own->high < own->low;
    float to = up ? own->high + past : -own->low - past;
    Interval next = interval_at(line + to, spacing, key);
    next.low -= to;
    next.high += to;
    return next;
}

// The share of the block beyond the nearer end: steps are as steep as the samples can show them
// without teeth.
static float share_beyond(const Interval *about, float cell)
{
    float away = fminf(about->low, about->high);
    return away < cell ? 0.5f * (1.0f - away / cell) : 0.0f;
}

float jointing_height(const JointScale *s, float x, float z, float mask)
{
    float cell = 1.2f * s->field->cell.x;
    Place place = {x, z, .line = {across(s, 0, x, z), across(s, 1, x, z)}};
    Interval own = interval_at(place.line[0], s->spacing, cuts_key(s, 0, NULL));
    float share[JOINT_SETS], sum = 0.0f;
    share[0] = share_beyond(&own, cell);
    for (int i = 0; i < (share[0] > 0.0f ? 2 : 1); i++) {
        float first = i == 0 ? 1.0f - share[0] : share[0];
        place.about[0] =
            i == 0 ? own : beyond(&own, place.line[0], s->spacing, cuts_key(s, 0, NULL));
        uint64_t key = cuts_key(s, 1, &place.about[0]);
        Interval second = interval_at(place.line[1], s->spacing, key);
        share[1] = share_beyond(&second, cell);
        place.about[1] = second;
        float height = height_in(s, &place, mask);
        if (share[1] > 0.0f) {
            place.about[1] = beyond(&second, place.line[1], s->spacing, key);
            height = lerpf(height, height_in(s, &place, mask), share[1]);
        }
        sum += first * height;
    }
    return sum;
}
