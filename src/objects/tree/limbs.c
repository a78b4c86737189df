#include "objects/tree/limbs.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

// Limbs' axes keep APART between FROM and TO along their paths from the fork. In radii of a limb,
// taken as equal branches that together have the trunk's cross-section.
#define APART 4.75f
#define FROM 5.3f
#define TO 21.0f

// A limb: the branch that leaves one node of the trunk.
typedef struct Limb {
    int32_t base; // its first node
    bool kept;
} Limb;

typedef struct Limbs {
    const OutTree *tree;
    Limb *limb;
    int64_t count, capacity;
    float radius;   // m, about that of a limb
    int32_t *above; // per node: number of descendants
    int32_t *heir;  // per node: the child with the most of them, -1 = none
    float *way;     // per node: m along the branches from the root
} Limbs;

static void free_limbs(Limbs *limbs)
{
    free(limbs->limb);
    free(limbs->above);
    free(limbs->heir);
    free(limbs->way);
}

// Finds the axes, from node to heir.
static bool find_axes(Limbs *limbs, Error *e)
{
    const OutTree *tree = limbs->tree;
    limbs->above = memory_alloc_zero(tree->count, sizeof *limbs->above, e);
    limbs->heir = memory_alloc(tree->count, sizeof *limbs->heir, e);
    limbs->way = memory_alloc_zero(tree->count, sizeof *limbs->way, e);
    if (!limbs->above || !limbs->heir || !limbs->way) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        limbs->heir[i] = -1;
        if (parent >= 0) {
            limbs->way[i] =
                limbs->way[parent] + vec3_distance(tree->position[i], tree->position[parent]);
        }
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            int32_t heir = limbs->heir[parent];
            limbs->above[parent] += 1 + limbs->above[i];
            limbs->heir[parent] =
                heir >= 0 && limbs->above[heir] > limbs->above[i] ? heir : (int32_t)i;
        }
    }
    return true;
}

static bool find_limbs(Limbs *limbs, int64_t first, Error *e)
{
    for (int64_t i = first; i < limbs->tree->count; i++) {
        if (limbs->tree->parent[i] >= first) {
            continue;
        }
        if (!memory_reserve(&limbs->limb, &limbs->capacity, limbs->count + 1, sizeof *limbs->limb,
                            e)) {
            return false;
        }
        limbs->limb[limbs->count++] = (Limb){.base = (int32_t)i};
    }
    return find_axes(limbs, e);
}

// The trunk node where two limbs part; -1 if they are of different stems.
static int32_t find_parting(const OutTree *tree, const Limb *a, const Limb *b)
{
    int32_t i = tree->parent[a->base], k = tree->parent[b->base];
    while (i != k) {
        if (i > k) {
            i = tree->parent[i];
        } else {
            k = tree->parent[k];
        }
    }
    return i;
}

// Do the axes of two limbs run close to each other near their fork?
static bool are_close(const Limbs *limbs, const Limb *a, const Limb *b)
{
    const Vec3 *position = limbs->tree->position;
    int32_t fork = find_parting(limbs->tree, a, b);
    if (fork < 0) {
        return false;
    }
    float from = limbs->way[fork] + FROM * limbs->radius;
    float to = limbs->way[fork] + TO * limbs->radius;
    for (int32_t i = a->base; i >= 0 && limbs->way[i] < to; i = limbs->heir[i]) {
        for (int32_t k = b->base; k >= 0 && limbs->way[k] < to; k = limbs->heir[k]) {
            if (limbs->way[i] > from && limbs->way[k] > from &&
                vec3_distance(position[i], position[k]) < APART * limbs->radius) {
                return true;
            }
        }
    }
    return false;
}

static bool is_crowded(const Limbs *limbs, const Limb *limb)
{
    for (int64_t i = 0; i < limbs->count; i++) {
        const Limb *other = &limbs->limb[i];
        if (other != limb && other->kept && are_close(limbs, limb, other)) {
            return true;
        }
    }
    return false;
}

