// Control over growth: films of it, edits that stay local, envelopes that move, ten times the size.
#include "grow/colonize.h"
#include "making.h"
#include "objects/tree/tree.h"
#include "testing.h"

#include "base/random.h"

#include <math.h>
#include <string.h>

static GrowLevel small_levels[] = {{30, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f},
                                   {300, 0.20f, 0.7f, 2.5f, 0.90f, 0.3f, 0.0f, 0.5f},
                                   {3000, 0.30f, 0.9f, 2.2f, 1.00f, 0.3f, 0.0f, 0.5f}};

static TreeParams small_tree(void)
{
    TreeParams params = tree_params_default();
    params.height = 14.0f;
    params.crown.element.levels = small_levels;
    params.crown.element.level_count = 3;
    params.crown.lobes = 0; // saves a level set each time
    return params;
}

static OutTree *grow(const TreeParams *params, float grow_to, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *tree = grow_kind(&kind_tree, params, &(Recipe){.seed = 4, .label = "oak", .run = &run},
                              grow_to, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static bool same_place(Vec3 a, Vec3 b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static int64_t find_id(const OutTree *tree, uint64_t id)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->id[i] == id) {
            return i;
        }
    }
    return -1;
}

// ---- growth as a film ----

static void earlier_growth_is_part_of_later_growth(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *later = grow(&params, 1.0f, 1);
    for (int k = 3; k >= 0; k--) {
        OutTree *tree = grow(&params, 0.27f * (float)k, 2);
        assert_true(out_tree_check(tree, NULL));
        assert_true(tree->count < later->count && tree->count > 1);
        for (int64_t i = 0; i < tree->count; i++) {
            int64_t j = find_id(later, tree->id[i]);
            assert_true(j >= 0 && same_place(tree->position[i], later->position[j]));
            assert_true(tree->radius[i] > 0.0f && tree->radius[i] <= later->radius[j]);
            int32_t parent = tree->parent[i];
            assert_true(parent < 0 || tree->birth[parent] <= tree->birth[i]);
            if (parent >= 0 && later->radius[later->parent[j]] >= later->radius[j]) {
                assert_true(tree->radius[parent] >= 0.9999f * tree->radius[i]);
            }
        }
        out_tree_free(later);
        later = tree;
    }
    out_tree_free(later);
}

static void the_trunk_comes_first_and_roots_come_along(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *early = grow(&params, 0.15f, 1), *half = grow(&params, 0.5f, 1);
    int64_t early_count[3] = {0}, half_count[3] = {0};
    for (int64_t i = 0; i < early->count; i++) {
        early_count[early->colony[i]]++;
    }
    for (int64_t i = 0; i < half->count; i++) {
        half_count[half->colony[i]]++;
    }
    assert_true(early_count[0] > 5 && early_count[1] == 0 && early_count[2] > 0);
    assert_true(half_count[1] > 10 && half_count[2] > early_count[2]);
    out_tree_free(early);
    out_tree_free(half);
}

// ---- local edits ----

static OutTree *grow_toward(const PointSet *attractors, int threads)
{
    OutTree *tree = out_tree_new(NULL);
    int64_t last = -1;
    for (int i = 0; i < 11; i++) { // a bar from which both sides grow
        last = out_tree_add_node(tree, vec3(0.2f * (float)(i - 5), 0, 0), last, 0, 0,
                                 random_key(5, (uint64_t)i), NULL);
    }
    ColonizeParams params = colonize_params_default();
    params.step = 0.03f, params.kill = 0.06f, params.influence = 0.3f;
    params.noise = 0.3f, params.max_children = 3;
    Run run = run_default();
    run.threads = threads;
    assert_true(colonize(tree, attractors, &params, &run, NULL, NULL));
    return tree;
}

static void add_cloud(PointSet *points, float x, int count, uint64_t seed)
{
    for (int i = 0; i < count; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        Vec3 p = vec3(x + random_range(random_key(key, 1), -0.5f, 0.5f),
                      random_range(random_key(key, 2), -0.5f, 0.5f),
                      random_range(random_key(key, 3), -0.5f, 0.5f));
        assert_true(points_add(points, p, vec3(0, 1, 0), key, NULL));
    }
}

