#include "making.h"
#include "objects/common/foliage.h"
#include "objects/ground/ground.h"
#include "objects/kinds.h"
#include "objects/tree/tree.h"
#include "scene/build.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static GrowLevel small_levels[] = {{30, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f},
                                   {300, 0.20f, 0.7f, 2.5f, 0.95f, 0.3f, 0.0f, 0.5f}};

static TreeParams small_tree(void)
{
    TreeParams params = tree_params_default();
    params.height = 14.0f;
    params.crown.element.levels = small_levels;
    params.crown.element.level_count = 2;
    params.crown.lobes = 0; // saves a level set each time
    params.leaves.max_count = 500;
    params.radii.tip = 0.01f;
    params.leaves.twig_radius = 0.03f;
    return params;
}

static OutTree *grow(const TreeParams *params, uint64_t seed, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *tree = grow_kind(&kind_tree, params,
                              &(Recipe){.seed = seed, .label = "oak", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static void a_tree_has_trunk_crown_and_roots(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *tree = grow(&params, 4, 1);
    Error e = {0};
    assert_true(out_tree_check(tree, &e));
    int64_t count[3] = {0};
    float top = 0.0f, lowest_branch = 1e9f, deepest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_in_range(tree->colony[i], 0, 2);
        count[tree->colony[i]]++;
        float y = tree->position[i].y;
        top = y > top ? y : top;
        deepest = y < deepest ? y : deepest;
        int32_t parent = tree->parent[i];
        if (tree->colony[i] == 1 && parent >= 0 && tree->colony[parent] == 0) {
            lowest_branch = y < lowest_branch ? y : lowest_branch;
        }
        if (parent >= 0 && tree->colony[i] == tree->colony[parent] && tree->colony[i] == 1) {
            assert_true(tree->radius[i] <= tree->radius[parent] * 1.0001f);
        }
        assert_true(tree->radius[i] > 0.0f);
    }
    assert_true(count[0] > 10 && count[1] > 200 && count[2] > 50);
    assert_true(top > 0.8f * params.height && top < 1.1f * params.height);
    // No branch below the share of the trunk that the scene keeps bare.
    assert_true(lowest_branch > 0.9f * params.crown.branch_from * 0.32f * params.height);
    assert_true(deepest < -0.1f);
    out_tree_free(tree);
}

static void the_same_seed_gives_the_same_tree_for_any_threads(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *one = grow(&params, 4, 1), *two = grow(&params, 4, 2), *other = grow(&params, 5, 1);
    assert_true(out_tree_hash(one) == out_tree_hash(two));
    assert_true(out_tree_hash(one) != out_tree_hash(other));
    out_tree_free(one);
    out_tree_free(two);
    out_tree_free(other);
}

// Ten times the size with no other number: the same form. Rounding may move a few nodes, so compare
// the extents.
static void a_larger_tree_has_the_same_form(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *small = grow(&params, 4, 1);
    params.height *= 10.0f;
    OutTree *large = grow(&params, 4, 1);
    double ratio = (double)large->count / (double)small->count;
    assert_true(ratio > 0.8 && ratio < 1.25);
    Vec3 a = out_tree_bounds(small).high, b = out_tree_bounds(large).high;
    assert_true(fabsf(b.y / a.y - 10.0f) < 0.7f);
    out_tree_free(small);
    out_tree_free(large);
}

static void leaves_sit_on_their_twigs(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *tree = grow(&params, 4, 1);
    Error e = {0};
    Run run = run_default();
    Geometry geometry = {0};
    Recipe recipe = {.seed = 4, .label = "oak", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    Grown grown = grown_of(tree);
    assert_true(tree_geometry(&params, &grown, &placing, &e));
    int64_t leaves = 0;
    CurveSet *twigs = NULL;
    for (int64_t p = 0; p < geometry.count; p++) {
        if (geometry.part[p].kind == PART_CURVES) {
            twigs = geometry.part[p].curves;
        }
        leaves += geometry.part[p].instance_count;
    }
    assert_non_null(twigs);
    assert_in_range(leaves, params.leaves.max_count * 8 / 10, params.leaves.max_count);
    for (int64_t p = 0; p < geometry.count; p++) {
        for (int64_t i = 0; i < geometry.part[p].instance_count; i += 17) {
            const Transform *t = &geometry.part[p].instance[i];
            Vec3 base = vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
            float nearest = 1e9f;
            for (int64_t c = 0; c < twigs->curve_count; c++) {
                for (int64_t k = twigs->first[c]; k + 1 < twigs->first[c + 1]; k++) {
                    Vec3 a = twigs->position[k], ab = vec3_sub(twigs->position[k + 1], a);
                    float s = vec3_dot(vec3_sub(base, a), ab) / vec3_dot(ab, ab);
                    Vec3 foot = vec3_madd(a, clampf(s, 0, 1), ab);
                    float gap = vec3_distance(base, foot) - twigs->radius[k];
                    nearest = gap < nearest ? gap : nearest;
                }
            }
            assert_true(nearest <= 0.0f); // the stalk's base is inside the bark
        }
    }
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static void grass_stands_on_the_ground(void **state)
{
    (void)state;
    GroundParams params = ground_params_default();
    params.grass_tufts = 600;
    params.fallen_leaves = 40;
    Error e = {0};
    Run run = run_default();
    Geometry geometry = {0};
    Recipe recipe = {.seed = 9, .label = "ground", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    assert_true(ground_geometry(&params, NULL, &placing, &e));
    int64_t tufts = 0;
    for (int64_t p = 1; p < geometry.count; p++) {
        for (int64_t i = 0; i < geometry.part[p].instance_count; i++) {
            const Transform *t = &geometry.part[p].instance[i];
            float above = t->m[1][3] - ground_height(&params, 9, t->m[0][3], t->m[2][3]);
            assert_true(above >= -1e-4f && above < 0.1f);
            tufts += geometry.part[p].material == GROUND_GRASS;
        }
    }
    assert_in_range(tufts, 200, 600);
    const Mesh *land = geometry.part[0].mesh;
    for (int64_t i = 0; i < land->vertex_count; i++) {
        assert_true(land->normal[i].y > 0.5f);
    }
    geometry_clear(&geometry);
}

// How far each stem of the trunk turns about the vertical axis through the base, from foot to top,
// in degrees from +Z toward +X. The stems are told apart by their roots, which come first.
enum { MOST_STEMS = 8 };

static int stem_turns(const OutTree *tree, Vec3 base, double turn[MOST_STEMS])
{
    int stems = 0;
    int *stem = calloc((size_t)tree->count, sizeof *stem);
    assert_non_null(stem);
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] != 0) {
            continue;
        }
        int32_t parent = tree->parent[i];
        if (parent < 0) {
            assert_true(stems < MOST_STEMS);
            turn[stem[i] = stems++] = 0.0;
            continue;
        }
        stem[i] = stem[parent];
        Vec3 a = vec3_sub(tree->position[parent], base), b = vec3_sub(tree->position[i], base);
        double across = (double)a.z * (double)b.x - (double)a.x * (double)b.z;
        double along = (double)a.x * (double)b.x + (double)a.z * (double)b.z;
        turn[stem[i]] += atan2(across, along) * 180.0 / 3.14159265358979;
    }
    free(stem);
    return stems;
}

// Copies of all meshes of this material.
static int64_t copies_of(const Geometry *geometry, int material)
{
    int64_t count = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        bool counts = part->kind == PART_MESH && part->material == material;
        count += counts ? part->instance_count : 0;
    }
    return count;
}

// Fewer things than variants, and land that is flat nowhere.
static void a_few_things_are_not_lost_among_variants(void **state)
{
    (void)state;
    GroundParams params = ground_params_default();
    params.flat_radius = 0.0f;
    params.grass_tufts = 0;
    params.fallen_leaves = 3;
    params.trees.count = 2;
    params.trees.clumping = 0.0f;
    params.trees.bare = true;
    Run run = {.threads = 1};
    Geometry geometry = {0};
    Error e = {0};
    Recipe recipe = {.seed = 9, .label = "ground", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    assert_true(ground_geometry(&params, NULL, &placing, &e));
    assert_int_equal(copies_of(&geometry, GROUND_FALLEN), 3);
    assert_int_equal(copies_of(&geometry, GROUND_BARK), 2);
    const Mesh *land = geometry.part[0].mesh;
    for (int64_t i = 0; i < land->vertex_count; i++) {
        assert_true(vec3_finite(land->position[i]) && vec3_finite(land->normal[i]));
    }
    geometry_clear(&geometry);
}

static int compare_ids(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

// Branches that crowd on one node of the trunk are not each other's doubles.
static void crowded_branches_have_names_of_their_own(void **state)
{
    (void)state;
    TreeParams params = tree_params_default();
    params.height = 14.0f;
    GrowLevel level = {20, 0.3f, 0.9f, 2.2f, 1.0f, 0.3f, 0.0f, 0.5f};
    params.crown.lobes = 0;
    params.crown.branches = 200;
    params.crown.element.points.shell = 0.0f;
    params.crown.element.levels = &level;
    params.crown.element.level_count = 1;
    params.roots.count = 0;
    Run run = {.threads = 1};
    Error e = {0};
    OutTree *tree = grow_kind(&kind_tree, &params,
                              &(Recipe){.seed = 5, .label = "tree", .run = &run}, 1.0f, &e);
    assert_non_null(tree);
    qsort(tree->id, (size_t)tree->count, sizeof *tree->id, compare_ids);
    for (int64_t i = 1; i < tree->count; i++) {
        assert_true(tree->id[i] != tree->id[i - 1]);
    }
    out_tree_free(tree);
}

// The pipe model's exponent for which the stem with most tips has the trunk's radius.
static double exponent_of_pipes(const OutTree *tree, const TreeParams *params)
{
    double most = 1.0, *tips = calloc((size_t)tree->count, sizeof *tips);
    assert_non_null(tips);
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        tips[i] = fmax(tips[i], 1.0);
        most = fmax(most, tips[i]);
        if (tree->parent[i] >= 0) {
            tips[tree->parent[i]] += tips[i];
        }
    }
    free(tips);
    return log(most) / log((double)params->trunk.radius / (double)params->radii.tip);
}

// How much thicker a node of a stem is than its children account for by the pipe model, relative to
// the length of the longest segment: large where a thin branch stands on a stump.
static double steepest_taper(const OutTree *tree, const TreeParams *params)
{
    double exponent = exponent_of_pipes(tree, params), steepest = 0.0, longest = 0.0;
    double *sum = calloc((size_t)tree->count, sizeof *sum);
    assert_non_null(sum);
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        double radius = (double)tree->radius[i];
        int32_t parent = tree->parent[i];
        if (tree->colony[i] == 0 && sum[i] > 0.0) {
            steepest = fmax(steepest, radius - pow(sum[i], 1.0 / exponent));
        }
        if (parent >= 0) {
            sum[parent] += pow(radius, exponent);
            longest =
                fmax(longest, (double)vec3_distance(tree->position[i], tree->position[parent]));
        }
    }
    free(sum);
    return steepest / longest;
}

// The trunk of scenes/twisted.yaml, whose crown is not looked at and made small.
static void the_turned_field_winds_the_stems(void **state)
{
    (void)state;
    Error e = {0};
    Scene *scene = scene_read("scenes/twisted.yaml", NULL, 0, &e);
    if (!scene) {
        fail_msg("%s:%d: %s", e.file, e.line, e.message);
    }
    const TreeParams *twisted = NULL;
    for (int i = 0; i < scene->object_count; i++) {
        twisted = scene->objects[i].kind == &kind_tree ? scene->objects[i].params : twisted;
    }
    assert_non_null(twisted);
    TreeParams params = *twisted;
    params.crown.lobes = 0;
    params.crown.element.levels = small_levels;
    params.crown.element.level_count = 1;
    params.roots.count = 0;
    double straight = 0.0;
    int count = 0;
    for (uint64_t seed = 1; seed <= 6; seed++) {
        for (int wound = 0; wound < 2; wound++) {
            params.trunk.element.growth.field_weight =
                wound ? twisted->trunk.element.growth.field_weight : 0.0f;
            double turn[MOST_STEMS];
            OutTree *tree = grow(&params, seed, 1);
            int stems = stem_turns(tree, params.position, turn);
            assert_int_equal(stems, params.trunk.stems);
            assert_true(steepest_taper(tree, &params) <
                        0.35); // none is a stump that bears thin branches
            for (int s = 0; s < stems; s++) {
                assert_true(wound ? turn[s] > 180.0 : fabs(turn[s]) < 120.0);
                straight += wound ? 0.0 : turn[s];
                count += !wound;
            }
            out_tree_free(tree);
        }
    }
    assert_true(fabs(straight / count) < 25.0); // without a field no side is favoured
    scene_free(scene);
}

static double measured(const OutTree *tree, const TreeParams *params, const char *name)
{
    MeasureList list = {0};
    Grown grown = grown_of(tree);
    assert_true(kind_tree.measure(params, &grown, NULL, &list, NULL));
    const Measure *measure = measures_find(&list, name);
    assert_non_null(measure);
    double value = measure->value;
    measures_clear(&list);
    return value;
}

// Figure 18 (c) of Tanaka et al.: a column of nuclei on the trunk's axis.
static void stems_wind_more_with_the_turn(void **state)
{
    (void)state;
    const float turns[] = {0.0f, 120.0f, 360.0f, 720.0f};
    Nucleus column = {.kind = NUCLEUS_LINE, .position = {0, -1, 0}, .end = {0, 6, 0}};
    FieldParams field = field_params_default(FIELD_NUCLEI);
    field.nucleus = &column;
    field.nucleus_count = 1;
    field.rim = 3.0f;
    TreeParams params = small_tree();
    params.height = 10.0f;
    params.trunk.height = 4.2f;
    params.trunk.radius = 0.16f;
    params.trunk.lean = 0.0f;
    params.trunk.stems = 5;
    params.trunk.stem_circle = 0.5f;
    params.trunk.element.growth.field_weight = 1.4f;
    params.trunk.element.growth.noise = 0.03f;
    params.trunk.element.fields = &field;
    params.trunk.element.field_count = 1;
    params.roots.count = 0;
    double last = 0.0;
    for (int i = 0; i < 4; i++) {
        field.turn = turns[i];
        OutTree *tree = grow(&params, 5, 1);
        double swept = measured(tree, &params, "trunk_swept"), turn[MOST_STEMS], mean = 0.0;
        int stems = stem_turns(tree, params.position, turn);
        for (int s = 0; s < stems; s++) {
            mean += turn[s] / stems;
        }
        assert_true(i > 0 ? swept > last + 25.0 : fabs(swept) < 25.0);
        assert_true(fabs(swept - mean) < 60.0); // the measure is what is counted here
        last = swept;
        out_tree_free(tree);
    }
    assert_true(last > 250.0);
}

// Figure 18 (b): the nuclei are the trunk's nodes, among which the foot of the tree is far away.
static void the_crown_winds_more_with_the_turn(void **state)
{
    (void)state;
    const float turns[] = {0.0f, 120.0f, 360.0f, 720.0f};
    GrowLevel level = {1500, 0.3f, 1.0f, 4.0f, 1.0f, 0.05f, 0.0f, 0.0f};
    FieldParams field = field_params_default(FIELD_NUCLEI);
    field.profile = PROFILE_GROWN;
    TreeParams params = small_tree();
    params.height = 10.0f;
    params.trunk.lean = 0.0f;
    params.crown.width = 9.5f;
    params.crown.base = 2.6f;
    params.crown.element.levels = &level;
    params.crown.element.level_count = 1;
    params.crown.element.growth.field_weight = 2.0f;
    params.crown.element.fields = &field;
    params.crown.element.field_count = 1;
    params.roots.count = 0;
    double last = 0.0;
    for (int i = 0; i < 4; i++) {
        field.turn = turns[i];
        OutTree *tree = grow(&params, 5, 1);
        double swept = measured(tree, &params, "crown_swept");
        assert_true(i > 0 ? swept > last + 40.0 : fabs(swept) < 20.0);
        last = swept;
        out_tree_free(tree);
    }
    assert_true(last > 250.0);
}

// Height of the land as it is drawn below (x, z): the faces are flat, ground_height is not.
static float drawn_height(const Mesh *land, float x, float z)
{
    for (int64_t f = 0; f < land->face_count; f++) {
        const uint32_t *corner = land->index + 4 * f;
        for (int half = 0; half < 2; half++) {
            Vec3 a = land->position[corner[0]], b = land->position[corner[1 + half]],
                 c = land->position[corner[2 + half]];
            float area = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
            float u = ((x - a.x) * (c.z - a.z) - (z - a.z) * (c.x - a.x)) / area;
            float v = ((b.x - a.x) * (z - a.z) - (b.z - a.z) * (x - a.x)) / area;
            if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f) {
                return a.y + u * (b.y - a.y) + v * (c.y - a.y);
            }
        }
    }
    fail_msg("no land below %g, %g", (double)x, (double)z);
    return 0.0f;
}

