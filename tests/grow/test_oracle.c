// The engine against growth by brute force: every attractor looks at every node in every step.
#include "grow/growth_fixture.h"

typedef struct Member {
    int64_t sum[3]; // unit pulls in units of 2^-30: exact sums, whatever the order
    int64_t count;
    uint64_t name; // of the set of attractors
} Member;

typedef struct Oracle {
    OutTree *tree;
    const PointSet *points;
    const ColonizeParams *params;
    bool *dead;        // per attractor
    Member *now;       // per node
    uint64_t *grew_by; // per node: name of the set that it last grew by; 0 = has not grown
    bool *dropped;     // per node
    int *children;     // per node
} Oracle;

enum { ROOM = 20000 };

static void find_members(Oracle *o)
{
    memset(o->now, 0, ROOM * sizeof *o->now);
    float influence2 = o->params->influence * o->params->influence;
    float kill2 = o->params->kill * o->params->kill;
    for (int64_t a = 0; a < o->points->count; a++) {
        int64_t nearest = -1;
        float best = influence2;
        for (int64_t n = 0; n < o->tree->count && !o->dead[a]; n++) {
            Vec3 v = vec3_sub(o->points->position[a], o->tree->position[n]);
            if (vec3_dot(v, v) < best) {
                best = vec3_dot(v, v);
                nearest = n;
            }
        }
        if (nearest < 0) {
            continue;
        }
        if (best < kill2) {
            o->dead[a] = true;
            continue;
        }
        Vec3 v = vec3_sub(o->points->position[a], o->tree->position[nearest]);
        Vec3 u = vec3_scale(v, 1.0f / sqrtf(best));
        Member *m = &o->now[nearest];
        m->sum[0] += (int64_t)(u.x * 1073741824.0f);
        m->sum[1] += (int64_t)(u.y * 1073741824.0f);
        m->sum[2] += (int64_t)(u.z * 1073741824.0f);
        m->count++;
        m->name += random_mix((uint64_t)a + 1);
    }
}

static bool propose(const Oracle *o, int64_t node, Vec3 *child)
{
    const ColonizeParams *p = o->params;
    const Member *m = &o->now[node];
    Vec3 sum = vec3_scale(vec3((float)m->sum[0], (float)m->sum[1], (float)m->sum[2]),
                          1.0f / 1073741824.0f);
    Vec3 d = vec3(0, 0, 0);
    if (vec3_length(sum) > 1e-6f * (float)m->count) {
        d = vec3_normalize(sum);
    }
    Vec3 lean = p->tropism;
    if (p->field_weight != 0.0f) {
        lean = vec3_madd(lean, p->field_weight,
                         guide_field_at(p->field, o->tree->position[node], vec3(0, 1, 0)));
    }
    if (p->noise > 0.0f) {
        uint64_t id = out_tree_child_id(o->tree->id[node], o->children[node]);
        uint64_t key = random_key(id, p->seed);
        lean.x += p->noise * random_normal(random_key(key, 0));
        lean.y += p->noise * random_normal(random_key(key, 1));
        lean.z += p->noise * random_normal(random_key(key, 2));
    }
    if (lean.x != 0.0f || lean.y != 0.0f || lean.z != 0.0f) {
        d = vec3_normalize(vec3_add(d, lean));
    }
    *child = vec3_madd(o->tree->position[node], p->step, d);
    return d.x != 0.0f || d.y != 0.0f || d.z != 0.0f;
}

static bool oracle_step(Oracle *o, int32_t birth)
{
    find_members(o);
    int64_t count = o->tree->count;
    for (int64_t n = 0; n < count; n++) {
        const Member *m = &o->now[n];
        if (m->count > 0 && m->name == o->grew_by[n]) {
            o->dropped[n] = true;
        }
        Vec3 child;
        bool full = o->params->max_children > 0 && o->children[n] >= o->params->max_children;
        if (m->count == 0 || o->dropped[n] || full || !propose(o, n, &child)) {
            continue;
        }
        uint64_t id = out_tree_child_id(o->tree->id[n], o->children[n]++);
        o->grew_by[n] = m->name;
        assert_true(o->tree->count < ROOM);
        out_tree_add_node(o->tree, child, n, birth, o->tree->colony[n], id, NULL);
    }
    return o->tree->count > count;
}

static void oracle_grow(OutTree *tree, const PointSet *points, const ColonizeParams *params)
{
    Oracle o = {.tree = tree, .points = points, .params = params};
    o.dead = calloc((size_t)points->count, sizeof *o.dead);
    o.now = calloc(ROOM, sizeof *o.now);
    o.grew_by = calloc(ROOM, sizeof *o.grew_by);
    o.dropped = calloc(ROOM, sizeof *o.dropped);
    o.children = calloc(ROOM, sizeof *o.children);
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            o.children[tree->parent[i]]++;
        }
    }
    for (int32_t birth = 1; oracle_step(&o, birth); birth++) {
    }
    free(o.dead);
    free(o.now);
    free(o.grew_by);
    free(o.dropped);
    free(o.children);
}

