// The scene's own keys: camera, film and renderer.
#include "render/world.h"
#include "scene/scene.h"
#include "scene/spec_check.h"

#include <stdlib.h>
#include <string.h>

static const Key CAMERA_KEYS[] = {
    {KEY_OF(Camera, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Where the lens is."},
    {KEY_OF(Camera, target, "target", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "The point in the middle of the picture (before shift)."},
    {KEY_OF(Camera, up, "up", KEY_VECTOR), .count = 3,
     .doc = "Direction that is up in the picture; any length."},
    {KEY_OF(Camera, fov, "fov", KEY_FLOAT), .flags = KEY_ABOVE | KEY_BELOW, .high = 180,
     .unit = "degrees", .doc = "Vertical field of view."},
    {KEY_OF(Camera, fov, "focal_length", KEY_FLOAT),
     .flags = KEY_INSTEAD | KEY_NO_DEFAULT | KEY_ABOVE, .high = 10000, .unit = "mm",
     .doc = "Instead of fov: focal length of a lens before a full frame, 24 mm high."},
    {KEY_OF(Camera, aperture, "aperture", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Diameter of the lens; 0 = everything sharp."},
    {KEY_OF(Camera, focus_distance, "focus_distance", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Distance that is sharp; 0 = that of the target."},
    {KEY_OF(Camera, shift_x, "shift", KEY_VECTOR), .count = 2, .low = -10, .high = 10,
     .unit = "image heights",
     .doc = "Lens shift right and up: keeps verticals upright when looking up."},
    {0},
};

static const Table CAMERA_TABLE = {
    .name = "camera",
    .doc = "The camera: where it stands, what it looks at, how wide, and what is sharp.",
    .example =
        "camera: {position: [4, 1.5, 18], target: [0, 5, 0], focal_length: 50, aperture: 0.03}\n",
    .size = sizeof(Camera),
    .keys = CAMERA_KEYS,
    .check = check_camera};

static const EnumName FILTERS[] = {{"blackman_harris", FILTER_BLACKMAN_HARRIS},
                                   {"box", FILTER_BOX},
                                   {"gaussian", FILTER_GAUSSIAN},
                                   {0}};
static const EnumName CURVES[] = {{"filmic", TONE_FILMIC}, {"linear", TONE_LINEAR}, {0}};

static const Key FILM_KEYS[] = {
    {KEY_OF(Scene, film.width, "width", KEY_INT), .low = 1, .high = 65536, .unit = "pixels",
     .doc = "Width of the picture."},
    {KEY_OF(Scene, film.height, "height", KEY_INT), .low = 1, .high = 65536, .unit = "pixels",
     .doc = "Height of the picture."},
    {KEY_OF(Scene, film.filter, "filter", KEY_ENUM), .names = FILTERS,
     .doc = "How samples are gathered into pixels. blackman_harris: sharp without halos; gaussian: "
            "softer; box: each pixel for itself."},
    {KEY_OF(Scene, film.filter_radius, "filter_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 16,
     .unit = "pixels", .doc = "How far the filter reaches."},
    {KEY_OF(Scene, film.crop, "crop", KEY_VECTOR), .count = 4, .high = 1,
     .doc = "Part of the picture to render: x0, y0, x1, y1 from the top left, in 0..1."},
    {KEY_OF(Scene, tone.exposure, "exposure", KEY_FLOAT), .low = -50, .high = 50, .unit = "stops",
     .doc = "Brightness of the developed picture: each stop doubles it."},
    {KEY_OF(Scene, tone.auto_exposure, "auto_exposure", KEY_BOOL),
     .doc = "Expose for the picture's mean brightness (its log-average luminance goes to 0.18); "
            "`exposure` is then added."},
    {KEY_OF(Scene, tone.curve, "curve", KEY_ENUM), .names = CURVES,
     .doc = "Tone curve. filmic: rolls off highlights, as a print does; linear: clips them."},
    {KEY_OF(Scene, tone.contrast, "contrast", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Slope of the filmic curve at middle grey; 1 = as it is."},
    {KEY_OF(Scene, tone.saturation, "saturation", KEY_FLOAT), .high = 10,
     .doc = "Strength of colour: 0 = grey, 1 = as it is."},
    {KEY_OF(Scene, tone.white_balance, "white_balance", KEY_FLOAT), .high = 40000, .unit = "K",
     .doc = "Colour temperature of the light that shall look neutral; 0 or 6500 = no change."},
    {KEY_OF(Scene, tone.bloom, "bloom", KEY_FLOAT), .high = 1,
     .doc = "Share of the light that the lens spreads over its neighbourhood."},
    {KEY_OF(Scene, tone.vignette, "vignette", KEY_FLOAT), .high = 1,
     .doc = "Darkening at the corners."},
    {KEY_OF(Scene, denoise, "denoise", KEY_BOOL),
     .doc = "Remove the noise that is left from the developed picture (never from the EXR)."},
    {0},
};

// A group of the scene itself: two structs make up what a photographer calls the film.
static const Table FILM_TABLE = {.name = "film",
                                 .doc = "The size of the picture and how it is developed.",
                                 .example = "film: {width: 1920, height: 1080, auto_exposure: "
                                            "true, exposure: -0.5, contrast: 1.1, denoise: true}\n",
                                 .size = sizeof(Scene),
                                 .keys = FILM_KEYS,
                                 .check = check_film};

static const Key RENDER_KEYS[] = {
    {KEY_OF(RenderParams, samples, "samples", KEY_INT), .low = 1, .high = 1 << 24,
     .doc = "Paths per pixel: twice as many cost twice the time and leave 0.7 of the noise."},
    {KEY_OF(RenderParams, max_depth, "max_depth", KEY_INT), .low = 1, .high = 10000,
     .doc =
         "Most bounces of a path; 1 = direct light only. Glass and leaves need more than stone."},
    {KEY_OF(RenderParams, roulette_depth, "roulette_depth", KEY_INT), .high = 10000,
     .doc = "Bounces before Russian roulette may end a path early; max_depth = never."},
    {KEY_OF(RenderParams, clamp, "clamp", KEY_FLOAT), .high = 1e9,
     .doc = "Upper bound on the indirect luminance of one path, against fireflies; 0 = none."},
    {KEY_OF(RenderParams, max_noise, "noise", KEY_FLOAT), .flags = KEY_BELOW, .high = 1,
     .doc = "A part of the picture is done when its estimated relative error is below this; 0 = "
            "take all samples everywhere."},
    {KEY_OF(RenderParams, noise_seed, "noise_seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Another number, another pattern of noise; nothing else of the picture changes."},
    {KEY_OF(RenderParams, max_seconds, "seconds", KEY_DOUBLE), .high = 1e8, .unit = "s",
     .doc = "Stop rendering after this time; 0 = no limit."},
    {0},
};

static const Table RENDER_TABLE = {.name = "render",
                                   .doc = "How long and how hard the path tracer works.",
                                   .example =
                                       "render: {samples: 256, max_depth: 12, noise: 0.02}\n",
                                   .size = sizeof(RenderParams),
                                   .keys = RENDER_KEYS};

static const Key TARGET_KEYS[] = {
    {KEY_OF(SceneTarget, object, "object", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the object."},
    {KEY_OF(SceneTarget, measure, "measure", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the measure, as `ramify measure` prints it."},
    {KEY_OF(SceneTarget, low, "low", KEY_DOUBLE),
     .doc = "Least value that meets the target; left out: any."},
    {KEY_OF(SceneTarget, high, "high", KEY_DOUBLE),
     .doc = "Largest value that meets the target; left out: any."},
    {0},
};

static void target_defaults(void *out)
{
    *(SceneTarget *)out = (SceneTarget){.low = -TARGET_NO_BOUND, .high = TARGET_NO_BOUND};
}

static const Table TARGET_TABLE = {
    .name = "target",
    .doc = "A number that the scene is held to: `ramify measure` "
           "says whether it is met, and fails when it is not.",
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
     .doc = "tolerance: alike within the limits below; exact: the same 8-bit values; statistical: "
            "equal but for noise."},
    {KEY_OF(SceneGolden, max_rmse, "max_rmse", KEY_DOUBLE), .high = 1,
     .doc = "tolerance: largest root mean square of the differences of display values, 0..1."},
    {KEY_OF(SceneGolden, threshold, "threshold", KEY_DOUBLE), .high = 1,
     .doc = "tolerance: a pixel fails when a channel differs by more than this."},
    {KEY_OF(SceneGolden, max_failing, "max_failing", KEY_DOUBLE), .high = 1,
     .doc = "tolerance: largest share of pixels that may fail, 0..1."},
    {KEY_OF(SceneGolden, alpha, "alpha", KEY_DOUBLE), .flags = KEY_ABOVE | KEY_BELOW, .high = 1,
     .doc = "statistical: chance of an alarm where nothing but the noise differs."},
    {KEY_OF(SceneGolden, runs, "runs", KEY_INT), .low = 2, .high = 1000,
     .doc = "statistical: how many renderings, each with a seed of its own, stand on either side."},
    {0},
};

SceneGolden scene_golden_default(void)
{
    // Other instruction sets and mathematical libraries move last bits, by which rare paths meet
    // another triangle: measured RMSE up to 0.00026 and 0.016 % of pixels over the threshold.
    return (SceneGolden){
        .max_rmse = 0.0007, .threshold = 0.012, .max_failing = 0.0008, .alpha = 0.01, .runs = 4};
}

static const Table GOLDEN_TABLE = {.name = "golden",
                                   .doc = "How `ramify golden` compares the scene's picture with "
                                          "the stored one.",
                                   .example = "golden: {mode: tolerance, max_failing: 0.002}\n",
                                   .size = sizeof(SceneGolden),
                                   .keys = GOLDEN_KEYS};

static const Key SCENE_KEYS[] = {
    {KEY_OF(Scene, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of everything random: another number, another tree of the same kind."},
    {KEY_OF(Scene, grow_to, "grow_to", KEY_FLOAT), .high = 1,
     .doc = "How much of all growth shows: 0 = nothing has grown yet, 1 = all of it."},
    {KEY_OF(Scene, camera, "camera", KEY_GROUP), .table = &CAMERA_TABLE, .doc = "The camera."},
    {.key = "film",
     .type = KEY_GROUP,
     .table = &FILM_TABLE,
     .doc = "The picture's size and its development."},
    {KEY_OF(Scene, render, "render", KEY_GROUP), .table = &RENDER_TABLE,
     .doc = "How long and how hard the path tracer works."},
    {KEY_OF(Scene, sky, "sky", KEY_GROUP), .table = &sky_table,
     .doc = "What lights the scene from all around."},
    {KEY_OF(Scene, medium, "medium", KEY_POINTER), .table = &medium_table,
     .doc = "Fog, haze or water around everything; left out: clear air."},
    {KEY_OF(Scene, lights, "lights", KEY_LIST), .count_offset = offsetof(Scene, light_count),
     .count = 100000, .table = &light_table, .doc = "Lamps."},
    {KEY_OF(Scene, materials, "materials", KEY_LIST),
     .count_offset = offsetof(Scene, material_count), .count = 10000, .table = &material_table,
     .doc = "Materials that objects name. bark, twig, leaf, ground, grass, fallen, conifer, ice, "
            "rime, soap_film, copper, lightning, coral, coral_polyp, reef_rock, mountain, "
            "badlands, lake, artery, vein, leaf_vein, broken and clay are there already; an entry "
            "of such a name changes it."},
    {KEY_OF(Scene, objects, "objects", KEY_LIST), .count_offset = offsetof(Scene, object_count),
     .flags = KEY_REQUIRED, .low = 1, .count = 10000, .table = &object_table,
     .doc = "What there is to see."},
    {KEY_OF(Scene, targets, "targets", KEY_LIST), .count_offset = offsetof(Scene, target_count),
     .count = 1000, .table = &TARGET_TABLE,
     .doc = "What the scene's measures must be, for `ramify measure`."},
    {KEY_OF(Scene, animation, "animation", KEY_POINTER), .table = &animation_table,
     .doc = "What changes over time, for `ramify turntable`; left out: nothing but the camera."},
    {KEY_OF(Scene, golden, "golden", KEY_GROUP), .table = &GOLDEN_TABLE,
     .doc = "How `ramify golden` compares the picture with the stored one."},
    {0},
};

// The documented defaults are those of the modules themselves.
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
    scene->golden = scene_golden_default();
}

const Table scene_table = {.name = "scene",
                           .doc = "A ramify scene: one file becomes one picture. Metres, degrees, "
                                  "Y up, right-handed, linear Rec. 709 colours.",
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
