// Start points and attractors that are placed, not scattered.
#include "objects/outtree/outtree.h"

#include "base/random.h"
#include "field/point_tree.h"
#include "objects/common/starts.h"
#include "shape/mesh_nearest.h"

enum { CANDIDATES_A_START = 60 };

static bool lies_on_surface(const OuttreeParams *params)
{
    return params->element.points.place == SCATTER_SURFACE;
}

// Where a placed point is, and its normal.
static PlacedPoint settle_point(const OuttreeParams *params, const Envelope *envelope, int i)
{
    PlacedPoint point = params->placed.points[i];
    Vec3 given = point.normal, normal = vec3(0, 1, 0);
    if (lies_on_surface(params)) {
        mesh_nearest(envelope_surface(envelope), &point.position, &normal);
    }
    point.normal = vec3_length(given) > 0.0f ? vec3_normalize(given) : normal;
    return point;
}

static bool plant_placed(OutTree *tree, const OuttreeParams *params, const Envelope *envelope,
                         uint64_t seed, Error *e)
{
    bool done = true;
    for (int i = 0; done && i < params->placed.count; i++) {
        if (params->placed.points[i].group != GROUP_NODE) {
            continue;
        }
        PlacedPoint point = settle_point(params, envelope, i);
        int64_t node = out_tree_add_node(tree, point.position, -1, 0, (int32_t)tree->count,
                                         random_key(seed, (uint64_t)i), e);
        done = node >= 0;
        if (done) {
            tree->normal[node] = point.normal;
        }
    }
    return done;
}

bool outtree_plant(OutTree *tree, const OuttreeParams *params, const Envelope *envelope,
                   const Recipe *recipe, Error *e)
{
    if (!plant_placed(tree, params, envelope, random_key(recipe->seed, STREAM_OUTTREE_PLACED), e)) {
        return false;
    }
    int count = params->starts.count;
    count = count == 0 && tree->count == 0 ? 1 : count;
    if (count == 0) {
        return true;
    }
    ScatterParams scatter = scatter_params_default();
    scatter.place = SCATTER_SURFACE;
    scatter.count = (int64_t)count * CANDIDATES_A_START;
    scatter.seed = random_key(recipe->seed, STREAM_OUTTREE_CANDIDATES);
    PointSet *points = points_scatter(envelope, &scatter, recipe->run, e);
    int64_t first = tree->count;
    bool done =
        points && starts_spread(tree, points, params->starts.direction, count,
                                random_key(recipe->seed, STREAM_OUTTREE_STARTS), recipe->run, e);
    points_free(points);
    for (int64_t i = first; done && !lies_on_surface(params) && i < tree->count; i++) {
        tree->normal[i] = vec3_neg(tree->normal[i]); // on the surface of a volume, it heads inward
    }
    return done;
}

// Mean distance from a point to its nearest neighbour, m.
static bool mean_gap(const PointSet *points, double *gap, Error *e)
{
    PointTree tree;
    double sum = 0.0;
    *gap = 1.0;
    if (points->count < 2) {
        return true;
    }
    if (!point_tree_init(&tree, points->position, points->count, e)) {
        return false;
    }
    for (int64_t i = 0; i < points->count; i++) {
        const TreePoint *nearest = point_tree_nearest(&tree, points->position[i], i);
        sum += (double)vec3_distance(points->position[i], nearest->position);
    }
    point_tree_free(&tree);
    *gap = sum / (double)points->count;
    return true;
}

PointSet *outtree_placed_attractors(const OuttreeParams *params, const Envelope *envelope,
                                    uint64_t seed, Error *e)
{
    PointSet *points = points_new(e);
    bool done = points;
    for (int i = 0; done && i < params->placed.count; i++) {
        if (params->placed.points[i].group == GROUP_ATTRACTOR) {
            PlacedPoint point = settle_point(params, envelope, i);
            done =
                points_add(points, point.position, point.normal, random_key(seed, (uint64_t)i), e);
        }
    }
    double gap;
    if (!done || !mean_gap(points, &gap, e)) {
        points_free(points);
        return NULL;
    }
    points->dimension = lies_on_surface(params) ? 2 : 3;
    points->measure =
        (double)points->count * (points->dimension == 2 ? gap * gap : gap * gap * gap);
    return points;
}
