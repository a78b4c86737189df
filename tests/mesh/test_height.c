#include "base/random.h"
#include "land/height_drainage.h"
#include "land/height_measure.h"
#include "land/height_mesh.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static HeightField *new_field(int columns, int rows, float cell)
{
    Error e = {0};
    HeightField *field =
        height_field_new(columns, rows, (Vec2){cell, cell}, (Vec2){0.0f, 0.0f}, &e);
    assert_non_null(field);
    return field;
}

static double measure_of(const HeightField *field, double least_area, const char *name)
{
    Error e = {0};
    MeasureList list = {0};
    assert_true(height_field_measure(field, least_area, &list, &e));
    const Measure *m = measures_find(&list, name);
    assert_non_null(m);
    double value = m->value;
    measures_clear(&list);
    return value;
}

static void a_cone_has_the_hypsometric_integral_of_a_cone(void **state)
{
    (void)state;
    HeightField *field = new_field(201, 201, 10.0f);
    double sum = 0.0;
    for (int i = 0; i < 201 * 201; i++) {
        float x = (float)(i % 201) - 100.0f, z = (float)(i / 201) - 100.0f;
        float h = 100.0f - sqrtf(x * x + z * z);
        field->height[i] = h > 0.0f ? h : 0.0f;
        sum += (double)field->height[i];
    }
    // A third of the height over the cone's circle, pi / 4 of the square.
    assert_true(fabs(measure_of(field, 0.0, "hypsometric_integral") - 0.785398 / 3.0) < 0.004);
    assert_true(fabs(measure_of(field, 0.0, "relief") - 100.0) < 1e-6);
    assert_true(measure_of(field, 0.0, "pits") > 100.0); // the flat around it
    height_field_free(field);
}

// Maps have no value beyond their land or water, the first sample included.
static void samples_without_a_value_have_no_part_in_the_range(void **state)
{
    (void)state;
    HeightField *field = new_field(3, 2, 1.0f);
    const float given[6] = {NAN, 4.0f, -2.0f, NAN, 1.0f, INFINITY};
    memcpy(field->height, given, sizeof given);
    float low, high;
    height_field_range(field, &low, &high);
    assert_true(low == -2.0f && high == 4.0f);
    for (int i = 0; i < 6; i++) {
        field->height[i] = NAN;
    }
    height_field_range(field, &low, &high);
    assert_true(low == 0.0f && high == 0.0f);
    height_field_free(field);
}

// A valley between two even slopes, sinking along z: all the water of a row gathers in the middle.
static void water_gathers_in_a_valley(void **state)
{
    (void)state;
    enum { WIDE = 41, LONG = 60 };
    HeightField *field = new_field(WIDE, LONG, 2.0f);
    for (int i = 0; i < WIDE * LONG; i++) {
        field->height[i] = 5.0f * fabsf((float)(i % WIDE) - 20.0f) - 0.01f * (float)(i / WIDE);
    }
    Error e = {0};
    Drainage *d = drainage_new(field, &e);
    assert_non_null(d);
    assert_int_equal(d->count, WIDE * LONG);
    for (int row = 1; row < LONG - 1; row++) {
        // Rows above, without the rim of the first row and of both sides, which drain outward.
        double expected = 4.0 * (double)(WIDE - 2) * row;
        double area = d->area[row * WIDE + 20];
        assert_true(fabs(area - expected) <= 4.0 * (WIDE + 1));
    }
    double all = 0.0;
    for (int64_t i = 0; i < d->count; i++) {
        all += d->receiver[i] == i ? d->area[i] : 0.0;
    }
    assert_true(fabs(all - 4.0 * WIDE * LONG) < 1e-6); // nothing is lost
    assert_int_equal(d->pits, 0);
    drainage_free(d);
    height_field_free(field);
}

