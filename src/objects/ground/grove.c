#include "objects/ground/grove.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/tree/tree.h"

#include <stdlib.h>

enum { STREAM_HEIGHT = 1, STREAM_CROWN_WIDTH = 2, STREAM_CROWN_BASE = 3 }; // of a variant's tree
enum { STREAM_PLACES = 1, STREAM_VARIANT_TREE = 2 };                       // of a variant
// Of a tree's place.
enum {
    STREAM_RADIUS = 1,
    STREAM_AZIMUTH = 2,
    STREAM_CLUMPING = 3,
    STREAM_SIZE = 4,
    STREAM_TURN = 5
};

// A tree of about a hundred pixels: fewer levels, few and large leaves, no roots.
static TreeParams distant_tree(const GroveParams *grove, GrowLevel levels[3], uint64_t seed)
{
    levels[0] = (GrowLevel){25, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f};
    levels[1] = (GrowLevel){250, 0.20f, 0.7f, 2.5f, 0.92f, 0.3f, 0.0f, 0.5f};
    levels[2] = (GrowLevel){1600, 0.35f, 0.9f, 2.2f, 1.0f, 0.3f, 0.1f, 0.5f};
    TreeParams tree = tree_params_default();
    tree.height = grove->height * random_range(random_key(seed, STREAM_HEIGHT), 0.65f, 1.0f);
    tree.crown.width = tree.height * random_range(random_key(seed, STREAM_CROWN_WIDTH), 0.6f, 1.1f);
    tree.crown.base = tree.height * random_range(random_key(seed, STREAM_CROWN_BASE), 0.06f, 0.16f);
    tree.crown.element.levels = levels;
    tree.crown.element.level_count = 3;
    tree.crown.element.voxel = tree.height / 32.0f;
    tree.crown.element.points.shell = 0.0f; // its depth field would cost more than the growth
    tree.roots.count = 0;
    tree.radii.tip = 0.004f;
    tree.skin.curve_radius = 0.03f;
    tree.skin.levels = 0;
    tree.leaves.twig_radius = 0.03f;
    tree.leaves.max_count = grove->bare ? 0 : 7000;
    tree.leaves.spacing = 0.05f;
    tree.leaves.length = 0.034f * tree.height;
    tree.leaves.width = 0.024f * tree.height;
    tree.leaves.petiole = 0.0f;
    tree.leaves.lobes = 0;
    tree.leaves.variants = 1;
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

static bool add_variant(const GroveParams *grove, const Transform *place, int64_t count,
                        uint64_t seed, const Placing *placing, Error *e)
{
    GrowLevel levels[3];
    TreeParams params = distant_tree(grove, levels, seed);
    const int material[] = {placing->material[GROUND_BARK], placing->material[GROUND_BARK],
                            placing->material[GROUND_FOLIAGE]};
    const Run *run = placing->recipe->run;
    Recipe recipe = {.seed = seed, .label = "distant tree", .run = run};
    Geometry single = {0};
    Placing own = {&recipe, &single, material, placing->object, {0}};
    Grown tree = {0};
    bool done = tree_grow(&params, &recipe, &tree, e) &&
                tree_finish(&params, &recipe, &tree, &tree, e) &&
                tree_geometry(&params, &tree, &own, e);
    grown_clear(&tree);
    for (int64_t i = 0; done && i < single.count; i++) {
        done = grove_add_part(placing->geometry, &single.part[i], place, count, run, e);
    }
    geometry_clear(&single);
    return done;
}

bool grove_add(const GroundParams *ground, const Placing *placing, Error *e)
{
    const GroveParams *grove = &ground->trees;
    const Recipe *recipe = placing->recipe;
    Transform *place =
        memory_alloc(grove_share(grove->count, grove->variants, 0), sizeof *place, e);
    bool done = place != NULL;
    for (int v = 0; done && v < grove->variants; v++) {
        uint64_t key = random_key(random_key(recipe->seed, STREAM_GROUND_TREES), (uint64_t)v);
        int64_t wanted = grove_share(grove->count, grove->variants, v);
        int64_t count = place_trees(ground, recipe->seed, random_key(key, STREAM_PLACES), wanted,
                                    placing->around.flood, place, recipe->run, e);
        done = count == 0 ||
               (count > 0 &&
                add_variant(grove, place, count, random_key(key, STREAM_VARIANT_TREE), placing, e));
    }
    free(place);
    return done;
}
