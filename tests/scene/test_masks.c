// Layers of materials: where they lie, how they mix, and what is refused.
#include "scene_fixture.h"

#include "land/where.h"
#include "render/material/bsdf.h"
#include "render/material/mask.h"
#include "render/world.h"
#include "scene/needs.h"

#include <stdlib.h>

static World *build(Fixture *fixture, const char *text, int threads, Scene **scene)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    *scene = fixture_read(fixture, text);
    World *world = scene_build(*scene, &run, NULL, &e);
    if (!world) {
        fail_msg("%s", e.message);
    }
    return world;
}

// ---- masks

static void splines_keep_constants_and_planes_and_mirror_the_rest(void **state)
{
    (void)state;
    enum { SIDE = 9 };
    uint8_t share[SIDE * SIDE];
    Mask mask = {SIDE, SIDE, {2.0f, 3.0f}, {-8.0f, 5.0f}, share};
    memset(share, 204, sizeof share);
    assert_true(fabsf(mask_at(&mask, 1.7f, -400.0f) - 0.8f) < 1e-6f);
    for (int i = 0; i < SIDE * SIDE; i++) {
        share[i] = (uint8_t)(10 * (i % SIDE) + 15 * (i / SIDE));
    }
    for (int k = 0; k < 50; k++) { // inside, off the mirrored rim
        float u = 1.0f + 0.12f * (float)k, v = 7.0f - 0.1f * (float)k;
        float x = -8.0f + 2.0f * u, z = 5.0f + 3.0f * v;
        assert_true(fabsf(mask_at(&mask, x, z) - (10.0f * u + 15.0f * v) / 255.0f) < 1e-5f);
        float beyond = mask_at(&mask, -16.0f - x, z), past = mask_at(&mask, x, 58.0f - z);
        assert_true(fabsf(beyond - mask_at(&mask, x, z)) < 1e-5f);
        assert_true(fabsf(past - mask_at(&mask, x, z)) < 1e-5f);
    }
}

#define LAYERS                                                                                  \
    "materials:\n"                                                                              \
    "  - {name: top, color: [0.8, 0.6, 0.2]}\n"                                                 \
    "  - name: m\n"                                                                             \
    "    color: [0.2, 0.2, 0.2]\n"                                                              \
    "    layers:\n"                                                                             \
    "      - {material: top, where: [{map: slope, range: [0, 12], fade: 6}]}\n"                 \
    "      - {material: top, where: [{map: wetness, range: [7, 30]}, {map: aspect, range: [0, " \
    "90], "                                                                                     \
    "fade: 30}]}\n"
#define TERRAIN                                                                              \
    "objects: [{name: land, material: m, terrain: {form: noise, size: 500, resolution: 64, " \
    "position: [300, 40, -200], noise: {iterations: 5}, beyond: 1, erosion: {thermal: 0.5}}}]\n"

// The shares of a terrain's masks are those of its conditions on its own samples.
static void masks_are_conditions_on_the_terrain(void **state)
{
    Scene *scene;
    World *world = build(*state, LAYERS TERRAIN, 2, &scene);
    const Geometry *geometry = &world->geometry;
    const HeightField *land = geometry->part[0].land;
    assert_non_null(land);
    assert_int_equal(world->masks.count, 2);
    assert_int_equal(world->masks.part_count, geometry->count);
    assert_true(geometry->count >= 2 && geometry->part[1].instance); // mirrored around the square
    assert_true(world->masks.of_part[0] == 0 && world->masks.of_part[1] == 0);
    Run run = run_default();
    for (int k = 0; k < 2; k++) {
        const MaterialLayer *layer = &scene->materials[1].layers[k];
        const Mask *mask = &world->masks.mask[k];
        Where where;
        assert_true(where_init(&where, layer->where, layer->where_count, land, &run, NULL));
        assert_true(mask->origin.x == 50.0f && mask->origin.y == -450.0f);
        int some = 0;
        for (int64_t i = 0; i < height_field_count(land); i++) {
            float share = (float)mask->share[i] / 255.0f;
            assert_true(fabsf(share - where_share_of(&where, i)) <= 0.5f / 255.0f + 1e-6f);
            some += share > 0.0f && share < 1.0f;
        }
        assert_true(some > 20); // the fade
        where_free(&where);
    }
    world_free(world);
    scene_free(scene);
}

