// Height fields as GeoTIFF, for geographic information systems.
#ifndef RAMIFY_LAND_GEOTIFF_H
#define RAMIFY_LAND_GEOTIFF_H

#include "base/run.h"
#include "land/height_field.h"

// 32-bit floats, rows from north (-z) to south, deflated; missing samples are GEOTIFF_MISSING, the
// file's nodata value. Pixels lie about the samples in the field's own reference system
// (HeightField.place), or in a local one of metres, x to the east and y = -z to the north. Encoded
// by GDAL in a child process. ERROR_IO if the file cannot be written.
#define GEOTIFF_MISSING (-9999.0f)
bool geotiff_write(const HeightField *field, const char *file, const Run *run, Error *e);

#endif
