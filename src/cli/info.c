// ramify info: what a scene file holds, without growing or rendering it.
#include "cli/command.h"

#include "render/film.h"
#include "scene/kind.h"

#include <stdio.h>

static int64_t object_attractors(const SceneObject *object)
{
    const Kind *kind = kind_of(object);
    return kind->attractors ? kind->attractors(object) : 0;
}

static int64_t object_instances(const SceneObject *object)
{
    const Kind *kind = kind_of(object);
    return kind->copies ? kind->copies(object) : 0;
}

// Rough size in memory, bytes: attractors and their search grid (~100 each), instances with their
// place in the acceleration structure (~200), and the film with one copy for development.
static int64_t expected_memory(const Scene *scene)
{
    int64_t attractors = 0, instances = 0;
    for (int i = 0; i < scene->object_count; i++) {
        attractors += object_attractors(&scene->objects[i]);
        instances += object_instances(&scene->objects[i]);
    }
    int64_t pixels = (int64_t)scene->film.width * scene->film.height;
    int64_t pixel_bytes = (int64_t)(4 * sizeof(Vec3) + 6 * sizeof(float) + 8 * sizeof(float));
    return 100 * attractors + 200 * instances + pixel_bytes * pixels;
}

static void print_text(const Scene *scene)
{
    printf("%s: seed %llu, %d x %d pixels, %d samples\n", scene->file,
           (unsigned long long)scene->seed, scene->film.width, scene->film.height,
           scene->render.samples);
    for (int i = 0; i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        const Kind *kind = kind_of(object);
        char text[256] = "";
        if (kind->describe) {
            kind->describe(object, text, sizeof text);
        }
        printf("object %d  %-20s %s%s", i, object->name, kind->key, text);
        int64_t attractors = object_attractors(object), instances = object_instances(object);
        if (attractors > 0) {
            printf(", %lld attractors", (long long)attractors);
        }
        if (instances > 0) {
            printf(", up to %lld instances", (long long)instances);
        }
        printf("\n");
    }
    for (int i = 0; i < scene->material_count; i++) {
        printf("material  %s\n", scene->materials[i].name);
    }
    printf("lights    %d\n", scene->light_count);
    printf("memory    about %.0f MB and the geometry\n", (double)expected_memory(scene) * 1e-6);
}

static void print_json(const Scene *scene)
{
    printf("{\"file\": ");
    json_print_string(scene->file);
    printf(", \"seed\": %llu, \"width\": %d, \"height\": %d, \"samples\": %d, \"objects\": [",
           (unsigned long long)scene->seed, scene->film.width, scene->film.height,
           scene->render.samples);
    for (int i = 0; i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        printf("%s{\"name\": ", i ? ", " : "");
        json_print_string(object->name);
        printf(", \"kind\": \"%s\", \"attractors\": %lld, \"instances\": %lld}",
               kind_of(object)->key, (long long)object_attractors(object),
               (long long)object_instances(object));
    }
    printf("], \"materials\": [");
    for (int i = 0; i < scene->material_count; i++) {
        printf("%s", i ? ", " : "");
        json_print_string(scene->materials[i].name);
    }
    printf("], \"lights\": %d, \"memory\": %lld}\n", scene->light_count,
           (long long)expected_memory(scene));
}

bool command_info(const Options *options, Error *e)
{
    Scene *scene = command_scene(options, e);
    if (!scene) {
        return false;
    }
    if (options->resolved) {
        fputs(scene->resolved, stdout);
    } else if (options->json) {
        print_json(scene);
    } else {
        print_text(scene);
    }
    scene_free(scene);
    return true;
}
