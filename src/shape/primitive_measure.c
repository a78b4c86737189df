// Bounds, volume and area of primitives, computed from the untransformed shape and its transform.
#include "base/exact_math.h"
#include "shape/affine.h"
#include "shape/ellipsoid.h"
#include "shape/primitive.h"

#include <math.h>

#define PI_D 3.14159265358979323846

static double length3(double x, double y, double z)
{
    return sqrt(x * x + y * y + z * z);
}

// Extends box by the points centre +- reach, rounded outward.
static Aabb add_extent(Aabb box, const double center[3], const double reach[3])
{
    float low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = nextafterf((float)(center[i] - reach[i]), -INFINITY);
        high[i] = nextafterf((float)(center[i] + reach[i]), INFINITY);
    }
    return aabb_add(aabb_add(box, vec3(low[0], low[1], low[2])), vec3(high[0], high[1], high[2]));
}

// Extends box by the image of the ellipsoid or (size 0) disc with these half-axes about (0, y, 0).
static Aabb add_round(Aabb box, const Primitive *p, double x, double y, double z, double at)
{
    double center[3], reach[3];
    affine_point(p->affine, (double[3]){0.0, at, 0.0}, center);
    for (int i = 0; i < 3; i++) {
        reach[i] = length3(p->affine[i][0] * x, p->affine[i][1] * y, p->affine[i][2] * z);
    }
    return add_extent(box, center, reach);
}

Aabb primitive_bounds(const Primitive *p)
{
    const double *s = p->raw_size;
    Aabb box = aabb_empty();
    double center[3], reach[3];
    switch (p->kind) {
    case SHAPE_BOX:
        for (int i = 0; i < 3; i++) {
            center[i] = p->affine[i][3];
            reach[i] = fabs(p->affine[i][0]) * s[0] + fabs(p->affine[i][1]) * s[1] +
                       fabs(p->affine[i][2]) * s[2];
        }
        return add_extent(box, center, reach);
    case SHAPE_CONE:
        box = add_round(box, p, s[0], 0.0, s[0], 0.0);
        return add_round(box, p, s[2], 0.0, s[2], s[1]);
    case SHAPE_CAPSULE:
        box = add_round(box, p, s[0], s[0], s[0], 0.0);
        return add_round(box, p, s[0], s[0], s[0], s[1]);
    case SHAPE_HALF_SPACE:
        return (Aabb){vec3_splat(-INFINITY), vec3_splat(INFINITY)};
    default: // forward is a rotation, and size holds the half-axes
        for (int i = 0; i < 3; i++) {
            center[i] = p->forward[i][3];
            reach[i] = length3(p->forward[i][0] * p->size[0], p->forward[i][1] * p->size[1],
                               p->forward[i][2] * p->size[2]);
        }
        return add_extent(box, center, reach);
    }
}

Transform primitive_frame(const Primitive *p)
{
    const double *s = p->raw_size;
    double low[3] = {-s[0], -s[1], -s[2]}, high[3] = {s[0], s[1], s[2]}, wide = fmax(s[0], s[2]);
    if (p->kind == SHAPE_CONE) {
        low[0] = low[2] = -wide, low[1] = 0.0;
        high[0] = high[2] = wide;
    } else if (p->kind == SHAPE_CAPSULE) {
        low[0] = low[1] = low[2] = -s[0];
        high[0] = high[2] = s[0], high[1] = s[1] + s[0];
    }
    bool round = p->kind == SHAPE_ELLIPSOID; // the unit sphere scaled along its axes
    Transform t;
    for (int i = 0; i < 3; i++) {
        double origin = p->affine[i][3];
        for (int j = 0; j < 3; j++) {
            double axis = round ? p->forward[i][j] * p->size[j] : p->affine[i][j];
            // slightly wider, against rounding in the mapping
            double from = (round ? -1.0 : low[j]) * 1.000001;
            double to = (round ? 1.0 : high[j]) * 1.000001;
            t.m[i][j] = (float)(axis * (to - from));
            origin += axis * from;
        }
        t.m[i][3] = (float)origin;
    }
    return t;
}

double primitive_volume(const Primitive *p)
{
    const double *s = p->raw_size;
    double scale = fabs(affine_determinant(p->affine));
    switch (p->kind) {
    case SHAPE_BOX:
        return scale * 8.0 * s[0] * s[1] * s[2];
    case SHAPE_CONE:
        return scale * PI_D / 3.0 * s[1] * (s[0] * s[0] + s[0] * s[2] + s[2] * s[2]);
    case SHAPE_CAPSULE:
        return scale * PI_D * s[0] * s[0] * (4.0 / 3.0 * s[0] + s[1]);
    case SHAPE_HALF_SPACE:
        return INFINITY;
    default:
        return 4.0 / 3.0 * PI_D * p->size[0] * p->size[1] * p->size[2];
    }
}

// Area of the image of a patch with this area and unit normal.
static double mapped_area(const double cofactor[3][3], double x, double y, double z)
{
    double v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = cofactor[i][0] * x + cofactor[i][1] * y + cofactor[i][2] * z;
    }
    return length3(v[0], v[1], v[2]);
}

// Mean over the azimuth of the area to which a unit patch with normal (cos a, rise, sin a) maps;
// the trapezoidal rule converges exponentially here. rise is not normalised.
static double mean_mapped_area(const double cofactor[3][3], double rise)
{
    enum { STEPS = 512 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        float s, c;
        exact_sincos((float)(2.0 * PI_D * i / STEPS), &s, &c);
        sum += mapped_area(cofactor, (double)c, rise, (double)s);
    }
    return sum / STEPS;
}

double primitive_area(const Primitive *p)
{
    const double *s = p->raw_size;
    double cofactor[3][3], scaled[3][4], axes[3][3], half[3];
    affine_cofactors(p->affine, cofactor);
    switch (p->kind) {
    case SHAPE_BOX:
        return 8.0 * (mapped_area(cofactor, s[1] * s[2], 0, 0) +
                      mapped_area(cofactor, 0, s[0] * s[2], 0) +
                      mapped_area(cofactor, 0, 0, s[0] * s[1]));
    case SHAPE_CONE: // the side's normal is (h, r0 - r1, h) / slant and its area pi (r0 + r1) slant
        return PI_D * (s[0] * s[0] + s[2] * s[2]) * mapped_area(cofactor, 0, 1, 0) +
               PI_D * (s[0] + s[2]) * s[1] * mean_mapped_area(cofactor, (s[0] - s[2]) / s[1]);
    case SHAPE_CAPSULE: // two half spheres and a cylinder
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 4; j++) {
                scaled[i][j] = p->affine[i][j] * (j < 3 ? s[0] : 1.0);
            }
        }
        affine_principal_axes(scaled, axes, half);
        return ellipsoid_area(half) + 2.0 * PI_D * s[0] * s[1] * mean_mapped_area(cofactor, 0.0);
    case SHAPE_HALF_SPACE:
        return INFINITY;
    default:
        return ellipsoid_area(p->size);
    }
}
