// Deformations against closed forms.
#include "base/exact_math.h"
#include "base/random.h"
#include "shape/deformation.h"
#include "shape/mean_value.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "testing.h"

static Vec3 random_point(uint64_t i, float size)
{
    uint64_t key = random_key(3, i);
    return vec3(random_range(random_key(key, 0), -size, size),
                random_range(random_key(key, 1), -size, size),
                random_range(random_key(key, 2), -size, size));
}

static DeformParams params_of(DeformKind kind)
{
    return (DeformParams){
        .kind = kind, .scale = {1, 1, 1}, .axis = {0, 1, 0}, .toward = {1, 0, 0}, .length = 1};
}

static Deformation *made(const DeformParams *params, int count)
{
    Run run = run_default();
    Error e = {0};
    Deformation *deformation = deformation_new(params, count, &run, &e);
    if (!deformation) {
        fail_msg("%s", e.message);
    }
    return deformation;
}

static void assert_near(Vec3 a, Vec3 b, float tolerance)
{
    if (!(vec3_distance(a, b) <= tolerance)) {
        fail_msg("(%g %g %g) is not (%g %g %g)", (double)a.x, (double)a.y, (double)a.z, (double)b.x,
                 (double)b.y, (double)b.z);
    }
}

static void affine_scales_shears_turns_moves(void **state)
{
    (void)state;
    DeformParams p = params_of(DEFORM_AFFINE);
    p.pivot = vec3(1, 2, 3);
    p.scale = vec3(2, 1, 1);
    p.shear = vec3(0.5f, 0, 0);
    p.rotation = vec3(0, 90, 0);
    p.move = vec3(0, 0, 10);
    Deformation *d = made(&p, 1);
    // offset (1, 1, 0) -> scaled (2, 1, 0) -> sheared (2.5, 1, 0) -> turned about y (0, 1, -2.5)
    assert_near(deformation_carry(d, vec3(2, 3, 3)), vec3(1, 3, 10.5f), 1e-5f);
    assert_near(deformation_carry(d, p.pivot), vec3(1, 2, 13), 1e-6f);
    deformation_free(d);
}

// The axis becomes an arc of the same length; what is beside it stays as far from it.
static void bends_keep_lengths(void **state)
{
    (void)state;
    DeformParams p = params_of(DEFORM_BEND);
    p.pivot = vec3(0, 1, 0);
    p.length = 2;
    p.angle = 90;
    Deformation *d = made(&p, 1);
    float radius = 2.0f / (0.5f * PI_F);
    assert_near(deformation_carry(d, vec3(0.3f, 0.5f, 0.1f)), vec3(0.3f, 0.5f, 0.1f), 1e-6f);
    assert_near(deformation_carry(d, vec3(0, 3, 0)), vec3(radius, 1 + radius, 0), 1e-5f);
    // beyond the arc it goes on straight, now toward +x; +x has become down
    assert_near(deformation_carry(d, vec3(0.25f, 4, 0.1f)),
                vec3(radius + 1, 1 + radius - 0.25f, 0.1f), 1e-5f);
    float length = 0.0f;
    Vec3 last = deformation_carry(d, vec3(0, 1, 0));
    for (int i = 1; i <= 1000; i++) {
        Vec3 next = deformation_carry(d, vec3(0, 1.0f + 0.002f * (float)i, 0));
        length += vec3_distance(last, next);
        last = next;
    }
    assert_float_equal(length, 2.0f, 1e-4f);
    deformation_free(d);
}

static void twists_turn_by_height(void **state)
{
    (void)state;
    DeformParams p = params_of(DEFORM_TWIST);
    p.length = 4;
    p.angle = 180;
    Deformation *d = made(&p, 1);
    for (int i = -2; i <= 6; i++) {
        float s, c, y = (float)i;
        exact_sincos(PI_F * clampf(y / 4, 0, 1), &s, &c);
        Vec3 at = deformation_carry(d, vec3(1, y, 0));
        assert_near(at, vec3(c, y, -s), 1e-5f);
    }
    deformation_free(d);
}

// An octahedron refined once and warped, so that it is closed but not convex.
static Mesh *star(bool flat)
{
    static const uint32_t faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    static const Vec3 tips[6] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                 {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    Mesh *mesh = mesh_new(3, 14, 24, 0, NULL);
    memcpy(mesh->position, tips, sizeof tips);
    for (uint32_t f = 0; f < 8; f++) {
        const uint32_t *v = faces[f];
        Vec3 middle = vec3_add(vec3_add(tips[v[0]], tips[v[1]]), tips[v[2]]);
        mesh->position[6 + f] = vec3_scale(middle, flat ? 1.0f / 3.0f : 0.18f);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t *corner = mesh->index + 9 * f + 3 * k;
            corner[0] = v[k], corner[1] = v[(k + 1) % 3], corner[2] = 6 + f;
        }
    }
    return mesh;
}

