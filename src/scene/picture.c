// Writes pictures: developed, and with all layers.
#include "scene/picture_parts.h"

#include "base/file_name.h"
#include "base/file_replace.h"
#include "base/memory.h"
#include "image/downsample.h"
#include "image/grain.h"
#include "image/sharpen.h"
#include "ramify.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    bool clean = denoise && picture_can_denoise(scene, film);
    Vec3 *own = clean && !film->denoised ? picture_denoised(scene, film, run, e) : NULL;
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
