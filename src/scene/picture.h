// Writes the film, and other results that are images, to files.
#ifndef RAMIFY_SCENE_PICTURE_H
#define RAMIFY_SCENE_PICTURE_H

#include "base/run.h"
#include "image/image.h"
#include "render/film.h"
#include "scene/scene.h"

// Does the file name end in .exr (upper or lower case)?
bool picture_is_exr(const char *file);

// Checks before rendering whether an image could be written there: ERROR_INPUT when its name does
// not end in .png, .jpg, .jpeg or .exr, ERROR_IO as from file_replace_check, errors of
// image_files_check.
bool picture_check(const char *file, Error *e);

// Finds the denoiser of the scene's pictures (film.denoiser): *oidn becomes the version of Open
// Image Denoise, or 0 for ours. ERROR_INPUT at the key when the scene wants Open Image Denoise and
// its library cannot be loaded. run: for a warning; may be NULL.
bool picture_find_denoiser(const Scene *scene, int *oidn, const Run *run, Error *e);

// Sets film->denoised, which the functions below then use in place of a denoising of their own.
// Leaves it NULL if a pixel of the crop has no sample, because a first pass was cancelled.
bool picture_denoise(const Scene *scene, Film *film, const Run *run, Error *e);

// Is the view of film.color one of its configuration? Errors as from ocio_check, at the key. True
// without film.color.
bool picture_check_color(const Scene *scene, Error *e);

// The film's radiance and alpha with its highlights compressed (image/highlights.h), and in *excess
// what that took away. Free both, also after a failure, which gives NULL.
Image *picture_compressed(const Scene *scene, const Film *film, Image **excess, Error *e);

// The noise of the developed picture before denoising, as a share of white: the standard error of
// its display values (0 = black, 1 = white), mean over the three channels and all pixels of the
// crop with at least two samples; NAN if there are none. A pixel's error is that of its radiance,
// sqrt(film->variance), as exposure, white balance, vignette and view show it, without bloom. It is
// that of independent samples: those of the sampler spread less, except where few samples have met
// what is bright and rare, whose variance is not known yet.
bool picture_noise(const Scene *scene, const Film *film, double *noise, Error *e);

// Display values of a film, as from tone_map; free them. denoise: denoise first, unless a pixel of
// the crop has no sample.
Image *picture_develop(const Scene *scene, const Film *film, bool denoise, const Run *run,
                       Error *e);

// Develops, makes smaller (film.downsample) and writes a .png (of film.png_depth bits) or .jpg.
// denoise: as for picture_develop.
bool picture_write_display(const char *file, const Scene *scene, const Film *film, bool denoise,
                           const Run *run, Error *e);

// Writes the linear EXR: RGBA, albedo, normal, depth, position, object id, samples; the scene's
// text and every setting as metadata. denoise: add a layer `denoised`, on the same condition.
bool picture_write_exr(const char *file, const Scene *scene, const Film *film, bool denoise,
                       const Run *run, Error *e);

// Writes either format, selected by the file extension and denoised if the scene asks for it, with
// `mark` as metadata under PICTURE_MARK: equal marks mean equal images.
#define PICTURE_MARK "ramify:frame"
#define PICTURE_VERSION "ramify:version" // key of the program's version
#define PICTURE_FILM "ramify:film"       // key of the layout of the film's planes in an .exr
#define PICTURE_FILM_LAYOUT ("ramify " RAMIFY_VERSION ", exact sums, albedo_square and blur")
#define PICTURE_SCENE "ramify:scene"       // key of the text of the scene file
#define PICTURE_SETTINGS "ramify:settings" // key of the scene as YAML with every setting
bool picture_write_marked(const char *file, const Scene *scene, const Film *film, const char *mark,
                          const Run *run, Error *e);

// Writes the linear EXR of the pixels of the scene's crop alone: a part, from which
// picture_read_film and picture_join read. Never denoised. mark: as above, or NULL.
bool picture_write_part(const char *file, const Scene *scene, const Film *film, const char *mark,
                        Error *e);

// Stops by which auto_exposure would brighten the film; NAN and e when out of memory.
double picture_metered_stops(const Film *film, Error *e);

// Radiance and alpha of a film: 4 * width * height floats.
void picture_copy_rgba(const Film *film, float *rgba);

// Writes an image of that kind, of the size of the scene's film: .exr unchanged, others developed
// and made smaller.
bool picture_write_rgba(const char *file, const Scene *scene, const float *rgba, Error *e);

// width * height values, 0..1, as grey .png, .jpg or .exr.
bool picture_write_grey(const char *file, const float *value, int width, int height, Error *e);

#endif
