// The child's side of survey.c: rasters are parsed by GDAL, in the plug-in ramify-gdal.so, only in
// a process with limits. For these two files alone.
#ifndef RAMIFY_LAND_SURVEY_RASTER_H
#define RAMIFY_LAND_SURVEY_RASTER_H

#include "base/child.h"

#define GDAL_PLUGIN "gdal" // see plugin_table
#define SURVEY_CODEC "survey_codec_gdal"

typedef struct SurveyJob {
    const char *file;
    int band;
} SurveyJob;

enum { SURVEY_REFERENCE_MOST = 65536 }; // bytes

// Precedes the reference system, then the heights: columns x rows floats, m, from the north-west
// row by row; NaN = no data.
typedef struct SurveyHeader {
    int32_t columns, rows;
    int32_t placed;    // 0 = the file tells no place
    int32_t reference; // bytes of the reference system as WKT; 0 = none
    double cell[2];    // m: between samples, to the east and to the south
    double middle[2];  // its coordinates of the raster's middle
    double unit[2];    // m of one unit of its coordinates
} SurveyHeader;

typedef struct SurveyCodec {
    size_t size;         // of this struct
    void (*start)(void); // before the child is forked
    ChildTask *read;     // of a SurveyJob
} SurveyCodec;

#endif
