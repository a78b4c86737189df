#include "api/handles.h"

#include "base/memory.h"
#include "render/film.h"
#include "render/world.h"

#include <stdlib.h>
#include <string.h>

RamifyWorld *ramify_build(const RamifyScene *scene, const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    RamifyWorld *world = memory_alloc_zero(1, sizeof *world, &e);
    if (world) {
        world->scene = scene_of(scene);
        world->world = scene_build(scene_of(scene), &own, &world->stats, &e);
    }
    if (!world || !world->world) {
        free(world);
        world = NULL;
        api_fail(error, &e);
    }
    return world;
}

void ramify_world_free(RamifyWorld *world)
{
    if (world) {
        world_free(world->world);
        free(world);
    }
}

void ramify_world_info(const RamifyWorld *world, RamifyWorldInfo *info)
{
    const BuildStats *stats = &world->stats;
    *info = (RamifyWorldInfo){.nodes = stats->nodes,
                              .triangles = stats->geometry.triangles,
                              .curve_segments = stats->geometry.curve_segments,
                              .instances = stats->geometry.instances,
                              .bytes = stats->geometry.bytes,
                              .grow_seconds = stats->grow_seconds,
                              .mesh_seconds = stats->mesh_seconds};
}

bool ramify_world_crop(RamifyWorld *world, const float crop[4], RamifyError *error)
{
    Error e = {0};
    FilmParams *film = &world->world->film;
    PixelBox box = film_crop_pixels(film->width, film->height, crop);
    bool valid = crop[0] < crop[2] && crop[1] < crop[3]; // not with NAN
    if (!valid || box.x0 >= box.x1 || box.y0 >= box.y1) {
        error_set(&e, ERROR_INPUT,
                  "a crop of %g, %g, %g, %g holds no pixel; x0 < x1 and y0 < y1 are needed",
                  (double)crop[0], (double)crop[1], (double)crop[2], (double)crop[3]);
        return api_fail(error, &e);
    }
    memcpy(film->crop, crop, sizeof film->crop);
    return true;
}

bool ramify_world_samples(RamifyWorld *world, int first, int end, RamifyError *error)
{
    Error e = {0};
    RenderParams *render = &world->world->render;
    if (first < 0 || first >= end || end > render->samples || render->max_noise > 0.0f ||
        render->max_seconds > 0.0) {
        error_set(&e, ERROR_INPUT,
                  "samples %d to %d of %d a pixel, noise %g, %g seconds; 0 <= first < end <= "
                  "render.samples is needed, without limits of noise and time",
                  first, end, render->samples, (double)render->max_noise, render->max_seconds);
        return api_fail(error, &e);
    }
    render->first_sample = first;
    render->end_sample = end;
    return true;
}

int64_t ramify_world_part_count(const RamifyWorld *world)
{
    return world->world->geometry.count;
}

_Static_assert(sizeof(Vec3) == 3 * sizeof(float) && sizeof(Vec2) == 2 * sizeof(float) &&
                   sizeof(Transform) == 12 * sizeof(float),
               "vectors and matrices are plain floats");

static const float *floats(const void *plain)
{
    return (const float *)plain;
}

static void describe_mesh(const Mesh *mesh, RamifyPart *part)
{
    part->face_size = mesh->face_size;
    part->vertex_count = mesh->vertex_count;
    part->positions = floats(mesh->position);
    part->normals = floats(mesh->normal);
    part->uvs = floats(mesh->uv);
    part->radii = mesh->radius;
    part->births = mesh->birth;
    part->face_count = mesh->face_count;
    part->indices = mesh->index;
}

static void describe_curves(const CurveSet *curves, RamifyPart *part)
{
    part->vertex_count = curves->point_count;
    part->positions = floats(curves->position);
    part->radii = curves->radius;
    part->births = curves->birth;
    part->curve_count = curves->curve_count;
    part->starts = curves->first;
}

void ramify_world_part(const RamifyWorld *world, int64_t index, RamifyPart *part)
{
    const Part *own = &world->world->geometry.part[index];
    *part = (RamifyPart){.object = own->object,
                         .material = world->world->material[own->material].name,
                         .instance_count = own->instance_count,
                         .instances = floats(own->instance),
                         .variations = own->variation};
    if (own->kind == PART_MESH) {
        describe_mesh(own->mesh, part);
    } else {
        describe_curves(own->curves, part);
    }
}
