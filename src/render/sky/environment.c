#include "render/sky/environment.h"

#include "image/image.h"

#include <stddef.h>

static bool check_shape(const Image *image, const char *file, Error *e)
{
    if (image->channels < 3) {
        return error_set(e, ERROR_INPUT,
                         "environment '%s' has %d channels; red, green and blue are needed", file,
                         image->channels);
    }
    if (image->width < 2 || image->height < 2) {
        return error_set(e, ERROR_INPUT, "environment '%s' has only %d x %d pixels", file,
                         image->width, image->height);
    }
    return true;
}

// Invalid pixels (NaN, infinite, negative) would spoil every path that meets them.
static float usable(float x)
{
    return isfinite(x) && x > 0.0f ? x : 0.0f;
}

Dome *environment_dome(const Sky *sky, const Run *run, Error *e)
{
    if (!sky->file) {
        error_set(e, ERROR_INPUT, "the sky is an environment without a file");
        return NULL;
    }
    Image *image = image_read(sky->file, run, e);
    if (!image) {
        error_key(e, "sky.file");
        return NULL;
    }
    Dome *dome = NULL;
    if (check_shape(image, sky->file, e)) {
        dome = dome_new(image->width, image->height, false, 0.0f, e);
    }
    for (int64_t i = 0; dome && i < (int64_t)image->width * image->height; i++) {
        const float *p = image->pixel + i * image->channels;
        dome->entry[i].radiance =
            vec3_scale(vec3(usable(p[0]), usable(p[1]), usable(p[2])), sky->strength);
    }
    image_free(image);
    if (dome) {
        dome_prepare(dome);
    } else {
        error_key(e, "sky.file");
    }
    return dome;
}
