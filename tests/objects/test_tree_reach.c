// Whether a tree's elements fill their envelopes: slender trunks, crowns out of the trunk's reach,
// and what is said about those that end short.
#include "making.h"
#include "objects/tree/tree.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static GrowLevel crown_level[] = {{30, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f}};

static TreeParams plain_tree(void)
{
    TreeParams params = tree_params_default();
    params.height = 14.0f;
    params.crown.element.levels = crown_level;
    params.crown.element.level_count = 1;
    params.crown.lobes = 0;
    params.roots.count = 0;
    return params;
}

static void keep_trunks(void *user, const char *message)
{
    if (strncmp(message, "oak, trunk ", 11) == 0) {
        snprintf(user, 512, "%s", message);
    }
}

// warning: the last one of the trunk, 512 bytes; may be NULL.
static OutTree *grow(const TreeParams *params, uint64_t seed, char *warning)
{
    Error e = {0};
    Run run = run_default();
    if (warning) {
        warning[0] = '\0';
        run.warn = keep_trunks;
        run.user = warning;
    }
    OutTree *tree = grow_kind(&kind_tree, params,
                              &(Recipe){.seed = seed, .label = "oak", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static float top_of(const OutTree *tree, int32_t colony)
{
    float top = -INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        float y = tree->position[i].y;
        top = tree->colony[i] == colony && y > top ? y : top;
    }
    return top;
}

static void a_slender_trunk_is_as_long_as_asked(void **state)
{
    (void)state;
    static const float radius[5] = {0.01f, 0.03f, 0.1f, 0.25f, 0.5f};
    TreeParams params = plain_tree();
    params.trunk.height = 9.0f;
    for (int r = 0; r < 5; r++) {
        params.trunk.radius = radius[r];
        for (uint64_t seed = 1; seed <= 12; seed++) {
            OutTree *tree = grow(&params, seed, NULL);
            float top = top_of(tree, TREE_TRUNK);
            if (top < 0.85f * params.trunk.height || top > 1.1f * params.trunk.height) {
                fail_msg("radius %g m, seed %llu: %g m of trunk", (double)radius[r],
                         (unsigned long long)seed, (double)top);
            }
            out_tree_free(tree);
        }
    }
}

// A trunk whose level reaches less far than its attractors stand apart stops, and that is said with
// the numbers and with what would do; an influence of what is advised does.
static void an_element_that_ends_short_is_told_of(void **state)
{
    (void)state;
    GrowLevel level = {
        .attractors = 40, .step = 0.2f, .kill = 0.4f, .influence = 1.3f, .scale = 1.0f};
    TreeParams params = plain_tree();
    params.trunk.height = 9.0f;
    params.trunk.radius = 0.1f;
    params.trunk.element.levels = &level;
    params.trunk.element.level_count = 1;
    char warning[512];
    int advices = 0;
    for (;; advices++) {
        OutTree *tree = grow(&params, 3, warning);
        float top = top_of(tree, TREE_TRUNK);
        out_tree_free(tree);
        const char *advice = strstr(warning, "give level 1 an influence above ");
        if (!advice) {
            assert_true(top > 0.85f * params.trunk.height);
            break;
        }
        assert_true(top < 0.9f * params.trunk.height);
        float off = 0.0f;
        int out = 0;
        assert_int_equal(sscanf(warning,
                                "oak, trunk ends up to %g m short of its envelope: %d of 40", &off,
                                &out),
                         2);
        assert_true(out >= 4 && out < 40);
        assert_true(fabsf(off - (params.trunk.height - top)) < 0.5f);
        float wanted = (float)atof(advice + strlen("give level 1 an influence above "));
        assert_true(wanted > level.influence && wanted < 10.0f);
        level.influence = 1.01f * wanted;
    }
    assert_in_range(advices, 1, 10);
}

// A crown that begins far above the trunk is grown toward; on the way the trunk stays over its
// foot.
static void a_trunk_grows_up_to_a_crown_out_of_its_reach(void **state)
{
    (void)state;
    TreeParams params = plain_tree();
    for (int base = 5; base <= 12; base++) {
        params.crown.base = (float)base;
        for (uint64_t seed = 1; seed <= 3; seed++) {
            OutTree *tree = grow(&params, seed, NULL);
            Vec3 high = vec3(0, -1, 0);
            int64_t crown = 0;
            for (int64_t i = 0; i < tree->count; i++) {
                Vec3 p = tree->position[i];
                high = tree->colony[i] == TREE_TRUNK && p.y > high.y ? p : high;
                crown += tree->colony[i] == TREE_CROWN && p.y > params.crown.base;
            }
            if (crown < 20) {
                fail_msg("base %d m: %lld nodes in the crown", base, (long long)crown);
            }
            assert_true(high.y < params.height);
            assert_true(fabsf(high.x) < 0.4f * high.y && fabsf(high.z) < 0.4f * high.y);
            out_tree_free(tree);
        }
    }
}

static int64_t nodes_above(const OutTree *tree, int64_t node)
{
    int64_t count = 0;
    for (int64_t i = node + 1; i < tree->count; i++) {
        int64_t at = i;
        while (at > node) {
            at = tree->parent[at];
        }
        count += at == node;
    }
    return count;
}

// Branches that find nothing to grow toward are left out: the three nodes that every branch starts
// with never stand alone. The crown is a pad beside the trunk's top; branches start far below it.
static void no_branch_is_a_stub(void **state)
{
    (void)state;
    TreeParams params = plain_tree();
    Shape pad = {.kind = SHAPE_ELLIPSOID,
                 .size = {2.2f, 0.42f, 1.6f},
                 .transform = transform_compose(vec3(1.6f, 5.6f, 0), vec3_splat(0), vec3_splat(1))};
    params.crown.element.shapes = &pad;
    params.crown.element.shape_count = 1;
    params.crown.branches = 16;
    params.crown.branch_from = 0.2f;
    int64_t branches = 0;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        OutTree *tree = grow(&params, seed, NULL);
        for (int64_t i = 0; i < tree->count; i++) {
            int32_t parent = tree->parent[i];
            if (parent < 0 || tree->colony[parent] != TREE_TRUNK) {
                continue;
            }
            for (int place = 0; place < params.crown.branches; place++) {
                if (tree->id[i] == out_tree_child_id(tree->id[parent], 1000 + place)) {
                    branches++;
                    assert_true(nodes_above(tree, i) >= 3);
                }
            }
        }
        out_tree_free(tree);
    }
    assert_true(branches >= 4 && branches < 4 * params.crown.branches);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slender_trunk_is_as_long_as_asked),
        cmocka_unit_test(an_element_that_ends_short_is_told_of),
        cmocka_unit_test(a_trunk_grows_up_to_a_crown_out_of_its_reach),
        cmocka_unit_test(no_branch_is_a_stub),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
