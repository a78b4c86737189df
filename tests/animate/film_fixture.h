// Small scenes to be filmed in tests.
#ifndef RAMIFY_TESTS_ANIMATE_FILM_FIXTURE_H
#define RAMIFY_TESTS_ANIMATE_FILM_FIXTURE_H

#include "testing.h"

#include "animate/turntable.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FILM_WIDTH = 32, FILM_HEIGHT = 24 };

#define BALL           \
    "objects:\n"       \
    "  - name: ball\n" \
    "    shape: {envelope: [{shape: box, size: [0.5, 1, 0.2], position: [1, 1, 0]}]}\n"

#define ASSERT_CLOSE(value, wanted, tolerance)               \
    do {                                                     \
        double v_ = (double)(value), w_ = (double)(wanted);  \
        if (!(fabs(v_ - w_) <= (tolerance))) {               \
            fail_msg("%s = %.9g, not %.9g", #value, v_, w_); \
        }                                                    \
    } while (0)

// Five lines, then `middle`, then `objects`.
static inline Scene *read_scene(const char *middle, const char *objects)
{
    static const char head[] = "seed: 3\n"
                               "camera: {position: [1, 3, 6], target: [0.5, 1, 0], fov: 40}\n"
                               "film: {width: 32, height: 24}\n"
                               "render: {samples: 4, max_depth: 3}\n\n";
    char text[8192];
    Error e = {0};
    snprintf(text, sizeof text, "%s%s%s", head, middle, objects);
    Scene *scene = scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    if (!scene) {
        fail_msg("%s in\n%s", e.message, text);
    }
    return scene;
}

static inline Turntable *make_turntable(const Scene *scene, const TurntableParams *params)
{
    Error e = {0};
    Turntable *turntable = turntable_new(scene, params, &e);
    if (!turntable) {
        fail_msg("%s", e.message);
    }
    return turntable;
}

static inline Scene *frame_of(const Turntable *turntable, int frame)
{
    Error e = {0};
    Scene *scene = turntable_scene(turntable, frame, &e);
    if (!scene) {
        fail_msg("%s", e.message);
    }
    return scene;
}

#endif
