#include "mesh/snow/snow_bed.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_GAPS = 1, STREAM_LUMPS = 2 }; // of a bough
enum { BORDER = 3, MOST_ACROSS = 400, ROUNDINGS = 3, HEIGHT_BLURS = 3 };

#define CELL_LEAST 0.008f   // m
#define CELL_DEPTH 0.3f     // cell, in depths
#define BEARS 0.12f         // share of a cell that must be covered to bear snow
#define SHARE_LEAST 0.18f   // of the depth: thinner snow is left out
#define SPECK 0.14f         // half the width of the smallest pillow, in depths
#define OVERHANG 0.16f      // of the rim, in depths
#define GAP_LENGTH 0.35f    // m, about, of a gap
#define LUMP_LENGTH 2.6f    // of a lump, in depths
#define LUMP_HEIGHT 0.55f   // how far lumps differ from the mean, by a noise of about -0.7 .. 0.7
#define NOWHERE 1e12f       // square of a distance, in cells: there is nothing

void snow_bed_clear(SnowBed *bed)
{
    free(bed->height);
    free(bed->outline);
    free(bed->share);
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
    float cell = fmaxf(fmaxf(CELL_LEAST, CELL_DEPTH * params->depth), widest / MOST_ACROSS);
    int border = BORDER + (int)(params->bridging / cell);
    *bed = (SnowBed){.across = 1 + 2 * border + (int)(size.x / cell + 0.5f),
                     .along = 1 + 2 * border + (int)(size.z / cell + 0.5f),
                     .cell = cell,
                     .low_x = box.low.x - (float)border * cell,
                     .low_z = box.low.z - (float)border * cell};
    bed->height = memory_alloc_zero(point_count(bed), sizeof(float), e);
    bed->outline = memory_alloc_zero(point_count(bed), sizeof(float), e);
    bed->share = memory_alloc_zero(point_count(bed), sizeof(float), e);
    return bed->height && bed->outline && bed->share;
}

// ---- distances ----

// Room for one row or column of either.
typedef struct Line {
    float *value, *result, *from;
    int *apex;
} Line;

// Squared distances along a line: the lower envelope of parabolas (Felzenszwalb and Huttenlocher
// 2012, "Distance transforms of sampled functions").
static void envelope(const Line *line, int count)
{
    const float *f = line->value;
    int last = 0;
    line->apex[0] = 0;
    line->from[0] = -NOWHERE;
    for (int i = 1; i < count; i++) {
        float cross;
        for (;; last--) {
            int a = line->apex[last];
            cross = (f[i] - f[a] + (float)(i * i) - (float)(a * a)) / (float)(2 * (i - a));
            if (last == 0 || cross > line->from[last]) {
                break;
            }
        }
        bool first = cross <= line->from[last];
        last = first ? last : last + 1;
        line->apex[last] = i;
        line->from[last] = first ? -NOWHERE : cross;
    }
    for (int i = 0, k = 0; i < count; i++) {
        while (k < last && line->from[k + 1] < (float)i) {
            k++;
        }
        int off = i - line->apex[k];
        line->result[i] = (float)(off * off) + f[line->apex[k]];
    }
}

// To every point the distance, in cells, to the nearest one where inside is `wanted`.
static void distances(const SnowBed *bed, const bool *inside, bool wanted, const Line *line,
                      float *distance)
{
    int across = bed->across, along = bed->along;
    for (int x = 0; x < across; x++) {
        for (int z = 0; z < along; z++) {
            line->value[z] = inside[z * across + x] == wanted ? 0.0f : NOWHERE;
        }
        envelope(line, along);
        for (int z = 0; z < along; z++) {
            distance[z * across + x] = fminf(line->result[z], NOWHERE);
        }
    }
    for (int z = 0; z < along; z++) {
        for (int x = 0; x < across; x++) {
            line->value[x] = distance[z * across + x];
        }
        envelope(line, across);
        for (int x = 0; x < across; x++) {
            distance[z * across + x] = sqrtf(line->result[x]);
        }
    }
}

// Adds (or, if not `grows`, removes) what is nearer than `reach` cells to it.
static void dilate(const SnowBed *bed, bool *inside, bool grows, float reach, const Line *line,
                   float *distance)
{
    distances(bed, inside, grows, line, distance);
    for (int64_t i = 0; i < point_count(bed); i++) {
        inside[i] = distance[i] < reach ? grows : inside[i];
    }
}

// ---- fields ----

// Each point becomes the mean of those up to `reach` points beside it, along x and then z.
static void box_blur(const SnowBed *bed, float *field, int reach, float *line)
{
    for (int turn = 0; turn < 2; turn++) {
        int count = turn == 0 ? bed->across : bed->along, step = turn == 0 ? 1 : bed->across;
        int lines = turn == 0 ? bed->along : bed->across, next = turn == 0 ? bed->across : 1;
        for (int k = 0; k < lines; k++) {
            float *first = field + (int64_t)k * next;
            for (int i = 0; i < count; i++) {
                float sum = 0.0f;
                for (int d = -reach; d <= reach; d++) {
                    sum += i + d >= 0 && i + d < count ? first[(int64_t)(i + d) * step] : 0.0f;
                }
                line[i] = sum / (float)(2 * reach + 1);
            }
            for (int i = 0; i < count; i++) {
                first[(int64_t)i * step] = line[i];
            }
        }
    }
}

