// The film: the planes that a rendering fills. One entry per pixel, row by row from the top left,
// 32-bit float.
//
// Sums over samples are exact, hence independent of their order: a value of a sample is rounded to
// a whole number of quanta, and a plane of means has planes beside it that hold what rounding took
// from the mean times its number of samples (film_merge.h).
#ifndef RAMIFY_RENDER_FILM_H
#define RAMIFY_RENDER_FILM_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

// The planes of means.
typedef enum FilmMean {
    MEAN_COLOR,
    MEAN_LIGHT,
    MEAN_SKY,
    MEAN_POSITION,
    MEAN_DEPTH,
    MEAN_ALBEDO, // from here on values are within -1 .. 1
    MEAN_NORMAL,
    MEAN_ALPHA,
    MEAN_LIGHT_SHARE,
    MEAN_SKY_SHARE,
    MEAN_ALBEDO_SQUARE,
    MEAN_BLUR,
    FILM_MEANS
} FilmMean;

enum {
    FILM_RESTS = 2,       // planes beside one of means
    FILM_SQUARE_LIMBS = 5 // of 24 bits
};

typedef struct Film {
    int width, height;
    Vec3 *color;        // mean radiance
    Vec3 *light;        // the part of color by samples that saw a light (SEEN_LIGHT), in focus
    Vec3 *sky;          // by samples that saw the sky, in focus
    float *alpha;       // share of samples that met something (or the visible sky)
    Vec3 *albedo;       // 0..1, of the first surface that is no mirror nor clear glass; 1 for sky,
                        // lamps and veils of haze
    Vec3 *normal;       // its shading normal, world, mean (not unit)
    float *light_share; // share of these samples
    float *sky_share;
    float *albedo_square; // of the albedo's luminance, mean
    float *blur;          // share of samples out of focus by more than a pixel
    float *depth;         // m along the ray, mean over samples that hit; INFINITY where none did
    Vec3 *position;       // m, first hit, mean over samples that hit; 0 where none
    float *object;        // object id + 1 of the first sample that hit; 0 = background
    float *hits;          // samples that met a surface: what depth and position are means over
    float *samples;       // taken so far
    float *variance; // of the pixel's mean luminance, estimated; for adaptive stopping, denoising
    float *mean[FILM_MEANS];             // the planes above by FilmMean
    float *rest[FILM_MEANS][FILM_RESTS]; // quanta, whole numbers, coarse and fine; bounded values
                                         // have no fine ones (NULL)
    float *squares; // sum of squared luminances in quanta: FILM_SQUARE_LIMBS limbs, lowest first
    Vec3 *denoised; // radiance as a denoiser left it; NULL = not denoised since it was rendered
} Film;

// Bytes of a pixel in all planes.
#define FILM_PIXEL_BYTES (7.0 * sizeof(Vec3) + (10.0 + 37.0 + FILM_SQUARE_LIMBS) * sizeof(float))

// Returns NULL with ERROR_MEMORY, before it allocates, when memory is too small.
Film *film_new(int width, int height, Error *e);
void film_free(Film *film); // NULL is fine

// Drops the plane `denoised`, which further samples make obsolete.
void film_drop_denoised(Film *film);

// Forgets the samples of the crop's pixels: a rendering starts anew there.
void film_forget(Film *film, const float crop[4]);

// A plane and its place in files.
typedef struct FilmPlane {
    float *value;                 // row by row, a float for each channel of a pixel; borrowed
    const char *layer, *channels; // "albedo" and "RGB"; layer "" = the picture itself
} FilmPlane;

// All planes but `denoised`: what a rendering can be resumed from.
enum { FILM_PLANES = 34 };
void film_planes(const Film *film, FilmPlane plane[FILM_PLANES]);

// Pixels x0 <= x < x1, y0 <= y < y1.
typedef struct PixelBox {
    int x0, y0, x1, y1;
} PixelBox;

// The pixels of a crop (see FilmParams) of a picture.
PixelBox film_crop_pixels(int width, int height, const float crop[4]);

// Variances of pixel i's mean albedo (of its luminance) and normal (of the vector) where the lens
// blurs it, estimated from its samples. 0 with fewer than two, and in focus, where what differs
// from pixel to pixel is detail as well as noise.
void film_guide_noise(const Film *film, int64_t i, float *albedo, float *normal);

// Has every pixel of the crop a sample? False after a first pass that was cancelled.
bool film_is_complete(const Film *film, const float crop[4]);

#endif
