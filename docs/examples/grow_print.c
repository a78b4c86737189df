// Grows all growing objects of a scene and prints their sizes and measures.
//
//     cc grow_print.c -o grow_print $(pkg-config --cflags --libs ramify)
//     ./grow_print oak.yaml objects.oak.tree.height=9
#include <ramify.h>

#include <stdio.h>

static int report(const RamifyError *error)
{
    char text[1200];
    ramify_error_format(error, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    return error->code == RAMIFY_BAD_INPUT ? 2 : 1;
}

static void print_tree(const char *name, const RamifyTree *tree)
{
    const int32_t *parents = ramify_tree_parents(tree);
    const float *radii = ramify_tree_radii(tree);
    float low[3], high[3], thickest = 0.0f;
    long long roots = 0;
    for (int64_t i = 0; i < ramify_tree_count(tree); i++) {
        roots += parents[i] < 0;
        thickest = radii[i] > thickest ? radii[i] : thickest;
    }
    ramify_tree_bounds(tree, low, high);
    printf("%s: %lld nodes, %lld roots, %.2f m high, up to %.1f mm thick\n", name,
           (long long)ramify_tree_count(tree), roots, (double)(high[1] - low[1]),
           2e3 * (double)thickest);
}

static void print_measures(const RamifyMeasures *measures)
{
    for (int i = 0; i < ramify_measures_count(measures); i++) {
        RamifyMeasure m;
        ramify_measures_get(measures, i, &m);
        printf("  %-24s %g %s\n", m.name, m.value, m.unit);
    }
}

static int grow_object(const RamifyScene *scene, int index, RamifyError *error)
{
    RamifyTree *tree = ramify_grow(scene, index, NULL, error);
    RamifyMeasures *measures = tree ? ramify_tree_measure(tree, error) : NULL;
    if (measures) {
        print_tree(ramify_scene_object_name(scene, index), tree);
        print_measures(measures);
    }
    ramify_measures_free(measures);
    ramify_tree_free(tree);
    return measures != NULL;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: grow_print SCENE [PATH=VALUE ...]\n");
        return 2;
    }
    RamifyError error = {0};
    RamifyScene *scene =
        ramify_scene_load(argv[1], (const char *const *)argv + 2, argc - 2, &error);
    int done = scene != NULL;
    for (int i = 0; done && i < ramify_scene_object_count(scene); i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        done = !object.grows || grow_object(scene, i, &error);
    }
    ramify_scene_free(scene);
    return done ? 0 : report(&error);
}
