// Synthesis of a sea's tiles by the Fourier transform: each wave of the spectrum has its amplitude
// and a random phase, which its frequency turns with time.
#include "objects/sea/tile.h"

#include "base/fft.h"
#include "base/memory.h"
#include "objects/sea/tile_modes.h"

#include <math.h>
#include <stdlib.h>

enum {
    SIDE = SEA_TILE_SIDE,
    LEAST_SIDE = 8, // of the coarsest level
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

typedef struct Synthesis {
    SeaTile with;
    WaveTile *tile;
    WaveMode *mode; // owned; from sea_modes
    double spread;  // of the crowding: its standard deviation
} Synthesis;

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
            const WaveMode *with =
                &s->mode[(n + SEA_MOST_NUMBER) * SEA_MODES + m + SEA_MOST_NUMBER];
            const WaveMode *against =
                &s->mode[(SEA_MOST_NUMBER - n) * SEA_MODES + SEA_MOST_NUMBER - m];
            if (with->omega == 0.0 && against->omega == 0.0) {
                continue;
            }
            Complex at = wave_coefficient(with, against, first.time);
            Complex a = complex_times(at, wave_factor(with, first.channel));
            at = second.time != first.time ? wave_coefficient(with, against, second.time) : at;
            Complex b = complex_times(at, wave_factor(with, second.channel));
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

bool sea_tile_fill(const SeaTile *with, WaveTile *tile, Error *e)
{
    Synthesis s = {.with = *with, .tile = tile};
    s.mode = sea_modes(with, tile, e);
    bool done = s.mode;
    s.spread = done ? wave_modes_crowding(s.mode) : 0.0;
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
