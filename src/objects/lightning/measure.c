// Measures that are taken from photographs of lightning.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/lightning/lightning.h"
#include "outtree/box_dimension.h"
#include "outtree/chains.h"

#include <stdlib.h>

enum { VIEWS = 4, PIECES = 64, FINEST = 128 };

// A photograph's picture plane: across and up.
typedef struct View {
    Vec3 right, up;
} View;

static View make_view(int number)
{
    float sine, cosine;
    exact_sincos(PI_F * (float)number / VIEWS, &sine, &cosine);
    return (View){vec3(cosine, 0.0f, sine), vec3(0.0f, 1.0f, 0.0f)};
}

static Vec3 seen(const View *view, Vec3 p)
{
    return vec3(vec3_dot(p, view->right), vec3_dot(p, view->up), 0.0f);
}

// Absolute angles between successive pieces of `length` m (in the picture plane) along a chain;
// adds their sum and count.
static void add_turning(const OutTree *tree, const int32_t *node, int64_t count, const View *view,
                        float length, double *sum, int64_t *turns)
{
    Vec3 last = seen(view, tree->position[node[0]]), before = vec3(0, 0, 0);
    bool has_before = false;
    for (int64_t k = 1; k < count; k++) {
        Vec3 p = seen(view, tree->position[node[k]]);
        Vec3 piece = vec3_sub(p, last);
        if (vec3_length(piece) < length) {
            continue;
        }
        if (has_before) {
            float cross = before.x * piece.y - before.y * piece.x;
            float angle = exact_atan2(cross, vec3_dot(before, piece));
            *sum += fabs((double)angle) * 180.0 / (double)PI_F;
            (*turns)++;
        }
        before = piece;
        has_before = true;
        last = p;
    }
}

static double channel_turning(const OutTree *tree, const ChainSet *chains, int bolts)
{
    double sum = 0.0;
    int64_t turns = 0;
    for (int64_t c = 0; c < chains->count; c++) {
        const int32_t *node = chains->node + chains->first[c];
        int64_t count = chains->first[c + 1] - chains->first[c];
        if (chains->parent[c] >= 0 || tree->colony[node[0]] >= bolts || count < 3) {
            continue;
        }
        float way = vec3_distance(tree->position[node[0]], tree->position[node[count - 1]]);
        for (int v = 0; v < VIEWS; v++) {
            View view = make_view(v);
            add_turning(tree, node, count, &view, way / PIECES, &sum, &turns);
        }
    }
    return turns > 0 ? sum / (double)turns : (double)NAN;
}

// Samples the branches by points closer than the finest boxes.
static Vec3 *line_points(const OutTree *tree, float spacing, const View *view, int64_t *count,
                         Error *e)
{
    Vec3 *points = NULL;
    int64_t capacity = 0;
    *count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        Vec3 to = seen(view, tree->position[i]);
        Vec3 from = parent < 0 ? to : seen(view, tree->position[parent]);
        int64_t pieces = (int64_t)(vec3_distance(from, to) / spacing) + 1;
        if (!memory_reserve(&points, &capacity, *count + pieces, sizeof *points, e)) {
            free(points);
            return NULL;
        }
        for (int64_t k = 1; k <= pieces; k++) {
            points[(*count)++] = vec3_lerp(from, to, (float)k / (float)pieces);
        }
    }
    return points;
}

static bool seen_dimension(const OutTree *tree, double *mean, Error *e)
{
    Aabb box = out_tree_bounds(tree);
    float finest = vec3_length(vec3_sub(box.high, box.low)) / FINEST;
    *mean = tree->count > 2 && finest > 0.0f ? 0.0 : (double)NAN;
    for (int v = 0; v < VIEWS && *mean == *mean; v++) {
        View view = make_view(v);
        int64_t count;
        double dimension;
        Vec3 *points = line_points(tree, 0.25f * finest, &view, &count, e);
        bool done = points && points_box_dimension(points, count, (double)finest, &dimension, e);
        free(points);
        if (!done) {
            return false;
        }
        *mean += dimension / VIEWS;
    }
    return true;
}

bool lightning_measure(const void *given, const Grown *grown, const Recipe *recipe,
                       MeasureList *list, Error *e)
{
    (void)recipe;
    const LightningParams *params = given;
    const OutTree *tree = grown->tree;
    ChainSet *chains = out_tree_chains(tree, e);
    double dimension;
    bool done = chains && seen_dimension(tree, &dimension, e);
    bool air =
        params->element.points.place == SCATTER_VOLUME; // natural ranges apply to the sky only
    done = done &&
           measures_add(list, "channel_turning", channel_turning(tree, chains, params->bolts),
                        "degrees", air ? 15.0 : (double)NAN, air ? 18.0 : (double)NAN, e) &&
           measures_add(list, "seen_dimension", dimension, "", air ? 1.2 : (double)NAN,
                        air ? 1.45 : (double)NAN, e);
    chains_free(chains);
    return done;
}
