#include "golden/comparison.h"

#include "base/color.h"
#include "base/memory.h"
#include "golden/heat.h"
#include "image/flip.h"
#include "image/tone_curve.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void comparison_clear(Comparison *comparison)
{
    free(comparison->ours.bytes);
    free(comparison->stored.bytes);
    free(comparison->map.bytes);
    *comparison = (Comparison){0};
}

// ---- common channels

// Converts to 3 or 4 channels; a missing alpha is 1.
static Image *with_channels(const Image *image, int channels, bool multiply, Error *e)
{
    Image *out = image_new(image->width, image->height, channels, e);
    for (int64_t i = 0; out && i < (int64_t)image->width * image->height; i++) {
        const float *p = image->pixel + i * image->channels;
        float alpha = image->channels == 4 ? p[3] : 1.0f;
        for (int c = 0; c < channels; c++) {
            out->pixel[i * channels + c] = c == 3 ? alpha : p[c] * (multiply ? alpha : 1.0f);
        }
    }
    return out;
}

static Image *without_alpha(const Image *image, bool premultiplied, Error *e)
{
    return with_channels(image, 3, !premultiplied && image->channels == 4, e);
}

static bool is_opaque(const Image *image)
{
    for (int64_t i = 0; image->channels == 4 && i < (int64_t)image->width * image->height; i++) {
        if (image->pixel[4 * i + 3] != 1.0f) {
            return false;
        }
    }
    return true;
}

// ---- numbers

// Peak signal-to-noise ratio, dB.
static double psnr_of(const Image *stored, double rmse)
{
    double peak = 1.0;
    for (int64_t i = 0; i < (int64_t)stored->width * stored->height * stored->channels; i++) {
        double v = (double)stored->pixel[i];
        peak = isfinite(v) ? fmax(peak, v) : peak;
    }
    return rmse > 0.0 ? 20.0 * log10(peak / rmse) : (double)INFINITY;
}

static bool measure(const Sides *s, double threshold, Comparison *c, Error *e)
{
    if (!image_compare(s->ours, s->stored, fmax(threshold, 0.0), &c->difference, e)) {
        return false;
    }
    c->psnr = psnr_of(s->stored, c->difference.rmse);
    Image *seen = image_flip(s->stored_shown, s->ours_shown, FLIP_PIXELS_PER_DEGREE, e);
    c->perceptual = seen ? image_mean(seen) : 0.0;
    image_free(seen);
    return seen;
}

static void judge(const Limits *limits, Comparison *c)
{
    double rmse = c->difference.rmse, failing = c->difference.failing;
    bool rmse_fails = limits->max_rmse >= 0.0 && !(rmse <= limits->max_rmse);
    bool share_fails = limits->max_failing >= 0.0 && !(failing <= limits->max_failing);
    c->alike = !rmse_fails && !share_fails;
    if (rmse_fails) {
        snprintf(c->message, sizeof c->message, "RMSE %.6g, at most %.6g is allowed", rmse,
                 limits->max_rmse);
    } else if (share_fails) {
        snprintf(c->message, sizeof c->message,
                 "%.6g %% of the pixels differ by more than %.6g, at most %.6g %% are allowed",
                 100.0 * failing, limits->threshold, 100.0 * limits->max_failing);
    }
}

static bool png_of(const Image *image, Png *png, Error *e)
{
    return image_encode_png(image, NULL, &png->bytes, &png->size, e);
}

// heat: NULL if sizes differ.
static bool show(const Sides *s, const Image *heat, Comparison *c, Error *e)
{
    return png_of(s->ours_shown, &c->ours, e) && png_of(s->stored_shown, &c->stored, e) &&
           (!heat || png_of(heat, &c->map, e));
}

static void begin(const Sides *s, Comparison *c)
{
    *c = (Comparison){.width = s->ours->width,
                      .height = s->ours->height,
                      .stored_width = s->stored->width,
                      .stored_height = s->stored->height};
    c->same_size = c->width == c->stored_width && c->height == c->stored_height;
    if (!c->same_size) {
        snprintf(c->message, sizeof c->message, "%d x %d pixels against %d x %d", c->width,
                 c->height, c->stored_width, c->stored_height);
    }
}

bool compare_pictures(const Sides *sides, const Limits *limits, bool pictures,
                      Comparison *comparison, Error *e)
{
    begin(sides, comparison);
    if (!comparison->same_size) {
        return !pictures || show(sides, NULL, comparison, e);
    }
    if (!measure(sides, limits->threshold, comparison, e)) {
        return false;
    }
    judge(limits, comparison);
    if (!pictures) {
        return true;
    }
    Image *heat = heat_of_difference(sides->ours_shown, sides->stored_shown, &comparison->scale, e);
    bool done = heat && show(sides, heat, comparison, e);
    image_free(heat);
    return done;
}

