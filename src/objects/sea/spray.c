// What surf throws up where it meets steep land. Each crest that arrives squeezes water up the rock
// in jets several times as high as the wave, which part into drops and fall back; fine ones hang in
// the air until they have drifted off. At the edge of a platform or a reef, where the bed rises as
// steeply but land begins farther on, the part of the wave that its shallow water cannot carry on
// is thrown up; the rest runs on over it.
//
// Jets: their speed is a few times that of the wave at the foot, sqrt(g H), and differs from gully
// to gully and from crest to crest (Peregrine, "Water-Wave Impact on Walls", Annu. Rev. Fluid Mech.
// 35, 2003).
#include "objects/sea/spray.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>

#define TURN 6.28318530717958647692

enum { STREAM_SPRAY = 77 };
enum { JETS = 10, MIST = 3 }; // parcels a sample of the shore
enum { NUMBER_DELAY, NUMBER_SPEED, NUMBER_ASIDE, NUMBER_LEAN, NUMBER_PLACE, NUMBERS };

static const float CLIFF = 1.2f;   // m: least height of steep land within two samples
static const float EDGE = 1.2f;    // m: least step of the bed within five samples, and
static const float CARRIES = 0.6f; // share of its depth that the water behind carries on of a wave
static const float UP = 0.6f;      // share of the rest that is thrown up
static const float LEAST = 0.35f;  // m: wave height at the foot that splashes at all
static const float FASTEST = 3.4f; // times sqrt(g H)
static const float ROW = 14.0f;    // m: size of stretches of the shore that a crest hits alike
static const float LINGERS = 6.0f; // s in which 1 - 1/e of the mist is gone

typedef struct Surf {
    const WavesShore *shore;
    Vec2 way;
    float length, period; // m, s: of the waves of the peak in deep water
    float height;         // m: significant, of the open sea
    float level;          // m
    float time;           // s
    uint64_t key;
} Surf;

static float depth_at(const Surf *s, int column, int row)
{
    const WavesShore *shore = s->shore;
    column = column < 0 ? 0 : (column < shore->columns ? column : shore->columns - 1);
    row = row < 0 ? 0 : (row < shore->rows ? row : shore->rows - 1);
    return shore->depth[(int64_t)row * shore->columns + column];
}

// Unit, in plan: from the land to the water; false where no steep land is near that waves run into.
static bool find_wall(const Surf *s, int column, int row, Vec2 *off)
{
    float x = depth_at(s, column + 2, row) - depth_at(s, column - 2, row);
    float z = depth_at(s, column, row + 2) - depth_at(s, column, row - 2);
    float length = sqrtf(x * x + z * z), highest = INFINITY;
    for (int k = -2; k <= 2; k++) {
        highest = fminf(highest, fminf(depth_at(s, column + k, row), depth_at(s, column, row + k)));
    }
    *off = (Vec2){x / length, z / length};
    return highest < -CLIFF && length > 0.0f && off->x * s->way.x + off->y * s->way.y < -0.15f;
}

// The share of waves of this height that the edge of a platform throws up; 0 where there is none.
// It is at the last sample seaward of the middle of a step of the bed. off: unit, in plan, from the
// land to the water.
static float edge_share(const Surf *s, int column, int row, float height, Vec2 *off)
{
    float x = depth_at(s, column + 1, row) - depth_at(s, column - 1, row);
    float z = depth_at(s, column, row + 1) - depth_at(s, column, row - 1);
    float length = sqrtf(x * x + z * z);
    *off = (Vec2){x / length, z / length};
    if (!(length > 0.0f) || off->x * s->way.x + off->y * s->way.y > -0.15f) {
        return 0.0f;
    }
    float depth[5]; // from two samples seaward to two landward
    for (int k = -2; k <= 2; k++) {
        depth[2 + k] = depth_at(s, column - (int)lrintf((float)k * off->x),
                                row - (int)lrintf((float)k * off->y));
    }
    float middle = 0.5f * (depth[0] + depth[4]);
    bool here = depth[2] >= middle && depth[3] < middle && depth[0] - depth[4] > EDGE;
    float kept = CARRIES * fmaxf(depth[4], 0.0f) / height;
    return here && depth[0] > height ? UP * fmaxf(1.0f - kept, 0.0f) : 0.0f;
}

// The height of the waves that come in, m: just before the wall they may be lower, since surf keeps
// to the depth, but what breaks there runs on into the wall.
static float height_before(const Surf *s, int column, int row)
{
    enum { REACH = 5 }; // samples
    const WavesShore *shore = s->shore;
    float share = 0.0f;
    for (int k = 0; k <= REACH; k++) {
        int x = column - (int)lrintf((float)k * s->way.x);
        int z = row - (int)lrintf((float)k * s->way.y);
        if (x >= 0 && z >= 0 && x < shore->columns && z < shore->rows) {
            int64_t i = (int64_t)z * shore->columns + x;
            share = fmaxf(share, shore->depth[i] > 0.0f ? shore->share[i * WAVES_TILES] : 0.0f);
        }
    }
    return share * s->height;
}

