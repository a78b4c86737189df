#include "skin/cage.h"

#include "base/memory.h"

#include <stdlib.h>

void skin_cage_clear(SkinCage *cage)
{
    free(cage->position);
    free(cage->uv);
    free(cage->radius);
    free(cage->birth);
    free(cage->index);
    free(cage->face_axis);
}

bool skin_cage_reserve(SkinCage *cage, int64_t more_vertices, int64_t more_faces, Error *e)
{
    int64_t vertices = cage->vertex_count + more_vertices, faces = cage->face_count + more_faces;
    if (vertices > UINT32_MAX) {
        return error_set(e, ERROR_MEMORY, "the skin needs 2^32 vertices or more; raise min_radius");
    }
    return memory_reserve(&cage->position, &cage->position_capacity, vertices, sizeof(Vec3), e) &&
           memory_reserve(&cage->uv, &cage->uv_capacity, vertices, sizeof(Vec2), e) &&
           memory_reserve(&cage->radius, &cage->radius_capacity, vertices, sizeof(float), e) &&
           memory_reserve(&cage->birth, &cage->birth_capacity, vertices, sizeof(float), e) &&
           memory_reserve(&cage->index, &cage->index_capacity, 4 * faces, sizeof(uint32_t), e) &&
           memory_reserve(&cage->face_axis, &cage->axis_capacity, faces, sizeof(Vec3), e);
}

uint32_t skin_cage_add_vertex(SkinCage *cage, SkinVertex vertex)
{
    int64_t i = cage->vertex_count++;
    cage->position[i] = vertex.position;
    cage->uv[i] = vertex.uv;
    cage->radius[i] = vertex.radius;
    cage->birth[i] = vertex.birth;
    return (uint32_t)i;
}

void skin_cage_add_face(SkinCage *cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d, Vec3 axis)
{
    uint32_t *corner = cage->index + 4 * cage->face_count;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    corner[3] = d;
    cage->face_axis[cage->face_count++] = axis;
}

static SkinVertex vertex_of(const SkinCage *cage, uint32_t i)
{
    return (SkinVertex){cage->position[i], cage->uv[i], cage->radius[i], cage->birth[i]};
}

SkinVertex skin_vertex_madd(SkinVertex a, float w, SkinVertex b)
{
    a.position = vec3_madd(a.position, w, b.position);
    a.uv.x += w * b.uv.x;
    a.uv.y += w * b.uv.y;
    a.radius += w * b.radius;
    a.birth += w * b.birth;
    return a;
}

// ---- caps ----

// A loop as the rim of a grid of columns x rows squares, starting at its lower left corner.
typedef struct CapGrid {
    const uint32_t *loop;
    int columns, rows, count;
    uint32_t inner; // first inner vertex
} CapGrid;

static uint32_t cap_point(const CapGrid *grid, int x, int y)
{
    if (y == 0) {
        return grid->loop[x];
    }
    if (x == grid->columns) {
        return grid->loop[grid->columns + y];
    }
    if (y == grid->rows) {
        return grid->loop[2 * grid->columns + grid->rows - x];
    }
    if (x == 0) {
        return grid->loop[grid->count - y];
    }
    return grid->inner + (uint32_t)((y - 1) * (grid->columns - 1) + x - 1);
}

// An inner point, interpolated from the rim (Coons 1967).
static SkinVertex cap_vertex(const SkinCage *cage, const CapGrid *grid, int x, int y)
{
    float s = (float)x / (float)grid->columns, t = (float)y / (float)grid->rows;
    int w = grid->columns, h = grid->rows;
    const struct {
        int x, y;
        float weight;
    } term[8] = {{x, 0, 1 - t},
                 {x, h, t},
                 {0, y, 1 - s},
                 {w, y, s},
                 {0, 0, -(1 - s) * (1 - t)},
                 {w, 0, -s * (1 - t)},
                 {w, h, -s * t},
                 {0, h, -(1 - s) * t}};
    SkinVertex sum = {.radius = 0.0f};
    for (int i = 0; i < 8; i++) {
        uint32_t rim = cap_point(grid, term[i].x, term[i].y);
        sum = skin_vertex_madd(sum, term[i].weight, vertex_of(cage, rim));
    }
    return sum;
}

bool skin_cage_cap(SkinCage *cage, const uint32_t *loop, int count, Vec3 axis, Error *e)
{
    int columns = count / 4, rows = count / 2 - columns;
    if (!skin_cage_reserve(cage, (columns - 1) * (rows - 1), columns * rows, e)) {
        return false;
    }
    CapGrid grid = {loop, columns, rows, count, (uint32_t)cage->vertex_count};
    for (int y = 1; y < rows; y++) {
        for (int x = 1; x < columns; x++) {
            skin_cage_add_vertex(cage, cap_vertex(cage, &grid, x, y));
        }
    }
    for (int y = 0; y < rows; y++) {
        for (int x = 0; x < columns; x++) {
            skin_cage_add_face(cage, cap_point(&grid, x, y), cap_point(&grid, x + 1, y),
                               cap_point(&grid, x + 1, y + 1), cap_point(&grid, x, y + 1), axis);
        }
    }
    return true;
}
