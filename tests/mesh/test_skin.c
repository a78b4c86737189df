#include "skin/cage.h"
#include "skin/girth.h"
#include "skin/skin.h"
#include "testing.h"
#include "tree_samples.h"

#include <math.h>
#include <string.h>

static Mesh *cage_of(const OutTree *tree, const SkinParams *params)
{
    Run run = run_default();
    Error e = {0};
    Mesh *cage = skin_cage(tree, params, &run, &e);
    if (!cage) {
        fail_msg("%s", e.message);
    }
    return cage;
}

static void assert_closed(const Mesh *mesh, int64_t pieces)
{
    MeshTopology t;
    assert_true(mesh_topology(mesh, &t, NULL));
    assert_int_equal(t.open_edges, 0);
    assert_int_equal(t.overused_edges, 0);
    assert_int_equal(t.misoriented_edges, 0);
    assert_int_equal(t.degenerate_faces, 0);
    assert_int_equal(t.component_count, pieces);
    assert_int_equal(t.euler_number, 2 * pieces);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        if (!vec3_finite(mesh->position[i])) {
            fail_msg("vertex %lld is not finite", (long long)i);
        }
    }
}

// Faces that do not look away from the axis of the branch they belong to.
static int64_t count_inverted(const OutTree *tree, const SkinParams *params)
{
    Run run = run_default();
    SkinPlan plan;
    SkinCage cage = {0};
    assert_true(skin_plan_init(&plan, tree, params, &run, NULL));
    assert_true(skin_cage_build(&cage, &plan, &run, NULL));
    int64_t inverted = 0;
    for (int64_t f = 0; f < cage.face_count; f++) {
        Vec3 p[4], middle = vec3(0, 0, 0);
        for (int k = 0; k < 4; k++) {
            p[k] = cage.position[cage.index[4 * f + k]];
            middle = vec3_madd(middle, 0.25f, p[k]);
        }
        Vec3 normal = vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[1]));
        inverted += !(vec3_dot(normal, vec3_sub(middle, cage.face_axis[f])) > 0.0f);
    }
    skin_plan_clear(&plan);
    skin_cage_clear(&cage);
    return inverted;
}

static int64_t count_roots(const OutTree *tree)
{
    int64_t roots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        roots += tree->parent[i] < 0;
    }
    return roots;
}

static void random_trees_have_closed_skins_that_look_outwards(void **state)
{
    (void)state;
    SkinParams params = skin_params_default();
    for (int i = 0; i < 100; i++) {
        params.collar = i % 2 == 1 ? 0.4f : 0.0f;
        params.swelling = i % 4 > 1 ? 1.0f : 0.0f;
        params.fluting = i % 5 > 2 ? 0.5f : 0.0f;
        OutTree *tree = sample_walk((uint64_t)i, 5 + 4 * i, 0.02f * (float)(i % 10),
                                    0.1f * (float)(i % 12), i % 3 != 0);
        Mesh *cage = cage_of(tree, &params);
        assert_closed(cage, 1);
        assert_int_equal(count_inverted(tree, &params), 0);
        mesh_free(cage);
        out_tree_free(tree);
    }
}

static void nasty_trees_have_closed_skins_that_look_outwards(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * NASTY_COUNT; i++) {
        SkinParams params = skin_params_default();
        params.ring_spacing = i < NASTY_COUNT ? 1.0f : 2.5f;
        params.smoothing = i < NASTY_COUNT ? 2 : 0;
        params.swelling = i % 2 == 1 ? 0.7f : 0.0f;
        params.fluting = i % 2 == 1 ? 0.4f : 0.0f;
        OutTree *tree = sample_nasty(i % NASTY_COUNT);
        Mesh *cage = cage_of(tree, &params);
        assert_closed(cage, count_roots(tree));
        assert_int_equal(count_inverted(tree, &params), 0);
        mesh_free(cage);
        out_tree_free(tree);
    }
}

// A limb of radius 0.1 on a trunk of 0.4: with a collar it is thicker near the trunk, and the same
// two radii further out; the skin stays closed.
static void collars_thicken_where_branches_leave(void **state)
{
    (void)state;
    float near[2], far[2];
    for (int with = 0; with < 2; with++) {
        OutTree *tree = out_tree_new(NULL);
        sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.2f, 0), 20, 0.4f);
        sample_line(tree, 10, vec3(0, 2, 0), vec3(0.1f, 0, 0), 20, 0.1f);
        SkinParams params = skin_params_default();
        params.collar = with ? 0.4f : 0.0f;
        Run run = run_default();
        Mesh *mesh = skin_tree(tree, &params, &run, NULL);
        assert_non_null(mesh);
        assert_closed(mesh, 1);
        near[with] = far[with] = 0.0f;
        for (int64_t i = 0; i < mesh->vertex_count; i++) {
            Vec3 p = mesh->position[i];
            float out = hypotf(p.y - 2.0f, p.z);
            if (p.x > 0.50f && p.x < 0.56f) {
                near[with] = fmaxf(near[with], out);
            } else if (p.x > 1.0f) {
                far[with] = fmaxf(far[with], out);
            }
        }
        mesh_free(mesh);
        out_tree_free(tree);
    }
    assert_true(near[1] > 1.1f * near[0]);
    assert_float_equal(far[1], far[0], 0.002f);
}

