#include "grow/venation/venation.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/venation/young_leaf.h"
#include "outtree/join.h"

#include <stdlib.h>

#define REACH 6.0f   // births: influence radius of sources; they lie closer than that
#define DARTS 1.5f   // darts thrown per round for each source that the blade has room for
#define SETTLE 400   // most steps after the blade is fully grown
#define TOOTHED 0.5f // relative size of the blade from which veins grow toward its teeth

enum { STREAM_ROUNDS = 1 }; // of the seed; one stream per round from it on; 0: young_leaf.c
enum { STREAM_TEETH = -1 }; // of the seed
enum { STREAM_X = 0, STREAM_Y = 1 }; // of a dart

static Aabb blade_box(const Leaf *leaf)
{
    const LeafOutline *o = &leaf->params->outline;
    float s = leaf->scale;
    return (Aabb){vec3(-0.5f * s * o->width, 0, 0), vec3(0.5f * s * o->width, s * o->length, 0)};
}

// ---- sources ----

static bool add_source(Leaf *leaf, Vec3 p, uint64_t id, Error *e)
{
    int64_t n = leaf->source_count;
    if (!memory_reserve(&leaf->source, &leaf->source_capacity, n + 1, sizeof *leaf->source, e) ||
        (leaf->all_sources && !points_add(leaf->all_sources, p, vec3(0, 0, 1), id, e))) {
        return false;
    }
    leaf->source[n] = p;
    leaf->report.sources++;
    leaf->source_count++;
    return true;
}

static bool is_free(const Leaf *leaf, int64_t old_sources, Vec3 p)
{
    float birth = leaf->params->birth;
    if (vein_nearest(&leaf->nodes, leaf->tree->position, p, birth) >= 0 ||
        vein_nearest(&leaf->darts, leaf->source, p, birth) >= 0) {
        return false;
    }
    for (int64_t i = old_sources; i < leaf->source_count; i++) {
        if (vec3_distance(leaf->source[i], p) < birth) {
            return false;
        }
    }
    return true;
}

static bool throw_darts(Leaf *leaf, int round, Error *e)
{
    const VeinParams *params = leaf->params;
    Aabb box = blade_box(leaf);
    Vec3 size = vec3_sub(box.high, box.low);
    int64_t darts = (int64_t)(DARTS * size.x * size.y / (params->birth * params->birth)) + 8;
    int64_t old = leaf->source_count;
    if (!vein_grid_fill(&leaf->nodes, leaf->tree->position, leaf->tree->count, box, params->birth,
                        e) ||
        !vein_grid_fill(&leaf->darts, leaf->source, old, box, params->birth, e)) {
        return false;
    }
    uint64_t key = random_key(params->seed, STREAM_ROUNDS + (uint64_t)round);
    for (int64_t i = 0; i < darts; i++) {
        if (!run_goes_on(leaf->run, i, e)) {
            return false;
        }
        uint64_t dart = random_key(key, (uint64_t)i);
        Vec3 p = vec3(random_range(random_key(dart, STREAM_X), box.low.x, box.high.x),
                      random_range(random_key(dart, STREAM_Y), box.low.y, box.high.y), 0);
        if (leaf_contains(&params->outline, leaf->scale, p) && is_free(leaf, old, p) &&
            !add_source(leaf, p, dart, e)) {
            return false;
        }
    }
    return true;
}

// Teeth are maxima of auxin: a source in the point of each, short of the margin.
static bool add_teeth(Leaf *leaf, Error *e)
{
    const VeinParams *params = leaf->params;
    uint64_t key = random_key(params->seed, (uint64_t)STREAM_TEETH);
    for (int i = 0; i < 2 * params->outline.teeth; i++) {
        float side = i % 2 == 0 ? -1.0f : 1.0f;
        Vec3 p = leaf_tooth(&params->outline, side, i / 2);
        p.x -= side * 0.5f * params->kill;
        if (p.x * side > 0.0f &&
            !add_source(leaf, vec3_scale(p, leaf->scale), random_key(key, (uint64_t)i), e)) {
            return false;
        }
    }
    return true;
}

static void remove_source(Leaf *leaf, int64_t i)
{
    leaf->source_count--;
    leaf->source[i] = leaf->source[leaf->source_count];
}

// ---- veins ----

static void add_pull(Leaf *leaf, int32_t node, Vec3 source)
{
    Pull *pull = &leaf->pull[node];
    Vec3 way = vec3_sub(source, leaf->tree->position[node]), unit = vec3_normalize(way);
    float distance = vec3_length(way);
    pull->sum = vec3_add(pull->sum, unit);
    if (distance < pull->distance) {
        pull->distance = distance;
        pull->nearest = unit;
    }
}

