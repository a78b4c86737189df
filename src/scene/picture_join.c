// Pictures of parts of one picture as one: crops, ranges of samples, and both.
#include "scene/picture_read.h"

#include "base/memory.h"
#include "render/film_merge.h"

#include <stdlib.h>
#include <string.h>

// A whole in the making.
typedef struct Joint {
    const Scene *scene;
    const char *const *file;
    PicturePart *part; // of the files so far
    int count;
    Film *film;
    FilmPlane to[FILM_PLANES], from[FILM_PLANES]; // of the whole and of the file at hand
    size_t bytes[FILM_PLANES];                    // of a pixel
    int32_t *source; // per pixel, the number of the last file with samples + 1
    int32_t *seen;   // per pixel, the first sample of the file from which `object` is
} Joint;

static bool intersect(const PixelBox *a, const PixelBox *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

static bool contains(const PixelBox *box, int x, int y)
{
    return x >= box->x0 && x < box->x1 && y >= box->y0 && y < box->y1;
}

// Ranges of samples must be of the same number, and no two files may hold the same samples.
static bool check_ranges(const Joint *joint, int number, Error *e)
{
    const PicturePart *fresh = &joint->part[number];
    int samples = joint->scene->render.samples;
    if (fresh->range && fresh->samples != samples) {
        return error_set(e, ERROR_INPUT,
                         "'%s' has samples %d to %d of %d a pixel, '%s' is of %d; parts of one "
                         "picture are needed",
                         joint->file[number], fresh->first, fresh->end - 1, fresh->samples,
                         joint->file[0], samples);
    }
    for (int i = 0; i < number && fresh->range; i++) {
        const PicturePart *old = &joint->part[i];
        if (old->range && intersect(&old->crop, &fresh->crop) && old->first < fresh->end &&
            fresh->first < old->end) {
            return error_set(e, ERROR_INPUT,
                             "'%s' has samples %d to %d, '%s' %d to %d of the same pixels; parts "
                             "that do not overlap are needed",
                             joint->file[i], old->first, old->end - 1, joint->file[number],
                             fresh->first, fresh->end - 1);
        }
    }
    return true;
}

// Pixel i of the file at hand, which has no samples in the whole yet.
static void copy_pixel(Joint *joint, int64_t i)
{
    for (int k = 0; k < FILM_PLANES; k++) {
        size_t bytes = joint->bytes[k];
        memcpy((char *)joint->to[k].value + (size_t)i * bytes,
               (const char *)joint->from[k].value + (size_t)i * bytes, bytes);
    }
}

static void add_pixel(Joint *joint, const Film *part, int first, int64_t i)
{
    PixelSum sum, more;
    film_sum(joint->film, i, &sum);
    film_sum(part, i, &more);
    bool sooner = more.hits > 0 && (sum.hits == 0 || first < joint->seen[i]);
    int object = sooner ? more.object : sum.object;
    pixel_sum_join(&sum, &more);
    sum.object = object;
    film_set(joint->film, i, &sum);
    joint->seen[i] = sooner ? first : joint->seen[i];
}

static bool take_pixel(Joint *joint, const Film *film, int number, int x, int y, Error *e)
{
    const PicturePart *part = &joint->part[number];
    int64_t i = (int64_t)y * film->width + x;
    int samples = (int)film->samples[i], other = joint->source[i] - 1;
    if (part->range && contains(&part->crop, x, y) && samples < part->end - part->first) {
        return error_set(e, ERROR_INPUT,
                         "'%s' is not finished: pixel %d, %d has %d of its %d samples; go on with "
                         "it by --resume",
                         joint->file[number], x, y, samples, part->end - part->first);
    }
    if (samples < 1) {
        return true;
    }
    if (other >= 0 && !(part->range && joint->part[other].range)) {
        return error_set(e, ERROR_INPUT,
                         "'%s' and '%s' both have samples for pixel %d, %d; parts that do not "
                         "overlap are needed",
                         joint->file[other], joint->file[number], x, y);
    }
    if (other < 0) {
        copy_pixel(joint, i);
        joint->seen[i] = part->first;
    } else {
        add_pixel(joint, film, part->first, i);
    }
    joint->source[i] = number + 1;
    return true;
}

static bool take_file(Joint *joint, int number, const Run *run, Error *e)
{
    PicturePart *part = &joint->part[number];
    Film *film = picture_read_part(joint->file[number], joint->scene, part, run, e);
    bool done = film && check_ranges(joint, number, e);
    if (done) {
        film_planes(film, joint->from);
    }
    for (int y = done ? part->box.y0 : part->box.y1; done && y < part->box.y1; y++) {
        for (int x = part->box.x0; done && x < part->box.x1; x++) {
            done = take_pixel(joint, film, number, x, y, e);
        }
    }
    film_free(film);
    return done;
}

// Sets the error to the first samples that the pixel lacks.
static bool tell_gap(const Joint *joint, int x, int y, Error *e)
{
    int from = 0, to = joint->scene->render.samples;
    for (bool moved = true; moved;) { // to the end of the ranges that follow each other
        moved = false;
        for (int i = 0; i < joint->count; i++) {
            const PicturePart *part = &joint->part[i];
            if (contains(&part->crop, x, y) && part->first == from) {
                from = part->end;
                moved = true;
            }
        }
    }
    for (int i = 0; i < joint->count; i++) {
        const PicturePart *part = &joint->part[i];
        bool next = contains(&part->crop, x, y) && part->first > from && part->first < to;
        to = next ? part->first : to;
    }
    return error_set(e, ERROR_INPUT,
                     "samples %d to %d of pixel %d, %d are in none of the %d files; add what "
                     "--sample-range %d:%d renders",
                     from, to - 1, x, y, joint->count, from, to);
}

static bool check_complete(const Joint *joint, int64_t *missing, Error *e)
{
    const Film *film = joint->film;
    *missing = 0;
    for (int64_t i = 0; i < (int64_t)film->width * film->height; i++) {
        int source = joint->source[i] - 1;
        *missing += source < 0;
        if (source >= 0 && joint->part[source].range &&
            (int)film->samples[i] < joint->scene->render.samples) {
            return tell_gap(joint, (int)(i % film->width), (int)(i / film->width), e);
        }
    }
    return true;
}

Film *picture_join(const char *const *files, int count, const Scene *scene, int64_t *missing,
                   const Run *run, Error *e)
{
    int64_t pixels = (int64_t)scene->film.width * scene->film.height;
    Joint joint = {.scene = scene, .file = files, .count = count};
    joint.film = film_new(scene->film.width, scene->film.height, e);
    joint.source = joint.film ? memory_alloc_zero(pixels, sizeof *joint.source, e) : NULL;
    joint.seen = joint.source ? memory_alloc_zero(pixels, sizeof *joint.seen, e) : NULL;
    joint.part = joint.seen ? memory_alloc_zero(count, sizeof *joint.part, e) : NULL;
    bool done = joint.part;
    if (done) {
        film_planes(joint.film, joint.to);
        for (int k = 0; k < FILM_PLANES; k++) {
            joint.bytes[k] = strlen(joint.to[k].channels) * sizeof(float);
        }
    }
    for (int i = 0; done && i < count; i++) {
        done = take_file(&joint, i, run, e);
    }
    done = done && check_complete(&joint, missing, e);
    free(joint.source);
    free(joint.seen);
    free(joint.part);
    if (!done) {
        film_free(joint.film);
        return NULL;
    }
    return joint.film;
}
