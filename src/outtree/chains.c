#include "outtree/chains.h"

#include "base/memory.h"

#include <stdlib.h>

// The child that continues each node's chain; -1 at tips.
static int32_t *find_heirs(const OutTree *tree, Error *e)
{
    int32_t *heir = memory_alloc(tree->count, sizeof *heir, e);
    int32_t *load = memory_alloc(tree->count, sizeof *load, e); // nodes per subtree
    if (!heir || !load) {
        free(heir);
        free(load);
        return NULL;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        load[i] = 1;
        heir[i] = -1;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        if (tree->parent[i] >= 0) {
            load[tree->parent[i]] += load[i];
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i], rival = parent >= 0 ? heir[parent] : -1;
        if (parent >= 0 && (rival < 0 || tree->radius[i] > tree->radius[rival] ||
                            (tree->radius[i] == tree->radius[rival] && load[i] > load[rival]))) {
            heir[parent] = (int32_t)i;
        }
    }
    free(load);
    return heir;
}

// Numbers the chains; chain[i] is the chain of node i.
static int64_t number_chains(const OutTree *tree, const int32_t *heir, int32_t *chain)
{
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        chain[i] = parent >= 0 && heir[parent] == i ? chain[parent] : (int32_t)count++;
    }
    return count;
}

static void fill_chains(ChainSet *set, const OutTree *tree, const int32_t *heir,
                        const int32_t *chain)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool leaves = parent >= 0 && heir[parent] != i;
        set->first[chain[i] + 1] += leaves ? 2 : 1;
        if (parent < 0 || leaves) {
            set->parent[chain[i]] = leaves ? chain[parent] : -1;
            set->order[chain[i]] = leaves ? set->order[chain[parent]] + 1 : 0;
        }
    }
    for (int64_t c = 0; c < set->count; c++) {
        set->first[c + 1] += set->first[c];
    }
    // first[c] is used as the write position and shifted back afterwards
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (parent >= 0 && heir[parent] != i) {
            set->node[set->first[chain[i]]++] = parent;
        }
        set->node[set->first[chain[i]]++] = (int32_t)i;
    }
    for (int64_t c = set->count; c > 0; c--) {
        set->first[c] = set->first[c - 1];
    }
    set->first[0] = 0;
}

ChainSet *out_tree_chains(const OutTree *tree, Error *e)
{
    ChainSet *set = memory_alloc_zero(1, sizeof *set, e);
    int32_t *heir = find_heirs(tree, e), *chain = memory_alloc(tree->count, sizeof *chain, e);
    bool done = set && heir && chain;
    if (done) {
        set->count = number_chains(tree, heir, chain);
        set->first = memory_alloc_zero(set->count + 1, sizeof *set->first, e);
        set->node = memory_alloc(tree->count + set->count, sizeof *set->node, e);
        set->parent = memory_alloc(set->count, sizeof *set->parent, e);
        set->order = memory_alloc(set->count, sizeof *set->order, e);
        done = set->first && set->node && set->parent && set->order;
    }
    if (done) {
        fill_chains(set, tree, heir, chain);
    }
    free(heir);
    free(chain);
    if (!done) {
        chains_free(set);
        return NULL;
    }
    return set;
}

void chains_free(ChainSet *chains)
{
    if (chains) {
        free(chains->first);
        free(chains->node);
        free(chains->parent);
        free(chains->order);
        free(chains);
    }
}
