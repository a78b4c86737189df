// Hoar frost on a straight branch, where its places can be counted; the frost of the clear night.
#include "base/random.h"
#include "making.h"
#include "mesh/hoar.h"
#include "objects/common/hoar.h"
#include "testing.h"

#include <math.h>

// A branch of 2 m along +X, 1 m up, of this radius.
static OutTree *straight_branch(float radius)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int i = 0; i <= 20; i++) {
        assert_int_equal(out_tree_add_node(tree, vec3(0.1f * (float)i, 1.0f, 0.0f), i - 1, i, 0,
                                           random_key(1, (uint64_t)i), NULL),
                         i);
        tree->radius[i] = radius;
    }
    return tree;
}

static Geometry frost_of(const HoarParams *params, float radius)
{
    OutTree *tree = straight_branch(radius);
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "branch", .run = &run};
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    SkinningParams skinning = {.levels = 2, .curve_radius = 1.0f};
    Error e = {0};
    if (!hoar_add(tree, &skinning, params, &placing, 3, &e)) {
        fail_msg("%s", e.message);
    }
    out_tree_free(tree);
    return geometry;
}

static int64_t tufts(const Geometry *geometry)
{
    int64_t count = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        assert_int_equal(geometry->part[i].material, 3);
        count += geometry->part[i].instance_count;
    }
    return count;
}

static HoarParams still_air(void)
{
    HoarParams params = hoar_params_default();
    params.length = 0.02f;
    params.bias = 0.0f;
    return params;
}

// Mean direction in which tufts grow; every foot lies on the branch, every tuft is as long as told.
static Vec3 mean_side(const Geometry *geometry, const HoarParams *params, float radius)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int64_t i = 0; i < geometry->count; i++) {
        for (int64_t k = 0; k < geometry->part[i].instance_count; k++) {
            const Transform *place = &geometry->part[i].instance[k];
            Vec3 foot = transform_point(place, vec3_splat(0.0f));
            Vec3 y = transform_vector(place, vec3(0, 1, 0));
            assert_true(hypotf(foot.y - 1.0f, foot.z) <= radius + 1e-5f);
            assert_true(foot.x >= -0.01f && foot.x <= 2.01f);
            assert_true(vec3_length(y) <= 1.2f * params->length);
            sum = vec3_add(sum, vec3_normalize(y));
        }
    }
    return vec3_scale(sum, 1.0f / (float)tufts(geometry));
}

static float mean_length(const Geometry *geometry)
{
    float sum = 0.0f;
    for (int64_t i = 0; i < geometry->count; i++) {
        for (int64_t k = 0; k < geometry->part[i].instance_count; k++) {
            sum += vec3_length(transform_vector(&geometry->part[i].instance[k], vec3(0, 1, 0)));
        }
    }
    return sum / (float)tufts(geometry);
}

static void assert_closed_and_one_high(Mesh *tuft)
{
    assert_non_null(tuft);
    MeshTopology topology;
    assert_true(mesh_topology(tuft, &topology, NULL));
    assert_int_equal(topology.open_edges, 0);
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    Aabb box = mesh_bounds(tuft);
    assert_true(box.high.y > 0.9f && box.high.y <= 1.05f && box.low.y > -0.3f);
    mesh_free(tuft);
}

static void tufts_are_closed_and_one_high(void **state)
{
    (void)state;
    assert_closed_and_one_high(hoar_tuft(50.0f, 7, NULL));
    for (uint64_t key = 1; key < 6; key++) {
        assert_closed_and_one_high(hoar_feathers(50.0f, key, NULL));
    }
}

// Every blade's volume counts as that of a body that faces outward, and is small.
static void feathers_face_outward_and_are_thin(void **state)
{
    (void)state;
    Mesh *feathers = hoar_feathers(50.0f, 7, NULL);
    assert_non_null(feathers);
    for (int64_t i = 0; i < feathers->face_count; i += 4) {
        Vec3 foot = feathers->position[feathers->index[3 * i]];
        double volume = 0.0; // of a blade of four faces
        for (int64_t k = i; k < i + 4; k++) {
            const uint32_t *face = feathers->index + 3 * k;
            Vec3 a = vec3_sub(feathers->position[face[0]], foot);
            Vec3 b = vec3_sub(feathers->position[face[1]], foot);
            Vec3 c = vec3_sub(feathers->position[face[2]], foot);
            volume += (double)vec3_dot(a, vec3_cross(b, c)) / 6.0;
        }
        assert_true(volume > 0.0 && volume < 1e-3);
    }
    mesh_free(feathers);
}

