// What each frame of a film shows: a camera that orbits its target (or a table that turns under
// it), growth, the sun's day, and the tracks of the scene's `animation:`. A frame is a Scene like
// any other: everything goes through changes to the scene's values, so every check of the schema
// holds and a frame's settings, which its picture carries, render it again as a still.
#ifndef RAMIFY_ANIMATE_TURNTABLE_H
#define RAMIFY_ANIMATE_TURNTABLE_H

#include "scene/scene.h"

enum { TURN_MOST_VALUES = 16, TURN_DEFAULT_FRAMES = 72, TURN_DEFAULT_FPS = 24 };

// Values at even steps of time. When the last is the first, frame i of N shows the time i/N, so
// that the film loops without a jump; else i/(N-1), so that the last frame shows the last value.
typedef struct TurnValues {
    double value[TURN_MOST_VALUES];
    int count; // 0 = none: as the scene has it
} TurnValues;

typedef struct TurntableParams {
    int frames;   // 0 = those of the scene's animation, else TURN_DEFAULT_FRAMES
    double fps;   // 0 likewise
    double turns; // full circles, from +Z toward +X; negative: the other way. NAN = 1, but 0
                  // where the scene has an animation
    bool spin;    // everything but camera, sky and lamps turns, instead of the camera
    TurnValues elevation; // degrees of the camera above its target, within -89 .. 89
    TurnValues dolly;     // factor on the camera's distance to its target, > 0
    TurnValues grow;      // grow_to, 0..1
    TurnValues sun;       // solar time, hours: see sun_place
    int ease;             // an Ease: EASE_LINEAR or EASE_SMOOTH; negative: smooth for elevation and
                          // dolly, linear for the rest
    int vary_noise;       // 1 yes, 0 no, negative: as the scene's animation says
} TurntableParams;

TurntableParams turntable_params_default(void);

typedef struct Turntable Turntable;

// scene: borrowed. ERROR_INPUT names the option that is wrong.
Turntable *turntable_new(const Scene *scene, const TurntableParams *params, Error *e);
void turntable_free(Turntable *turntable); // NULL is fine

int turntable_frames(const Turntable *turntable);
double turntable_fps(const Turntable *turntable);

// The scene as frame number `frame` (0 .. frames - 1) shows it. ERROR_INPUT names frame, file and
// line of the track that asks for what cannot be.
Scene *turntable_scene(const Turntable *turntable, int frame, Error *e);

// Do the tracks of the scene name values that it has? Looks at the first frame only. True where
// there is no animation.
bool turntable_check_tracks(const Scene *scene, Error *e);

// The scene at a time, 0 .. 1, between frames or on one.
Scene *turntable_scene_at(const Turntable *turntable, double time, Error *e);

// Do frames expose themselves (film.auto_exposure)? Frames by themselves would flicker.
bool turntable_exposes_itself(const Turntable *turntable);

// From now on no frame exposes itself; all are brightened by this many stops instead.
void turntable_lock_exposure(Turntable *turntable, double stops);

// Where the sun stands in the sky of a place at 48 degrees north on a day in mid-May, at a solar
// time in hours (12 = noon). South is +Z and east +X, so noon has azimuth 0. Degrees.
void sun_place(double hour, double *elevation, double *azimuth);

#endif
