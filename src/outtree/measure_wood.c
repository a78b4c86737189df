#include "outtree/measure_wood.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define THIN 0.01         // m: thinner wood does not count
#define BREAST_HEIGHT 1.3 // m
#define ROUNDING 1e-6     // of a radius
#define PI 3.14159265358979

typedef struct Limb {
    double straightness; // chord / length
    double length;       // m
} Limb;

typedef struct Wood {
    const OutTree *tree;
    bool *counts;   // per node: wood from its parent to it counts
    double *beyond; // m^3, per node: volume of the wood above it
    double *way;    // m, per node: along the branches from the base
    int32_t *next;  // per node: the child that continues its axis; -1 = none
    int32_t *order; // per node: 0 on the stem
    Limb *limb;     // the branches that leave the stem
    int64_t limbs;
} Wood;

static void wood_free(Wood *wood)
{
    free(wood->counts);
    free(wood->beyond);
    free(wood->way);
    free(wood->next);
    free(wood->order);
    free(wood->limb);
}

static double segment_length(const OutTree *tree, int64_t i)
{
    return (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
}

// Volume of a cone's frustum.
static double segment_volume(const OutTree *tree, int64_t i)
{
    double a = (double)tree->radius[tree->parent[i]], b = (double)tree->radius[i];
    return PI / 3.0 * segment_length(tree, i) * (a * a + a * b + b * b);
}

static void find_axes(Wood *wood)
{
    const OutTree *tree = wood->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool thick = (double)tree->radius[i] >= THIN * (1.0 - ROUNDING);
        wood->counts[i] = thick && (parent < 0 || wood->counts[parent]);
        wood->way[i] = parent >= 0 ? wood->way[parent] + segment_length(tree, i) : 0.0;
        wood->next[i] = -1;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        if (parent >= 0 && wood->counts[i]) {
            wood->beyond[i] += segment_volume(tree, i);
            wood->beyond[parent] += wood->beyond[i];
            int32_t *next = &wood->next[parent];
            *next = *next >= 0 && wood->beyond[*next] > wood->beyond[i] ? *next : (int32_t)i;
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        wood->order[i] = parent < 0 ? 0 : wood->order[parent] + (wood->next[parent] != i);
    }
}

// The branch that begins with node i.
static Limb limb_at(const Wood *wood, int64_t i)
{
    int32_t base = wood->tree->parent[i], end = (int32_t)i;
    while (wood->next[end] >= 0) {
        end = wood->next[end];
    }
    double chord = (double)vec3_distance(wood->tree->position[base], wood->tree->position[end]);
    double length = wood->way[end] - wood->way[base];
    return (Limb){length > 0.0 ? chord / length : 1.0, length};
}

static int compare(const void *a, const void *b)
{
    double p = ((const Limb *)a)->straightness, q = ((const Limb *)b)->straightness;
    return (p > q) - (p < q);
}

// The branches that leave the stem, in order of their straightness.
static void find_limbs(Wood *wood)
{
    const OutTree *tree = wood->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (wood->counts[i] && wood->order[i] == 1 && wood->order[parent] == 0) {
            wood->limb[wood->limbs++] = limb_at(wood, i);
        }
    }
    qsort(wood->limb, (size_t)wood->limbs, sizeof *wood->limb, compare);
}

static double median_straightness(const Wood *wood)
{
    int64_t n = wood->limbs;
    return n > 0 ? 0.5 * (wood->limb[(n - 1) / 2].straightness + wood->limb[n / 2].straightness)
                 : (double)NAN;
}

// Half of the limbs' length is in limbs of at most this straightness: stubs hardly count.
static double limb_straightness(const Wood *wood)
{
    double all = 0.0, sum = 0.0;
    for (int64_t i = 0; i < wood->limbs; i++) {
        all += wood->limb[i].length;
    }
    for (int64_t i = 0; i < wood->limbs; i++) {
        sum += wood->limb[i].length;
        if (sum >= 0.5 * all) {
            return wood->limb[i].straightness;
        }
    }
    return (double)NAN;
}

