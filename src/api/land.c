#include "api/handles.h"

#include "export/heights.h"
#include "land/height_maps.h"
#include "land/height_measure.h"
#include "scene/picture.h"

static RamifyLand *hand_land(HeightField *field, const Error *e, RamifyError *error)
{
    if (!field) {
        api_fail(error, e);
    }
    return (RamifyLand *)(void *)field;
}

static HeightField *make_land(const Scene *scene, int index, const OutTree *tree, const Run *run,
                              Error *e)
{
    const Kind *kind = scene->objects[index].kind;
    if (tree || !kind->grow || !kind->heights) {
        return scene_heights(scene, index, tree, run, e);
    }
    OutTree *grown = scene_grow_object(scene, index, run, e);
    HeightField *field = grown ? scene_heights(scene, index, grown, run, e) : NULL;
    out_tree_free(grown);
    return field;
}

RamifyLand *ramify_land(const RamifyScene *scene, int index, const RamifyTree *tree,
                        const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    bool sound = api_check_object(scene, index, &e);
    return hand_land(sound ? make_land(scene_of(scene), index, tree_of(tree), &own, &e) : NULL, &e,
                     error);
}

RamifyLand *ramify_land_read(const char *file, RamifyError *error)
{
    Error e = {0};
    return hand_land(height_field_read_asc(file, &e), &e, error);
}

RamifyLand *ramify_land_map(const RamifyLand *land, const char *name, RamifyError *error)
{
    Error e = {0};
    Run run = api_run(NULL);
    HeightMap map;
    bool known = height_map_parse(name, &map, &e);
    return hand_land(known ? height_map(land_of(land), &map, &run, &e) : NULL, &e, error);
}

RamifyLand *ramify_land_tile(const RamifyScene *scene, int index, const RamifyLand *world,
                             const char *map, int column, int row, const RamifyRun *run,
                             RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    HeightMap kind;
    HeightField *tile = NULL;
    if (api_check_object(scene, index, &e) && (!map || height_map_parse(map, &kind, &e))) {
        tile = scene_tile(scene_of(scene), index, land_of(world), map ? &kind : NULL, column, row,
                          &own, &e);
    }
    return hand_land(tile, &e, error);
}

void ramify_land_free(RamifyLand *land)
{
    height_field_free((HeightField *)(void *)land);
}

void ramify_land_info(const RamifyLand *land, RamifyLandInfo *info)
{
    const HeightField *field = land_of(land);
    *info = (RamifyLandInfo){.columns = field->columns,
                             .rows = field->rows,
                             .cell = {field->cell.x, field->cell.y},
                             .origin = {field->origin.x, field->origin.y},
                             .hash = height_field_hash(field)};
    height_field_range(field, &info->low, &info->high);
}

const float *ramify_land_heights(const RamifyLand *land)
{
    return land_of(land)->height;
}

bool ramify_land_write(const RamifyLand *land, const char *file, RamifyError *error)
{
    Error e = {0};
    Run run = api_run(NULL);
    return export_height_field(land_of(land), file, &run, &e) || api_fail(error, &e);
}

static bool paint(const Scene *scene, int index, const OutTree *tree, int width, int height,
                  float *pixel, Error *e)
{
    const SceneObject *object = &scene->objects[index];
    const Kind *kind = object->kind;
    if (!kind->paint) {
        return error_set(e, ERROR_INPUT, "a picture of object '%s', a %s; a venation makes one",
                         object->name, kind_name(kind));
    }
    return kind->paint(object->params, tree, width, height, pixel, e);
}

bool ramify_paint(const RamifyScene *scene, int index, const RamifyTree *tree, int width,
                  int height, float *pixel, RamifyError *error)
{
    Error e = {0};
    bool done = api_check_object(scene, index, &e) &&
                paint(scene_of(scene), index, tree_of(tree), width, height, pixel, &e);
    return done || api_fail(error, &e);
}

bool ramify_paint_write(const float *pixel, int width, int height, const char *file,
                        RamifyError *error)
{
    Error e = {0};
    return picture_write_grey(file, pixel, width, height, &e) || api_fail(error, &e);
}
