#include "render/film_merge.h"

#include "base/color.h"

#include <math.h>
#include <string.h>

#define WIDE 0x1p28 // quanta in 1, of what is not bounded
#define WIDE_LIMIT 0x1p19f
#define UNIT 0x1p24 // of what is within -1 .. 1
#define SQUARE 0x1p48
#define MOST_SAMPLES 0x1p24f
#define MOST_REST 0x1p48f // quanta: half an ulp of WIDE_LIMIT times MOST_SAMPLES, and some

// A plane of means: its place among the channels, the quanta in 1.
typedef struct Mean {
    int first, channels;
    double quanta;
    float limit;
    bool of_hits; // a mean over samples that hit
} Mean;

static const Mean MEANS[FILM_MEANS] = {
    [MEAN_COLOR] = {0, 3, WIDE, WIDE_LIMIT, false},
    [MEAN_LIGHT] = {3, 3, WIDE, WIDE_LIMIT, false},
    [MEAN_SKY] = {6, 3, WIDE, WIDE_LIMIT, false},
    [MEAN_POSITION] = {9, 3, WIDE, WIDE_LIMIT, true},
    [MEAN_DEPTH] = {12, 1, WIDE, WIDE_LIMIT, true},
    [MEAN_ALBEDO] = {13, 3, UNIT, 1.0f, false},
    [MEAN_NORMAL] = {16, 3, UNIT, 1.0f, false},
    [MEAN_ALPHA] = {19, 1, UNIT, 1.0f, false},
    [MEAN_LIGHT_SHARE] = {20, 1, UNIT, 1.0f, false},
    [MEAN_SKY_SHARE] = {21, 1, UNIT, 1.0f, false},
    [MEAN_ALBEDO_SQUARE] = {22, 1, UNIT, 1.0f, false},
    [MEAN_BLUR] = {23, 1, UNIT, 1.0f, false},
};
enum {
    WIDE_CHANNELS = 13,
    COLOR = 0,
    LIGHT = 3,
    SKY = 6,
    POSITION = 9,
    DEPTH = 12,
    ALBEDO = 13,
    NORMAL = 16,
    ALPHA = 19,
    LIGHT_SHARE = 20,
    SKY_SHARE = 21,
    ALBEDO_SQUARE = 22,
    BLUR = 23
};

// ---- paths