static void compare(const PointSet *points, const ColonizeParams *params, const OutTree *start)
{
    OutTree *fast = out_tree_copy(start, NULL), *slow = out_tree_copy(start, NULL);
    assert_non_null(fast);
    assert_non_null(slow);
    grow_with(fast, points, params, 2);
    oracle_grow(slow, points, params);
    assert_true(fast->count > start->count + 20);
    assert_same_tree(fast, slow);
    out_tree_free(fast);
    out_tree_free(slow);
}

static void plain_growth_equals_brute_force(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        PointSet *points = points_in_ball(2000, seed);
        OutTree *start = tree_from(vec3(0, -1, 0));
        ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
        compare(points, &params, start);
        out_tree_free(start);
        points_free(points);
    }
}

static void limited_noisy_growth_equals_brute_force(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        PointSet *points = points_in_ball(1000, seed);
        OutTree *start = tree_from(vec3(0, -1, 0));
        out_tree_add_node(start, vec3(0.3f, 1.2f, 0), -1, 0, 1, 5, NULL);
        out_tree_add_node(start, vec3(0, -0.9f, 0), 0, 0, 0, out_tree_child_id(77, 0), NULL);
        ColonizeParams params = params_auto(points, 0.4f, 1.0f, 3.0f);
        params.max_children = 1 + (int)(seed % 3);
        params.noise = 0.3f;
        params.tropism = vec3(0, 0.1f, 0);
        params.seed = seed;
        compare(points, &params, start);
        out_tree_free(start);
        points_free(points);
    }
}

static void growth_in_a_field_equals_brute_force(void **state)
{
    (void)state;
    Run run = run_default();
    FieldParams field = field_params_default(FIELD_VORTEX);
    GuideField *vortex =
        guide_field_new(&field, 1, &(FieldSite){.bounds = aabb_empty()}, &run, NULL);
    assert_non_null(vortex);
    PointSet *points = points_in_ball(1500, 3);
    OutTree *start = tree_from(vec3(0.1f, -1, 0));
    ColonizeParams params = params_auto(points, 0.5f, 1.2f, 5.0f);
    params.field = vortex;
    params.field_weight = 0.8f;
    compare(points, &params, start);
    out_tree_free(start);
    points_free(points);
    guide_field_free(vortex);
}

// Thin sheets whose nodes reach more cells than a search looks at together: many rows of cells in
// the plane x-y, long rows in the plane x-z.
static void far_reaching_growth_equals_brute_force(void **state)
{
    (void)state;
    for (int flat = 1; flat <= 2; flat++) {
        PointSet *points = points_empty(0.2, 3);
        for (uint64_t i = 0; i < 2000; i++) {
            uint64_t key = random_key((uint64_t)flat, i);
            float thin = random_range(random_key(key, 0), 0.0f, 0.05f);
            float wide = random_range(random_key(key, 1), -1.0f, 1.0f);
            float x = random_range(random_key(key, 2), -1.0f, 1.0f);
            points_put(points, flat == 1 ? vec3(x, thin, wide) : vec3(x, wide, thin),
                       vec3(0, 1, 0));
        }
        OutTree *start = tree_from(vec3(0.1f, 0, 0));
        ColonizeParams params = params_auto(points, 0.5f, 1.5f, 25.0f);
        compare(points, &params, start);
        out_tree_free(start);
        points_free(points);
    }
}

// Lattice points: many attractors are exactly as far from two nodes, so ties decide everywhere.
static void ties_go_to_the_lowest_index(void **state)
{
    (void)state;
    PointSet *points = points_empty(8.0, 3);
    for (int i = 0; i < 1000; i++) {
        points_put(
            points,
            vec3((float)(i % 10) * 0.25f, (float)(i / 10 % 10) * 0.25f, (float)(i / 100) * 0.25f),
            vec3(0, 1, 0));
    }
    OutTree *start = tree_from(vec3(1.125f, -0.25f, 1.125f));
    out_tree_add_node(start, vec3(0.5f, -0.25f, 0.5f), -1, 0, 1, 6, NULL);
    out_tree_add_node(start, vec3(0.5f, -0.25f, 1.5f), -1, 0, 2, 7, NULL);
    ColonizeParams params = colonize_params_default();
    params.step = 0.125f, params.kill = 0.25f, params.influence = 1.0f;
    compare(points, &params, start);
    out_tree_free(start);
    points_free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_growth_equals_brute_force),
        cmocka_unit_test(limited_noisy_growth_equals_brute_force),
        cmocka_unit_test(growth_in_a_field_equals_brute_force),
        cmocka_unit_test(far_reaching_growth_equals_brute_force),
        cmocka_unit_test(ties_go_to_the_lowest_index),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
