// From grown colonies to geometry: skins of branches, crusts over rocks, corallites.
#include "objects/coral/coral.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/coral/crust.h"
#include "objects/coral/polyps.h"
#include "outtree/join.h"
#include "skin/skin.h"

#include <stdlib.h>

enum { YOUTH_STEPS = 1000 };

// A copy of the tree whose births are the closeness to a growing tip (YOUTH_STEPS at the tip, 0
// from `pale` metres on): the colour of living coral shows the age of its tissue, not of its
// skeleton. Tips that have fused (may be NULL) grow no more.
static OutTree *with_youth(const OutTree *tree, const bool *fused, float pale, Error *e)
{
    OutTree *copy = out_tree_copy(tree, e);
    float *to_tip = copy ? memory_alloc(tree->count, sizeof *to_tip, e) : NULL;
    if (!to_tip) {
        out_tree_free(copy);
        return NULL;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        to_tip[i] = INFINITY;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        bool ends = to_tip[i] == INFINITY && !(fused && fused[i]);
        to_tip[i] = ends ? 0.0f : to_tip[i];
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            float way = to_tip[i] + vec3_distance(tree->position[i], tree->position[parent]);
            to_tip[parent] = way < to_tip[parent] ? way : to_tip[parent];
        }
        float youth = clampf(1.0f - to_tip[i] / pale, 0.0f, 1.0f);
        copy->birth[i] = (int32_t)(youth * (float)YOUTH_STEPS + 0.5f);
    }
    free(to_tip);
    return copy;
}

// The thickest child of each node, -1 without one: tree->count numbers, which the caller frees.
static int32_t *find_thickest(const OutTree *tree, Error *e)
{
    int32_t *thickest = memory_alloc(tree->count, sizeof *thickest, e);
    for (int64_t i = 0; thickest && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        thickest[i] = -1;
        if (parent >= 0 &&
            (thickest[parent] < 0 || tree->radius[i] > tree->radius[thickest[parent]])) {
            thickest[parent] = (int32_t)i;
        }
    }
    return thickest;
}

// Copies node i, below `parent` (-1: below a copy of its own parent, as thin as the node).
static int64_t copy_twig_node(OutTree *to, int64_t parent, const OutTree *from, int64_t i, Error *e)
{
    int32_t above = from->parent[i];
    if (parent < 0 && above >= 0) {
        parent = out_tree_copy_node(to, -1, from, above, e);
        if (parent < 0) {
            return -1;
        }
        to->radius[parent] = from->radius[i];
    }
    return out_tree_copy_node(to, parent, from, i, e);
}

// The same branches as unforked twigs, each of which begins inside the one it leaves: a lattice has
// more branches than the skin of a thick one has room for mouths, and where a branch has fused
// it ends inside another anyway.
static OutTree *part_twigs(const OutTree *tree, Error *e)
{
    int32_t *thickest = find_thickest(tree, e);
    int64_t *copy = thickest ? memory_alloc(tree->count, sizeof *copy, e) : NULL;
    OutTree *parted = copy ? out_tree_new(e) : NULL;
    bool done = parted;
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool goes_on = parent >= 0 && thickest[parent] == (int32_t)i;
        copy[i] = copy_twig_node(parted, goes_on ? copy[parent] : -1, tree, i, e);
        done = copy[i] >= 0;
    }
    free(thickest);
    free(copy);
    if (!done) {
        out_tree_free(parted);
        return NULL;
    }
    return parted;
}

static Mesh *branches(const OutTree *tree, const CoralParams *p, const Run *run, Error *e)
{
    bool net = p->fuse > 0.0f;
    bool *fused = net ? out_tree_find_joined(tree, e) : NULL;
    OutTree *young = net && !fused ? NULL : with_youth(tree, fused, p->pale, e);
    OutTree *twigs = young && net ? part_twigs(young, e) : NULL;
    SkinParams skin = skin_params_default();
    skin.levels = p->levels;
    skin.ring_spacing = 0.8f;
    const OutTree *shown = net ? twigs : young;
    Mesh *mesh = shown ? skin_tree(shown, &skin, run, e) : NULL;
    out_tree_free(young);
    out_tree_free(twigs);
    free(fused);
    return mesh;
}

