#include "shape/blend.h"

#include <math.h>

double blend_distance(double a, double b, double width)
{
    double h = width > 0.0 ? (width - fabs(a - b)) / width : 0.0;
    double lower = a < b ? a : b;
    return h > 0.0 ? lower - 0.25 * h * h * width : lower;
}

double blend_reach(const Blend *blend)
{
    double reach = 0.0;
    for (int i = 0; i < blend->count; i++) {
        reach += 0.25 * (double)blend->part[i].shape->blend;
    }
    return reach;
}

static double part_distance(const BlendPart *part, Vec3 p, double *bound)
{
    return part->primitive ? primitive_distance(part->primitive, p, bound)
                           : body_distance(part->body, p, bound);
}

double blend_all_distance(const void *given, Vec3 p, double *bound)
{
    const Blend *blend = given;
    double nearest, distance = part_distance(&blend->part[0], p, &nearest);
    for (int i = 1; i < blend->count; i++) {
        const Shape *shape = blend->part[i].shape;
        double width = (double)shape->blend, own;
        double next = part_distance(&blend->part[i], p, &own);
        nearest = own < nearest ? own : nearest;
        switch (shape->op) {
        case SHAPE_UNION:
            distance = blend_distance(distance, next, width);
            break;
        case SHAPE_DIFFERENCE:
            distance = -blend_distance(-distance, next, width);
            break;
        case SHAPE_INTERSECTION:
            distance = -blend_distance(-distance, -next, width);
            break;
        }
    }
    double reach = blend_reach(blend);
    *bound = nearest > reach ? nearest - reach : 0.0;
    return distance;
}
