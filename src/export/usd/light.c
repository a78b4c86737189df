// Camera, lamps, sky and sun in USD's text format.
#include "base/color.h"
#include "export/asset_path.h"
#include "export/sky_bake.h"
#include "export/usd/usda.h"

#include "mesh/geometry_measure.h"
#include "render/camera.h"
#include "render/sky/dome.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SKY_COLUMNS = 1024 };

// ---- camera ----

// Distance of the far plane, beyond the whole world.
static float far_distance(const World *world)
{
    Aabb all = geometry_bounds(&world->geometry, 0);
    if (aabb_is_empty(all)) {
        return 1000.0f;
    }
    Vec3 p = world->camera.position;
    Vec3 reach = vec3_max(vec3_sub(p, all.low), vec3_sub(all.high, p));
    return fmaxf(1.01f * vec3_length(reach), 1.0f);
}

// For a film of 24 mm height. Lens lengths are in tenths of the stage's unit.
void usda_camera(Usda *usda)
{
    const World *world = usda->source->world;
    const Camera *camera = &world->camera;
    const float film_height = 0.24f;
    CameraFrame frame = camera_frame(camera, world->film.width, world->film.height);
    float focal = 0.5f * film_height / tanf(0.5f * camera->fov * RADIANS_PER_DEGREE);
    Transform t =
        transform_from_axes(vec3_normalize(frame.across), vec3_neg(vec3_normalize(frame.down)),
                            vec3_neg(frame.forward), camera->position);
    UsdaText *text = &usda->text;
    const Vec3 clipping = {0.01f, far_distance(world), 0.0f};
    usda_begin(text, NULL, "def Camera \"Camera\"");
    usda_line(text, "token projection = \"perspective\"");
    usda_float(text, "float focalLength", focal);
    usda_float(text, "float verticalAperture", film_height);
    usda_float(text, "float horizontalAperture",
               film_height * (float)world->film.width / (float)world->film.height);
    usda_float(text, "float horizontalApertureOffset", film_height * camera->shift_x);
    usda_float(text, "float verticalApertureOffset", film_height * camera->shift_y);
    usda_line(text, "float2 clippingRange = (%.9g, %.9g)", (double)clipping.x, (double)clipping.y);
    usda_float(text, "float focusDistance", frame.focus);
    if (camera->aperture > 0.0f) {
        usda_float(text, "float fStop", 0.1f * focal / camera->aperture);
    }
    usda_transform(text, &t);
    usda_end(text);
}

// ---- lights ----

// Writes radiance as a colour of at most 1 and an intensity.
static void radiance(UsdaText *text, Vec3 value)
{
    float most = fmaxf(value.x, fmaxf(value.y, value.z));
    Vec3 color = most > 0.0f ? vec3_scale(value, 1.0f / most) : vec3_splat(1.0f);
    usda_vec3(text, "color3f inputs:color", color);
    usda_float(text, "float inputs:intensity", most);
}

static void quad(UsdaText *text, const Light *light, int index)
{
    // it shines along -z
    Vec3 z = vec3_neg(vec3_normalize(vec3_cross(light->edge_u, light->edge_v)));
    Vec3 middle = vec3_madd(vec3_madd(light->corner, 0.5f, light->edge_u), 0.5f, light->edge_v);
    Transform t = transform_from_axes(vec3_normalize(light->edge_v), vec3_normalize(light->edge_u),
                                      z, middle);
    usda_begin(text, NULL, "def RectLight \"Lamp_%d\"", index);
    radiance(text, light->radiance);
    usda_float(text, "float inputs:width", vec3_length(light->edge_v));
    usda_float(text, "float inputs:height", vec3_length(light->edge_u));
    usda_transform(text, &t);
    usda_end(text);
}

static void sphere(UsdaText *text, const Light *light, int index)
{
    Transform t = transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), light->center);
    usda_begin(text, NULL, "def SphereLight \"Lamp_%d\"", index);
    radiance(text, light->radiance);
    usda_float(text, "float inputs:radius", light->radius);
    usda_transform(text, &t);
    usda_end(text);
}

