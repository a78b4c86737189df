#include "api/handles.h"

#include "base/file_replace.h"
#include "fit/search.h"

#include <stdlib.h>
#include <string.h>

enum { USUAL_EVALUATIONS = 64 };

// FitParams.evaluated: tells the caller's function, with the API's type.
static void tell(void *user, const Fit *fit)
{
    const RamifyFitOptions *options = user;
    options->evaluated(options->user, (const RamifyFit *)(const void *)fit);
}

static bool check_options(const RamifyFitOptions *options, Error *e)
{
    int count = options->range_count;
    if (count < 1 || count > SEARCH_MOST_DIMENSIONS) {
        return error_set(e, ERROR_INPUT, "%d ranges to search; give 1 to %d", count,
                         SEARCH_MOST_DIMENSIONS);
    }
    for (int i = 0; i < count; i++) {
        if (!options->ranges[i].path) {
            return error_set(e, ERROR_INPUT, "range %d has no path; name a number of the scene", i);
        }
    }
    if (options->evaluations < 0) {
        return error_set(e, ERROR_INPUT, "%d evaluations; there must be 1 or more, or 0 for %d",
                         options->evaluations, USUAL_EVALUATIONS);
    }
    return options->until == RAMIFY_UNTIL_TARGETS || options->until == RAMIFY_UNTIL_EVALUATIONS ||
           error_set(e, ERROR_INPUT, "until is %d; it must be one of its named values",
                     options->until);
}

RamifyFit *ramify_fit(const RamifyScene *scene, const RamifyFitOptions *options,
                      const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    if (!check_options(options, &e)) {
        api_fail(error, &e);
        return NULL;
    }
    Run own = api_run(run);
    RamifyFitOptions listener = *options;
    FitRange ranges[SEARCH_MOST_DIMENSIONS];
    for (int i = 0; i < options->range_count; i++) {
        const RamifyRange *range = &options->ranges[i];
        ranges[i] = (FitRange){range->path, range->low, range->high, range->logarithmic != 0};
    }
    FitParams params = {.ranges = ranges,
                        .range_count = options->range_count,
                        .evaluations =
                            options->evaluations > 0 ? options->evaluations : USUAL_EVALUATIONS,
                        .spend_all = options->until == RAMIFY_UNTIL_EVALUATIONS,
                        .evaluated = options->evaluated ? tell : NULL,
                        .user = &listener};
    Fit *fit = fit_scene(scene_of(scene), &params, &own, &e);
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
