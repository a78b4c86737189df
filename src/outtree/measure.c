#include "outtree/measure.h"

#include "base/exact_math.h"
#include "outtree/box_dimension.h"
#include "outtree/measure_forks.h"
#include "outtree/measure_wood.h"
#include "outtree/strahler.h"

#include <math.h>

typedef struct Entry {
    const char *name;
    double value;
    const char *unit;
} Entry;

static bool add_entries(MeasureList *list, const Entry *entry, int count, Error *e)
{
    bool done = true;
    for (int i = 0; done && i < count; i++) {
        done = measures_add(list, entry[i].name, entry[i].value, entry[i].unit, (double)NAN,
                            (double)NAN, e);
    }
    return done;
}

#define ADD_ENTRIES(list, entries, e) \
    add_entries(list, entries, (int)(sizeof(entries) / sizeof((entries)[0])), e)

static bool add_counts(const OutTree *tree, const Branching *b, MeasureList *list, Error *e)
{
    int64_t roots = 0, forks = 0, terminals = 0, most = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        roots += tree->parent[i] < 0;
        forks += b->children[i] > 1;
        terminals += b->children[i] == 0;
        most = b->children[i] > most ? b->children[i] : most;
    }
    const Entry entries[] = {{"nodes", (double)tree->count, ""},
                             {"roots", (double)roots, ""},
                             {"forks", (double)forks, ""},
                             {"terminals", (double)terminals, ""},
                             {"most_children", (double)most, ""}};
    return ADD_ENTRIES(list, entries, e);
}

// Mean over all ends that do not coincide with their root.
static double mean_tortuosity(const OutTree *tree, const Branching *b)
{
    double sum = 0.0, count = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        double straight = (double)vec3_distance(tree->position[i], tree->position[b->root[i]]);
        if (b->children[i] == 0 && straight > 0.0) {
            sum += b->path[i] / straight;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : (double)NAN;
}

// Mean angle between consecutive segments of a branch, degrees.
static double mean_turning(const OutTree *tree, const Branching *b)
{
    double sum = 0.0, count = 0.0;
    for (int32_t i = 0; i < (int32_t)tree->count; i++) {
        if (tree->parent[i] < 0 || b->children[i] == 0) {
            continue;
        }
        Vec3 before = branching_direction_before(b, tree, i, 1);
        Vec3 after = branching_direction_after(b, tree, i, branching_main_child(b, tree, i), 1);
        if (vec3_dot(before, before) > 0.5f && vec3_dot(after, after) > 0.5f) {
            sum += (double)(exact_acos(vec3_dot(before, after)) / RADIANS_PER_DEGREE);
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : (double)NAN;
}

static bool add_lengths(const OutTree *tree, const Branching *b, MeasureList *list, Error *e)
{
    double length = 0.0, longest = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        length += tree->parent[i] >= 0 ? b->path[i] - b->path[tree->parent[i]] : 0.0;
        longest = fmax(longest, b->path[i]);
    }
    Aabb box = out_tree_bounds(tree);
    Vec3 size = tree->count > 0 ? vec3_sub(box.high, box.low) : vec3(0, 0, 0);
    const Entry entries[] = {{"width", (double)size.x, "m"},
                             {"height", (double)size.y, "m"},
                             {"depth", (double)size.z, "m"},
                             {"length", length, "m"},
                             {"longest_path", longest, "m"},
                             {"tortuosity", mean_tortuosity(tree, b), ""},
                             {"turning", mean_turning(tree, b), "degrees"}};
    return ADD_ENTRIES(list, entries, e);
}

static bool add_radii(const OutTree *tree, const Branching *b, MeasureList *list, Error *e)
{
    double root = (double)NAN, tips = 0.0, count = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] < 0) {
            root = fmax(root, (double)tree->radius[i]);
        }
        if (b->children[i] == 0) {
            tips += (double)tree->radius[i];
            count += 1.0;
        }
    }
    const Entry entries[] = {{"root_radius", root, "m"},
                             {"tip_radius", count > 0.0 ? tips / count : (double)NAN, "m"}};
    return ADD_ENTRIES(list, entries, e);
}

static bool add_forks(const OutTree *tree, const Branching *b, MeasureList *list, Error *e)
{
    ForkMeasures forks;
    if (!measure_forks(tree, b, &forks, e)) {
        return false;
    }
    const Entry entries[] = {{"branch_angle", forks.angle, "degrees"},
                             {"branch_angle_spread", forks.angle_spread, "degrees"},
                             {"main_angle", forks.main_angle, "degrees"},
                             {"radius_exponent", forks.exponent, ""},
                             {"pipe_residual", forks.pipe_residual, ""},
                             {"murray_residual", forks.murray_residual, ""},
                             {"asymmetry", forks.asymmetry, ""}};
    return ADD_ENTRIES(list, entries, e);
}

static bool add_orders(const OutTree *tree, MeasureList *list, Error *e)
{
    HortonRatios ratios;
    double dimension;
    if (!out_tree_horton(tree, &ratios, e) || !out_tree_box_dimension(tree, &dimension, e)) {
        return false;
    }
    const Entry entries[] = {{"strahler_order", ratios.highest, ""},
                             {"horton_number", ratios.number, ""},
                             {"horton_length", ratios.length, ""},
                             {"horton_diameter", ratios.diameter, ""},
                             {"box_dimension", dimension, ""}};
    return ADD_ENTRIES(list, entries, e);
}

bool out_tree_measure(const OutTree *tree, MeasureList *list, Error *e)
{
    Branching branching;
    if (!branching_init(&branching, tree, e)) {
        return false;
    }
    bool done = add_counts(tree, &branching, list, e) && add_lengths(tree, &branching, list, e) &&
                add_radii(tree, &branching, list, e) && add_forks(tree, &branching, list, e) &&
                add_orders(tree, list, e) &&
                (!tree->scanned || out_tree_measure_wood(tree, 0.0f, list, e));
    branching_free(&branching);
    return done;
}
