#include "shape/body.h"

#include "shape/affine.h"
#include "shape/blend.h"

#include <math.h>

// A round cone between two spheres, flattened front to back, blended with all parts before it.
typedef struct BodyPart {
    double a[3], radius_a, b[3], radius_b;
    double depth; // ratio of depth (front to back) to width
    double blend; // width of the smooth blend with the parts before it
} BodyPart;

// For a height of 1 and x >= 0; the other side is its mirror image. Proportions follow the artists'
// canon of seven and a half heads.
static const BodyPart PARTS[] = {
    // trunk
    {{0, 0.655, 0.002}, 0.079, {0, 0.752, -0.004}, 0.093, 0.70, 0.000},
    {{0, 0.610, 0.003}, 0.067, {0, 0.665, 0.003}, 0.078, 0.72, 0.040},
    {{0, 0.530, 0.000}, 0.081, {0, 0.590, 0.002}, 0.070, 0.74, 0.050},
    {{0, 0.792, -0.010}, 0.046, {0.088, 0.797, -0.012}, 0.036, 0.95, 0.040},
    {{0, 0.862, -0.016}, 0.026, {0.062, 0.816, -0.016}, 0.024, 1.0, 0.030},
    {{0.022, 0.728, 0.036}, 0.028, {0.062, 0.745, 0.024}, 0.032, 0.75, 0.025},
    {{0.048, 0.695, -0.034}, 0.034, {0.062, 0.745, -0.032}, 0.036, 0.75, 0.030},
    {{0.040, 0.508, -0.030}, 0.044, {0.052, 0.520, -0.022}, 0.040, 1.0, 0.025},
    // neck and head
    {{0, 0.812, -0.012}, 0.036, {0, 0.885, 0.004}, 0.032, 1.0, 0.020},
    {{0, 0.948, -0.016}, 0.050, {0, 0.944, 0.008}, 0.047, 1.0, 0.014},
    {{0, 0.912, 0.012}, 0.036, {0, 0.886, 0.030}, 0.019, 1.0, 0.022},
    {{0.020, 0.916, 0.026}, 0.021, {0.012, 0.898, 0.034}, 0.016, 1.0, 0.016},
    {{0, 0.936, 0.051}, 0.005, {0, 0.917, 0.058}, 0.0070, 1.0, 0.012},
    {{0.0485, 0.934, -0.004}, 0.0095, {0.0465, 0.914, 0.000}, 0.0065, 0.8, 0.005},
    // arm
    {{0.106, 0.793, -0.010}, 0.041, {0.122, 0.752, -0.008}, 0.034, 1.0, 0.030},
    {{0.118, 0.765, -0.008}, 0.034, {0.168, 0.642, -0.008}, 0.0255, 1.0, 0.020},
    {{0.136, 0.722, 0.002}, 0.027, {0.152, 0.682, 0.002}, 0.024, 1.0, 0.016},
    {{0.168, 0.644, -0.008}, 0.0255, {0.184, 0.598, -0.002}, 0.0265, 1.0, 0.030},
    {{0.184, 0.600, -0.002}, 0.0262, {0.214, 0.512, 0.004}, 0.0175, 0.95, 0.024},
    // hand: palm, ball of the thumb, thumb, fingers
    {{0.216, 0.508, 0.004}, 0.0170, {0.231, 0.462, 0.010}, 0.0220, 0.58, 0.012},
    {{0.224, 0.490, 0.008}, 0.0110, {0.243, 0.470, 0.015}, 0.0090, 1.0, 0.010},
    {{0.243, 0.470, 0.015}, 0.0085, {0.256, 0.442, 0.020}, 0.0065, 1.0, 0.004},
    {{0.247, 0.452, 0.011}, 0.0068, {0.262, 0.410, 0.017}, 0.0054, 1.0, 0.004},
    {{0.238, 0.447, 0.012}, 0.0070, {0.252, 0.399, 0.019}, 0.0055, 1.0, 0.004},
    {{0.228, 0.445, 0.012}, 0.0068, {0.239, 0.398, 0.019}, 0.0054, 1.0, 0.004},
    {{0.218, 0.447, 0.011}, 0.0062, {0.225, 0.407, 0.017}, 0.0050, 1.0, 0.004},
    // leg
    {{0.050, 0.500, 0.000}, 0.058, {0.057, 0.440, 0.002}, 0.0525, 1.0, 0.030},
    {{0.057, 0.442, 0.002}, 0.0520, {0.061, 0.292, 0.000}, 0.0330, 1.0, 0.040},
    {{0.064, 0.410, 0.016}, 0.041, {0.064, 0.330, 0.012}, 0.034, 1.0, 0.020},
    {{0.061, 0.290, 0.005}, 0.0315, {0.061, 0.262, 0.004}, 0.0305, 1.0, 0.030},
    {{0.061, 0.275, -0.004}, 0.0310, {0.062, 0.215, -0.012}, 0.0355, 1.0, 0.030},
    {{0.062, 0.215, -0.012}, 0.0355, {0.063, 0.060, -0.014}, 0.0195, 1.0, 0.016},
    // foot
    {{0.063, 0.060, -0.012}, 0.0195, {0.063, 0.024, -0.024}, 0.0220, 1.0, 0.014},
    {{0.064, 0.046, 0.000}, 0.0200, {0.072, 0.018, 0.056}, 0.0150, 1.0, 0.018},
    {{0.063, 0.022, -0.020}, 0.0200, {0.080, 0.014, 0.050}, 0.0140, 1.0, 0.014},
    {{0.063, 0.012, 0.058}, 0.0110, {0.064, 0.010, 0.088}, 0.0090, 1.0, 0.008},
    {{0.075, 0.011, 0.060}, 0.0085, {0.077, 0.008, 0.086}, 0.0068, 1.0, 0.004},
    {{0.085, 0.010, 0.056}, 0.0080, {0.088, 0.008, 0.078}, 0.0065, 1.0, 0.004},
    {{0.093, 0.010, 0.050}, 0.0078, {0.097, 0.007, 0.069}, 0.0060, 1.0, 0.004},
};

