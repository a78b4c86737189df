// Detail that follows the size on the screen: which form of a leaf or tuft is drawn, that it looks
// the same, and triangles joined to quads.
#include "render/accel/accel_detail.h"
#include "render/accel/accel_pairs.h"

#include "image/flip.h"
#include "mesh/grass.h"
#include "mesh/leaf/leaf.h"
#include "render/tiny_world.h"

static const LeafParams LEAF = {.length = 0.11f,
                                .width = 0.07f,
                                .petiole = 0.012f,
                                .fold = 20.0f,
                                .curl = 25.0f,
                                .wave = 0.05f,
                                .lobes = 4,
                                .lobe_depth = 0.42f,
                                .detail = 1};
static const GrassParams TUFT = {
    .blades = 22, .height = 0.36f, .width = 0.0065f, .spread = 0.09f, .lean = 32, .bend = 85};

static double area(const Mesh *mesh)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        Vec3 p[4];
        for (int k = 0; k < 4; k++) {
            p[k] = mesh->position[mesh->index[4 * f + k]];
        }
        Vec3 a = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
        Vec3 b = vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[0]));
        sum += 0.5 * (double)(vec3_length(a) + vec3_length(b));
    }
    return sum;
}

static Part leaf_part(void)
{
    Part part = {.kind = PART_MESH, .mesh = leaf_mesh_new(&LEAF, 3, NULL)};
    for (int i = 0; i < leaf_coarse_levels(&LEAF); i++) {
        part.coarse[i].mesh = leaf_mesh_coarse(&LEAF, 3, i, &part.coarse[i].error, NULL);
        assert_non_null(part.coarse[i].mesh);
    }
    return part;
}

static Part tuft_part(void)
{
    Part part = {.kind = PART_MESH, .mesh = grass_tuft_new(&TUFT, 3, NULL)};
    for (int i = 0; i < GRASS_COARSE_LEVELS; i++) {
        part.coarse[i].mesh = grass_tuft_coarse(&TUFT, 3, i, &part.coarse[i].error, NULL);
        assert_non_null(part.coarse[i].mesh);
    }
    return part;
}

static void coarse_forms_have_the_same_area(void **state)
{
    (void)state;
    Part parts[] = {leaf_part(), tuft_part()};
    for (int p = 0; p < 2; p++) {
        double fine = area(parts[p].mesh);
        for (int i = 0; i < PART_COARSE_MOST && parts[p].coarse[i].mesh; i++) {
            const Mesh *mesh = parts[p].coarse[i].mesh;
            assert_in_range((int)(100.0 * area(mesh) / fine + 0.5), 92, 108);
            int64_t before =
                i > 0 ? parts[p].coarse[i - 1].mesh->face_count : parts[p].mesh->face_count;
            assert_true(10 * mesh->face_count < 6 * before);
            assert_true(parts[p].coarse[i].error > (i > 0 ? parts[p].coarse[i - 1].error : 0.0f));
        }
        part_free_meshes(&parts[p]);
    }
}

static void the_nearest_view_decides(void **state)
{
    (void)state;
    Part part = leaf_part();
    Transform place = transform_identity();
    part.instance = &place;
    part.instance_count = 1;
    Vec3 eye[] = {{0, 0, 1000}, {0, 0, 1}};
    float reach = detail_reach(part.mesh);
    Views far = {eye, 1, 1e-3f, 0.3f}, both = {eye, 2, 1e-3f, 0.3f}, none = {0};
    assert_int_equal(detail_level(&part, 0, reach, &far), 2);
    assert_int_equal(detail_level(&part, 0, reach, &both), 0);
    assert_int_equal(detail_level(&part, 0, reach, &none), 0);
    eye[0].z = 3.4f * part.coarse[0].error / 1e-3f + 1.1f * reach; // just beyond its first level
    assert_int_equal(detail_level(&part, 0, reach, &far), 1);
    place.m[1][1] = 2.0f; // twice as large: seen in full
    assert_int_equal(detail_level(&part, 0, reach, &far), 0);
    part_free_meshes(&part);
}

