// The child's side of geotiff.c: GDAL encodes in the plug-in ramify-gdal.so, into memory. For these
// two files alone.
#ifndef RAMIFY_LAND_GEOTIFF_CHILD_H
#define RAMIFY_LAND_GEOTIFF_CHILD_H

#include "base/child.h"
#include "land/height_field.h"

#define GEOTIFF_CODEC "geotiff_codec_gdal"

// The result is the file, byte by byte.
typedef struct GeoTiffJob {
    const HeightField *field;
    float missing;
} GeoTiffJob;

typedef struct GeoTiffCodec {
    size_t size;         // of this struct
    void (*start)(void); // before the child is forked
    ChildTask *write;    // of a GeoTiffJob
} GeoTiffCodec;

#endif
