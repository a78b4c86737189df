#include "base/mesh.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

Mesh *mesh_new(int face_size, int64_t vertex_count, int64_t face_count, int arrays, Error *e)
{
    if (vertex_count < 0 || vertex_count > UINT32_MAX) {
        error_set(e, ERROR_MEMORY, "a mesh of %lld vertices; fewer than 2^32 are possible",
                  (long long)vertex_count);
        return NULL;
    }
    Mesh *mesh = memory_alloc_zero(1, sizeof *mesh, e);
    if (!mesh) {
        return NULL;
    }
    mesh->face_size = face_size;
    mesh->vertex_count = vertex_count;
    mesh->face_count = face_count;
    mesh->index = memory_alloc_zero(face_count, sizeof(uint32_t) * (size_t)face_size, e);
    mesh->position = memory_alloc_zero(vertex_count, sizeof(Vec3), e);
    bool made = mesh->index && mesh->position;
    if (made && (arrays & MESH_NORMAL)) {
        made = (mesh->normal = memory_alloc_zero(vertex_count, sizeof(Vec3), e));
    }
    if (made && (arrays & MESH_UV)) {
        made = (mesh->uv = memory_alloc_zero(vertex_count, sizeof(Vec2), e));
    }
    if (made && (arrays & MESH_RADIUS)) {
        made = (mesh->radius = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_BIRTH)) {
        made = (mesh->birth = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_SITE)) {
        made = (mesh->site = memory_alloc_zero(vertex_count, sizeof(Vec2), e));
    }
    if (!made) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

void mesh_free(Mesh *mesh)
{
    if (mesh) {
        free(mesh->index);
        free(mesh->position);
        free(mesh->normal);
        free(mesh->uv);
        free(mesh->radius);
        free(mesh->birth);
        free(mesh->site);
        free(mesh);
    }
}

Aabb mesh_bounds(const Mesh *mesh)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        box = aabb_add(box, mesh->position[i]);
    }
    return box;
}

bool mesh_compute_normals(Mesh *mesh, Error *e)
{
    if (!mesh->normal) {
        mesh->normal = memory_alloc(mesh->vertex_count, sizeof(Vec3), e);
        if (!mesh->normal) {
            return false;
        }
    }
    memset(mesh->normal, 0, sizeof(Vec3) * (size_t)mesh->vertex_count);
    int n = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * n;
        for (int k = 0; k < n; k++) {
            Vec3 here = mesh->position[corner[k]];
            Vec3 ahead = vec3_sub(mesh->position[corner[(k + 1) % n]], here);
            Vec3 back = vec3_sub(mesh->position[corner[(k + n - 1) % n]], here);
            Vec3 across = vec3_cross(ahead, back);
            float sine = vec3_length(across);
            if (sine > 0.0f) {
                float weight = exact_atan2(sine, vec3_dot(ahead, back)) / sine;
                mesh->normal[corner[k]] = vec3_madd(mesh->normal[corner[k]], weight, across);
            }
        }
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 unit = vec3_normalize(mesh->normal[i]);
        mesh->normal[i] = vec3_dot(unit, unit) > 0.0f ? unit : vec3(0, 1, 0);
    }
    return true;
}

static float determinant(const Transform *t)
{
    return vec3_dot(vec3(t->m[0][0], t->m[0][1], t->m[0][2]),
                    vec3_cross(vec3(t->m[1][0], t->m[1][1], t->m[1][2]),
                               vec3(t->m[2][0], t->m[2][1], t->m[2][2])));
}

static void turn_faces_round(Mesh *mesh)
{
    int n = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t *corner = mesh->index + f * n;
        uint32_t swapped = corner[1];
        corner[1] = corner[n - 1];
        corner[n - 1] = swapped;
    }
}

bool mesh_transform(Mesh *mesh, const Transform *t, Error *e)
{
    Transform inverse;
    if (!transform_inverse(t, &inverse)) {
        return error_set(e, ERROR_INPUT,
                         "the transform flattens the mesh; no scale may be 0 on any axis");
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        mesh->position[i] = transform_point(t, mesh->position[i]);
        if (mesh->normal) {
            mesh->normal[i] = vec3_normalize(transform_normal(&inverse, mesh->normal[i]));
        }
    }
    if (determinant(t) < 0.0f) {
        turn_faces_round(mesh);
    }
    return true;
}