enum { PART_COUNT = sizeof PARTS / sizeof PARTS[0] };

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Distance to the convex hull of two spheres, found on its profile in a plane through the axis.
// axis: vector between the centres; q: the point relative to the first centre.
static double round_cone_distance(const double q[3], const double axis[3], double ra, double rb)
{
    double length2 = dot3(axis, axis), length = sqrt(length2);
    double y = dot3(q, axis) / length;
    double x2 = dot3(q, q) - y * y, x = sqrt(x2 > 0.0 ? x2 : 0.0);
    double slope = (ra - rb) / length, rise = sqrt(1.0 - slope * slope);
    double along = y * rise - x * slope; // along the flank, from the first sphere's tangent circle
    if (along <= 0.0) {
        return sqrt(x * x + y * y) - ra;
    }
    if (along >= length * rise) {
        return sqrt(x * x + (y - length) * (y - length)) - rb;
    }
    return x * rise + y * slope - ra;
}

static double part_distance(const BodyPart *part, const double p[3])
{
    double middle = 0.5 * (part->a[2] + part->b[2]), squeeze = 1.0 / part->depth;
    double q[3] = {p[0] - part->a[0], p[1] - part->a[1],
                   (p[2] - middle) * squeeze - (part->a[2] - middle)};
    double axis[3] = {part->b[0] - part->a[0], part->b[1] - part->a[1], part->b[2] - part->a[2]};
    return part->depth * round_cone_distance(q, axis, part->radius_a, part->radius_b);
}

bool body_new(const Shape *shape, Body *body, Error *e)
{
    float height = shape->size.x;
    if (!(height > 0.0f) || !isfinite(height)) {
        return error_set(e, ERROR_INPUT, "a body %g m tall; its height must be positive",
                         (double)height);
    }
    double forward[3][4];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            forward[i][j] = (double)shape->transform.m[i][j] * (j < 3 ? (double)height : 1.0);
        }
    }
    if (!affine_inverse(forward, body->inverse)) {
        return error_set(e, ERROR_INPUT,
                         "the transform flattens the body or is not finite; every scale must be a "
                         "number other than 0");
    }
    double axes[3][3], stretch[3];
    affine_principal_axes(forward, axes, stretch);
    body->shrink = fmin(stretch[0], fmin(stretch[1], stretch[2]));
    Aabb unit = {vec3(-0.28f, -0.01f, -0.11f), vec3(0.28f, 1.01f, 0.12f)};
    unit.low = vec3_scale(unit.low, height);
    unit.high = vec3_scale(unit.high, height);
    body->bounds = aabb_transform(unit, &shape->transform);
    return true;
}

double body_distance(const Body *body, Vec3 point, double *bound)
{
    double world[3] = {(double)point.x, (double)point.y, (double)point.z}, p[3];
    affine_point(body->inverse, world, p);
    p[0] = fabs(p[0]);
    double distance = part_distance(&PARTS[0], p);
    for (int i = 1; i < PART_COUNT; i++) {
        distance = blend_distance(distance, part_distance(&PARTS[i], p), PARTS[i].blend);
    }
    distance *= body->shrink;
    if (bound) {
        *bound = fabs(distance);
    }
    return distance;
}
