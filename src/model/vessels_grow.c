#include "model/vessels_grow.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

// Attractors of the finest level for each terminal, and of a level for each of the coarser one.
#define ATTRACTORS_PER_TERMINAL 6
#define LEVEL_RATIO 8

// More than the wanted terminals are grown: some go when vessels touch.
#define SURPLUS 1.06

enum { MOST_LEVELS = 12, LEAST_ATTRACTORS = 24, MOST_FILLS = 4 };

int32_t *vessel_child_counts(const OutTree *tree, int64_t *terminals, Error *e)
{
    int32_t *children = memory_alloc_zero(tree->count, sizeof *children, e);
    int64_t inner = 0;
    for (int64_t i = 0; children && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            inner += children[tree->parent[i]]++ == 0;
        }
    }
    if (terminals) {
        *terminals = tree->count - inner;
    }
    return children;
}

static bool count_terminals(const OutTree *tree, int64_t *terminals, Error *e)
{
    int32_t *children = vessel_child_counts(tree, terminals, e);
    bool counted = children != NULL;
    free(children);
    return counted;
}

static int64_t wanted_terminals(const VesselBed *bed)
{
    int64_t wanted = bed->params->terminals / bed->tree_count;
    return wanted > 1 ? wanted : 1;
}

// ---- where vessels may be ----

// What a tree must keep clear of.
typedef struct Bounds {
    const VesselTree *tree;
    const Envelope *envelope;
    const SegmentGrid *others; // of the other tree; NULL = none
    float most_inset;          // m: as far as the envelope's distance can be told
    float gap;                 // m, beyond both radii
} Bounds;

static Bounds make_bounds(const VesselBed *bed, const VesselTree *tree, const SegmentGrid *others,
                          float gap)
{
    return (Bounds){tree, bed->envelope, others, 0.9f * envelope_band(bed->envelope), gap};
}

static bool is_inside(const Bounds *bounds, Vec3 a, Vec3 b, float radius)
{
    float inset = radius < bounds->most_inset ? radius : bounds->most_inset;
    return envelope_distance(bounds->envelope, b) <= -inset &&
           envelope_distance(bounds->envelope, vec3_lerp(a, b, 0.5f)) <= -inset;
}

static bool may_lie(const Bounds *bounds, Vec3 a, Vec3 b, float radius)
{
    return is_inside(bounds, a, b, radius) &&
           !(bounds->others &&
             segment_grid_touches(bounds->others, a, b, radius + bounds->gap, 0.0f));
}

// MurrayAllowed: stems stay where they are.
static bool may_turn_to(void *user, int64_t node, Vec3 from, Vec3 to)
{
    const Bounds *bounds = user;
    const OutTree *tree = bounds->tree->tree;
    float radius = tree->radius[node];
    if (node < bounds->tree->stem_count) {
        return vec3_distance(tree->position[node], to) < 1e-3f * radius;
    }
    return may_lie(bounds, from, to, radius);
}

// ---- growth ----

static void relax(OutTree *tree, int64_t first, float share)
{
    for (int64_t i = tree->count - 1; i >= first; i--) {
        tree->position[i] = vec3_lerp(tree->position[i], tree->position[tree->parent[i]], share);
    }
}

// Drops the points that lie outside, or in the other tree's vessels.
static void keep_free_points(PointSet *points, const Bounds *bounds, float clearance)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = points->position[i];
        if (envelope_contains(bounds->envelope, p) &&
            !(bounds->others && segment_grid_touches(bounds->others, p, p, clearance, 0.0f))) {
            points->position[kept] = p;
            points->normal[kept] = points->normal[i];
            points->id[kept++] = points->id[i];
        }
    }
    points->count = kept;
}

// Radii as they will be if every terminal so far feeds an equal share of the organ.
static bool foresee_radii(const VesselBed *bed, VesselTree *tree, Error *e)
{
    int64_t terminals;
    if (!count_terminals(tree->tree, &terminals, e)) {
        return false;
    }
    MurrayLaw law = bed->params->law;
    out_tree_murray_radii(tree->tree, law, murray_tip_radius(law, tree->root_radius, terminals));
    return true;
}

// Drops the nodes from `first` on that may not lie where they are, and all below them.
static bool keep_allowed(OutTree *tree, int64_t first, const Bounds *bounds, Error *e)
{
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    for (int64_t i = 0; keep && i < tree->count; i++) {
        keep[i] = i < first || may_lie(bounds, tree->position[tree->parent[i]], tree->position[i],
                                       tree->radius[i]);
    }
    bool done = keep && out_tree_keep_nodes(tree, keep, e);
    free(keep);
    return done;
}

