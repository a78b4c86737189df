// Smooth axes for chains of out-tree nodes.
#include "base/memory.h"
#include "skin/plan.h"

// ---- relaxed chain nodes ----

static bool gather_nodes(SkinPlan *plan, const SkinChain *chain, int64_t *count, Error *e)
{
    const OutTree *tree = plan->tree;
    int64_t extra = chain->parent >= 0 ? 1 : 0;
    *count = chain->count + extra;
    if (!memory_reserve(&plan->raw, &plan->raw_capacity, *count, sizeof(SkinNode), e)) {
        return false;
    }
    for (int64_t i = 0; i < chain->count; i++) {
        int32_t node = plan->node[chain->first + i];
        float radius = tree->radius[node];
        plan->raw[extra + i] =
            (SkinNode){.position = tree->position[node],
                       .radius = radius > plan->least_radius ? radius : plan->least_radius,
                       .birth = clampf((float)tree->birth[node] * plan->birth_scale, 0.0f, 1.0f)};
    }
    if (extra) {
        plan->raw[0] = plan->raw[1];
        plan->raw[0].position = skin_axis_at(plan, chain->parent, chain->attach).position;
    }
    return true;
}

static void relax_nodes(SkinNode *node, int64_t count, int passes)
{
    for (int pass = 0; pass < passes; pass++) {
        Vec3 before = node[0].position;
        for (int64_t i = 1; i < count - 1; i++) {
            Vec3 middle = vec3_lerp(before, node[i + 1].position, 0.5f);
            before = node[i].position;
            node[i].position = vec3_lerp(before, middle, 0.5f);
        }
    }
}

static void measure_nodes(SkinNode *node, int64_t count)
{
    node[0].along = 0.0f;
    for (int64_t i = 1; i < count; i++) {
        node[i].along = node[i - 1].along + vec3_distance(node[i - 1].position, node[i].position);
    }
}

// ---- filtering ----

// Point of the polyline through the nodes at an arc length from its start. *k is the segment of the
// last call.
static SkinNode polyline_at(const SkinNode *node, int64_t count, float along, int64_t *k)
{
    while (*k > 0 && node[*k].along > along) {
        --*k;
    }
    while (*k < count - 2 && node[*k + 1].along <= along) {
        ++*k;
    }
    if (count == 1) {
        return node[0];
    }
    const SkinNode *a = &node[*k], *b = a + 1;
    float length = b->along - a->along;
    float t = length > 0.0f ? clampf((along - a->along) / length, 0.0f, 1.0f) : 1.0f;
    return (SkinNode){vec3_lerp(a->position, b->position, t), along, lerpf(a->radius, b->radius, t),
                      lerpf(a->birth, b->birth, t)};
}

// The polyline, extended beyond its ends by point reflection, so that filtering leaves the ends in
// place.
static SkinNode reflected_at(const SkinNode *node, int64_t count, float along, int64_t *k)
{
    float length = node[count - 1].along;
    if (along >= 0.0f && along <= length) {
        return polyline_at(node, count, along, k);
    }
    float mirrored = clampf(along < 0.0f ? -along : 2.0f * length - along, 0.0f, length);
    SkinNode end = node[along < 0.0f ? 0 : count - 1];
    SkinNode inside = polyline_at(node, count, mirrored, k);
    inside.position = vec3_sub(vec3_scale(end.position, 2.0f), inside.position);
    return inside;
}

// Tent filter of half width w.
static SkinNode filtered_at(const SkinNode *node, int64_t count, float along, float w, int64_t *k)
{
    enum { TAPS = 5 }; // on either side of the centre
    SkinNode sum = {.along = along};
    float total = 0.0f;
    for (int i = -TAPS; i <= TAPS; i++) {
        float x = (float)i / (float)(TAPS + 1);
        float weight = 1.0f - fabsf(x);
        SkinNode tap = reflected_at(node, count, along + x * w, k);
        sum.position = vec3_madd(sum.position, weight, tap.position);
        sum.radius += weight * tap.radius;
        sum.birth += weight * tap.birth;
        total += weight;
    }
    sum.position = vec3_scale(sum.position, 1.0f / total);
    sum.radius /= total;
    sum.birth /= total;
    return sum;
}

static bool add_point(SkinPlan *plan, const SkinNode *node, Error *e)
{
    if (!memory_reserve(&plan->point, &plan->point_capacity, plan->point_count + 1,
                        sizeof(SkinPoint), e)) {
        return false;
    }
    plan->point[plan->point_count++] = (SkinPoint){.position = node->position,
                                                   .along = node->along,
                                                   .radius = node->radius,
                                                   .birth = node->birth};
    return true;
}

