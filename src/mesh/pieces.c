#include "mesh/pieces.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

typedef struct Splitting {
    const Mesh *mesh;
    uint32_t *group;           // per vertex: union-find parent, then the number of its component
    uint32_t *place;           // per vertex: its index in its component
    int64_t *vertices, *faces; // per component
} Splitting;

static uint32_t find_root(uint32_t *group, uint32_t i)
{
    while (group[i] != i) {
        group[i] = group[group[i]];
        i = group[i];
    }
    return i;
}

// Unites the vertices of every face; the root of a group is its first vertex.
static void unite(Splitting *s)
{
    int n = s->mesh->face_size;
    for (int64_t i = 0; i < s->mesh->vertex_count; i++) {
        s->group[i] = (uint32_t)i;
    }
    for (int64_t f = 0; f < s->mesh->face_count; f++) {
        const uint32_t *corner = s->mesh->index + f * n;
        for (int k = 1; k < n; k++) {
            uint32_t a = find_root(s->group, corner[0]), b = find_root(s->group, corner[k]);
            s->group[a > b ? a : b] = a > b ? b : a;
        }
    }
}

// Numbers the groups and counts their vertices and faces; returns the number of groups.
static int64_t number(Splitting *s)
{
    int64_t count = 0;
    for (int64_t i = 0; i < s->mesh->vertex_count; i++) {
        uint32_t root = find_root(s->group, (uint32_t)i);
        if (root == (uint32_t)i) {
            s->place[i] = (uint32_t)count++; // for roots, temporarily the component's number
        }
    }
    for (int64_t i = 0; i < s->mesh->vertex_count; i++) {
        s->group[i] = find_root(s->group, (uint32_t)i);
    }
    for (int64_t i = s->mesh->vertex_count - 1; i >= 0; i--) {
        s->group[i] = s->place[s->group[i]]; // a root precedes its group, so in reverse order it is
                                             // replaced last
    }
    for (int64_t i = 0; i < s->mesh->vertex_count; i++) {
        s->place[i] = (uint32_t)s->vertices[s->group[i]]++;
    }
    for (int64_t f = 0; f < s->mesh->face_count; f++) {
        s->faces[s->group[s->mesh->index[f * s->mesh->face_size]]]++;
    }
    return count;
}

static bool make_pieces(const Splitting *s, MeshPieces *pieces, int64_t count, Error *e)
{
    const Mesh *mesh = s->mesh;
    pieces->piece = memory_alloc_zero(count, sizeof(Mesh *), e);
    if (!pieces->piece) {
        return false;
    }
    for (; pieces->count < count; pieces->count++) {
        int64_t i = pieces->count;
        Mesh *piece = mesh_new(mesh->face_size, s->vertices[i], s->faces[i],
                               mesh->normal ? MESH_NORMAL : 0, e);
        if (!piece) {
            return false;
        }
        pieces->piece[i] = piece;
        piece->face_count = 0; // used as a counter while faces are filled in
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Mesh *piece = pieces->piece[s->group[i]];
        piece->position[s->place[i]] = mesh->position[i];
        if (mesh->normal) {
            piece->normal[s->place[i]] = mesh->normal[i];
        }
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        Mesh *piece = pieces->piece[s->group[corner[0]]];
        uint32_t *to = piece->index + piece->face_count++ * mesh->face_size;
        for (int k = 0; k < mesh->face_size; k++) {
            to[k] = s->place[corner[k]];
        }
    }
    return true;
}

bool mesh_split(const Mesh *mesh, MeshPieces *pieces, Error *e)
{
    *pieces = (MeshPieces){0};
    Splitting s = {.mesh = mesh};
    s.group = memory_alloc(mesh->vertex_count, sizeof *s.group, e);
    s.place = memory_alloc(mesh->vertex_count, sizeof *s.place, e);
    s.vertices = memory_alloc_zero(mesh->vertex_count, sizeof *s.vertices, e);
    s.faces = memory_alloc_zero(mesh->vertex_count, sizeof *s.faces, e);
    bool done = s.group && s.place && s.vertices && s.faces;
    if (done) {
        unite(&s);
        done = make_pieces(&s, pieces, number(&s), e);
    }
    free(s.group);
    free(s.place);
    free(s.vertices);
    free(s.faces);
    if (!done) {
        mesh_pieces_clear(pieces);
    }
    return done;
}

void mesh_pieces_clear(MeshPieces *pieces)
{
    for (int64_t i = 0; i < pieces->count; i++) {
        mesh_free(pieces->piece[i]);
    }
    free(pieces->piece);
    *pieces = (MeshPieces){0};
}
