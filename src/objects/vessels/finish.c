// End of growth: removes vessels that touch, then surplus terminals; final radii and angles.
#include "base/memory.h"
#include "base/random.h"
#include "objects/vessels/room.h"

#include <stdlib.h>

// The other tree: all of it, and its stems alone. NULL = there is none.
typedef struct Others {
    SegmentGrid *all, *stems;
} Others;

// Radius that a stem will have at most: as long as there are surplus terminals, it is thicker.
static float stem_radius(const VesselTree *tree, int64_t node)
{
    float radius = tree->tree->radius[node];
    return radius < tree->root_radius ? radius : tree->root_radius;
}

// Removes vessels that touch the other tree (the thinner of the two, the vein if equal) or the
// outside. Whatever touches a stem gives way to it, unless it is a stem, too: a stem takes its
// whole tree with it.
static void clear_tree(VesselBed *bed, int t, const Others *others, float gap, bool *keep)
{
    const VesselTree *mine = &bed->trees[t];
    const OutTree *tree = mine->tree;
    VesselRoom room = vessel_room(bed, mine, others->all, gap);
    for (int64_t i = 0; i < tree->count; i++) {
        keep[i] = 1;
        if (tree->parent[i] < 0) {
            continue;
        }
        Vec3 a = tree->position[tree->parent[i]], b = tree->position[i];
        bool stem = i < mine->stem_count;
        float r = stem ? stem_radius(mine, i) : tree->radius[i];
        float least = t == VESSELS_ARTERIES ? nextafterf(r, INFINITY) : r;
        keep[i] =
            (stem || vessel_room_is_inside(&room, a, b, r)) &&
            !(others->all &&
              segment_grid_touches(stem ? others->stems : others->all, a, b, r + gap, least)) &&
            !(others->all && !stem && segment_grid_touches(others->stems, a, b, r + gap, 0.0f));
    }
}

// Stem nodes come first, also after removal. Adds those removed to *lost.
static bool keep_marked(VesselTree *tree, bool *keep, int64_t *lost, Error *e)
{
    int64_t stems = 0;
    for (int64_t i = 0; i < tree->stem_count; i++) {
        int32_t parent = tree->tree->parent[i];
        keep[i] = keep[i] && (parent < 0 || keep[parent]);
        stems += keep[i];
    }
    *lost += tree->stem_count - stems;
    tree->stem_count = stems;
    return out_tree_keep_nodes(tree->tree, keep, e);
}

static bool make_others(const VesselTree *tree, Others *others, Error *e)
{
    OutTree stems = *tree->tree; // come first
    stems.count = tree->stem_count;
    stems.radius = memory_alloc(stems.count, sizeof *stems.radius, e);
    for (int64_t i = 0; stems.radius && i < stems.count; i++) {
        stems.radius[i] = stem_radius(tree, i);
    }
    others->all = stems.radius ? segment_grid_new(tree->tree, e) : NULL;
    others->stems = others->all ? segment_grid_new(&stems, e) : NULL;
    free(stems.radius);
    return others->stems;
}

static bool clear_touching(VesselBed *bed, float gap, Error *e)
{
    const int count = bed->tree_count > 1 ? 2 : 1;
    Others trees[2] = {{NULL, NULL}, {NULL, NULL}};
    const Others none = {NULL, NULL};
    bool *keep[2] = {NULL, NULL};
    bool done = true;
    for (int t = 0; done && t < count; t++) {
        keep[t] = memory_alloc(bed->trees[t].tree->count, sizeof *keep[t], e);
        done = keep[t] && make_others(&bed->trees[t], &trees[t], e);
    }
    for (int t = 0; done && t < count; t++) {
        clear_tree(bed, t, count > 1 ? &trees[1 - t] : &none, gap, keep[t]);
    }
    for (int t = 0; done && t < count; t++) {
        done = keep_marked(&bed->trees[t], keep[t], &bed->lost_stems, e);
    }
    for (int t = 0; t < 2; t++) {
        segment_grid_free(trees[t].all);
        segment_grid_free(trees[t].stems);
        free(keep[t]);
    }
    return done;
}

