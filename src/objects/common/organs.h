// Organs beside leaves on a plant's branches: blossom, fruit, cones, buds, spines.
#ifndef RAMIFY_OBJECTS_COMMON_ORGANS_H
#define RAMIFY_OBJECTS_COMMON_ORGANS_H

#include "mesh/organ/organ.h"
#include "objects/common/branches.h"

// Where organs stand.
typedef enum OrganSites {
    SITES_ENDS,  // at the ends of twigs
    SITES_ALONG, // along twigs, as leaves in a spiral
    SITES_STEM   // in `rows` lines along stems and branches
} OrganSites;

// One kind of organ on all branches.
typedef struct OrganGroup {
    OrganKind kind;
    OrganSites where;
    float season[2];   // months in which they are there (see Phenology); 0 = always
    int64_t max_count; // of clusters
    float share;       // 0..1 of the places that bear one
    float spacing;     // m between places along a branch
    float twig_radius; // m: only branches thinner than this bear them
    float above;       // 0..1 of the crown's height: none below
    int rows;          // of SITES_STEM
    float angle;       // degrees to the branch
    float hang;        // 0..1: how far they hang straight down

    // Form: see OrganParams.
    OrganCluster cluster;
    int per_cluster;
    float axis, taper, spread;
    float arch, one_sided, nod;
    int bracts;
    float bract_length;
    float length, width, stalk; // m
    float open;
    int petals;
    float buds, spur;
    float dimple;
    float size_variation; // 0..1
    int variants, detail;
} OrganGroup;

extern const struct Table organ_table; // of an OrganGroup

// How a plant's organs are shown.
typedef struct OrgansParams {
    const OrganGroup *group;
    int count;
    float time; // of the year, months (phenology_time); 0 = every group is there
    const SkinningParams *skin;
    int32_t bare_from; // branches of this colony and later ones bear none; -1 = all do
    uint64_t seed;
    LeafLight light;   // facing, if not NULL: where plants on a surface hold their organs to
    int role[TISSUES]; // of the kind's materials
} OrgansParams;

// Adds the organs of all groups: one part for every variant and tissue.
bool organs_add(const OutTree *tree, const OrgansParams *params, const Placing *placing, Error *e);

#endif
