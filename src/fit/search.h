// Minimizes a function over the unit cube in few evaluations: for functions that are expensive,
// noisy and have no derivatives. By NLopt's deterministic algorithms, so the same function gives
// the same sequence of points.
#ifndef RAMIFY_FIT_SEARCH_H
#define RAMIFY_FIT_SEARCH_H

#include "base/error.h"

enum { SEARCH_MOST_DIMENSIONS = 32 };

typedef struct Search {
    int dimensions;
    int evaluations;     // most that the function may spend
    const double *start; // dimensions coordinates in 0..1
    const double *least; // smallest step in each that the function may notice; 0 = any

    // The function at x. *spent: evaluations so far, which grow only where the function does its
    // work (it may know a point already). Returns false to end the search.
    bool (*evaluate)(void *user, const double *x, double *value, int *spent);
    void *user;
} Search;

// Evaluates the start, then searches around it, then the whole cube, then around the best point,
// until the evaluations are spent, the function ends the search, or the steps around the best point
// are very small. The function sees every point; so nothing is returned. ERROR_MEMORY or
// ERROR_INTERNAL from NLopt.
bool search_run(const Search *search, Error *e);

#endif
