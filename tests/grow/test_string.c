// Growth along the directions of an L-system string, against the rule done by brute force.
#include "grow/growth_fixture.h"

#include "base/exact_math.h"

#include <math.h>

static GrowString string_of(const char *axiom, const char *rules, int generations, float degrees)
{
    Run run = run_default();
    Error e = {0};
    ModuleString modules;
    GrowString string;
    LSystemParams params = {.axiom = axiom, .rules = rules, .generations = generations, .seed = 2};
    if (!lsystem_derive(&params, &run, &modules, &e) ||
        !grow_string_init(&string, &modules, degrees, &e)) {
        fail_msg("%s", e.message);
    }
    module_string_clear(&modules);
    return string;
}

static ColonizeParams string_params(const GrowString *string)
{
    ColonizeParams params = colonize_params_default();
    params.rule = GROW_STRING;
    params.string = string;
    params.step = 0.15f;
    params.kill = 0.1f;
    params.influence = 0.6f;
    params.length_near = 0.2f;
    params.length_far = 0.1f;
    params.sector_angle = 70.0f;
    params.regularity = 0.4f;
    return params;
}

static void a_string_becomes_a_tree_of_directions(void **state)
{
    (void)state;
    GrowString string = string_of("X", "X -> [+FX][-FX]FX", 3, 30.0f);
    assert_int_equal(string.count, 1 + 3 + 9 + 27);
    assert_int_equal(string.most_followers, 3);
    for (int64_t i = 0; i < string.count; i++) {
        const GrowDirection *d = &string.direction[i];
        assert_int_equal(d->followers, i < 13 ? 3 : 0);
        const float side[3] = {0.5f, -0.5f, 0.0f};
        for (int k = 0; k < d->followers; k++) {
            const GrowDirection *next = &string.direction[d->first + k];
            assert_int_equal(next->parent, i);
            assert_float_equal(next->heading.z, side[k], 1e-6f);
            assert_float_equal(next->heading.y, 0.0f, 1e-6f);
            assert_float_equal(next->normal.y, 1.0f, 1e-6f);
        }
    }
    grow_string_clear(&string);
}

static void strings_that_cannot_grow_are_refused(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"+X", "the string has no F, so that nothing can grow"},
        {"FfF", "symbol 2 of the string, 'f', jumps; a branch can only grow (F)"},
        {"F(0)", "symbol 1 of the string is F(0); a branch's length must be above 0"},
    };
    for (int i = 0; i < 3; i++) {
        ModuleString modules;
        GrowString string;
        Error e = {0};
        LSystemParams written = {.axiom = cases[i][0], .rules = ""};
        Run run = run_default();
        assert_true(lsystem_derive(&written, &run, &modules, &e));
        assert_false(grow_string_init(&string, &modules, 30.0f, &e));
        assert_string_equal(e.message, cases[i][1]);
        module_string_clear(&modules);
    }
}

// ---- the rule by brute force, in double ----

enum { MOST = 4000 };

typedef struct Brute {
    Vec3 position[MOST], normal[MOST];
    int parent[MOST], place[MOST];
    bool had_turn[MOST];
    int count;
} Brute;

static Vec3 across(Vec3 v, Vec3 n)
{
    v = vec3_madd(v, -vec3_dot(v, n), n);
    return vec3_dot(v, v) > 1e-6f ? vec3_normalize(v) : vec3_perpendicular(n);
}

static int nearest_node(const Brute *b, Vec3 p, float reach)
{
    float best = reach * reach;
    int found = -1;
    for (int i = 0; i < b->count; i++) {
        Vec3 d = vec3_sub(p, b->position[i]);
        float d2 = vec3_dot(d, d);
        if (d2 < best) {
            best = d2;
            found = i;
        }
    }
    return found;
}

