#include "image/compare.h"

#include <math.h>

// Absolute difference of two values; 0 for equal infinities and two NaNs, infinite for a NaN and a
// number.
static double difference_of(float a, float b)
{
    if (a == b || (isnan(a) && isnan(b))) {
        return 0.0;
    }
    double d = fabs((double)a - (double)b);
    return isnan(d) ? (double)INFINITY : d;
}

bool image_compare(const Image *a, const Image *b, double threshold, ImageDifference *difference,
                   Error *e)
{
    if (a->width != b->width || a->height != b->height || a->channels != b->channels) {
        return error_set(e, ERROR_INPUT,
                         "images of %d x %d with %d channels and %d x %d with %d channels cannot "
                         "be compared; they must be alike in all three",
                         a->width, a->height, a->channels, b->width, b->height, b->channels);
    }
    int64_t pixels = (int64_t)a->width * a->height, failing = 0, worst = 0;
    double sum = 0.0, squares = 0.0, maximum = 0.0;
    for (int64_t i = 0; i < pixels; i++) {
        bool over = false;
        for (int c = 0; c < a->channels; c++) {
            int64_t k = i * a->channels + c;
            double d = difference_of(a->pixel[k], b->pixel[k]);
            sum += d;
            squares += d * d;
            worst = d > maximum ? i : worst;
            maximum = fmax(maximum, d);
            over = over || d > threshold;
        }
        failing += over;
    }
    double count = (double)pixels * a->channels;
    *difference = (ImageDifference){.rmse = sqrt(squares / count),
                                    .mean = sum / count,
                                    .maximum = maximum,
                                    .failing = (double)failing / (double)pixels,
                                    .worst_x = (int)(worst % a->width),
                                    .worst_y = (int)(worst / a->width)};
    return true;
}
