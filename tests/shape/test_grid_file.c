// OpenVDB files read back by OpenVDB: envelopes against their distance, guide fields against their
// own evaluation.
#include "testing.h"

#include "base/random.h"
#include "field/guide_field.h"
#include "shape/envelope.h"
#include "shape/volume.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify_grids_XXXXXX";

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") == 0 && system(command) == 0 ? 0 : -1;
}

static const Shape SHAPES[2] = {
    {.kind = SHAPE_ELLIPSOID,
     .size = {2, 1, 1.5f},
     .transform = {{{1, 0, 0, 3}, {0, 1, 0, 4}, {0, 0, 1, -1}}}},
    {.kind = SHAPE_SPHERE,
     .size = {1, 1, 1},
     .transform = {{{0.8f, 0, 0, 5}, {0, 0.8f, 0, 4.5f}, {0, 0, 0.8f, -1}}}},
};

static Envelope *make_envelope(int shapes)
{
    Run run = run_default();
    EnvelopeParams params = {.shapes = SHAPES, .shape_count = shapes};
    Envelope *envelope = envelope_new(&params, &run, NULL);
    assert_non_null(envelope);
    return envelope;
}

static Vec3 point_about(Aabb box, uint64_t n, float share)
{
    Vec3 middle = vec3_lerp(box.low, box.high, 0.5f), half = vec3_sub(box.high, middle);
    Vec3 u = vec3(random_unit(random_key(n, 1)), random_unit(random_key(n, 2)),
                  random_unit(random_key(n, 3)));
    u = vec3_sub(vec3_scale(u, 2.0f), vec3_splat(1.0f));
    return vec3_add(middle, vec3_mul(half, vec3_scale(u, share)));
}

static Volume *write_and_read(const GridFile *grids, const char *file, const char *name)
{
    Error e = {0};
    Run run = run_default();
    if (!grid_file_write(grids, file, &e)) {
        fail_msg("%s", e.message);
    }
    Volume *back = volume_read(file, name, &run, &e);
    if (!back) {
        fail_msg("%s", e.message);
    }
    return back;
}

static Vec3 vector_at(const Volume *volume, Vec3 p)
{
    float value[3];
    volume_at(volume, p, value);
    return vec3(value[0], value[1], value[2]);
}

// One of a level set of its own, one of a primitive, which is sampled.
static void envelopes_read_back_as_their_distance(void **state)
{
    (void)state;
    Run run = run_default();
    for (int shapes = 1; shapes <= 2; shapes++) {
        Envelope *envelope = make_envelope(shapes);
        GridFile *grids = grid_file_new(NULL);
        assert_true(envelope_add_to(envelope, "crown/envelope", grids, &run, NULL));
        assert_int_equal(grid_file_count(grids), 1);
        Volume *back = write_and_read(grids, "envelope.vdb", "crown/envelope");
        Aabb box = envelope_bounds(envelope);
        float voxel = (box.high.x - box.low.x) / 128.0f,
              band = 1.2f * voxel; // corners of such cells are not clamped
        int near = 0;
        for (uint64_t i = 0; i < 20000; i++) {
            Vec3 p = point_about(box, i, 1.15f);
            float want = clampf(envelope_distance(envelope, p), -band, band), got;
            volume_at(back, p, &got);
            near += fabsf(want) < band;
            assert_true(fabsf(clampf(got, -band, band) - want) < 0.15f * voxel);
        }
        assert_true(near > 200);
        volume_free(back);
        grid_file_free(grids);
        envelope_free(envelope);
    }
}

static void fields_read_back_as_they_are(void **state)
{
    (void)state;
    Run run = run_default();
    run.threads = 2;
    Envelope *envelope = make_envelope(2);
    FieldParams params[2] = {field_params_default(FIELD_VORTEX), field_params_default(FIELD_CURL)};
    params[0].center = vec3(3, 0, -9);
    params[1].scale = 3.0f;
    params[1].weight = 0.5f;
    GuideField *field =
        guide_field_new(params, 2, &(FieldSite){.bounds = envelope_bounds(envelope)}, &run, NULL);
    assert_non_null(field);
    GridFile *grids = grid_file_new(NULL);
    assert_true(guide_field_add_to(field, envelope, 48, "crown/field", grids, &run, NULL));
    Volume *back = write_and_read(grids, "field.vdb", "crown/field");
    int inside = 0;
    double sum = 0.0;
    for (uint64_t i = 0; i < 20000; i++) {
        Vec3 p = point_about(envelope_bounds(envelope), i, 1.0f), got;
        if (envelope_contains(envelope, p)) {
            Vec3 want = guide_field_at(field, p, vec3(0, 1, 0));
            got = vector_at(back, p);
            inside++;
            sum += (double)vec3_distance(got, want);
        }
    }
    assert_true(inside > 5000);
    assert_true(sum / inside < 0.01); // the curl turns sharply here and there
    volume_free(back);
    grid_file_free(grids);
    guide_field_free(field);
    envelope_free(envelope);
}

