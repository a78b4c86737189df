#include "shape/mesh_close.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- joining vertices ----

static uint64_t hash_position(Vec3 p)
{
    float v[3] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; // adding 0 turns -0 into 0
    uint64_t key = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &v[i], sizeof bits);
        key = random_key(key, bits);
    }
    return key;
}

// Sets to[i] to the index of vertex i in joined, whose vertices have distinct positions.
static bool join_vertices(const Mesh *mesh, uint32_t *to, Mesh *joined, Error *e)
{
    uint64_t size = 16;
    while (size < 2 * (uint64_t)mesh->vertex_count) {
        size *= 2;
    }
    uint32_t *table = memory_alloc((int64_t)size, sizeof *table, e);
    if (!table) {
        return false;
    }
    memset(table, 0xff, size * sizeof *table);
    joined->vertex_count = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        uint64_t slot = hash_position(p) & (size - 1);
        while (table[slot] != UINT32_MAX) {
            Vec3 q = joined->position[table[slot]];
            if (p.x == q.x && p.y == q.y && p.z == q.z) {
                break;
            }
            slot = (slot + 1) & (size - 1);
        }
        if (table[slot] == UINT32_MAX) {
            table[slot] = (uint32_t)joined->vertex_count;
            joined->position[joined->vertex_count++] = p;
        }
        to[i] = table[slot];
    }
    free(table);
    return true;
}

static void join_faces(const Mesh *mesh, const uint32_t *to, Mesh *joined)
{
    joined->face_count = 0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t a = to[mesh->index[3 * f]], b = to[mesh->index[3 * f + 1]];
        uint32_t c = to[mesh->index[3 * f + 2]], *corner = joined->index + 3 * joined->face_count;
        if (a != b && b != c && c != a) {
            corner[0] = a, corner[1] = b, corner[2] = c;
            joined->face_count++;
        }
    }
}

// ---- open edges ----

typedef struct HalfEdge {
    uint32_t from, to;
} HalfEdge;

static uint64_t edge_key(HalfEdge h)
{
    return h.from < h.to ? (uint64_t)h.from << 32 | h.to : (uint64_t)h.to << 32 | h.from;
}

static int compare_edges(const void *a, const void *b)
{
    HalfEdge x = *(const HalfEdge *)a, y = *(const HalfEdge *)b;
    uint64_t p = edge_key(x), q = edge_key(y);
    if (p != q) {
        return p < q ? -1 : 1;
    }
    return x.from < y.from ? -1 : (x.from > y.from ? 1 : 0);
}

// One half-edge per edge with an odd number of faces; these edges form closed rings. *single is set
// to the number of edges with one face. The caller frees the result.
static HalfEdge *odd_edges(const Mesh *mesh, int64_t *count, int64_t *single, Error *e)
{
    int64_t total = 3 * mesh->face_count, n = 0;
    HalfEdge *edge = memory_alloc(total, sizeof *edge, e);
    if (!edge) {
        return NULL;
    }
    for (int64_t i = 0; i < total; i++) {
        edge[i] = (HalfEdge){mesh->index[i], mesh->index[i - i % 3 + (i + 1) % 3]};
    }
    qsort(edge, (size_t)total, sizeof *edge, compare_edges);
    *single = 0;
    for (int64_t i = 0, end; i < total; i = end) {
        for (end = i + 1; end < total && edge_key(edge[end]) == edge_key(edge[i]); end++) {
        }
        if ((end - i) % 2 == 1) {
            *single += end - i == 1;
            edge[n++] = edge[i + (end - i) / 2]; // the direction that most faces use
        }
    }
    *count = n;
    return edge;
}

// ---- holes ----

// A walk along odd edges. Every vertex has an even number of them, so a walk ends where it began.
typedef struct Walk {
    const HalfEdge *edge;
    int64_t count;
    int64_t *first; // vertex v's edges are incident[first[v]] .. incident[first[v + 1] - 1]
    int64_t *incident;
    bool *used;
    int64_t *path;    // edges walked
    uint32_t *corner; // the vertex before each of them
    int64_t *place;   // per vertex, its index in corner; -1 if absent
    int64_t length;
} Walk;

static void walk_free(Walk *w)
{
    free(w->first);
    free(w->incident);
    free(w->used);
    free(w->path);
    free(w->corner);
    free(w->place);
}

static bool walk_new(const Mesh *mesh, const HalfEdge *edge, int64_t count, Walk *w, Error *e)
{
    int64_t vertices = mesh->vertex_count;
    *w = (Walk){.edge = edge, .count = count};
    w->first = memory_alloc_zero(vertices + 2, sizeof *w->first, e);
    w->incident = memory_alloc(2 * count, sizeof *w->incident, e);
    w->used = memory_alloc_zero(count, sizeof *w->used, e);
    w->path = memory_alloc(count + 1, sizeof *w->path, e);
    w->corner = memory_alloc(count + 1, sizeof *w->corner, e);
    w->place = memory_alloc(vertices, sizeof *w->place, e);
    if (!w->first || !w->incident || !w->used || !w->path || !w->corner || !w->place) {
        walk_free(w);
        return false;
    }
    for (int64_t v = 0; v < vertices; v++) {
        w->place[v] = -1;
    }
    // a counting sort, offset by one, so that filling leaves first[] correct
    for (int64_t i = 0; i < count; i++) {
        w->first[edge[i].from + 2]++;
        w->first[edge[i].to + 2]++;
    }
    for (int64_t v = 2; v < vertices + 2; v++) {
        w->first[v] += w->first[v - 1];
    }
    for (int64_t i = 0; i < count; i++) {
        w->incident[w->first[edge[i].from + 1]++] = i;
        w->incident[w->first[edge[i].to + 1]++] = i;
    }
    return true;
}

