#include "scene/picture_read.h"

#include "base/file_name.h"
#include "base/memory.h"
#include "image/image.h"
#include "ramify.h"
#include "scene/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool picture_holds_scene(const char *file)
{
    return picture_is_exr(file) || file_name_ends(file, ".png");
}

char *picture_read_settings(const char *file, char **origin, Error *e)
{
    char *settings = image_read_metadata(file, PICTURE_SETTINGS, NULL, e);
    if (settings && origin) {
        *origin = image_read_metadata(file, PICTURE_SCENE, NULL, e);
        if (!*origin) {
            free(settings);
            return NULL;
        }
    }
    return settings;
}

// ---- is it a picture of this scene? ----

// Samples for which the noise of a scene's pictures is laid out.
static int planned(const Scene *scene)
{
    const RenderParams *render = &scene->render;
    return render->planned_samples > 0 ? render->planned_samples : render->samples;
}

// The scene's settings without those that may differ between a picture and its continuation.
static Scene *without_counts(const char *text, const char *name, const Scene *place, bool any_crop,
                             Error *e)
{
    const char *const same[] = {"render.samples=1", "render.planned_samples=0", "render.seconds=0",
                                "film.crop=[0, 0, 1, 1]"};
    return scene_read_text(text, strlen(text), name, place->folder, same, any_crop ? 4 : 3, e);
}

// Sets the error to the first line in which the texts differ.
static bool tell_difference(const char *file, const char *theirs, const char *ours, Error *e)
{
    while (*theirs && *ours) {
        size_t a = strcspn(theirs, "\n"), b = strcspn(ours, "\n");
        if (a != b || memcmp(theirs, ours, a) != 0) {
            break;
        }
        theirs += a + (theirs[a] != '\0');
        ours += b + (ours[b] != '\0');
    }
    theirs += strspn(theirs, " ");
    ours += strspn(ours, " ");
    return error_set(e, ERROR_INPUT,
                     "'%s' is a picture of other settings: it has '%.*s' where the scene has "
                     "'%.*s'; move it away or write to another file",
                     file, (int)strcspn(theirs, "\n"), theirs, (int)strcspn(ours, "\n"), ours);
}

static bool compare_settings(const char *file, const Scene *theirs, const Scene *scene,
                             bool any_crop, Error *e)
{
    if (planned(theirs) != planned(scene)) {
        return error_set(e, ERROR_INPUT,
                         "'%s' has its noise laid out for %d samples, the scene for %d; to add "
                         "samples to a picture use --add-samples",
                         file, planned(theirs), planned(scene));
    }
    Scene *a = without_counts(theirs->resolved, file, scene, any_crop, e);
    Scene *b = a ? without_counts(scene->resolved, scene->file, scene, any_crop, e) : NULL;
    bool same = b && (strcmp(a->resolved, b->resolved) == 0 ||
                      tell_difference(file, a->resolved, b->resolved, e));
    scene_free(a);
    scene_free(b);
    return same;
}

static bool check_version(const char *file, Error *e)
{
    char *text = image_read_metadata(file, PICTURE_VERSION, NULL, e);
    bool same = text && (strcmp(text, RAMIFY_VERSION) == 0 ||
                         error_set(e, ERROR_INPUT,
                                   "'%s' was rendered by ramify %.40s, this is %s; render it anew, "
                                   "or go on with that version",
                                   file, text, RAMIFY_VERSION));
    free(text);
    return same;
}

static bool check_picture(const char *file, const Scene *scene, bool any_crop, Error *e)
{
    char *text = picture_read_settings(file, NULL, e);
    Scene *theirs = text && check_version(file, e)
                        ? scene_read_text(text, strlen(text), file, scene->folder, NULL, 0, e)
                        : NULL;
    bool same = theirs && compare_settings(file, theirs, scene, any_crop, e);
    scene_free(theirs);
    free(text);
    return same;
}

// ---- its film ----

enum { MOST_CHANNELS = 3 * FILM_PLANES, NAME_SIZE = 24 };

// Full names of the channels of all planes: "R", "albedo.R", "depth.Z". Returns their number.
static int channel_names(const FilmPlane plane[FILM_PLANES], char name[MOST_CHANNELS][NAME_SIZE])
{
    int count = 0;
    for (int i = 0; i < FILM_PLANES; i++) {
        for (const char *c = plane[i].channels; *c; c++) {
            snprintf(name[count++], NAME_SIZE, "%s%s%c", plane[i].layer,
                     plane[i].layer[0] ? "." : "", *c);
        }
    }
    return count;
}

static Image *read_planes(const char *file, const FilmPlane plane[FILM_PLANES], int window[6],
                          const Run *run, Error *e)
{
    char text[MOST_CHANNELS][NAME_SIZE];
    const char *name[MOST_CHANNELS];
    int count = channel_names(plane, text);
    for (int i = 0; i < count; i++) {
        name[i] = text[i];
    }
    return image_read_channels(file, name, count, window, run, e);
}

