// Snow on a flat spray: the spray's faces are gathered in cells across its plane; where they are
// dense, a cushion lies on their upper side.
#include "mesh/snow/snow.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COVER_ENOUGH 0.3f // share of a cell that must be covered to bear all snow
#define COVER_LEAST 0.3f  // of that, after spreading, to bear any
enum { SPREADINGS = 2, SMOOTHINGS = 4 };

typedef struct Cells {
    int across, along;
    Vec3 low;            // m, of the spray's bounds
    float width, length; // m, of a cell
    float *area;         // m2, of the spray's faces in each cell
    float *height;       // m, of what bears the snow, times the area
    float *cover;        // 0..1: how much of the full depth lies on each cell
} Cells;

static void cells_clear(Cells *cells)
{
    free(cells->area);
    free(cells->height);
    free(cells->cover);
}

// Index of the cell, -1 beside the grid.
static int cell_at(const Cells *cells, int x, int y)
{
    bool inside = x >= 0 && x < cells->across && y >= 0 && y < cells->along;
    return inside ? y * cells->across + x : -1;
}

static float cover_of(const Cells *cells, int x, int y)
{
    int cell = cell_at(cells, x, y);
    return cell < 0 ? 0.0f : cells->cover[cell];
}

static bool bears(const Cells *cells, int x, int y)
{
    return cover_of(cells, x, y) >= COVER_LEAST;
}

// Adds every face to the cell of its middle.
static void gather(Cells *cells, const Mesh *spray)
{
    for (int64_t f = 0; f < spray->face_count; f++) {
        const uint32_t *corner = spray->index + f * spray->face_size;
        Vec3 a = spray->position[corner[0]], b = spray->position[corner[1]];
        Vec3 c = spray->position[corner[2]], d = spray->position[corner[spray->face_size - 1]];
        float area = 0.5f * vec3_length(vec3_cross(vec3_sub(c, a), vec3_sub(d, b)));
        Vec3 middle = vec3_scale(vec3_add(vec3_add(a, b), vec3_add(c, d)), 0.25f);
        Vec3 place = vec3_sub(middle, cells->low);
        int x = (int)(place.x / cells->width), y = (int)(place.y / cells->length);
        int cell = cell_at(cells, x < cells->across ? x : cells->across - 1,
                           y < cells->along ? y : cells->along - 1);
        if (cell >= 0) {
            cells->area[cell] += area;
            cells->height[cell] += area * middle.z;
        }
    }
}

// Snow bridges small gaps, and a cushion is deepest in its middle: the cover is averaged with that
// of the cells around. Snow that would lie beside the spray is lost.
static bool spread(Cells *cells, Error *e)
{
    int64_t count = (int64_t)cells->across * cells->along;
    float enough = COVER_ENOUGH * cells->width * cells->length;
    float *mean = memory_alloc(count, sizeof *mean, e);
    for (int64_t i = 0; mean && i < count; i++) {
        cells->cover[i] = fminf(1.0f, cells->area[i] / enough);
    }
    for (int turn = 0; mean && turn < SPREADINGS; turn++) {
        for (int64_t i = 0; i < count; i++) {
            int x = (int)(i % cells->across), y = (int)(i / cells->across);
            float sum = 2.0f * cells->cover[i];
            for (int k = 0; k < 9; k++) {
                sum += cover_of(cells, x + k % 3 - 1, y + k / 3 - 1);
            }
            mean[i] = sum / 11.0f;
        }
        memcpy(cells->cover, mean, (size_t)count * sizeof *mean);
    }
    free(mean);
    return mean;
}

static bool cells_init(Cells *cells, const Mesh *spray, int count, Error *e)
{
    Aabb box = mesh_bounds(spray);
    Vec3 size = vec3_sub(box.high, box.low);
    *cells = (Cells){.across = count, .along = 2 * count, .low = box.low};
    cells->width = fmaxf(size.x, 1e-6f) / (float)cells->across;
    cells->length = fmaxf(size.y, 1e-6f) / (float)cells->along;
    cells->area = memory_alloc_zero((int64_t)cells->across * cells->along, sizeof(float), e);
    cells->height = memory_alloc_zero((int64_t)cells->across * cells->along, sizeof(float), e);
    cells->cover = memory_alloc_zero((int64_t)cells->across * cells->along, sizeof(float), e);
    bool done = cells->area && cells->height && cells->cover;
    if (done) {
        gather(cells, spray);
        done = spread(cells, e);
    }
    if (!done) {
        cells_clear(cells);
    }
    return done;
}

