#include "shape/mean_value.h"

#include "base/exact_math.h"

#include <math.h>

#define NEAR 1e-9 // of a vertex or of a face's plane, relative to the distances
#define PI_D 3.14159265358979323846

typedef struct Sum {
    double weight, at[3];
} Sum;

// One triangle seen from the point.
typedef struct View {
    double unit[3][3]; // to its corners
    double distance[3];
    double angle[3], sine[3]; // between the directions to the other two corners
} View;

// 2 asin(half): a float's angle and one Newton step, which doubles its digits.
static double angle_of_half_chord(double half)
{
    half = half < 1.0 ? half : 1.0;
    double across = sqrt(1.0 - half * half), s, c;
    double guess = (double)exact_atan2((float)half, (float)across);
    exact_sincos_double(guess, &s, &c);
    return 2.0 * (guess + (half * c - across * s));
}

static void add(Sum *sum, double weight, Vec3 at)
{
    sum->weight += weight;
    sum->at[0] += weight * (double)at.x;
    sum->at[1] += weight * (double)at.y;
    sum->at[2] += weight * (double)at.z;
}

static double determinant(const double u[3][3])
{
    return u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
           u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
           u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
}

// False if p is at a corner, which *corner then is.
static bool look(const Mesh *rest, const uint32_t *index, Vec3 p, View *view, int *corner)
{
    for (int i = 0; i < 3; i++) {
        Vec3 at = rest->position[index[i]];
        double way[3] = {(double)at.x - (double)p.x, (double)at.y - (double)p.y,
                         (double)at.z - (double)p.z};
        double distance = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        view->distance[i] = distance;
        if (!(distance > 0.0)) {
            *corner = i;
            return false;
        }
        for (int k = 0; k < 3; k++) {
            view->unit[i][k] = way[k] / distance;
        }
    }
    for (int i = 0; i < 3; i++) {
        const double *a = view->unit[(i + 1) % 3], *b = view->unit[(i + 2) % 3];
        double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, cosine;
        view->angle[i] = angle_of_half_chord(0.5 * sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
        exact_sincos_double(view->angle[i], &view->sine[i], &cosine);
    }
    return true;
}

// The face's share; true if p lies on the face, whose corners then are all that counts.
static bool add_face(const View *view, const uint32_t *index, const Mesh *posed, Sum *sum)
{
    const double *t = view->angle, *d = view->distance, *sine = view->sine;
    double half = 0.5 * (t[0] + t[1] + t[2]), c[3], s[3], sin_half, unused;
    if (PI_D - half < NEAR) {
        *sum = (Sum){0};
        for (int i = 0; i < 3; i++) {
            add(sum, sine[i] * d[(i + 1) % 3] * d[(i + 2) % 3], posed->position[index[i]]);
        }
        return true;
    }
    exact_sincos_double(half, &sin_half, &unused);
    double side = determinant(view->unit) < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        double rest;
        exact_sincos_double(half - t[i], &rest, &unused);
        c[i] = 2.0 * sin_half * rest / (sine[(i + 1) % 3] * sine[(i + 2) % 3]) - 1.0;
        s[i] = side * sqrt(c[i] < 1.0 && c[i] > -1.0 ? 1.0 - c[i] * c[i] : 0.0);
        if (!(fabs(s[i]) > NEAR)) { // p is in the face's plane, outside it
            return false;
        }
    }
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3, last = (i + 2) % 3;
        double weight =
            (t[i] - c[next] * t[last] - c[last] * t[next]) / (d[i] * sine[next] * s[last]);
        add(sum, weight, posed->position[index[i]]);
    }
    return false;
}

Vec3 mean_value_carry(const Mesh *rest, const Mesh *posed, Vec3 p)
{
    Sum sum = {0};
    for (int64_t f = 0; f < rest->face_count; f++) {
        const uint32_t *index = rest->index + 3 * f;
        View view;
        int corner = 0;
        if (!look(rest, index, p, &view, &corner)) {
            return posed->position[index[corner]];
        }
        if (add_face(&view, index, posed, &sum)) {
            break;
        }
    }
    double w = sum.weight != 0.0 ? 1.0 / sum.weight : 0.0;
    return vec3((float)(sum.at[0] * w), (float)(sum.at[1] * w), (float)(sum.at[2] * w));
}
