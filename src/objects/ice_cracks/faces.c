// The faces of cracks in ice: along each arm a grid of grains from the ice's surface down, of which
// the open parts are kept, cut where the ice has healed and where the crack ends below.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/ice_cracks/ice_cracks.h"

#include <stdlib.h>

enum { STREAM_FACES = 3, STREAM_DEPTH = 4 }; // of the object's seed
// Of the faces' key.
enum { STREAM_OPEN = 1, STREAM_TILT = 2, STREAM_BULGE = 3, STREAM_HACKLE = 4, STREAM_FOOT = 5 };
enum { OPEN_OCTAVES = 6 };

#define NOISE_RMS 0.25f // of noise_plane and noise_space
#define BURIED 0.1f     // grains: how far below the ice's surface faces begin
#define SEAM 3.0f       // grains from the surface in which nothing heals: vapour keeps it open
#define BULGE 0.12f     // of the depth
#define HACKLE 0.25f    // grains: height of the finest relief

// An arm as a grid: columns along its path, rows from the surface down.
typedef struct Sheet {
    const IceCracksParams *params;
    uint64_t seed, key; // of the object; of its faces
    float grain;        // m
    float threshold;    // of the openness: below it the crack has healed
    const OutTree *tree;
    int64_t columns, rows;
    Vec3 *position;  // m, columns * rows
    float *value;    // the same: what is above 0 is kept
    int32_t *at[3];  // the same: vertices at the corner, on the edge to the next row, column; -1
    int64_t corners; // capacity of these arrays
} Sheet;

// What the arms' kept parts make.
typedef struct Faces {
    Vec3 *position;
    uint32_t *index;
    int64_t vertices, indices, vertex_capacity, index_capacity;
} Faces;

// ---- the form of a face

// How open the crack is at p, of rms 1: patches, and ever finer ones down to the grain.
static float openness(const Sheet *sheet, Vec3 p)
{
    float wave = 0.5f * sheet->params->depth, weight = 1.0f, sum = 0.0f, squares = 0.0f;
    uint64_t key = random_key(sheet->key, STREAM_OPEN);
    for (uint64_t k = 0; k < OPEN_OCTAVES && (k == 0 || wave > 2.0f * sheet->grain); k++) {
        Vec3 q = vec3(p.x / wave, p.y / (1.7f * wave), p.z / wave); // a crack runs in tongues
        sum += weight * noise_space(q, random_key(key, k));
        squares += weight * weight;
        wave *= 0.45f;
        weight *= 0.95f;
    }
    return sum / (NOISE_RMS * sqrtf(squares));
}

// m by which the face is off the vertical over its path at p.
static float offset(const Sheet *sheet, Vec3 p)
{
    const IceCracksParams *params = sheet->params;
    float s, c, depth = params->depth, down = -p.y;
    exact_sincos(params->tilt * RADIANS_PER_DEGREE, &s, &c);
    float lean = noise_plane(p.x / params->spacing, p.z / params->spacing,
                             random_key(sheet->key, STREAM_TILT)) /
                 NOISE_RMS;
    float bulge =
        noise_space(vec3_scale(p, 1.4f / depth), random_key(sheet->key, STREAM_BULGE)) / NOISE_RMS;
    float hackle =
        noise_space(vec3_scale(p, 0.2f / sheet->grain), random_key(sheet->key, STREAM_HACKLE)) /
        NOISE_RMS;
    float free = down < 0.25f * depth ? 4.0f * down / depth : 1.0f;
    return down * lean * s / c + free * BULGE * depth * bulge +
           (free < 0.1f ? 10.0f * free : 1.0f) * HACKLE * sheet->grain * hackle;
}

// m: how far down the crack goes at p of its path, `left` before a loose end.
static float depth_at(const Sheet *sheet, int32_t crack, Vec3 p, float left)
{
    const IceCracksParams *params = sheet->params;
    float first = params->size / params->spacing; // about the cracks that went through first
    uint64_t key = random_key(random_key(sheet->seed, STREAM_DEPTH), (uint64_t)crack);
    float own = random_range(key, 0.55f, 1.0f) * (0.3f + 0.7f / (1.0f + (float)crack / first));
    float wave = 0.35f * params->spacing;
    float uneven =
        noise_plane_fractal(p.x / wave, p.z / wave, 4, random_key(sheet->key, STREAM_FOOT)) /
        NOISE_RMS;
    float shape = left < 0.5f * params->spacing ? sqrtf(left / (0.5f * params->spacing)) : 1.0f;
    return params->depth * shape * own * clampf(0.8f + 0.15f * uneven, 0.2f, 1.0f);
}

