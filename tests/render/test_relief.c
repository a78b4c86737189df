// Relief as geometry near the camera: what rays meet, against the height that the material tells.
#include "render/accel/accel.h"
#include "render/material/pattern.h"
#include "render/material/relief.h"
#include "render/tiny_world.h"

#include <math.h>

enum { SIDES = 48, RINGS = 40 };

#define RADIUS 0.3f

// A stem about y from -1 to 1, as grown ones are: u and v in metres.
static Mesh *stem_mesh(void)
{
    Mesh *mesh = mesh_new(4, (int64_t)SIDES * (RINGS + 1), (int64_t)SIDES * RINGS,
                          MESH_NORMAL | MESH_UV | MESH_RADIUS, NULL);
    assert_non_null(mesh);
    uint32_t *index = mesh->index;
    for (int j = 0; j <= RINGS; j++) {
        for (int i = 0; i < SIDES; i++) {
            float angle = 2.0f * PI_F * (float)i / SIDES, y = 2.0f * (float)j / RINGS - 1.0f;
            int k = j * SIDES + i;
            mesh->normal[k] = vec3(sinf(angle), 0, cosf(angle));
            mesh->position[k] = vec3_add(vec3_scale(mesh->normal[k], RADIUS), vec3(0, y, 0));
            mesh->uv[k] = (Vec2){angle * RADIUS, y};
            mesh->radius[k] = RADIUS;
            if (j < RINGS) {
                uint32_t a = (uint32_t)k, b = (uint32_t)(j * SIDES + (i + 1) % SIDES);
                memcpy(index, (uint32_t[4]){a, b, b + SIDES, a + SIDES}, 16);
                index += 4;
            }
        }
    }
    return mesh;
}

static World *stem_world(BarkKind bark, float distance)
{
    World *world = tiny_world(320, 240, 1, 0.3f);
    world->camera.position = vec3(0, 0, distance);
    world->camera.fov = 50;
    Material *m = &world->material[0];
    m->pattern = PATTERN_BARK;
    m->bark = bark;
    m->pattern_depth = 0.02f;
    m->color2 = vec3_splat(0.1f);
    add_mesh(world, stem_mesh(), 0, 0);
    return world;
}

typedef struct Scan {
    Accel *accel;
    MaterialSet *set;
} Scan;

static Scan scan_begin(const World *world)
{
    Run run = run_default();
    Error e = {0};
    Scan scan = {.set = material_set_new(world->material, NULL, world->material_count, &run, &e)};
    scan.accel = scan.set ? accel_new(world, scan.set, NULL, &run, &e) : NULL;
    if (!scan.accel) {
        fail_msg("%s", e.message);
    }
    return scan;
}

static void scan_end(Scan *scan)
{
    accel_free(scan->accel);
    material_set_free(scan->set);
}

// What a horizontal ray toward the axis meets at this angle and height.
static SurfacePoint look(const Scan *scan, float angle, float y)
{
    Vec3 out = vec3(sinf(angle), 0, cosf(angle));
    Ray ray = {.origin = vec3_add(vec3_scale(out, 2.0f), vec3(0, y, 0)),
               .direction = vec3_neg(out),
               .far = INFINITY};
    Hit hit;
    assert_true(accel_intersect(scan->accel, &ray, &hit));
    SurfacePoint point;
    accel_surface(scan->accel, &ray, &hit, &point);
    return point;
}

static float from_axis(Vec3 p)
{
    return hypotf(p.x, p.z);
}

static void rays_meet_the_height_of_the_pattern(void **state)
{
    (void)state;
    for (int bark = BARK_FURROWED; bark <= BARK_GNARLED; bark++) {
        World *world = stem_world((BarkKind)bark, 0.9f);
        Scan scan = scan_begin(world);
        float pixel = 2.0f * tanf(25.0f * PI_F / 180.0f) / 240.0f;
        double error = 0.0, low = 1.0, high = -1.0;
        int count = 0;
        for (int i = 0; i < 60; i++) {
            for (int j = 0; j < 20; j++) {
                float angle = 0.02f * (float)(i - 30), y = 0.0117f * (float)(j - 10);
                SurfacePoint point = look(&scan, angle, y);
                assert_float_equal(from_axis(point.object_position), RADIUS, 2e-4f);
                assert_true(point.displaced > 0.999f);
                point.footprint =
                    pixel * vec3_distance(point.object_position, world->camera.position);
                float height = relief_height(scan.set, &point);
                float met = from_axis(point.position) - RADIUS;
                error += (double)fabsf(met - height);
                low = fmin(low, (double)met);
                high = fmax(high, (double)met);
                count++;
            }
        }
        // Between vertices 1.5 pixels (3 mm) apart the facets cut off steep walls.
        assert_true(error / count < 8e-4);
        assert_true(high - low >
                    (bark == BARK_FURROWED || bark == BARK_PLATES || bark == BARK_GNARLED
                         ? 0.012
                         : 0.0005));
        scan_end(&scan);
        world_free(world);
    }
}

