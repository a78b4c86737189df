// From the film, and from other results that are pictures, to files.
#ifndef RAMIFY_SCENE_PICTURE_H
#define RAMIFY_SCENE_PICTURE_H

#include "base/run.h"
#include "image/image.h"
#include "render/film.h"
#include "scene/scene.h"

// Does the file's name end in .exr, in any case?
bool picture_is_exr(const char *file);

// Whether a picture could be written there, before the work: ERROR_INPUT when its name ends in none
// of .png, .jpg, .jpeg and .exr, ERROR_IO as file_replace_check.
bool picture_check(const char *file, Error *e);

// Display values of a film, as tone_map gives them, to be freed. denoise: take the noise out first.
Image *picture_develop(const Scene *scene, const Film *film, bool denoise, const Run *run,
                       Error *e);

// Develops and writes a .png or .jpg. denoise: take the noise out first.
bool picture_write_display(const char *file, const Scene *scene, const Film *film, bool denoise,
                           const Run *run, Error *e);

// Writes the linear EXR: RGBA, albedo, normal, depth, position, object id, samples; the scene's
// text and every setting as metadata.
bool picture_write_exr(const char *file, const Scene *scene, const Film *film, Error *e);

// One of the two by the file's ending, denoised if the scene says so, with `mark` as metadata under
// PICTURE_MARK: the same mark, the same picture.
#define PICTURE_MARK "ramify:frame"
bool picture_write_marked(const char *file, const Scene *scene, const Film *film, const char *mark,
                          const Run *run, Error *e);

// Stops by which auto_exposure would brighten the film; NAN and e when memory is short.
double picture_metered_stops(const Film *film, Error *e);

// Radiance and alpha of a film: 4 * width * height floats.
void picture_copy_rgba(const Film *film, float *rgba);

// A picture of that kind, as large as the scene's film: .exr as it is, others developed.
bool picture_write_rgba(const char *file, const Scene *scene, const float *rgba, Error *e);

// width * height values, 0..1, as grey .png, .jpg or .exr.
bool picture_write_grey(const char *file, const float *value, int width, int height, Error *e);

#endif
