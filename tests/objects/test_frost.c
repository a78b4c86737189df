// Frost: sides at 60 degrees, orders limited, crystals that do not cross, bubbles that stay round,
// fields that turn, blades that are closed, the same at any size and on any number of threads.
#include "making.h"
#include "testing.h"

#include "base/random.h"
#include "objects/frost/surface.h"
#include "outtree/crossings.h"

static Recipe recipe_on(const Run *run)
{
    return (Recipe){.seed = 11, .label = "frost", .run = run};
}

static FrostParams small_params(FrostSurface surface)
{
    FrostParams params = frost_params_default(surface);
    params.nuclei = surface == FROST_PANE ? 5 : 1;
    params.spines = 90;
    params.sides = 6000;
    params.grains = 300;
    return params;
}

static OutTree *grow(const FrostParams *params, int threads, float grow_to)
{
    Run run = run_default();
    run.threads = threads;
    Recipe recipe = recipe_on(&run);
    Error e = {0};
    OutTree *tree = grow_kind(&kind_frost, params, &recipe, grow_to, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

static double measured(const OutTree *tree, const FrostParams *params, const char *name)
{
    MeasureList list = {0};
    Grown grown = grown_of(tree);
    assert_true(frost_measure(params, &grown, NULL, &list, NULL));
    const Measure *measure = measures_find(&list, name);
    assert_non_null(measure);
    double value = measure->value;
    measures_clear(&list);
    return value;
}

static void sides_leave_at_their_angle(void **state)
{
    (void)state;
    for (int angle = 45; angle <= 60; angle += 15) {
        FrostParams params = small_params(FROST_PANE);
        params.angle = (float)angle;
        OutTree *tree = grow(&params, 1, 1.0f);
        assert_true(tree->count > 3000);
        assert_float_equal(measured(tree, &params, "side_angle"), angle, 1.0);
        assert_true(measured(tree, &params, "side_angle_spread") < 3.0);
        out_tree_free(tree);
    }
}

static void orders_are_limited(void **state)
{
    (void)state;
    for (int orders = 1; orders <= 3; orders++) {
        FrostParams params = small_params(FROST_PANE);
        params.orders = orders;
        OutTree *tree = grow(&params, 1, 1.0f);
        assert_float_equal(measured(tree, &params, "orders"), orders, 0.0);
        out_tree_free(tree);
    }
}

// Skipping every side leaves the spines as they are without any.
static void skipped_sides_do_not_grow(void **state)
{
    (void)state;
    FrostParams params = small_params(FROST_PANE), bare = params;
    int64_t count[3];
    const float skip[3] = {0.0f, 0.33f, 1.0f};
    for (int i = 0; i < 3; i++) {
        params.skip = skip[i];
        OutTree *tree = grow(&params, 1, 1.0f);
        count[i] = tree->count;
        out_tree_free(tree);
    }
    bare.sides = 0;
    OutTree *tree = grow(&bare, 1, 1.0f);
    assert_true(count[0] > 1.1 * (double)count[1] && count[1] > 2 * count[2]);
    assert_true(tree->count > 100);
    out_tree_free(tree);
}

// Every pair of segments without a common node, crossing told by where the lines through them meet.
static int64_t count_crossings(const OutTree *tree)
{
    int64_t crossings = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        for (int64_t j = 0; j < i && tree->parent[i] >= 0; j++) {
            int32_t p = tree->parent[i], q = tree->parent[j];
            if (q < 0 || q == i || p == j || p == q) {
                continue;
            }
            Vec3 a = tree->position[p], b = tree->position[q];
            Vec3 u = vec3_sub(tree->position[i], a), v = vec3_sub(tree->position[j], b);
            double det = (double)u.x * (double)v.y - (double)u.y * (double)v.x;
            double x = (double)b.x - (double)a.x, y = (double)b.y - (double)a.y;
            double s = (x * (double)v.y - y * (double)v.x) / det;
            double t = (x * (double)u.y - y * (double)u.x) / det;
            crossings += det != 0.0 && s > 1e-4 && s < 0.9999 && t > 1e-4 && t < 0.9999;
        }
    }
    return crossings;
}

static void crystals_do_not_cross(void **state)
{
    (void)state;
    FrostParams params = small_params(FROST_PANE);
    OutTree *tree = grow(&params, 1, 1.0f);
    assert_int_equal(count_crossings(tree), 0);
    out_tree_free(tree);
    // and it is not for want of anything to drop: a random tangle loses its crossings, no more
    OutTree *tangle = out_tree_new(NULL);
    for (int i = 0; i < 400; i++) {
        uint64_t key = random_key(9, (uint64_t)i);
        Vec3 p =
            vec3(random_range(random_key(key, 0), 0, 1), random_range(random_key(key, 1), 0, 1), 0);
        Vec3 d = random_direction(random_key(key, 2));
        int64_t root = out_tree_add_node(tangle, p, -1, 0, i, key, NULL);
        Vec3 tip = vec3(p.x + 0.06f * d.x, p.y + 0.06f * d.y, 0);
        out_tree_add_node(tangle, tip, root, 1 + i % 7, i, random_key(key, 3), NULL);
    }
    for (int64_t i = 0; i < tangle->count; i++) {
        tangle->normal[i] = vec3(0, 0, 1);
    }
    int64_t before = tangle->count, crossings = count_crossings(tangle);
    Run run = run_default();
    assert_true(crossings > 20);
    assert_true(out_tree_drop_crossings(tangle, &run, NULL));
    assert_int_equal(count_crossings(tangle), 0);
    assert_true(tangle->count < before && before - tangle->count <= crossings);
    out_tree_free(tangle);
}

static void bubbles_stay_round(void **state)
{
    (void)state;
    FrostParams params = small_params(FROST_BUBBLE);
    params.position = vec3(0.1f, 0.2f, -0.3f);
    OutTree *tree = grow(&params, 1, 1.0f);
    double highest = -1.0;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 d = vec3_sub(tree->position[i], params.position);
        assert_float_equal(vec3_length(d), params.radius, 1e-5f * params.radius);
        assert_true(vec3_dot(vec3_normalize(d), tree->normal[i]) > 0.9999f);
        highest = fmax(highest, (double)(d.y / params.radius));
    }
    assert_float_equal(tree->position[0].y, params.position.y - params.radius, 1e-6f);
    assert_true(highest > 0.9); // all the way up
    out_tree_free(tree);
}

