#include "mesh/cover.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_CELLS = 256 }; // cells per side

typedef struct Triangle {
    Vec3 a, b, c;
} Triangle;

struct Cover {
    Triangle *triangle;
    int64_t count, capacity;
    float x, z, width, depth; // bounds of all triangles in the plane
    int side;                 // cells
    int64_t *start;           // per cell, its first index in item; side * side + 1 entries
    int32_t *item;            // triangle indices
};

Cover *cover_new(Error *e)
{
    return memory_alloc_zero(1, sizeof(Cover), e);
}

void cover_free(Cover *cover)
{
    if (cover) {
        free(cover->triangle);
        free(cover->start);
        free(cover->item);
        free(cover);
    }
}

bool cover_add(Cover *cover, const Mesh *mesh, Error *e)
{
    int64_t more = mesh->face_count * (mesh->face_size - 2);
    if (!memory_reserve(&cover->triangle, &cover->capacity, cover->count + more,
                        sizeof *cover->triangle, e)) {
        return false;
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        for (int k = 2; k < mesh->face_size; k++) {
            cover->triangle[cover->count++] =
                (Triangle){mesh->position[corner[0]], mesh->position[corner[k - 1]],
                           mesh->position[corner[k]]};
        }
    }
    return true;
}

static float least(float a, float b, float c)
{
    float d = a < b ? a : b;
    return c < d ? c : d;
}

static int cell_of(float x, float low, float extent, int side)
{
    float t = extent > 0.0f ? (x - low) / extent * (float)side : 0.0f;
    return (int)clampf(t, 0.0f, (float)(side - 1));
}

// Range of cells that a triangle's bounds overlap: columns, then rows.
static void cells_of(const Cover *cover, const Triangle *t, int range[4])
{
    range[0] = cell_of(least(t->a.x, t->b.x, t->c.x), cover->x, cover->width, cover->side);
    range[1] = cell_of(-least(-t->a.x, -t->b.x, -t->c.x), cover->x, cover->width, cover->side);
    range[2] = cell_of(least(t->a.z, t->b.z, t->c.z), cover->z, cover->depth, cover->side);
    range[3] = cell_of(-least(-t->a.z, -t->b.z, -t->c.z), cover->z, cover->depth, cover->side);
}

// Counts the triangles per cell (item NULL) or stores them; start[i + 1] is cell i's counter or
// write position.
static void enter_all(Cover *cover)
{
    for (int64_t i = 0; i < cover->count; i++) {
        int range[4];
        cells_of(cover, &cover->triangle[i], range);
        for (int row = range[2]; row <= range[3]; row++) {
            for (int column = range[0]; column <= range[1]; column++) {
                int64_t *next = &cover->start[(int64_t)row * cover->side + column + 1];
                if (cover->item) {
                    cover->item[*next] = (int32_t)i;
                }
                ++*next;
            }
        }
    }
}

static void find_bounds(Cover *cover)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < cover->count; i++) {
        box = aabb_add(box, cover->triangle[i].a);
        box = aabb_add(box, cover->triangle[i].b);
        box = aabb_add(box, cover->triangle[i].c);
    }
    cover->x = box.low.x;
    cover->z = box.low.z;
    cover->width = box.high.x - box.low.x;
    cover->depth = box.high.z - box.low.z;
}

bool cover_finish(Cover *cover, Error *e)
{
    find_bounds(cover);
    cover->side = 1;
    while (cover->side < MAX_CELLS && (int64_t)cover->side * cover->side < cover->count) {
        cover->side *= 2;
    }
    int64_t cells = (int64_t)cover->side * cover->side;
    cover->start = memory_alloc_zero(cells + 2, sizeof *cover->start, e);
    if (!cover->start) {
        return false;
    }
    enter_all(cover);
    // prefix sums: start[i + 1] becomes cell i's first index, as enter_all expects
    int64_t sum = 0;
    for (int64_t i = 0; i <= cells; i++) {
        int64_t own = cover->start[i + 1];
        cover->start[i + 1] = sum;
        sum += own;
    }
    cover->item = memory_alloc(sum, sizeof *cover->item, e);
    if (!cover->item) {
        return false;
    }
    enter_all(cover);
    return true;
}

// Height of a triangle above (x, z), if it covers that point, or all but covers it: `beside` it, as
// a share of its size; *up: whether it faces up.
static bool height_over(const Triangle *t, float x, float z, float beside, float *height, bool *up)
{
    float bx = t->b.x - t->a.x, bz = t->b.z - t->a.z, cx = t->c.x - t->a.x, cz = t->c.z - t->a.z;
    float area = bz * cx - bx * cz; // positive if counter-clockwise seen from above
    float px = x - t->a.x, pz = z - t->a.z;
    float u = pz * cx - px * cz, v = bz * px - bx * pz;
    if (area < 0.0f) {
        u = -u;
        v = -v;
    }
    float size = fabsf(area), out = beside * size;
    if (!(size > 0.0f) || u < -out || v < -out || u + v > size + out) {
        return false;
    }
    *height = t->a.y + (u * (t->b.y - t->a.y) + v * (t->c.y - t->a.y)) / size;
    *up = area > 0.0f;
    return true;
}

// Items of the cell at a place: from `first` to the one before `end`, none beside all triangles.
typedef struct CellItems {
    int64_t first, end;
} CellItems;

static CellItems items_at(const Cover *cover, float x, float z)
{
    if (cover->count == 0 || x < cover->x || z < cover->z || x > cover->x + cover->width ||
        z > cover->z + cover->depth) {
        return (CellItems){0};
    }
    int column = cell_of(x, cover->x, cover->width, cover->side);
    int row = cell_of(z, cover->z, cover->depth, cover->side);
    int64_t cell = (int64_t)row * cover->side + column;
    return (CellItems){cover->start[cell], cover->start[cell + 1]};
}

bool cover_hides(const Cover *cover, Vec3 p)
{
    CellItems items = items_at(cover, p.x, p.z);
    float nearest = INFINITY;
    bool hidden = false;
    for (int64_t k = items.first; k < items.end; k++) {
        float height;
        bool up;
        if (height_over(&cover->triangle[cover->item[k]], p.x, p.z, 0.0f, &height, &up) &&
            height > p.y && height < nearest) {
            nearest = height;
            hidden = up;
        }
    }
    return hidden;
}

static Vec3 upward_normal(const Triangle *t)
{
    Vec3 normal = vec3_normalize(vec3_cross(vec3_sub(t->b, t->a), vec3_sub(t->c, t->a)));
    return normal.y < 0.0f ? vec3_scale(normal, -1.0f) : normal;
}

bool cover_top(const Cover *cover, float x, float z, float *height, Vec3 *normal)
{
    const float beside = 1e-4f; // places on an edge are in one of its triangles at least
    CellItems items = items_at(cover, x, z);
    const Triangle *top = NULL;
    for (int64_t k = items.first; k < items.end; k++) {
        const Triangle *t = &cover->triangle[cover->item[k]];
        float own;
        bool up;
        if (height_over(t, x, z, beside, &own, &up) && (!top || own > *height)) {
            *height = own;
            top = t;
        }
    }
    if (top) {
        *normal = upward_normal(top);
    }
    return top;
}
