// Self-contained HTML report of results, with a slider between ours and stored, their difference
// and the numbers; failures come first.
#ifndef RAMIFY_GOLDEN_REPORT_H
#define RAMIFY_GOLDEN_REPORT_H

#include "golden/golden.h"

// title: of the page. ours, stored: captions of the two pictures. The results must include
// pictures.
bool report_write(const char *file, const char *title, const char *ours, const char *stored,
                  const GoldenResults *results, Error *e);

#endif
