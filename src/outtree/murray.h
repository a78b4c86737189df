// Murray's laws of branching vessels (Murray 1926; Tanaka et al., section 5.4): radii by which flow
// is conserved at every fork, and the angles of least work at which the daughters leave.
#ifndef RAMIFY_OUTTREE_MURRAY_H
#define RAMIFY_OUTTREE_MURRAY_H

#include "base/error.h"
#include "outtree/out_tree.h"

// How the flow through a vessel goes with its radius. exponent > 0: as r^exponent at every size.
// exponent 0: as measured in arteries, r^3 up to 0.1 mm, r^2.7 from there to 1 mm, r^2.3 above.
typedef struct MurrayLaw {
    float exponent;
} MurrayLaw;

// The flow through a vessel of this radius (m), in units of that through one of 1 m (of the largest
// vessels' law, extended); and back. Both increase; radius and flow > 0.
double murray_flow(MurrayLaw law, double radius);
double murray_radius(MurrayLaw law, double flow);

// The radius (m) of tips such that `tips` of them take the flow of a root of root_radius (m).
float murray_tip_radius(MurrayLaw law, float root_radius, int64_t tips);

// Radii from tip_radius (m) at the tips: at every node the flow in is the sum of the flows out.
void out_tree_murray_radii(OutTree *tree, MurrayLaw law, float tip_radius);

// Cosines of the angles at which the daughters 1 and 2 of a vessel leave its direction; clamped to
// [-1, 1]. Their sum is Tanaka et al., eq. (15): cos(a + b) = (r0^4 - r1^4 - r2^4) / (2 r1^2 r2^2).
typedef struct MurrayAngles {
    double cosine1, cosine2, cosine_between;
} MurrayAngles;

MurrayAngles murray_angles(double r0, double r1, double r2);

// Whether the vessel from `from` to `to` may lead to node (whose position in the tree is still the
// old one).
typedef bool MurrayAllowed(void *user, int64_t node, Vec3 from, Vec3 to);

typedef struct MurrayReport {
    int64_t forks;   // nodes with two children
    int64_t exact;   // both daughters stand at the law's angles
    int64_t reduced; // a daughter was turned by less than the law asks, to stay where it is allowed
    int64_t multiple; // nodes with more children: no law says how those stand, so they are left
} MurrayReport;

// Turns the subtrees below every fork rigidly about it, from the roots to the tips, until both
// daughters' first segments stand at Murray's angles to their mother, in the plane in which they
// parted. Angles follow the radii that the tree has. A root with two children has no mother; its
// daughters are turned about the direction in which their pulls balance. allowed (may be NULL): a
// turn that would take a segment of the subtree where it may not be is halved until all are
// allowed, at most three times, then left out; a tree that is allowed to start with stays so. Time
// O(n), and what the checks take. bound (count flags, may be NULL) is set to 1 at the forks that
// were reduced, else 0. report may be NULL.
bool out_tree_murray_turn(OutTree *tree, MurrayAllowed *allowed, void *user, uint8_t *bound,
                          MurrayReport *report, Error *e);

// How well a tree keeps the laws.
typedef struct MurrayFit {
    int64_t forks;
    double residual;     // largest |flow in - sum of flows out| / flow in, over all nodes
    double angle_median; // degrees: |angle between the daughters - eq. (15)|, over the forks
    double angle_exact;  // share of the forks where that is below 0.5 degrees
    double side_angle;   // degrees: mean angle between a daughter and its mother
} MurrayFit;

bool out_tree_murray_fit(const OutTree *tree, MurrayLaw law, MurrayFit *fit, Error *e);

#endif
