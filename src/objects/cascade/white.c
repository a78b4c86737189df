// What a long exposure shows of a strand: a thin trail of white water along its way, as dense as
// the water is slow, and the mist that it throws up where it meets rock or pool.
#include "base/random.h"
#include "objects/cascade/cascade.h"

#include <math.h>

enum { STREAM_DEPTH = 101, STREAM_MIST };

// m^3/s that a strand brings.
static float flux_of(const CascadeParams *params, uint64_t seed, int strand)
{
    return params->discharge * cascade_share(params, seed, strand) / (float)params->strands;
}

// A jet takes bubbles down into the pool; they rise where it ends, and their foam spreads.
static Vec3 lowered(const CascadePlace *place, float since, uint64_t key)
{
    Vec3 p = place->at;
    if (place->afloat) {
        float left = 1.0f / (1.0f + 4.0f * since);
        p.y += 0.03f * left * random_unit(key);
    }
    return p;
}

// The share of a strand's bubbles that lie at the surface: most of those in the pool are below it.
static float shown(const CascadePlace *place, float since)
{
    return place->afloat ? lerpf(0.5f, 0.04f, fminf(2.5f * since, 1.0f)) : 1.0f;
}

static bool add_trail(const CascadeParams *params, uint64_t seed, int strand,
                      const CascadePlace *place, int count, SprayParcels *white, Error *e)
{
    float flux = flux_of(params, seed, strand) * spray_of_water(), held = 0.0f, way = 0.0f;
    float since = 0.0f; // s afloat
    uint64_t key = random_key(random_key(seed, STREAM_DEPTH), (uint64_t)strand);
    int first = 0;
    for (int i = 0; i + 1 < count && flux > 0.0f; i++) {
        float radius =
            0.5f * params->width * (place[i].afloat ? 1.0f + 9.0f * fminf(since, 1.0f) : 1.0f);
        held += place[i].white * place[i].seconds * shown(&place[i], since);
        way += vec3_distance(place[i].at, place[i + 1].at);
        since += place[i].afloat ? place[i].seconds : 0.0f;
        if (way < 1.6f * radius && i + 2 < count && place[i].afloat == place[i + 1].afloat) {
            continue;
        }
        Vec3 a = lowered(&place[first], since, key), b = lowered(&place[i + 1], since, key);
        SprayParcel parcel = {.center = vec3_lerp(a, b, 0.5f),
                              .radius = radius,
                              .content = flux * held,
                              .drawn = vec3_scale(vec3_sub(b, a), 0.75f)};
        if (parcel.content > 0.0f && !spray_add(white, parcel, e)) {
            return false;
        }
        held = way = 0.0f;
        first = i + 1;
    }
    return true;
}

// Puffs where the strand loses much of its speed at once.
static bool add_mist(const CascadeParams *params, uint64_t seed, int strand,
                     const CascadePlace *place, int count, SprayParcels *mist, Error *e)
{
    const float thrown = 0.55f; // m^3 of the densest mist a m^3/s that meets at 1 m/s
    uint64_t key = random_key(random_key(seed, STREAM_MIST), (uint64_t)strand);
    Vec3 heading = cascade_heading(params);
    for (int i = 0; i + 1 < count; i++) {
        float lost = vec3_length(place[i].velocity) - vec3_length(place[i + 1].velocity);
        if (lost < 0.6f) {
            continue;
        }
        uint64_t own = random_key(key, (uint64_t)i);
        float rise = random_unit(random_key(own, 1)),
              size = random_range(random_key(own, 2), 0.05f, 0.11f);
        Vec3 at = vec3_madd(place[i].at, 0.5f * rise * random_unit(random_key(own, 3)), heading);
        at = vec3_madd(at, 0.1f * rise, random_direction(random_key(own, 4)));
        at.y = fmaxf(at.y, place[i].at.y) + 0.35f * rise * rise;
        SprayParcel puff = {.center = at,
                            .radius = size + 0.22f * rise,
                            .content = thrown * lost * flux_of(params, seed, strand)};
        if (puff.content > 0.0f && !spray_add(mist, puff, e)) {
            return false;
        }
    }
    return true;
}

bool cascade_whiten(const CascadeParams *params, uint64_t seed, int strand,
                    const CascadePlace *place, int count, const CascadeWater *water, Error *e)
{
    return (!water->white || add_trail(params, seed, strand, place, count, water->white, e)) &&
           (!water->mist || add_mist(params, seed, strand, place, count, water->mist, e));
}
