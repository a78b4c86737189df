// Prints the numbers of a comparison, as text and as JSON.
#ifndef RAMIFY_CLI_DIFFERENCE_H
#define RAMIFY_CLI_DIFFERENCE_H

#include "ramify.h"

// Prints one line without a newline: "RMSE 0.00012, maximum ...". threshold: negative = none.
void difference_print(const RamifyDifference *difference, double threshold);

// Prints the members of a JSON object, without braces: "width": 120, ...
void difference_print_json(const RamifyDifference *difference);

#endif
