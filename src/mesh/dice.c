#include "mesh/dice.h"

#include "base/memory.h"
#include "mesh/dice_budget.h"
#include "mesh/dice_split.h"
#include "mesh/dice_surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PASSES = 24 };

#define COARSER 1.2f // see coarsen

#define NO_VERTEX UINT32_MAX

// Triangles, 3 indices each.
typedef struct Triangles {
    uint32_t *index;
    int64_t count, capacity; // capacity in indices
} Triangles;

// A halved edge (lower index << 32 | higher) and the vertex in its middle.
typedef struct HalvedEdge {
    uint64_t key;
    uint32_t middle; // NO_VERTEX = the slot is free
} HalvedEdge;

typedef struct Dicer {
    const DiceRule *rule;
    const Run *run;
    Error *e;
    DicePoint *point;
    Vec3 *displaced;
    float *share;
    int64_t point_count, point_capacity, displaced_capacity, share_capacity;
    Triangles done, active, next; // `done` have no edge to halve
    uint8_t *mark;                // per active triangle: bit k = edge k is halved
    int64_t mark_capacity;
    HalvedEdge *edge;
    uint64_t edge_mask;
    float coarsening;
} Dicer;

static void dicer_clear(Dicer *dicer)
{
    free(dicer->point);
    free(dicer->displaced);
    free(dicer->share);
    free(dicer->done.index);
    free(dicer->active.index);
    free(dicer->next.index);
    free(dicer->mark);
    free(dicer->edge);
}

static bool add_triangle(Triangles *list, uint32_t a, uint32_t b, uint32_t c, Error *e)
{
    if (!memory_reserve(&list->index, &list->capacity, 3 * list->count + 3, sizeof a, e)) {
        return false;
    }
    uint32_t *out = list->index + 3 * list->count++;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    return true;
}

// ---- points

static bool reserve_points(Dicer *dicer, int64_t count)
{
    return memory_reserve(&dicer->point, &dicer->point_capacity, count, sizeof(DicePoint),
                          dicer->e) &&
           memory_reserve(&dicer->displaced, &dicer->displaced_capacity, count, sizeof(Vec3),
                          dicer->e) &&
           memory_reserve(&dicer->share, &dicer->share_capacity, count, sizeof(float), dicer->e);
}

static void displace(Dicer *dicer, int64_t first)
{
    const DiceRule *rule = dicer->rule;
#pragma omp parallel for num_threads(dicer->run->threads) schedule(dynamic, 4096)
    for (int64_t i = first; i < dicer->point_count; i++) {
        const DicePoint *point = &dicer->point[i];
        float height = rule->height(rule->user, point, dicer->coarsening, &dicer->share[i]);
        dicer->displaced[i] = vec3_madd(point->position, height, point->normal);
    }
}

// ---- edges

static bool is_long(const Dicer *dicer, uint32_t a, uint32_t b)
{
    return dice_is_long(dicer->rule, dicer->coarsening, &dicer->point[a], dicer->displaced[a],
                        &dicer->point[b], dicer->displaced[b]);
}

// Marks the edges to halve. Returns the number of triangles after that.
static int64_t mark_edges(Dicer *dicer)
{
    const uint32_t *index = dicer->active.index;
    int64_t after = 0;
#pragma omp parallel for num_threads(dicer->run->threads) schedule(dynamic, 4096) reduction(+ : after)
    for (int64_t i = 0; i < dicer->active.count; i++) {
        unsigned mark = 0;
        after++;
        for (unsigned k = 0; k < 3; k++) {
            uint32_t a = index[3 * i + k], b = index[3 * i + (k + 1) % 3];
            bool halved = is_long(dicer, a < b ? a : b, a < b ? b : a);
            mark |= halved ? 1u << k : 0u;
            after += halved;
        }
        dicer->mark[i] = (uint8_t)mark;
    }
    return after;
}

static HalvedEdge *find_edge(const Dicer *dicer, uint32_t a, uint32_t b)
{
    uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
    uint64_t slot = (key * 0x9e3779b97f4a7c15ull) ^ (key >> 29);
    slot ^= slot >> 31;
    HalvedEdge *edge = &dicer->edge[slot & dicer->edge_mask];
    while (edge->middle != NO_VERTEX && edge->key != key) {
        edge = &dicer->edge[++slot & dicer->edge_mask];
    }
    edge->key = key;
    return edge;
}

