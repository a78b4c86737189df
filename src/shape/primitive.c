#include "shape/primitive.h"

#include "shape/affine.h"
#include "shape/ellipsoid.h"

#include <math.h>
#include <stddef.h>

static bool is_positive(float x)
{
    return isfinite(x) && x > 0.0f;
}

static bool is_not_negative(float x)
{
    return isfinite(x) && x >= 0.0f;
}

static bool check_size(const Shape *shape, Error *e)
{
    Vec3 s = shape->size;
    switch (shape->kind) {
    case SHAPE_ELLIPSOID:
    case SHAPE_BOX:
        if (!is_positive(s.x) || !is_positive(s.y) || !is_positive(s.z)) {
            return error_set(e, ERROR_INPUT, "%s of half-axes %g, %g, %g m; all must be positive",
                             shape->kind == SHAPE_BOX ? "box" : "ellipsoid", (double)s.x,
                             (double)s.y, (double)s.z);
        }
        return true;
    case SHAPE_CONE:
        if (!is_not_negative(s.x) || !is_not_negative(s.z) || !is_positive(s.y) ||
            s.x + s.z <= 0.0f) {
            return error_set(e, ERROR_INPUT,
                             "cone of radii %g and %g m and height %g m; the height and at least "
                             "one radius must be positive, none negative",
                             (double)s.x, (double)s.z, (double)s.y);
        }
        return true;
    case SHAPE_CAPSULE:
        if (!is_positive(s.x) || !is_not_negative(s.y)) {
            return error_set(e, ERROR_INPUT,
                             "capsule of radius %g m and length %g m; the radius must be positive, "
                             "the length not negative",
                             (double)s.x, (double)s.y);
        }
        return true;
    default:
        return true;
    }
}

// The image of a sphere or an ellipsoid under an affine map is an ellipsoid; its frame is that of
// its axes.
static void become_ellipsoid(Primitive *p)
{
    double image[3][4];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            image[i][j] = p->affine[i][j] * (p->kind == SHAPE_SPHERE ? 1.0 : p->raw_size[j]);
        }
        image[i][3] = p->affine[i][3];
    }
    double axes[3][3];
    affine_principal_axes(image, axes, p->size);
    affine_rigid(axes, image, p->forward, p->inverse);
    p->kind = SHAPE_ELLIPSOID;
    p->exact = true;
    p->shrink = 1.0;
}

// Scales of the three axes if the transform is a scaling followed by a rotation; false when it
// shears.
static bool axis_scales(const double m[3][4], double scale[3])
{
    double dot[3] = {0, 0, 0};
    for (int j = 0; j < 3; j++) {
        scale[j] = 0.0;
        for (int i = 0; i < 3; i++) {
            scale[j] += m[i][j] * m[i][j];
            dot[j] += m[i][j] * m[i][(j + 1) % 3];
        }
        scale[j] = sqrt(scale[j]);
    }
    for (int j = 0; j < 3; j++) {
        if (fabs(dot[j]) > 1e-6 * scale[j] * scale[(j + 1) % 3]) {
            return false;
        }
    }
    return true;
}

static bool same(double a, double b)
{
    return fabs(a - b) <= 1e-6 * (fabs(a) + fabs(b));
}

// Folds the scales into the size if the primitive keeps its kind.
static bool fold_scales(Primitive *p)
{
    double scale[3];
    if (!axis_scales(p->affine, scale)) {
        return false;
    }
    bool round = same(scale[0], scale[2]), uniform = round && same(scale[0], scale[1]);
    if ((p->kind == SHAPE_CONE && !round) || (p->kind == SHAPE_CAPSULE && !uniform)) {
        return false;
    }
    double axes[3][3];
    for (int j = 0; j < 3; j++) {
        // a cone's third size is a radius too, so it scales with x
        p->size[j] *= scale[p->kind == SHAPE_CONE && j == 2 ? 0 : j];
        for (int i = 0; i < 3; i++) {
            axes[i][j] = p->affine[i][j] / scale[j];
        }
    }
    affine_rigid(axes, p->affine, p->forward, p->inverse);
    p->exact = true;
    p->shrink = 1.0;
    return true;
}

bool primitive_new(const Shape *shape, Primitive *p, Error *e)
{
    if (!check_size(shape, e)) {
        return false;
    }
    *p = (Primitive){.kind = shape->kind, .exact = false};
    const float size[3] = {shape->size.x, shape->size.y, shape->size.z};
    for (int i = 0; i < 3; i++) {
        p->size[i] = p->raw_size[i] = (double)size[i];
        for (int j = 0; j < 4; j++) {
            p->affine[i][j] = p->forward[i][j] = (double)shape->transform.m[i][j];
        }
    }
    if (!affine_inverse(p->affine, p->inverse)) {
        return error_set(e, ERROR_INPUT,
                         "the transform flattens the shape or is not finite; every scale must be a "
                         "number other than 0");
    }
    if (p->kind == SHAPE_SPHERE || p->kind == SHAPE_ELLIPSOID) {
        become_ellipsoid(p);
    } else if (!fold_scales(p)) {
        double axes[3][3], stretch[3];
        affine_principal_axes(p->affine, axes, stretch);
        p->shrink = fmin(stretch[0], fmin(stretch[1], stretch[2]));
    }
    return true;
}

