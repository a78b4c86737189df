// Synthesis of a sea's tiles by the Fourier transform: each wave of the spectrum has its amplitude
// and a random phase, which its frequency turns with time.
#include "objects/sea/tile.h"

#include "base/exact_math.h"
#include "base/fft.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

static const double TURN = 6.28318530717958647692;

enum {
    SIDE = SEA_TILE_SIDE,
    LEAST_SIDE = 8, // of the coarsest level
    SUBDIVISION = 4,
    TRAIL_STEPS = 16,
    SPILL_STEPS = 4,
    FOAM_STEPS = 16,
    WAVE_PAIRS = 5 // transforms of a level, each of two fields
};

#define TRAIL_SECONDS 4.0 // that foam lasts
#define TRAIL_FADE 0.05   // crowding that a trail loses in a second
#define FOAM_SECONDS 6.0  // after which nothing is left of foam in the open sea
#define SPILL_SECONDS 0.6 // by which a roller runs ahead of its crest at most
#define SPILL_FADE 0.4    // crowding that it needs for a second

// ---- waves

// A wave of a tile at time 0, and its frequency. Waves beyond the band have no amplitude.
typedef struct WaveMode {
    Complex amplitude; // m
    double omega;      // rad/s
    double kx, kz, k;  // 1/m
    double breaks;     // 0..1: share of it in what breaks
} WaveMode;

typedef struct Synthesis {
    SeaTile with;
    WaveTile *tile;
    WaveMode *mode; // owned: MODES a side, of numbers -MOST_NUMBER .. MOST_NUMBER
    double spread;  // of the crowding: its standard deviation
} Synthesis;

enum { MOST_NUMBER = SIDE / 4, MODES = 2 * MOST_NUMBER + 1 };

// Waves of four samples or more.
static bool in_band(const Synthesis *s, double k)
{
    return k >= s->with.low && k < s->with.high;
}