static void swirl_grows_with_the_turn(void **state)
{
    (void)state;
    const float turns[] = {0.0f, 120.0f, 360.0f, 720.0f};
    double last = -1.0;
    for (int i = 0; i < 4; i++) {
        FrostParams params = frost_params_default(FROST_BUBBLE);
        params.turn = turns[i];
        params.sides = 0;
        OutTree *tree = grow(&params, 1, 1.0f);
        double swept = measured(tree, &params, "swept");
        assert_true(swept > last + (i == 0 ? 0.0 : 8.0));
        assert_true(i > 0 || swept < 30.0);
        last = swept;
        out_tree_free(tree);
    }
}

// Figures 7, 8 and 20 of Tanaka et al.: the spines alone, on a plane about its middle and on a ball
// from the bottom, sweep most of the turn.
static void spines_sweep_more_with_the_turn(void **state)
{
    (void)state;
    const float turns[] = {0.0f, 120.0f, 360.0f, 720.0f};
    FrostNucleus middle = {{0, 0, 0}};
    for (int surface = FROST_PANE; surface <= FROST_BUBBLE; surface++) {
        for (int sides = 0; sides <= 3000; sides += 3000) {
            double last = -INFINITY;
            for (int i = 0; i < 4; i++) {
                FrostParams params = frost_params_default((FrostSurface)surface);
                params.nucleus = surface == FROST_PANE ? &middle : NULL;
                params.nucleus_count = surface == FROST_PANE;
                params.width = params.height = 0.5f;
                params.turn = turns[i];
                params.profile = PROFILE_GROWN;
                params.field_weight = 1.5f;
                params.spines = 420;
                params.sides = sides;
                OutTree *tree = grow(&params, 1, 1.0f);
                double swept = measured(tree, &params, "spine_swept");
                assert_true(i > 0 ? swept > last + 40.0 : fabs(swept) < 25.0);
                assert_true(i == 0 ||
                            (swept > 0.45 * (double)turns[i] && swept < 1.1 * (double)turns[i]));
                last = swept;
                out_tree_free(tree);
            }
        }
    }
}

