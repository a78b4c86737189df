// Clouds of OpenVDB files against closed forms.
#include "render/cloud/cloud_grid.h"
#include "render/cloud/cloud_voxels.h"
#include "render/cloud/clouds.h"

#include "base/random.h"
#include "shape/envelope.h"
#include "shape/grid_file.h"
#include "shape/sparse_volume.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "testing.h"

static char folder[] = "/tmp/ramify_cloud_XXXXXX", file[64];

static const Vec3 box_low = {-2.0f, 1.0f, -3.0f}, box_high = {6.0f, 5.0f, 3.0f}; // file's units
static const float voxel = 0.25f, dense = 2.5f;

static float in_box(const void *context, Vec3 p)
{
    (void)context;
    bool inside = p.x >= box_low.x && p.y >= box_low.y && p.z >= box_low.z && p.x <= box_high.x &&
                  p.y <= box_high.y && p.z <= box_high.z;
    return inside ? dense : 0.0f;
}

// Waves over a ball, on blocks some of which are empty.
static float in_ball(const void *context, Vec3 p)
{
    (void)context;
    float r = vec3_distance(p, vec3(1.0f, 2.0f, -1.0f));
    return r < 4.0f ? (4.0f - r) * (1.0f + 0.9f * sinf(5.0f * p.x) * cosf(4.0f * p.z)) : 0.0f;
}

static bool add_level_set(GridFile *grids, Error *e)
{
    Run run = run_default();
    Shape shape = {.kind = SHAPE_BOX,
                   .size = {4, 4, 4},
                   .transform = transform_compose(vec3_splat(0), vec3_splat(0), vec3_splat(1))};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1, .voxel = 0.1f};
    Envelope *envelope = envelope_new(&params, &run, e);
    bool done = envelope && envelope_add_to(envelope, "level", grids, &run, e);
    envelope_free(envelope);
    return done;
}

static bool is_vector(const void *context, Vec3 p, Vec3 *vector)
{
    (void)context;
    *vector = p;
    return true;
}