// The strongest limb not yet visited; -1 = none.
static int64_t find_strongest(const Limbs *limbs, const bool *seen)
{
    int64_t best = -1;
    for (int64_t i = 0; i < limbs->count; i++) {
        if (!seen[i] && (best < 0 || limbs->above[limbs->limb[i].base] >
                                         limbs->above[limbs->limb[best].base])) {
            best = i;
        }
    }
    return best;
}

// Chooses limbs in order of strength. Limbs from `starts_end` on are the trunk's own growth, not
// started branches, and are kept.
static bool choose_limbs(Limbs *limbs, int64_t starts_end, const Run *run, Error *e)
{
    bool *seen = memory_alloc_zero(limbs->count, sizeof *seen, e);
    bool good = seen;
    for (int64_t i = 0; good && i < limbs->count; i++) {
        seen[i] = limbs->limb[i].kept = limbs->limb[i].base >= starts_end;
    }
    for (int64_t i; good && (i = find_strongest(limbs, seen)) >= 0;) {
        seen[i] = true;
        limbs->limb[i].kept = !is_crowded(limbs, &limbs->limb[i]);
        good = !run_is_cancelled(run) || run_cancel_error(e);
    }
    free(seen);
    return good;
}

// Drops the starting pieces of limbs not kept.
static bool drop_crowded(OutTree *tree, const Limbs *limbs, bool *dropped, Error *e)
{
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    *dropped = false;
    for (int64_t i = 0; keep && i < tree->count; i++) {
        keep[i] = true;
    }
    for (int64_t i = 0; keep && i < limbs->count; i++) {
        if (!limbs->limb[i].kept) {
            keep[limbs->limb[i].base] = false;
            *dropped = true;
        }
    }
    bool done = keep && (!*dropped || out_tree_keep_nodes(tree, keep, e));
    free(keep);
    return done;
}

// One pass: grows the first level on a copy and drops crowded limbs.
static bool thin_once(OutTree *tree, int64_t first, const TreeParams *params,
                      const Envelope *envelope, const GuideField *field, uint64_t seed,
                      bool *dropped, const Run *run, Error *e)
{
    const ElementParams *crown = &params->crown.element;
    ScatterParams scatter =
        element_scatter_params(tree, crown, random_key(seed, STREAM_ELEMENT_POINTS));
    ColonizeParams colonize =
        element_colonize_params(tree, crown, field, random_key(seed, STREAM_ELEMENT_GROWTH));
    OutTree *grown = out_tree_copy(tree, e);
    Limbs limbs = {.tree = grown,
                   .radius = params->trunk.radius / sqrtf((float)params->crown.branches)};
    Density *density;
    bool done =
        element_density(crown, &scatter, &density, run, e) && grown &&
        colonize_levels(grown, envelope, &scatter, crown->levels, 1, &colonize, run, NULL, e) &&
        find_limbs(&limbs, first, e) && choose_limbs(&limbs, tree->count, run, e) &&
        drop_crowded(tree, &limbs, dropped, e);
    density_free(density);
    free_limbs(&limbs);
    out_tree_free(grown);
    return done;
}

bool tree_thin_limbs(OutTree *tree, int64_t first, const TreeParams *params,
                     const Envelope *envelope, uint64_t seed, const Run *run, Error *e)
{
    const ElementParams *crown = &params->crown.element;
    GuideField *field;
    if (crown->level_count < 1 || first == tree->count) {
        return true;
    }
    if (!element_guide_field(tree, first, crown, envelope, random_key(seed, STREAM_ELEMENT_FIELD),
                             run, &field, e)) {
        return false;
    }
    Run quiet = *run; // the growth that follows reports its own warnings
    quiet.warn = NULL;
    quiet.progress = NULL;
    bool done = true;
    for (bool again = true; done && again;) {
        done = thin_once(tree, first, params, envelope, field, seed, &again, &quiet, e);
    }
    guide_field_free(field);
    return done;
}
