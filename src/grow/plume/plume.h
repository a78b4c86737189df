// Plumes: ribs bear barbs on both sides, barbs bear barbules, and so on, as in the ferns of window
// frost. Space colonization (Tanaka eq. (1)-(8)) in a field: a tip heads along normalize(n + w X_f)
// (eq. (9)-(13)) and ends where it meets others, because no attractor is left that is nearer to it
// than to them. X_f leads a rib away from its nucleus, turned by an angle that grows outward, and a
// branch along the chain that it left, turned by an angle that falls along the way.
#ifndef RAMIFY_GROW_PLUME_H
#define RAMIFY_GROW_PLUME_H

#include "base/run.h"
#include "grow/room.h"
#include "outtree/jitter.h"
#include "outtree/out_tree.h"
#include "shape/points.h"

enum { PLUME_MOST_ORDERS = 3 };

// A rib's start.
typedef struct PlumeStart {
    Vec3 position;  // m, on the surface
    Vec3 heading;   // unit, tangent
    float turn;     // 1/m, either sign: at the distance r from the start, the field is turned by
                    // atan(turn r)
    int32_t birth;  // step at which it begins
    int64_t number; // the caller's own; not read
} PlumeStart;

// The branches of one order: 0 = barbs, which leave ribs, 1 = barbules, which leave barbs, ...
typedef struct PlumeOrder {
    float spacing; // m along the chain that they leave, on each side
    float angle;   // degrees between that chain and a branch where it leaves
    float curl;    // degrees by which this angle has fallen at full length
    float length;  // m: the longest
    float taper;   // longest length over the way ahead of the branch that they leave; 0 = any
    int period;    // steps of growth that a step of theirs takes
} PlumeOrder;

typedef struct PlumeParams {
    float step, kill, influence; // m, as of ColonizeParams
    PlumeOrder order[PLUME_MOST_ORDERS];
    int orders;
    float side_rib;     // 0..1: share of the barbs that become ribs, with barbs of their own
    float side_length;  // m: the longest of these
    float field_weight; // w
    float spread;       // degrees: standard deviation of the angles
    float skip;         // 0..1: probability that a branch does not grow
    SurfaceProject *project;
    const void *surface; // passed to project
    const Room *room;    // obstacles and rivals; NULL = the growth is alone
    uint64_t seed;
} PlumeParams;

// Grows plumes into the empty tree. Births count steps; the colony is the start's number, in order
// of their births. The result does not depend on run->threads. ERROR_INPUT, ERROR_CANCELLED.
bool plume_grow(OutTree *tree, const PlumeStart *start, int64_t count, const PointSet *attractors,
                const PlumeParams *params, const Run *run, Error *e);

#endif
