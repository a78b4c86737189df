// Colours at vertices against what rays meet there.
#include "render/world.h"
#include "testing.h"

#include "export/vertex.h"
#include "export/vertex_colors.h"
#include "render/accel/accel.h"
#include "render/material/pattern.h"
#include "scene/build.h"

#include <stdlib.h>
#include <string.h>

static const char SCENE[] =
    "objects:\n"
    "  - name: oak\n"
    "    tree: {height: 3}\n"
    "  - name: floor\n"
    "    ground: {radius: 20, flat_radius: 10, grass_tufts: 0, fallen_leaves: 0}\n";

static Scene *read_scene(void)
{
    Error e = {0};
    Scene *scene = scene_read_text(SCENE, strlen(SCENE), "scene.yaml", "", NULL, 0, &e);
    if (!scene) {
        fail_msg("%s", e.message);
    }
    return scene;
}

// Sums over the vertices that a ray from outside reaches first.
typedef struct Agreement {
    int64_t met;
    double difference, spread; // of luminance-like sums; from the colour met, and from the mean
} Agreement;

static Agreement compare(const World *world, const Accel *accel, const Part *part,
                         const Vec3 *color, float footprint)
{
    Agreement sum = {0};
    const Mesh *mesh = part->mesh;
    Vec3 mean = {0};
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        mean = vec3_madd(mean, 1.0f / (float)mesh->vertex_count, color[i]);
    }
    for (int64_t i = 0; i < mesh->vertex_count; i += 7) {
        const float away = 0.002f;
        Ray ray = {.origin = vec3_madd(mesh->position[i], away, mesh->normal[i]),
                   .direction = vec3_neg(mesh->normal[i]),
                   .far = 2.0f * away};
        Hit hit;
        SurfacePoint point;
        if (!accel_intersect(accel, &ray, &hit)) {
            continue;
        }
        accel_surface(accel, &ray, &hit, &point);
        if (&world->geometry.part[point.part] != part ||
            vec3_distance(point.position, mesh->position[i]) > 0.0005f) {
            continue;
        }
        const Material *material = &world->material[part->material];
        point.footprint = footprint;
        PatternShade shade = {material->color, material->transmittance, point.normal, 0.0f,
                              material->roughness};
        pattern_apply(material, &point, &shade);
        sum.met++;
        sum.difference += (double)vec3_distance(shade.color, color[i]);
        sum.spread += (double)vec3_distance(mean, color[i]);
    }
    return sum;
}

static float mean_footprint(const Mesh *mesh)
{
    double area = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + f * mesh->face_size;
        const Vec3 *p = mesh->position;
        Vec3 e1 = vec3_sub(p[c[1]], p[c[0]]), e2 = vec3_sub(p[c[2]], p[c[0]]);
        area += (double)vec3_length(vec3_cross(e1, e2)) / (double)mesh->face_count;
    }
    return (float)sqrt(area);
}

static void vertices_have_the_colours_that_rays_meet(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_default();
    Scene *scene = read_scene();
    World *world = scene_build(scene, &run, NULL, &e);
    assert_non_null(world);
    MaterialSet *set = material_set_new(world->material, NULL, world->material_count, NULL, &e);
    Accel *accel = accel_new(world, set, NULL, &run, &e);
    assert_non_null(accel);
    int compared = 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        if (!part->mesh || part->instance ||
            !material_has_pattern(&world->material[part->material])) {
            continue;
        }
        Vec3 *color = vertex_colors(world, part, &run, &e);
        assert_non_null(color);
        Agreement sum = compare(world, accel, part, color, mean_footprint(part->mesh));
        assert_true(sum.met > part->mesh->vertex_count / 20);
        assert_true(sum.difference < 0.2 * sum.spread);
        compared++;
        free(color);
    }
    assert_true(compared >= 2);
    accel_free(accel);
    material_set_free(set);
    world_free(world);
    scene_free(scene);
}

static void white_water_has_the_colour_of_foam(void **state)
{
    (void)state;
    Error e = {0};
    Vec3 position[3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    float foam[3] = {0, 1, 0};
    uint32_t index[3] = {0, 1, 2};
    const Mesh mesh = {.vertex_count = 3,
                       .face_count = 1,
                       .face_size = 3,
                       .position = position,
                       .index = index,
                       .foam = foam};
    const Material lake = {
        .pattern = PATTERN_WATER, .color = {0.1f, 0.2f, 0.3f}, .color2 = {1, 1, 1}};
    ExportSurface surface;
    ExportVertex vertex[3];
    assert_true(export_surface_prepare(&surface, &mesh, &lake,
                                       EXPORT_WANTS_NORMALS | EXPORT_WANTS_COLORS, &e));
    export_surface_vertices(&surface, NULL, (InstanceLook){0.5f, 0.0f}, 0, 3, 1, vertex);
    for (int i = 0; i < 3; i++) {
        Vec3 wanted = foam[i] > 0.0f ? lake.color2 : lake.color;
        assert_float_equal(vec3_distance(vertex[i].color, wanted), 0.0f, 1e-6f);
    }
    export_surface_clear(&surface);
}

static void a_cancelled_run_makes_no_colours(void **state)
{
    (void)state;
    Run run = run_default();
    Scene *scene = read_scene();
    World *world = scene_build(scene, &run, NULL, NULL);
    assert_non_null(world);
    volatile int cancelled = 1;
    run.cancelled = &cancelled;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        Error e = {0};
        assert_null(vertex_colors(world, &world->geometry.part[i], &run, &e));
        assert_int_equal(e.code, ERROR_CANCELLED);
    }
    world_free(world);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_have_the_colours_that_rays_meet),
        cmocka_unit_test(white_water_has_the_colour_of_foam),
        cmocka_unit_test(a_cancelled_run_makes_no_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
