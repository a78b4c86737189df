// Geomorphological measures of rivers and relief: Horton's laws (Horton 1945, Strahler 1957),
// Hack's law (Hack 1957), slope-area concavity (Flint 1974) and the hypsometric integral. For any
// height field, generated or surveyed.
#ifndef RAMIFY_LAND_HEIGHT_MEASURE_H
#define RAMIFY_LAND_HEIGHT_MEASURE_H

#include "base/measures.h"
#include "land/height_drainage.h"

// The catchment, m^2, above which a sample is a river where nothing else is asked for: a thousandth
// of the field, but at least 32 cells.
double height_field_river_area(const HeightField *field);

// Rivers are samples with a catchment above `least_area` (m^2); 0 = height_field_river_area.
bool height_field_measure(const HeightField *field, double least_area, MeasureList *list, Error *e);

// Strahler order of every sample (Strahler 1957): 0 off the rivers.
bool drainage_orders(const Drainage *drainage, double least_area, uint8_t *order, Error *e);

// Reads an Esri ASCII grid (ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize
// or dx and dy, NODATA_value, heights from the north-west corner; x = east, z = south). A corner
// and cells that can only be degrees of longitude and latitude (cells under 0.1, a corner within
// 360 x 90) are converted to metres on the WGS 84 spheroid. Missing heights are NAN. ERROR_INPUT
// names file, line and what would be right. The caller frees the field.
HeightField *height_field_read_asc(const char *file, Error *e);

// The same from a text in memory, which it cuts into words; the name `file` is for errors alone.
HeightField *height_field_parse_asc(char *text, const char *file, Error *e);

#endif
