// Growth of a tree: trunk, crown and roots as elements joined into one out-tree (Tanaka et al.,
// section 5.1).
#include "objects/tree/tree.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/tree/bole.h"
#include "objects/tree/by_light.h"
#include "objects/tree/defaults.h"
#include "objects/tree/hazards.h"
#include "objects/tree/limbs.h"
#include "objects/tree/ribs.h"
#include "objects/tree/veteran.h"
#include "outtree/elbows.h"
#include "outtree/radii.h"

#include <stdlib.h>

// Of a crown or the roots, besides those of its element; the same number as ELEMENT_FIELD.
enum { STREAM_STARTS = 1 };
enum { STREAM_OFFSET = 1, STREAM_ROOTS = 10 }; // of the roots' starts; ROOTS + i: root i
enum { STREAM_ROOT_ID = 2 };                   // of a root
enum { STREAM_FOOT = 1 };                      // of a stem

#define GOLDEN_ANGLE_DEGREES 137.50776f

// Each node's unit direction from its parent; a root has that of its first child, or up.
static Vec3 node_direction(const OutTree *tree, int64_t node)
{
    int64_t parent = tree->parent[node];
    if (parent < 0) {
        for (int64_t i = node + 1; i < tree->count; i++) {
            if (tree->parent[i] == node) {
                return vec3_normalize(vec3_sub(tree->position[i], tree->position[node]));
            }
        }
        return vec3(0, 1, 0);
    }
    Vec3 d = vec3_normalize(vec3_sub(tree->position[node], tree->position[parent]));
    return vec3_dot(d, d) > 0.5f ? d : vec3(0, 1, 0);
}

// Normals across the branches, transported from parent to child without twist.
static void transport_normals(OutTree *tree)
{
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 d = node_direction(tree, i);
        Vec3 n = tree->parent[i] >= 0 ? tree->normal[tree->parent[i]] : vec3(0, 0, 1);
        n = vec3_madd(n, -vec3_dot(n, d), d);
        tree->normal[i] = vec3_dot(n, n) > 1e-6f ? vec3_normalize(n) : vec3_perpendicular(d);
    }
}

Vec3 tree_stem_foot(const TreeParams *params, int stem, uint64_t seed)
{
    const TrunkParams *trunk = &params->trunk;
    if (trunk->stems <= 1) {
        return params->position;
    }
    float sine, cosine,
        share = random_unit(random_key(random_key(seed, (uint64_t)stem), STREAM_FOOT));
    exact_sincos(2.0f * PI_F * (float)stem / (float)trunk->stems, &sine, &cosine);
    float away = trunk->stem_circle * lerpf(1.0f, sqrtf(share), trunk->stem_scatter);
    return vec3_madd(params->position, away, vec3(sine, 0, cosine));
}

bool tree_plant_stems(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e)
{
    int stems = params->trunk.stems > 1 ? params->trunk.stems : 1;
    for (int i = 0; i < stems; i++) {
        Vec3 foot = tree_stem_foot(params, i, seed);
        Vec3 below = vec3_add(foot, vec3(0, -params->trunk.radius, 0));
        uint64_t id = random_key(seed, (uint64_t)i);
        int64_t root = out_tree_add_node(tree, below, -1, 0, TREE_TRUNK, id, e);
        if (root < 0 ||
            out_tree_add_node(tree, foot, root, 0, TREE_TRUNK, out_tree_child_id(id, 0), e) < 0) {
            return false;
        }
    }
    return true;
}

typedef struct HeightOrder {
    float y;
    int32_t node;
} HeightOrder;

static int compare_height(const void *a, const void *b)
{
    const HeightOrder *p = a, *q = b;
    if (p->y != q->y) {
        return p->y < q->y ? -1 : 1;
    }
    return p->node < q->node ? -1 : (p->node > q->node);
}

