#include "animate/turntable.h"

#include "animate/keys.h"
#include "animate/timeline.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "render/light/light.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define DEGREES (3.14159265358979323846 / 180.0)
#define HIGHEST_ELEVATION 89.0
#define LATITUDE 48.0
#define DECLINATION 18.5   // of the sun in mid-May, degrees
#define LOWEST_SUN (-10.0) // lower limit of the sky model

struct Turntable {
    const Scene *scene;
    TurntableParams params; // all defaults resolved
    Timeline *timeline;
    bool loop; // of the tracks
    bool locked;
    double stops;
};

// Frame time for looping and for non-looping values.
typedef struct Moment {
    double round; // i/N
    double open;  // i/(N-1)
    int frame;    // -1 = between frames
} Moment;

static const SceneChange TURNING = {.source = "the turntable"};

TurntableParams turntable_params_default(void)
{
    return (TurntableParams){.turns = (double)NAN, .ease = -1, .vary_noise = -1};
}

// ---- checks

static bool check_values(const TurnValues *values, const char *name, double low, double high,
                         Error *e)
{
    for (int i = 0; i < values->count; i++) {
        if (!(values->value[i] >= low && values->value[i] <= high)) {
            return error_set(e, ERROR_INPUT, "%s has %g; its values must lie in %g to %g", name,
                             values->value[i], low, high);
        }
    }
    return true;
}

static bool check_params(const TurntableParams *p, const Scene *scene, Error *e)
{
    if (p->frames < 1 || p->frames > 1000000) {
        return error_set(e, ERROR_INPUT, "%d frames; there must be 1 to 1000000", p->frames);
    }
    if (!(p->fps > 0.0 && p->fps <= 1000.0)) {
        return error_set(e, ERROR_INPUT,
                         "%g frames a second; it must be greater than 0 and at most 1000", p->fps);
    }
    if (!(fabs(p->turns) <= 1000.0)) {
        return error_set(e, ERROR_INPUT, "%g turns; it must be -1000 to 1000", p->turns);
    }
    if (p->ease > (int)EASE_SMOOTH) {
        return error_set(e, ERROR_INPUT, "a turntable eases linear or smooth");
    }
    if (p->sun.count > 0 && scene->sky.kind != SKY_SUN_SKY) {
        return error_set(e, ERROR_INPUT,
                         "sun is given, but the scene's sky has no sun; its kind must be sun_sky");
    }
    return check_values(&p->elevation, "elevation", -HIGHEST_ELEVATION, HIGHEST_ELEVATION, e) &&
           check_values(&p->dolly, "dolly", 1e-3, 1e3, e) &&
           check_values(&p->grow, "grow", 0.0, 1.0, e) &&
           check_values(&p->sun, "sun", 0.0, 24.0, e);
}

static TurntableParams complete(const TurntableParams *given, const SceneAnimation *animation)
{
    TurntableParams p = *given;
    if (p.frames == 0) {
        p.frames = animation ? animation->frames : TURN_DEFAULT_FRAMES;
    }
    if (p.fps == 0.0) {
        p.fps = animation ? animation->fps : TURN_DEFAULT_FPS;
    }
    if (isnan(p.turns)) {
        p.turns = animation && !p.spin ? 0.0 : 1.0;
    }
    if (p.vary_noise < 0) {
        p.vary_noise = animation && animation->vary_noise;
    }
    return p;
}

// ---- creation

Turntable *turntable_new(const Scene *scene, const TurntableParams *params, Error *e)
{
    const SceneAnimation *animation = scene->animation;
    TurntableParams full = complete(params, animation);
    if (!check_params(&full, scene, e)) {
        return NULL;
    }
    Turntable *t = memory_alloc_zero(1, sizeof *t, e);
    if (!t) {
        return NULL;
    }
    *t = (Turntable){.scene = scene, .params = full, .loop = animation && animation->loop};
    CLocale locale;
    if (c_locale_enter(&locale, e)) {
        t->timeline = timeline_new(animation, e);
        c_locale_leave(&locale);
    }
    if (!t->timeline) {
        turntable_free(t);
        return NULL;
    }
    return t;
}

void turntable_free(Turntable *turntable)
{
    if (turntable) {
        timeline_free(turntable->timeline);
        free(turntable);
    }
}

int turntable_frames(const Turntable *turntable)
{
    return turntable->params.frames;
}

double turntable_fps(const Turntable *turntable)
{
    return turntable->params.fps;
}

bool turntable_exposes_itself(const Turntable *turntable)
{
    return turntable->scene->tone.auto_exposure && !turntable->locked;
}

void turntable_lock_exposure(Turntable *turntable, double stops)
{
    turntable->locked = true;
    turntable->stops = stops;
}

// ---- values

