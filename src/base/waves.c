#include "base/waves.h"

#include "base/exact_math.h"
#include "base/noise.h"

#include <stdlib.h>

void waves_shore_free(WavesShore *shore)
{
    if (shore) {
        free(shore->depth);
        free(shore->share);
        free(shore->shift);
        free(shore->breaking);
        free(shore->drift);
        free(shore);
    }
}

void waves_free(Waves *waves)
{
    if (waves) {
        for (int i = 0; i < WAVES_TILES; i++) {
            for (int l = 0; l < WAVES_LEVELS; l++) {
                free(waves->tile[i].texel[l]);
            }
        }
        waves_shore_free(waves->shore);
        free(waves);
    }
}

// ---- tiles

// Weights of Catmull and Rom's spline at t, 0..1, between the second and the third of four samples.
static void spline_weights(float t, float weight[4])
{
    float t2 = t * t, t3 = t2 * t;
    weight[0] = 0.5f * (-t + 2.0f * t2 - t3);
    weight[1] = 0.5f * (2.0f - 5.0f * t2 + 3.0f * t3);
    weight[2] = 0.5f * (t + 4.0f * t2 - 3.0f * t3);
    weight[3] = 0.5f * (t3 - t2);
}

// Adds `share` of one level at the tile's place u, v (in sizes).
static void add_level(const WaveTile *tile, int level, float u, float v, float share,
                      float sum[WAVE_CHANNELS])
{
    int side = tile->side >> level, mask = side - 1;
    float s = (u - floorf(u)) * (float)side, t = (v - floorf(v)) * (float)side;
    int column = (int)s, row = (int)t;
    float along[4], across[4];
    spline_weights(s - (float)column, along);
    spline_weights(t - (float)row, across);
    for (int j = 0; j < 4; j++) {
        const float *line =
            tile->texel[level] + (int64_t)((row + j - 1) & mask) * side * WAVE_CHANNELS;
        for (int i = 0; i < 4; i++) {
            const float *texel = line + (int64_t)((column + i - 1) & mask) * WAVE_CHANNELS;
            float weight = share * across[j] * along[i];
            for (int c = 0; c < WAVE_CHANNELS; c++) {
                sum[c] += weight * texel[c];
            }
        }
    }
}

// The number of halvings by which x exceeds 1: a logarithm to base 2 that is linear between powers
// of two; + - * / only.
static float halvings(float x)
{
    int exponent;
    float mantissa = frexpf(x, &exponent); // 0.5 .. 1
    return (float)(exponent - 1) + 2.0f * mantissa - 1.0f;
}

// The tile at a place, without waves shorter than twice the width.
static void tile_at(const WaveTile *tile, float x, float z, float width, float sum[WAVE_CHANNELS])
{
    float u = (x * tile->cosine + z * tile->sine) / tile->size;
    float v = (z * tile->cosine - x * tile->sine) / tile->size;
    float texel = tile->size / (float)tile->side;
    float level = 0.5f * width > texel ? halvings(0.5f * width / texel) : 0.0f;
    int low = (int)level;
    float part = level - (float)low;
    for (int c = 0; c < WAVE_CHANNELS; c++) {
        sum[c] = 0.0f;
    }
    if (low < tile->levels) {
        add_level(tile, low, u, v, 1.0f - part, sum);
    }
    if (low + 1 < tile->levels && part > 0.0f) {
        add_level(tile, low + 1, u, v, part, sum);
    }
}

double waves_mean_square(const WaveTile *tile, int channel)
{
    int64_t count = (int64_t)tile->side * tile->side;
    double sum = 0.0;
    for (int64_t i = 0; i < count; i++) {
        double value = (double)tile->texel[0][i * WAVE_CHANNELS + channel];
        sum += value * value;
    }
    return sum / (double)count;
}

// ---- the shore

// A place on the grid, within it.
typedef struct GridPlace {
    int64_t sample[4];
    float weight[4];
    // d weight / d x and d z
    float weight_x[4], weight_z[4];
} GridPlace;

static GridPlace grid_place(const WavesShore *shore, float x, float z)
{
    float s = (x - shore->origin.x) / shore->cell, t = (z - shore->origin.y) / shore->cell;
    bool in_x = s > 0.0f && s < (float)(shore->columns - 1);
    bool in_z = t > 0.0f && t < (float)(shore->rows - 1);
    s = clampf(s, 0.0f, (float)(shore->columns - 1));
    t = clampf(t, 0.0f, (float)(shore->rows - 1));
    int column = (int)s, row = (int)t;
    column = column > shore->columns - 2 ? shore->columns - 2 : column;
    row = row > shore->rows - 2 ? shore->rows - 2 : row;
    s -= (float)column;
    t -= (float)row;
    int64_t first = (int64_t)row * shore->columns + column;
    float per_x = in_x ? 1.0f / shore->cell : 0.0f, per_z = in_z ? 1.0f / shore->cell : 0.0f;
    return (GridPlace){{first, first + 1, first + shore->columns, first + shore->columns + 1},
                       {(1.0f - s) * (1.0f - t), s * (1.0f - t), (1.0f - s) * t, s * t},
                       {-(1.0f - t) * per_x, (1.0f - t) * per_x, -t * per_x, t * per_x},
                       {-(1.0f - s) * per_z, -s * per_z, (1.0f - s) * per_z, s * per_z}};
}

