// The film as a picture: denoised, its highlights compressed, in display values.
#include "scene/picture_parts.h"

#include "base/color.h"
#include "base/memory.h"
#include "image/denoise.h"
#include "image/highlights.h"
#include "image/oidn.h"
#include "scene/place.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DENOISE_STRENGTH 1.0f

void picture_copy_rgba(const Film *film, float *rgba)
{
    for (int64_t i = 0; i < (int64_t)film->width * film->height; i++) {
        float pixel[4] = {film->color[i].x, film->color[i].y, film->color[i].z, film->alpha[i]};
        memcpy(rgba + 4 * i, pixel, sizeof pixel);
    }
}

bool picture_check_color(const Scene *scene, Error *e)
{
    return !scene->tone.color || ocio_check(scene->tone.color, e) ||
           scene_fail_at(scene, "film.color", e);
}

static Image *beauty_image(const Film *film, Error *e)
{
    Image *image = image_new(film->width, film->height, 4, e);
    if (image) {
        picture_copy_rgba(film, image->pixel);
    }
    return image;
}

// Copies one of the film's planes.
static Image *plane_image(const Film *film, const void *plane, int channels, Error *e)
{
    Image *image = image_new(film->width, film->height, channels, e);
    if (image) {
        memcpy(image->pixel, plane,
               sizeof(float) * (size_t)channels * (size_t)film->width * (size_t)film->height);
    }
    return image;
}

bool picture_find_denoiser(const Scene *scene, int *oidn, const Run *run, Error *e)
{
    Error why = {0};
    *oidn = scene->denoiser == DENOISER_OWN ? 0 : image_oidn_version(&why);
    if (*oidn > 0 || scene->denoiser == DENOISER_OWN) {
        return true;
    }
    if (scene->denoiser == DENOISER_AUTO) {
        if (run && getenv(OIDN_VARIABLE)) { // the user expects a library
            run_warn(run, "%s; ramify's own denoiser is used", why.message);
        }
        return true;
    }
    error_prefix(&why, "film.denoiser is oidn, but ");
    error_key(&why, "film.denoiser");
    scene_fail_at(scene, "", &why);
    if (e) {
        *e = why;
    }
    return false;
}

// Variance of the means after highlights were compressed: of the same relative size.
static Image *variance_image(const Film *film, const Image *beauty, Error *e)
{
    Image *image = plane_image(film, film->variance, 1, e);
    for (int64_t i = 0; image && i < (int64_t)film->width * film->height; i++) {
        float before = luminance(film->color[i]), after = luminance_rgb(beauty->pixel + 4 * i);
        if (after < before) {
            image->pixel[i] *= after / before * (after / before);
        }
    }
    return image;
}

static Image *guide_variance_image(const Film *film, Error *e)
{
    Image *image = image_new(film->width, film->height, 2, e);
    for (int64_t i = 0; image && i < (int64_t)film->width * film->height; i++) {
        film_guide_noise(film, i, &image->pixel[2 * i], &image->pixel[2 * i + 1]);
    }
    return image;
}

static Image *denoised_image(const Scene *scene, const Image *beauty, const Film *film,
                             const Run *run, Error *e)
{
    int oidn;
    if (!picture_find_denoiser(scene, &oidn, run, e)) {
        return NULL;
    }
    Image *guides[] = {
        plane_image(film, film->albedo, 3, e),  plane_image(film, film->normal, 3, e),
        plane_image(film, film->depth, 1, e),   variance_image(film, beauty, e),
        plane_image(film, film->samples, 1, e), guide_variance_image(film, e)};
    enum { GUIDES = sizeof guides / sizeof guides[0] };
    bool made = true;
    for (int i = 0; i < GUIDES; i++) {
        made = made && guides[i];
    }
    const DenoiseInput input = {beauty,    guides[0], guides[1], guides[2],
                                guides[3], guides[4], guides[5]};
    Image *clean = NULL;
    if (made) {
        clean = oidn ? image_denoise_oidn(beauty, guides[0], guides[1], run, e)
                     : image_denoise(&input, DENOISE_STRENGTH, run, e);
    }
    for (int i = 0; i < GUIDES; i++) {
        image_free(guides[i]);
    }
    return clean;
}

Image *picture_compressed(const Scene *scene, const Film *film, Image **excess, Error *e)
{
    *excess = image_new(film->width, film->height, 3, e);
    Image *beauty = *excess ? beauty_image(film, e) : NULL;
    if (beauty) {
        const HighlightParts parts = {.light = film->light,
                                      .sky = film->sky,
                                      .light_share = film->light_share,
                                      .sky_share = film->sky_share};
        highlights_compress(beauty, *excess, &parts, &scene->tone);
    }
    return beauty;
}

bool picture_can_denoise(const Scene *scene, const Film *film)
{
    return film->denoised || film_is_complete(film, scene->film.crop);
}

// Highlights are compressed while the film is denoised, because no denoiser keeps their edges; what
// that takes away is added again.
Vec3 *picture_denoised(const Scene *scene, const Film *film, const Run *run, Error *e)
{
    int64_t count = (int64_t)film->width * film->height;
    Image *excess, *beauty = picture_compressed(scene, film, &excess, e);
    Image *clean = beauty ? denoised_image(scene, beauty, film, run, e) : NULL;
    Vec3 *plane = clean ? memory_alloc(count, sizeof *plane, e) : NULL;
    for (int64_t i = 0; plane && i < count; i++) {
        const float *p = clean->pixel + 4 * i, *lost = excess->pixel + 3 * i;
        plane[i] = vec3(fmaxf(0.0f, p[0] + lost[0]), fmaxf(0.0f, p[1] + lost[1]),
                        fmaxf(0.0f, p[2] + lost[2]));
    }
    image_free(beauty);
    image_free(excess);
    image_free(clean);
    return plane;
}

bool picture_denoise(const Scene *scene, Film *film, const Run *run, Error *e)
{
    film_drop_denoised(film);
    if (picture_can_denoise(scene, film)) {
        film->denoised = picture_denoised(scene, film, run, e);
        return film->denoised;
    }
    return true;
}

// Replaces the radiance of an image with compressed highlights by the denoised one.
static bool put_denoised(Image *beauty, const Image *excess, const Scene *scene, const Film *film,
                         const Run *run, Error *e)
{
    Vec3 *own = film->denoised ? NULL : picture_denoised(scene, film, run, e);
    const Vec3 *plane = film->denoised ? film->denoised : own;
    for (int64_t i = 0; plane && i < (int64_t)film->width * film->height; i++) {
        float *p = beauty->pixel + 4 * i;
        const float *lost = excess->pixel + 3 * i;
        p[0] = plane[i].x - lost[0];
        p[1] = plane[i].y - lost[1];
        p[2] = plane[i].z - lost[2];
    }
    free(own);
    return plane;
}

Image *picture_develop(const Scene *scene, const Film *film, bool denoise, const Run *run, Error *e)
{
    Image *excess, *beauty = picture_compressed(scene, film, &excess, e);
    bool done = beauty && (!denoise || !picture_can_denoise(scene, film) ||
                           put_denoised(beauty, excess, scene, film, run, e));
    Image *display = done ? tone_map(beauty, excess, &scene->tone, e) : NULL;
    image_free(beauty);
    image_free(excess);
    return display;
}

double picture_metered_stops(const Film *film, Error *e)
{
    Image *image = beauty_image(film, e);
    double stops = image ? log2((double)tone_auto_gain(image)) : (double)NAN;
    image_free(image);
    return stops;
}
