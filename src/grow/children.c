#include "base/random.h"
#include "grow/rules/rule.h"

#include <stddef.h>

#define NOISE_STEPS 2.0f // lattice spacing of the noise in space, in steps

// Random streams: of a child's noise or a noise lattice point (one per component), of a child and
// of a root.
enum { STREAM_NOISE_X = 0, STREAM_NOISE_Y = 1, STREAM_NOISE_Z = 2 };
enum { STREAM_APICAL = 3, STREAM_ROOT_HEADING = 4 };

static Vec3 random_normals(uint64_t key)
{
    return vec3(random_normal(random_key(key, STREAM_NOISE_X)),
                random_normal(random_key(key, STREAM_NOISE_Y)),
                random_normal(random_key(key, STREAM_NOISE_Z)));
}

// Smooth noise at p, mean 0 and variance 1 per component, p in lattice units: quintic blends of
// normal variates at the corners, rescaled for the variance that blending loses.
static Vec3 space_noise(Vec3 p, uint64_t key)
{
    const float at[3] = {p.x, p.y, p.z};
    float weight[3][2], squares = 1.0f;
    uint64_t cell[3];
    for (int i = 0; i < 3; i++) {
        float low = floorf(at[i]), t = at[i] - low;
        t = t * t * t * (t * (6.0f * t - 15.0f) + 10.0f);
        cell[i] = (uint64_t)(int64_t)low;
        weight[i][0] = 1.0f - t, weight[i][1] = t;
        squares *= weight[i][0] * weight[i][0] + t * t;
    }
    Vec3 sum = vec3(0, 0, 0);
    for (int corner = 0; corner < 8; corner++) {
        uint64_t mine = key;
        float w = 1.0f;
        for (int i = 0; i < 3; i++) {
            int side = corner >> i & 1;
            mine = random_key(mine, cell[i] + (uint64_t)side);
            w *= weight[i][side];
        }
        sum = vec3_madd(sum, w, random_normals(mine));
    }
    return vec3_scale(sum, 1.0f / sqrtf(squares));
}

// w X_f + tropism + noise, which is added to the unit pull (Tanaka eq. (13) in the steering form).
// The noise is keyed by the child's id.
static Vec3 lean_of(const Growth *growth, const Grower *grower, uint64_t child_id)
{
    const ColonizeParams *p = growth->params;
    Vec3 lean = p->tropism;
    if (p->field && p->field_weight != 0.0f && p->field_mode == FIELD_STEER) {
        Vec3 x = guide_field_at(p->field, grower->position, grower->normal);
        lean = vec3_madd(lean, p->field_weight, x);
    }
    if (p->noise > 0.0f) {
        Vec3 place = vec3_sub(grower->position, p->anchor);
        Vec3 g = p->noise_in_space
                     ? space_noise(vec3_scale(place, 1.0f / (NOISE_STEPS * p->step)), p->seed)
                     : random_normals(random_key(child_id, p->seed));
        lean = vec3_madd(lean, p->noise, g);
    }
    return lean;
}

static bool is_zero(Vec3 v)
{
    return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f;
}

uint64_t growth_child_id(const Growth *growth, const Grower *grower, int place)
{
    return out_tree_child_id(growth->tree->id[grower->node],
                             growth->state[grower->node].children + place);
}

// A root has no parent to define a heading. Its bins are oriented by its first initial child, else
// by the normal in space, or by a random direction on the surface, keyed by the root.
static Vec3 root_heading(const Growth *growth, int32_t node)
{
    const OutTree *tree = growth->tree;
    int32_t child = growth->state[node].first_child;
    if (child >= 0 && child < growth->initial_count) {
        return vec3_sub(tree->position[child], tree->position[node]);
    }
    if (!growth->params->on_surface) {
        return tree->normal[node];
    }
    return random_direction(
        random_key(random_key(tree->id[node], growth->params->seed), STREAM_ROOT_HEADING));
}

