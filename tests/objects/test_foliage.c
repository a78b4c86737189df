// Leaves on one straight twig: where each arrangement puts them and how they are turned.
#include "objects/common/branches.h"
#include "objects/common/foliage.h"
#include "objects/tree/tree.h"
#include "testing.h"

#include <stdio.h>

enum { POINTS = 11 };
static const float TWIG_LENGTH = 0.5f;

// Level along +X, or upright.
static CurveSet *twig(Vec3 along)
{
    CurveSet *curves = curves_new(POINTS, 1, NULL);
    for (int i = 0; i < POINTS; i++) {
        curves->position[i] = vec3_scale(along, TWIG_LENGTH * (float)i / (POINTS - 1));
        curves->radius[i] = 0.002f;
        curves->birth[i] = curves->along[i] = 0.0f;
    }
    curves->first[0] = 0;
    curves->first[1] = POINTS;
    curves->id[0] = 5;
    return curves;
}

static LeavesParams plain_leaves(LeafArrangement arrangement)
{
    LeavesParams leaves = tree_params_default().leaves;
    leaves.arrangement = arrangement;
    leaves.spacing = 0.05f;
    leaves.droop = 0.0f;
    leaves.crowding = 0.0f;
    leaves.size_variation = 0.0f;
    leaves.variants = 1;
    return leaves;
}

// The leaves' part, the only one. Free with geometry_clear.
static Geometry grow_on(const LeavesParams *leaves, Vec3 along)
{
    Geometry geometry = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 1, .label = "twig", .run = &run};
    static const int material[3] = {0};
    Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
    CurveSet *curves = twig(along);
    Error e = {0};
    LeafLight light = {.center = {0, -5, 0}};
    assert_true(foliage_add(curves, NULL, leaves, &light, 3, &placing, 0, &e));
    curves_free(curves);
    assert_int_equal(geometry.count, 1);
    return geometry;
}

static Vec3 axis(const Transform *t, int column)
{
    return vec3_normalize(vec3(t->m[0][column], t->m[1][column], t->m[2][column]));
}

// Direction of a leaf's stalk across the twig.
static Vec3 outward(const Transform *t, Vec3 along)
{
    Vec3 y = axis(t, 1);
    return vec3_normalize(vec3_madd(y, -vec3_dot(y, along), along));
}

static float degrees_between(Vec3 a, Vec3 b)
{
    return acosf(clampf(vec3_dot(a, b), -1.0f, 1.0f)) / RADIANS_PER_DEGREE;
}

static void successive_leaves_are_turned_by_the_arrangement(void **state)
{
    (void)state;
    static const struct {
        LeafArrangement arrangement;
        int step;    // from leaf to leaf that is compared
        float angle; // between them
    } cases[] = {{ARRANGE_SPIRAL, 1, 137.5f},  {ARRANGE_ALTERNATE, 1, 144.0f},
                 {ARRANGE_DISTICHOUS, 1, 180}, {ARRANGE_OPPOSITE, 1, 180.0f},
                 {ARRANGE_OPPOSITE, 2, 90.0f}, {ARRANGE_WHORLED, 1, 120.0f},
                 {ARRANGE_WHORLED, 3, 60.0f}};
    Vec3 along = vec3(1, 0, 0);
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        LeavesParams leaves = plain_leaves(cases[c].arrangement);
        int each = leaves_per_node(&leaves);
        Geometry geometry = grow_on(&leaves, along);
        const Part *part = &geometry.part[0];
        assert_in_range(part->instance_count, 9 * each, 11 * each);
        for (int64_t i = 0; i + cases[c].step < part->instance_count; i += each) {
            float turn = degrees_between(outward(&part->instance[i], along),
                                         outward(&part->instance[i + cases[c].step], along));
            if (!(fabsf(turn - cases[c].angle) < 8.01f)) { // 4 degrees of noise each
                fail_msg("case %zu, leaf %lld: %g degrees", c, (long long)i, (double)turn);
            }
        }
        geometry_clear(&geometry);
    }
}

