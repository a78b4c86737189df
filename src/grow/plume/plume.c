#include "grow/plume/plume.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "base/turn.h"
#include "grow/plume/plume_free.h"

#include <stdlib.h>

enum { RIB = -1 };                                                       // order of ribs
enum { STREAM_ANGLE, STREAM_SKIP, STREAM_GAP, STREAM_LONG, STREAM_RIB }; // of a branch's key

static const float AHEAD_COS = 0.5f;   // attractors within 60 degrees of the heading draw a tip
static const float TURN_SHARE = 0.35f; // of the way to its direction that a step turns

// The end of a chain that grows.
typedef struct Tip {
    int32_t node;       // its last; -1 = the rib has not begun
    int32_t start;      // of a rib
    int32_t guide;      // of a branch: the node beside it of the chain that it left
    int order;          // RIB, 0 = barb, ...
    int bears;          // order of its branches
    Vec3 heading;       // unit
    float side;         // 1 = left of the chain that it left, -1 = right of it
    float foot;         // degrees: the angle at which it left
    float length, most; // m: so far, and at the end
    float since[2];     // m: since the last branch on each side
} Tip;

typedef struct Tips {
    Tip *tip;
    int64_t count, capacity;
} Tips;

typedef struct Plumes {
    const PlumeParams *params;
    const PlumeStart *start;
    int64_t start_count;
    OutTree *tree;
    int32_t *next; // per node: the one after it on its chain; -1 = none
    int64_t next_capacity;
    FreePlaces places;
    Tips now, later; // tips of this step and of the next one
    int32_t step;
} Plumes;

static bool add_tip(Tips *tips, const Tip *tip, Error *e)
{
    if (!memory_reserve(&tips->tip, &tips->capacity, tips->count + 1, sizeof *tips->tip, e)) {
        return false;
    }
    tips->tip[tips->count++] = *tip;
    return true;
}

static Vec3 project(const Plumes *plumes, Vec3 *p)
{
    Vec3 normal = vec3(0, 1, 0);
    plumes->params->project(plumes->params->surface, p, &normal);
    return normal;
}

static Vec3 tangent(Vec3 d, Vec3 normal)
{
    d = vec3_madd(d, -vec3_dot(d, normal), normal);
    float length = vec3_length(d);
    return length > 1e-12f ? vec3_scale(d, 1.0f / length) : vec3_perpendicular(normal);
}

// Appends a node; returns its index, or -1 and e.
static int32_t add_node(Plumes *plumes, Vec3 p, int32_t parent, int32_t colony, uint64_t id,
                        Error *e)
{
    Vec3 normal = project(plumes, &p);
    int64_t node = out_tree_add_node(plumes->tree, p, parent, plumes->step, colony, id, e);
    if (node < 0 ||
        !memory_reserve(&plumes->next, &plumes->next_capacity, node + 1, sizeof *plumes->next, e)) {
        return -1;
    }
    plumes->tree->normal[node] = normal;
    plumes->next[node] = -1;
    return (int32_t)node;
}

// A new chain has its first branches at different distances on both sides.
static void begin_spacing(const Plumes *plumes, Tip *tip, uint64_t key)
{
    for (int side = 0; side < 2 && tip->bears < plumes->params->orders; side++) {
        tip->since[side] = plumes->params->order[tip->bears].spacing *
                           random_unit(random_key(random_key(key, STREAM_GAP), (uint64_t)side));
    }
}

