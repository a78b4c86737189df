// Views of OpenColorIO's configurations, through the plug-in ramify-ocio.so (base/plugin.h).
#ifndef RAMIFY_IMAGE_OCIO_H
#define RAMIFY_IMAGE_OCIO_H

#include "image/image.h"

// Which view of which configuration. NULL: the configuration's default; all strings are borrowed.
typedef struct OcioParams {
    const char *config; // file, or the name of a built-in configuration: "ocio://..."
    const char *display, *view;
    const char *look;  // looks in place of the view's, as in "grade, -warm"
    const char *space; // the colour space that is linear Rec. 709
} OcioParams;

// Can pictures be shown so? ERROR_INPUT with a key of OcioParams (error_key) and a list of what the
// configuration has; when the plug-in or the configuration cannot be loaded; ERROR_MEMORY.
bool ocio_check(const OcioParams *params, Error *e);

// Turns linear Rec. 709 into display values, in place; 3 or 4 channels, alpha is kept. Errors as
// above.
bool ocio_apply(const OcioParams *params, Image *image, Error *e);

// The functions of the plug-in.
typedef struct OcioPlugin {
    size_t size; // of this struct
    bool (*check)(const OcioParams *params, Error *e);
    bool (*apply)(const OcioParams *params, Image *image, Error *e);
} OcioPlugin;

#define OCIO_PLUGIN "ocio" // see plugin_table
#define OCIO_VIEWS "views_ocio"

#endif