static float length_of(const Transform *t)
{
    return vec3_length(vec3(t->m[0][1], t->m[1][1], t->m[2][1]));
}

// Sizes and gaps grow from the twig's end, to those of a twig without the key.
static void leaves_are_smaller_toward_the_end(void **state)
{
    (void)state;
    enum { SMALL = 5 };
    const Vec3 along = {1, 0, 0};
    LeavesParams leaves = plain_leaves(ARRANGE_DISTICHOUS);
    Geometry equal = grow_on(&leaves, along);
    leaves.tip_leaves = SMALL;
    Geometry tapered = grow_on(&leaves, along);
    const Part *part = &tapered.part[0];
    assert_true(part->instance_count > SMALL + 2);
    assert_true(part->instance_count > equal.part[0].instance_count);
    float full = length_of(&equal.part[0].instance[0]);
    for (int64_t i = 0; i + 1 < part->instance_count; i++) {
        const Transform *leaf = &part->instance[i];
        float share = i < SMALL ? (float)(i + 1) / (SMALL + 1) : 1.0f;
        assert_float_equal(length_of(leaf), share * full, 1e-4f * full);
        float gap = leaf->m[0][3] - leaf[1].m[0][3];
        assert_float_equal(gap, share * leaves.spacing, 1e-3f * leaves.spacing);
    }
    geometry_clear(&equal);
    geometry_clear(&tapered);
}

// Sizes rise in proportion to the distance from the lower end, from a third; places stay.
static void leaves_are_smaller_toward_the_base(void **state)
{
    (void)state;
    enum { SMALL = 6 };
    const Vec3 along = {1, 0, 0};
    LeavesParams leaves = plain_leaves(ARRANGE_DISTICHOUS);
    Geometry equal = grow_on(&leaves, along);
    leaves.base_leaves = SMALL;
    Geometry tapered = grow_on(&leaves, along);
    const Part *part = &tapered.part[0], *plain = &equal.part[0];
    assert_int_equal(part->instance_count, plain->instance_count);
    int small = 0;
    for (int64_t i = 0; i < part->instance_count; i++) {
        float above = part->instance[i].m[0][3] / (SMALL * leaves.spacing);
        float share = above < 1.0f ? (1.0f + 2.0f * above) / 3.0f : 1.0f;
        float full = length_of(&plain->instance[i]);
        assert_float_equal(length_of(&part->instance[i]), share * full, 1e-4f * full);
        assert_float_equal(part->instance[i].m[0][3], plain->instance[i].m[0][3], 1e-6f);
        small += above < 1.0f;
    }
    assert_in_range(small, SMALL - 1, SMALL + 1);
    geometry_clear(&equal);
    geometry_clear(&tapered);
}

// The nodes within the foot are the same as without it; there are none above.
static void leaves_keep_to_the_foot(void **state)
{
    (void)state;
    const float foot = 0.3f;
    LeavesParams leaves = plain_leaves(ARRANGE_DISTICHOUS);
    Geometry all = grow_on(&leaves, (Vec3){1, 0, 0});
    leaves.foot = foot;
    Geometry low = grow_on(&leaves, (Vec3){1, 0, 0});
    int64_t next = 0;
    for (int64_t i = 0; i < all.part[0].instance_count; i++) {
        const Transform *place = &all.part[0].instance[i];
        if (place->m[0][3] > foot) {
            continue;
        }
        assert_true(next < low.part[0].instance_count);
        assert_memory_equal(place, &low.part[0].instance[next], sizeof *place);
        next++;
    }
    assert_true(next > 0 && next < all.part[0].instance_count);
    assert_int_equal(next, low.part[0].instance_count);
    leaves.arrangement = ARRANGE_ROSETTE; // stays at the end
    leaves.per_node = 7;
    Geometry rosette = grow_on(&leaves, (Vec3){1, 0, 0});
    assert_int_equal(rosette.part[0].instance_count, leaves.per_node);
    geometry_clear(&all);
    geometry_clear(&low);
    geometry_clear(&rosette);
}

