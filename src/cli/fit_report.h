// Prints what a fit does and finds to stdout, as a table and as JSON.
#ifndef RAMIFY_CLI_FIT_REPORT_H
#define RAMIFY_CLI_FIT_REPORT_H

#include "ramify.h"

// What the fit works on; all borrowed.
typedef struct FitReport {
    const RamifyScene *scene;
    const RamifyRange *ranges;
    int range_count, target_count;
} FitReport;

// Prints the table's line of the last evaluation; before the first one the ranges, the targets and
// the heads of the columns.
void fit_report_last(const FitReport *report, const RamifyFit *fit);

// Prints the best parameters as options --set.
void fit_report_best(const FitReport *report, const RamifyFit *fit);

// Prints parameters, targets and all evaluations.
void fit_report_json(const FitReport *report, const RamifyFit *fit);

#endif
