// Settled snow: as deep as it should be on a level branch, none on steep or bare ones, closed
// pillows on boughs that face outward and bridge gaps, less of it below what catches it.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/snow/snow_bed.h"
#include "objects/common/snow_fall.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 41 };

#define LENGTH 1.2f
#define RADIUS 0.03f
#define DEPTH 0.05f

static float everywhere(const void *user, Vec3 p)
{
    (void)p;
    return user ? *(const float *)user : 1.0f;
}

static const SnowReach OPEN = {everywhere, NULL};

// A straight branch from the origin.
static CurveSet *branch(Vec3 direction, float radius)
{
    CurveSet *curves = curves_new(POINTS, 1, NULL);
    assert_non_null(curves);
    for (int i = 0; i < POINTS; i++) {
        curves->position[i] = vec3_scale(direction, LENGTH * (float)i / (POINTS - 1));
        curves->radius[i] = radius;
        curves->birth[i] = curves->along[i] = 0.0f;
    }
    curves->id[0] = 7;
    curves->first[0] = 0;
    curves->first[1] = POINTS;
    return curves;
}

static Mesh *snow_on(Vec3 direction, float radius, SnowParams params, const bool *bare)
{
    Run run = run_default();
    CurveSet *curves = branch(direction, radius);
    Mesh *mesh = snow_on_curves(curves, bare, &params, &OPEN, &run, NULL);
    assert_non_null(mesh);
    curves_free(curves);
    return mesh;
}

static double mean_top(const Mesh *mesh)
{
    double sum = 0.0;
    int count = 0;
    for (int64_t i = 3; i < mesh->vertex_count; i += 8) { // beside the top of each ring
        sum += (double)mesh->position[i].y;
        count++;
    }
    return sum / count;
}

// Lumps have a mean of nearly 0, so the mean depth is that of the formula.
static void a_level_branch_bears_its_depth(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 55.0f};
    Mesh *mesh = snow_on(vec3(1, 0, 0), RADIUS, params, NULL);
    double width = 2.0 * (double)RADIUS + 0.003;
    double depth = (double)DEPTH * (1.0 - exp(-1.7 * width / (double)DEPTH));
    double low = 0.2 * (double)RADIUS, top = (double)RADIUS + depth;
    assert_true(fabs(mean_top(mesh) - (low + 0.97 * (top - low))) < 0.15 * depth);
    Aabb box = mesh_bounds(mesh);
    assert_true(fabsf(box.low.z + box.high.z) < 1e-5f); // as far to one side as to the other
    mesh_free(mesh);
}

static void thin_twigs_bear_less(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 55.0f};
    double before = 0.0;
    for (float radius = 0.002f; radius < 0.03f; radius *= 3.0f) {
        Mesh *mesh = snow_on(vec3(0, 0, 1), radius, params, NULL);
        double depth = mean_top(mesh) - (double)radius;
        assert_true(depth > before && depth < 1.4 * (double)DEPTH);
        before = depth;
        mesh_free(mesh);
    }
}

static void steep_and_bare_branches_bear_none(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 50.0f};
    const bool bare = true;
    for (int degrees = 0; degrees <= 90; degrees += 10) {
        float sine, cosine;
        exact_sincos((float)degrees * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 direction = vec3(cosine, sine, 0);
        Mesh *mesh = snow_on(direction, RADIUS, params, NULL);
        assert_int_equal(mesh->face_count > 0, degrees < 50);
        mesh_free(mesh);
        mesh = snow_on(direction, RADIUS, params, &bare);
        assert_int_equal(mesh->face_count, 0);
        mesh_free(mesh);
    }
    assert_true(snow_stays(&params, 1.0f) == 1.0f && snow_stays(&params, 0.0f) == 0.0f);
}

// With gaps, cushions end inside the branch: every open edge is below its surface.
static void cushions_end_inside_the_branch(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 50.0f, .gaps = 0.5f};
    Mesh *mesh = snow_on(vec3(1, 0, 0), RADIUS, params, NULL);
    Mesh *whole =
        snow_on(vec3(1, 0, 0), RADIUS, (SnowParams){.depth = DEPTH, .steepest = 50.0f}, NULL);
    assert_true(mesh->face_count > 0 && mesh->face_count < whole->face_count);
    int used[4096] = {0};
    assert_true(mesh->vertex_count < 4096);
    for (int64_t i = 0; i < 4 * mesh->face_count; i++) {
        used[mesh->index[i]]++;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        bool at_branch_end = p.x < 0.05f || p.x > LENGTH - 0.05f;
        if (used[i] == 2 && !at_branch_end) { // of the first or last ring of a cushion
            assert_true(sqrtf(p.y * p.y + p.z * p.z) < RADIUS);
        }
    }
    mesh_free(mesh);
    mesh_free(whole);
}

