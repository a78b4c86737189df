// What the files of the plug-in ramify-gdal.so share.
#ifndef RAMIFY_LAND_GDAL_INTERNAL_H
#define RAMIFY_LAND_GDAL_INTERNAL_H

#include <gdal/cpl_error.h>
#include <gdal/gdal.h>

#include <memory>

extern "C" {
#include "base/error.h"
}

namespace gdal
{

struct Closer {
    void operator()(GDALDatasetH set) const
    {
        GDALClose(set);
    }
};
using Dataset = std::unique_ptr<void, Closer>;

// Sets the error with GDAL's own words; false.
inline bool fail(Error *e, ErrorCode code, const char *what)
{
    const char *why = CPLGetLastErrorMsg();
    return error_set(e, code, "%s%s%s", what, why[0] ? ": " : "", why);
}

// Drivers are registered once, by the parent: the child may not load what they need.
inline void start()
{
    if (GDALGetDriverCount() == 0) {
        CPLSetErrorHandler(CPLQuietErrorHandler);
        GDALAllRegister();
    }
}

} // namespace gdal

#endif
