#include "objects/common/hoar.h"

#include "base/random.h"
#include "objects/common/hoar_tufts.h"

#include <math.h>

enum { STREAM_SIDE, STREAM_SIZE, STREAM_SHAPE, STREAM_GAP, STREAM_TURN, STREAM_KEPT }; // of a place

typedef struct Hoar {
    const HoarParams *params;
    Vec3 against; // the wind
    float step;   // m between tufts along thin twigs
    uint64_t seed;
    HoarTufts tufts;
} Hoar;

// The side of a twig on which a tuft grows: any, turned against the wind.
static Vec3 side_of(const Hoar *hoar, Vec3 along, uint64_t key)
{
    Vec3 d = random_direction(random_key(key, STREAM_SIDE));
    d = vec3_lerp(d, hoar->against, hoar->params->bias);
    d = vec3_madd(d, -0.8f * vec3_dot(d, along), along);
    float length = vec3_length(d);
    return length > 1e-4f ? vec3_scale(d, 1.0f / length) : vec3_perpendicular(along);
}

static bool add_tuft(Hoar *hoar, Vec3 p, float radius, Vec3 along, uint64_t key, Error *e)
{
    const HoarParams *params = hoar->params;
    Vec3 y = side_of(hoar, along, key);
    float thin = params->thickest / (params->thickest + radius);
    float size = params->length * thin * hoar_size_share(params, p, random_key(key, STREAM_SIZE));
    float share = sqrtf(hoar_sky_share(params, y.y, 1.0f)); // 1 unless frost grows by radiation
    if (size == 0.0f || random_unit(random_key(key, STREAM_KEPT)) >= share) {
        return true;
    }
    Vec3 turned = vec3_lerp(along, vec3_cross(along, y),
                            random_range(random_key(key, STREAM_TURN), -1.0f, 1.0f));
    return hoar_tufts_add(&hoar->tufts, vec3_madd(p, 0.85f * radius, y), turned, y, share * size,
                          random_key(key, STREAM_SHAPE), e);
}

// Thicker branches carry more tufts side by side.
static float step_at(const Hoar *hoar, float radius)
{
    return hoar->step / (1.0f + 1.5f * radius / hoar->params->length);
}

static bool add_on_curve(Hoar *hoar, const CurveSet *curves, int64_t c, Error *e)
{
    uint64_t key = random_key(hoar->seed, curves->id[c]), number = 0;
    float left = hoar->step * random_unit(random_key(key, STREAM_GAP));
    bool done = true;
    for (int64_t i = curves->first[c]; done && i + 1 < curves->first[c + 1]; i++) {
        Vec3 a = curves->position[i], b = curves->position[i + 1];
        float length = vec3_distance(a, b);
        if (!(length > 0.0f)) {
            continue;
        }
        Vec3 along = vec3_scale(vec3_sub(b, a), 1.0f / length);
        while (done && left < length) {
            float t = left / length, radius = lerpf(curves->radius[i], curves->radius[i + 1], t);
            done = add_tuft(hoar, vec3_lerp(a, b, t), radius, along, random_key(key, 16 + number++),
                            e);
            left += step_at(hoar, radius);
        }
        left -= length;
    }
    return done;
}

static double count_on(const Hoar *hoar, const CurveSet *curves)
{
    double sum = 0.0;
    for (int64_t c = 0; c < curves->curve_count; c++) {
        for (int64_t i = curves->first[c]; i + 1 < curves->first[c + 1]; i++) {
            sum += (double)(vec3_distance(curves->position[i], curves->position[i + 1]) /
                            step_at(hoar, curves->radius[i]));
        }
    }
    return sum;
}

static bool place_all(Hoar *hoar, const CurveSet *curves, const Run *run, Error *e)
{
    hoar->step = HOAR_SPACING * hoar->params->length / hoar->params->density;
    double count = count_on(hoar, curves), most = (double)hoar->params->max_count;
    if (count > most) {
        run_warn(run, "hoar frost of %.0f tufts is thinned out to hoar.max_count, %.0f", count,
                 most);
        hoar->step *= (float)(count / most);
    }
    bool done = true;
    for (int64_t c = 0; done && c < curves->curve_count; c++) {
        done = run_goes_on(run, c, e) && add_on_curve(hoar, curves, c, e);
    }
    return done;
}

static Hoar hoar_of(const HoarParams *params, uint64_t seed)
{
    return (Hoar){.params = params, .against = hoar_against(params), .seed = seed};
}

bool hoar_add(const OutTree *tree, const SkinningParams *skinning, const HoarParams *params,
              const Placing *placing, int role, Error *e)
{
    if (params->length <= 0.0f || params->density <= 0.0f) {
        return true;
    }
    const float every_radius = 1e6f;
    Hoar hoar = hoar_of(params, random_key(placing->recipe->seed, 0x40a7));
    SkinParams skin = branches_skin(skinning);
    CurveSet *curves = skin_curves(tree, every_radius, &skin, e);
    bool done = curves && place_all(&hoar, curves, placing->recipe->run, e);
    curves_free(curves);
    if (!done) {
        hoar_tufts_clear(&hoar.tufts);
        return false;
    }
    return hoar_tufts_place(&hoar.tufts, params->habit, hoar.seed, placing, role, e);
}
