// The waves of a sea: three tiles of consecutive bands of its spectrum, and what they leave out.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/sea/tile.h"

#include <math.h>

static const double TURN = 6.28318530717958647692;

#define SHORTEST_WAVE 0.017 // m: where surface tension takes over from gravity
#define RIPPLE (TURN / SHORTEST_WAVE)
#define TILE_WAVES 8.0 // the longest waves of a band go that often into its tile
// Shorter waves break without foam: of the longest wave of the first tile, and m.
#define SHORTEST_BREAKER 0.025
#define LEAST_BREAKER 0.5
// Crowding, with that of the waves too short for tiles, from which water breaks: Monahan's
// whitecaps at 10 and 15 m/s (tests/objects/test_sea.c).
#define BREAKING_CROWDING 0.55

WaveSpectrum sea_spectrum(const SeaParams *params)
{
    WaveSpectrum s =
        wave_spectrum((double)params->wind, (double)params->fetch, (double)params->depth);
    wave_spectrum_steepen(&s, (double)params->wind, SHORTEST_WAVE, 0.5);
    return s;
}

Vec2 sea_way(const SeaParams *params)
{
    float sine, cosine;
    exact_sincos(params->wind_azimuth * RADIANS_PER_DEGREE, &sine, &cosine);
    return (Vec2){-sine, cosine};
}

// The greatest wave number of a tile, 1/m.
static double shortest_shown(const WaveTile *tile)
{
    double most = 0.99 * TURN * SEA_TILE_SIDE / 4.0 / (double)tile->size;
    return most < RIPPLE ? most : RIPPLE;
}

// Variance of the slopes of waves shorter than given lengths: by the spectrum down to the shortest
// wave that the tiles have, and what is left of that of a real sea, evenly over the logarithm of
// the wave number, down to ripples.
static void find_hidden(Waves *waves, const WaveSpectrum *s, double wind)
{
    const WaveTile *finest = &waves->tile[WAVES_TILES - 1];
    double shown = shortest_shown(finest);
    double last = RIPPLE > 1.5 * shown ? RIPPLE : 1.5 * shown;
    double lowest = 0.25 * wave_number(s->peak, s->depth);
    double rest = cox_munk_slopes(wind) - wave_spectrum_slopes(s, lowest, shown);
    rest = rest > 0.003 ? rest : 0.003;
    for (int i = 0; i < WAVES_BANDS; i++) {
        double octave = 1.0 + (i % 4) / 4.0;
        int power = (int)WAVES_BAND_FIRST + i / 4;
        double k = TURN / ldexp(octave, power);
        double share = k >= last   ? 0.0
                       : k > shown ? exact_log(last / k) / exact_log(last / shown)
                                   : 1.0;
        k = k > lowest ? k : lowest;
        waves->hidden[i] = (float)(share * rest + wave_spectrum_slopes(s, k, shown));
    }
}

// Standard deviations of the crowding from which waves break; without foam, none does.
static double breaking_of(const SeaParams *params)
{
    double most = BREAKING_CROWDING / sqrt(cox_munk_slopes((double)params->wind));
    return params->foam > 0.0f ? most / (double)params->foam : 1e9;
}

// From which crowding waves break: the shorter ones, on their crests, add to it as the wind adds to
// the slopes of the sea.
static void find_breaking(Waves *waves, const SeaParams *params)
{
    double squares = 0.0;
    for (int i = 0; i < WAVES_TILES; i++) {
        squares += waves_mean_square(&waves->tile[i], WAVE_CROWDING);
    }
    double spread = sqrt(squares);
    waves->spread = params->choppiness * (float)spread;
    waves->foam = params->foam > 0.0f ? waves->spread * (float)breaking_of(params) : 1e9f;
}

// Foam lies in lines from a fresh breeze on, and well marked in a gale (Beaufort 7 and 8).
static void find_streaks(Waves *waves, const SeaParams *params)
{
    const double share = 0.25; // of what whitecaps cover
    double wind = (double)params->wind, marked = wind > 10.0 ? (wind - 10.0) / 8.0 : 0.0;
    double cover = share * (marked < 1.0 ? marked : 1.0) * monahan_whitecaps(wind);
    waves->streaks = fminf((float)cover * params->foam, 0.1f);
}

Waves *sea_waves(const SeaParams *params, uint64_t seed, const Run *run, Error *e)
{
    static const float angle[WAVES_TILES] = {0.0f, 0.61f, -0.97f};
    Waves *waves = memory_alloc_zero(1, sizeof *waves, e);
    if (!waves) {
        return NULL;
    }
    WaveSpectrum spectrum = sea_spectrum(params);
    double peak = wave_number(spectrum.peak, spectrum.depth);
    double longest = TURN / peak, low = 0.0;
    double breaker = fmax(SHORTEST_BREAKER * longest, LEAST_BREAKER);
    for (int i = 0; i < WAVES_TILES; i++) {
        WaveTile *tile = &waves->tile[i];
        tile->size = (float)(TILE_WAVES * longest);
        tile->longest = (float)longest;
        tile->side = SEA_TILE_SIDE;
        exact_sincos(angle[i], &tile->sine, &tile->cosine);
        double high = shortest_shown(tile);
        SeaTile with = {.params = params,
                        .spectrum = spectrum,
                        .low = low,
                        .high = high,
                        .breaker = breaker,
                        .breaking = breaking_of(params),
                        .trails = i == 0,
                        .has_crest = i == 0,
                        .key = random_key(seed, (uint64_t)i),
                        .run = run};
        bool done =
            sea_tile_fill(&with, tile, e) && (!run_is_cancelled(run) || run_cancel_error(e));
        if (!done) {
            waves_free(waves);
            return NULL;
        }
        low = high;
        longest = TURN / high;
    }
    waves->way = sea_way(params);
    waves->choppiness = params->choppiness;
    waves->swash = params->swash;
    waves->breakers = params->foam > 0.0f ? params->breakers : 0.0f;
    waves->shortest = (float)(TURN / shortest_shown(&waves->tile[WAVES_TILES - 1]));
    find_breaking(waves, params);
    find_streaks(waves, params);
    find_hidden(waves, &spectrum, (double)params->wind);
    return waves;
}
