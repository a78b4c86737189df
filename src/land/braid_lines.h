// Streamlines of a braided river's flow: the stream function, whose contours they are.
#ifndef RAMIFY_LAND_BRAID_LINES_H
#define RAMIFY_LAND_BRAID_LINES_H

#include "land/braid.h"

// At the north-west corners of all cells and at the east end of each row, side * (side + 1) values,
// row by row: the share of the row's discharge that flows west of the corner, times `width`, m. So
// even flow over the whole width has it grow by a metre a metre, and a swift thread by more. The
// flow must be steady. NULL on failure; free it.
float *braid_lines_new(const Braid *braid, Error *e);

// At a place, u and v in cells from the first column and row; linear between corners.
float braid_line_at(const Braid *braid, const float *lines, double u, double v);

#endif
