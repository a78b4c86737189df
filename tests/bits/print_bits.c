// Prints what scenes grow and build, as hashes: tests/bits/run compares them between compilers,
// processors and numbers of threads.
//   print_bits THREADS SCENE...
// A line for each out-tree, for each object's measures and for each object's geometry; a scene that
// cannot be built gives its error.
#include "scene/geometry_hash.h"

#include "base/measures.h"
#include "objects/kind.h"
#include "scene/build.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t hash_tree(const OutTree *tree)
{
    size_t n = (size_t)tree->count;
    uint64_t hash = out_tree_hash(tree);
    hash = hash_bytes(hash, tree->normal, sizeof(Vec3) * n);
    return hash_bytes(hash, tree->id, sizeof *tree->id * n);
}

static bool print_trees(const Scene *scene, const char *name, const Run *run, Error *e)
{
    for (int i = 0; i < scene->object_count; i++) {
        if (scene->objects[i].kind->grow) {
            OutTree *tree = scene_grow_object(scene, i, run, e);
            if (!tree) {
                return false;
            }
            printf("%s %s growth %016" PRIx64 " of %" PRId64 " nodes\n", name,
                   scene->objects[i].name, hash_tree(tree), tree->count);
            out_tree_free(tree);
        }
    }
    return true;
}

static bool print_measures(const Scene *scene, const char *name, const Run *run, Error *e)
{
    for (int i = 0; i < scene->object_count; i++) {
        const Kind *kind = scene->objects[i].kind;
        if (kind->grow || kind->measure) {
            MeasureList list = {0};
            bool done = scene_measure(scene, i, run, &list, e);
            uint64_t hash = 0;
            for (int64_t k = 0; k < list.count; k++) {
                hash = hash_bytes(hash, &list.item[k].value, sizeof list.item[k].value);
            }
            printf("%s %s measures %016" PRIx64 "\n", name, scene->objects[i].name, hash);
            measures_clear(&list);
            if (!done) {
                return false;
            }
        }
    }
    return true;
}

// What parts have beside their geometry: coarse forms and what instances differ by.
static uint64_t hash_looks(const Geometry *geometry)
{
    uint64_t hash = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        size_t size = sizeof(float) * (size_t)part->instance_count;
        hash = hash_bytes(hash, part->variation, size);
        hash = hash_bytes(hash, part->season, size);
        for (int k = 0; k < PART_COARSE_MOST && part->coarse[k].mesh; k++) {
            hash = hash_mesh(hash, part->coarse[k].mesh);
            hash = hash_bytes(hash, &part->coarse[k].error, sizeof part->coarse[k].error);
        }
    }
    return hash;
}

// The parts of each object; those of the whole scene are in the order of its objects.
static bool print_world(const Scene *scene, const char *name, const Run *run, Error *e)
{
    BuildStats stats = {0};
    World *world = scene_build(scene, run, &stats, e);
    int64_t count = world ? world->geometry.count : 0;
    for (int64_t first = 0, next; first < count; first = next) {
        Part *part = world->geometry.part + first;
        next = first + 1;
        while (next < count && world->geometry.part[next].object == part->object) {
            next++;
        }
        Geometry of = {.part = part, .count = next - first};
        printf("%s %s geometry %016" PRIx64 " looks %016" PRIx64 " of %" PRId64 " parts\n", name,
               scene->objects[part->object].name, geometry_hash(&of), hash_looks(&of), of.count);
    }
    world_free(world);
    return world != NULL;
}

int main(int argc, char **argv)
{
    Run run = run_default();
    run.threads = argc > 1 ? atoi(argv[1]) : 0;
    if (run.threads < 1 || argc < 3) {
        fprintf(stderr, "usage: print_bits THREADS SCENE...\n");
        return 2;
    }
    for (int i = 2; i < argc; i++) {
        Error e = {0};
        const char *slash = strrchr(argv[i], '/'), *name = slash ? slash + 1 : argv[i];
        Scene *scene = scene_read(argv[i], NULL, 0, &e);
        if (!scene || !print_trees(scene, name, &run, &e) ||
            !print_measures(scene, name, &run, &e) || !print_world(scene, name, &run, &e)) {
            printf("%s: %s\n", name, e.message);
        }
        scene_free(scene);
    }
    return 0;
}