static void threads_change_no_share(void **state)
{
    Scene *scenes[2];
    World *one = build(*state, LAYERS TERRAIN, 1, &scenes[0]);
    World *many = build(*state, LAYERS TERRAIN, 4, &scenes[1]);
    for (int k = 0; k < 2; k++) {
        const Mask *a = &one->masks.mask[k], *b = &many->masks.mask[k];
        assert_memory_equal(a->share, b->share, (size_t)a->columns * (size_t)a->rows);
    }
    world_free(one);
    world_free(many);
    scene_free(scenes[0]);
    scene_free(scenes[1]);
}

// A ball from above: slope at a distance r from the axis is asin r.
static void any_surface_has_masks(void **state)
{
    Scene *scene;
    World *world = build(*state,
                         LAYERS "objects: [{name: ball, material: m, shape: {envelope: [{shape: "
                                "sphere, size: 2, position: [5, 1, 3]}]}}]\n",
                         2, &scene);
    assert_int_equal(world->masks.count, 2);
    assert_true(mask_at(&world->masks.mask[0], 5.0f, 3.0f) > 0.99f);
    assert_true(mask_at(&world->masks.mask[0], 5.7f, 3.0f) < 0.01f);
    assert_null(world->geometry.part[0].land);
    world_free(world);
    scene_free(scene);
}

static void nothing_is_kept_without_layers(void **state)
{
    Scene *scene;
    World *world = build(*state, "materials: [{name: m}]\n" TERRAIN, 2, &scene);
    assert_int_equal(world->masks.count, 0);
    assert_null(world->geometry.part[0].land);
    world_free(world);
    scene_free(scene);
}

static void masks_are_counted_in_the_estimate(void **state)
{
    Scene *with = fixture_read(*state, LAYERS TERRAIN);
    Scene *without = fixture_read(*state, "materials: [{name: m}]\n" TERRAIN);
    double more = scene_memory(with) - scene_memory(without);
    assert_true(more >= 2.0 * 65 * 65 && more < 100.0 * 65 * 65);
    scene_free(with);
    scene_free(without);
}

// ---- mixing

static uint8_t half[4] = {128, 128, 128, 128};
static int32_t first_of_part[1] = {0};
static Mask half_mask = {2, 2, {1.0f, 1.0f}, {0.0f, 0.0f}, half};

static SurfacePoint point_at(float x)
{
    return (SurfacePoint){.position = vec3(x, 0, 1),
                          .object_position = vec3(x, 0, 1),
                          .geometric_normal = vec3(0, 1, 0),
                          .normal = vec3(0, 1, 0),
                          .material = 1};
}

// Colours are the mean by the share; matt and coated lobes are drawn as often as they cover the
// surface; each reflects no more than comes.
static void layers_mix_by_their_share(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        MaterialLayer layer = {.material = (char *)"top", .strength = 0.5f};
        Material m[2] = {material_default(kind ? MATERIAL_PRINCIPLED : MATERIAL_DIFFUSE),
                         material_default(MATERIAL_DIFFUSE)};
        strcpy(m[0].name, "top");
        strcpy(m[1].name, "below");
        m[0].color = vec3(0.9f, 0.5f, 0.1f);
        m[1].color = vec3(0.1f, 0.1f, 0.1f);
        m[1].layers = &layer;
        m[1].layer_count = 1;
        MaskSet masks = {&half_mask, 1, 1, first_of_part, 1};
        MaterialSet *set = material_set_new(m, NULL, 2, NULL, NULL);
        assert_non_null(set);
        float share = 0.5f * 128.0f / 255.0f;
        int coated = 0;
        for (int i = 0; i < 4000; i++) {
            SurfacePoint point = point_at(0.001f * (float)i);
            material_set_use_masks(set, NULL);
            Bsdf plain = bsdf_at(set, &point, vec3(0, 1, 0));
            assert_true(fabsf(plain.albedo.x - 0.1f) < 1e-6f);
            material_set_use_masks(set, &masks);
            Bsdf b = bsdf_at(set, &point, vec3_normalize(vec3(0.6f, 0.5f, 0.0f)));
            assert_true(fabsf(b.albedo.x - lerpf(0.1f, 0.9f, share)) < 1e-5f);
            assert_true(fabsf(b.albedo.y - lerpf(0.1f, 0.5f, share)) < 1e-5f);
            coated += !b.lambert;
        }
        double wanted = kind ? (double)share : 0.0, spread = sqrt(wanted * (1.0 - wanted) / 4000.0);
        assert_true(fabs(coated / 4000.0 - wanted) <= 4.0 * spread);
        material_set_free(set);
    }
}

