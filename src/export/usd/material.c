// Materials as UsdPreviewSurface: diffuse under a coat, metal, emission and plain transparency,
// with textures by the mesh's uv.
#include "export/asset_path.h"
#include "export/usd/usda.h"

#include "export/vertex_colors.h"
#include "image/image.h"
#include "render/material/appearance.h"

#include <stdlib.h>

// Opacity of a dielectric that scatters: that of a layer of one centimetre.
static float cloudiness(const Material *m)
{
    float mean = (m->scattering.x + m->scattering.y + m->scattering.z) / 3.0f;
    return 1.0f - expf(-0.01f * mean);
}

// ---- shaders beside the surface, each named by what it feeds

// Reads a colour from the vertices.
static void primvar_reader(UsdaText *text, const char *name, const char *primvar, Vec3 fallback)
{
    usda_begin(text, NULL, "def Shader \"%s\"", name);
    usda_line(text, "uniform token info:id = \"UsdPrimvarReader_float3\"");
    usda_line(text, "string inputs:varname = \"%s\"", primvar);
    usda_vec3(text, "float3 inputs:fallback", fallback);
    usda_line(text, "float3 outputs:result");
    usda_end(text);
}

static bool texture(Usda *usda, const char *name, const char *material, const char *picture,
                    const Vec3 *scale, Error *e)
{
    UsdaText *text = &usda->text;
    char *path = asset_path(usda->file, picture, e);
    if (!path) {
        return false;
    }
    usda_begin(text, NULL, "def Shader \"%s\"", name);
    usda_line(text, "uniform token info:id = \"UsdUVTexture\"");
    usda_asset(text, "asset inputs:file", path);
    usda_line(text, "float2 inputs:st.connect = </World/Materials/%s/Place.outputs:result>",
              material);
    usda_line(text, "token inputs:sourceColorSpace = \"%s\"", scale ? "auto" : "raw");
    usda_line(text, "token inputs:wrapS = \"repeat\"");
    usda_line(text, "token inputs:wrapT = \"repeat\"");
    if (scale) {
        usda_line(text, "float4 inputs:scale = (%.9g, %.9g, %.9g, 1)", (double)scale->x,
                  (double)scale->y, (double)scale->z);
        usda_line(text, "float3 outputs:rgb");
    } else {
        usda_line(text, "float outputs:r");
        usda_line(text, "float outputs:a");
    }
    usda_end(text);
    free(path);
    return true;
}

static void place_reader(UsdaText *text)
{
    usda_begin(text, NULL, "def Shader \"Place\"");
    usda_line(text, "uniform token info:id = \"UsdPrimvarReader_float2\"");
    usda_line(text, "string inputs:varname = \"st\"");
    usda_line(text, "float2 outputs:result");
    usda_end(text);
}

// The channel of an alpha texture: alpha if it has one, else the first.
static bool opacity_channel(const char *picture, char *channel, const Run *run, Error *e)
{
    Image *image = image_read(picture, run, e);
    if (image) {
        *channel = image->channels == 2 || image->channels == 4 ? 'a' : 'r';
    }
    image_free(image);
    return image;
}

static void surface(Usda *usda, const Material *m, const char *name, bool glows, char opacity_from)
{
    UsdaText *text = &usda->text;
    Appearance a = material_appearance(m);
    float roughness = appearance_is_matt(&a) ? 1.0f : a.roughness;
    usda_begin(text, NULL, "def Shader \"Surface\"");
    usda_line(text, "uniform token info:id = \"UsdPreviewSurface\"");
    if (m->texture || vertex_colors_wanted(&usda->source->options, m)) {
        usda_line(text, "color3f inputs:diffuseColor.connect = </World/Materials/%s/Color.%s>",
                  name, m->texture ? "outputs:rgb" : "outputs:result");
    } else {
        usda_vec3(text, "color3f inputs:diffuseColor", a.color);
    }
    if (glows) {
        usda_line(text,
                  "color3f inputs:emissiveColor.connect = </World/Materials/%s/"
                  "Emission.outputs:result>",
                  name);
    } else {
        usda_vec3(text, "color3f inputs:emissiveColor", a.emission);
    }
    if (opacity_from) {
        usda_line(text, "float inputs:opacity.connect = </World/Materials/%s/Opacity.outputs:%c>",
                  name, opacity_from);
    } else {
        usda_float(text, "float inputs:opacity", appearance_is_clear(&a) ? cloudiness(m) : 1.0f);
    }
    usda_float(text, "float inputs:metallic", a.metalness);
    usda_float(text, "float inputs:roughness", roughness);
    usda_float(text, "float inputs:ior", a.ior);
    usda_line(text, "token outputs:surface");
    usda_end(text);
}

static bool material(Usda *usda, int index, Error *e)
{
    const Material *m = &usda->source->world->material[index];
    const char *name = usda->material[index];
    UsdaText *text = &usda->text;
    char opacity_from = 0;
    if (m->alpha_texture && !opacity_channel(m->alpha_texture, &opacity_from, usda->run, e)) {
        return false;
    }
    usda_begin(text, NULL, "def Material \"%s\"", name);
    usda_line(text, "token outputs:surface.connect = </World/Materials/%s/Surface.outputs:surface>",
              name);
    surface(usda, m, name, usda->glows[index], opacity_from);
    bool done = true;
    if (m->texture) {
        done = texture(usda, "Color", name, m->texture, &m->color, e);
    } else if (vertex_colors_wanted(&usda->source->options, m)) {
        primvar_reader(text, "Color", "displayColor", m->color);
    }
    if (usda->glows[index]) {
        primvar_reader(text, "Emission", "emission", m->radiance);
    }
    if (done && m->alpha_texture) {
        done = texture(usda, "Opacity", name, m->alpha_texture, NULL, e);
    }
    if (m->texture || m->alpha_texture) {
        place_reader(text);
    }
    usda_end(text);
    return done;
}

bool usda_materials(Usda *usda, Error *e)
{
    bool done = true;
    usda_begin(&usda->text, NULL, "def Scope \"Materials\"");
    for (int i = 0; done && i < usda->source->world->material_count; i++) {
        done = !usda->used[i] || material(usda, i, e);
    }
    usda_end(&usda->text);
    return done;
}
