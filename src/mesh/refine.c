#include "mesh/refine.h"

#include "base/memory.h"
#include "mesh/limit_patch.h"
#include "mesh/refine_layout.h"

#include <stdlib.h>
#include <string.h>

// Wanted faces per patch: about 32,000 fine faces, some tens of MB inside OpenSubdiv.
static int64_t patch_size(int level)
{
    int64_t size = (int64_t)32768 >> (2 * level);
    return size < 32 ? 32 : size;
}

// Per-thread workspace for cutting patches out of the cage.
typedef struct PatchCutter {
    const Mesh *cage;
    const RefineLayout *layout;
    int32_t *local_vertex; // per cage vertex: its index in the patch, -1 = not in it
    uint8_t *in_patch;     // per cage face
    LimitPatch patch;
    uint32_t *face;   // cage faces of the patch
    uint32_t *vertex; // cage vertices of the patch
    int64_t face_capacity, vertex_capacity, index_capacity, point_capacity, grid_capacity;
    LimitPoint *grid;
} PatchCutter;

static void cutter_clear(PatchCutter *cutter)
{
    free(cutter->local_vertex);
    free(cutter->in_patch);
    free(cutter->patch.index);
    free(cutter->patch.vertex);
    free(cutter->face);
    free(cutter->vertex);
    free(cutter->grid);
}

static bool cutter_init(PatchCutter *cutter, const Mesh *cage, const RefineLayout *layout, Error *e)
{
    *cutter = (PatchCutter){.cage = cage, .layout = layout};
    cutter->local_vertex = memory_alloc(cage->vertex_count, sizeof(int32_t), e);
    cutter->in_patch = memory_alloc_zero(cage->face_count, 1, e);
    if (!cutter->local_vertex || !cutter->in_patch) {
        return false;
    }
    memset(cutter->local_vertex, 0xff, (size_t)cage->vertex_count * sizeof(int32_t));
    return true;
}

static bool cutter_add_face(PatchCutter *cutter, uint32_t face, Error *e)
{
    if (cutter->in_patch[face]) {
        return true;
    }
    LimitPatch *patch = &cutter->patch;
    int64_t count = patch->face_count;
    if (!memory_reserve(&cutter->face, &cutter->face_capacity, count + 1, sizeof face, e) ||
        !memory_reserve(&patch->index, &cutter->index_capacity, 4 * count + 4, sizeof(int32_t),
                        e) ||
        !memory_reserve(&cutter->vertex, &cutter->vertex_capacity, patch->vertex_count + 4,
                        sizeof(uint32_t), e) ||
        !memory_reserve(&patch->vertex, &cutter->point_capacity, patch->vertex_count + 4,
                        sizeof(LimitPoint), e)) {
        return false;
    }
    cutter->in_patch[face] = 1;
    cutter->face[count] = face;
    patch->face_count++;
    const Mesh *cage = cutter->cage;
    for (int k = 0; k < 4; k++) {
        uint32_t v = cage->index[4 * (int64_t)face + k];
        if (cutter->local_vertex[v] < 0) {
            cutter->local_vertex[v] = patch->vertex_count;
            cutter->vertex[patch->vertex_count] = v;
            patch->vertex[patch->vertex_count++] =
                (LimitPoint){.position = cage->position[v],
                             .uv = cage->uv ? cage->uv[v] : (Vec2){0, 0},
                             .radius = cage->radius ? cage->radius[v] : 0.0f,
                             .birth = cage->birth ? cage->birth[v] : 0.0f};
        }
        patch->index[4 * count + k] = cutter->local_vertex[v];
    }
    return true;
}

static void cutter_reset(PatchCutter *cutter)
{
    for (int32_t i = 0; i < cutter->patch.face_count; i++) {
        cutter->in_patch[cutter->face[i]] = 0;
    }
    for (int32_t i = 0; i < cutter->patch.vertex_count; i++) {
        cutter->local_vertex[cutter->vertex[i]] = -1;
    }
    cutter->patch.face_count = cutter->patch.vertex_count = cutter->patch.wanted_count = 0;
}

// Collects the wanted faces, then every face around their vertices.
static bool cut_patch(PatchCutter *cutter, const uint32_t *wanted, int64_t count, Error *e)
{
    cutter_reset(cutter);
    for (int64_t i = 0; i < count; i++) {
        if (!cutter_add_face(cutter, wanted[i], e)) {
            return false;
        }
    }
    cutter->patch.wanted_count = (int32_t)count;
    const RefineLayout *layout = cutter->layout;
    int32_t inner_vertices = cutter->patch.vertex_count;
    for (int32_t i = 0; i < inner_vertices; i++) {
        uint32_t v = cutter->vertex[i];
        for (int64_t k = layout->ring_first[v]; k < layout->ring_first[v + 1]; k++) {
            if (!cutter_add_face(cutter, layout->ring_face[k], e)) {
                return false;
            }
        }
    }
    return true;
}

