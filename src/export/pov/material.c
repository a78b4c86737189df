// Materials, each as a macro of the colours that vary over the surface.
#include "export/pov/pov.h"

#include "base/color.h"
#include "render/material/thin_film.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

bool pov_has_picture(const Material *m)
{
    return m->texture || m->alpha_texture;
}

// "2_bark": POV-Ray's names are letters, digits and underscores.
static void write_name(Pov *pov, int material)
{
    char name[sizeof pov->world->material->name + 1];
    const char *from = pov->world->material[material].name;
    size_t i = 0;
    for (; from[i] && i + 1 < sizeof name; i++) {
        name[i] = (char)(isalnum((unsigned char)from[i]) ? from[i] : '_');
    }
    name[i] = 0;
    file_writer_print(pov->out, "%d_%s", material, name);
}

// ---- finishes

// POV-Ray has no blurred reflection: the share of a glossy lobe that becomes a mirror.
static float mirror_share(float roughness)
{
    return 1.0f - smoothstepf(0.15f, 0.55f, roughness);
}

// POV-Ray's highlight is the cosine of the half vector to the power of 1 / roughness; a GGX lobe of
// this alpha is about as wide as the power 2 / alpha^2 - 2.
static float highlight_roughness(float roughness)
{
    float a2 = fmaxf(powf(roughness, 4.0f), 1e-6f);
    return clampf(a2 / fmaxf(2.0f - 2.0f * a2, 1e-3f), 1e-4f, 1.0f);
}

static void write_highlight(Pov *pov, float albedo, float roughness, bool metallic)
{
    if (albedo > 0.0f) {
        file_writer_print(pov->out, " specular albedo %.5g roughness %.5g%s", (double)albedo,
                          (double)highlight_roughness(roughness), metallic ? " metallic" : "");
    }
}

// Reflection follows Schlick's law, as in ours. Of the light of lamps that a rough metal reflects,
// half becomes a highlight and half diffuse, which also shows the sky.
static void write_conductor_finish(Pov *pov, float roughness)
{
    float share = mirror_share(roughness), rest = 0.5f * (1.0f - share);
    file_writer_print(pov->out, "finish { diffuse %.5g", (double)rest);
    write_highlight(pov, rest, roughness, true);
    if (share > 0.0f) {
        file_writer_print(pov->out, " reflection { rgb C * %.5g, rgb %.5g falloff 5 }",
                          (double)share, (double)share);
    }
    file_writer_text(pov->out, " }");
}

static void write_coated_finish(Pov *pov, const Appearance *a)
{
    float f0 = 0.08f * a->specular, metal = a->metalness;
    float share = mirror_share(a->roughness), rest = 1.0f - share;
    float matt = (1.0f - metal) * (1.0f - f0) + 0.5f * metal * rest;
    file_writer_print(pov->out, "finish { diffuse %.5g", (double)matt);
    write_highlight(pov, f0 * (1.0f - metal) * rest + 0.5f * metal * rest, a->roughness,
                    metal > 0.5f);
    if (share > 0.0f && (f0 > 0.0f || metal > 0.0f)) {
        file_writer_print(pov->out,
                          " reflection { rgb (C * %.5g + %.5g) * %.5g, rgb %.5g falloff 5 }",
                          (double)metal, (double)(f0 * (1.0f - metal)), (double)share,
                          (double)(share * lerpf(fminf(1.0f, 50.0f * f0), 1.0f, metal)));
    }
    file_writer_text(pov->out, " }");
}

// Two layers, each half transparent and of twice the strength: POV-Ray has one colour for
// reflection and transmission, a leaf has two.
static void write_sheet(Pov *pov, const Appearance *a, bool picture, const char *pigment)
{
    float f0 = 0.08f * a->specular, under = 1.0f - f0;
    if (picture) {
        float t = luminance(a->transmittance), c = fmaxf(luminance(a->color), 1e-3f);
        file_writer_print(pov->out, "texture { %s finish { diffuse %.5g, %.5g", pigment,
                          (double)under, (double)(under * t / c));
        write_highlight(pov, f0, a->roughness, false);
        file_writer_text(pov->out, " } }");
        return;
    }
    file_writer_print(pov->out, "texture { pigment { rgb T } finish { diffuse 0, %.5g } }\n",
                      (double)(2.0f * under));
    file_writer_print(pov->out, "texture { pigment { rgb C transmit 0.5 } finish { diffuse %.5g, 0",
                      (double)(2.0f * under));
    write_highlight(pov, f0, a->roughness, false);
    file_writer_text(pov->out, " } }");
}

// Interference: reflectance varies between 0 and twice its mean with the film's thickness.
static void write_film(Pov *pov, const Appearance *a)
{
    float mean = thin_film_mean(a->ior, 1.0f);
    file_writer_print(pov->out,
                      "texture { pigment { rgb C filter 1 } finish { diffuse 0 reflection "
                      "{ rgb %.5g, rgb 1 falloff 5 } conserve_energy\n"
                      "    irid { 1 thickness %.5g turbulence %.5g } } }",
                      (double)mean, (double)(a->ior * a->film_thickness * 1e-3f),
                      (double)(0.5f * a->film_variation));
}