static float grid_sum(const GridPlace *place, const float weight[4], const float *value, int stride,
                      int offset)
{
    (void)place;
    float sum = 0.0f;
    for (int i = 0; i < 4; i++) {
        sum += weight[i] * value[place->sample[i] * stride + offset];
    }
    return sum;
}

float waves_depth(const WavesShore *shore, float x, float z)
{
    GridPlace place = grid_place(shore, x, z);
    return grid_sum(&place, place.weight, shore->depth, 1, 0);
}

// Adds the tile where its waves have come by the shore's grid.
static void add_shifted(const Waves *waves, int index, const GridPlace *place, float x, float z,
                        float width, float sum[WAVE_CHANNELS])
{
    const WavesShore *shore = waves->shore;
    float share = grid_sum(place, place->weight, shore->share, WAVES_TILES, index);
    if (share <= 0.0f) {
        return;
    }
    float shift = grid_sum(place, place->weight, shore->shift, WAVES_TILES, index);
    float shift_x = grid_sum(place, place->weight_x, shore->shift, WAVES_TILES, index);
    float shift_z = grid_sum(place, place->weight_z, shore->shift, WAVES_TILES, index);
    float own[WAVE_CHANNELS];
    // Where waves are drawn together, shorter ones of the tile are left out.
    float closer = 1.0f + waves->way.x * shift_x + waves->way.y * shift_z;
    tile_at(&waves->tile[index], x + shift * waves->way.x, z + shift * waves->way.y,
            width * clampf(closer, 1.0f, 8.0f), own);
    float along = own[WAVE_SLOPE_X] * waves->way.x + own[WAVE_SLOPE_Z] * waves->way.y;
    own[WAVE_SLOPE_X] += along * shift_x;
    own[WAVE_SLOPE_Z] += along * shift_z;
    for (int c = 0; c < WAVE_CHANNELS; c++) {
        sum[c] += (c < WAVE_CROWDING ? share : 1.0f) * own[c];
    }
}

// ---- the sum

static float hidden_variance(const Waves *waves, float longest)
{
    float at = 4.0f * (halvings(longest) - WAVES_BAND_FIRST);
    at = clampf(at, 0.0f, (float)(WAVES_BANDS - 1));
    int i = (int)at;
    i = i > WAVES_BANDS - 2 ? WAVES_BANDS - 2 : i;
    return lerpf(waves->hidden[i], waves->hidden[i + 1], at - (float)i);
}

// The normal of the displaced surface: the cross product of its tangents.
static Vec3 normal_of(const Waves *waves, const float sum[WAVE_CHANNELS])
{
    float chop = waves->choppiness;
    Vec3 along_x = {1.0f + chop * sum[WAVE_STRETCH_XX], sum[WAVE_SLOPE_X],
                    chop * sum[WAVE_STRETCH_XZ]};
    Vec3 along_z = {chop * sum[WAVE_STRETCH_XZ], sum[WAVE_SLOPE_Z],
                    1.0f + chop * sum[WAVE_STRETCH_ZZ]};
    Vec3 normal = vec3_cross(along_z, along_x);
    normal.y = fmaxf(normal.y, 0.05f); // a fold has no upper side
    return vec3_normalize(normal);
}

// The sum of all tiles at a place; *point: what the shore tells.
static void sum_at(const Waves *waves, float x, float z, float width, float sum[WAVE_CHANNELS],
                   WavePoint *point)
{
    const WavesShore *shore = waves->shore;
    for (int c = 0; c < WAVE_CHANNELS; c++) {
        sum[c] = 0.0f;
    }
    point->breaking = point->drift = 0.0f;
    point->depth = INFINITY;
    if (shore) {
        GridPlace place = grid_place(shore, x, z);
        for (int i = 0; i < WAVES_TILES; i++) {
            add_shifted(waves, i, &place, x, z, width, sum);
        }
        point->breaking = grid_sum(&place, place.weight, shore->breaking, 1, 0);
        point->drift = grid_sum(&place, place.weight, shore->drift, 1, 0);
        point->depth = grid_sum(&place, place.weight, shore->depth, 1, 0);
        return;
    }
    for (int i = 0; i < WAVES_TILES; i++) {
        float own[WAVE_CHANNELS];
        tile_at(&waves->tile[i], x, z, width, own);
        for (int c = 0; c < WAVE_CHANNELS; c++) {
            sum[c] += own[c];
        }
    }
}

