// Murray's laws: closed forms, a turning by brute force, and what a constraint may and may not do.
#include "base/random.h"
#include "outtree/murray.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

#define DEGREES 57.29577951308232

// A random binary tree of chains, thick toward the root.
static OutTree *make_tree(int64_t nodes, uint64_t seed, MurrayLaw law)
{
    OutTree *tree = out_tree_new(NULL);
    int *children = calloc((size_t)nodes, sizeof *children);
    assert_non_null(tree);
    assert_non_null(children);
    assert_int_equal(out_tree_add_node(tree, vec3(0, 0, 0), -1, 0, 0, seed, NULL), 0);
    for (int64_t i = 1; i < nodes; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        int64_t parent = i - 1;
        if (random_unit(random_key(key, 1)) < 0.3f) {
            parent = (int64_t)(random_unit(random_key(key, 2)) * (float)i);
        }
        while (children[parent] >= 2) {
            parent = (parent + 1) % i;
        }
        children[parent]++;
        Vec3 step = vec3_scale(random_direction(random_key(key, 3)),
                               random_range(random_key(key, 4), 0.05f, 0.15f));
        assert_int_equal(out_tree_add_node(tree, vec3_add(tree->position[parent], step), parent, 0,
                                           0, key, NULL),
                         i);
    }
    free(children);
    out_tree_murray_radii(tree, law, 1e-3f);
    return tree;
}

static double angle_between(Vec3 a, Vec3 b)
{
    double dot = (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
    double aa = (double)a.x * (double)a.x + (double)a.y * (double)a.y + (double)a.z * (double)a.z;
    double bb = (double)b.x * (double)b.x + (double)b.y * (double)b.y + (double)b.z * (double)b.z;
    return DEGREES * acos(fmax(-1.0, fmin(1.0, dot / sqrt(aa * bb))));
}

// The children of a fork; how many there are in all.
static int children_of(const OutTree *tree, int64_t node, int64_t child[2])
{
    int count = 0;
    for (int64_t i = node + 1; i < tree->count; i++) {
        if (tree->parent[i] == node) {
            if (count < 2) {
                child[count] = i;
            }
            count++;
        }
    }
    return count;
}

// Error of the angle between the daughters, by eq. (15) as printed, degrees.
static double fork_error(const OutTree *tree, int64_t node, const int64_t child[2])
{
    double r0 = (double)tree->radius[node], r1 = (double)tree->radius[child[0]],
           r2 = (double)tree->radius[child[1]];
    double cosine = (pow(r0, 4) - pow(r1, 4) - pow(r2, 4)) / (2 * r1 * r1 * r2 * r2);
    Vec3 a = vec3_sub(tree->position[child[0]], tree->position[node]);
    Vec3 b = vec3_sub(tree->position[child[1]], tree->position[node]);
    return fabs(angle_between(a, b) - DEGREES * acos(cosine));
}

static void flow_is_conserved_at_every_fork(void **state)
{
    (void)state;
    const MurrayLaw laws[3] = {{3.0f}, {2.3f}, {0.0f}};
    for (int l = 0; l < 3; l++) {
        OutTree *tree = make_tree(3000, 5, laws[l]);
        MurrayFit fit;
        assert_true(out_tree_murray_fit(tree, laws[l], &fit, NULL));
        assert_true(fit.forks > 200);
        assert_true(fit.residual < 2e-6); // radii are single precision
        for (int64_t i = 0; i < tree->count && laws[l].exponent > 0.0f; i++) {
            int64_t child[2];
            if (children_of(tree, i, child) == 2) {
                double e = (double)laws[l].exponent;
                double sum =
                    pow((double)tree->radius[child[0]], e) + pow((double)tree->radius[child[1]], e);
                assert_true(fabs(pow((double)tree->radius[i], e) / sum - 1.0) < 2e-6);
            }
        }
        tree->radius[7] *= 1.1f;
        assert_true(out_tree_murray_fit(tree, laws[l], &fit, NULL));
        assert_true(fit.residual > 0.1);
        out_tree_free(tree);
    }
}

static void the_law_by_size_has_its_three_exponents(void **state)
{
    (void)state;
    MurrayLaw law = {0.0f};
    const double radius[3] = {5e-5, 5e-4, 5e-3}, exponent[3] = {3.0, 2.7, 2.3};
    for (int i = 0; i < 3; i++) {
        double slope =
            log(murray_flow(law, radius[i] * 1.01) / murray_flow(law, radius[i])) / log(1.01);
        assert_true(fabs(slope - exponent[i]) < 1e-9);
        assert_true(fabs(murray_radius(law, murray_flow(law, radius[i])) / radius[i] - 1) < 1e-12);
    }
    // no jump where the exponent changes
    assert_true(fabs(murray_flow(law, 1e-3 * (1 + 1e-9)) / murray_flow(law, 1e-3) - 1) < 1e-8);
    assert_true(fabs(murray_flow(law, 1e-4 * (1 + 1e-9)) / murray_flow(law, 1e-4) - 1) < 1e-8);
    OutTree *tree = make_tree(500, 9, law);
    int64_t tips = 0, child[2];
    for (int64_t i = 0; i < tree->count; i++) {
        tips += children_of(tree, i, child) == 0;
    }
    out_tree_murray_radii(tree, law, murray_tip_radius(law, 0.004f, tips));
    assert_true(fabs((double)tree->radius[0] / 0.004 - 1.0) < 1e-6);
    out_tree_free(tree);
}

static void angles_balance_the_pulls(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        double r1 = 0.2 + (double)random_unit(random_key(1, (uint64_t)i));
        double r2 = 0.2 + (double)random_unit(random_key(2, (uint64_t)i));
        double e = 2.1 + 2.0 * (double)random_unit(random_key(3, (uint64_t)i));
        double r0 = pow(pow(r1, e) + pow(r2, e), 1.0 / e);
        MurrayAngles angles = murray_angles(r0, r1, r2);
        double a = acos(angles.cosine1), b = acos(angles.cosine2);
        // Murray's condition of least work: the pulls r^2 of three vessels balance.
        assert_true(fabs(r1 * r1 * cos(a) + r2 * r2 * cos(b) - r0 * r0) < 1e-9);
        assert_true(fabs(r1 * r1 * sin(a) - r2 * r2 * sin(b)) < 1e-6);
        assert_true(fabs(cos(a + b) - angles.cosine_between) < 1e-6);
    }
    double half = acos(murray_angles(pow(2.0, 1.0 / 3.0), 1, 1).cosine1) * DEGREES;
    assert_true(fabs(half - 37.4675) < 1e-3); // Murray 1926: 75 degrees between equal daughters
}