static void put_vector(float to[3], Vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

static void put_path(const PathResult *path, float value[FILM_CHANNELS])
{
    put_vector(value + COLOR, path->color);
    put_vector(value + ALBEDO, path->albedo);
    float bright = luminance(path->albedo);
    value[ALBEDO_SQUARE] = bright * bright;
    value[BLUR] = 1.0f - path->sharpness;
    value[ALPHA] = path->alpha;
    if (path->seen != SEEN_SURFACE) {
        bool light = path->seen == SEEN_LIGHT;
        put_vector(value + (light ? LIGHT : SKY), vec3_scale(path->color, path->sharpness));
        value[light ? LIGHT_SHARE : SKY_SHARE] = path->sharpness;
    }
    put_vector(value + NORMAL, path->normal);
    if (path->hit) {
        put_vector(value + POSITION, path->position);
        value[DEPTH] = path->depth;
    }
}

static double luminance_of(double red, double green, double blue)
{
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

// The bounds of each channel, and numbers so large that doubles beside them are multiples of the
// quantum: what is added to one and taken off again is rounded to the nearest. In tables, so that
// the compiler takes several channels at a time.
#define BOUND_3(x) x, x, x
#define CHANNELS(wide, unit)                                                         \
    BOUND_3(wide), BOUND_3(wide), BOUND_3(wide), BOUND_3(wide), wide, BOUND_3(unit), \
        BOUND_3(unit), BOUND_3(unit), unit, unit
static const float LIMIT[FILM_CHANNELS] = {CHANNELS(WIDE_LIMIT, 1.0f)};
static const double SHIFT[FILM_CHANNELS] = {CHANNELS(1.5 * 0x1p52 / WIDE, 1.5 * 0x1p52 / UNIT)};

static WideUint square_quanta(double l)
{
    double square = l * l * SQUARE;
    return square < 0x1p63 ? (WideUint)(uint64_t)(int64_t)square : (WideUint)square;
}

// In two steps: a load of several values waits for the stores of single ones right before it.
void path_sum_add(PathSum *sum, const PathResult path[], int count)
{
    _Alignas(64) // else GCC 12 loads it as if it were
        float value[WAVE_SIZE][FILM_CHANNELS] = {{0.0f}};
    double luminance[WAVE_SIZE];
    for (int k = 0; k < count; k++) {
        put_path(&path[k], value[k]);
        if (path[k].hit) {
            sum->object = sum->hits++ ? sum->object : path[k].object + 1;
        }
        sum->rays += path[k].rays;
    }
    for (int k = 0; k < count; k++) {
        double exact[FILM_CHANNELS];
        for (int i = 0; i < FILM_CHANNELS; i++) {
            float x = value[k][i] > -LIMIT[i] ? value[k][i] : -LIMIT[i]; // of NAN too
            x = x < LIMIT[i] ? x : LIMIT[i];
            exact[i] = (double)x + SHIFT[i] - SHIFT[i];
            sum->mean[i] += exact[i];
        }
        // of the color as it is summed, so that equal samples have no variance
        luminance[k] = luminance_of(exact[0], exact[1], exact[2]);
    }
    for (int k = 0; k < count; k++) {
        sum->squares += square_quanta(luminance[k]);
    }
    sum->samples += count;
}

// ---- pixels

void pixel_sum_add(PixelSum *sum, const PathSum *later)
{
    for (int i = 0; i < WIDE_CHANNELS; i++) {
        sum->mean[i] += (int64_t)(later->mean[i] * WIDE);
    }
    for (int i = WIDE_CHANNELS; i < FILM_CHANNELS; i++) {
        sum->mean[i] += (int64_t)(later->mean[i] * UNIT);
    }
    sum->squares += later->squares;
    sum->object = sum->hits > 0 ? sum->object : later->object;
    sum->samples += later->samples;
    sum->hits += later->hits;
}

void pixel_sum_join(PixelSum *sum, const PixelSum *later)
{
    for (int i = 0; i < FILM_CHANNELS; i++) {
        sum->mean[i] += later->mean[i];
    }
    sum->squares += later->squares;
    sum->object = sum->hits > 0 ? sum->object : later->object;
    sum->samples += later->samples;
    sum->hits += later->hits;
}

// ---- films

static double to_double(WideInt x)
{
    int64_t narrow = (int64_t)x;
    return narrow == x ? (double)narrow : (double)x; // the same, sooner
}

static WideInt to_wide(double x)
{
    return fabs(x) < 0x1p62 ? (WideInt)(int64_t)x : (WideInt)x;
}

// The quanta that the float tells of, for the quanta in 1 times the number of samples. The product
// is exact.
static WideInt told_by_mean(float mean, double scale)
{
    return to_wide((double)mean * scale);
}

static WideUint read_squares(const float limb[FILM_SQUARE_LIMBS])
{
    WideUint sum = 0;
    for (int k = FILM_SQUARE_LIMBS - 1; k >= 0; k--) {
        sum = sum << 24 | (uint32_t)limb[k];
    }
    return sum;
}

static void write_squares(WideUint sum, float limb[FILM_SQUARE_LIMBS])
{
    for (int k = 0; k < FILM_SQUARE_LIMBS; k++, sum >>= 24) {
        limb[k] = (float)(int)(sum & 0xffffff);
    }
}

void film_sum(const Film *film, int64_t i, PixelSum *sum)
{
    *sum = (PixelSum){.samples = (int)film->samples[i]};
    if (sum->samples < 1) {
        return;
    }
    sum->hits = (int)film->hits[i];
    sum->object = (int)film->object[i];
    sum->squares = read_squares(film->squares + FILM_SQUARE_LIMBS * i);
    for (int which = 0; which < FILM_MEANS; which++) {
        const Mean *mean = &MEANS[which];
        const float *coarse = film->rest[which][0], *fine = film->rest[which][1];
        double scale = mean->quanta * (mean->of_hits ? sum->hits : sum->samples);
        for (int c = 0; c < mean->channels && scale > 0.0; c++) {
            int64_t at = mean->channels * i + c;
            sum->mean[mean->first + c] = told_by_mean(film->mean[which][at], scale) +
                                         (int64_t)coarse[at] + (fine ? (int64_t)fine[at] : 0);
        }
    }
}

static void set_mean(Film *film, int64_t i, FilmMean which, const PixelSum *sum)
{
    const Mean *mean = &MEANS[which];
    float *coarse = film->rest[which][0], *fine = film->rest[which][1];
    double scale = mean->quanta * (mean->of_hits ? sum->hits : sum->samples),
           inverse = scale > 0.0 ? 1.0 / scale : 0.0;
    for (int c = 0; c < mean->channels; c++) {
        WideInt quanta = sum->mean[mean->first + c];
        int64_t at = mean->channels * i + c;
        float value = (float)(to_double(quanta) * inverse);
        int64_t rest = (int64_t)(quanta - told_by_mean(value, scale));
        film->mean[which][at] = value;
        coarse[at] = (float)rest;
        if (fine) {
            fine[at] = (float)(rest - (int64_t)coarse[at]);
        }
    }
}

// Of the mean: squared deviations from it over n (n - 1).
static float variance(const PixelSum *sum)
{
    const WideInt *color = &sum->mean[COLOR];
    double n = sum->samples,
           total =
               luminance_of(to_double(color[0]), to_double(color[1]), to_double(color[2])) / WIDE;
    double deviations = (double)sum->squares / SQUARE - total * total / n;
    return n > 1.0 ? (float)(fmax(0.0, deviations) / (n * (n - 1.0))) : 0.0f;
}

void film_set(Film *film, int64_t i, const PixelSum *sum)
{
    for (int which = 0; which < FILM_MEANS; which++) {
        set_mean(film, i, which, sum);
    }
    film->depth[i] = sum->hits > 0 ? film->depth[i] : INFINITY;
    write_squares(sum->squares, film->squares + FILM_SQUARE_LIMBS * i);
    film->variance[i] = variance(sum);
    film->object[i] = (float)sum->object;
    film->hits[i] = (float)sum->hits;
    film->samples[i] = (float)sum->samples;
}

// ---- checking

static bool is_whole(float x, float low, float high)
{
    return x >= low && x <= high && floorf(x) == x;
}

static bool mean_is_sound(const Film *film, int64_t i, FilmMean which)
{
    const Mean *mean = &MEANS[which];
    bool sound = true, empty = mean->of_hits && film->hits[i] < 1.0f;
    for (int64_t at = mean->channels * i; at < mean->channels * (i + 1) && sound; at++) {
        float value = film->mean[which][at];
        sound = empty || fabsf(value) <= mean->limit;
        for (int k = 0; k < FILM_RESTS && film->rest[which][k] && sound; k++) {
            sound = is_whole(film->rest[which][k][at], -MOST_REST, MOST_REST);
        }
    }
    return sound;
}

bool film_is_sound(const Film *film, int64_t i)
{
    float n = film->samples[i];
    bool sound = is_whole(n, 0.0f, MOST_SAMPLES) && is_whole(film->hits[i], 0.0f, n) &&
                 is_whole(film->object[i], 0.0f, 0x1p24f);
    for (int k = 0; k < FILM_SQUARE_LIMBS && sound; k++) {
        sound = is_whole(film->squares[FILM_SQUARE_LIMBS * i + k], 0.0f, 0x1p24f - 1.0f);
    }
    for (int which = 0; which < FILM_MEANS && sound; which++) {
        sound = mean_is_sound(film, i, which);
    }
    return sound;
}