// ---- breakers

// By how many standard deviations the crowding exceeds that from which waves break.
static float excess_of(const Waves *waves, const float sum[WAVE_CHANNELS])
{
    return (waves->choppiness * sum[WAVE_CROWDING] - waves->foam) / waves->spread;
}

// Lumps of water that boils, -1..1, of sizes by halves from `largest` m down.
static float lumps_at(float x, float z, float largest, float width)
{
    float sum = 0.0f, size = largest, share = 1.0f;
    for (uint64_t i = 0; i < 5 && size > 2.0f * width; i++) {
        sum += share * noise_plane(x / size, z / size, 9311 + i);
        size *= 0.47f;
        share *= 0.62f;
    }
    return sum;
}

// The crest leans over as the square of its excess, so that its foot stays and its lip goes
// farthest, and falls as the lip runs ahead.
Vec3 waves_thrown(const Waves *waves, float x, float z, float width, const float sum[WAVE_CHANNELS])
{
    const float most = 3.0f, drop = 0.35f, lump = 0.9f, boils = 0.10f; // deviations; shares; m
    float excess = excess_of(waves, sum);
    if (waves->breakers <= 0.0f || !(excess > 0.0f)) {
        return vec3(0.0f, 0.0f, 0.0f);
    }
    float share = fminf(excess / most, 1.0f), square = share * share;
    float rise = fmaxf(sum[WAVE_HEIGHT], 0.0f), reach = waves->breakers * rise;
    float boil = boils * reach * smoothstepf(0.1f, 0.6f, share) * lumps_at(x, z, lump, width);
    float ahead = reach * square + 0.5f * boil;
    return vec3(ahead * waves->way.x, boil - drop * reach * square * square, ahead * waves->way.y);
}

static Vec3 displacement_of(const Waves *waves, const float sum[WAVE_CHANNELS])
{
    return vec3(waves->choppiness * sum[WAVE_ASIDE_X], sum[WAVE_HEIGHT],
                waves->choppiness * sum[WAVE_ASIDE_Z]);
}

// Throws the crest at the point, and turns its normal, by differences over a pixel.
static void throw_crest(const Waves *waves, float x, float z, float width,
                        const float sum[WAVE_CHANNELS], WavePoint *point)
{
    const float least = 0.01f; // m
    float step = fmaxf(width, least);
    Vec3 here = waves_thrown(waves, x, z, width, sum), tangent[2];
    for (int axis = 0; axis < 2; axis++) {
        float beside[WAVE_CHANNELS], to_x = axis == 0 ? x + step : x,
                                     to_z = axis == 1 ? z + step : z;
        WavePoint rest;
        sum_at(waves, to_x, to_z, width, beside, &rest);
        Vec3 to = vec3_add(displacement_of(waves, beside),
                           waves_thrown(waves, to_x, to_z, width, beside));
        to = vec3_sub(to, vec3_add(point->displacement, here));
        to.x += to_x - x;
        to.z += to_z - z;
        tangent[axis] = to;
    }
    point->displacement = vec3_add(point->displacement, here);
    Vec3 normal = vec3_cross(tangent[1], tangent[0]);
    float length = vec3_length(normal);
    point->normal = length > 0.0f ? vec3_scale(normal, 1.0f / length) : point->normal;
}

void waves_at(const Waves *waves, float x, float z, float width, WavePoint *point)
{
    float sum[WAVE_CHANNELS];
    sum_at(waves, x, z, width, sum, point);
    point->displacement = displacement_of(waves, sum);
    point->normal = normal_of(waves, sum);
    point->crowding = waves->choppiness * sum[WAVE_CROWDING];
    point->trail = waves->choppiness * sum[WAVE_TRAIL];
    point->spill = waves->choppiness * sum[WAVE_SPILL];
    point->left = clampf(sum[WAVE_FOAM], 0.0f, 1.0f);
    point->place = (Vec2){x, z};
    point->width = width;
    point->roughness2 = hidden_variance(waves, fmaxf(2.0f * width, waves->shortest));
    if (waves->breakers > 0.0f && excess_of(waves, sum) > 0.0f) {
        throw_crest(waves, x, z, width, sum, point);
    }
}

// Foam between the breakers: dense where the water runs up the shore and back, then what drifts
// off.
static float old_surf(const Waves *waves, const WavePoint *point)
{
    const float wash = 1.5f; // m: depth in which water is white all the time
    float lasts = fminf(3.0f * waves->spread / waves->foam, 1.0f);
    float near = 0.14f + 0.46f * smoothstepf(wash, 0.0f, point->depth);
    return lasts * fmaxf(near * point->breaking, 0.16f * point->drift * point->drift);
}

