#include "mesh/leaf.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "base/triangle.h"

#include <stddef.h>

// A leaf is a grid of rows along the midrib and columns across, with a three-sided stalk below it.
enum { STALK_SIDES = 3, BLADE_ROWS = 4, BLADE_ROWS_COARSE = 3 };

enum { STREAM_LOBE_PHASE = 1, STREAM_LOBE_SHIFT = 2 }; // of a leaf

// Random streams of a grass blade.
enum {
    STREAM_AZIMUTH = 1,
    STREAM_DISTANCE = 2,
    STREAM_TURN = 3,
    STREAM_HEIGHT = 4,
    STREAM_WIDTH = 5,
    STREAM_LEAN = 6,
    STREAM_BEND = 7
};

// Grid of a leaf's blade.
typedef struct LeafGrid {
    int rows, columns;
} LeafGrid;

static LeafGrid leaf_grid(const LeafParams *params)
{
    bool fine = params->detail > 1;
    if (params->lobes == 0) {
        return (LeafGrid){fine ? 12 : 6, fine ? 5 : 3};
    }
    return (LeafGrid){(fine ? 6 : 2) * params->lobes + 1, fine ? 5 : 3};
}

// Half width of the blade at t in 0..1 along it, relative to the largest: an obovate oval, widest
// at 0.62, cut by the bays between the lobes.
static float outline(const LeafParams *params, float t, float phase)
{
    const float a = 0.9f, b = 0.55f, peak = a / (a + b);
    float oval = exact_pow(t / peak, a) * exact_pow((1.0f - t) / (1.0f - peak), b);
    if (params->lobes == 0) {
        return oval;
    }
    float sine, cosine;
    exact_sincos(2.0f * PI_F * ((float)params->lobes * t + phase), &sine, &cosine);
    // The squared raised cosine makes bays narrow and lobes broad.
    float bay = 0.5f + 0.5f * cosine;
    float reach = smoothstepf(0.02f, 0.25f, t) * smoothstepf(1.02f, 0.8f, t);
    return oval * (1.0f - params->lobe_depth * bay * bay * reach);
}

// A vertex of the blade: x across, t along the midrib, folded, rippled and curled.
static Vec3 blade_point(const LeafParams *params, float x, float t, float ripple)
{
    float fold_sine, fold_cosine, sine, cosine;
    exact_sincos(params->fold * RADIANS_PER_DEGREE, &fold_sine, &fold_cosine);
    float lift = (x < 0.0f ? -x : x) * fold_sine + ripple;
    // The midrib bends by `curl` over the blade's length, mostly toward the tip.
    float angle = params->curl * RADIANS_PER_DEGREE * t * t;
    exact_sincos(angle, &sine, &cosine);
    float along = params->petiole + params->length * t * (1.0f - 0.12f * angle * angle);
    float down = params->length * t * sine * 0.4f;
    return vec3(x * fold_cosine, along + lift * sine, lift * cosine - down);
}

static void add_blade(Mesh *mesh, const LeafParams *params, LeafGrid grid, uint64_t seed)
{
    float phase = random_range(random_key(seed, STREAM_LOBE_PHASE), -0.15f, 0.15f);
    float side_shift = random_range(random_key(seed, STREAM_LOBE_SHIFT), 0.1f, 0.35f);
    for (int r = 0; r < grid.rows; r++) {
        float t = (float)r / (float)(grid.rows - 1);
        for (int c = 0; c < grid.columns; c++) {
            float across = (float)c / (float)(grid.columns - 1) * 2.0f - 1.0f;
            // The lobes of the two sides are slightly offset.
            float half = outline(params, clampf(t, 0.012f, 0.985f),
                                 phase + (across < 0.0f ? side_shift : 0.0f));
            float x = 0.5f * params->width * half * across;
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (3.0f * t + phase + 0.3f * across), &sine, &cosine);
            float ripple = params->wave * params->width * sine * across * across * half;
            int64_t v = (int64_t)r * grid.columns + c;
            mesh->position[v] = blade_point(params, x, t, ripple);
            mesh->uv[v] = (Vec2){0.5f + 0.5f * across, t};
        }
    }
    uint32_t *face = mesh->index;
    for (int r = 0; r + 1 < grid.rows; r++) {
        for (int c = 0; c + 1 < grid.columns; c++) {
            uint32_t v = (uint32_t)(r * grid.columns + c), up = v + (uint32_t)grid.columns;
            uint32_t corners[4] = {v, v + 1, up + 1, up};
            for (int k = 0; k < 4; k++) {
                *face++ = corners[k];
            }
        }
    }
}

