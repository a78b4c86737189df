// Writes results as JUnit XML for continuous integration: one test case per scene.
#ifndef RAMIFY_GOLDEN_JUNIT_H
#define RAMIFY_GOLDEN_JUNIT_H

#include "golden/golden.h"

// Different and missing images are failures, scenes that fail to render errors; orphans are listed
// in the suite's output. suite: its name.
bool junit_write(const char *file, const char *suite, const GoldenResults *results, Error *e);

#endif