typedef struct Terminal {
    uint64_t key;
    int32_t node;
} Terminal;

static int compare_terminals(const void *a, const void *b)
{
    const Terminal *p = a, *q = b;
    if (p->key != q->key) {
        return p->key < q->key ? -1 : 1;
    }
    return p->node < q->node ? -1 : (p->node > q->node);
}

// Removes a terminal and the nodes that lead only to it; false if it is the last below a stem.
static bool drop_terminal(const VesselTree *tree, int32_t *children, bool *keep, int64_t node)
{
    const int32_t *parent = tree->tree->parent;
    int64_t top = node;
    while (parent[top] >= 0 && children[parent[top]] == 1) {
        top = parent[top];
    }
    if (top < tree->stem_count || parent[top] < 0) {
        return false;
    }
    children[parent[top]]--;
    keep[top] = 0;
    return true;
}

// Drops random terminals until `wanted` are left.
static bool thin_out(VesselTree *tree, int64_t wanted, uint64_t seed, Error *e)
{
    int64_t terminals = 0, count = 0, nodes = tree->tree->count;
    int32_t *children = vessel_child_counts(tree->tree, &terminals, e);
    bool *keep = memory_alloc(nodes, sizeof *keep, e);
    Terminal *order = memory_alloc(terminals, sizeof *order, e);
    bool done = children && keep && order;
    if (done) {
        for (int64_t i = 0; i < nodes; i++) {
            keep[i] = 1;
            if (children[i] == 0) {
                order[count++] = (Terminal){random_key(seed, tree->tree->id[i]), (int32_t)i};
            }
        }
        qsort(order, (size_t)count, sizeof *order, compare_terminals);
        for (int64_t k = 0; k < count && terminals > wanted; k++) {
            terminals -= drop_terminal(tree, children, keep, order[k].node);
        }
        done = out_tree_keep_nodes(tree->tree, keep, e);
    }
    free(children);
    free(keep);
    free(order);
    return done;
}

static bool turn_both(VesselBed *bed, float gap, Error *e)
{
    bed->turned = (MurrayReport){0};
    for (int t = 0; t < bed->tree_count; t++) {
        const OutTree *other = bed->tree_count > 1 ? bed->trees[1 - t].tree : NULL;
        SegmentGrid *others = other ? segment_grid_new(other, e) : NULL;
        VesselRoom room = vessel_room(bed, &bed->trees[t], others, gap);
        bool done = (!other || others) && vessel_room_turn(bed, &room, e) &&
                    vessel_room_bend(bed, &room, e);
        segment_grid_free(others);
        if (!done) {
            return false;
        }
    }
    return true;
}

bool vessel_bed_finish(VesselBed *bed, Error *e)
{
    const int count = bed->tree_count > 1 ? 2 : 1;
    MurrayLaw law = bed->params->law;
    float tip[2] = {0, 0}, gap = INFINITY;
    for (int t = 0; t < count; t++) {
        tip[t] = murray_tip_radius(law, bed->trees[t].root_radius, vessel_wanted_terminals(bed));
        gap = bed->params->gap * tip[t] < gap ? bed->params->gap * tip[t] : gap;
        out_tree_murray_radii(bed->trees[t].tree, law, tip[t]);
    }
    // Fewer terminals make thinner vessels, so vessels that are clear now stay clear.
    if (!clear_touching(bed, gap, e)) {
        return false;
    }
    for (int t = 0; t < count; t++) {
        uint64_t seed = random_key(bed->recipe->seed, STREAM_THINNING + (uint64_t)t);
        if (!thin_out(&bed->trees[t], vessel_wanted_terminals(bed), seed, e)) {
            return false;
        }
        out_tree_murray_radii(bed->trees[t].tree, law, tip[t]);
    }
    return turn_both(bed, gap, e);
}
