#include "shape/blend.h"

#include <math.h>

double blend_distance(double a, double b, double width)
{
    double h = width > 0.0 ? (width - fabs(a - b)) / width : 0.0;
    double lower = a < b ? a : b;
    return h > 0.0 ? lower - 0.25 * h * h * width : lower;
}

// How far the surface of blended lower bounds lies at most from that of the distances, m.
static double bound_error(const Blend *blend)
{
    double error = 0.0;
    bool exact = true;
    for (int i = 0; i < blend->count; i++) {
        error += 0.25 * (double)blend->part[i].shape->blend;
        exact = exact && (!blend->part[i].primitive || blend->part[i].primitive->exact);
    }
    return exact ? 0.0 : error;
}

static double part_distance(const BlendPart *part, Vec3 p, double *bound)
{
    return part->primitive ? primitive_distance(part->primitive, p, bound)
                           : body_distance(part->body, p, bound);
}

static double combine(double before, double next, const Shape *shape)
{
    double width = (double)shape->blend;
    switch (shape->op) {
    case SHAPE_UNION:
        return blend_distance(before, next, width);
    case SHAPE_DIFFERENCE:
        return -blend_distance(-before, next, width);
    case SHAPE_INTERSECTION:
        break;
    }
    return -blend_distance(-before, -next, width);
}

double blend_all_distance(const void *given, Vec3 p, double *bound)
{
    const Blend *blend = given;
    double own, distance = part_distance(&blend->part[0], p, &own);
    // bounds change by no more than the way, and so does their blend
    double lower = distance < 0.0 ? -own : own;
    for (int i = 1; i < blend->count; i++) {
        double next = part_distance(&blend->part[i], p, &own);
        distance = combine(distance, next, blend->part[i].shape);
        lower = combine(lower, next < 0.0 ? -own : own, blend->part[i].shape);
    }
    double least = fabs(lower) - bound_error(blend);
    *bound = least > 0.0 ? least : 0.0;
    return distance;
}
