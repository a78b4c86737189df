#include "cli/difference.h"

#include "base/json.h"

#include <stdio.h>

static bool of_one_size(const RamifyDifference *d)
{
    return d->width == d->other_width && d->height == d->other_height;
}

void difference_print(const RamifyDifference *d, double threshold)
{
    if (!of_one_size(d)) {
        return;
    }
    if (d->statistical && d->alike) { // the message contains it otherwise
        printf("%lld of %lld blocks differ, p %.3g, Z %.1f, ", (long long)d->rejected,
               (long long)d->tests, d->p, d->z);
    }
    printf("RMSE %.6g, maximum %.6g at (%d, %d), ", d->rmse, d->maximum, d->worst_x, d->worst_y);
    if (!d->statistical && threshold >= 0.0) {
        printf("%.6g %% over %.6g, ", 100.0 * d->failing, threshold);
    }
    printf("perceptual %.6g", d->perceptual);
}

static void print_number(const char *name, double value)
{
    printf(", \"%s\": ", name);
    json_put_number(stdout, value, 6);
}

void difference_print_json(const RamifyDifference *d)
{
    printf("\"alike\": %s, \"width\": %d, \"height\": %d, \"other_width\": %d, "
           "\"other_height\": %d",
           d->alike ? "true" : "false", d->width, d->height, d->other_width, d->other_height);
    if (!of_one_size(d)) {
        return;
    }
    print_number("rmse", d->rmse);
    print_number("mean", d->mean);
    print_number("maximum", d->maximum);
    printf(", \"worst\": [%d, %d]", d->worst_x, d->worst_y);
    print_number("psnr", d->psnr);
    print_number("perceptual", d->perceptual);
    if (d->statistical) {
        print_number("p", d->p);
        print_number("z", d->z);
        printf(", \"tests\": %lld, \"rejected\": %lld", (long long)d->tests,
               (long long)d->rejected);
    } else {
        print_number("failing", d->failing);
    }
}