static void more_attractors_on_one_side_leave_the_other_side_alone(void **state)
{
    (void)state;
    PointSet *few = points_new(NULL), *more = points_new(NULL);
    add_cloud(few, 1.5f, 400, 1);
    add_cloud(few, -1.5f, 2000, 2);
    add_cloud(more, 1.5f, 400, 1);
    add_cloud(more, 1.7f, 1500, 3); // first in the list, so that every later index shifts
    add_cloud(more, -1.5f, 2000, 2);
    OutTree *before = grow_toward(few, 1), *after = grow_toward(more, 2);
    int64_t left = 0, right = 0;
    for (int64_t i = 0; i < before->count; i++) {
        int64_t j = find_id(after, before->id[i]);
        if (before->position[i].x < 0.0f) {
            left++;
            assert_true(j >= 0 && same_place(before->position[i], after->position[j]));
            assert_int_equal(before->birth[i], after->birth[j]);
        } else {
            right += j < 0 || !same_place(before->position[i], after->position[j]);
        }
    }
    assert_true(left > 500 && right > 0);
    points_free(few);
    points_free(more);
    out_tree_free(before);
    out_tree_free(after);
}

static PointSet *scatter(const Shape *shapes, int count, ScatterPlace place, float shell,
                         int threads)
{
    Run run = run_default();
    run.threads = threads;
    EnvelopeParams envelope_params = {.shapes = shapes, .shape_count = count, .voxel = 0.03f};
    Envelope *envelope = envelope_new(&envelope_params, &run, NULL);
    ScatterParams params = scatter_params_default();
    params.place = place;
    params.count = 4000;
    params.shell = shell;
    params.anchored = true;
    params.anchor = vec3(0.1f, -3.0f, 0.2f);
    Error e = {0};
    PointSet *points = points_scatter(envelope, &params, &run, &e);
    if (!points) {
        fail_msg("%s", e.message);
    }
    envelope_free(envelope);
    return points;
}

static Shape ball(Vec3 center, float radius)
{
    return (Shape){.kind = SHAPE_SPHERE,
                   .op = SHAPE_UNION,
                   .size = vec3_splat(radius),
                   .transform = transform_compose(center, vec3_splat(0), vec3_splat(1))};
}

// Of the points of a with x below limit, how many b has at the very same place.
static double share_of_same(const PointSet *a, const PointSet *b, float limit)
{
    int64_t all = 0, same = 0;
    for (int64_t i = 0; i < a->count; i++) {
        if (a->position[i].x >= limit) {
            continue;
        }
        all++;
        for (int64_t j = 0; j < b->count; j++) {
            if (a->id[i] == b->id[j] && same_place(a->position[i], b->position[j])) {
                same++;
                break;
            }
        }
    }
    return (double)same / (double)all;
}

static void anchored_points_fill_the_region_evenly(void **state)
{
    (void)state;
    Shape shape = ball(vec3(0.3f, 0.2f, -0.4f), 1.0f);
    PointSet *points = scatter(&shape, 1, SCATTER_VOLUME, 0.0f, 1);
    PointSet *again = scatter(&shape, 1, SCATTER_VOLUME, 0.0f, 3);
    assert_int_equal(points->count, again->count);
    assert_memory_equal(points->position, again->position, sizeof(Vec3) * (size_t)points->count);
    // the asked number within a quarter octave of spacing and its own scatter
    assert_true(points->count > 4000 / 1.4 && points->count < 4000 * 1.4);
    double volume = 4.0 / 3.0 * 3.14159265 * 1.0;
    double spacing = points_spacing(points);
    assert_true(fabs((double)points->count * spacing * spacing * spacing / volume - 1.0) < 0.05);
    // as many in each octant as in any other
    int64_t octant[8] = {0};
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = vec3_sub(points->position[i], vec3(0.3f, 0.2f, -0.4f));
        assert_true(vec3_length(p) <= 1.0001f);
        octant[(p.x > 0) | (p.y > 0) << 1 | (p.z > 0) << 2]++;
    }
    double mean = (double)points->count / 8.0;
    for (int i = 0; i < 8; i++) {
        assert_true(fabs((double)octant[i] - mean) < 5.0 * sqrt(mean));
    }
    points_free(points);
    points_free(again);
    points = scatter(&shape, 1, SCATTER_SURFACE, 0.0f, 2);
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = vec3_sub(points->position[i], vec3(0.3f, 0.2f, -0.4f));
        assert_true(fabsf(vec3_length(p) - 1.0f) < 2e-3f);
        assert_true(vec3_dot(vec3_normalize(p), points->normal[i]) > 0.999f);
    }
    spacing = points_spacing(points);
    assert_true(fabs((double)points->count * spacing * spacing / (4.0 * 3.14159265) - 1.0) < 0.06);
    points_free(points);
}

