// Sampling of lamps: quads, which emit to one side, and spheres.
#ifndef RAMIFY_RENDER_LIGHT_LAMP_H
#define RAMIFY_RENDER_LIGHT_LAMP_H

#include "render/light/light.h"
#include "render/light/lights.h"

// Power that reaches the scene, over pi^2 R^2 for a scene of radius R.
float lamp_power(const Light *light, float scene_radius);

// Its flux, and a box around it; as if it emitted all around.
LightBounds lamp_bounds(const Light *light);

// Samples light toward `point` from a position drawn with two uniform numbers; pdf per steradian.
// False if it emits none in that direction.
bool lamp_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample);

// The density with which lamp_sample would have drawn this direction from origin, along which the
// lamp is hit after `distance` m; 0 on the dark side of a quad.
float lamp_density(const Light *light, Vec3 origin, Vec3 direction, float distance);

// The position on a quad drawn with the same numbers; the centre of a sphere.
Vec3 lamp_pivot(const Light *light, const float u[2]);

#endif
