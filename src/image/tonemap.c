#include "image/tonemap.h"

#include "base/color.h"
#include "base/memory.h"
#include "image/color_matrix.h"
#include "image/lens.h"
#include "image/tone_curve.h"

#include <math.h>
#include <stdlib.h>

ToneParams tone_params_default(void)
{
    return (ToneParams){.view = VIEW_AGX,
                        .look = AGX_MEDIUM_HIGH_CONTRAST,
                        .contrast = 1.0f,
                        .saturation = 1.0f,
                        .white_balance = 6500.0f,
                        .bloom = 0.03f,
                        .vignette = 0.15f};
}

static float gain_of(const Image *image, const Image *excess)
{
    double sum = 0.0, weight = 0.0;
    int64_t count = (int64_t)image->width * image->height;
    for (int64_t i = 0; i < count; i++) {
        const float *p = image->pixel + i * image->channels;
        float cover = image->channels == 4 ? p[3] : 1.0f;
        float y = luminance_rgb(p) + (excess ? luminance_rgb(excess->pixel + 3 * i) : 0.0f);
        if (cover > 0.0f && y > 1e-7f && isfinite(y)) {
            sum += (double)cover * log((double)(y / cover));
            weight += (double)cover;
        }
    }
    return weight > 0.0 ? (float)(0.18 / exp(sum / weight)) : 1.0f;
}

float tone_auto_gain(const Image *image)
{
    return gain_of(image, NULL);
}

float tone_gain(const Image *image, const Image *excess, const ToneParams *params)
{
    return exp2f(params->exposure) * (params->auto_exposure ? gain_of(image, excess) : 1.0f);
}

// Converts to linear, straight (not premultiplied), finite, exposed and white-balanced values.
static void prepare(Image *out, const Image *image, float gain, float white_balance)
{
    float balance[3][3];
    tone_white_balance(white_balance, balance);
    int64_t count = (int64_t)image->width * image->height;
    for (int64_t i = 0; i < count; i++) {
        const float *p = image->pixel + i * image->channels;
        float *q = out->pixel + i * image->channels;
        float value[3];
        for (int c = 0; c < 3; c++) {
            value[c] = p[c] > 0.0f ? fminf(p[c] * gain, 1e6f) : 0.0f;
        }
        color_matrix_apply(balance, value, q);
        for (int c = 0; c < 3; c++) {
            q[c] = fmaxf(0.0f, q[c]);
        }
        if (image->channels == 4) {
            q[3] = clampf(p[3], 0.0f, 1.0f);
        }
    }
}

static bool add_bloom(Image *image, const Image *excess, float gain, const ToneParams *params,
                      Error *e)
{
    Image *light = excess ? image_new(excess->width, excess->height, 3, e) : NULL;
    if (excess && !light) {
        return false;
    }
    if (light) {
        prepare(light, excess, gain, params->white_balance);
    }
    bool done = lens_bloom(image, light, fminf(params->bloom, 1.0f), e);
    image_free(light);
    return done;
}

typedef struct View {
    const ToneParams *params;
    AgxFit agx;
    ToneCurveFit film;
} View;

static View view_of(const ToneParams *params)
{
    return (View){.params = params,
                  .agx = agx_fit(params->look, params->contrast),
                  .film = tone_curve_fit(params->contrast)};
}

// Linear scene values become linear display values.
static void apply_view(const View *view, float rgb[3])
{
    switch (view->params->view) {
    case VIEW_AGX:
        agx_apply(&view->agx, view->params->saturation, rgb);
        return;
    case VIEW_FILMIC:
        tone_film(&view->film, view->params->saturation, rgb);
        return;
    case VIEW_STANDARD:
        break;
    }
    tone_saturate(view->params->saturation, rgb);
}

// Radiance as the view takes it: darkened toward the corners, not premultiplied.
static void straighten(Image *image, float vignette)
{
#pragma omp parallel for schedule(static)
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            float *p = image->pixel + ((int64_t)y * image->width + x) * image->channels;
            float alpha = image->channels == 4 ? p[3] : 1.0f;
            float scale = alpha > 0.0f ? lens_vignette(image, x, y, vignette) / alpha : 0.0f;
            for (int c = 0; c < 3; c++) {
                p[c] *= scale;
            }
        }
    }
}

static void show(Image *image, const ToneParams *params)
{
    View view = view_of(params);
    int64_t count = (int64_t)image->width * image->height;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < count; i++) {
        float *p = image->pixel + i * image->channels;
        apply_view(&view, p);
        for (int c = 0; c < 3; c++) {
            p[c] = tone_srgb_from_linear(p[c]);
        }
    }
}

static bool show_by_ocio(Image *image, const ToneParams *params, Error *e)
{
    int64_t count = (int64_t)image->width * image->height;
    for (int64_t i = 0; i < count; i++) {
        tone_saturate(params->saturation, image->pixel + i * image->channels);
    }
    if (!ocio_apply(params->color, image, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) { // a view may leave the display's range
        float *p = image->pixel + i * image->channels;
        for (int c = 0; c < 3; c++) {
            p[c] = p[c] > 0.0f ? fminf(p[c], 1.0f) : 0.0f;
        }
    }
    return true;
}

// Exposure, lens and view.
static bool develop(Image *out, const Image *image, const Image *excess, const ToneParams *params,
                    Error *e)
{
    float gain = tone_gain(image, excess, params);
    prepare(out, image, gain, params->white_balance);
    if (params->bloom > 0.0f && !add_bloom(out, excess, gain, params, e)) {
        return false;
    }
    straighten(out, params->vignette);
    if (params->color) {
        return show_by_ocio(out, params, e);
    }
    show(out, params);
    return true;
}

Image *tone_map(const Image *image, const Image *excess, const ToneParams *params, Error *e)
{
    if (image->channels != 3 && image->channels != 4) {
        error_set(e, ERROR_INPUT,
                  "an image with %d channels cannot be tone mapped; 3 or 4 would do",
                  image->channels);
        return NULL;
    }
    Image *out = image_new(image->width, image->height, image->channels, e);
    if (out && !develop(out, image, excess, params, e)) {
        image_free(out);
        return NULL;
    }
    return out;
}
