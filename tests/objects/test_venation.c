// Leaves: veins with radii, geometry of blade and veins, the texture.
#include "making.h"
#include "testing.h"

#include "objects/venation/blade_grid.h"
#include "objects/venation/blade_wave.h"
#include "objects/venation/margin_hairs.h"
#include "objects/venation/vein_curves.h"
#include "objects/venation/vein_hairs.h"
#include "objects/venation/venation.h"

#include <math.h>
#include <stdlib.h>

static OutTree *grow(const VenationParams *params)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 3, .label = "leaf", .run = &run};
    OutTree *tree = grow_kind(&kind_venation, params, &recipe, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static VenationParams small_params(void)
{
    VenationParams params = venation_params_default();
    params.detail = 25;
    return params;
}

static void a_leaf_has_a_blade_and_a_curve_for_each_piece_of_vein(void **state)
{
    (void)state;
    VenationParams params = small_params();
    OutTree *tree = grow(&params);
    assert_float_equal(tree->radius[0], 0.008f * params.outline.length, 1e-6);
    Geometry geometry = {0};
    Error e = {0};
    Placing placing = placing_in(&geometry, NULL);
    Grown grown = grown_of(tree);
    assert_true(venation_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 2);
    const CurveSet *veins = geometry.part[0].curves;
    assert_int_equal(veins->curve_count, tree->count - 1);
    assert_int_equal(veins->first[veins->curve_count], veins->point_count);
    Aabb blade = mesh_bounds(geometry.part[1].mesh);
    for (int64_t i = 0; i < veins->point_count; i++) { // in the blade, but for the petiole
        assert_true(veins->position[i].x > blade.low.x - 1e-3f);
        assert_true(veins->position[i].x < blade.high.x + 1e-3f);
        assert_true(veins->position[i].y < blade.high.y + 1e-3f);
    }
    geometry_clear(&geometry);
    params.blade = false;
    assert_true(venation_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 1);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static CurveSet *curves_of(const OutTree *tree, const VenationParams *params)
{
    Transform place = transform_compose(vec3(0, 0, 0), vec3(0, 0, 0), vec3_splat(1.0f));
    Error e = {0};
    Relief flat = {.params = params};
    CurveSet *curves = venation_curves(tree, params, &flat, &place, &e);
    assert_non_null(curves);
    return curves;
}

// Sum of squared turns between pieces that follow each other, and of steps in their radii.
static void count_roughness(const OutTree *tree, const CurveSet *curves, double *turns,
                            double *steps)
{
    int64_t *piece = malloc(sizeof *piece * (size_t)tree->count), number = 0;
    *turns = *steps = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        piece[i] = parent >= 0 ? number++ : -1;
        bool only = parent >= 0 && piece[parent] >= 0 && tree->radius[i] == tree->radius[parent];
        const Vec3 *p = curves->position;
        if (only) {
            int64_t a = 2 * piece[parent], b = 2 * piece[i];
            Vec3 before = vec3_normalize(vec3_sub(p[a + 1], p[a]));
            Vec3 after = vec3_normalize(vec3_sub(p[b + 1], p[b]));
            *turns += 1.0 - (double)vec3_dot(before, after);
        }
        if (parent >= 0 && tree->radius[i] > 0.8f * tree->radius[parent]) { // goes on
            *steps += fabs((double)curves->radius[2 * piece[i]] / (double)tree->radius[parent] - 1);
        }
    }
    free(piece);
}

static void smoothing_rounds_bends_and_keeps_joins(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.curl = params.fold = 0.0f;
    OutTree *tree = grow(&params);
    CurveSet *rough = curves_of(tree, &params);
    params.smoothing = 3;
    CurveSet *smooth = curves_of(tree, &params);
    double turns[2], steps[2];
    count_roughness(tree, rough, &turns[0], &steps[0]);
    count_roughness(tree, smooth, &turns[1], &steps[1]);
    assert_true(turns[0] > 0.0 && turns[1] < 0.8 * turns[0]);
    assert_true(steps[0] > 0.0 && steps[1] < 0.5 * steps[0]);
    int64_t joins = 0;
    for (int64_t i = 1; i < rough->point_count; i += 2) { // a tip that met another stays there
        for (int64_t j = 1; j < i; j += 2) {
            bool meet = vec3_distance(rough->position[i], rough->position[j]) == 0.0f;
            assert_true(!meet || vec3_distance(smooth->position[i], smooth->position[j]) == 0.0f);
            joins += meet;
        }
    }
    assert_true(joins > 20);
    curves_free(rough);
    curves_free(smooth);
    out_tree_free(tree);
}

static void the_texture_shows_the_midrib_in_the_middle(void **state)
{
    (void)state;
    VenationParams params = small_params();
    OutTree *tree = grow(&params);
    enum { WIDTH = 64, HEIGHT = 128 };
    float *pixel = malloc(sizeof *pixel * WIDTH * HEIGHT), dark = 0.0f;
    assert_true(venation_paint(&params, tree, WIDTH, HEIGHT, pixel, NULL));
    for (int row = HEIGHT / 4; row < HEIGHT; row++) {
        assert_true(pixel[row * WIDTH + WIDTH / 2] > 0.05f);
        for (int column = 0; column < WIDTH; column++) {
            float value = pixel[row * WIDTH + column];
            assert_true(value >= 0.0f && value <= 1.0f);
            dark += value == 0.0f;
        }
    }
    assert_true(dark > 0.4f * WIDTH * HEIGHT * 3 / 4); // and blade between the veins
    free(pixel);
    out_tree_free(tree);
}

static double measured(const OutTree *tree, const VenationParams *params, const char *name)
{
    MeasureList list = {0};
    Grown grown = grown_of(tree);
    assert_true(venation_measure(params, &grown, NULL, &list, NULL));
    double value = measures_find(&list, name)->value;
    measures_clear(&list);
    return value;
}

static void the_net_is_measured_against_the_blade(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.outline = (LeafOutline){.length = 0.1f, .width = 0.06f, .widest = 0.5f, .tip = 1.0f};
    double ellipse = M_PI / 4.0 * 100.0 * 60.0; // mm^2
    OutTree *net = grow(&params);
    double areoles = measured(net, &params, "areoles");
    assert_true(areoles > 20.0);
    assert_true(fabs(measured(net, &params, "areole_area") * areoles / ellipse - 1.0) < 1e-3);
    params.closed = false;
    OutTree *open = grow(&params);
    assert_true(measured(open, &params, "areoles") == 0.0);
    assert_true(isnan(measured(open, &params, "areole_area")));
    double length = 0.0;
    for (int64_t i = 1; i < open->count; i++) {
        length += (double)vec3_distance(open->position[i], open->position[open->parent[i]]);
    }
    length = 1000.0 * (length - (double)params.petiole);
    assert_true(fabs(measured(open, &params, "vein_density") * ellipse / length - 1.0) < 1e-3);
    out_tree_free(net);
    out_tree_free(open);
}

// The midrib lies at the bottom of its furrow, all the relief deep, and so does the blade above it;
// half an areole beside the net's finest veins the blade is hardly lower than without relief.
static void the_blade_bulges_between_veins(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.relief = 0.0008f;
    params.curl = params.fold = 0.0f;
    OutTree *tree = grow(&params);
    VenationParams full = venation_params_resolve(&params);
    Relief relief;
    Error e = {0};
    assert_true(relief_init(&relief, &full, tree, &e));
    Transform place = transform_identity();
    Mesh *blade = venation_blade(&full, &relief, &place, &e);
    assert_non_null(blade);
    float low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < blade->vertex_count; i++) {
        Vec3 p = blade->position[i];
        assert_true(p.z <= 0.0f && p.z >= -params.relief);
        if (p.y > 0.004f && p.y < 0.01f && fabsf(p.x) < 0.0002f) {
            low = fminf(low, p.z);
        }
        high = fmaxf(high, p.z);
    }
    assert_true(low < -0.9f * params.relief);
    assert_true(high > -0.02f * params.relief);
    float root = relief_at(&relief, vec3(0, 0.005f, 0));
    assert_true(root < -0.9f * params.relief);
    assert_true(relief_at(&relief, vec3(0, -0.01f, 0)) == 0.0f); // the stalk
    mesh_free(blade);
    relief_clear(&relief);
    out_tree_free(tree);
}