// The outline: bumps leave it a straight line, displacement does not.
static void only_displacement_changes_the_outline(void **state)
{
    (void)state;
    double spread[2];
    for (int off = 0; off < 2; off++) {
        World *world = stem_world(BARK_FURROWED, 0.9f);
        world->material[0].displacement = off ? DISPLACEMENT_OFF : DISPLACEMENT_AUTO;
        Scan scan = scan_begin(world);
        double sum = 0.0, squares = 0.0;
        const int rows = 60;
        for (int j = 0; j < rows; j++) {
            float x = 0.34f;
            Hit hit;
            bool met = false;
            for (; !met && x > 0.25f; x -= 0.0005f) {
                Ray ray = {.origin = {x, 0.005f * ((float)j - 0.5f * (float)rows), 2},
                           .direction = {0, 0, -1},
                           .far = INFINITY};
                met = accel_intersect(scan.accel, &ray, &hit);
            }
            sum += (double)x;
            squares += (double)(x * x);
        }
        spread[off] = sqrt(fmax(squares / rows - sum * sum / rows / rows, 0.0));
        scan_end(&scan);
        world_free(world);
    }
    assert_true(spread[0] > 0.0006);
    assert_true(spread[1] < 0.0001);
}

// Far away, and for copies, the mesh stays as it is; so does its share of bumps.
static void far_stems_and_copies_keep_bumps(void **state)
{
    (void)state;
    for (int copy = 0; copy < 2; copy++) {
        World *world = stem_world(BARK_FURROWED, copy ? 0.9f : 40.0f);
        Part *part = &world->geometry.part[0];
        if (copy) {
            part->instance = memory_alloc(1, sizeof *part->instance, NULL);
            assert_non_null(part->instance);
            *part->instance = transform_identity();
            part->instance_count = 1;
        }
        Scan scan = scan_begin(world);
        SurfacePoint point = look(&scan, 0.3f, 0.1f);
        assert_true(point.displaced <= 0.0f);
        assert_true(from_axis(point.position) <= RADIUS);
        scan_end(&scan);
        world_free(world);
    }
}

// On an upright stem whose axis is y: at this height, in the direction n, u m around.
static SurfacePoint stem_point(Vec3 n, float u, float y)
{
    return (SurfacePoint){.object_position = vec3_madd(vec3(0, y, 0), RADIUS, n),
                          .geometric_normal = n,
                          .normal = n,
                          .tangent_u = vec3(n.z, 0, -n.x),
                          .tangent_v = vec3(0, 1, 0),
                          .uv = {u, y},
                          .radius = RADIUS,
                          .footprint = 1e-4f};
}

// Moss is on the north side (-z) and near the foot; scars make dents and rings.
static void moss_and_scars_grow_where_they_are_asked_for(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_BARK;
    m.bark = BARK_SMOOTH;
    m.moss = 0.45f;
    double green[2][2] = {{0, 0}, {0, 0}};
    float deepest = 0.0f, highest = 0.0f;
    for (int i = 0; i < 4000; i++) {
        float angle = 0.1f * (float)(i % 20 - 10), y = 0.001f * (float)i;
        int north = i % 2, high = y > 2.0f;
        Vec3 n = vec3(sinf(angle), 0, north ? -cosf(angle) : cosf(angle));
        SurfacePoint point = stem_point(n, angle * RADIUS, y);
        PatternShade shade = {.color = m.color, .normal = n};
        pattern_apply(&m, &point, &shade);
        green[north][high] += (double)(shade.color.y - shade.color.x);
        Material scarred = m;
        scarred.moss = 0.0f;
        scarred.scars = 1.0f;
        float height = pattern_height(&scarred, &point);
        deepest = fminf(deepest, height);
        highest = fmaxf(highest, height);
    }
    assert_true(green[1][1] > green[0][1] + 1.0);
    assert_true(green[0][0] + green[1][0] > green[0][1] + green[1][1] + 1.0);
    assert_true(deepest < -0.01f && highest > 0.008f);
    assert_true(highest - deepest < relief_size(&m, RADIUS) + 0.06f);
}

