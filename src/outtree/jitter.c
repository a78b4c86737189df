#include "outtree/jitter.h"

#include "base/exact_math.h"
#include "base/fbm.h"
#include "base/memory.h"
#include "base/random.h"
#include "outtree/chains.h"

#include <stdlib.h>
#include <string.h>

// Half width of the window over which a chain's direction is taken, as a share of its length.
#define DIRECTION_REACH 0.05

typedef struct Jitter {
    const JitterParams *params;
    OutTree *tree;
    Vec3 *old; // positions before
    int32_t *children;
    Fbm *fbm;
    double *way;   // m along a chain
    double *a, *b; // two bridges, with room for the longest chain
} Jitter;

JitterParams jitter_params_default(void)
{
    return (JitterParams){.hurst = 0.7f, .reference = 1.0f, .seed = 1, .stride = 1.0f};
}

// Fills j->way with the arc lengths along the piece; returns the total, m.
static double measure_piece(const Jitter *j, const int32_t *node, int64_t steps)
{
    j->way[0] = 0.0;
    for (int64_t k = 1; k <= steps; k++) {
        j->way[k] = j->way[k - 1] + (double)vec3_distance(j->old[node[k - 1]], j->old[node[k]]);
    }
    return j->way[steps];
}

// Standard deviation of the process after a step of this length (m), m.
static double step_deviation(const Jitter *j, double step)
{
    double share = step / (double)j->params->reference;
    return share > 0.0 ? (double)j->params->amplitude *
                             exact_exp((double)j->params->hurst * exact_log(share))
                       : 0.0;
}

// Linear interpolation at x of a path given at 0 .. steps.
static float path_at(const double *path, int64_t steps, double x)
{
    int64_t k = (int64_t)x;
    if (k >= steps) {
        return (float)path[steps];
    }
    return (float)(path[k] + (x - (double)k) * (path[k + 1] - path[k]));
}

// A sliding window over a piece.
typedef struct Window {
    int64_t first, last;
    double reach; // m, to either side of its centre
} Window;

// Direction of the chain about place k, smoothed so that the displacement across it does not swing
// with every step, least of all where nodes crowd at forks. k must not decrease from call to call.
static Vec3 direction_at(const Jitter *j, const int32_t *node, int64_t steps, int64_t k, Window *w)
{
    while (w->first < k && j->way[k] - j->way[w->first] > w->reach) {
        w->first++;
    }
    while (w->last < steps && (w->last <= k || j->way[w->last] - j->way[k] < w->reach)) {
        w->last++;
    }
    Vec3 d = vec3_normalize(vec3_sub(j->old[node[w->last]], j->old[node[w->first]]));
    return vec3_dot(d, d) > 0.5f ? d : vec3(0, 1, 0);
}

// Unit vector along the component of v perpendicular to the unit vector d.
static Vec3 across(Vec3 v, Vec3 d)
{
    v = vec3_madd(v, -vec3_dot(v, d), d);
    return vec3_dot(v, v) > 1e-8f ? vec3_normalize(v) : vec3_perpendicular(d);
}

static void place_in_space(const Jitter *j, int32_t node, Vec3 shift, Vec3 offset)
{
    j->tree->position[node] = vec3_add(vec3_add(j->old[node], shift), offset);
}

// On a surface: moves the node along the surface by the length of the displacement, stride by
// stride, projecting it back onto the surface after each.
static void place_on_surface(const Jitter *j, int32_t node, Vec3 shift, Vec3 offset)
{
    const JitterParams *params = j->params;
    Vec3 p = j->old[node], n = j->tree->normal[node], d = vec3_add(shift, offset);
    d = vec3_madd(d, -vec3_dot(d, n), n);
    float left = vec3_length(d);
    d = vec3_normalize(d);
    do {
        float stride = left < params->stride ? left : params->stride;
        p = vec3_madd(p, stride, d);
        params->project(params->surface, &p, &n);
        d = vec3_madd(d, -vec3_dot(d, n), n);
        left = vec3_dot(d, d) > 0.01f ? left - stride : 0.0f; // stopped by an edge
        d = vec3_normalize(d);
    } while (left > 0.0f);
    j->tree->position[node] = p;
    j->tree->normal[node] = n;
}

