#include "scene/needs.h"

#include "base/memory.h"
#include "render/accel.h"
#include "render/film.h"
#include "scene/kind.h"
#include "scene/overrides.h"
#include "scene/yaml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Measured on x86-64 with Embree 3.12.
#define PROGRAM_BYTES 1.4e8     // the program and its libraries
#define PIXEL_WRITE_BYTES 160.0 // of a pixel while it is denoised and written
#define COPY_FACE_BYTES 100.0   // of a face copied out, in the ray tracer
#define INSTANCE_BYTES 700.0    // of an instance that is not
#define NODE_BYTES 700.0        // of a node while it grows, and of its curve
#define NODES_AN_ATTRACTOR 0.8
#define SKIN_BYTES 180.0 // of a node's skin at level 0; each level has four times as much

void needs_add(Needs *needs, const char *key, double count, double each)
{
    double bytes = count > 0.0 ? count * each : 0.0;
    needs->bytes += bytes;
    if (bytes > needs->largest) {
        needs->largest = bytes;
        needs->largest_object = needs->object;
        snprintf(needs->largest_key, sizeof needs->largest_key, "%s", key);
    }
}

void needs_add_copies(Needs *needs, const char *key, double count, double faces)
{
    double room = (ACCEL_COPY_FACES_LIMIT - needs->copied_faces) / faces;
    double copied = faces > ACCEL_COPY_MESH_LIMIT ? 0.0 : fmax(0.0, fmin(count, room));
    double own = sizeof(Transform) + sizeof(float);
    needs->copied_faces += copied * faces;
    needs_add(needs, key, 1.0,
              count * own + copied * faces * COPY_FACE_BYTES + (count - copied) * INSTANCE_BYTES);
}

void needs_add_growth(Needs *needs, const char *key, double attractors, int skin_levels)
{
    needs_add(needs, key, NODES_AN_ATTRACTOR * attractors,
              NODE_BYTES + (skin_levels >= 0 ? SKIN_BYTES * exp2(2.0 * skin_levels) : 0.0));
}

static Needs needs_of(const Scene *scene, int only)
{
    Needs needs = {.largest_object = -1};
    for (int i = 0; i < scene->object_count; i++) {
        const Kind *kind = kind_of(&scene->objects[i]);
        needs.object = i;
        if (kind->needs && (only < 0 || only == i)) {
            kind->needs(&scene->objects[i], &needs);
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

// Entry number index of the list of objects.
static const Node *object_node(const Node *root, int index)
{
    const Node *list = node_get(root, "objects");
    const Node *entry = list ? list->first : NULL;
    for (int i = 0; entry && i < index; i++) {
        entry = entry->next;
    }
    return entry;
}

// Gives the error the place of an object's key, or of what it lies in where the file does not name
// it. The text is parsed again, as nothing else needs to know places any more.
static void locate(const Scene *scene, int object, const char *key, Error *e)
{
    Error own = {0};
    Arena *arena = arena_new(&own);
    Node *root = arena ? yaml_parse(arena, scene->text, strlen(scene->text), scene->file, NULL, &own)
                       : NULL;
    for (const char *at = scene->overrides; root && *at; at += strlen(at) + 1) {
        override_apply(arena, root, at, &own);
    }
    const Node *node = root ? object_node(root, object) : NULL;
    const Node *child = node ? node_get(node, kind_of(&scene->objects[object])->key) : NULL;
    while (child) {
        char word[64];
        size_t length = strcspn(key, ".");
        node = child;
        snprintf(word, sizeof word, "%.*s", (int)length, key);
        child = node_get(node, word);
        key += length + (key[length] == '.');
    }
    if (node && node->source) {
        error_locate(e, node->source, 0, 0);
    } else {
        error_locate(e, scene->file, node ? node->line : 0, node ? node->column : 0);
    }
    arena_free(arena);
}

bool scene_check_memory(const Scene *scene, int object, Error *e)
{
    Needs needs = needs_of(scene, object);
    double there = memory_allowed();
    if (needs.bytes / NEEDS_FACTOR <= there || needs.largest_object < 0) {
        return true;
    }
    const SceneObject *largest = &scene->objects[needs.largest_object];
    error_set(e, ERROR_MEMORY,
              "objects.%s.%s.%s asks for about %.1f GB of memory, and %.1f GB are there; a smaller "
              "number would be right",
              largest->name, kind_of(largest)->key, needs.largest_key, needs.largest * 1e-9,
              there * 1e-9);
    if (e) {
        locate(scene, needs.largest_object, needs.largest_key, e);
    }
    return false;
}