// The sign tells the side: by the right-hand rule about the normal at the nucleus.
static void a_negative_turn_sweeps_the_other_way(void **state)
{
    (void)state;
    FrostNucleus middle = {{0, 0, 0}};
    for (int surface = FROST_PANE; surface <= FROST_BUBBLE; surface++) {
        double swept[2];
        for (int i = 0; i < 2; i++) {
            FrostParams params = small_params((FrostSurface)surface);
            params.nucleus = surface == FROST_PANE ? &middle : NULL;
            params.nucleus_count = surface == FROST_PANE;
            params.sides = 0;
            params.turn = i == 0 ? 200.0f : -200.0f;
            OutTree *tree = grow(&params, 1, 1.0f);
            swept[i] = measured(tree, &params, "spine_swept");
            out_tree_free(tree);
        }
        assert_true(swept[0] > 20.0 && swept[1] < -20.0);
    }
}

static void growth_shows_from_the_nuclei(void **state)
{
    (void)state;
    FrostParams params = small_params(FROST_PANE);
    OutTree *all = grow(&params, 1, 1.0f), *half = grow(&params, 1, 0.5f);
    OutTree *none = grow(&params, 1, 0.0f);
    assert_int_equal(none->count, 5);
    assert_true(half->count > 500 && half->count < all->count);
    for (int64_t i = 0, j = 0; i < half->count; i++, j++) {
        while (all->id[j] != half->id[i]) {
            j++;
            assert_true(j < all->count);
        }
        assert_memory_equal(&all->position[j], &half->position[i], sizeof(Vec3));
    }
    Run run = run_default();
    Recipe recipe = recipe_on(&run);
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    Grown grown = grown_of(none);
    assert_true(frost_geometry(&params, &grown, &placing, NULL));
    geometry_clear(&geometry);
    out_tree_free(all);
    out_tree_free(half);
    out_tree_free(none);
}

static void threads_do_not_show(void **state)
{
    (void)state;
    FrostParams params = small_params(FROST_PANE);
    OutTree *one = grow(&params, 1, 1.0f);
    for (int threads = 2; threads <= 3; threads++) {
        OutTree *more = grow(&params, threads, 1.0f);
        assert_true(out_tree_hash(one) == out_tree_hash(more));
        out_tree_free(more);
    }
    out_tree_free(one);
}

// Rounding makes a crystal end a step earlier here and there, no more.
static void ten_times_the_size_looks_the_same(void **state)
{
    (void)state;
    for (int surface = 0; surface < 2; surface++) {
        FrostParams params = small_params((FrostSurface)surface), large = params;
        large.width *= 10.0f;
        large.height *= 10.0f;
        large.radius *= 10.0f;
        OutTree *a = grow(&params, 1, 1.0f), *b = grow(&large, 1, 1.0f);
        assert_true(fabs((double)a->count / (double)b->count - 1.0) < 0.03);
        assert_float_equal(b->radius[0] / a->radius[0], 10.0f, 0.3f);
        assert_float_equal(measured(a, &params, "side_angle"), measured(b, &large, "side_angle"),
                           0.3);
        assert_float_equal(measured(a, &params, "swept"), measured(b, &large, "swept"), 3.0);
        out_tree_free(a);
        out_tree_free(b);
    }
}

static double signed_volume(const Mesh *mesh)
{
    double volume = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        volume += (double)vec3_dot(mesh->position[c[0]],
                                   vec3_cross(mesh->position[c[1]], mesh->position[c[2]]));
    }
    return volume / 6.0;
}

static void blades_and_grains_are_closed(void **state)
{
    (void)state;
    for (int surface = 0; surface < 2; surface++) {
        FrostParams params = small_params((FrostSurface)surface);
        Run run = run_default();
        Recipe recipe = recipe_on(&run);
        OutTree *tree = grow(&params, 1, 1.0f);
        Geometry geometry = {0};
        Placing placing = placing_in(&geometry, &recipe);
        placing.material += 3; // from 3 on
        Grown grown = grown_of(tree);
        assert_true(frost_geometry(&params, &grown, &placing, NULL));
        assert_true(geometry.count > 3);
        int rime = 0;
        for (int64_t i = 0; i < geometry.count; i++) {
            MeshTopology topology;
            assert_true(mesh_topology(geometry.part[i].mesh, &topology, NULL));
            assert_int_equal(topology.open_edges, 0);
            assert_int_equal(topology.overused_edges, 0);
            assert_int_equal(topology.misoriented_edges, 0);
            assert_int_equal(topology.degenerate_faces, 0);
            assert_int_equal(topology.euler_number, 2 * topology.component_count);
            assert_true(signed_volume(geometry.part[i].mesh) > 0.0);
            rime += geometry.part[i].material == 4;
        }
        assert_true(rime > 1);
        geometry_clear(&geometry);
        out_tree_free(tree);
    }
}