// Young leaves are at the end, the younger the nearer and the smaller; places stay, and so do
// leaves of needles, whose mesh has its ages.
static void the_tip_is_this_years(void **state)
{
    (void)state;
    const Vec3 along = {1, 0, 0};
    LeavesParams leaves = plain_leaves(ARRANGE_DISTICHOUS);
    leaves.spacing = 0.01f;
    Geometry old = grow_on(&leaves, along);
    leaves.flush = 0.5f;
    Geometry renewed = grow_on(&leaves, along);
    const Part *part = &renewed.part[0], *plain = &old.part[0];
    assert_int_equal(part->instance_count, plain->instance_count);
    int young = 0;
    for (int64_t i = 0; i < part->instance_count; i++) { // from the tip on
        float share = -part->season[i];
        assert_true(share >= 0.0f && share <= 1.0f);
        assert_float_equal(plain->season[i], 0.0f, 0.0f);
        assert_true(i == 0 || part->season[i] >= part->season[i - 1]);
        assert_float_equal(length_of(&part->instance[i]),
                           (1.0f - 0.6f * share) * length_of(&plain->instance[i]), 1e-5f);
        assert_float_equal(part->instance[i].m[0][3], plain->instance[i].m[0][3], 1e-6f);
        young += share > 0.0f;
    }
    assert_true(part->season[0] < -0.8f); // at the tip
    assert_in_range(young, 3, part->instance_count);
    assert_float_equal(part->season[part->instance_count - 1], 0.0f, 0.05f);
    geometry_clear(&old);
    geometry_clear(&renewed);
}

static void two_rows_lie_left_and_right(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_DISTICHOUS);
    leaves.plane = 1.0f;
    Geometry geometry = grow_on(&leaves, vec3(1, 0, 0));
    const Part *part = &geometry.part[0];
    for (int64_t i = 0; i < part->instance_count; i++) {
        assert_true(fabsf(axis(&part->instance[i], 1).y) < 1e-4f);
        assert_true(axis(&part->instance[i], 2).y > 0.999f); // the upper side up
    }
    geometry_clear(&geometry);
}

static void hanging_leaves_hang(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_SPIRAL);
    leaves.hang = 1.0f;
    Geometry geometry = grow_on(&leaves, vec3(1, 0, 0));
    for (int64_t i = 0; i < geometry.part[0].instance_count; i++) {
        assert_true(axis(&geometry.part[0].instance[i], 1).y < -0.9f);
    }
    geometry_clear(&geometry);
}

static void a_rosette_is_at_the_end(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_ROSETTE);
    leaves.per_node = 30;
    leaves.angle = 100.0f;
    Vec3 up = vec3(0, 1, 0);
    Geometry geometry = grow_on(&leaves, up);
    const Part *part = &geometry.part[0];
    assert_int_equal(part->instance_count, 30);
    for (int64_t i = 0; i < 30; i++) {
        assert_true(part->instance[i].m[1][3] > TWIG_LENGTH - 0.01f);
    }
    // From nearly upright to beyond level.
    assert_true(degrees_between(axis(&part->instance[0], 1), up) < 20.0f);
    assert_true(degrees_between(axis(&part->instance[29], 1), up) > 65.0f);
    geometry_clear(&geometry);
}

