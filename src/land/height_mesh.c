#include "land/height_mesh.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

typedef struct Mesher {
    const HeightField *field;
    const HeightMeshParams *params;
    int side;        // cells
    uint8_t *active; // 1 for samples that are vertices
    int32_t *vertex; // per sample: its vertex index, -1 = none yet
    uint32_t *index;
    int64_t index_count, index_capacity;
    int32_t *sample; // per vertex: its sample
    int64_t vertex_count, vertex_capacity;
} Mesher;

static int64_t place(const Mesher *m, int column, int row)
{
    return (int64_t)row * m->field->columns + column;
}

static float height(const Mesher *m, int column, int row)
{
    return m->field->height[place(m, column, row)];
}

static Vec3 sample_position(const HeightField *field, int column, int row)
{
    return vec3(field->origin.x + (float)column * field->cell.x,
                field->height[(int64_t)row * field->columns + column],
                field->origin.y + (float)row * field->cell.y);
}

// ---- which samples are vertices

// Height error allowed at a sample, m.
static float allowed(const Mesher *m, int column, int row)
{
    const HeightMeshParams *params = m->params;
    if (!params->eye) {
        return params->error;
    }
    float distance = vec3_distance(*params->eye, sample_position(m->field, column, row));
    distance = distance > params->nearest ? distance : params->nearest;
    float error = params->view * distance;
    return error > params->error ? error : params->error;
}

// A vertex requires the two right-angle corners of the triangles it splits.
static void need(Mesher *m, int column, int row)
{
    if (column >= 0 && row >= 0 && column <= m->side && row <= m->side) {
        m->active[place(m, column, row)] = 1;
    }
}

// Tests the midpoint of an axis-aligned edge of length 2 step along x (or z).
static void judge_edge(Mesher *m, int column, int row, int step, bool along_x)
{
    int dx = along_x ? step : 0, dz = along_x ? 0 : step;
    float mean = 0.5f * (height(m, column - dx, row - dz) + height(m, column + dx, row + dz));
    if (m->active[place(m, column, row)] ||
        fabsf(height(m, column, row) - mean) > allowed(m, column, row)) {
        m->active[place(m, column, row)] = 1;
        need(m, column - dz, row - dx);
        need(m, column + dz, row + dx);
    }
}

// Tests the centre of a square of side 2 step, split along the diagonal that its position in the
// hierarchy determines.
static void judge_center(Mesher *m, int column, int row, int step)
{
    // Corners with both coordinates odd (or both even) in units of 2 step are the ends of the
    // diagonal.
    int a = (column - step) / (2 * step), b = (row - step) / (2 * step);
    int turn = (a + b) % 2 == 0 ? 1 : -1;
    float mean = 0.5f * (height(m, column - step, row - turn * step) +
                         height(m, column + step, row + turn * step));
    if (m->active[place(m, column, row)] ||
        fabsf(height(m, column, row) - mean) > allowed(m, column, row)) {
        m->active[place(m, column, row)] = 1;
        need(m, column - step, row + turn * step);
        need(m, column + step, row - turn * step);
    }
}

static void judge_all(Mesher *m)
{
    for (int step = 1; step <= m->side / 2; step *= 2) {
        for (int row = 0; row <= m->side; row += step) {
            bool odd = (row / step) % 2 != 0;
            for (int column = odd ? 0 : step; column <= m->side; column += 2 * step) {
                judge_edge(m, column, row, step, !odd);
            }
        }
        for (int row = step; row < m->side; row += 2 * step) {
            for (int column = step; column < m->side; column += 2 * step) {
                judge_center(m, column, row, step);
            }
        }
    }
}

// ---- triangles

typedef struct Point {
    int column, row;
} Point;

static bool add_corner(Mesher *m, Point p, Error *e)
{
    int32_t *vertex = &m->vertex[place(m, p.column, p.row)];
    if (*vertex < 0) {
        if (!memory_reserve(&m->sample, &m->vertex_capacity, m->vertex_count + 1, sizeof *m->sample,
                            e)) {
            return false;
        }
        m->sample[m->vertex_count] = (int32_t)place(m, p.column, p.row);
        *vertex = (int32_t)m->vertex_count++;
    }
    m->index[m->index_count++] = (uint32_t)*vertex;
    return true;
}

// Adds the triangle with hypotenuse a b and right angle at c, counter-clockwise from above.
static bool add_triangle(Mesher *m, Point a, Point b, Point c, Error *e)
{
    int gap_x = abs(a.column - c.column), gap_z = abs(a.row - c.row);
    Point middle = {(a.column + b.column) / 2, (a.row + b.row) / 2};
    if (gap_x + gap_z > 1 && m->active[place(m, middle.column, middle.row)]) {
        return add_triangle(m, c, a, middle, e) && add_triangle(m, b, c, middle, e);
    }
    return memory_reserve(&m->index, &m->index_capacity, m->index_count + 3, sizeof *m->index, e) &&
           add_corner(m, a, e) && add_corner(m, b, e) && add_corner(m, c, e);
}

