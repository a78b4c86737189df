// Compares a picture of ours with another renderer's, for tests/cross/run.
//
//     compare mask OURS.exr THEIRS.exr PICTURE     alpha, pixel by pixel; prints the share that
//     differs compare light OURS.exr THEIRS.exr PICTURE    linear colours; prints RMS difference
//     and bias over the mean
//
// THEIRS may be a whole number of times as large in light; its pixels are averaged.
// PICTURE-ours.png, PICTURE-theirs.png and PICTURE-difference.png are written for people.
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(const char *what)
{
    fprintf(stderr, "compare: %s\n", what);
    exit(2);
}

static Image *read_picture(const char *file)
{
    Error e = {0};
    Image *image = image_read(file, NULL, &e);
    return image ? image : (fail(e.message), NULL);
}

static Image *new_picture(int width, int height, int channels)
{
    Image *image = image_new(width, height, channels, NULL);
    return image ? image : (fail("out of memory"), NULL);
}

static float *pixel_at(const Image *image, int x, int y)
{
    return image->pixel + ((int64_t)y * image->width + x) * image->channels;
}

// Channels first .. first + count - 1, averaged over squares of `times` pixels.
static Image *shrink(const Image *image, int first, int count, int times)
{
    Image *out = new_picture(image->width / times, image->height / times, count);
    for (int y = 0; y < out->height; y++) {
        for (int x = 0; x < out->width; x++) {
            for (int c = 0; c < count; c++) {
                double sum = 0.0;
                for (int k = 0; k < times * times; k++) {
                    sum += (double)pixel_at(image, x * times + k % times,
                                            y * times + k / times)[first + c];
                }
                pixel_at(out, x, y)[c] = (float)(sum / (times * times));
            }
        }
    }
    return out;
}

static float to_display(float v)
{
    v = v > 0.0f ? (v < 1.0f ? v : 1.0f) : 0.0f;
    return v <= 0.0031308f ? 12.92f * v : 1.055f * powf(v, 1.0f / 2.4f) - 0.055f;
}

// scale * (a - b) + offset as a picture; b may be NULL.
static void write_view(const char *stem, const char *name, const Image *a, const Image *b,
                       float scale, float offset)
{
    Image *view = new_picture(a->width, a->height, 3);
    for (int64_t i = 0; i < (int64_t)a->width * a->height; i++) {
        for (int c = 0; c < 3; c++) {
            int k = a->channels == 1 ? 0 : c;
            float v = a->pixel[i * a->channels + k] - (b ? b->pixel[i * b->channels + k] : 0.0f);
            view->pixel[3 * i + c] = to_display(scale * v + offset);
        }
    }
    char file[4096];
    Error e = {0};
    snprintf(file, sizeof file, "%s-%s.png", stem, name);
    if (!image_write_display(file, view, NULL, &e)) {
        fail(e.message);
    }
    image_free(view);
}

static double mean_of(const Image *image)
{
    double sum = 0.0;
    int64_t count = (int64_t)image->width * image->height * image->channels;
    for (int64_t i = 0; i < count; i++) {
        sum += (double)image->pixel[i];
    }
    return sum / (double)count;
}

static void compare_masks(const Image *ours, const Image *theirs, const char *stem)
{
    int64_t different = 0, covered = 0, count = (int64_t)ours->width * ours->height;
    for (int64_t i = 0; i < count; i++) {
        ours->pixel[i] = ours->pixel[i] > 0.5f;
        theirs->pixel[i] = theirs->pixel[i] > 0.5f;
        different += ours->pixel[i] != theirs->pixel[i];
        covered += ours->pixel[i] > 0.5f;
    }
    printf("%.6f %.6f\n", (double)different / (double)count, (double)covered / (double)count);
    write_view(stem, "ours", ours, NULL, 1.0f, 0.0f);
    write_view(stem, "theirs", theirs, NULL, 1.0f, 0.0f);
    write_view(stem, "difference", ours, theirs, 0.5f, 0.5f);
}

static void compare_light(const Image *ours, const Image *theirs, const char *stem)
{
    double square = 0.0, mean = mean_of(ours);
    int64_t count = (int64_t)ours->width * ours->height * 3;
    for (int64_t i = 0; i < count; i++) {
        double d = (double)ours->pixel[i] - (double)theirs->pixel[i];
        square += d * d;
    }
    printf("%.6f %.6f\n", sqrt(square / (double)count) / mean, mean_of(theirs) / mean - 1.0);
    float bright = (float)(0.25 / mean);
    write_view(stem, "ours", ours, NULL, bright, 0.0f);
    write_view(stem, "theirs", theirs, NULL, bright, 0.0f);
    write_view(stem, "difference", theirs, ours, 8.0f * bright, 0.2f);
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        fail("usage: compare mask|light OURS THEIRS PICTURE");
    }
    bool mask = strcmp(argv[1], "mask") == 0;
    Image *ours = read_picture(argv[2]), *theirs = read_picture(argv[3]);
    int times = theirs->width / ours->width;
    if (times < 1 || theirs->width != times * ours->width ||
        theirs->height != times * ours->height || (mask && times > 1) ||
        theirs->channels < (mask ? 4 : 3) || ours->channels < 4) {
        fail("the pictures do not fit each other");
    }
    Image *a = shrink(ours, mask ? 3 : 0, mask ? 1 : 3, 1);
    Image *b = shrink(theirs, mask ? 3 : 0, mask ? 1 : 3, times);
    if (mask) {
        compare_masks(a, b, argv[4]);
    } else {
        compare_light(a, b, argv[4]);
    }
    image_free(ours);
    image_free(theirs);
    image_free(a);
    image_free(b);
    return 0;
}