// ---- pictures

enum { WIDTH = 160, HEIGHT = 160, INSTANCES = 3000, SAMPLES = 96 };

// Things in a box of 2 m, upright or turned at random.
static void add_things(World *world, Part part, bool upright)
{
    part.instance = memory_alloc(INSTANCES, sizeof(Transform), NULL);
    part.instance_count = INSTANCES;
    for (int i = 0; i < INSTANCES; i++) {
        uint64_t key = random_key(9, (uint64_t)i);
        Vec3 y = upright ? vec3(0, 1, 0) : random_direction(random_key(key, 1));
        Vec3 x = vec3_perpendicular(y);
        Vec3 at =
            vec3(random_range(random_key(key, 2), -1, 1), random_range(random_key(key, 3), -1, 1),
                 random_range(random_key(key, 4), -1, 1));
        part.instance[i] = transform_from_axes(x, y, vec3_cross(x, y), at);
    }
    add_part(world, part);
}

// Twigs of 0.4 mm to 4 mm in that box.
static void add_twigs(World *world)
{
    enum { CURVES = 300, POINTS = 4 };
    CurveSet *curves = curves_new((int64_t)CURVES * POINTS, CURVES, NULL);
    assert_non_null(curves);
    for (int i = 0; i < CURVES; i++) {
        uint64_t key = random_key(11, (uint64_t)i);
        Vec3 p = vec3_scale(random_direction(random_key(key, 1)), 0.9f);
        Vec3 d = random_direction(random_key(key, 2));
        curves->first[i] = (int64_t)i * POINTS;
        for (int k = 0; k < POINTS; k++) {
            curves->position[i * POINTS + k] = p;
            curves->radius[i * POINTS + k] = 0.004f - 0.0012f * (float)k;
            d = vec3_madd(d, 0.3f, random_direction(random_key(key, 3 + (uint64_t)k)));
            p = vec3_madd(p, 0.1f, vec3_normalize(d));
        }
    }
    curves->first[CURVES] = (int64_t)CURVES * POINTS;
    add_part(world, (Part){.kind = PART_CURVES, .curves = curves});
}

static Image *picture(const World *world)
{
    Film *film = film_new(WIDTH, HEIGHT, NULL);
    Run run = {.threads = 2};
    Error e = {0};
    Renderer *renderer = renderer_new(world, NULL, &run, &e);
    assert_non_null(renderer);
    RenderStats stats;
    assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, &e));
    Image *image = image_new(WIDTH, HEIGHT, 3, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        Vec3 c = film->color[i];
        float channel[3] = {c.x, c.y, c.z};
        for (int k = 0; k < 3; k++) {
            image->pixel[3 * i + k] = sqrtf(fminf(channel[k], 1.0f));
        }
    }
    renderer_free(renderer);
    film_free(film);
    return image;
}

// FLIP of the world in the detail that its camera sees and in full.
static double difference(World *world)
{
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3(0.5f, 0.6f, 0.8f);
    world->material[0].color = vec3(0.1f, 0.2f, 0.05f);
    Image *chosen = picture(world);
    world->render.detail = 0.0f;
    Image *full = picture(world);
    Image *map = image_flip(full, chosen, FLIP_PIXELS_PER_DEGREE, NULL);
    double flip = image_mean(map);
    assert_true(memcmp(full->pixel, chosen->pixel, sizeof(float) * 3 * WIDTH * HEIGHT) != 0);
    image_free(map);
    image_free(full);
    image_free(chosen);
    world_free(world);
    return flip;
}

static World *distant_world(void)
{
    World *world = tiny_world(WIDTH, HEIGHT, SAMPLES, 0.2f);
    world->camera.position = vec3(0, 0, 28);
    world->camera.fov = 9.16f; // a pixel of 1 mrad
    world->render.detail = 0.3f;
    return world;
}

