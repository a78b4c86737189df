#include "animate/shoot.h"
#include "api/handles.h"
#include "base/save_clock.h"

#include <math.h>
#include <string.h>

_Static_assert((int)RAMIFY_MOST_KEYS == (int)TURN_MAX_VALUES, "keys fit");

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
    const struct {
        const RamifyKeys *from;
        TurnValues *to;
        const char *name;
    } keys[] = {{&given->elevation, &params->elevation, "elevation"},
                {&given->dolly, &params->dolly, "dolly"},
                {&given->grow, &params->grow, "grow"},
                {&given->sun, &params->sun, "sun"}};
    bool valid =
        ((unsigned)given->ease <= RAMIFY_EASE_SMOOTH && !isnan(given->turns)) ||
        error_set(e, ERROR_INPUT, "ease %d and %g turns; ease must be of its list, turns a number",
                  given->ease, given->turns);
    for (size_t i = 0; valid && i < sizeof keys / sizeof keys[0]; i++) {
        int count = keys[i].from->count;
        valid = (count >= 0 && count <= RAMIFY_MOST_KEYS) ||
                error_set(e, ERROR_INPUT, "%d keys of %s; there may be 0 to %d", count,
                          keys[i].name, (int)RAMIFY_MOST_KEYS);
        keys[i].to->count = count;
        memcpy(keys[i].to->value, keys[i].from->value, sizeof keys[i].to->value);
    }
    return valid;
}

// The scene at a frame, or at `time` if frame is NULL.
static RamifyScene *scene_then(const RamifyScene *scene, const RamifyTurntable *given,
                               const int *frame, double time, RamifyError *error)
{
    static const RamifyTurntable usual;
    Error e = {0};
    TurntableParams params;
    Turntable *turntable = NULL;
    Scene *then = NULL;
    if (frame && *frame < 0) {
        error_set(&e, ERROR_INPUT, "frame %d; they are counted from 0", *frame);
    } else if (!frame && !(time >= 0.0 && time <= 1.0)) {
        error_set(&e, ERROR_INPUT, "time %g; it must lie in 0 to 1", time);
    } else if (take_params(given ? given : &usual, &params, &e)) {
        turntable = turntable_new(scene_of(scene), &params, &e);
    }
    if (turntable && frame && *frame >= turntable_frames(turntable)) {
        error_set(&e, ERROR_INPUT, "no frame %d; there are %d, counted from 0", *frame,
                  turntable_frames(turntable));
    } else if (turntable) {
        then = frame ? turntable_scene(turntable, *frame, &e)
                     : turntable_scene_at(turntable, time, &e);
    }
    turntable_free(turntable);
    if (!then) {
        api_fail(error, &e);
    }
    return (RamifyScene *)(void *)then;
}

RamifyScene *ramify_scene_at(const RamifyScene *scene, const RamifyTurntable *turntable,
                             double time, RamifyError *error)
{
    return scene_then(scene, turntable, NULL, time, error);
}

RamifyScene *ramify_scene_at_frame(const RamifyScene *scene, const RamifyTurntable *turntable,
                                   int frame, RamifyError *error)
{
    return scene_then(scene, turntable, &frame, 0.0, error);
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
    params.checkpoint = given->checkpoint == 0.0 ? SAVE_CLOCK_USUAL : fmax(given->checkpoint, 0.0);
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