// Fills the ring of edges path[from..length) with a triangle fan and removes them from the path.
static void fill_ring(Walk *w, int64_t from, Mesh *mesh)
{
    double middle[3] = {0, 0, 0}, n = (double)(w->length - from);
    for (int64_t i = from; i < w->length; i++) {
        Vec3 p = mesh->position[w->corner[i]];
        middle[0] += (double)p.x / n;
        middle[1] += (double)p.y / n;
        middle[2] += (double)p.z / n;
        w->place[w->corner[i]] = -1;
    }
    uint32_t center = (uint32_t)mesh->vertex_count++;
    mesh->position[center] = vec3((float)middle[0], (float)middle[1], (float)middle[2]);
    for (int64_t i = from; i < w->length; i++) {
        const HalfEdge *h = &w->edge[w->path[i]];
        uint32_t *corner = mesh->index + 3 * mesh->face_count++;
        corner[0] = h->to, corner[1] = h->from, corner[2] = center;
    }
    w->length = from;
}

static void walk_from(Walk *w, uint32_t v, Mesh *mesh)
{
    for (;;) {
        if (w->place[v] >= 0) {
            fill_ring(w, w->place[v], mesh);
        }
        int64_t next = -1;
        while (next < 0 && w->first[v] < w->first[v + 1]) {
            int64_t candidate = w->incident[w->first[v]++];
            next = w->used[candidate] ? -1 : candidate;
        }
        if (next < 0) {
            return;
        }
        w->used[next] = true;
        w->place[v] = w->length;
        w->corner[w->length] = v;
        w->path[w->length++] = next;
        v = w->edge[next].from == v ? w->edge[next].to : w->edge[next].from;
    }
}

static bool fill_holes(Mesh *mesh, const HalfEdge *edge, int64_t count, Error *e)
{
    Walk w;
    if (!walk_new(mesh, edge, count, &w, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        walk_from(&w, edge[i].from, mesh);
    }
    walk_free(&w);
    return true;
}

// Reserves space for the triangles and centres of the rings of these edges.
static bool make_room(Mesh *mesh, int64_t edges, Error *e)
{
    int64_t index = 3 * mesh->face_count, position = mesh->vertex_count;
    return memory_reserve(&mesh->index, &index, 3 * (mesh->face_count + edges), sizeof *mesh->index,
                          e) &&
           memory_reserve(&mesh->position, &position, mesh->vertex_count + edges / 3 + 1,
                          sizeof *mesh->position, e);
}

Mesh *mesh_close(const Mesh *mesh, int64_t *open_edges, Error *e)
{
    uint32_t *to = memory_alloc(mesh->vertex_count, sizeof *to, e);
    Mesh *closed = to ? mesh_new(3, mesh->vertex_count, mesh->face_count, 0, e) : NULL;
    bool made = closed && join_vertices(mesh, to, closed, e);
    if (made) {
        join_faces(mesh, to, closed);
        int64_t count = 0;
        HalfEdge *edge = odd_edges(closed, &count, open_edges, e);
        made = edge &&
               (count == 0 || (make_room(closed, count, e) && fill_holes(closed, edge, count, e)));
        free(edge);
    }
    free(to);
    if (!made) {
        mesh_free(closed);
        return NULL;
    }
    return closed;
}

// ---- measures ----

// Computes twice the area vector of triangle f and its first corner relative to origin, in double.
static void triangle_area_vector(const Mesh *mesh, int64_t f, Vec3 origin, double area[3],
                                 double corner[3])
{
    double p[3][3];
    for (int k = 0; k < 3; k++) {
        Vec3 v = mesh->position[mesh->index[3 * f + k]];
        p[k][0] = (double)v.x - (double)origin.x;
        p[k][1] = (double)v.y - (double)origin.y;
        p[k][2] = (double)v.z - (double)origin.z;
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        area[i] =
            (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
        corner[i] = p[0][i];
    }
}

double mesh_signed_volume(const Mesh *mesh)
{
    double sum = 0.0, area[3], corner[3];
    if (mesh->vertex_count == 0) {
        return 0.0;
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        // relative to a vertex, to avoid cancellation far from the origin
        triangle_area_vector(mesh, f, mesh->position[0], area, corner);
        sum += corner[0] * area[0] + corner[1] * area[1] + corner[2] * area[2];
    }
    return sum / 6.0;
}

double mesh_area(const Mesh *mesh)
{
    double sum = 0.0, area[3], corner[3];
    for (int64_t f = 0; f < mesh->face_count; f++) {
        triangle_area_vector(mesh, f, vec3(0, 0, 0), area, corner);
        sum += sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    }
    return 0.5 * sum;
}

void mesh_flip(Mesh *mesh)
{
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t *corner = mesh->index + 3 * f, swap = corner[1];
        corner[1] = corner[2];
        corner[2] = swap;
    }
    for (int64_t i = 0; mesh->normal && i < mesh->vertex_count; i++) {
        mesh->normal[i] = vec3_neg(mesh->normal[i]);
    }
}