// Embedded veins have no curves, and thicker ones sink in as they taper; where they run, the blade
// is paler than anywhere in an areole, and areoles differ, but not by much.
static void thin_veins_lie_in_the_blade(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.embedded = 0.0003f;
    OutTree *tree = grow(&params);
    VenationParams full = venation_params_resolve(&params);
    int64_t thick = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        thick += tree->parent[i] >= 0 && tree->radius[i] >= full.embedded;
    }
    CurveSet *curves = curves_of(tree, &full);
    assert_int_equal(curves->curve_count, thick);
    assert_true(thick > 0 && thick < tree->count - 1);
    float thinnest = INFINITY; // where a tube sinks into the blade
    for (int64_t i = 0; i < curves->point_count; i++) {
        thinnest = fminf(thinnest, curves->radius[i]);
    }
    assert_true(thinnest > 0.0f && thinnest < 0.4f * full.embedded);
    Relief relief;
    Error e = {0};
    assert_true(relief_init(&relief, &full, tree, &e));
    Transform place = transform_identity();
    Mesh *blade = venation_blade(&full, &relief, &place, &e);
    assert_non_null(blade);
    assert_non_null(blade->young);
    int64_t veins = 0, greenest = 0, paler = 0;
    for (int64_t i = 0; i < blade->vertex_count; i++) {
        float young = blade->young[i];
        assert_true(young >= 0.0f && young <= 1.0f);
        veins += young > 0.5f;
        greenest += young < 0.1f;
        paler += young > 0.2f && young < 0.3f;
    }
    assert_true(veins > blade->vertex_count / 50 && veins < blade->vertex_count / 2);
    assert_true(greenest > blade->vertex_count / 20 && paler > blade->vertex_count / 20);
    mesh_free(blade);
    curves_free(curves);
    relief_clear(&relief);
    out_tree_free(tree);
}