// Numbers the middles of all marked edges in the order of the triangles.
static bool halve_edges(Dicer *dicer, int64_t marks)
{
    uint64_t slots = 16;
    while (slots < (uint64_t)marks * 2) {
        slots *= 2;
    }
    free(dicer->edge);
    dicer->edge = memory_alloc((int64_t)slots, sizeof *dicer->edge, dicer->e);
    int64_t first = dicer->point_count;
    if (!dicer->edge || !reserve_points(dicer, first + marks)) {
        return false;
    }
    memset(dicer->edge, 0xff, slots * sizeof *dicer->edge);
    dicer->edge_mask = slots - 1;
    for (int64_t i = 0; i < dicer->active.count; i++) {
        const uint32_t *corner = dicer->active.index + 3 * i;
        for (unsigned k = 0; k < 3; k++) {
            uint32_t a = corner[k], b = corner[(k + 1) % 3];
            HalvedEdge *edge = dicer->mark[i] & 1u << k ? find_edge(dicer, a, b) : NULL;
            if (edge && edge->middle == NO_VERTEX) {
                edge->middle = (uint32_t)dicer->point_count;
                bool in_order = a < b;
                dicer->point[dicer->point_count++] =
                    dice_middle(&dicer->point[in_order ? a : b], &dicer->point[in_order ? b : a]);
            }
        }
    }
    displace(dicer, first);
    return true;
}

// ---- triangles

static bool divide(Dicer *dicer, const uint32_t corner[3], unsigned mark)
{
    uint32_t vertex[6] = {corner[0], corner[1], corner[2]};
    Vec3 position[6];
    for (unsigned k = 0; k < 3; k++) {
        position[k] = dicer->point[vertex[k]].position;
        if (mark & 1u << k) {
            vertex[3 + k] = find_edge(dicer, corner[k], corner[(k + 1) % 3])->middle;
            position[3 + k] = dicer->point[vertex[3 + k]].position;
        }
    }
    DiceSplit split = dice_split(mark, position);
    bool good = true;
    for (int i = 0; good && i < split.count; i++) {
        const uint8_t *c = split.corner[i];
        good = add_triangle(&dicer->next, vertex[c[0]], vertex[c[1]], vertex[c[2]], dicer->e);
    }
    return good;
}

static bool divide_all(Dicer *dicer)
{
    dicer->next.count = 0;
    bool good = true;
    for (int64_t i = 0; good && i < dicer->active.count; i++) {
        const uint32_t *corner = dicer->active.index + 3 * i;
        good = dicer->mark[i]
                   ? divide(dicer, corner, dicer->mark[i])
                   : add_triangle(&dicer->done, corner[0], corner[1], corner[2], dicer->e);
    }
    Triangles old = dicer->active;
    dicer->active = dicer->next;
    dicer->next = old;
    return good;
}

typedef enum Step { STEP_FAILED, STEP_HALVED, STEP_DONE, STEP_OVERFULL } Step;

// Halves what is too long, once; not if there would be too many faces.
static Step halve_once(Dicer *dicer)
{
    if (run_is_cancelled(dicer->run)) {
        run_cancel_error(dicer->e);
        return STEP_FAILED;
    }
    int64_t count = dicer->active.count;
    if (!memory_reserve(&dicer->mark, &dicer->mark_capacity, count + 1, 1, dicer->e)) {
        return STEP_FAILED;
    }
    int64_t after = mark_edges(dicer);
    if (after == count) {
        return STEP_DONE;
    }
    if (dicer->done.count + after > dicer->rule->most_faces) {
        return STEP_OVERFULL;
    }
    return halve_edges(dicer, after - count) && divide_all(dicer) ? STEP_HALVED : STEP_FAILED;
}

// ---- the result

// Where nothing is displaced the smooth surface's normals stay.
static bool set_normals(DicedMesh *diced, Error *e)
{
    Mesh *mesh = diced->mesh;
    Mesh displaced = {.face_size = 3,
                      .vertex_count = mesh->vertex_count,
                      .face_count = mesh->face_count,
                      .index = mesh->index,
                      .position = diced->displaced};
    if (!mesh_compute_normals(&displaced, e)) {
        free(displaced.normal);
        return false;
    }
    diced->normal = displaced.normal;
    const float whole = 0.1f;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        float t = clampf(diced->share[i] / whole, 0.0f, 1.0f);
        diced->normal[i] = vec3_normalize(vec3_lerp(mesh->normal[i], diced->normal[i], t));
    }
    return true;
}