// ---- statistical comparison

static void judge_noise(double alpha, Comparison *c)
{
    static const char *const colors[] = {"red", "green", "blue"};
    const NoiseVerdict *noise = &c->noise;
    const NoiseBlock *worst = &noise->worst;
    c->alike = noise->rejected == 0;
    if (!c->alike) {
        snprintf(c->message, sizeof c->message,
                 "%lld of %lld blocks differ by more than noise (p %.3g, alpha %.3g); %s of the "
                 "%d x %d pixels from (%d, %d): %.6g, stored %.6g, Z %.1f",
                 (long long)noise->rejected, (long long)noise->tests, noise->p, alpha,
                 colors[worst->channel], worst->size, worst->size, worst->x, worst->y, worst->a,
                 worst->b, worst->z);
    }
}

bool compare_noisy(const Sides *sides, const NoisyPicture *ours, const NoisyPicture *stored,
                   double alpha, bool pictures, Comparison *comparison, Error *e)
{
    Comparison *c = comparison;
    begin(sides, c);
    c->statistical = true;
    if (!c->same_size) {
        return !pictures || show(sides, NULL, c, e);
    }
    Image *z = NULL, *heat = NULL;
    bool done = measure(sides, 0.0, c, e) &&
                noise_compare(ours, stored, alpha, &c->noise, pictures ? &z : NULL, e);
    if (done) {
        judge_noise(alpha, c);
    }
    if (done && pictures) {
        heat = heat_of_blocks(z, NOISE_BLOCK, c->width, c->height, &c->scale, e);
        done = heat && show(sides, heat, c, e);
    }
    image_free(z);
    image_free(heat);
    return done;
}

// ---- files

// Gain that maps the log-average luminance of pixels that are not black to middle grey.
static float gain_of(const Image *linear)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < (int64_t)linear->width * linear->height; i++) {
        const float *p = linear->pixel + i * linear->channels;
        float y = luminance_rgb(p);
        if (y > 1e-7f && isfinite(y)) {
            sum += log((double)y);
            count++;
        }
    }
    return count > 0 ? (float)(0.18 / exp(sum / (double)count)) : 1.0f;
}

// Display values of radiance, over black, clipped; *gain is computed if 0.
static Image *shown_of(const Image *image, bool linear, float *gain, Error *e)
{
    Image *shown = without_alpha(image, linear, e);
    if (shown && linear) {
        *gain = *gain > 0.0f ? *gain : gain_of(image);
        for (int64_t i = 0; i < (int64_t)3 * image->width * image->height; i++) {
            float v = shown->pixel[i] * *gain;
            shown->pixel[i] = tone_srgb_from_linear(v > 0.0f ? fminf(v, 1.0f) : 0.0f);
        }
    }
    return shown;
}

// Prepares the values to compare: premultiplied, with alpha only if one of the two is transparent.
static Image *counted(const Image *image, bool linear, bool opaque, Error *e)
{
    return with_channels(image, opaque ? 3 : 4, !linear && !opaque, e);
}

bool compare_images(const Image *ours, const Image *stored, bool linear, const Limits *limits,
                    bool pictures, Comparison *comparison, Error *e)
{
    float gain = 0.0f;
    bool opaque = is_opaque(ours) && is_opaque(stored);
    Image *stored_shown = shown_of(stored, linear, &gain, e);
    Image *ours_shown = stored_shown ? shown_of(ours, linear, &gain, e) : NULL;
    Image *a = ours_shown ? counted(ours, linear, opaque, e) : NULL;
    Image *b = a ? counted(stored, linear, opaque, e) : NULL;
    Sides sides = {a, b, ours_shown, stored_shown};
    bool done = b && compare_pictures(&sides, limits, pictures, comparison, e);
    image_free(stored_shown);
    image_free(ours_shown);
    image_free(a);
    image_free(b);
    return done;
}

bool compare_files(const char *ours, const char *stored, const Limits *limits, bool pictures,
                   Comparison *comparison, Error *e)
{
    bool linear[2] = {false, false};
    *comparison = (Comparison){0};
    Image *a = image_read_color(ours, &linear[0], NULL, e);
    Image *b = a ? image_read_color(stored, &linear[1], NULL, e) : NULL;
    bool done = b;
    if (done && linear[0] != linear[1]) {
        done = error_set(e, ERROR_INPUT,
                         "'%s' holds radiance and '%s' display values; compare two of a kind",
                         linear[0] ? ours : stored, linear[0] ? stored : ours);
    }
    done = done && compare_images(a, b, linear[0], limits, pictures, comparison, e);
    image_free(a);
    image_free(b);
    return done;
}
