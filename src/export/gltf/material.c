#include "export/gltf/glb.h"

#include "base/memory.h"
#include "export/vertex_colors.h"
#include "render/material/appearance.h"

bool glb_gather_materials(Glb *glb, Error *e)
{
    const World *world = glb->source->world;
    glb->material = memory_alloc(world->material_count, sizeof *glb->material, e);
    bool done = glb->material;
    for (int i = 0; done && i < world->material_count; i++) {
        glb->material[i] = -1;
        for (int64_t k = 0; k < glb->part_count && glb->material[i] < 0; k++) {
            if (world->geometry.part[glb->part[k].index].material == i) {
                glb->material[i] = glb->material_count++;
            }
        }
        const Material *m = &world->material[i];
        done = glb->material[i] < 0 ||
               (glb_add_image(glb, m, e) && (glb->strongest[i] <= 0.0f || glb_add_ramp(glb, m, e)));
    }
    return done;
}

// ---- extensions

typedef enum Extension {
    EMISSIVE_STRENGTH,
    IOR,
    IRIDESCENCE,
    SPECULAR,
    TRANSMISSION,
    VOLUME,
    EXTENSION_COUNT
} Extension;

static const char *const EXTENSION_NAMES[EXTENSION_COUNT] = {
    "KHR_materials_emissive_strength", "KHR_materials_ior",          "KHR_materials_iridescence",
    "KHR_materials_specular",          "KHR_materials_transmission", "KHR_materials_volume"};

static float most(Vec3 v)
{
    return fmaxf(v.x, fmaxf(v.y, v.z));
}

static float strongest_glow(const Glb *glb, const Material *m)
{
    return glb->strongest[m - glb->source->world->material];
}

// The largest channel of the radiance at its strongest glow.
static float brightness(const Glb *glb, const Material *m)
{
    float glow = strongest_glow(glb, m);
    return most(m->radiance) * (glow > 0.0f ? glow : 1.0f);
}

static bool uses(const Glb *glb, const Material *m, Extension extension)
{
    Appearance a = material_appearance(m);
    switch (extension) {
    case EMISSIVE_STRENGTH:
        return a.traits & TRAIT_EMISSIVE &&
               (strongest_glow(glb, m) > 0.0f || most(a.emission) > 1.0f);
    case IOR:
        return appearance_is_clear(&a) || (a.coated && a.specular > 0.5f);
    case IRIDESCENCE:
        return a.traits & TRAIT_THIN;
    case SPECULAR:
        return appearance_is_matt(&a) || (a.coated && a.specular < 0.5f);
    case TRANSMISSION:
        return appearance_is_clear(&a);
    case VOLUME:
        return a.traits & TRAIT_BODY;
    case EXTENSION_COUNT:
        break;
    }
    return false;
}

void glb_put_material_extensions(const Glb *glb, FILE *json)
{
    for (Extension x = 0; x < EXTENSION_COUNT; x++) {
        bool used = false;
        for (int i = 0; i < glb->source->world->material_count; i++) {
            used =
                used || (glb->material[i] >= 0 && uses(glb, &glb->source->world->material[i], x));
        }
        if (used) {
            fprintf(json, "\"%s\",", EXTENSION_NAMES[x]);
        }
    }
}

static void put_number(FILE *json, const char *key, float value)
{
    fprintf(json, "\"%s\":", key);
    json_put_float(json, value);
}

// Approximate thickness of bodies of this material: the smallest side of the largest bounding box.
static float thickness(const Glb *glb, const Material *m)
{
    const World *world = glb->source->world;
    float deepest = 0.0f;
    for (int64_t i = 0; i < glb->part_count; i++) {
        const GlbPart *part = &glb->part[i];
        if (&world->material[world->geometry.part[part->index].material] == m) {
            Vec3 size = vec3_sub(part->bounds.high, part->bounds.low);
            deepest = fmaxf(deepest, fminf(size.x, fminf(size.y, size.z)));
        }
    }
    return deepest;
}

