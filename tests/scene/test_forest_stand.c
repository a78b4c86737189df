// Forests of species: inner trees are bare below, those of an edge lean outward.
#include "objects/forest/individuals.h"

#include "scene_fixture.h"

#include <math.h>
#include <stdlib.h>

enum { LEAST_BRANCH = 20 }; // nodes of a branch that counts

// Height of the lowest living branch of the trunk, share of the tree's.
static float crown_base(const OutTree *tree)
{
    int32_t *above = calloc((size_t)tree->count, sizeof *above);
    float top = 0.0f, base = INFINITY;
    for (int64_t i = tree->count - 1; i > 0; i--) {
        int32_t parent = tree->parent[i];
        if (parent < 0 || tree->colony[i] > TREE_CROWN) {
            continue;
        }
        above[parent] += above[i] + 1;
        top = fmaxf(top, tree->position[i].y);
        bool branch = tree->colony[i] == TREE_CROWN && tree->colony[parent] == TREE_TRUNK;
        base = branch && above[i] >= LEAST_BRANCH ? fminf(base, tree->position[parent].y) : base;
    }
    free(above);
    return base / top;
}

// Mean of the crown's nodes beyond the foot toward the open land, share of the crown's width.
static float lean(const OutTree *tree)
{
    Aabb box = aabb_empty();
    double sum = 0.0, count = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] == TREE_CROWN) {
            box = aabb_add(box, tree->position[i]);
            sum += (double)tree->position[i].z;
            count += 1.0;
        }
    }
    return (float)(sum / count) / (box.high.x - box.low.x);
}

typedef struct Stand {
    float base[3]; // means by situation, of trees that are not suppressed
    float lean;    // of the edge
} Stand;

static Stand measure(const Scene *scene)
{
    Error e = {0};
    Individuals all;
    const ForestParams *forest = scene->objects[0].params;
    assert_true(individuals_init(&all, forest, scene_object_seed(scene, 0), &e));
    OutTree *grown = fixture_grow(scene, "wood", 2);
    Stand stand = {0};
    int count[3] = {0};
    for (int i = 0; i < all.count; i++) {
        const Individual *one = &all.one[i];
        bool small = one->params.height < 0.9f * all.one[0].params.height;
        if (!one->kept || small) {
            continue;
        }
        OutTree *tree = individuals_tree(&all, grown, i, &e);
        assert_non_null(tree);
        float base = crown_base(tree);
        if (base < 1.0f && out_tree_bounds(tree).high.y > 0.8f * one->params.height) {
            stand.base[one->situation] += base;
            stand.lean += one->situation == SITUATION_EDGE ? lean(tree) : 0.0f;
            count[one->situation]++;
        }
        out_tree_free(tree);
    }
    assert_true(count[SITUATION_INNER] >= 2 && count[SITUATION_EDGE] >= 2);
    for (int k = 0; k < 3; k++) {
        stand.base[k] /= (float)count[k];
    }
    stand.lean /= (float)count[SITUATION_EDGE];
    individuals_free(&all);
    out_tree_free(grown);
    return stand;
}

// A closed stand of a species by its library file, on a few seeds.
static void check_species(void **state, const char *species, int trees, float spacing,
                          float least_lean)
{
    for (int seed = 1; seed <= 3; seed++) {
        char text[512];
        snprintf(text, sizeof text,
                 "seed: %d\nobjects:\n  - name: wood\n    forest: {height: 24, spacing: %g, "
                 "stands: 1, stand_trees: %d, leaves: {max_count: 0}, species: [{tree: {species: "
                 "%s, light: {seasons: 22}}}]}\n",
                 seed, (double)spacing, trees, species);
        Scene *scene = fixture_read(*state, text);
        Stand stand = measure(scene);
        float inner = stand.base[SITUATION_INNER], edge = stand.base[SITUATION_EDGE];
        print_message("%s, seed %d: crown base %.2f inside, %.2f at the edge, %.2f open; lean "
                      "%.2f\n",
                      species, seed, (double)inner, (double)edge,
                      (double)stand.base[SITUATION_OPEN], (double)stand.lean);
        assert_true(inner > 0.45f && inner < 0.75f);
        assert_true(edge < inner - 0.1f);
        assert_true(stand.base[SITUATION_OPEN] < 0.2f);
        assert_true(stand.lean > least_lean);
        scene_free(scene);
    }
}

static void beeches_clear_their_stems(void **state)
{
    check_species(state, "beech", 6, 4.5f, 0.25f);
}

static void spruces_clear_their_stems(void **state)
{
    check_species(state, "norway_spruce", 4, 4.0f, 0.05f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(beeches_clear_their_stems, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(spruces_clear_their_stems, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
