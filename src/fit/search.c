#include "fit/search.h"

#include <nlopt.h>
#include <string.h>

#define FIRST_STEP 0.15         // of local searches, in the unit cube
#define SMALLEST_STEP 3e-3      // at which they end
#define START_SHARE 0.3         // of the evaluations for the search around the start
#define WHOLE_SHARE 0.7         // the same with that of the whole cube
#define CALLS_PER_EVALUATION 20 // limit on calls where the function knows all points already

typedef struct Stage {
    nlopt_opt optimizer;
    const Search *search;
    int most;    // evaluations at which this stage ends
    int spent;   // of all stages so far
    bool ended;  // the function ended the search
    double best; // lowest value of all stages
    double at[SEARCH_MOST_DIMENSIONS];
} Stage;

static double evaluate(unsigned n, const double *x, double *gradient, void *user)
{
    (void)gradient; // these algorithms use none
    Stage *stage = user;
    double value = stage->best;
    if (stage->ended || stage->spent >= stage->most) { // DIRECT-L finishes its round
        return value;
    }
    stage->ended = !stage->search->evaluate(stage->search->user, x, &value, &stage->spent);
    if (value < stage->best) {
        stage->best = value;
        memcpy(stage->at, x, n * sizeof *x);
    }
    if (stage->ended || stage->spent >= stage->most) {
        nlopt_force_stop(stage->optimizer);
    }
    return value;
}

static bool optimize(Stage *stage, nlopt_opt optimizer, Error *e)
{
    int n = stage->search->dimensions;
    double x[SEARCH_MOST_DIMENSIONS], step[SEARCH_MOST_DIMENSIONS], lowest;
    for (int i = 0; i < n; i++) {
        step[i] = stage->search->least[i] > FIRST_STEP ? stage->search->least[i] : FIRST_STEP;
    }
    memcpy(x, stage->at, (size_t)n * sizeof *x);
    stage->optimizer = optimizer;
    bool set = nlopt_set_min_objective(optimizer, evaluate, stage) > 0 &&
               nlopt_set_lower_bounds1(optimizer, 0.0) > 0 &&
               nlopt_set_upper_bounds1(optimizer, 1.0) > 0 &&
               nlopt_set_initial_step(optimizer, step) > 0 &&
               nlopt_set_xtol_abs1(optimizer, SMALLEST_STEP) > 0 &&
               nlopt_set_maxeval(optimizer, CALLS_PER_EVALUATION * stage->search->evaluations) > 0;
    nlopt_result result = set ? nlopt_optimize(optimizer, x, &lowest) : NLOPT_INVALID_ARGS;
    if (result == NLOPT_OUT_OF_MEMORY) {
        return error_set(e, ERROR_MEMORY, "out of memory while searching parameters");
    }
    return result != NLOPT_INVALID_ARGS ||
           error_set(e, ERROR_INTERNAL, "NLopt refused the search: %s",
                     nlopt_get_errmsg(optimizer) ? nlopt_get_errmsg(optimizer) : "no reason given");
}

// Runs one algorithm until `share` of the evaluations are spent.
static bool run_stage(Stage *stage, nlopt_algorithm algorithm, double share, Error *e)
{
    stage->most = (int)(share * stage->search->evaluations);
    if (stage->ended || stage->spent >= stage->most) {
        return true;
    }
    nlopt_opt optimizer = nlopt_create(algorithm, (unsigned)stage->search->dimensions);
    bool done = optimizer ? optimize(stage, optimizer, e)
                          : error_set(e, ERROR_MEMORY, "out of memory while searching parameters");
    nlopt_destroy(optimizer);
    return done;
}

bool search_run(const Search *search, Error *e)
{
    Stage stage = {.search = search};
    memcpy(stage.at, search->start, (size_t)search->dimensions * sizeof *stage.at);
    stage.ended = !search->evaluate(search->user, stage.at, &stage.best, &stage.spent);
    return run_stage(&stage, NLOPT_LN_COBYLA, START_SHARE, e) &&
           run_stage(&stage, NLOPT_GN_DIRECT_L, WHOLE_SHARE, e) &&
           run_stage(&stage, NLOPT_LN_COBYLA, 1.0, e) && run_stage(&stage, NLOPT_LN_SBPLX, 1.0, e);
}