// Most scars on smooth bark are closed: few of the places that lie below the bark lie deep, where
// wood is bare.
static void few_scars_of_smooth_bark_are_open(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_BARK;
    m.bark = BARK_SMOOTH;
    m.pattern_depth = 0.0f;
    m.scars = 1.0f;
    int below = 0, deep = 0;
    for (int i = 0; i < 48 * 4000; i++) {
        float angle = 2.0f * PI_F * (float)(i % 48) / 48.0f, y = 0.01f * (float)(i / 48);
        Vec3 n = vec3(sinf(angle), 0, cosf(angle));
        SurfacePoint point = stem_point(n, angle * RADIUS, y);
        float height = pattern_height(&m, &point);
        below += height < -0.0005f;
        deep += height < -0.006f;
    }
    assert_true(below > 400 && deep > 40);
    assert_true(3 * deep < 2 * below);
}

// Hollows are deep and dark in a roll of callus, and rotten wood in them is rough, and brown-grey:
// not orange.
static void hollows_are_rough_and_dark(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_BARK;
    m.bark = BARK_GNARLED;
    m.color = m.color2 = vec3(0.2f, 0.18f, 0.16f);
    m.pattern_depth = 0.0f;
    m.hollows = 1.0f;
    double rough = 0.0, within = 0.0, outside = 0.0, red = 0.0, blue = 0.0;
    int deep = 0, level = 0;
    float highest = 0.0f;
    for (int i = 0; i < 48 * 800; i++) {
        float angle = 2.0f * PI_F * (float)(i % 48) / 48.0f, y = 2.0f + 0.01f * (float)(i / 48);
        Vec3 n = vec3(sinf(angle), 0, cosf(angle));
        SurfacePoint point = stem_point(n, angle * RADIUS, y);
        PatternShade shade = {.color = m.color, .normal = n};
        pattern_apply(&m, &point, &shade);
        float height = pattern_height(&m, &point);
        highest = fmaxf(highest, height);
        if (height < -0.54f * RADIUS) {
            point.object_position.y += 0.01f;
            point.uv.y += 0.01f;
            rough += (double)fabsf(pattern_height(&m, &point) - height);
            within += (double)shade.color.y;
            red += (double)shade.color.x;
            blue += (double)shade.color.z;
            deep++;
        } else if (height > -1e-6f && height < 1e-6f) {
            outside += (double)shade.color.y;
            level++;
        }
    }
    assert_true(deep > 500 && level > 5000);
    assert_true(within / deep < 0.6 * outside / level && red > 1.05 * within);
    assert_true(red > 1.2 * blue && red < 1.7 * blue);
    assert_true(rough / deep > 0.002);
    assert_true(highest > 0.08f * RADIUS && highest < 0.25f * RADIUS);
}

// A change of the relief rebuilds; one of the colour does not.
static void structures_fit_the_relief(void **state)
{
    (void)state;
    World *world = stem_world(BARK_FURROWED, 0.9f);
    Scan scan = scan_begin(world);
    world->material[0].color = vec3(0.1f, 0.5f, 0.2f);
    assert_true(accel_fits_materials(scan.accel));
    world->material[0].pattern_depth = 0.01f;
    assert_false(accel_fits_materials(scan.accel));
    scan_end(&scan);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_the_height_of_the_pattern),
        cmocka_unit_test(only_displacement_changes_the_outline),
        cmocka_unit_test(far_stems_and_copies_keep_bumps),
        cmocka_unit_test(moss_and_scars_grow_where_they_are_asked_for),
        cmocka_unit_test(few_scars_of_smooth_bark_are_open),
        cmocka_unit_test(hollows_are_rough_and_dark),
        cmocka_unit_test(structures_fit_the_relief),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
