// What else takes up the space of a growth: obstacles, and rivals that grow at the same time.
#ifndef RAMIFY_GROW_ROOM_H
#define RAMIFY_GROW_ROOM_H

#include "base/run.h"
#include "outtree/out_tree.h"
#include "shape/points.h"

// How far plants of one habit grow freely, found once for all rivals.
typedef struct RoomTrial {
    uint64_t key; // of what it depends on
    Aabb reach;
} RoomTrial;

typedef struct RoomTrials {
    RoomTrial *trial;
    int64_t count, capacity;
} RoomTrials;

// Positions are in the growth's own space.
typedef struct Room {
    // Distance (m) from p to the space that is taken: negative inside. *away: unit direction in
    // which it grows; zero if unknown. Called by many threads, between two calls of `meet`.
    float (*clearance)(const void *user, Vec3 p, Vec3 *away);

    // The same to the obstacles alone, which cast shade; NULL = there are none. Called by many
    // threads.
    float (*obstacle)(const void *user, Vec3 p);

    // Is p an attractor's place: free, and near enough to what it must be near?
    bool (*allows)(const void *user, Vec3 p);

    // Called before every step with the nodes that are new to the rivals: first .. tree->count - 1;
    // first = 0 begins a growth. Returns when it is this growth's turn; *rival then are the rivals'
    // nodes that are new to it (all of them if first = 0), valid until the next call. False and e
    // if the growth must stop. NULL = no rivals.
    bool (*meet)(void *user, const OutTree *tree, int64_t first, const Vec3 **rival, int64_t *count,
                 Error *e);

    // Light that all who grow by it share; all four NULL = none. give_leaves is called before each
    // meet: places of the leaves, m, area of each across the light, m2, and the edge of the voxels
    // that they need, m. After meet, carry_light makes the light of all leaves that were given when
    // this round of turns began: light is its share (0..1) on leaves at p, brightest the mean
    // direction to it, not unit. These two are called by many threads, until the next call of meet.
    bool (*give_leaves)(void *user, const Vec3 *leaf, int64_t count, float area, float cell,
                        Error *e);
    bool (*carry_light)(void *user, int threads, Error *e);
    float (*light)(const void *user, Vec3 p);
    Vec3 (*brightest)(const void *user, Vec3 p);
    void *user;
    RoomTrials *trials; // of all rivals; NULL = none
} Room;

// The trial of that key; NULL if there is none yet.
const Aabb *room_find_trial(const RoomTrials *trials, uint64_t key);
bool room_keep_trial(RoomTrials *trials, uint64_t key, Aabb reach, Error *e);

// The points that the room allows, as a new set with the same mean spacing.
PointSet *room_allowed_points(const Room *room, const PointSet *points, const Run *run, Error *e);

// Makes a child of `from` at *child keep out of taken space: turns its step toward free space,
// keeping the length. False if there is none. A child may be in taken space if its parent is deeper
// in it, so that growth can leave an obstacle that it starts in. normal: the step turns about this
// unit vector alone, which keeps it on a surface; zero = in any direction.
bool room_give_way(const Room *room, Vec3 from, Vec3 normal, Vec3 *child);

#endif
