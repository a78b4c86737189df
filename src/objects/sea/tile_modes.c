#include "objects/sea/tile_modes.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

static const double TURN = 6.28318530717958647692;

enum { SUBDIVISION = 4 }; // of a mode's cell of wave numbers

typedef struct Synthesis {
    const SeaTile *with;
    const WaveTile *tile;
    double step;    // 1/m, between wave numbers
    WaveRing *ring; // owned: see ring_index
} Synthesis;

// Waves of four samples or more.
static bool in_band(const SeaTile *with, double k)
{
    return k >= with->low && k < with->high;
}

// Odd eighths of a step at which cells are sampled: |u| of sample j lies at (2 j + 1) / 8.
enum { RING_SIDE = SUBDIVISION * SEA_MOST_NUMBER + SUBDIVISION / 2 };

static int64_t ring_index(int i, int j)
{
    int64_t low = i < j ? i : j, high = i < j ? j : i;
    return high * (high + 1) / 2 + low;
}

// The spectrum at each length of the wave numbers that cells are sampled at, which eight of them
// share. To be freed.
static WaveRing *find_rings(const SeaTile *with, double step, Error *e)
{
    WaveRing *ring = memory_alloc(ring_index(0, RING_SIDE), sizeof *ring, e);
    if (!ring) {
        return NULL;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(with->run->threads)
    for (int i = 0; i < RING_SIDE; i++) {
        for (int j = 0; j <= i; j++) {
            double u = (2 * i + 1) / (2.0 * SUBDIVISION) * step;
            double v = (2 * j + 1) / (2.0 * SUBDIVISION) * step;
            double k = sqrt(u * u + v * v);
            ring[ring_index(i, j)] =
                in_band(with, k) ? wave_spectrum_ring(&with->spectrum, k) : (WaveRing){0};
        }
    }
    return ring;
}

// The ring's coordinate of sample i of a cell.
static int ring_side(int number, int i)
{
    int eighths = 2 * SUBDIVISION * number + 2 * i + 1 - SUBDIVISION;
    return abs(eighths) / 2;
}

// Mean of the spectrum's density over the mode's cell of wave numbers, within the band.
static double cell_density(const Synthesis *s, int m, int n)
{
    Vec2 way = sea_way(s->with->params);
    double cosine = (double)s->tile->cosine, sine = (double)s->tile->sine, sum = 0.0;
    for (int i = 0; i < SUBDIVISION * SUBDIVISION; i++) {
        int column = i % SUBDIVISION, row = i / SUBDIVISION;
        double u = (m + (column + 0.5) / SUBDIVISION - 0.5) * s->step;
        double v = (n + (row + 0.5) / SUBDIVISION - 0.5) * s->step;
        double x = u * cosine - v * sine, z = u * sine + v * cosine;
        if (in_band(s->with, sqrt(u * u + v * v))) {
            double ahead = x * (double)way.x + z * (double)way.y;
            double aside = z * (double)way.x - x * (double)way.y;
            double angle = (double)exact_atan2((float)aside, (float)ahead);
            int64_t ring = ring_index(ring_side(m, column), ring_side(n, row));
            sum += wave_ring_density(&s->ring[ring], angle);
        }
    }
    return sum / (SUBDIVISION * SUBDIVISION);
}

static void turn(double phase, double *sine, double *cosine)
{
    exact_sincos_double(phase - TURN * floor(phase / TURN), sine, cosine);
}

static WaveMode mode_at(const Synthesis *s, int m, int n)
{
    double step = s->step, u = m * step, v = n * step;
    double cosine = (double)s->tile->cosine, sine = (double)s->tile->sine;
    WaveMode mode = {.kx = u * cosine - v * sine, .kz = u * sine + v * cosine};
    mode.k = sqrt(u * u + v * v);
    // A cell that overlaps the band's end is partly in it.
    double reach = 0.75 * step;
    if ((m == 0 && n == 0) || mode.k < s->with->low - reach || mode.k > s->with->high + reach) {
        return mode;
    }
    double height = sqrt(0.5 * cell_density(s, m, n)) * step;
    uint64_t column = (uint64_t)((int64_t)m + SEA_MOST_NUMBER);
    uint64_t row = (uint64_t)((int64_t)n + SEA_MOST_NUMBER);
    uint64_t key = random_key(random_key(s->with->key, column), row);
    double phase = TURN * (double)random_unit(key);
    double re, im;
    turn(phase, &im, &re);
    mode.amplitude = (Complex){height * re, height * im};
    mode.omega = wave_frequency(mode.k, s->with->spectrum.depth);
    double ratio = mode.k * s->with->breaker / TURN;
    mode.breaks = exact_exp(-ratio * ratio);
    return mode;
}

// The phase of a wave at the place and the time of the great wave's crest.
static double phase_at_crest(const SeaParams *params, const WaveMode *mode)
{
    return mode->kx * (double)params->crest[0] + mode->kz * (double)params->crest[1] -
           mode->omega * (double)params->crest_time;
}

// Adds the great wave: to each wave a part in proportion to its variance that is in phase with all
// others at the crest, which makes the mean surface about a crest of this height; what the random
// waves have there already is taken off (Tromans et al. 1991; Taylor et al. 1997).
static void add_crest(const SeaParams *params, WaveMode *modes)
{
    double have = 0.0, most = 0.0;
    for (int i = 0; i < SEA_MODES * SEA_MODES; i++) {
        const WaveMode *mode = &modes[i];
        Complex a = mode->amplitude;
        double sine, cosine;
        turn(phase_at_crest(params, mode), &sine, &cosine);
        have += 2.0 * (a.re * cosine - a.im * sine);
        most += 2.0 * (a.re * a.re + a.im * a.im);
    }
    double factor = most > 0.0 ? ((double)params->crest_height - have) / most : 0.0;
    for (int i = 0; i < SEA_MODES * SEA_MODES; i++) {
        WaveMode *mode = &modes[i];
        Complex *a = &mode->amplitude;
        double sine, cosine, part = factor * (a->re * a->re + a->im * a->im);
        turn(-phase_at_crest(params, mode), &sine, &cosine);
        a->re += part * cosine;
        a->im += part * sine;
    }
}

WaveMode *sea_modes(const SeaTile *with, const WaveTile *tile, Error *e)
{
    Synthesis s = {.with = with, .tile = tile, .step = TURN / (double)tile->size};
    WaveMode *modes = memory_alloc((int64_t)SEA_MODES * SEA_MODES, sizeof *modes, e);
    s.ring = modes ? find_rings(with, s.step, e) : NULL;
    if (!s.ring) {
        free(modes);
        return NULL;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(with->run->threads)
    for (int n = -SEA_MOST_NUMBER; n <= SEA_MOST_NUMBER; n++) {
        for (int m = -SEA_MOST_NUMBER; m <= SEA_MOST_NUMBER; m++) {
            modes[(n + SEA_MOST_NUMBER) * SEA_MODES + m + SEA_MOST_NUMBER] = mode_at(&s, m, n);
        }
    }
    free(s.ring);
    if (with->has_crest && with->params->crest_height > 0.0f) {
        add_crest(with->params, modes);
    }
    return modes;
}

Complex wave_coefficient(const WaveMode *with, const WaveMode *against, double time)
{
    double sine, cosine;
    turn(with->omega * time, &sine, &cosine);
    Complex a = complex_times(with->amplitude, (Complex){cosine, -sine});
    Complex b = complex_times(against->amplitude, (Complex){cosine, -sine});
    return (Complex){a.re + b.re, a.im - b.im};
}

Complex wave_factor(const WaveMode *mode, int channel)
{
    double k = mode->k > 0.0 ? mode->k : 1.0;
    switch (channel) {
    case WAVE_HEIGHT:
        return (Complex){1.0, 0.0};
    case WAVE_ASIDE_X:
        return (Complex){0.0, mode->kx / k};
    case WAVE_ASIDE_Z:
        return (Complex){0.0, mode->kz / k};
    case WAVE_SLOPE_X:
        return (Complex){0.0, mode->kx};
    case WAVE_SLOPE_Z:
        return (Complex){0.0, mode->kz};
    case WAVE_STRETCH_XX:
        return (Complex){-mode->kx * mode->kx / k, 0.0};
    case WAVE_STRETCH_ZZ:
        return (Complex){-mode->kz * mode->kz / k, 0.0};
    case WAVE_STRETCH_XZ:
        return (Complex){-mode->kx * mode->kz / k, 0.0};
    default:
        return (Complex){k * mode->breaks, 0.0};
    }
}

double wave_modes_crowding(const WaveMode *modes)
{
    double squares = 0.0;
    for (int i = 0; i < SEA_MODES * SEA_MODES; i++) {
        const WaveMode *mode = &modes[i];
        double crowding = mode->k * mode->breaks;
        Complex a = mode->amplitude;
        squares += 2.0 * crowding * crowding * (a.re * a.re + a.im * a.im);
    }
    return sqrt(squares);
}
