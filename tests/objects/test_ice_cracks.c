// Cracks in ice: how far apart they are, where and at what angles they end, that none crosses
// another, how much of their faces has healed, where the faces lie.
#include "making.h"
#include "testing.h"

#include "base/random.h"
#include "objects/ice_cracks/ice_cracks.h"
#include "shape/mesh_close.h"

#include <stdlib.h>
#include <string.h>

static Grown grow(const IceCracksParams *params, uint64_t seed)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = seed, .label = "object 'cracks'", .run = &run};
    Grown grown = {0};
    if (!ice_cracks_grow(params, &recipe, &grown, &e) || !out_tree_check(grown.tree, &e)) {
        fail_msg("%s", e.message);
    }
    return grown;
}

static Vec3 start_of(const OutTree *tree, int64_t i)
{
    return tree->position[tree->parent[i]];
}

// Share t of the way from a to b at which the line through c and d crosses it, and u of theirs.
static bool crossing(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double *t, double *u)
{
    double ax = (double)b.x - (double)a.x, az = (double)b.z - (double)a.z;
    double cx = (double)d.x - (double)c.x, cz = (double)d.z - (double)c.z;
    double x = (double)c.x - (double)a.x, z = (double)c.z - (double)a.z, area = ax * cz - az * cx;
    *t = (x * cz - z * cx) / area;
    *u = (x * az - z * ax) / area;
    return area != 0.0;
}

static double distance_to_step(const OutTree *tree, int64_t i, Vec3 p)
{
    Vec3 a = start_of(tree, i), way = vec3_sub(tree->position[i], a);
    float square = vec3_dot(way, way);
    float t = square > 0 ? clampf(vec3_dot(vec3_sub(p, a), way) / square, 0, 1) : 0;
    return (double)vec3_distance(p, vec3_madd(a, t, way));
}

// The step of another crack that is nearest to p.
static int64_t nearest_step(const OutTree *tree, Vec3 p, int32_t but, double *distance)
{
    int64_t nearest = -1;
    *distance = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && tree->colony[i] != but) {
            double d = distance_to_step(tree, i, p);
            nearest = d < *distance ? i : nearest;
            *distance = d < *distance ? d : *distance;
        }
    }
    return nearest;
}

static bool is_tip(const OutTree *tree, int64_t i)
{
    return tree->parent[i] >= 0 && (i + 1 == tree->count || tree->parent[i + 1] != i);
}

// Random lines over the ice cross a crack once in a spacing.
static void cracks_are_as_far_apart_as_asked_for(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        IceCracksParams params = ice_cracks_params_default();
        params.spacing = k ? 0.3f : 0.6f;
        Grown grown = grow(&params, 1 + (uint64_t)k);
        const OutTree *tree = grown.tree;
        double length = 0.0, half = 0.5 * (double)params.size;
        int64_t hits = 0;
        for (uint64_t line = 0; line < 600; line++) { // isotropic: an angle and a distance from 0
            float angle = 6.2831853f * random_unit(random_key(line, 1));
            float far = (float)half * random_range(random_key(line, 2), -1.4143f, 1.4143f);
            Vec3 way = vec3(cosf(angle), 0, sinf(angle)), off = vec3(-way.z, 0, way.x);
            Vec3 a = vec3_madd(vec3_scale(off, far), -2.0f * params.size, way);
            Vec3 b = vec3_madd(vec3_scale(off, far), 2.0f * params.size, way);
            double enter = 0.0, leave = 1.0, t, u;
            for (int side = 0; side < 2; side++) { // cut to the square
                double from = (double)(side ? a.z : a.x), to = (double)(side ? b.z : b.x);
                double t0 = (-half - from) / (to - from), t1 = (half - from) / (to - from);
                enter = fmax(enter, fmin(t0, t1));
                leave = fmin(leave, fmax(t0, t1));
            }
            if (leave <= enter) {
                continue;
            }
            length += (leave - enter) * 4.0 * (double)params.size;
            for (int64_t i = 0; i < tree->count; i++) {
                hits += tree->parent[i] >= 0 &&
                        crossing(a, b, start_of(tree, i), tree->position[i], &t, &u) && u >= 0 &&
                        u < 1 && t >= enter && t < leave;
            }
        }
        double spacing = length / (double)hits;
        print_message("spacing %g: %.3f over %lld crossings\n", (double)params.spacing, spacing,
                      (long long)hits);
        assert_true(fabs(spacing / (double)params.spacing - 1.0) < 0.05);
        grown_clear(&grown);
    }
}

