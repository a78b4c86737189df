#include "mesh/refine_layout.h"

#include "base/memory.h"

#include <stdlib.h>

static uint32_t corner_of(const RefineLayout *layout, uint32_t face, int k)
{
    return layout->cage->index[4 * (int64_t)face + (k & 3)];
}

static bool gather_rings(RefineLayout *layout, Error *e)
{
    const Mesh *cage = layout->cage;
    layout->ring_first = memory_alloc_zero(cage->vertex_count + 2, sizeof(int64_t), e);
    layout->ring_face = memory_alloc(cage->face_count * 4, sizeof(uint32_t), e);
    if (!layout->ring_first || !layout->ring_face) {
        return false;
    }
    // Counts offset by two, so that filling shifts each start to its place.
    for (int64_t i = 0; i < cage->face_count * 4; i++) {
        layout->ring_first[cage->index[i] + 2]++;
    }
    for (int64_t v = 0; v < cage->vertex_count; v++) {
        layout->ring_first[v + 2] += layout->ring_first[v + 1];
    }
    for (int64_t i = 0; i < cage->face_count * 4; i++) {
        layout->ring_face[layout->ring_first[cage->index[i] + 1]++] = (uint32_t)(i / 4);
    }
    return true;
}

// The face across side k of a face, and which of its sides that is; -1 at a border.
static int64_t neighbour(const RefineLayout *layout, uint32_t face, int k, int *side)
{
    uint32_t from = corner_of(layout, face, k), to = corner_of(layout, face, k + 1);
    for (int64_t i = layout->ring_first[to]; i < layout->ring_first[to + 1]; i++) {
        uint32_t other = layout->ring_face[i];
        for (int j = 0; j < 4 && other != face; j++) {
            if (corner_of(layout, other, j) == to && corner_of(layout, other, j + 1) == from) {
                *side = j;
                return other;
            }
        }
    }
    return -1;
}

static bool finer(const RefineLayout *layout, uint32_t a, uint32_t b)
{
    return layout->face_level[a] > layout->face_level[b];
}

static bool number_edges(RefineLayout *layout, Error *e)
{
    int64_t faces = layout->cage->face_count;
    layout->face_edge = memory_alloc(faces * 4, sizeof(uint32_t), e);
    layout->edge_owner = memory_alloc(faces * 4, sizeof(uint32_t), e);
    if (!layout->face_edge || !layout->edge_owner) {
        return false;
    }
    for (int64_t f = 0; f < faces; f++) {
        for (int k = 0; k < 4; k++) {
            int side = 0;
            int64_t other = neighbour(layout, (uint32_t)f, k, &side);
            if (other >= 0 && other < f) {
                layout->face_edge[4 * f + k] = layout->face_edge[4 * other + side];
                continue;
            }
            layout->face_edge[4 * f + k] = (uint32_t)layout->edge_count;
            bool theirs = other >= 0 && finer(layout, (uint32_t)other, (uint32_t)f);
            layout->edge_owner[layout->edge_count++] = (uint32_t)(theirs ? other : f);
        }
    }
    return true;
}

static bool choose_vertex_owners(RefineLayout *layout, Error *e)
{
    int64_t count = layout->cage->vertex_count;
    layout->vertex_owner = memory_alloc(count, sizeof(uint32_t), e);
    if (!layout->vertex_owner) {
        return false;
    }
    for (int64_t v = 0; v < count; v++) {
        int64_t first = layout->ring_first[v], end = layout->ring_first[v + 1];
        layout->vertex_owner[v] = first < end ? layout->ring_face[first] : 0;
        for (int64_t i = first; i < end; i++) {
            if (finer(layout, layout->ring_face[i], layout->vertex_owner[v])) {
                layout->vertex_owner[v] = layout->ring_face[i];
            }
        }
    }
    return true;
}

static int edge_size(const RefineLayout *layout, uint32_t face, int k)
{
    uint32_t edge = layout->face_edge[4 * (int64_t)face + (k & 3)];
    return 1 << layout->face_level[layout->edge_owner[edge]];
}

