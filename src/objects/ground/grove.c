#include "objects/ground/grove.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/tree/instanced.h"
#include "objects/tree/tree.h"

#include <stdlib.h>

enum { STREAM_HEIGHT = 1 };                                              // of a variant's tree
enum { STREAM_PLACES = 1, STREAM_VARIANT_TREE = 2, STREAM_SPECIES = 3 }; // of a variant
enum { DISTANT_SEASONS = 26, DISTANT_LEAVES = 40000, DISTANT_FACES = 300000 };
// Of a tree's place.
enum {
    STREAM_RADIUS = 1,
    STREAM_AZIMUTH = 2,
    STREAM_CLUMPING = 3,
    STREAM_SIZE = 4,
    STREAM_TURN = 5
};

// A tree of about a hundred pixels grows in fewer seasons, so with fewer branches, and without
// roots.
static TreeParams distant_tree(const GroveParams *grove, const TreeParams *own, uint64_t seed)
{
    TreeParams tree = own ? *own : tree_params_default();
    float size = random_range(random_key(seed, STREAM_HEIGHT), 0.7f, 1.0f);
    tree.height = size * (tree.height > 0.0f ? tree.height : grove->height);
    tree.age = 0.0f;
    // a tree of this height is grown up here, unless it is much smaller than the species
    tree.light.mature_height = tree.height;
    int *seasons = &tree.light.growth.seasons;
    *seasons = *seasons < DISTANT_SEASONS ? *seasons : DISTANT_SEASONS;
    tree.grown_by = GROWN_BY_LIGHT;
    tree.crown.element = tree_params_default().crown.element;
    tree.crown.width = tree.crown.base = 0.0f;
    tree.roots.count = 0;
    tree.position = vec3(0, 0, 0);
    tree.radii.tip = tree.radii.tip > 0.003f ? tree.radii.tip : 0.003f;
    tree.leaves.twig_radius *= 2.0f; // as its twigs are thicker
    tree.skin.curve_radius = 0.04f;
    tree.skin.levels = 0;
    tree.leaves.variants = 1;
    if (grove->bare) {
        tree.leaves.max_count = 0;
    }
    return tree;
}

// Places the trees of one variant: transforms from the origin to the land. -1 if interrupted.
static int64_t place_trees(const GroundParams *ground, uint64_t ground_seed, uint64_t seed,
                           int64_t wanted, const Flood *flood, Transform *place, const Run *run,
                           Error *e)
{
    const GroveParams *grove = &ground->trees;
    int64_t count = 0;
    for (int64_t i = 0; i < 40 * wanted && count < wanted; i++) {
        if (!run_goes_on(run, i, e)) {
            return -1;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        float u = random_unit(random_key(key, STREAM_RADIUS)), sine, cosine;
        float r = sqrtf(lerpf(grove->inner * grove->inner, grove->outer * grove->outer, u));
        exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine,
                     &cosine);
        float x = r * sine, z = r * cosine;
        float wood = noise_plane_fractal(x * 0.008f, z * 0.008f, 3,
                                         random_key(ground_seed, STREAM_GROUND_WOODS));
        Vec3 foot = vec3(x, ground_height(ground, ground_seed, x, z), z);
        if ((random_unit(random_key(key, STREAM_CLUMPING)) < grove->clumping && wood < 0.12f) ||
            flood_covers(flood, foot)) {
            continue;
        }
        float size = random_range(random_key(key, STREAM_SIZE), 0.7f, 1.0f);
        exact_sincos(random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F), &sine, &cosine);
        place[count++] =
            transform_from_axes(vec3(size * cosine, 0, -size * sine), vec3(0, size, 0),
                                vec3(size * sine, 0, size * cosine), vec3(x, foot.y - 0.2f, z));
    }
    return count;
}