// Mean of the spectrum's density over the mode's cell of wave numbers, within the band.
static double cell_density(const Synthesis *s, double m, double n)
{
    double step = TURN / (double)s->tile->size;
    Vec2 way = sea_way(s->with.params);
    double sum = 0.0;
    for (int i = 0; i < SUBDIVISION * SUBDIVISION; i++) {
        int column = i % SUBDIVISION, row = i / SUBDIVISION;
        double u = (m + (column + 0.5) / SUBDIVISION - 0.5) * step;
        double v = (n + (row + 0.5) / SUBDIVISION - 0.5) * step;
        double k = sqrt(u * u + v * v);
        double cosine = (double)s->tile->cosine, sine = (double)s->tile->sine;
        double x = u * cosine - v * sine, z = u * sine + v * cosine;
        if (in_band(s, k)) {
            double ahead = x * (double)way.x + z * (double)way.y;
            double aside = z * (double)way.x - x * (double)way.y;
            double angle = (double)exact_atan2((float)aside, (float)ahead);
            sum += wave_spectrum_density(&s->with.spectrum, k, angle);
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
    double step = TURN / (double)s->tile->size;
    double u = m * step, v = n * step;
    double cosine = (double)s->tile->cosine, sine = (double)s->tile->sine;
    WaveMode mode = {.kx = u * cosine - v * sine, .kz = u * sine + v * cosine};
    mode.k = sqrt(u * u + v * v);
    // A cell that overlaps the band's end is partly in it.
    double reach = 0.75 * step;
    if ((m == 0 && n == 0) || mode.k < s->with.low - reach || mode.k > s->with.high + reach) {
        return mode;
    }
    double height = sqrt(0.5 * cell_density(s, m, n)) * step;
    uint64_t column = (uint64_t)((int64_t)m + MOST_NUMBER);
    uint64_t row = (uint64_t)((int64_t)n + MOST_NUMBER);
    uint64_t key = random_key(random_key(s->with.key, column), row);
    double phase = TURN * (double)random_unit(key);
    double re, im;
    turn(phase, &im, &re);
    mode.amplitude = (Complex){height * re, height * im};
    mode.omega = wave_frequency(mode.k, s->with.spectrum.depth);
    double ratio = mode.k * s->with.breaker / TURN;
    mode.breaks = exact_exp(-ratio * ratio);
    return mode;
}

static bool find_modes(Synthesis *s, Error *e)
{
    s->mode = memory_alloc((int64_t)MODES * MODES, sizeof *s->mode, e);
    if (!s->mode) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(s->with.run->threads)
    for (int n = -MOST_NUMBER; n <= MOST_NUMBER; n++) {
        for (int m = -MOST_NUMBER; m <= MOST_NUMBER; m++) {
            s->mode[(n + MOST_NUMBER) * MODES + m + MOST_NUMBER] = mode_at(s, m, n);
        }
    }
    return true;
}

static Complex times(Complex a, Complex b)
{
    return (Complex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

// The phase of a wave at the place and the time of the great wave's crest.
static double phase_at_crest(const Synthesis *s, const WaveMode *mode)
{
    const SeaParams *params = s->with.params;
    return mode->kx * (double)params->crest[0] + mode->kz * (double)params->crest[1] -
           mode->omega * (double)params->crest_time;
}

// Adds the great wave: to each wave a part in proportion to its variance that is in phase with all
// others at the crest, which makes the mean surface about a crest of this height; what the random
// waves have there already is taken off (Tromans et al. 1991; Taylor et al. 1997).
static void add_crest(Synthesis *s)
{
    double have = 0.0, most = 0.0;
    for (int i = 0; i < MODES * MODES; i++) {
        const WaveMode *mode = &s->mode[i];
        Complex a = mode->amplitude;
        double sine, cosine;
        turn(phase_at_crest(s, mode), &sine, &cosine);
        have += 2.0 * (a.re * cosine - a.im * sine);
        most += 2.0 * (a.re * a.re + a.im * a.im);
    }
    double factor = most > 0.0 ? ((double)s->with.params->crest_height - have) / most : 0.0;
    for (int i = 0; i < MODES * MODES; i++) {
        WaveMode *mode = &s->mode[i];
        Complex *a = &mode->amplitude;
        double sine, cosine, part = factor * (a->re * a->re + a->im * a->im);
        turn(-phase_at_crest(s, mode), &sine, &cosine);
        a->re += part * cosine;
        a->im += part * sine;
    }
}

// The coefficient of exp(i k x) at a time: that wave and the one that runs against it.
static Complex coefficient(const WaveMode *with, const WaveMode *against, double time)
{
    double sine, cosine;
    turn(with->omega * time, &sine, &cosine);
    Complex a = times(with->amplitude, (Complex){cosine, -sine});
    Complex b = times(against->amplitude, (Complex){cosine, -sine});
    return (Complex){a.re + b.re, a.im - b.im};
}

// The factor on that coefficient for a channel.
static Complex factor(const WaveMode *mode, int channel)
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

// ---- transforms

// A square of complex numbers, and a column of it.
typedef struct Square {
    int side;
    Complex *value, *column; // owned
    Complex *root;
} Square;

static void square_clear(Square *q)
{
    free(q->value);
    free(q->column);
    free(q->root);
}

static bool square_init(Square *q, int side, Error *e)
{
    *q = (Square){.side = side};
    q->value = memory_alloc((int64_t)side * side, sizeof *q->value, e);
    q->column = q->value ? memory_alloc(side, sizeof *q->column, e) : NULL;
    q->root = q->column ? fft_roots(side, e) : NULL;
    if (!q->root) {
        square_clear(q);
    }
    return q->root;
}

static void square_transform(Square *q)
{
    for (int64_t row = 0; row < q->side; row++) {
        fft_transform(q->value + row * q->side, q->side, q->root);
    }
    for (int64_t column = 0; column < q->side; column++) {
        for (int64_t row = 0; row < q->side; row++) {
            q->column[row] = q->value[row * q->side + column];
        }
        fft_transform(q->column, q->side, q->root);
        for (int64_t row = 0; row < q->side; row++) {
            q->value[row * q->side + column] = q->column[row];
        }
    }
}

// A field of the surface at a time.
typedef struct WaveField {
    int channel;
    double time;
} WaveField;

// Fills the square with two fields, one as real and one as imaginary part. Their coefficients lie
// at the negative of their numbers, because fft_transform takes exp(-i ...).
static void fill(const Synthesis *s, Square *q, WaveField first, WaveField second)
{
    for (int64_t i = 0; i < (int64_t)q->side * q->side; i++) {
        q->value[i] = (Complex){0};
    }
    int most = q->side / 4;
    for (int n = -most; n <= most; n++) {
        for (int m = -most; m <= most; m++) {
            const WaveMode *with = &s->mode[(n + MOST_NUMBER) * MODES + m + MOST_NUMBER];
            const WaveMode *against = &s->mode[(MOST_NUMBER - n) * MODES + MOST_NUMBER - m];
            if (with->omega == 0.0 && against->omega == 0.0) {
                continue;
            }
            Complex at = coefficient(with, against, first.time);
            Complex a = times(at, factor(with, first.channel));
            at = second.time != first.time ? coefficient(with, against, second.time) : at;
            Complex b = times(at, factor(with, second.channel));
            int column = (q->side - m) % q->side, row = (q->side - n) % q->side;
            q->value[(int64_t)row * q->side + column] = (Complex){a.re - b.im, a.im + b.re};
        }
    }
}

static void store(const Square *q, float *texel, int first, int second)
{
    for (int64_t i = 0; i < (int64_t)q->side * q->side; i++) {
        texel[i * WAVE_CHANNELS + first] = (float)q->value[i].re;
        texel[i * WAVE_CHANNELS + second] = (float)q->value[i].im;
    }
}

// The greatest crowding of the next `seconds`, which fades with the time until then; of the last
// ones if they are negative. `channel` has that of now.
static void find_greatest(const Synthesis *s, Square *q, float *texel, int channel, double seconds,
                          int steps, double fade)
{
    double now = (double)s->with.params->time, step = seconds / steps;
    for (int i = 1; i <= steps; i += 2) {
        double first = i * step, second = first + step;
        fill(s, q, (WaveField){WAVE_CROWDING, now + first},
             (WaveField){WAVE_CROWDING, now + second});
        square_transform(q);
        for (int64_t k = 0; k < (int64_t)q->side * q->side; k++) {
            float *most = &texel[k * WAVE_CHANNELS + channel];
            *most = fmaxf(*most, (float)(q->value[k].re - fabs(first) * fade));
            *most = fmaxf(*most, (float)(q->value[k].im - fabs(second) * fade));
        }
    }
}

// What is left of the foam of crests that broke in the last seconds.
static void find_left(const Synthesis *s, Square *q, float *texel)
{
    const double full = 0.5; // deviations by which the foam of a crest grows to its whole
    double now = (double)s->with.params->time, step = FOAM_SECONDS / FOAM_STEPS;
    float from = (float)(s->with.breaking * s->spread);
    float to = (float)((s->with.breaking + full) * s->spread);
    for (int i = 0; i < FOAM_STEPS; i += 2) {
        fill(s, q, (WaveField){WAVE_CROWDING, now - i * step},
             (WaveField){WAVE_CROWDING, now - (i + 1) * step});
        square_transform(q);
        float first = 1.0f - (float)i / FOAM_STEPS, second = 1.0f - (float)(i + 1) / FOAM_STEPS;
        for (int64_t k = 0; k < (int64_t)q->side * q->side; k++) {
            float *left = &texel[k * WAVE_CHANNELS + WAVE_FOAM];
            *left = fmaxf(*left, first * smoothstepf(from, to, (float)q->value[k].re));
            *left = fmaxf(*left, second * smoothstepf(from, to, (float)q->value[k].im));
        }
    }
}

static bool make_level(const Synthesis *s, int level, Error *e)
{
    static const int pair[WAVE_PAIRS][2] = {{WAVE_HEIGHT, WAVE_CROWDING},
                                            {WAVE_ASIDE_X, WAVE_ASIDE_Z},
                                            {WAVE_SLOPE_X, WAVE_SLOPE_Z},
                                            {WAVE_STRETCH_XX, WAVE_STRETCH_ZZ},
                                            {WAVE_STRETCH_XZ, WAVE_TRAIL}};
    int side = s->tile->side >> level;
    Square square;
    float *texel = memory_alloc((int64_t)side * side, WAVE_CHANNELS * sizeof *texel, e);
    s->tile->texel[level] = texel;
    if (!texel || !square_init(&square, side, e)) {
        return false;
    }
    double now = (double)s->with.params->time;
    for (int i = 0; i < WAVE_PAIRS; i++) {
        fill(s, &square, (WaveField){pair[i][0], now}, (WaveField){pair[i][1], now});
        square_transform(&square);
        store(&square, texel, pair[i][0], pair[i][1]);
    }
    for (int64_t k = 0; k < (int64_t)side * side; k++) {
        texel[k * WAVE_CHANNELS + WAVE_SPILL] = texel[k * WAVE_CHANNELS + WAVE_CROWDING];
        texel[k * WAVE_CHANNELS + WAVE_FOAM] = 0.0f;
    }
    if (s->with.trails) {
        find_greatest(s, &square, texel, WAVE_TRAIL, -TRAIL_SECONDS, TRAIL_STEPS, TRAIL_FADE);
        find_greatest(s, &square, texel, WAVE_SPILL, SPILL_SECONDS, SPILL_STEPS, SPILL_FADE);
        find_left(s, &square, texel);
    }
    square_clear(&square);
    return true;
}

// Standard deviation of the crowding.
static double crowding_spread(const Synthesis *s)
{
    double squares = 0.0;
    for (int i = 0; i < MODES * MODES; i++) {
        const WaveMode *mode = &s->mode[i];
        double crowding = mode->k * mode->breaks;
        Complex a = mode->amplitude;
        squares += 2.0 * crowding * crowding * (a.re * a.re + a.im * a.im);
    }
    return sqrt(squares);
}

bool sea_tile_fill(const SeaTile *with, WaveTile *tile, Error *e)
{
    Synthesis s = {.with = *with, .tile = tile};
    bool done = find_modes(&s, e);
    if (done && with->has_crest && with->params->crest_height > 0.0f) {
        add_crest(&s);
    }
    s.spread = done ? crowding_spread(&s) : 0.0;
    tile->levels = 0;
    while (tile->levels < WAVES_LEVELS && SIDE >> tile->levels >= LEAST_SIDE) {
        tile->levels++;
    }
    Error error[WAVES_LEVELS] = {0};
    int failed = WAVES_LEVELS;
#pragma omp parallel for schedule(dynamic, 1) num_threads(with->run->threads)
    for (int level = 0; level < (done ? tile->levels : 0); level++) {
        if (!make_level(&s, level, &error[level])) {
#pragma omp critical
            failed = level < failed ? level : failed;
        }
    }
    if (failed < WAVES_LEVELS) {
        done = false;
        if (e) {
            *e = error[failed];
        }
    }
    free(s.mode);
    return done;
}
