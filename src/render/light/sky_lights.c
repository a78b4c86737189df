// Light from infinity: the sky with its sun or moon, direct or refracted by water.
#include "render/light/lights_internal.h"

#include "render/sky/environment.h"
#include "render/sky/night.h"
#include "render/sky/stars.h"

#include <stddef.h>

// Clouds are lit by the sun and by the sky's mean radiance half way up.
static PaintedClouds paint_clouds(const Lights *lights)
{
    const Sky *sky = &lights->world->sky;
    PaintedClouds clouds = {.cover = sky->clouds,
                            .sun_direction = lights->sun.direction,
                            .sunlight = vec3_scale(lights->sun.radiance, lights->sun.solid_angle),
                            .seed = (uint32_t)lights->world->render.seed};
    const float half = 0.70710678f;
    const Vec3 around[4] = {{half, half, 0}, {-half, half, 0}, {0, half, half}, {0, half, -half}};
    for (int i = 0; i < 4; i++) {
        clouds.skylight = vec3_madd(clouds.skylight, 0.25f, dome_lookup(lights->dome, around[i]));
    }
    return clouds;
}

static bool make_day(Lights *lights, const Run *run, Error *e)
{
    const Sky *sky = &lights->world->sky;
    Atmosphere *atmosphere = sky_atmosphere(sky, run, e);
    lights->dome = atmosphere ? sky_dome(sky, atmosphere, &lights->sun, run, e) : NULL;
    if (!lights->dome || !(sky->aerial_perspective > 0.0f)) {
        atmosphere_free(atmosphere);
        return lights->dome;
    }
    lights->air = air_new(atmosphere, sky, e);
    return lights->air;
}

static bool make_sky(Lights *lights, const Run *run, Error *e)
{
    const Sky *sky = &lights->world->sky;
    switch (sky->kind) {
    case SKY_NONE:
        return true;
    case SKY_CONSTANT:
        lights->constant = vec3_scale(sky->color, sky->strength);
        return true;
    case SKY_SUN_SKY:
        if (!make_day(lights, run, e)) {
            return false;
        }
        lights->clouds = paint_clouds(lights);
        break;
    case SKY_NIGHT:
        lights->dome = night_dome(sky, &lights->sun, e);
        break;
    case SKY_ENVIRONMENT:
        lights->dome = environment_dome(sky, run, e);
        break;
    }
    if (lights->dome) {
        lights->built_sun = lights->sun;
        lights->built_rotation = lights->dome->rotation;
        lights_turn_sky(lights);
    }
    return lights->dome != NULL;
}

// From azimuth 0 (+Z) toward 90 degrees (+X).
static Vec3 turned(Vec3 d, float cosine, float sine)
{
    return vec3(d.x * cosine + d.z * sine, d.y, d.z * cosine - d.x * sine);
}

// Rotates a direction from the world to the sky as it was built.
static Vec3 into_sky(const Lights *lights, Vec3 direction)
{
    return turned(direction, lights->turn_cos, -lights->turn_sin);
}

void lights_turn_sky(Lights *lights)
{
    float angle = lights->world->sky.rotation * RADIANS_PER_DEGREE;
    lights->turn_cos = cosf(angle);
    lights->turn_sin = sinf(angle);
    lights->sun.direction = turned(lights->built_sun.direction, lights->turn_cos, lights->turn_sin);
    if (lights->dome) {
        lights->dome->rotation = lights->built_rotation + angle;
    }
}

// Caustics are sharp at the camera's target.
static bool make_water(Lights *lights, const Run *run, Error *e)
{
    const World *world = lights->world;
    if (world->medium.kind != MEDIUM_WATER) {
        return true;
    }
    float depth = world->medium.height - world->camera.target.y;
    depth = depth > 0.0f ? depth : fmaxf(world->medium.height - world->camera.position.y, 1.0f);
    float sun_radius = sqrtf(lights->sun.solid_angle / PI_F);
    lights->water = water_new(&world->medium, lights->sun.direction, sun_radius, depth,
                              world->render.seed, run, e);
    return lights->water != NULL;
}

bool lights_make_above(Lights *lights, const Run *run, Error *e)
{
    return make_sky(lights, run, e) && make_water(lights, run, e);
}

// Refracts light from above the water down to a point in it.
static bool into_water(const Lights *lights, Vec3 point, bool sun, LightSample *sample)
{
    WaterPassage passage;
    if (!water_enter(sample->direction, &passage)) {
        return false;
    }
    float scale = WATER_INDEX * WATER_INDEX * passage.share;
    scale *= sun ? water_caustic(lights->water, point) : 1.0f;
    sample->radiance = vec3_scale(sample->radiance, scale);
    sample->direction = passage.direction;
    sample->pdf *= passage.shrink;
    return true;
}

bool lights_sample_above(const Lights *lights, int index, Vec3 point, const float u[2],
                         LightSample *sample)
{
    sample->distance = INFINITY;
    sample->slack = 0.0f;
    sample->part = -1;
    if (index == lights->dome_index) {
        DomeLight light;
        sample->direction = dome_sample(lights->dome, u[0], u[1], &light);
        sample->radiance = light.radiance;
        sample->pdf = light.density;
    } else {
        sample->direction = sun_sample(&lights->sun, u[0], u[1]);
        sample->radiance = sun_radiance(&lights->sun, sample->direction);
        sample->pdf = 1.0f / lights->sun.solid_angle;
    }
    return !water_covers(lights->water, point) ||
           into_water(lights, point, index == lights->sun_index, sample);
}