Vec3 growth_unit_across(Vec3 v, Vec3 n)
{
    v = vec3_madd(v, -vec3_dot(v, n), n);
    return vec3_dot(v, v) > 1e-6f ? vec3_normalize(v) : vec3_perpendicular(n);
}

void growth_prepare(const Growth *growth, Grower *grower)
{
    const OutTree *tree = growth->tree;
    int32_t node = grower->node, parent = tree->parent[node];
    grower->position = tree->position[node];
    grower->heading = vec3(0, 0, 0);
    if (parent >= 0) {
        grower->heading = vec3_normalize(vec3_sub(grower->position, tree->position[parent]));
    } else if (growth->rule->roots_head) {
        grower->heading = vec3_normalize(root_heading(growth, node));
    }
    grower->has_heading = !is_zero(grower->heading);
    grower->normal = vec3_normalize(tree->normal[node]);
    if (grower->has_heading && growth->params->on_surface) {
        grower->heading = growth_unit_across(grower->heading, grower->normal);
    } else if (grower->has_heading) {
        grower->normal = growth_unit_across(grower->normal, grower->heading);
    }
    grower->side = vec3_cross(grower->normal, grower->heading);
    grower->lean = growth->rule->picks ? lean_of(growth, grower, growth_child_id(growth, grower, 0))
                                       : vec3(0, 0, 0);
}

Vec3 growth_mean_direction(const Pull *pull)
{
    Vec3 sum =
        vec3_scale(vec3((float)pull->toward[0], (float)pull->toward[1], (float)pull->toward[2]),
                   1.0f / PULL_ONE);
    float least = 1e-6f * (float)pull->count;
    return vec3_dot(sum, sum) > least * least ? vec3_normalize(sum) : vec3(0, 0, 0);
}

static Vec3 mean_normal(const Pull *pull, Vec3 fallback)
{
    Vec3 sum =
        vec3_scale(vec3((float)pull->normal[0], (float)pull->normal[1], (float)pull->normal[2]),
                   1.0f / PULL_ONE);
    float least = 1e-3f * (float)pull->count;
    return vec3_dot(sum, sum) > least * least ? vec3_normalize(sum) : fallback;
}

// Rotates d in its plane with the heading until the angle between them is within the limits.
static Vec3 limit_angle(const Growth *growth, const Grower *grower, bool lateral, Vec3 d)
{
    if (!grower->has_heading || growth->tree->parent[grower->node] < 0) {
        return d;
    }
    float cosine = vec3_dot(d, grower->heading), c, s;
    if (cosine < growth->limits.max_cos) {
        c = growth->limits.max_cos, s = growth->limits.max_sin;
    } else if (lateral && cosine > growth->limits.min_cos) {
        c = growth->limits.min_cos, s = growth->limits.min_sin;
    } else {
        return d;
    }
    Vec3 across = vec3_madd(d, -cosine, grower->heading);
    across = vec3_dot(across, across) > 1e-12f ? vec3_normalize(across) : grower->side;
    return vec3_normalize(vec3_madd(vec3_scale(grower->heading, c), s, across));
}

// Rotates d toward the cone's axis until it lies within the cone.
static Vec3 limit_cone(const Growth *growth, Vec3 d)
{
    Vec3 axis = growth->limits.cone_axis;
    float cosine = vec3_dot(d, axis);
    if (growth->params->on_surface || cosine >= growth->limits.cone_cos || is_zero(axis)) {
        return d;
    }
    Vec3 across = vec3_madd(d, -cosine, axis);
    across = vec3_dot(across, across) > 1e-12f ? vec3_normalize(across) : vec3_perpendicular(axis);
    return vec3_normalize(
        vec3_madd(vec3_scale(axis, growth->limits.cone_cos), growth->limits.cone_sin, across));
}

