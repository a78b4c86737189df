#include "animate/shoot.h"
#include "api/handles.h"

#include <math.h>
#include <string.h>

_Static_assert((int)RAMIFY_MOST_KEYS == (int)TURN_MAX_VALUES, "keys fit");

static bool take_keys(const RamifyKeys *keys, const char *name, TurnValues *values, Error *e)
{
    if (keys->count < 0 || keys->count > RAMIFY_MOST_KEYS) {
        return error_set(e, ERROR_INPUT, "%d keys of %s; there may be 0 to %d", keys->count, name,
                         (int)RAMIFY_MOST_KEYS);
    }
    values->count = keys->count;
    memcpy(values->value, keys->value, sizeof values->value);
    return true;
}

static bool check_choices(const RamifyTurntable *given, Error *e)
{
    if ((unsigned)given->ease > RAMIFY_EASE_SMOOTH || isnan(given->turns)) {
        return error_set(e, ERROR_INPUT,
                         "ease %d and %g turns; ease must be of its list, turns a number",
                         given->ease, given->turns);
    }
    return true;
}

static bool take_params(const RamifyTurntable *given, TurntableParams *params, Error *e)
{
    *params = turntable_params_default();
    params->frames = given->frames;
    params->fps = given->fps;
    params->turns = given->still ? 0.0 : (given->turns != 0.0 ? given->turns : (double)NAN);
    params->spin = given->spin;
    params->ease = given->ease == RAMIFY_EASE_USUAL
                       ? -1
                       : (int)(given->ease == RAMIFY_EASE_SMOOTH ? EASE_SMOOTH : EASE_LINEAR);
    params->vary_noise = given->vary_noise == 0 ? -1 : given->vary_noise > 0;
    return check_choices(given, e) &&
           take_keys(&given->elevation, "elevation", &params->elevation, e) &&
           take_keys(&given->dolly, "dolly", &params->dolly, e) &&
           take_keys(&given->grow, "grow", &params->grow, e) &&
           take_keys(&given->sun, "sun", &params->sun, e);
}

static Turntable *make_turntable(const RamifyScene *scene, const RamifyTurntable *given, Error *e)
{
    static const RamifyTurntable usual;
    TurntableParams params;
    return take_params(given ? given : &usual, &params, e)
               ? turntable_new(scene_of(scene), &params, e)
               : NULL;
}

// The scene at a frame; if frame is negative, at `time`.
static Scene *scene_then(const RamifyScene *scene, const RamifyTurntable *given, int frame,
                         double time, Error *e)
{
    Turntable *turntable = make_turntable(scene, given, e);
    Scene *then = NULL;
    if (turntable && frame >= turntable_frames(turntable)) {
        error_set(e, ERROR_INPUT, "no frame %d; there are %d, counted from 0", frame,
                  turntable_frames(turntable));
    } else if (turntable) {
        then = frame >= 0 ? turntable_scene(turntable, frame, e)
                          : turntable_scene_at(turntable, time, e);
    }
    turntable_free(turntable);
    return then;
}

RamifyScene *ramify_scene_at(const RamifyScene *scene, const RamifyTurntable *turntable,
                             double time, RamifyError *error)
{
    Error e = {0};
    Scene *then = NULL;
    if (time >= 0.0 && time <= 1.0) {
        then = scene_then(scene, turntable, -1, time, &e);
    } else {
        error_set(&e, ERROR_INPUT, "time %g; it must lie in 0 to 1", time);
    }
    if (!then) {
        api_fail(error, &e);
    }
    return (RamifyScene *)(void *)then;
}

RamifyScene *ramify_scene_at_frame(const RamifyScene *scene, const RamifyTurntable *turntable,
                                   int frame, RamifyError *error)
{
    Error e = {0};
    Scene *then = NULL;
    if (frame >= 0) {
        then = scene_then(scene, turntable, frame, 0.0, &e);
    } else {
        error_set(&e, ERROR_INPUT, "frame %d; they are counted from 0", frame);
    }
    if (!then) {
        api_fail(error, &e);
    }
    return (RamifyScene *)(void *)then;
}

static void hand_info(const ShootStats *stats, RamifyTurntableInfo *info)
{
    const StageStats *stage = &stats->stage;
    *info = (RamifyTurntableInfo){.frames = stats->frames,
                                  .rendered = stats->rendered,
                                  .skipped = stats->skipped,
                                  .geometries = stage->geometries,
                                  .structures = stage->structures,
                                  .paths = stats->paths,
                                  .prepare_seconds = stats->prepare_seconds,
                                  .grow_seconds = stage->build.grow_seconds,
                                  .mesh_seconds = stage->build.mesh_seconds,
                                  .build_seconds = stage->build_seconds,
                                  .trace_seconds = stats->trace_seconds,
                                  .finish_seconds = stats->finish_seconds,
                                  .video_seconds = stats->video_seconds};
}

// Converts the last frame to render; -1 = the last of all.
static bool take_end(const RamifyTurntable *given, int *end, Error *e)
{
    if (given->count < 0 || given->start < 0) {
        return error_set(e, ERROR_INPUT, "%d frames from frame %d; neither may be negative",
                         given->count, given->start);
    }
    int64_t last = (int64_t)given->start + given->count - 1;
    *end = given->count == 0 ? -1 : (int)(last > INT32_MAX ? INT32_MAX : last);
    return true;
}

bool ramify_turntable(const RamifyScene *scene, const RamifyTurntable *turntable, const char *file,
                      const RamifyRun *run, RamifyTurntableInfo *info, RamifyError *error)
{
    static const RamifyTurntable usual;
    const RamifyTurntable *given = turntable ? turntable : &usual;
    Error e = {0};
    Run own = api_run(run);
    ShootStats stats = {0};
    ShootParams params = {.output = file, .start = given->start, .isa = given->isa};
    bool done = take_end(given, &params.end, &e) && take_params(given, &params.turntable, &e) &&
                shoot(scene_of(scene), &params, &own, &stats, &e);
    if (info) {
        hand_info(&stats, info);
    }
    return done || api_fail(error, &e);
}

bool ramify_turntable_check(const char *file, RamifyError *error)
{
    Error e = {0};
    return shoot_check_output(file, &e) || api_fail(error, &e);
}
