// Corals: forms, territory, crusts, corallites; and that size changes nothing but the size.
#include "making.h"
#include "objects/coral/coral.h"
#include "objects/coral/crust.h"
#include "objects/coral/cup.h"
#include "objects/coral/polyps.h"
#include "testing.h"

#include "base/random.h"
#include "outtree/join.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static OutTree *grow(const CoralParams *params, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *tree = grow_kind(&kind_coral, params,
                              &(Recipe){.seed = 7, .label = "coral", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static CoralParams small(CoralForm form)
{
    CoralParams params = coral_params_default();
    params.form = form;
    params.levels = 1;
    params.generations = 5;
    return params;
}

static Geometry geometry_of(const CoralParams *params, const OutTree *tree, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Geometry geometry = {0};
    Recipe recipe = {.seed = 7, .label = "coral", .run = &run};
    Placing placing = placing_in(&geometry, &recipe);
    placing.material++; // from 1 on
    Grown grown = grown_of(tree);
    if (!coral_geometry(params, &grown, &placing, &e)) {
        fail_msg("%s", e.message);
    }
    return geometry;
}

static void every_form_grows(void **state)
{
    (void)state;
    for (CoralForm form = CORAL_BRANCHING; form <= CORAL_MASSIVE; form++) {
        CoralParams params = small(form);
        OutTree *tree = grow(&params, 1);
        Aabb box = out_tree_bounds(tree);
        assert_true(tree->count > 100);
        assert_true(box.high.x - box.low.x < 1.3f * params.size);
        if (form == CORAL_FAN) {
            assert_true(box.low.z == box.high.z); // flat
        } else {
            assert_true(box.high.z - box.low.z > 0.3f * params.size);
        }
        for (int64_t i = 0; i < tree->count; i++) {
            assert_true(tree->radius[i] > 0.0f);
        }
        out_tree_free(tree);
    }
}

static void ten_times_the_size_is_the_same_coral(void **state)
{
    (void)state;
    for (CoralForm form = CORAL_BRANCHING; form <= CORAL_FAN; form++) {
        CoralParams params = small(form);
        OutTree *one = grow(&params, 1);
        params.size *= 8.0f; // a power of two: roundings are the same
        OutTree *eight = grow(&params, 1);
        assert_int_equal(one->count, eight->count);
        for (int64_t i = 0; i < one->count; i++) {
            Vec3 scaled = vec3_scale(one->position[i], 8.0f);
            assert_true(vec3_distance(scaled, eight->position[i]) < 0.02f * params.size);
            assert_int_equal(one->parent[i], eight->parent[i]);
        }
        out_tree_free(one);
        out_tree_free(eight);
    }
}

static void threads_change_nothing(void **state)
{
    (void)state;
    for (CoralForm form = CORAL_BRANCHING; form <= CORAL_ENCRUSTING; form++) {
        CoralParams params = small(form);
        params.colonies = 2;
        OutTree *tree = grow(&params, 1);
        for (int threads = 2; threads <= 3; threads++) {
            OutTree *other = grow(&params, threads);
            assert_true(out_tree_hash(tree) == out_tree_hash(other));
            out_tree_free(other);
        }
        out_tree_free(tree);
    }
}

static void branches_are_as_thick_as_madracis(void **state)
{
    (void)state;
    CoralParams params = coral_params_default();
    OutTree *tree = grow(&params, 1);
    CoralMeasures m;
    assert_true(coral_measure(tree, &m, NULL));
    assert_true(m.branch_thickness > 0.007 && m.branch_thickness < 0.025);
    assert_true(m.branch_spacing > m.branch_thickness); // room between them
    assert_true(isnan(m.seam));
    out_tree_free(tree);
}

static void colonies_leave_a_bare_seam(void **state)
{
    (void)state;
    CoralParams params = small(CORAL_ENCRUSTING);
    params.colonies = 3;
    params.generations = 9;
    OutTree *tree = grow(&params, 1);
    CrustParams crust = {.thickness = 0.01f,
                         .reach = 0.05f,
                         .seam = 0.006f,
                         .pale = 0.02f,
                         .lump = 0.05f,
                         .seed = 4};
    int seams = 0, covered = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        covered += crust_at(tree, &crust, tree->position[i]).height > 0.0f;
        for (int64_t k = 0; k < i; k++) { // half-way between neighbours of two colonies
            if (tree->colony[i] != tree->colony[k] &&
                vec3_distance(tree->position[i], tree->position[k]) < 0.03f) {
                Vec3 middle = vec3_lerp(tree->position[i], tree->position[k], 0.5f);
                CrustPoint point = crust_at(tree, &crust, middle);
                assert_true(point.height < 0.0f);
                assert_float_equal(point.margin, 1.0f, 1e-6f);
                seams++;
            }
        }
    }
    assert_true(seams > 0);
    assert_true(covered > tree->count * 8 / 10);
    out_tree_free(tree);
}

