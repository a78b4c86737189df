#include "objects/vessels/room.h"

#include "grow/room.h"

#include <stddef.h>

VesselRoom vessel_room(const VesselBed *bed, const VesselTree *tree, const SegmentGrid *others,
                       float gap)
{
    return (VesselRoom){.tree = tree,
                        .envelope = bed->envelope,
                        .others = others,
                        .taken = bed->recipe->room,
                        .most_inset = 0.9f * envelope_band(bed->envelope),
                        .gap = gap};
}

static bool is_clear(const Room *room, Vec3 a, Vec3 b)
{
    Vec3 away;
    float at_end = room->clearance(room->user, b, &away);
    float half_way = room->clearance(room->user, vec3_lerp(a, b, 0.5f), &away);
    return (at_end >= 0.0f && half_way >= 0.0f) || at_end > room->clearance(room->user, a, &away);
}

bool vessel_room_is_inside(const VesselRoom *room, Vec3 a, Vec3 b, float radius)
{
    float inset = radius < room->most_inset ? radius : room->most_inset;
    return envelope_distance(room->envelope, b) <= -inset &&
           envelope_distance(room->envelope, vec3_lerp(a, b, 0.5f)) <= -inset &&
           (!room->taken || is_clear(room->taken, a, b));
}

bool vessel_room_is_free(const VesselRoom *room, Vec3 a, Vec3 b, float radius)
{
    return vessel_room_is_inside(room, a, b, radius) &&
           !(room->others && segment_grid_touches(room->others, a, b, radius + room->gap, 0.0f));
}

// MurrayAllowed: stems stay where they are.
static bool may_turn_to(void *user, int64_t node, Vec3 from, Vec3 to)
{
    const VesselRoom *room = user;
    const OutTree *tree = room->tree->tree;
    float radius = tree->radius[node];
    if (node < room->tree->stem_count) {
        return vec3_distance(tree->position[node], to) < 1e-3f * radius;
    }
    return vessel_room_is_free(room, from, to, radius);
}

bool vessel_room_turn(VesselBed *bed, const VesselRoom *room, Error *e)
{
    MurrayReport report;
    if (!bed->params->turn) {
        return true;
    }
    if (!out_tree_murray_turn(room->tree->tree, may_turn_to, (void *)room, NULL, &report, e)) {
        return false;
    }
    bed->turned.forks += report.forks;
    bed->turned.exact += report.exact;
    bed->turned.reduced += report.reduced;
    bed->turned.multiple += report.multiple;
    return true;
}

bool vessel_room_bend(VesselBed *bed, const VesselRoom *room, Error *e)
{
    return !bed->params->turn ||
           out_tree_murray_bend(room->tree->tree, may_turn_to, (void *)room, e);
}
