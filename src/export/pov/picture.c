// Textures of materials, baked with the material's colour and its alpha texture into one PNG each.
#include "export/pov/pov.h"

#include "image/image.h"
#include "image/tone_curve.h"
#include "render/material/texture.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

bool pov_make_folder(Pov *pov)
{
    return mkdir(pov->folder, 0777) == 0 || errno == EEXIST ||
           error_set(pov->e, ERROR_IO, "folder '%s' cannot be made: %s", pov->folder,
                     strerror(errno));
}

// Alpha if the picture has it, else the first channel, as in the renderer; not filtered, since
// POV-Ray filters it.
static float opacity_at(const Image *alpha, int x, int y, const Image *out)
{
    int64_t column = (int64_t)x * alpha->width / out->width;
    int64_t row = (int64_t)y * alpha->height / out->height;
    const float *pixel = alpha->pixel + (row * alpha->width + column) * alpha->channels;
    return pixel[alpha->channels % 2 == 0 ? alpha->channels - 1 : 0];
}

// Colours are looked up as in the renderer, at the centres of the texels.
static void fill_picture(const Material *m, const Texture *color, const Image *alpha, Image *out)
{
    float du = 1.0f / (float)out->width, dv = 1.0f / (float)out->height;
    for (int y = 0; y < out->height; y++) {
        for (int x = 0; x < out->width; x++) {
            Vec2 uv = {((float)x + 0.5f) * du, 1.0f - ((float)y + 0.5f) * dv};
            Vec3 c = color ? vec3_mul(m->color, texture_color(color, uv, du, dv)) : m->color;
            float *to = out->pixel + ((int64_t)y * out->width + x) * out->channels;
            to[0] = tone_srgb_from_linear(c.x);
            to[1] = tone_srgb_from_linear(c.y);
            to[2] = tone_srgb_from_linear(c.z);
            if (alpha) {
                to[3] = opacity_at(alpha, x, y, out);
            }
        }
    }
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static bool bake(Pov *pov, const Material *m, const Texture *color, const Image *size,
                 const Image *alpha, const char *file)
{
    int width = larger(size ? size->width : 1, alpha ? alpha->width : 1);
    int height = larger(size ? size->height : 1, alpha ? alpha->height : 1);
    Image *out = image_new(width, height, alpha ? 4 : 3, pov->e);
    if (!out) {
        return false;
    }
    fill_picture(m, color, alpha, out);
    bool done = image_write_display(file, out, NULL, pov->e);
    image_free(out);
    return done;
}

bool pov_bake_picture(Pov *pov, int material, char *name, int size)
{
    const Material *m = &pov->world->material[material];
    char file[PATH_MAX];
    snprintf(file, sizeof file, "%s/%d.png", pov->folder, material);
    snprintf(name, (size_t)size, "png \"%s/%d.png\" gamma srgb", pov->beside, material);
    TextureCache *cache = texture_cache_new(pov->e);
    const Texture *color =
        cache && m->texture ? texture_open(cache, m->texture, pov->run, pov->e) : NULL;
    Image *own = color ? image_read(m->texture, pov->run, pov->e) : NULL;
    Image *alpha = m->alpha_texture ? image_read(m->alpha_texture, pov->run, pov->e) : NULL;
    bool done = cache && (own || !m->texture) && (alpha || !m->alpha_texture) &&
                pov_make_folder(pov) && bake(pov, m, color, own, alpha, file);
    image_free(own);
    image_free(alpha);
    texture_cache_free(cache);
    return done;
}
