#include "objects/forest/individuals.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/tree/by_light.h"

#include <stdlib.h>

enum { STREAM_AGE = 1, STREAM_X = 2, STREAM_Z = 3, STREAM_TREE = 4 }; // of an individual
enum { EDGE_TREES = 3, EDGE_ROWS = 2, MOST_COPIES = 8 };

#define ROW 0.8660254f          // of the spacing, from row to row
#define JITTER 0.22f            // of the spacing
#define INNER_SLENDERNESS 1.55f // of a tree in the open
#define EDGE_SLENDERNESS 1.2f

// Least tropism of stems: in a wood, gravity leads them more than light.
static const float STRAIGHT[] = {
    [SITUATION_INNER] = 0.25f, [SITUATION_EDGE] = 0.1f, [SITUATION_OPEN] = 0.0f};

// Heights of the trees of a stand, shares of the tallest: few sizes, so that they share trials.
static const float HEIGHTS[] = {1.0f, 0.92f, 1.0f, 0.8f, 0.92f, 0.55f, 1.0f, 0.3f};

// The species that is rarest for its share among those that are chosen so far.
static int next_species(const ForestParams *forest, const int *chosen, int count)
{
    float all = 0.0f, most = -1e30f;
    int best = 0;
    for (int i = 0; i < forest->species_count; i++) {
        all += forest->species[i].share;
    }
    for (int i = 0; i < forest->species_count; i++) {
        float wanted = forest->species[i].share / all * (float)(count + 1);
        float missing = wanted - (float)chosen[i] + (chosen[i] == 0 ? 1.0f : 0.0f);
        if (missing > most) {
            most = missing;
            best = i;
        }
    }
    return best;
}

// A tree of the species in a situation; share: of its full height.
static TreeParams tree_of(const ForestParams *forest, int species, Situation situation, float share)
{
    static const float slenderness[] = {[SITUATION_INNER] = INNER_SLENDERNESS,
                                        [SITUATION_EDGE] = EDGE_SLENDERNESS,
                                        [SITUATION_OPEN] = 1.0f};
    TreeParams tree = *forest->species[species].tree, plain = tree_params_default();
    tree.height = share * (tree.height > 0.0f ? tree.height : forest->height);
    tree.age = 0.0f;
    tree.position = vec3(0, 0, 0);
    tree.grown_by = GROWN_BY_LIGHT;
    tree.crown = plain.crown;
    tree.crown.element.growth.tropism = forest->species[species].tree->crown.element.growth.tropism;
    tree.roots.count = 0;
    float *upright = &tree.light.growth.tropism.x, straight = STRAIGHT[situation];
    *upright = *upright > straight ? *upright : straight;
    float own = tree.trunk.slenderness > 0.0f ? tree.trunk.slenderness : 25.0f;
    tree.trunk.slenderness = slenderness[situation] * own;
    return tree;
}

static void add_stand(Individuals *all, const ForestParams *forest, Situation situation,
                      int columns, int rows, Vec3 corner, uint64_t seed, int *chosen)
{
    float spacing = forest_params_resolve(forest).spacing;
    int sizes = (int)(sizeof HEIGHTS / sizeof *HEIGHTS);
    for (int i = 0; i < columns * rows; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        int row = i / columns, column = i % columns, known = 0;
        for (int k = 0; k < forest->species_count; k++) {
            known += chosen[k];
        }
        int species = next_species(forest, chosen, known);
        bool back = situation == SITUATION_EDGE && row > 0;
        chosen[species] += !back;
        int size = (int)(random_unit(random_key(key, STREAM_AGE)) * (float)sizes);
        bool tall = i == 0 || situation != SITUATION_INNER;
        float x = (float)column + (row & 1 ? 0.5f : 0.0f), z = -ROW * (float)row;
        x += random_range(random_key(key, STREAM_X), -JITTER, JITTER);
        z += random_range(random_key(key, STREAM_Z), -JITTER, JITTER);
        all->one[all->count++] =
            (Individual){.species = species,
                         .situation = situation,
                         .kept = !back,
                         .stand = all->stands,
                         .foot = vec3_add(corner, vec3(spacing * x, 0, spacing * z)),
                         .params = tree_of(forest, species, situation, tall ? 1.0f : HEIGHTS[size]),
                         .seed = random_key(key, STREAM_TREE)};
    }
    all->stands++;
}

