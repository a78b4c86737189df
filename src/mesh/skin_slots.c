#include "mesh/skin_slots.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

#define QUARTER (0.5f * PI_F)

// A stretch of a chain between two rings, made for one child and shared with others that leave
// through other faces.
typedef struct SkinSlot {
    float low, high; // m along the axis
    float turn;      // radians: face 0 looks that far round from the axis' side
    int32_t child[4];
} SkinSlot;

// What a child asks for.
typedef struct SlotWish {
    int32_t child;
    float centre, height; // m along the axis
    float azimuth;        // radians round from the axis' side
    float radius;         // m, of the parent there
} SlotWish;

// The stretch of the axis that is to be a tube.
typedef struct TubeRange {
    float low, high;
} TubeRange;

void skin_slots_clear(SkinSlots *slots)
{
    free(slots->station);
    free(slots->slot);
    free(slots->child);
}

// ---- wishes ----

// The face must hold the child's own square, elongated when the child leaves at a slant.
static float slot_height(const SkinPlan *plan, const SkinChain *child, float parent_radius)
{
    float radius = skin_axis_at(plan, (int32_t)(child - plan->chain), child->start).radius;
    float slant = 1.0f / clampf(child->exit_sine, 0.5f, 1.0f);
    float height = 2.6f * radius * slant, least = 0.5f * plan->params.ring_spacing * parent_radius;
    return height > least ? height : least;
}

static SlotWish make_wish(const SkinPlan *plan, int32_t chain, int32_t number, TubeRange range)
{
    const SkinChain *child = &plan->chain[number];
    SkinPoint at = skin_axis_at(plan, chain, child->exit_on_parent);
    Vec3 across = vec3_cross(at.tangent, at.side);
    float height = slot_height(plan, child, at.radius), room = range.high - range.low;
    height = height < room ? height : room;
    float centre =
        clampf(child->exit_on_parent, range.low + 0.5f * height, range.high - 0.5f * height);
    return (SlotWish){.child = number,
                      .centre = centre,
                      .height = height,
                      .azimuth = exact_atan2(vec3_dot(child->exit_side, across),
                                             vec3_dot(child->exit_side, at.side)),
                      .radius = at.radius};
}

// ---- placing ----

// Distance of x from the nearest multiple of a full turn, signed.
static float wrap_turn(float x)
{
    while (x > PI_F) {
        x -= 2.0f * PI_F;
    }
    while (x < -PI_F) {
        x += 2.0f * PI_F;
    }
    return x;
}

// The free face of a slot that looks most nearly where the child goes, or -1; *misfit in radians.
static int best_face(const SkinSlot *slot, float azimuth, float *misfit)
{
    int best = -1;
    *misfit = INFINITY;
    for (int f = 0; f < 4; f++) {
        float off = fabsf(wrap_turn(azimuth - slot->turn - (float)f * QUARTER));
        if (slot->child[f] < 0 && off < *misfit) {
            *misfit = off;
            best = f;
        }
    }
    return best;
}

static bool insert_slot(SkinSlots *slots, int64_t at, SkinSlot slot, Error *e)
{
    if (!memory_reserve(&slots->slot, &slots->slot_capacity, slots->slot_count + 1,
                        sizeof(SkinSlot), e)) {
        return false;
    }
    memmove(slots->slot + at + 1, slots->slot + at,
            (size_t)(slots->slot_count - at) * sizeof(SkinSlot));
    slots->slot[at] = slot;
    slots->slot_count++;
    return true;
}

static SkinSlot slot_for(const SlotWish *wish, float low, float high)
{
    return (SkinSlot){
        .low = low, .high = high, .turn = wish->azimuth, .child = {wish->child, -1, -1, -1}};
}

// Ways to seat a child, and what each costs: radians of misfit or parent radii of displacement.
typedef struct Seat {
    float cost;
    int64_t slot; // join this slot (face >= 0), or make a new one before it (face -1)
    int face;
    float low, high;
} Seat;

static void consider_joining(const SkinSlots *slots, const SlotWish *wish, int64_t i, Seat *best)
{
    const SkinSlot *slot = &slots->slot[i];
    float misfit, height = slot->high - slot->low;
    int face = best_face(slot, wish->azimuth, &misfit);
    float away = fabsf(0.5f * (slot->low + slot->high) - wish->centre);
    float tight = height < 0.7f * wish->height ? wish->height / height : 0.0f;
    float cost = away / wish->radius + misfit * misfit + tight;
    if (face >= 0 && cost < best->cost) {
        *best = (Seat){.cost = cost, .slot = i, .face = face};
    }
}