// The closed form on a strip of half width w at x from its middle.
static double strip_thickness(double depth, double w, double x)
{
    double length = depth / sqrt(2.0);
    return depth * sqrt(1.0 - cosh(x / length) / cosh(w / length));
}

// A bed whose outline is a strip along x of half width w about z = 0.
static SnowBed strip_bed(float w, float cell)
{
    SnowBed bed = {.across = 60, .along = 61, .cell = cell, .low_z = -30.0f * cell};
    int64_t count = (int64_t)bed.across * bed.along;
    bed.height = calloc((size_t)count, sizeof(float));
    bed.outline = calloc((size_t)count, sizeof(float));
    bed.share = calloc((size_t)count, sizeof(float));
    assert_true(bed.height && bed.outline && bed.share);
    for (int64_t i = 0; i < count; i++) {
        int64_t row = i / bed.across;
        float z = bed.low_z + cell * (float)row;
        bool end = i % bed.across == 0 || i % bed.across == bed.across - 1;
        bed.outline[i] = end ? -cell : w - fabsf(z);
        bed.share[i] = 1.0f;
    }
    return bed;
}

// Compared as squares, which the equation solves: at the outline the thickness is steep.
static void thickness_is_that_of_the_closed_form(void **state)
{
    (void)state;
    const float cell = 0.3f * DEPTH, width[] = {0.021f, 0.0517f, 0.09f, 0.22f};
    double most = (double)DEPTH * (double)DEPTH;
    for (int k = 0; k < 4; k++) {
        SnowBed bed = strip_bed(width[k], cell);
        float *thick = snow_thickness(&bed, DEPTH, NULL);
        assert_non_null(thick);
        for (int z = 0; z < bed.along; z++) {
            double x = (double)(bed.low_z + cell * (float)z), w = (double)width[k];
            double expected = fabs(x) < w ? strip_thickness((double)DEPTH, w, x) : 0.0;
            double found = (double)thick[z * bed.across + bed.across / 2];
            assert_true(fabs(found * found - expected * expected) < 0.03 * most);
        }
        free(thick);
        snow_bed_clear(&bed);
    }
}

typedef struct Bearers {
    SnowBearer *bearer;
    int64_t count;
} Bearers;

// Bearers on a level rectangle whose middle is at `middle`, closer than the cells of any bed.
static void add_sheet(Bearers *to, Vec3 middle, float size_x, float size_z, float slope)
{
    const float step = 0.004f;
    int across = (int)(size_x / step), along = (int)(size_z / step);
    to->bearer = realloc(to->bearer, (size_t)(to->count + across * along) * sizeof *to->bearer);
    assert_non_null(to->bearer);
    for (int i = 0; i < across * along; i++) {
        int column = i % across, row = i / across;
        float x = step * ((float)column - 0.5f * (float)(across - 1));
        float z = step * ((float)row - 0.5f * (float)(along - 1));
        to->bearer[to->count++] =
            (SnowBearer){vec3(middle.x + x, middle.y + slope * x, middle.z + z), step * step};
    }
}

// The snow on the bearers, which are freed.
static Mesh *pillows(Bearers on, SnowParams params, const SnowReach *reach)
{
    SnowPile pile = {0};
    assert_true(snow_add_pillows(&pile, on.bearer, on.count, &params, reach, 5, NULL));
    Mesh *mesh = snow_pile_mesh(&pile, NULL);
    assert_non_null(mesh);
    snow_pile_clear(&pile);
    free(on.bearer);
    return mesh;
}

static double volume(const Mesh *mesh)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + 3 * f;
        Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]];
        sum += (double)vec3_dot(a, vec3_cross(b, mesh->position[corner[2]])) / 6.0;
    }
    return sum;
}

static int64_t bodies(const Mesh *mesh)
{
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, NULL));
    assert_int_equal(topology.open_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.degenerate_faces, 0);
    return topology.component_count;
}