// Mean value coordinates reproduce affine maps everywhere (Ju et al. 2005, section 2).
static void meshes_carry_affine_motions_exactly(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        Mesh *rest = star(flat), *posed = star(flat);
        Transform t = transform_compose(vec3(0.3f, -1, 2), vec3(20, 35, -50), vec3(1, 1.3f, 0.8f));
        assert_true(mesh_transform(posed, &t, NULL));
        for (uint64_t i = 0; i < 3000; i++) {
            Vec3 p = random_point(i, 1.5f);
            assert_near(mean_value_carry(rest, posed, p), transform_point(&t, p), 2e-4f);
        }
        for (int64_t v = 0; v < rest->vertex_count; v++) {
            assert_near(mean_value_carry(rest, posed, rest->position[v]), posed->position[v],
                        1e-6f);
        }
        for (int64_t f = 0; f < rest->face_count; f++) { // on the faces themselves
            Vec3 on = vec3(0, 0, 0), to = on;
            for (int k = 0; k < 3; k++) {
                on = vec3_madd(on, 1.0f / 3.0f, rest->position[rest->index[3 * f + k]]);
                to = vec3_madd(to, 1.0f / 3.0f, posed->position[posed->index[3 * f + k]]);
            }
            assert_near(mean_value_carry(rest, posed, on), to, 2e-4f);
        }
        mesh_free(rest);
        mesh_free(posed);
    }
}

// A vertex that moves carries its neighbourhood, and the far side hardly.
static void meshes_carry_smoothly(void **state)
{
    (void)state;
    Mesh *rest = star(true), *posed = star(true);
    posed->position[0] = vec3(1.5f, 0, 0);
    float near = mean_value_carry(rest, posed, vec3(0.8f, 0, 0)).x - 0.8f;
    float middle = mean_value_carry(rest, posed, vec3(0, 0, 0)).x;
    float far = mean_value_carry(rest, posed, vec3(-0.8f, 0, 0)).x + 0.8f;
    assert_true(near > 0.3f && near > middle && middle > far && far > -0.01f);
    Vec3 last = mean_value_carry(rest, posed, vec3(-1.5f, 0.11f, 0.07f));
    for (int i = 1; i <= 600; i++) { // through the surface without a jump
        Vec3 next = mean_value_carry(rest, posed, vec3(-1.5f + 0.005f * (float)i, 0.11f, 0.07f));
        assert_true(vec3_distance(last, next) < 0.012f);
        last = next;
    }
    mesh_free(rest);
    mesh_free(posed);
}

static void write_obj(const char *path, const Mesh *mesh, int64_t faces)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        fprintf(file, "v %.9g %.9g %.9g\n", (double)p.x, (double)p.y, (double)p.z);
    }
    for (int64_t f = 0; f < faces; f++) {
        const uint32_t *v = mesh->index + 3 * f;
        fprintf(file, "f %u %u %u\n", v[0] + 1, v[1] + 1, v[2] + 1);
    }
    fclose(file);
}

static void refuse(const char *rest, const char *posed, const char *why, const char *key)
{
    DeformParams p = params_of(DEFORM_MESH);
    p.rest = rest;
    p.posed = posed;
    Run run = run_default();
    Error e = {0};
    assert_null(deformation_new(&p, 1, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    if (!strstr(e.message, why)) {
        fail_msg("'%s' does not say '%s'", e.message, why);
    }
    assert_string_equal(e.key, key);
}

static void meshes_are_read_and_checked(void **state)
{
    (void)state;
    char folder[] = "/tmp/ramify_deform_XXXXXX", rest[64], posed[64], open[64];
    assert_non_null(mkdtemp(folder));
    snprintf(rest, sizeof rest, "%s/rest.obj", folder);
    snprintf(posed, sizeof posed, "%s/posed.obj", folder);
    snprintf(open, sizeof open, "%s/open.obj", folder);
    Mesh *mesh = star(true);
    write_obj(rest, mesh, 24);
    write_obj(open, mesh, 23);
    mesh->position[0] = vec3(1, 0.5f, 0);
    write_obj(posed, mesh, 24);
    DeformParams p = params_of(DEFORM_MESH);
    p.rest = rest;
    p.posed = posed;
    Deformation *d = made(&p, 1);
    assert_near(deformation_carry(d, vec3(1, 0, 0)), vec3(1, 0.5f, 0), 1e-5f);
    deformation_free(d);
    refuse(open, posed, "open edges", "0.rest");
    refuse(rest, open, "open edges", "0.posed");
    refuse(rest, "/nonexistent.obj", "No such file", "0.posed");
    mesh_free(mesh);
    unlink(rest), unlink(posed), unlink(open), rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(affine_scales_shears_turns_moves),
        cmocka_unit_test(bends_keep_lengths),
        cmocka_unit_test(twists_turn_by_height),
        cmocka_unit_test(meshes_carry_affine_motions_exactly),
        cmocka_unit_test(meshes_carry_smoothly),
        cmocka_unit_test(meshes_are_read_and_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
