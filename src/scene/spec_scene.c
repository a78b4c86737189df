// Keys of the scene: camera, film, renderer, targets and golden image.
#include "render/world.h"
#include "scene/scene.h"
#include "scene/spec_check.h"

#include <stdlib.h>
#include <string.h>

static const Key CAMERA_KEYS[] = {
    {KEY_OF(Camera, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the camera."},
    {KEY_OF(Camera, target, "target", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Point the camera looks at: the centre of the image before `shift`."},
    {KEY_OF(Camera, up, "up", KEY_VECTOR), .count = 3,
     .doc = "Up direction of the image; any length."},
    {KEY_OF(Camera, fov, "fov", KEY_FLOAT), .flags = KEY_ABOVE | KEY_BELOW, .high = 180,
     .unit = "degrees", .doc = "Vertical field of view."},
    {KEY_OF(Camera, fov, "focal_length", KEY_FLOAT),
     .flags = KEY_INSTEAD | KEY_NO_DEFAULT | KEY_ABOVE, .high = 10000, .unit = "mm",
     .doc = "Focal length on a full-frame sensor, 24 mm high; an alternative to fov."},
    {KEY_OF(Camera, aperture, "aperture", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Diameter of the lens aperture; 0 = pinhole, everything in focus."},
    {KEY_OF(Camera, focus_distance, "focus_distance", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Focus distance; 0 = distance to the target."},
    {KEY_OF(Camera, shift_x, "shift", KEY_VECTOR), .count = 2, .low = -10, .high = 10,
     .unit = "image heights",
     .doc = "Lens shift to the right and up. With a level camera it raises the view and keeps "
            "vertical lines parallel."},
    {0},
};

static const Table CAMERA_TABLE = {
    .name = "camera",
    .doc = "The camera: position, orientation, field of view and focus.",
    .example =
        "camera: {position: [4, 1.5, 18], target: [0, 5, 0], focal_length: 50, aperture: 0.03}\n",
    .size = sizeof(Camera),
    .keys = CAMERA_KEYS,
    .check = check_camera};

static const EnumName FILTERS[] = {{"blackman_harris", FILTER_BLACKMAN_HARRIS},
                                   {"box", FILTER_BOX},
                                   {"gaussian", FILTER_GAUSSIAN},
                                   {0}};
static const EnumName VIEWS[] = {
    {"agx", VIEW_AGX}, {"filmic", VIEW_FILMIC}, {"standard", VIEW_STANDARD}, {0}};
static const EnumName LOOKS[] = {{"medium_high_contrast", AGX_MEDIUM_HIGH_CONTRAST},
                                 {"base_contrast", AGX_BASE_CONTRAST},
                                 {"high_contrast", AGX_HIGH_CONTRAST},
                                 {"punchy", AGX_PUNCHY},
                                 {0}};
static const EnumName DENOISERS[] = {
    {"own", DENOISER_OWN}, {"oidn", DENOISER_OIDN}, {"auto", DENOISER_AUTO}, {0}};

static const Key COLOR_KEYS[] = {
    {KEY_OF(OcioParams, config, "config", KEY_FILE), .flags = KEY_REQUIRED | KEY_OR_URI,
     .doc = "File of the configuration, or `ocio://NAME` for one that is built into OpenColorIO "
            "(version 2.2 or newer)."},
    {KEY_OF(OcioParams, display, "display", KEY_TEXT),
     .doc = "Display of the configuration; its default if omitted."},
    {KEY_OF(OcioParams, view, "view", KEY_TEXT),
     .doc = "View of the display; its default if omitted."},
    {KEY_OF(OcioParams, look, "look", KEY_TEXT),
     .doc = "Looks in place of the view's own, as in `grade, -warm`; the view's own if omitted."},
    {KEY_OF(OcioParams, space, "space", KEY_TEXT),
     .doc =
         "Colour space of the configuration that is linear Rec. 709. If omitted, it is found by "
         "its usual names, or through the role aces_interchange; without either, scene_linear is "
         "taken."},
    {0},
};

static const Table COLOR_TABLE = {
    .name = "color",
    .doc = "A view of an OpenColorIO configuration, in place of `view`, `look` and `contrast` of "
           "film. Exposure, white balance, saturation, bloom and vignette come before it.",
    .example = "film:\n"
               "  color:\n"
               "    config: ocio://studio-config-v1.0.0_aces-v1.3_ocio-v2.1\n"
               "    display: sRGB - Display\n"
               "    view: ACES 1.0 - SDR Video\n",
    .size = sizeof(OcioParams),
    .keys = COLOR_KEYS};

static const Key FILM_KEYS[] = {
    {KEY_OF(Scene, film.width, "width", KEY_INT), .low = 1, .high = 65536, .unit = "pixels",
     .doc = "Width of the image."},
    {KEY_OF(Scene, film.height, "height", KEY_INT), .low = 1, .high = 65536, .unit = "pixels",
     .doc = "Height of the image."},
    {KEY_OF(Scene, film.filter, "filter", KEY_ENUM), .names = FILTERS,
     .doc = "Pixel reconstruction filter. blackman_harris: sharp without ringing; gaussian: "
            "softer; box: equal weights."},
    {KEY_OF(Scene, film.filter_radius, "filter_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 16,
     .unit = "pixels", .doc = "Radius of the filter."},
    {KEY_OF(Scene, film.crop, "crop", KEY_VECTOR), .count = 4, .high = 1,
     .doc = "Region of the image to render: x0, y0, x1, y1 as fractions of the image size, from "
            "the top left."},
    {KEY_OF(Scene, tone.exposure, "exposure", KEY_FLOAT), .low = -50, .high = 50, .unit = "stops",
     .doc = "Exposure of the developed image; each stop doubles its brightness."},
    {KEY_OF(Scene, tone.auto_exposure, "auto_exposure", KEY_BOOL),
     .doc = "Set the exposure automatically, so that the log-average luminance becomes 0.18; "
            "`exposure` is added."},
    {KEY_OF(Scene, tone.view, "view", KEY_ENUM), .names = VIEWS,
     .doc =
         "View transform from radiance to the display. agx: rolls highlights off far, and bright "
         "colours pale toward white in their own hue; filmic: a shorter roll-off, in which "
         "bright colours turn toward yellow, cyan or magenta; standard: clips highlights."},
    {KEY_OF(Scene, tone.look, "look", KEY_ENUM), .names = LOOKS,
     .doc =
         "Contrast and saturation of `view: agx`. base_contrast: flat, for grading; punchy: more "
         "saturated."},
    {KEY_OF(Scene, tone.color, "color", KEY_POINTER), .table = &COLOR_TABLE,
     .doc = "A view of an OpenColorIO configuration; if omitted, `view` applies."},
    {KEY_OF(Scene, tone.contrast, "contrast", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Factor on the slope of the agx or filmic curve at middle grey; 1 = unchanged."},
    {KEY_OF(Scene, tone.saturation, "saturation", KEY_FLOAT), .high = 10,
     .doc = "Colour saturation: 0 = grey, 1 = unchanged."},
    {KEY_OF(Scene, tone.white_balance, "white_balance", KEY_FLOAT), .high = 40000, .unit = "K",
     .doc = "Colour temperature of the light that appears neutral; 0 or 6500 = unchanged."},
    {KEY_OF(Scene, tone.bloom, "bloom", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the light that the lens scatters into a glow around bright areas."},
    {KEY_OF(Scene, tone.vignette, "vignette", KEY_FLOAT), .high = 1,
     .doc = "Strength of the darkening toward the corners of the image."},
    {KEY_OF(Scene, png_depth, "png_depth", KEY_INT), .low = 8, .high = 16, .unit = "bits",
     .doc = "Bits per channel of PNG files, 8 or 16. 8 bits are dithered against banding."},
    {KEY_OF(Scene, downsample, "downsample", KEY_INT), .low = 1, .high = 8,
     .doc =
         "Pixels of the film, a side, that are averaged to one of the developed picture: with 2, "
         "an image of 3840 x 2160 gives a PNG of 1920 x 1080, after denoising and view. Leaves "
         "and twigs keep their contrast, which the mean of their radiance would lose, and a "
         "fourth of the samples suffices. An EXR keeps the image's size."},
    {KEY_OF(Scene, sharpen, "sharpen", KEY_FLOAT), .high = 5,
     .doc = "Sharpening of the developed picture, as a camera does it: 0 = none, 0.5 = moderate, 1 "
            "= strong. It raises the contrast of detail of a pixel or two, without halos."},
    {KEY_OF(Scene, grain, "grain", KEY_FLOAT), .high = 1,
     .doc = "Film grain of the developed picture: the standard deviation of the noise at middle "
            "grey, as a share of white; black and white have none. 0.01 = fine, 0.03 = a fast "
            "film. An EXR has none. Frames differ with `animation.vary_noise`."},
    {KEY_OF(Scene, denoise, "denoise", KEY_BOOL),
     .doc = "Denoise the developed image. An EXR file keeps its raw layers and gets the layer "
            "`denoised` beside them."},
    {KEY_OF(Scene, denoiser, "denoiser", KEY_ENUM), .names = DENOISERS,
     .doc = "Denoiser to use. own: ramify's, the same result on every machine; oidn: Open Image "
            "Denoise, whose library must be installed (or named by the environment variable "
            "RAMIFY_OIDN); auto: oidn if its library can be loaded, otherwise own."},
    {0},
};

// A group of the scene itself, because its keys are in two structs: film and tone.
static const Table FILM_TABLE = {.name = "film",
                                 .doc = "Image size, pixel filter and tone mapping.",
                                 .example = "film: {width: 1920, height: 1080, auto_exposure: "
                                            "true, exposure: -0.5, contrast: 1.1, denoise: true}\n",
                                 .size = sizeof(Scene),
                                 .keys = FILM_KEYS,
                                 .check = check_film};

static const Key RENDER_KEYS[] = {
    {KEY_OF(RenderParams, samples, "samples", KEY_INT), .low = 1, .high = 1 << 24,
     .doc = "Paths per pixel. Twice as many take twice the time and reduce the noise to 0.7."},
    {KEY_OF(RenderParams, planned_samples, "planned_samples", KEY_INT), .high = 1 << 24,
     .doc =
         "Number of samples per pixel for which the pattern of the noise is laid out; 0 = samples. "
         "Pictures to which samples are added keep theirs."},
    {KEY_OF(RenderParams, first_sample, "first_sample", KEY_INT), .high = (1 << 24) - 1,
     .doc = "The samples before this one (counted from 0) are left to another rendering; `ramify "
            "merge` joins both."},
    {KEY_OF(RenderParams, end_sample, "end_sample", KEY_INT), .high = 1 << 24,
     .doc = "This sample and further ones are left to another rendering; 0 = none are."},
    {KEY_OF(RenderParams, max_depth, "max_depth", KEY_INT), .low = 1, .high = 10000,
     .doc = "Maximum number of bounces of a path; 1 = direct light only. Glass and leaves need "
            "more than opaque surfaces."},
    {KEY_OF(RenderParams, roulette_depth, "roulette_depth", KEY_INT), .high = 10000,
     .doc = "Number of bounces before Russian roulette may end a path; the value of max_depth "
            "turns it off."},
    {KEY_OF(RenderParams, clamp, "clamp", KEY_FLOAT), .high = 1e9,
     .doc = "Upper bound on the indirect luminance of one path, to suppress fireflies; 0 = none."},
    {KEY_OF(RenderParams, max_noise, "noise", KEY_FLOAT), .flags = KEY_BELOW, .high = 1,
     .doc = "Adaptive sampling: stop sampling a region of the image when its estimated relative "
            "error is below this; 0 = take all samples everywhere."},
    {KEY_OF(RenderParams, detail, "detail", KEY_FLOAT), .high = 10, .unit = "pixels",
     .doc = "Leaves, blades of grass and twigs that are small in the image are traced as simpler "
            "forms of equal area, which are off by at most so much; 0 = full detail everywhere, "
            "which takes about half as long again among leaves."},
    {KEY_OF(RenderParams, lamp_field, "lamp_field", KEY_BOOL),
     .doc = "Light of lamps and glowing objects that clouds have scattered many times comes from a "
            "field that photons fill before the picture; false = from paths alone, without the "
            "field's small error and with hundreds of times the noise deep in a cloud."},
    {KEY_OF(RenderParams, noise_seed, "noise_seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of the noise pattern; it changes nothing else in the image."},
    {KEY_OF(RenderParams, max_seconds, "seconds", KEY_DOUBLE), .high = 1e8, .unit = "s",
     .doc = "Time limit for rendering; 0 = none."},
    {0},
};

static const Table RENDER_TABLE = {
    .name = "render",
    .doc = "Path tracer: samples, path length, noise threshold and time limit.",
    .example = "render: {samples: 256, max_depth: 12, noise: 0.02}\n",
    .size = sizeof(RenderParams),
    .keys = RENDER_KEYS,
    .check = check_render};

static const Key TARGET_KEYS[] = {
    {KEY_OF(SceneTarget, object, "object", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the object."},
    {KEY_OF(SceneTarget, measure, "measure", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the measure, as printed by `ramify measure`."},
    {KEY_OF(SceneTarget, low, "low", KEY_DOUBLE),
     .doc = "Minimum value that meets the target; no minimum if omitted."},
    {KEY_OF(SceneTarget, high, "high", KEY_DOUBLE),
     .doc = "Maximum value that meets the target; no maximum if omitted."},
    {0},
};

static void target_defaults(void *out)
{
    *(SceneTarget *)out = (SceneTarget){.low = -TARGET_NO_BOUND, .high = TARGET_NO_BOUND};
}

static const Table TARGET_TABLE = {
    .name = "target",
    .doc = "A required range for a measure of an object. `ramify measure` reports whether it is "
           "met and fails if it is not.",
    .example = "objects:\n"
               "  - name: oak\n"
               "    tree: {}\n"
               "targets:\n"
               "  - {object: oak, measure: branch_angle, low: 30, high: 70}\n",
    .size = sizeof(SceneTarget),
    .keys = TARGET_KEYS,
    .defaults = target_defaults,
    .check = check_target};

static const EnumName GOLDEN_MODES[] = {{"tolerance", GOLDEN_TOLERANCE},
                                        {"exact", GOLDEN_EXACT},
                                        {"statistical", GOLDEN_STATISTICAL},
                                        {0}};

static const Key GOLDEN_KEYS[] = {
    {KEY_OF(SceneGolden, mode, "mode", KEY_ENUM), .names = GOLDEN_MODES,
     .doc = "tolerance: equal within the limits below; exact: identical 8-bit values; statistical: "
            "equal except for noise."},
    {KEY_OF(SceneGolden, max_rmse, "max_rmse", KEY_DOUBLE), .high = 1,
     .doc = "tolerance: maximum root-mean-square difference of display values, 0..1."},
    {KEY_OF(SceneGolden, threshold, "threshold", KEY_DOUBLE), .high = 1,
     .doc = "tolerance: a pixel fails if a channel differs by more than this."},
    {KEY_OF(SceneGolden, max_failing, "max_failing", KEY_DOUBLE), .high = 1,
     .doc = "tolerance: maximum fraction of pixels that may fail, 0..1."},
    {KEY_OF(SceneGolden, alpha, "alpha", KEY_DOUBLE), .flags = KEY_ABOVE | KEY_BELOW, .high = 1,
     .doc = "statistical: probability of a false alarm, when only the noise differs."},
    {KEY_OF(SceneGolden, runs, "runs", KEY_INT), .low = 2, .high = 1000,
     .doc = "statistical: number of renderings on each side, each with its own noise seed."},
    {0},
};

SceneGolden scene_golden_default(void)
{
    // Other instruction sets and math libraries change last bits, so that rare paths hit another
    // triangle: measured RMSE up to 0.00026, with 0.016 % of pixels over the threshold.
    return (SceneGolden){
        .max_rmse = 0.0007, .threshold = 0.012, .max_failing = 0.0008, .alpha = 0.01, .runs = 4};
}

static const Table GOLDEN_TABLE = {
    .name = "golden",
    .doc = "How `ramify golden` compares the rendered image with the stored one.",
    .example = "golden: {mode: tolerance, max_failing: 0.002}\n",
    .size = sizeof(SceneGolden),
    .keys = GOLDEN_KEYS};

static const Key SCENE_KEYS[] = {
    {KEY_OF(Scene, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of all random numbers; another seed grows another individual of the same kind."},
    {KEY_OF(Scene, grow_to, "grow_to", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the growth that is shown: 0 = none, 1 = all."},
    {KEY_OF(Scene, camera, "camera", KEY_GROUP), .table = &CAMERA_TABLE, .doc = "The camera."},
    {.key = "film",
     .type = KEY_GROUP,
     .table = &FILM_TABLE,
     .doc = "Image size, pixel filter and tone mapping."},
    {KEY_OF(Scene, render, "render", KEY_GROUP), .table = &RENDER_TABLE,
     .doc = "Path tracer: samples, path length, noise threshold and time limit."},
    {KEY_OF(Scene, sky, "sky", KEY_GROUP), .table = &sky_table,
     .doc = "Light from the environment: day sky, night sky, panorama or constant colour."},
    {KEY_OF(Scene, medium, "medium", KEY_POINTER), .table = &medium_table,
     .doc = "Fog, haze or water that fills the scene; clear air if omitted."},
    {KEY_OF(Scene, clouds, "clouds", KEY_LIST), .count_offset = offsetof(Scene, cloud_count),
     .count = 16, .table = &cloud_table,
     .doc = "Clouds that light passes through and that cast shadows."},
    {KEY_OF(Scene, showers, "showers", KEY_LIST), .count_offset = offsetof(Scene, shower_count),
     .count = RAIN_MOST_SHOWERS, .table = &shower_table,
     .doc = "Shafts of rain, with the rainbow in them."},
    {KEY_OF(Scene, lights, "lights", KEY_LIST), .count_offset = offsetof(Scene, light_count),
     .count = 100000, .table = &light_table, .doc = "Area lights."},
    {KEY_OF(Scene, materials, "materials", KEY_LIST),
     .count_offset = offsetof(Scene, material_count), .count = 10000, .table = &material_table,
     .doc = "Materials, which objects refer to by name. bark, twig, leaf, ground, grass, fallen, "
            "conifer, ice, rime, soap_film, copper, lightning, coral, coral_polyp, reef_rock, "
            "mountain, badlands, terrain/strata, terrain/dunes, lake, altitude, artery, vein, "
            "leaf_vein, broken "
            "and clay are "
            "built in; an "
            "entry with one of these names changes it."},
    {KEY_OF(Scene, objects, "objects", KEY_LIST), .count_offset = offsetof(Scene, object_count),
     .flags = KEY_REQUIRED, .low = 1, .count = 10000, .table = &object_table,
     .doc = "Objects of the scene."},
    {KEY_OF(Scene, targets, "targets", KEY_LIST), .count_offset = offsetof(Scene, target_count),
     .count = 1000, .table = &TARGET_TABLE,
     .doc = "Required values of measures, checked by `ramify measure`."},
    {KEY_OF(Scene, animation, "animation", KEY_POINTER), .table = &animation_table,
     .doc = "Animation, for `ramify turntable`; if omitted, only the camera moves."},
    {KEY_OF(Scene, golden, "golden", KEY_GROUP), .table = &GOLDEN_TABLE,
     .doc = "How `ramify golden` compares the rendered image with the stored one."},
    {0},
};

// The defaults are those of the modules.
static void scene_defaults(void *out)
{
    Scene *scene = out;
    const World world = world_default();
    scene->camera = world.camera;
    scene->film = world.film;
    scene->render = world.render;
    scene->sky = world.sky;
    scene->seed = 1;
    scene->grow_to = 1.0f;
    scene->tone = tone_params_default();
    scene->png_depth = 8;
    scene->downsample = 1;
    scene->golden = scene_golden_default();
}

const Table scene_table = {.name = "scene",
                           .doc = "A ramify scene: one file describes one image. Metres, degrees, "
                                  "right-handed, Y up, linear Rec. 709 colours.",
                           .example =
                               "seed: 7\n"
                               "camera: {position: [0, 1.7, 26], target: [0, 6.2, 0], fov: 34}\n"
                               "film: {auto_exposure: true}\n"
                               "sky: {kind: sun_sky, sun_elevation: 14, sun_azimuth: 60}\n"
                               "objects:\n"
                               "  - name: meadow\n"
                               "    ground: {}\n"
                               "  - name: oak\n"
                               "    tree: {height: 14}\n",
                           .size = sizeof(Scene),
                           .keys = SCENE_KEYS,
                           .defaults = scene_defaults,
                           .check = check_scene};