// The points that bear snow, and as the bed's height the highest bearer of each.
static void gather(SnowBed *bed, const SnowBearer *bearer, int64_t count, bool *inside)
{
    float *area = bed->share;
    for (int64_t i = 0; i < count; i++) {
        int64_t at = snow_bed_entry(bed, bearer[i].p);
        bool first = area[at] == 0.0f;
        bed->height[at] = first ? bearer[i].p.y : fmaxf(bed->height[at], bearer[i].p.y);
        area[at] += bearer[i].area;
    }
    for (int64_t i = 0; i < point_count(bed); i++) {
        inside[i] = area[i] >= BEARS * bed->cell * bed->cell;
    }
}

// Snow lies on the tops, evened out over the gaps that it spans.
static void even_out(SnowBed *bed, const bool *inside, int reach, float *weight, float *line)
{
    for (int64_t i = 0; i < point_count(bed); i++) {
        weight[i] = inside[i];
        bed->height[i] = inside[i] ? bed->height[i] : 0.0f;
    }
    for (int turn = 0; turn < HEIGHT_BLURS; turn++) {
        box_blur(bed, weight, reach, line);
        box_blur(bed, bed->height, reach, line);
    }
    for (int64_t i = 0; i < point_count(bed); i++) {
        bed->height[i] = weight[i] > 1e-6f ? bed->height[i] / weight[i] : 0.0f;
    }
}

// How much of the full depth lies at the point: less on slopes and below other boughs.
static float share_at(const SnowBed *bed, int x, int z, const SnowParams *params,
                      const SnowReach *reach, uint64_t seed)
{
    const float *h = bed->height + (int64_t)z * bed->across + x;
    float slope_x = (h[1] - h[-1]) / (2.0f * bed->cell);
    float slope_z = (h[bed->across] - h[-bed->across]) / (2.0f * bed->cell);
    float level = 1.0f / sqrtf(1.0f + slope_x * slope_x + slope_z * slope_z);
    Vec3 p = vec3(bed->low_x + (float)x * bed->cell, h[0], bed->low_z + (float)z * bed->cell);
    float length = LUMP_LENGTH * params->depth;
    float lump =
        noise_plane_fractal(p.x / length, p.z / length, 2, random_key(seed, STREAM_LUMPS));
    float gap = 1.0f;
    if (params->gaps > 0.0f) {
        float wave =
            noise_plane(p.x / GAP_LENGTH, p.z / GAP_LENGTH, random_key(seed, STREAM_GAPS));
        float edge = -0.5f + params->gaps;
        gap = smoothstepf(edge - 0.08f, edge + 0.08f, wave);
    }
    return (1.0f + LUMP_HEIGHT * lump) * gap * snow_stays(params, level) *
           reach->share(reach->user, p);
}

// Snow that would be too thin is left out.
static void set_shares(SnowBed *bed, const SnowParams *params, const SnowReach *reach,
                       uint64_t seed, bool *inside)
{
    for (int i = 0; i < bed->across * bed->along; i++) {
        int x = i % bed->across, z = i / bed->across;
        bool border = x == 0 || z == 0 || x == bed->across - 1 || z == bed->along - 1;
        bed->share[i] = border ? 0.0f : share_at(bed, x, z, params, reach, seed);
        inside[i] = inside[i] && bed->share[i] >= SHARE_LEAST;
    }
}

// Signed distances to the border of what is inside, rounded.
static void set_outline(SnowBed *bed, const bool *inside, const Line *line, float overhang,
                        float *distance)
{
    distances(bed, inside, false, line, distance);
    distances(bed, inside, true, line, bed->outline);
    for (int64_t i = 0; i < point_count(bed); i++) {
        float cells = inside[i] ? distance[i] - 0.5f : 0.5f - bed->outline[i];
        bed->outline[i] = bed->cell * clampf(cells, -30.0f, 30.0f) + overhang;
    }
    for (int turn = 0; turn < ROUNDINGS; turn++) {
        box_blur(bed, bed->outline, 1, line->value);
    }
}

static void shape(SnowBed *bed, const SnowBearer *bearer, int64_t count, const SnowParams *params,
                  const SnowReach *reach, uint64_t seed, bool *inside, float *field,
                  const Line *line)
{
    float span = 0.5f * params->bridging / bed->cell, speck = SPECK * params->depth / bed->cell;
    gather(bed, bearer, count, inside);
    even_out(bed, inside, 1 + (int)span, field, line->value);
    dilate(bed, inside, true, span + 0.5f, line, field); // closing: gaps become snow
    dilate(bed, inside, false, span + 0.5f, line, field);
    set_shares(bed, params, reach, seed, inside);
    dilate(bed, inside, false, speck + 0.5f, line, field); // opening: specks and spikes vanish
    dilate(bed, inside, true, speck + 0.5f, line, field);
    set_outline(bed, inside, line, OVERHANG * params->depth, field);
    box_blur(bed, bed->share, 1, line->value);
}

bool snow_bed_init(SnowBed *bed, const SnowBearer *bearer, int64_t count, const SnowParams *params,
                   const SnowReach *reach, uint64_t seed, Error *e)
{
    bool done = lay_out(bed, bearer, count, params, e);
    int longest = bed->across > bed->along ? bed->across : bed->along;
    Line line = {.value = memory_alloc(longest, sizeof(float), e),
                 .result = memory_alloc(longest, sizeof(float), e),
                 .from = memory_alloc(longest, sizeof(float), e),
                 .apex = memory_alloc(longest, sizeof(int), e)};
    bool *inside = memory_alloc_zero(point_count(bed), sizeof *inside, e);
    float *field = memory_alloc(point_count(bed), sizeof *field, e);
    done = done && line.value && line.result && line.from && line.apex && inside && field;
    if (done) {
        shape(bed, bearer, count, params, reach, seed, inside, field, &line);
    } else {
        snow_bed_clear(bed);
    }
    free(line.value);
    free(line.result);
    free(line.from);
    free(line.apex);
    free(inside);
    free(field);
    return done;
}