// A trunk of radius 0.4 with a limb toward +x at height 4, of other random numbers for each trunk.
static OutTree *trunk_with_limb(uint64_t trunk)
{
    OutTree *tree = out_tree_new(NULL);
    sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.2f, 0), 40, 0.4f);
    sample_line(tree, 20, vec3(0, 4, 0), vec3(0.1f, 0, 0), 20, 0.25f);
    tree->id[0] = random_key(trunk, 3);
    return tree;
}

// How far the trunk's surface reaches toward the limb at a height, in its radii there, and that
// radius, m: means over many trunks.
static float mean_reach(float swelling, float fluting, float height, float *radius)
{
    enum { TRUNKS = 60 };
    float sum = 0.0f;
    *radius = 0.0f;
    for (int i = 0; i < TRUNKS; i++) {
        OutTree *tree = trunk_with_limb((uint64_t)i);
        SkinParams params = skin_params_default();
        params.swelling = swelling;
        params.fluting = fluting;
        Run run = run_default();
        SkinPlan plan;
        assert_true(skin_plan_init(&plan, tree, &params, &run, NULL));
        SkinPoint at = skin_axis_at(&plan, 0, height);
        sum += skin_girth_toward(&plan, 0, &at, vec3(1, 0, 0)) / (float)TRUNKS;
        *radius += at.radius / (float)TRUNKS;
        skin_plan_clear(&plan);
        out_tree_free(tree);
    }
    return sum;
}

static void trunks_swell_where_a_limb_leaves(void **state)
{
    (void)state;
    float radius, far, still;
    assert_float_equal(mean_reach(0.0f, 0.0f, 4.0f, &still), 1.0f, 1e-6f);
    assert_float_equal(still, 0.4f, 1e-6f);
    float here = mean_reach(0.5f, 0.0f, 3.75f, &radius); // below the limb
    float above = mean_reach(0.5f, 0.0f, 6.0f, &far);
    assert_true(here * radius > 1.15f * above * far); // 0.5 x 0.25 / 0.4 = 0.31 before limits
    assert_true(radius > far && far < 1.06f * still);
}

// The strand below a limb stands out two radii below it, but not two radii above.
static void strands_run_down_from_limbs(void **state)
{
    (void)state;
    float radius;
    float below = mean_reach(0.0f, 0.3f, 4.0f - 0.8f, &radius);
    float above = mean_reach(0.0f, 0.3f, 4.0f + 0.8f, &radius);
    assert_true(below > 1.1f);
    assert_true(above < 1.05f && above > 0.95f);
    assert_float_equal(radius, 0.4f, 1e-6f); // as thick on the whole
}

// Against the sum that defines it; a turned section is the same one seen from another angle.
static void sections_are_fourier_sums(void **state)
{
    (void)state;
    SkinGirth girth = {.round = 1.0f};
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        girth.cosine[n] = random_range((uint64_t)n, -0.02f, 0.02f);
        girth.sine[n] = random_range((uint64_t)n + 50, -0.02f, 0.02f);
    }
    SkinGirth turned = skin_girth_turned(girth, 0.7f);
    for (int k = 0; k < 20; k++) {
        float angle = 0.31f * (float)k, wanted = 1.0f;
        for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
            float way = (float)(n + 1) * angle;
            wanted += girth.cosine[n] * cosf(way) + girth.sine[n] * sinf(way);
        }
        assert_float_equal(skin_girth_reach(&girth, cosf(angle), sinf(angle)), wanted, 1e-5f);
        float from = angle - 0.7f;
        assert_float_equal(skin_girth_reach(&turned, cosf(from), sinf(from)), wanted, 1e-5f);
    }
}

