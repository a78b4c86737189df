// A number of the scene that a fit varies within a range.
#ifndef RAMIFY_FIT_PARAMETER_H
#define RAMIFY_FIT_PARAMETER_H

#include "scene/scene.h"

typedef struct FitRange {
    const char *path; // as in an override: objects.oak.tree.height
    double low, high; // low < high
    bool logarithmic; // equal steps are equal factors; low > 0
} FitRange;

enum { FIT_NUMBER_TEXT = 40 };

typedef struct FitParameter {
    char *path, *source; // source names it in messages: "range path=low:high"
    double low, high;
    bool logarithmic;
    bool whole;   // the key takes whole numbers only
    double start; // the scene's own value, moved into the range; 0..1 of it
} FitParameter;

// Checks a range against the scene and describes the parameter; its texts are in the arena.
// ERROR_INPUT if there is no such key, it has no number, or the range is not within the key's.
bool fit_parameter_read(const Scene *scene, const FitRange *range, Arena *arena,
                        FitParameter *parameter, Error *e);

// The value at `at` (0..1) of the range, rounded to about a ten thousandth of it, or to a whole
// number, as text for the scene file. Returns the number.
double fit_parameter_value(const FitParameter *parameter, double at, char text[FIT_NUMBER_TEXT]);

// The step in 0..1 that changes a whole number by about 1; 0 for other numbers.
double fit_parameter_step(const FitParameter *parameter);

#endif
