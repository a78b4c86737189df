#include "shape/points.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

PointSet *points_new(Error *e)
{
    PointSet *points = memory_alloc_zero(1, sizeof *points, e);
    if (points) {
        points->dimension = 3;
    }
    return points;
}

// Reserves `count` points in all three arrays; capacity is that of the smallest.
static bool points_reserve(PointSet *points, int64_t count, Error *e)
{
    int64_t capacity[3] = {points->capacity, points->capacity, points->capacity};
    if (!memory_reserve(&points->position, &capacity[0], count, sizeof *points->position, e) ||
        !memory_reserve(&points->normal, &capacity[1], count, sizeof *points->normal, e) ||
        !memory_reserve(&points->id, &capacity[2], count, sizeof *points->id, e)) {
        return false; // arrays already grown are merely larger than capacity says
    }
    points->capacity = capacity[0];
    return true;
}

bool points_add(PointSet *points, Vec3 position, Vec3 normal, uint64_t id, Error *e)
{
    if (!points_reserve(points, points->count + 1, e)) {
        return false;
    }
    points->position[points->count] = position;
    points->normal[points->count] = normal;
    points->id[points->count] = id;
    points->count++;
    return true;
}

void points_free(PointSet *points)
{
    if (points) {
        free(points->position);
        free(points->normal);
        free(points->id);
        free(points);
    }
}

double points_spacing(const PointSet *points)
{
    if (points->count < 1 || !(points->measure > 0.0)) {
        return 0.0;
    }
    double share = points->measure / (double)points->count;
    return points->dimension == 2 ? sqrt(share) : exact_exp(exact_log(share) / 3.0);
}
