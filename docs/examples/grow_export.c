// Grows a scene and writes it for another program: the out-tree of its first growing object as .swc
// or .json, or the whole scene in any format of ramify_export.
//
//     cc grow_export.c -o grow_export $(pkg-config --cflags --libs ramify)
//     ./grow_export oak.yaml oak.obj
#include <ramify.h>

#include <stdio.h>
#include <string.h>

static int report(const RamifyError *error)
{
    char text[1200];
    ramify_error_format(error, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    return error->code == RAMIFY_BAD_INPUT ? 2 : 1;
}

static void warn(void *user, const char *message)
{
    (void)user;
    fprintf(stderr, "warning: %s\n", message);
}

static bool ends_in(const char *file, const char *ending)
{
    size_t length = strlen(file), tail = strlen(ending);
    return length > tail && strcmp(file + length - tail, ending) == 0;
}

static int first_growing(const RamifyScene *scene)
{
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        if (object.grows) {
            return i;
        }
    }
    return 0; // ramify_grow reports the error
}

static bool write_tree(const RamifyScene *scene, const char *file, const RamifyRun *run,
                       RamifyError *error)
{
    RamifyTree *tree = ramify_grow(scene, first_growing(scene), run, error);
    bool done = tree && ramify_tree_write(tree, file, error);
    ramify_tree_free(tree);
    return done;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: grow_export SCENE FILE\n  .swc .json  the first out-tree\n");
        for (int i = 0; i < ramify_export_format_count(); i++) {
            fprintf(stderr, "  %-11s %s\n", ramify_export_format_ending(i),
                    ramify_export_format_doc(i));
        }
        return 2;
    }
    RamifyError error = {0};
    RamifyRun run = {.warn = warn};
    bool is_tree = ends_in(argv[2], ".swc") || ends_in(argv[2], ".json");
    if (!is_tree && !ramify_export_check(argv[2], &error)) {
        return report(&error); // fail before the work, not after it
    }
    RamifyScene *scene = ramify_scene_load(argv[1], NULL, 0, &error);
    bool done = scene && (is_tree ? write_tree(scene, argv[2], &run, &error)
                                  : ramify_export(scene, argv[2], NULL, &run, NULL, &error));
    ramify_scene_free(scene);
    return done ? 0 : report(&error);
}
