// OpenVDB files as surfaces and as fields: what was written is read, what is broken is refused.
#include "shape/envelope.h"
#include "shape/grid_file.h"
#include "shape/import.h"
#include "shape/volume.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "testing.h"

static char folder[] = "/tmp/ramify_volume_XXXXXX", file[64];
static const Vec3 middle = {0.4f, 0.5f, -0.2f};

// A level set of a sphere of radius 1, as the program exports it.
static int set_up(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    Shape shape = {.kind = SHAPE_SPHERE,
                   .size = {1, 1, 1},
                   .transform = transform_compose(middle, vec3_splat(0), vec3_splat(1))};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1, .voxel = 0.04f};
    Envelope *envelope = envelope_new(&params, &run, &e);
    GridFile *grids = envelope ? grid_file_new(&e) : NULL;
    bool done = grids && envelope_add_to(envelope, "ball", grids, &run, &e) && mkdtemp(folder);
    snprintf(file, sizeof file, "%s/ball.vdb", folder);
    done = done && grid_file_write(grids, file, &e);
    grid_file_free(grids);
    envelope_free(envelope);
    if (!done) {
        fprintf(stderr, "%s\n", e.message);
    }
    return done ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    unlink(file);
    return rmdir(folder);
}

static void a_level_set_is_a_closed_surface(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    Mesh *mesh = mesh_import(file, &run, &e);
    if (!mesh) {
        fail_msg("%s", e.message);
    }
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, &e));
    assert_int_equal(topology.open_edges, 0);
    assert_int_equal(topology.component_count, 1);
    double volume = 0.0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        assert_float_equal(vec3_distance(mesh->position[i], middle), 1.0f, 0.01f);
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        volume += (double)vec3_dot(mesh->position[c[0]],
                                   vec3_cross(mesh->position[c[1]], mesh->position[c[2]])) /
                  6.0;
    }
    assert_float_equal((float)volume, 4.18879f, 0.03f); // positive: the faces face outward
    mesh_free(mesh);
}

static void a_grid_is_sampled_between_its_voxels(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    Volume *volume = volume_read(file, "ball", &run, &e);
    if (!volume) {
        fail_msg("%s", e.message);
    }
    assert_int_equal(volume->components, 1);
    for (int i = 0; i <= 40; i++) { // through the surface, off the voxels' centres
        Vec3 p = vec3_madd(middle, 0.98f + 0.001f * (float)i, vec3(0.6f, 0.64f, 0.48f));
        float value;
        volume_at(volume, p, &value);
        assert_float_equal(value, vec3_distance(p, middle) - 1.0f, 0.003f);
    }
    float outside, inside;
    volume_at(volume, vec3(50, 0, 0), &outside);
    volume_at(volume, middle, &inside);
    assert_true(outside > 0.0f && inside < 0.0f);
    volume_free(volume);
}

static void refuse(const char *name, const char *why)
{
    Run run = run_default();
    Error e = {0};
    assert_null(volume_read(file, name, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    if (!strstr(e.message, why)) {
        fail_msg("'%s' does not say '%s'", e.message, why);
    }
}

// Every truncation and a sweep of changed bytes: an error or a result, never a crash.
static void broken_files_are_refused(void **state)
{
    (void)state;
    refuse("cube", "there is no grid of floats called 'cube'; the file has: ball");
    FILE *stream = fopen(file, "rb");
    static char whole[1 << 22];
    size_t size = fread(whole, 1, sizeof whole, stream);
    fclose(stream);
    assert_true(size > 1000 && size < sizeof whole);
    Run run = run_default();
    const char *good = strdup(file);
    snprintf(file, sizeof file, "%s/bad.vdb", folder);
    for (int i = 0; i < 24; i++) {
        stream = fopen(file, "wb");
        size_t length = i < 8 ? size * (size_t)i / 8 : size;
        size_t at = (size_t)(i - 8) * size / 16;
        char kept = whole[at % size];
        whole[at % size] = i < 8 ? kept : (char)(kept ^ 0x5a);
        fwrite(whole, 1, length, stream);
        whole[at % size] = kept;
        fclose(stream);
        Error e = {0};
        Mesh *mesh = mesh_import(file, &run, &e);
        assert_true(mesh || e.code == ERROR_INPUT);
        assert_true(i >= 8 || !mesh);
        mesh_free(mesh);
    }
    unlink(file);
    snprintf(file, sizeof file, "%s", good);
    free((void *)(uintptr_t)good);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_set_is_a_closed_surface),
        cmocka_unit_test(a_grid_is_sampled_between_its_voxels),
        cmocka_unit_test(broken_files_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
