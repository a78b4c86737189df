// Leaf meshes: outlines have the wanted size and both sides are alike, teeth and lobes are as many
// as asked for, simpler forms keep the area, no quad is without area, needles are where they
// belong.
#include "mesh/leaf/blade.h"
#include "mesh/leaf/leaf.h"
#include "testing.h"

#include <math.h>

static double area(const Mesh *mesh, double *least)
{
    double sum = 0.0;
    *least = 1e30;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        Vec3 p[4];
        for (int k = 0; k < 4; k++) {
            p[k] = mesh->position[mesh->index[4 * f + k]];
        }
        Vec3 a = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
        Vec3 b = vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[0]));
        double own = 0.5 * (double)(vec3_length(a) + vec3_length(b));
        *least = own < *least ? own : *least;
        sum += own;
    }
    return sum;
}

static LeafParams flat(LeafShape shape, float length, float width)
{
    return (LeafParams){.shape = shape, .length = length, .width = width, .detail = 1};
}

// One of each form, at sizes of nature.
static int all_forms(LeafParams *form)
{
    int n = 0;
    for (int shape = LEAF_OAK; shape <= LEAF_PAD; shape++) {
        form[n] = flat((LeafShape)shape, 0.09f, 0.06f);
        form[n].lobes = shape == LEAF_PALMATE ? 5 : shape == LEAF_OAK ? 4 : 0;
        form[n].lobe_depth = 0.45f;
        form[n].fold = 12.0f;
        form[n].curl = 20.0f;
        form[n].wave = 0.04f;
        form[n].teeth = 12;
        form[n].tooth_depth = 0.04f;
        form[n++].petiole = 0.02f;
    }
    form[n] = flat(LEAF_OVATE, 0.3f, 0.2f);
    form[n].compound = COMPOUND_PINNATE;
    form[n++].leaflets = 11;
    form[n] = flat(LEAF_OVATE, 0.1f, 0.08f);
    form[n].compound = COMPOUND_BIPINNATE;
    form[n].leaflets = 14;
    form[n].leaflet_width = 0.01f;
    form[n++].leaflets_of_part = 24;
    form[n] = flat(LEAF_OBOVATE, 0.2f, 0.3f);
    form[n].compound = COMPOUND_PALMATE;
    form[n++].leaflets = 7;
    for (int shape = LEAF_NEEDLES; shape <= LEAF_SCALES; shape++) {
        form[n] = flat((LeafShape)shape, 0.02f, 0.0012f);
        form[n].needles = 64;
        form[n].shoot = shape == LEAF_TUFT ? 0.004f : 0.04f;
        form[n++].needle_angle = 55.0f;
    }
    form[n] = form[n - 3];
    form[n].shoot = 0.3f;
    form[n].needles = 400;
    form[n].curl = 20.0f;
    form[n++].side_shoots = 12;
    return n;
}

enum { MOST_FORMS = 20 };

static void no_quad_is_without_area(void **state)
{
    (void)state;
    LeafParams form[MOST_FORMS];
    for (int i = 0, n = all_forms(form); i < n; i++) {
        for (form[i].detail = 1; form[i].detail <= 2; form[i].detail++) {
            Mesh *mesh = leaf_mesh_new(&form[i], 7, NULL);
            assert_non_null(mesh);
            double least;
            double whole = area(mesh, &least);
            // of its mean share
            if (!(least > 1e-4 * whole / (double)mesh->face_count)) {
                fail_msg("form %d, detail %d: a quad of %g of %g m2", i, form[i].detail, least,
                         whole);
            }
            for (int64_t v = 0; v < mesh->vertex_count; v++) {
                assert_true(vec3_finite(mesh->position[v]) && vec3_finite(mesh->normal[v]));
                assert_true(mesh->uv[v].x >= 0.0f && mesh->uv[v].x <= 1.0f);
                assert_true(mesh->uv[v].y >= 0.0f && mesh->uv[v].y <= 1.0f);
            }
            mesh_free(mesh);
        }
    }
}

