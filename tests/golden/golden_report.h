// The page that shows what is wrong with a golden image: ours, the stored one, their difference,
// all in one HTML file.
#ifndef RAMIFY_TESTS_GOLDEN_REPORT_H
#define RAMIFY_TESTS_GOLDEN_REPORT_H

#include "image/compare.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#define GOLDEN_AMPLIFIED 10.0f

static inline void golden_base64(FILE *page, const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        unsigned b[3] = {bytes[i], i + 1 < count ? bytes[i + 1] : 0u,
                         i + 2 < count ? bytes[i + 2] : 0u};
        unsigned group = b[0] << 16 | b[1] << 8 | b[2];
        fputc(digits[group >> 18], page);
        fputc(digits[group >> 12 & 63], page);
        fputc(i + 1 < count ? digits[group >> 6 & 63] : '=', page);
        fputc(i + 2 < count ? digits[group & 63] : '=', page);
    }
}

static inline void golden_figure(FILE *page, const char *png, const char *caption, int width)
{
    fprintf(page,
            "<figure><img width='%d' style='image-rendering:pixelated' "
            "src='data:image/png;base64,",
            width);
    FILE *file = fopen(png, "rb");
    unsigned char bytes[3 * 1024];
    size_t count;
    while (file && (count = fread(bytes, 1, sizeof bytes, file)) > 0) {
        golden_base64(page, bytes, count);
    }
    if (file) {
        fclose(file);
    }
    fprintf(page, "'><figcaption>%s</figcaption></figure>\n", caption);
}

static inline bool golden_write_difference(const char *png, const Image *ours, const Image *stored)
{
    Image *difference = image_new(ours->width, ours->height, 3, NULL);
    for (int64_t i = 0; difference && i < (int64_t)3 * ours->width * ours->height; i++) {
        difference->pixel[i] =
            fminf(1.0f, fabsf(ours->pixel[i] - stored->pixel[i]) * GOLDEN_AMPLIFIED);
    }
    bool done = difference && image_write_display(png, difference, NULL, NULL);
    image_free(difference);
    return done;
}

// Writes build/golden/NAME.html. ours_png and stored_png are the files of the two images.
static inline void golden_report(const char *name, const char *ours_png, const char *stored_png,
                                 const Image *ours, const Image *stored, const ImageDifference *d,
                                 double threshold)
{
    char path[512], difference_png[512];
    mkdir("build", 0777);
    mkdir("build/golden", 0777);
    snprintf(path, sizeof path, "build/golden/%s.html", name);
    snprintf(difference_png, sizeof difference_png, "build/golden/%s-difference.png", name);
    FILE *page = fopen(path, "w");
    if (!page) {
        return;
    }
    int width = 4 * ours->width;
    fprintf(page,
            "<!doctype html><meta charset='utf-8'><title>%s</title>\n"
            "<style>body{background:#222;color:#ddd;font:15px sans-serif}"
            "figure{display:inline-block;margin:8px}</style>\n"
            "<h1>%s</h1><p>%d x %d pixels. RMSE %.5f, largest difference %.4f, %.3f %% of pixels "
            "differ by more than %.3f of the display range.</p>\n",
            name, name, ours->width, ours->height, d->rmse, d->maximum, 100.0 * d->failing,
            threshold);
    golden_figure(page, ours_png, "ours", width);
    golden_figure(page, stored_png, "stored", width);
    if (golden_write_difference(difference_png, ours, stored)) {
        golden_figure(page, difference_png, "difference x 10", width);
        unlink(difference_png);
    }
    fclose(page);
}

#endif
