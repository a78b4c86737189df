#include "render/film.h"

#include "base/color.h"
#include "base/memory.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Layer and channels of the planes of means in files, and the layers of their rests.
static const struct {
    const char *layer, *channels, *rest[FILM_RESTS];
} MEANS[FILM_MEANS] = {
    [MEAN_COLOR] = {"", "RGB", {"color_rest", "color_rest2"}},
    [MEAN_LIGHT] = {"light", "RGB", {"light_rest", "light_rest2"}},
    [MEAN_SKY] = {"sky", "RGB", {"sky_rest", "sky_rest2"}},
    [MEAN_POSITION] = {"position", "XYZ", {"position_rest", "position_rest2"}},
    [MEAN_DEPTH] = {"depth", "Z", {"depth_rest", "depth_rest2"}},
    [MEAN_ALBEDO] = {"albedo", "RGB", {"albedo_rest"}},
    [MEAN_NORMAL] = {"normal", "XYZ", {"normal_rest"}},
    [MEAN_ALPHA] = {"", "A", {"alpha_rest"}},
    [MEAN_LIGHT_SHARE] = {"light_share", "V", {"light_share_rest"}},
    [MEAN_SKY_SHARE] = {"sky_share", "V", {"sky_share_rest"}},
    [MEAN_ALBEDO_SQUARE] = {"albedo_square", "V", {"albedo_square_rest"}},
    [MEAN_BLUR] = {"blur", "V", {"blur_rest"}},
};

static bool film_make_means(Film *film, int64_t count, Error *e)
{
    for (int i = 0; i < FILM_MEANS; i++) {
        int64_t values = count * (int64_t)strlen(MEANS[i].channels);
        film->mean[i] = memory_alloc_zero(values, sizeof(float), e);
        bool made = film->mean[i];
        for (int k = 0; k < FILM_RESTS && MEANS[i].rest[k]; k++) {
            made = made && (film->rest[i][k] = memory_alloc_zero(values, sizeof(float), e));
        }
        if (!made) {
            return false;
        }
    }
    film->color = (Vec3 *)(void *)film->mean[MEAN_COLOR];
    film->light = (Vec3 *)(void *)film->mean[MEAN_LIGHT];
    film->sky = (Vec3 *)(void *)film->mean[MEAN_SKY];
    film->position = (Vec3 *)(void *)film->mean[MEAN_POSITION];
    film->depth = film->mean[MEAN_DEPTH];
    film->albedo = (Vec3 *)(void *)film->mean[MEAN_ALBEDO];
    film->normal = (Vec3 *)(void *)film->mean[MEAN_NORMAL];
    film->alpha = film->mean[MEAN_ALPHA];
    film->light_share = film->mean[MEAN_LIGHT_SHARE];
    film->sky_share = film->mean[MEAN_SKY_SHARE];
    film->albedo_square = film->mean[MEAN_ALBEDO_SQUARE];
    film->blur = film->mean[MEAN_BLUR];
    return true;
}

static bool film_make_planes(Film *film, Error *e)
{
    int64_t count = (int64_t)film->width * film->height;
    if (!memory_check((double)count * FILM_PIXEL_BYTES, e, "a film of %d x %d pixels", film->width,
                      film->height)) {
        return false;
    }
    float **scalars[] = {&film->object, &film->hits, &film->samples, &film->variance};
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++) {
        if (!(*scalars[i] = memory_alloc_zero(count, sizeof(float), e))) {
            return false;
        }
    }
    film->squares = memory_alloc_zero(count * FILM_SQUARE_LIMBS, sizeof(float), e);
    if (!film->squares || !film_make_means(film, count, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        film->depth[i] = INFINITY;
    }
    return true;
}