// All veins that grow toward the source have arrived and meet in it. Neighbours connected nearby
// count as one vein.
static bool close_loop(Leaf *leaf, Vec3 source, const int32_t *neighbour, int count, Error *e)
{
    int32_t met[VEIN_MAX_NEIGHBOURS];
    int meeting = 0;
    for (int k = 0; k < count; k++) {
        bool is_new = true;
        for (int m = 0; m < meeting; m++) {
            is_new = is_new && out_tree_path_exceeds(leaf->tree, met[m], neighbour[k],
                                                     3.0f * leaf->params->birth);
        }
        if (is_new) {
            met[meeting++] = neighbour[k];
        }
    }
    for (int m = 0; meeting > 1 && m < meeting; m++) {
        if (leaf_add_node(leaf, source, met[m], e) < 0) {
            return false;
        }
    }
    leaf->report.loops += meeting > 1 ? meeting - 1 : 0;
    return true;
}

// A source of closed venation: pulls those of its neighbours that have not arrived. *done: all
// have.
static bool pull_closed(Leaf *leaf, Vec3 source, bool *done, Error *e)
{
    const VeinParams *params = leaf->params;
    int32_t neighbour[VEIN_MAX_NEIGHBOURS];
    int count = vein_relative_neighbours(&leaf->nodes, leaf->tree->position, source,
                                         REACH * params->birth, neighbour);
    *done = count > 0;
    for (int k = 0; k < count; k++) {
        if (vec3_distance(leaf->tree->position[neighbour[k]], source) > params->kill) {
            add_pull(leaf, neighbour[k], source);
            *done = false;
        }
    }
    return !*done || close_loop(leaf, source, neighbour, count, e);
}

static bool pull_open(Leaf *leaf, Vec3 source, bool *done)
{
    int32_t node =
        vein_nearest(&leaf->nodes, leaf->tree->position, source, REACH * leaf->params->birth);
    *done = node >= 0 && vec3_distance(leaf->tree->position[node], source) <= leaf->params->kill;
    if (node >= 0 && !*done) {
        add_pull(leaf, node, source);
    }
    return true;
}

