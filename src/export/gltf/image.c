#include "export/gltf/glb.h"

#include "base/file_beside.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/tone_curve.h"

#include <math.h>

#include <stdlib.h>
#include <string.h>

static bool given(const char *file)
{
    return file && file[0];
}

bool glb_has_image(const Material *m)
{
    return given(m->texture) || given(m->alpha_texture);
}

static bool same(const char *a, const char *b)
{
    return given(a) == given(b) && (!given(a) || strcmp(a, b) == 0);
}

static bool read_bytes(const char *file, GlbImage *image, Error *e)
{
    FILE *stream = file_open_regular(file, e);
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
    if (!stream) {
        return false;
    }
    bool good = !ferror(stream);
    fclose(stream);
    return good || error_set(e, ERROR_IO, "'%s' cannot be read", file);
}

// Reads the picture to check it, since files that are copied are not decoded otherwise.
static bool check_picture(const char *file, const Run *run, Error *e)
{
    Image *picture = image_read(file, run, e);
    image_free(picture);
    return picture != NULL;
}

// Copies PNG and JPEG files unchanged.
static bool take_file(GlbImage *image, const char *file, bool *taken, const Run *run, Error *e)
{
    static const unsigned char png[4] = {0x89, 'P', 'N', 'G'}, jpeg[3] = {0xff, 0xd8, 0xff};
    if (!read_bytes(file, image, e)) {
        return false;
    }
    image->jpeg = image->size > 3 && memcmp(image->bytes, jpeg, sizeof jpeg) == 0;
    *taken = image->jpeg || (image->size > 4 && memcmp(image->bytes, png, sizeof png) == 0);
    if (*taken) {
        return check_picture(file, run, e);
    }
    free(image->bytes);
    image->bytes = NULL;
    image->size = 0;
    return true;
}

// The channel at pixel (x, y) of `scale`, which may have more pixels.
static float pixel_at(const Image *image, int x, int y, const Image *scale, int channel)
{
    int64_t column = (int64_t)x * image->width / scale->width;
    int64_t row = (int64_t)y * image->height / scale->height;
    return image->pixel[(row * image->width + column) * image->channels + channel];
}

// Colour from one picture, alpha from another, as in material_opacity. Either may be NULL, but not
// both.
static Image *combine(const Image *color, bool linear, const Image *alpha, Error *e)
{
    const Image *wide = !alpha || (color && color->width > alpha->width) ? color : alpha;
    const Image *high = !alpha || (color && color->height > alpha->height) ? color : alpha;
    Image *out = wide ? image_new(wide->width, high->height, alpha ? 4 : 3, e) : NULL;
    int from = alpha && (alpha->channels == 4 || alpha->channels == 2) ? alpha->channels - 1 : 0;
    for (int y = 0; out && y < out->height; y++) {
        for (int x = 0; x < out->width; x++) {
            float *pixel = out->pixel + ((int64_t)y * out->width + x) * out->channels;
            for (int k = 0; k < 3; k++) {
                float c = color ? pixel_at(color, x, y, out, color->channels >= 3 ? k : 0) : 1.0f;
                pixel[k] = linear ? (float)export_srgb8(c) / 255.0f : c;
            }
            if (alpha) {
                pixel[3] = pixel_at(alpha, x, y, out, from);
            }
        }
    }
    return out;
}

static bool make_picture(GlbImage *image, const Run *run, Error *e)
{
    bool linear = false;
    size_t size = 0;
    Image *color = given(image->color) ? image_read_color(image->color, &linear, run, e) : NULL;
    Image *alpha = given(image->alpha) ? image_read(image->alpha, run, e) : NULL;
    bool read = (color || !given(image->color)) && (alpha || !given(image->alpha));
    Image *both = read ? combine(color, linear, alpha, e) : NULL;
    bool done = both && image_encode_png(both, NULL, &image->bytes, &size, e);
    image->size = done ? (int64_t)size : 0;
    image_free(color);
    image_free(alpha);
    image_free(both);
    return done;
}

int64_t glb_image_number(const Glb *glb, const Material *m)
{
    for (int64_t i = 0; i < glb->image_count && glb_has_image(m); i++) {
        if (same(glb->image[i].color, m->texture) && same(glb->image[i].alpha, m->alpha_texture)) {
            return i;
        }
    }
    return -1;
}

