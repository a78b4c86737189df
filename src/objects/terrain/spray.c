// What a waterfall throws up. Falling water drags air down with it; at the foot this air escapes
// sideways and up with the drops that the impact tears off, in puffs that widen, slow down and rain
// out. Fine drops come off the strands on their way down too, the more the farther they have
// fallen.
#include "objects/terrain/spray.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <math.h>

#define GRAVITY 9.81f

enum { FROM_FOOT = 6, FROM_VEIL = 3 }; // parcels a strand
enum { NUMBER_AGE, NUMBER_TURN, NUMBER_RISE, NUMBER_SIZE, NUMBER_SHARE, NUMBER_ASIDE, NUMBERS };

static const float PART_OF_SPEED = 0.4f; // of the water's at the foot: the air's that escapes
static const float LASTS = 4.0f;         // s in which 1 - 1/e of the drops rain out
static const float OLDEST = 12.0f;       // s
static const float SETTLES = 0.35f;      // m/s
static const float WIDE = 0.04f;         // of the height: mean radius of a puff at the foot
static const float VEIL = 0.3f;          // density of the spray about the strands at the foot

static float number_of(const FallSpray *fall, int parcel, int number)
{
    return random_unit(random_key(fall->key, (uint64_t)parcel * NUMBERS + (uint64_t)number));
}

static float foot_speed(const FallSpray *fall)
{
    return PART_OF_SPEED * sqrtf(2.0f * GRAVITY * fall->height);
}

static float left_after(float seconds)
{
    return (float)exact_exp((double)(-seconds / LASTS));
}

float terrain_fall_content(const FallSpray *fall)
{
    float face = 2.0f * fall->half * 2.0f * WIDE * fall->height * fall->cover;
    return face * foot_speed(fall) * LASTS * (1.0f - left_after(OLDEST));
}

// A puff of a random age whose drops came from the foot of a strand. All of them together hold what
// leaves the foot in OLDEST seconds, less what has rained out.
static SprayParcel foot_puff(const FallSpray *fall, Vec3 foot, int parcel)
{
    float age = OLDEST * number_of(fall, parcel, NUMBER_AGE);
    float size = lerpf(0.5f, 1.7f, number_of(fall, parcel, NUMBER_SIZE));
    float rise = lerpf(0.05f, 0.95f, number_of(fall, parcel, NUMBER_RISE));
    float turn = 1.4f * (2.0f * number_of(fall, parcel, NUMBER_TURN) - 1.0f), sine, cosine;
    exact_sincos(turn, &sine, &cosine);
    float level = sqrtf(1.0f - rise * rise), start = size * WIDE * fall->height;
    float way = spray_puff_way(start, foot_speed(fall), age);
    SprayParcel puff = {.center = vec3_madd(foot, way * level * cosine, fall->way),
                        .radius = spray_puff_radius(start, way)};
    puff.center = vec3_madd(puff.center, way * level * sine, fall->across);
    float low = foot.y + 0.3f * puff.radius;
    puff.center.y += way * rise - SETTLES * age;
    puff.center.y = fmaxf(puff.center.y, low);
    float face = 4.0f * fall->half * WIDE * fall->height * fall->cover;
    float share = OLDEST / (float)(FROM_FOOT * fall->strands);
    puff.content = face * foot_speed(fall) * share * left_after(age);
    return puff;
}

// Spray about a strand, evenly spread over the time of its fall.
static SprayParcel veil_puff(const FallSpray *fall, const Vec3 *place, int count, int parcel)
{
    float share = number_of(fall, parcel, NUMBER_SHARE), at = share * (float)(count - 1);
    int k = (int)at < count - 2 ? (int)at : count - 2;
    float size = lerpf(0.6f, 1.4f, number_of(fall, parcel, NUMBER_SIZE));
    SprayParcel puff = {.center = vec3_lerp(place[k], place[k + 1], at - (float)k),
                        .radius = size * WIDE * fall->height * (0.3f + 0.9f * share)};
    float aside = 2.0f * number_of(fall, parcel, NUMBER_ASIDE) - 1.0f;
    puff.center = vec3_madd(puff.center, aside * puff.radius, fall->way);
    float sheet = 2.0f * fall->half * fall->height * 2.0f * WIDE * fall->height * fall->cover;
    puff.content = VEIL * share * share * sheet / (float)(FROM_VEIL * fall->strands);
    return puff;
}

bool terrain_spray_strand(const FallSpray *fall, int strand, const Vec3 *place, int count,
                          SprayParcels *spray, Error *e)
{
    const int each = FROM_FOOT + FROM_VEIL;
    bool done = true;
    for (int i = 0; done && i < each; i++) {
        int parcel = strand * each + i;
        done = spray_add(spray,
                         i < FROM_FOOT ? foot_puff(fall, place[count - 1], parcel)
                                       : veil_puff(fall, place, count, parcel),
                         e);
    }
    return done;
}