// With variety most tufts are short and some longer than any without.
static void tufts_vary_when_told(void **state)
{
    (void)state;
    HoarParams params = still_air(), varied = params;
    varied.variety = 1.0f;
    int none = 0, small = 0, large = 0;
    const int places = 4000;
    for (int i = 0; i < places; i++) {
        uint64_t key = random_key(3, (uint64_t)i);
        Vec3 p = vec3_scale(random_direction(random_key(4, (uint64_t)i)), 1.0f);
        float even = hoar_size_share(&params, p, key), share = hoar_size_share(&varied, p, key);
        assert_true(even >= 0.35f && even <= 1.2f);
        none += share == 0.0f;
        small += share > 0.0f && share < 0.35f;
        large += share > 1.2f;
    }
    assert_in_range(none, places / 10, places / 2);
    assert_in_range(small, places / 5, 4 * places / 5);
    assert_in_range(large, places / 100, places / 5);
}

static void as_many_tufts_as_density_and_length_ask_for(void **state)
{
    (void)state;
    HoarParams params = still_air(), dense = params, none = params;
    dense.density = 2.0f;
    none.length = 0.0f;
    Geometry once = frost_of(&params, 0.001f), twice = frost_of(&dense, 0.001f);
    Geometry empty = frost_of(&none, 0.001f);
    double step = 0.22 * 0.02 / (1.0 + 1.5 * 0.001 / 0.02);
    assert_true(fabs((double)tufts(&once) - 2.0 / step) <
                0.06 * 2.0 / step); // twigs taper at the tip
    assert_true(llabs(tufts(&twice) - 2 * tufts(&once)) <= 3);
    assert_int_equal(empty.count, 0);
    dense.max_count = 100;
    Geometry few = frost_of(&dense, 0.001f);
    assert_true(llabs(tufts(&few) - 100) <= 2);
    geometry_clear(&once);
    geometry_clear(&twice);
    geometry_clear(&few);
}

// In still air the mean direction is none; wind makes frost grow against it; thick branches bear
// shorter needles.
static void frost_grows_against_the_wind(void **state)
{
    (void)state;
    HoarParams params = still_air();
    Geometry still = frost_of(&params, 0.002f);
    assert_true(vec3_length(mean_side(&still, &params, 0.002f)) < 0.15f);
    params.bias = 0.9f;
    params.wind = 180.0f; // toward -Z
    Geometry windy = frost_of(&params, 0.002f);
    assert_true(mean_side(&windy, &params, 0.002f).z > 0.85f);
    Geometry thick = frost_of(&params, 0.05f);
    assert_true(mean_length(&thick) < 0.35f * mean_length(&windy));
    geometry_clear(&still);
    geometry_clear(&windy);
    geometry_clear(&thick);
}

// By radiation alone nothing grows underneath, and most on top.
static void a_clear_night_leaves_the_lower_side_bare(void **state)
{
    (void)state;
    HoarParams params = still_air();
    params.sky = 1.0f;
    Geometry night = frost_of(&params, 0.002f);
    assert_true(tufts(&night) > 200);
    assert_true(mean_side(&night, &params, 0.002f).y > 0.2f);
    for (int64_t i = 0; i < night.count; i++) {
        for (int64_t k = 0; k < night.part[i].instance_count; k++) {
            Vec3 y = transform_vector(&night.part[i].instance[k], vec3(0, 1, 0));
            assert_true(vec3_normalize(y).y >= -0.8001f);
        }
    }
    geometry_clear(&night);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tufts_are_closed_and_one_high),
        cmocka_unit_test(feathers_face_outward_and_are_thin),
        cmocka_unit_test(tufts_vary_when_told),
        cmocka_unit_test(as_many_tufts_as_density_and_length_ask_for),
        cmocka_unit_test(frost_grows_against_the_wind),
        cmocka_unit_test(a_clear_night_leaves_the_lower_side_bare),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
