// What the kinds of organs build with.
#ifndef RAMIFY_MESH_ORGAN_ORGAN_PARTS_H
#define RAMIFY_MESH_ORGAN_ORGAN_PARTS_H

#include "mesh/organ/organ.h"
#include "mesh/quads.h"

// The golden angle, in degrees.
#define ORGAN_DIVERGENCE 137.507764f

typedef struct OrganBuild {
    const OrganParams *params;
    Quads tissue[TISSUES];
} OrganBuild;

// Sets the place of all tissues; NULL = identity.
void organ_set_place(OrganBuild *build, const Transform *place);

// A frame with its y axis at `open` degrees from +Y toward the azimuth `turn` (degrees, from +X
// toward +Z), its origin at p.
Transform organ_frame(Vec3 p, float open, float turn);

// A tapered stalk from the origin to p, which it reaches along +Y at first.
void organ_stalk(OrganBuild *build, Vec3 p, float radius);

// A sheet from the origin along +Y that faces +Z: half width half[i] at length[i], lifted by
// lift[i] toward +Z in its middle.
void organ_sheet(Quads *quads, const float *length, const float *half, const float *lift, int rows,
                 float cup);

// The kinds: each adds one organ at the origin along +Y, without its stalk.
void organ_blossom(OrganBuild *build, uint64_t seed);
void organ_daisy(OrganBuild *build, uint64_t seed);
void organ_catkin(OrganBuild *build, uint64_t seed);
void organ_cone(OrganBuild *build, uint64_t seed);
void organ_fruit(OrganBuild *build, uint64_t seed);
void organ_acorn(OrganBuild *build, uint64_t seed);
void organ_husk(OrganBuild *build, uint64_t seed);
void organ_bud(OrganBuild *build, uint64_t seed);
void organ_samara(OrganBuild *build, uint64_t seed);
void organ_thorn(OrganBuild *build, uint64_t seed);

#endif