static void coarse_forms_keep_the_area_with_fewer_quads(void **state)
{
    (void)state;
    LeafParams form[MOST_FORMS];
    for (int i = 0, n = all_forms(form); i < n; i++) {
        form[i].petiole = 0.0f;
        Mesh *fine = leaf_mesh_new(&form[i], 7, NULL);
        double least, whole = area(fine, &least), before = (double)fine->face_count;
        for (int level = 0; level < leaf_coarse_levels(&form[i]); level++) {
            float error = 0.0f;
            Mesh *mesh = leaf_mesh_coarse(&form[i], 7, level, &error, NULL);
            assert_non_null(mesh);
            double ratio = area(mesh, &least) / whole;
            if (!(ratio > 0.85 && ratio < 1.12 && (double)mesh->face_count < 0.7 * before)) {
                fail_msg("form %d, level %d: %g of the area, %lld of %g quads", i, level, ratio,
                         (long long)mesh->face_count, before);
            }
            float size = 2.0f * form[i].length + form[i].width + form[i].shoot;
            if (!(error > 0.0f && error < 0.5f * size)) {
                fail_msg("form %d, level %d: an error of %g of %g m", i, level, (double)error,
                         (double)size);
            }
            before = (double)mesh->face_count;
            mesh_free(mesh);
        }
        mesh_free(fine);
    }
}

// Wide needles close gaps: the error is at least half the distance of a coarse needle's sides,
// whose quad begins and ends with one.
static void coarse_needles_are_off_by_half_their_width(void **state)
{
    (void)state;
    LeafParams form[MOST_FORMS];
    for (int i = 0, n = all_forms(form); i < n; i++) {
        for (int level = 0; form[i].shape == LEAF_NEEDLES && level < leaf_coarse_levels(&form[i]);
             level++) {
            float error = 0.0f, widest = 0.0f;
            Mesh *mesh = leaf_mesh_coarse(&form[i], 7, level, &error, NULL);
            assert_non_null(mesh);
            for (int64_t f = 0; f < mesh->face_count; f++) {
                const uint32_t *corner = mesh->index + 4 * f;
                widest = fmaxf(widest,
                               vec3_distance(mesh->position[corner[0]], mesh->position[corner[2]]));
            }
            assert_true(widest > 2.0f * form[i].width); // it is a coarse one
            assert_true(error > 0.499f * widest);
            mesh_free(mesh);
        }
    }
}

// A flat blade reaches from 0 to its length, and is as wide as asked for.
static void blades_have_the_size_asked_for(void **state)
{
    (void)state;
    for (int shape = LEAF_OAK; shape <= LEAF_FAN; shape++) {
        LeafParams form = flat((LeafShape)shape, 0.1f, 0.07f);
        form.detail = 2;
        form.lobes = shape == LEAF_PALMATE ? 5 : 0;
        form.lobe_depth = 0.4f;
        Mesh *mesh = leaf_mesh_new(&form, 3, NULL);
        Aabb box = mesh_bounds(mesh);
        double width = (double)(box.high.x - box.low.x), top = (double)box.high.y;
        if (!(width > 0.066 && width < 0.074 && top > 0.094 && top < 0.1003)) {
            fail_msg("shape %d: %g wide, %g long", shape, width, top);
        }
        mesh_free(mesh);
    }
}

// A flat pad is an ellipse about the end of its stalk, less a notch of up to 30 degrees to it.
static void pads_are_round_with_a_notch(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_PAD, 0.22f, 0.2f);
    for (uint64_t seed = 1; seed < 20; seed++) {
        for (form.detail = 1; form.detail <= 3; form.detail++) {
            Mesh *mesh = leaf_mesh_new(&form, seed, NULL);
            Aabb box = mesh_bounds(mesh);
            assert_true(box.high.x <= 0.1f && box.low.x >= -0.1f && box.high.y <= 0.11f);
            assert_true(box.high.x > 0.08f && box.low.x < -0.08f && box.high.y > 0.095f);
            double least, share = area(mesh, &least) / (3.14159265 * 0.1 * 0.11);
            assert_true(share > 0.75 && share < 0.96);
            for (int64_t v = 0; v < mesh->vertex_count; v++) {
                Vec3 p = mesh->position[v];
                bool notch = p.y < 0.0f && fabsf(p.x) < 0.008f * -p.y;
                assert_false(notch && p.y < -0.002f);
            }
            mesh_free(mesh);
        }
    }
}

// A pad's rim alone bends up, and no farther than an arc of that angle does.
static void rims_of_pads_turn_up(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_PAD, 0.2f, 0.2f);
    form.detail = 3;
    form.curl = 60.0f;
    Mesh *mesh = leaf_mesh_new(&form, 5, NULL);
    float highest = 0.0f;
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        Vec3 p = mesh->position[v];
        float lobe = 0.02f * form.width; // one side of the notch lies above the other
        bool inside = sqrtf(p.x * p.x + p.y * p.y) < 0.07f;
        assert_true(!inside || fabsf(p.z) < lobe);
        highest = fmaxf(highest, p.z);
    }
    assert_true(highest > 0.006f && highest < 0.016f);
    mesh_free(mesh);
}