// Projects d into the tangent plane, corrected toward the surface if the steps have left it.
static Vec3 keep_on_surface(const Growth *growth, const Pull *pull, Vec3 normal, Vec3 d)
{
    d = vec3_normalize(vec3_madd(d, -vec3_dot(d, normal), normal));
    if (growth->params->project) { // no step leaves it
        return d;
    }
    float height = (float)pull->height / (PULL_ONE * (float)pull->count);
    float rise = height * growth->params->influence / growth->params->step;
    return vec3_normalize(vec3_madd(d, -clampf(rise, -0.7f, 0.7f), normal));
}

Vec3 growth_add_field(const Growth *growth, const Grower *grower, Vec3 p)
{
    const ColonizeParams *params = growth->params;
    if (!params->field || params->field_weight == 0.0f || params->field_mode != FIELD_ADDITIVE) {
        return p;
    }
    Vec3 x = guide_field_at(params->field, grower->position, grower->normal);
    return vec3_madd(p, params->step * params->field_weight,
                     x); // Tanaka eq. (13), X_f scaled by the step
}

bool growth_make_child(const Growth *growth, const Grower *grower, const Pull *pull,
                       const Vec3 *axis, float step, int place, Child *child)
{
    const ColonizeParams *params = growth->params;
    Vec3 d = axis ? *axis : growth_mean_direction(pull);
    Vec3 lean = lean_of(growth, grower, growth_child_id(growth, grower, place));
    if (!is_zero(lean)) {
        d = vec3_normalize(vec3_add(d, lean));
    }
    Vec3 normal = grower->normal;
    if (params->on_surface) {
        normal = params->project ? grower->normal : mean_normal(pull, grower->normal);
        d = keep_on_surface(growth, pull, normal, d);
    }
    if (is_zero(d)) {
        return false;
    }
    d = limit_angle(growth, grower, growth->state[grower->node].children + place > 0, d);
    d = limit_cone(growth, d);
    // in space, the parent's normal is parallel-transported
    child->normal = params->on_surface ? normal : growth_unit_across(grower->normal, d);
    Vec3 p = vec3_madd(grower->position, step, d); // Tanaka eq. (6)
    child->position = growth_add_field(growth, grower, p);
    return true;
}

bool growth_is_suppressed(const Growth *growth, uint64_t child_id)
{
    return growth->params->apical > 0.0f &&
           random_unit(random_key(random_key(child_id, growth->params->seed), STREAM_APICAL)) <
               growth->params->apical;
}

bool growth_is_last_order(const Growth *growth, int32_t node)
{
    int limit = growth->params->max_order;
    return limit > 0 && growth->tree->parent[node] >= 0 && growth->state[node].order >= limit;
}

Vec3 growth_from_frame(const Grower *grower, Vec3 local)
{
    Vec3 v = vec3_scale(grower->heading, local.x);
    v = vec3_madd(v, local.y, grower->normal);
    return vec3_madd(v, local.z, grower->side);
}

Vec3 growth_to_frame(const Grower *grower, Vec3 v)
{
    return vec3(vec3_dot(v, grower->heading), vec3_dot(v, grower->normal),
                vec3_dot(v, grower->side));
}

int growth_make_children(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    const ColonizeParams *params = growth->params;
    int count = growth->rule->make_children(growth, grower, pull, child);
    for (int i = 0; params->project && i < count; i++) {
        params->project(params->surface, &child[i].position, &child[i].normal);
    }
    return count;
}

int growth_make_single(const Growth *growth, const Grower *grower, const Pull *pull, Child *child,
                       MakeChild *make)
{
    child->bin = 0;
    bool lateral = growth->state[grower->node].children > 0;
    bool barred = pull->count == 0 ||
                  (lateral && (growth_is_last_order(growth, grower->node) ||
                               growth_is_suppressed(growth, growth_child_id(growth, grower, 0))));
    return !barred && make(growth, grower, pull, child);
}
