// A lamp of the scene, a quad that shines to one side or a ball: light drawn from it and met by
// chance.
#ifndef RAMIFY_RENDER_LIGHT_LAMP_H
#define RAMIFY_RENDER_LIGHT_LAMP_H

#include "render/light/light.h"
#include "render/light/lights.h"

// Power that reaches the scene, over pi^2 R^2 for a scene of radius R.
float lamp_power(const Light *light, float scene_radius);

// Light toward `point` from a place drawn with two uniform numbers; its pdf is per steradian. False
// when none is sent that way.
bool lamp_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample);

// The density with which lamp_sample would have drawn this direction from origin, in which the lamp
// is met after `distance` m; 0 on a quad's dark side.
float lamp_density(const Light *light, Vec3 origin, Vec3 direction, float distance);

// The place of a quad that the same numbers draw; the middle of a ball.
Vec3 lamp_pivot(const Light *light, const float u[2]);

#endif
