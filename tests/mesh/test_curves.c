#include "mesh/curves.h"
#include "mesh/geometry.h"
#include "skin/skin.h"
#include "testing.h"
#include "tree_samples.h"

#include <math.h>

static float distance_to_segment(Vec3 p, Vec3 a, Vec3 b)
{
    Vec3 step = vec3_sub(b, a), from = vec3_sub(p, a);
    float length2 = vec3_dot(step, step);
    float t = length2 > 0.0f ? clampf(vec3_dot(from, step) / length2, 0.0f, 1.0f) : 0.0f;
    return vec3_length(vec3_madd(from, -t, step));
}

// Distance from p to the nearest curve but `but`, minus that curve's radius there (about).
static float distance_to_curves(const CurveSet *curves, Vec3 p, int64_t but)
{
    float best = INFINITY;
    for (int64_t c = 0; c < curves->curve_count; c++) {
        for (int64_t i = curves->first[c]; c != but && i + 1 < curves->first[c + 1]; i++) {
            float d = distance_to_segment(p, curves->position[i], curves->position[i + 1]);
            best = fminf(best, d - curves->radius[i + 1]);
        }
    }
    return best;
}

// How often the surface winds round p: the solid angle it fills over 4 pi (Van Oosterom and
// Strackee 1983). 1 or more inside.
static double winding(const Mesh *mesh, Vec3 p)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + f * mesh->face_size;
        for (int k = 1; k + 1 < mesh->face_size; k++) {
            Vec3 a = vec3_sub(mesh->position[c[0]], p), b = vec3_sub(mesh->position[c[k]], p);
            Vec3 d = vec3_sub(mesh->position[c[k + 1]], p);
            float la = vec3_length(a), lb = vec3_length(b), ld = vec3_length(d);
            double below = (double)(la * lb * ld + vec3_dot(a, b) * ld + vec3_dot(b, d) * la +
                                    vec3_dot(d, a) * lb);
            sum += 2.0 * atan2((double)vec3_dot(a, vec3_cross(b, d)), below);
        }
    }
    return sum / (4.0 * (double)PI_F);
}

// Whether p is inside a surface or nearly so.
static bool is_covered(const Mesh *mesh, Vec3 p, float reach)
{
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        if (vec3_distance(mesh->position[i], p) < reach) {
            return true;
        }
    }
    return winding(mesh, p) > 0.5;
}

static OutTree *make_tree(uint64_t seed)
{
    OutTree *tree = sample_walk(seed, 500, 0.15f, 0.15f, true);
    out_tree_pipe_radii(tree, 2.4f, 0.004f, 0.15f);
    return tree;
}

static void curves_are_sound(void **state)
{
    (void)state;
    OutTree *tree = make_tree(1);
    SkinParams params = skin_params_default();
    CurveSet *curves = skin_curves(tree, 0.01f, &params, NULL);
    assert_non_null(curves);
    assert_true(curves->curve_count > 10);
    assert_int_equal(curves->first[0], 0);
    assert_int_equal(curves->first[curves->curve_count], curves->point_count);
    for (int64_t c = 0; c < curves->curve_count; c++) {
        int64_t first = curves->first[c], end = curves->first[c + 1];
        assert_true(end - first >= 2);
        assert_true(curves->along[first] == 0.0f);
        for (int64_t i = first; i < end; i++) {
            assert_true(vec3_finite(curves->position[i]));
            assert_true(curves->radius[i] > 0.0f && curves->radius[i] < 0.01f);
            assert_true(curves->birth[i] >= 0.0f && curves->birth[i] <= 1.0f);
            assert_true(i == first || curves->along[i] > curves->along[i - 1]);
        }
        assert_true(curves->radius[end - 1] < 0.4f * curves->radius[first]);
    }
    curves_free(curves);
    out_tree_free(tree);
}