void sun_place(double hour, double *elevation, double *azimuth)
{
    double angle = 15.0 * (hour - 12.0) * DEGREES;
    double sl = sin(LATITUDE * DEGREES), cl = cos(LATITUDE * DEGREES);
    double sd = sin(DECLINATION * DEGREES), cd = cos(DECLINATION * DEGREES);
    double up = sl * sd + cl * cd * cos(angle);
    double south = sl * cd * cos(angle) - cl * sd, east = -cd * sin(angle);
    *elevation = asin(fmax(-1.0, fmin(1.0, up))) / DEGREES;
    *azimuth = atan2(east, south) / DEGREES;
}

static Ease ease_of(const Turntable *t, Ease by_default)
{
    return t->params.ease < 0 ? by_default : (Ease)t->params.ease;
}

// `fallback` if there are no values.
static double value_at(const Turntable *t, const TurnValues *values, const Moment *now,
                       Ease by_default, double fallback)
{
    if (values->count < 2) {
        return values->count ? values->value[0] : fallback;
    }
    int last = values->count - 1;
    bool closed = values->value[0] == values->value[last];
    double place = (closed ? now->round : now->open) * last;
    int i = (int)place < last ? (int)place : last - 1;
    return ease_between(ease_of(t, by_default), values->value[i], values->value[i + 1],
                        place - (double)i);
}

static double turn_at(const Turntable *t, const Moment *now)
{
    return 360.0 * t->params.turns * ease_between(ease_of(t, EASE_LINEAR), 0.0, 1.0, now->round);
}

static bool add_one(Changes *changes, const char *path, double value, Error *e)
{
    SceneChange change = TURNING;
    change.path = path;
    return changes_add_numbers(changes, &change, &value, 1, e);
}

static bool add_vector(Changes *changes, const char *path, const double v[3], Error *e)
{
    SceneChange change = TURNING;
    change.path = path;
    return changes_add_numbers(changes, &change, v, 3, e);
}

// Adds all changes that do not depend on the positions of the scene's camera and lamps.
static bool add_values(const Turntable *t, const Moment *now, Changes *changes, Error *e)
{
    const TurntableParams *p = &t->params;
    if (!timeline_add(t->timeline, t->loop ? now->round : now->open, changes, e)) {
        return false;
    }
    if (p->grow.count > 0 &&
        !add_one(changes, "grow_to", value_at(t, &p->grow, now, EASE_LINEAR, 1.0), e)) {
        return false;
    }
    if (p->vary_noise && now->frame >= 0 &&
        !add_one(changes, "render.noise_seed", (double)now->frame + 1.0, e)) {
        return false;
    }
    if (p->sun.count == 0) {
        return true;
    }
    double elevation, azimuth;
    sun_place(value_at(t, &p->sun, now, EASE_LINEAR, 12.0), &elevation, &azimuth);
    return add_one(changes, "sky.sun_elevation", fmax(elevation, LOWEST_SUN), e) &&
           add_one(changes, "sky.sun_azimuth", azimuth, e);
}

// ---- rotation

typedef struct Turn {
    double center[3]; // a point of the axis
    double sine, cosine;
} Turn;

static void turn_vector(const Turn *turn, Vec3 v, double out[3])
{
    out[0] = (double)v.x * turn->cosine + (double)v.z * turn->sine;
    out[1] = (double)v.y;
    out[2] = (double)v.z * turn->cosine - (double)v.x * turn->sine;
}

static void turn_point(const Turn *turn, Vec3 p, double out[3])
{
    Vec3 center = vec3((float)turn->center[0], (float)turn->center[1], (float)turn->center[2]);
    turn_vector(turn, vec3_sub(p, center), out);
    for (int i = 0; i < 3; i++) {
        out[i] += turn->center[i];
    }
}

// Moves the camera to the new elevation and distance, then rotates it about the vertical through
// its target.
static bool add_camera(const Turntable *t, const Moment *now, const Scene *scene, const Turn *turn,
                       Changes *changes, Error *e)
{
    const Camera *camera = &scene->camera;
    Vec3 offset = vec3_sub(camera->position, camera->target);
    double x = (double)offset.x, y = (double)offset.y, z = (double)offset.z;
    double level = hypot(x, z), distance = hypot(level, y), azimuth = atan2(x, z);
    double elevation =
        value_at(t, &t->params.elevation, now, EASE_SMOOTH, atan2(y, level) / DEGREES);
    distance *= value_at(t, &t->params.dolly, now, EASE_SMOOTH, 1.0);
    azimuth += atan2(turn->sine, turn->cosine);
    double reach = distance * cos(elevation * DEGREES), up[3];
    double position[3] = {turn->center[0] + reach * sin(azimuth),
                          turn->center[1] + distance * sin(elevation * DEGREES),
                          turn->center[2] + reach * cos(azimuth)};
    turn_vector(turn, camera->up, up);
    return add_vector(changes, "camera.position", position, e) &&
           add_vector(changes, "camera.up", up, e);
}