// Brute force: raise every sample to the lowest pass on any way to the rim, by relaxation.
static void relax_fill(const HeightField *field, float *level)
{
    int w = field->columns, h = field->rows;
    for (int i = 0; i < w * h; i++) {
        bool rim = i % w == 0 || i / w == 0 || i % w == w - 1 || i / w == h - 1;
        level[i] = rim ? field->height[i] : 1e30f;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = 0; i < w * h; i++) {
            if (i % w == 0 || i / w == 0 || i % w == w - 1 || i / w == h - 1) {
                continue;
            }
            float lowest = 1e30f;
            for (int k = 0; k < 9; k++) {
                float beside = level[i + (k % 3 - 1) + (k / 3 - 1) * w];
                lowest = k != 4 && beside < lowest ? beside : lowest;
            }
            float wanted = lowest > field->height[i] ? lowest : field->height[i];
            if (wanted < level[i]) {
                level[i] = wanted;
                changed = true;
            }
        }
    }
}

static void the_flood_fills_as_brute_force_does(void **state)
{
    (void)state;
    enum { SIDE = 40 };
    HeightField *field = new_field(SIDE, SIDE, 1.0f);
    for (int i = 0; i < SIDE * SIDE; i++) {
        field->height[i] = 10.0f * random_unit(random_key(3, (uint64_t)i));
    }
    float level[SIDE * SIDE];
    relax_fill(field, level);
    assert_true(height_field_pits(field) > 50);
    Error e = {0};
    assert_true(height_field_fill(field, 0.0f, &e));
    for (int i = 0; i < SIDE * SIDE; i++) {
        assert_true(fabsf(field->height[i] - level[i]) < 1e-3f);
    }
    assert_int_equal(height_field_pits(field), 0);
    height_field_free(field);
}

// A regular tree of rivers with known ratios: each stream of order k is met by two of order k - 1
// at its head; lengths double from order to order.
typedef struct Comb {
    Drainage d;
    int32_t receiver[4096], order[4096];
    double area[4096];
    int count;
} Comb;

// Adds a stream of `length` samples that runs into `to`; returns its highest sample.
static int add_stream(Comb *comb, int to, int length)
{
    for (int i = 0; i < length; i++) {
        comb->receiver[comb->count] = to;
        comb->order[comb->count] = comb->count;
        to = comb->count++;
    }
    return to;
}

static void add_binary(Comb *comb, int to, int order)
{
    int head = add_stream(comb, to, 1 << order);
    if (order > 1) {
        add_binary(comb, head, order - 1);
        add_binary(comb, head, order - 1);
    }
}

static void strahler_orders_of_a_binary_network(void **state)
{
    (void)state;
    static Comb comb;
    comb = (Comb){0};
    comb.order[0] = comb.receiver[0] = 0;
    comb.count = 1;
    add_binary(&comb, 0, 5);
    for (int i = comb.count - 1; i > 0; i--) {
        comb.area[i] += 1.0;
        comb.area[comb.receiver[i]] += comb.area[i];
    }
    comb.d = (Drainage){.samples = comb.count,
                        .count = comb.count,
                        .receiver = comb.receiver,
                        .order = comb.order,
                        .area = comb.area};
    uint8_t order[4096] = {0};
    Error e = {0};
    assert_true(drainage_orders(&comb.d, 0.5, order, &e));
    int samples[7] = {0};
    for (int i = 1; i < comb.count; i++) {
        assert_in_range(order[i], 1, 5);
        samples[order[i]]++;
    }
    for (int k = 1; k <= 5; k++) {
        assert_int_equal(samples[k],
                         (1 << (5 - k)) * (1 << k)); // streams of order k x their length
    }
}