static SnowParams calm(float depth, float gaps, float bridging)
{
    return (SnowParams){.depth = depth, .steepest = 55.0f, .gaps = gaps, .bridging = bridging};
}

// A comb of twigs with gaps, one twig far below the others.
static Bearers comb(void)
{
    Bearers on = {0};
    add_sheet(&on, vec3(0, 1, 0), 0.6f, 0.03f, 0.2f);
    for (int i = 0; i < 5; i++) {
        add_sheet(&on, vec3(-0.24f + 0.12f * (float)i, 1, 0), 0.02f, 0.5f, 0.0f);
    }
    add_sheet(&on, vec3(0, 0.5f, 0.02f), 0.3f, 0.3f, 0.0f);
    return on;
}

static void pillows_are_closed_and_face_outward(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        int wide = k / 2;
        float gaps = 0.3f * (float)(k % 2), bridging = 0.05f * (float)wide;
        Mesh *mesh = pillows(comb(), calm(DEPTH, gaps, bridging), &OPEN);
        assert_true(bodies(mesh) >= 2); // the lower twig bears its own
        uint8_t *closed = malloc((size_t)mesh->face_count);
        assert_non_null(closed);
        assert_true(mesh_closed_faces(mesh, closed, NULL));
        for (int64_t f = 0; f < mesh->face_count; f++) {
            assert_true(closed[f]);
        }
        for (int64_t i = 0; i < mesh->vertex_count; i++) {
            assert_true(vec3_finite(mesh->position[i]) && vec3_finite(mesh->normal[i]));
        }
        free(closed);
        mesh_free(mesh);
    }
}

static void deeper_snow_has_more_volume(void **state)
{
    (void)state;
    double before = 0.0;
    for (int k = 0; k < 6; k++) {
        const float depth[] = {0.02f, 0.03f, 0.045f, 0.07f, 0.1f, 0.15f};
        Mesh *mesh = pillows(comb(), calm(depth[k], 0.0f, 0.1f), &OPEN);
        double here = volume(mesh);
        assert_true(here > before);
        before = here;
        mesh_free(mesh);
    }
    float half = 0.5f;
    Mesh *mesh = pillows(comb(), calm(0.15f, 0.0f, 0.1f), &(SnowReach){everywhere, &half});
    assert_true(volume(mesh) < 0.7 * before); // below other boughs
    mesh_free(mesh);
}

// Two twigs 0.1 m apart.
static void snow_spans_what_it_can_bridge(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Bearers on = {0};
        add_sheet(&on, vec3(0, 0, -0.08f), 0.5f, 0.06f, 0.0f);
        add_sheet(&on, vec3(0, 0, 0.08f), 0.5f, 0.06f, 0.0f);
        Mesh *mesh = pillows(on, calm(0.03f, 0.0f, k == 0 ? 0.08f : 0.12f), &OPEN);
        assert_int_equal(bodies(mesh), k == 0 ? 2 : 1);
        mesh_free(mesh);
    }
}

// A wide level sheet bears the depth and its lumps; its rim hangs over by less than the depth.
static void a_level_sheet_bears_its_depth(void **state)
{
    (void)state;
    Bearers on = {0};
    add_sheet(&on, vec3(0, 1, 0), 0.6f, 0.6f, 0.0f);
    Mesh *mesh = pillows(on, calm(DEPTH, 0.0f, 0.1f), &OPEN);
    Aabb box = mesh_bounds(mesh);
    assert_true(box.high.y > 1.0f + DEPTH && box.high.y < 1.0f + 1.6f * DEPTH);
    assert_true(box.high.x > 0.29f && box.high.x < 0.3f + 0.5f * DEPTH);
    double mean = volume(mesh) / (0.36 * (double)DEPTH); // above and, by a quarter, below
    assert_true(mean > 1.0 && mean < 1.4);
    mesh_free(mesh);
}

// Variance (m2) of the upper side's heights well inside of its rim.
static double unevenness_of(const Mesh *mesh)
{
    double sum = 0.0, squares = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        if (mesh->normal[i].y > 0.0f && fabsf(p.x) < 0.15f && fabsf(p.z) < 0.15f) {
            sum += (double)p.y;
            squares += (double)p.y * (double)p.y;
            count++;
        }
    }
    return squares / (double)count - sum * sum / ((double)count * (double)count);
}