// Turns fork by fork, every descendant by itself.
static void turn_slowly(OutTree *tree)
{
    for (int64_t fork = 1; fork < tree->count; fork++) {
        int64_t child[2];
        if (children_of(tree, fork, child) != 2) {
            continue;
        }
        Vec3 p = tree->position[fork], d[2];
        Vec3 mother = vec3_normalize(vec3_sub(p, tree->position[tree->parent[fork]]));
        for (int k = 0; k < 2; k++) {
            d[k] = vec3_normalize(vec3_sub(tree->position[child[k]], p));
        }
        Vec3 side = vec3_sub(d[0], d[1]);
        side = vec3_normalize(vec3_madd(side, -vec3_dot(side, mother), mother));
        MurrayAngles law = murray_angles((double)tree->radius[fork], (double)tree->radius[child[0]],
                                         (double)tree->radius[child[1]]);
        const double cosine[2] = {law.cosine1, law.cosine2};
        for (int k = 0; k < 2; k++) {
            double angle = acos(cosine[k]);
            Vec3 to = vec3_madd(vec3_scale(mother, (float)cosine[k]),
                                (float)(k == 0 ? sin(angle) : -sin(angle)), side);
            Vec3 axis = vec3_normalize(vec3_cross(d[k], to));
            float turn = (float)(angle_between(d[k], to) / DEGREES);
            for (int64_t i = child[k]; i < tree->count; i++) {
                int64_t at = i;
                while (at > child[k]) {
                    at = tree->parent[at];
                }
                if (at == child[k]) {
                    Vec3 from = vec3_sub(tree->position[i], p);
                    tree->position[i] =
                        vec3_add(p, vec3_rotate(from, axis, cosf(turn), sinf(turn)));
                }
            }
        }
    }
}

static void turning_agrees_with_brute_force(void **state)
{
    (void)state;
    OutTree *tree = make_tree(400, 3, (MurrayLaw){2.7f}), *slow = out_tree_copy(tree, NULL);
    // Only where the root does not fork are both defined alike.
    MurrayReport report;
    assert_true(out_tree_murray_turn(tree, NULL, NULL, NULL, &report, NULL));
    assert_true(report.forks > 30 && report.exact == report.forks);
    turn_slowly(slow);
    int64_t child[2];
    if (children_of(tree, 0, child) == 1) {
        for (int64_t i = 0; i < tree->count; i++) {
            assert_true(vec3_distance(tree->position[i], slow->position[i]) < 2e-3f);
        }
    } else {
        fail_msg("the test's tree must not fork at its root");
    }
    out_tree_free(tree);
    out_tree_free(slow);
}