// Samples the filtered polyline about every half radius; `along` is still the polyline's arc
// length.
static bool sample_axis(SkinPlan *plan, SkinChain *chain, int64_t count, Error *e)
{
    const SkinNode *node = plan->raw;
    float length = node[count - 1].along;
    // Limits the number of samples of very thin chains.
    float least_step = length / (float)(8 * count + 64);
    int64_t k = 0, at = 0;
    chain->axis = plan->point_count;
    for (float along = 0.0f;;) {
        float radius = polyline_at(node, count, along, &at).radius;
        float step = 0.5f * radius;
        step = step > least_step ? step : least_step;
        float width = 1.2f * radius > 2.0f * step ? 1.2f * radius : 2.0f * step;
        SkinNode sample = filtered_at(node, count, along, width, &k);
        if (!add_point(plan, &sample, e)) {
            return false;
        }
        if (!(along < length)) {
            break;
        }
        float next = along + step; // no more than along, if the chain has millions of nodes
        along = next > along && along + 1.5f * step < length ? next : length;
    }
    chain->samples = plan->point_count - chain->axis;
    return true;
}

// A tube cannot bend more tightly than its own radius: samples where the axis has a bend radius
// below 1.4 radii are pulled toward their neighbours until none remain, or a number of passes is
// reached.
static void soften_bends(SkinPoint *point, int64_t count)
{
    bool bent = true;
    for (int pass = 0; bent && pass < 80; pass++) {
        bent = false;
        for (int64_t i = 1; i + 1 < count; i++) {
            Vec3 before = vec3_sub(point[i].position, point[i - 1].position);
            Vec3 after = vec3_sub(point[i + 1].position, point[i].position);
            float length = 0.5f * (vec3_length(before) + vec3_length(after));
            Vec3 turn = vec3_sub(vec3_normalize(after), vec3_normalize(before));
            if (vec3_length(turn) * 1.4f * point[i].radius > length) {
                Vec3 middle = vec3_lerp(point[i - 1].position, point[i + 1].position, 0.5f);
                point[i].position = vec3_lerp(point[i].position, middle, 0.7f);
                bent = true;
            }
        }
    }
}

// ---- frames ----

static void set_tangents(SkinPoint *point, int64_t count, Vec3 fallback)
{
    for (int64_t i = 0; i < count; i++) {
        int64_t a = i > 2 ? i - 2 : 0, b = i + 2 < count ? i + 2 : count - 1;
        Vec3 along = vec3_sub(point[b].position, point[a].position);
        Vec3 unit = vec3_normalize(along);
        bool fine = vec3_length(along) > 0.05f * point[i].radius && vec3_finite(unit);
        point[i].tangent = fine ? unit : (i > 0 ? point[i - 1].tangent : fallback);
    }
}

// Double reflection (Wang 2008): the next side of a rotation-minimising frame.
static Vec3 transport_side(const SkinPoint *from, const SkinPoint *to)
{
    Vec3 step = vec3_sub(to->position, from->position);
    float length2 = vec3_dot(step, step);
    Vec3 side = from->side, tangent = from->tangent;
    if (length2 > 0.0f) {
        side = vec3_madd(side, -2.0f * vec3_dot(step, side) / length2, step);
        tangent = vec3_madd(tangent, -2.0f * vec3_dot(step, tangent) / length2, step);
    }
    Vec3 turn = vec3_sub(to->tangent, tangent);
    float turn2 = vec3_dot(turn, turn);
    if (turn2 > 1e-12f) {
        side = vec3_madd(side, -2.0f * vec3_dot(turn, side) / turn2, turn);
    }
    side = vec3_normalize(vec3_madd(side, -vec3_dot(side, to->tangent), to->tangent));
    bool fine = vec3_dot(side, side) > 0.5f && vec3_finite(side);
    return fine ? side : vec3_perpendicular(to->tangent);
}

// Sets the frames (tangent and side) of an axis with known positions.
static void turn_frames(SkinPoint *point, int64_t count, Vec3 fallback_tangent)
{
    set_tangents(point, count, fallback_tangent);
    point[0].side = vec3_perpendicular(point[0].tangent);
    for (int64_t i = 1; i < count; i++) {
        point[i].side = transport_side(&point[i - 1], &point[i]);
    }
}

