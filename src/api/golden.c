// Golden images.
#include "golden/golden.h"

#include "api/handles.h"
#include "golden/junit.h"
#include "golden/report.h"
#include "render/accel/accel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

_Static_assert((int)RAMIFY_GOLDEN_ALIKE == (int)GOLDEN_ALIKE &&
                   (int)RAMIFY_GOLDEN_DIFFERENT == (int)GOLDEN_DIFFERENT &&
                   (int)RAMIFY_GOLDEN_MISSING == (int)GOLDEN_MISSING &&
                   (int)RAMIFY_GOLDEN_FAILED == (int)GOLDEN_FAILED &&
                   (int)RAMIFY_GOLDEN_STORED == (int)GOLDEN_STORED &&
                   (int)RAMIFY_GOLDEN_ORPHAN == (int)GOLDEN_ORPHAN,
               "states are the same");

// mode 0 is the scenes' own, -1 internally
_Static_assert((int)RAMIFY_GOLDEN_TOLERANCE == (int)GOLDEN_TOLERANCE + 1 &&
                   (int)RAMIFY_GOLDEN_EXACT == (int)GOLDEN_EXACT + 1 &&
                   (int)RAMIFY_GOLDEN_STATISTICAL == (int)GOLDEN_STATISTICAL + 1,
               "modes are one apart");

_Static_assert(sizeof((RamifyDifference){0}.message) == sizeof((Comparison){0}.message),
               "messages fit");

const char *ramify_golden_status_name(int status)
{
    return golden_status_name((GoldenStatus)status);
}

static RamifyDifference difference_of(const Comparison *c)
{
    RamifyDifference d = {.alike = c->alike,
                          .width = c->width,
                          .height = c->height,
                          .other_width = c->stored_width,
                          .other_height = c->stored_height,
                          .rmse = c->difference.rmse,
                          .mean = c->difference.mean,
                          .maximum = c->difference.maximum,
                          .failing = c->difference.failing,
                          .psnr = c->psnr,
                          .perceptual = c->perceptual,
                          .worst_x = c->difference.worst_x,
                          .worst_y = c->difference.worst_y,
                          .statistical = c->statistical,
                          .p = c->noise.p,
                          .z = c->noise.worst.z,
                          .tests = c->noise.tests,
                          .rejected = c->noise.rejected};
    memcpy(d.message, c->message, sizeof d.message);
    return d;
}

// NaN as a limit would pass everything.
static bool check_limits(const RamifyLimits *limits, Error *e)
{
    if (limits &&
        (isnan(limits->max_rmse) || isnan(limits->threshold) || isnan(limits->max_failing))) {
        return error_set(e, ERROR_INPUT, "a limit is not a number; negative stands for no limit");
    }
    return true;
}

// ---- two files

static bool report_two(const char *report, const char *ours, const char *other,
                       const Limits *limits, Comparison *comparison, Error *e)
{
    char title[600];
    snprintf(title, sizeof title, "%.280s and %.280s", ours, other);
    GoldenStatus status = comparison->alike ? GOLDEN_ALIKE : GOLDEN_DIFFERENT;
    GoldenResult result = {.name = title,
                           .status = status,
                           .limits = *limits,
                           .compared = true,
                           .comparison = *comparison};
    memcpy(result.message, comparison->message, sizeof comparison->message);
    GoldenResults results = {.item = &result, .count = 1};
    results.counts[status] = 1;
    return report_write(report, title, ours, other, &results, e);
}

bool ramify_compare(const char *ours, const char *other, const RamifyLimits *limits,
                    const char *report, RamifyDifference *difference, RamifyError *error)
{
    Error e = {0};
    Comparison comparison = {0};
    Limits own = {0};
    if (limits) {
        own =
            (Limits){limits->max_rmse,
                     limits->threshold < 0.0 ? scene_golden_default().threshold : limits->threshold,
                     limits->max_failing};
    }
    bool done = check_limits(limits, &e) &&
                compare_files(ours, other, &own, report != NULL, &comparison, &e) &&
                (!report || report_two(report, ours, other, &own, &comparison, &e));
    *difference = difference_of(&comparison);
    comparison_clear(&comparison);
    return done || api_fail(error, &e);
}

// ---- a folder

static void hand_out(void *user, const GoldenResult *r)
{
    const RamifyGoldenOptions *options = user;
    RamifyDifference difference = difference_of(&r->comparison);
    RamifyLimits limits = {r->limits.max_rmse, r->limits.threshold, r->limits.max_failing};
    RamifyGoldenScene scene = {.name = r->name,
                               .message = r->message,
                               .status = (int32_t)r->status,
                               .difference = r->compared ? &difference : NULL,
                               .limits = &limits,
                               .alpha = r->alpha,
                               .seconds = r->seconds};
    options->each(options->user, &scene);
}

static GoldenOptions options_of(const RamifyGoldenOptions *o)
{
    GoldenOptions own = golden_options_default();
    own.update = o->update;
    own.pictures = o->report;
    own.filter = o->filter;
    own.isa = !o->isa ? own.isa : (strcmp(o->isa, "native") == 0 ? NULL : o->isa);
    own.mode = o->mode > 0 ? o->mode - 1 : -1;
    own.memory = o->memory;
    own.series = o->series > 0 ? o->series : own.series;
    if (o->limits) {
        own.limits = (Limits){o->limits->max_rmse, o->limits->threshold, o->limits->max_failing};
    }
    own.each = o->each ? hand_out : NULL;
    own.user = (void *)(uintptr_t)o; // only read, by hand_out
    return own;
}

static bool check_options(const RamifyGoldenOptions *o, Error *e)
{
    if ((unsigned)o->mode > RAMIFY_GOLDEN_STATISTICAL) {
        return error_set(e, ERROR_INPUT, "mode %d; it must be of its list", o->mode);
    }
    return check_limits(o->limits, e);
}

static bool write_results(const char *folder, const RamifyGoldenOptions *options,
                          const GoldenResults *results, Error *e)
{
    char title[600];
    snprintf(title, sizeof title, "Golden images of %.560s", folder);
    return (!options->report ||
            report_write(options->report, title, "ours", "stored", results, e)) &&
           (!options->junit || junit_write(options->junit, folder, results, e));
}

bool ramify_golden(const char *folder, const RamifyGoldenOptions *options, const RamifyRun *run,
                   RamifyGoldenCounts *counts, RamifyError *error)
{
    static const RamifyGoldenOptions plain = {0};
    const RamifyGoldenOptions *asked = options ? options : &plain;
    Error e = {0};
    Run own_run = api_run(run);
    GoldenOptions own = options_of(asked);
    GoldenResults results = {0};
    bool done = check_options(asked, &e) && accel_check_isa(own.isa, &e) &&
                golden_run(folder, &own, &own_run, &results, &e) &&
                write_results(folder, asked, &results, &e);
    *counts = (RamifyGoldenCounts){.alike = results.counts[GOLDEN_ALIKE],
                                   .different = results.counts[GOLDEN_DIFFERENT],
                                   .missing = results.counts[GOLDEN_MISSING],
                                   .failed = results.counts[GOLDEN_FAILED],
                                   .stored = results.counts[GOLDEN_STORED],
                                   .orphans = results.counts[GOLDEN_ORPHAN]};
    golden_results_clear(&results);
    return done || api_fail(error, &e);
}