static void store_point(Mesh *mesh, int64_t i, const LimitPoint *point)
{
    mesh->position[i] = point->position;
    mesh->normal[i] = point->normal;
    if (mesh->uv) {
        mesh->uv[i] = point->uv;
    }
    if (mesh->radius) {
        mesh->radius[i] = point->radius;
    }
    if (mesh->birth) {
        mesh->birth[i] = point->birth;
    }
}

// Stores those points of a face's grid that the face owns.
static void store_grid(Mesh *mesh, const RefineLayout *layout, uint32_t face,
                       const LimitPoint *grid)
{
    int size = 1 << layout->face_level[face];
    for (int y = 0; y <= size; y++) {
        for (int x = 0; x <= size; x++) {
            int64_t i = refine_layout_owned(layout, face, x, y);
            if (i >= 0) {
                store_point(mesh, i, &grid[y * (size + 1) + x]);
            }
        }
    }
}

static bool refine_patch(PatchCutter *cutter, const uint32_t *wanted, int64_t count, Mesh *mesh,
                         Error *e)
{
    int level = cutter->layout->face_level[wanted[0]];
    int64_t points = ((int64_t)(1 << level) + 1) * ((1 << level) + 1);
    if (!cut_patch(cutter, wanted, count, e) ||
        !memory_reserve(&cutter->grid, &cutter->grid_capacity, count * points, sizeof(LimitPoint),
                        e) ||
        !limit_patch_evaluate(&cutter->patch, level, cutter->grid, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        store_grid(mesh, cutter->layout, wanted[i], cutter->grid + i * points);
    }
    return true;
}

// Start of each patch in layout->order (faces sorted by level); NULL and e when out of memory.
static int64_t *divide_into_patches(const RefineLayout *layout, int64_t face_count,
                                    int64_t *patch_count, Error *e)
{
    int64_t *first = memory_alloc(face_count + 1, sizeof *first, e);
    if (!first) {
        return NULL;
    }
    *patch_count = 0;
    for (int64_t i = 0; i < face_count;) {
        first[(*patch_count)++] = i;
        int level = layout->face_level[layout->order[i]];
        int64_t end = i + patch_size(level);
        while (i < face_count && i < end && layout->face_level[layout->order[i]] == level) {
            i++;
        }
    }
    first[*patch_count] = face_count;
    return first;
}

static bool refine_all(const Mesh *cage, const RefineLayout *layout, Mesh *mesh, const Run *run,
                       Error *e)
{
    int64_t patch_count = 0, done = 0;
    int64_t *first = divide_into_patches(layout, cage->face_count, &patch_count, e);
    if (!first) {
        return false;
    }
    bool good = true;
    Error first_error = {0};
#pragma omp parallel num_threads(run->threads)
    {
        Error error = {0};
        PatchCutter cutter;
        bool mine = cutter_init(&cutter, cage, layout, &error);
#pragma omp for schedule(dynamic)
        for (int64_t p = 0; p < patch_count; p++) {
            if (mine && !run_is_cancelled(run)) {
                mine = refine_patch(&cutter, layout->order + first[p], first[p + 1] - first[p],
                                    mesh, &error);
#pragma omp critical(refine_progress)
                run_progress(run, "smoothing", (double)++done / (double)patch_count);
            }
        }
        if (!mine) {
#pragma omp critical(refine_progress)
            {
                good = false;
                first_error = error;
            }
        }
        cutter_clear(&cutter);
    }
    free(first);
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    if (!good && e) {
        *e = first_error;
    }
    return good;
}

Mesh *mesh_refine(const Mesh *cage, const uint8_t *face_level, const Run *run, Error *e)
{
    RefineLayout layout;
    Mesh *mesh = NULL;
    if (refine_layout_init(&layout, cage, face_level, e)) {
        int arrays = MESH_NORMAL | (cage->uv ? MESH_UV : 0) | (cage->radius ? MESH_RADIUS : 0) |
                     (cage->birth ? MESH_BIRTH : 0);
        mesh = mesh_new(layout.graded ? 3 : 4, layout.vertex_count, layout.face_count, arrays, e);
        if (mesh) {
            refine_layout_faces(&layout, mesh->index);
        }
        if (mesh && !refine_all(cage, &layout, mesh, run, e)) {
            mesh_free(mesh);
            mesh = NULL;
        }
    }
    refine_layout_clear(&layout);
    return mesh;
}