// The intensity of a normalised distant light is its irradiance.
static void sun_light(UsdaText *text, const Sun *sun)
{
    if (!(luminance(sun->radiance) > 0.0f)) {
        return;
    }
    Vec3 z = sun->direction, x = vec3_perpendicular(z); // it shines along -z
    Transform t = transform_from_axes(x, vec3_cross(z, x), z, vec3(0, 0, 0));
    float half_angle = 2.0f * asinf(sqrtf(0.5f * sun->one_minus_cos));
    usda_begin(text, NULL, "def DistantLight \"%s\"", sun->even ? "Moon" : "Sun");
    radiance(text, vec3_scale(sun->radiance, sun->solid_angle));
    usda_line(text, "bool inputs:normalize = 1");
    usda_float(text, "float inputs:angle", 2.0f * half_angle / RADIANS_PER_DEGREE);
    usda_transform(text, &t);
    usda_end(text);
}

static void dome_texture(UsdaText *text, const char *path)
{
    usda_asset(text, "asset inputs:texture:file", path);
    usda_line(text, "token inputs:texture:format = \"latlong\"");
}

static bool dome_picture(Usda *usda, const char *picture, Error *e)
{
    char *path = asset_path(usda->file, picture, e);
    if (path) {
        dome_texture(&usda->text, path);
    }
    bool done = path;
    free(path);
    return done;
}

// Bakes the sky into a picture file beside the exported one.
static bool baked_dome(Usda *usda, Error *e)
{
    const char *slash = strrchr(usda->file, '/');
    char *name = asset_beside(slash ? slash + 1 : usda->file, "-sky.exr", e);
    char path[PATH_MAX] = "";
    if (name) {
        snprintf(path, sizeof path, "./%s", name);
        radiance(&usda->text, vec3_splat(1.0f));
        dome_texture(&usda->text, path);
    }
    free(name);
    return path[0];
}

bool usda_write_sky(const Usda *usda, Error *e)
{
    if (!usda->sky) {
        return true;
    }
    char *picture = asset_beside(usda->file, "-sky.exr", e);
    ImageLayer layer = {"", "RGB", usda->sky};
    bool done = picture && image_write_exr(picture, &layer, 1, NULL, e);
    free(picture);
    return done;
}

static bool dome_light(Usda *usda, const Sky *sky, Error *e)
{
    if (sky->kind == SKY_NONE) {
        return true;
    }
    UsdaText *text = &usda->text;
    bool done = true;
    usda_begin(text, NULL, "def DomeLight \"Sky\"");
    if (sky->kind == SKY_ENVIRONMENT) {
        radiance(text, vec3_splat(sky->strength));
        done = dome_picture(usda, sky->file, e);
        usda_float(text, "float xformOp:rotateY", sky->rotation);
        usda_line(text, "uniform token[] xformOpOrder = [\"xformOp:rotateY\"]");
    } else if (usda->sky) {
        done = baked_dome(usda, e);
    } else {
        radiance(text, vec3_scale(sky->color, sky->strength));
    }
    usda_end(text);
    return done;
}

bool usda_lights(Usda *usda, Error *e)
{
    const World *world = usda->source->world;
    UsdaText *text = &usda->text;
    BakedSky baked;
    if (!sky_bake(&world->sky, SKY_COLUMNS, usda->run, &baked, e)) {
        return false;
    }
    usda->sky = baked.image;
    baked.image = NULL;
    usda_begin(text, NULL, "def Scope \"Lights\"");
    bool done = dome_light(usda, &world->sky, e);
    sun_light(text, &baked.sun);
    for (int i = 0; i < world->light_count; i++) {
        if (world->light[i].kind == LIGHT_QUAD) {
            quad(text, &world->light[i], i);
        } else {
            sphere(text, &world->light[i], i);
        }
    }
    usda_end(text);
    baked_sky_clear(&baked);
    return done;
}
