// The points of growth made visible: attractors, nodes, start points, what pulls what, the kill and
// influence distances.
#include "base/exact_math.h"
#include "base/memory.h"
#include "field/point_tree.h"
#include "objects/common/balls.h"
#include "objects/outtree/outtree.h"
#include "outtree/branching.h"

#include <math.h>
#include <stdlib.h>

enum { CIRCLE_POINTS = 97 };

// Which nodes are meant.
typedef bool NodeTest(const OutTree *tree, const Branching *branching, int64_t node);

static bool is_any(const OutTree *tree, const Branching *branching, int64_t node)
{
    (void)tree, (void)branching, (void)node;
    return true;
}

static bool is_start(const OutTree *tree, const Branching *branching, int64_t node)
{
    (void)branching;
    return tree->parent[node] < 0;
}

static bool is_tip(const OutTree *tree, const Branching *branching, int64_t node)
{
    (void)tree;
    return branching->children[node] == 0;
}

static NodeTest *const AROUND[] = {
    [SHOW_TIPS] = is_tip, [SHOW_STARTS] = is_start, [SHOW_NODES] = is_any};

// Positions of the nodes that are meant; the caller frees them.
static Vec3 *find_nodes(const OutTree *tree, NodeTest *test, int64_t *count, Error *e)
{
    Branching branching;
    *count = 0;
    if (!branching_init(&branching, tree, e)) {
        return NULL;
    }
    Vec3 *found = memory_alloc(tree->count, sizeof *found, e);
    for (int64_t i = 0; found && i < tree->count; i++) {
        if (test(tree, &branching, i)) {
            found[(*count)++] = tree->position[i];
        }
    }
    branching_free(&branching);
    return found;
}

static bool add_nodes(const OutTree *tree, NodeTest *test, float radius, const Placing *placing,
                      int role, Error *e)
{
    int64_t count = 0;
    Vec3 *found = radius > 0.0f ? find_nodes(tree, test, &count, e) : NULL;
    bool done = radius <= 0.0f || (found && balls_add(found, count, radius, placing, role, e));
    free(found);
    return done;
}

// ---- lines ----

static void fill_line(CurveSet *curves, int64_t curve, int points, float radius)
{
    int64_t first = curve * points;
    curves->first[curve + 1] = first + points;
    curves->id[curve] = (uint64_t)curve;
    for (int64_t i = first; i < first + points; i++) {
        curves->radius[i] = radius;
        curves->birth[i] = 0.0f;
        curves->along[i] = i == first
                               ? 0.0f
                               : curves->along[i - 1] +
                                     vec3_distance(curves->position[i - 1], curves->position[i]);
    }
}

// Circles about the centres, facing the given way.
static bool add_circles(const Vec3 *center, int64_t count, float size, Vec3 facing, float radius,
                        const Placing *placing, int role, Error *e)
{
    CurveSet *curves = curves_new(count * CIRCLE_POINTS, count, e);
    Vec3 n = vec3_normalize(facing), x = vec3_perpendicular(n), y = vec3_cross(n, x);
    for (int64_t c = 0; curves && c < count; c++) {
        for (int i = 0; i < CIRCLE_POINTS; i++) {
            float s, k;
            exact_sincos(2.0f * PI_F * (float)(i % (CIRCLE_POINTS - 1)) / (CIRCLE_POINTS - 1), &s,
                         &k);
            curves->position[c * CIRCLE_POINTS + i] =
                vec3_madd(vec3_madd(center[c], size * k, x), size * s, y);
        }
        fill_line(curves, c, CIRCLE_POINTS, radius);
    }
    return placing_add(placing, (Part){.curves = curves}, role, e);
}

static bool add_zones(const OutTree *tree, const ShowParams *show, const AttractorGroup *group,
                      const Placing *placing, Error *e)
{
    if (show->kill <= 0.0f && show->influence <= 0.0f) {
        return true;
    }
    int64_t count = 0;
    Vec3 *found = find_nodes(tree, AROUND[show->around], &count, e);
    bool done = found && (show->kill <= 0.0f || count == 0 ||
                          add_circles(found, count, group->kill, show->facing, show->kill, placing,
                                      OUTTREE_NODE, e));
    done = done && (show->influence <= 0.0f || count == 0 ||
                    add_circles(found, count, group->influence, show->facing, show->influence,
                                placing, OUTTREE_ATTRACTOR, e));
    free(found);
    return done;
}

// Nodes that the group's attractors pull, -1 = none: the nearest one within influence.
static int64_t find_pulled(const PointTree *nodes, const AttractorLog *log,
                           const AttractorGroup *group, int64_t *node)
{
    int64_t count = 0;
    for (int64_t i = 0; i < group->count; i++) {
        Vec3 p = log->position[group->first + i];
        const TreePoint *nearest = point_tree_nearest(nodes, p, -1);
        bool pulls = nearest && vec3_distance(nearest->position, p) < group->influence;
        node[i] = pulls ? nearest->index : -1;
        count += pulls;
    }
    return count;
}