static void add_stalk(Mesh *mesh, const LeafParams *params, int64_t first_vertex,
                      int64_t first_face)
{
    float thickness = 0.006f * params->length;
    for (int end = 0; end < 2; end++) {
        for (int k = 0; k < STALK_SIDES; k++) {
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (float)k / STALK_SIDES, &sine, &cosine);
            // The stalk continues below the blade's base, where the midrib begins.
            float y = end ? params->petiole + 0.04f * params->length : 0.0f;
            int64_t v = first_vertex + (int64_t)end * STALK_SIDES + k;
            mesh->position[v] = vec3(thickness * cosine, y, thickness * (sine - 0.8f));
            mesh->uv[v] = (Vec2){0.5f, 0.0f};
        }
    }
    for (int k = 0; k < STALK_SIDES; k++) {
        uint32_t a = (uint32_t)(first_vertex + k);
        uint32_t b = (uint32_t)(first_vertex + (k + 1) % STALK_SIDES);
        uint32_t corners[4] = {a, a + STALK_SIDES, b + STALK_SIDES, b};
        for (int c = 0; c < 4; c++) {
            mesh->index[(first_face + k) * 4 + c] = corners[c];
        }
    }
}

Mesh *leaf_mesh_new(const LeafParams *params, uint64_t seed, Error *e)
{
    LeafGrid grid = leaf_grid(params);
    int64_t blade_vertices = (int64_t)grid.rows * grid.columns;
    int64_t blade_faces = (int64_t)(grid.rows - 1) * (grid.columns - 1);
    bool stalk = params->petiole > 0.0f;
    Mesh *mesh = mesh_new(4, blade_vertices + (stalk ? 2 * STALK_SIDES : 0),
                          blade_faces + (stalk ? STALK_SIDES : 0), MESH_NORMAL | MESH_UV, e);
    if (!mesh) {
        return NULL;
    }
    add_blade(mesh, params, grid, seed);
    if (stalk) {
        add_stalk(mesh, params, blade_vertices, blade_faces);
    }
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

// ---- simpler leaves ----

static double mesh_area(const Mesh *mesh, int64_t faces)
{
    double area = 0.0;
    for (int64_t f = 0; f < faces; f++) {
        const uint32_t *corner = mesh->index + 4 * f;
        Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]];
        Vec3 c = mesh->position[corner[2]], d = mesh->position[corner[3]];
        Vec3 abc = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
        Vec3 acd = vec3_cross(vec3_sub(c, a), vec3_sub(d, a));
        area += 0.5 * (double)(vec3_length(abc) + vec3_length(acd));
    }
    return area;
}

// Largest distance of the first `vertices` of fine from the faces of coarse.
static float mesh_distance(const Mesh *fine, int64_t vertices, const Mesh *coarse)
{
    float largest = 0.0f;
    for (int64_t v = 0; v < vertices; v++) {
        float nearest = INFINITY;
        for (int64_t f = 0; f < coarse->face_count; f++) {
            for (int k = 0; k < 2; k++) {
                const uint32_t *corner = coarse->index + 4 * f;
                Vec3 on =
                    triangle_nearest(coarse->position[corner[0]], coarse->position[corner[k + 1]],
                                     coarse->position[corner[k + 2]], fine->position[v]);
                nearest = fminf(nearest, vec3_distance(on, fine->position[v]));
            }
        }
        largest = fmaxf(largest, nearest);
    }
    return largest;
}

// One quad: left, base, right and tip, since Embree folds a quad along the line from its second
// corner to its fourth.
static void add_kite(Mesh *mesh, const LeafParams *params)
{
    const float widest = 0.55f, half = 0.5f * params->width;
    const float along[4] = {widest, 0.0f, widest, 1.0f}, side[4] = {-1.0f, 0.0f, 1.0f, 0.0f};
    for (uint32_t i = 0; i < 4; i++) {
        mesh->position[i] = blade_point(params, side[i] * half, along[i], 0.0f);
        mesh->uv[i] = (Vec2){0.5f + 0.5f * side[i], along[i]};
        mesh->index[i] = i;
    }
}

// Scales x, across the leaf.
static void widen(Mesh *mesh, float factor)
{
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        mesh->position[v].x *= factor;
    }
}