// glTF has no scattering: scattered light counts as absorbed.
static void put_volume(const Glb *glb, const Material *m, FILE *json)
{
    Vec3 lost = vec3_add(m->absorption, m->scattering);
    float strongest = most(lost);
    put_number(json, "thicknessFactor", thickness(glb, m));
    if (strongest > 0.0f) {
        fputc(',', json);
        put_number(json, "attenuationDistance", 1.0f / strongest);
        fputc(',', json);
        json_put_color(
            json, "attenuationColor",
            vec3(expf(-lost.x / strongest), expf(-lost.y / strongest), expf(-lost.z / strongest)));
    }
}

static void put_extension(const Glb *glb, const Material *m, Extension x, FILE *json)
{
    Appearance a = material_appearance(m);
    fprintf(json, "\"%s\":{", EXTENSION_NAMES[x]);
    switch (x) {
    case EMISSIVE_STRENGTH:
        put_number(json, "emissiveStrength", brightness(glb, m));
        break;
    case IOR:
        put_number(json, "ior", fmaxf(a.ior, 1.0f));
        break;
    case IRIDESCENCE:
        fputs("\"iridescenceFactor\":1,", json);
        put_number(json, "iridescenceIor", a.ior);
        fputc(',', json);
        put_number(json, "iridescenceThicknessMaximum", a.film_thickness);
        break;
    case SPECULAR:
        put_number(json, "specularFactor", 2.0f * fmaxf(a.specular, 0.0f));
        break;
    case TRANSMISSION:
        fputs("\"transmissionFactor\":1", json);
        break;
    case VOLUME:
        put_volume(glb, m, json);
        break;
    case EXTENSION_COUNT:
        break;
    }
    fputc('}', json);
}

// ---- materials

static void put_surface(const Glb *glb, const Material *m, FILE *json)
{
    Appearance a = material_appearance(m);
    Vec3 color = vertex_colors_wanted(&glb->source->options, m) ? vec3_splat(1.0f) : a.color;
    color = vec3_max(vec3_min(color, vec3_splat(1.0f)), vec3_splat(0.0f));
    int64_t image = glb_image_number(glb, m);
    fputs(",\"pbrMetallicRoughness\":{", json);
    json_put_floats(json, "baseColorFactor", (const float[]){color.x, color.y, color.z, 1.0f}, 4);
    if (image >= 0) {
        fprintf(json, ",\"baseColorTexture\":{\"index\":%d}", (int)image);
    }
    fputc(',', json);
    put_number(json, "metallicFactor", clampf(a.metalness, 0.0f, 1.0f));
    fputc(',', json);
    put_number(json, "roughnessFactor",
               appearance_is_matt(&a) ? 1.0f : clampf(a.roughness, 0.0f, 1.0f));
    fputc('}', json);
}

static void put_material(const Glb *glb, const Material *m, FILE *json)
{
    fputs("{\"name\":", json);
    json_put_string(json, m->name);
    put_surface(glb, m, json);
    if (strongest_glow(glb, m) > 0.0f) {
        fprintf(json,
                ",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":%d,\"texCoord\":1}",
                (int)glb_ramp_number(glb, m));
    } else if (material_has(m, TRAIT_EMISSIVE)) {
        fputc(',', json);
        json_put_color(json, "emissiveFactor",
                       vec3_scale(m->radiance, 1.0f / fmaxf(most(m->radiance), 1.0f)));
    }
    if (m->alpha_texture && m->alpha_texture[0]) {
        fputs(",\"alphaMode\":\"MASK\"", json);
    }
    if (!material_has(m, TRAIT_BODY)) { // the ray tracer shades both sides
        fputs(",\"doubleSided\":true", json);
    }
    bool any = false;
    for (Extension x = 0; x < EXTENSION_COUNT; x++) {
        if (uses(glb, m, x)) {
            fputs(any ? "," : ",\"extensions\":{", json);
            put_extension(glb, m, x, json);
            any = true;
        }
    }
    fputs(any ? "}}" : "}", json);
}

void glb_put_materials(const Glb *glb, FILE *json)
{
    bool first = true;
    fputs(",\n\"materials\":[", json);
    for (int i = 0; i < glb->source->world->material_count; i++) {
        if (glb->material[i] >= 0) {
            fputs(first ? "\n" : ",\n", json);
            put_material(glb, &glb->source->world->material[i], json);
            first = false;
        }
    }
    fputc(']', json);
    if (glb->image_count > 0) {
        glb_put_images(glb, json);
    }
}