static void distant_trees_stand_on_the_ground(void **state)
{
    (void)state;
    GroundParams params = ground_params_default();
    params.grass_tufts = 0;
    params.trees.count = 60;
    params.trees.variants = 1;
    Error e = {0};
    Run run = run_default();
    Geometry geometry = {0};
    Recipe recipe = {.seed = 9, .label = "ground", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    assert_true(ground_geometry(&params, NULL, &placing, &e));
    const Mesh *land = geometry.part[0].mesh;
    int trunks = 0, crowns = 0; // parts: a crown's leaves are of several tones
    for (int64_t p = 1; p < geometry.count; p++) {
        const Part *part = &geometry.part[p];
        if (part->kind != PART_MESH) {
            continue;
        }
        Aabb box = mesh_bounds(part->mesh);
        trunks += part->material == GROUND_BARK;
        crowns += part->material == GROUND_FOLIAGE;
        assert_int_equal(part->instance_count, params.trees.count);
        for (int64_t i = 0; i < part->instance_count; i++) {
            const Transform *t = &part->instance[i];
            float x = t->m[0][3], z = t->m[2][3], land_y = drawn_height(land, x, z);
            float size = t->m[1][1], foot = t->m[1][3] + size * box.low.y - land_y;
            float r = sqrtf(x * x + z * z);
            assert_true(r >= 0.999f * params.trees.inner && r <= 1.001f * params.trees.outer);
            if (part->material == GROUND_BARK) {
                assert_true(foot < 0.0f && foot > -1.5f); // in the soil, and not deep
            } else {
                assert_true(foot > 0.0f); // leaves hang free
            }
            assert_true(t->m[1][3] + size * box.high.y - land_y < 1.05f * params.trees.height);
        }
    }
    assert_int_equal(trunks, 1);
    assert_true(crowns >= 1);
    geometry_clear(&geometry);
}

static uint64_t named_tree_hash(const char *objects, int index)
{
    static const char tree[] = "tree: &tree {height: 4, crown: {lobes: 0, growth: {levels: "
                               "[{attractors: 60}]}}}}";
    char text[1024];
    Error e = {0};
    Run run = run_default();
    snprintf(text, sizeof text, objects, tree);
    Scene *scene = scene_read_text(text, strlen(text), "text", "", NULL, 0, &e);
    OutTree *out = scene ? scene_grow_object(scene, index, &run, &e) : NULL;
    if (!out) {
        fail_msg("%s", e.message);
    }
    uint64_t hash = out_tree_hash(out);
    out_tree_free(out);
    scene_free(scene);
    return hash;
}

static void an_objects_name_makes_its_tree(void **state)
{
    (void)state;
    uint64_t ash = named_tree_hash("objects: [{name: ash, %s]", 0);
    assert_true(named_tree_hash("objects: [{name: elm, %s]", 0) != ash);
    assert_true(named_tree_hash("seed: 2\nobjects: [{name: ash, %s]", 0) != ash);
    // Other objects do not matter, and neither does the place in the list.
    static const char second[] = "objects: [{name: elm, %s, {name: ash, tree: *tree}]";
    assert_true(named_tree_hash(second, 1) == ash);
    assert_true(named_tree_hash(second, 0) == named_tree_hash("objects: [{name: elm, %s]", 0));
    // A seed of its own stands above name and scene.
    uint64_t own = named_tree_hash("objects: [{name: ash, seed: 5, %s]", 0);
    assert_true(own != ash);
    assert_true(named_tree_hash("seed: 3\nobjects: [{name: elm, seed: 5, %s]", 0) == own);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_has_trunk_crown_and_roots),
        cmocka_unit_test(the_same_seed_gives_the_same_tree_for_any_threads),
        cmocka_unit_test(a_larger_tree_has_the_same_form),
        cmocka_unit_test(leaves_sit_on_their_twigs),
        cmocka_unit_test(grass_stands_on_the_ground),
        cmocka_unit_test(a_few_things_are_not_lost_among_variants),
        cmocka_unit_test(crowded_branches_have_names_of_their_own),
        cmocka_unit_test(the_turned_field_winds_the_stems),
        cmocka_unit_test(stems_wind_more_with_the_turn),
        cmocka_unit_test(the_crown_winds_more_with_the_turn),
        cmocka_unit_test(distant_trees_stand_on_the_ground),
        cmocka_unit_test(an_objects_name_makes_its_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
