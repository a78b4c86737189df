#include "mesh/snow/snow_bed.h"

#include "base/distance_transform.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_GAPS = 1, STREAM_LUMPS = 2, STREAM_RIM = 3, STREAM_CLODS = 4 }; // of a bough
enum { BORDER = 4, REACH = 3, MOST_ACROSS = 400, ROUNDINGS = 3 };

#define CELL_LEAST 0.008f // m
#define CELL_MOST 0.045f
#define CELL_FRAYED 0.02f // at most, of frayed snow
#define CELL_DEPTH 0.3f   // cell, in depths
#define BEARS 0.12f       // share of a cell that must be covered to bear snow
#define SHARE_LEAST 0.18f // of the depth: thinner snow is left out
#define SPECK 0.004f      // m2: smaller pillows are left out
#define STIFF 0.1f        // cells2: how little slopes follow a few tops
#define OVERHANG 0.16f    // of the rim, in depths
#define GAP_LENGTH 0.35f  // m, about, of a gap
#define LUMP_LENGTH 3.2f  // of a lump, in depths
#define RIM_LENGTH 0.13f  // m, about, of a tongue or bay of a frayed rim; smaller ones on it
#define RIM_DEPTH 0.055f  // m, about half of their length across it
#define CLOD_LENGTH 0.1f  // m, of a clod on frayed snow; smaller ones on it
#define CLOD_HEIGHT 0.5f
#define LUMP_HEIGHT 0.55f // how far lumps differ from the mean, by a noise of about -0.7 .. 0.7

void snow_bed_clear(SnowBed *bed)
{
    free(bed->height);
    free(bed->outline);
    free(bed->share);
    free(bed->highest);
}

static int64_t point_count(const SnowBed *bed)
{
    return (int64_t)bed->across * bed->along;
}

int64_t snow_bed_entry(const SnowBed *bed, Vec3 p)
{
    int x = (int)((p.x - bed->low_x) / bed->cell + 0.5f);
    int z = (int)((p.z - bed->low_z) / bed->cell + 0.5f);
    return (int64_t)z * bed->across + x;
}

bool snow_bed_passes(const SnowBed *bed, Vec3 p)
{
    return p.y < bed->highest[snow_bed_entry(bed, p)] - SNOW_STEP;
}

// How far (m) the outline may lie outside of the bearers.
static float most_outside(const SnowParams *params)
{
    return OVERHANG * params->depth + 0.1f * params->fray * RIM_DEPTH;
}

// Two octaves of noise: about -0.7 .. 0.7.
static float octaves(Vec3 p, float length, uint64_t key)
{
    float x = p.x / length, z = p.z / length;
    return noise_plane(x, z, key) + 0.5f * noise_plane(2.3f * x, 2.3f * z, random_key(key, 1));
}

// A grid that leaves room for the overhang and for what bridging does near the border.
static bool lay_out(SnowBed *bed, const SnowBearer *bearer, int64_t count, const SnowParams *params,
                    Error *e)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < count; i++) {
        box = aabb_add(box, bearer[i].p);
    }
    Vec3 size = vec3_sub(box.high, box.low);
    float widest = fmaxf(size.x, size.z);
    float most = lerpf(CELL_MOST, CELL_FRAYED, params->fray);
    float cell = fmaxf(clampf(CELL_DEPTH * params->depth, CELL_LEAST, most), widest / MOST_ACROSS);
    int border =
        BORDER + (int)(params->bridging / cell) + (int)(params->fray * most_outside(params) / cell);
    *bed = (SnowBed){.across = 1 + 2 * border + (int)(size.x / cell + 0.5f),
                     .along = 1 + 2 * border + (int)(size.z / cell + 0.5f),
                     .cell = cell,
                     .low_x = box.low.x - (float)border * cell,
                     .low_z = box.low.z - (float)border * cell};
    bed->height = memory_alloc_zero(point_count(bed), sizeof(float), e);
    bed->outline = memory_alloc_zero(point_count(bed), sizeof(float), e);
    bed->share = memory_alloc_zero(point_count(bed), sizeof(float), e);
    bed->highest = memory_alloc_zero(point_count(bed), sizeof(float), e);
    return bed->height && bed->outline && bed->share && bed->highest;
}

// ---- distances ----

// To every point the squared distance, in cells, to the nearest one where inside is `wanted`.
static bool distances(const SnowBed *bed, const bool *inside, bool wanted, double *squared,
                      Error *e)
{
    for (int64_t i = 0; i < point_count(bed); i++) {
        squared[i] = inside[i] == wanted ? 0.0 : INFINITY;
    }
    return distance_transform(squared, bed->across, bed->along, 1.0, 1.0, e);
}

