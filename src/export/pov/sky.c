// Sky, sun, haze and media.
#include "export/pov/pov.h"

#include "base/color.h"
#include "base/memory.h"
#include "image/image.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

enum { SUN_GRID = 8 };

// Distance of the sun in radii of the scene: its rays are parallel to 0.006 degrees.
static const float SUN_AWAY = 1e4f;
static const float SKY_AWAY = 100.0f;

// ---- the picture of the sky

// POV-Ray's spherical image map: u turns from +x to +z, v rises.
static Vec3 texel_direction(int x, int y, int width, int height)
{
    float turn = 2.0f * PI_F * ((float)x + 0.5f) / (float)width;
    float rise = PI_F * (0.5f - ((float)y + 0.5f) / (float)height);
    return vec3(cosf(rise) * cosf(turn), sinf(rise), cosf(rise) * sinf(turn));
}

// Moves a direction inside the sun's disc beside it: the disc is a separate object.
static Vec3 beside_sun(const Sun *sun, Vec3 direction)
{
    if (!sun || !sun_covers(sun, direction)) {
        return direction;
    }
    float cosine = 1.0f - 1.05f * sun->one_minus_cos;
    Vec3 aside = vec3_madd(direction, -vec3_dot(direction, sun->direction), sun->direction);
    float length = vec3_length(aside);
    aside = length > 0.0f ? vec3_scale(aside, 1.0f / length) : vec3_perpendicular(sun->direction);
    return vec3_madd(vec3_scale(sun->direction, cosine), sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine)),
                     aside);
}

static void bake_sky(const Pov *pov, Image *image)
{
    const Vec3 origin = {0.0f, 0.0f, 0.0f};
    float spread = PI_F / (float)image->height;
    PovHaze haze = pov_haze(pov);
#pragma omp parallel for schedule(dynamic) num_threads(pov->run->threads)
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            Vec3 d = texel_direction(x, y, image->width, image->height);
            Vec3 c = lights_background(pov->lights, origin, beside_sun(pov->sun, d), 0.0f, spread);
            c = pov_haze_undo(&haze, d, c);
            float *pixel = image->pixel + ((int64_t)y * image->width + x) * 3;
            pixel[0] = c.x;
            pixel[1] = c.y;
            pixel[2] = c.z;
        }
    }
}

static bool write_sky_picture(Pov *pov)
{
    const Sky *sky = &pov->world->sky;
    bool smooth = sky->kind == SKY_SUN_SKY && !(sky->clouds > 0.0f);
    int height = smooth ? 512 : 1024;
    Image *image = image_new(2 * height, height, 3, pov->e);
    char name[PATH_MAX];
    snprintf(name, sizeof name, "%s/sky.exr", pov->folder);
    bool done = image && pov_make_folder(pov);
    if (done) {
        bake_sky(pov, image);
        ImageLayer layer = {"", "RGB", image};
        done = image_write_exr(name, &layer, 1, NULL, pov->e);
    }
    image_free(image);
    return done;
}

static void write_sky_pigment(Pov *pov)
{
    if (pov->world->sky.kind == SKY_CONSTANT) {
        file_writer_text(pov->out, "pigment { rgb ");
        pov_vector(pov, vec3_scale(pov->world->sky.color, pov->world->sky.strength));
        file_writer_text(pov->out, " }");
    } else {
        file_writer_print(pov->out,
                          "pigment { image_map { exr \"%s/sky.exr\" map_type 1 interpolate 2 } }",
                          pov->beside);
    }
}

// Light that the camera must not see comes from a sphere around the scene that emits inward.
static void write_sky(Pov *pov)
{
    if (pov->world->sky.visible) {
        file_writer_text(pov->out, "sky_sphere { ");
        write_sky_pigment(pov);
        file_writer_text(pov->out, " }\n\n");
        return;
    }
    file_writer_text(pov->out, "sphere { 0, 1 hollow no_image no_shadow\n    texture { ");
    write_sky_pigment(pov);
    file_writer_print(pov->out, " finish { diffuse 0 emission 1 } }\n    scale %.9g translate ",
                      (double)(SKY_AWAY * pov->radius * pov->unit));
    pov_point(pov, pov->center);
    file_writer_text(pov->out, "\n}\n\n");
}

// ---- the sun

// A distant light, not a parallel one, which has no angular size.
static void write_sun(Pov *pov)
{
    const Sun *sun = pov->sun;
    float away = SUN_AWAY * pov->radius;
    Vec3 place = vec3_madd(pov->center, away, sun->direction);
    float sine2 = sun->one_minus_cos * (2.0f - sun->one_minus_cos);
    float radius = away * sqrtf(sine2) * pov->unit;
    float side = 2.0f * radius * (float)(SUN_GRID - 1) / (float)SUN_GRID;
    file_writer_text(pov->out, "light_source {\n    ");
    pov_point(pov, place);
    file_writer_text(pov->out, " rgb ");
    pov_vector(pov, vec3_scale(sun->radiance, sun->solid_angle / PI_F));
    file_writer_print(pov->out,
                      "\n    area_light <%.9g,0,0>, <0,%.9g,0>, %d, %d adaptive 1 circular orient\n"
                      "}\n",
                      (double)side, (double)side, SUN_GRID, SUN_GRID);
    if (!pov->world->sky.visible) {
        return;
    }
    file_writer_text(pov->out, "sphere { ");
    pov_point(pov, place);
    file_writer_print(pov->out, ", %.9g\n    texture { pigment { rgb ", (double)radius);
    pov_vector(pov, sun->radiance);
    file_writer_text(pov->out, " } finish { diffuse 0 emission 1 } }\n"
                               "    no_shadow no_radiosity\n}\n\n");
}

// ---- light that has bounced

static bool is_dark(const Sky *sky)
{
    return sky->kind == SKY_NONE || !(sky->strength > 0.0f) ||
           (sky->kind == SKY_CONSTANT && !(luminance(sky->color) > 0.0f));
}

// Leaves and grass have few neighbours in their plane, so most pixels there gather on their own.
// Wide reuse, one bounce and no further samples in the last pass keep that affordable.
static void write_radiosity(Pov *pov)
{
    file_writer_text(pov->out, "// Light of the sky, and light between surfaces: 0 leaves it out.\n"
                               "#ifndef (Radiosity) #declare Radiosity = 1; #end\n"
                               "#if (Radiosity)\n"
                               "global_settings { radiosity {\n"
                               "    pretrace_start 0.08 pretrace_end 0.04 always_sample off\n"
                               "    count 40 nearest_count 5 error_bound 1.5 minimum_reuse 0.03\n"
                               "    recursion_limit 1 gray_threshold 0 brightness 1\n"
                               "} }\n"
                               "#end\n\n");
}

bool pov_sky(Pov *pov)
{
    const Sky *sky = &pov->world->sky;
    bool dark = is_dark(sky);
    if (pov->world->render.max_depth > 1) { // radiosity adds a bounce
        write_radiosity(pov);
    }
    if (dark) {
        return true;
    }
    if (sky->kind != SKY_CONSTANT && !write_sky_picture(pov)) {
        return false;
    }
    write_sky(pov);
    if (pov->sun) {
        write_sun(pov);
    }
    return true;
}
