// The parts of an out-tree that are too thin to skin, as round curves.
#include "base/memory.h"
#include "skin/plan.h"
#include "skin/skin.h"

#include <stdlib.h>
#include <string.h>

typedef struct CurvePoint {
    Vec3 position;
    float radius, birth, along;
    int32_t node; // -1 for points that are not nodes of the curve
} CurvePoint;

typedef struct CurveBuilder {
    const SkinPlan *plan;
    int32_t *thickest_child; // per node, among the thin ones
    Vec3 *relaxed;           // per thin node
    CurvePoint *raw;         // of the current curve
    CurvePoint *point;       // of all curves
    int64_t *first;          // per curve, index of its first point
    int32_t *start;          // per curve, its first node
    int64_t raw_count, raw_capacity, point_count, point_capacity, curve_count, first_capacity,
        start_capacity;
} CurveBuilder;

static bool is_thin(const SkinPlan *plan, int64_t node)
{
    return plan->chain_of[node] < 0;
}

static void choose_thickest(CurveBuilder *builder)
{
    const OutTree *tree = builder->plan->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        builder->thickest_child[i] = -1;
        int32_t parent = tree->parent[i];
        if (parent < 0 || !is_thin(builder->plan, i)) {
            continue;
        }
        int32_t rival = builder->thickest_child[parent];
        if (rival < 0 || tree->radius[i] > tree->radius[rival]) {
            builder->thickest_child[parent] = (int32_t)i;
        }
    }
}

// ---- one curve ----

static bool add_raw(CurveBuilder *builder, Vec3 position, int32_t node, Error *e)
{
    if (!memory_reserve(&builder->raw, &builder->raw_capacity, builder->raw_count + 1,
                        sizeof(CurvePoint), e)) {
        return false;
    }
    builder->raw[builder->raw_count++] = (CurvePoint){.position = position, .node = node};
    return true;
}

// Arc length of a skinned node on its chain's axis, m.
static float along_axis(const SkinPlan *plan, int32_t node)
{
    int32_t number = plan->chain_of[node];
    const SkinChain *chain = &plan->chain[number];
    int64_t place = plan->place[node] - chain->first;
    int64_t sample = chain->count > 1 ? place * (chain->samples - 1) / (chain->count - 1) : 0;
    return skin_axis_nearest(plan, number, plan->tree->position[node], &sample);
}

static bool add_axis_point(CurveBuilder *builder, int32_t chain, float along, Error *e)
{
    return add_raw(builder, skin_axis_at(builder->plan, chain, along).position, -1, e);
}

// Adds the points before the first thin node, inside the branch it grows from. If that branch is
// hidden in its own parent or has only just left it, the curve starts in the parent.
static bool add_beginning(CurveBuilder *builder, int32_t base, Error *e)
{
    const SkinPlan *plan = builder->plan;
    if (is_thin(plan, base)) {
        return add_raw(builder, builder->relaxed[base], -1, e);
    }
    int32_t number = plan->chain_of[base];
    const SkinChain *chain = &plan->chain[number];
    float along = along_axis(plan, base);
    float near = chain->start + 2.0f * skin_axis_at(plan, number, along).radius;
    if (chain->parent >= 0 && (!chain->visible || along < near)) {
        if (!add_axis_point(builder, chain->parent, chain->attach, e)) {
            return false;
        }
        for (int64_t i = chain->first; !chain->visible && i < plan->place[base]; i++) {
            if (!add_raw(builder, plan->tree->position[plan->node[i]], -1, e)) {
                return false;
            }
        }
    }
    return add_axis_point(builder, number, along, e);
}

static bool gather_curve(CurveBuilder *builder, int64_t start, Error *e)
{
    const OutTree *tree = builder->plan->tree;
    builder->raw_count = 0;
    if (tree->parent[start] >= 0 && !add_beginning(builder, tree->parent[start], e)) {
        return false;
    }
    for (int64_t i = start; i >= 0; i = builder->thickest_child[i]) {
        if (!add_raw(builder, tree->position[i], (int32_t)i, e)) {
            return false;
        }
    }
    if (builder->raw_count == 1) { // a root without children: a bud
        Vec3 up = vec3_scale(tree->normal[start], tree->radius[start]);
        return add_raw(builder, vec3_add(tree->position[start], up), (int32_t)start, e);
    }
    return true;
}

static void relax_curve(CurveBuilder *builder)
{
    CurvePoint *raw = builder->raw;
    for (int pass = 0; pass < builder->plan->params.smoothing; pass++) {
        Vec3 before = raw[0].position;
        for (int64_t i = 1; i + 1 < builder->raw_count; i++) {
            Vec3 middle = vec3_lerp(before, raw[i + 1].position, 0.5f);
            before = raw[i].position;
            raw[i].position = vec3_lerp(before, middle, 0.5f);
        }
    }
    for (int64_t i = 0; i < builder->raw_count; i++) {
        if (raw[i].node >= 0) {
            builder->relaxed[raw[i].node] = raw[i].position;
        }
    }
}