// What of a form's growth shows early is the same later on.
static void growth_in_progress_is_a_part_of_the_whole(void **state)
{
    (void)state;
    CoralParams params = small(CORAL_BRANCHING);
    Run run = run_default();
    OutTree *whole = grow(&params, 1);
    OutTree *half = grow_kind(&kind_coral, &params,
                              &(Recipe){.seed = 7, .label = "coral", .run = &run}, 0.5f, NULL);
    assert_true(half->count > 10 && half->count < whole->count);
    assert_memory_equal(half->position, whole->position, (size_t)half->count * sizeof(Vec3));
    out_tree_free(whole);
    out_tree_free(half);
}

// Cups by their frames.
typedef struct Cups {
    Transform frame[6000];
    int64_t count;
} Cups;

static void take_cups(const CoralParams *params, const OutTree *tree, Cups *cups)
{
    Geometry geometry = geometry_of(params, tree, 1);
    cups->count = 0;
    for (int64_t i = 0; i < geometry.count; i++) {
        const Part *part = &geometry.part[i];
        for (int64_t k = 0; k < part->instance_count && part->material == 2; k++) {
            assert_true(cups->count < 6000);
            cups->frame[cups->count++] = part->instance[k];
        }
    }
    geometry_clear(&geometry);
}

static float least_distance(const Cups *cups)
{
    float least = INFINITY;
    for (int64_t i = 0; i < cups->count; i++) {
        Vec3 p = transform_point(&cups->frame[i], vec3(0, 0, 0));
        for (int64_t k = 0; k < i; k++) {
            Vec3 other = transform_point(&cups->frame[k], vec3(0, 0, 0));
            least = fminf(least, vec3_distance(p, other));
        }
    }
    return least;
}

static void cups_keep_their_distance_and_lean_to_the_tip(void **state)
{
    (void)state;
    static Cups cups;
    CoralParams params = small(CORAL_BRANCHING);
    params.generations = 2;
    params.polyps.max_count = 2000;
    OutTree *tree = grow(&params, 1);
    take_cups(&params, tree, &cups);
    assert_true(cups.count > 500 && cups.count < 2000);
    float spacing = coral_params_resolve(&params).polyps.spacing;
    assert_true(least_distance(&cups) > 0.999f * spacing);
    out_tree_free(tree);
}

// Cups are added between the others, at most 0.6 of their size, and none of the others moves.
static void small_cups_fill_gaps(void **state)
{
    (void)state;
    static Cups few, many;
    CoralParams params = small(CORAL_BRANCHING);
    params.generations = 2;
    params.polyps.shape = POLYP_NOSE;
    params.polyps.max_count = 5000;
    OutTree *tree = grow(&params, 1);
    take_cups(&params, tree, &few);
    params.polyps.fill = 1.0f;
    take_cups(&params, tree, &many);
    CoralParams p = coral_params_resolve(&params);
    assert_true(many.count > few.count + few.count / 3);
    assert_true(least_distance(&many) > 0.57f * p.polyps.spacing);
    int64_t kept = 0, small_ones = 0;
    for (int64_t i = 0; i < many.count; i++) {
        float size = vec3_length(transform_vector(&many.frame[i], vec3(1, 0, 0)));
        small_ones += size < 0.65f * p.polyps.diameter;
        for (int64_t k = 0; k < few.count; k++) {
            kept += memcmp(&many.frame[i], &few.frame[k], sizeof few.frame[k]) == 0;
        }
    }
    assert_int_equal(kept, few.count);
    assert_true(small_ones >= many.count - few.count);
    out_tree_free(tree);
}

