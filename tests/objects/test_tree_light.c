// Trees of the kind that grow by light: the default oak's measures, heights and ages.
#include "objects/kind.h"
#include "objects/tree/tree.h"

#include "making.h"
#include "testing.h"

#include <math.h>

static TreeParams bare_tree(void)
{
    TreeParams params = tree_params_default();
    params.leaves.max_count = 0;
    params.roots.count = 0;
    return params;
}

static OutTree *grow(const TreeParams *params, uint64_t seed)
{
    Error e = {0};
    Run run = run_default();
    run.threads = 2;
    OutTree *tree = grow_kind(&kind_tree, params,
                              &(Recipe){.seed = seed, .label = "oak", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static float top_of(const OutTree *tree)
{
    return out_tree_bounds(tree).high.y;
}

static double measured(const TreeParams *params, OutTree *tree, const char *name)
{
    MeasureList list = {0};
    Grown grown = {.tree = tree};
    assert_true(kind_tree.measure(params, &grown, NULL, &list, NULL));
    double value = measures_find(&list, name)->value;
    measures_clear(&list);
    return value;
}

// Ranges of an open-grown broad-leaved tree among scanned ones.
static void five_default_oaks_are_open_grown_trees(void **state)
{
    (void)state;
    static const struct {
        const char *measure;
        double low, high;
    } range[] = {{"height_per_diameter", 20, 35},
                 {"branch_per_height", 40, 80},
                 {"tips", 500, 1500},
                 {"stem_share", 0.25, 0.45},
                 {"limb_straightness", 0.7, 0.87}};
    TreeParams params = bare_tree();
    for (uint64_t seed = 1; seed <= 5; seed++) {
        OutTree *tree = grow(&params, seed);
        for (size_t i = 0; i < sizeof range / sizeof range[0]; i++) {
            double value = measured(&params, tree, range[i].measure);
            if (!(value >= range[i].low && value <= range[i].high)) {
                fail_msg("seed %d: %s %g", (int)seed, range[i].measure, value);
            }
        }
        out_tree_free(tree);
    }
}

static void trees_have_the_height_that_was_asked(void **state)
{
    (void)state;
    static const float height[] = {1.0f, 4.0f, 11.0f, 25.0f};
    for (int i = 0; i < 4; i++) {
        TreeParams params = bare_tree();
        params.light.growth.seasons = 24;
        params.height = height[i];
        OutTree *tree = grow(&params, 3);
        assert_true(fabsf(top_of(tree) / height[i] - 1.0f) < 1e-3f);
        out_tree_free(tree);
    }
}

// From a sapling to a veteran: taller, with more branches, stouter.
static void trees_age(void **state)
{
    (void)state;
    static const float age[] = {8.0f, 30.0f, 120.0f, 400.0f};
    float top = 0.0f;
    int64_t nodes = 0;
    float slenderness = INFINITY;
    for (int i = 0; i < 4; i++) {
        TreeParams params = bare_tree();
        params.light.growth.seasons = 24;
        params.age = age[i];
        OutTree *tree = grow(&params, 3);
        float now = top_of(tree) / tree->radius[0];
        assert_true(top_of(tree) > top && tree->count > nodes && now < slenderness);
        top = top_of(tree);
        nodes = tree->count;
        slenderness = now;
        out_tree_free(tree);
    }
    assert_true(top > 14.0f && top < 16.0f);
}

// The height implies the age, and the age the height.
static void height_and_age_imply_each_other(void **state)
{
    (void)state;
    TreeParams params = bare_tree(), settled;
    params.height = 7.0f;
    kind_tree.settle(&params, &settled);
    assert_true(settled.age > 15.0f && settled.age < 60.0f);
    params.age = settled.age;
    params.height = 0.0f;
    kind_tree.settle(&params, &settled);
    assert_float_equal(settled.height, 7.0f, 1e-3f);
    params.age = 0.0f;
    kind_tree.settle(&params, &settled);
    assert_float_equal(settled.height, params.light.mature_height, 1e-3f);
    assert_float_equal(settled.age, params.light.mature_age, 1e-2f);
}

static GrowLevel limb_level = {40, 0.10f, 0.4f, 4.0f, 0.8f, 0.3f, 0.0f, 0.5f};

// Attractors lay the limbs; light adds twigs on all of them, within the crown's envelope.
static void light_fills_limbs_that_attractors_laid(void **state)
{
    (void)state;
    TreeParams params = bare_tree();
    params.height = 10.0f;
    params.trunk.radius = 0.2f;
    params.crown.lobes = 0;
    params.crown.element.levels = &limb_level;
    params.crown.element.level_count = 1;
    OutTree *limbs = grow(&params, 5);
    params.grown_by = GROWN_BY_BOTH;
    params.light.growth.seasons = 12;
    OutTree *tree = grow(&params, 5);
    assert_true(tree->count > 4 * limbs->count);
    assert_true(top_of(tree) < 10.3f && top_of(tree) > 8.0f);
    int64_t kept = 0;
    for (int64_t i = 0; i < limbs->count; i++) { // the limbs are still there
        int64_t k = 0;
        while (k < tree->count && tree->id[k] != limbs->id[i]) {
            k++;
        }
        kept += k < tree->count && vec3_distance(tree->position[k], limbs->position[i]) < 1e-3f;
    }
    assert_true(kept > limbs->count / 2);
    out_tree_free(limbs);
    out_tree_free(tree);
}

// The envelope of the attractors gives the crown its side and keeps it there, but does not cut it.
static void attractors_form_a_crown_that_light_fills(void **state)
{
    (void)state;
    Shape side = {.kind = SHAPE_ELLIPSOID,
                  .size = {3.0f, 2.5f, 3.0f},
                  .transform =
                      transform_compose(vec3(2.2f, 6.0f, 0), vec3(0, 0, 0), vec3_splat(1))};
    for (uint64_t seed = 1; seed <= 3; seed++) {
        TreeParams params = bare_tree();
        params.height = 9.0f;
        params.trunk.lean = 0.0f;
        params.light.growth.seasons = 24;
        OutTree *plain = grow(&params, seed);
        params.light.attractors.count = 4000;
        params.light.attractors.element.shapes = &side;
        params.light.attractors.element.shape_count = 1;
        OutTree *formed = grow(&params, seed);
        Aabb open = out_tree_bounds(plain), box = out_tree_bounds(formed);
        assert_true(box.low.x > 0.6f * open.low.x);
        assert_true(box.high.x > -1.3f * box.low.x && box.high.x < 6.5f);
        assert_true(formed->count > plain->count / 4);
        out_tree_free(plain);
        out_tree_free(formed);
    }
}

// A veteran has dead limbs, the more the older it is, in its upper crown; a young tree has none.
static void old_trees_have_dead_tops(void **state)
{
    (void)state;
    static const float age[] = {60.0f, 120.0f, 180.0f, 300.0f};
    double last = 0.0;
    for (int i = 0; i < 4; i++) {
        TreeParams params = bare_tree();
        params.light.growth.seasons = 24;
        params.light.growth.snags = 0.0f; // stubs are dead wood, too
        params.veteran.dead_limbs = 0.4f;
        params.age = age[i];
        OutTree *tree = grow(&params, 4);
        double dead = measured(&params, tree, "dead_share"), wanted = i < 2 ? 0.0 : 0.2 * (i - 1);
        assert_true(dead >= 0.6 * wanted && dead <= 1.1 * wanted);
        assert_true(i < 2 || dead > 1.4 * last);
        last = dead;
        double height = 0.0, living = 0.0, nodes = 0.0, alive = 0.0;
        for (int64_t k = 0; k < tree->count; k++) {
            bool snag = tree->colony[k] == TREE_SNAGS;
            assert_true(!snag || tree->radius[k] >= 0.01f); // twigs have fallen
            height += snag ? (double)tree->position[k].y : 0.0;
            nodes += snag;
            living += tree->colony[k] == TREE_CROWN ? (double)tree->position[k].y : 0.0;
            alive += tree->colony[k] == TREE_CROWN;
        }
        assert_true(i < 2 || height / nodes > living / alive);
        out_tree_free(tree);
    }
}

static void mistletoe_grows_on_grown_up_trees(void **state)
{
    (void)state;
    static const float age[] = {20.0f, 120.0f};
    static const double balls[] = {0.0, 12.0};
    for (int i = 0; i < 2; i++) {
        TreeParams params = bare_tree();
        params.light.growth.seasons = 24;
        params.veteran.mistletoe = 12;
        params.age = age[i];
        OutTree *tree = grow(&params, 4);
        assert_float_equal(measured(&params, tree, "mistletoe"), balls[i], 0.0);
        out_tree_free(tree);
    }
}

// With healing, old stubs become knots, nodes inside the wood that bore the limb; living wood
// stays as it is.
static void old_stubs_heal_to_knots(void **state)
{
    (void)state;
    TreeParams params = bare_tree();
    params.light.growth.seasons = 30;
    OutTree *stubs = grow(&params, 4);
    params.light.healing = 6;
    OutTree *healed = grow(&params, 4);
    int64_t count[2][TREE_COLONIES] = {0};
    for (int64_t i = 0; i < stubs->count; i++) {
        count[0][stubs->colony[i]]++;
    }
    for (int64_t i = 0; i < healed->count; i++) {
        count[1][healed->colony[i]]++;
        if (healed->colony[i] == TREE_KNOTS) {
            int32_t base = healed->parent[i];
            assert_true(healed->colony[base] <= TREE_CROWN);
            float away = vec3_distance(healed->position[i], healed->position[base]);
            assert_true(away < 0.6f * healed->radius[base]);
        }
    }
    assert_int_equal(count[0][TREE_TRUNK], count[1][TREE_TRUNK]);
    assert_int_equal(count[0][TREE_CROWN], count[1][TREE_CROWN]);
    assert_true(count[0][TREE_KNOTS] == 0 && count[1][TREE_KNOTS] > 50);
    assert_true(count[1][TREE_SNAGS] < count[0][TREE_SNAGS]);
    out_tree_free(stubs);
    out_tree_free(healed);
}

static int64_t count_parts(const Geometry *geometry, int role, int64_t *instances, int64_t *faces)
{
    int64_t parts = 0;
    *instances = *faces = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        if (geometry->part[i].material == role) {
            parts++;
            *instances += geometry->part[i].instance_count;
            *faces += geometry->part[i].mesh ? geometry->part[i].mesh->face_count : 0;
        }
    }
    return parts;
}

// Dead wood, mistletoe, moss and knots are parts of their own materials, in their number, and no
// tuft of moss is higher than the foot.
static void what_years_leave_has_geometry(void **state)
{
    (void)state;
    TreeParams params = bare_tree();
    params.light.growth.seasons = 24;
    params.skin.levels = 1;
    params.age = 240.0f;
    params.light.healing = 6;
    params.veteran = (VeteranParams){.dead_limbs = 0.3f, .mistletoe = 9, .moss = 200};
    Run run = run_default();
    Recipe recipe = {.seed = 4, .label = "oak", .run = &run};
    Grown grown;
    assert_true(kind_grow(&kind_tree, &params, &recipe, 1.0f, NULL, &grown, NULL));
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    assert_true(kind_tree.geometry(&params, &grown, &placing, NULL));
    int64_t instances, faces;
    assert_true(count_parts(&geometry, TREE_DEADWOOD, &instances, &faces) >= 2 && faces > 500);
    assert_true(count_parts(&geometry, TREE_MISTLETOE, &instances, &faces) > 0);
    assert_int_equal(instances, 9);
    assert_true(count_parts(&geometry, TREE_MOSS, &instances, &faces) > 0);
    assert_int_equal(instances, 200);
    for (int64_t i = 0; i < geometry.count; i++) {
        const Part *part = &geometry.part[i];
        for (int64_t k = 0; part->material == TREE_MOSS && k < part->instance_count; k++) {
            assert_true(part->instance[k].m[1][3] < 2.0f);
        }
    }
    geometry_clear(&geometry);
    grown_clear(&grown);
}

static void stems_grow_beside_each_other(void **state)
{
    (void)state;
    TreeParams params = bare_tree();
    params.height = 5.0f;
    params.light.growth.seasons = 20;
    params.trunk.stems = 4;
    params.trunk.stem_circle = 0.2f;
    OutTree *tree = grow(&params, 5);
    int roots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] < 0) {
            Vec3 foot = tree->position[i + 1];
            assert_float_equal(sqrtf(foot.x * foot.x + foot.z * foot.z), 0.2f, 1e-4f);
            assert_float_equal(foot.y, 0.0f, 1e-4f);
            roots++;
        }
    }
    assert_int_equal(roots, 4);
    out_tree_free(tree);
}

