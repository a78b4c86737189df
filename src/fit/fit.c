#include "fit/fit.h"

#include "base/c_locale.h"
#include "base/memory.h"
#include "config/scalar.h"
#include "fit/misfit.h"
#include "fit/search.h"
#include "scene/edit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MIDDLE_WEIGHT 0.01 // of the distance from the middles of ranges, if targets are met
#define FAILED_VALUE 100.0 // for the search, of a scene that cannot be grown

// A search at work.
typedef struct Fitting {
    Fit *fit;
    const FitParams *params;
    const Run *run;
    Error *e;
    bool failed; // e is set
    char texts[SEARCH_MOST_DIMENSIONS][FIT_NUMBER_TEXT];
} Fitting;

// ---- one evaluation

static FitStep *new_step(Fit *fit, Error *e)
{
    if (!memory_reserve(&fit->steps, &fit->capacity, fit->count + 1, sizeof *fit->steps, e)) {
        return NULL;
    }
    FitStep *step = &fit->steps[fit->count];
    *step = (FitStep){
        .parameters =
            arena_alloc(fit->arena, (size_t)fit->parameter_count * sizeof *step->parameters, e),
        .measures =
            arena_alloc(fit->arena, (size_t)fit->scene->target_count * sizeof *step->measures, e)};
    return step->parameters && step->measures ? step : NULL;
}

// The step that had the same parameters; NULL if there was none.
static const FitStep *find_step(const Fit *fit, const double *parameters)
{
    for (int64_t i = 0; i < fit->count; i++) {
        if (memcmp(fit->steps[i].parameters, parameters,
                   (size_t)fit->parameter_count * sizeof *parameters) == 0) {
            return &fit->steps[i];
        }
    }
    return NULL;
}

static Scene *change_scene(const Fit *fit, char texts[][FIT_NUMBER_TEXT], Error *e)
{
    SceneChange changes[SEARCH_MOST_DIMENSIONS];
    for (int i = 0; i < fit->parameter_count; i++) {
        changes[i] = (SceneChange){.path = fit->parameters[i].path,
                                   .value = texts[i],
                                   .source = fit->parameters[i].source};
    }
    return scene_changed(fit->scene, changes, fit->parameter_count, e);
}

static void judge(const Fit *fit, bool spend_all, FitStep *step)
{
    step->met = true;
    for (int i = 0; i < fit->scene->target_count; i++) {
        const SceneTarget *target = &fit->scene->targets[i];
        step->misfit += misfit_of(target, step->measures[i]);
        step->met = step->met && misfit_is_met(target, step->measures[i]);
        step->rank +=
            spend_all ? MIDDLE_WEIGHT * misfit_from_middle(target, step->measures[i]) : 0.0;
    }
    step->rank += step->misfit;
}

// A scene that the search tries and that cannot be grown is a step, too; the first one is an error.
static bool keep_failure(Fitting *fitting, FitStep *step, const Error *error)
{
    Fit *fit = fitting->fit;
    bool passes = error->code == ERROR_INPUT && fit->count > 0;
    if (!passes) {
        *fitting->e = *error;
        return false;
    }
    for (int i = 0; i < fit->scene->target_count; i++) {
        step->measures[i] = (double)NAN;
    }
    step->misfit = step->rank = (double)INFINITY;
    step->failure = arena_text(fit->arena, error->message, strlen(error->message), fitting->e);
    return step->failure;
}

// Grows and measures the scene of the texts.
static bool grow_step(Fitting *fitting, FitStep *step)
{
    Error error = {0};
    Scene *scene = change_scene(fitting->fit, fitting->texts, &error);
    bool grown = scene && misfit_measure(scene, fitting->run, step->measures, &error);
    scene_free(scene);
    if (!grown) {
        return keep_failure(fitting, step, &error);
    }
    judge(fitting->fit, fitting->params->spend_all, step);
    return true;
}

static bool add_step(Fitting *fitting, const double *parameters)
{
    Fit *fit = fitting->fit;
    FitStep *step = new_step(fit, fitting->e);
    if (!step) {
        return false;
    }
    memcpy(step->parameters, parameters, (size_t)fit->parameter_count * sizeof *parameters);
    if (!grow_step(fitting, step)) {
        return false;
    }
    if (!step->failure && (fit->best < 0 || step->rank < fit->steps[fit->best].rank)) {
        fit->best = fit->count;
    }
    fit->count++;
    run_progress(fitting->run, "fit", (double)fit->count / fitting->params->evaluations);
    if (fitting->params->evaluated) {
        fitting->params->evaluated(fitting->params->user, fit);
    }
    return true;
}