// Triangles of a face: two per inner square, and strips that connect to the edges' points.
static int64_t triangle_count(const RefineLayout *layout, uint32_t face)
{
    int64_t size = 1 << layout->face_level[face], boundary = 0;
    for (int k = 0; k < 4; k++) {
        boundary += edge_size(layout, face, k);
    }
    // (size - 2)^2 squares inside; their rim has 4 (size - 2) sides (a point if size = 2).
    return 2 * (size - 2) * (size - 2) + boundary + 4 * (size - 2);
}

static bool number_points(RefineLayout *layout, Error *e)
{
    int64_t faces = layout->cage->face_count;
    layout->edge_first = memory_alloc(layout->edge_count, sizeof(int64_t), e);
    layout->face_first = memory_alloc(faces, sizeof(int64_t), e);
    if (!layout->edge_first || !layout->face_first) {
        return false;
    }
    int64_t next = layout->cage->vertex_count;
    for (int64_t i = 0; i < layout->edge_count; i++) {
        layout->edge_first[i] = next;
        next += (1 << layout->face_level[layout->edge_owner[i]]) - 1;
    }
    for (int64_t f = 0; f < faces; f++) {
        int64_t size = 1 << layout->face_level[f];
        layout->face_first[f] = next;
        next += (size - 1) * (size - 1);
        layout->face_count += layout->graded ? triangle_count(layout, (uint32_t)f) : size * size;
    }
    layout->vertex_count = next;
    return true;
}

// Counting sort: patches are cut from faces of one level that are close to each other.
static bool sort_by_level(RefineLayout *layout, Error *e)
{
    int64_t faces = layout->cage->face_count, next = 0;
    layout->order = memory_alloc(faces, sizeof(uint32_t), e);
    if (!layout->order) {
        return false;
    }
    for (int level = 0; level < 16; level++) {
        int64_t before = next;
        for (int64_t f = 0; f < faces; f++) {
            if (layout->face_level[f] == level) {
                layout->order[next++] = (uint32_t)f;
            }
        }
        layout->graded |= next > before && next < faces;
    }
    return true;
}

bool refine_layout_init(RefineLayout *layout, const Mesh *cage, const uint8_t *face_level, Error *e)
{
    *layout = (RefineLayout){.cage = cage, .face_level = face_level};
    return sort_by_level(layout, e) && gather_rings(layout, e) && number_edges(layout, e) &&
           choose_vertex_owners(layout, e) && number_points(layout, e);
}

void refine_layout_clear(RefineLayout *layout)
{
    free(layout->ring_first);
    free(layout->ring_face);
    free(layout->face_edge);
    free(layout->edge_owner);
    free(layout->vertex_owner);
    free(layout->edge_first);
    free(layout->face_first);
    free(layout->order);
}

// Point i of 0..edge_size along side k, from corner k to corner k + 1.
static int64_t side_point(const RefineLayout *layout, uint32_t face, int k, int i)
{
    int size = edge_size(layout, face, k);
    uint32_t from = corner_of(layout, face, k), to = corner_of(layout, face, k + 1);
    if (i == 0 || i == size) {
        return i == 0 ? from : to;
    }
    int64_t first = layout->edge_first[layout->face_edge[4 * (int64_t)face + (k & 3)]];
    return first + (from < to ? i : size - i) - 1;
}

// Side of a grid of size x size squares that the point is on (*along as in side_point, from its
// first corner); -1 inside.
static int which_side(int x, int y, int size, int *along)
{
    int side = y == 0 ? 0 : (x == size ? 1 : (y == size ? 2 : (x == 0 ? 3 : -1)));
    int way[4] = {x, y, size - x, size - y};
    *along = side >= 0 ? way[side] : 0;
    return side;
}

static int64_t inner_point(const RefineLayout *layout, uint32_t face, int x, int y)
{
    int64_t size = 1 << layout->face_level[face];
    return layout->face_first[face] + (y - 1) * (size - 1) + (x - 1);
}