// The gap before slot i.
static void consider_gap(const SkinSlots *slots, const SlotWish *wish, int64_t i, TubeRange range,
                         Seat *best)
{
    float low = i > 0 ? slots->slot[i - 1].high : range.low;
    float high = i < slots->slot_count ? slots->slot[i].low : range.high;
    float height = wish->height < high - low ? wish->height : high - low;
    if (!(height > 0.0f) || height < 0.5f * wish->height) {
        return;
    }
    float centre = clampf(wish->centre, low + 0.5f * height, high - 0.5f * height);
    float cost =
        fabsf(centre - wish->centre) / wish->radius + 2.0f * (1.0f - height / wish->height);
    if (cost < best->cost) {
        *best = (Seat){.cost = cost,
                       .slot = i,
                       .face = -1,
                       .low = centre - 0.5f * height,
                       .high = centre + 0.5f * height};
    }
}

// Halves the tallest slot and gives the child a face of the new half.
static bool split_slot(SkinSlots *slots, const SlotWish *wish, Error *e)
{
    int64_t tallest = 0;
    for (int64_t i = 1; i < slots->slot_count; i++) {
        if (slots->slot[i].high - slots->slot[i].low >
            slots->slot[tallest].high - slots->slot[tallest].low) {
            tallest = i;
        }
    }
    SkinSlot *slot = &slots->slot[tallest];
    float middle = 0.5f * (slot->low + slot->high), high = slot->high;
    slot->high = middle;
    return insert_slot(slots, tallest + 1, slot_for(wish, middle, high), e);
}

static bool seat_child(SkinSlots *slots, const SlotWish *wish, TubeRange range, Error *e)
{
    Seat best = {.cost = INFINITY, .slot = -1};
    for (int64_t i = 0; i <= slots->slot_count; i++) {
        consider_gap(slots, wish, i, range, &best);
        if (i < slots->slot_count) {
            consider_joining(slots, wish, i, &best);
        }
    }
    if (best.slot < 0) {
        return split_slot(slots, wish, e);
    }
    if (best.face < 0) {
        return insert_slot(slots, best.slot, slot_for(wish, best.low, best.high), e);
    }
    slots->slot[best.slot].child[best.face] = wish->child;
    return true;
}

// Thick children choose first.
static void sort_children(SkinSlots *slots, const SkinPlan *plan)
{
    for (int64_t i = 1; i < slots->child_count; i++) {
        int32_t moving = slots->child[i];
        float radius = plan->point[plan->chain[moving].axis].radius;
        int64_t j = i;
        while (j > 0 && plan->point[plan->chain[slots->child[j - 1]].axis].radius < radius) {
            slots->child[j] = slots->child[j - 1];
            j--;
        }
        slots->child[j] = moving;
    }
}

// ---- rings ----

// Slots that almost touch come to share a ring.
static void close_small_gaps(SkinSlots *slots, const SkinPlan *plan, int32_t chain, TubeRange range)
{
    float spacing = plan->params.ring_spacing;
    for (int64_t i = 0; i <= slots->slot_count; i++) {
        SkinSlot *before = i > 0 ? &slots->slot[i - 1] : NULL;
        SkinSlot *after = i < slots->slot_count ? &slots->slot[i] : NULL;
        float low = before ? before->high : range.low, high = after ? after->low : range.high;
        float radius = skin_axis_at(plan, chain, low).radius;
        if (high - low < 0.35f * spacing * radius) {
            float meet = before ? (after ? 0.5f * (low + high) : high) : low;
            if (before) {
                before->high = meet;
            }
            if (after) {
                after->low = meet;
            }
        }
    }
}

// Turns slots' faces towards their children only as far as the tube between can twist, half a
// radian a radius; each slot's turn becomes what it gets.
static void limit_twist(SkinSlots *slots, const SkinPlan *plan, int32_t chain, float start,
                        float phase)
{
    float twist = phase, place = start;
    for (int64_t i = 0; i < slots->slot_count; i++) {
        SkinSlot *slot = &slots->slot[i];
        float middle = 0.5f * (slot->low + slot->high);
        float radius = skin_axis_at(plan, chain, middle).radius;
        float limit = 0.5f * (middle - place) / radius;
        float wanted = wrap_turn(slot->turn - twist);
        int quarters = (int)floorf(wanted / QUARTER + 0.5f);
        float change = clampf(wanted - (float)quarters * QUARTER, -limit, limit);
        // Face f looked to turn + 90 f; after a change by whole quarters the names move round.
        int32_t renamed[4];
        for (int f = 0; f < 4; f++) {
            renamed[(f + quarters) & 3] = slot->child[f];
        }
        memcpy(slot->child, renamed, sizeof renamed);
        twist = wrap_turn(twist + change);
        slot->turn = twist;
        place = middle;
    }
}

static bool add_station(SkinSlots *slots, float along, float twist, Error *e)
{
    if (!memory_reserve(&slots->station, &slots->station_capacity, slots->station_count + 1,
                        sizeof(SkinStation), e)) {
        return false;
    }
    slots->station[slots->station_count++] = (SkinStation){along, twist, {-1, -1, -1, -1}};
    return true;
}