// Unless params.blunt, tapers radii to a third at the tip, whatever the tree's radii, mostly near
// the tip.
static void dress_curve(CurveBuilder *builder)
{
    const SkinPlan *plan = builder->plan;
    CurvePoint *raw = builder->raw;
    int64_t count = builder->raw_count, first_own = 0;
    while (raw[first_own].node < 0) {
        first_own++;
    }
    for (int64_t i = 0; i < count; i++) {
        int32_t node = raw[i < first_own ? first_own : i].node;
        raw[i].radius = fmaxf(plan->tree->radius[node], plan->least_radius);
        raw[i].birth = clampf((float)plan->tree->birth[node] * plan->birth_scale, 0.0f, 1.0f);
        raw[i].along =
            i > 0 ? raw[i - 1].along + vec3_distance(raw[i - 1].position, raw[i].position) : 0.0f;
    }
    float length = raw[count - 1].along;
    for (int64_t i = 0; i < count && length > 0.0f && !plan->params.blunt; i++) {
        float t = raw[i].along / length;
        raw[i].radius *= 1.0f - 0.67f * t * t;
    }
}

// Whether the segment from raw point a to b approximates all points between.
static bool segment_will_do(const CurvePoint *raw, int64_t a, int64_t b)
{
    Vec3 step = vec3_sub(raw[b].position, raw[a].position);
    float length2 = vec3_dot(step, step);
    for (int64_t i = a + 1; i < b; i++) {
        Vec3 from = vec3_sub(raw[i].position, raw[a].position);
        float t = length2 > 0.0f ? clampf(vec3_dot(from, step) / length2, 0.0f, 1.0f) : 0.0f;
        float radius = lerpf(raw[a].radius, raw[b].radius, t);
        if (vec3_length(vec3_madd(from, -t, step)) > 0.2f * raw[i].radius ||
            fabsf(radius - raw[i].radius) > 0.1f * raw[i].radius) {
            return false;
        }
    }
    return true;
}

// Stores the curve, simplified.
static bool store_curve(CurveBuilder *builder, int32_t start, Error *e)
{
    enum { FARTHEST = 16 };
    if (!memory_reserve(&builder->point, &builder->point_capacity,
                        builder->point_count + builder->raw_count, sizeof(CurvePoint), e) ||
        !memory_reserve(&builder->first, &builder->first_capacity, builder->curve_count + 1,
                        sizeof(int64_t), e) ||
        !memory_reserve(&builder->start, &builder->start_capacity, builder->curve_count + 1,
                        sizeof(int32_t), e)) {
        return false;
    }
    builder->start[builder->curve_count] = start;
    builder->first[builder->curve_count++] = builder->point_count;
    builder->point[builder->point_count++] = builder->raw[0];
    for (int64_t a = 0; a + 1 < builder->raw_count;) {
        int64_t b = a + 1;
        while (b + 1 < builder->raw_count && b + 1 <= a + FARTHEST &&
               segment_will_do(builder->raw, a, b + 1)) {
            b++;
        }
        builder->point[builder->point_count++] = builder->raw[b];
        a = b;
    }
    return true;
}

// ---- all curves ----

static bool trace_curves(CurveBuilder *builder, Error *e)
{
    const OutTree *tree = builder->plan->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool goes_on = parent >= 0 && is_thin(builder->plan, parent) &&
                       builder->thickest_child[parent] == (int32_t)i;
        if (!is_thin(builder->plan, i) || goes_on) {
            continue;
        }
        if (!gather_curve(builder, i, e)) {
            return false;
        }
        relax_curve(builder);
        dress_curve(builder);
        if (!store_curve(builder, (int32_t)i, e)) {
            return false;
        }
    }
    return true;
}

static CurveSet *finish_curves(const CurveBuilder *builder, Error *e)
{
    CurveSet *curves = curves_new(builder->point_count, builder->curve_count, e);
    if (!curves) {
        return NULL;
    }
    for (int64_t i = 0; i < builder->point_count; i++) {
        curves->position[i] = builder->point[i].position;
        curves->radius[i] = builder->point[i].radius;
        curves->birth[i] = builder->point[i].birth;
        curves->along[i] = builder->point[i].along;
    }
    for (int64_t i = 0; i < builder->curve_count; i++) {
        curves->first[i] = builder->first[i];
        curves->id[i] = builder->plan->tree->id[builder->start[i]];
    }
    curves->first[builder->curve_count] = builder->point_count;
    return curves;
}

CurveSet *skin_curves(const OutTree *tree, float max_radius, const SkinParams *params, Error *e)
{
    SkinParams at_limit = *params;
    at_limit.min_radius = max_radius;
    Run run = run_default();
    SkinPlan plan;
    CurveBuilder builder = {.plan = &plan};
    CurveSet *curves = NULL;
    if (skin_plan_init(&plan, tree, &at_limit, &run, e)) {
        builder.thickest_child = memory_alloc(tree->count, sizeof(int32_t), e);
        builder.relaxed = memory_alloc_zero(tree->count, sizeof(Vec3), e);
        if (builder.thickest_child && builder.relaxed) {
            choose_thickest(&builder);
            curves = trace_curves(&builder, e) ? finish_curves(&builder, e) : NULL;
        }
    }
    free(builder.thickest_child);
    free(builder.relaxed);
    free(builder.raw);
    free(builder.point);
    free(builder.first);
    free(builder.start);
    skin_plan_clear(&plan);
    return curves;
}
