#include "image/codec.h"

#include "base/plugin.h"

const ImageCodec *image_codec(Error *e)
{
    return plugin_table(OIIO_PLUGIN, IMAGE_CODEC, sizeof(ImageCodec), e);
}

bool image_files_check(Error *e)
{
    return image_codec(e);
}