Mesh *leaf_mesh_coarse(const LeafParams *params, uint64_t seed, int level, float *error, Error *e)
{
    LeafGrid grid = leaf_grid(params);
    Mesh *fine = leaf_mesh_new(params, seed, e);
    bool kite = level > 0;
    LeafGrid plain = {5, 3};
    Mesh *mesh = !fine  ? NULL
                 : kite ? mesh_new(4, 4, 1, MESH_NORMAL | MESH_UV, e)
                        : mesh_new(4, (int64_t)plain.rows * plain.columns,
                                   (int64_t)(plain.rows - 1) * (plain.columns - 1),
                                   MESH_NORMAL | MESH_UV, e);
    if (mesh && kite) {
        add_kite(mesh, params);
    } else if (mesh) {
        LeafParams smooth = *params;
        smooth.lobes = 0;
        add_blade(mesh, &smooth, plain, seed);
    }
    if (mesh) {
        double area = mesh_area(fine, (int64_t)(grid.rows - 1) * (grid.columns - 1));
        widen(mesh, (float)(area / mesh_area(mesh, mesh->face_count)));
        *error = mesh_distance(fine, (int64_t)grid.rows * grid.columns, mesh);
    }
    mesh_free(fine);
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

// ---- grass ----

typedef struct Blade {
    Vec3 out, side, base;
    float height, width; // m
    float lean, bend;    // degrees
} Blade;

static Blade blade_of(const GrassParams *params, uint64_t key)
{
    Blade blade;
    float sine, cosine;
    exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine, &cosine);
    blade.out = vec3(cosine, 0, sine);
    blade.side = vec3(-sine, 0, cosine);
    float place = params->spread * sqrtf(random_unit(random_key(key, STREAM_DISTANCE)));
    float turn = random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F);
    exact_sincos(turn, &sine, &cosine);
    blade.base = vec3(place * cosine, 0, place * sine);
    blade.height = params->height * random_range(random_key(key, STREAM_HEIGHT), 0.45f, 1.0f);
    blade.width = params->width * random_range(random_key(key, STREAM_WIDTH), 0.6f, 1.0f);
    blade.lean = params->lean * random_unit(random_key(key, STREAM_LEAN));
    blade.bend = params->bend * random_unit(random_key(key, STREAM_BEND));
    return blade;
}

// Blade number `number` of the mesh: `rows` pairs of vertices along an arc that leaves the ground
// at angle `lean` and bends over.
static void add_grass_blade(Mesh *mesh, const Blade *blade, int rows, int64_t number)
{
    Vec3 p = blade->base;
    int64_t first = number * rows * 2;
    for (int r = 0; r < rows; r++) {
        float t = (float)r / (float)(rows - 1), sine, cosine;
        float half = 0.5f * blade->width * (1.0f - 0.92f * t * t);
        mesh->position[first + 2 * r] = vec3_madd(p, -half, blade->side);
        mesh->position[first + 2 * r + 1] = vec3_madd(p, half, blade->side);
        mesh->uv[first + 2 * r] = (Vec2){0, t};
        mesh->uv[first + 2 * r + 1] = (Vec2){1, t};
        exact_sincos((blade->lean + blade->bend * t * t) * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 d = vec3_madd(vec3(0, cosine, 0), sine, blade->out);
        p = vec3_madd(p, blade->height / (float)(rows - 1), d);
    }
    for (int r = 0; r + 1 < rows; r++) {
        uint32_t v = (uint32_t)(first + (int64_t)2 * r);
        uint32_t *face = mesh->index + (number * (rows - 1) + r) * 4;
        face[0] = v;
        face[1] = v + 1;
        face[2] = v + 3;
        face[3] = v + 2;
    }
}

// One blade of every `stride`, as wide as to have the area of all of them. *width: their mean
// width.
static Mesh *tuft_new(const GrassParams *params, uint64_t seed, int rows, int stride, float *width,
                      Error *e)
{
    int64_t blades = (params->blades + stride - 1) / stride;
    Mesh *mesh = mesh_new(4, blades * rows * 2, blades * (rows - 1), MESH_NORMAL | MESH_UV, e);
    float widths = 0.0f;
    for (int i = 0; mesh && i < blades; i++) {
        Blade blade = blade_of(params, random_key(seed, (uint64_t)i * (uint64_t)stride));
        float area = blade.width * blade.height;
        for (int k = i * stride + 1; k < (i + 1) * stride && k < params->blades; k++) {
            Blade other = blade_of(params, random_key(seed, (uint64_t)k));
            area += other.width * other.height;
        }
        blade.width = stride > 1 ? area / blade.height : blade.width;
        widths += blade.width;
        add_grass_blade(mesh, &blade, rows, i);
    }
    *width = widths / (float)blades;
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

Mesh *grass_tuft_new(const GrassParams *params, uint64_t seed, Error *e)
{
    float width;
    return tuft_new(params, seed, BLADE_ROWS, 1, &width, e);
}

Mesh *grass_tuft_coarse(const GrassParams *params, uint64_t seed, int level, float *error, Error *e)
{
    return tuft_new(params, seed, BLADE_ROWS_COARSE, level > 0 ? 4 : 2, error, e);
}