static bool add_lamp(const Light *light, int index, const Turn *turn, Changes *changes, Error *e)
{
    char path[3][64];
    double v[3][3];
    int count = light->kind == LIGHT_SPHERE ? 1 : 3;
    static const char *const keys[2][3] = {{"center"}, {"corner", "edge_u", "edge_v"}};
    if (light->kind == LIGHT_SPHERE) {
        turn_point(turn, light->center, v[0]);
    } else {
        turn_point(turn, light->corner, v[0]);
        turn_vector(turn, light->edge_u, v[1]);
        turn_vector(turn, light->edge_v, v[2]);
    }
    for (int i = 0; i < count; i++) {
        snprintf(path[i], sizeof path[i], "lights.%d.%s", index, keys[count > 1][i]);
        if (!add_vector(changes, path[i], v[i], e)) {
            return false;
        }
    }
    return true;
}

// The table turns one way; instead, camera, sky and lamps turn the other way, so that the geometry
// stays unchanged.
static bool add_surroundings(const Scene *scene, const Turn *turn, double degrees, Changes *changes,
                             Error *e)
{
    for (int i = 0; i < scene->light_count; i++) {
        if (!add_lamp(&scene->lights[i], i, turn, changes, e)) {
            return false;
        }
    }
    SkyKind kind = scene->sky.kind;
    bool same_all_around = kind == SKY_NONE || kind == SKY_CONSTANT;
    return same_all_around ||
           add_one(changes, "sky.rotation", fmod((double)scene->sky.rotation + degrees, 360.0), e);
}

static bool add_turn(const Turntable *t, const Moment *now, const Scene *scene, Changes *changes,
                     Error *e)
{
    const TurntableParams *p = &t->params;
    double degrees = fmod(turn_at(t, now), 360.0);
    const Vec3 *target = &scene->camera.target;
    Turn turn = {{(double)target->x, (double)target->y, (double)target->z},
                 sin(degrees * DEGREES),
                 cos(degrees * DEGREES)};
    bool moves = degrees != 0.0 || p->elevation.count > 0 || p->dolly.count > 0;
    if (t->locked &&
        !(add_one(changes, "film.exposure", (double)scene->tone.exposure + t->stops, e) &&
          changes_add(changes,
                      &(SceneChange){
                          .path = "film.auto_exposure", .value = "false", .source = TURNING.source},
                      e))) {
        return false;
    }
    return (!moves || add_camera(t, now, scene, &turn, changes, e)) &&
           (!p->spin || degrees == 0.0 || add_surroundings(scene, &turn, degrees, changes, e));
}

static Scene *make_scene(const Turntable *t, const Moment *now, Changes *changes, Error *e)
{
    if (!add_values(t, now, changes, e)) {
        return NULL;
    }
    Scene *scene = NULL;
    if (changes->count > 0 &&
        !(scene = scene_changed(t->scene, changes->item, (int)changes->count, e))) {
        return NULL;
    }
    int64_t values = changes->count;
    bool done = add_turn(t, now, scene ? scene : t->scene, changes, e);
    if (done && scene && changes->count == values) {
        return scene;
    }
    scene_free(scene);
    return done ? scene_changed(t->scene, changes->item, (int)changes->count, e) : NULL;
}

static Scene *scene_at(const Turntable *t, const Moment *now, Error *e)
{
    Changes changes = {0};
    Scene *scene = NULL;
    CLocale locale;
    if (c_locale_enter(&locale, e)) {
        scene = make_scene(t, now, &changes, e);
        c_locale_leave(&locale);
    }
    changes_clear(&changes);
    return scene;
}

Scene *turntable_scene(const Turntable *turntable, int frame, Error *e)
{
    int frames = turntable->params.frames;
    Moment now = {frame_time(frame, frames, true), frame_time(frame, frames, false), frame};
    Scene *scene = scene_at(turntable, &now, e);
    if (!scene && e && e->code == ERROR_INPUT) {
        error_prefix(e, "frame %d: ", frame);
    }
    return scene;
}

Scene *turntable_scene_at(const Turntable *turntable, double time, Error *e)
{
    Scene *scene = scene_at(turntable, &(Moment){time, time, -1}, e);
    if (!scene && e && e->code == ERROR_INPUT) {
        error_prefix(e, "at %g: ", time);
    }
    return scene;
}

bool turntable_check_tracks(const Scene *scene, Error *e)
{
    if (!scene->animation || scene->animation->track_count == 0) {
        return true;
    }
    TurntableParams params = turntable_params_default();
    Turntable *turntable = turntable_new(scene, &params, e);
    Scene *first = turntable ? turntable_scene(turntable, 0, e) : NULL;
    bool done = first;
    scene_free(first);
    turntable_free(turntable);
    return done;
}
