#include "scene/picture_read.h"

#include "base/file_name.h"
#include "base/memory.h"
#include "image/image.h"
#include "ramify.h"
#include "render/film_merge.h"
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

// The scene's settings without those that may differ between a picture and its continuation.
static Scene *without_counts(const char *text, const char *name, bool any_crop, Error *e)
{
    const char *const same[] = {"render.samples=1",      "render.planned_samples=0",
                                "render.first_sample=0", "render.end_sample=0",
                                "render.seconds=0",      "film.crop=[0, 0, 1, 1]"};
    return scene_read_settings(text, NULL, name, same, any_crop ? 6 : 5, e);
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
    int planned = render_planned(&theirs->render), ours = render_planned(&scene->render);
    if (planned != ours) {
        return error_set(e, ERROR_INPUT,
                         "'%s' has its noise laid out for %d samples, the scene for %d; to add "
                         "samples to a picture use --add-samples",
                         file, planned, ours);
    }
    Scene *a = without_counts(theirs->resolved, file, any_crop, e);
    Scene *b = a ? without_counts(scene->resolved, scene->file, any_crop, e) : NULL;
    bool same = b && (strcmp(a->resolved, b->resolved) == 0 ||
                      tell_difference(file, a->resolved, b->resolved, e));
    scene_free(a);
    scene_free(b);
    return same;
}

static bool check_version(const char *file, Error *e)
{
    char *text = image_read_metadata(file, PICTURE_FILM, NULL, NULL);
    bool same = (text && strcmp(text, PICTURE_FILM_LAYOUT) == 0) ||
                error_set(e, ERROR_INPUT,
                          "'%s' holds a film of %.40s, this program's is of %s; render it anew, or "
                          "go on with that version",
                          file, text ? text : "an older ramify", PICTURE_FILM_LAYOUT);
    free(text);
    return same;
}

// A rendering that goes on takes the same samples; of a picture that is complete, others too.
static bool check_range(const char *file, const PicturePart *part, const Scene *scene, Error *e)
{
    const RenderParams *ours = &scene->render;
    bool same = part->first == ours->first_sample && part->end == render_end(ours);
    return (!part->range && !render_is_range(ours)) || same ||
           error_set(e, ERROR_INPUT,
                     "'%s' has samples %d to %d of each pixel, the scene takes %d to %d; move it "
                     "away, write to another file, or join both by ramify merge",
                     file, part->first, part->end - 1, ours->first_sample, render_end(ours) - 1);
}

static bool check_picture(const char *file, const Scene *scene, bool any_crop, PicturePart *part,
                          Error *e)
{
    char *text = picture_read_settings(file, NULL, e);
    Scene *theirs =
        text && check_version(file, e) ? scene_read_settings(text, NULL, file, NULL, 0, e) : NULL;
    bool same = theirs && compare_settings(file, theirs, scene, any_crop, e);
    if (same) {
        const FilmParams *film = &theirs->film;
        *part = (PicturePart){.crop = film_crop_pixels(film->width, film->height, film->crop),
                              .first = theirs->render.first_sample,
                              .end = render_end(&theirs->render),
                              .samples = theirs->render.samples,
                              .range = render_is_range(&theirs->render)};
        same = any_crop || check_range(file, part, scene, e);
    }
    scene_free(theirs);
    free(text);
    return same;
}

// ---- its film ----

enum { MOST_CHANNELS = 5 * FILM_PLANES, NAME_SIZE = 24 };

// Bytes of a film that are read at once: what its planes take beside itself meanwhile, and less
// than an image may have. A film of 3840 x 2160 pixels takes 2.3 GB.
#define MOST_BYTES (INT64_C(1) << 29)

// Full names of the channels of planes: "R", "albedo.R", "depth.Z". Returns their number.
static int channel_names(const FilmPlane *plane, int planes, char name[MOST_CHANNELS][NAME_SIZE])
{
    int count = 0;
    for (int i = 0; i < planes; i++) {
        for (const char *c = plane[i].channels; *c; c++) {
            snprintf(name[count++], NAME_SIZE, "%s%s%c", plane[i].layer,
                     plane[i].layer[0] ? "." : "", *c);
        }
    }
    return count;
}

