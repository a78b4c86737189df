#include "objects/venation/hair.h"

#include "base/random.h"
#include "objects/venation/vein_curves.h"

enum { STREAM_LENGTH = 1, STREAM_BEND_DRAW = 3 }; // of a hair

#define THICKNESS 0.014f // radius at the base, in lengths

void hair_add(CurveSet *hairs, const VenationParams *params, const Transform *place,
              const Hair *hair)
{
    float length = hair->length * random_range(random_key(hair->key, STREAM_LENGTH), 0.5f, 1.2f);
    Vec3 bend = random_direction(random_key(hair->key, STREAM_BEND_DRAW));
    int64_t first = HAIR_POINTS * hairs->curve_count;
    for (int k = 0; k < HAIR_POINTS; k++) {
        float t = (float)k / (HAIR_POINTS - 1);
        Vec3 p = vec3_madd(hair->foot, length * t, vec3_madd(hair->out, 0.45f * t, bend));
        p.z += hair->lift;
        hairs->position[first + k] = transform_point(place, venation_bend(params, p));
        hairs->radius[first + k] = THICKNESS * hair->length * (1.0f - 0.8f * t);
        hairs->birth[first + k] = 1.0f; // the blade is whole by then
        hairs->along[first + k] = (float)k * hair->length / (HAIR_POINTS - 1);
    }
    hairs->id[hairs->curve_count] = hair->key;
    hairs->curve_count++;
    hairs->first[hairs->curve_count] = first + HAIR_POINTS;
}
