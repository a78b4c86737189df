// Topological defects of a surface, and its faces that enclose a volume.
#include "base/mesh.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// An edge as its vertices, lower index in the high bits: (low << 32 | high), and how often faces
// use it in each direction.
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

// vertices that no face uses do not count: used[i] and group[i] of those are ignored
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

// ---- faces that enclose a volume ----

// Components of a mesh with vertices at equal positions merged: seams of texture coordinates and
// normals split vertices, but leave no gap.
typedef struct Pieces {
    uint32_t *same;  // per vertex: the first vertex at its position
    uint32_t *group; // per vertex: union-find parent
    uint8_t *open;   // per root
    double *volume, *area;
    EdgeUse *table;
    uint64_t mask;
} Pieces;

static void pieces_free(Pieces *p)
{
    free(p->same);
    free(p->group);
    free(p->open);
    free(p->volume);
    free(p->area);
    free(p->table);
}

static bool pieces_alloc(Pieces *p, const Mesh *mesh, Error *e)
{
    uint64_t slots = 16, edges = (uint64_t)mesh->face_count * (uint64_t)mesh->face_size;
    while (slots < 2 * edges || slots < 2 * (uint64_t)mesh->vertex_count) {
        slots *= 2;
    }
    p->mask = slots - 1;
    return (p->same = memory_alloc(mesh->vertex_count, sizeof *p->same, e)) &&
           (p->group = memory_alloc(mesh->vertex_count, sizeof *p->group, e)) &&
           (p->open = memory_alloc_zero(mesh->vertex_count, 1, e)) &&
           (p->volume = memory_alloc_zero(mesh->vertex_count, sizeof *p->volume, e)) &&
           (p->area = memory_alloc_zero(mesh->vertex_count, sizeof *p->area, e)) &&
           (p->table = memory_alloc((int64_t)slots, sizeof *p->table, e));
}

static void clear_table(Pieces *p)
{
    for (uint64_t i = 0; i <= p->mask; i++) {
        p->table[i] = (EdgeUse){.key = EMPTY_EDGE};
    }
}

static uint64_t place_hash(Vec3 v)
{
    float c[3] = {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}; // adding 0 turns -0 into 0
    uint32_t bits[3];
    memcpy(bits, c, sizeof bits);
    uint64_t hash = 0;
    for (int i = 0; i < 3; i++) {
        hash = (hash ^ bits[i]) * 0x9e3779b97f4a7c15ull;
        hash ^= hash >> 29;
    }
    return hash;
}

// Here the table stores vertices: a slot's key is a vertex.
static void join_places(Pieces *p, const Mesh *mesh)
{
    clear_table(p);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 v = mesh->position[i];
        uint64_t slot = place_hash(v);
        for (;; slot++) {
            EdgeUse *use = &p->table[slot & p->mask];
            if (use->key == EMPTY_EDGE) {
                use->key = (uint64_t)i;
            }
            Vec3 w = mesh->position[use->key];
            if (use->key == (uint64_t)i || (v.x == w.x && v.y == w.y && v.z == w.z)) {
                p->same[i] = (uint32_t)use->key;
                break;
            }
        }
        p->group[i] = (uint32_t)i;
    }
}

static void join_faces(Pieces *p, const Mesh *mesh)
{
    int n = mesh->face_size;
    clear_table(p);
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * n;
        for (int k = 0; k < n; k++) {
            uint32_t a = p->same[corner[k]], b = p->same[corner[(k + 1) % n]];
            if (a == b) {
                continue;
            }
            uint32_t low = a < b ? a : b, high = a < b ? b : a;
            EdgeUse *use = find_edge(p->table, p->mask, (uint64_t)low << 32 | high);
            use->key = (uint64_t)low << 32 | high;
            *(a < b ? &use->forward : &use->backward) += 1;
            p->group[find_root(p->group, a)] = find_root(p->group, b);
        }
    }
    for (uint64_t i = 0; i <= p->mask; i++) {
        const EdgeUse *use = &p->table[i];
        if (use->key != EMPTY_EDGE && use->forward != use->backward) {
            p->open[find_root(p->group, (uint32_t)(use->key >> 32))] = 1;
        }
    }
}

static uint32_t piece_of(Pieces *p, const Mesh *mesh, int64_t face)
{
    return find_root(p->group, p->same[mesh->index[face * mesh->face_size]]);
}

static void measure_pieces(Pieces *p, const Mesh *mesh)
{
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        uint32_t piece = piece_of(p, mesh, f);
        Vec3 origin = mesh->position[piece];
        Vec3 a = vec3_sub(mesh->position[corner[0]], origin);
        for (int k = 2; k < mesh->face_size; k++) {
            Vec3 b = vec3_sub(mesh->position[corner[k - 1]], origin);
            Vec3 c = vec3_sub(mesh->position[corner[k]], origin);
            p->volume[piece] += (double)vec3_dot(a, vec3_cross(b, c)) / 6.0;
            p->area[piece] += 0.5 * (double)vec3_length(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
        }
    }
}

bool mesh_closed_faces(const Mesh *mesh, uint8_t *closed, Error *e)
{
    Pieces p = {.mask = 0};
    bool made = pieces_alloc(&p, mesh, e);
    if (made) {
        join_places(&p, mesh);
        join_faces(&p, mesh);
        measure_pieces(&p, mesh);
        for (int64_t f = 0; f < mesh->face_count; f++) {
            uint32_t piece = piece_of(&p, mesh, f);
            // volume of the ball with this area: 6 sqrt(pi)
            double ball = p.area[piece] * sqrt(p.area[piece]) / 10.6347;
            closed[f] = !p.open[piece] && p.volume[piece] > 1e-6 * ball;
        }
    }
    pieces_free(&p);
    return made;
}