// A mask whose border lies along a wall: the wall's top is covered, its foot is not.
static float share_on_wall(const MaterialSet *set, Vec3 normal, float along, float up)
{
    SurfacePoint point = point_at(8.0f);
    point.position = point.object_position = vec3(8.0f, up, 4.0f + along);
    point.geometric_normal = point.normal = normal;
    Bsdf b = bsdf_at(set, &point, normal);
    return (b.albedo.x - 0.1f) / 0.8f;
}

// Fray moves a border along the surface: on level ground the border at a place wanders, and on an
// upright wall, which is above one line of the mask, it does not cover what lies beside the wall.
static void fray_moves_along_the_surface(void **state)
{
    (void)state;
    enum { SIDE = 17, PLACES = 400 };
    static uint8_t border[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        border[i] = i % SIDE > SIDE / 2 ? 255 : 0;
    }
    Mask mask = {SIDE, SIDE, {1.0f, 1.0f}, {0.0f, 0.0f}, border};
    MaskSet masks = {&mask, 1, 1, first_of_part, 1};
    MaterialLayer layer = {.material = (char *)"top", .strength = 1.0f, .fray = 1.0f};
    Material m[2] = {material_default(MATERIAL_DIFFUSE), material_default(MATERIAL_DIFFUSE)};
    strcpy(m[0].name, "top");
    strcpy(m[1].name, "below");
    m[0].color = vec3(0.9f, 0.9f, 0.9f);
    m[1].color = vec3(0.1f, 0.1f, 0.1f);
    m[1].layers = &layer;
    m[1].layer_count = 1;
    MaterialSet *set = material_set_new(m, NULL, 2, NULL, NULL);
    assert_non_null(set);
    material_set_use_masks(set, &masks);
    float range[2];
    for (int wall = 0; wall < 2; wall++) {
        float least = 1.0f, most = 0.0f;
        Vec3 normal = wall ? vec3(1, 0, 0) : vec3(0, 1, 0);
        for (int i = 0; i < PLACES; i++) {
            float share = share_on_wall(set, normal, 0.02f * (float)i, 0.13f * (float)i);
            least = fminf(least, share);
            most = fmaxf(most, share);
        }
        range[wall] = most - least;
    }
    printf("    shares differ by %.2f on level ground, by %.4f on a wall\n", (double)range[0],
           (double)range[1]);
    assert_true(range[0] > 0.3f && range[1] < 1e-4f);
    material_set_free(set);
}

// ---- what is refused

static void wrong_layers_are_refused(void **state)
{
    const char *const wrong[][2] = {
        {"materials: [{name: m, layers: [{material: nix}]}]\n" TERRAIN,
         "materials.m.layers.0.material: there is no material 'nix'"},
        {"materials: [{name: m, layers: [{material: leaf}]}]\n" TERRAIN,
         "'leaf' is no layer; it must be diffuse or principled"},
        {"materials: [{name: m, layers: [{material: m}]}]\n" TERRAIN, "'m' is no layer"},
        {"materials: [{name: m, kind: conductor, layers: []}]\n" TERRAIN, "layers"},
        {"materials: [{name: m, layers: [{material: clay, where: [{map: beauty, range: [0, "
         "1]}]}]}]\n" TERRAIN,
         "beauty"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        fixture_refuse(*state, wrong[i][0], wrong[i][1], 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splines_keep_constants_and_planes_and_mirror_the_rest),
        cmocka_unit_test(masks_are_conditions_on_the_terrain),
        cmocka_unit_test(threads_change_no_share),
        cmocka_unit_test(any_surface_has_masks),
        cmocka_unit_test(nothing_is_kept_without_layers),
        cmocka_unit_test(masks_are_counted_in_the_estimate),
        cmocka_unit_test(layers_mix_by_their_share),
        cmocka_unit_test(fray_moves_along_the_surface),
        cmocka_unit_test(wrong_layers_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
