// Size, crop and reconstruction filter of a picture.
#ifndef RAMIFY_RENDER_FILM_PARAMS_H
#define RAMIFY_RENDER_FILM_PARAMS_H

typedef enum FilterKind { FILTER_BLACKMAN_HARRIS, FILTER_BOX, FILTER_GAUSSIAN } FilterKind;

typedef struct FilmParams {
    int width, height;
    FilterKind filter;
    float filter_radius; // pixels
    float crop[4];       // x0, y0, x1, y1 in 0..1
} FilmParams;

#endif
