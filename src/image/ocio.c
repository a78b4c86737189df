#include "image/ocio.h"

#include "base/plugin.h"

static const OcioPlugin *plugin(Error *e)
{
    return plugin_table(OCIO_PLUGIN, OCIO_VIEWS, sizeof(OcioPlugin), e);
}

bool ocio_check(const OcioParams *params, Error *e)
{
    const OcioPlugin *ocio = plugin(e);
    return ocio && ocio->check(params, e);
}

bool ocio_apply(const OcioParams *params, Image *image, Error *e)
{
    const OcioPlugin *ocio = plugin(e);
    return ocio && ocio->apply(params, image, e);
}