// A worn leaf as it has grown, flat.
typedef struct WornLeaf {
    OutTree *tree;
    VenationParams params;
    Relief relief;
    Mesh *blade;
} WornLeaf;

static void worn_leaf_init(WornLeaf *leaf, VenationParams params)
{
    params.curl = params.fold = 0.0f;
    leaf->tree = grow(&params);
    leaf->params = venation_params_of(&params, leaf->tree);
    Error e = {0};
    Transform place = transform_identity();
    assert_true(relief_init(&leaf->relief, &leaf->params, leaf->tree, &e));
    leaf->blade = venation_blade(&leaf->params, &leaf->relief, &place, &e);
    assert_non_null(leaf->blade);
}

static void worn_leaf_clear(WornLeaf *leaf)
{
    mesh_free(leaf->blade);
    relief_clear(&leaf->relief);
    out_tree_free(leaf->tree);
}

static double mesh_area(const Mesh *mesh)
{
    double area = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 4 * f;
        Vec3 d = vec3_sub(mesh->position[c[2]], mesh->position[c[0]]);
        Vec3 g = vec3_sub(mesh->position[c[3]], mesh->position[c[1]]);
        area += 0.5 * (double)vec3_length(vec3_cross(d, g));
    }
    return area;
}

// Area that is within the margin and not eaten, by samples.
static double sampled_area(const WornLeaf *leaf, double *eaten)
{
    const float step = 1e-4f;
    double area = 0.0;
    *eaten = 0.0;
    for (float y = 0.0f; y < 0.1f; y += step) {
        for (float x = -0.04f; x < 0.04f; x += step) {
            Vec3 p = vec3(x, y, 0);
            bool within = leaf_contains(&leaf->params.outline, 1.0f, p);
            bool gone = within && blade_wear_depth(&leaf->relief.wear, p) > 0.0f;
            area += within && !gone ? (double)(step * step) : 0.0;
            *eaten += gone ? (double)(step * step) : 0.0;
        }
    }
    return area;
}