// Starts a branch beside the tip, by chance.
static bool add_branch(Plumes *plumes, const Tip *tip, int side, Error *e)
{
    const PlumeParams *params = plumes->params;
    const PlumeOrder *order = &params->order[tip->bears];
    uint64_t key = random_key(plumes->tree->id[tip->node], 16 + (uint64_t)side);
    if (random_unit(random_key(key, STREAM_SKIP)) < params->skip) {
        return true;
    }
    bool rib = tip->bears == 0 && random_unit(random_key(key, STREAM_RIB)) < params->side_rib;
    float most = (rib ? params->side_length : order->length) *
                 random_range(random_key(key, STREAM_LONG), 0.7f, 1.0f);
    float limit = order->taper * (tip->most - tip->length) + 2.0f * params->step;
    Tip branch = {.node = tip->node,
                  .start = tip->start,
                  .guide = tip->node,
                  .order = tip->bears,
                  .bears = rib ? 0 : tip->bears + 1,
                  .side = side == 0 ? 1.0f : -1.0f,
                  .foot =
                      order->angle + params->spread * random_normal(random_key(key, STREAM_ANGLE)),
                  .most = order->taper > 0.0f && limit < most ? limit : most};
    branch.heading =
        vec3_turn(tip->heading, plumes->tree->normal[tip->node], branch.side * branch.foot);
    begin_spacing(plumes, &branch, key);
    return add_tip(&plumes->later, &branch, e);
}

// Starts the branches that are due at the tip's new node.
static bool add_branches(Plumes *plumes, Tip *tip, Error *e)
{
    const PlumeParams *params = plumes->params;
    for (int side = 0; side < 2 && tip->bears < params->orders; side++) {
        tip->since[side] += params->step;
        if (tip->since[side] >= params->order[tip->bears].spacing) {
            tip->since[side] -= params->order[tip->bears].spacing;
            if (!add_branch(plumes, tip, side, e)) {
                return false;
            }
        }
    }
    return true;
}

static bool way_is_open(const Plumes *plumes, int32_t node, Vec3 *to)
{
    const Room *room = plumes->params->room;
    const OutTree *tree = plumes->tree;
    return !room || room_give_way(room, tree->position[node], tree->normal[node], to);
}

// Moves the tip's guide along the chain that it left to the node nearest to the tip; returns the
// direction of that chain there.
static Vec3 guide_direction(const Plumes *plumes, Tip *tip)
{
    const OutTree *tree = plumes->tree;
    Vec3 p = tree->position[tip->node];
    int32_t next = plumes->next[tip->guide];
    while (next >= 0 &&
           vec3_distance(tree->position[next], p) <= vec3_distance(tree->position[tip->guide], p)) {
        tip->guide = next;
        next = plumes->next[next];
    }
    int32_t before = tree->parent[tip->guide], from = before >= 0 ? before : tip->guide;
    int32_t to = next >= 0 ? next : tip->guide;
    return from == to ? tip->heading : vec3_sub(tree->position[to], tree->position[from]);
}

// The field X_f at a tip (Tanaka eq. (9)-(12)): of a rib, away from its start; of a branch, along
// the chain that it left; turned about the normal.
static Vec3 field_at(const Plumes *plumes, Tip *tip)
{
    const PlumeStart *start = &plumes->start[tip->start];
    Vec3 normal = plumes->tree->normal[tip->node];
    if (tip->order == RIB) {
        Vec3 away = vec3_sub(plumes->tree->position[tip->node], start->position);
        float turn = exact_atan2(start->turn * vec3_length(away), 1.0f);
        return vec3_turn(tangent(away, normal), normal, turn / RADIANS_PER_DEGREE);
    }
    const PlumeOrder *order = &plumes->params->order[tip->order];
    Vec3 along = tangent(guide_direction(plumes, tip), normal);
    float bent = order->curl * clampf(tip->length / order->length, 0.0f, 1.0f);
    return vec3_turn(along, normal, tip->side * (tip->foot - bent));
}