// ---- the grid of an arm

static bool reserve(Sheet *sheet, int64_t corners, Error *e)
{
    if (sheet->position && corners <= sheet->corners) {
        return true;
    }
    int64_t capacity[5] = {sheet->corners, sheet->corners, sheet->corners, sheet->corners,
                           sheet->corners};
    if (!memory_reserve(&sheet->position, &capacity[0], corners, sizeof(Vec3), e) ||
        !memory_reserve(&sheet->value, &capacity[1], corners, sizeof(float), e) ||
        !memory_reserve(&sheet->at[0], &capacity[2], corners, sizeof(int32_t), e) ||
        !memory_reserve(&sheet->at[1], &capacity[3], corners, sizeof(int32_t), e) ||
        !memory_reserve(&sheet->at[2], &capacity[4], corners, sizeof(int32_t), e)) {
        return false;
    }
    sheet->corners = corners;
    return true;
}

static void fill_column(Sheet *sheet, int64_t column, Vec3 p, Vec3 across, float depth)
{
    for (int64_t row = 0; row < sheet->rows; row++) {
        int64_t i = column * sheet->rows + row;
        float down = ((float)row + BURIED) * sheet->grain;
        Vec3 q = vec3(p.x, -down, p.z);
        float open = openness(sheet, q) - sheet->threshold;
        if ((float)row < SEAM) {
            open += 4.0f * (1.0f - (float)row / SEAM);
        }
        float below = (depth - down) / (0.15f * sheet->params->depth); // it closes toward its foot
        sheet->position[i] = vec3_madd(q, offset(sheet, q), across);
        sheet->value[i] = below < open ? below : open;
        sheet->at[0][i] = sheet->at[1][i] = sheet->at[2][i] = -1;
    }
}

// Lays the grid over the arm whose first and last nodes these are.
static bool lay_grid(Sheet *sheet, int64_t first, int64_t last, Error *e)
{
    const OutTree *tree = sheet->tree;
    int32_t crack = tree->colony[first], root = tree->parent[first];
    int arm = 0;
    while (arm < ICE_CRACK_ARMS && out_tree_child_id(tree->id[root], arm) != tree->id[first]) {
        arm++;
    }
    float most, step = ice_cracks_step(sheet->params), path = 0.0f;
    bool loose = ice_cracks_arm_is_loose(sheet->params, sheet->seed, crack, arm, &most);
    int64_t pieces = (int64_t)(step / sheet->grain + 0.999f); // of a step
    pieces = pieces > 1 ? pieces : 1;
    sheet->columns = (last - first + 1) * pieces + 1;
    if (!reserve(sheet, sheet->columns * sheet->rows, e)) {
        return false;
    }
    float side = arm == 1 ? -1.0f : 1.0f; // both arms of a crack lean to the same side
    for (int64_t column = 0; column < sheet->columns; column++) {
        int64_t k = column / pieces, node = first + (k <= last - first ? k : last - first);
        float t = (float)(column - (node - first) * pieces) / (float)pieces;
        int64_t from = node == first ? root : node - 1;
        Vec3 p = vec3_lerp(tree->position[from], tree->position[node], t);
        Vec3 across = vec3_normalize(vec3_lerp(
            node == first ? tree->normal[node] : tree->normal[from], tree->normal[node], t));
        path = ((float)(node - first) + t) * step;
        float left = loose && path < most ? most - path : loose ? 0.0f : sheet->params->size;
        fill_column(sheet, column, p, vec3_scale(across, side), depth_at(sheet, crack, p, left));
    }
    return true;
}

// ---- what is kept of it

static bool add_vertex(Faces *faces, Vec3 p, int32_t *vertex, Error *e)
{
    if (*vertex < 0) {
        if (!memory_reserve(&faces->position, &faces->vertex_capacity, faces->vertices + 1,
                            sizeof(Vec3), e)) {
            return false;
        }
        if (faces->vertices == INT32_MAX) {
            return error_set(e, ERROR_MEMORY,
                             "cracks have more than %d vertices: a larger grain takes fewer",
                             INT32_MAX);
        }
        *vertex = (int32_t)faces->vertices;
        faces->position[faces->vertices++] = p;
    }
    return true;
}

// The vertex where the value is 0 between two neighbours; edge: 1 = to the next row, 2 = to the
// next column, of the corner i.
static bool add_cut(Sheet *sheet, Faces *faces, int64_t i, int edge, int32_t *vertex, Error *e)
{
    int64_t j = edge == 1 ? i + 1 : i + sheet->rows;
    float t = sheet->value[i] / (sheet->value[i] - sheet->value[j]);
    Vec3 p = vec3_lerp(sheet->position[i], sheet->position[j], t);
    bool done = add_vertex(faces, p, &sheet->at[edge][i], e);
    *vertex = sheet->at[edge][i];
    return done;
}