bool individuals_init(Individuals *all, const ForestParams *forest, uint64_t seed, Error *e)
{
    int species = forest->species_count;
    int trees = forest->stand_trees > species ? forest->stand_trees : species, columns = 1;
    while (columns * columns < trees) {
        columns++;
    }
    int rows = (trees + columns - 1) / columns;
    rows += rows & 1; // rows are shifted in turn, so that copies fit
    int edge = species > EDGE_TREES ? species : EDGE_TREES;
    float spacing = forest_params_resolve(forest).spacing;
    float row = ROW * spacing;
    *all = (Individuals){.tile = vec3(spacing * (float)columns, 0, row * (float)rows),
                         .edge_tile = vec3(spacing * (float)edge, 0, row * EDGE_ROWS)};
    all->one =
        memory_alloc((int64_t)forest->stands * columns * rows + (int64_t)edge * EDGE_ROWS + species,
                     sizeof *all->one, e);
    int *chosen = all->one ? memory_alloc_zero(species, sizeof *chosen, e) : NULL;
    if (!chosen) {
        individuals_free(all);
        return false;
    }
    float apart = 2.0f * (all->tile.x + spacing * (float)edge) + 2.0f * forest->height;
    for (int i = 0; i < forest->stands; i++) {
        add_stand(all, forest, SITUATION_INNER, columns, rows, vec3(apart * (float)i, 0, 0),
                  random_key(seed, (uint64_t)i), chosen);
    }
    for (int i = 0; i < species; i++) {
        chosen[i] = 0;
    }
    add_stand(all, forest, SITUATION_EDGE, edge, EDGE_ROWS,
              vec3(apart * (float)forest->stands, 0, 0), random_key(seed, (uint64_t)all->stands),
              chosen);
    for (int i = 0; i < species; i++) {
        chosen[i] = 0;
    }
    for (int i = 0; i < species; i++) {
        add_stand(all, forest, SITUATION_OPEN, 1, 1,
                  vec3(apart * (float)(forest->stands + 1 + i), 0, 0),
                  random_key(seed, (uint64_t)all->stands), chosen);
    }
    free(chosen);
    return true;
}

void individuals_free(Individuals *all)
{
    free(all->one);
    *all = (Individuals){0};
}

// Where the stand's shade is repeated: all around an inner one, beside and behind an edge.
static int find_copies(const Individuals *all, Situation situation, Vec3 copy[MOST_COPIES])
{
    bool edge = situation == SITUATION_EDGE;
    Vec3 tile = edge ? all->edge_tile : all->tile;
    int count = 0;
    for (int row = -1; situation != SITUATION_OPEN && row <= (edge ? 0 : 1); row++) {
        for (int column = -1; column <= 1; column++) {
            if (row != 0 || column != 0) {
                copy[count++] = vec3((float)column * tile.x, 0, (float)row * tile.z);
            }
        }
    }
    return count;
}

static bool append(const Individuals *all, int index, OutTree *tree, OutTree *into, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        tree->colony[i] += INDIVIDUAL_COLONIES * index;
    }
    return !all->one[index].kept || out_tree_append(into, tree, e);
}

static bool grow_stand(const Individuals *all, int stand, const Recipe *recipe, OutTree *into,
                       Error *e)
{
    int first = 0, count = 0;
    while (all->one[first].stand != stand) {
        first++;
    }
    while (first + count < all->count && all->one[first + count].stand == stand) {
        count++;
    }
    StandTree *tree = memory_alloc_zero(count, sizeof *tree, e);
    for (int i = 0; tree && i < count; i++) {
        const Individual *one = &all->one[first + i];
        tree[i] = (StandTree){.params = &one->params, .foot = one->foot, .seed = one->seed};
    }
    Vec3 copy[MOST_COPIES];
    int copies = find_copies(all, all->one[first].situation, copy);
    bool done = tree && tree_grow_stand(tree, count, copy, copies, recipe, e);
    for (int i = 0; tree && i < count; i++) {
        done = done && append(all, first + i, tree[i].grown, into, e);
        out_tree_free(tree[i].grown);
    }
    free(tree);
    return done;
}

bool individuals_grow(const Individuals *all, const Recipe *recipe, OutTree *into, Error *e)
{
    bool done = true;
    for (int i = 0; done && i < all->stands; i++) {
        done = grow_stand(all, i, recipe, into, e);
    }
    return done;
}

// The nodes of an individual follow each other.
OutTree *individuals_tree(const Individuals *all, const OutTree *grown, int index, Error *e)
{
    int64_t first = 0;
    while (first < grown->count && grown->colony[first] / INDIVIDUAL_COLONIES != index) {
        first++;
    }
    OutTree *tree = out_tree_new(e);
    bool done = tree;
    for (int64_t i = first;
         done && i < grown->count && grown->colony[i] / INDIVIDUAL_COLONIES == index; i++) {
        int64_t parent = grown->parent[i] >= 0 ? grown->parent[i] - first : -1;
        int64_t made = out_tree_copy_node(tree, parent, grown, i, e);
        done = made >= 0;
        if (done) {
            tree->colony[made] = grown->colony[i] % INDIVIDUAL_COLONIES;
            tree->position[made] = vec3_sub(grown->position[i], all->one[index].foot);
        }
    }
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}
