// ramify compare: differences of two pictures.
#include "base/json.h"
#include "cli/command.h"
#include "cli/difference.h"

#include <stdio.h>

#define DEFAULT_THRESHOLD 0.012

static void print_json(const Options *options, const RamifyDifference *d)
{
    printf("{\"a\": ");
    json_put_string(stdout, options->operand);
    printf(", \"b\": ");
    json_put_string(stdout, options->second);
    printf(", ");
    difference_print_json(d);
    printf(", \"message\": ");
    json_put_string(stdout, d->message);
    printf("}\n");
}

// Without a limit all values must be equal; the fraction over the threshold is then only reported.
static RamifyLimits limits_of(const Options *options)
{
    RamifyLimits limits = command_limits(options);
    if (limits.max_rmse < 0.0 && limits.max_failing < 0.0) {
        limits.max_rmse = 0.0;
    }
    if (limits.threshold < 0.0) {
        limits.threshold = DEFAULT_THRESHOLD;
    }
    return limits;
}

bool command_compare(const Options *options, RamifyError *e)
{
    if (options->report && !output_check(options->report, e)) {
        return false;
    }
    RamifyLimits limits = limits_of(options);
    RamifyDifference d;
    if (!ramify_compare(options->operand, options->second, &limits, options->report, &d, e)) {
        return false;
    }
    if (options->json) {
        print_json(options, &d);
    } else {
        printf("%s", d.alike ? "alike" : "different");
        if (d.width == d.other_width && d.height == d.other_height) {
            printf(": ");
            difference_print(&d, limits.threshold);
        }
        printf("\n");
    }
    return d.alike || fail(e, RAMIFY_DIFFERS, "%s and %s are not alike: %s", options->operand,
                           options->second, d.message);
}