const Water *lights_water(const Lights *lights)
{
    return lights->water;
}

// Seen by the camera and in mirrors only: clouds, stars, the face of the moon.
static Vec3 seen_above(const Lights *lights, Vec3 direction, const DomePlace *place, float spread)
{
    const Sky *sky = &lights->world->sky;
    Vec3 above = into_sky(lights, direction);
    Vec3 sum = painted_clouds_before(&lights->clouds, above, dome_radiance(lights->dome, place));
    bool covered = lights->sun_index >= 0 && sun_covers(&lights->sun, direction);
    if (sky->kind == SKY_NIGHT && !covered) {
        sum = vec3_add(sum, night_stars(sky, above, spread));
    }
    if (covered) {
        float face = lights->sun.even ? night_moon_face(sky, &lights->built_sun, above) : 1.0f;
        sum = vec3_madd(sum, face, sun_radiance(&lights->sun, direction));
    }
    return sum;
}

// Its light, weighted; shrink: see WaterPassage.
static Vec3 light_above(const Lights *lights, Vec3 direction, const DomePlace *place,
                        float bsdf_pdf, float shrink, float sun_share)
{
    DomeLight sky = dome_at(lights->dome, place);
    float pdf = sky.density * lights->share[lights->dome_index] * shrink;
    Vec3 sum = vec3_scale(sky.radiance, lights_weight(bsdf_pdf, pdf));
    if (lights->sun_index >= 0 && sun_covers(&lights->sun, direction)) {
        pdf = lights->share[lights->sun_index] / lights->sun.solid_angle * shrink;
        sum = vec3_madd(sum, lights_weight(bsdf_pdf, pdf) * sun_share,
                        sun_radiance(&lights->sun, direction));
    }
    return sum;
}

// The sun seen through waves is blurred over a few degrees: glints would not converge at any number
// of samples.
static Vec3 glitter(const Lights *lights, Vec3 direction)
{
    const float spread = 0.03f; // radians
    Vec3 off = vec3_sub(direction, lights->sun.direction);
    float share = expf(-0.5f * vec3_dot(off, off) / (spread * spread));
    float solid_angle = 2.0f * PI_F * spread * spread;
    return vec3_scale(lights->sun.radiance, share * lights->sun.solid_angle / solid_angle);
}

static Vec3 background_from_water(const Lights *lights, const BackgroundRay *ray)
{
    Vec3 from = ray->from, direction = ray->direction;
    WaterPassage passage;
    bool eye = ray->bsdf_pdf <= 0.0f;
    Vec3 normal = vec3(0.0f, 1.0f, 0.0f);
    if (eye && direction.y > 0.0f) {
        float t = (lights->world->medium.height - from.y) / direction.y;
        normal = water_normal(lights->water, vec3_madd(from, t, direction));
    }
    if (!water_leave(direction, normal, &passage)) {
        return vec3_splat(0.0f);
    }
    Vec3 above = lights->constant;
    if (lights->dome) {
        DomePlace place = dome_find(lights->dome, passage.direction);
        if (eye && lights->world->sky.kind == SKY_SUN_SKY) {
            above = painted_clouds_before(&lights->clouds, into_sky(lights, passage.direction),
                                          dome_radiance(lights->dome, &place));
            above = vec3_add(above, glitter(lights, passage.direction));
        } else if (eye) {
            above = seen_above(lights, passage.direction, &place, ray->spread);
        } else {
            above = light_above(lights, passage.direction, &place, ray->bsdf_pdf, passage.shrink,
                                water_caustic(lights->water, from));
        }
    }
    return vec3_scale(above, WATER_INDEX * WATER_INDEX * passage.share);
}

void lights_background_many(const Lights *lights, const BackgroundRay ray[], int count,
                            Vec3 radiance[])
{
    DomePlace place[BACKGROUND_LIMIT];
    for (int i = 0; i < count && lights->dome; i++) {
        place[i] = dome_find(lights->dome, ray[i].direction);
    }
    for (int i = 0; i < count; i++) {
        const BackgroundRay *r = &ray[i];
        if (water_covers(lights->water, r->from)) {
            radiance[i] = background_from_water(lights, r);
        } else if (!lights->dome) {
            radiance[i] = lights->constant;
        } else if (r->bsdf_pdf > 0.0f) {
            radiance[i] = light_above(lights, r->direction, &place[i], r->bsdf_pdf, 1.0f, 1.0f);
        } else {
            radiance[i] = seen_above(lights, r->direction, &place[i], r->spread);
        }
    }
}

bool lights_air(const Lights *lights, Vec3 from, Vec3 direction, float distance, float u,
                AirView *view)
{
    if (lights->air) {
        *view = air_view(lights->air, from, direction, distance, lights->sun.direction, u);
    }
    return lights->air;
}

const Sun *lights_sun(const Lights *lights)
{
    return lights->sun_index >= 0 ? &lights->sun : NULL;
}

Vec3 lights_horizon(const Lights *lights, Vec3 direction)
{
    if (!lights->dome) {
        return lights->constant;
    }
    float level = sqrtf(direction.x * direction.x + direction.z * direction.z);
    float rise = 0.02f * fmaxf(level, 1e-3f); // a degree above the horizon, clear of the ground
    return dome_lookup(lights->dome, vec3_normalize(vec3(direction.x, rise, direction.z)));
}
