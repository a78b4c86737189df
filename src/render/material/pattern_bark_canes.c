// Canes of bamboo: glossy internodes; at each node the dark scar of a sheath, above it a swollen
// ring, below it a band of waxy bloom. Internodes are 0.24 m long on a full-size cane.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <stddef.h>

#define INTERNODE 0.24f // m
#define RING 0.008f     // m: half the width of the swollen ring
#define BLOOM 6.0f      // rings: how far the band of bloom reaches down

// A bump of height 1 at x = 0, of this half width; *slope: its derivative.
static float bump(float x, float width, float *slope)
{
    float t = x / width, rest = fmaxf(1.0f - t * t, 0.0f);
    *slope = -4.0f * t * rest / width;
    return rest * rest;
}

BarkLook bark_canes(const Material *m, const StemPlace *place, float scale, float footprint)
{
    float length = INTERNODE * scale, ring = RING * scale;
    float run = place->p.z / length;
    float above = (run - floorf(run + 0.5f)) * length; // m above the nearest node
    float slope, unused;
    float swelling = bump(above - 0.4f * ring, ring, &slope);
    float scar = bump(above + 0.8f * ring, 0.5f * ring, &unused);
    float bloom = above < -ring ? smoothstepf(-BLOOM * ring, -1.5f * ring, above) : 0.0f;
    float streak = noise_solid(stem_lookup(place, 0.02f * scale, 0.03f * scale), 71, NULL);
    float blotch = noise_fractal(stem_lookup(place, 0.05f * scale, 0.12f * scale), 3, 72);
    Vec3 own = vec3_scale(m->color, 1.0f + 0.10f * blotch + 0.06f * streak);
    Vec3 color = vec3_lerp(own, m->color2, 0.55f * bloom + 0.25f * swelling);
    color = vec3_scale(color, 1.0f - 0.75f * scar);
    float seen = pattern_detail(3.0f * ring, footprint);
    Vec3 mean = vec3_lerp(own, m->color2, 0.5f * 0.55f * BLOOM * ring / length);
    return (BarkLook){
        .color = vec3_lerp(mean, color, seen), .height = seen * swelling, .slope_v = seen * slope};
}
