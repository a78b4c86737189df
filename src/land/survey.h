// Surveyed land: heights from a raster in any format that GDAL reads (GeoTIFF, HGT, ASC, DTED,
// ...).
#ifndef RAMIFY_LAND_SURVEY_H
#define RAMIFY_LAND_SURVEY_H

#include "base/run.h"
#include "land/height_field.h"

// Reads a band (1 = the first) of a raster in a child process (base/child.h). The field is centred
// at the origin, in metres: north is -z, east is +x; degrees become metres by the ellipsoid WGS 84
// at the raster's middle. Rasters of more than HEIGHT_FIELD_MAX samples a side are averaged down.
// HeightField.place tells where it lies in the raster's own reference system.
// Samples without data take smooth heights from those around them.
// ERROR_INPUT with the file's name: no raster, rotated, no such band, no data at all.
HeightField *survey_read(const char *file, int band, const Run *run, Error *e);

#endif
