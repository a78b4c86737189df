// ramify info: what a scene file holds, without growing or rendering it.
#include "cli/command.h"

#include <stdio.h>

static void print_text(const RamifyScene *scene)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    printf("%s: seed %llu, %d x %d pixels, %d samples\n", info.file, (unsigned long long)info.seed,
           info.width, info.height, info.samples);
    for (int i = 0; i < info.object_count; i++) {
        RamifyObjectInfo object;
        char text[256];
        ramify_scene_object(scene, i, &object);
        ramify_scene_object_describe(scene, i, text, sizeof text);
        printf("object %d  %-20s %s%s", i, object.name, object.kind, text);
        if (object.attractors > 0) {
            printf(", %lld attractors", (long long)object.attractors);
        }
        if (object.instances > 0) {
            printf(", up to %lld instances", (long long)object.instances);
        }
        printf("\n");
    }
    for (int i = 0; i < info.material_count; i++) {
        printf("material  %s\n", ramify_scene_material_name(scene, i));
    }
    printf("lights    %d\n", info.light_count);
    printf("memory    about %.0f MB and the geometry\n", (double)info.memory * 1e-6);
}

static void print_json(const RamifyScene *scene)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    printf("{\"file\": ");
    json_print_string(info.file);
    printf(", \"seed\": %llu, \"width\": %d, \"height\": %d, \"samples\": %d, \"objects\": [",
           (unsigned long long)info.seed, info.width, info.height, info.samples);
    for (int i = 0; i < info.object_count; i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        printf("%s{\"name\": ", i ? ", " : "");
        json_print_string(object.name);
        printf(", \"kind\": \"%s\", \"attractors\": %lld, \"instances\": %lld}", object.kind,
               (long long)object.attractors, (long long)object.instances);
    }
    printf("], \"materials\": [");
    for (int i = 0; i < info.material_count; i++) {
        printf("%s", i ? ", " : "");
        json_print_string(ramify_scene_material_name(scene, i));
    }
    printf("], \"lights\": %d, \"memory\": %lld}\n", info.light_count, (long long)info.memory);
}

bool command_info(const Options *options, RamifyError *e)
{
    RamifyScene *scene = command_scene(options, e);
    if (!scene) {
        return false;
    }
    if (options->resolved) {
        fputs(ramify_scene_resolved(scene), stdout);
    } else if (options->json) {
        print_json(scene);
    } else {
        print_text(scene);
    }
    ramify_scene_free(scene);
    return true;
}