static bool take_result(Dicer *dicer, const Mesh *mesh, DicedMesh *diced)
{
    int64_t faces = dicer->done.count + dicer->active.count;
    diced->along = memory_alloc(dicer->point_count, sizeof(Vec3), dicer->e);
    diced->mesh = dice_mesh_of(mesh, dicer->point, dicer->point_count, faces, dicer->e);
    if (!diced->along || !diced->mesh) {
        return false;
    }
    uint32_t *index = diced->mesh->index;
    size_t done = (size_t)dicer->done.count * 3, active = (size_t)dicer->active.count * 3;
    if (done > 0) {
        memcpy(index, dicer->done.index, done * sizeof *index);
    }
    if (active > 0) {
        memcpy(index + done, dicer->active.index, active * sizeof *index);
    }
    for (int64_t i = 0; i < dicer->point_count; i++) {
        diced->along[i] = dicer->point[i].along;
    }
    diced->coarsening = dicer->coarsening;
    diced->displaced = dicer->displaced;
    diced->share = dicer->share;
    dicer->displaced = NULL;
    dicer->share = NULL;
    return set_normals(diced, dicer->e);
}

// Sets the triangles and points to those of the mesh.
static bool start(Dicer *dicer, const Mesh *mesh)
{
    int64_t triangles = mesh->face_count * (mesh->face_size - 2);
    if (!memory_reserve(&dicer->active.index, &dicer->active.capacity, 3 * triangles + 3,
                        sizeof(uint32_t), dicer->e) ||
        !reserve_points(dicer, mesh->vertex_count + 1)) {
        return false;
    }
    dicer->done.count = 0;
    dicer->active.count = triangles;
    dicer->point_count = mesh->vertex_count;
    dice_split_faces(mesh, dicer->active.index);
    dice_fill_points(mesh, dicer->active.index, triangles, dicer->point);
    displace(dicer, 0);
    return true;
}

// Edges become longer everywhere, or those that need most halvings would bear it all: what is near
// the camera. The estimate does not know the finest relief: on rock it is a tenth too low.
static void coarsen(Dicer *dicer)
{
    const DiceTriangles whole = {dicer->active.index, dicer->active.count, dicer->point,
                                 dicer->displaced};
    dicer->coarsening = dicer->coarsening > 1.0f
                            ? dicer->coarsening * COARSER
                            : COARSER * dice_coarsening(&whole, dicer->rule, dicer->run);
    displace(dicer, 0);
}

// *halved: some edge was.
static Step halve(Dicer *dicer, bool *halved)
{
    Step step = STEP_HALVED;
    *halved = false;
    for (int i = 0; step == STEP_HALVED && i < MOST_PASSES; i++) {
        step = halve_once(dicer);
        *halved = *halved || step == STEP_HALVED;
    }
    return step;
}

static bool halve_within_limit(Dicer *dicer, const Mesh *mesh, bool *halved)
{
    Step step = STEP_OVERFULL;
    for (int attempt = 0; step == STEP_OVERFULL; attempt++) {
        if (!start(dicer, mesh)) {
            return false;
        }
        if (attempt > 0) {
            coarsen(dicer);
        }
        step = halve(dicer, halved);
    }
    return step != STEP_FAILED;
}

static bool is_displaced(const Dicer *dicer)
{
    bool some = false;
    for (int64_t i = 0; !some && i < dicer->point_count; i++) {
        some = dicer->share[i] > 0.0f;
    }
    return some;
}

bool mesh_dice(const Mesh *mesh, const DiceRule *rule, const Run *run, DicedMesh *diced, Error *e)
{
    *diced = (DicedMesh){.coarsening = 1.0f};
    Dicer dicer = {.rule = rule, .run = run, .e = e, .coarsening = 1.0f};
    bool halved = false, good = halve_within_limit(&dicer, mesh, &halved);
    if (good && (halved || is_displaced(&dicer))) {
        good = take_result(&dicer, mesh, diced);
    }
    dicer_clear(&dicer);
    return good;
}

void diced_mesh_clear(DicedMesh *diced)
{
    mesh_free(diced->mesh);
    free(diced->displaced);
    free(diced->normal);
    free(diced->along);
    free(diced->share);
    *diced = (DicedMesh){0};
}