static bool turn_tree(VesselBed *bed, const Bounds *bounds, Error *e)
{
    MurrayReport report;
    if (!bed->params->turn) {
        return true;
    }
    if (!out_tree_murray_turn(bounds->tree->tree, may_turn_to, (void *)bounds, NULL, &report, e)) {
        return false;
    }
    bed->turned.forks += report.forks;
    bed->turned.exact += report.exact;
    bed->turned.reduced += report.reduced;
    bed->turned.multiple += report.multiple;
    return true;
}

static bool grow_toward(VesselBed *bed, VesselTree *tree, PointSet *points, const GrowLevel *level,
                        uint64_t seed, Error *e)
{
    const ElementParams *element = &bed->params->element;
    GuideField *field;
    if (!element_guide_field(tree->tree, element, bed->envelope, random_key(bed->seed, 5), bed->run,
                             &field, e)) {
        return false;
    }
    ColonizeParams params = element_colonize_params(tree->tree, element, field, seed);
    colonize_auto(&params, points_spacing(points), level->step, level->kill, level->influence);
    params.noise = level->noise;
    params.tropism = vec3_scale(params.tropism, level->tropism);
    params.first_step = tree->last_birth;
    GrowReport report;
    int64_t first = tree->tree->count;
    bool done = colonize(tree->tree, points, &params, bed->run, &report, e);
    guide_field_free(field);
    if (done) {
        for (int64_t i = first; i < tree->tree->count; i++) {
            tree->tree->colony[i] = tree->colony;
        }
        relax(tree->tree, first, level->relax);
        tree->last_birth += (int32_t)report.steps;
    }
    return done;
}

// One level of one tree, around what the other has so far.
static bool grow_around(VesselBed *bed, VesselTree *tree, const SegmentGrid *others,
                        const GrowLevel *level, bool coarse, uint64_t seed, Error *e)
{
    ScatterParams scatter =
        element_scatter_params(tree->tree, &bed->params->element, random_key(seed, 1));
    scatter.count = level->attractors;
    scatter.scale = level->scale;
    PointSet *points = points_scatter(bed->envelope, &scatter, bed->run, e);
    if (!points) {
        return false;
    }
    float spacing = (float)points_spacing(points);
    Bounds bounds = make_bounds(bed, tree, others, 0.05f * spacing);
    keep_free_points(points, &bounds, 0.2f * spacing);
    int64_t first = tree->tree->count;
    bool done = points->count == 0 || grow_toward(bed, tree, points, level, random_key(seed, 2), e);
    points_free(points);
    return done && foresee_radii(bed, tree, e) && keep_allowed(tree->tree, first, &bounds, e) &&
           foresee_radii(bed, tree, e) && (!coarse || turn_tree(bed, &bounds, e));
}

// coarse: more levels follow, which fill what turning the forks lays open.
static bool grow_level(VesselBed *bed, const GrowLevel *level, int number, bool coarse, Error *e)
{
    int32_t last = 0;
    for (int t = 0; t < bed->tree_count; t++) {
        const OutTree *other = bed->tree_count > 1 ? bed->trees[1 - t].tree : NULL;
        SegmentGrid *others = other ? segment_grid_new(other, e) : NULL;
        uint64_t seed = random_key(random_key(bed->seed, (uint64_t)number), (uint64_t)t);
        bool done =
            (!other || others) && grow_around(bed, &bed->trees[t], others, level, coarse, seed, e);
        segment_grid_free(others);
        if (!done) {
            return false;
        }
        last = bed->trees[t].last_birth > last ? bed->trees[t].last_birth : last;
    }
    for (int t = 0; t < bed->tree_count; t++) {
        bed->trees[t].last_birth = last; // both begin their next level at the same time
    }
    return true;
}

// Coarse to fine: the recipe of the oak, scaled to the number of terminals. Returns how many.
static int choose_levels(const VesselBed *bed, GrowLevel *levels)
{
    const ElementParams *element = &bed->params->element;
    static const float step[4] = {0.10f, 0.20f, 0.30f, 0.40f}, kill[4] = {0.4f, 0.7f, 0.8f, 0.8f},
                       influence[4] = {4.0f, 2.5f, 2.2f, 2.0f}, scale[4] = {0.75f, 0.9f, 0.97f, 1};
    int64_t attractors[MOST_LEVELS];
    int count = 0;
    for (int64_t n = ATTRACTORS_PER_TERMINAL * wanted_terminals(bed);
         count < MOST_LEVELS && (count == 0 || n >= LEAST_ATTRACTORS); n /= LEVEL_RATIO) {
        attractors[count++] = n > LEAST_ATTRACTORS ? n : LEAST_ATTRACTORS;
    }
    for (int i = 0; i < count; i++) {
        int k = i < 3 ? i : 3;
        levels[i] = (GrowLevel){.attractors = attractors[count - 1 - i],
                                .step = step[k],
                                .kill = kill[k],
                                .influence = influence[k],
                                .scale = bed->limbs ? 1.0f : scale[k],
                                .noise = element->noise,
                                .tropism = 1.0f,
                                .relax = 0.5f};
    }
    return count;
}