Vec3 height_mesh_normal(const HeightField *field, int column, int row)
{
    int west = column > 0 ? column - 1 : 0, north = row > 0 ? row - 1 : 0;
    int east = column + 1 < field->columns ? column + 1 : column;
    int south = row + 1 < field->rows ? row + 1 : row;
    float span_x = (float)(east - west), span_z = (float)(south - north);
    if (field->periodic) { // the rim has neighbours on the other side
        west = column > 0 ? west : field->columns - 2;
        north = row > 0 ? north : field->rows - 2;
        east = column + 1 < field->columns ? east : 1;
        south = row + 1 < field->rows ? south : 1;
        span_x = span_z = 2.0f;
    }
    const float *h = field->height;
    int64_t stride = field->columns;
    float dx = (h[row * stride + east] - h[row * stride + west]) / (span_x * field->cell.x);
    float dz = (h[south * stride + column] - h[north * stride + column]) / (span_z * field->cell.y);
    return vec3_normalize(vec3(-dx, 1.0f, -dz));
}

Vec2 height_mesh_site(const HeightField *field, int64_t sample, float low, float high)
{
    if (field->wind) {
        Vec2 wind = field->wind[sample];
        return (Vec2){0.5f + 0.5f * wind.x, 0.5f + 0.5f * wind.y};
    }
    float scale = high > low ? 1.0f / (high - low) : 0.0f;
    float felt = field->age       ? field->age[sample]
                 : field->climate ? field->climate[sample]
                                  : (field->height[sample] - low) * scale;
    const float *second = field->ground ? field->ground : field->wetness;
    return (Vec2){felt, second ? second[sample] : 0.0f};
}

static Mesh *make_mesh(const Mesher *m, Error *e)
{
    const HeightField *field = m->field;
    int arrays = MESH_NORMAL | MESH_UV | MESH_SITE | (field->water ? MESH_SHORE_ARRAY : 0);
    Mesh *mesh = mesh_new(3, m->vertex_count, m->index_count / 3, arrays, e);
    if (!mesh) {
        return NULL;
    }
    float low, high;
    height_field_range(field, &low, &high);
    memcpy(mesh->index, m->index, sizeof *m->index * (size_t)m->index_count);
    for (int64_t i = 0; i < m->vertex_count; i++) {
        int column = m->sample[i] % field->columns, row = m->sample[i] / field->columns;
        Vec3 p = sample_position(field, column, row);
        mesh->position[i] = p;
        mesh->normal[i] = height_mesh_normal(field, column, row);
        mesh->uv[i] = (Vec2){p.x, p.z};
        mesh->site[i] = height_mesh_site(field, m->sample[i], low, high);
        if (mesh->shore && field->water) {
            mesh->shore[i] = fmaxf(MESH_SHORE + field->water[m->sample[i]] - p.y, 0.0f);
        }
    }
    return mesh;
}

Mesh *height_mesh_new(const HeightField *field, const HeightMeshParams *params, Error *e)
{
    int side = field->columns - 1;
    if (field->rows != field->columns || side < 2 || (side & (side - 1)) != 0) {
        error_set(e, ERROR_INPUT,
                  "a height field of %d x %d cells cannot be meshed; its side must "
                  "be a power of two",
                  side, field->rows - 1);
        return NULL;
    }
    int64_t count = height_field_count(field);
    Mesher m = {.field = field, .params = params, .side = side};
    m.active = memory_alloc_zero(count, 1, e);
    m.vertex = memory_alloc(count, sizeof *m.vertex, e);
    bool done = m.active && m.vertex;
    if (done) {
        memset(m.vertex, 0xff, sizeof *m.vertex * (size_t)count);
        if (params->keep) {
            memcpy(m.active, params->keep, (size_t)count);
        }
        judge_all(&m);
        Point nw = {0, 0}, se = {side, side}, ne = {side, 0}, sw = {0, side};
        done = add_triangle(&m, nw, se, ne, e) && add_triangle(&m, se, nw, sw, e);
    }
    Mesh *mesh = done ? make_mesh(&m, e) : NULL;
    free(m.active);
    free(m.vertex);
    free(m.index);
    free(m.sample);
    return mesh;
}

float height_mesh_finest_at(const HeightField *field, float x, float z)
{
    float u = (x - field->origin.x) / field->cell.x, v = (z - field->origin.y) / field->cell.y;
    u = clampf(u, 0.0f, (float)(field->columns - 1));
    v = clampf(v, 0.0f, (float)(field->rows - 1));
    int column = u < (float)(field->columns - 1) ? (int)u : field->columns - 2;
    int row = v < (float)(field->rows - 1) ? (int)v : field->rows - 2;
    u -= (float)column;
    v -= (float)row;
    const float *h = field->height + (int64_t)row * field->columns + column;
    float a = h[0], b = h[1], c = h[field->columns], d = h[field->columns + 1];
    // Diagonals end where row and column are both even or both odd.
    if ((row + column) % 2 == 0) {
        return u > v ? a + u * (b - a) + v * (d - b) : a + v * (c - a) + u * (d - c);
    }
    return u + v < 1.0f ? a + u * (b - a) + v * (c - a)
                        : d + (1.0f - u) * (c - d) + (1.0f - v) * (b - d);
}
