// Small worlds to trace in tests.
#ifndef RAMIFY_TESTS_RENDER_TINY_WORLD_H
#define RAMIFY_TESTS_RENDER_TINY_WORLD_H

#include "render/world.h"
#include "testing.h"

#include "base/memory.h"
#include "render/renderer.h"
#include "render/sky/dome.h"

#include <stdlib.h>
#include <string.h>

// Looks from +Z at the origin: a black sky, box filter, one diffuse material.
static inline World *tiny_world(int width, int height, int samples, float albedo)
{
    World *world = world_new(NULL);
    assert_non_null(world);
    world->camera =
        (Camera){.position = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 30};
    world->film.width = width;
    world->film.height = height;
    world->film.filter = FILTER_BOX;
    world->film.filter_radius = 0.5f;
    world->render = (RenderParams){
        .samples = samples, .max_depth = 8, .roulette_depth = 8, .seed = 7, .clamp = 0.0f};
    world->sky.kind = SKY_NONE;
    world->material = memory_alloc_zero(4, sizeof *world->material, NULL);
    assert_non_null(world->material);
    world->material_count = 1;
    world->material[0] = material_default(MATERIAL_DIFFUSE);
    world->material[0].color = vec3_splat(albedo);
    world->material[0].roughness = 0.0f;
    return world;
}

static inline void add_part(World *world, Part part)
{
    assert_true(geometry_add(&world->geometry, part, NULL));
}

static inline void add_mesh(World *world, Mesh *mesh, int material, int object)
{
    assert_non_null(mesh);
    add_part(world,
             (Part){.kind = PART_MESH, .mesh = mesh, .material = material, .object = object});
}

static inline void add_light(World *world, Light light)
{
    world->light = realloc(world->light, sizeof light * (size_t)(world->light_count + 1));
    assert_non_null(world->light);
    world->light[world->light_count++] = light;
}

// One quad facing u x v.
static inline Mesh *quad_mesh(Vec3 corner, Vec3 u, Vec3 v)
{
    Mesh *mesh = mesh_new(4, 4, 1, 0, NULL);
    assert_non_null(mesh);
    Vec3 p[4] = {corner, vec3_add(corner, u), vec3_add(vec3_add(corner, u), v),
                 vec3_add(corner, v)};
    memcpy(mesh->position, p, sizeof p);
    memcpy(mesh->index, (uint32_t[4]){0, 1, 2, 3}, 16);
    return mesh;
}

// A sphere of n x 2n quads, with smooth normals when asked.
static inline Mesh *sphere_mesh(Vec3 center, float radius, int n, bool smooth)
{
    Mesh *mesh =
        mesh_new(4, (int64_t)(n + 1) * 2 * n, (int64_t)2 * n * n, smooth ? MESH_NORMAL : 0, NULL);
    assert_non_null(mesh);
    uint32_t *index = mesh->index;
    for (int j = 0; j <= n; j++) {
        for (int i = 0; i < 2 * n; i++) {
            float t = PI_F * (float)j / (float)n, p = PI_F * (float)i / (float)n;
            Vec3 d = vec3(sinf(t) * sinf(p), cosf(t), sinf(t) * cosf(p));
            int64_t k = (int64_t)j * 2 * n + i;
            mesh->position[k] = vec3_madd(center, radius, d);
            if (smooth) {
                mesh->normal[k] = d;
            }
            if (j < n) {
                uint32_t a = (uint32_t)(j * 2 * n + i),
                         b = (uint32_t)(j * 2 * n + (i + 1) % (2 * n));
                uint32_t row = (uint32_t)(2 * n);
                memcpy(index, (uint32_t[4]){a, a + row, b + row, b}, 16);
                index += 4;
            }
        }
    }
    return mesh;
}

static inline Film *trace(const World *world, int threads, RenderStats *stats)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {.code = ERROR_NONE};
    Renderer *renderer = renderer_new(world, NULL, &run, &e);
    if (!renderer) {
        fail_msg("%s", e.message);
    }
    Film *film = film_new(world->film.width, world->film.height, &e);
    assert_non_null(film);
    RenderStats own;
    assert_true(renderer_render(renderer, film, &run, NULL, NULL, stats ? stats : &own, &e));
    renderer_free(renderer);
    return film;
}

static inline double mean_luminance(const Film *film)
{
    double sum = 0.0;
    for (int i = 0; i < film->width * film->height; i++) {
        sum += (double)luminance(film->color[i]);
    }
    return sum / (film->width * film->height);
}

// Standard error of mean_luminance, from the film's own variances.
static inline double mean_error(const Film *film)
{
    double sum = 0.0;
    for (int i = 0; i < film->width * film->height; i++) {
        sum += (double)film->variance[i];
    }
    return sqrt(sum) / (film->width * film->height);
}

#endif
