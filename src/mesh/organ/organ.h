// Organs of plants beside leaves as small quad meshes, to be instanced: blossom, catkins, fruit,
// cones, buds, winged nuts, spines.
#ifndef RAMIFY_MESH_ORGAN_ORGAN_H
#define RAMIFY_MESH_ORGAN_ORGAN_H

#include "base/mesh.h"

#include <stdint.h>

typedef enum OrganKind {
    ORGAN_BLOSSOM,   // flowers of separate petals
    ORGAN_CATKIN,    // a cylinder of small scales
    ORGAN_FRUIT,     // round or long, with or without a dimple: apple, cherry, olive, date
    ORGAN_CONE,      // woody scales in spirals
    ORGAN_ACORN,     // a nut in a cup
    ORGAN_HUSK,      // a ball with spikes: horse chestnut
    ORGAN_BUD,       // pointed, with overlapping scales
    ORGAN_SAMARA,    // two winged nuts: maple
    ORGAN_THORN,     // straight spines
    ORGAN_DAISY,     // flower heads of rays about a disc
    ORGAN_BELL,      // tubes whose tips curl back: bluebell, hyacinth, lily of the valley
    ORGAN_WATER_LILY // sepals, pointed petals in many whorls, stamens as broad as petals
} OrganKind;

// How those of one place stand together.
typedef enum OrganCluster {
    CLUSTER_UMBEL, // from one point
    CLUSTER_RACEME // along an axis
} OrganCluster;

// What a part of an organ is made of: each has a material of its own.
typedef enum OrganTissue {
    TISSUE_PETAL,
    TISSUE_FLESH,  // of fruit and nuts, the disc of a daisy
    TISSUE_WOOD,   // scales of cones, catkins and buds, cups, spines
    TISSUE_GREEN,  // stalks, sepals, stamens
    TISSUE_WING,   // thin: of winged nuts
    TISSUE_ANTHER, // pollen bags of a blossom of detail 2; stamens and stigma of a water lily
    TISSUES
} OrganTissue;

// An organ or cluster whose stalk starts at the origin and runs along +Y. Lengths in metres.
typedef struct OrganParams {
    OrganKind kind;
    float length, width; // of one; of blossom the length and width of a petal; of a bell the length
                         // of a petal from the stalk to its tip, and the tube's width
    float stalk;         // length of each one's stalk
    OrganCluster cluster;
    int per_cluster; // at least 1
    float axis;      // length of a raceme's axis
    float taper;     // 0..1: how much smaller a raceme's organs and stalks are at its end
    float arch;      // degrees by which a raceme's axis bends toward +X from its foot to its end
    float one_sided; // 0..1: from all round to one side, that to which the axis bends
    float nod;       // 0..1: how far each one hangs toward -Y at the end of its stalk; those near a
                     // raceme's end less
    int bracts;      // at the foot of each stalk
    float bract_length;
    float spread; // degrees between the outermost stalks and +Y
    float open;   // 0..1: from closed to open petals, scales or wings
    int petals;   // of a blossom more than 5 in several whorls
    float buds;   // 0..1: share of a cluster's blossoms that are still closed; of bells the last
    float spur;   // length of the short shoot on which the cluster stands; 0 = none
    float dimple; // 0..1: of fruit, at both ends; of a daisy the disc's radius, in petal lengths
    int detail;   // 1 or 2; 0 = for organs of a few pixels: a cone or catkin without
                  // scales, a blossom of flat petals without what stands between them
} OrganParams;

// mesh[t]: of tissue t; NULL where the organ has none. The caller frees each with mesh_free. uv: u
// across, v along each petal, scale or body. False and e when memory is short; then all are NULL.
bool organ_meshes(const OrganParams *params, uint64_t seed, Mesh *mesh[TISSUES], Error *e);

#endif