static float number_of(uint64_t key, int parcel, int number)
{
    return random_unit(random_key(key, (uint64_t)parcel * NUMBERS + (uint64_t)number));
}

// A jet's parcel `age` s after the crest has come; false before it starts and after it has fallen
// back.
static bool jet_parcel(const Surf *s, uint64_t key, int number, Vec2 off, float speed, float age,
                       SprayParcel *parcel)
{
    float t = age - 0.9f * number_of(key, number, NUMBER_DELAY);
    float fast = speed * lerpf(0.25f, 1.0f, number_of(key, number, NUMBER_SPEED));
    float along = 0.3f * (2.0f * number_of(key, number, NUMBER_ASIDE) - 1.0f);
    float lean = 0.35f * number_of(key, number, NUMBER_LEAN);
    float x = lean * off.x - along * off.y, z = lean * off.y + along * off.x;
    float place = s->shore->cell * (number_of(key, number, NUMBER_PLACE) - 0.5f);
    float rise = fast * t - 0.5f * (float)GRAVITY * t * t;
    parcel->center = vec3(x * fast * t - place * off.y, rise, z * fast * t + place * off.x);
    parcel->radius = 0.2f + 0.02f * speed + 0.14f * fast * t;
    return t > 0.0f && rise > -0.5f * parcel->radius;
}

// Adds what hangs over the shore at a sample.
static bool splash(const Surf *s, int64_t i, Vec2 at, Vec2 off, float height, SprayParcels *spray,
                   Error *e)
{
    const WavesShore *shore = s->shore;
    float phase = (at.x * s->way.x + at.y * s->way.y + shore->shift[i * WAVES_TILES]) / s->length;
    float crests = s->time / s->period - phase, number = floorf(crests);
    float age = (crests - number) * s->period, wave = sqrtf((float)GRAVITY * height);
    bool done = true;
    for (int last = 0; done && last < 2; last++) { // of this crest, and the mist of the one before
        uint64_t crest = random_key(s->key, (uint64_t)(int64_t)(number - (float)last));
        float gust = noise_plane_fractal(at.x / ROW, at.y / ROW, 2, crest);
        float speed = FASTEST * wave * clampf(0.45f + 1.3f * gust, 0.0f, 1.0f);
        float since = age + (float)last * s->period;
        uint64_t key = random_key(crest, (uint64_t)i);
        float content = height * shore->cell * 0.25f * speed / JETS;
        for (int k = 0; done && k < JETS + MIST && speed > wave; k++) {
            SprayParcel parcel = {.content = content};
            bool mist = k >= JETS;
            float left = (float)exact_exp((double)(-since / LINGERS));
            if (!jet_parcel(s, key, k, off, speed, mist ? fminf(since, 0.1f * speed) : since,
                            &parcel)) {
                continue;
            }
            parcel.content *= mist ? 0.5f * left : 1.0f;
            parcel.radius *= mist ? 1.6f : 1.0f;
            parcel.center = vec3_add(parcel.center, vec3(at.x, s->level, at.y));
            done = spray_add(spray, parcel, e);
        }
    }
    return done;
}

SprayParcels *sea_spray(const SeaParams *params, const Waves *waves, uint64_t seed, Error *e)
{
    SprayParcels *spray = memory_alloc_zero(1, sizeof *spray, e);
    const WavesShore *shore = waves->shore;
    if (!spray || !shore) {
        return spray;
    }
    WaveSpectrum spectrum = sea_spectrum(params);
    Surf s = {.shore = shore,
              .way = waves->way,
              .length = (float)(TURN / wave_number(spectrum.peak, spectrum.depth)),
              .period = (float)(TURN / spectrum.peak),
              .height = (float)(4.0 * sqrt(wave_spectrum_variance(&spectrum))),
              .level = params->level,
              .time = params->time,
              .key = random_key(seed, STREAM_SPRAY)};
    bool done = true;
    for (int row = 0; done && row < shore->rows; row++) {
        for (int column = 0; done && column < shore->columns; column++) {
            int64_t i = (int64_t)row * shore->columns + column;
            Vec2 at = {shore->origin.x + (float)column * shore->cell,
                       shore->origin.y + (float)row * shore->cell},
                 off = {0};
            float height = shore->depth[i] > 0.0f ? height_before(&s, column, row) : 0.0f;
            if (height > LEAST && !find_wall(&s, column, row, &off)) {
                height *= edge_share(&s, column, row, height, &off);
            }
            done = height <= LEAST || splash(&s, i, at, off, height, spray, e);
        }
    }
    if (!done) {
        spray_free(spray);
        return NULL;
    }
    return spray;
}