// Closed form: the margin is widest where asked for, monotone to both ends, and 0 there.
static void margins_are_widest_where_they_should_be(void **state)
{
    (void)state;
    for (int shape = LEAF_OVATE; shape <= LEAF_RHOMBIC; shape++) {
        LeafParams form = flat((LeafShape)shape, 1.0f, 1.0f);
        for (form.widest = 0.2f; form.widest < 0.85f; form.widest += 0.3f) {
            assert_float_equal(blade_margin(&form, form.widest).x, 1.0f, 1e-6f);
            assert_float_equal(blade_margin(&form, 0.0f).x, 0.0f, 1e-6f);
            assert_float_equal(blade_margin(&form, 1.0f).x, 0.0f, 1e-6f);
            float before = 0.0f;
            for (int i = 1; i < 100; i++) {
                float s = 0.01f * (float)i, half = blade_margin(&form, s).x;
                assert_true(s < form.widest ? half >= before
                                            : half <= before + 1e-6f || s < form.widest + 0.011f);
                before = half;
            }
        }
    }
}

// Area of a blade without teeth: twice the integral of the margin (rows are straight).
static void an_ovate_blade_has_the_area_of_its_outline(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_OVATE, 0.1f, 0.06f);
    form.detail = 2;
    double sum = 0.0, least;
    enum { PIECES = 10000 };
    for (int i = 0; i < PIECES; i++) {
        sum += (double)blade_margin(&form, ((float)i + 0.5f) / PIECES).x / PIECES;
    }
    Mesh *mesh = leaf_mesh_new(&form, 1, NULL);
    double ratio = area(mesh, &least) / (0.1 * 0.06 * sum);
    assert_true(ratio > 0.97 && ratio < 1.03);
    mesh_free(mesh);
}

// Points of the margin farther out than both neighbours.
static int count_teeth(const Mesh *mesh, int columns, int side)
{
    int teeth = 0;
    int64_t rows = mesh->vertex_count / columns;
    for (int64_t r = 1; r + 1 < rows; r++) {
        float x[3];
        for (int k = 0; k < 3; k++) {
            int64_t v = (r + k - 1) * columns + (side < 0 ? 0 : columns - 1);
            x[k] = fabsf(mesh->position[v].x);
        }
        teeth += x[1] > x[0] && x[1] > x[2];
    }
    return teeth;
}

static void an_edge_has_as_many_teeth_as_asked_for(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_OVATE, 0.1f, 0.06f);
    form.detail = 2;
    form.teeth = 14;
    form.tooth_depth = 0.2f;
    Mesh *mesh = leaf_mesh_new(&form, 5, NULL);
    // Teeth fade at both ends of the edge.
    assert_in_range(count_teeth(mesh, 7, -1), 12, 14);
    assert_int_equal(count_teeth(mesh, 7, -1), count_teeth(mesh, 7, 1));
    mesh_free(mesh);
    form.detail = 3; // from near the edge bends between its teeth, too
    mesh = leaf_mesh_new(&form, 5, NULL);
    assert_in_range(count_teeth(mesh, 15, 1), 12, 14);
    assert_int_equal(mesh->vertex_count, 15 * (14 * 6 + 1));
    mesh_free(mesh);
}

// Leaflets that are components of the mesh: 11, and stalk and rachis.
static void a_pinnate_leaf_has_its_leaflets(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_OVATE, 0.3f, 0.2f);
    form.compound = COMPOUND_PINNATE;
    MeshTopology topology;
    for (form.leaflets = 3; form.leaflets < 40; form.leaflets += 9) {
        Mesh *mesh = leaf_mesh_new(&form, 5, NULL);
        assert_true(mesh_topology(mesh, &topology, NULL));
        assert_int_equal(topology.component_count, form.leaflets + 1);
        Aabb box = mesh_bounds(mesh);
        assert_in_range((int)(1000.0f * box.high.y), 260, 330);
        assert_in_range((int)(1000.0f * (box.high.x - box.low.x)), 170, 220);
        mesh_free(mesh);
    }
}

static void needles_stand_on_their_shoot(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_NEEDLES, 0.02f, 0.001f);
    form.needles = 100;
    form.shoot = 0.05f;
    form.needle_angle = 60.0f;
    for (int combed = 0; combed < 2; combed++) {
        form.comb = (float)combed;
        Mesh *mesh = leaf_mesh_new(&form, 9, NULL);
        MeshTopology topology;
        assert_true(mesh_topology(mesh, &topology, NULL));
        assert_int_equal(topology.component_count, 100);
        Aabb box = mesh_bounds(mesh);
        assert_true(box.low.y > -0.002f && box.high.y < 0.073f);
        assert_true(box.high.x > 0.012f && box.low.x < -0.012f);
        float thick = box.high.z - box.low.z;
        assert_true(combed ? thick < 0.012f : thick > 0.026f);
        mesh_free(mesh);
    }
}