static void free_forks_stand_at_the_laws_angle_and_stay_rigid(void **state)
{
    (void)state;
    OutTree *tree = make_tree(4000, 4, (MurrayLaw){3.0f}), *old = out_tree_copy(tree, NULL);
    assert_true(out_tree_murray_turn(tree, NULL, NULL, NULL, NULL, NULL));
    int64_t forks = 0, child[2], below[2];
    for (int64_t i = 0; i < tree->count; i++) {
        int count = children_of(tree, i, child);
        if (count == 2) {
            forks++;
            assert_true(fork_error(tree, i, child) < 0.01);
        }
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            double length = (double)vec3_distance(old->position[i], old->position[parent]);
            double now = (double)vec3_distance(tree->position[i], tree->position[parent]);
            assert_true(fabs(now - length) < 1e-5);
        }
        // where nothing forks, the bend stays as it was
        if (count == 1 && children_of(tree, child[0], below) == 1) {
            double length = (double)vec3_distance(old->position[i], old->position[below[0]]);
            double now = (double)vec3_distance(tree->position[i], tree->position[below[0]]);
            assert_true(fabs(now - length) < 1e-5);
        }
    }
    assert_true(forks > 300);
    MurrayFit fit;
    assert_true(out_tree_murray_fit(tree, (MurrayLaw){3.0f}, &fit, NULL));
    assert_int_equal(fit.forks, forks);
    assert_true(fit.angle_exact == 1.0 && fit.angle_median < 0.1);
    assert_true(out_tree_murray_fit(old, (MurrayLaw){3.0f}, &fit, NULL));
    assert_true(fit.angle_exact < 0.1); // as it grew, it does not keep the law
    out_tree_free(tree);
    out_tree_free(old);
}

typedef struct Ball {
    float radius;
    int64_t asked;
} Ball;

static bool stays_in_ball(void *user, int64_t node, Vec3 from, Vec3 to)
{
    Ball *ball = user;
    (void)node;
    ball->asked++;
    return vec3_length(from) <= ball->radius && vec3_length(to) <= ball->radius;
}

static void constrained_turns_keep_within_and_say_where_they_bound(void **state)
{
    (void)state;
    OutTree *tree = make_tree(4000, 6, (MurrayLaw){2.7f});
    Ball ball = {0.0f, 0};
    for (int64_t i = 0; i < tree->count; i++) {
        ball.radius = fmaxf(ball.radius, vec3_length(tree->position[i]));
    }
    ball.radius *= 1.0001f;
    uint8_t *bound = calloc((size_t)tree->count, 1);
    assert_non_null(bound);
    MurrayReport report;
    assert_true(out_tree_murray_turn(tree, stays_in_ball, &ball, bound, &report, NULL));
    assert_true(report.reduced > 0 && report.exact > report.reduced);
    int64_t flagged = 0, child[2];
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(vec3_length(tree->position[i]) <= ball.radius);
        flagged += bound[i];
        if (!bound[i] && children_of(tree, i, child) == 2) {
            assert_true(fork_error(tree, i, child) < 0.5);
        }
    }
    assert_int_equal(flagged, report.reduced);
    free(bound);
    out_tree_free(tree);
}

// What may be bent: the ball, and all nodes but one.
typedef struct Bounds {
    const OutTree *tree;
    Ball ball;
    int64_t fixed; // -1 = none
} Bounds;

static bool stays_in_bounds(void *user, int64_t node, Vec3 from, Vec3 to)
{
    Bounds *bounds = user;
    return stays_in_ball(&bounds->ball, node, from, to) &&
           (node != bounds->fixed || vec3_distance(bounds->tree->position[node], to) == 0.0f);
}

// A tree in the smallest ball about it, its forks turned as far as that allows.
static OutTree *turned_in_bounds(Bounds *bounds, MurrayReport *report)
{
    OutTree *tree = make_tree(4000, 6, (MurrayLaw){2.7f});
    *bounds = (Bounds){tree, {0.0f, 0}, -1};
    for (int64_t i = 0; i < tree->count; i++) {
        bounds->ball.radius = fmaxf(bounds->ball.radius, vec3_length(tree->position[i]));
    }
    bounds->ball.radius *= 1.0001f;
    assert_true(out_tree_murray_turn(tree, stays_in_bounds, bounds, NULL, report, NULL));
    return tree;
}