static void curves_and_mesh_together_show_every_node(void **state)
{
    (void)state;
    Run run = run_default();
    for (uint64_t seed = 1; seed <= 2; seed++) {
        OutTree *tree = make_tree(seed);
        SkinParams params = skin_params_default();
        params.min_radius = 0.012f;
        params.levels = 1;
        Mesh *mesh = skin_tree(tree, &params, &run, NULL);
        CurveSet *curves = skin_curves(tree, params.min_radius, &params, NULL);
        assert_non_null(mesh);
        assert_non_null(curves);
        int64_t missing = 0, thin = 0;
        for (int64_t i = 0; i < tree->count; i++) {
            // Relaxing may move a node by part of a step, 0.1 m.
            bool by_curve = distance_to_curves(curves, tree->position[i], -1) < 0.04f;
            thin += tree->radius[i] < params.min_radius;
            missing += !by_curve && !is_covered(mesh, tree->position[i], 0.04f);
        }
        assert_true(thin > 100 && thin < tree->count - 20);
        assert_int_equal(missing, 0);
        mesh_free(mesh);
        curves_free(curves);
        out_tree_free(tree);
    }
}

static void curves_start_inside_what_they_grow_from(void **state)
{
    (void)state;
    Run run = run_default();
    OutTree *tree = make_tree(3);
    SkinParams params = skin_params_default();
    params.min_radius = 0.012f;
    Mesh *mesh = skin_tree(tree, &params, &run, NULL);
    CurveSet *curves = skin_curves(tree, params.min_radius, &params, NULL);
    assert_non_null(mesh);
    assert_non_null(curves);
    int64_t from_mesh = 0, loose = 0;
    for (int64_t c = 0; c < curves->curve_count; c++) {
        Vec3 start = curves->position[curves->first[c]];
        bool inside = winding(mesh, start) > 0.5;
        from_mesh += inside;
        loose += !inside && distance_to_curves(curves, start, c) > 0.0f;
    }
    assert_true(from_mesh > 5);
    assert_int_equal(loose, 0);
    mesh_free(mesh);
    curves_free(curves);
    out_tree_free(tree);
}

static void nasty_trees_make_curves_too(void **state)
{
    (void)state;
    for (int i = 0; i < NASTY_COUNT; i++) {
        OutTree *tree = sample_nasty(i);
        SkinParams params = skin_params_default();
        for (int k = 0; k < 3; k++) {
            CurveSet *curves =
                skin_curves(tree, k == 0 ? 0.0f : (k == 1 ? 0.09f : 10.0f), &params, NULL);
            assert_non_null(curves);
            assert_true(k == 0 ? curves->curve_count == 0 : curves->curve_count >= 0);
            assert_true(k < 2 || curves->curve_count > 0);
            for (int64_t p = 0; p < curves->point_count; p++) {
                assert_true(vec3_finite(curves->position[p]) && curves->radius[p] > 0.0f);
            }
            curves_free(curves);
        }
        out_tree_free(tree);
    }
}

static void geometry_counts_what_it_owns(void **state)
{
    (void)state;
    Geometry geometry = {0};
    CurveSet *curves = curves_new(10, 3, NULL);
    Mesh *quads = mesh_new(4, 8, 6, MESH_NORMAL, NULL);
    Transform *instance = calloc(5, sizeof *instance);
    assert_true(curves && quads && instance);
    assert_true(geometry_add(&geometry, (Part){.kind = PART_CURVES, .curves = curves}, NULL));
    Part leaves = {.kind = PART_MESH, .mesh = quads, .instance = instance, .instance_count = 5};
    assert_true(geometry_add(&geometry, leaves, NULL));
    GeometryCounts counts = geometry_counts(&geometry);
    assert_int_equal(counts.triangles, 12);
    assert_int_equal(counts.curve_segments, 7);
    assert_int_equal(counts.instances, 5);
    assert_true(counts.bytes > 5 * (int64_t)sizeof(Transform) + 8 * 24);
    geometry_clear(&geometry);
    assert_int_equal(geometry.count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_are_sound),
        cmocka_unit_test(curves_and_mesh_together_show_every_node),
        cmocka_unit_test(curves_start_inside_what_they_grow_from),
        cmocka_unit_test(nasty_trees_make_curves_too),
        cmocka_unit_test(geometry_counts_what_it_owns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
