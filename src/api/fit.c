#include "api/handles.h"

#include "base/file_replace.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { USUAL_EVALUATIONS = 64 };

// The caller's function, which gets its own type.
typedef struct Listener {
    const RamifyFitOptions *options;
} Listener;

static void tell(void *user, const Fit *fit)
{
    const RamifyFitOptions *options = ((const Listener *)user)->options;
    options->evaluated(options->user, (const RamifyFit *)(const void *)fit);
}

static FitRange *copy_ranges(const RamifyFitOptions *options, Error *e)
{
    int count = options->range_count > 0 ? options->range_count : 0;
    FitRange *ranges = memory_alloc(count, sizeof *ranges, e);
    for (int i = 0; ranges && i < count; i++) {
        ranges[i] = (FitRange){options->ranges[i].path, options->ranges[i].low,
                               options->ranges[i].high, options->ranges[i].logarithmic != 0};
    }
    return ranges;
}

RamifyFit *ramify_fit(const RamifyScene *scene, const RamifyFitOptions *options,
                      const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    Listener listener = {options};
    FitRange *ranges = copy_ranges(options, &e);
    FitParams params = {.ranges = ranges,
                        .range_count = options->range_count,
                        .evaluations =
                            options->evaluations > 0 ? options->evaluations : USUAL_EVALUATIONS,
                        .spend_all = options->until == RAMIFY_UNTIL_EVALUATIONS,
                        .evaluated = options->evaluated ? tell : NULL,
                        .user = &listener};
    Fit *fit = ranges ? fit_scene(scene_of(scene), &params, &own, &e) : NULL;
    free(ranges);
    if (!fit) {
        api_fail(error, &e);
    }
    return (RamifyFit *)(void *)fit;
}

void ramify_fit_free(RamifyFit *fit)
{
    fit_free((Fit *)(void *)fit);
}

void ramify_fit_info(const RamifyFit *fit, RamifyFitInfo *info)
{
    const Fit *own = fit_of(fit);
    *info = (RamifyFitInfo){.evaluation_count = (int32_t)own->count,
                            .range_count = own->parameter_count,
                            .target_count = own->scene->target_count,
                            .best = (int32_t)own->best,
                            .met = own->best >= 0 && own->steps[own->best].met,
                            .cancelled = own->cancelled};
}

void ramify_fit_evaluation(const RamifyFit *fit, int index, RamifyEvaluation *evaluation)
{
    const FitStep *step = &fit_of(fit)->steps[index];
    *evaluation = (RamifyEvaluation){.parameters = step->parameters,
                                     .measures = step->measures,
                                     .misfit = step->misfit,
                                     .failure = step->failure};
}

bool ramify_fit_write(const RamifyFit *fit, const char *file, bool *whole, RamifyError *error)
{
    Error e = {0};
    bool kept = false;
    char *text = fit_text(fit_of(fit), &kept, &e);
    bool done = text && file_replace(file, text, strlen(text), &e);
    free(text);
    if (whole) {
        *whole = kept;
    }
    return done || api_fail(error, &e);
}

bool ramify_fit_draw(const RamifyFit *fit, const char *file, RamifyError *error)
{
    Error e = {0};
    return fit_draw(fit_of(fit), file, &e) || api_fail(error, &e);
}