static FrostParams small_ferns(FrostSurface surface)
{
    FrostParams params = frost_habit_default(surface, FROST_FERNS);
    params.nuclei = 5;
    params.spines = 40;
    params.sides = 12000;
    params.grains = 300;
    return params;
}

static void ferns_leave_at_their_angle_and_do_not_cross(void **state)
{
    (void)state;
    for (int angle = 40; angle <= 60; angle += 20) {
        FrostParams params = small_ferns(FROST_PANE);
        params.angle = (float)angle;
        OutTree *tree = grow(&params, 1, 1.0f);
        assert_true(tree->count > 2000);
        assert_float_equal(measured(tree, &params, "side_angle"), angle, 3.0);
        assert_true(measured(tree, &params, "side_angle_spread") < 8.0);
        assert_int_equal(count_crossings(tree), 0);
        out_tree_free(tree);
    }
}

// Nodes keep out of the islands, which have the share of the surface that was asked for, so there
// are fewer of them; grains are elsewhere.
static void ferns_leave_glass_clear(void **state)
{
    (void)state;
    FrostParams params = small_ferns(FROST_PANE);
    double count[2];
    for (int i = 0; i < 2; i++) {
        params.clear = 0.5f * (float)i;
        OutTree *tree = grow(&params, 1, 1.0f);
        count[i] = (double)tree->count;
        out_tree_free(tree);
    }
    assert_true(count[1] < 0.6 * count[0] && count[1] > 0.1 * count[0]);
}

static void ferns_are_the_same_on_any_threads(void **state)
{
    (void)state;
    for (int surface = 0; surface < 2; surface++) {
        FrostParams params = small_ferns((FrostSurface)surface);
        OutTree *one = grow(&params, 1, 1.0f);
        for (int threads = 2; threads <= 3; threads++) {
            OutTree *more = grow(&params, threads, 1.0f);
            assert_true(out_tree_hash(one) == out_tree_hash(more));
            out_tree_free(more);
        }
        for (int64_t i = 0; surface == FROST_BUBBLE && i < one->count; i++) {
            assert_float_equal(vec3_length(one->position[i]), params.radius, 1e-5f * params.radius);
        }
        out_tree_free(one);
    }
}

static void nuclei_stand_where_they_should(void **state)
{
    (void)state;
    FrostParams params = small_params(FROST_PANE);
    for (int i = 0; i < 5; i++) {
        Vec3 normal, p = frost_nucleus(&params, i, 4, &normal);
        bool left_right = fabsf(fabsf(p.x) - 0.5f * params.width) < 1e-6f;
        bool above_below = fabsf(fabsf(p.y) - 0.5f * params.height) < 1e-6f;
        assert_true(left_right || above_below);
        assert_float_equal(normal.z, 1.0f, 0.0f);
    }
    FrostNucleus listed[2] = {{{0.1f, 0.05f, 3.0f}}, {{9.0f, 0.0f, 0.0f}}};
    params.nucleus = listed;
    params.nucleus_count = 2;
    OutTree *tree = grow(&params, 1, 0.0f);
    assert_int_equal(tree->count, 2);
    assert_float_equal(tree->position[0].x, 0.1f, 1e-7f);
    assert_float_equal(tree->position[0].z, 0.0f, 0.0f);
    assert_float_equal(tree->position[1].x, 0.5f * params.width, 1e-7f); // taken to the pane
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_leave_at_their_angle),
        cmocka_unit_test(orders_are_limited),
        cmocka_unit_test(skipped_sides_do_not_grow),
        cmocka_unit_test(crystals_do_not_cross),
        cmocka_unit_test(bubbles_stay_round),
        cmocka_unit_test(swirl_grows_with_the_turn),
        cmocka_unit_test(spines_sweep_more_with_the_turn),
        cmocka_unit_test(a_negative_turn_sweeps_the_other_way),
        cmocka_unit_test(growth_shows_from_the_nuclei),
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(ten_times_the_size_looks_the_same),
        cmocka_unit_test(blades_and_grains_are_closed),
        cmocka_unit_test(ferns_leave_at_their_angle_and_do_not_cross),
        cmocka_unit_test(ferns_leave_glass_clear),
        cmocka_unit_test(ferns_are_the_same_on_any_threads),
        cmocka_unit_test(nuclei_stand_where_they_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
