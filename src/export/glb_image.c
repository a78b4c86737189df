#include "export/glb.h"

#include "base/memory.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static bool given(const char *file)
{
    return file && file[0];
}

static bool same(const char *a, const char *b)
{
    return given(a) == given(b) && (!given(a) || strcmp(a, b) == 0);
}

static bool read_bytes(const char *file, GlbImage *image, Error *e)
{
    FILE *stream = fopen(file, "rb");
    int64_t capacity = 0;
    size_t got = 1;
    while (stream && got > 0) {
        if (!memory_reserve(&image->bytes, &capacity, image->size + 65536, 1, e)) {
            fclose(stream);
            return false;
        }
        got = fread(image->bytes + image->size, 1, 65536, stream);
        image->size += (int64_t)got;
    }
    bool good = stream && !ferror(stream);
    if (stream) {
        fclose(stream);
    }
    return good || error_set(e, ERROR_IO, "'%s' cannot be read", file);
}

// PNG or JPEG, as it is.
static bool take_file(GlbImage *image, const char *file, bool *taken, Error *e)
{
    static const unsigned char png[4] = {0x89, 'P', 'N', 'G'}, jpeg[3] = {0xff, 0xd8, 0xff};
    if (!read_bytes(file, image, e)) {
        return false;
    }
    image->jpeg = image->size > 3 && memcmp(image->bytes, jpeg, sizeof jpeg) == 0;
    *taken = image->jpeg || (image->size > 4 && memcmp(image->bytes, png, sizeof png) == 0);
    if (!*taken) {
        free(image->bytes);
        image->bytes = NULL;
        image->size = 0;
    }
    return true;
}

static bool is_linear(const char *file)
{
    size_t length = strlen(file);
    return length > 4 && (strcasecmp(file + length - 4, ".exr") == 0 ||
                          strcasecmp(file + length - 4, ".hdr") == 0);
}

static float pixel_at(const Image *image, int x, int y, int channel)
{
    return image->pixel[((int64_t)y * image->width + x) * image->channels + channel];
}

// Colour from one picture, alpha from another: as material_opacity has it. Either may be NULL; as
// large as `size`, which is one of them.
static Image *combine(const Image *size, const Image *color, bool linear, const Image *alpha,
                      Error *e)
{
    Image *out = image_new(size->width, size->height, alpha ? 4 : 3, e);
    int from = alpha && (alpha->channels == 4 || alpha->channels == 2) ? alpha->channels - 1 : 0;
    for (int y = 0; out && y < out->height; y++) {
        for (int x = 0; x < out->width; x++) {
            float *pixel = out->pixel + ((int64_t)y * out->width + x) * out->channels;
            for (int k = 0; k < 3; k++) {
                float c = color ? pixel_at(color, x, y, color->channels >= 3 ? k : 0) : 1.0f;
                pixel[k] = linear ? (float)export_srgb8(c) / 255.0f : c;
            }
            if (alpha) {
                pixel[3] = pixel_at(alpha, (int)((int64_t)x * alpha->width / out->width),
                                    (int)((int64_t)y * alpha->height / out->height), from);
            }
        }
    }
    return out;
}

// As PNG, by way of a file in the folder for such.
static bool take_picture(GlbImage *image, const Image *picture, Error *e)
{
    const char *folder = getenv("TMPDIR");
    char name[4096];
    snprintf(name, sizeof name, "%s/ramify-XXXXXX.png", given(folder) ? folder : "/tmp");
    int descriptor = mkstemps(name, 4);
    if (descriptor < 0) {
        return error_set(e, ERROR_IO, "no file can be made in '%s'; TMPDIR names another folder",
                         given(folder) ? folder : "/tmp");
    }
    close(descriptor);
    bool done = image_write_display(name, picture, NULL, e) && read_bytes(name, image, e);
    unlink(name);
    return done;
}

static bool make_picture(GlbImage *image, Error *e)
{
    Image *color = given(image->color) ? image_read(image->color, e) : NULL;
    Image *alpha = given(image->alpha) ? image_read(image->alpha, e) : NULL;
    const Image *size = color ? color : alpha;
    bool read = (color || !given(image->color)) && (alpha || !given(image->alpha));
    Image *both =
        read && size ? combine(size, color, color && is_linear(image->color), alpha, e) : NULL;
    bool done = both && take_picture(image, both, e);
    image_free(color);
    image_free(alpha);
    image_free(both);
    return done;
}

int64_t glb_image_number(const Glb *glb, const Material *m)
{
    for (int64_t i = 0; i < glb->image_count; i++) {
        if (same(glb->image[i].color, m->texture) && same(glb->image[i].alpha, m->alpha_texture)) {
            return i;
        }
    }
    return -1;
}

bool glb_add_image(Glb *glb, const Material *m, Error *e)
{
    if ((!given(m->texture) && !given(m->alpha_texture)) || glb_image_number(glb, m) >= 0) {
        return true;
    }
    if (!memory_reserve(&glb->image, &glb->image_capacity, glb->image_count + 1, sizeof *glb->image,
                        e)) {
        return false;
    }
    GlbImage *image = &glb->image[glb->image_count++];
    *image = (GlbImage){.color = m->texture, .alpha = m->alpha_texture};
    bool taken = false;
    bool done = given(m->alpha_texture) || take_file(image, m->texture, &taken, e);
    done = done && (taken || make_picture(image, e));
    if (!done) {
        error_prefix(e, "material '%s': ", m->name);
    }
    return done;
}

static int64_t first_image_view(const Glb *glb)
{
    int64_t views = 0;
    for (int64_t i = 0; i < glb->part_count; i++) {
        views += glb_part_views(&glb->part[i]);
    }
    return views;
}

void glb_put_images(const Glb *glb, FILE *json)
{
    int64_t view = first_image_view(glb);
    fputs(",\n\"textures\":[", json);
    for (int64_t i = 0; i < glb->image_count; i++) {
        fprintf(json, "%s{\"sampler\":0,\"source\":%d}", i > 0 ? "," : "", (int)i);
    }
    fputs("],\n\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987}],\n\"images\":[", json);
    for (int64_t i = 0; i < glb->image_count; i++) {
        fprintf(json, "%s{\"bufferView\":%d,\"mimeType\":\"image/%s\"}", i > 0 ? "," : "",
                (int)(view + i), glb->image[i].jpeg ? "jpeg" : "png");
    }
    fputc(']', json);
}
