#include "objects/tree/buttress.h"

#include "base/memory.h"

#include <stdlib.h>

// A branch segment as a rounded cone.
typedef struct Cone {
    Vec3 a, b;
    float radius_a, radius_b; // m
    int body;                 // 0: the trunk, then the roots
} Cone;

typedef struct Foot {
    Cone *cone; // by body
    int64_t count, capacity;
    int bodies;
    Aabb box;    // of what may be moved
    float blend; // m: surfaces closer to each other than this are blended
} Foot;

// A signed distance, m, with its gradient.
typedef struct Distance {
    float value;
    Vec3 gradient;
} Distance;

static Distance cone_distance(const Cone *cone, Vec3 p)
{
    Vec3 axis = vec3_sub(cone->b, cone->a), from = vec3_sub(p, cone->a);
    float length2 = vec3_dot(axis, axis);
    float t = length2 > 0.0f ? clampf(vec3_dot(from, axis) / length2, 0.0f, 1.0f) : 0.0f;
    Vec3 apart = vec3_madd(from, -t, axis);
    float length = vec3_length(apart);
    Vec3 out = length > 0.0f ? vec3_scale(apart, 1.0f / length) : vec3(0, 1, 0);
    return (Distance){length - lerpf(cone->radius_a, cone->radius_b, t), out};
}

// Smooth minimum (a quadratic spline); *fillet accumulates its distance below the plain minimum.
static Distance blend(Distance a, Distance b, float width, float *fillet)
{
    float h = clampf(0.5f + 0.5f * (b.value - a.value) / width, 0.0f, 1.0f);
    float below = width * h * (1.0f - h);
    float least = a.value < b.value ? a.value : b.value;
    float value = lerpf(b.value, a.value, h) - below;
    *fillet += least - value;
    return (Distance){value, vec3_lerp(b.gradient, a.gradient, h)};
}

// Where p has to go: nowhere where only one body is near.
static Vec3 drawn_out(const Foot *foot, Vec3 p)
{
    Distance sum = {INFINITY, {0, 0, 0}};
    float least = INFINITY, fillet = 0.0f;
    for (int64_t i = 0; i < foot->count;) {
        Distance body = cone_distance(&foot->cone[i], p);
        int64_t k = i + 1;
        for (; k < foot->count && foot->cone[k].body == foot->cone[i].body; k++) {
            Distance other = cone_distance(&foot->cone[k], p);
            body = other.value < body.value ? other : body;
        }
        sum = i == 0 ? body : blend(sum, body, foot->blend, &fillet);
        least = body.value < least ? body.value : least;
        i = k;
    }
    // Below another body's surface, as above a root's mouth: move out to it.
    float under = least < 0.0f ? -least * clampf(8.0f * fillet / foot->blend, 0.0f, 1.0f) : 0.0f;
    Vec3 way = vec3_normalize(sum.gradient);
    return vec3_dot(way, way) > 0.5f ? vec3_madd(p, fillet + under, way) : p;
}

static bool add_cone(Foot *foot, const OutTree *tree, int64_t node, int body, Error *e)
{
    if (!memory_reserve(&foot->cone, &foot->capacity, foot->count + 1, sizeof *foot->cone, e)) {
        return false;
    }
    int32_t parent = tree->parent[node];
    Cone cone = {tree->position[parent], tree->position[node], tree->radius[parent],
                 tree->radius[node], body};
    foot->cone[foot->count++] = cone;
    return true;
}

static bool gather_trunk(Foot *foot, const OutTree *tree, float below, Error *e)
{
    bool good = true;
    for (int64_t i = 0; good && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (tree->colony[i] == TREE_TRUNK && parent >= 0 && tree->position[parent].y < below) {
            good = add_cone(foot, tree, i, 0, e);
        }
    }
    return good;
}

// The starting pieces of main roots are consecutive in the out-tree.
static bool gather_roots(Foot *foot, const OutTree *tree, Error *e)
{
    bool good = true;
    for (int64_t i = 1; good && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (tree->colony[i] != TREE_ROOTS || parent < 0 || tree->colony[parent] != TREE_TRUNK) {
            continue;
        }
        foot->bodies++;
        for (int k = 1; good && k < TREE_ROOT_PIECES && i + k < tree->count &&
                        tree->parent[i + k] == i + k - 1;
             k++) {
            foot->box = aabb_add(foot->box, tree->position[i + k]);
            good = add_cone(foot, tree, i + k, foot->bodies, e);
        }
    }
    return good;
}

bool tree_buttress(Mesh *skin, const OutTree *tree, const TreeParams *params, Error *e)
{
    float flare = params->radii.flare < 1.0f ? params->radii.flare : 1.0f;
    if (flare <= 0.0f || tree->count < 2) {
        return true;
    }
    float girth = tree->radius[1]; // on the ground
    Foot foot = {.box = aabb_empty(), .blend = 0.5f * flare * girth};
    bool good = gather_trunk(&foot, tree, params->position.y + 4.0f * girth, e) &&
                gather_roots(&foot, tree, e);
    if (good && foot.bodies > 0) {
        Vec3 room = vec3_splat(girth);
        Aabb box = {vec3_sub(foot.box.low, room), vec3_add(foot.box.high, room)};
        for (int64_t i = 0; i < skin->vertex_count; i++) {
            Vec3 p = skin->position[i];
            bool inside = p.x > box.low.x && p.y > box.low.y && p.z > box.low.z &&
                          p.x < box.high.x && p.y < box.high.y && p.z < box.high.z;
            skin->position[i] = inside ? drawn_out(&foot, p) : p;
        }
        good = mesh_compute_normals(skin, e);
    }
    free(foot.cone);
    return good;
}
