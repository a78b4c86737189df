// All clouds of a scene, and tracking through them with null collisions against the bounds of
// cells (Woodcock et al. 1965; Novak et al., "Residual Ratio Tracking", SIGGRAPH Asia 2014;
// cells: Szirmay-Kalos et al. 2011). Unbiased for the field as it is looked up.
#ifndef RAMIFY_RENDER_CLOUD_CLOUDS_H
#define RAMIFY_RENDER_CLOUD_CLOUDS_H

#include "base/run.h"
#include "base/vec.h"
#include "render/cloud/cloud.h"

#include <stdint.h>

typedef struct CloudSet CloudSet;

// seed: of the scene. ERROR_MEMORY when the grids do not fit.
CloudSet *clouds_new(const Cloud *cloud, int count, uint64_t seed, const Run *run, Error *e);
void clouds_free(CloudSet *clouds); // NULL is fine

// Bytes that clouds_new will hold.
int64_t clouds_bytes(const Cloud *cloud, int count);

// Part of a ray with unit direction, up to far m.
typedef struct CloudRay {
    Vec3 origin, direction;
    float far;
    bool blurred; // of light that many scatterings have spread: small detail is left out
} CloudRay;

// Draws the distance to the first collision with a droplet, where scattering counts `scale` times;
// INFINITY = none. *key: state of the random numbers, which advances.
float clouds_collide(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key);

// The same, with the number of the cloud that holds the droplet.
float clouds_collide_with(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key,
                          int *which);

// Share of the light that goes on after a collision in cloud number index, where the extinction by
// scattering counts `scale` times. What absorbs counts in full: so light reaches as far as it does
// in nature, though fewer scatterings are traced.
Vec3 clouds_albedo(const CloudSet *clouds, int index, float scale);

// Does cloud number index absorb any light?
bool clouds_absorb(const CloudSet *clouds, int index);

// Roulette by that share at a collision; u: random, 0 .. 1. False: the light is absorbed; else
// *weight takes the colour of what goes on.
bool clouds_scatter(const CloudSet *clouds, int index, float scale, float u, Vec3 *weight);

// An estimate of the ray's transmittance, 0 .. 1, of the right mean.
float clouds_pass(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key);

// The same with less spread, for several times the work: for light that is seen through clouds,
// where clouds_pass, as it plays for small shares, is all or nothing. May be a little below 0.
float clouds_clear(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key);

// Extinction of all clouds at a place, 1/m.
float clouds_extinction(const CloudSet *clouds, Vec3 p);

// Extinction in the midst of the densest cloud, 1/m.
float clouds_densest(const CloudSet *clouds);

// Extinction of cloud number index alone at a place, 1/m.
float clouds_extinction_of(const CloudSet *clouds, int index, Vec3 p);

// Box of cloud number index, which is grown, and distance of samples that show its form, m. Of one
// that repeats, the samples of a period in x and z: the next copy's begin one distance farther.
void clouds_samples_of(const CloudSet *clouds, int index, Aabb *box, float *distance);

// The share of light that a ray loses, by steps through the clouds without wisps, and the mean
// distance at which it does, m.
float clouds_seen(const CloudSet *clouds, const CloudRay *ray, float *distance);

// Gradient of the extinction without wisps, over that of a soft border; forms that are smaller than
// light shows are left out.
Vec3 clouds_slope(const CloudSet *clouds, Vec3 p);

#endif