static void none_crosses_another(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        IceCracksParams params = ice_cracks_params_default();
        params.size = 4.0f;
        Grown grown = grow(&params, seed);
        const OutTree *tree = grown.tree;
        for (int64_t i = 0; i < tree->count; i++) {
            for (int64_t j = 0; j < i; j++) {
                double t, u, end = 1e-3;
                if (tree->parent[i] >= 0 && tree->parent[j] >= 0 &&
                    crossing(start_of(tree, i), tree->position[i], start_of(tree, j),
                             tree->position[j], &t, &u) &&
                    t > end && t < 1 - end && u > end && u < 1 - end) {
                    fail_msg("steps %lld and %lld cross", (long long)i, (long long)j);
                }
            }
        }
        grown_clear(&grown);
    }
}

// Without loose ends all arms end on an older crack or at the square's edge, at angles nearer to 90
// degrees than those of lines thrown at random, whose mean is one radian.
static void ends_meet_older_cracks_about_square(void **state)
{
    (void)state;
    double sum = 0.0;
    int64_t count = 0;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        IceCracksParams params = ice_cracks_params_default();
        params.loose = 0.0f;
        Grown grown = grow(&params, seed);
        const OutTree *tree = grown.tree;
        double own = 0.0;
        int64_t own_count = 0;
        for (int64_t i = 0; i < tree->count; i++) {
            if (!is_tip(tree, i)) {
                continue;
            }
            Vec3 p = tree->position[i];
            double distance, half = 0.5 * (double)params.size;
            int64_t step = nearest_step(tree, p, tree->colony[i], &distance);
            if (fmax(fabs((double)p.x), fabs((double)p.z)) > half - 1e-4) {
                continue;
            }
            assert_true(distance < 1e-4 && tree->colony[step] < tree->colony[i]);
            Vec3 a = vec3_normalize(vec3_sub(p, start_of(tree, i)));
            Vec3 b = vec3_normalize(vec3_sub(tree->position[step], start_of(tree, step)));
            own += acos(fmin(1.0, fabs((double)vec3_dot(a, b)))) * 180.0 / M_PI;
            own_count++;
        }
        Run run = run_default();
        Recipe recipe = {.seed = seed, .label = "object 'cracks'", .run = &run};
        MeasureList list = {0};
        assert_true(ice_cracks_measure(&params, &grown, &recipe, &list, NULL));
        assert_true(fabs(measures_find(&list, "junction_angle")->value - own / (double)own_count) <
                    1.0);
        measures_clear(&list);
        sum += own;
        count += own_count;
        grown_clear(&grown);
    }
    print_message("%lld junctions, mean %.1f degrees\n", (long long)count, sum / (double)count);
    assert_true(sum / (double)count > 72.0);
}

static void stars_open_at_120_degrees(void **state)
{
    (void)state;
    IceCracksParams params = ice_cracks_params_default();
    for (int stars = 0; stars < 2; stars++) {
        params.stars = (float)stars;
        params.spacing = 3.0f; // no older crack is near the first
        Grown grown = grow(&params, 4);
        const OutTree *tree = grown.tree;
        Vec3 way[4];
        int arms = 0;
        for (int64_t i = 1; i < tree->count && tree->colony[i] == 0; i++) {
            if (tree->parent[i] == 0 && arms < 4) {
                way[arms++] = vec3_normalize(vec3_sub(tree->position[i], tree->position[0]));
            }
        }
        assert_int_equal(arms, stars ? 3 : 2);
        for (int k = 0; k < arms; k++) {
            float cosine = vec3_dot(way[k], way[(k + 1) % arms]);
            assert_float_equal(cosine, stars ? -0.5f : -1.0f, 1e-4f);
        }
        grown_clear(&grown);
    }
}

static void loose_ends_stay_short(void **state)
{
    (void)state;
    IceCracksParams params = ice_cracks_params_default();
    params.loose = 1.0f;
    Grown grown = grow(&params, 5);
    const OutTree *tree = grown.tree;
    double *path = calloc((size_t)tree->count, sizeof *path), most = 0.0;
    assert_non_null(path);
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        path[i] = parent < 0 ? 0.0
                             : path[parent] +
                                   (double)vec3_distance(tree->position[parent], tree->position[i]);
        most = fmax(most, path[i]);
    }
    assert_true(most <= 1.2501 * (double)params.spacing && most > 0.9 * (double)params.spacing);
    free(path);
    grown_clear(&grown);
}

// ---- faces

static Mesh *make_faces(const IceCracksParams *params, const Grown *grown, Geometry *geometry)
{
    Run run = run_default();
    Recipe recipe = {.seed = 6, .label = "object 'cracks'", .run = &run};
    Placing placing = placing_in(geometry, &recipe);
    Error e = {0};
    if (!ice_cracks_geometry(params, grown, &placing, &e)) {
        fail_msg("%s", e.message);
    }
    assert_int_equal(geometry->count, 1);
    return geometry->part[0].mesh;
}

