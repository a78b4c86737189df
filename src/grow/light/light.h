// Growth by light, season by season (Palubicki et al. 2009: Self-organizing tree models for image
// synthesis). A tree is made of metamers: an internode with its leaves and side buds at its upper
// end. Each season (1) a voxel grid tells how much light of the sky the leaves of each metamer
// catch, (2) branches whose leaves catch too little die, (3) the light caught is summed down to the
// base, which makes growth of it, and growth is shared out at every fork by apical control
// (Borchert and Honda 1984), (4) buds that get enough make shoots of metamers.
#ifndef RAMIFY_GROW_LIGHT_LIGHT_H
#define RAMIFY_GROW_LIGHT_LIGHT_H

#include "field/guide_field.h"
#include "grow/room.h"
#include "outtree/out_tree.h"
#include "shape/envelope.h"

// How a species grows. Lengths are in internodes, so a tree of any size grows alike. Three values:
// of the stem, of limbs (which leave it), of the branches on them.
typedef struct LightParams {
    int seasons;         // in which a tree grows up
    Vec2 apical_control; // share of a fork's growth that the axis gets if both sides have the same
                         // light: of a young and of an old tree
    Vec2 maturing;       // shares of the seasons between which it goes from young to old
    float vigor;         // metamers that the light of one free metamer makes in a season
    Vec3 shoot;          // metamers of the longest shoot of a season
    float shade;         // area of a metamer's leaves across the light, internodes squared
    int leaf_seasons;    // in which a metamer bears leaves
    float light_need;    // mean light (0..1) of a branch's leaves below which it dies
    Vec3 branch_angle;   // degrees between a branch and its axis: limbs, branches, twigs
    float angle_spread;  // degrees, standard deviation of these
    float phyllotaxis;   // degrees about the axis from one node to the next
    int buds;            // side buds at a node
    int whorl;           // side buds stand at the end of a season's shoot alone, so many on the
                         // stem; 0 = at every node
    float between;       // chance of a side bud at a node between whorls
    Vec3 tropism;        // pull along LightSite.up on the direction of each new metamer
    float phototropism;  // pull toward the brightest part of the sky
    float zigzag;        // degrees by which a season's shoot turns aside from the last
    Vec3 leader_loss;    // chance that an axis loses its end bud in a season; the side bud below
                         // leads on, at LightParams.branch_angle
    float unevenness;    // of branches' vigor: standard deviation of its natural logarithm
    float noise;         // Gaussian, per component, on the direction of a season's shoot
    float plagiotropy;   // 0..1: how far side shoots spread in a level plane
    float bole;          // height below which the stem loses its branches, share of the tree's
    float snags;         // length of the stub that a shed branch leaves, share of the branch's
    float upkeep;        // what a metamer without leaves counts in light_need, beside one with
                         // leaves: wood must be kept alive, too
} LightParams;

LightParams light_params_default(void); // an oak in the open

// Points that buds reach for beside light; borrowed. Lengths in internodes but for the positions.
typedef struct LightAttractors {
    const Vec3 *position; // m
    int64_t count;
    float weight;   // 0..1: share of its light that does not count if none draws a metamer
    float pull;     // on the direction of each new metamer, toward those that draw its shoot
    float reach;    // to the metamer that each draws
    float occupied; // one nearer to a metamer than this is taken; at most the reach
} LightAttractors;

// Where and for how long it grows. Lengths in m.
typedef struct LightSite {
    Vec3 foot;                // of the stem
    float internode;          // m
    int seasons;              // to grow; from the start nodes on
    Vec3 up;                  // direction of tropism 1
    const Envelope *envelope; // nothing grows beyond; NULL = everywhere
    const GuideField *field;  // turns shoots; NULL = none
    float field_weight;
    const LightAttractors *attractors; // NULL = none; not used in a stand
    const Room *room;                  // obstacles and rivals; NULL = it grows alone
    Aabb reach;                        // internodes from the foot: where it may grow in a room
    int64_t cells;                     // most voxels of the grid; 0 = 400,000
    int64_t metamers;                  // most; growth ends there; 0 = 8 million
    float tip,
        girth;      // m: radius of a tip and of the thickest stem's base (see out_tree_pipe_radii)
    float exponent; // of the pipe model if girth is 0
    int healing; // seasons after its death in which a branch's stub has fallen and its place been
                 // overgrown: a knot, one node inside the wood; 0 = stubs stay
    int32_t colony[4]; // of the nodes of stems, of branches, of snags, of knots
    uint64_t seed;
} LightSite;

// Grows a tree from the nodes of start, which are its first metamers: a foot on the ground, or
// limbs that were laid by attractors. Returns a new tree with the living metamers and the stubs of
// shed branches, with radii by the pipe model over all wood that ever grew; parts of start may be
// shed. The result does not depend on run->threads. NULL and e: ERROR_MEMORY, ERROR_CANCELLED,
// ERROR_INPUT for a start without nodes or an internode that is not positive.
OutTree *light_grow(const OutTree *start, const LightParams *params, const LightSite *site,
                    const Run *run, Error *e);

// One of several plants that grow side by side.
typedef struct StandPlant {
    OutTree *start; // borrowed
    LightParams params;
    LightSite site; // all in one space; room and reach are not used
    OutTree *grown; // the result, owned by the caller
} StandPlant;

// Grows plants that shade each other, each as light_grow does. Those with fewer seasons begin
// later. copy: m, offsets at which the leaves of all cast their shade once more, as those of a
// larger stand. The result does not depend on the order of the plants or on run->threads. On
// failure no plant has a tree; errors as for light_grow.
bool light_grow_stand(StandPlant *plant, int count, const Vec3 *copy, int copies, const Run *run,
                      Error *e);

#endif
