// Murray's laws of branching vessels (Murray 1926; Tanaka 5.4): radii that conserve flow at every
// fork, and the angles of least work at which the daughters leave.
#ifndef RAMIFY_OUTTREE_MURRAY_H
#define RAMIFY_OUTTREE_MURRAY_H

#include "base/error.h"
#include "outtree/out_tree.h"

// Flow as a power of a vessel's radius. exponent > 0: r^exponent at every size. exponent 0: as
// measured in arteries, r^3 up to 0.1 mm, r^2.7 from there to 1 mm, r^2.3 above.
typedef struct MurrayLaw {
    float exponent;
} MurrayLaw;

// Flow through a vessel of this radius (m), relative to one of radius 1 m (extrapolating the
// largest vessels' law), and the inverse. Both increase; radius and flow > 0.
double murray_flow(MurrayLaw law, double radius);
double murray_radius(MurrayLaw law, double flow);

// Radius (m) of tips such that `tips` of them carry the flow of a root of root_radius (m).
float murray_tip_radius(MurrayLaw law, float root_radius, int64_t tips);

// Sets radii from tip_radius (m) at the tips: at every node the inflow is the sum of the outflows.
void out_tree_murray_radii(OutTree *tree, MurrayLaw law, float tip_radius);

// Cosines of the angles between the daughters 1 and 2 of a vessel and its direction, clamped to
// [-1, 1]. Their sum obeys Tanaka eq. (15): cos(a + b) = (r0^4 - r1^4 - r2^4) / (2 r1^2 r2^2).
typedef struct MurrayAngles {
    double cosine1, cosine2, cosine_between;
} MurrayAngles;

MurrayAngles murray_angles(double r0, double r1, double r2);

// Whether the vessel to `node` may run from `from` to `to` (the tree still holds the node's old
// position).
typedef bool MurrayAllowed(void *user, int64_t node, Vec3 from, Vec3 to);

typedef struct MurrayReport {
    int64_t forks;    // nodes with two children
    int64_t exact;    // both daughters leave at the law's angles
    int64_t reduced;  // a daughter was rotated by less than the law asks, to stay where it is
                      // allowed
    int64_t multiple; // nodes with more than two children, which the law does not cover; left
                      // unchanged
} MurrayReport;

// Rotates the subtrees below every fork rigidly about it, from the roots to the tips, until both
// daughters' first segments leave at Murray's angles to their mother, in the plane of the fork. The
// angles follow from the tree's radii. A root with two children has no mother; its daughters are
// rotated about the direction in which their pulls balance. allowed (may be NULL): a rotation that
// would take a segment of the subtree where it is not allowed is halved, at most three times, then
// dropped; a tree that starts out allowed stays so. Time O(n) plus the checks. bound (count flags,
// may be NULL) is set to 1 at reduced forks, else 0. report may be NULL.
bool out_tree_murray_turn(OutTree *tree, MurrayAllowed *allowed, void *user, uint8_t *bound,
                          MurrayReport *report, Error *e);

// Bends the daughters of forks that out_tree_murray_turn had to leave: their first segments take
// the law's angles, in a plane about the mother as near to the fork's as is allowed, and what
// follows returns within at most 8 generations to where it was. A first segment keeps at least 0.35
// of its length, every other one 0.3. Where only one daughter can move, the angle between both is
// the law's (eq. 15). Forks are visited from the roots to the tips, so a fork once bent stays
// exact; those without an allowed bend are left unchanged. allowed: as above. Time O(n) plus the
// checks.
bool out_tree_murray_bend(OutTree *tree, MurrayAllowed *allowed, void *user, Error *e);

// How well a tree obeys the laws.
typedef struct MurrayFit {
    int64_t forks;
    double residual;     // largest |flow in - sum of flows out| / flow in, over all nodes
    double angle_median; // degrees: |angle between the daughters - Tanaka eq. (15)|, over the forks
    double angle_exact;  // share of the forks where that is below 0.5 degrees
    double side_angle;   // degrees: mean angle between a daughter and its mother
} MurrayFit;

bool out_tree_murray_fit(const OutTree *tree, MurrayLaw law, MurrayFit *fit, Error *e);

#endif