static size_t read_bytes(const char *file, char *bytes, size_t size)
{
    FILE *stream = fopen(file, "rb");
    assert_non_null(stream);
    size_t got = fread(bytes, 1, size, stream);
    fclose(stream);
    return got;
}

// Whenever they are written, and by any number of threads.
static void the_same_grids_give_the_same_bytes(void **state)
{
    (void)state;
    enum { MOST = 1 << 22 };
    char *bytes[2] = {malloc(MOST), malloc(MOST)};
    size_t size[2];
    assert_true(bytes[0] && bytes[1]);
    for (int i = 0; i < 2; i++) {
        Run run = run_default();
        run.threads = 1 + i;
        Envelope *envelope = make_envelope(2);
        FieldParams params = field_params_default(FIELD_VORTEX);
        GuideField *field = guide_field_new(
            &params, 1, &(FieldSite){.bounds = envelope_bounds(envelope)}, &run, NULL);
        GridFile *grids = grid_file_new(NULL);
        assert_true(envelope_add_to(envelope, "a", grids, &run, NULL));
        assert_true(guide_field_add_to(field, envelope, 24, "b", grids, &run, NULL));
        assert_true(grid_file_write(grids, "same.vdb", NULL));
        size[i] = read_bytes("same.vdb", bytes[i], MOST);
        grid_file_free(grids);
        guide_field_free(field);
        envelope_free(envelope);
    }
    assert_true(size[0] > 1000 && size[0] < MOST);
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    free(bytes[0]);
    free(bytes[1]);
}

static void what_is_no_grid_file_is_refused(void **state)
{
    (void)state;
    Run run = run_default();
    const char *const texts[] = {"", "no grids", " BDV and then nothing"};
    for (int i = 0; i < 3; i++) {
        FILE *stream = fopen("bad.vdb", "wb");
        assert_non_null(stream);
        fputs(texts[i], stream);
        fclose(stream);
        Error e = {0};
        assert_null(volume_read("bad.vdb", NULL, &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.file, "bad.vdb"));
    }
    assert_null(volume_read("none.vdb", NULL, &run, NULL));
}

// A quarter turn about Y takes x to -z and z to x.
static void grids_that_move_take_their_vectors_along(void **state)
{
    (void)state;
    Run run = run_default();
    GridFile *grids = grid_file_new(NULL);
    Envelope *envelope = make_envelope(1);
    FieldParams params = field_params_default(FIELD_RADIAL);
    params.center = vec3(3, 4, -1);
    Aabb box = envelope_bounds(envelope);
    GuideField *field = guide_field_new(&params, 1, &(FieldSite){.bounds = box}, &run, NULL);
    assert_true(envelope_add_to(envelope, "stays", grids, &run, NULL));
    assert_true(envelope_add_to(envelope, "level", grids, &run, NULL));
    assert_true(guide_field_add_to(field, envelope, 40, "field", grids, &run, NULL));
    Transform motion =
        transform_from_axes(vec3(0, 0, -1), vec3(0, 1, 0), vec3(1, 0, 0), vec3(7, -2, 0.5f));
    assert_true(grid_file_move(grids, 1, &motion, NULL));
    Volume *stays = write_and_read(grids, "moved.vdb", "stays");
    Volume *level = write_and_read(grids, "moved.vdb", "level");
    Volume *turned = write_and_read(grids, "moved.vdb", "field");
    for (uint64_t i = 0; i < 200; i++) {
        Vec3 p = point_about(box, i, 0.6f), v, wanted = vec3_normalize(vec3_sub(p, params.center));
        Vec3 q = transform_point(&motion, p);
        float there, here;
        volume_at(level, q, &there);
        volume_at(stays, p, &here);
        assert_float_equal(there, here, 1e-4);
        v = vector_at(turned, q);
        if (vec3_distance(p, params.center) > 0.5f) { // no kink within a voxel
            assert_true(vec3_distance(v, transform_vector(&motion, wanted)) < 0.02f);
        }
    }
    guide_field_free(field);
    envelope_free(envelope);
    grid_file_free(grids);
    volume_free(stays);
    volume_free(level);
    volume_free(turned);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(envelopes_read_back_as_their_distance),
        cmocka_unit_test(fields_read_back_as_they_are),
        cmocka_unit_test(grids_that_move_take_their_vectors_along),
        cmocka_unit_test(the_same_grids_give_the_same_bytes),
        cmocka_unit_test(what_is_no_grid_file_is_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
