#include "image/codec.h"

#include "base/plugin.h"
#include "image/image.h"

const ImageReader *image_reader(Error *e)
{
    return plugin_table("oiio", "image_reader_oiio", sizeof(ImageReader), e);
}

const ImageWriter *image_writer(Error *e)
{
    return plugin_table("write", "image_writer_write", sizeof(ImageWriter), e);
}

bool image_files_check(Error *e)
{
    return image_writer(e);
}