// Area (m2) of a closed mesh without overhangs seen from above.
static double footprint(const Mesh *mesh)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + 3 * f;
        Vec3 a = mesh->position[corner[0]];
        Vec3 across = vec3_cross(vec3_sub(mesh->position[corner[1]], a),
                                 vec3_sub(mesh->position[corner[2]], a));
        sum += 0.25 * (double)fabsf(across.y);
    }
    return sum;
}

// Frayed pillows are closed, too, reach no further out than smooth ones and have bays in their
// rims; they are uneven and yet of much the same depth.
static void frayed_snow_is_uneven_with_bays_in_its_rim(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        const float depth[] = {0.05f, 0.12f, 0.6f};
        double area[2], uneven[2], mean[2];
        for (int frayed = 0; frayed < 2; frayed++) {
            Bearers on = {0};
            add_sheet(&on, vec3(0, 1, 0), 0.6f, 0.6f, 0.0f);
            SnowParams params = calm(depth[k], 0.0f, 0.1f);
            params.fray = (float)frayed;
            Mesh *mesh = pillows(on, params, &OPEN);
            assert_true(bodies(mesh) >= 1);
            for (int64_t i = 0; i < mesh->vertex_count; i++) {
                assert_true(vec3_finite(mesh->position[i]) && vec3_finite(mesh->normal[i]));
            }
            area[frayed] = footprint(mesh);
            uneven[frayed] = unevenness_of(mesh);
            mean[frayed] = volume(mesh) / area[frayed];
            assert_true(mesh_bounds(mesh).high.x < 0.33f + 0.16f * depth[k]);
            mesh_free(mesh);
        }
        print_message("depth %.2f: area %.2f, variance %.1f, mean depth %.2f of the smooth one's\n",
                      (double)depth[k], area[1] / area[0], uneven[1] / uneven[0],
                      mean[1] / mean[0]);
        assert_true(area[1] > 0.75 * area[0] && area[1] < 0.98 * area[0]);
        assert_true(uneven[1] > 1.3 * uneven[0]);
        assert_true(mean[1] > 0.8 * mean[0] && mean[1] < 1.25 * mean[0]);
    }
}

// The crumbs on the bearers, which are freed. *volume: of the pillows beside them.
static SnowCrumbs crumbs_on(Bearers on, SnowParams params, const SnowReach *reach, double *body)
{
    SnowPile pile = {0};
    assert_true(snow_add_pillows(&pile, on.bearer, on.count, &params, reach, 5, NULL));
    Mesh *mesh = snow_pile_mesh(&pile, NULL);
    assert_non_null(mesh);
    *body = volume(mesh);
    mesh_free(mesh);
    SnowCrumbs crumbs = pile.crumbs;
    pile.crumbs = (SnowCrumbs){0};
    snow_pile_clear(&pile);
    free(on.bearer);
    return crumbs;
}

// A level sheet bears a pillow, with crumbs at its rim alone; one so steep that pillows slide off
// bears crumbs all over. Crumbs change no pillow, and where no snow comes there are none.
static void crumbs_lie_beside_pillows(void **state)
{
    (void)state;
    const float half = 0.3f, size = 0.02f;
    SnowParams params = calm(DEPTH, 0.0f, 0.05f), with = params;
    with.crumbs = size;
    int64_t count[2];
    for (int k = 0; k < 2; k++) {
        double body[2];
        float slope = k == 0 ? 0.0f : 2.5f; // 68 degrees
        Bearers on = {0}, same = {0};
        add_sheet(&on, vec3(0, 1, 0), 2.0f * half, 2.0f * half, slope);
        add_sheet(&same, vec3(0, 1, 0), 2.0f * half, 2.0f * half, slope);
        SnowCrumbs none = crumbs_on(same, params, &OPEN, &body[0]);
        SnowCrumbs all = crumbs_on(on, with, &OPEN, &body[1]);
        assert_int_equal(none.count, 0);
        assert_true(body[0] == body[1] && (body[0] > 0.0) == (k == 0));
        int64_t inner = 0;
        for (int64_t i = 0; i < all.count; i++) {
            SnowCrumb c = all.crumb[i];
            assert_true(c.radius > 0.0f && c.radius <= 0.5f * size);
            float off = c.p.y - (1.0f + slope * c.p.x); // above the sheet
            assert_true(off > 0.0f && off < c.radius);
            inner += fmaxf(fabsf(c.p.x), fabsf(c.p.z)) < half - 1.5f * DEPTH;
        }
        assert_true(k == 0 ? inner == 0 : inner > 100);
        count[k] = all.count;
        free(all.crumb);
    }
    assert_true(count[1] > count[0]);
    float nothing = 0.0f;
    double body;
    SnowCrumbs none = crumbs_on(comb(), with, &(SnowReach){everywhere, &nothing}, &body);
    assert_int_equal(none.count, 0);
    free(none.crumb);
}

