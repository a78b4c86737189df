#include "image/image.h"

#include "base/memory.h"

#include <stdlib.h>

Image *image_new(int width, int height, int channels, Error *e)
{
    if (width < 1 || height < 1 || channels < 1) {
        error_set(e, ERROR_INPUT,
                  "an image cannot be %d x %d with %d channels; each must be at least 1", width,
                  height, channels);
        return NULL;
    }
    Image *image = memory_alloc(1, sizeof *image, e);
    if (!image) {
        return NULL;
    }
    *image = (Image){.width = width, .height = height, .channels = channels};
    image->pixel = memory_alloc_zero((int64_t)width * height, (size_t)channels * sizeof(float), e);
    if (!image->pixel) {
        free(image);
        return NULL;
    }
    return image;
}

void image_free(Image *image)
{
    if (image) {
        free(image->pixel);
        free(image);
    }
}

void texels_free(Texels *texels)
{
    if (texels) {
        free(texels->data);
        free(texels);
    }
}