static GlbImage *new_image(Glb *glb, GlbImage image, Error *e)
{
    if (!memory_reserve(&glb->image, &glb->image_capacity, glb->image_count + 1, sizeof *glb->image,
                        e)) {
        return NULL;
    }
    glb->image[glb->image_count] = image;
    return &glb->image[glb->image_count++];
}

bool glb_add_image(Glb *glb, const Material *m, Error *e)
{
    if (!glb_has_image(m) || glb_image_number(glb, m) >= 0) {
        return true;
    }
    GlbImage *image = new_image(glb, (GlbImage){.color = m->texture, .alpha = m->alpha_texture}, e);
    if (!image) {
        return false;
    }
    bool taken = false;
    bool done = given(m->alpha_texture) || take_file(image, m->texture, &taken, glb->run, e);
    done = done && (taken || make_picture(image, glb->run, e));
    if (!done) {
        error_prefix(e, "material '%s': ", m->name);
    }
    return done;
}

enum { RAMP = 256 }; // shades: every 8-bit value

// The hue is in the picture because Blender 3.4 ignores the factor of an emissive texture.
static Image *make_ramp(const Material *m, Error *e)
{
    float most = fmaxf(m->radiance.x, fmaxf(m->radiance.y, m->radiance.z));
    Vec3 hue = vec3_scale(m->radiance, most > 0.0f ? 1.0f / most : 0.0f);
    Image *ramp = image_new(RAMP, 1, 3, e);
    for (int i = 0; ramp && i < RAMP; i++) {
        float share = tone_linear_from_srgb((float)i / (float)(RAMP - 1));
        const float shade[3] = {share * hue.x, share * hue.y, share * hue.z};
        for (int k = 0; k < 3; k++) {
            ramp->pixel[3 * i + k] = (float)export_srgb8(shade[k]) / 255.0f;
        }
    }
    return ramp;
}

bool glb_add_ramp(Glb *glb, const Material *m, Error *e)
{
    Image *ramp = make_ramp(m, e);
    GlbImage *image = ramp ? new_image(glb, (GlbImage){.ramp = m}, e) : NULL;
    size_t size = 0;
    bool done = image && image_encode_png(ramp, NULL, &image->bytes, &size, e);
    if (done) {
        image->size = (int64_t)size;
    }
    image_free(ramp);
    return done;
}

int64_t glb_ramp_number(const Glb *glb, const Material *m)
{
    for (int64_t i = 0; i < glb->image_count; i++) {
        if (glb->image[i].ramp == m) {
            return i;
        }
    }
    return -1;
}

float glb_ramp_place(float share)
{
    return (tone_srgb_from_linear(share) * (float)(RAMP - 1) + 0.5f) / (float)RAMP;
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
    int64_t view = first_image_view(glb), ramps = 0;
    for (int64_t i = 0; i < glb->image_count; i++) {
        ramps += glb->image[i].ramp != NULL;
    }
    bool both = ramps > 0 && ramps < glb->image_count;
    fputs(",\n\"textures\":[", json);
    for (int64_t i = 0; i < glb->image_count; i++) {
        fprintf(json, "%s{\"sampler\":%d,\"source\":%d}", i > 0 ? "," : "",
                both && glb->image[i].ramp, (int)i);
    }
    fputs("],\n\"samplers\":[", json);
    if (ramps < glb->image_count) {
        fputs("{\"magFilter\":9729,\"minFilter\":9987}", json);
    }
    if (ramps > 0) { // no coarser levels, no repeating
        fprintf(json, "%s{\"magFilter\":9729,\"minFilter\":9729,\"wrapS\":33071,\"wrapT\":33071}",
                both ? "," : "");
    }
    fputs("],\n\"images\":[", json);
    for (int64_t i = 0; i < glb->image_count; i++) {
        fprintf(json, "%s{\"bufferView\":%d,\"mimeType\":\"image/%s\"}", i > 0 ? "," : "",
                (int)(view + i), glb->image[i].jpeg ? "jpeg" : "png");
    }
    fputc(']', json);
}