// Dead leaves come on top of the living, hang below them and keep their colour all year.
static void withered_leaves_hang_below_a_rosette(void **state)
{
    (void)state;
    enum { LIVING = 20, WITHERED = 12 };
    LeavesParams leaves = plain_leaves(ARRANGE_ROSETTE);
    leaves.per_node = LIVING;
    leaves.angle = 100.0f;
    leaves.withered = WITHERED;
    Vec3 up = vec3(0, 1, 0);
    for (int turning = 0; turning < 2; turning++) {
        leaves.autumn = turning ? 0.4f : 0.0f;
        Geometry geometry = grow_on(&leaves, up);
        const Part *part = &geometry.part[0];
        assert_int_equal(part->instance_count, LIVING + WITHERED);
        float lowest = TWIG_LENGTH;
        for (int64_t i = 0; i < LIVING; i++) {
            assert_true(turning || part->season[i] == 0.0f);
            lowest = fminf(lowest, part->instance[i].m[1][3]);
        }
        for (int64_t i = LIVING; i < LIVING + WITHERED; i++) {
            assert_true(part->season[i] == 1.0f);
            assert_true(part->instance[i].m[1][3] < lowest);
            assert_true(i < LIVING + WITHERED / 2 || axis(&part->instance[i], 1).y < -0.1f);
        }
        geometry_clear(&geometry);
    }
    leaves.arrangement = ARRANGE_WHORLED; // of rosettes alone
    leaves.autumn = 0.0f;
    Geometry geometry = grow_on(&leaves, up);
    assert_int_equal(geometry.part[0].instance_count % LIVING, 0);
    geometry_clear(&geometry);
}

// However wide the spacing, a rosette keeps its leaves: then fewer twigs have any.
static void rosettes_are_limited(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_ROSETTE);
    leaves.per_node = 30;
    leaves.max_count = 100;
    Geometry geometry = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 1, .label = "twigs", .run = &run};
    static const int material[3] = {0};
    Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
    LeafLight light = {.center = {0, -5, 0}};
    Error e = {0};
    enum { TWIGS = 20 };
    CurveSet *curves = curves_new(2 * TWIGS, TWIGS, &e);
    assert_non_null(curves);
    for (int i = 0; i <= TWIGS; i++) {
        curves->first[i] = 2 * i;
    }
    for (int i = 0; i < 2 * TWIGS; i++) {
        curves->position[i] = vec3((float)(i / 2), (float)(i % 2), 0);
        curves->radius[i] = 0.001f;
        curves->birth[i] = curves->along[i] = 0.0f;
        curves->id[i / 2] = (uint64_t)i;
    }
    assert_true(foliage_add(curves, NULL, &leaves, &light, 3, &placing, 0, &e));
    assert_int_equal(geometry.count, 1);
    assert_in_range(geometry.part[0].instance_count, 30, 100);
    assert_int_equal(geometry.part[0].instance_count % 30, 0);
    geometry_clear(&geometry);
    curves_free(curves);
}

static void note_warning(void *user, const char *message)
{
    snprintf(user, 512, "%s", message);
}

// Warning about leaves on a shoot of ten equal internodes, the lower `thick` of which are thicker
// than curve_radius and all thinner than twig_radius; empty if there is none.
static void warning_of_shoot(int thick, float curve_radius, char text[512])
{
    Error e = {0};
    Geometry geometry = {0};
    text[0] = '\0';
    Run run = run_default();
    run.warn = note_warning;
    run.user = text;
    Recipe recipe = {.seed = 1, .label = "shoot", .run = &run};
    static const int material[3] = {0};
    Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
    OutTree *tree = out_tree_new(&e);
    for (int i = 0; i <= 10; i++) {
        uint64_t id = i == 0 ? 1 : out_tree_child_id(tree->id[i - 1], 0);
        assert_int_equal(out_tree_add_node(tree, vec3(0, 0.1f * (float)i, 0), i - 1, i, 0, id, &e),
                         i);
        tree->radius[i] = i <= thick ? 0.008f : 0.003f;
    }
    LeavesParams leaves = plain_leaves(ARRANGE_SPIRAL);
    leaves.twig_radius = 0.01f;
    SkinningParams skin = {.curve_radius = curve_radius};
    TwigParams twigs = {.skin = &skin, .leaves = &leaves, .bare_from = -1, .leaf_role = 1};
    assert_true(branches_add_twigs(tree, &twigs, &placing, &e));
    geometry_clear(&geometry);
    out_tree_free(tree);
}

