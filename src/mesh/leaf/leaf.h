// Leaves as small quad meshes, to be instanced by the hundred thousand: blades of many outlines,
// alone or as the leaflets of compound leaves, and pieces of shoots with needles or scales.
#ifndef RAMIFY_MESH_LEAF_LEAF_H
#define RAMIFY_MESH_LEAF_LEAF_H

#include "base/mesh.h"

// The outline of a blade or leaflet, or what stands in place of one.
typedef enum LeafShape {
    LEAF_OAK,        // obovate with rounded lobes; without lobes a plain oval
    LEAF_OVATE,      // egg-shaped, widest below the middle
    LEAF_OBOVATE,    // widest above the middle, with a wedge-shaped base
    LEAF_LANCEOLATE, // narrow, with a long point
    LEAF_LINEAR,     // parallel sides: bamboo, palms' leaflets
    LEAF_CORDATE,    // heart-shaped
    LEAF_RHOMBIC,    // with corners at the sides: birch, poplar
    LEAF_PALMATE,    // lobes that spread from the stalk: maple, plane, ivy
    LEAF_FAN,        // ginkgo
    LEAF_PAD,        // round about the stalk's end, with a notch to it: water lily
    LEAF_NEEDLES,    // a piece of a shoot with needles, or a branchlet of such: spruce, pine
    LEAF_TUFT,       // a rosette of needles on a short shoot: larch, cedar
    LEAF_SCALES      // a spray of twiglets covered with scales: cypress
} LeafShape;

// How leaflets are arranged on the rachis.
typedef enum LeafCompound {
    COMPOUND_NONE,
    COMPOUND_PINNATE,   // in two rows
    COMPOUND_BIPINNATE, // pinnate leaves in two rows
    COMPOUND_PALMATE    // from the end of the stalk
} LeafCompound;

// A leaf whose stalk starts at the origin, with the blade along +Y, upper side facing +Z; a pad
// lies all round the end of its stalk. Lengths in metres. Of a compound leaf, length and width are
// those of the whole. 0 = the shape's own for all below `detail`.
typedef struct LeafParams {
    float length, width; // of the blade; of a needle
    float petiole;       // length of the stalk; its base is the origin
    float fold;          // degrees by which each half is folded up about the midrib
    float curl;          // degrees by which the blade or the rachis bends down from base to tip; by
                         // which a pad's rim bends up where it does
    float wave;          // ripple amplitude of the edge, relative to the width
    int lobes;           // oak: per side, rounded, 0 = none; palmate: of the whole leaf
    float lobe_depth;    // depth of the bays between lobes: oak: relative to the half width;
                         // palmate: to the length
    int detail;          // 1 = about 25 quads, for whole trees; 2 = about 110 or one for every
                         // tooth and needle, for close-ups; 3 = blades without lobes and teeth
                         // in 840, for their margins from near

    LeafShape shape;
    float nod;         // degrees between the stalk's direction and the blade, down from it
    float widest;      // 0..1 along the blade: where it is widest
    float sickle;      // degrees by which the midrib of an undivided blade bends sideways
    float tip;         // 0..1: from a blunt tip over a point (0.5) to a long drawn-out one
    int teeth;         // per side of a blade or lobe; 0 = a smooth edge
    float tooth_depth; // relative to the width
    bool double_teeth; // three small ones on each
    float wear;        // 0..1: bites and holes, at detail 2

    LeafCompound compound;
    int leaflets;         // of the leaf (an odd number: with one at the end); of a bipinnate leaf
                          // the number of its pinnate parts
    float leaflet_width;  // m
    int leaflets_of_part; // bipinnate: leaflets of each part
    float taper;          // 0..1: from equal leaflets to a leaf that narrows to its tip

    int needles;        // of the piece or rosette
    int bundle;         // needles that stand together: pines have 2, 3 or 5
    int side_shoots;    // of a branchlet with needles; 0 = a plain piece of shoot
    float shoot;        // m, length of the piece of shoot or of the spray
    float needle_angle; // degrees to the shoot
    float comb;         // 0..1: from all round to two sides
    float flush;        // 0..1: share of every shoot with needles, at its tip, that grew this year
} LeafParams;

// uv: u 0..1 across (0.5 = midrib), v 0..1 along the blade (0 on the stalk), of every leaflet, lobe
// and needle; of a pad both from above, its stalk's end at (0.5, 0.5). seed varies the outline
// slightly. The caller frees the mesh with mesh_free.
Mesh *leaf_mesh_new(const LeafParams *params, uint64_t seed, Error *e);

// A simpler leaf of the same area, without stalk and lobes, for leaves of a few pixels. level: 0 =
// a smooth outline of 8 quads, one quad for every leaflet, part or palmate lobe, every fourth
// needle; 1 = one quad folded along the midrib, or every sixteenth needle (Cook et al., "Stochastic
// Simplification of Aggregate Detail", 2007); 2, of branchlets alone = one quad along every shoot.
// *error (m): how far the leaf's vertices are from it, at least half the width of its needles. The
// caller frees the mesh with mesh_free.
enum { LEAF_COARSE_MOST = 3 };
int leaf_coarse_levels(const LeafParams *params);
Mesh *leaf_mesh_coarse(const LeafParams *params, uint64_t seed, int level, float *error, Error *e);

#endif