// Copies the image, whose upper left pixel lies at x, y, to planes of this width.
static void copy_planes(const Image *image, int x, int y, int width,
                        const FilmPlane plane[FILM_PLANES])
{
    int64_t first = 0;
    for (int i = 0; i < FILM_PLANES; i++) {
        int64_t channels = (int64_t)strlen(plane[i].channels);
        for (int64_t p = 0; p < (int64_t)image->width * image->height; p++) {
            int64_t to = (y + p / image->width) * width + x + p % image->width;
            memcpy(plane[i].value + to * channels, image->pixel + p * image->channels + first,
                   (size_t)channels * sizeof(float));
        }
        first += channels;
    }
}

// A picture, or a part of one (picture_write_part).
static bool check_window(const char *file, const Film *film, const Image *image,
                         const int window[6], Error *e)
{
    bool whole =
        window[2] == 0 && window[3] == 0 && window[4] == film->width && window[5] == film->height;
    bool within = window[0] >= 0 && window[1] >= 0 && window[0] <= film->width - image->width &&
                  window[1] <= film->height - image->height;
    return (whole && within) ||
           error_set(e, ERROR_INPUT, "'%s' has %d x %d pixels, its settings say %d x %d", file,
                     window[4], window[5], film->width, film->height);
}

// Whole counts of samples are what a rendering relies on.
static bool check_film(const char *file, const Film *film, const PixelBox *box, Error *e)
{
    for (int y = box->y0; y < box->y1; y++) {
        for (int x = box->x0; x < box->x1; x++) {
            int64_t i = (int64_t)y * film->width + x;
            float n = film->samples[i], hits = film->hits[i];
            if (!(n >= 0.0f && n <= 1 << 24 && floorf(n) == n && hits >= 0.0f && hits <= n)) {
                return error_set(e, ERROR_INPUT,
                                 "'%s' is damaged: pixel %d, %d has %g samples of which %g met "
                                 "something; a picture as ramify writes it is needed",
                                 file, x, y, (double)n, (double)hits);
            }
        }
    }
    return true;
}

// *box: the pixels that the file holds.
static Film *read_film(const char *file, const Scene *scene, bool any_crop, PixelBox *box,
                       const Run *run, Error *e)
{
    if (!check_picture(file, scene, any_crop, e)) {
        return NULL;
    }
    FilmPlane plane[FILM_PLANES];
    Film *film = film_new(scene->film.width, scene->film.height, e);
    if (!film) {
        return NULL;
    }
    film_planes(film, plane);
    int window[6];
    Image *image = read_planes(file, plane, window, run, e);
    bool done = image && check_window(file, film, image, window, e);
    if (done) {
        *box = (PixelBox){.x0 = window[0],
                          .y0 = window[1],
                          .x1 = window[0] + image->width,
                          .y1 = window[1] + image->height};
        copy_planes(image, box->x0, box->y0, film->width, plane);
        done = check_film(file, film, box, e);
    }
    image_free(image);
    if (!done) {
        film_free(film);
        return NULL;
    }
    return film;
}

Film *picture_read_film(const char *file, const Scene *scene, bool any_crop, const Run *run,
                        Error *e)
{
    PixelBox box;
    return read_film(file, scene, any_crop, &box, run, e);
}

// ---- joining ----

// Moves the box's pixels with samples into the whole. source: per pixel, the number of the file
// + 1.
static bool take_pixels(Film *whole, const Film *part, const PixelBox *box,
                        const char *const *files, int number, int32_t *source, Error *e)
{
    FilmPlane to[FILM_PLANES], from[FILM_PLANES];
    film_planes(whole, to);
    film_planes(part, from);
    int64_t width = box->x1 - box->x0, height = box->y1 - box->y0;
    for (int64_t p = 0; p < width * height; p++) {
        int64_t i = (box->y0 + p / width) * part->width + box->x0 + p % width;
        if (part->samples[i] < 1.0f) {
            continue;
        }
        if (source[i]) {
            return error_set(e, ERROR_INPUT,
                             "'%s' and '%s' both have samples for pixel %lld, %lld; parts that do "
                             "not overlap are needed",
                             files[source[i] - 1], files[number], (long long)(i % part->width),
                             (long long)(i / part->width));
        }
        source[i] = number + 1;
        for (int k = 0; k < FILM_PLANES; k++) {
            int64_t channels = (int64_t)strlen(to[k].channels);
            memcpy(to[k].value + i * channels, from[k].value + i * channels,
                   (size_t)channels * sizeof(float));
        }
    }
    return true;
}

Film *picture_join(const char *const *files, int count, const Scene *scene, int64_t *missing,
                   const Run *run, Error *e)
{
    int64_t pixels = (int64_t)scene->film.width * scene->film.height;
    Film *whole = film_new(scene->film.width, scene->film.height, e);
    int32_t *source = whole ? memory_alloc_zero(pixels, sizeof *source, e) : NULL;
    bool done = source;
    for (int i = 0; done && i < count; i++) {
        PixelBox box;
        Film *part = read_film(files[i], scene, true, &box, run, e);
        done = part && take_pixels(whole, part, &box, files, i, source, e);
        film_free(part);
    }
    *missing = 0;
    for (int64_t i = 0; done && i < pixels; i++) {
        *missing += !source[i];
    }
    free(source);
    if (!done) {
        film_free(whole);
        return NULL;
    }
    return whole;
}