// How far apart rings stand here: ring_spacing radii on thick wood and in bends, up to three times
// as far on thin straight twigs, whose cage would otherwise outweigh all the rest.
static float ring_step(const SkinPlan *plan, int32_t chain, float along)
{
    SkinPoint here = skin_axis_at(plan, chain, along);
    float reach = 2.0f * here.radius;
    SkinPoint ahead = skin_axis_at(plan, chain, along + reach);
    Vec3 bend = vec3_sub(ahead.tangent, here.tangent);
    float thin = 1.0f - smoothstepf(0.05f, 0.3f, here.radius / plan->thickest);
    float straight = 1.0f / (1.0f + 25.0f * vec3_dot(bend, bend));
    float step = plan->params.ring_spacing * here.radius * (1.0f + 2.0f * thin * straight);
    const SkinChain *c = &plan->chain[chain];
    float length = plan->point[c->axis + c->samples - 1].along;
    float least = length / (float)(8 * c->count + 64);
    return step > least ? step : least;
}

// Rings strictly between two places, evenly in units of the step.
static bool fill_gap(SkinSlots *slots, const SkinPlan *plan, int32_t chain, SkinStation from,
                     SkinStation to, Error *e)
{
    float steps = 0.0f;
    for (float at = from.along; at < to.along;) {
        float step = ring_step(plan, chain, at);
        steps += at + step < to.along ? 1.0f : (to.along - at) / step;
        at += step;
    }
    int count = (int)floorf(steps + 0.5f);
    float share = count > 0 ? steps / (float)count : 0.0f, at = from.along;
    for (int i = 1; i < count; i++) {
        at += share * ring_step(plan, chain, at);
        float t = (at - from.along) / (to.along - from.along);
        if (t < 0.98f &&
            !add_station(slots, at, from.twist + t * wrap_turn(to.twist - from.twist), e)) {
            return false;
        }
    }
    return true;
}

static bool place_stations(SkinSlots *slots, const SkinPlan *plan, int32_t chain, TubeRange range,
                           float start, float phase, Error *e)
{
    slots->station_count = 0;
    SkinStation last = {.along = start, .twist = phase};
    if (!add_station(slots, start, phase, e)) {
        return false;
    }
    for (int64_t i = 0; i < slots->slot_count; i++) {
        const SkinSlot *slot = &slots->slot[i];
        if (slot->low > last.along) {
            SkinStation next = {.along = slot->low, .twist = slot->turn};
            if (!fill_gap(slots, plan, chain, last, next, e) ||
                !add_station(slots, next.along, next.twist, e)) {
                return false;
            }
        }
        memcpy(slots->station[slots->station_count - 1].child, slot->child, sizeof slot->child);
        last = (SkinStation){.along = slot->high, .twist = slot->turn};
        if (!add_station(slots, last.along, last.twist, e)) {
            return false;
        }
    }
    if (range.high <= last.along) {
        return true;
    }
    SkinStation end = {.along = range.high, .twist = last.twist};
    return fill_gap(slots, plan, chain, last, end, e) &&
           add_station(slots, end.along, end.twist, e);
}

// The tube's ends: a root starts, and every chain ends, a little beyond its last node, because the
// limit surface draws back from a closed end.
static TubeRange tube_range(const SkinSlots *slots, const SkinPlan *plan, int32_t number)
{
    const SkinChain *chain = &plan->chain[number];
    const SkinPoint *first = &plan->point[chain->axis];
    const SkinPoint *last = first + chain->samples - 1;
    TubeRange range = {chain->parent >= 0 ? chain->start : 0.0f, last->along};
    float longest = chain->parent < 0 && range.high <= range.low ? 0.2f * last->radius : 0.0f;
    for (int64_t i = 0; i < slots->child_count; i++) {
        const SkinChain *child = &plan->chain[slots->child[i]];
        float height = slot_height(plan, child, last->radius);
        longest = height > longest ? height : longest;
    }
    longest = longest < 2.5f * last->radius ? longest : 2.5f * last->radius;
    float room = range.high - range.low;
    range.high += 0.5f * last->radius;
    if (room < longest) {
        range.high = range.low + longest;
    }
    return range;
}

bool skin_slots_place(SkinSlots *slots, const SkinPlan *plan, int32_t chain, float phase, Error *e)
{
    TubeRange range = tube_range(slots, plan, chain);
    slots->slot_count = 0;
    sort_children(slots, plan);
    for (int64_t i = 0; i < slots->child_count; i++) {
        SlotWish wish = make_wish(plan, chain, slots->child[i], range);
        if (!seat_child(slots, &wish, range, e)) {
            return false;
        }
    }
    close_small_gaps(slots, plan, chain, range);
    float start = range.low;
    if (plan->chain[chain].parent < 0) {
        start -= 0.9f * plan->point[plan->chain[chain].axis].radius;
    }
    limit_twist(slots, plan, chain, start, phase);
    return place_stations(slots, plan, chain, range, start, phase, e);
}
