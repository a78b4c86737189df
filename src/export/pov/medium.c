// Haze and media as fog of one colour, or, around lamps, as POV-Ray's scattering media.
#include "export/pov/pov.h"

#include "base/color.h"
#include "render/camera.h"

// The mean radiance of the sky over all directions, which isotropic scattering shows.
static Vec3 mean_sky(const Pov *pov)
{
    enum { DRAWS = 256 };
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < DRAWS; i++) { // a Fibonacci spiral
        float y = 1.0f - (2.0f * (float)i + 1.0f) / DRAWS, turn = 2.39996323f * (float)i;
        float level = sqrtf(1.0f - y * y);
        Vec3 d = vec3(level * cosf(turn), y, level * sinf(turn));
        if (!pov->sun || !sun_covers(pov->sun, d)) {
            Vec3 c = lights_background(pov->lights, vec3_splat(0.0f), d, 0.0f, 0.1f);
            sum = vec3_madd(sum, 1.0f / DRAWS, c);
        }
    }
    return sum;
}

// Fog from the ground to `top`, thinning out above within `rise` (m).
static void write_fog(Pov *pov, float distance, float top, float rise, Vec3 color)
{
    file_writer_print(
        pov->out, "fog {\n    fog_type 2 distance %.9g fog_offset %.9g fog_alt %.9g\n    rgb ",
        (double)(distance * pov->unit), (double)(top * pov->unit), (double)(rise * pov->unit));
    pov_vector(pov, color);
    file_writer_text(pov->out, "\n}\n\n");
}

// Directions through the film's columns, or all around if the camera looks straight up or down.
static Vec3 horizon_direction(const Pov *pov, const CameraFrame *frame, float t)
{
    const FilmParams *film = &pov->world->film;
    float pixels = (float)film->width * (t - 0.5f);
    pixels += (float)film->height * pov->world->camera.shift_x;
    Vec3 d = vec3_madd(frame->forward, pixels, frame->across);
    d.y = 0.0f;
    if (vec3_length(d) < 0.1f) {
        d = vec3(cosf(2.0f * PI_F * t), 0.0f, sinf(2.0f * PI_F * t));
    }
    return vec3_normalize(d);
}

// The distance over which haze and air take light to 1 / e, m; INFINITY without any.
static float haze_length(const Sky *sky)
{
    float haze =
        sky->kind != SKY_NONE && sky->haze_distance > 0.0f ? 1.0f / sky->haze_distance : 0.0f;
    if (sky->kind == SKY_SUN_SKY) {
        haze += sky->aerial_perspective / (1000.0f * atmosphere_clear_length(sky->turbidity));
    }
    return 1.0f / haze;
}

// Fog has one colour, haze that of the horizon behind it. The visible part of the horizon counts,
// which may be a third as bright as the mean when the sun is low.
static Vec3 haze_color(const Pov *pov)
{
    enum { COLUMNS = 16 };
    const FilmParams *film = &pov->world->film;
    CameraFrame frame = camera_frame(&pov->world->camera, film->width, film->height);
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < COLUMNS; i++) {
        Vec3 d = horizon_direction(pov, &frame, ((float)i + 0.5f) / COLUMNS);
        sum = vec3_madd(sum, 1.0f / COLUMNS, lights_horizon(pov->lights, d));
    }
    return sum;
}

// Haze ends a little above the scene, so that it does not cover the sky.
static float haze_rise(const Pov *pov)
{
    return fmaxf(0.02f * pov->height, 1e-3f);
}

PovHaze pov_haze(const Pov *pov)
{
    float length = haze_length(&pov->world->sky);
    if (isinf(length)) {
        return (PovHaze){0};
    }
    float above = fmaxf(0.0f, pov->top - pov->world->camera.position.y);
    float depth = above + 0.5f * PI_F * haze_rise(pov); // its density is 1 / (1 + (y / rise)^2)
    return (PovHaze){haze_color(pov), depth / length};
}

Vec3 pov_haze_undo(const PovHaze *haze, Vec3 direction, Vec3 color)
{
    const float least = 0.25f; // transmittance; below it only haze shows
    if (!(haze->depth > 0.0f) || !(direction.y > 0.0f)) {
        return color;
    }
    float left = expf(-haze->depth / direction.y);
    Vec3 own = vec3_madd(color, left - 1.0f, haze->color);
    return vec3_max(vec3_scale(own, 1.0f / fmaxf(left, least)), vec3_splat(0.0f));
}

// The colour deep in a medium: its albedo under sky and sun.
static Vec3 medium_color(const Pov *pov)
{
    const Medium *m = &pov->world->medium;
    Vec3 light = mean_sky(pov);
    if (pov->sun) {
        light = vec3_madd(light, 0.25f * pov->sun->solid_angle / PI_F, pov->sun->radiance);
    }
    Vec3 sum = vec3_add(m->scattering, m->absorption);
    return vec3(sum.x > 0.0f ? light.x * m->scattering.x / sum.x : 0.0f,
                sum.y > 0.0f ? light.y * m->scattering.y / sum.y : 0.0f,
                sum.z > 0.0f ? light.z * m->scattering.z / sum.z : 0.0f);
}

// POV-Ray's phase functions are 1 where nature's are 1 / 4 pi, and its lights are irradiance over
// pi: a quarter of the scattering gives the same light, and an extinction of four times that gives
// the same fading.
static void write_scattering(Pov *pov)
{
    const Medium *m = &pov->world->medium;
    float radius = m->extent > 0.0f ? m->extent : 3.0f * pov->radius;
    file_writer_text(pov->out, "sphere {\n    ");
    pov_point(pov, pov->center);
    file_writer_print(pov->out, ", %.9g hollow no_shadow\n    pigment { rgbt 1 }\n",
                      (double)(radius * pov->unit));
    file_writer_text(pov->out, "    interior { media {\n        scattering { 5, rgb ");
    pov_vector(pov, vec3_scale(m->scattering, 0.25f / pov->unit));
    file_writer_print(pov->out, " eccentricity %.9g extinction 4 }\n        absorption rgb ",
                      (double)m->anisotropy);
    pov_vector(pov, vec3_scale(m->absorption, 1.0f / pov->unit));
    file_writer_text(pov->out, "\n        method 3 intervals 1 samples 24\n    } }\n}\n\n");
}

void pov_medium(Pov *pov)
{
    const Medium *m = &pov->world->medium;
    float extinction = luminance(vec3_add(m->scattering, m->absorption));
    float haze = haze_length(&pov->world->sky);
    if (isfinite(haze)) {
        write_fog(pov, haze, pov->top, haze_rise(pov), haze_color(pov));
    }
    if (m->kind == MEDIUM_NONE || !(extinction > 0.0f)) {
        return;
    }
    if (m->kind == MEDIUM_EVERYWHERE) {
        write_scattering(pov);
        return;
    }
    float rise = m->kind == MEDIUM_LAYER ? m->falloff : 1e-3f * pov->radius;
    write_fog(pov, 1.0f / extinction, m->height, fmaxf(rise, 1e-6f), medium_color(pov));
    if (m->kind == MEDIUM_WATER) {
        run_warn(pov->run,
                 "water becomes plain fog: its surface, its waves and the sun's network of "
                 "light are lost");
    }
}
