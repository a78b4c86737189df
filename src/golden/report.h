// The page that shows results to people: one HTML file that needs nothing else, with a slider
// between ours and stored, their difference and the numbers; what is not alike comes first.
#ifndef RAMIFY_GOLDEN_REPORT_H
#define RAMIFY_GOLDEN_REPORT_H

#include "golden/golden.h"

// title: of the page. ours, stored: what the two pictures are called. The results must have been
// made with pictures.
bool report_write(const char *file, const char *title, const char *ours, const char *stored,
                  const GoldenResults *results, Error *e);

#endif