static bool grow_levels(VesselBed *bed, const GrowLevel *levels, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        run_progress(bed->run, "vessels", (double)i / (double)count);
        if (!grow_level(bed, &levels[i], i, i + 1 < count, e)) {
            return false;
        }
    }
    // The finest level once more, until there are enough.
    for (int fill = 0; fill < MOST_FILLS; fill++) {
        bool enough = true;
        for (int t = 0; t < bed->tree_count; t++) {
            int64_t terminals;
            if (!count_terminals(bed->trees[t].tree, &terminals, e)) {
                return false;
            }
            enough = enough && (double)terminals >= SURPLUS * (double)wanted_terminals(bed);
        }
        if (enough) {
            break;
        }
        if (!grow_level(bed, &levels[count - 1], count + fill, false, e)) {
            return false;
        }
    }
    return true;
}

bool vessel_bed_grow(VesselBed *bed, Error *e)
{
    const ElementParams *element = &bed->params->element;
    for (int t = 0; t < bed->tree_count; t++) {
        if (!foresee_radii(bed, &bed->trees[t], e)) {
            return false;
        }
    }
    if (element->level_count > 0) {
        return grow_levels(bed, element->levels, element->level_count, e);
    }
    GrowLevel levels[MOST_LEVELS];
    int count = choose_levels(bed, levels);
    return grow_levels(bed, levels, count, e);
}

// ---- finish ----

// Leaves out what touches the other tree (the thinner of two goes; of two alike the vein) or the
// outside.
static void clear_tree(VesselBed *bed, int t, const SegmentGrid *others, float gap, bool *keep)
{
    const VesselTree *mine = &bed->trees[t];
    const OutTree *tree = mine->tree;
    Bounds bounds = make_bounds(bed, mine, others, gap);
    for (int64_t i = 0; i < tree->count; i++) {
        keep[i] = 1;
        if (tree->parent[i] < 0) {
            continue;
        }
        Vec3 a = tree->position[tree->parent[i]], b = tree->position[i];
        float r = tree->radius[i], least = t == VESSELS_ARTERIES ? nextafterf(r, INFINITY) : r;
        keep[i] = (i < mine->stem_count || is_inside(&bounds, a, b, r)) &&
                  !(others && segment_grid_touches(others, a, b, r + gap, least));
    }
}

// Stems come first, also among those that stay.
static bool keep_marked(VesselTree *tree, bool *keep, Error *e)
{
    int64_t stems = 0;
    for (int64_t i = 0; i < tree->stem_count; i++) {
        int32_t parent = tree->tree->parent[i];
        keep[i] = keep[i] && (parent < 0 || keep[parent]);
        stems += keep[i];
    }
    tree->stem_count = stems;
    return out_tree_keep_nodes(tree->tree, keep, e);
}

static bool clear_touching(VesselBed *bed, float gap, Error *e)
{
    const int count = bed->tree_count > 1 ? 2 : 1;
    SegmentGrid *grid[2] = {NULL, NULL};
    bool *keep[2] = {NULL, NULL};
    bool done = true;
    for (int t = 0; done && t < count; t++) {
        grid[t] = segment_grid_new(bed->trees[t].tree, e);
        keep[t] = memory_alloc(bed->trees[t].tree->count, sizeof *keep[t], e);
        done = grid[t] && keep[t];
    }
    for (int t = 0; done && t < count; t++) {
        clear_tree(bed, t, count > 1 ? grid[1 - t] : NULL, gap, keep[t]);
    }
    for (int t = 0; done && t < count; t++) {
        done = keep_marked(&bed->trees[t], keep[t], e);
    }
    for (int t = 0; t < 2; t++) {
        segment_grid_free(grid[t]);
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

// Removes a terminal with all that leads to it alone; false when it is the last below a stem.
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

// Drops terminals here and there until `wanted` are left.
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
        Bounds bounds = make_bounds(bed, &bed->trees[t], others, gap);
        bool done = (!other || others) && turn_tree(bed, &bounds, e);
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
        tip[t] = murray_tip_radius(law, bed->trees[t].root_radius, wanted_terminals(bed));
        gap = bed->params->gap * tip[t] < gap ? bed->params->gap * tip[t] : gap;
        out_tree_murray_radii(bed->trees[t].tree, law, tip[t]);
    }
    // Fewer terminals make thinner vessels: what is clear now stays clear.
    if (!clear_touching(bed, gap, e)) {
        return false;
    }
    for (int t = 0; t < count; t++) {
        uint64_t seed = random_key(bed->seed, 1000 + (uint64_t)t);
        if (!thin_out(&bed->trees[t], wanted_terminals(bed), seed, e)) {
            return false;
        }
        out_tree_murray_radii(bed->trees[t].tree, law, tip[t]);
    }
    return turn_both(bed, gap, e);
}
