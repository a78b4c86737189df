// The life of a snow crystal: the weather at each size becomes rates of growth.
#include "base/noise.h"
#include "base/random.h"
#include "base/vec.h"
#include "objects/snow_crystal/column.h"

enum { STAGES = 129 };                       // of its life
enum { STREAM_GUSTS = 1, STREAM_CELLS = 2 }; // of the seed

SnowWeather snow_weather_at(const SnowCrystalParams *params, float at)
{
    const SnowWeather *life = params->life;
    int count = params->life_count;
    if (count == 0) {
        return params->weather;
    }
    if (at <= life[0].at) {
        return life[0];
    }
    for (int i = 1; i < count; i++) {
        if (at <= life[i].at) {
            const SnowWeather *a = &life[i - 1], *b = &life[i];
            float t = (at - a->at) / (b->at - a->at);
            return (SnowWeather){at, lerpf(a->temperature, b->temperature, t),
                                 lerpf(a->supersaturation, b->supersaturation, t)};
        }
    }
    return life[count - 1];
}

// The air's moisture varies as the crystal tumbles through the cloud; all six arms meet the same,
// which is why they look alike. About -1 .. 1.
float snow_gust(float at, uint64_t seed)
{
    return 2.0f * noise_plane_fractal(9.0f * at, 0.5f, 3, random_key(seed, STREAM_GUSTS));
}

float snow_column_until(const SnowCrystalParams *params)
{
    enum { LOOKS = 1024 };
    for (int i = 0; i <= LOOKS; i++) {
        float at = (float)i / LOOKS;
        if (snow_is_flat(snow_weather_at(params, at).temperature)) {
            return at;
        }
    }
    return 1.0f;
}

// Size of the whole crystal, as a share of the final one, when a plate had the share u of its own.
// A cap meets its weather only where it is wider than its column.
static float stage_at(const SnowCrystalParams *params, const SnowColumn *column, float u)
{
    if (!(column->length > 0.0f)) {
        return u;
    }
    float covered = column->width / params->size;
    float share = covered < 1.0f ? (u - covered) / (1.0f - covered) : 0.0f;
    return lerpf(column->until, 1.0f, clampf(share, 0.0f, 1.0f));
}

bool snow_crystal_grow(const SnowCrystalParams *params, uint64_t seed, const Run *run,
                       Snowfake *fake, Error *e)
{
    SnowfakeRates life[STAGES];
    SnowColumn column = snow_column(params);
    for (int i = 0; i < STAGES; i++) {
        float at = stage_at(params, &column, (float)i / (STAGES - 1));
        SnowWeather weather = snow_weather_at(params, at);
        weather.supersaturation *= 1.0f + params->gusts * snow_gust(at, seed);
        life[i] = snow_habit_rates(snow_habit(&weather));
    }
    SnowfakeParams grow = {.radius = params->cells,
                           .life = life,
                           .life_count = STAGES,
                           .noise = params->noise,
                           .seed = random_key(seed, STREAM_CELLS)};
    return snowfake_grow(&grow, run, fake, e);
}

static bool is_ice(const Snowfake *fake, int q, int r)
{
    return snowfake_distance(q, r) <= fake->radius && fake->ice[snowfake_cell(fake, q, r)] > 0.0f;
}

double snowfake_fill(const Snowfake *fake)
{
    int64_t ice = 0, all = 0;
    for (int r = -fake->radius; r <= fake->radius; r++) {
        for (int q = -fake->radius; q <= fake->radius; q++) {
            ice += is_ice(fake, q, r);
            all += snowfake_distance(q, r) <= fake->radius;
        }
    }
    return (double)ice / (double)all;
}

double snowfake_asymmetry(const Snowfake *fake)
{
    int64_t ice = 0, missing = 0;
    for (int r = -fake->radius; r <= fake->radius; r++) {
        for (int q = -fake->radius; q <= fake->radius; q++) {
            bool here = is_ice(fake, q, r);
            ice += here;
            missing += here && !is_ice(fake, -r, q + r);
        }
    }
    return (double)missing / (double)ice;
}
