#include "render/world.h"

#include "base/memory.h"

#include <stdlib.h>

World world_default(void)
{
    World world = {0};
    world.camera = (Camera){.position = {0.0f, 1.7f, 10.0f},
                            .target = {0.0f, 1.7f, 0.0f},
                            .up = {0.0f, 1.0f, 0.0f},
                            .fov = 40.0f};
    world.film = (FilmParams){.width = 1280,
                              .height = 720,
                              .filter = FILTER_BLACKMAN_HARRIS,
                              .filter_radius = 1.5f,
                              .crop = {0.0f, 0.0f, 1.0f, 1.0f}};
    world.render = (RenderParams){.samples = 64,
                                  .max_depth = 8,
                                  .roulette_depth = 1,
                                  .seed = 1,
                                  .detail = 0.3f,
                                  .lamp_field = true};
    world.sky = (Sky){.kind = SKY_SUN_SKY,
                      .color = {1.0f, 1.0f, 1.0f},
                      .sun_elevation = 35.0f,
                      .sun_azimuth = 45.0f,
                      .sun_size = 0.53f,
                      .sun_strength = 1.0f,
                      .turbidity = 2.5f,
                      .sidereal = 285.0f, // a summer evening
                      .altitude = 50.0f,
                      .ground_albedo = 0.2f,
                      .moon_elevation = 35.0f,
                      .moon_azimuth = 45.0f,
                      .moon_size = 0.53f,
                      .stars = 1.0f,
                      .strength = 1.0f,
                      .visible = true};
    return world;
}

World *world_new(Error *e)
{
    World *world = memory_alloc(1, sizeof *world, e);
    if (world) {
        *world = world_default();
    }
    return world;
}

void world_free(World *world)
{
    if (world) {
        cloud_grounds_free(world->cloud, world->cloud_count);
        free(world->cloud);
        free(world->shower);
        free(world->light);
        free(world->material);
        geometry_clear(&world->geometry);
        mask_set_clear(&world->masks);
        free(world);
    }
}

bool world_uses_material(const World *world, int material)
{
    for (int64_t i = 0; i < world->geometry.count; i++) {
        if (world->geometry.part[i].material == material) {
            return true;
        }
    }
    return false;
}