// A tube that is cut open has a lip at its end, the inside of a wall of the wanted thickness, and a
// floor three radii in; its surface stays closed.
static void cut_roots_are_hollow(void **state)
{
    (void)state;
    const float r = 0.1f, wall = 0.3f;
    OutTree *tree = out_tree_new(NULL);
    sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 20, r);
    float inner = INFINITY, lip = INFINITY, floor = INFINITY;
    SkinParams params = skin_params_default();
    params.wall = wall;
    params.levels = 3;
    Run run = run_default();
    Mesh *mesh = skin_tree(tree, &params, &run, NULL);
    assert_non_null(mesh);
    assert_closed(mesh, 1);
    assert_int_equal(count_inverted(tree, &params), 0);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        lip = fminf(lip, p.y);
        if (p.y > 0.0f && p.y < 0.1f) {
            inner = fminf(inner, hypotf(p.x, p.z));
        }
        if (hypotf(p.x, p.z) < 0.2f * r) {
            floor = fminf(floor, p.y);
        }
    }
    mesh_free(mesh);
    assert_float_equal(floor - lip, 3.0f * r, 0.15f * r);
    assert_float_equal(inner, r * (1.0f - wall), 0.002f);
    assert_true(lip > -r); // where the round end would reach
    out_tree_free(tree);
}

static void finished_skins_are_closed_and_look_outwards(void **state)
{
    (void)state;
    SkinParams params = skin_params_default();
    params.levels = 3;
    Run run = run_default();
    for (int i = 0; i < 6; i++) {
        OutTree *tree = sample_walk((uint64_t)i, 150, 0.1f, 0.2f, true);
        Mesh *mesh = skin_tree(tree, &params, &run, NULL);
        assert_non_null(mesh);
        assert_closed(mesh, 1);
        int64_t against = 0, corners = 0, not_unit = 0;
        for (int64_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *c = mesh->index + f * mesh->face_size;
            Vec3 normal = vec3_cross(vec3_sub(mesh->position[c[1]], mesh->position[c[0]]),
                                     vec3_sub(mesh->position[c[2]], mesh->position[c[0]]));
            for (int k = 0; k < mesh->face_size; k++, corners++) {
                not_unit += !(fabsf(vec3_length(mesh->normal[c[k]]) - 1.0f) < 1e-4f);
                against += vec3_dot(mesh->normal[c[k]], normal) < 0.0f;
            }
        }
        assert_int_equal(not_unit, 0);
        assert_true(against * 1000 < corners); // creases of a sharp crotch at most
        mesh_free(mesh);
        out_tree_free(tree);
    }
}

static OutTree *straight_tube(float radius, float thick)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    sample_line(tree, -1, vec3(0, 0, 0), vec3(0.06f, 0.1f, 0.03f), 40, radius);
    if (thick > 0.0f) { // a second root far off, so that sides are chosen against it
        sample_line(tree, -1, vec3(100, 0, 0), vec3(0, 0.5f, 0), 4, thick);
    }
    return tree;
}

// Least and largest distance from the axis over the middle of the tube, in radii.
static void measure_tube(const Mesh *mesh, float radius, float *least, float *largest)
{
    Vec3 step = vec3(0.06f, 0.1f, 0.03f), axis = vec3_normalize(step);
    float length = 40.0f * vec3_length(step);
    *least = INFINITY;
    *largest = 0.0f;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        float along = vec3_dot(mesh->position[i], axis);
        if (mesh->position[i].x > 50.0f || along < 3 * radius || along > length - 3 * radius) {
            continue;
        }
        float r = vec3_length(vec3_madd(mesh->position[i], -along, axis)) / radius;
        *least = r < *least ? r : *least;
        *largest = r > *largest ? r : *largest;
    }
}

static void straight_tubes_have_the_asked_radius(void **state)
{
    (void)state;
    Run run = run_default();
    SkinParams params = skin_params_default();
    params.levels = 3;
    const float thick[4] = {0.0f, 0.1f, 0.15f, 1.0f};
    for (int i = 0; i < 4; i++) { // 4 to 32 sides
        OutTree *tree = straight_tube(0.1f, thick[i]);
        if (i == 1) {
            tree->radius[tree->count - 1] = 0.001f;
        }
        Mesh *mesh = skin_tree(tree, &params, &run, NULL);
        assert_non_null(mesh);
        float least, largest;
        measure_tube(mesh, 0.1f, &least, &largest);
        assert_true(least > 0.97f && largest < 1.03f);
        mesh_free(mesh);
        out_tree_free(tree);
    }
}

// On the way from 32 sides to 4 the surface must not bulge where sides are halved.
static void tapering_tubes_stay_round(void **state)
{
    (void)state;
    enum { NODES = 100, BINS = 100 };
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int i = 0; i <= NODES; i++) {
        sample_add(tree, vec3(0, 0.05f * (float)i, 0), i - 1, 0.3f - 0.0028f * (float)i);
    }
    Run run = run_default();
    SkinParams params = skin_params_default();
    params.levels = 3;
    Mesh *mesh = skin_tree(tree, &params, &run, NULL);
    assert_non_null(mesh);
    double sum[BINS] = {0}, count[BINS] = {0};
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        if (p.y < 0.2f || p.y > 4.9f) {
            continue;
        }
        double radius = sqrt((double)(p.x * p.x + p.z * p.z)) / (0.3 - 0.056 * (double)p.y);
        assert_true(radius > 0.94 && radius < 1.09);
        sum[(int)(p.y * 20.0f)] += radius;
        count[(int)(p.y * 20.0f)] += 1.0;
    }
    for (int b = 4; b < 98; b++) {
        assert_true(count[b] > 0.0 && fabs(sum[b] / count[b] - 1.0) < 0.03);
    }
    mesh_free(mesh);
    out_tree_free(tree);
}

