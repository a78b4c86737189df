// The results as JUnit XML, which continuous integration shows: one test case a scene.
#ifndef RAMIFY_GOLDEN_JUNIT_H
#define RAMIFY_GOLDEN_JUNIT_H

#include "golden/golden.h"

// Different and missing images are failures, scenes that cannot be rendered errors; orphans are
// told in the suite's output. suite: its name.
bool junit_write(const char *file, const char *suite, const GoldenResults *results, Error *e);

#endif
