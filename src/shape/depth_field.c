#include "shape/depth_field.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { CELLS = 96, BISECTIONS = 8, SWEEPS = 8 };

static Vec3 node_position(const DepthField *f, int x, int y, int z)
{
    return vec3_madd(f->origin, f->spacing, vec3((float)x, (float)y, (float)z));
}

static int64_t node_index(const DepthField *f, int x, int y, int z)
{
    return ((int64_t)x * f->size[1] + y) * f->size[2] + z;
}

// Distance from the inner point p along step (a grid edge) to where the edge crosses the surface.
static float crossing(const Envelope *envelope, Vec3 p, Vec3 step)
{
    float low = 0.0f, high = 1.0f;
    for (int i = 0; i < BISECTIONS; i++) {
        float middle = 0.5f * (low + high);
        if (envelope_contains(envelope, vec3_madd(p, middle, step))) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5f * (low + high) * vec3_length(step);
}

// Depth of an inner node with an outer neighbour, assuming a locally flat surface; INFINITY for
// nodes without one.
static float border_depth(const DepthField *f, const float *depth, int x, int y, int z)
{
    static const int side[6][3] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                   {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};
    Vec3 p = node_position(f, x, y, z);
    float nearest[3] = {INFINITY, INFINITY, INFINITY}, sum = 0.0f;
    for (int i = 0; i < 6; i++) {
        int a = x + side[i][0], b = y + side[i][1], c = z + side[i][2];
        if (depth[node_index(f, a, b, c)] == 0.0f) {
            Vec3 step = vec3_scale(vec3((float)side[i][0], (float)side[i][1], (float)side[i][2]),
                                   f->spacing);
            nearest[i / 2] = fminf(nearest[i / 2], crossing(f->envelope, p, step));
        }
    }
    for (int i = 0; i < 3; i++) {
        sum += 1.0f / (nearest[i] * nearest[i]);
    }
    return 1.0f / sqrtf(sum);
}

// Of numbers: instructions, where fminf and fmaxf are calls.
static inline float lower(float a, float b)
{
    return a < b ? a : b;
}

static inline float higher(float a, float b)
{
    return a > b ? a : b;
}

// Solves sum over axes of max(0, u - a_i)^2 = h^2 for the smallest u.
static inline float solve_node(float x, float y, float z, float h)
{
    float low = lower(x, y), high = higher(x, y), rest = higher(low, z);
    float a = lower(low, z), b = lower(high, rest), c = higher(high, rest); // sorted
    float u = a + h;
    if (u > b) {
        u = 0.5f * (a + b + sqrtf(higher(2.0f * h * h - (a - b) * (a - b), 0.0f)));
    }
    if (u > c) {
        float sum = a + b + c, squares = a * a + b * b + c * c;
        u = (sum + sqrtf(higher(sum * sum - 3.0f * (squares - h * h), 0.0f))) / 3.0f;
    }
    return u;
}

// One pass over the grid; the bits of `way` choose the direction along each axis. False if it
// changes nothing: then no other would.
static bool sweep(DepthField *f, int way)
{
    bool changed = false;
    int64_t sx = (int64_t)f->size[1] * f->size[2], sy = f->size[2];
    int n[3] = {f->size[0] - 2, f->size[1] - 2, f->size[2] - 2};
    for (int i = 0; i < n[0]; i++) {
        for (int j = 0; j < n[1]; j++) {
            for (int k = 0; k < n[2]; k++) {
                int64_t at =
                    node_index(f, 1 + (way & 1 ? n[0] - 1 - i : i),
                               1 + (way & 2 ? n[1] - 1 - j : j), 1 + (way & 4 ? n[2] - 1 - k : k));
                float *d = f->depth;
                if (d[at] > 0.0f) {
                    float u =
                        solve_node(lower(d[at - sx], d[at + sx]), lower(d[at - sy], d[at + sy]),
                                   lower(d[at - 1], d[at + 1]), f->spacing);
                    changed |= u < d[at];
                    d[at] = lower(d[at], u);
                }
            }
        }
    }
    return changed;
}

// Initialises outer nodes to 0 and inner ones to their depth where known, else to INFINITY.
static void start_nodes(DepthField *f)
{
    float band = envelope_band(f->envelope);
    for (int x = 0; x < f->size[0]; x++) {
        for (int y = 0; y < f->size[1]; y++) {
            for (int z = 0; z < f->size[2]; z++) {
                float d = envelope_distance(f->envelope, node_position(f, x, y, z));
                f->depth[node_index(f, x, y, z)] =
                    d >= 0.0f ? 0.0f : (d > -0.99f * band ? -d : INFINITY);
            }
        }
    }
}

static bool solve(DepthField *f, Error *e)
{
    int64_t count = (int64_t)f->size[0] * f->size[1] * f->size[2];
    f->depth = memory_alloc(count, sizeof *f->depth, e);
    if (!f->depth) {
        return false;
    }
    start_nodes(f);
    for (int x = 1; x < f->size[0] - 1; x++) {
        for (int y = 1; y < f->size[1] - 1; y++) {
            for (int z = 1; z < f->size[2] - 1; z++) {
                float *d = &f->depth[node_index(f, x, y, z)];
                if (isinf(*d)) {
                    *d = border_depth(f, f->depth, x, y, z);
                }
            }
        }
    }
    // sweeps may lower a border node too, when its nearest surface point lies elsewhere
    bool changed = true;
    for (int i = 0; i < SWEEPS && changed; i++) {
        changed = sweep(f, i);
    }
    for (int64_t i = 0; i < count; i++) {
        f->deepest = higher(f->deepest, f->depth[i]);
    }
    return true;
}

// From a node at this distance, how many ahead are no deeper than what is found: an exact distance
// changes by no more than the way.
static int nodes_no_deeper(const DepthField *f, float distance)
{
    float way = 0.999f * (f->deepest + distance); // less, for rounding
    return envelope_is_exact(f->envelope) ? (int)fminf(way / f->spacing, (float)CELLS) : 0;
}

static void find_deepest(DepthField *f)
{
    for (int x = 0; x < f->size[0]; x++) {
        for (int y = 0; y < f->size[1]; y++) {
            for (int z = 0; z < f->size[2]; z++) {
                float d = envelope_distance(f->envelope, node_position(f, x, y, z));
                f->deepest = fmaxf(f->deepest, -d);
                z += nodes_no_deeper(f, d);
            }
        }
    }
}

// A grid centred on the envelope's bounds; clamped: its distances do not reach the deepest point.
static void place_grid(DepthField *f, bool clamped)
{
    Aabb box = envelope_bounds(f->envelope);
    Vec3 size = vec3_sub(box.high, box.low);
    // the maximum of an exact distance needs only a coarse grid
    float cells = clamped ? (float)CELLS : (float)CELLS / 3.0f;
    f->spacing = fmaxf(size.x, fmaxf(size.y, size.z)) / cells;
    float extent[3] = {size.x, size.y, size.z}, origin[3] = {box.low.x, box.low.y, box.low.z};
    for (int i = 0; i < 3; i++) {
        // at least two outer nodes on each side
        f->size[i] = (int)(extent[i] / f->spacing) + 5;
        origin[i] -= 0.5f * ((float)(f->size[i] - 1) * f->spacing - extent[i]);
    }
    f->origin = vec3(origin[0], origin[1], origin[2]);
}

DepthField *depth_field_new(const Envelope *envelope, Error *e)
{
    DepthField *f = memory_alloc_zero(1, sizeof *f, e);
    if (!f) {
        return NULL;
    }
    f->envelope = envelope;
    bool clamped = isfinite(envelope_band(envelope));
    place_grid(f, clamped);
    if (!clamped) {
        find_deepest(f);
    } else if (!solve(f, e)) {
        depth_field_free(f);
        return NULL;
    }
    return f;
}

void depth_field_free(DepthField *field)
{
    if (field) {
        free(field->depth);
        free(field);
    }
}

static float grid_depth(const DepthField *f, Vec3 p)
{
    Vec3 local = vec3_scale(vec3_sub(p, f->origin), 1.0f / f->spacing);
    float at[3] = {local.x, local.y, local.z}, t[3];
    int c[3];
    for (int i = 0; i < 3; i++) {
        at[i] = clampf(at[i], 0.0f, (float)(f->size[i] - 2) + 0.999f);
        c[i] = (int)at[i];
        t[i] = at[i] - (float)c[i];
    }
    float v[8];
    for (int i = 0; i < 8; i++) {
        v[i] = f->depth[node_index(f, c[0] + (i >> 2), c[1] + (i >> 1 & 1), c[2] + (i & 1))];
    }
    for (int i = 0; i < 4; i++) {
        v[i] = lerpf(v[i], v[i + 4], t[0]);
    }
    return lerpf(lerpf(v[0], v[2], t[1]), lerpf(v[1], v[3], t[1]), t[2]);
}

float depth_field_at(const DepthField *f, Vec3 p)
{
    // within the band the envelope is more accurate than the coarse grid
    float distance = envelope_distance(f->envelope, p);
    bool clamped = f->depth && distance <= -0.9f * envelope_band(f->envelope);
    float depth = clamped ? grid_depth(f, p) : -distance;
    return f->deepest > 0.0f ? clampf(depth / f->deepest, 0.0f, 1.0f) : 0.0f;
}