Film *film_new(int width, int height, Error *e)
{
    if (width < 1 || height < 1) {
        error_set(e, ERROR_INPUT, "a picture of %d x %d pixels; at least 1 x 1 is needed", width,
                  height);
        return NULL;
    }
    Film *film = memory_alloc_zero(1, sizeof *film, e);
    if (!film) {
        return NULL;
    }
    film->width = width;
    film->height = height;
    if (!film_make_planes(film, e)) {
        film_free(film);
        return NULL;
    }
    return film;
}

void film_drop_denoised(Film *film)
{
    free(film->denoised);
    film->denoised = NULL;
}

void film_free(Film *film)
{
    if (film) {
        free(film->object);
        free(film->hits);
        free(film->samples);
        free(film->variance);
        free(film->denoised);
        for (int i = 0; i < FILM_MEANS; i++) {
            free(film->mean[i]);
            free(film->rest[i][0]);
            free(film->rest[i][1]);
        }
        free(film->squares);
        free(film);
    }
}

static int crop_edge(float share, int pixels)
{
    return (int)lroundf(clampf(share, 0.0f, 1.0f) * (float)pixels);
}

PixelBox film_crop_pixels(int width, int height, const float crop[4])
{
    return (PixelBox){.x0 = crop_edge(crop[0], width),
                      .y0 = crop_edge(crop[1], height),
                      .x1 = crop_edge(crop[2], width),
                      .y1 = crop_edge(crop[3], height)};
}

bool film_is_complete(const Film *film, const float crop[4])
{
    PixelBox box = film_crop_pixels(film->width, film->height, crop);
    for (int y = box.y0; y < box.y1; y++) {
        for (int x = box.x0; x < box.x1; x++) {
            if (film->samples[(int64_t)y * film->width + x] < 1.0f) {
                return false;
            }
        }
    }
    return true;
}

void film_guide_noise(const Film *film, int64_t i, float *albedo, float *normal)
{
    float n = film->samples[i], mean = luminance(film->albedo[i]);
    // normals are unit vectors, or 0 where no surface was met
    float share = n > 0.0f ? film->hits[i] / n : 0.0f;
    float of_mean = n > 1.0f ? film->blur[i] / (n - 1.0f) : 0.0f;
    *albedo = of_mean * fmaxf(film->albedo_square[i] - mean * mean, 0.0f);
    *normal = of_mean * fmaxf(share - vec3_dot(film->normal[i], film->normal[i]), 0.0f);
}

void film_forget(Film *film, const float crop[4])
{
    PixelBox box = film_crop_pixels(film->width, film->height, crop);
    for (int y = box.y0; y < box.y1; y++) {
        for (int x = box.x0; x < box.x1; x++) {
            film->samples[(int64_t)y * film->width + x] = 0.0f;
        }
    }
}

void film_planes(const Film *film, FilmPlane plane[FILM_PLANES])
{
    static const FilmMean order[FILM_MEANS] = {
        MEAN_COLOR, MEAN_ALPHA, MEAN_ALBEDO,      MEAN_NORMAL,    MEAN_DEPTH,         MEAN_POSITION,
        MEAN_LIGHT, MEAN_SKY,   MEAN_LIGHT_SHARE, MEAN_SKY_SHARE, MEAN_ALBEDO_SQUARE, MEAN_BLUR};
    const FilmPlane others[] = {{film->object, "object", "V"},
                                {film->samples, "samples", "V"},
                                {film->hits, "hits", "V"},
                                {film->variance, "variance", "V"},
                                {film->squares, "squares", "ABCDE"}};
    int count = 0;
    for (int i = 0; i < FILM_MEANS; i++) {
        FilmMean mean = order[i];
        plane[count++] = (FilmPlane){film->mean[mean], MEANS[mean].layer, MEANS[mean].channels};
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        plane[count++] = others[i];
    }
    for (int i = 0; i < FILM_MEANS; i++) {
        for (int k = 0; k < FILM_RESTS && MEANS[i].rest[k]; k++) {
            plane[count++] = (FilmPlane){film->rest[i][k], MEANS[i].rest[k], MEANS[i].channels};
        }
    }
    assert(count == FILM_PLANES);
}