// ---- topology ----

// An edge as its vertices, lower index high: (low << 32 | high), and how often faces run along it
// either way.
typedef struct EdgeUse {
    uint64_t key; // EMPTY_EDGE when the slot is free
    uint32_t forward, backward;
} EdgeUse;

#define EMPTY_EDGE UINT64_MAX

static EdgeUse *find_edge(EdgeUse *table, uint64_t mask, uint64_t key)
{
    uint64_t slot = (key * 0x9e3779b97f4a7c15ull) ^ (key >> 29);
    slot ^= slot >> 31;
    while (table[slot & mask].key != key && table[slot & mask].key != EMPTY_EDGE) {
        slot++;
    }
    return &table[slot & mask];
}

static uint32_t find_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static bool face_repeats_vertex(const uint32_t *corner, int n)
{
    for (int a = 0; a < n; a++) {
        for (int b = a + 1; b < n; b++) {
            if (corner[a] == corner[b]) {
                return true;
            }
        }
    }
    return false;
}

static void enter_faces(const Mesh *mesh, EdgeUse *table, uint64_t mask, uint32_t *group,
                        MeshTopology *topology)
{
    int n = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * n;
        topology->degenerate_faces += face_repeats_vertex(corner, n);
        for (int k = 0; k < n; k++) {
            uint32_t a = corner[k], b = corner[(k + 1) % n];
            uint32_t low = a < b ? a : b, high = a < b ? b : a;
            EdgeUse *use = find_edge(table, mask, (uint64_t)low << 32 | high);
            topology->edge_count += use->key == EMPTY_EDGE;
            use->key = (uint64_t)low << 32 | high;
            *(a < b ? &use->forward : &use->backward) += 1;
            group[find_root(group, a)] = find_root(group, b);
        }
    }
}

static void count_edges(const EdgeUse *table, uint64_t mask, MeshTopology *topology)
{
    for (uint64_t i = 0; i <= mask; i++) {
        uint32_t uses = table[i].forward + table[i].backward;
        topology->open_edges += uses == 1;
        topology->overused_edges += uses > 2;
        topology->misoriented_edges += uses == 2 && table[i].forward != 1;
    }
}

// used[i] and group[i] of vertices that no face touches must not count.
static void count_pieces(const Mesh *mesh, uint32_t *group, uint8_t *used, MeshTopology *topology)
{
    for (int64_t i = 0; i < mesh->face_count * mesh->face_size; i++) {
        used[mesh->index[i]] = 1;
    }
    int64_t used_count = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        used_count += used[i];
        topology->component_count += used[i] && group[i] == (uint32_t)i;
    }
    topology->euler_number = used_count - topology->edge_count + mesh->face_count;
}

bool mesh_topology(const Mesh *mesh, MeshTopology *topology, Error *e)
{
    *topology = (MeshTopology){0};
    uint64_t slots = 16;
    while (slots < (uint64_t)mesh->face_count * (uint64_t)mesh->face_size * 2) {
        slots *= 2;
    }
    EdgeUse *table = memory_alloc((int64_t)slots, sizeof *table, e);
    uint32_t *group = memory_alloc(mesh->vertex_count, sizeof *group, e);
    uint8_t *used = memory_alloc_zero(mesh->vertex_count, 1, e);
    bool made = table && group && used;
    if (made) {
        for (uint64_t i = 0; i < slots; i++) {
            table[i] = (EdgeUse){.key = EMPTY_EDGE};
        }
        for (int64_t i = 0; i < mesh->vertex_count; i++) {
            group[i] = (uint32_t)i;
        }
        enter_faces(mesh, table, slots - 1, group, topology);
        count_edges(table, slots - 1, topology);
        count_pieces(mesh, group, used, topology);
    }
    free(table);
    free(group);
    free(used);
    return made;
}
