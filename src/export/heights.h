// Height fields as files.
#ifndef RAMIFY_EXPORT_HEIGHTS_H
#define RAMIFY_EXPORT_HEIGHTS_H

#include "base/run.h"
#include "land/height_field.h"

// The ending chooses the format: 16-bit .png, black at the lowest and white at the highest point;
// float .exr in metres (channel Y); .asc, an Esri ASCII grid in metres, rows from north (-z) to
// south, missing heights -9999; .tif, a GeoTIFF (land/geotiff.h). Pictures hold their scale as
// metadata (ramify:low, ramify:high, ramify:cell, all in metres). ERROR_INPUT for other endings.
bool export_height_field(const HeightField *field, const char *file, const Run *run, Error *e);

#endif
