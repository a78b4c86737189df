#include "tree/jitter.h"

#include "base/exact_math.h"
#include "base/fbm.h"
#include "base/memory.h"
#include "base/random.h"
#include "tree/chains.h"

#include <stdlib.h>
#include <string.h>

typedef struct Jitter {
    const JitterParams *params;
    OutTree *tree;
    Vec3 *old; // positions before
    int32_t *children;
    Fbm *fbm;
    double *a, *b; // two bridges, as long as the longest chain
} Jitter;

JitterParams jitter_params_default(void)
{
    return (JitterParams){.hurst = 0.7f, .reference = 1.0f, .seed = 1};
}

static float piece_length(const Jitter *j, const int32_t *node, int64_t steps)
{
    float length = 0.0f;
    for (int64_t k = 1; k <= steps; k++) {
        length += vec3_distance(j->old[node[k - 1]], j->old[node[k]]);
    }
    return length;
}

// Standard deviation of the process after a step of this length (m), m.
static double step_deviation(const Jitter *j, double step)
{
    double share = step / (double)j->params->reference;
    return share > 0.0 ? (double)j->params->amplitude *
                             exact_exp((double)j->params->hurst * exact_log(share))
                       : 0.0;
}

// A path drawn at 0 .. steps, at x; straight between.
static float path_at(const double *path, int64_t steps, double x)
{
    int64_t k = (int64_t)x;
    if (k >= steps) {
        return (float)path[steps];
    }
    return (float)(path[k] + (x - (double)k) * (path[k + 1] - path[k]));
}

// The direction of the chain at place k of a piece of `steps` steps, over at least a step of the
// process either way: nodes that crowd at forks may point anywhere.
static Vec3 direction_at(const Jitter *j, const int32_t *node, int64_t steps, int64_t k,
                         float reach)
{
    int64_t first = k, last = k;
    for (float way = 0.0f; first > 0 && way < reach; first--) {
        way += vec3_distance(j->old[node[first - 1]], j->old[node[first]]);
    }
    for (float way = 0.0f; last < steps && way < reach; last++) {
        way += vec3_distance(j->old[node[last]], j->old[node[last + 1]]);
    }
    Vec3 d = vec3_normalize(vec3_sub(j->old[node[last]], j->old[node[first]]));
    return vec3_dot(d, d) > 0.5f ? d : vec3(0, 1, 0);
}

// v across the unit vector d, as a unit vector.
static Vec3 across(Vec3 v, Vec3 d)
{
    v = vec3_madd(v, -vec3_dot(v, d), d);
    return vec3_dot(v, v) > 1e-8f ? vec3_normalize(v) : vec3_perpendicular(d);
}

static void place_in_space(const Jitter *j, int32_t node, Vec3 shift, Vec3 offset)
{
    j->tree->position[node] = vec3_add(vec3_add(j->old[node], shift), offset);
}

// On a surface, shift and offset lie in the tangent plane at the old place; the end goes back to
// the surface.
static void place_on_surface(const Jitter *j, int32_t node, Vec3 shift, Vec3 offset)
{
    Vec3 n = j->tree->normal[node];
    Vec3 move = vec3_add(shift, offset);
    move = vec3_madd(move, -vec3_dot(move, n), n);
    Vec3 p = vec3_add(j->old[node], move);
    j->params->project(j->params->surface, &p, &n);
    j->tree->position[node] = p;
    j->tree->normal[node] = n;
}

// Displaces the nodes after node[0] of a piece of a chain; node[0] is in its new place already.
// The piece's end moves as its start did.
static bool jitter_piece(Jitter *j, const int32_t *node, int64_t steps, Error *e)
{
    const OutTree *tree = j->tree;
    uint64_t key = random_key(tree->id[node[1]], j->params->seed);
    if (!fbm_bridges(j->fbm, steps, key, j->a, j->b, e)) {
        return false;
    }
    // The process runs evenly along the piece; nodes closer than that stay close.
    double step = (double)piece_length(j, node, steps) / (double)steps, way = 0.0;
    float scale = (float)step_deviation(j, step), reach = 0.99f * (float)step;
    Vec3 shift = vec3_sub(tree->position[node[0]], j->old[node[0]]);
    Vec3 side = across(tree->normal[node[0]], direction_at(j, node, steps, 0, reach));
    bool in_space = !j->params->project;
    for (int64_t k = 1; k <= steps; k++) {
        Vec3 d = direction_at(j, node, steps, k, reach);
        way += (double)vec3_distance(j->old[node[k - 1]], j->old[node[k]]);
        double x = k == steps || step == 0.0 ? (double)steps : way / step;
        float a = scale * path_at(j->a, steps, x), b = scale * path_at(j->b, steps, x);
        if (in_space) {
            side = across(side, d); // carried along without twist
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
        j.a = memory_alloc(longest, sizeof *j.a, e);
        j.b = memory_alloc(longest, sizeof *j.b, e);
        done = j.old && j.children && j.a && j.b;
    }
    if (done && tree->count > 0) {
        memcpy(j.old, tree->position, sizeof *j.old * (size_t)tree->count);
        done = jitter_chains(&j, chains, run, e);
    }
    free(j.old);
    free(j.children);
    free(j.a);
    free(j.b);
    chains_free(chains);
    fbm_free(j.fbm);
    return done;
}