// SearchFunction: see search.h.
static bool evaluate(void *user, const double *x, double *value, int *spent)
{
    Fitting *fitting = user;
    Fit *fit = fitting->fit;
    double parameters[SEARCH_MOST_DIMENSIONS];
    CLocale locale;
    if (!c_locale_enter(&locale, fitting->e)) {
        fitting->failed = true;
        return false;
    }
    for (int i = 0; i < fit->parameter_count; i++) {
        parameters[i] = fit_parameter_value(&fit->parameters[i], x[i], fitting->texts[i]);
    }
    c_locale_leave(&locale);
    const FitStep *step = find_step(fit, parameters);
    if (!step) {
        fitting->failed = !add_step(fitting, parameters);
        step = fitting->failed ? NULL : &fit->steps[fit->count - 1];
    }
    *spent = (int)fit->count;
    *value = step && !step->failure ? step->rank : FAILED_VALUE;
    bool satisfied = step && step->met && !fitting->params->spend_all;
    return step && !satisfied && !run_is_cancelled(fitting->run);
}

// ---- the whole

static bool check(const Scene *scene, const FitParams *params, Error *e)
{
    bool valid = true;
    if (scene->target_count == 0) {
        valid = error_set(e, ERROR_INPUT,
                          "the scene has no targets to meet; add them, as in 'targets: [{object: "
                          "oak, measure: height, low: 8, high: 10}]'");
        error_locate(e, scene->file, 0, 0);
    }
    for (int i = 0; valid && i < params->range_count; i++) {
        for (int j = 0; valid && j < i; j++) {
            valid = strcmp(params->ranges[i].path, params->ranges[j].path) != 0 ||
                    error_set(e, ERROR_INPUT, "'%s' is to be varied twice; keep one range",
                              params->ranges[i].path);
        }
    }
    return valid;
}

static bool read_parameters(Fit *fit, const FitParams *params, Error *e)
{
    CLocale locale;
    fit->parameters =
        arena_alloc(fit->arena, (size_t)params->range_count * sizeof *fit->parameters, e);
    if (!fit->parameters || !c_locale_enter(&locale, e)) {
        return false;
    }
    bool read = true;
    for (int i = 0; read && i < params->range_count; i++) {
        read =
            fit_parameter_read(fit->scene, &params->ranges[i], fit->arena, &fit->parameters[i], e);
    }
    c_locale_leave(&locale);
    fit->parameter_count = params->range_count;
    return read;
}

static Fit *new_fit(const Scene *scene, Error *e)
{
    Fit *fit = memory_alloc_zero(1, sizeof *fit, e);
    if (fit) {
        fit->scene = scene;
        fit->best = -1;
        fit->arena = arena_new(e);
    }
    return fit;
}

static bool search(Fit *fit, const FitParams *params, const Run *run, Error *e)
{
    Error error = {0};
    Fitting fitting = {.fit = fit, .params = params, .run = run, .e = &error};
    double start[SEARCH_MOST_DIMENSIONS], least[SEARCH_MOST_DIMENSIONS];
    for (int i = 0; i < fit->parameter_count; i++) {
        start[i] = fit->parameters[i].start;
        least[i] = fit_parameter_step(&fit->parameters[i]);
    }
    Search task = {.dimensions = fit->parameter_count,
                   .evaluations = params->evaluations,
                   .start = start,
                   .least = least,
                   .evaluate = evaluate,
                   .user = &fitting};
    bool done = search_run(&task, &error) && !fitting.failed;
    fit->cancelled = run_is_cancelled(run) && fit->count > 0;
    if (!done && !fit->cancelled && e) {
        *e = error;
    }
    return done || fit->cancelled;
}

Fit *fit_scene(const Scene *scene, const FitParams *params, const Run *run, Error *e)
{
    if (!check(scene, params, e)) {
        return NULL;
    }
    Fit *fit = new_fit(scene, e);
    if (fit && !(fit->arena && read_parameters(fit, params, e) && search(fit, params, run, e))) {
        fit_free(fit);
        fit = NULL;
    }
    return fit;
}

void fit_free(Fit *fit)
{
    if (fit) {
        arena_free(fit->arena);
        free(fit->steps);
        free(fit);
    }
}

char *fit_text(const Fit *fit, bool *whole, Error *e)
{
    char texts[SEARCH_MOST_DIMENSIONS][FIT_NUMBER_TEXT];
    SceneChange changes[SEARCH_MOST_DIMENSIONS];
    const FitStep *best = &fit->steps[fit->best];
    CLocale locale;
    if (!c_locale_enter(&locale, e)) {
        return NULL;
    }
    for (int i = 0; i < fit->parameter_count; i++) {
        scalar_from_double(best->parameters[i], texts[i]);
        changes[i] = (SceneChange){.path = fit->parameters[i].path,
                                   .value = texts[i],
                                   .source = fit->parameters[i].source};
    }
    c_locale_leave(&locale);
    return scene_edited_text(fit->scene, changes, fit->parameter_count, whole, e);
}