static Image *read_planes(const char *file, const FilmPlane *plane, int planes, int window[6],
                          const Run *run, Error *e)
{
    char text[MOST_CHANNELS][NAME_SIZE];
    const char *name[MOST_CHANNELS];
    int count = channel_names(plane, planes, text);
    for (int i = 0; i < count; i++) {
        name[i] = text[i];
    }
    return image_read_channels(file, name, count, window, run, e);
}

// Copies the image, whose upper left pixel lies at x, y, to planes of this width.
static void copy_planes(const Image *image, int x, int y, int width, const FilmPlane *plane,
                        int planes)
{
    int64_t first = 0;
    for (int i = 0; i < planes; i++) {
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

// A rendering that was killed in its first pass leaves the first look where no sample has been.
static void forget_first_look(Film *film, const PixelBox *box)
{
    const PixelSum nothing = {.samples = 0};
    for (int y = box->y0; y < box->y1; y++) {
        for (int x = box->x0; x < box->x1; x++) {
            int64_t i = (int64_t)y * film->width + x;
            if (film->samples[i] == 0.0f) {
                film_set(film, i, &nothing);
            }
        }
    }
}

// Values that sums can be made of again are what a rendering relies on.
static bool check_film(const char *file, const Film *film, const PicturePart *part, Error *e)
{
    for (int y = part->box.y0; y < part->box.y1; y++) {
        for (int x = part->box.x0; x < part->box.x1; x++) {
            int64_t i = (int64_t)y * film->width + x;
            if (!film_is_sound(film, i)) {
                return error_set(e, ERROR_INPUT,
                                 "'%s' is damaged: pixel %d, %d has %g samples of which %g met "
                                 "something, or values that are no sums of so many; a picture as "
                                 "ramify writes it is needed",
                                 file, x, y, (double)film->samples[i], (double)film->hits[i]);
            }
            if (part->range && (int)film->samples[i] > part->end - part->first) {
                return error_set(e, ERROR_INPUT,
                                 "'%s' is damaged: pixel %d, %d has %g samples, its settings say "
                                 "%d to %d",
                                 file, x, y, (double)film->samples[i], part->first, part->end - 1);
            }
        }
    }
    return true;
}

// How many of the planes are read at once; at least one.
static int planes_at_once(const Film *film, const FilmPlane *plane, int planes)
{
    int64_t channel = (int64_t)film->width * film->height * (int64_t)sizeof(float);
    int64_t bytes = channel * (int64_t)strlen(plane[0].channels);
    int count = 1;
    while (count < planes &&
           (bytes += channel * (int64_t)strlen(plane[count].channels)) <= MOST_BYTES) {
        count++;
    }
    return count;
}

// Fills some planes of the film, and *box with the pixels that the file has.
static bool read_some(const char *file, Film *film, const FilmPlane *plane, int planes,
                      PixelBox *box, const Run *run, Error *e)
{
    int window[6];
    Image *image = read_planes(file, plane, planes, window, run, e);
    bool done = image && check_window(file, film, image, window, e);
    if (done) {
        *box = (PixelBox){.x0 = window[0],
                          .y0 = window[1],
                          .x1 = window[0] + image->width,
                          .y1 = window[1] + image->height};
        copy_planes(image, window[0], window[1], film->width, plane, planes);
    }
    image_free(image);
    return done;
}

static Film *read_film(const char *file, const Scene *scene, bool any_crop, PicturePart *part,
                       const Run *run, Error *e)
{
    if (!check_picture(file, scene, any_crop, part, e)) {
        return NULL;
    }
    FilmPlane plane[FILM_PLANES];
    Film *film = film_new(scene->film.width, scene->film.height, e);
    if (!film) {
        return NULL;
    }
    film_planes(film, plane);
    bool done = true;
    for (int first = 0, count; done && first < FILM_PLANES; first += count) {
        count = planes_at_once(film, plane + first, FILM_PLANES - first);
        done = read_some(file, film, plane + first, count, &part->box, run, e);
    }
    if (done) {
        forget_first_look(film, &part->box);
        done = check_film(file, film, part, e);
    }
    if (!done) {
        film_free(film);
        return NULL;
    }
    return film;
}

Film *picture_read_film(const char *file, const Scene *scene, bool any_crop, const Run *run,
                        Error *e)
{
    PicturePart part;
    return read_film(file, scene, any_crop, &part, run, e);
}

Film *picture_read_part(const char *file, const Scene *scene, PicturePart *part, const Run *run,
                        Error *e)
{
    return read_film(file, scene, true, part, run, e);
}