// Displaces the nodes after node[0] of a piece of a chain; node[0] has its new position already.
// The piece's end moves by the same displacement as its start.
static bool jitter_piece(Jitter *j, const int32_t *node, int64_t steps, Error *e)
{
    const OutTree *tree = j->tree;
    uint64_t key = random_key(tree->id[node[1]], j->params->seed);
    if (!fbm_bridges(j->fbm, steps, key, j->a, j->b, e)) {
        return false;
    }
    // The process is sampled uniformly by arc length, so nodes closer than a sample stay close.
    double length = measure_piece(j, node, steps), step = length / (double)steps;
    float scale = (float)step_deviation(j, step);
    Window window = {0, 0, DIRECTION_REACH * length};
    Vec3 shift = vec3_sub(tree->position[node[0]], j->old[node[0]]);
    Vec3 side = across(tree->normal[node[0]], direction_at(j, node, steps, 0, &window));
    bool in_space = !j->params->project;
    for (int64_t k = 1; k <= steps; k++) {
        double x = k == steps || step == 0.0 ? (double)steps : j->way[k] / step;
        float a = scale * path_at(j->a, steps, x), b = scale * path_at(j->b, steps, x);
        Vec3 d = direction_at(j, node, steps, k, &window);
        if (in_space) {
            side = across(side, d); // parallel transport, without twist
            Vec3 offset = vec3_scale(side, a);
            place_in_space(j, node[k], shift, vec3_madd(offset, b, vec3_cross(d, side)));
        } else {
            Vec3 tangent = across(d, tree->normal[node[k]]);
            Vec3 offset = vec3_scale(vec3_cross(tree->normal[node[k]], tangent), a);
            place_on_surface(j, node[k], shift, offset);
        }
    }
    return true;
}

static bool jitter_chain(Jitter *j, const int32_t *node, int64_t count, Error *e)
{
    int64_t start = 0;
    for (int64_t end = 1; end < count; end++) {
        bool pinned = j->params->pin_forks && j->children[node[end]] > 1;
        if (pinned || end == count - 1) {
            if (!jitter_piece(j, node + start, end - start, e)) {
                return false;
            }
            start = end;
        }
    }
    return true;
}

static bool jitter_chains(Jitter *j, const ChainSet *chains, const Run *run, Error *e)
{
    for (int64_t i = 0; i < j->tree->count; i++) {
        if (j->tree->parent[i] >= 0) {
            j->children[j->tree->parent[i]]++;
        }
    }
    for (int64_t c = 0; c < chains->count; c++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (!jitter_chain(j, chains->node + chains->first[c],
                          chains->first[c + 1] - chains->first[c], e)) {
            return false;
        }
    }
    return true;
}

static int64_t longest_chain(const ChainSet *chains)
{
    int64_t most = 1;
    for (int64_t c = 0; c < chains->count; c++) {
        int64_t count = chains->first[c + 1] - chains->first[c];
        most = count > most ? count : most;
    }
    return most;
}

bool out_tree_jitter(OutTree *tree, const JitterParams *params, const Run *run, Error *e)
{
    if (params->project && !(params->stride > 0.0f)) {
        return error_set(e, ERROR_INPUT, "jitter with strides of %g m; they must be longer than 0",
                         (double)params->stride);
    }
    if (!(params->amplitude >= 0.0f && params->reference > 0.0f)) {
        return error_set(e, ERROR_INPUT,
                         "jitter of %g m after %g m; neither may be negative, nor the second 0",
                         (double)params->amplitude, (double)params->reference);
    }
    Jitter j = {.params = params, .tree = tree, .fbm = fbm_new((double)params->hurst, e)};
    ChainSet *chains = j.fbm ? out_tree_chains(tree, e) : NULL;
    bool done = chains;
    if (done) {
        int64_t longest = longest_chain(chains);
        j.old = memory_alloc(tree->count, sizeof *j.old, e);
        j.children = memory_alloc_zero(tree->count, sizeof *j.children, e);
        j.way = memory_alloc(longest, sizeof *j.way, e);
        j.a = memory_alloc(longest, sizeof *j.a, e);
        j.b = memory_alloc(longest, sizeof *j.b, e);
        done = j.old && j.children && j.way && j.a && j.b;
    }
    if (done && tree->count > 0) {
        memcpy(j.old, tree->position, sizeof *j.old * (size_t)tree->count);
        done = jitter_chains(&j, chains, run, e);
    }
    free(j.old);
    free(j.children);
    free(j.way);
    free(j.a);
    free(j.b);
    chains_free(chains);
    fbm_free(j.fbm);
    return done;
}
