#include "objects/vessels/room.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/room.h"

#include <stdlib.h>

enum { STREAM_POINTS = 1, STREAM_GROWTH = 2 }; // of one level of one tree

// Attractors of the finest level per terminal, and of a level per attractor of the next coarser
// one.
#define ATTRACTORS_PER_TERMINAL 6
#define LEVEL_RATIO 8

// Surplus of grown terminals: some are removed where vessels touch.
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

static void relax(OutTree *tree, int64_t first, float share)
{
    for (int64_t i = tree->count - 1; i >= first; i--) {
        tree->position[i] = vec3_lerp(tree->position[i], tree->position[tree->parent[i]], share);
    }
}

// Drops points outside of the organ, in obstacles or inside the other tree's vessels.
static void keep_free_points(PointSet *points, const VesselRoom *room, float clearance)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = points->position[i];
        if (envelope_contains(room->envelope, p) &&
            (!room->taken || room->taken->allows(room->taken->user, p)) &&
            !(room->others && segment_grid_touches(room->others, p, p, clearance, 0.0f))) {
            points->position[kept] = p;
            points->normal[kept] = points->normal[i];
            points->id[kept++] = points->id[i];
        }
    }
    points->count = kept;
}

// Estimates the final radii, assuming that every present terminal supplies an equal share of the
// organ.
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

// Drops nodes from `first` on at places not allowed, with their descendants.
static bool keep_allowed(OutTree *tree, int64_t first, const VesselRoom *room, Error *e)
{
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    for (int64_t i = 0; keep && i < tree->count; i++) {
        keep[i] = i < first || vessel_room_is_free(room, tree->position[tree->parent[i]],
                                                   tree->position[i], tree->radius[i]);
    }
    bool done = keep && out_tree_keep_nodes(tree, keep, e);
    free(keep);
    return done;
}

