// The out-tree of a plant: its living wood and stubs of what it shed, with radii by the pipe model.
#include "grow/light/plant.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>

#define STUB_GIRTHS 9.0f // a stub is at most so many of its radii long
#define LEAST_STUB 2.0f  // thinnest branch that leaves one, in tips
#define KNOT_DEPTH 0.5f  // of the wood's radius: how far out a knot's node lies

static bool is_knot(const Plant *plant, const Metamer *m, const LightSite *site)
{
    return site->healing > 0 && m->died != PLANT_ALIVE && m->parent >= 0 &&
           plant->metamer[m->parent].died == PLANT_ALIVE &&
           site->seasons - m->died >= site->healing;
}

typedef struct WoodShape {
    float *radius; // m, per metamer
    float *stub;   // m, per metamer of dead branches: length of stub that is left from here on
    bool *kept;
} WoodShape;

// Radii: each tip that ever grew adds a pipe to all wood below it, and dead pipes stay.
static void compute_radii(const Plant *plant, const LightSite *site, float *radius)
{
    float thickest = 1.0f;
    for (int64_t i = 0; i < plant->count; i++) {
        radius[i] = 0.0f;
    }
    for (int64_t i = plant->count - 1; i >= 0; i--) {
        int32_t parent = plant->metamer[i].parent;
        radius[i] = radius[i] > 0.0f ? radius[i] : 1.0f;
        if (parent >= 0) {
            radius[parent] += radius[i];
        } else {
            thickest = radius[i] > thickest ? radius[i] : thickest;
        }
    }
    double power = 1.0 / (double)site->exponent;
    if (site->girth > 0.0f && thickest > 1.0f) {
        power = exact_log((double)site->girth / (double)site->tip) / exact_log((double)thickest);
    }
    for (int64_t i = 0; i < plant->count; i++) {
        radius[i] = site->tip * (float)exact_exp(power * exact_log((double)radius[i]));
    }
}

// Chord of the dead branch that begins at metamer i, m.
static float dead_length(const Plant *plant, int64_t i, float internode)
{
    const Metamer *base = &plant->metamer[i];
    int32_t end = (int32_t)i;
    while (plant->metamer[end].next >= 0) {
        end = plant->metamer[end].next;
    }
    return internode *
           vec3_distance(plant->metamer[base->parent].position, plant->metamer[end].position);
}

// Marks the metamers to keep: the living ones and the stubs of dead branches.
static void choose_kept(const Plant *plant, const LightParams *params, const LightSite *site,
                        WoodShape *shape)
{
    for (int64_t i = 0; i < plant->count; i++) {
        const Metamer *m = &plant->metamer[i];
        shape->stub[i] = 0.0f;
        shape->kept[i] = m->died == PLANT_ALIVE;
        if (is_knot(plant, m, site)) {
            shape->kept[i] = shape->radius[i] >= LEAST_STUB * site->tip;
            continue;
        }
        if (shape->kept[i] || m->parent < 0 || params->snags <= 0.0f) {
            continue;
        }
        const Metamer *base = &plant->metamer[m->parent];
        if (base->died == PLANT_ALIVE) {
            float most = STUB_GIRTHS * shape->radius[i];
            float length = params->snags * dead_length(plant, i, site->internode);
            bool thick = shape->radius[i] >= LEAST_STUB * site->tip;
            shape->stub[i] = thick ? (length < most ? length : most) : 0.0f;
        } else if (base->next == i) {
            shape->stub[i] = shape->stub[m->parent] -
                             site->internode * vec3_distance(m->position, base->position);
        }
        shape->kept[i] = shape->stub[i] > 0.0f;
    }
}

static int32_t colony_of(const Plant *plant, const Metamer *m, const LightSite *site)
{
    int32_t dead = site->colony[is_knot(plant, m, site) ? 3 : 2];
    return m->died != PLANT_ALIVE ? dead : site->colony[m->order > 0];
}

// m; a knot's node lies inside the wood that bears it.
static Vec3 place_of(const Plant *plant, int64_t i, const LightSite *site, const WoodShape *shape)
{
    const Metamer *m = &plant->metamer[i];
    if (!is_knot(plant, m, site)) {
        return vec3_madd(site->foot, site->internode, m->position);
    }
    Vec3 base = plant->metamer[m->parent].position;
    Vec3 d = vec3_normalize(vec3_sub(m->position, base));
    return vec3_madd(vec3_madd(site->foot, site->internode, base),
                     KNOT_DEPTH * shape->radius[m->parent], d);
}

static bool add_nodes(const Plant *plant, const LightSite *site, const WoodShape *shape,
                      int32_t *node, OutTree *tree, Error *e)
{
    for (int64_t i = 0; i < plant->count; i++) {
        const Metamer *m = &plant->metamer[i];
        if (!shape->kept[i]) {
            continue;
        }
        int32_t parent = m->parent >= 0 ? node[m->parent] : -1;
        int64_t made = out_tree_add_node(tree, place_of(plant, i, site, shape), parent, m->birth,
                                         colony_of(plant, m, site), m->id, e);
        if (made < 0) {
            return false;
        }
        node[i] = (int32_t)made;
        tree->radius[made] = shape->radius[i];
    }
    return true;
}

OutTree *plant_out_tree(const Plant *plant, const LightParams *params, const LightSite *site,
                        Error *e)
{
    WoodShape shape = {0};
    int32_t *node = memory_alloc(plant->count, sizeof *node, e);
    shape.radius = node ? memory_alloc(plant->count, sizeof *shape.radius, e) : NULL;
    shape.stub = shape.radius ? memory_alloc(plant->count, sizeof *shape.stub, e) : NULL;
    shape.kept = shape.stub ? memory_alloc(plant->count, sizeof *shape.kept, e) : NULL;
    OutTree *tree = shape.kept ? out_tree_new(e) : NULL;
    if (tree) {
        compute_radii(plant, site, shape.radius);
        choose_kept(plant, params, site, &shape);
        if (!add_nodes(plant, site, &shape, node, tree, e)) {
            out_tree_free(tree);
            tree = NULL;
        }
    }
    free(node);
    free(shape.radius);
    free(shape.stub);
    free(shape.kept);
    return tree;
}
