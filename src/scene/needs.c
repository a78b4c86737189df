#include "scene/needs.h"

#include "base/memory.h"
#include "render/film.h"
#include "scene/place.h"

// Measured on x86-64 with Embree 3.12.
#define PROGRAM_BYTES 1.4e8     // the program and its libraries
#define PIXEL_WRITE_BYTES 204.0 // per pixel while denoising and writing

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

double scene_memory(const Scene *scene)
{
    double pixels = (double)scene->film.width * scene->film.height;
    return PROGRAM_BYTES + needs_of(scene, -1).bytes +
           (FILM_PIXEL_BYTES + PIXEL_WRITE_BYTES) * pixels;
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
