// Below the lip of a fall turbulence tears a jet into clots of drops and air, and they into smaller
// ones (Ervine and Falvey, "Behaviour of Turbulent Water Jets in the Atmosphere and in Plunge
// Pools", Proc. Inst. Civ. Eng. 83, 1987). The air holds back what is torn off: it trails behind
// the dense head as a tail, wider and thinner, so that a clot looks like a comet. Evenly spaced in
// time, clots and tails are drawn out by the speed that they gain.
#include "objects/terrain/white_water.h"

#include "base/noise.h"
#include "base/random.h"

#include <math.h>

enum {
    CLOTS = 30,  // of a strand
    HEADS = 3,   // parcels of a clot: its head and two of its tail ...
    THREADS = 6, // ... and fine threads of drops among them
    PARCELS = HEADS + THREADS
};
enum { NUMBER_AGE, NUMBER_SIZE, NUMBER_LONG, NUMBER_ASIDE, NUMBER_OFF, NUMBERS };
enum { NUMBER_THREAD_ASIDE, NUMBER_THREAD_OFF, NUMBER_THREAD_BEHIND, NUMBER_THREAD_SIZE };

static const float GATHERED = 0.5f;          // share of a clot's water in its head and tail
static const float CLOT[2] = {0.07f, 0.26f}; // m: radius of a head at the lip and at the foot
static const float THREAD = 0.09f;           // m: radius

typedef struct Clot {
    Vec3 center, along; // along: unit, down the path
    float radius, length, weight;
    float way; // m that it is seen to fall
    uint64_t key;
} Clot;

static float number_of(uint64_t key, int number)
{
    return random_unit(random_key(key, (uint64_t)number));
}

static float even(uint64_t key, int number) // -1..1
{
    return 2.0f * number_of(key, number) - 1.0f;
}

float white_water_share(float share)
{
    return smoothstepf(0.01f, 0.2f, share);
}

// What comes over the lip varies: gusts of metres and of decimetres, which part as they fall. Those
// that pass while the shutter is open make one streak.
static float gust(const WhiteWater *fall, const WhiteStrand *strand, float age, float share)
{
    const float passes = 0.12f; // s
    age /= 1.0f + fall->shutter / passes;
    float x = strand->side, apart = smoothstepf(0.0f, 0.5f, share);
    float broad = noise_plane_fractal(0.8f * x, 3.2f * age, 3, random_key(fall->key, 1));
    float fine = noise_plane_fractal(3.1f * x, 11.0f * age, 2, random_key(fall->key, 2));
    float split = noise_plane_fractal(1.7f * x, 0.9f * age, 3, random_key(fall->key, 3));
    float gain = 1.0f + apart * (2.4f * broad + 1.9f * fine) + 1.7f * split;
    return gain > 0.0f ? gain * gain : 0.0f;
}

static Vec3 offset(const WhiteWater *fall, float across, float way)
{
    return vec3_madd(vec3_scale(fall->across, across), way, fall->way);
}

// False: there is none.
static bool clot_of(const WhiteWater *fall, const WhiteStrand *strand, int number, Clot *clot)
{
    uint64_t key =
        random_key(random_key(fall->key, 10 + (uint64_t)strand->number), (uint64_t)number);
    float last = (float)(strand->count - 1);
    float at = last * ((float)number + number_of(key, NUMBER_AGE)) / CLOTS;
    int k = (int)at < strand->count - 2 ? (int)at : strand->count - 2;
    const Vec3 *place = strand->place;
    Vec3 p = vec3_lerp(place[k], place[k + 1], at - (float)k);
    Vec3 moved = vec3_sub(place[k + 1], place[k]);
    float speed = vec3_length(moved) / strand->step;
    float share = (place[0].y - p.y) / fmaxf(place[0].y - place[strand->count - 1].y, 1e-6f);
    float weight = white_water_share(share) * gust(fall, strand, at * strand->step, share);
    if (!(weight > 0.0f && speed > 0.0f)) {
        return false;
    }
    float size = lerpf(0.5f, 1.5f, number_of(key, NUMBER_SIZE));
    float spread = strand->step * last / CLOTS; // s
    float aside = 0.5f * fall->spacing + 0.25f * share;
    *clot = (Clot){.along = vec3_scale(moved, 1.0f / (speed * strand->step)),
                   .radius = size * lerpf(CLOT[0], CLOT[1], share),
                   .length = speed * spread * lerpf(0.5f, 1.4f, number_of(key, NUMBER_LONG)),
                   .way = fminf(speed * fall->shutter, vec3_distance(place[0], p)),
                   .weight = weight * strand->width * spread,
                   .key = key};
    clot->center =
        vec3_add(p, offset(fall, aside * even(key, NUMBER_ASIDE), aside * even(key, NUMBER_OFF)));
    return true;
}