// Sums the pulls of all sources and removes those that are reached.
static bool gather_pulls(Leaf *leaf, Error *e)
{
    int64_t count = leaf->tree->count;
    if (!memory_reserve(&leaf->pull, &leaf->pull_capacity, count, sizeof *leaf->pull, e) ||
        !vein_grid_fill(&leaf->nodes, leaf->tree->position, count, blade_box(leaf),
                        leaf->params->birth, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        leaf->pull[i] = (Pull){.distance = INFINITY};
    }
    for (int64_t i = leaf->source_count - 1; i >= 0; i--) {
        bool done;
        if (!run_goes_on(leaf->run, i, e)) {
            return false;
        }
        if (!(leaf->params->closed ? pull_closed(leaf, leaf->source[i], &done, e)
                                   : pull_open(leaf, leaf->source[i], &done))) {
            return false;
        }
        if (done) {
            remove_source(leaf, i);
        }
    }
    return true;
}

// Position of a node's child: along the mean pull turned toward the tip; if that leaves the blade
// or coincides with a node, along the mean pull; else toward the nearest source.
static bool find_place(const Leaf *leaf, int64_t node, float step, float slant, Vec3 *place)
{
    const Pull *pull = &leaf->pull[node];
    Vec3 mean = vec3_normalize(pull->sum);
    const Vec3 way[3] = {vec3_normalize(vec3_add(mean, vec3(0, slant, 0))), mean, pull->nearest};
    for (int k = vec3_length(pull->sum) > 0.05f ? 0 : 2; k < 3; k++) {
        *place = vec3_madd(leaf->tree->position[node], step, way[k]);
        if (leaf_contains(&leaf->params->outline, leaf->scale, *place) &&
            vein_nearest(&leaf->nodes, leaf->tree->position, *place, 0.2f * step) < 0) {
            return true;
        }
    }
    return false;
}

// Every pulled node makes a child, unless a node is already there. *grew: whether any did.
static bool grow_step(Leaf *leaf, bool *grew, Error *e)
{
    const VeinParams *params = leaf->params;
    int64_t count = leaf->tree->count;
    *grew = false;
    if (!gather_pulls(leaf, e)) {
        return false;
    }
    leaf->birth++;
    // A young blade is small; its vein segments are scaled with it.
    float step = params->step;
    float slant = params->slant * (1.0f - leaf->scale);
    float young = 0.02f * leaf->scale * params->outline.length;
    step = young < step ? young : step;
    for (int64_t i = 0; i < count; i++) {
        Vec3 p;
        if (!run_goes_on(leaf->run, i, e)) {
            return false;
        }
        if (!(leaf->pull[i].distance < INFINITY) || !find_place(leaf, i, step, slant, &p)) {
            continue;
        }
        if (leaf_add_node(leaf, p, i, e) < 0) {
            return false;
        }
        *grew = true;
    }
    return true;
}

// Scales the blade and its contents by this factor; with marginal growth the contents stay.
static void enlarge(Leaf *leaf, float factor)
{
    leaf->scale *= factor;
    if (leaf->params->marginal) {
        return;
    }
    for (int64_t i = 0; i < leaf->tree->count; i++) {
        leaf->tree->position[i] = vec3_scale(leaf->tree->position[i], factor);
    }
    for (int64_t i = 0; i < leaf->source_count; i++) {
        leaf->source[i] = vec3_scale(leaf->source[i], factor);
    }
    for (int64_t i = 0; leaf->all_sources && i < leaf->all_sources->count; i++) {
        leaf->all_sources->position[i] = vec3_scale(leaf->all_sources->position[i], factor);
    }
}

static bool grow_leaf(Leaf *leaf, Error *e)
{
    const VeinParams *params = leaf->params;
    bool grew = true, toothed = params->marginal;
    for (int round = 0;; round++) {
        run_progress(leaf->run, "veins", (double)(leaf->scale * leaf->scale));
        bool grown = leaf->scale >= 1.0f, half_grown = !toothed && leaf->scale >= TOOTHED;
        toothed = toothed || half_grown;
        // when it has grown once more, since veins stop as far from the points as they did then
        if (((grown || half_grown) && !add_teeth(leaf, e)) || !throw_darts(leaf, round, e)) {
            return false;
        }
        grew = true;
        for (int i = 0; grew && i < (grown ? SETTLE : params->pace); i++) {
            if (!grow_step(leaf, &grew, e)) {
                return false;
            }
        }
        if (grown) {
            return gather_pulls(leaf, e); // removes what the last step reached
        }
        float factor = 1.0f + params->rate;
        enlarge(leaf, factor * leaf->scale > 1.0f ? 1.0f / leaf->scale : factor);
    }
}

VeinParams vein_params_default(void)
{
    return (VeinParams){.outline = {.length = 0.1f, .width = 0.05f, .widest = 0.42f, .tip = 1.4f},
                        .birth = 0.001f,
                        .kill = 0.0005f,
                        .step = 0.00025f,
                        .start = 0.2f,
                        .rate = 0.02f,
                        .pace = 8,
                        .midrib = 0.97f,
                        .slant = 0.8f,
                        .seed = 1};
}

static bool check_params(const VeinParams *params, Error *e)
{
    const float length[5] = {params->outline.length, params->outline.width, params->birth,
                             params->kill, params->step};
    for (int i = 0; i < 5; i++) {
        if (!(length[i] > 0.0f) || !isfinite(length[i])) {
            return error_set(e, ERROR_INPUT,
                             "veins with a length of %g m; length, width, birth, kill and step "
                             "must be above 0",
                             (double)length[i]);
        }
    }
    if (params->kill >= params->birth || params->step > params->birth) {
        return error_set(e, ERROR_INPUT,
                         "veins with kill %g m, step %g m and birth %g m; kill must "
                         "be below birth, step no more than birth",
                         (double)params->kill, (double)params->step, (double)params->birth);
    }
    if (!(params->start > 0.0f && params->start <= 1.0f) || !(params->rate >= 0.001f)) {
        return error_set(e, ERROR_INPUT,
                         "veins that start at %g and grow by %g; start must be "
                         "above 0 and at most 1, rate 0.001 or more",
                         (double)params->start, (double)params->rate);
    }
    return true;
}

OutTree *veins_grow(const VeinParams *params, PointSet *sources, VeinReport *report, const Run *run,
                    Error *e)
{
    if (!check_params(params, e)) {
        return NULL;
    }
    Leaf leaf = {.params = params, .run = run, .all_sources = sources, .scale = params->start};
    leaf.tree = out_tree_new(e);
    bool done = leaf.tree && leaf_plant(&leaf, e) && grow_leaf(&leaf, e);
    leaf.report.sources_left = leaf.source_count;
    if (report) {
        *report = leaf.report;
    }
    vein_grid_free(&leaf.nodes);
    vein_grid_free(&leaf.darts);
    free(leaf.children);
    free(leaf.pull);
    free(leaf.source);
    if (!done) {
        out_tree_free(leaf.tree);
        return NULL;
    }
    return leaf.tree;
}
