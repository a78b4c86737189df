// Racemes that nod: a bending axis, stalks that hang, bracts at their feet.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_POINTS = 10 };                                  // of an axis; + number
enum { STREAM_LEAN = 1, STREAM_LENGTH = 2, STREAM_SIDE = 3 }; // of a bract

// Degrees from +Y at t in 0..1 of the axis: it bends more and more toward its end.
static float bend_at(const OrganParams *p, float t)
{
    return p->arch * t * (0.35f + 0.65f * t);
}

OrganAxis organ_axis(const OrganParams *p, uint64_t seed)
{
    OrganAxis axis;
    Vec3 at = vec3(0, p->spur, 0);
    float step = p->axis / (ORGAN_AXIS_POINTS - 1), uneven = fminf(0.1f * p->arch, 6.0f);
    float share = random_range(random_key(seed, 0), 0.7f, 1.2f), aside = 0.0f, extra = 0.0f;
    for (int i = 0; i < ORGAN_AXIS_POINTS; i++) {
        axis.point[i] = at;
        uint64_t key = random_key(seed, STREAM_POINTS + (uint64_t)i);
        extra = 0.6f * extra + random_range(key, -uneven, uneven);
        aside = 0.8f * aside + random_range(random_key(key, 0), -uneven, uneven);
        float sine, cosine, middle = ((float)i + 0.5f) / (ORGAN_AXIS_POINTS - 1);
        exact_sincos((share * bend_at(p, middle) + extra) * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 along = vec3_normalize(vec3(sine, cosine, aside * RADIANS_PER_DEGREE));
        at = vec3_madd(at, step, along);
    }
    return axis;
}

Transform organ_axis_frame(const OrganAxis *axis, float t)
{
    float at = clampf(t, 0.0f, 1.0f) * (ORGAN_AXIS_POINTS - 1);
    int i = (int)fminf(at, ORGAN_AXIS_POINTS - 2);
    Vec3 a = axis->point[i], b = axis->point[i + 1];
    Vec3 step = vec3_sub(b, a);
    Vec3 y = vec3_dot(step, step) > 0.0f ? vec3_normalize(step) : vec3(0, 1, 0);
    Vec3 x = vec3_normalize(vec3_cross(y, vec3(0, 0, 1))), z = vec3_cross(x, y);
    return transform_from_axes(x, y, z, vec3_lerp(a, b, at - (float)i));
}

void organ_axis_add(OrganBuild *build, const OrganAxis *axis, float radius)
{
    int step = build->params->detail > 0 ? 1 : 4, count = 0;
    Vec3 point[ORGAN_AXIS_POINTS];
    float thick[ORGAN_AXIS_POINTS];
    for (int i = 0; i < ORGAN_AXIS_POINTS; i += step) {
        point[count] = axis->point[i];
        thick[count++] = radius * (1.0f - 0.62f * (float)i / (ORGAN_AXIS_POINTS - 1));
    }
    if (vec3_distance(point[0], point[1]) > 0.0f) {
        quads_tube(&build->tissue[TISSUE_GREEN], point, thick, count,
                   build->params->detail > 1 ? 8 : 4, (Vec2){0.5f, 0.0f});
    }
}

// A frame at p along y.
static Transform frame_along(Vec3 p, Vec3 y)
{
    Vec3 x = vec3_perpendicular(y);
    return transform_from_axes(x, y, vec3_cross(x, y), p);
}

Transform organ_nodding_stalk(OrganBuild *build, const Transform *start, float length, float nod,
                              float radius)
{
    enum { POINTS = 8 };
    Vec3 first = transform_point(start, vec3(0, 0, 0));
    Vec3 out = vec3_normalize(transform_vector(start, vec3(0, 1, 0)));
    Vec3 hang = vec3_normalize(vec3_lerp(out, vec3(0.12f * out.x, -1, 0.12f * out.z), nod));
    Vec3 knee = vec3_madd(first, 0.62f * length, out);
    Vec3 end = vec3_madd(knee, 0.38f * length, hang);
    if (length > 0.0f) {
        int points = build->params->detail > 0 ? POINTS : 3;
        Vec3 axis[POINTS];
        float thick[POINTS];
        for (int i = 0; i < points; i++) {
            float t = (float)i / (float)(points - 1);
            axis[i] = vec3_lerp(vec3_lerp(first, knee, t), vec3_lerp(knee, end, t), t);
            thick[i] = radius * (1.0f + 0.25f * t * t);
        }
        quads_tube(&build->tissue[TISSUE_GREEN], axis, thick, points,
                   build->params->detail > 1 ? 6 : 3, (Vec2){0.5f, 0.0f});
    }
    return frame_along(end, hang);
}

// A narrow bract along +Y of the place, hollow, bent back toward its tip.
static void add_bract(Quads *quads, float length, float back)
{
    enum { ROWS = 7 };
    static const float share[ROWS] = {0.0f, 0.12f, 0.3f, 0.5f, 0.7f, 0.87f, 1.0f};
    static const float wide[ROWS] = {0.7f, 1.0f, 0.95f, 0.76f, 0.5f, 0.25f, 0.03f};
    float at[ROWS], half[ROWS], lift[ROWS];
    for (int r = 0; r < ROWS; r++) {
        at[r] = length * share[r] * (1.0f - 0.15f * back * share[r]);
        half[r] = 0.085f * length * wide[r];
        lift[r] = -0.4f * back * length * share[r] * share[r];
    }
    organ_sheet(quads, at, half, lift, ROWS, 0.45f);
}

void organ_bracts(OrganBuild *build, const Transform *start, float size, uint64_t seed)
{
    const OrganParams *p = build->params;
    Quads *green = &build->tissue[TISSUE_GREEN];
    const Transform *outer = green->place;
    for (int i = 0; i < p->bracts && p->detail > 0; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        // The first is below the stalk, -Z of its frame, and the longest; others stand beside it.
        float side = 360.0f * (float)i / (float)p->bracts - 90.0f;
        side += random_range(random_key(key, STREAM_SIDE), -35.0f, 35.0f);
        float lean = random_range(random_key(key, STREAM_LEAN), 8.0f, 32.0f);
        float length = p->bract_length * lerpf(0.55f, 1.0f, size) / (1.0f + 0.45f * (float)i);
        length *= random_range(random_key(key, STREAM_LENGTH), 0.8f, 1.2f);
        Transform own = organ_frame(vec3(0, 0, 0), lean, side);
        Transform place = transform_multiply(start, &own);
        green->place = &place;
        add_bract(green, length, random_unit(key));
        green->place = outer;
    }
}