// Leaves stand on curves alone: where most of the thin branches are mesh, that is told.
static void leaves_lost_to_the_mesh_are_told(void **state)
{
    (void)state;
    char text[512];
    warning_of_shoot(6, 0.005f, text);
    assert_non_null(strstr(text, "60 %"));
    assert_non_null(strstr(text, "skin.curve_radius, 0.005 m"));
    assert_non_null(strstr(text, "leaves.twig_radius, 0.01 m"));
    warning_of_shoot(10, 0.001f, text); // not one leaf
    assert_non_null(strstr(text, "100 %"));
    warning_of_shoot(4, 0.005f, text);
    assert_string_equal(text, "");
    warning_of_shoot(6, 0.01f, text);
    assert_string_equal(text, "");
    warning_of_shoot(6, 0.0f, text); // all is mesh: leaves have curves of their own
    assert_string_equal(text, "");
}

static void short_shoots_bear_clusters(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_SPURS);
    leaves.per_node = 4;
    Geometry geometry = grow_on(&leaves, vec3(1, 0, 0));
    const Part *part = &geometry.part[0];
    assert_int_equal(part->instance_count % 4, 0);
    for (int64_t i = 0; i < part->instance_count; i += 4) {
        for (int64_t k = 1; k < 4; k++) {
            for (int row = 0; row < 3; row++) {
                assert_float_equal(part->instance[i + k].m[row][3], part->instance[i].m[row][3],
                                   1e-6f);
            }
        }
    }
    geometry_clear(&geometry);
}

// Pieces with needles follow each other without a gap from the twig's end to its start.
static void needles_cover_the_twig(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_SPIRAL);
    leaves.shape = LEAF_NEEDLES;
    leaves.length = 0.015f;
    leaves.width = 0.001f;
    Vec3 along = vec3(1, 0, 0);
    Geometry geometry = grow_on(&leaves, along);
    const Part *part = &geometry.part[0];
    float covered = 0.0f;
    for (int64_t i = 0; i < part->instance_count; i++) {
        const Transform *t = &part->instance[i];
        assert_true(degrees_between(axis(t, 1), along) < 0.1f);
        Vec3 start = vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
        Vec3 end = transform_point(t, vec3(0, leaves.spacing, 0));
        covered += vec3_distance(start, end);
        assert_true(end.x <= TWIG_LENGTH + 1e-5f && start.x >= -1e-5f);
    }
    assert_float_equal(covered, TWIG_LENGTH, 1e-4f);
    geometry_clear(&geometry);
}

// Number of leaves with a season in (low, high].
static int64_t in_season(const Geometry *geometry, float low, float high)
{
    int64_t count = 0;
    const Part *part = &geometry->part[0];
    for (int64_t i = 0; i < part->instance_count; i++) {
        count += part->season[i] > low && part->season[i] <= high;
    }
    return count;
}

static void leaves_turn_from_the_top(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_SPIRAL);
    leaves.spacing = 0.0005f;
    for (leaves.autumn = 0.0f; leaves.autumn <= 1.0f; leaves.autumn += 0.25f) {
        Geometry geometry = grow_on(&leaves, vec3(0, 1, 0));
        const Part *part = &geometry.part[0];
        double share = (double)in_season(&geometry, 0.5f, 1.0f) / (double)part->instance_count;
        double wanted = 1.3 * (double)leaves.autumn - 0.15; // half turned
        wanted = wanted < 0.0 ? 0.0 : wanted > 1.0 ? 1.0 : wanted;
        assert_true(fabs(share - wanted) < 0.003);
        if (leaves.autumn == 0.5f) {
            double height[2] = {0}, count[2] = {0};
            for (int64_t i = 0; i < part->instance_count; i++) {
                bool turned = part->season[i] > 0.5f;
                height[turned] += (double)part->instance[i].m[1][3];
                count[turned] += 1.0;
            }
            assert_true(height[1] / count[1] > height[0] / count[0] + 0.05);
        }
        assert_int_equal(in_season(&geometry, 0.0f, 1.0f) > 0, leaves.autumn > 0.0f);
        geometry_clear(&geometry);
    }
}