// Starts one branch at a trunk node: a short piece along the node's normal. place: index of the
// branch at this node.
static bool start_branch(OutTree *tree, int64_t node, int place, Vec3 normal, float length,
                         const CrownParams *crown, Error *e)
{
    enum { PIECES = 3 };
    Vec3 axis = node_direction(tree, node);
    int32_t birth = tree->birth[node];
    float sine, cosine;
    exact_sincos(crown->branch_angle * RADIANS_PER_DEGREE, &sine, &cosine);
    Vec3 d = vec3_madd(vec3_scale(axis, cosine), sine, normal);
    int64_t parent = node;
    for (int i = 0; i < PIECES; i++) {
        uint64_t id = out_tree_child_id(tree->id[parent], i == 0 ? 1000 + place : 0);
        Vec3 p = vec3_madd(tree->position[parent], length / PIECES, d);
        parent = out_tree_add_node(tree, p, parent, ++birth, TREE_CROWN, id, e);
        if (parent < 0) {
            return false;
        }
        d = vec3_normalize(vec3_add(d, vec3(0, 0.12f, 0))); // limbs bow upward
    }
    return true;
}

// Starts branches on the trunk's upper nodes in order of height, along the node's normal, each
// rotated about the trunk by the golden angle from the last. height: of the trunk, m.
static bool start_branches(OutTree *tree, const TreeParams *params, float height, uint64_t seed,
                           Error *e)
{
    const CrownParams *crown = &params->crown;
    HeightOrder *order = memory_alloc(tree->count, sizeof *order, e);
    if (!order) {
        return false;
    }
    int64_t count = 0;
    float from = params->position.y + crown->branch_from * height;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->position[i].y >= from) {
            order[count++] = (HeightOrder){tree->position[i].y, (int32_t)i};
        }
    }
    qsort(order, (size_t)count, sizeof *order, compare_height);
    bool done = true;
    int64_t last = -1;
    for (int b = 0, place = 0; done && b < crown->branches && count > 0; b++) {
        float share = ((float)b + random_range(random_key(seed, (uint64_t)b), 0.2f, 0.8f)) /
                      (float)crown->branches;
        int64_t node = order[(int64_t)(share * (float)count)].node;
        place = node == last ? place + 1 : 0;
        last = node;
        float sine, cosine;
        exact_sincos((float)(b + 1) * GOLDEN_ANGLE_DEGREES * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 normal = vec3_rotate(tree->normal[node], node_direction(tree, node), cosine, sine);
        done = start_branch(tree, node, place, normal,
                            crown->branch_length * (1.15f - 0.4f * share), crown, e);
    }
    free(order);
    return done;
}

static bool grow_trunk(OutTree *tree, const TreeParams *params, uint64_t seed, const Recipe *recipe,
                       Error *e)
{
    if (!tree_plant_stems(tree, params, seed, e) ||
        !element_grow(tree, &params->trunk.element, seed, recipe, "trunk", e)) {
        error_key(e, "trunk");
        return false;
    }
    transport_normals(tree);
    return true;
}

// Did nothing grow from a starting piece but its own three nodes? count[i]: descendants of node i.
static bool is_barren(const OutTree *tree, int64_t i, const int32_t *count)
{
    return tree->parent[i] >= 0 && tree->colony[tree->parent[i]] == TREE_TRUNK && count[i] < 3;
}

// Drops branches that did not grow, which would be stubs. pieces: number of nodes in starting
// pieces, from `first` on.
static bool drop_barren(OutTree *tree, int64_t first, int64_t pieces, Error *e)
{
    int32_t *count = memory_alloc_zero(tree->count, sizeof *count, e);
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    bool done = count && keep;
    for (int64_t i = tree->count - 1; done && i >= first; i--) {
        count[tree->parent[i]] += 1 + count[i];
    }
    for (int64_t i = 0; done && i < tree->count; i++) {
        keep[i] = i < first || i >= first + pieces || !is_barren(tree, i, count);
    }
    done = done && out_tree_keep_nodes(tree, keep, e);
    free(count);
    free(keep);
    return done;
}

