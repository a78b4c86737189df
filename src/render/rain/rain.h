// Showers of rain: shafts of falling drops below clouds, with the rainbow that drops make.
#ifndef RAMIFY_RENDER_RAIN_RAIN_H
#define RAMIFY_RENDER_RAIN_RAIN_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Shower {
    float center_x, center_z; // m: of the shaft where it leaves the cloud
    float radius;             // m
    float base;               // m: altitude of the cloud's underside
    float bottom;             // m: altitude at which the last drops evaporate
    float rate;               // mm/h, in the middle
    float wind;               // degrees from +Z toward +X: where the drops drift to
    float lean;               // degrees from the vertical
    float streaks;            // 0 = even, 1 = in shafts and veils
    float ragged;             // 0 = a round shaft, 1 = a frayed edge that dries up as it falls
    int seed;                 // of this shower beside the scene's
} Shower;

enum { RAIN_MOST_SHOWERS = 16 }; // of a scene

Shower shower_default(void);

// A shower with what follows from it.
typedef struct RainShaft {
    Shower shower;
    Vec3 drift; // m by the metre of fall, horizontal
    float extinction;
    uint64_t key;
} RainShaft;

RainShaft rain_shaft(const Shower *shower, uint64_t seed);

// 1/m: what drops hold back, without the half of it that they bend by less than a tenth of a degree
// (diffraction).
float rain_extinction(const RainShaft *shaft, Vec3 p);

// The part of a ray with unit direction where there may be rain, before `far`. False if none.
bool rain_segment(const RainShaft *shaft, Vec3 origin, Vec3 direction, float far, float *from,
                  float *to);

#endif
