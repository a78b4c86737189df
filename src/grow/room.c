#include "grow/room.h"

#include "base/memory.h"

enum { MOST_TURNS = 4 };   // of a step toward free space
enum { MOST_PROBES = 16 }; // of a step's way

// Is the way from -> to free, or does it at least lead out? A step is probed at intervals of the
// clearance found, so thin obstacles are not jumped over.
static bool way_is_free(const Room *room, Vec3 from, float at_start, Vec3 to)
{
    Vec3 away;
    float length = vec3_distance(from, to), done = 0.0f;
    float least = at_start < 0.0f ? at_start : 0.0f;
    for (int i = 0; i < MOST_PROBES && done < length; i++) {
        float clearance = room->clearance(room->user, vec3_lerp(from, to, done / length), &away);
        if (clearance < least) {
            return false;
        }
        float shortest = length / (float)MOST_PROBES;
        done += clearance > shortest ? clearance : shortest;
    }
    float clearance = room->clearance(room->user, to, &away);
    return clearance >= 0.0f || clearance > at_start;
}

// The step turned toward free space: `share` of what leads into taken space is removed, and the
// rest, along its border, stretched to the old length. False if nothing is left.
static bool turn_aside(const Room *room, Vec3 from, Vec3 normal, float share, Vec3 *child)
{
    Vec3 away, step = vec3_sub(*child, from);
    float depth = -room->clearance(room->user, *child, &away), length = vec3_length(step);
    away = vec3_madd(away, -vec3_dot(away, normal), normal);
    if (!(vec3_dot(away, away) > 0.0f)) {
        return false;
    }
    away = vec3_normalize(away);
    float inward = -vec3_dot(step, away);
    float push = (inward > 0.0f ? share * inward : 0.0f) + (depth > 0.0f ? 0.25f * depth : 0.0f);
    step = vec3_madd(step, push, away);
    if (!(vec3_length(step) > 1e-3f * length)) {
        return false;
    }
    *child = vec3_madd(from, length, vec3_normalize(step));
    return true;
}

bool room_give_way(const Room *room, Vec3 from, Vec3 normal, Vec3 *child)
{
    Vec3 away;
    float at_start = room->clearance(room->user, from, &away);
    for (int turn = 1; turn <= MOST_TURNS; turn++) {
        if (way_is_free(room, from, at_start, *child)) {
            return true;
        }
        if (!turn_aside(room, from, normal, (float)turn / (float)MOST_TURNS, child)) {
            return false;
        }
    }
    return way_is_free(room, from, at_start, *child);
}

PointSet *room_allowed_points(const Room *room, const PointSet *points, const Run *run, Error *e)
{
    PointSet *allowed = points_new(e);
    for (int64_t i = 0; allowed && i < points->count; i++) {
        bool taken = !room->allows(room->user, points->position[i]);
        if (!run_goes_on(run, i, e) ||
            (!taken &&
             !points_add(allowed, points->position[i], points->normal[i], points->id[i], e))) {
            points_free(allowed);
            return NULL;
        }
    }
    if (allowed) {
        double share = points->count > 0 ? (double)allowed->count / (double)points->count : 1.0;
        allowed->measure = points->measure * share;
        allowed->dimension = points->dimension;
    }
    return allowed;
}

const Aabb *room_find_trial(const RoomTrials *trials, uint64_t key)
{
    for (int64_t i = 0; i < trials->count; i++) {
        if (trials->trial[i].key == key) {
            return &trials->trial[i].reach;
        }
    }
    return NULL;
}

bool room_keep_trial(RoomTrials *trials, uint64_t key, Aabb reach, Error *e)
{
    if (!memory_reserve(&trials->trial, &trials->capacity, trials->count + 1, sizeof *trials->trial,
                        e)) {
        return false;
    }
    trials->trial[trials->count++] = (RoomTrial){key, reach};
    return true;
}