// Steps a to d for one node; adds its children.
static void brute_node(Brute *b, int node, const int *owner, const PointSet *points,
                       const bool *alive, const ColonizeParams *p, double furthest)
{
    const GrowDirection *at = &p->string->direction[b->place[node]];
    Vec3 heading = b->parent[node] >= 0
                       ? vec3_normalize(vec3_sub(b->position[node], b->position[b->parent[node]]))
                       : b->normal[node];
    Vec3 normal = across(b->normal[node], heading), side = vec3_cross(normal, heading);
    double half = cos((double)p->sector_angle * 0.5 * (double)RADIANS_PER_DEGREE);
    for (int k = 0; k < at->followers; k++) {
        double sum[3] = {0}, length = 0.0;
        int count = 0;
        const GrowDirection *mine = &p->string->direction[at->first + k];
        for (int64_t a = 0; a < points->count; a++) {
            if (!alive[a] || owner[a] != node) {
                continue;
            }
            Vec3 unit = vec3_normalize(vec3_sub(points->position[a], b->position[node]));
            Vec3 local =
                vec3(vec3_dot(unit, heading), vec3_dot(unit, normal), vec3_dot(unit, side));
            int best = -1;
            double cosine = half;
            for (int j = 0; j < at->followers; j++) {
                double c = (double)vec3_dot(local, p->string->direction[at->first + j].heading);
                best = c > cosine ? j : best;
                cosine = c > cosine ? c : cosine;
            }
            if (best == k) {
                sum[0] += (double)unit.x, sum[1] += (double)unit.y, sum[2] += (double)unit.z;
                double from_root = (double)vec3_distance(points->position[a], b->position[0]);
                length += (double)p->length_near +
                          (double)(p->length_far - p->length_near) * from_root / furthest;
                count++;
            }
        }
        if (count == 0) {
            continue;
        }
        Vec3 mean = vec3_normalize(vec3((float)sum[0], (float)sum[1], (float)sum[2]));
        Vec3 l = mine->heading, n = mine->normal;
        Vec3 axis = vec3_madd(vec3_madd(vec3_scale(heading, l.x), l.y, normal), l.z, side);
        Vec3 up = vec3_madd(vec3_madd(vec3_scale(heading, n.x), n.y, normal), n.z, side);
        Vec3 d = vec3_normalize(vec3_lerp(mean, axis, p->regularity));
        int child = b->count++;
        assert_true(child < MOST);
        b->position[child] =
            vec3_madd(b->position[node], (float)(length / count) * mine->length, d);
        b->normal[child] = across(up, d);
        b->parent[child] = node;
        b->place[child] = at->first + k;
    }
}

static void brute_grow(Brute *b, const PointSet *points, const ColonizeParams *p)
{
    bool alive[2000];
    int owner[2000];
    double furthest = 0.0;
    for (int64_t a = 0; a < points->count; a++) {
        alive[a] = true;
        double d = (double)vec3_distance(points->position[a], b->position[0]);
        furthest = d > furthest ? d : furthest;
    }
    for (int before = -1; before != b->count;) {
        for (int64_t a = 0; a < points->count; a++) {
            alive[a] = alive[a] && nearest_node(b, points->position[a], p->kill) < 0;
            owner[a] = alive[a] ? nearest_node(b, points->position[a], p->influence) : -1;
        }
        before = b->count;
        for (int i = 0; i < before; i++) {
            if (!b->had_turn[i]) {
                int children = b->count;
                brute_node(b, i, owner, points, alive, p, furthest);
                b->had_turn[i] = b->count > children;
            }
        }
    }
}

static void compare_with_brute_force(const PointSet *points, const char *rules, int generations,
                                     Vec3 up)
{
    GrowString string = string_of("X", rules, generations, 32.0f);
    ColonizeParams params = string_params(&string);
    OutTree *tree = tree_from(vec3(0, 0, 0));
    tree->normal[0] = up;
    static Brute brute;
    brute = (Brute){.count = 1, .parent = {-1}, .normal = {up}};
    grow_with(tree, points, &params, 1);
    brute_grow(&brute, points, &params);
    assert_true(brute.count > 60);
    assert_int_equal(tree->count, brute.count);
    for (int i = 0; i < brute.count; i++) {
        assert_int_equal(tree->parent[i], brute.parent[i]);
        assert_true(vec3_distance(tree->position[i], brute.position[i]) < 2e-5f);
    }
    out_tree_free(tree);
    grow_string_clear(&string);
}

