#include "objects/venation/margin_hairs.h"

#include "base/random.h"
#include "objects/venation/hair.h"

enum { STREAM_HAIRS = 5 };                  // of the outline's key
enum { STREAM_PLACE = 0, STREAM_LEAN = 2 }; // of a hair; others are hair.c's

enum { MOST_HAIRS = 20000 }; // on a side

#define SPACING 0.4f // along the midrib from hair to hair, in their lengths
#define FIRST 0.03f  // shares of the blade's length between which they stand
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

CurveSet *margin_hairs(const VenationParams *params, const Relief *relief, const Transform *place,
                       Error *e)
{
    int count = count_of(params);
    CurveSet *hairs = curves_new(2 * (int64_t)count * HAIR_POINTS, 2 * (int64_t)count, e);
    if (hairs) {
        hairs->curve_count = 0;
    }
    for (int i = 0; hairs && i < 2 * count; i++) {
        float side = i < count ? -1.0f : 1.0f;
        uint64_t key = random_key(random_key(params->outline.key, STREAM_HAIRS), (uint64_t)i);
        Vec3 foot = foot_of(params, side, i % count, key);
        if (blade_wear_depth(&relief->wear, foot) > 0.0f) {
            continue;
        }
        Hair hair = {foot, out_of(params, side, foot, key), relief_at(relief, foot), params->hairs,
                     key};
        hair_add(hairs, params, place, &hair);
    }
    if (hairs) {
        hairs->point_count = HAIR_POINTS * hairs->curve_count;
    }
    return hairs;
}