static void healing_takes_its_share_of_the_faces(void **state)
{
    (void)state;
    IceCracksParams params = ice_cracks_params_default();
    params.size = 3.0f;
    params.grain = 0.004f;
    Grown grown = grow(&params, 6);
    double whole = 0.0;
    for (int k = 0; k <= 4; k++) {
        params.healed = 0.2f * (float)k;
        Geometry geometry = {0};
        double area = mesh_area(make_faces(&params, &grown, &geometry));
        whole = k == 0 ? area : whole;
        // three grains below the surface stay open, about a tenth of the depth of most cracks
        print_message("healed %.1f: %.3f of the area is left\n", (double)params.healed,
                      area / whole);
        assert_true(area / whole > 1.0 - (double)params.healed - 0.06);
        assert_true(area / whole <
                    1.0 - (double)params.healed + 0.06 + 0.12 * (double)params.healed);
        geometry_clear(&geometry);
    }
    grown_clear(&grown);
}

static void faces_hang_from_their_cracks(void **state)
{
    (void)state;
    IceCracksParams params = ice_cracks_params_default();
    params.size = 1.5f;
    params.tilt = 0.0f;
    Grown grown = grow(&params, 6);
    Geometry geometry = {0};
    const Mesh *mesh = make_faces(&params, &grown, &geometry);
    float grain = ice_cracks_grain(&params);
    float deepest = 0.0f;
    for (int64_t v = 0; v < mesh->vertex_count; v += 7) {
        Vec3 p = mesh->position[v], on = vec3(p.x, 0, p.z);
        double near;
        nearest_step(grown.tree, on, -1, &near);
        assert_true(p.y < 0.0f && p.y > -params.depth);
        assert_true(near < (p.y > -grain ? 0.5 * (double)grain : 0.5 * (double)params.depth));
        deepest = fminf(deepest, p.y);
    }
    assert_true(deepest < -0.6f * params.depth);
    Error e = {0};
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, &e));
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    assert_int_equal(topology.degenerate_faces, 0);
    geometry_clear(&geometry);
    grown_clear(&grown);
}

static void seeds_differ_and_sizes_scale(void **state)
{
    (void)state;
    IceCracksParams params = ice_cracks_params_default();
    Grown one = grow(&params, 1), other = grow(&params, 2);
    params.size *= 4.0f;
    params.spacing *= 4.0f;
    Grown large = grow(&params, 1);
    assert_true(out_tree_hash(one.tree) != out_tree_hash(other.tree));
    assert_int_equal(large.tree->count, one.tree->count);
    for (int64_t i = 0; i < one.tree->count; i++) {
        Vec3 p = vec3_scale(one.tree->position[i], 4.0f);
        assert_memory_equal(&p, &large.tree->position[i], sizeof p);
    }
    grown_clear(&one);
    grown_clear(&other);
    grown_clear(&large);
}

static void too_many_are_refused(void **state)
{
    (void)state;
    IceCracksParams params = ice_cracks_params_default();
    params.size = 1001.0f * params.spacing;
    Run run = run_default();
    Recipe recipe = {.seed = 1, .label = "object 'cracks'", .run = &run};
    Grown grown = {0};
    Error e = {0};
    assert_false(ice_cracks_grow(&params, &recipe, &grown, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "object 'cracks'"));
    assert_non_null(strstr(e.message, "spacing must be at least 0.5005 m"));
    grown_clear(&grown);
}

static void a_cancelled_growth_stops(void **state)
{
    (void)state;
    int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    IceCracksParams params = ice_cracks_params_default();
    Recipe recipe = {.seed = 1, .label = "object 'cracks'", .run = &run};
    Grown grown = {0};
    Error e = {0};
    assert_false(ice_cracks_grow(&params, &recipe, &grown, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    grown_clear(&grown);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cracks_are_as_far_apart_as_asked_for),
        cmocka_unit_test(none_crosses_another),
        cmocka_unit_test(ends_meet_older_cracks_about_square),
        cmocka_unit_test(stars_open_at_120_degrees),
        cmocka_unit_test(loose_ends_stay_short),
        cmocka_unit_test(healing_takes_its_share_of_the_faces),
        cmocka_unit_test(faces_hang_from_their_cracks),
        cmocka_unit_test(seeds_differ_and_sizes_scale),
        cmocka_unit_test(too_many_are_refused),
        cmocka_unit_test(a_cancelled_growth_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