int64_t refine_layout_owned(const RefineLayout *layout, uint32_t face, int x, int y)
{
    int size = 1 << layout->face_level[face], along;
    int side = which_side(x, y, size, &along);
    if (side < 0) {
        return inner_point(layout, face, x, y);
    }
    if (along == 0 || along == size) {
        uint32_t v = corner_of(layout, face, side + (along == size));
        return layout->vertex_owner[v] == face ? (int64_t)v : -1;
    }
    uint32_t edge = layout->face_edge[4 * (int64_t)face + side];
    return layout->edge_owner[edge] == face ? side_point(layout, face, side, along) : -1;
}

// Point (x, y) of a face whose edges are all at its own level.
static uint32_t grid_point(const RefineLayout *layout, uint32_t face, int x, int y)
{
    int along, side = which_side(x, y, 1 << layout->face_level[face], &along);
    return (uint32_t)(side < 0 ? inner_point(layout, face, x, y)
                               : side_point(layout, face, side, along));
}

static uint32_t *write_quads(const RefineLayout *layout, uint32_t face, uint32_t *out)
{
    int size = 1 << layout->face_level[face];
    for (int y = 0; y < size; y++) {
        for (int x = 0; x < size; x++) {
            *out++ = grid_point(layout, face, x, y);
            *out++ = grid_point(layout, face, x + 1, y);
            *out++ = grid_point(layout, face, x + 1, y + 1);
            *out++ = grid_point(layout, face, x, y + 1);
        }
    }
    return out;
}

static uint32_t *write_triangle(uint32_t *out, int64_t a, int64_t b, int64_t c)
{
    out[0] = (uint32_t)a;
    out[1] = (uint32_t)b;
    out[2] = (uint32_t)c;
    return out + 3;
}

// Point i of 1..size-1 of the inner rim beside side k.
static int64_t rim_point(const RefineLayout *layout, uint32_t face, int k, int i)
{
    int size = 1 << layout->face_level[face];
    int x[4] = {i, size - 1, size - i, 1}, y[4] = {1, i, size - 1, size - i};
    return inner_point(layout, face, x[k], y[k]);
}

// Triangulates between the edge's points and the rim's, always advancing on the side that is
// behind.
static uint32_t *write_strip(const RefineLayout *layout, uint32_t face, int k, uint32_t *out)
{
    int size = 1 << layout->face_level[face], fine = edge_size(layout, face, k);
    int i = 0, j = 1;
    while (i < fine || j < size - 1) {
        bool edge_lags = (2 * i + 1) * size <= (2 * j + 1) * fine;
        if (i < fine && (edge_lags || j == size - 1)) {
            out = write_triangle(out, side_point(layout, face, k, i),
                                 side_point(layout, face, k, i + 1), rim_point(layout, face, k, j));
            i++;
        } else {
            out = write_triangle(out, side_point(layout, face, k, i),
                                 rim_point(layout, face, k, j + 1), rim_point(layout, face, k, j));
            j++;
        }
    }
    return out;
}

static uint32_t *write_triangles(const RefineLayout *layout, uint32_t face, uint32_t *out)
{
    int size = 1 << layout->face_level[face];
    for (int y = 1; y < size - 1; y++) {
        for (int x = 1; x < size - 1; x++) {
            int64_t a = inner_point(layout, face, x, y),
                    c = inner_point(layout, face, x + 1, y + 1);
            out = write_triangle(out, a, inner_point(layout, face, x + 1, y), c);
            out = write_triangle(out, a, c, inner_point(layout, face, x, y + 1));
        }
    }
    for (int k = 0; k < 4; k++) {
        out = write_strip(layout, face, k, out);
    }
    return out;
}

void refine_layout_faces(const RefineLayout *layout, uint32_t *index)
{
    for (int64_t f = 0; f < layout->cage->face_count; f++) {
        index = layout->graded ? write_triangles(layout, (uint32_t)f, index)
                               : write_quads(layout, (uint32_t)f, index);
    }
}