// The blade ends at its toothed margin and at the rims of its holes; every vertex is of a face.
static void a_worn_blade_is_what_teeth_and_holes_leave(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.detail = 100, params.closed = false; // fine enough a mesh
    params.outline.teeth = 30, params.outline.uneven = 1.0f;
    params.wear = 1.0f;
    WornLeaf leaf;
    worn_leaf_init(&leaf, params);
    double eaten, area = sampled_area(&leaf, &eaten);
    assert_true(leaf.relief.wear.holes > 8);
    assert_true(eaten > 0.01 * area && eaten < 0.3 * area);
    assert_true(fabs(mesh_area(leaf.blade) / area - 1.0) < 0.004);
    bool *used = calloc((size_t)leaf.blade->vertex_count, sizeof *used);
    for (int64_t i = 0; i < 4 * leaf.blade->face_count; i++) {
        used[leaf.blade->index[i]] = true;
    }
    for (int64_t i = 0; i < leaf.blade->vertex_count; i++) {
        Vec3 p = leaf.blade->position[i];
        float edge = leaf_margin(&leaf.params.outline, p.x < 0.0f ? -1.0f : 1.0f, p.y);
        assert_true(used[i]);
        assert_true(blade_wear_depth(&leaf.relief.wear, p) < 1e-5f);
        assert_true(fabsf(p.x) < edge + 4e-4f); // rims at the margin may lean out by a face
    }
    free(used);
    Transform place = transform_identity();
    Error e = {0};
    CurveSet *veins = venation_curves(leaf.tree, &leaf.params, &leaf.relief, &place, &e);
    assert_true(veins->curve_count < leaf.tree->count - 1);
    for (int64_t i = 0; i < veins->point_count; i++) { // none hangs in a hole
        assert_true(blade_wear_depth(&leaf.relief.wear, veins->position[i]) == 0.0f);
    }
    for (int64_t i = 0; i < leaf.tree->count; i++) { // thick ones are whole
        assert_true(leaf.tree->radius[i] < 0.25f * leaf.params.midrib ||
                    blade_wear_depth(&leaf.relief.wear, leaf.tree->position[i]) == 0.0f);
    }
    curves_free(veins);
    worn_leaf_clear(&leaf);
}

// Rims of holes are dry, tissue far from them green; spots are few, and none without their key.
static void rims_of_holes_are_dead_and_the_rest_is_green(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.detail = 100, params.closed = false;
    params.wear = 0.6f;
    WornLeaf leaf;
    worn_leaf_init(&leaf, params);
    const BladeWear *wear = &leaf.relief.wear;
    assert_non_null(leaf.blade->withered);
    double rim = 0.0, far = 0.0;
    int rims = 0;
    for (int64_t i = 0; i < leaf.blade->vertex_count; i++) {
        float nearest = INFINITY;
        for (int h = 0; h < wear->holes; h++) {
            float away = vec3_distance(leaf.blade->position[i], wear->hole[h].center);
            nearest = fminf(nearest, away - 1.5f * wear->hole[h].radius - 2.6f * wear->hole[h].rim);
        }
        far = fmax(far, nearest > 0.0005f ? (double)leaf.blade->withered[i] : 0.0);
        Vec3 in = leaf.blade->position[i];
        for (int h = 0; h < wear->holes; h++) { // is a tenth of a millimetre in, eaten?
            Vec3 way = vec3_normalize(vec3_sub(wear->hole[h].center, in));
            if (blade_wear_depth(wear, vec3_madd(in, 1e-4f, way)) > 0.00005f) {
                rim += (double)leaf.blade->withered[i];
                rims++;
            }
        }
    }
    assert_true(far == 0.0);
    assert_true(rims > 50 && rim / rims > 0.7);
    worn_leaf_clear(&leaf);
    params.wear = 0.0f, params.spots = 1.0f;
    worn_leaf_init(&leaf, params);
    int64_t dead = 0, yellow = 0, n = leaf.blade->vertex_count;
    for (int64_t i = 0; i < n; i++) {
        float withered = leaf.blade->withered[i];
        assert_true(withered >= 0.0f && withered <= 1.0f);
        dead += withered > 0.6f;
        yellow += withered > 0.1f && withered < 0.5f;
    }
    assert_true(leaf.relief.wear.holes == 0);
    assert_true(dead > 0 && dead < n / 15 && yellow > n / 50 && yellow < n * 3 / 5);
    worn_leaf_clear(&leaf);
    worn_leaf_init(&leaf, small_params());
    assert_null(leaf.blade->withered);
    worn_leaf_clear(&leaf);
}