static bool grow_crown_in(OutTree *tree, const TreeParams *params, const Envelope *envelope,
                          uint64_t seed, const Recipe *recipe, Error *e)
{
    int64_t trunk = tree->count;
    float height = params->trunk.height;
    if (!tree_grow_bole(tree, params, envelope, seed, recipe, e)) {
        return false;
    }
    int64_t first = tree->count;
    if (first > trunk) {
        transport_normals(tree);
        height = tree->position[tree_highest_node(tree)].y - params->position.y;
    }
    if (!start_branches(tree, params, height, random_key(seed, STREAM_STARTS), e) ||
        !tree_thin_limbs(tree, first, params, envelope, seed, recipe->run, e)) {
        return false;
    }
    int64_t pieces = tree->count - first;
    if (!element_grow_in(tree, first, &params->crown.element, envelope, seed, recipe, "crown", e)) {
        return false;
    }
    for (int64_t i = first; i < tree->count; i++) {
        tree->colony[i] = TREE_CROWN;
    }
    return drop_barren(tree, first, pieces, e);
}

static bool grow_crown(OutTree *tree, const TreeParams *params, uint64_t seed, const Recipe *recipe,
                       Error *e)
{
    Envelope *envelope = element_envelope(&params->crown.element, recipe->run, e);
    bool done = envelope && grow_crown_in(tree, params, envelope, seed, recipe, e);
    envelope_free(envelope);
    return done || recipe_fail(recipe, "crown", e) || error_key(e, "crown");
}

// Plants main roots evenly around the foot, the centre of the trunk's base.
static bool plant_roots(OutTree *roots, const TreeParams *params, uint64_t seed, Error *e)
{
    // Each root descends inside the flare, where it forms a buttress, leaves it close to the ground
    // and continues just below the turf. In trunk radii: outward from the axis, a share of the
    // flared radius and a part beyond it; upward from the ground.
    static const float inside[TREE_ROOT_PIECES] = {0.4f, 0.66f, 0.98f, 1.0f, 1.0f, 1.0f};
    static const float beyond[TREE_ROOT_PIECES] = {0.0f, 0.0f, 0.1f, 0.6f, 1.3f, 2.1f};
    static const float up[TREE_ROOT_PIECES] = {1.0f, 0.5f, 0.12f, -0.06f, -0.18f, -0.36f};
    float radius = params->trunk.radius, flared = radius * (1.0f + params->radii.flare);
    float offset = random_range(random_key(seed, STREAM_OFFSET), 0.0f, 2.0f * PI_F);
    for (int i = 0; i < params->roots.count; i++) {
        uint64_t key = random_key(seed, STREAM_ROOTS + (uint64_t)i);
        float turn = ((float)i + random_range(key, -0.25f, 0.25f)) / (float)params->roots.count;
        float sine, cosine;
        exact_sincos(offset + 2.0f * PI_F * turn, &sine, &cosine);
        Vec3 out = vec3(sine, 0, cosine);
        uint64_t id = random_key(key, STREAM_ROOT_ID);
        int64_t parent = -1;
        for (int k = 0; k < TREE_ROOT_PIECES; k++) {
            Vec3 p = vec3_madd(params->position, inside[k] * flared + beyond[k] * radius, out);
            p.y += up[k] * radius;
            id = k == 0 ? id : out_tree_child_id(id, 0);
            parent = out_tree_add_node(roots, p, parent, 0, TREE_ROOTS, id, e);
            if (parent < 0) {
                return false;
            }
        }
    }
    return true;
}

// Joins the roots to the trunk: each root's first node becomes a child of the foot node. Births of
// roots are scaled to span those of the rest.
static bool graft_roots(OutTree *tree, const OutTree *roots, int64_t foot, Error *e)
{
    int64_t base = tree->count;
    int64_t last = out_tree_last_birth(tree), last_root = out_tree_last_birth(roots);
    last_root = last_root > 0 ? last_root : 1;
    if (!out_tree_reserve(tree, base + roots->count, e)) {
        return false;
    }
    for (int64_t i = 0; i < roots->count; i++) {
        int64_t parent = roots->parent[i] < 0 ? foot : base + roots->parent[i];
        int32_t birth = (int32_t)(roots->birth[i] * last / last_root);
        int64_t node =
            out_tree_add_node(tree, roots->position[i], parent, birth, TREE_ROOTS, roots->id[i], e);
        if (node < 0) {
            return false;
        }
        tree->radius[node] = roots->radius[i];
    }
    return true;
}