static void write_textures(Pov *pov, const Material *m, const char *pigment)
{
    Appearance a = material_appearance(m);
    if (a.traits & TRAIT_EMISSIVE) {
        file_writer_text(pov->out, "texture { pigment { rgb C } finish { diffuse 0 emission 1 } }");
    } else if (a.traits & TRAIT_THIN) {
        write_film(pov, &a);
    } else if (a.traits & TRAIT_BODY) {
        file_writer_print(pov->out, "texture { pigment { rgb C filter 1 } finish { diffuse 0%s } }",
                          a.ior > 1.0f ? " reflection { 0, 1 fresnel on } conserve_energy" : "");
    } else if (!(a.traits & TRAIT_OPAQUE)) {
        write_sheet(pov, &a, pov_has_picture(m), pigment);
    } else {
        file_writer_print(pov->out, "texture { %s ", pigment);
        if (a.coated) {
            write_coated_finish(pov, &a);
        } else if (a.metalness > 0.0f) {
            write_conductor_finish(pov, a.roughness);
        } else {
            file_writer_text(pov->out, "finish { diffuse 1 }");
        }
        file_writer_text(pov->out, " }");
    }
}

// ---- interiors

// POV-Ray's fade_power 1001 is Beer and Lambert's law: exp(-(1 - fade_color) depth / distance).
static void write_absorption(Pov *pov, Vec3 absorption)
{
    float most = fmaxf(absorption.x, fmaxf(absorption.y, absorption.z));
    if (most > 0.0f) {
        file_writer_print(pov->out, " fade_power 1001 fade_distance %.9g fade_color rgb ",
                          (double)(pov->unit / most));
        pov_vector(pov, vec3(1.0f - absorption.x / most, 1.0f - absorption.y / most,
                             1.0f - absorption.z / most));
    }
}

// medium.c explains the quarter.
static void write_scattering(Pov *pov, const Material *m)
{
    if (luminance(m->scattering) > 0.0f) {
        file_writer_text(pov->out, "\n    media { scattering { 5, rgb ");
        pov_vector(pov, vec3_scale(m->scattering, 0.25f / pov->unit));
        file_writer_print(pov->out, " eccentricity %.5g extinction 4 } method 3 samples 8 }",
                          (double)m->anisotropy);
    }
}

static void write_interior(Pov *pov, int material)
{
    const Material *m = &pov->world->material[material];
    file_writer_text(pov->out, "#declare I");
    write_name(pov, material);
    file_writer_print(pov->out, " = interior { ior %.9g", (double)m->ior);
    write_absorption(pov, m->absorption);
    write_scattering(pov, m);
    file_writer_text(pov->out, " }\n");
}

void pov_interior(Pov *pov, int material)
{
    const Material *m = &pov->world->material[material];
    if (material_has(m, TRAIT_BODY)) {
        file_writer_text(pov->out, luminance(m->scattering) > 0.0f ? " hollow interior { I"
                                                                   : " interior { I");
        write_name(pov, material);
        file_writer_text(pov->out, " }");
    }
    if (material_has(m, TRAIT_EMISSIVE) && pov->glow_lights) {
        file_writer_text(pov->out, " no_shadow no_radiosity");
    }
}

// ---- all of them

void pov_textures(Pov *pov, int64_t number, int material, const Palette *colors)
{
    for (int i = 0; i < colors->count; i++) {
        file_writer_print(pov->out, "#declare P%lld_%d = M", (long long)number, i);
        write_name(pov, material);
        file_writer_text(pov->out, "(");
        pov_vector(pov, colors->color[i]);
        file_writer_text(pov->out, ",");
        pov_vector(pov, colors->second[i]);
        file_writer_text(pov->out, ")\n");
    }
}

static bool write_material(Pov *pov, int material)
{
    const Material *m = &pov->world->material[material];
    char pigment[PATH_MAX + 64] = "pigment { rgb C }", picture[PATH_MAX];
    if (pov_has_picture(m)) {
        if (!pov_bake_picture(pov, material, picture, sizeof picture)) {
            return false;
        }
        snprintf(pigment, sizeof pigment, "uv_mapping pigment { image_map { %s interpolate 2 } }",
                 picture);
    }
    file_writer_text(pov->out, "#macro M");
    write_name(pov, material);
    file_writer_text(pov->out, "(C, T)\n");
    write_textures(pov, m, pigment);
    file_writer_text(pov->out, "\n#end\n");
    if (material_has(m, TRAIT_BODY)) {
        write_interior(pov, material);
    }
    return true;
}

bool pov_materials(Pov *pov)
{
    for (int i = 0; i < pov->world->material_count; i++) {
        if (world_uses_material(pov->world, i) && !write_material(pov, i)) {
            return false;
        }
    }
    file_writer_text(pov->out, "\n");
    return true;
}
