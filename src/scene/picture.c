#include "scene/picture.h"

#include "base/color.h"
#include "base/file_name.h"
#include "base/file_replace.h"
#include "base/memory.h"
#include "image/denoise.h"
#include "image/downsample.h"
#include "image/grain.h"
#include "image/highlights.h"
#include "image/oidn.h"
#include "image/sharpen.h"
#include "ramify.h"
#include "scene/place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DENOISE_STRENGTH 1.0f

bool picture_is_exr(const char *file)
{
    return file_name_ends(file, ".exr");
}

// Checks the file name before the image is developed.
static bool check_ending(const char *file, Error *e)
{
    return picture_is_exr(file) || file_name_ends(file, ".png") || file_name_ends(file, ".jpg") ||
           file_name_ends(file, ".jpeg") ||
           error_set(e, ERROR_INPUT,
                     "'%s' cannot be written: a picture's name must end in .png, .jpg or .exr",
                     file);
}

bool picture_check(const char *file, Error *e)
{
    return check_ending(file, e) && file_replace_check(file, e) && image_files_check(e);
}

// ---- films ----

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

// "key\0value\0 ... \0" on the heap. mark: NULL = none; put first, so that it always fits in a
// JPEG.
static char *make_metadata(const Scene *scene, const char *mark, Error *e)
{
    const char *const pairs[] = {
        PICTURE_MARK,        mark,          PICTURE_VERSION, RAMIFY_VERSION,   PICTURE_FILM,
        PICTURE_FILM_LAYOUT, PICTURE_SCENE, scene->origin,   PICTURE_SETTINGS, scene->resolved};
    enum { COUNT = sizeof pairs / sizeof pairs[0] };
    int first = mark ? 0 : 2;
    int64_t length = 1;
    for (int i = first; i < COUNT; i++) {
        length += (int64_t)strlen(pairs[i]) + 1;
    }
    char *metadata = memory_alloc_zero(length, 1, e);
    char *at = metadata;
    for (int i = first; metadata && i < COUNT; i++) {
        size_t size = strlen(pairs[i]) + 1;
        memcpy(at, pairs[i], size);
        at += size;
    }
    return metadata;
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

static bool can_denoise(const Scene *scene, const Film *film)
{
    return film->denoised || film_is_complete(film, scene->film.crop);
}

// The film's radiance without noise; free() it. Highlights are compressed while it is denoised,
// because no denoiser keeps their edges; what that takes away is added again.
static Vec3 *denoised_plane(const Scene *scene, const Film *film, const Run *run, Error *e)
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
    if (can_denoise(scene, film)) {
        film->denoised = denoised_plane(scene, film, run, e);
        return film->denoised;
    }
    return true;
}

// Replaces the radiance of an image with compressed highlights by the denoised one.
static bool put_denoised(Image *beauty, const Image *excess, const Scene *scene, const Film *film,
                         const Run *run, Error *e)
{
    Vec3 *own = film->denoised ? NULL : denoised_plane(scene, film, run, e);
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
    bool done = beauty && (!denoise || !can_denoise(scene, film) ||
                           put_denoised(beauty, excess, scene, film, run, e));
    Image *display = done ? tone_map(beauty, excess, &scene->tone, e) : NULL;
    image_free(beauty);
    image_free(excess);
    return display;
}

static bool replace(Image **image, Image *next)
{
    image_free(*image);
    *image = next;
    return next;
}

// What comes after the view. image: of the film's size; becomes what is shown, NULL on failure.
static bool finish(const Scene *scene, Image **image, Error *e)
{
    return (scene->downsample <= 1 ||
            replace(image, image_downsample(*image, scene->downsample, e))) &&
           (scene->sharpen <= 0.0f || replace(image, image_sharpen(*image, scene->sharpen, e))) &&
           (scene->grain <= 0.0f ||
            replace(image, image_grain(*image, scene->grain, scene->render.noise_seed, e)));
}

// display: of the film's size; becomes what is shown.
static bool write_developed(const char *file, const Scene *scene, Image **display,
                            const char *metadata, Error *e)
{
    bool deep = scene->png_depth == 16 && file_name_ends(file, ".png");
    return finish(scene, display, e) && (deep ? image_write_display16(file, *display, metadata, e)
                                              : image_write_display(file, *display, metadata, e));
}

static bool write_display(const char *file, const Scene *scene, const Film *film, bool denoise,
                          const char *mark, const Run *run, Error *e)
{
    Image *display = check_ending(file, e) ? picture_develop(scene, film, denoise, run, e) : NULL;
    char *metadata = display ? make_metadata(scene, mark, e) : NULL;
    bool done = metadata && write_developed(file, scene, &display, metadata, e);
    free(metadata);
    image_free(display);
    return done;
}

