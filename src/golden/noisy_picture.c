#include "golden/noise.h"

#include <stddef.h>

bool noisy_picture_make(NoisyPicture *picture, int width, int height, Error *e)
{
    *picture = (NoisyPicture){.mean = image_new(width, height, 3, e)};
    picture->variance = picture->mean ? image_new(width, height, 3, e) : NULL;
    if (!picture->variance) {
        noisy_picture_clear(picture);
        return false;
    }
    return true;
}

void noisy_picture_clear(NoisyPicture *picture)
{
    image_free(picture->mean);
    image_free(picture->variance);
    *picture = (NoisyPicture){0};
}

// Accumulates the sum of squared deviations (Welford 1962) and stores the variance of the mean:
// that sum over n (n - 1).
void noisy_picture_add(NoisyPicture *picture, const Image *rendering)
{
    double n = ++picture->runs;
    for (int64_t i = 0; i < (int64_t)3 * rendering->width * rendering->height; i++) {
        float *mean = &picture->mean->pixel[i], *variance = &picture->variance->pixel[i];
        double value = (double)rendering->pixel[i], deviation = value - (double)*mean;
        double sum = (double)*variance * (n - 1.0) * (n - 2.0);
        double new_mean = n > 1.0 ? (double)*mean + deviation / n : value;
        sum += n > 1.0 ? deviation * (value - new_mean) : 0.0;
        *mean = (float)new_mean;
        *variance = n > 1.0 ? (float)(sum / (n * (n - 1.0))) : 0.0f;
    }
}

bool noisy_picture_write(const NoisyPicture *picture, const char *file, Error *e)
{
    int width = picture->mean->width, height = picture->mean->height;
    Image *runs = image_new(width, height, 1, e);
    if (!runs) {
        return false;
    }
    for (int64_t i = 0; i < (int64_t)width * height; i++) {
        runs->pixel[i] = (float)picture->runs;
    }
    const ImageLayer layers[] = {
        {"", "RGB", picture->mean}, {"variance", "RGB", picture->variance}, {"runs", "V", runs}};
    bool done = image_write_exr(file, layers, 3, NULL, e);
    image_free(runs);
    return done;
}

static bool check_runs(const char *file, const Image *runs, Error *e)
{
    float count = runs->pixel[0];
    return (count >= 2.0f && count <= 1e6f) ||
           error_set(e, ERROR_INPUT,
                     "image '%s' says that it was made of %g runs; 2 or more would do", file,
                     (double)count);
}

bool noisy_picture_read(NoisyPicture *picture, const char *file, Error *e)
{
    Image *runs = image_read_layer(file, "runs", "V", NULL, e);
    *picture = (NoisyPicture){0};
    if (runs && check_runs(file, runs, e)) {
        picture->runs = (int)runs->pixel[0];
        picture->mean = image_read_layer(file, "", "RGB", NULL, e);
        picture->variance =
            picture->mean ? image_read_layer(file, "variance", "RGB", NULL, e) : NULL;
    }
    image_free(runs);
    if (!picture->variance) {
        noisy_picture_clear(picture);
        return false;
    }
    return true;
}
