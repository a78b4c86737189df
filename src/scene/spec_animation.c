// Keys of the animation.
#include "scene/scene.h"
#include "scene/spec_check.h"

static const EnumName EASES[] = {{"linear", EASE_LINEAR},
                                 {"smooth", EASE_SMOOTH},
                                 {"step", EASE_STEP},
                                 {"spline", EASE_SPLINE},
                                 {0}};

static const Key KEY_KEYS[] = {
    {KEY_OF(SceneKey, at, "at", KEY_DOUBLE), .flags = KEY_REQUIRED, .high = 1,
     .doc = "Time: 0 = start of the animation, 1 = its end."},
    {KEY_OF(SceneKey, value, "value", KEY_ANY), .count_offset = offsetof(SceneKey, quoted),
     .flags = KEY_REQUIRED, .count = SCENE_KEY_MOST_NUMBERS,
     .doc = "Value at that time: a number, a list of numbers, a colour or a word."},
    {0},
};

static const Table KEY_TABLE = {.name = "key",
                                .doc = "A keyframe: the value at one time.",
                                .size = sizeof(SceneKey),
                                .keys = KEY_KEYS};

static const Key TRACK_KEYS[] = {
    {KEY_OF(SceneTrack, path, "path", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Path of the animated value, as for an override: camera.position, sky.sun_elevation, "
            "objects.oak.tree.height."},
    {KEY_OF(SceneTrack, ease, "ease", KEY_ENUM), .names = EASES,
     .doc = "Interpolation between keys. linear: constant speed; smooth: slow at every key; step: "
            "holds the value until the next key; spline: smooth curve through all keys, without "
            "overshoot. Words always step."},
    {KEY_OF(SceneTrack, keys, "keys", KEY_LIST), .flags = KEY_REQUIRED,
     .count_offset = offsetof(SceneTrack, key_count), .low = 1, .count = 10000, .table = &KEY_TABLE,
     .doc = "Keyframes, in order of time."},
    {0},
};

static void track_defaults(void *out)
{
    *(SceneTrack *)out = (SceneTrack){.ease = EASE_LINEAR};
}

static const Table TRACK_TABLE = {.name = "track",
                                  .doc = "Animation of one value of the scene.",
                                  .size = sizeof(SceneTrack),
                                  .keys = TRACK_KEYS,
                                  .defaults = track_defaults,
                                  .check = check_track};

static const Key ANIMATION_KEYS[] = {
    {KEY_OF(SceneAnimation, frames, "frames", KEY_INT), .low = 1, .high = 1000000,
     .doc = "Number of frames."},
    {KEY_OF(SceneAnimation, fps, "fps", KEY_DOUBLE), .flags = KEY_ABOVE, .high = 1000,
     .unit = "frames a second", .doc = "Frame rate."},
    {KEY_OF(SceneAnimation, loop, "loop", KEY_BOOL),
     .doc = "Loop from the last frame to the first: frame i of N shows the time i/N, and values "
            "run from their last key on to their first. If false, frame i shows the time i/(N-1), "
            "and values are constant before their first key and after their last."},
    {KEY_OF(SceneAnimation, vary_noise, "vary_noise", KEY_BOOL),
     .doc = "Change the noise pattern in every frame, like film grain; if false, parts that do not "
            "move stay identical."},
    {KEY_OF(SceneAnimation, tracks, "tracks", KEY_LIST),
     .count_offset = offsetof(SceneAnimation, track_count), .count = 1000, .table = &TRACK_TABLE,
     .doc = "Tracks, one for each animated value."},
    {0},
};

static void animation_defaults(void *out)
{
    *(SceneAnimation *)out = (SceneAnimation){.frames = 72, .fps = 24.0, .loop = true};
}

const Table animation_table = {
    .name = "animation",
    .doc = "Animation of the scene: frames, speed and tracks.",
    .example =
        "objects:\n"
        "  - name: oak\n"
        "    tree: {}\n"
        "animation:\n"
        "  frames: 120\n"
        "  tracks:\n"
        "    - {path: sky.sun_elevation, keys: [{at: 0, value: 2}, {at: 0.5, value: 30}]}\n"
        "    - {path: grow_to, ease: smooth, keys: [{at: 0, value: 0.1}, {at: 0.9, value: 1}]}\n",
    .size = sizeof(SceneAnimation),
    .keys = ANIMATION_KEYS,
    .defaults = animation_defaults};