// Adds (or, if not `grows`, removes) what is nearer than `reach` cells to it.
static bool dilate(const SnowBed *bed, bool *inside, bool grows, float reach, double *squared,
                   Error *e)
{
    bool done = distances(bed, inside, grows, squared, e);
    for (int64_t i = 0; done && i < point_count(bed); i++) {
        inside[i] = sqrt(squared[i]) < (double)reach ? grows : inside[i];
    }
    return done;
}

// ---- fields ----

// What becomes of a point, by the `count` values, `step` apart, that lie about it; `all` would if
// the grid had no border.
typedef float Window(const float *first, int count, int64_t step, int all);

static float mean_of(const float *first, int count, int64_t step, int all)
{
    float sum = 0.0f;
    for (int i = 0; i < count; i++) {
        sum += first[i * step];
    }
    return sum / (float)all; // 0 beyond the border
}

static float greatest_of(const float *first, int count, int64_t step, int all)
{
    float most = -INFINITY;
    (void)all;
    for (int i = 0; i < count; i++) {
        most = fmaxf(most, first[i * step]);
    }
    return most;
}

// Filters by those up to `reach` points beside each, along x and then z. line: scratch of the
// longest row or column.
static void filter(const SnowBed *bed, float *field, Window *window, int reach, float *line)
{
    for (int turn = 0; turn < 2; turn++) {
        int count = turn == 0 ? bed->across : bed->along, step = turn == 0 ? 1 : bed->across;
        int lines = turn == 0 ? bed->along : bed->across, next = turn == 0 ? bed->across : 1;
        for (int k = 0; k < lines; k++) {
            float *first = field + (int64_t)k * next;
            for (int i = 0; i < count; i++) {
                int low = i > reach ? i - reach : 0,
                    high = i + reach < count ? i + reach : count - 1;
                line[i] = window(first + (int64_t)low * step, high - low + 1, step, 2 * reach + 1);
            }
            for (int i = 0; i < count; i++) {
                first[(int64_t)i * step] = line[i];
            }
        }
    }
}

// The highest bearer at every point and near it, and the points that bear snow: enough is there,
// and nothing stands far above them. top: m, NAN where there is none.
static void gather(SnowBed *bed, const SnowBearer *bearer, int64_t count, int reach, bool *inside,
                   float *top, float *line)
{
    float *area = bed->share;
    for (int64_t i = 0; i < point_count(bed); i++) {
        bed->highest[i] = -INFINITY;
    }
    for (int64_t i = 0; i < count; i++) {
        int64_t at = snow_bed_entry(bed, bearer[i].p);
        bed->highest[at] = fmaxf(bed->highest[at], bearer[i].p.y);
        area[at] += bearer[i].area;
    }
    for (int64_t i = 0; i < point_count(bed); i++) {
        inside[i] = area[i] >= BEARS * bed->cell * bed->cell;
        top[i] = inside[i] ? bed->highest[i] : NAN;
    }
    filter(bed, bed->highest, greatest_of, reach, line);
    for (int64_t i = 0; i < point_count(bed); i++) {
        if (inside[i] && top[i] < bed->highest[i] - SNOW_STEP) {
            inside[i] = false;
            top[i] = NAN;
        }
    }
}

// A plane over the tops about a point.
typedef struct Slope {
    float height; // m, at the point
    float x, z;   // slopes; 0 without tops
    bool none;    // there is no top in reach
} Slope;