// ---- folds ----

// First sample about which the axis folds back on itself, or -1.
static int64_t find_fold(const SkinPoint *point, int64_t count)
{
    enum { REACH = 3 }; // samples, about a radius and a half
    for (int64_t i = REACH; i + REACH < count; i++) {
        if (vec3_dot(point[i - REACH].tangent, point[i + REACH].tangent) < -0.5f) {
            // The apex is the sharpest bend.
            int64_t apex = i;
            float sharpest = 1.0f;
            for (int64_t j = i; j < i + 2 * REACH && j + 1 < count; j++) {
                float dot = vec3_dot(point[j - 1].tangent, point[j + 1].tangent);
                if (dot < sharpest) {
                    sharpest = dot;
                    apex = j;
                }
            }
            return apex;
        }
    }
    return -1;
}

// Cuts the chain after the node nearest to `along`; the rest becomes a child. False without an
// error (*cut = false) if no node lies between.
static bool cut_chain(SkinPlan *plan, int32_t number, float along, int64_t count, bool *cut,
                      Error *e)
{
    SkinChain *chain = &plan->chain[number];
    int64_t extra = count - chain->count, keep = 1;
    while (keep < chain->count - 1 && plan->raw[extra + keep - 1].along < along) {
        keep++;
    }
    *cut = chain->count >= 2;
    if (!*cut) {
        return true;
    }
    if (!memory_reserve(&plan->chain, &plan->chain_capacity, plan->chain_count + 1,
                        sizeof(SkinChain), e)) {
        return false;
    }
    chain = &plan->chain[number];
    int32_t rest = (int32_t)plan->chain_count++;
    plan->chain[rest] = (SkinChain){.base = plan->node[chain->first + keep - 1],
                                    .parent = number,
                                    .first = chain->first + keep,
                                    .count = chain->count - keep,
                                    .first_child = -1,
                                    .next_sibling = -1};
    for (int64_t i = keep; i < chain->count; i++) {
        plan->chain_of[plan->node[chain->first + i]] = rest;
    }
    chain->count = keep;
    // Redistributes the children.
    int32_t child = chain->first_child;
    chain->first_child = rest;
    while (child >= 0) {
        SkinChain *moved = &plan->chain[child];
        int32_t next = moved->next_sibling, owner = plan->chain_of[moved->base];
        moved->next_sibling = plan->chain[owner].first_child;
        if (owner == number) { // `rest` stays the head of the list
            moved->next_sibling = plan->chain[rest].next_sibling;
            plan->chain[rest].next_sibling = child;
        } else {
            plan->chain[owner].first_child = child;
        }
        child = next;
    }
    return true;
}

// ---- complete axes ----

// Converts polyline arc lengths to axis arc lengths and sets where each child starts.
static void measure_axis(SkinPlan *plan, const SkinChain *chain, int64_t count)
{
    SkinPoint *point = plan->point + chain->axis;
    int64_t extra = count - chain->count, s = 0;
    float before = 0.0f, length = 0.0f; // polyline and axis arc length at sample s
    for (int64_t i = 0; i < count; i++) {
        while (s + 1 < chain->samples && point[s + 1].along < plan->raw[i].along) {
            length += vec3_distance(point[s].position, point[s + 1].position);
            before = point[++s].along;
        }
        float t = 0.0f;
        if (s + 1 < chain->samples && point[s + 1].along > before) {
            t = clampf((plan->raw[i].along - before) / (point[s + 1].along - before), 0.0f, 1.0f);
            t *= vec3_distance(point[s].position, point[s + 1].position);
        }
        plan->raw[i].along = length + t;
    }
    point[0].along = 0.0f;
    for (int64_t i = 1; i < chain->samples; i++) {
        point[i].along =
            point[i - 1].along + vec3_distance(point[i - 1].position, point[i].position);
    }
    for (int32_t i = chain->first_child; i >= 0; i = plan->chain[i].next_sibling) {
        int64_t place = plan->place[plan->chain[i].base] - chain->first;
        plan->chain[i].attach = plan->raw[extra + place].along;
    }
}

// Direction of a chain of zero length.
static Vec3 default_tangent(const SkinPlan *plan, const SkinChain *chain)
{
    if (chain->parent >= 0) {
        return skin_axis_at(plan, chain->parent, chain->attach).tangent;
    }
    Vec3 normal = vec3_normalize(plan->tree->normal[plan->node[chain->first]]);
    return vec3_dot(normal, normal) > 0.5f ? normal : vec3(0, 1, 0);
}

