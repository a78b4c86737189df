#include "land/height_raster.h"

#include <math.h>
#include <stddef.h>

#define LEAST_CELL 1e-6f // m: a mesh without extent has one
#define OUTSIDE 1e-5f    // of barycentric coordinates, so that no sample falls between two faces

typedef struct Span {
    int first, last;
} Span;

// The samples from low to high (m).
static Span samples_between(float low, float high, float origin, float cell, int count)
{
    double first = floor((double)(low - origin) / (double)cell);
    double last = ceil((double)(high - origin) / (double)cell);
    return (Span){(int)fmax(first, 0.0), (int)fmin(last, count - 1.0)};
}

static float least(float a, float b, float c)
{
    return fminf(a, fminf(b, c));
}

static float most(float a, float b, float c)
{
    return fmaxf(a, fmaxf(b, c));
}

// The height of the triangle's plane at x, z; NAN outside of the triangle.
static float height_within(const Vec3 corner[3], float x, float z)
{
    float ax = corner[1].x - corner[0].x, az = corner[1].z - corner[0].z;
    float bx = corner[2].x - corner[0].x, bz = corner[2].z - corner[0].z;
    float area = ax * bz - az * bx, px = x - corner[0].x, pz = z - corner[0].z;
    float u = (px * bz - pz * bx) / area, v = (ax * pz - az * px) / area;
    bool inside = u >= -OUTSIDE && v >= -OUTSIDE && u + v <= 1.0f + OUTSIDE;
    return inside ? corner[0].y + u * (corner[1].y - corner[0].y) + v * (corner[2].y - corner[0].y)
                  : NAN;
}

static void raise_to_triangle(HeightField *field, const Vec3 c[3])
{
    Span columns = samples_between(least(c[0].x, c[1].x, c[2].x), most(c[0].x, c[1].x, c[2].x),
                                   field->origin.x, field->cell.x, field->columns);
    Span rows = samples_between(least(c[0].z, c[1].z, c[2].z), most(c[0].z, c[1].z, c[2].z),
                                field->origin.y, field->cell.y, field->rows);
    for (int row = rows.first; row <= rows.last; row++) {
        for (int column = columns.first; column <= columns.last; column++) {
            float *height = &field->height[(int64_t)row * field->columns + column];
            float x = field->origin.x + (float)column * field->cell.x;
            float z = field->origin.y + (float)row * field->cell.y;
            *height = fmaxf(*height, height_within(c, x, z)); // fmaxf passes NAN over
        }
    }
}

static Vec3 corner(const Mesh *mesh, int64_t face, int number)
{
    return mesh->position[mesh->index[face * mesh->face_size + number]];
}

HeightField *height_field_of_mesh(const Mesh *mesh, int side, Error *e)
{
    Aabb bounds = mesh_bounds(mesh);
    float cells = (float)(side - 1);
    Vec2 cell = {fmaxf((bounds.high.x - bounds.low.x) / cells, LEAST_CELL),
                 fmaxf((bounds.high.z - bounds.low.z) / cells, LEAST_CELL)};
    Vec2 origin = {bounds.low.x, bounds.low.z};
    HeightField *field = height_field_new(side, side, cell, origin, e);
    if (!field) {
        return NULL;
    }
    for (int64_t i = 0; i < height_field_count(field); i++) {
        field->height[i] = NAN;
    }
    for (int64_t face = 0; face < mesh->face_count; face++) {
        for (int k = 2; k < mesh->face_size; k++) {
            const Vec3 triangle[3] = {corner(mesh, face, 0), corner(mesh, face, k - 1),
                                      corner(mesh, face, k)};
            raise_to_triangle(field, triangle);
        }
    }
    return field;
}
