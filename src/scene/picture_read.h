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

// The films of several pictures of parts of the scene's picture as one: each pixel from the file
// that has samples for it. *missing: pixels without samples in any. ERROR_INPUT as from
// picture_read_film, and when two files have samples for the same pixel.
Film *picture_join(const char *const *files, int count, const Scene *scene, int64_t *missing,
                   const Run *run, Error *e);

#endif