// Sets c to the surface point nearest to p; returns true when p is inside.
static bool nearest_on_box(const double size[3], const double p[3], double c[3])
{
    bool inside = true;
    int face = 0;
    for (int i = 0; i < 3; i++) {
        c[i] = fmax(-size[i], fmin(size[i], p[i]));
        inside = inside && fabs(p[i]) < size[i];
        if (size[i] - fabs(p[i]) < size[face] - fabs(p[face])) {
            face = i;
        }
    }
    if (inside) {
        c[face] = p[face] < 0.0 ? -size[face] : size[face];
    }
    return inside;
}

// Sets c to the point of the segment a-b nearest to q, in the plane; returns the squared distance.
static double nearest_on_segment(const double a[2], const double b[2], const double q[2],
                                 double c[2])
{
    double d[2] = {b[0] - a[0], b[1] - a[1]}, length2 = d[0] * d[0] + d[1] * d[1];
    double t = length2 > 0.0 ? ((q[0] - a[0]) * d[0] + (q[1] - a[1]) * d[1]) / length2 : 0.0;
    t = fmax(0.0, fmin(1.0, t));
    c[0] = a[0] + t * d[0];
    c[1] = a[1] + t * d[1];
    return (q[0] - c[0]) * (q[0] - c[0]) + (q[1] - c[1]) * (q[1] - c[1]);
}

// Revolves a profile point (radius, y) about the axis into the half plane of p.
static void revolve_point(const double p[3], double radius, const double profile[2], double c[3])
{
    double x = radius > 0.0 ? p[0] / radius : 1.0, z = radius > 0.0 ? p[2] / radius : 0.0;
    c[0] = x * profile[0];
    c[1] = profile[1];
    c[2] = z * profile[0];
}

static bool nearest_on_cone(const double size[3], const double p[3], double c[3])
{
    double q[2] = {sqrt(p[0] * p[0] + p[2] * p[2]), p[1]}, best = INFINITY, nearest[2] = {0, 0};
    const double corner[4][2] = {{0, 0}, {size[0], 0}, {size[2], size[1]}, {0, size[1]}};
    for (int i = 0; i < 3; i++) {
        double candidate[2], d2 = nearest_on_segment(corner[i], corner[i + 1], q, candidate);
        if (d2 < best) {
            best = d2;
            nearest[0] = candidate[0];
            nearest[1] = candidate[1];
        }
    }
    revolve_point(p, q[0], nearest, c);
    return q[1] > 0.0 && q[1] < size[1] && q[0] < size[0] + (size[2] - size[0]) * q[1] / size[1];
}

static bool nearest_on_capsule(const double size[3], const double p[3], double c[3])
{
    double y = fmax(0.0, fmin(size[1], p[1]));
    double d[3] = {p[0], p[1] - y, p[2]};
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double k = length > 0.0 ? size[0] / length : 0.0;
    c[0] = length > 0.0 ? d[0] * k : size[0];
    c[1] = y + d[1] * k;
    c[2] = d[2] * k;
    return length < size[0];
}

// Signed distance in the primitive's own frame, and the nearest surface point.
static double frame_distance(const Primitive *p, const double q[3], double c[3])
{
    bool inside;
    switch (p->kind) {
    case SHAPE_BOX:
        inside = nearest_on_box(p->size, q, c);
        break;
    case SHAPE_CONE:
        inside = nearest_on_cone(p->size, q, c);
        break;
    case SHAPE_CAPSULE:
        inside = nearest_on_capsule(p->size, q, c);
        break;
    case SHAPE_HALF_SPACE:
        c[0] = q[0];
        c[1] = 0.0;
        c[2] = q[2];
        return q[1];
    default:
        inside = ellipsoid_nearest(p->size, q, c);
        break;
    }
    double d[3] = {q[0] - c[0], q[1] - c[1], q[2] - c[2]};
    double distance = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return inside ? -distance : distance;
}

double primitive_distance(const Primitive *p, Vec3 point, double *bound)
{
    double world[3] = {(double)point.x, (double)point.y, (double)point.z}, q[3], c[3];
    affine_point(p->inverse, world, q);
    double distance = frame_distance(p, q, c), lower = fabs(distance) * p->shrink;
    if (!p->exact && lower > 0.0) {
        // first order: divide by the length of the distance's gradient in world space
        double n[3], length2 = 0.0;
        for (int j = 0; j < 3; j++) {
            n[j] = 0.0;
            for (int i = 0; i < 3; i++) {
                n[j] += p->inverse[i][j] * (q[i] - c[i]);
            }
            length2 += n[j] * n[j];
        }
        distance *= fabs(distance) / sqrt(length2);
    }
    if (bound) {
        *bound = lower;
    }
    return distance;
}

bool primitive_contains(const Primitive *p, Vec3 point)
{
    if (p->kind != SHAPE_ELLIPSOID) {
        return primitive_distance(p, point, NULL) < 0.0;
    }
    double world[3] = {(double)point.x, (double)point.y, (double)point.z}, q[3];
    affine_point(p->inverse, world, q);
    return ellipsoid_contains(p->size, q);
}