// Snow lies on the tops, evened out over the gaps that it spans: moving least squares of planes,
// weighted by distance, which neither level nor bend the rims of slopes.
static Slope fit(const SnowBed *bed, const float *top, int x, int z, float reach)
{
    int far = (int)reach;
    float weight = 0.0f, mean[3] = {0}, cross[5] = {0}; // x, z, y; xx, zz, xz, xy, zy
    float middle = 0.0f;
    for (int dz = -far; dz <= far; dz++) {
        for (int dx = -far; dx <= far; dx++) {
            bool off = x + dx < 0 || z + dz < 0 || x + dx >= bed->across || z + dz >= bed->along;
            float share = 1.0f - (float)(dx * dx + dz * dz) / (reach * reach);
            float y = off ? NAN : top[(int64_t)(z + dz) * bed->across + x + dx];
            if (isnan(y) || share <= 0.0f) {
                continue;
            }
            middle = weight == 0.0f ? y : middle; // keeps the sums precise
            float w = share * share, fx = (float)dx, fz = (float)dz, fy = y - middle;
            const float add[5] = {fx * fx, fz * fz, fx * fz, fx * fy, fz * fy};
            weight += w;
            mean[0] += w * fx;
            mean[1] += w * fz;
            mean[2] += w * fy;
            for (int k = 0; k < 5; k++) {
                cross[k] += w * add[k];
            }
        }
    }
    if (weight == 0.0f) {
        return (Slope){.none = true};
    }
    for (int k = 0; k < 3; k++) {
        mean[k] /= weight;
    }
    float xx = cross[0] / weight - mean[0] * mean[0] + STIFF;
    float zz = cross[1] / weight - mean[1] * mean[1] + STIFF;
    float xz = cross[2] / weight - mean[0] * mean[1];
    float xy = cross[3] / weight - mean[0] * mean[2], zy = cross[4] / weight - mean[1] * mean[2];
    float whole = xx * zz - xz * xz;
    Slope slope = {.x = (xy * zz - zy * xz) / whole, .z = (zy * xx - xy * xz) / whole};
    slope.height = middle + mean[2] - slope.x * mean[0] - slope.z * mean[1];
    slope.x /= bed->cell;
    slope.z /= bed->cell;
    return slope;
}

// 0 in gaps, else 1 and lumps.
static float unevenness(const SnowParams *params, Vec3 p, uint64_t seed)
{
    float length = LUMP_LENGTH * params->depth, gap = 1.0f;
    float lump = noise_plane(p.x / length, p.z / length, random_key(seed, STREAM_LUMPS));
    if (params->gaps > 0.0f) {
        float wave = noise_plane(p.x / GAP_LENGTH, p.z / GAP_LENGTH, random_key(seed, STREAM_GAPS));
        float edge = -0.5f + params->gaps;
        gap = smoothstepf(edge - 0.08f, edge + 0.08f, wave);
    }
    if (params->fray > 0.0f) {
        float clod = octaves(p, CLOD_LENGTH, random_key(seed, STREAM_CLODS));
        gap *= 1.0f + CLOD_HEIGHT * params->fray * clod;
    }
    return gap * (1.0f + LUMP_HEIGHT * lump);
}

// The surface, and how much of the full depth lies at each point: less on slopes and below other
// boughs. Snow that would be too thin is left out.
static void set_surface(SnowBed *bed, const SnowParams *params, const SnowReach *reach,
                        uint64_t seed, bool *inside, const float *top)
{
    float far = 0.5f * params->bridging / bed->cell + 4.0f;
    for (int i = 0; i < bed->across * bed->along; i++) {
        int x = i % bed->across, z = i / bed->across;
        Slope slope = {.none = bed->highest[i] == -INFINITY}; // all around
        if (!slope.none) {
            slope = fit(bed, top, x, z, far);
        }
        float level = 1.0f / sqrtf(1.0f + slope.x * slope.x + slope.z * slope.z);
        Vec3 p = vec3(bed->low_x + (float)x * bed->cell, slope.height,
                      bed->low_z + (float)z * bed->cell);
        bed->height[i] = slope.none ? NAN : slope.height;
        bed->share[i] = slope.none ? 0.0f
                                   : unevenness(params, p, seed) * snow_stays(params, level) *
                                         reach->share(reach->user, p);
        inside[i] = inside[i] && bed->share[i] >= SHARE_LEAST;
    }
}

// Rims reach out over points that no bearer is near: the surface goes on there as it is beside
// them.
static void extend_surface(SnowBed *bed, const SnowParams *params)
{
    // points, as far as overhang and rounding move the outline
    int reach = REACH + (int)(params->fray * most_outside(params) / bed->cell);
    const int64_t beside[4] = {-1, 1, -bed->across, bed->across};
    for (int turn = 0; turn < reach; turn++) {
        for (int64_t i = bed->across; i < point_count(bed) - bed->across; i++) {
            for (int n = 0; n < 4 && isnan(bed->height[i]); n++) {
                bed->height[i] = bed->height[i + beside[n]];
            }
        }
    }
}