static void concavity_of_a_made_river(void **state)
{
    (void)state;
    // One straight valley; along it slope = 0.2 (A / A0)^-0.45 with the area that gathers there.
    enum { WIDE = 65, LONG = 200 };
    HeightField *field = new_field(WIDE, LONG, 10.0f);
    float bed[LONG];
    bed[LONG - 1] = 0.0f;
    for (int row = LONG - 2; row >= 0; row--) {
        bed[row] = bed[row + 1] + 10.0f * 0.2f * powf((float)(row + 1), -0.45f);
    }
    for (int i = 0; i < WIDE * LONG; i++) {
        field->height[i] = bed[i / WIDE] + 20.0f * fabsf((float)(i % WIDE) - 32.0f);
    }
    assert_true(fabs(measure_of(field, 100.0 * 2.5 * WIDE, "concavity") - 0.45) < 0.03);
    height_field_free(field);
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void grids_are_read_and_bad_ones_refused(void **state)
{
    (void)state;
    char name[] = "/tmp/ramify-asc-XXXXXX";
    int handle = mkstemp(name);
    assert_true(handle >= 0);
    Error e = {0};
    write_text(name, "ncols 3\nnrows 2\nxllcorner 500\nyllcorner 100\ncellsize 30\n"
                     "NODATA_value -9999\n1 2 3\n4 -9999 6\n");
    HeightField *field = height_field_read_asc(name, &e);
    assert_non_null(field);
    assert_int_equal(field->columns, 3);
    assert_true(field->cell.x == 30.0f && field->height[5] == 6.0f && isnan(field->height[4]));
    height_field_free(field);
    // Degrees: at 60 north a degree of longitude is half as long as at the equator.
    write_text(name, "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 60\ncellsize 0.001\n1 2\n3 4\n");
    field = height_field_read_asc(name, &e);
    assert_non_null(field);
    assert_true(fabsf(field->cell.x - 55.80f) < 0.05f && fabsf(field->cell.y - 111.41f) < 0.05f);
    height_field_free(field);
    const char *bad[][2] = {
        {"ncols 3\nnrows 2\ncellsize 30\n1 2 3 4 5\n", "ends early"},
        {"ncols 2\nnrows 2\ncellsize 30\n1 2 3 4 5\n", "more heights"},
        {"ncols 2\nnrows 2\ncellsize 30\n1 2 x 4\n", "no number"},
        {"ncols 2\nrows 2\ncellsize 30\n1 2 3 4\n", "unknown key"},
        {"ncols 2\nnrows 2\n1 2 3 4\n", "cellsize"},
        {"ncols 99999999\nnrows 2\ncellsize 1\n1 2 3 4\n", "ncols"},
        {"", "ncols"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        e = (Error){0};
        write_text(name, bad[i][0]);
        assert_null(height_field_read_asc(name, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, bad[i][1]));
    }
    remove(name);
    assert_null(height_field_read_asc(name, &e));
}

static HeightField *hills(int side)
{
    HeightField *field = new_field(side + 1, side + 1, 1.0f);
    for (int i = 0; i < (side + 1) * (side + 1); i++) {
        float x = (float)(i % (side + 1)) / (float)side, z = (float)(i / (side + 1)) / (float)side;
        float near = x * x + z * z < 0.2f ? random_unit(random_key(9, (uint64_t)i)) : 0.0f;
        field->height[i] = 20.0f * x * (1.0f - x) * z + 2.0f * near;
    }
    return field;
}

static void the_mesh_has_no_cracks_and_keeps_its_error(void **state)
{
    (void)state;
    enum { SIDE = 64 };
    HeightField *field = hills(SIDE);
    Vec3 eye = {0.0f, 5.0f, 0.0f};
    HeightMeshParams params[2] = {{.error = 0.2f},
                                  {.error = 0.0f, .eye = &eye, .view = 0.02f, .nearest = 1.0f}};
    for (int k = 0; k < 2; k++) {
        Error e = {0};
        Mesh *mesh = height_mesh_new(field, &params[k], &e);
        assert_non_null(mesh);
        assert_true(mesh->face_count < SIDE * SIDE && mesh->face_count > 100);
        MeshTopology t;
        assert_true(mesh_topology(mesh, &t, &e));
        assert_true(t.overused_edges == 0 && t.misoriented_edges == 0 && t.degenerate_faces == 0);
        assert_int_equal(t.component_count, 1);
        assert_int_equal(t.euler_number, 1); // a disc: an open edge inside would be a crack
        double area = 0.0;
        for (int64_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *c = mesh->index + 3 * f;
            Vec3 n = vec3_cross(vec3_sub(mesh->position[c[1]], mesh->position[c[0]]),
                                vec3_sub(mesh->position[c[2]], mesh->position[c[0]]));
            assert_true(n.y > 0.0f); // all face up
            area += 0.5 * (double)n.y;
        }
        assert_true(fabs(area - SIDE * SIDE) < 1e-3);
        mesh_free(mesh);
    }
    Error e = {0};
    HeightField *odd = new_field(8, 8, 1.0f);
    assert_null(height_mesh_new(odd, &params[0], &e));
    assert_int_equal(e.code, ERROR_INPUT);
    height_field_free(odd);
    height_field_free(field);
}

// Samples to keep are corners, and where all are, the mesh is the finest one.
static void samples_to_keep_become_corners(void **state)
{
    (void)state;
    enum { SIDE = 32 };
    HeightField *field = hills(SIDE);
    uint8_t keep[(SIDE + 1) * (SIDE + 1)] = {0};
    for (int i = 0; i < (SIDE + 1) * (SIDE + 1); i++) {
        int column = i % (SIDE + 1), row = i / (SIDE + 1);
        keep[i] = column >= 9 && column <= 14 && row >= 4 && row <= 11;
    }
    Error e = {0};
    Mesh *mesh = height_mesh_new(field, &(HeightMeshParams){.error = 1e3f, .keep = keep}, &e);
    assert_non_null(mesh);
    MeshTopology t;
    assert_true(mesh_topology(mesh, &t, &e));
    assert_true(t.overused_edges == 0 && t.degenerate_faces == 0 && t.euler_number == 1);
    int corners = 0, inside = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        corners += keep[(int)p.z * (SIDE + 1) + (int)p.x];
    }
    assert_int_equal(corners, 6 * 8);
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        Vec3 a = mesh->position[c[0]], b = mesh->position[c[1]], d = mesh->position[c[2]];
        Vec3 middle = vec3_scale(vec3_add(a, vec3_add(b, d)), 1.0f / 3.0f);
        if (middle.x > 9.0f && middle.x < 14.0f && middle.z > 4.0f && middle.z < 11.0f) {
            assert_true(fabsf(height_mesh_finest_at(field, middle.x, middle.z) - middle.y) < 1e-4f);
            inside++;
        }
    }
    assert_int_equal(inside, 5 * 7 * 2);
    assert_true(mesh->face_count < SIDE * SIDE);
    assert_true(height_mesh_finest_at(field, -5.0f, 99.0f) == field->height[SIDE * (SIDE + 1)]);
    mesh_free(mesh);
    height_field_free(field);
}

static void splines_pass_through_the_samples(void **state)
{
    (void)state;
    HeightField *field = hills(16);
    for (int i = 0; i < 17 * 17; i += 7) {
        float x = (float)(i % 17), z = (float)(i / 17);
        assert_true(fabsf(height_field_at(field, x, z) - field->height[i]) < 1e-5f);
        assert_true(fabsf(height_field_smooth_at(field, x, z) - field->height[i]) < 1e-5f);
    }
    assert_true(height_field_at(field, -50.0f, -50.0f) == field->height[0]);
    height_field_free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cone_has_the_hypsometric_integral_of_a_cone),
        cmocka_unit_test(samples_without_a_value_have_no_part_in_the_range),
        cmocka_unit_test(water_gathers_in_a_valley),
        cmocka_unit_test(the_flood_fills_as_brute_force_does),
        cmocka_unit_test(strahler_orders_of_a_binary_network),
        cmocka_unit_test(concavity_of_a_made_river),
        cmocka_unit_test(grids_are_read_and_bad_ones_refused),
        cmocka_unit_test(the_mesh_has_no_cracks_and_keeps_its_error),
        cmocka_unit_test(samples_to_keep_become_corners),
        cmocka_unit_test(splines_pass_through_the_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
