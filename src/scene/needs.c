#include "scene/needs.h"

#include "base/memory.h"
#include "config/yaml.h"
#include "render/film.h"
#include "render/lamp_field.h"
#include "scene/cloud_grounds.h"
#include "scene/masks.h"
#include "scene/place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Measured on x86-64 with Embree 3.12.
#define PROGRAM_BYTES 3e7       // the program and its libraries
#define READER_BYTES 1.2e8      // those that read pictures
#define PIXEL_WRITE_BYTES 195.0 // per pixel while denoising and writing

static Needs needs_of(const Scene *scene, int only)
{
    Needs needs = {.largest_object = -1};
    for (int i = 0; i < scene->object_count; i++) {
        const Kind *kind = scene->objects[i].kind;
        needs.object = i;
        if (kind->needs && (only < 0 || only == i)) {
            kind->needs(scene->objects[i].params, &needs);
        }
    }
    return needs;
}

double scene_film_memory(const Scene *scene)
{
    return (FILM_PIXEL_BYTES + PIXEL_WRITE_BYTES) * (double)scene->film.width * scene->film.height;
}

static bool has_lamps(const Scene *scene)
{
    bool lamps = scene->light_count > 0;
    for (int i = 0; !lamps && i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        for (int role = 0; role < OBJECT_MOST_MATERIALS; role++) {
            const char *name = object->material[role]
                                   ? object->material[role]
                                   : kind_material(object->kind, object->params, role);
            const Material *material = name ? scene_material(scene, name) : NULL;
            lamps = lamps || (material && material->kind == MATERIAL_EMISSION);
        }
    }
    return lamps;
}

// A medium leaves no field, and one that pays nowhere is not made: at most.
static double lamp_field_memory(const Scene *scene)
{
    bool made = scene->render.lamp_field && scene->cloud_count > 0 && !scene->medium;
    return made && has_lamps(scene) ? (double)lamp_field_bytes() : 0.0;
}

// Does it have textures or a sky from a picture?
static bool reads_pictures(const Scene *scene)
{
    bool reads = scene->sky.file;
    for (int i = 0; !reads && i < scene->material_count; i++) {
        reads = scene->materials[i].texture || scene->materials[i].alpha_texture;
    }
    return reads;
}

double scene_memory(const Scene *scene)
{
    return PROGRAM_BYTES + (reads_pictures(scene) ? READER_BYTES : 0.0) +
           needs_of(scene, -1).bytes + scene_film_memory(scene) + scene_cloud_memory(scene) +
           scene_mask_memory(scene) + lamp_field_memory(scene);
}

// ---- a limit ----

// Value of a number of the resolved scene, defaults included; NAN if the path has none.
static double number_at(const Scene *scene, const char *path)
{
    Arena *arena = arena_new(NULL);
    const Node *root =
        arena ? yaml_parse(arena, scene->resolved, strlen(scene->resolved), scene->file, NULL, NULL)
              : NULL;
    const char *rest = "";
    const Node *node = root ? node_follow(root, path, &rest) : NULL;
    double value =
        node && node->kind == NODE_SCALAR && !*rest ? strtod(node->text, NULL) : (double)NAN;
    arena_free(arena);
    return value;
}

// Rounds down to two digits.
static double rounded_down(double value)
{
    double unit = pow(10.0, floor(log10(value)) - 1.0);
    return floor(value / unit) * unit;
}