// Diameter of the stem where it crosses breast height.
static double stem_diameter(const Wood *wood, float ground)
{
    const OutTree *tree = wood->tree;
    double height = (double)ground + BREAST_HEIGHT;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (!wood->counts[i] || parent < 0 || wood->order[i] > 0) {
            continue;
        }
        double low = (double)tree->position[parent].y, high = (double)tree->position[i].y;
        if (low <= height && high > height) {
            double share = (height - low) / (high - low);
            return 2.0 *
                   ((1.0 - share) * (double)tree->radius[parent] + share * (double)tree->radius[i]);
        }
    }
    return (double)NAN;
}

typedef struct Sums {
    Aabb box;
    double length, volume, stem, tips, ways, longest;
} Sums;

static Sums sum_wood(const Wood *wood)
{
    const OutTree *tree = wood->tree;
    Sums sums = {.box = aabb_empty()};
    for (int64_t i = 0; i < tree->count; i++) {
        if (!wood->counts[i]) {
            continue;
        }
        sums.box = aabb_add(sums.box, tree->position[i]);
        if (tree->parent[i] < 0) {
            continue;
        }
        double volume = segment_volume(tree, i);
        sums.volume += volume;
        sums.stem += wood->order[i] == 0 ? volume : 0.0;
        sums.length += segment_length(tree, i);
        if (wood->next[i] < 0) {
            sums.tips += 1.0;
            sums.ways += wood->way[i];
            sums.longest = fmax(sums.longest, wood->way[i]);
        }
    }
    return sums;
}

static bool add_measures(Wood *wood, float ground, MeasureList *list, Error *e)
{
    Sums sums = sum_wood(wood);
    Vec3 size = vec3_sub(sums.box.high, sums.box.low);
    bool any = sums.volume > 0.0;
    double height = any ? (double)(sums.box.high.y - ground) : (double)NAN;
    double width = any ? 0.5 * (double)(size.x + size.z) : (double)NAN;
    double d = stem_diameter(wood, ground);
    find_limbs(wood);
    const struct {
        const char *name;
        double value;
        const char *unit;
    } entry[] = {{"diameter", d, "m"},
                 {"height_per_diameter", height / d, ""},
                 {"crown_width_per_height", width / height, ""},
                 {"branch_per_height", sums.length / height, ""},
                 {"tips", sums.tips, ""},
                 {"path_fraction", sums.ways / sums.tips / sums.longest, ""},
                 {"straightness", median_straightness(wood), ""},
                 {"limb_straightness", limb_straightness(wood), ""},
                 {"stem_share", sums.stem / sums.volume, ""},
                 {"form_factor", sums.volume / (PI / 4.0 * d * d * height), ""}};
    bool done = true;
    for (size_t i = 0; done && i < sizeof entry / sizeof entry[0]; i++) {
        done = measures_add(list, entry[i].name, entry[i].value, entry[i].unit, (double)NAN,
                            (double)NAN, e);
    }
    return done;
}

bool out_tree_measure_wood(const OutTree *tree, float ground, MeasureList *list, Error *e)
{
    int64_t n = tree->count;
    Wood wood = {.tree = tree,
                 .counts = memory_alloc_zero(n, sizeof(bool), e),
                 .beyond = memory_alloc_zero(n, sizeof(double), e),
                 .way = memory_alloc(n, sizeof(double), e),
                 .next = memory_alloc(n, sizeof(int32_t), e),
                 .order = memory_alloc(n, sizeof(int32_t), e),
                 .limb = memory_alloc(n, sizeof(Limb), e)};
    bool done = wood.counts && wood.beyond && wood.way && wood.next && wood.order && wood.limb;
    if (done) {
        find_axes(&wood);
        done = add_measures(&wood, ground, list, e);
    }
    wood_free(&wood);
    return done;
}
