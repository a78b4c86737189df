#include "api/libraries.h"

#include <Imath/ImathConfig.h>
#include <OpenColorIO/OpenColorABI.h>
#include <OpenEXR/OpenEXRConfig.h>
#include <OpenImageIO/oiioversion.h>
#include <embree3/rtcore_config.h>
#include <gdal/gdal_version.h>
#include <jconfig.h>
#include <oneapi/tbb/version.h>
#include <opensubdiv/version.h>
#include <openvdb/version.h>
#include <png.h>

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
#define OIIO TEXT(OIIO_VERSION_MAJOR) "." TEXT(OIIO_VERSION_MINOR) "." TEXT(OIIO_VERSION_PATCH)
#define OSD                        \
    TEXT(OPENSUBDIV_VERSION_MAJOR) \
    "." TEXT(OPENSUBDIV_VERSION_MINOR) "." TEXT(OPENSUBDIV_VERSION_PATCH)

const char *libraries_compiled(void)
{
    return "Embree " RTC_VERSION_STRING ", OpenSubdiv " OSD
           ", OpenVDB " OPENVDB_LIBRARY_VERSION_STRING ", OpenImageIO " OIIO
           ", libpng " PNG_LIBPNG_VER_STRING
           ", libjpeg-turbo " TEXT(LIBJPEG_TURBO_VERSION) ", OpenEXR " OPENEXR_VERSION_STRING
                                                          ", Imath " IMATH_VERSION_STRING
                                                          ", OpenColorIO " OCIO_VERSION
                                                          ", GDAL " GDAL_RELEASE_NAME
                                                          ", TBB " TBB_VERSION_STRING;
}
