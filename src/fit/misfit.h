// How far a scene's measures are from its targets.
#ifndef RAMIFY_FIT_MISFIT_H
#define RAMIFY_FIT_MISFIT_H

#include "scene/scene.h"

// Measures the objects that targets name: one value for each target. ERROR_INPUT names a target
// whose object has no such measure.
bool misfit_measure(const Scene *scene, const Run *run, double *values, Error *e);

bool misfit_is_met(const SceneTarget *target, double value);

// Misfit of one target, see fit.h; a measure that is not a number counts as ten half widths.
double misfit_of(const SceneTarget *target, double value);

// Squared distance from the middle of a range with two ends, in half widths; 0 for other ranges.
double misfit_from_middle(const SceneTarget *target, double value);

#endif