static void bends_make_the_constrained_forks_exact(void **state)
{
    (void)state;
    Bounds bounds;
    MurrayReport report;
    OutTree *tree = turned_in_bounds(&bounds, &report), *old = out_tree_copy(tree, NULL);
    assert_true(report.reduced > 20);
    assert_true(out_tree_murray_bend(tree, stays_in_bounds, &bounds, NULL));
    int64_t child[2], forks = 0, inexact = 0;
    double lengths = 0.0, moved = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(vec3_length(tree->position[i]) <= bounds.ball.radius);
        moved += (double)vec3_distance(tree->position[i], old->position[i]);
        if (tree->parent[i] >= 0) {
            double length = (double)vec3_distance(old->position[i], old->position[tree->parent[i]]);
            double now = (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            assert_true(now > 0.01 * length);
            lengths += length;
        }
        if (tree->parent[i] >= 0 && children_of(tree, i, child) == 2) {
            forks++;
            inexact += fork_error(tree, i, child) > 0.5;
        }
    }
    assert_true(forks > 300 && inexact * 100 <= forks); // turning alone leaves report.reduced
    assert_true(moved < 2.0 * lengths);                 // nodes stay near where they were
    out_tree_free(tree);
    out_tree_free(old);
}

// A daughter that must stay: the other one takes the whole angle between them.
static void bends_leave_what_must_stay(void **state)
{
    (void)state;
    static const int parent[6] = {-1, 0, 1, 1, 2, 3};
    static const Vec3 place[6] = {{0, 0, 0},        {0, 1, 0},    {0.1f, 2, 0},
                                  {-0.1f, 2, 0.1f}, {0.2f, 3, 0}, {-0.2f, 3, 0.2f}};
    for (int64_t fixed = 2; fixed <= 3; fixed++) {
        OutTree *tree = out_tree_new(NULL);
        for (int i = 0; i < 6; i++) {
            assert_int_equal(out_tree_add_node(tree, place[i], parent[i], 0, 0, (uint64_t)i, NULL),
                             i);
        }
        out_tree_murray_radii(tree, (MurrayLaw){3.0f}, 0.01f);
        Bounds bounds = {tree, {10.0f, 0}, fixed};
        assert_true(out_tree_murray_bend(tree, stays_in_bounds, &bounds, NULL));
        const int64_t child[2] = {2, 3};
        assert_true(vec3_distance(tree->position[fixed], place[fixed]) == 0.0f);
        assert_true(fork_error(tree, 1, child) < 0.05);
        out_tree_free(tree);
    }
}

static void nodes_with_three_children_are_left(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    static const int parent[7] = {-1, 0, 1, 1, 1, 3, 3};
    for (int i = 0; i < 7; i++) {
        Vec3 p = vec3(0.3f * (float)(i % 3), (float)i, 0.1f * (float)(i * i));
        assert_int_equal(out_tree_add_node(tree, p, parent[i], 0, 0, (uint64_t)i, NULL), i);
    }
    out_tree_murray_radii(tree, (MurrayLaw){3.0f}, 0.01f);
    OutTree *old = out_tree_copy(tree, NULL);
    MurrayReport report;
    assert_true(out_tree_murray_turn(tree, NULL, NULL, NULL, &report, NULL));
    assert_true(report.multiple == 1 && report.forks == 1);
    for (int i = 0; i < 5; i++) {
        assert_true(vec3_distance(tree->position[i], old->position[i]) < 1e-6f);
    }
    const int64_t child[2] = {5, 6};
    assert_true(fork_error(tree, 3, child) < 0.01);
    out_tree_free(tree);
    out_tree_free(old);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flow_is_conserved_at_every_fork),
        cmocka_unit_test(the_law_by_size_has_its_three_exponents),
        cmocka_unit_test(angles_balance_the_pulls),
        cmocka_unit_test(turning_agrees_with_brute_force),
        cmocka_unit_test(free_forks_stand_at_the_laws_angle_and_stay_rigid),
        cmocka_unit_test(constrained_turns_keep_within_and_say_where_they_bound),
        cmocka_unit_test(bends_make_the_constrained_forks_exact),
        cmocka_unit_test(bends_leave_what_must_stay),
        cmocka_unit_test(nodes_with_three_children_are_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