static int set_up(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    GridFile *grids = grid_file_new(&e);
    Aabb box = {vec3(-8, -4, -8), vec3(12, 10, 8)};
    Aabb small = {vec3(0, 0, 0), vec3(1, 1, 1)};
    bool done = grids && mkdtemp(folder) &&
                grid_file_add_density(grids, "box", box, voxel, in_box, NULL, &run, &e) &&
                grid_file_add_density(grids, "ball", box, voxel, in_ball, NULL, &run, &e) &&
                add_level_set(grids, &e) &&
                grid_file_add_vectors(grids, "velocity", small, 0.5f, is_vector, NULL, &run, &e);
    snprintf(file, sizeof file, "%s/cloud.vdb", folder);
    done = done && grid_file_write(grids, file, &e);
    grid_file_free(grids);
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

static Cloud cloud_of(const char *grid)
{
    Cloud cloud = cloud_default(CLOUD_GRID);
    cloud.file = file;
    cloud.grid = grid;
    return cloud;
}

static CloudSet *grow(Cloud cloud)
{
    Run run = run_default();
    Error e = {0};
    CloudSet *clouds = clouds_new(&cloud, 1, 3, &run, &e);
    if (!clouds) {
        fail_msg("%s", e.message);
    }
    return clouds;
}

static void assert_near(double value, double wanted, double error)
{
    if (!(fabs(value - wanted) <= error)) {
        fail_msg("%.6g is not %.6g +- %.6g", value, wanted, error);
    }
}

// Shares that pass and that do not collide, beside exp(-depth).
static void assert_passes(const CloudSet *clouds, const CloudRay *ray, double depth, uint64_t key)
{
    enum { TRIALS = 4000 };
    double passed = 0.0, missed = 0.0;
    for (int k = 0; k < TRIALS; k++) {
        passed += (double)clouds_pass(clouds, ray, 1.0f, &key) / TRIALS;
        missed += isinf(clouds_collide(clouds, ray, 1.0f, &key)) ? 1.0 / TRIALS : 0.0;
    }
    double error = 4.5 * 0.5 / sqrt((double)TRIALS);
    assert_near(passed, exp(-depth), error);
    assert_near(missed, exp(-depth), error);
}

// Along the longest axis the optical depth is extinction x density x length: from a whole sample to
// the next voxel outside the density falls to 0, half a voxel's worth at either end.
static void a_box_is_as_thick_as_it_is_long(void **state)
{
    (void)state;
    Cloud cloud = cloud_of("box");
    cloud.scale = 50.0f;
    cloud.position = vec3(300, 900, -4000);
    cloud.rotation = vec3(0, 90, 0); // the file's x becomes -z of the scene
    cloud.extinction = 0.0012f;
    CloudSet *clouds = grow(cloud);
    double length = (double)(cloud.scale * (box_high.x - box_low.x + voxel));
    double depth = (double)(cloud.extinction * dense) * length;
    for (uint64_t i = 0; i < 6; i++) {
        float up = random_range(random_key(i, 0), 1.3f, 4.7f);
        float aside = random_range(random_key(i, 1), -2.7f, 2.7f);
        CloudRay ray = {.origin = vec3(300 + cloud.scale * aside, 900 + cloud.scale * up, -3000),
                        .direction = vec3(0, 0, -1),
                        .far = 3000.0f};
        assert_passes(clouds, &ray, depth, random_key(5, i));
    }
    CloudRay beside = {
        .origin = vec3(300, 900 + 5.5f * 50, -3000), .direction = vec3(0, 0, -1), .far = 3000.0f};
    uint64_t key = 4;
    assert_true(clouds_pass(clouds, &beside, 1.0f, &key) >= 1.0f);
    assert_true(clouds_extinction(clouds, vec3(300, 1050, -4100)) == cloud.extinction * dense);
    clouds_free(clouds);
}

// A level set's inside rises from 0 to 1 across its band of three voxels, so that a ray loses half
// of it twice.
static void a_level_set_is_filled(void **state)
{
    (void)state;
    Cloud cloud = cloud_of("level");
    cloud.extinction = 0.2f;
    CloudSet *clouds = grow(cloud);
    for (uint64_t i = 0; i < 5; i++) {
        CloudRay ray = {.origin = vec3(-9, random_range(random_key(i, 0), -1.2f, 1.2f),
                                       random_range(random_key(i, 1), -1.2f, 1.2f)),
                        .direction = vec3(1, 0, 0),
                        .far = 30.0f};
        assert_passes(clouds, &ray, 0.2 * (8.0 - 0.3), random_key(6, i));
    }
    clouds_free(clouds);
}

// The integral of what is written, at places and along oblique rays through a placed grid.
static void samples_are_interpolated(void **state)
{
    (void)state;
    Cloud cloud = cloud_of("ball");
    cloud.extinction = 0.04f;
    cloud.rotation = vec3(20, 35, -15);
    cloud.position = vec3(10, 20, 30);
    cloud.scale = 3.0f;
    Transform placed = transform_compose(cloud.position, cloud.rotation, vec3_splat(cloud.scale));
    CloudSet *clouds = grow(cloud);
    for (uint64_t i = 0; i < 3000; i++) { // at samples themselves
        Vec3 p = vec3(-8.0f + voxel * floorf(80.0f * random_unit(random_key(i, 0))),
                      -4.0f + voxel * floorf(56.0f * random_unit(random_key(i, 1))),
                      -8.0f + voxel * floorf(64.0f * random_unit(random_key(i, 2))));
        double wanted = (double)(cloud.extinction * in_ball(NULL, p));
        assert_near((double)clouds_extinction(clouds, transform_point(&placed, p)), wanted, 1e-4);
    }
    for (uint64_t i = 0; i < 8; i++) {
        Vec3 d = random_direction(random_key(i, 9));
        Vec3 middle = transform_point(&placed, vec3(1.0f, 2.5f, -1.0f));
        CloudRay ray = {.origin = vec3_madd(middle, -20.0f, d), .direction = d, .far = 45.0f};
        double depth = 0.0;
        for (int k = 0; k < 4500; k++) {
            depth += 0.01 * (double)clouds_extinction(
                                clouds, vec3_madd(ray.origin, 0.01f * ((float)k + 0.5f), d));
        }
        assert_passes(clouds, &ray, depth, random_key(7, i));
    }
    clouds_free(clouds);
}

// No place is thinner or denser than the bounds of its part, and they are tight.
static void bounds_hold(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    Cloud cloud = cloud_of("ball");
    CloudGrid g = {0};
    assert_true(cloud_grid_new(&g, &cloud, NULL, 1, &run, &e));
    double sum = 0.0, least = 0.0, most = 0.0;
    int met = 0;
    for (uint64_t i = 0; i < 200000; i++) {
        float at[3], own[3];
        int c[3], part[3];
        for (int axis = 0; axis < 3; axis++) {
            own[axis] = 0.9999f * (float)g.cells[axis] * random_unit(random_key(i, (uint64_t)axis));
            c[axis] = (int)own[axis];
            part[axis] = (int)((own[axis] - (float)c[axis]) * PARTS);
            at[axis] = own[axis] * g.voxel * CELL;
        }
        Transform to_scene;
        assert_true(transform_inverse(&g.to_own, &to_scene));
        Vec3 p = transform_point(&to_scene, vec3_add(g.low, vec3(at[0], at[1], at[2])));
        float extinction = cloud_grid_extinction(&g, p, true), step = g.extinction / CELL_STEPS;
        const CloudCell *cell = &g.cell[cloud_grid_cell(&g, c[0], c[1], c[2])];
        CloudBounds b =
            cell->parts < 0
                ? cell->bounds
                : g.part[((cell->parts * PARTS + part[2]) * PARTS + part[0]) * PARTS + part[1]];
        if (extinction < 0.99999f * step * b.least || extinction > 1.00001f * step * b.most) {
            fail_msg("%g is not within %d .. %d of 255 of %g", (double)extinction, b.least, b.most,
                     (double)g.extinction);
        }
        assert_true(cell->gap == 0 || extinction <= 0.0f);
        met += extinction > 0.0f;
        sum += (double)extinction;
        least += (double)(step * b.least);
        most += (double)(step * b.most);
    }
    assert_true(met > 8000);
    assert_true(most < 1.6 * sum && least > 0.5 * sum);
    cloud_grid_clear(&g);
}

// What reading takes is known before, within a factor of two and a half.
static void its_memory_is_estimated(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    Cloud cloud = cloud_of("ball");
    SparseVolume *volume = sparse_volume_read(file, "ball", &run, &e);
    assert_non_null(volume);
    double taken = (double)sparse_volume_bytes(volume);
    double told = (double)sparse_volume_estimate(file, "ball", &run);
    assert_true(told > taken / 2.5 && told < taken * 2.5);
    assert_true(clouds_bytes(&cloud, 1) > (int64_t)told);
    sparse_volume_free(volume);
    cloud.grid = "none";
    assert_int_equal(clouds_bytes(&cloud, 1), 0);
}

static void assert_refused(Cloud cloud, const char *key, const char *words)
{
    Run run = run_default();
    Error e = {0};
    assert_null(clouds_new(&cloud, 1, 3, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.key, key);
    if (!strstr(e.message, words)) {
        fail_msg("'%s' does not say '%s'", e.message, words);
    }
}

static void what_is_no_density_is_refused(void **state)
{
    (void)state;
    assert_refused(cloud_of("smoke"), "clouds.0.grid", "no grid of floats called 'smoke'");
    assert_refused(cloud_of("velocity"), "clouds.0.grid", "no grid of floats called 'velocity'");
    char other[80];
    snprintf(other, sizeof other, "%s/text.vdb", folder);
    FILE *out = fopen(other, "w");
    assert_non_null(out);
    fputs("not a grid", out);
    fclose(out);
    Cloud cloud = cloud_of(NULL);
    cloud.file = other;
    assert_refused(cloud, "clouds.0.file", "OpenVDB");
    unlink(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_is_as_thick_as_it_is_long),
        cmocka_unit_test(a_level_set_is_filled),
        cmocka_unit_test(samples_are_interpolated),
        cmocka_unit_test(bounds_hold),
        cmocka_unit_test(its_memory_is_estimated),
        cmocka_unit_test(what_is_no_density_is_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