// Takes out what is so small that it would look like a flake in the air.
static void drop_specks(const SnowBed *bed, bool *inside, int32_t *stack, bool *seen)
{
    const int64_t beside[4] = {-1, 1, -bed->across, bed->across};
    int64_t least = 1 + (int64_t)(SPECK / (bed->cell * bed->cell));
    for (int64_t i = 0; i < point_count(bed); i++) {
        int64_t count = 0;
        if (inside[i] && !seen[i]) {
            seen[i] = true;
            stack[count++] = (int32_t)i;
        }
        for (int64_t k = 0; k < count; k++) {
            for (int n = 0; n < 4; n++) {
                int64_t other = stack[k] + beside[n];
                if (inside[other] && !seen[other]) {
                    seen[other] = true;
                    stack[count++] = (int32_t)other;
                }
            }
        }
        for (int64_t k = 0; k < count && count < least; k++) {
            inside[stack[k]] = false;
        }
    }
}

// Room for the steps of a bed.
typedef struct Room {
    float *line;         // a row or column
    bool *inside, *seen; // per point
    double *squared;
    float *top;
    int32_t *stack;
} Room;

// Bays of the rim, which none of the rounding takes away; tongues would hang like cloth.
static void fray_outline(SnowBed *bed, float fray, uint64_t seed)
{
    for (int64_t i = 0; i < point_count(bed); i++) {
        int64_t x = i % bed->across, z = i / bed->across;
        Vec3 p = vec3(bed->low_x + (float)x * bed->cell, 0.0f, bed->low_z + (float)z * bed->cell);
        float wave = octaves(p, RIM_LENGTH, random_key(seed, STREAM_RIM));
        bed->outline[i] += fray * RIM_DEPTH * clampf(1.4f * wave - 0.2f, -1.0f, 0.1f);
    }
}

// Signed distances to the border of what is inside, rounded.
static bool set_outline(SnowBed *bed, const bool *inside, float overhang, const Room *room,
                        Error *e)
{
    for (int side = 0; side < 2; side++) { // of the points inside, then of those outside
        if (!distances(bed, inside, side == 1, room->squared, e)) {
            return false;
        }
        for (int64_t i = 0; i < point_count(bed); i++) {
            if (inside[i] == (side == 0)) {
                float cells = fminf((float)sqrt(room->squared[i]) - 0.5f, 30.0f);
                bed->outline[i] = bed->cell * (inside[i] ? cells : -cells) + overhang;
            }
        }
    }
    for (int turn = 0; turn < ROUNDINGS; turn++) {
        filter(bed, bed->outline, mean_of, 1, room->line);
    }
    return true;
}

static bool shape(SnowBed *bed, const SnowBearer *bearer, int64_t count, const SnowParams *params,
                  const SnowReach *reach, uint64_t seed, const Room *room, Error *e)
{
    float span = 0.5f * params->bridging / bed->cell + 0.5f;
    gather(bed, bearer, count, 1 + (int)span, room->inside, room->top, room->line);
    if (!dilate(bed, room->inside, true, span, room->squared, e) || // closing: gaps become snow
        !dilate(bed, room->inside, false, span, room->squared, e)) {
        return false;
    }
    set_surface(bed, params, reach, seed, room->inside, room->top);
    extend_surface(bed, params);
    drop_specks(bed, room->inside, room->stack, room->seen);
    filter(bed, bed->share, mean_of, 1, room->line);
    bool done = set_outline(bed, room->inside, OVERHANG * params->depth, room, e);
    if (done && params->fray > 0.0f) {
        fray_outline(bed, params->fray, seed);
    }
    return done;
}

static void room_clear(Room *room)
{
    free(room->line);
    free(room->inside);
    free(room->seen);
    free(room->squared);
    free(room->top);
    free(room->stack);
}

static bool room_init(Room *room, const SnowBed *bed, Error *e)
{
    int64_t points = point_count(bed);
    int longest = bed->across > bed->along ? bed->across : bed->along;
    *room = (Room){.line = memory_alloc(longest, sizeof(float), e),
                   .inside = memory_alloc_zero(points, sizeof(bool), e),
                   .seen = memory_alloc_zero(points, sizeof(bool), e),
                   .squared = memory_alloc(points, sizeof(double), e),
                   .top = memory_alloc(points, sizeof(float), e),
                   .stack = memory_alloc(points, sizeof(int32_t), e)};
    return room->line && room->inside && room->seen && room->squared && room->top && room->stack;
}

bool snow_bed_init(SnowBed *bed, const SnowBearer *bearer, int64_t count, const SnowParams *params,
                   const SnowReach *reach, uint64_t seed, Error *e)
{
    Room room = {0};
    bool done = lay_out(bed, bearer, count, params, e) && room_init(&room, bed, e) &&
                shape(bed, bearer, count, params, reach, seed, &room, e);
    if (!done) {
        snow_bed_clear(bed);
    }
    room_clear(&room);
    return done;
}