// The part of a cell that is kept, a polygon of up to six corners, as a fan.
static bool add_cell(Sheet *sheet, Faces *faces, int64_t column, int64_t row, Error *e)
{
    int64_t i = column * sheet->rows + row, rows = sheet->rows;
    const int64_t corner[4] = {i, i + 1, i + rows + 1, i + rows};
    const int64_t edge_of[4] = {i, i + 1, i + rows, i};
    const int edge[4] = {1, 2, 1, 2};
    int32_t polygon[8];
    int count = 0;
    for (int k = 0; k < 4; k++) {
        int64_t a = corner[k], b = corner[(k + 1) & 3];
        bool kept = sheet->value[a] > 0.0f;
        if (kept) {
            if (!add_vertex(faces, sheet->position[a], &sheet->at[0][a], e)) {
                return false;
            }
            polygon[count++] = sheet->at[0][a];
        }
        if (kept != (sheet->value[b] > 0.0f)) {
            if (!add_cut(sheet, faces, edge_of[k], edge[k], &polygon[count], e)) {
                return false;
            }
            count++;
        }
    }
    if (count < 3) {
        return true;
    }
    if (!memory_reserve(&faces->index, &faces->index_capacity, faces->indices + 3 * (count - 2),
                        sizeof(uint32_t), e)) {
        return false;
    }
    for (int k = 2; k < count; k++) {
        faces->index[faces->indices++] = (uint32_t)polygon[0];
        faces->index[faces->indices++] = (uint32_t)polygon[k - 1];
        faces->index[faces->indices++] = (uint32_t)polygon[k];
    }
    return true;
}

static bool add_arm(Sheet *sheet, Faces *faces, int64_t first, int64_t last, Error *e)
{
    if (!lay_grid(sheet, first, last, e)) {
        return false;
    }
    for (int64_t column = 0; column + 1 < sheet->columns; column++) {
        for (int64_t row = 0; row + 1 < sheet->rows; row++) {
            if (!add_cell(sheet, faces, column, row, e)) {
                return false;
            }
        }
    }
    return true;
}

static bool add_arms(Sheet *sheet, Faces *faces, const Run *run, Error *e)
{
    const OutTree *tree = sheet->tree;
    for (int64_t first = 0; first < tree->count;) {
        int64_t last = first;
        while (last + 1 < tree->count && tree->parent[last + 1] == last) {
            last++;
        }
        if (tree->parent[first] < 0) { // a root: its first arm goes on from it
            first++;
            continue;
        }
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (!add_arm(sheet, faces, first, last, e)) {
            return false;
        }
        first = last + 1;
    }
    return true;
}

static Mesh *make_mesh(const Faces *faces, Error *e)
{
    Mesh *mesh = mesh_new(3, faces->vertices, faces->indices / 3, 0, e);
    if (!mesh) {
        return NULL;
    }
    for (int64_t i = 0; i < faces->vertices; i++) {
        mesh->position[i] = faces->position[i];
    }
    for (int64_t i = 0; i < faces->indices; i++) {
        mesh->index[i] = faces->index[i];
    }
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

bool ice_cracks_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const IceCracksParams *params = given;
    Sheet sheet = {.params = params,
                   .seed = placing->recipe->seed,
                   .key = random_key(placing->recipe->seed, STREAM_FACES),
                   .grain = ice_cracks_grain(params),
                   .tree = grown->tree};
    sheet.rows = (int64_t)(params->depth / sheet.grain) + 2;
    // the quantile of a normal distribution, by the logistic one
    float healed = clampf(params->healed, 1e-4f, 1.0f - 1e-4f);
    sheet.threshold = (float)(exact_log((double)(healed / (1.0f - healed))) / 1.702);
    sheet.threshold = params->healed > 0.0f ? sheet.threshold : -1e3f;
    Faces faces = {0};
    bool done = add_arms(&sheet, &faces, placing->recipe->run, e);
    if (done && faces.indices > 0) {
        Part part = {.kind = PART_MESH, .mesh = make_mesh(&faces, e)};
        done = part.mesh && placing_add(placing, part, 0, e);
    }
    free(sheet.position);
    free(sheet.value);
    for (int k = 0; k < 3; k++) {
        free(sheet.at[k]);
    }
    free(faces.position);
    free(faces.index);
    return done;
}