static void anchored_points_stay_when_the_envelope_changes(void **state)
{
    (void)state;
    Shape one = ball(vec3(0, 0, 0), 1.0f), moved = ball(vec3(0.01f, 0.005f, 0), 1.0f);
    for (int place = 0; place < 2; place++) {
        PointSet *before = scatter(&one, 1, (ScatterPlace)place, 0.0f, 1);
        PointSet *after = scatter(&moved, 1, (ScatterPlace)place, 0.0f, 1);
        if (place == SCATTER_VOLUME) {
            assert_true(share_of_same(before, after, 10.0f) > 0.97);
        } else { // these move with the surface; their names stay
            int64_t same = 0;
            for (int64_t i = 0; i < before->count; i++) {
                for (int64_t j = 0; j < after->count; j++) {
                    same += before->id[i] == after->id[j] &&
                            vec3_distance(before->position[i], after->position[j]) < 0.02f;
                }
            }
            assert_true((double)same > 0.75 * (double)before->count);
        }
        points_free(before);
        points_free(after);
    }
    // a bulge on the right: the left keeps every point
    Shape body[2] = {ball(vec3(0, 0, 0), 1.0f), ball(vec3(0.8f, 0, 0), 0.4f)};
    Shape edited[2] = {body[0], ball(vec3(0.85f, 0, 0), 0.45f)};
    PointSet *before = scatter(body, 2, SCATTER_VOLUME, 0.0f, 1);
    PointSet *after = scatter(edited, 2, SCATTER_VOLUME, 0.0f, 2);
    assert_true(share_of_same(before, after, 0.0f) == 1.0);
    assert_true(share_of_same(after, before, 0.0f) == 1.0);
    assert_true(share_of_same(after, before, 10.0f) < 1.0);
    points_free(before);
    points_free(after);
}

// ---- an envelope that moves ----

// Share of a's nodes that have one of b's within a step of it.
static double share_near(const OutTree *a, const OutTree *b, float step)
{
    int64_t near = 0;
    for (int64_t i = 0; i < a->count; i++) {
        float best = INFINITY;
        for (int64_t j = 0; j < b->count; j++) {
            best = fminf(best, vec3_distance(a->position[i], b->position[j]));
        }
        near += best < step;
    }
    return (double)near / (double)a->count;
}

// A crown that sways by 5 mm, which is 12 cm/s at 24 pictures a second.
static void a_crown_that_moves_a_little_keeps_its_branches(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    Shape crown = {.kind = SHAPE_ELLIPSOID, .size = vec3(7, 5.6f, 7)};
    params.crown.element.shapes = &crown;
    params.crown.element.shape_count = 1;
    params.crown.element.points.anchored = true;
    crown.transform = transform_compose(vec3(0, 8.4f, 0), vec3_splat(0), vec3_splat(1));
    OutTree *before = grow(&params, 1.0f, 1);
    crown.transform = transform_compose(vec3(0.005f, 8.4f, 0), vec3_splat(0), vec3_splat(1));
    OutTree *after = grow(&params, 1.0f, 1);
    float step = 0.2f; // the finest level's, after relaxing
    double share = share_near(before, after, step), back = share_near(after, before, step);
    if (share < 0.9 || back < 0.9) {
        fail_msg("%.3f and %.3f of the nodes stayed", share, back);
    }
    out_tree_free(before);
    out_tree_free(after);
}

// ---- size ----

// Eight times is exact in floating point: every node stands at eight times its place.
static void growth_knows_no_absolute_size(void **state)
{
    (void)state;
    TreeParams small = small_tree(), large = small;
    small.trunk.radius = 0.4f;
    large.trunk.radius = 8.0f * small.trunk.radius; // else by elastic similarity
    large.height = 8.0f * small.height;
    OutTree *a = grow(&small, 1.0f, 1), *b = grow(&large, 1.0f, 1);
    assert_int_equal(a->count, b->count);
    for (int64_t i = 0; i < a->count; i++) {
        assert_int_equal(a->parent[i], b->parent[i]);
        Vec3 wanted = vec3_scale(a->position[i], 8.0f);
        assert_true(vec3_distance(wanted, b->position[i]) < 1e-4f * large.height);
    }
    out_tree_free(a);
    out_tree_free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(earlier_growth_is_part_of_later_growth),
        cmocka_unit_test(the_trunk_comes_first_and_roots_come_along),
        cmocka_unit_test(more_attractors_on_one_side_leave_the_other_side_alone),
        cmocka_unit_test(anchored_points_fill_the_region_evenly),
        cmocka_unit_test(anchored_points_stay_when_the_envelope_changes),
        cmocka_unit_test(a_crown_that_moves_a_little_keeps_its_branches),
        cmocka_unit_test(growth_knows_no_absolute_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