// With a taper, branches are thinnest at their tips and nowhere thicker than nearer to the root.
static void branches_taper_to_their_tips(void **state)
{
    (void)state;
    CoralParams params = small(CORAL_BRANCHING);
    OutTree *plain = grow(&params, 1);
    params.taper = 0.1f;
    OutTree *tapered = grow(&params, 1);
    float tip_radius = coral_params_resolve(&params).tip_radius;
    bool *bears = calloc((size_t)tapered->count, sizeof *bears);
    int thinner = 0;
    for (int64_t i = tapered->count - 1; i >= 0; i--) {
        int32_t parent = tapered->parent[i];
        thinner += tapered->radius[i] < 0.9f * plain->radius[i];
        assert_true(bears[i] || tapered->radius[i] < 0.5f * tip_radius);
        assert_true(parent < 0 || tapered->radius[i] < tapered->radius[parent] * 1.0001f);
        if (parent >= 0) {
            bears[parent] = true;
        }
    }
    assert_true(thinner > 100);
    assert_true(tapered->radius[0] == plain->radius[0]); // far from all tips
    free(bears);
    out_tree_free(plain);
    out_tree_free(tapered);
}

static int64_t loops_of(const OutTree *tree)
{
    int64_t pieces, loops;
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    return loops;
}

// Fans and plates become nets where tips fuse, more so with bridges; the skin of a net has no part
// outside the room of its branches, however many of them leave one place.
static void fused_branches_are_a_net(void **state)
{
    (void)state;
    for (CoralForm form = CORAL_TABLE; form <= CORAL_FAN; form++) {
        CoralParams params = small(form);
        params.rule = CORAL_MEAN;
        params.attractors = 4000;
        params.length = params.length_tip = 0.02f * params.size;
        params.branchlet = 0.03f * params.size;
        params.levels = 0;
        OutTree *apart = grow(&params, 1);
        params.fuse = 0.03f * params.size;
        OutTree *fused = grow(&params, 1);
        params.bridge = 0.04f * params.size;
        OutTree *net = grow(&params, 2);
        assert_int_equal(loops_of(apart), 0);
        assert_true(loops_of(fused) > 20);
        assert_true(loops_of(net) > loops_of(fused) + 20);
        Geometry geometry = geometry_of(&params, net, 1);
        Aabb room = out_tree_bounds(net), skin = mesh_bounds(geometry.part[0].mesh);
        float thick = 0.0f;
        for (int64_t i = 0; i < net->count; i++) {
            thick = fmaxf(thick, net->radius[i]);
        }
        assert_true(skin.low.x > room.low.x - 2.0f * thick);
        assert_true(skin.high.x < room.high.x + 2.0f * thick);
        assert_true(skin.high.y < room.high.y + 2.0f * thick);
        geometry_clear(&geometry);
        out_tree_free(apart);
        out_tree_free(fused);
        out_tree_free(net);
    }
}

// A table's stalk stands off the middle of its plate by a share of half the size.
static void a_stalk_may_stand_aside(void **state)
{
    (void)state;
    CoralParams params = small(CORAL_TABLE);
    params.rule = CORAL_MEAN;
    for (int aside = 0; aside < 2; aside++) {
        params.eccentric = 0.5f * (float)aside;
        OutTree *tree = grow(&params, 1);
        Aabb box = out_tree_bounds(tree);
        Vec3 middle = vec3_lerp(box.low, box.high, 0.5f);
        float off = hypotf(middle.x - params.position.x, middle.z - params.position.z);
        assert_float_equal(off, 0.25f * (float)aside * params.size, 0.06f * params.size);
        out_tree_free(tree);
    }
}