static void distant_leaves_look_the_same(void **state)
{
    (void)state;
    World *world = distant_world();
    add_things(world, leaf_part(), false);
    assert_true(difference(world) < 0.02);
}

static void distant_grass_looks_the_same(void **state)
{
    (void)state;
    World *world = distant_world();
    world->camera.position.z = 40.0f;
    add_things(world, tuft_part(), true);
    assert_true(difference(world) < 0.02);
}

static void distant_twigs_look_the_same(void **state)
{
    (void)state;
    World *world = distant_world();
    add_twigs(world);
    assert_true(difference(world) < 0.02);
}

// ---- pairs

static Vec3 on_quad(const Vec3 *p, const uint32_t *corner, float u, float v)
{
    bool second = u + v > 1.0f;
    Vec3 a = p[corner[second ? 2 : 0]], b = p[corner[second ? 3 : 1]],
         c = p[corner[second ? 1 : 3]];
    float x = second ? 1.0f - u : u, y = second ? 1.0f - v : v;
    return vec3_madd(vec3_madd(a, x, vec3_sub(b, a)), y, vec3_sub(c, a));
}

static void a_hit_of_a_pair_is_one_of_its_triangles(void **state)
{
    (void)state;
    const uint32_t a[3] = {0, 1, 2}, b[3] = {2, 1, 3}; // share the edge 1 2
    const Vec3 p[6] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {5, 0, 0}, {5, 1, 0}};
    for (uint32_t turn = 0; turn < 9; turn++) {
        Mesh *mesh = mesh_new(3, 6, 3, 0, NULL);
        memcpy(mesh->position, p, sizeof p);
        const uint32_t alone[3] = {4, 5, 0};
        for (uint32_t k = 0; k < 3; k++) {
            mesh->index[k] = a[(k + turn) % 3];
            mesh->index[3 + k] = b[(k + turn / 3) % 3];
            mesh->index[6 + k] = alone[k];
        }
        Pairs pairs;
        assert_true(pairs_new(&pairs, mesh, NULL));
        assert_int_equal(pairs.count, 2);
        const float uv[][2] = {{0.2f, 0.3f}, {0.6f, 0.1f}, {0.9f, 0.4f}, {0.5f, 0.8f}};
        for (int i = 0; i < 4; i++) {
            for (int64_t q = 0; q < 2; q++) {
                float u = uv[i][0], v = uv[i][1];
                if (q == 1 && u + v > 1.0f) {
                    continue; // the half without area
                }
                Vec3 want = on_quad(p, pairs.corner + 4 * q, u, v);
                uint32_t face = pairs_triangle(pairs.face[q], &u, &v);
                assert_int_equal(face, q == 1 ? 2 : uv[i][0] + uv[i][1] > 1.0f);
                const uint32_t *corner = mesh->index + (size_t)3 * face;
                Vec3 c = p[corner[0]];
                Vec3 got = vec3_madd(vec3_madd(c, u, vec3_sub(p[corner[1]], c)), v,
                                     vec3_sub(p[corner[2]], c));
                assert_true(vec3_distance(want, got) < 1e-6f);
            }
        }
        pairs_clear(&pairs);
        mesh_free(mesh);
    }
}

static void triangles_without_partners_stay(void **state)
{
    (void)state;
    Mesh *mesh = mesh_new(3, 9, 3, 0, NULL);
    for (uint32_t i = 0; i < 9; i++) {
        mesh->index[i] = i;
    }
    Pairs pairs;
    assert_true(pairs_new(&pairs, mesh, NULL));
    assert_int_equal(pairs.count, 0);
    assert_null(pairs.corner);
    mesh_free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coarse_forms_have_the_same_area),
        cmocka_unit_test(the_nearest_view_decides),
        cmocka_unit_test(distant_leaves_look_the_same),
        cmocka_unit_test(distant_grass_looks_the_same),
        cmocka_unit_test(distant_twigs_look_the_same),
        cmocka_unit_test(a_hit_of_a_pair_is_one_of_its_triangles),
        cmocka_unit_test(triangles_without_partners_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
