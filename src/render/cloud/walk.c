#include "render/cloud/walk.h"

// m: no cloud is seen beyond, where the Earth's curve has hidden it.
static const float REACH = 90000.0f;

// The part of the ray within the grid; false if there is none.
static bool clip(const CloudGrid *g, const CloudRay *ray, float *near, float *far)
{
    *near = 0.0f;
    *far = fminf(ray->far, REACH);
    for (int axis = 0; axis < 3; axis++) {
        if (g->repeats && axis != 1) {
            continue;
        }
        float low = vec3_axis(g->low, axis), d = vec3_axis(ray->direction, axis);
        float high = low + g->voxel * (float)g->count[axis], o = vec3_axis(ray->origin, axis);
        if (d == 0.0f) {
            if (o < low || o > high) {
                return false;
            }
            continue;
        }
        float a = (low - o) / d, b = (high - o) / d;
        *near = fmaxf(*near, fminf(a, b));
        *far = fminf(*far, fmaxf(a, b));
    }
    return *near < *far;
}

static inline int next_axis(const Steps *s)
{
    int axis = s->next[0] < s->next[1] ? 0 : 1;
    return s->next[2] < s->next[axis] ? 2 : axis;
}

static inline void take_bounds(Walk *w, CloudBounds bounds)
{
    float step = w->grid->extinction / CELL_STEPS;
    w->least = (float)bounds.least * step;
    w->most = (float)bounds.most * step;
}

// ---- parts ----

static inline void enter_part(Walk *w)
{
    const int *at = w->parts.at;
    take_bounds(w, w->part[(at[2] * PARTS + at[0]) * PARTS + at[1]]);
    float far = w->parts.next[next_axis(&w->parts)];
    w->far = far < w->cell_far ? far : w->cell_far;
}

static void enter_parts(Walk *w)
{
    for (int axis = 0; axis < 3; axis++) {
        if (w->rate[axis] == 0.0f) {
            int at = (int)((w->still[axis] - (float)w->cells.at[axis]) * PARTS);
            w->parts.at[axis] = at < PARTS ? at : PARTS - 1;
            w->parts.next[axis] = INFINITY;
            continue;
        }
        int left = (int)((w->cells.next[axis] - w->near) * w->rate[axis] * PARTS);
        left = left < 0 ? 0 : (left < PARTS ? left : PARTS - 1); // whole parts to cross after it
        w->parts.at[axis] = w->step[axis] > 0 ? PARTS - 1 - left : left;
        w->parts.next[axis] = w->cells.next[axis] - (float)left * w->delta[axis] * (1.0f / PARTS);
    }
    enter_part(w);
}

// False where the ray leaves the cell.
static inline bool next_part(Walk *w)
{
    if (!w->part || w->far >= w->cell_far) {
        return false;
    }
    int axis = next_axis(&w->parts), at = w->parts.at[axis] + w->step[axis];
    if ((unsigned)at >= PARTS) { // by rounding
        return false;
    }
    w->near = w->far;
    w->parts.at[axis] = at;
    w->parts.next[axis] += w->delta[axis] * (1.0f / PARTS);
    enter_part(w);
    return true;
}

// ---- cells ----

// Moves to the last cells of a gap that reaches `cells` further along each axis.
static void leap(Walk *w, int cells)
{
    Steps *s = &w->cells;
    float out = INFINITY; // where the ray leaves the gap
    for (int axis = 0; axis < 3; axis++) {
        float t = s->next[axis] + (float)cells * w->delta[axis];
        out = t < out ? t : out;
    }
    for (int axis = 0; axis < 3; axis++) {
        if (s->next[axis] <= out) {
            int crossed = (int)((out - s->next[axis]) * w->rate[axis]) + 1;
            crossed = crossed < cells ? crossed : cells;
            s->at[axis] += w->step[axis] * crossed;
            s->next[axis] += w->delta[axis] * (float)crossed;
        }
    }
}

static void enter_cell(Walk *w)
{
    const CloudGrid *g = w->grid;
    const int *at = w->cells.at;
    int64_t place = cloud_grid_cell(g, at[0], at[1], at[2]);
    CloudCell cell = {.parts = -1};
    if (place >= 0) {
        cell = g->cell[place];
    }
    if (cell.gap > 1) {
        leap(w, cell.gap - 1);
    }
    float far = w->cells.next[next_axis(&w->cells)];
    w->far = w->cell_far = far < w->end ? far : w->end;
    w->part = NULL;
    if (cell.parts >= 0 && !w->whole) {
        w->part = &g->part[(int64_t)cell.parts * PARTS * PARTS * PARTS];
        enter_parts(w);
    } else {
        take_bounds(w, cell.bounds);
    }
}

// In a file's own space, where its direction is about as long.
static CloudRay ray_in(const CloudGrid *g, const CloudRay *ray)
{
    CloudRay own = *ray;
    if (g->voxels) {
        own.origin = transform_point(&g->to_own, ray->origin);
        own.direction = transform_vector(&g->to_own, ray->direction);
    }
    return own;
}

bool walk_begin(Walk *w, const CloudGrid *g, const CloudRay *scene_ray, bool whole)
{
    const CloudRay own = ray_in(g, scene_ray), *ray = &own;
    w->grid = g;
    w->whole = whole;
    if (!clip(g, ray, &w->near, &w->end)) {
        return false;
    }
    float side = g->voxel * CELL;
    for (int axis = 0; axis < 3; axis++) {
        float d = vec3_axis(ray->direction, axis);
        float o = vec3_axis(ray->origin, axis) - vec3_axis(g->low, axis);
        int at = (int)floorf((o + w->near * d) / side);
        float border = side * (float)(at + (d < 0.0f ? 0 : 1));
        w->step[axis] = d < 0.0f ? -1 : 1;
        w->delta[axis] = d != 0.0f ? side / fabsf(d) : INFINITY;
        w->rate[axis] = fabsf(d) / side;
        w->still[axis] = o / side;
        w->cells.at[axis] = at;
        w->cells.next[axis] = d != 0.0f ? fmaxf((border - o) / d, w->near) : INFINITY;
    }
    enter_cell(w);
    return true;
}

bool walk_on(Walk *w)
{
    if (next_part(w)) {
        return true;
    }
    if (w->cell_far >= w->end) {
        return false;
    }
    int axis = next_axis(&w->cells);
    w->near = w->cell_far;
    w->cells.at[axis] += w->step[axis];
    w->cells.next[axis] += w->delta[axis];
    enter_cell(w);
    return true;
}
