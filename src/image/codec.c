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

bool image_write_display(const char *file, const Image *image, const char *metadata, Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec && codec->write_display(file, image, metadata, e);
}

bool image_write_display16(const char *file, const Image *image, const char *metadata, Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec && codec->write_display16(file, image, metadata, e);
}

bool image_write_grey16(const char *file, const Image *image, const char *metadata, Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec && codec->write_grey16(file, image, metadata, e);
}

bool image_write_exr(const char *file, const ImageLayer *layers, int count, const char *metadata,
                     Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec && codec->write_exr(file, layers, count, NULL, metadata, e);
}

bool image_write_exr_window(const char *file, const ImageLayer *layers, int count,
                            const int window[4], const char *metadata, Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec && codec->write_exr(file, layers, count, window, metadata, e);
}

bool image_encode_png(const Image *image, const char *metadata, unsigned char **bytes, size_t *size,
                      Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec && codec->encode_png(image, metadata, bytes, size, e);
}

Image *image_decode_png(const unsigned char *bytes, size_t size, Error *e)
{
    const ImageCodec *codec = image_codec(e);
    return codec ? codec->decode_png(bytes, size, e) : NULL;
}