bool grove_add_part(Geometry *geometry, Part *part, const Transform *place, int64_t count,
                    const Run *run, Error *e)
{
    Part copy = {.kind = part->kind, .material = part->material, .object = part->object};
    copy.instance = memory_alloc(count, sizeof *copy.instance, e);
    if (!copy.instance) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        copy.instance[i] = place[i];
    }
    copy.instance_count = count;
    if (part->instance_count > 0) {
        copy.mesh = geometry_bake(part, run, e);
        if (!copy.mesh) {
            free(copy.instance);
            return false;
        }
    } else {
        copy.mesh = part->mesh;
        copy.curves = part->curves;
        part->mesh = NULL;
        part->curves = NULL;
    }
    return geometry_add(geometry, copy, e);
}

static bool add_variant(const GroveParams *grove, int species, const Transform *place,
                        int64_t count, uint64_t seed, const Placing *placing, Error *e)
{
    const TreeParams *own = species >= 0 ? grove->species[species].tree : NULL;
    TreeParams params = distant_tree(grove, own, seed);
    int plain[TREE_ROLES];
    for (int i = 0; i < TREE_ROLES; i++) {
        plain[i] = placing->material[i == TREE_LEAF ? GROUND_FOLIAGE : GROUND_BARK];
    }
    Recipe recipe = {.seed = seed, .label = "distant tree", .run = placing->recipe->run};
    InstancedTree how = {.at = {.place = place,
                                .count = count,
                                .most_leaves = DISTANT_LEAVES,
                                .most_faces = DISTANT_FACES,
                                .distant = true,
                                .seed = seed},
                         .material =
                             species >= 0 ? placing->further + species * TREE_ROLES : plain};
    Grown tree = {0};
    bool done = tree_grow(&params, &recipe, &tree, e) &&
                tree_finish(&params, &recipe, &tree, &tree, e) &&
                tree_add_instanced(&params, &tree, &how, placing, e);
    grown_clear(&tree);
    return done;
}

// The species of a variant: the first ones in turn, then by their shares. -1 = none is given.
static int species_of(const GroveParams *grove, int variant, uint64_t seed)
{
    if (grove->species_count == 0 || variant < grove->species_count) {
        return grove->species_count == 0 ? -1 : variant;
    }
    return tree_mix_choose(grove->species, grove->species_count, random_unit(seed));
}

// How many of the trees are of variant v: its species' share, divided among its variants.
static int64_t trees_of(const GroveParams *grove, const int *species, int variants, int v)
{
    double all = 0.0, same = 0.0;
    if (species[v] < 0) {
        return grove_share(grove->count, variants, v);
    }
    for (int i = 0; i < grove->species_count; i++) {
        all += (double)grove->species[i].share;
    }
    for (int i = 0; i < variants; i++) {
        same += species[i] == species[v];
    }
    double share = (double)grove->species[species[v]].share / all / same;
    return (int64_t)(share * (double)grove->count + 0.5);
}

bool grove_add(const GroundParams *ground, const Placing *placing, Error *e)
{
    const GroveParams *grove = &ground->trees;
    const Recipe *recipe = placing->recipe;
    int variants = grove->variants > grove->species_count ? grove->variants : grove->species_count;
    Transform *place = memory_alloc((int64_t)grove->count + 1, sizeof *place, e);
    int *species = place ? memory_alloc(variants, sizeof *species, e) : NULL;
    uint64_t seed = random_key(recipe->seed, STREAM_GROUND_TREES);
    for (int v = 0; species && v < variants; v++) {
        uint64_t key = random_key(random_key(seed, (uint64_t)v), STREAM_SPECIES);
        species[v] = species_of(grove, v, key);
    }
    bool done = species;
    for (int v = 0; done && v < variants; v++) {
        uint64_t key = random_key(seed, (uint64_t)v);
        int64_t wanted = trees_of(grove, species, variants, v);
        int64_t count = place_trees(ground, recipe->seed, random_key(key, STREAM_PLACES), wanted,
                                    placing->around.flood, place, recipe->run, e);
        done = count == 0 ||
               (count > 0 && add_variant(grove, species[v], place, count,
                                         random_key(key, STREAM_VARIANT_TREE), placing, e));
    }
    free(species);
    free(place);
    return done;
}
