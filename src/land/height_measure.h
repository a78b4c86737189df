// Rivers and relief of a height field as geomorphologists measure them: Horton's laws (Horton 1945,
// Strahler 1957), Hack's law (1957), the slope-area concavity (Flint 1974) and the hypsometric
// integral. For any height field, grown or surveyed.
#ifndef RAMIFY_LAND_HEIGHT_MEASURE_H
#define RAMIFY_LAND_HEIGHT_MEASURE_H

#include "base/measures.h"
#include "land/height_drainage.h"

// Rivers are samples that more than `least_area` (m^2) drain through; 0 = a thousandth of the
// field, but no less than 32 cells.
bool height_field_measure(const HeightField *field, double least_area, MeasureList *list, Error *e);

// Strahler's order of every sample: 0 off the rivers.
bool drainage_orders(const Drainage *drainage, double least_area, uint8_t *order, Error *e);

// Reads an Esri ASCII grid (ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize
// or dx and dy, NODATA_value, heights from the north-west corner; x = east, z = south). Where the
// corner and cells can only be degrees of longitude and latitude (cells under 0.1, a corner within
// 360 x 90) cells become metres on the spheroid of WGS 84. Missing heights are NAN. ERROR_INPUT
// names file, line and what would be right.
HeightField *height_field_read_asc(const char *file, Error *e);

#endif
