// Finds parameters of a scene whose measures meet the scene's targets. Only what targets name is
// grown and measured; nothing is rendered.
//
// The misfit of a scene is the sum over its targets of e^2 / (1 + e), where e is how far the
// measure is outside of its range, in half widths of the range (of a range with one end: in sizes
// of that end). It is near a square for small e, so that the search sees a smooth function, and
// near e for a large one, so that a target which is far away does not hide the others.
#ifndef RAMIFY_FIT_FIT_H
#define RAMIFY_FIT_FIT_H

#include "fit/parameter.h"

typedef struct Fit Fit;

typedef struct FitParams {
    const FitRange *ranges; // range_count, 1 .. SEARCH_MOST_DIMENSIONS
    int range_count;
    int evaluations; // most scenes to grow, >= 1
    // go on when all targets are met, toward the middle of their ranges, until the evaluations are
    // spent
    bool spend_all;
    // told after each evaluation, from the calling thread; may be NULL
    void (*evaluated)(void *user, const Fit *fit);
    void *user;
} FitParams;

// One scene that was grown.
typedef struct FitStep {
    double *parameters; // one for each range
    double *measures;   // one for each target; NAN = not measurable
    double misfit;      // 0 = all targets met; INFINITY = the scene could not be grown
    double rank;        // the misfit, and with spend_all a little for the distance from the middles
    bool met;           // all targets
    const char *failure; // why the scene could not be grown; NULL = it was
} FitStep;

// Steps, in order. All memory is the arena's but the steps' array.
struct Fit {
    Arena *arena;
    const Scene *scene; // borrowed
    FitParameter *parameters;
    int parameter_count;
    FitStep *steps; // owned
    int64_t count, capacity;
    int64_t best;   // lowest rank, the earlier one of equals; -1 = none
    bool cancelled; // the search was interrupted
};

// Searches. The scene must live as long as the result. ERROR_INPUT for a bad path or range, a scene
// without targets, or a target that cannot be measured. When the run is cancelled after the first
// evaluation, the result holds what was found until then.
Fit *fit_scene(const Scene *scene, const FitParams *params, const Run *run, Error *e);

void fit_free(Fit *fit); // NULL is fine

// The scene's file with the parameters of the best step in place, as heap text. *whole: comments
// and layout are kept; false = the file could not be edited (a value comes from an alias, say), and
// the text is the scene with all values written out.
char *fit_text(const Fit *fit, bool *whole, Error *e);

// Draws misfit, parameters and measures over the evaluations as SVG. ERROR_IO.
bool fit_draw(const Fit *fit, const char *file, Error *e);

#endif
