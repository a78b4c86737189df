// How droplets of water scatter visible light: a fit to Mie's theory by two lobes, one of Henyey
// and Greenstein and one of Draine (Jendersie and d'Eon, "An Approximate Mie Scattering Function
// for Fog and Cloud Rendering", SIGGRAPH 2023 Talks).
#ifndef RAMIFY_RENDER_MEDIUM_DROPLETS_H
#define RAMIFY_RENDER_MEDIUM_DROPLETS_H

#include "base/vec.h"

typedef struct DropletPhase {
    float forward; // anisotropy of Henyey and Greenstein's lobe
    float side;    // and of Draine's
    float alpha;   // of Draine's: how much more goes forward and back than aside
    float share;   // of Draine's lobe
} DropletPhase;

// diameter: 5 .. 50 um.
DropletPhase droplet_phase(float diameter);

// The same with all anisotropies times `left`, 0 .. 1; 0 = even.
DropletPhase droplet_phase_widened(const DropletPhase *phase, float left);

float droplet_phase_mean_cosine(const DropletPhase *phase);

// 1/sr; cosine of the angle between the directions before and after.
float droplet_phase_density(const DropletPhase *phase, float cosine);

// A direction by this density. u, v: uniform in [0, 1).
Vec3 droplet_phase_draw(const DropletPhase *phase, Vec3 direction, float u, float v);

#endif