// The lower and the upper vertex at a corner of cells: their means over the four cells about it.
static void set_corner(const Cells *cells, int x, int y, float depth, bool turned, Vec3 *position)
{
    float cover = 0.0f, area = 0.0f, height = 0.0f;
    for (int k = 0; k < 4; k++) {
        int cx = x - (k & 1), cy = y - (k >> 1), cell = cell_at(cells, cx, cy);
        cover += 0.25f * cover_of(cells, cx, cy);
        area += cell < 0 ? 0.0f : cells->area[cell];
        height += cell < 0 ? 0.0f : cells->height[cell];
    }
    Vec3 p = vec3(cells->low.x + (float)x * cells->width, cells->low.y + (float)y * cells->length,
                  area > 0.0f ? height / area : 0.0f);
    float side = turned ? -1.0f : 1.0f, thick = 1.3f * depth * cover; // smoothing lowers it
    position[0] = vec3(p.x, p.y, p.z - side * 0.1f * thick);
    position[1] = vec3(p.x, p.y, p.z + side * thick);
}

// Upper, lower and side faces of one cell; returns their number. corner NULL: only counts. Corners
// are numbered row by row, two vertices each.
static int cell_faces(const Cells *cells, int x, int y, bool turned, uint32_t *corner)
{
    static const int STEP[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    static const int BESIDE[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    if (!bears(cells, x, y)) {
        return 0;
    }
    uint32_t low[5];
    for (int k = 0; k < 5; k++) {
        low[k] = 2 * (uint32_t)((y + STEP[k][1]) * (cells->across + 1) + x + STEP[k][0]);
    }
    uint32_t face[6][4] = {{low[0] + 1, low[1] + 1, low[2] + 1, low[3] + 1},
                           {low[3], low[2], low[1], low[0]}};
    int count = 2;
    for (int k = 0; k < 4; k++) {
        if (!bears(cells, x + BESIDE[k][0], y + BESIDE[k][1])) {
            const uint32_t wall[4] = {low[k], low[k + 1], low[k + 1] + 1, low[k] + 1};
            memcpy(face[count++], wall, sizeof wall);
        }
    }
    for (int i = 0; corner && i < count * 4; i++) {
        corner[i] = face[i / 4][turned ? 3 - i % 4 : i % 4];
    }
    return count;
}

static Mesh *mesh_of(const Cells *cells, float depth, bool turned, Error *e)
{
    int64_t faces = 0;
    for (int i = 0; i < cells->across * cells->along; i++) {
        faces += cell_faces(cells, i % cells->across, i / cells->across, turned, NULL);
    }
    int row = cells->across + 1;
    Mesh *mesh = mesh_new(4, 2 * (int64_t)row * (cells->along + 1), faces, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    for (int i = 0; i < row * (cells->along + 1); i++) {
        set_corner(cells, i % row, i / row, depth, turned, &mesh->position[2 * i]);
    }
    uint32_t *corner = mesh->index;
    for (int i = 0; i < cells->across * cells->along; i++) {
        corner += 4 * cell_faces(cells, i % cells->across, i / cells->across, turned, corner);
    }
    return mesh;
}

// Moves every vertex toward the mean of its neighbours, so that the cells' corners become round.
static bool smooth(Mesh *mesh, Error *e)
{
    Vec3 *sum = memory_alloc(mesh->vertex_count, sizeof *sum, e);
    int32_t *count = memory_alloc(mesh->vertex_count, sizeof *count, e);
    for (int turn = 0; sum && count && turn < SMOOTHINGS; turn++) {
        for (int64_t v = 0; v < mesh->vertex_count; v++) {
            sum[v] = vec3(0, 0, 0);
            count[v] = 0;
        }
        for (int64_t i = 0; i < mesh->face_count * 4; i++) {
            uint32_t from = mesh->index[i], to = mesh->index[i % 4 == 3 ? i - 3 : i + 1];
            sum[to] = vec3_add(sum[to], mesh->position[from]);
            count[to]++;
        }
        for (int64_t v = 0; v < mesh->vertex_count; v++) {
            if (count[v] > 0) {
                Vec3 mean = vec3_scale(sum[v], 1.0f / (float)count[v]);
                mesh->position[v] = vec3_lerp(mesh->position[v], mean, 0.5f);
            }
        }
    }
    free(sum);
    free(count);
    return sum && count;
}

Mesh *snow_on_spray(const Mesh *spray, float depth, bool turned, int count, Error *e)
{
    Cells cells;
    if (!cells_init(&cells, spray, count, e)) {
        return NULL;
    }
    Mesh *mesh = mesh_of(&cells, depth, turned, e);
    cells_clear(&cells);
    if (mesh && (!smooth(mesh, e) || !mesh_compute_normals(mesh, e))) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
