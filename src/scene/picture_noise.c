#include "base/color.h"
#include "scene/picture.h"

#include <math.h>

// The picture as it is shown when every pixel is brighter (sign 1) or darker (-1) by its standard
// error. Of compressed highlights the error is of the same relative size.
static Image *shown_off_by_error(const Image *beauty, const Film *film, float sign,
                                 const ToneParams *tone, Error *e)
{
    Image *off = image_new(film->width, film->height, 3, e);
    for (int64_t i = 0; off && i < (int64_t)film->width * film->height; i++) {
        float light = luminance(film->color[i]);
        float error = light > 0.0f ? sqrtf(film->variance[i]) / light : 0.0f;
        float alpha = beauty->pixel[4 * i + 3];
        float scale = alpha > 0.0f ? fmaxf(0.0f, 1.0f + sign * error) / alpha : 0.0f;
        for (int c = 0; c < 3; c++) {
            off->pixel[3 * i + c] = scale * beauty->pixel[4 * i + c];
        }
    }
    Image *shown = off ? tone_map(off, NULL, tone, e) : NULL;
    image_free(off);
    return shown;
}

// Half the mean difference over the crop's pixels of which the variance is known.
static double mean_error(const Scene *scene, const Film *film, const Image *high, const Image *low)
{
    PixelBox box = film_crop_pixels(film->width, film->height, scene->film.crop);
    double sum = 0.0, count = 0.0;
    for (int y = box.y0; y < box.y1; y++) {
        for (int x = box.x0; x < box.x1; x++) {
            int64_t i = (int64_t)y * film->width + x;
            for (int c = 0; film->samples[i] >= 2.0f && c < 3; c++) {
                sum += 0.5 * (double)(high->pixel[3 * i + c] - low->pixel[3 * i + c]);
                count += 1.0;
            }
        }
    }
    return count > 0.0 ? sum / count : (double)NAN;
}

bool picture_noise(const Scene *scene, const Film *film, double *noise, Error *e)
{
    Image *excess, *beauty = picture_compressed(scene, film, &excess, e);
    ToneParams tone = scene->tone;
    if (beauty) { // as the picture itself is exposed
        tone.exposure = log2f(tone_gain(beauty, excess, &tone));
        tone.auto_exposure = false;
        tone.bloom = 0.0f;
    }
    image_free(excess);
    Image *high = beauty ? shown_off_by_error(beauty, film, 1.0f, &tone, e) : NULL;
    Image *low = high ? shown_off_by_error(beauty, film, -1.0f, &tone, e) : NULL;
    image_free(beauty);
    if (low) {
        *noise = mean_error(scene, film, high, low);
    }
    image_free(high);
    image_free(low);
    return low;
}