// Weathers the rock's surface: bumps and hollows of `depth` (m).
static Mesh *weathered(const Mesh *from, float depth, uint64_t seed, Error *e)
{
    Mesh *to = mesh_new(from->face_size, from->vertex_count, from->face_count, 0, e);
    for (int64_t i = 0; to && i < from->vertex_count; i++) {
        Vec3 p = vec3_scale(from->position[i], 0.2f / depth);
        float rise = noise_plane_fractal(p.x + 0.4f * p.y, p.z, 4, seed) +
                     noise_plane_fractal(p.y, p.x - 0.4f * p.z, 4, seed + 1);
        to->position[i] = vec3_madd(from->position[i], depth * rise, from->normal[i]);
    }
    for (int64_t i = 0; to && i < from->face_count * from->face_size; i++) {
        to->index[i] = from->index[i];
    }
    if (to && !mesh_compute_normals(to, e)) {
        mesh_free(to);
        return NULL;
    }
    return to;
}

static CrustParams crust_params(const CoralParams *p, uint64_t seed)
{
    bool massive = p->form == CORAL_MASSIVE;
    return (CrustParams){.thickness = 1.3f * p->tip_radius,
                         .reach = (massive ? 2.5f : 1.5f) * p->length,
                         .seam = 0.35f * p->length_tip,
                         .pale = (massive ? 0.03f : 0.025f) * p->size,
                         .lump = (massive ? 0.10f : 0.05f) * p->size,
                         .seed = random_key(seed, STREAM_CORAL_CRUST)};
}

// Adds a colony's skin and its corallites; at the ends of the tree's branches too, unless it is
// NULL. seed, variation (0..1): the colony's own. Takes the mesh.
static bool add_colony(Mesh *mesh, const OutTree *tree, float variation, const CoralParams *p,
                       uint64_t seed, const Placing *placing, Error *e)
{
    PolypPlaces places = {.shape = p->polyps.shape,
                          .max_count = p->polyps.max_count,
                          .spacing = p->polyps.spacing,
                          .diameter = p->polyps.diameter,
                          .height = p->polyps.height,
                          .lean = p->polyps.lean,
                          .fill = p->polyps.fill,
                          .tentacles = p->polyps.tentacles,
                          .girth = tree ? 1.2f * p->tip_radius : 0.0f,
                          .floor = p->position.y,
                          .tree = tree,
                          .seed = random_key(seed, STREAM_CORAL_POLYPS)};
    if (p->polyps.max_count > 0 && !polyps_add(mesh, &places, placing, CORAL_POLYPS, e)) {
        mesh_free(mesh);
        return false;
    }
    Part part = {.mesh = mesh,
                 .instance = memory_alloc(1, sizeof(Transform), e),
                 .variation = memory_alloc(1, sizeof(float), e),
                 .instance_count = 1};
    if (!part.instance || !part.variation) {
        mesh_free(mesh);
        free(part.instance);
        free(part.variation);
        return false;
    }
    part.instance[0] = transform_identity();
    part.variation[0] = variation;
    return placing_add(placing, part, CORAL_SKIN, e);
}

// Adds a crust per colony, and the rock below.
static bool add_crusts(const OutTree *tree, const CoralParams *p, const Placing *placing, Error *e)
{
    const Run *run = placing->recipe->run;
    uint64_t seed = placing->recipe->seed;
    Envelope *base = coral_base(p, seed, run, e);
    Mesh *rock = base ? weathered(envelope_surface(base), 0.035f * p->size,
                                  random_key(seed, STREAM_CORAL_ROCK), e)
                      : NULL;
    envelope_free(base);
    CrustParams params = crust_params(p, seed);
    CrustPoint *points = rock ? crust_points(rock, tree, &params, run, e) : NULL;
    bool done = points;
    for (int c = 0; done && c < p->colonies; c++) {
        Mesh *mesh = crust_mesh(rock, points, c, e);
        done = mesh;
        if (mesh && mesh->face_count == 0) {
            mesh_free(mesh);
        } else if (mesh) {
            float variation = random_unit(random_key(seed, STREAM_CORAL_VARIATIONS + (uint64_t)c));
            done = add_colony(mesh, NULL, variation, p,
                              random_key(seed, STREAM_CORAL_COLONIES + (uint64_t)c), placing, e);
        }
    }
    free(points);
    if (!done) {
        mesh_free(rock);
        return false;
    }
    return placing_add(placing, (Part){.mesh = rock}, CORAL_ROCK, e);
}

bool coral_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e)
{
    CoralParams p = coral_params_resolve(params);
    if (p.form == CORAL_ENCRUSTING || p.form == CORAL_MASSIVE) {
        return add_crusts(grown->tree, &p, placing, e);
    }
    uint64_t seed = placing->recipe->seed;
    Mesh *mesh = branches(grown->tree, &p, placing->recipe->run, e);
    return mesh &&
           add_colony(mesh, p.form == CORAL_FAN ? NULL : grown->tree,
                      random_unit(random_key(seed, STREAM_CORAL_VARIATIONS)), &p, seed, placing, e);
}