static bool add_clot(const WhiteWater *fall, const Clot *clot, SprayParcels *water, Error *e)
{
    static const float held[HEADS] = {0.45f, 0.33f, 0.22f};
    bool done = true;
    for (int i = 0; done && i < PARCELS; i++) {
        float behind = 0.55f * (float)i, wide = 1.0f + 0.35f * (float)i;
        SprayParcel parcel = {
            .radius = wide * clot->radius,
            .content = GATHERED * clot->weight * (i < HEADS ? held[i] : 0.0f),
            .drawn = vec3_scale(clot->along, 0.4f * wide * clot->length + 0.5f * clot->way)};
        Vec3 off = {0};
        if (i >= HEADS) {
            uint64_t key = random_key(clot->key, NUMBERS + (uint64_t)i);
            behind = lerpf(-0.5f, 1.8f, number_of(key, NUMBER_THREAD_BEHIND));
            float size = lerpf(0.6f, 1.5f, number_of(key, NUMBER_THREAD_SIZE));
            float beside = clot->radius * (1.1f + 0.5f * fmaxf(behind, 0.0f));
            off = offset(fall, beside * even(key, NUMBER_THREAD_ASIDE),
                         beside * even(key, NUMBER_THREAD_OFF));
            parcel.radius = fminf(THREAD, 0.8f * clot->radius) * size;
            parcel.content = (1.0f - GATHERED) * clot->weight / THREADS;
            parcel.drawn = vec3_scale(clot->along, 0.35f * size * clot->length + 0.5f * clot->way);
        }
        parcel.center = vec3_madd(vec3_add(clot->center, off), -behind * clot->length, clot->along);
        done = spray_add(water, parcel, e);
    }
    return done;
}

bool white_water_strand(WhiteWater *fall, const WhiteStrand *strand, SprayParcels *water, Error *e)
{
    // What is seen on a long way needs fewer clots to be whole.
    float spread = strand->step * (float)(strand->count - 1) / CLOTS; // s
    int each = 1 + (int)fminf(0.5f * fall->shutter / fmaxf(spread, 1e-6f), CLOTS / 3.0f);
    bool done = true;
    for (int i = strand->number % each; done && i < CLOTS; i += each) {
        Clot clot;
        if (clot_of(fall, strand, i, &clot)) {
            fall->weights += (double)clot.weight;
            done = add_clot(fall, &clot, water, e);
        }
    }
    float height = fmaxf(strand->place[0].y - strand->place[strand->count - 1].y, 1e-6f);
    for (int k = 0; k + 1 < strand->count; k++) { // seconds for which its water is white
        float share = (strand->place[0].y - strand->place[k].y) / height;
        fall->falling += (double)(strand->width * strand->step * white_water_share(share));
    }
    fall->strands += (double)strand->width;
    return done;
}

void white_water_settle(const WhiteWater *fall, SprayParcels *water)
{
    if (!(fall->weights > 0.0)) {
        return;
    }
    double volume = (double)fall->discharge * fall->falling / fall->strands; // m^3
    float factor = (float)(volume / fall->weights) * spray_of_water();
    for (int64_t i = 0; i < water->count; i++) {
        water->parcel[i].content *= factor;
    }
}