static bool grow_roots(OutTree *tree, const TreeParams *params, uint64_t seed, const Recipe *recipe,
                       Error *e)
{
    OutTree *roots = out_tree_new(e);
    bool done = roots && plant_roots(roots, params, random_key(seed, STREAM_STARTS), e) &&
                (element_grow(roots, &params->roots.element, seed, recipe, "roots", e) ||
                 error_key(e, "roots"));
    if (done) {
        out_tree_pipe_radii(roots, params->radii.exponent, 2.0f * params->radii.tip,
                            params->roots.radius * params->trunk.radius);
        done = graft_roots(tree, roots, 1, e); // node 1: the first stem's foot, on the ground
    }
    out_tree_free(roots);
    return done;
}

// Stems that wind about each other keep a least radius even if few branches grew from them. They
// reach it within four fifths of their height from their ends: no thin branch stands on a stump.
static void keep_stems_stout(OutTree *tree, const TreeParams *params)
{
    float least = 0.75f * params->trunk.radius, slope = least / (0.8f * params->trunk.height);
    for (int64_t i = tree->count - 1; i >= 0; i--) { // children before their parents
        int32_t parent = tree->parent[i];
        if (parent >= 0 && tree->colony[parent] == TREE_TRUNK && tree->colony[i] != TREE_ROOTS) {
            float length = vec3_distance(tree->position[i], tree->position[parent]);
            float radius = fminf(tree->radius[i] + slope * length, least);
            tree->radius[parent] = fmaxf(tree->radius[parent], radius);
        }
    }
}

void tree_compute_radii(OutTree *tree, const TreeParams *params, bool by_light)
{
    const RadiiParams *radii = &params->radii;
    if (radii->model == RADIUS_BIRTH) {
        out_tree_birth_radii(tree, radii->tip, params->trunk.radius);
    } else if (!by_light) {
        out_tree_pipe_radii(tree, radii->exponent, radii->tip, params->trunk.radius);
    }
    if (params->trunk.stems > 1 && !by_light) {
        keep_stems_stout(tree, params);
    }
    // the first node is a radius below the ground
    out_tree_root_flare(tree, radii->flare, params->trunk.radius, radii->flare_height);
}

static bool grow_by_attractors(OutTree *tree, const TreeParams *params, const Recipe *recipe,
                               Error *e)
{
    uint64_t seed = recipe->seed;
    return grow_trunk(tree, params, random_key(seed, STREAM_TREE_TRUNK), recipe, e) &&
           grow_crown(tree, params, random_key(seed, STREAM_TREE_CROWN), recipe, e);
}

bool tree_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e)
{
    TreePlan plan;
    uint64_t seed = recipe->seed;
    tree_plan_make(&plan, params, seed);
    const TreeParams *tree = &plan.params;
    bool by_light = plan.grown_by != GROWN_BY_ATTRACTORS;
    whole->tree = out_tree_new(e);
    if (!whole->tree ||
        (plan.grown_by != GROWN_BY_LIGHT && !grow_by_attractors(whole->tree, tree, recipe, e)) ||
        (by_light && !tree_grow_by_light(&whole->tree, &plan, recipe, e))) {
        return false;
    }
    tree_compute_radii(whole->tree, tree, by_light);
    if (!out_tree_elbows(whole->tree, tree->elbows, tree->trunk.radius, e) ||
        !tree_round_ends(whole->tree, tree, e) ||
        (by_light && (!tree_kill_limbs(whole->tree, tree, seed, e) ||
                      !tree_befall(whole->tree, tree, seed, e)))) {
        return false;
    }
    return tree->roots.count <= 0 ||
           grow_roots(whole->tree, tree, random_key(seed, STREAM_TREE_ROOTS), recipe, e);
}

float tree_tip_radius(const void *given, const OutTree *whole)
{
    (void)whole;
    const TreeParams *params = given;
    return params->radii.tip;
}

bool tree_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                 Error *e)
{
    (void)params, (void)recipe, (void)whole, (void)e;
    transport_normals(grown->tree);
    return true;
}
