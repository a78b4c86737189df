#include "export/mtl.h"

#include "base/memory.h"
#include "base/number_text.h"
#include "export/asset_path.h"
#include "render/material/appearance.h"
#include "render/world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_taken(char (*name)[MTL_NAME], int count, const char *wanted)
{
    bool taken = false;
    for (int i = 0; i < count; i++) {
        taken = taken || strcmp(name[i], wanted) == 0;
    }
    return taken;
}

char (*mtl_names(const World *world, Error *e))[MTL_NAME]
{
    char(*name)[MTL_NAME] = memory_alloc(world->material_count, sizeof *name, e);
    for (int i = 0; name && i < world->material_count; i++) {
        char own[MTL_NAME - 16];
        snprintf(own, sizeof own, "%s", world->material[i].name);
        for (char *c = own; *c; c++) {
            *c = (unsigned char)*c <= ' ' ? '_' : *c;
        }
        snprintf(name[i], sizeof name[i], "%s", own);
        for (int k = 2; is_taken(name, i, name[i]); k++) {
            snprintf(name[i], sizeof name[i], "%s_%d", own, k);
        }
    }
    return name;
}

static void write_numbers(FileWriter *writer, const char *keyword, const float *value, int count)
{
    char text[3 * (FLOAT_TEXT_MOST + 1)];
    file_writer_text(writer, keyword);
    file_writer_bytes(writer, " ", 1);
    file_writer_bytes(writer, text, (size_t)(floats_text(text, value, count, ' ') - text));
    file_writer_bytes(writer, "\n", 1);
}

static void write_color(FileWriter *writer, const char *keyword, Vec3 color)
{
    write_numbers(writer, keyword, (float[]){color.x, color.y, color.z}, 3);
}

static void write_number(FileWriter *writer, const char *keyword, float value)
{
    write_numbers(writer, keyword, &value, 1);
}

static bool write_map(FileWriter *writer, const char *keyword, const char *picture,
                      const char *file, Error *e)
{
    if (!picture || !picture[0]) {
        return true;
    }
    char *path = asset_path(file, picture, e);
    if (path) {
        file_writer_print(writer, "%s %s\n", keyword, path);
    }
    free(path);
    return path != NULL;
}

static bool write_material(FileWriter *writer, const Material *m, const char *name,
                           const char *file, Error *e)
{
    Appearance a = material_appearance(m);
    bool clear = appearance_is_clear(&a), matt = appearance_is_matt(&a);
    bool metal = a.metalness > 0.0f && !a.coated;
    Vec3 specular = metal ? a.color : vec3_splat(clear ? 0.5f : a.specular);
    float alpha = fmaxf(a.roughness * a.roughness, 0.03f);
    file_writer_print(writer, "\nnewmtl %s\n", name);
    write_color(writer, "Kd", metal ? vec3_splat(0.0f) : a.color);
    write_color(writer, "Ks", specular);
    // Blinn's exponent of a GGX lobe as wide
    write_number(writer, "Ns", fminf(2.0f / (alpha * alpha) - 2.0f, 1000.0f));
    write_number(writer, "Ni", clear ? a.ior : 1.5f);
    write_number(writer, "d", clear ? 0.1f : 1.0f);
    if (a.traits & TRAIT_EMISSIVE) {
        write_color(writer, "Ke", a.emission);
    }
    file_writer_print(writer, "illum %d\n", clear ? 7 : matt ? 1 : 2);
    write_number(writer, "Pr", matt ? 1.0f : a.roughness);
    write_number(writer, "Pm", a.metalness);
    return write_map(writer, "map_Kd", m->texture, file, e) &&
           write_map(writer, "map_d", m->alpha_texture, file, e);
}

bool mtl_write(FileWriter *writer, const ExportSource *source, char (*name)[MTL_NAME],
               const char *file, Error *e)
{
    const World *world = source->world;
    file_writer_text(writer, "# materials written by ramify\n");
    bool done = true;
    for (int i = 0; done && i < world->material_count; i++) {
        done = !world_uses_material(world, i) ||
               write_material(writer, &world->material[i], name[i], file, e);
    }
    return done;
}
