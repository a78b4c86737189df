// Pictures that change a material over a surface, seen in the film's albedo and normal.
#include "tiny_world.h"

#include "image/image.h"
#include "render/accel/accel.h"

#include <math.h>
#include <unistd.h>

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

typedef struct Picture {
    char name[40];
} Picture;

// Writes a picture of one colour, or of two, left and right.
static Picture picture(Vec3 left, Vec3 right)
{
    Picture file = {"/tmp/ramify_maps_XXXXXX.exr"};
    int descriptor = mkstemps(file.name, 4);
    assert_true(descriptor >= 0);
    close(descriptor);
    Image *image = image_new(16, 16, 3, NULL);
    assert_non_null(image);
    for (int i = 0; i < 256; i++) {
        Vec3 c = i % 16 < 8 ? left : right;
        memcpy(image->pixel + 3 * (size_t)i, (float[3]){c.x, c.y, c.z}, 3 * sizeof(float));
    }
    ImageLayer layer = {"", "RGB", image};
    assert_true(image_write_exr(file.name, &layer, 1, NULL, NULL));
    image_free(image);
    return file;
}

// A square of 2 m that faces +Z, with UVs from 0 to 1.
static Mesh *square(bool uv)
{
    Mesh *mesh = quad_mesh(vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0));
    if (uv) {
        mesh->uv = memory_alloc_zero(4, sizeof(Vec2), NULL);
        assert_non_null(mesh->uv);
        mesh->uv[1].x = mesh->uv[2].x = mesh->uv[2].y = mesh->uv[3].y = 1.0f;
    }
    return mesh;
}

static World *world_with(Mesh *mesh)
{
    World *world = tiny_world(16, 16, 4, 1.0f);
    world->camera.fov = 20.0f; // 1.76 m wide
    add_mesh(world, mesh, 0, 0);
    return world;
}

static Film *trace_and_free(World *world)
{
    Film *film = trace(world, 2, NULL);
    world_free(world);
    return film;
}

// A tilt of 30 degrees along v is one about the horizontal axis: up in the picture, whatever the
// size of the square in UVs; from behind the bumps are hollows.
static void normals_tilt_along_the_picture(void **state)
{
    (void)state;
    Picture file = picture(vec3(0.5f, 0.75f, 0.5f + 0.5f * cosf(PI_F / 6.0f)),
                           vec3(0.5f, 0.75f, 0.5f + 0.5f * cosf(PI_F / 6.0f)));
    for (int back = 0; back < 2; back++) {
        for (int uv = 0; uv < 2; uv++) {
            World *world = world_with(square(uv == 1));
            world->material[0].normal_texture = file.name;
            world->camera.position.z = back ? -5.0f : 5.0f;
            Film *film = trace_and_free(world);
            Vec3 n = film->normal[8 * 16 + 8];
            ASSERT_NEAR(n.x, 0.0, 1e-4);
            assert_true(back ? n.y < -0.3f && n.z < -0.8f : n.y > 0.3f && n.z > 0.8f);
            film_free(film);
        }
    }
    unlink(file.name);
}

// Grey 0.5 leaves the surface where it is; black lies half of the depth behind it, white before it.
static void heights_move_the_surface(void **state)
{
    (void)state;
    Picture file = picture(vec3_splat(0.0f), vec3_splat(1.0f));
    for (int off = 0; off < 2; off++) {
        World *world = world_with(square(true));
        assert_true(mesh_compute_normals(world->geometry.part[0].mesh, NULL));
        world->film.width = world->film.height = 200;
        world->material[0].displacement_texture = file.name;
        world->material[0].displacement_depth = 0.2f;
        world->material[0].displacement = off ? DISPLACEMENT_OFF : DISPLACEMENT_AUTO;
        Run run = run_default();
        MaterialSet *set = material_set_new(world->material, NULL, 1, &run, NULL);
        assert_non_null(set);
        Accel *accel = accel_new(world, set, NULL, &run, NULL);
        assert_non_null(accel);
        for (int side = -1; side <= 1; side += 2) {
            Ray ray = {
                .origin = {0.5f * (float)side, 0.31f, 5}, .direction = {0, 0, -1}, .far = INFINITY};
            Hit hit;
            assert_true(accel_intersect(accel, &ray, &hit));
            ASSERT_NEAR(5.0f - hit.t, off ? 0.0 : 0.1 * side, 1e-4);
        }
        accel_free(accel);
        material_set_free(set);
        world_free(world);
    }
    unlink(file.name);
}

// By UVs the picture fills the square: dark left, light right. At half the size it repeats.
static void scale_repeats_the_picture(void **state)
{
    (void)state;
    Picture file = picture(vec3_splat(0.2f), vec3_splat(0.8f));
    static const struct {
        float scale;
        int column;
        double albedo;
    } expected[] = {{0.0f, 4, 0.2}, {0.0f, 12, 0.8}, {0.5f, 2, 0.2},
                    {0.5f, 6, 0.8}, {0.5f, 9, 0.2},  {0.5f, 14, 0.8}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        World *world = world_with(square(true));
        world->material[0].texture = file.name;
        world->material[0].texture_scale = expected[i].scale;
        Film *film = trace_and_free(world);
        ASSERT_NEAR(film->albedo[8 * 16 + expected[i].column].x, expected[i].albedo, 0.03);
        film_free(film);
    }
    unlink(file.name);
}