// A thicket's stems stand all over the circle, none outside.
static void stems_scatter_inside_their_circle(void **state)
{
    (void)state;
    TreeParams params = bare_tree();
    params.height = 5.0f;
    params.light.growth.seasons = 6;
    params.trunk.stems = 40;
    params.trunk.stem_circle = 1.0f;
    params.trunk.stem_scatter = 1.0f;
    OutTree *tree = grow(&params, 5);
    int inner = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] < 0) {
            Vec3 foot = tree->position[i + 1];
            float away2 = foot.x * foot.x + foot.z * foot.z;
            assert_true(away2 < 1.0f);
            inner += away2 < 0.5f;
        }
    }
    assert_in_range(inner, 12, 28); // half of the area
    out_tree_free(tree);
}

// Each stem starts at the splay's angle, away from the middle, and the tree is wider for it.
static void stems_splay_outward(void **state)
{
    (void)state;
    TreeParams params = bare_tree();
    params.height = 5.0f;
    params.light.growth.seasons = 8;
    params.trunk.lean = 0.0f;
    params.trunk.stems = 6;
    params.trunk.stem_circle = 0.5f;
    float width[2];
    for (int splayed = 0; splayed < 2; splayed++) {
        params.trunk.splay = splayed ? 30.0f : 0.0f;
        OutTree *tree = grow(&params, 5);
        for (int64_t i = 0; i < tree->count; i++) {
            if (tree->parent[i] >= 0) {
                continue;
            }
            Vec3 foot = tree->position[i + 1];
            Vec3 along = vec3_normalize(vec3_sub(foot, tree->position[i]));
            float out = (along.x * foot.x + along.z * foot.z) / 0.5f;
            assert_true(fabsf(out - (splayed ? 0.5f : 0.0f)) < 1e-3f); // sin 30
            assert_true(fabsf(along.y - (splayed ? sqrtf(0.75f) : 1.0f)) < 1e-3f);
        }
        Aabb box = out_tree_bounds(tree);
        width[splayed] = box.high.x - box.low.x;
        out_tree_free(tree);
    }
    assert_true(width[1] > 1.15f * width[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(five_default_oaks_are_open_grown_trees),
        cmocka_unit_test(trees_have_the_height_that_was_asked),
        cmocka_unit_test(trees_age),
        cmocka_unit_test(height_and_age_imply_each_other),
        cmocka_unit_test(light_fills_limbs_that_attractors_laid),
        cmocka_unit_test(attractors_form_a_crown_that_light_fills),
        cmocka_unit_test(old_trees_have_dead_tops),
        cmocka_unit_test(mistletoe_grows_on_grown_up_trees),
        cmocka_unit_test(old_stubs_heal_to_knots),
        cmocka_unit_test(what_years_leave_has_geometry),
        cmocka_unit_test(stems_grow_beside_each_other),
        cmocka_unit_test(stems_scatter_inside_their_circle),
        cmocka_unit_test(stems_splay_outward),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
