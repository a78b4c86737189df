#include "grow/venation/venation.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static int64_t column_of(const VeinGrid *grid, int axis, float offset)
{
    int64_t c = (int64_t)(offset / grid->cell);
    return offset < 0.0f || c < 0 ? 0 : (c >= grid->size[axis] ? grid->size[axis] - 1 : c);
}

static int64_t cell_of(const VeinGrid *grid, Vec3 p)
{
    return column_of(grid, 1, p.y - grid->low.y) * grid->size[0] +
           column_of(grid, 0, p.x - grid->low.x);
}

bool vein_grid_fill(VeinGrid *grid, const Vec3 *position, int64_t count, Aabb box, float cell,
                    Error *e)
{
    grid->cell = cell;
    grid->low = box.low;
    grid->size[0] = (int64_t)((box.high.x - box.low.x) / cell) + 1;
    grid->size[1] = (int64_t)((box.high.y - box.low.y) / cell) + 1;
    int64_t cells = grid->size[0] * grid->size[1];
    if (!memory_reserve(&grid->first, &grid->cell_capacity, cells + 2, sizeof(int32_t), e) ||
        !memory_reserve(&grid->node, &grid->node_capacity, count, sizeof(int32_t), e)) {
        return false;
    }
    memset(grid->first, 0, sizeof(int32_t) * (size_t)(cells + 2));
    int32_t *end = grid->first + 1; // shifted by one; becomes each cell's end while nodes are
                                    // stored
    for (int64_t i = 0; i < count; i++) {
        end[cell_of(grid, position[i]) + 1]++;
    }
    for (int64_t c = 0; c < cells; c++) {
        end[c + 1] += end[c];
    }
    for (int64_t i = 0; i < count; i++) {
        grid->node[end[cell_of(grid, position[i])]++] = (int32_t)i;
    }
    return true;
}

void vein_grid_free(VeinGrid *grid)
{
    free(grid->first);
    free(grid->node);
    *grid = (VeinGrid){0};
}

// The cells that a disc may overlap, row by row; the cells of a row are contiguous.
typedef struct Window {
    int64_t x0, x1, y, y1;
} Window;

static Window window_about(const VeinGrid *grid, Vec3 p, float reach)
{
    return (Window){column_of(grid, 0, p.x - reach - grid->low.x),
                    column_of(grid, 0, p.x + reach - grid->low.x),
                    column_of(grid, 1, p.y - reach - grid->low.y),
                    column_of(grid, 1, p.y + reach - grid->low.y)};
}

static const int32_t *row_begin(const VeinGrid *grid, const Window *w)
{
    return grid->node + grid->first[w->y * grid->size[0] + w->x0];
}

static const int32_t *row_end(const VeinGrid *grid, const Window *w)
{
    return grid->node + grid->first[w->y * grid->size[0] + w->x1 + 1];
}

static float squared_distance(Vec3 a, Vec3 b)
{
    Vec3 d = vec3_sub(a, b);
    return vec3_dot(d, d);
}

int32_t vein_nearest(const VeinGrid *grid, const Vec3 *position, Vec3 p, float reach)
{
    float least = reach * reach;
    int32_t found = -1;
    for (Window w = window_about(grid, p, reach); w.y <= w.y1; w.y++) {
        for (const int32_t *i = row_begin(grid, &w), *end = row_end(grid, &w); i < end; i++) {
            float d2 = squared_distance(position[*i], p);
            if (d2 < least || (d2 == least && found >= 0 && *i < found)) {
                least = d2;
                found = *i;
            }
        }
    }
    return found;
}

// Index of the sector [0, 60), [60, 120), ... degrees. Two points of one sector subtend less than
// 60 degrees at its apex, so the farther is nearer to the other point than to the apex.
static int sector_of(float x, float y)
{
    const float root3 = 1.7320508f;
    if (y > 0.0f || (y == 0.0f && x > 0.0f)) {
        return y < root3 * x ? 0 : (y > -root3 * x ? 1 : 2);
    }
    return -y < -root3 * x ? 3 : (-y > root3 * x ? 4 : 5);
}

static bool is_blocked(const VeinGrid *grid, const Vec3 *position, Vec3 p, int32_t v, float d2)
{
    float reach = sqrtf(d2);
    for (Window w = window_about(grid, p, reach); w.y <= w.y1; w.y++) {
        for (const int32_t *i = row_begin(grid, &w), *end = row_end(grid, &w); i < end; i++) {
            if (*i != v && squared_distance(position[*i], p) < d2 &&
                squared_distance(position[*i], position[v]) < d2) {
                return true;
            }
        }
    }
    return false;
}

int vein_relative_neighbours(const VeinGrid *grid, const Vec3 *position, Vec3 p, float reach,
                             int32_t neighbour[VEIN_MAX_NEIGHBOURS])
{
    int32_t nearest[VEIN_MAX_NEIGHBOURS];
    float least[VEIN_MAX_NEIGHBOURS];
    for (int k = 0; k < VEIN_MAX_NEIGHBOURS; k++) {
        nearest[k] = -1;
        least[k] = reach * reach;
    }
    for (Window w = window_about(grid, p, reach); w.y <= w.y1; w.y++) {
        for (const int32_t *i = row_begin(grid, &w), *end = row_end(grid, &w); i < end; i++) {
            float d2 = squared_distance(position[*i], p);
            int k = sector_of(position[*i].x - p.x, position[*i].y - p.y);
            if (d2 < least[k] || (d2 == least[k] && nearest[k] >= 0 && *i < nearest[k])) {
                least[k] = d2;
                nearest[k] = *i;
            }
        }
    }
    int count = 0;
    for (int k = 0; k < VEIN_MAX_NEIGHBOURS; k++) {
        if (nearest[k] >= 0 && !is_blocked(grid, position, p, nearest[k], least[k])) {
            neighbour[count++] = nearest[k];
        }
    }
    return count;
}