static void the_same_tree_gives_the_same_bits(void **state)
{
    (void)state;
    OutTree *tree = sample_walk(5, 300, 0.1f, 0.3f, true);
    SkinParams params = skin_params_default();
    Run one = run_default(), four = {.threads = 4};
    Mesh *a = skin_tree(tree, &params, &one, NULL), *b = skin_tree(tree, &params, &four, NULL);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->face_count, b->face_count);
    size_t n = (size_t)a->vertex_count;
    assert_memory_equal(a->position, b->position, n * sizeof(Vec3));
    assert_memory_equal(a->normal, b->normal, n * sizeof(Vec3));
    assert_memory_equal(a->uv, b->uv, n * sizeof(Vec2));
    assert_memory_equal(a->birth, b->birth, n * sizeof(float));
    mesh_free(a);
    mesh_free(b);
    out_tree_free(tree);
}

static void along_never_jumps(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 40, 0.3f);
    sample_line(tree, 20, vec3(0, 2, 0), vec3(0.1f, 0.05f, 0), 30, 0.1f);
    sample_line(tree, 25, vec3(0, 2.5f, 0), vec3(0, 0.05f, 0.1f), 30, 0.03f);
    SkinParams params = skin_params_default();
    Run run = run_default();
    Mesh *mesh = skin_tree(tree, &params, &run, NULL);
    assert_non_null(mesh);
    float low = INFINITY, high = -INFINITY;
    int64_t jumps = 0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + f * mesh->face_size;
        for (int k = 0; k < mesh->face_size; k++) {
            uint32_t a = c[k], b = c[(k + 1) % mesh->face_size];
            float change = fabsf(mesh->uv[a].y - mesh->uv[b].y);
            jumps += !(change <= 2.5f * vec3_distance(mesh->position[a], mesh->position[b]));
        }
        low = fminf(low, mesh->uv[c[0]].y);
        high = fmaxf(high, mesh->uv[c[0]].y);
    }
    assert_int_equal(jumps, 0);
    assert_true(low > -0.4f && low < 0.0f);
    assert_true(high > 4.0f && high < 7.0f); // 2 m of trunk and 3.4 m of branch
    mesh_free(mesh);
    out_tree_free(tree);
}

static void thin_chains_are_left_out(void **state)
{
    (void)state;
    OutTree *tree = sample_walk(3, 400, 0.2f, 0.2f, true);
    SkinParams params = skin_params_default();
    Mesh *all = cage_of(tree, &params);
    params.min_radius = 0.02f;
    Mesh *thick = cage_of(tree, &params);
    assert_closed(thick, 1);
    assert_true(thick->face_count < all->face_count);
    for (int64_t i = 0; i < thick->vertex_count; i++) {
        assert_true(thick->radius[i] > 0.0199f && thick->birth[i] >= 0 && thick->birth[i] <= 1);
    }
    params.min_radius = 1.0f;
    Mesh *none = cage_of(tree, &params);
    assert_int_equal(none->face_count, 0);
    mesh_free(all);
    mesh_free(thick);
    mesh_free(none);
    out_tree_free(tree);
}

static void bad_settings_are_named(void **state)
{
    (void)state;
    OutTree *tree = sample_nasty(0);
    Run run = run_default();
    SkinParams params = skin_params_default();
    params.levels = 9;
    Error e = {0};
    assert_null(skin_tree(tree, &params, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "levels"));
    int stop = 1;
    run.cancelled = &stop;
    params.levels = 2;
    assert_null(skin_tree(tree, &params, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_trees_have_closed_skins_that_look_outwards),
        cmocka_unit_test(nasty_trees_have_closed_skins_that_look_outwards),
        cmocka_unit_test(collars_thicken_where_branches_leave),
        cmocka_unit_test(trunks_swell_where_a_limb_leaves),
        cmocka_unit_test(strands_run_down_from_limbs),
        cmocka_unit_test(sections_are_fourier_sums),
        cmocka_unit_test(cut_roots_are_hollow),
        cmocka_unit_test(finished_skins_are_closed_and_look_outwards),
        cmocka_unit_test(straight_tubes_have_the_asked_radius),
        cmocka_unit_test(tapering_tubes_stay_round),
        cmocka_unit_test(the_same_tree_gives_the_same_bits),
        cmocka_unit_test(along_never_jumps),
        cmocka_unit_test(thin_chains_are_left_out),
        cmocka_unit_test(bad_settings_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
