// Reads back what a rendering has written: its scene and its film.
#ifndef RAMIFY_SCENE_PICTURE_READ_H
#define RAMIFY_SCENE_PICTURE_READ_H

#include "render/film.h"
#include "scene/scene.h"

// Is the file, by its name, a picture that may hold its scene's settings: .exr or .png?
bool picture_holds_scene(const char *file);

// The settings stored in a picture, as YAML; the caller frees them. *origin (may be NULL): the text
// of the scene file, to be freed too. ERROR_INPUT when it is no picture of ramify's.
char *picture_read_settings(const char *file, char **origin, Error *e);

// The film of an .exr, with all that a rendering needs to go on. ERROR_INPUT when the file cannot
// be read, or when it is no picture of this scene: any setting other than the numbers of samples
// and seconds, and `crop` if wanted, is another; the message names the first.
Film *picture_read_film(const char *file, const Scene *scene, bool any_crop, const Run *run,
                        Error *e);

// What a picture holds of its scene's.
typedef struct PicturePart {
    PixelBox box, crop; // the file's pixels; those that were rendered
    int first, end;     // the samples of each that were to be taken, first .. end - 1
    int samples;        // of these
    bool range;         // not all of them
} PicturePart;

// The same of a picture of any crop and range of samples.
Film *picture_read_part(const char *file, const Scene *scene, PicturePart *part, const Run *run,
                        Error *e);

// The films of several pictures of parts of the scene's picture as one: the sums of all their
// samples, in whatever order they are named. *missing: pixels without samples in any. ERROR_INPUT
// as from picture_read_film, when two files have the same samples of a pixel, and when some samples
// of a pixel are in none. picture_join.c
Film *picture_join(const char *const *files, int count, const Scene *scene, int64_t *missing,
                   const Run *run, Error *e);

#endif