static void as_many_leaves_are_shed_as_asked_for(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_SPIRAL);
    leaves.spacing = 0.001f;
    Geometry whole = grow_on(&leaves, vec3(0, 1, 0));
    int64_t all = whole.part[0].instance_count;
    geometry_clear(&whole);
    leaves.fall = 0.6f;
    int64_t shed = (int64_t)(0.6 * (double)all + 0.5);
    for (leaves.litter = 0.0f; leaves.litter <= 1.0f; leaves.litter += 0.5f) {
        Geometry geometry = grow_on(&leaves, vec3(0, 1, 0));
        const Part *part = &geometry.part[0];
        int64_t lying = part->instance_count - (all - shed);
        double share = (double)lying / (double)shed;
        assert_true(fabs(share - (double)leaves.litter) < 0.06);
        int64_t low = 0; // on the ground, which is at height 0, with their upper or under side up
        for (int64_t i = 0; i < part->instance_count; i++) {
            const Transform *t = &part->instance[i];
            bool lies = t->m[1][3] > 0.0f && t->m[1][3] < 0.031f && part->season[i] == 1.0f &&
                        fabsf(axis(t, 2).y) > 0.7f;
            low += lies;
        }
        assert_true(low >= lying);
        geometry_clear(&geometry);
    }
}

static void young_leaves_are_small_and_folded(void **state)
{
    (void)state;
    LeavesParams leaves = plain_leaves(ARRANGE_SPIRAL);
    float before = 0.0f, width_before = 0.0f;
    for (leaves.emergence = 0.25f; leaves.emergence <= 1.0f; leaves.emergence += 0.25f) {
        Geometry geometry = grow_on(&leaves, vec3(1, 0, 0));
        const Part *part = &geometry.part[0];
        float size = 0.0f;
        for (int64_t i = 0; i < part->instance_count; i++) {
            const Transform *t = &part->instance[i];
            size += vec3_length(vec3(t->m[0][1], t->m[1][1], t->m[2][1]));
            assert_true(part->season[i] <= 0.0f && part->season[i] >= -1.0f);
        }
        size /= (float)part->instance_count;
        Aabb box = mesh_bounds(part->mesh);
        assert_true(size > before && box.high.x - box.low.x > width_before);
        before = size;
        width_before = box.high.x - box.low.x;
        geometry_clear(&geometry);
    }
    assert_float_equal(before, 1.0f, 1e-6f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(successive_leaves_are_turned_by_the_arrangement),
        cmocka_unit_test(leaves_are_smaller_toward_the_end),
        cmocka_unit_test(leaves_are_smaller_toward_the_base),
        cmocka_unit_test(leaves_keep_to_the_foot),
        cmocka_unit_test(the_tip_is_this_years),
        cmocka_unit_test(two_rows_lie_left_and_right),
        cmocka_unit_test(hanging_leaves_hang),
        cmocka_unit_test(a_rosette_is_at_the_end),
        cmocka_unit_test(withered_leaves_hang_below_a_rosette),
        cmocka_unit_test(rosettes_are_limited),
        cmocka_unit_test(leaves_lost_to_the_mesh_are_told),
        cmocka_unit_test(short_shoots_bear_clusters),
        cmocka_unit_test(needles_cover_the_twig),
        cmocka_unit_test(leaves_turn_from_the_top),
        cmocka_unit_test(as_many_leaves_are_shed_as_asked_for),
        cmocka_unit_test(young_leaves_are_small_and_folded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