static void growth_is_that_of_brute_force_in_space(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(1200, 5);
    compare_with_brute_force(points, "X -> [+FX][-FX]/(90)FX", 9, vec3(0, 1, 0));
    compare_with_brute_force(points, "X -> F[&(40)F(1.5)X]/(137)FX : 1; X -> [+FX]FX : 1", 9,
                             vec3(0.6f, 0, 0.8f));
    points_free(points);
}

// As in the paper: everything stays in the plane, without being told so.
static void growth_in_a_plane_stays_there(void **state)
{
    (void)state;
    PointSet *points = points_on_plane(900, 6);
    GrowString string = string_of("X", "X -> [+FX][-FX]FX", 7, 30.0f);
    ColonizeParams params = string_params(&string);
    params.sector_angle = 60.0f;
    params.regularity = 0.0f;
    OutTree *tree = tree_from(vec3(-1, 0, 0));
    out_tree_add_node(tree, vec3(-0.95f, 0, 0), 0, 0, 0, 78, NULL);
    grow_with(tree, points, &params, 1);
    assert_true(tree->count > 60);
    for (int64_t i = 0; i < tree->count; i++) {
        assert_float_equal(tree->position[i].y, 0.0f, 1e-5f);
        // no turn is wider than the rule's angle and half a group
        if (i > 1 && tree->parent[i] > 0) {
            int32_t p = tree->parent[i];
            Vec3 a = vec3_normalize(vec3_sub(tree->position[i], tree->position[p]));
            Vec3 b = vec3_normalize(vec3_sub(tree->position[p], tree->position[tree->parent[p]]));
            assert_true(vec3_dot(a, b) > 0.4999f);
        }
        assert_true(tree->birth[i] <= 7);
    }
    out_tree_free(tree);
    grow_string_clear(&string);
    points_free(points);
}

static void any_number_of_threads_grows_the_same(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(20000, 9);
    GrowString string = string_of("X", "X -> [+FX][-FX]/(90)FX", 9, 35.0f);
    ColonizeParams params = string_params(&string);
    params.kill = 0.05f;
    params.influence = 0.3f;
    params.length_near = params.length_far = 0.06f;
    params.noise = 0.1f;
    OutTree *first = NULL;
    for (int threads = 1; threads <= 3; threads++) {
        OutTree *tree = tree_from(vec3(0, -0.8f, 0));
        out_tree_add_node(tree, vec3(0.5f, 0.5f, 0), -1, 0, 1, 79, NULL);
        grow_with(tree, points, &params, threads);
        assert_true(tree->count > 1000);
        if (first) {
            assert_same_tree(first, tree);
            out_tree_free(tree);
        } else {
            first = tree;
        }
    }
    out_tree_free(first);
    grow_string_clear(&string);
    points_free(points);
}

// Two colonies share the attractors: each stops where the other was.
static void colonies_keep_apart(void **state)
{
    (void)state;
    PointSet *points = points_on_plane(3000, 3);
    GrowString string = string_of("[FX]+(60)[FX]+(60)[FX]+(60)[FX]+(60)[FX]+(60)[FX]",
                                  "X -> [+FX][-FX]FX", 7, 30.0f);
    ColonizeParams params = string_params(&string);
    params.on_surface = true;
    params.kill = 0.09f;
    params.influence = 0.3f;
    params.length_near = params.length_far = 0.1f;
    OutTree *tree = tree_from(vec3(-0.5f, 0, 0));
    out_tree_add_node(tree, vec3(0.5f, 0, 0), -1, 0, 1, 79, NULL);
    grow_with(tree, points, &params, 1);
    int64_t count[2] = {0};
    for (int64_t i = 0; i < tree->count; i++) {
        count[tree->colony[i]]++;
        // nobody comes far into the other's half
        float own = tree->colony[i] == 0 ? -1.0f : 1.0f;
        assert_true(own * tree->position[i].x > -0.2f);
    }
    assert_true(count[0] > 60 && count[1] > 60);
    out_tree_free(tree);
    grow_string_clear(&string);
    points_free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_string_becomes_a_tree_of_directions),
        cmocka_unit_test(strings_that_cannot_grow_are_refused),
        cmocka_unit_test(growth_is_that_of_brute_force_in_space),
        cmocka_unit_test(growth_in_a_plane_stays_there),
        cmocka_unit_test(any_number_of_threads_grows_the_same),
        cmocka_unit_test(colonies_keep_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