// A level plate stays in a slab; an uneven one leaves it and does not fill its disc.
static void a_plate_may_be_uneven(void **state)
{
    (void)state;
    double height[2], filled[2];
    for (int uneven = 0; uneven < 2; uneven++) {
        CoralParams params = small(CORAL_TABLE);
        params.rule = CORAL_MEAN;
        params.plate = 0.01f * params.size;
        params.branchlet = 0.01f * params.size;
        params.uneven = (float)uneven;
        OutTree *tree = grow(&params, 1);
        double sum = 0.0, squares = 0.0;
        int64_t count = 0, outside = 0;
        for (int64_t i = 0; i < tree->count; i++) {
            if (tree->birth[i] == 0) {
                continue;
            }
            double y = (double)(tree->position[i].y / params.size);
            sum += y;
            squares += y * y;
            count++;
            outside += hypotf(tree->position[i].x, tree->position[i].z) > 0.45f * params.size;
        }
        height[uneven] = sqrt(squares / (double)count - sum * sum / (double)(count * count));
        filled[uneven] = (double)outside / (double)count;
        out_tree_free(tree);
    }
    assert_true(height[0] < 0.008);
    assert_true(height[1] > 2.0 * height[0]);
    assert_true(filled[1] < 0.8 * filled[0]);
}

// How far a fan grows toward each of six sides, as shares of its outline's half ellipse.
static void reach_of_fan(const OutTree *tree, const CoralParams *params, float reach[6])
{
    CoralParams p = coral_params_resolve(params);
    memset(reach, 0, 6 * sizeof reach[0]);
    for (int64_t i = 0; i < tree->count; i++) {
        float x = tree->position[i].x / (0.5f * p.size), y = tree->position[i].y / p.height;
        int side = (int)(6.0f * atan2f(y, x) / PI_F);
        if (side >= 0 && side < 6) {
            reach[side] = fmaxf(reach[side], hypotf(x, y));
        }
    }
}

// A plain fan fills half an ellipse in a plane; an uneven one leaves the plane, but not at its
// foot, and reaches less far to some sides.
static void a_fan_may_be_uneven(void **state)
{
    (void)state;
    float away[2] = {0.0f}, least[2] = {1.0f, 1.0f};
    for (int uneven = 0; uneven < 2; uneven++) {
        CoralParams params = small(CORAL_FAN);
        params.rule = CORAL_MEAN;
        params.length = params.length_tip = 0.03f * params.size;
        params.uneven = (float)uneven;
        OutTree *tree = grow(&params, 1);
        float reach[6];
        reach_of_fan(tree, &params, reach);
        for (int side = 0; side < 6; side++) {
            assert_true(reach[side] < 1.0f + 0.06f / 0.8f); // one step beyond, upward
            least[uneven] = fminf(least[uneven], reach[side]);
        }
        for (int64_t i = 0; i < tree->count; i++) {
            float z = fabsf(tree->position[i].z) / params.size;
            assert_true(z < 0.03f || tree->position[i].y > 0.1f * params.size);
            away[uneven] = fmaxf(away[uneven], z);
        }
        out_tree_free(tree);
    }
    assert_true(away[0] == 0.0f);
    assert_true(away[1] > 0.02f && away[1] < 0.2f);
    assert_true(least[0] > 0.9f);
    assert_true(least[1] < 0.8f);
}

static void a_cup_is_open_and_faces_outward(void **state)
{
    (void)state;
    Mesh *cup = polyp_cup(0.8f, 0.5f, NULL);
    MeshTopology topology;
    assert_true(mesh_topology(cup, &topology, NULL));
    assert_int_equal(topology.open_edges, 10); // its foot, in the branch
    assert_int_equal(topology.misoriented_edges + topology.overused_edges, 0);
    for (int64_t i = 0; i < 10; i++) { // the outer wall
        Vec3 p = cup->position[i], n = cup->normal[i];
        assert_true(p.x * n.x + p.z * n.z > 0.0f);
    }
    mesh_free(cup);
}

