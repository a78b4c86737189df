#include "render/film.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool film_make_planes(Film *film, Error *e)
{
    int64_t count = (int64_t)film->width * film->height;
    if (!memory_check((double)count * FILM_PIXEL_BYTES, e, "a film of %d x %d pixels", film->width,
                      film->height)) {
        return false;
    }
    Vec3 **vectors[] = {&film->color,  &film->light,  &film->sky,
                        &film->albedo, &film->normal, &film->position};
    float **scalars[] = {&film->alpha,  &film->light_share, &film->sky_share, &film->depth,
                         &film->object, &film->hits,        &film->samples,   &film->variance};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        if (!(*vectors[i] = memory_alloc_zero(count, sizeof(Vec3), e))) {
            return false;
        }
    }
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++) {
        if (!(*scalars[i] = memory_alloc_zero(count, sizeof(float), e))) {
            return false;
        }
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
        free(film->color);
        free(film->light);
        free(film->sky);
        free(film->light_share);
        free(film->sky_share);
        free(film->alpha);
        free(film->albedo);
        free(film->normal);
        free(film->depth);
        free(film->position);
        free(film->object);
        free(film->hits);
        free(film->samples);
        free(film->variance);
        free(film->denoised);
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
    const FilmPlane all[FILM_PLANES] = {
        {&film->color->x, "", "RGB"},
        {film->alpha, "", "A"},
        {&film->albedo->x, "albedo", "RGB"},
        {&film->normal->x, "normal", "XYZ"},
        {film->depth, "depth", "Z"},
        {&film->position->x, "position", "XYZ"},
        {film->object, "object", "V"},
        {film->samples, "samples", "V"},
        {film->hits, "hits", "V"},
        {film->variance, "variance", "V"},
        {&film->light->x, "light", "RGB"},
        {&film->sky->x, "sky", "RGB"},
        {film->light_share, "light_share", "V"},
        {film->sky_share, "sky_share", "V"},
    };
    memcpy(plane, all, sizeof all);
}
