#include "model/crack.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <stdlib.h>

enum { CELLS = 40, OCTAVES = 3 }; // cells along the longest side of the box

typedef struct Sheet {
    Vec3 a, b, c;
} Sheet;

struct Crack {
    CrackParams params;
    Sheet *sheet;
    int64_t sheet_count;
    Vec3 low;
    float cell;
    int64_t size[3];
    int64_t *first;  // per cell, and the end: places in `listed`
    int32_t *listed; // sheets known somewhere in the cell
    int64_t listed_capacity;
};

static float segment_distance2(Vec3 p, Vec3 a, Vec3 b)
{
    Vec3 along = vec3_sub(b, a), to = vec3_sub(p, a);
    float length2 = vec3_dot(along, along);
    float t = length2 > 0.0f ? clampf(vec3_dot(to, along) / length2, 0.0f, 1.0f) : 0.0f;
    Vec3 d = vec3_madd(to, -t, along);
    return vec3_dot(d, d);
}

float triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c)
{
    Vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    float n2 = vec3_dot(n, n);
    Vec3 pa = vec3_sub(p, a), pb = vec3_sub(p, b), pc = vec3_sub(p, c);
    bool over = n2 > 0.0f && vec3_dot(vec3_cross(vec3_sub(b, a), pa), n) >= 0.0f &&
                vec3_dot(vec3_cross(vec3_sub(c, b), pb), n) >= 0.0f &&
                vec3_dot(vec3_cross(vec3_sub(a, c), pc), n) >= 0.0f;
    if (over) {
        return fabsf(vec3_dot(pa, n)) / sqrtf(n2);
    }
    float d2 = segment_distance2(p, a, b), e2 = segment_distance2(p, b, c);
    float f2 = segment_distance2(p, c, a);
    d2 = e2 < d2 ? e2 : d2;
    return sqrtf(f2 < d2 ? f2 : d2);
}

static Vec3 displaced(const Crack *crack, Vec3 p)
{
    float height = 2.0f * crack->params.roughness, scale = 1.0f / crack->params.wavelength;
    Vec3 moved = p;
    for (int k = 0; k < OCTAVES && height > 0.0f; k++) {
        Vec3 q = vec3_scale(p, scale);
        uint64_t key = random_key(crack->params.seed, (uint64_t)k);
        Vec3 noise = vec3(noise_space(q, random_key(key, 0)), noise_space(q, random_key(key, 1)),
                          noise_space(q, random_key(key, 2)));
        moved = vec3_madd(moved, height, noise);
        scale *= 2.3f;
        height *= 0.45f;
    }
    return moved;
}

static int64_t column_of(const Crack *crack, int axis, float offset)
{
    int64_t c = offset > 0.0f ? (int64_t)(offset / crack->cell) : 0;
    return c < crack->size[axis] ? c : crack->size[axis] - 1;
}

float crack_distance(const Crack *crack, Vec3 at)
{
    Vec3 p = displaced(crack, at), d = vec3_sub(p, crack->low);
    int64_t cell =
        (column_of(crack, 0, d.x) * crack->size[1] + column_of(crack, 1, d.y)) * crack->size[2] +
        column_of(crack, 2, d.z);
    float least = crack->params.known;
    for (int64_t i = crack->first[cell]; i < crack->first[cell + 1]; i++) {
        const Sheet *s = &crack->sheet[crack->listed[i]];
        float distance = triangle_distance(p, s->a, s->b, s->c);
        least = distance < least ? distance : least;
    }
    return least;
}

// From a bar to the centre one triangle, to the axis two; a little of it lies outside.
static void add_sheets(Crack *crack, Vec3 a, Vec3 b)
{
    const CrackParams *params = &crack->params;
    Vec3 foot_a = params->center, foot_b = params->center;
    if (params->to_axis) {
        foot_a.y = a.y;
        foot_b.y = b.y;
    }
    a = vec3_madd(a, params->outward, vec3_normalize(vec3_sub(a, foot_a)));
    b = vec3_madd(b, params->outward, vec3_normalize(vec3_sub(b, foot_b)));
    crack->sheet[crack->sheet_count++] = (Sheet){a, b, foot_a};
    if (params->to_axis) {
        crack->sheet[crack->sheet_count++] = (Sheet){b, foot_b, foot_a};
    }
}

static bool list_sheets(Crack *crack, const Run *run, Error *e)
{
    int64_t cells = crack->size[0] * crack->size[1] * crack->size[2], count = 0;
    float reach = crack->params.known + 0.8660255f * crack->cell;
    for (int64_t c = 0; c < cells; c++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        crack->first[c] = count;
        int64_t z = c % crack->size[2], row = c / crack->size[2];
        int64_t y = row % crack->size[1], x = row / crack->size[1];
        Vec3 index = vec3((float)x, (float)y, (float)z);
        Vec3 middle = vec3_madd(crack->low, crack->cell, vec3_add(index, vec3_splat(0.5f)));
        for (int64_t i = 0; i < crack->sheet_count; i++) {
            const Sheet *s = &crack->sheet[i];
            if (triangle_distance(middle, s->a, s->b, s->c) <= reach) {
                if (!memory_reserve(&crack->listed, &crack->listed_capacity, count + 1,
                                    sizeof *crack->listed, e)) {
                    return false;
                }
                crack->listed[count++] = (int32_t)i;
            }
        }
    }
    crack->first[cells] = count;
    return true;
}

static bool crack_fill(Crack *crack, const OutTree *network, Aabb box, const Run *run, Error *e)
{
    float margin = 2.0f * crack->params.roughness; // displaced points stay in the grid
    crack->low = vec3_sub(box.low, vec3_splat(margin));
    Vec3 extent = vec3_add(vec3_sub(box.high, crack->low), vec3_splat(margin));
    float longest = extent.x > extent.y ? extent.x : extent.y;
    crack->cell = (longest > extent.z ? longest : extent.z) / CELLS;
    crack->size[0] = (int64_t)(extent.x / crack->cell) + 1;
    crack->size[1] = (int64_t)(extent.y / crack->cell) + 1;
    crack->size[2] = (int64_t)(extent.z / crack->cell) + 1;
    crack->sheet = memory_alloc(2 * network->count, sizeof *crack->sheet, e);
    crack->first =
        memory_alloc(crack->size[0] * crack->size[1] * crack->size[2] + 1, sizeof *crack->first, e);
    if (!crack->sheet || !crack->first) {
        return false;
    }
    for (int64_t i = 0; i < network->count; i++) {
        if (network->parent[i] >= 0) {
            add_sheets(crack, network->position[network->parent[i]], network->position[i]);
        }
    }
    return list_sheets(crack, run, e);
}

Crack *crack_new(const OutTree *network, const CrackParams *params, Aabb box, const Run *run,
                 Error *e)
{
    Crack *crack = memory_alloc_zero(1, sizeof *crack, e);
    if (!crack) {
        return NULL;
    }
    crack->params = *params;
    if (!crack_fill(crack, network, box, run, e)) {
        crack_free(crack);
        return NULL;
    }
    return crack;
}

void crack_free(Crack *crack)
{
    if (crack) {
        free(crack->sheet);
        free(crack->first);
        free(crack->listed);
        free(crack);
    }
}
