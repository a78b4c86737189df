// The description of a lamp: a quad or a ball.
#ifndef RAMIFY_RENDER_LIGHT_LIGHT_H
#define RAMIFY_RENDER_LIGHT_LIGHT_H

#include "base/vec.h"

typedef enum LightKind { LIGHT_QUAD, LIGHT_SPHERE } LightKind;

typedef struct Light {
    LightKind kind;
    Vec3 radiance; // W / (m^2 sr), per channel
    Vec3 center;   // LIGHT_SPHERE
    float radius;
    Vec3 corner, edge_u, edge_v; // LIGHT_QUAD: emits on the side of edge_u x edge_v
} Light;

#endif
