#include "scene/export_scene.h"

#include "base/memory.h"
#include "scene/build.h"
#include "scene/kind.h"

#include <stdio.h>
#include <stdlib.h>

bool scene_export_check(const char *file, Error *e)
{
    if (export_format(file)) {
        return true;
    }
    char endings[256] = "";
    for (int i = 0, used = 0; i < export_format_count(); i++) {
        used += snprintf(endings + used, sizeof endings - (size_t)used, "%s%s", i > 0 ? " " : "",
                         export_format_at(i)->ending);
    }
    return error_set(e, ERROR_INPUT, "'%s' ends in no format that can be written; one of %s would",
                     file, endings);
}

// What a source is made of, owned.
typedef struct Parts {
    World *world;
    OutTree **tree;
    HeightField **land;
    const char **name;
} Parts;

static void clear_parts(Parts *parts, int object_count)
{
    for (int i = 0; i < object_count; i++) {
        if (parts->tree) {
            out_tree_free(parts->tree[i]);
        }
        if (parts->land) {
            height_field_free(parts->land[i]);
        }
    }
    world_free(parts->world);
    free(parts->tree);
    free(parts->land);
    free(parts->name);
}

static bool make_lands(const Scene *scene, Parts *parts, const Run *run, Error *e)
{
    parts->land = memory_alloc_zero(scene->object_count, sizeof *parts->land, e);
    bool done = parts->land;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (kind_of(&scene->objects[i])->heights) {
            parts->land[i] = scene_heights(scene, i, parts->tree[i], run, e);
            done = parts->land[i];
        }
    }
    return done;
}

static bool make_parts(const Scene *scene, unsigned needs, Parts *parts, const Run *run, Error *e)
{
    parts->name = memory_alloc(scene->object_count, sizeof *parts->name, e);
    bool done = parts->name;
    for (int i = 0; done && i < scene->object_count; i++) {
        parts->name[i] = scene->objects[i].name;
    }
    if (done && needs & EXPORT_WORLD) {
        parts->world = scene_build(scene, run, NULL, e);
        done = parts->world;
    }
    if (done && needs & (EXPORT_TREES | EXPORT_LAND)) {
        parts->tree = scene_grow(scene, run, e);
        done = parts->tree;
    }
    return done && (!(needs & EXPORT_LAND) || make_lands(scene, parts, run, e));
}

bool scene_export(const Scene *scene, const char *file, const Run *run, Error *e)
{
    if (!scene_export_check(file, e)) {
        return false;
    }
    const ExportFormat *format = export_format(file);
    Parts parts = {0};
    bool done = make_parts(scene, format->needs, &parts, run, e);
    if (done) {
        ExportSource source = {.title = scene->file,
                               .world = parts.world,
                               .object_count = scene->object_count,
                               .object_name = parts.name,
                               .tree = (const OutTree *const *)parts.tree,
                               .land = (const HeightField *const *)parts.land};
        done = format->write(&source, file, run, e);
    }
    clear_parts(&parts, scene->object_count);
    return done;
}
