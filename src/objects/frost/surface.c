#include "objects/frost/surface.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <stddef.h>

#define STREAM_BORDER_OFFSET UINT64_MAX // of the nuclei; nucleus i uses stream i
enum { STREAM_X = 0, STREAM_Y = 1 };    // of a point or nucleus on the pane

#define GOLDEN_TURN 0.61803398875 // of a circle

float frost_area(const FrostParams *params)
{
    return params->surface == FROST_PANE ? params->width * params->height
                                         : 4.0f * PI_F * params->radius * params->radius;
}

float frost_side_spacing(const FrostParams *params)
{
    int64_t count = params->sides > 0 ? params->sides : 20 * params->spines;
    return sqrtf(frost_area(params) / (float)count);
}

Vec3 frost_project(const FrostParams *params, Vec3 *p)
{
    Vec3 d = vec3_sub(*p, params->position);
    if (params->surface == FROST_PANE) {
        d.x = clampf(d.x, -0.5f * params->width, 0.5f * params->width);
        d.y = clampf(d.y, -0.5f * params->height, 0.5f * params->height);
        *p = vec3(params->position.x + d.x, params->position.y + d.y, params->position.z);
        return vec3(0, 0, 1);
    }
    Vec3 normal = vec3_dot(d, d) > 0.0f ? vec3_normalize(d) : vec3(0, -1, 0);
    *p = vec3_madd(params->position, params->radius, normal);
    return normal;
}

// One point per square cell, at random in its middle 80 %.
static bool fill_pane(const FrostParams *params, int64_t count, uint64_t seed, PointSet *points,
                      const Run *run, Error *e)
{
    float cell = sqrtf(frost_area(params) / (float)count);
    int64_t columns = (int64_t)(params->width / cell + 0.5f);
    int64_t rows = (int64_t)(params->height / cell + 0.5f);
    columns = columns > 0 ? columns : 1;
    rows = rows > 0 ? rows : 1;
    for (int64_t i = 0; i < columns * rows; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        int64_t row = i / columns, column = i % columns;
        float x = (float)column + random_range(random_key(key, STREAM_X), 0.1f, 0.9f);
        float y = (float)row + random_range(random_key(key, STREAM_Y), 0.1f, 0.9f);
        Vec3 p = vec3_add(params->position, vec3((x / (float)columns - 0.5f) * params->width,
                                                 (y / (float)rows - 0.5f) * params->height, 0.0f));
        if (!run_goes_on(run, i, e) || !points_add(points, p, vec3(0, 0, 1), key, e)) {
            return false;
        }
    }
    return true;
}

// A Fibonacci spiral, each point moved at random within about its own cell.
static bool fill_bubble(const FrostParams *params, int64_t count, uint64_t seed, PointSet *points,
                        const Run *run, Error *e)
{
    float cell = sqrtf(4.0f * PI_F / (float)count);
    for (int64_t i = 0; i < count; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float y = 1.0f - (2.0f * (float)i + 1.0f) / (float)count, s, c;
        double turn = GOLDEN_TURN * (double)i;
        exact_sincos((float)(turn - (double)(int64_t)turn) * 2.0f * PI_F, &s, &c);
        float r = sqrtf(clampf(1.0f - y * y, 0.0f, 1.0f));
        Vec3 d = vec3_madd(vec3(r * s, y, r * c), 0.4f * cell, random_direction(key));
        Vec3 p = vec3_madd(params->position, params->radius, vec3_normalize(d));
        Vec3 normal = frost_project(params, &p);
        if (!run_goes_on(run, i, e) || !points_add(points, p, normal, key, e)) {
            return false;
        }
    }
    return true;
}

PointSet *frost_points(const FrostParams *params, int64_t count, uint64_t seed, const Run *run,
                       Error *e)
{
    PointSet *points = points_new(e);
    if (!points) {
        return NULL;
    }
    points->measure = (double)frost_area(params);
    points->dimension = 2;
    bool done = params->surface == FROST_PANE ? fill_pane(params, count, seed, points, run, e)
                                              : fill_bubble(params, count, seed, points, run, e);
    if (!done) {
        points_free(points);
        return NULL;
    }
    return points;
}

// The point of the pane's border at a share of its perimeter, from the lower left corner to the
// right.
static Vec3 border_point(const FrostParams *params, float share)
{
    float w = params->width, h = params->height, s = share * 2.0f * (w + h), x, y;
    if (s < w) {
        x = s, y = 0.0f;
    } else if (s < w + h) {
        x = w, y = s - w;
    } else if (s < 2.0f * w + h) {
        x = 2.0f * w + h - s, y = h;
    } else {
        x = 0.0f, y = 2.0f * (w + h) - s;
    }
    return vec3_add(params->position, vec3(x - 0.5f * w, y - 0.5f * h, 0.0f));
}

Vec3 frost_nucleus(const FrostParams *params, int i, uint64_t seed, Vec3 *normal)
{
    uint64_t key = random_key(seed, (uint64_t)i);
    Vec3 p;
    if (i < params->nucleus_count) {
        p = params->nucleus[i].position;
    } else if (params->surface == FROST_BUBBLE) {
        Vec3 d = i == 0 ? vec3(0, -1, 0) : random_direction(key);
        p = vec3_madd(params->position, params->radius, d);
    } else if (params->place == FROST_BORDER) {
        float offset = random_unit(random_key(seed, STREAM_BORDER_OFFSET));
        float share = ((float)i + random_range(key, 0.15f, 0.85f)) / (float)params->nuclei + offset;
        p = border_point(params, share - (float)(int)share);
    } else {
        p = vec3_add(params->position,
                     vec3(random_range(random_key(key, STREAM_X), -0.5f, 0.5f) * params->width,
                          random_range(random_key(key, STREAM_Y), -0.5f, 0.5f) * params->height,
                          0.0f));
    }
    *normal = frost_project(params, &p);
    return p;
}

int frost_nucleus_total(const FrostParams *params)
{
    return params->nucleus_count > 0 ? params->nucleus_count : params->nuclei;
}

float frost_depth(const FrostParams *params, Vec3 p)
{
    Vec3 d = vec3_sub(p, params->position);
    if (params->surface == FROST_BUBBLE) {
        return clampf(0.5f + 0.5f * d.y / params->radius, 0.0f, 1.0f);
    }
    float x = 0.5f * params->width - fabsf(d.x), y = 0.5f * params->height - fabsf(d.y);
    float half = 0.5f * (params->width < params->height ? params->width : params->height);
    return clampf((x < y ? x : y) / half, 0.0f, 1.0f);
}