// Writes by what value of its key the largest need shrinks to `share` > 0 of what it is.
static void suggest(const Scene *scene, const Needs *needs, double share, char *text, size_t size)
{
    const SceneObject *object = &scene->objects[needs->largest_object];
    const char *key = needs->largest_key;
    const char *last = strrchr(key, '.') ? strrchr(key, '.') + 1 : key;
    char path[256];
    snprintf(path, sizeof path, "objects.%s.%s.%s", object->name, kind_name(object->kind), key);
    double value = number_at(scene, path);
    if (strcmp(last, "max_count") == 0) { // which may be more than there are
        value = fmin(value, needs->largest_count);
    }
    if (!(value > 0.0)) {
        snprintf(text, size, "make it smaller");
    } else if (strcmp(last, "voxel") == 0 || strcmp(last, "spacing") == 0) { // over a surface
        snprintf(text, size, "set it to %.3g or more", value / sqrt(share));
    } else if (strcmp(last, "levels") == 0) { // each has four times the faces of the one before
        snprintf(text, size, "set it to %g", fmax(0.0, value - ceil(-0.5 * log2(share))));
    } else if (value * share < 1.0) {
        snprintf(text, size, "set it to 0");
    } else {
        snprintf(text, size, "set it to %.0f or less", rounded_down(value * share));
    }
}

// Blames the film: by what size the picture would fit.
static bool fail_film(const Scene *scene, double bytes, double share, Error *e)
{
    double by = sqrt(share);
    error_set(e, ERROR_INPUT,
              "the picture takes %.2f GB of them: set film.width and film.height to %.0f and %.0f "
              "or less",
              bytes * 1e-9, fmax(1.0, floor(by * scene->film.width)),
              fmax(1.0, floor(by * scene->film.height)));
    error_key(e, "film.width");
    return false;
}

static bool fail_object(const Scene *scene, const Needs *needs, double share, Error *e)
{
    char advice[96];
    suggest(scene, needs, share, advice, sizeof advice);
    error_set(e, ERROR_INPUT, "%s of object '%s' takes about %.2f GB of them: %s",
              needs->largest_key, scene->objects[needs->largest_object].name, needs->largest * 1e-9,
              advice);
    const SceneObject *object = &scene->objects[needs->largest_object];
    error_key(e, "objects.%s.%s.%s", object->name, kind_name(object->kind), needs->largest_key);
    return false;
}

bool scene_limit_memory(const Scene *scene, double limit, double measured, Error *e)
{
    double counted = scene_memory(scene), bytes = measured > 0.0 ? measured : counted;
    if (limit <= 0.0 || bytes <= limit || (measured <= 0.0 && counted / NEEDS_FACTOR <= limit)) {
        return true;
    }
    Needs needs = needs_of(scene, -1);
    double film = scene_film_memory(scene);
    needs.largest *= fmin(1.0, bytes / counted);
    bool picture = film >= needs.largest;
    double largest = picture ? film : needs.largest, share = 1.0 - (bytes - limit) / largest;
    // where less of one thing is not enough, less of everything
    bool all = share < 0.1;
    share = all ? (limit - PROGRAM_BYTES) / (bytes - PROGRAM_BYTES) : share;
    if (share <= 0.0) {
        error_set(e, ERROR_INPUT, "no scene takes less than %.2f GB", PROGRAM_BYTES * 1e-9);
    } else if (picture) {
        fail_film(scene, film, share, e);
    } else {
        fail_object(scene, &needs, share, e);
    }
    error_prefix(e, "about %.2f GB of memory are needed, but %.2f GB are allowed; ", bytes * 1e-9,
                 limit * 1e-9);
    size_t used = e ? strlen(e->message) : 0;
    if (all && share > 0.0 && e) {
        snprintf(e->message + used, sizeof e->message - used, ", and all else likewise");
    }
    return scene_fail_at(scene, "", e);
}

bool scene_check_memory(const Scene *scene, int object, Error *e)
{
    Needs needs = needs_of(scene, object);
    double there = memory_allowed();
    if (needs.bytes / NEEDS_FACTOR <= there || needs.largest_object < 0) {
        return true;
    }
    error_set(e, ERROR_INPUT,
              "%s needs about %.1f GB of memory, but %.1f GB are available; use a smaller number",
              needs.largest_key, needs.largest * 1e-9, there * 1e-9);
    error_key(e, "%s", needs.largest_key);
    return scene_fail_object(scene, needs.largest_object, e);
}