// The grid has the rows it is given, about as wide as high, whatever the detail.
static void rows_set_the_grid_of_the_blade(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.rows = 300;
    WornLeaf leaf;
    worn_leaf_init(&leaf, params);
    assert_int_equal(leaf.relief.height, 300);
    assert_in_range(leaf.relief.width, 150, 160); // half as wide as long
    assert_int_equal(leaf.blade->vertex_count, 301 * (leaf.relief.width + 1));
    worn_leaf_clear(&leaf);
    params.rows = 2000; // above what the detail would ever take
    worn_leaf_init(&leaf, params);
    assert_int_equal(leaf.relief.height, 2000);
    worn_leaf_clear(&leaf);
}

// The stalk stands out, whatever lies in the blade.
static void the_stalk_stands_out(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.embedded = 1.0f;
    VenationParams full = venation_params_resolve(&params);
    assert_float_equal(full.embedded, 0.95f * full.midrib, 1e-9);
    OutTree *tree = grow(&params);
    CurveSet *curves = curves_of(tree, &full);
    assert_true(curves->curve_count > 0);
    assert_true(curves->radius[0] > 0.3f * full.midrib);
    curves_free(curves);
    out_tree_free(tree);
}

static void waves_rise_from_the_midrib_to_the_margin(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.wave = 0.002f;
    WornLeaf leaf;
    worn_leaf_init(&leaf, params);
    float low = 0.0f, high = 0.0f, steepest = 0.0f;
    int turns = 0, way = 0;
    float before = 0.0f;
    for (float y = 0.0f; y < 0.1f; y += 5e-5f) {
        assert_true(relief_at(&leaf.relief, vec3(0, y, 0)) == 0.0f);
        float z = relief_at(&leaf.relief, vec3(leaf_half_width(&leaf.params.outline, y), y, 0));
        low = fminf(low, z), high = fmaxf(high, z);
        steepest = fmaxf(steepest, fabsf(z - before) / 5e-5f);
        int now = z > before ? 1 : -1;
        turns += now != way, way = now, before = z;
    }
    assert_true(high > 0.25f * params.wave && high < 1.5f * params.wave);
    assert_true(low < -0.25f * params.wave && low > -1.5f * params.wave);
    assert_true(turns > 8 && turns < 40);
    assert_true(steepest < 2.0f); // no folds
    assert_true(blade_wave(&leaf.params, vec3(0, -0.01f, 0)) == 0.0f);
    worn_leaf_clear(&leaf);
}

// Hairs stand on the margin of the flat leaf, where it is whole, and lead out of it to the tip.
static void hairs_fringe_the_margin(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.outline.teeth = 12, params.outline.uneven = 1.0f;
    params.wear = 1.0f, params.hairs = 0.001f;
    WornLeaf leaf;
    worn_leaf_init(&leaf, params);
    const LeafOutline *outline = &leaf.params.outline;
    Transform place = transform_identity();
    Error e = {0};
    CurveSet *hairs = margin_hairs(&leaf.params, &leaf.relief, &place, &e);
    assert_non_null(hairs);
    int64_t left = 0, outside = 0, forward = 0, n = hairs->curve_count;
    assert_int_equal(hairs->first[n], hairs->point_count);
    for (int64_t i = 0; i < n; i++) {
        int64_t foot = hairs->first[i], end = hairs->first[i + 1] - 1;
        Vec3 a = hairs->position[foot], b = hairs->position[end];
        float edge = leaf_margin(outline, a.x < 0.0f ? -1.0f : 1.0f, a.y);
        assert_true(fabsf(fabsf(a.x) - edge) < 1e-6f);
        assert_true(blade_wear_depth(&leaf.relief.wear, a) == 0.0f);
        float reach = vec3_distance(a, b);
        assert_true(reach > 0.25f * params.hairs && reach < 2.0f * params.hairs);
        assert_true(hairs->radius[foot] > hairs->radius[end] && hairs->radius[end] > 0.0f);
        left += a.x < 0.0f;
        outside += !leaf_contains(outline, 1.0f, vec3(b.x, b.y, 0));
        forward += b.y > a.y;
    }
    // 2 x 0.1 m / 0.4 mm, but for what is eaten
    assert_true(n > 300 && n < 500 && left > n * 2 / 5 && left < n * 3 / 5);
    assert_true(outside > n * 9 / 10 && forward > n * 3 / 4);
    curves_free(hairs);
    worn_leaf_clear(&leaf);
}