// A cup bends toward -z, its lip is longer on the outer side, no two are alike, and tentacles
// are pieces of their own that reach beyond the mouth.
static void a_nose_bends_to_the_tip(void **state)
{
    (void)state;
    NoseCup plain = {.height = 1.2f, .lean = 50.0f, .oblique = 0.3f, .flare = 1.0f, .youth = 0.3f};
    NoseCup around = plain, other = plain, out = plain, straight = plain;
    straight.lean = 0.0f;
    around.girth = 3.0f;
    other.seed = 2;
    out.reach = 0.8f;
    Mesh *cup = polyp_nose(&plain, NULL), *second = polyp_nose(&other, NULL);
    Mesh *bent = polyp_nose(&around, NULL), *polyp = polyp_nose(&out, NULL);
    Mesh *upright = polyp_nose(&straight, NULL);
    MeshTopology topology;
    assert_true(mesh_topology(cup, &topology, NULL));
    assert_int_equal(topology.open_edges, 36); // its foot, in the branch
    assert_int_equal(topology.misoriented_edges + topology.overused_edges, 0);
    assert_true(mesh_topology(polyp, &topology, NULL));
    assert_int_equal(topology.open_edges, 36 + 12 * 6);
    assert_int_equal(topology.component_count, 13);
    assert_int_equal(topology.misoriented_edges + topology.overused_edges, 0);
    assert_true(mesh_bounds(polyp).high.y > mesh_bounds(cup).high.y + 0.1f);
    enum { LIP = 10 * 36, INNER = LIP + 9, OUTER = LIP + 27 };
    Vec3 inner = cup->position[INNER], outer = cup->position[OUTER];
    assert_true(0.5f * (inner.z + outer.z) < -0.3f);
    inner = upright->position[INNER], outer = upright->position[OUTER];
    assert_float_equal(outer.y - inner.y, plain.oblique * plain.height, 0.15f);
    assert_float_equal(inner.z + outer.z, 0.0f, 0.1f);
    float apart = 0.0f;
    for (int64_t i = LIP; i < LIP + 36; i++) {
        apart = fmaxf(apart, vec3_distance(cup->position[i], second->position[i]));
    }
    assert_true(apart > 0.02f);
    // around a branch its foot sinks at the sides and nowhere else
    assert_true(bent->position[0].y < cup->position[0].y - 0.1f);
    assert_true(bent->position[9].y == cup->position[9].y);
    for (int64_t i = 0; i < 36; i++) {
        assert_true(cup->normal[i].y > 0.5f); // it leaves along the skin
    }
    mesh_free(cup);
    mesh_free(second);
    mesh_free(bent);
    mesh_free(polyp);
    mesh_free(upright);
}

static void a_wrong_rule_is_one_clear_error(void **state)
{
    (void)state;
    CoralParams params = small(CORAL_BRANCHING);
    params.rules = "X -> [+FX";
    Run run = run_default();
    Error e = {0};
    assert_null(grow_kind(&kind_coral, &params,
                          &(Recipe){.seed = 7, .label = "object 'reef'", .run = &run}, 1.0f, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.message, "the L-system's rules, line 1, column 10: '[' is "
                                   "not closed; put a ']' for each '['");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_grows),
        cmocka_unit_test(ten_times_the_size_is_the_same_coral),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(branches_are_as_thick_as_madracis),
        cmocka_unit_test(colonies_leave_a_bare_seam),
        cmocka_unit_test(growth_in_progress_is_a_part_of_the_whole),
        cmocka_unit_test(cups_keep_their_distance_and_lean_to_the_tip),
        cmocka_unit_test(small_cups_fill_gaps),
        cmocka_unit_test(branches_taper_to_their_tips),
        cmocka_unit_test(fused_branches_are_a_net),
        cmocka_unit_test(a_stalk_may_stand_aside),
        cmocka_unit_test(a_plate_may_be_uneven),
        cmocka_unit_test(a_fan_may_be_uneven),
        cmocka_unit_test(a_cup_is_open_and_faces_outward),
        cmocka_unit_test(a_nose_bends_to_the_tip),
        cmocka_unit_test(a_wrong_rule_is_one_clear_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