// Lines from the group's attractors to the nodes that they pull (Tanaka et al., eq. (5)).
static bool add_pulls(const OutTree *tree, const ShowParams *show, const AttractorLog *log,
                      const AttractorGroup *group, const Placing *placing, Error *e)
{
    PointTree nodes;
    if (show->pulls <= 0.0f) {
        return true;
    }
    if (!point_tree_init(&nodes, tree->position, tree->count, e)) {
        return false;
    }
    int64_t *node = memory_alloc(group->count, sizeof *node, e);
    int64_t count = node ? find_pulled(&nodes, log, group, node) : 0;
    bool done = node;
    if (count > 0) {
        CurveSet *curves = curves_new(2 * count, count, e);
        for (int64_t i = 0, c = 0; curves && i < group->count; i++) {
            if (node[i] >= 0) {
                curves->position[2 * c] = log->position[group->first + i];
                curves->position[2 * c + 1] = tree->position[node[i]];
                fill_line(curves, c++, 2, show->pulls);
            }
        }
        done = placing_add(placing, (Part){.curves = curves}, OUTTREE_ATTRACTOR, e);
    }
    free(node);
    point_tree_free(&nodes);
    return done;
}

// ---- the narrow band ----

// The slice of the band: voxels through the middle of the envelope's box.
typedef struct Slice {
    const Envelope *envelope;
    Vec3 middle, x, y; // m; unit
    float voxel;       // m
    int half;          // voxels from the middle to an edge
} Slice;

static Slice slice_of(const OuttreeParams *params, const Envelope *envelope)
{
    Aabb box = envelope_bounds(envelope);
    Vec3 sides = vec3_sub(box.high, box.low), n = vec3_normalize(params->show.facing);
    float across = vec3_length(sides), extent = fmaxf(sides.x, fmaxf(sides.y, sides.z));
    Slice slice = {.envelope = envelope, .middle = vec3_lerp(box.low, box.high, 0.5f)};
    slice.voxel = params->element.voxel > 0.0f ? params->element.voxel : extent / 128.0f;
    slice.x = fabsf(n.y) < 0.9f ? vec3_normalize(vec3_cross(vec3(0, 1, 0), n)) : vec3(1, 0, 0);
    slice.y = vec3_cross(n, slice.x);
    slice.half = (int)fminf(0.5f * across / slice.voxel + 4.0f, 2000.0f);
    return slice;
}

// The slice's voxels within half the band's width of the surface, on one side of it.
static int64_t slice_band(const Slice *slice, bool inside, Vec3 *found)
{
    int64_t count = 0;
    float width = 2.99f * slice->voxel; // distances of a level set are clamped to three voxels
    for (int j = -slice->half; j <= slice->half; j++) {
        for (int i = -slice->half; i <= slice->half; i++) {
            Vec3 p = vec3_madd(slice->middle, (float)i * slice->voxel, slice->x);
            p = vec3_madd(p, (float)j * slice->voxel, slice->y);
            float d = envelope_distance(slice->envelope, p);
            if (fabsf(d) < width && (d < 0.0f) == inside) {
                found[count++] = p;
            }
        }
    }
    return count;
}

static bool add_band(const OuttreeParams *params, const Placing *placing, Error *e)
{
    if (params->show.band <= 0.0f) {
        return true;
    }
    Envelope *envelope = outtree_envelope(params, placing->recipe, e);
    if (!envelope) {
        return false;
    }
    Slice slice = slice_of(params, envelope);
    int64_t side = 2 * slice.half + 1;
    Vec3 *found = memory_alloc(side * side, sizeof *found, e);
    bool done = found;
    for (int inside = 0; done && inside < 2; inside++) {
        int64_t count = slice_band(&slice, inside, found);
        done = balls_add(found, count, params->show.band, placing,
                         inside ? OUTTREE_NODE : OUTTREE_ATTRACTOR, e);
    }
    free(found);
    envelope_free(envelope);
    return done;
}

static bool add_edges(const OutTree *tree, float radius, const Placing *placing, Error *e)
{
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        count += tree->parent[i] >= 0;
    }
    if (radius <= 0.0f || count == 0) {
        return true;
    }
    CurveSet *curves = curves_new(2 * count, count, e);
    for (int64_t i = 0, c = 0; curves && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            curves->position[2 * c] = tree->position[tree->parent[i]];
            curves->position[2 * c + 1] = tree->position[i];
            fill_line(curves, c++, 2, radius);
        }
    }
    return placing_add(placing, (Part){.curves = curves}, OUTTREE_SKIN, e);
}

bool outtree_show(const OuttreeParams *params, const OutTree *tree, const AttractorLog *log,
                  const Placing *placing, Error *e)
{
    const ShowParams *show = &params->show;
    if (!add_band(params, placing, e) || !add_edges(tree, show->edges, placing, e) ||
        !add_nodes(tree, is_any, show->nodes, placing, OUTTREE_NODE, e) ||
        !add_nodes(tree, is_start, show->starts, placing, OUTTREE_NODE, e)) {
        return false;
    }
    if (!log || log->group_count == 0) {
        return true;
    }
    const AttractorGroup *group = &log->group[log->group_count - 1];
    return (show->attractors <= 0.0f ||
            balls_add(log->position + group->first, group->count, show->attractors, placing,
                      OUTTREE_ATTRACTOR, e)) &&
           add_zones(tree, show, group, placing, e) &&
           add_pulls(tree, show, log, group, placing, e);
}