// Without UVs the picture lies along the axes, in metres of the object's own space: an instance
// that is moved takes it along.
static void triplanar_moves_with_the_object(void **state)
{
    (void)state;
    Picture file = picture(vec3_splat(0.2f), vec3_splat(0.8f));
    for (int moved = 0; moved < 2; moved++) {
        World *world = tiny_world(16, 16, 4, 1.0f);
        world->camera.fov = 20.0f;
        world->material[0].texture = file.name;
        world->material[0].texture_scale = 2.0f; // left half of the picture at 0 .. 1 m
        Part part = {.kind = PART_MESH, .mesh = square(false)};
        part.instance = memory_alloc_zero(1, sizeof *part.instance, NULL);
        assert_non_null(part.instance);
        part.instance[0] =
            transform_compose(vec3(moved ? 0.9f : 0.0f, 0, 0), vec3_splat(0.0f), vec3_splat(1.0f));
        part.instance_count = 1;
        add_part(world, part);
        Film *film = trace_and_free(world);
        ASSERT_NEAR(film->albedo[8 * 16 + 12].x, moved ? 0.8 : 0.2, 0.03);
        ASSERT_NEAR(film->albedo[8 * 16 + 4].x, moved ? 1.0 : 0.8, 0.03); // 1: beside it
        film_free(film);
    }
    unlink(file.name);
}

// A plane that slants by 45 degrees between two axes mixes their pictures by halves.
static void triplanar_mixes_where_it_slants(void **state)
{
    (void)state;
    Picture file = picture(vec3_splat(0.2f), vec3_splat(0.8f));
    World *world = tiny_world(16, 16, 16, 1.0f);
    world->camera.fov = 4.0f;
    world->material[0].texture = file.name;
    world->material[0].texture_scale = 8.0f;
    // x = -z: along z the picture's u is x, near -0.5 (right half); along x it is z, near 0.5
    add_mesh(world, quad_mesh(vec3(-4.5f, -4, 4.5f), vec3(8, 0, -8), vec3(0, 8, 0)), 0, 0);
    world->camera.target = vec3(-0.5f, 0, 0.5f);
    Film *film = trace_and_free(world);
    ASSERT_NEAR(film->albedo[8 * 16 + 8].x, 0.5, 0.03);
    film_free(film);
    unlink(file.name);
}

// A picture of roughness: the same as a material of that roughness, energy included.
static void roughness_multiplies(void **state)
{
    (void)state;
    Picture file = picture(vec3_splat(0.5f), vec3_splat(0.5f));
    double mean[2];
    for (int mapped = 0; mapped < 2; mapped++) {
        World *world = world_with(square(true));
        world->render.samples = 256;
        world->material[0] = material_default(MATERIAL_CONDUCTOR);
        world->material[0].color = vec3_splat(0.9f);
        world->material[0].roughness = mapped ? 0.8f : 0.4f;
        world->material[0].roughness_texture = mapped ? file.name : NULL;
        add_light(world, (Light){.kind = LIGHT_SPHERE,
                                 .radiance = vec3_splat(100.0f),
                                 .center = {1, 1, 5},
                                 .radius = 0.5f});
        Film *film = trace_and_free(world);
        mean[mapped] = mean_luminance(film);
        film_free(film);
    }
    assert_true(mean[0] > 0.1);
    ASSERT_NEAR(mean[1] / mean[0], 1.0, 0.02);
    unlink(file.name);
}

static void transmittance_lets_less_through(void **state)
{
    (void)state;
    Picture file = picture(vec3_splat(0.25f), vec3_splat(0.25f));
    double mean[2];
    for (int mapped = 0; mapped < 2; mapped++) {
        World *world = world_with(square(true));
        world->render.samples = 64;
        world->material[0] = material_default(MATERIAL_LEAF);
        world->material[0].specular = 0.0f;
        world->material[0].transmittance = vec3_splat(0.4f);
        world->material[0].transmittance_texture = mapped ? file.name : NULL;
        add_light(world, (Light){.kind = LIGHT_SPHERE,
                                 .radiance = vec3_splat(100.0f),
                                 .center = {0, 0, -5},
                                 .radius = 0.5f});
        Film *film = trace_and_free(world);
        mean[mapped] = mean_luminance(film);
        film_free(film);
    }
    ASSERT_NEAR(mean[1] / mean[0], 0.25, 0.01);
    unlink(file.name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_tilt_along_the_picture),
        cmocka_unit_test(heights_move_the_surface),
        cmocka_unit_test(scale_repeats_the_picture),
        cmocka_unit_test(triplanar_moves_with_the_object),
        cmocka_unit_test(triplanar_mixes_where_it_slants),
        cmocka_unit_test(roughness_multiplies),
        cmocka_unit_test(transmittance_lets_less_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