bool skin_plan_axis(SkinPlan *plan, int32_t number, Error *e)
{
    for (;;) {
        SkinChain *chain = &plan->chain[number];
        int64_t count;
        if (!gather_nodes(plan, chain, &count, e)) {
            return false;
        }
        relax_nodes(plan->raw, count, plan->params.smoothing);
        measure_nodes(plan->raw, count);
        if (!sample_axis(plan, chain, count, e)) {
            return false;
        }
        SkinPoint *point = plan->point + chain->axis;
        soften_bends(point, chain->samples);
        turn_frames(point, chain->samples, default_tangent(plan, chain));
        int64_t fold = find_fold(point, chain->samples);
        bool cut = false;
        if (fold >= 0 && !cut_chain(plan, number, point[fold].along, count, &cut, e)) {
            return false;
        }
        if (!cut) {
            measure_axis(plan, &plan->chain[number], count);
            return true;
        }
        plan->point_count = plan->chain[number].axis;
    }
}

// ---- queries ----

int64_t skin_axis_sample(const SkinPlan *plan, int32_t number, float along)
{
    const SkinChain *chain = &plan->chain[number];
    const SkinPoint *point = plan->point + chain->axis;
    int64_t low = 0, high = chain->samples - 1;
    while (high - low > 1) {
        int64_t middle = low + (high - low) / 2;
        if (point[middle].along <= along) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

SkinPoint skin_axis_at(const SkinPlan *plan, int32_t number, float along)
{
    const SkinChain *chain = &plan->chain[number];
    const SkinPoint *point = plan->point + chain->axis;
    const SkinPoint *last = &point[chain->samples - 1];
    if (along <= 0.0f || along >= last->along) {
        SkinPoint end = along <= 0.0f ? point[0] : *last;
        end.position = vec3_madd(end.position, along - end.along, end.tangent);
        end.along = along;
        return end;
    }
    const SkinPoint *a = &point[skin_axis_sample(plan, number, along)], *b = a + 1;
    float t = b->along > a->along ? (along - a->along) / (b->along - a->along) : 0.0f;
    SkinPoint p = {.position = vec3_lerp(a->position, b->position, t),
                   .tangent = vec3_normalize(vec3_lerp(a->tangent, b->tangent, t)),
                   .along = along,
                   .radius = lerpf(a->radius, b->radius, t),
                   .birth = lerpf(a->birth, b->birth, t)};
    if (vec3_dot(p.tangent, p.tangent) < 0.5f) {
        p.tangent = a->tangent;
    }
    Vec3 side = vec3_lerp(a->side, b->side, t);
    side = vec3_normalize(vec3_madd(side, -vec3_dot(side, p.tangent), p.tangent));
    p.side = vec3_dot(side, side) > 0.5f ? side : vec3_perpendicular(p.tangent);
    return p;
}

// Arc length of the point of segment k nearest to p, and the squared distance to it.
static float nearest_on_segment(const SkinPoint *point, int64_t k, Vec3 p, float *distance2)
{
    Vec3 step = vec3_sub(point[k + 1].position, point[k].position);
    float length2 = vec3_dot(step, step);
    float t = length2 > 0.0f
                  ? clampf(vec3_dot(vec3_sub(p, point[k].position), step) / length2, 0.0f, 1.0f)
                  : 0.0f;
    Vec3 apart = vec3_sub(p, vec3_madd(point[k].position, t, step));
    *distance2 = vec3_dot(apart, apart);
    return lerpf(point[k].along, point[k + 1].along, t);
}

float skin_axis_nearest(const SkinPlan *plan, int32_t number, Vec3 p, int64_t *sample)
{
    const SkinChain *chain = &plan->chain[number];
    const SkinPoint *point = plan->point + chain->axis;
    if (chain->samples < 2) {
        *sample = 0;
        return 0.0f;
    }
    int64_t k = *sample < chain->samples - 1 ? *sample : chain->samples - 2;
    float best, rival;
    float along = nearest_on_segment(point, k, p, &best);
    for (int way = -1; way <= 1; way += 2) {
        while (k + way >= 0 && k + way < chain->samples - 1) {
            float there = nearest_on_segment(point, k + way, p, &rival);
            if (rival > best) {
                break;
            }
            best = rival;
            along = there;
            k += way;
        }
    }
    *sample = k;
    return along;
}