// The tip of every shoot is this year's, in the fine mesh as in coarse ones; without flush no mesh
// has ages.
static void needles_at_the_tip_are_young(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_NEEDLES, 0.004f, 0.001f);
    form.needles = 200;
    form.shoot = 0.1f;
    form.needle_angle = 90.0f;
    form.flush = 0.3f;
    float error;
    for (int coarse = 0; coarse < 2; coarse++) {
        Mesh *mesh =
            coarse ? leaf_mesh_coarse(&form, 9, 0, &error, NULL) : leaf_mesh_new(&form, 9, NULL);
        int64_t young = 0, old = 0;
        assert_non_null(mesh->young);
        for (int64_t v = 0; v < mesh->vertex_count; v++) {
            float y = mesh->position[v].y;
            assert_true(y < 0.068f ? mesh->young[v] < 0.26f : true);
            assert_true(y > 0.072f ? mesh->young[v] > 0.74f : true);
            young += mesh->young[v] > 0.5f;
            old += mesh->young[v] < 0.5f;
        }
        assert_in_range(100 * young / (young + old), 24, 36);
        mesh_free(mesh);
    }
    form.flush = 0.0f;
    Mesh *mesh = leaf_mesh_new(&form, 9, NULL);
    assert_null(mesh->young);
    mesh_free(mesh);
}

static void wear_takes_area_away(void **state)
{
    (void)state;
    LeafParams form = flat(LEAF_OVATE, 0.1f, 0.06f);
    form.detail = 2;
    double whole = 0.0, worn = 0.0, least;
    for (uint64_t seed = 0; seed < 30; seed++) {
        for (int i = 0; i < 2; i++) {
            form.wear = (float)i;
            Mesh *mesh = leaf_mesh_new(&form, seed, NULL);
            *(i ? &worn : &whole) += area(mesh, &least);
            mesh_free(mesh);
        }
    }
    assert_true(worn < 0.985 * whole && worn > 0.6 * whole);
}

// Largest turn of the right margin from one row to the next, degrees; not at the blade's two ends.
static double sharpest_turn(const Mesh *mesh, int columns)
{
    int rows = (int)(mesh->vertex_count / columns);
    double sharpest = 0.0;
    for (int r = 3; r + 4 < rows; r++) {
        Vec3 p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = mesh->position[(r + k) * columns - 1];
        }
        Vec3 a = vec3_normalize(vec3_sub(p[1], p[0])), b = vec3_normalize(vec3_sub(p[2], p[1]));
        double turn =
            (double)acosf(clampf(vec3_dot(a, b), -1.0f, 1.0f)) / (double)RADIANS_PER_DEGREE;
        sharpest = turn > sharpest ? turn : sharpest;
    }
    return sharpest;
}

static void close_margins_have_no_corners(void **state)
{
    (void)state;
    enum { CLOSE_COLUMNS = 15, FINE_COLUMNS = 7 };
    LeafParams form = flat(LEAF_OVATE, 0.1f, 0.06f);
    double least;
    form.detail = 3;
    Mesh *close = leaf_mesh_new(&form, 5, NULL);
    form.detail = 2;
    Mesh *fine = leaf_mesh_new(&form, 5, NULL);
    assert_non_null(close);
    assert_non_null(fine);
    double turn = sharpest_turn(close, CLOSE_COLUMNS);
    assert_true(turn < 4.5);
    assert_true(sharpest_turn(fine, FINE_COLUMNS) > 2.0 * turn);
    assert_true(fabs(area(close, &least) / area(fine, &least) - 1.0) < 0.03);
    mesh_free(close);
    mesh_free(fine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_quad_is_without_area),
        cmocka_unit_test(coarse_forms_keep_the_area_with_fewer_quads),
        cmocka_unit_test(coarse_needles_are_off_by_half_their_width),
        cmocka_unit_test(blades_have_the_size_asked_for),
        cmocka_unit_test(pads_are_round_with_a_notch),
        cmocka_unit_test(rims_of_pads_turn_up),
        cmocka_unit_test(margins_are_widest_where_they_should_be),
        cmocka_unit_test(an_ovate_blade_has_the_area_of_its_outline),
        cmocka_unit_test(an_edge_has_as_many_teeth_as_asked_for),
        cmocka_unit_test(a_pinnate_leaf_has_its_leaflets),
        cmocka_unit_test(needles_stand_on_their_shoot),
        cmocka_unit_test(needles_at_the_tip_are_young),
        cmocka_unit_test(wear_takes_area_away),
        cmocka_unit_test(close_margins_have_no_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
