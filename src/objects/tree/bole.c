#include "objects/tree/bole.h"

#include "base/random.h"

int64_t tree_highest_node(const OutTree *tree)
{
    int64_t top = -1;
    for (int64_t i = 0; i < tree->count; i++) {
        top = top < 0 || tree->position[i].y > tree->position[top].y ? i : top;
    }
    return top;
}

static float nearest_distance(const PointSet *points, Vec3 p)
{
    float best2 = INFINITY;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 apart = vec3_sub(points->position[i], p);
        float distance2 = vec3_dot(apart, apart);
        best2 = distance2 < best2 ? distance2 : best2;
    }
    return sqrtf(best2);
}

static float tree_distance(const PointSet *points, const OutTree *tree)
{
    float best = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        float distance = nearest_distance(points, tree->position[i]);
        best = distance < best ? distance : best;
    }
    return best;
}

// Mean direction of the attractors that would influence p if the nearest one were next to it, at
// most 60 degrees from the direction of that one, so that each step approaches it.
static Vec3 pull_at(const PointSet *points, Vec3 p, float influence)
{
    float near = nearest_distance(points, p);
    Vec3 sum = vec3(0, 0, 0), first = sum;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 apart = vec3_sub(points->position[i], p);
        float distance = vec3_length(apart);
        if (distance <= near + influence) {
            Vec3 unit = vec3_scale(apart, 1.0f / distance);
            sum = vec3_add(sum, unit);
            first = distance <= near ? unit : first;
        }
    }
    Vec3 mean = vec3_normalize(sum);
    return vec3_dot(mean, first) >= 0.5f ? mean : first;
}

// Adds nodes from `node` on until an attractor is within `goal`; *length: their length, m.
static bool lengthen(OutTree *tree, int64_t node, const PointSet *points, float goal,
                     float influence, float step, float *length, const Run *run, Error *e)
{
    enum { MOST_NODES = 4000 };
    int64_t parent = tree->parent[node];
    Vec3 heading = parent >= 0
                       ? vec3_normalize(vec3_sub(tree->position[node], tree->position[parent]))
                       : vec3(0, 1, 0);
    *length = 0.0f;
    for (int i = 0; i < MOST_NODES; i++) {
        Vec3 p = tree->position[node];
        if (nearest_distance(points, p) <= goal) {
            break;
        }
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        heading = vec3_normalize(vec3_lerp(heading, pull_at(points, p, influence), 0.2f));
        node = out_tree_add_node(tree, vec3_madd(p, step, heading), node, tree->birth[node] + 1,
                                 tree->colony[node], out_tree_child_id(tree->id[node], 0), e);
        if (node < 0) {
            return false;
        }
        *length += step;
    }
    return true;
}

static bool bole_toward(OutTree *tree, const PointSet *points, float influence,
                        const TreeParams *params, const Recipe *recipe, Error *e)
{
    float away = tree_distance(points, tree);
    if (away < influence) {
        return true;
    }
    int64_t top = tree_highest_node(tree);
    float length, way = nearest_distance(points, tree->position[top]);
    float step = 0.8f * params->trunk.radius;
    step = step > way / 200.0f ? step : way / 200.0f;
    step = step < 0.25f * influence ? step : 0.25f * influence;
    if (!lengthen(tree, top, points, 0.5f * influence, influence, step, &length, recipe->run, e)) {
        return false;
    }
    if (length > params->height) {
        recipe_warn(recipe, "crown",
                    "its nearest attractor is %.3g m from the trunk, but the influence of the "
                    "first level is %.3g m: the trunk was extended by %.3g m to reach it; if this "
                    "is not intended, move the crown's envelope",
                    (double)away, (double)influence, (double)length);
    }
    return true;
}

bool tree_grow_bole(OutTree *tree, const TreeParams *params, const Envelope *envelope,
                    uint64_t seed, const Recipe *recipe, Error *e)
{
    const ElementParams *crown = &params->crown.element;
    if (crown->level_count < 1) {
        return true;
    }
    float influence;
    ScatterParams scatter =
        element_scatter_params(tree, crown, random_key(seed, STREAM_ELEMENT_POINTS));
    Density *density;
    PointSet *points = element_density(crown, &scatter, &density, recipe->run, e)
                           ? colonize_first_attractors(envelope, &scatter, &crown->levels[0],
                                                       &influence, recipe->run, e)
                           : NULL;
    density_free(density);
    bool done = points && bole_toward(tree, points, influence, params, recipe, e);
    points_free(points);
    return done;
}
