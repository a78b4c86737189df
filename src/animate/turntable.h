// The content of each frame: a camera that orbits its target (or a table that turns under it),
// growth, the sun's course, and the tracks of the scene's `animation:`. A frame is an ordinary
// Scene, made by changes to the scene's values, so all checks apply, and the settings stored in its
// picture render it again as a still.
#ifndef RAMIFY_ANIMATE_TURNTABLE_H
#define RAMIFY_ANIMATE_TURNTABLE_H

#include "scene/scene.h"

enum { TURN_MAX_VALUES = 16, TURN_DEFAULT_FRAMES = 72, TURN_DEFAULT_FPS = 24 };

// Values at equal steps of time. If the last equals the first, frame i of N shows the time i/N, so
// that the animation loops without a jump; else i/(N-1), so that the last frame shows the last
// value.
typedef struct TurnValues {
    double value[TURN_MAX_VALUES];
    int count; // 0 = none: the scene's own
} TurnValues;

typedef struct TurntableParams {
    int frames;   // 0 = that of the scene's animation, else TURN_DEFAULT_FRAMES
    double fps;   // 0 = likewise
    double turns; // full circles, from +Z toward +X; negative: the other direction. NAN = 1, but 0
                  // if the scene has an animation
    bool spin;    // rotates the objects instead of camera, sky and lamps
    TurnValues elevation; // degrees of the camera above its target, within -89 .. 89
    TurnValues dolly;     // factor on the camera's distance from its target, > 0
    TurnValues grow;      // grow_to, 0..1
    TurnValues sun;       // solar time, hours: see sun_place
    int ease;             // an Ease: EASE_LINEAR or EASE_SMOOTH; negative: smooth for elevation and
                          // dolly, linear for the rest
    int vary_noise;       // 1 yes, 0 no, negative: the scene's animation decides
} TurntableParams;

TurntableParams turntable_params_default(void);

typedef struct Turntable Turntable;

// scene: borrowed. ERROR_INPUT names the parameter that is wrong.
Turntable *turntable_new(const Scene *scene, const TurntableParams *params, Error *e);
void turntable_free(Turntable *turntable); // NULL is fine

int turntable_frames(const Turntable *turntable);
double turntable_fps(const Turntable *turntable);

// The scene at frame number `frame` (0 .. frames - 1), owned by the caller. ERROR_INPUT names
// frame, file and line of an invalid track.
Scene *turntable_scene(const Turntable *turntable, int frame, Error *e);

// Checks that the tracks refer to existing values of the scene, at the first frame only. True
// without an animation.
bool turntable_check_tracks(const Scene *scene, Error *e);

// The scene at a time, 0 .. 1, on or between frames; owned by the caller.
Scene *turntable_scene_at(const Turntable *turntable, double time, Error *e);

// Whether frames have automatic exposure (film.auto_exposure), which would flicker.
bool turntable_exposes_itself(const Turntable *turntable);

// Replaces the automatic exposure of all frames by this many stops.
void turntable_lock_exposure(Turntable *turntable, double stops);

// Position of the sun at 48 degrees north in mid-May, at a solar time in hours (12 = noon). South
// is +Z and east +X, so noon has azimuth 0. Degrees.
void sun_place(double hour, double *elevation, double *azimuth);

#endif
