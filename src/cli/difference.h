// The numbers of a comparison, for people and as JSON.
#ifndef RAMIFY_CLI_DIFFERENCE_H
#define RAMIFY_CLI_DIFFERENCE_H

#include "ramify.h"

// One line without its end: "RMSE 0.00012, maximum ...". threshold: negative = none.
void difference_print(const RamifyDifference *difference, double threshold);

// Members of a JSON object, without braces: "width": 120, ...
void difference_print_json(const RamifyDifference *difference);

#endif