bool picture_write_display(const char *file, const Scene *scene, const Film *film, bool denoise,
                           const Run *run, Error *e)
{
    return write_display(file, scene, film, denoise, NULL, run, e);
}

// A plane as an image, which borrows its values.
static Image view_of(const Film *film, const float *value, int channels)
{
    return (Image){film->width, film->height, channels, (float *)(uintptr_t)value};
}

// window: see image_write_exr_window.
static bool write_layers(const char *file, const Scene *scene, const Film *film,
                         const Vec3 *denoised, const int window[4], const char *mark, Error *e)
{
    FilmPlane plane[FILM_PLANES];
    Image image[FILM_PLANES + 1];
    ImageLayer layers[FILM_PLANES + 1];
    int count = 0;
    film_planes(film, plane);
    for (int i = 0; i < FILM_PLANES; i++, count++) {
        image[count] = view_of(film, plane[i].value, (int)strlen(plane[i].channels));
        layers[count] = (ImageLayer){plane[i].layer, plane[i].channels, &image[count]};
    }
    if (denoised) {
        image[count] = view_of(film, &denoised->x, 3);
        layers[count] = (ImageLayer){"denoised", "RGB", &image[count]};
        count++;
    }
    char *metadata = make_metadata(scene, mark, e);
    bool done = metadata && image_write_exr_window(file, layers, count, window, metadata, e);
    free(metadata);
    return done;
}

static bool write_exr(const char *file, const Scene *scene, const Film *film, bool denoise,
                      const char *mark, const Run *run, Error *e)
{
    bool clean = denoise && can_denoise(scene, film);
    Vec3 *own = clean && !film->denoised ? denoised_plane(scene, film, run, e) : NULL;
    const Vec3 *denoised = own ? own : film->denoised;
    const int whole[4] = {0, 0, film->width, film->height};
    bool done = (!clean || denoised) &&
                write_layers(file, scene, film, clean ? denoised : NULL, whole, mark, e);
    free(own);
    return done;
}

bool picture_write_exr(const char *file, const Scene *scene, const Film *film, bool denoise,
                       const Run *run, Error *e)
{
    return write_exr(file, scene, film, denoise, NULL, run, e);
}

bool picture_write_part(const char *file, const Scene *scene, const Film *film, const char *mark,
                        Error *e)
{
    PixelBox box = film_crop_pixels(film->width, film->height, scene->film.crop);
    const int window[4] = {box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0};
    return write_layers(file, scene, film, NULL, window, mark, e);
}

bool picture_write_marked(const char *file, const Scene *scene, const Film *film, const char *mark,
                          const Run *run, Error *e)
{
    return picture_is_exr(file) ? write_exr(file, scene, film, scene->denoise, mark, run, e)
                                : write_display(file, scene, film, scene->denoise, mark, run, e);
}

double picture_metered_stops(const Film *film, Error *e)
{
    Image *image = beauty_image(film, e);
    double stops = image ? log2((double)tone_auto_gain(image)) : (double)NAN;
    image_free(image);
    return stops;
}

bool picture_write_rgba(const char *file, const Scene *scene, const float *rgba, Error *e)
{
    int width = scene->film.width, height = scene->film.height;
    Image *image = check_ending(file, e) ? image_new(width, height, 4, e) : NULL;
    if (!image) {
        return false;
    }
    memcpy(image->pixel, rgba, sizeof(float) * 4 * (size_t)width * (size_t)height);
    bool done;
    if (picture_is_exr(file)) {
        ImageLayer layer = {"", "RGBA", image};
        done = image_write_exr(file, &layer, 1, NULL, e);
    } else {
        Image *display = tone_map(image, NULL, &scene->tone, e);
        done = display && write_developed(file, scene, &display, NULL, e);
        image_free(display);
    }
    image_free(image);
    return done;
}

// ---- other pictures ----

bool picture_write_grey(const char *file, const float *value, int width, int height, Error *e)
{
    Image *image = check_ending(file, e) ? image_new(width, height, 3, e) : NULL;
    if (!image) {
        return false;
    }
    for (int64_t i = 0; i < (int64_t)width * height * 3; i++) {
        image->pixel[i] = value[i / 3];
    }
    ImageLayer layer = {"", "RGB", image};
    bool done = picture_is_exr(file) ? image_write_exr(file, &layer, 1, NULL, e)
                                     : image_write_display(file, image, NULL, e);
    image_free(image);
    return done;
}