// How white a crest that breaks now is. Its edge is torn into tongues that run ahead on the front
// of the wave, longer than they are wide.
static float roller(const Waves *waves, const WavePoint *point, float from)
{
    const float torn = 0.8f, edge = 0.4f, steep = 0.35f, lean = 0.3f; // deviations; slope
    float spread = waves->spread, crowding = fmaxf(point->crowding, point->spill);
    if (crowding < from - (torn + lean) * spread) {
        return 0.0f;
    }
    Vec2 way = waves->way, at = point->place;
    float fall = (point->normal.x * way.x + point->normal.z * way.y) / point->normal.y;
    float open = 1.0f - point->breaking;
    crowding += open * lean * spread * clampf(fall / steep, -1.0f, 1.0f);
    float along = at.x * way.x + at.y * way.y, across = at.y * way.x - at.x * way.y;
    crowding += torn * spread * lumps_at(0.55f * along, across, 1.4f, point->width);
    return smoothstepf(from, from + edge * spread, crowding);
}

// Share of foam that drifts in lines along the wind, where the water of Langmuir's cells meets:
// some metres to tens of metres from each other, each ending after some tens of metres. Its mean
// over places is that of the sea.
static float streaks(const Waves *waves, const WavePoint *point)
{
    static const float spacing[] = {11.0f, 4.3f}; // m
    const float longer = 14.0f, mean = 0.0933f;   // mean: of the product below
    Vec2 way = waves->way, at = point->place;
    float along = at.x * way.x + at.y * way.y, across = at.y * way.x - at.x * way.y;
    float share = 1.0f, seen = smoothstepf(2.0f, 0.5f, point->width);
    for (uint64_t i = 0; i < 2; i++) {
        float size = spacing[i];
        float bend = 0.5f * noise_plane(along / (4.0f * size), across / (4.0f * size), 9341 + i);
        float line = noise_plane(along / (longer * size), across / size + bend, 9351 + i);
        share *= smoothstepf(-0.1f, 0.3f, line);
    }
    return waves->streaks * lerpf(1.0f, share / mean, seen);
}

// Foam on the sheet of water that runs out on the shore, by how thick it still is: the lip at its
// edge, of froth that the sheet pushes along, and the lace that trails behind it. The lip is wide
// in some places, nearly gone in others.
static float swash_lip(const Waves *waves, const WavePoint *point)
{
    const float lip = 0.024f, apart = 1.3f; // m
    if (waves->swash <= 0.0f) {
        return 0.0f;
    }
    float sheet = point->depth + point->displacement.y; // -infinity..: thickness, m
    float ragged = lumps_at(point->place.x, point->place.y, apart, point->width);
    return waves->swash * smoothstepf(lip * fmaxf(1.3f + ragged, 0.1f), 0.0f, sheet);
}

static float swash_lace(const Waves *waves, const WavePoint *point)
{
    const float most = 0.5f, sheet = 0.22f, apart = 3.5f; // share; m
    if (waves->swash <= 0.0f) {
        return 0.0f;
    }
    float thick = fmaxf(point->depth + point->displacement.y, 0.0f);
    float patchy = 0.75f + 0.9f * lumps_at(point->place.x, point->place.y, apart, point->width);
    float near = smoothstepf(sheet, 0.0f, thick);
    return waves->swash * most * near * near * clampf(patchy, 0.0f, 1.5f);
}

WaveFoam waves_foam(const Waves *waves, const WavePoint *point)
{
    // In surf waves of any steepness break, and the foam of a breaker lasts to the next one. In the
    // open sea few crests roll at a time; what they leave lasts longer.
    const float dense = 0.8f, widest = 0.6f, most = 0.6f;
    float spread = waves->spread;
    float from = waves->foam * (1.0f - 0.9f * point->breaking);
    float crest = dense * roller(waves, point, from);
    float trail = point->breaking * smoothstepf(from, from + 2.2f * spread, point->trail);
    float surf = point->drift > 0.0f ? old_surf(waves, point) : 0.0f;
    float lines = waves->streaks > 0.0f ? fminf(streaks(waves, point), most) : 0.0f;
    float left = point->left * point->left, lace = swash_lace(waves, point);
    float old = 1.0f - (1.0f - 0.75f * trail) * (1.0f - surf) * (1.0f - lines) *
                           (1.0f - widest * left) * (1.0f - lace);
    crest = fmaxf(crest, dense * swash_lip(waves, point));
    float cover = fmaxf(crest, old);
    float bubbles = fmaxf(cover, fmaxf(point->left, trail));
    return (WaveFoam){cover, cover > 0.0f ? crest / cover : 0.0f, bubbles};
}