// Needles here and there, high up, without bridges: every rim stays near the needles about it.
static void scattered_needles_bear_no_spikes(void **state)
{
    (void)state;
    const float high = 12.0f, depth = 0.08f;
    for (uint64_t bough = 0; bough < 8; bough++) {
        Bearers on = {0};
        for (uint64_t i = 0; i < 300; i++) {
            uint64_t key = random_key(random_key(1, bough), i);
            float x = random_range(random_key(key, 1), -0.5f, 0.5f);
            float z = random_range(random_key(key, 2), -0.5f, 0.5f);
            add_sheet(&on, vec3(x, high + 0.1f * x, z), 0.03f, 0.02f, 0.0f);
        }
        Mesh *mesh = pillows(on, calm(depth, 0.2f, 0.0f), &OPEN);
        Aabb box = mesh_bounds(mesh);
        assert_true(mesh->face_count > 0);
        assert_true(box.low.y > high - 0.2f && box.high.y < high + 0.3f);
        mesh_free(mesh);
    }
}

static void steep_and_sheltered_boughs_bear_none(void **state)
{
    (void)state;
    float none = 0.0f;
    for (int k = 0; k < 3; k++) {
        Bearers on = {0};
        if (k < 2) {
            add_sheet(&on, vec3(0, 0, 0), 0.3f, 0.3f, k == 0 ? 1.6f : 0.0f);
        }
        SnowReach reach = {everywhere, k == 1 ? &none : NULL};
        Mesh *mesh = pillows(on, calm(DEPTH, 0.0f, 0.1f), &reach);
        assert_int_equal(mesh->face_count, 0);
        mesh_free(mesh);
    }
}

// Three layers that catch half of what they cover, above a place and beside it.
static void layers_above_keep_snow_off(void **state)
{
    (void)state;
    SnowFall fall;
    Aabb bounds = {vec3(0, 0, 0), vec3(8, 8, 8)};
    assert_true(snow_fall_init(&fall, bounds, NULL));
    float cell = fall.cells.size, area = cell * cell;
    Vec3 low = vec3(2.1f, 1.0f, 3.1f), beside = vec3(5.0f, 1.0f, 3.1f);
    for (int i = 0; i < 3; i++) {
        snow_fall_add(&fall, vec3(low.x, 3.0f + (float)i, low.z), area);
    }
    snow_fall_finish(&fall);
    assert_true(fabs((double)snow_fall_share(&fall, low) - (0.2 + 0.8 * exp(-1.5))) < 1e-5);
    assert_true(fabs((double)snow_fall_share(&fall, vec3(low.x, 7.0f, low.z)) - (1.0)) < 1e-6);
    assert_true(fabs((double)snow_fall_share(&fall, beside) - (1.0)) < 1e-6);
    assert_true(snow_fall_share(&fall, vec3(-50, 90, 50)) <= 1.0f); // beyond the bounds
    snow_fall_free(&fall);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_branch_bears_its_depth),
        cmocka_unit_test(thin_twigs_bear_less),
        cmocka_unit_test(steep_and_bare_branches_bear_none),
        cmocka_unit_test(cushions_end_inside_the_branch),
        cmocka_unit_test(thickness_is_that_of_the_closed_form),
        cmocka_unit_test(pillows_are_closed_and_face_outward),
        cmocka_unit_test(deeper_snow_has_more_volume),
        cmocka_unit_test(snow_spans_what_it_can_bridge),
        cmocka_unit_test(a_level_sheet_bears_its_depth),
        cmocka_unit_test(frayed_snow_is_uneven_with_bays_in_its_rim),
        cmocka_unit_test(crumbs_lie_beside_pillows),
        cmocka_unit_test(scattered_needles_bear_no_spikes),
        cmocka_unit_test(steep_and_sheltered_boughs_bear_none),
        cmocka_unit_test(layers_above_keep_snow_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
