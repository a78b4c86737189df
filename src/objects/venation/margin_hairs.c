#include "objects/venation/margin_hairs.h"

#include "base/random.h"
#include "objects/venation/vein_curves.h"

enum { STREAM_HAIRS = 5 };                                               // of the outline's key
enum { STREAM_PLACE, STREAM_LENGTH, STREAM_LEAN, STREAM_BEND_DRAW = 3 }; // of a hair

enum { POINTS = 4, MOST_HAIRS = 20000 }; // of a hair; on a side

#define SPACING 0.4f     // along the midrib from hair to hair, in their lengths
#define THICKNESS 0.014f // radius at the base, in lengths
#define FIRST 0.03f      // shares of the blade's length between which they stand
#define LAST 0.985f

// Hairs on each side.
static int count_of(const VenationParams *params)
{
    float count = (LAST - FIRST) * params->outline.length / (SPACING * params->hairs);
    return (int)clampf(count, 1.0f, (float)MOST_HAIRS);
}

// Where on the flat leaf hair number `i` of a side stands.
static Vec3 foot_of(const VenationParams *params, float side, int i, uint64_t key)
{
    float at = ((float)i + random_unit(random_key(key, STREAM_PLACE))) / (float)count_of(params);
    float y = params->outline.length * lerpf(FIRST, LAST, at);
    return vec3(side * leaf_margin(&params->outline, side, y), y, 0);
}

// The direction in which a hair leaves the flat margin: square to the smooth outline, so that it
// does not follow every notch, and toward the tip.
static Vec3 out_of(const VenationParams *params, float side, Vec3 foot, uint64_t key)
{
    const float step = 0.02f * params->outline.length;
    float slope = (leaf_half_width(&params->outline, foot.y + step) -
                   leaf_half_width(&params->outline, foot.y - step)) /
                  (2.0f * step);
    Vec3 out = vec3_normalize(vec3(side, -slope, 0));
    Vec3 along = vec3(-side * out.y, side * out.x, 0);
    float lean = random_range(random_key(key, STREAM_LEAN), 0.0f, 1.1f);
    return vec3_normalize(vec3_madd(out, lean, along));
}

// Writes the points of a hair, bent with the leaf.
static void write_hair(const VenationParams *params, const Relief *relief, const Transform *place,
                       float side, Vec3 foot, uint64_t key, Vec3 *position, float *radius)
{
    float length = params->hairs * random_range(random_key(key, STREAM_LENGTH), 0.5f, 1.2f);
    Vec3 out = out_of(params, side, foot, key);
    Vec3 bend = random_direction(random_key(key, STREAM_BEND_DRAW));
    float lift = relief_at(relief, foot);
    for (int k = 0; k < POINTS; k++) {
        float t = (float)k / (POINTS - 1);
        Vec3 p = vec3_madd(foot, length * t, vec3_madd(out, 0.45f * t, bend));
        p.z += lift;
        position[k] = transform_point(place, venation_bend(params, p));
        radius[k] = THICKNESS * params->hairs * (1.0f - 0.8f * t);
    }
}

CurveSet *margin_hairs(const VenationParams *params, const Relief *relief, const Transform *place,
                       Error *e)
{
    int count = count_of(params);
    CurveSet *hairs = curves_new(2 * (int64_t)count * POINTS, 2 * (int64_t)count, e);
    int64_t curve = 0;
    for (int i = 0; hairs && i < 2 * count; i++) {
        float side = i < count ? -1.0f : 1.0f;
        uint64_t key = random_key(random_key(params->outline.key, STREAM_HAIRS), (uint64_t)i);
        Vec3 foot = foot_of(params, side, i % count, key);
        if (blade_wear_depth(&relief->wear, foot) > 0.0f) {
            continue;
        }
        int64_t point = POINTS * curve;
        write_hair(params, relief, place, side, foot, key, hairs->position + point,
                   hairs->radius + point);
        for (int k = 0; k < POINTS; k++) {
            hairs->birth[point + k] = 1.0f; // the blade is whole by then
            hairs->along[point + k] = (float)k * params->hairs / (POINTS - 1);
        }
        hairs->id[curve] = key;
        curve++;
        hairs->first[curve] = point + POINTS;
    }
    if (hairs) {
        hairs->curve_count = curve;
        hairs->point_count = POINTS * curve;
    }
    return hairs;
}