// They stay on the margin of a blade that is wavy, folded and bent; without a blade there are none.
static void hairs_bend_with_the_blade(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.hairs = 0.001f, params.wave = 0.003f, params.fold = 30.0f, params.curl = 60.0f;
    OutTree *tree = grow(&params);
    Geometry geometry = {0};
    Error e = {0};
    Placing placing = placing_in(&geometry, NULL);
    Grown grown = grown_of(tree);
    assert_true(venation_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 3);
    const Mesh *blade = geometry.part[1].mesh;
    const CurveSet *hairs = geometry.part[2].curves;
    for (int64_t i = 0; i < hairs->curve_count; i++) {
        float nearest = 1.0f;
        for (int64_t v = 0; v < blade->vertex_count; v++) {
            Vec3 foot = hairs->position[hairs->first[i]];
            nearest = fminf(nearest, vec3_distance(foot, blade->position[v]));
        }
        assert_true(nearest < 0.0006f); // rows are 0.625 mm apart
    }
    geometry_clear(&geometry);
    params.blade = false;
    assert_true(venation_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 1);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

// Mean of a picture of the blade at the nodes of veins from `low` to `high` shares of the midrib.
static double mean_at_veins(const WornLeaf *leaf, const float *pixel, float low, float high)
{
    const LeafOutline *outline = &leaf->params.outline;
    double sum = 0.0, count = 0.0;
    for (int64_t i = 0; i < leaf->tree->count; i++) {
        Vec3 p = leaf->tree->position[i];
        float share = leaf->tree->radius[i] / leaf->params.midrib;
        if (p.y < 0.2f * outline->length || p.y > 0.8f * outline->length || share < low ||
            share > high) {
            continue;
        }
        BladeRow row = blade_row(outline, p.y);
        float width = (float)leaf->relief.width, height = (float)leaf->relief.height;
        int c = (int)fminf(blade_row_column(&row, p.x) * width, width - 1.0f);
        int r = (int)((1.0f - p.y / outline->length) * height);
        sum += (double)pixel[r * leaf->relief.width + c];
        count += 1.0;
    }
    assert_true(count > 5.0);
    return sum / count;
}

// Thick veins keep their green, the margin dies, and no leaf of later autumn is greener anywhere.
static void autumn_goes_last_along_thick_veins(void **state)
{
    (void)state;
    const float autumn[4] = {0.2f, 0.5f, 0.7f, 1.0f};
    float *before = NULL;
    for (int k = 0; k < 4; k++) {
        VenationParams params = small_params();
        params.secondaries = 6, params.vein = 0.00002f, params.autumn = autumn[k];
        WornLeaf leaf;
        worn_leaf_init(&leaf, params);
        const float *withered = leaf.relief.withered;
        int width = leaf.relief.width, size = width * leaf.relief.height;
        double mean = 0.0, edge = 0.0;
        for (int i = 0; i < size; i++) {
            assert_true(withered[i] >= 0.0f && withered[i] <= 1.0f);
            assert_true(!before || withered[i] >= before[i] - 1e-6f);
            mean += (double)withered[i] / size;
            edge += i % width == 0 ? (double)withered[i] / leaf.relief.height : 0.0;
        }
        double thick = mean_at_veins(&leaf, withered, 0.35f, 1.0f);
        double thin = mean_at_veins(&leaf, withered, 0.0f, 0.1f);
        if (autumn[k] == 0.5f) {
            assert_true(thick < 0.35 * thin && thin > 0.5 * (double)MESH_YELLOW);
            assert_true(edge > 1.1 * mean);
        }
        if (autumn[k] == 1.0f) {
            assert_true(thick > 0.9 * (double)MESH_YELLOW && edge > 0.9);
        }
        free(before);
        before = leaf.relief.withered;
        leaf.relief.withered = NULL;
        worn_leaf_clear(&leaf);
    }
    free(before);
}

static float distance_to_piece(const OutTree *tree, int64_t node, Vec3 p)
{
    Vec3 a = tree->position[tree->parent[node]], way = vec3_sub(tree->position[node], a);
    float length2 = vec3_dot(way, way);
    float t = length2 > 0.0f ? vec3_dot(vec3_sub(p, a), way) / length2 : 0.0f;
    return vec3_distance(p, vec3_madd(a, clampf(t, 0.0f, 1.0f), way));
}

// Hairs stand on the veins that stand out, about as many as their length asks for, on the front.
static void hairs_stand_on_thick_veins(void **state)
{
    (void)state;
    VenationParams params = small_params();
    params.secondaries = 6, params.vein = 0.00002f, params.embedded = 0.0002f;
    params.wear = 1.0f;
    params.vein_hairs = 0.0006f;
    WornLeaf leaf;
    worn_leaf_init(&leaf, params);
    const OutTree *tree = leaf.tree;
    Transform place = transform_identity();
    Error e = {0};
    CurveSet *hairs = vein_hairs(tree, &leaf.params, &leaf.relief, &place, &e);
    assert_non_null(hairs);
    assert_int_equal(hairs->first[hairs->curve_count], hairs->point_count);
    double way = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        bool bears = tree->position[i].y > 0.0f && tree->radius[i] >= leaf.params.embedded &&
                     blade_wear_depth(&leaf.relief.wear, tree->position[i]) == 0.0f;
        way +=
            bears ? (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]) : 0.0;
    }
    double expected = way / (0.12 * 0.0006), n = (double)hairs->curve_count;
    assert_true(expected > 500.0 && n > 0.95 * expected && n < 1.05 * expected);
    int64_t front = 0;
    for (int64_t i = 0; i < hairs->curve_count; i++) {
        Vec3 a = hairs->position[hairs->first[i]], b = hairs->position[hairs->first[i + 1] - 1];
        float nearest = 1.0f;
        for (int64_t k = 0; k < tree->count; k++) {
            bool bears = tree->parent[k] >= 0 && tree->radius[k] >= leaf.params.embedded;
            nearest = bears ? fminf(nearest, distance_to_piece(tree, k, a)) : nearest;
        }
        assert_true(nearest < leaf.params.midrib);
        float reach = vec3_distance(a, b);
        assert_true(reach > 0.25f * params.vein_hairs && reach < 2.0f * params.vein_hairs);
        front += b.z > a.z;
    }
    assert_true(front > hairs->curve_count * 3 / 4);
    curves_free(hairs);
    worn_leaf_clear(&leaf);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smoothing_rounds_bends_and_keeps_joins),
        cmocka_unit_test(a_leaf_has_a_blade_and_a_curve_for_each_piece_of_vein),
        cmocka_unit_test(the_texture_shows_the_midrib_in_the_middle),
        cmocka_unit_test(the_net_is_measured_against_the_blade),
        cmocka_unit_test(the_blade_bulges_between_veins),
        cmocka_unit_test(thin_veins_lie_in_the_blade),
        cmocka_unit_test(a_worn_blade_is_what_teeth_and_holes_leave),
        cmocka_unit_test(rims_of_holes_are_dead_and_the_rest_is_green),
        cmocka_unit_test(rows_set_the_grid_of_the_blade),
        cmocka_unit_test(the_stalk_stands_out),
        cmocka_unit_test(waves_rise_from_the_midrib_to_the_margin),
        cmocka_unit_test(hairs_fringe_the_margin),
        cmocka_unit_test(hairs_bend_with_the_blade),
        cmocka_unit_test(autumn_goes_last_along_thick_veins),
        cmocka_unit_test(hairs_stand_on_thick_veins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
