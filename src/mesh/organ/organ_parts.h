// What the kinds of organs build with.
#ifndef RAMIFY_MESH_ORGAN_ORGAN_PARTS_H
#define RAMIFY_MESH_ORGAN_ORGAN_PARTS_H

#include "mesh/organ/organ.h"
#include "mesh/quads.h"

// The golden angle, in degrees.
#define ORGAN_DIVERGENCE 137.507764f

typedef struct OrganBuild {
    const OrganParams *params;
    float rank; // 0..1: of the one that is being added within its cluster, from foot to end
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

// A petal of a close-up from the origin along +Y that faces +Z: hollow, with a wavy margin and a
// notch at its end.
void organ_petal(Quads *quads, float length, float width, float open, uint64_t key);

// The axis of a raceme from its foot to its end, bending toward +X, each a little more or less than
// another and not quite evenly.
enum { ORGAN_AXIS_POINTS = 17 };
typedef struct OrganAxis {
    Vec3 point[ORGAN_AXIS_POINTS];
} OrganAxis;
OrganAxis organ_axis(const OrganParams *params, uint64_t seed);

// A frame on the axis at t in 0..1 of its length whose +Y runs along it and whose +X is on the side
// to which it bends.
Transform organ_axis_frame(const OrganAxis *axis, float t);

// The bending axis itself: a tube of this radius (m) that tapers.
void organ_axis_add(OrganBuild *build, const OrganAxis *axis, float radius);

// A stalk of this length (m) from the frame's origin along its +Y that bends until the one it bears
// hangs by `nod` (0..1) toward -Y. Returns the frame of that one.
Transform organ_nodding_stalk(OrganBuild *build, const Transform *start, float length, float nod,
                              float radius);

// Bracts below a stalk that starts along +Y of the frame.
void organ_bracts(OrganBuild *build, const Transform *start, float size, uint64_t seed);

// A short shoot from the origin along +Y: ringed by the scars of past years, ended by the open
// scales of the bud that the cluster has come out of.
void organ_spur(OrganBuild *build, uint64_t seed);

// Is the blossom of this seed still closed?
bool organ_is_closed(const OrganParams *params, uint64_t seed);

// The kinds: each adds one organ at the origin along +Y, without its stalk.
void organ_blossom(OrganBuild *build, uint64_t seed);
void organ_daisy(OrganBuild *build, uint64_t seed);
void organ_bell(OrganBuild *build, uint64_t seed);
void organ_water_lily(OrganBuild *build, uint64_t seed);
void organ_catkin(OrganBuild *build, uint64_t seed);
void organ_cone(OrganBuild *build, uint64_t seed);
void organ_fruit(OrganBuild *build, uint64_t seed);
void organ_acorn(OrganBuild *build, uint64_t seed);
void organ_husk(OrganBuild *build, uint64_t seed);
void organ_bud(OrganBuild *build, uint64_t seed);
void organ_samara(OrganBuild *build, uint64_t seed);
void organ_thorn(OrganBuild *build, uint64_t seed);

#endif