static bool grow_toward(VesselBed *bed, VesselTree *tree, PointSet *points, const GrowLevel *level,
                        uint64_t seed, Error *e)
{
    const ElementParams *element = &bed->params->element;
    GuideField *field;
    if (!element_guide_field(tree->tree, tree->stem_count, element, bed->envelope,
                             random_key(bed->recipe->seed, STREAM_FIELD), bed->recipe->run, &field,
                             e)) {
        return false;
    }
    ColonizeParams params = element_colonize_params(tree->tree, element, field, seed);
    colonize_auto(&params, points_spacing(points), level->step, level->kill, level->influence);
    params.noise = level->noise;
    params.room = bed->recipe->room;
    params.tropism = vec3_scale(params.tropism, level->tropism);
    params.first_step = tree->last_birth;
    GrowReport report;
    int64_t first = tree->tree->count;
    bool done = colonize(tree->tree, points, &params, bed->recipe->run, &report, e);
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

// The level's attractors in the organ, shrunk by its scale.
static PointSet *scatter_level(const VesselBed *bed, const VesselTree *tree, const GrowLevel *level,
                               float scale, uint64_t seed, Error *e)
{
    const ElementParams *element = &bed->params->element;
    ScatterParams scatter =
        element_scatter_params(tree->tree, element, random_key(seed, STREAM_POINTS));
    scatter.count = level->attractors;
    scatter.scale = scale;
    Density *density;
    PointSet *points = element_density(element, &scatter, &density, bed->recipe->run, e)
                           ? points_scatter(bed->envelope, &scatter, bed->recipe->run, e)
                           : NULL;
    density_free(density);
    return points;
}

// The attractors that one tree can reach, and where it may grow. A coarse level shrinks the organ,
// so that its vessels keep away from the surface; an organ with a cavity is shrunk out of itself,
// so it keeps its size where fewer than half of the points remain.
static PointSet *free_points(const VesselBed *bed, const VesselTree *tree,
                             const SegmentGrid *others, const GrowLevel *level, uint64_t seed,
                             VesselRoom *room, Error *e)
{
    for (float scale = level->scale;; scale = 1.0f) {
        PointSet *points = scatter_level(bed, tree, level, scale, seed, e);
        if (!points) {
            return NULL;
        }
        float spacing = (float)points_spacing(points);
        int64_t scattered = points->count;
        *room = vessel_room(bed, tree, others, 0.05f * spacing);
        keep_free_points(points, room, 0.2f * spacing);
        if (scale == 1.0f || 2 * points->count >= scattered) {
            return points;
        }
        points_free(points);
    }
}

// Grows one level of one tree around the other tree.
static bool grow_around(VesselBed *bed, VesselTree *tree, const SegmentGrid *others,
                        const GrowLevel *level, bool coarse, uint64_t seed, Error *e)
{
    VesselRoom room;
    PointSet *points = free_points(bed, tree, others, level, seed, &room, e);
    if (!points) {
        return false;
    }
    int64_t first = tree->tree->count;
    bool done = points->count == 0 ||
                grow_toward(bed, tree, points, level, random_key(seed, STREAM_GROWTH), e);
    points_free(points);
    return done && foresee_radii(bed, tree, e) && keep_allowed(tree->tree, first, &room, e) &&
           foresee_radii(bed, tree, e) && (!coarse || vessel_room_turn(bed, &room, e));
}

// coarse: more levels follow, which fill the gaps that turning the forks opens.
static bool grow_level(VesselBed *bed, const GrowLevel *level, int number, bool coarse, Error *e)
{
    int32_t last = 0;
    for (int t = 0; t < bed->tree_count; t++) {
        const OutTree *other = bed->tree_count > 1 ? bed->trees[1 - t].tree : NULL;
        SegmentGrid *others = other ? segment_grid_new(other, e) : NULL;
        uint64_t seed = random_key(random_key(bed->recipe->seed, (uint64_t)number), (uint64_t)t);
        bool done =
            (!other || others) && grow_around(bed, &bed->trees[t], others, level, coarse, seed, e);
        segment_grid_free(others);
        if (!done) {
            return false;
        }
        last = bed->trees[t].last_birth > last ? bed->trees[t].last_birth : last;
    }
    for (int t = 0; t < bed->tree_count; t++) {
        bed->trees[t].last_birth = last; // both start their next level at the same time
    }
    return true;
}

// Default levels, coarse to fine, scaled to the number of terminals. Returns how many.
static int choose_levels(const VesselBed *bed, GrowLevel *levels)
{
    const ElementParams *element = &bed->params->element;
    static const float step[4] = {0.10f, 0.20f, 0.30f, 0.40f}, kill[4] = {0.4f, 0.7f, 0.8f, 0.8f},
                       influence[4] = {4.0f, 2.5f, 2.2f, 2.0f}, scale[4] = {0.75f, 0.9f, 0.97f, 1};
    int64_t attractors[MOST_LEVELS];
    int count = 0;
    for (int64_t n = ATTRACTORS_PER_TERMINAL * vessel_wanted_terminals(bed);
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
                                .noise = element->growth.noise,
                                .tropism = 1.0f,
                                .relax = 0.5f};
    }
    return count;
}

static bool grow_levels(VesselBed *bed, const GrowLevel *levels, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        run_progress(bed->recipe->run, "vessels", (double)i / (double)count);
        if (!grow_level(bed, &levels[i], i, i + 1 < count, e)) {
            return false;
        }
    }
    // Repeat the finest level until there are enough terminals.
    for (int fill = 0; fill < MOST_FILLS; fill++) {
        bool enough = true;
        for (int t = 0; t < bed->tree_count; t++) {
            int64_t terminals;
            if (!count_terminals(bed->trees[t].tree, &terminals, e)) {
                return false;
            }
            enough = enough && (double)terminals >= SURPLUS * (double)vessel_wanted_terminals(bed);
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
