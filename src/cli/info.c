// ramify info: prints the contents of a scene file, and what rendering it takes.
#include "base/json.h"
#include "cli/command.h"

#include <stdio.h>
#include <string.h>

// estimate: NULL = none.
static void print_text(const RamifyScene *scene, const RamifyEstimate *estimate)
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
    if (!estimate) {
        printf("memory    about %.0f MB by its counts and files; --estimate tells more precisely\n",
               (double)info.memory * 1e-6);
        return;
    }
    double write = estimate->preview_seconds + estimate->write_seconds;
    printf("memory    %.0f MB at most\n", (double)estimate->memory * 1e-6);
    printf("time      %.1f s of a processor: grow and mesh %.1f, build %.1f, trace %.1f (%.1f M "
           "paths), develop and write %.1f\n",
           estimate->grow_seconds + estimate->build_seconds + estimate->trace_seconds + write,
           estimate->grow_seconds, estimate->build_seconds, estimate->trace_seconds,
           (double)estimate->paths * 1e-6, write);
}

static void print_estimate_json(const RamifyEstimate *estimate)
{
    printf(", \"estimate\": {\"memory\": %lld, \"paths\": %lld, \"seconds\": {\"grow\": %.3f, "
           "\"build\": %.3f, \"trace\": %.3f, \"preview\": %.3f, \"write\": %.3f}}",
           (long long)estimate->memory, (long long)estimate->paths, estimate->grow_seconds,
           estimate->build_seconds, estimate->trace_seconds, estimate->preview_seconds,
           estimate->write_seconds);
}

static void print_json(const RamifyScene *scene, const RamifyEstimate *estimate)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    printf("{\"file\": ");
    json_put_string(stdout, info.file);
    printf(", \"seed\": %llu, \"width\": %d, \"height\": %d, \"samples\": %d, \"objects\": [",
           (unsigned long long)info.seed, info.width, info.height, info.samples);
    for (int i = 0; i < info.object_count; i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        printf("%s{\"name\": ", i ? ", " : "");
        json_put_string(stdout, object.name);
        printf(", \"kind\": \"%s\", \"attractors\": %lld, \"instances\": %lld}", object.kind,
               (long long)object.attractors, (long long)object.instances);
    }
    printf("], \"materials\": [");
    for (int i = 0; i < info.material_count; i++) {
        printf("%s", i ? ", " : "");
        json_put_string(stdout, ramify_scene_material_name(scene, i));
    }
    printf("], \"lights\": %d, \"memory\": %lld", info.light_count, (long long)info.memory);
    if (estimate) {
        print_estimate_json(estimate);
    }
    printf("}\n");
}

// path is "objects.NAME.KIND.KEY": printed for every object of that kind, or for all without a
// kind.
static void print_object_path(const RamifyScene *scene, const char *rest, int length)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    int word = (int)strcspn(rest, ".\n");
    for (int i = 0; i < info.object_count; i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        bool own =
            (int)strlen(object.kind) == word && strncmp(rest, object.kind, (size_t)word) == 0;
        if (word == length || own) {
            printf("objects.%s.%.*s\n", object.name, length, rest);
        }
    }
}

// Prints the keys' paths with the names of this scene's objects and materials.
static bool print_paths(const RamifyScene *scene, RamifyError *e)
{
    static const char objects[] = "objects.NAME.", materials[] = "materials.NAME.";
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    char *paths = ramify_schema_paths(e);
    for (char *line = paths; line && *line; line = strchr(line, '\n') + 1) {
        for (char *n = line; *n != '\n'; n++) {
            bool entry = n > line && n[-1] == '.' && n[0] == 'N' && n[1] == '.';
            *n = entry ? '0' : *n;
        }
        int length = (int)strcspn(line, "\n");
        if (strncmp(line, objects, strlen(objects)) == 0) {
            print_object_path(scene, line + strlen(objects), length - (int)strlen(objects));
        } else if (strncmp(line, materials, strlen(materials)) == 0) {
            for (int i = 0; i < info.material_count; i++) {
                printf("materials.%s%.*s\n", ramify_scene_material_name(scene, i),
                       length - (int)strlen(materials) + 1, line + strlen(materials) - 1);
            }
        } else {
            printf("%.*s\n", length, line);
        }
    }
    ramify_free(paths);
    return paths;
}

static bool estimate_scene(const Options *options, const RamifyScene *scene,
                           RamifyEstimate *estimate, RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    bool done = ramify_estimate(scene, NULL, (int64_t)options->memory, &run, estimate, e);
    progress_end(&progress);
    return done;
}

bool command_info(const Options *options, RamifyError *e)
{
    RamifyScene *scene = command_scene(options, e);
    if (!scene) {
        return false;
    }
    RamifyEstimate found = {0}, *estimate = options->estimate ? &found : NULL;
    bool done = estimate ? estimate_scene(options, scene, estimate, e)
                         : command_check_memory(options, scene, e);
    if (!done) {
        ramify_scene_free(scene);
        return false;
    }
    if (options->paths) {
        done = print_paths(scene, e);
    } else if (options->resolved) {
        fputs(ramify_scene_resolved(scene), stdout);
    } else if (options->json) {
        print_json(scene, estimate);
    } else {
        print_text(scene, estimate);
    }
    ramify_scene_free(scene);
    return done;
}
