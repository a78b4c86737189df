#include "render/light/emission.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/light/lights_internal.h"
#include "render/warp.h"

#include <stdlib.h>

struct EmissionTable {
    const Lights *lights;
    int64_t lamps, count; // lamps come first, then emitters
    double sum[];         // count + 1: cumulated luminous power
};

// A place on a light and what it emits there.
typedef struct Spot {
    Vec3 position, normal;
    float extent;
    Vec3 radiance;
    float area; // m^2 over the density of the place among all of the light
} Spot;

static double lamp_flux(const Light *light)
{
    double area = light->kind == LIGHT_QUAD
                      ? (double)vec3_length(vec3_cross(light->edge_u, light->edge_v))
                      : 4.0 * (double)PI_F * (double)(light->radius * light->radius);
    return (double)PI_F * area * (double)luminance(light->radiance);
}

static Vec3 radiance_of(const Lights *lights, const Emitter *emitter)
{
    const World *world = lights->world;
    return world->material[world->geometry.part[emitter->part].material].radiance;
}

EmissionTable *emission_table_new(const Lights *lights, Error *e)
{
    const EmitterSet *set = &lights->emitters;
    int64_t lamps = lights->world->light_count, count = lamps + (set->tree ? set->count : 0);
    EmissionTable *table = memory_alloc(1, sizeof *table + sizeof(double) * (size_t)(count + 1), e);
    if (!table) {
        return NULL;
    }
    table->lights = lights;
    table->lamps = lamps;
    table->count = count;
    table->sum[0] = 0.0;
    for (int64_t i = 0; i < count; i++) {
        double flux;
        if (i < lamps) {
            flux = lamp_flux(&lights->world->light[i]);
        } else {
            const Emitter *emitter = &set->emitter[i - lamps];
            float glow = luminance(radiance_of(lights, emitter));
            flux = (double)emitter_bounds(emitter, glow).power;
        }
        table->sum[i + 1] = table->sum[i] + (isfinite(flux) && flux > 0.0 ? flux : 0.0);
    }
    if (!(table->sum[count] > 0.0)) {
        free(table);
        return NULL;
    }
    return table;
}

void emission_table_free(EmissionTable *table)
{
    free(table);
}

float emission_power(const EmissionTable *table)
{
    return (float)table->sum[table->count];
}

static Spot lamp_spot(const Light *light, uint64_t key)
{
    float u = random_unit(random_key(key, 2)), v = random_unit(random_key(key, 3));
    Spot spot = {.radiance = light->radiance};
    if (light->kind == LIGHT_QUAD) {
        Vec3 across = vec3_cross(light->edge_u, light->edge_v);
        spot.area = vec3_length(across);
        spot.normal = vec3_scale(across, 1.0f / spot.area);
        spot.position = vec3_madd(vec3_madd(light->corner, u, light->edge_u), v, light->edge_v);
        spot.extent = vec3_length(vec3_add(light->edge_u, light->edge_v));
        return spot;
    }
    spot.normal = random_direction(random_key(key, 2));
    spot.position = vec3_madd(light->center, light->radius, spot.normal);
    spot.extent = light->radius;
    spot.area = 4.0f * PI_F * light->radius * light->radius;
    return spot;
}

static Spot emitter_spot(const Emitter *emitter, Vec3 radiance, uint64_t key)
{
    float u[2] = {random_unit(random_key(key, 2)), random_unit(random_key(key, 3))};
    EmissionSpot on = emitter_emit(emitter, u, random_unit(random_key(key, 4)));
    return (Spot){on.position, on.normal, on.extent, vec3_scale(radiance, on.glow), on.area};
}

// The light whose stretch of the cumulated power holds `at`.
static int64_t find(const EmissionTable *table, double at)
{
    int64_t low = 0, high = table->count;
    while (high - low > 1) {
        int64_t middle = low + (high - low) / 2;
        if (table->sum[middle] <= at) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

Emission emission_draw(const EmissionTable *table, uint64_t key)
{
    const Lights *lights = table->lights;
    double all = table->sum[table->count];
    int64_t i = find(table, (double)random_unit(random_key(key, 0)) * all);
    const Emitter *emitter = i < table->lamps ? NULL : &lights->emitters.emitter[i - table->lamps];
    Spot spot = emitter ? emitter_spot(emitter, radiance_of(lights, emitter), random_key(key, 1))
                        : lamp_spot(&lights->world->light[i], random_key(key, 1));
    float own = (float)(table->sum[i + 1] - table->sum[i]);
    float u = random_unit(random_key(key, 5)), v = random_unit(random_key(key, 6));
    Vec3 direction = warp_cosine(spot.normal, u, v);
    Vec3 origin = lights_end(spot.position, spot.normal, spot.extent, spot.position);
    float scale = own > 0.0f ? PI_F * spot.area / own : 0.0f;
    return (Emission){origin, direction, vec3_scale(spot.radiance, scale)};
}