// The node of the tip's next step, or -1 if it ends, or on failure, which sets *failed.
static int32_t step_tip(Plumes *plumes, Tip *tip, bool *failed, Error *e)
{
    const PlumeParams *params = plumes->params;
    const OutTree *tree = plumes->tree;
    Vec3 normal = tree->normal[tip->node], pull;
    bool foot = tip->length == 0.0f;
    if (!foot) {
        tip->heading = tangent(vec3_lerp(tip->heading, field_at(plumes, tip), TURN_SHARE), normal);
    }
    if ((tip->order != RIB && tip->length + params->step > tip->most) ||
        free_places_pull(&plumes->places, tree, tip->node, tip->heading, AHEAD_COS, &pull) == 0) {
        return -1;
    }
    Vec3 drawn = foot ? vec3(0, 0, 0) : vec3_normalize(pull);            // it leaves at its angle
    Vec3 heading = vec3_madd(drawn, params->field_weight, tip->heading); // eq. (13)
    Vec3 p = vec3_madd(tree->position[tip->node], params->step, tangent(heading, normal));
    if (!way_is_open(plumes, tip->node, &p)) {
        return -1;
    }
    int64_t place = foot && tip->order != RIB ? 1 + (tip->side < 0.0f) : 0;
    int32_t node = add_node(plumes, p, tip->node, tree->colony[tip->node],
                            out_tree_child_id(tree->id[tip->node], place), e);
    *failed = node < 0;
    if (node >= 0 && place == 0) {
        plumes->next[tip->node] = node;
    }
    return node;
}

static bool grow_tip(Plumes *plumes, Tip *tip, Error *e)
{
    const PlumeParams *params = plumes->params;
    if (tip->order != RIB && plumes->step % params->order[tip->order].period != 0) {
        return add_tip(&plumes->later, tip, e);
    }
    bool failed = false;
    int32_t node = step_tip(plumes, tip, &failed, e);
    if (node < 0) {
        return !failed;
    }
    const OutTree *tree = plumes->tree;
    tip->heading =
        tangent(vec3_sub(tree->position[node], tree->position[tip->node]), tree->normal[node]);
    tip->node = node;
    tip->length += params->step;
    return add_branches(plumes, tip, e) && add_tip(&plumes->later, tip, e);
}

// Begins the ribs whose time has come, from number `first` on; returns the next one's number, or -1
// and e. The attractors see the new nodes in the next step.
static int64_t begin_ribs(Plumes *plumes, int64_t first, Error *e)
{
    for (; first < plumes->start_count && plumes->start[first].birth <= plumes->step; first++) {
        const PlumeStart *start = &plumes->start[first];
        uint64_t id = random_key(plumes->params->seed, (uint64_t)first);
        Tip tip = {.start = (int32_t)first, .order = RIB, .heading = start->heading};
        tip.node = add_node(plumes, start->position, -1, (int32_t)first, id, e);
        tip.most = INFINITY;
        begin_spacing(plumes, &tip, id);
        if (tip.node < 0 || !add_tip(&plumes->now, &tip, e)) {
            return -1;
        }
    }
    return first;
}

static bool grow_all(Plumes *plumes, const Run *run, Error *e)
{
    double attractors = (double)plumes->places.grid.alive + 1.0;
    int64_t begun = 0;
    while (plumes->now.count > 0 || begun < plumes->start_count) {
        begun = begin_ribs(plumes, begun, e);
        if (begun < 0 || !free_places_update(&plumes->places, plumes->tree, run, e)) {
            return false;
        }
        run_progress(run, "plumes", 1.0 - (double)plumes->places.grid.alive / attractors);
        plumes->step++;
        plumes->later.count = 0;
        for (int64_t i = 0; i < plumes->now.count; i++) {
            if (!grow_tip(plumes, &plumes->now.tip[i], e) || !run_goes_on(run, i, e)) {
                return false;
            }
        }
        Tips grown = plumes->now;
        plumes->now = plumes->later;
        plumes->later = grown;
    }
    return true;
}

bool plume_grow(OutTree *tree, const PlumeStart *start, int64_t count, const PointSet *attractors,
                const PlumeParams *params, const Run *run, Error *e)
{
    Plumes plumes = {.params = params, .start = start, .start_count = count, .tree = tree};
    PointSet *allowed = params->room ? room_allowed_points(params->room, attractors, run, e) : NULL;
    bool done = (allowed || !params->room) &&
                free_places_init(&plumes.places, allowed ? allowed : attractors, params->influence,
                                 params->kill, params->room, run, e) &&
                grow_all(&plumes, run, e);
    free_places_clear(&plumes.places);
    points_free(allowed);
    free(plumes.next);
    free(plumes.now.tip);
    free(plumes.later.tip);
    return done;
}
