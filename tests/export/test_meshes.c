// OBJ, PLY, STL and GLB: Assimp reads back what was written; refusals and interrupts harm nothing.
#include "testing.h"

#include "base/memory.h"
#include "base/random.h"
#include "export/formats.h"
#include "export/pieces.h"
#include "render/world.h"
#include "shape/import.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct Fixture {
    char folder[64], path[128];
} Fixture;

static int set_up(void **state)
{
    Fixture *fixture = calloc(1, sizeof *fixture);
    strcpy(fixture->folder, "/tmp/ramify_export_XXXXXX");
    *state = fixture;
    return mkdtemp(fixture->folder) ? 0 : -1;
}

static int tear_down(void **state)
{
    Fixture *fixture = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", fixture->folder);
    int status = system(command);
    free(fixture);
    return status;
}

static const char *path_of(Fixture *fixture, const char *name)
{
    snprintf(fixture->path, sizeof fixture->path, "%s/%s", fixture->folder, name);
    return fixture->path;
}

// A closed box of quads about the origin, half as wide as `half`; with everything at its vertices
// unless bare.
static Mesh *box(Vec3 half, bool bare)
{
    static const uint32_t faces[24] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                                       2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    Mesh *mesh =
        mesh_new(4, 8, 6, bare ? 0 : MESH_NORMAL | MESH_UV | MESH_RADIUS | MESH_BIRTH, NULL);
    assert_non_null(mesh);
    memcpy(mesh->index, faces, sizeof faces);
    for (int i = 0; i < 8; i++) {
        mesh->position[i] =
            vec3(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
        if (!bare) {
            mesh->uv[i] = (Vec2){0.1f * (float)i, 0.3f};
            mesh->radius[i] = 0.25f + (float)i;
            mesh->birth[i] = 0.125f * (float)i;
        }
    }
    assert_true(bare || mesh_compute_normals(mesh, NULL));
    return mesh;
}

static CurveSet *curves(void)
{
    CurveSet *set = curves_new(400, 100, NULL);
    assert_non_null(set);
    for (int64_t i = 0; i < 400; i++) {
        set->position[i] = vec3(0.1f * (float)(i / 4), 3.0f + 0.2f * (float)(i % 4), -2.0f);
        set->radius[i] = 0.02f;
        set->along[i] = 0.2f * (float)(i % 4);
    }
    for (int64_t i = 0; i <= 100; i++) {
        set->first[i] = 4 * i;
    }
    return set;
}

// A skin, boxes without normals at 6 places (one mirrored, one stretched), hairs: objects a and b.
static World *make_world(bool sheared)
{
    World *world = world_new(NULL);
    assert_non_null(world);
    world->material = memory_alloc_zero(2, sizeof *world->material, NULL);
    world->material_count = 2;
    world->material[0] = material_default(MATERIAL_PRINCIPLED);
    world->material[0].pattern = PATTERN_BARK;
    strcpy(world->material[0].name, "bark");
    world->material[1] = material_default(MATERIAL_DIFFUSE);
    world->material[1].variation = 0.5f;
    strcpy(world->material[1].name, "plain one");
    Part skin = {.mesh = box(vec3(1, 2, 3), false)};
    assert_true(geometry_add(&world->geometry, skin, NULL));
    Part copies = {.mesh = box(vec3(0.5f, 0.25f, 0.125f), true), .material = 1, .object = 1};
    copies.instance_count = 6;
    copies.instance = memory_alloc(6, sizeof *copies.instance, NULL);
    for (int i = 0; i < 6; i++) {
        Vec3 scale = i == 2 ? vec3(-1, 1, 1) : i == 4 ? vec3(1, 2, 3) : vec3_splat(0.5f);
        copies.instance[i] =
            transform_compose(vec3(3.0f * (float)i, 10, 0), vec3(20.0f * (float)i, 15, 5), scale);
    }
    if (sheared) {
        copies.instance[3].m[0][1] += 0.3f;
    }
    assert_true(geometry_add(&world->geometry, copies, NULL));
    Part hairs = {.kind = PART_CURVES, .curves = curves(), .material = 1, .object = 1};
    assert_true(geometry_add(&world->geometry, hairs, NULL));
    return world;
}

static ExportSource source_of(const World *world)
{
    static const char *const names[] = {"a", "b"};
    return (ExportSource){.title = "test", .world = world, .object_count = 2, .object_name = names};
}

static void write_format(const ExportSource *source, const char *file)
{
    Error e = {0};
    Run run = run_default();
    if (!export_format(file)->write(source, file, &run, &e)) {
        fail_msg("%s: %s", file, e.message);
    }
}

static char *read_file(const char *file, size_t *size)
{
    FILE *stream = fopen(file, "rb");
    assert_non_null(stream);
    fseek(stream, 0, SEEK_END);
    *size = (size_t)ftell(stream);
    rewind(stream);
    char *bytes = calloc(*size + 1, 1);
    assert_int_equal(fread(bytes, 1, *size, stream), *size);
    fclose(stream);
    return bytes;
}

static double signed_volume(const Mesh *mesh)
{
    double volume = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        volume += (double)vec3_dot(mesh->position[c[0]],
                                   vec3_cross(mesh->position[c[1]], mesh->position[c[2]])) /
                  6.0;
    }
    return volume;
}

static bool join_bounds(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    Aabb *box = user;
    *box = aabb_union(*box, export_piece_bounds(piece));
    return true;
}

// What the file must come to.
static void assert_read_back(const ExportSource *source, const char *file)
{
    Error e = {0};
    Run run = run_default();
    Mesh *mesh = mesh_import(file, &run, &e);
    if (!mesh) {
        fail_msg("%s: %s", file, e.message);
    }
    Aabb wanted = aabb_empty(), got = mesh_bounds(mesh);
    assert_true(export_all_pieces(source, 0, 0.0f, 1.0f, &run, join_bounds, &wanted, NULL));
    assert_int_equal(mesh->face_count, export_all_tally(source).triangles);
    assert_int_equal(mesh->face_count, 12 + 6 * 12 + 100 * (3 * 12 + 12));
    assert_true(vec3_distance(got.low, wanted.low) < 1e-4f);
    assert_true(vec3_distance(got.high, wanted.high) < 1e-4f);
    // a mirrored or inside-out copy would take its volume away twice
    double hexagon = 0.5 * 6 * 0.02 * 0.02 * sin(M_PI / 3.0);
    double boxes = 0.125 * (4 * 0.125 + 1.0 + 6.0);
    double volume = 48.0 + boxes + 100.0 * hexagon * (0.6 + 2.0 * 0.02 / 3.0);
    assert_true(fabs(signed_volume(mesh) - volume) < 2e-4 * volume);
    mesh_free(mesh);
}

static void assimp_reads_everything_back(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    const char *const names[] = {"x.obj", "x.ply", "x.stl", "x.glb"};
    for (int i = 0; i < 4; i++) {
        write_format(&source, path_of(*state, names[i]));
        assert_read_back(&source, path_of(*state, names[i]));
    }
    source.options.instances = EXPORT_INSTANCES_FLAT;
    write_format(&source, path_of(*state, "flat.glb"));
    assert_read_back(&source, path_of(*state, "flat.glb"));
    source.options.colors = EXPORT_COLORS_NONE;
    for (int i = 0; i < 4; i++) {
        write_format(&source, path_of(*state, names[i]));
        assert_read_back(&source, path_of(*state, names[i]));
    }
    world_free(world);
}

// No node can shear, but two can, one within the other.
static void sheared_copies_are_read_back(void **state)
{
    World *world = make_world(true);
    ExportSource source = source_of(world);
    for (ExportInstances how = EXPORT_INSTANCES_AUTO; how <= EXPORT_INSTANCES_FLAT; how++) {
        source.options.instances = how;
        const char *file = path_of(*state, "sheared.glb");
        write_format(&source, file);
        assert_read_back(&source, file);
        size_t size;
        char *bytes = read_file(file, &size);
        bool copied = !strstr(bytes + 20, "{\"children\":[2],\"translation\":");
        assert_int_equal(copied, how == EXPORT_INSTANCES_FLAT);
        free(bytes);
    }
    world_free(world);
}

// Copies of the second part, which leaves it with that many.
static void set_copies(World *world, int64_t count)
{
    Part *part = &world->geometry.part[1];
    free(part->instance);
    part->instance_count = count;
    part->instance = memory_alloc(count, sizeof *part->instance, NULL);
    assert_non_null(part->instance);
    for (int64_t i = 0; i < count; i++) {
        part->instance[i] = transform_compose(vec3((float)(i % 100), (float)(i / 100), 0),
                                              vec3_splat(10), vec3_splat(0.5f));
    }
}

static int nodes_of(const ExportSource *source, const char *file)
{
    write_format(source, file);
    size_t size;
    char *bytes = read_file(file, &size);
    int count = 0;
    for (const char *at = strstr(bytes + 20, "\"mesh\":"); at; at = strstr(at + 1, "\"mesh\":")) {
        count++;
    }
    free(bytes);
    return count;
}

// Leaves are one mesh; a few boxes, and what would make the file too large, are not.
static void small_copies_are_merged_into_one_mesh(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    const char *file = path_of(*state, "merged.glb");
    assert_int_equal(nodes_of(&source, file), 1 + 6 + 1);
    set_copies(world, 300);
    assert_int_equal(nodes_of(&source, file), 1 + 1 + 1);
    Error e = {0};
    Run run = run_default();
    Mesh *mesh = mesh_import(file, &run, &e);
    assert_non_null(mesh);
    assert_int_equal(mesh->face_count, export_all_tally(&source).triangles);
    mesh_free(mesh);
    source.options.instances = EXPORT_INSTANCES_NODES;
    assert_int_equal(nodes_of(&source, file), 1 + 300 + 1);
    source.options.instances = EXPORT_INSTANCES_AUTO;
    set_copies(world, 170000); // 12 triangles each: over 2 million
    write_format(&source, file);
    size_t size;
    char *bytes = read_file(file, &size);
    assert_non_null(strstr(bytes + 20, "EXT_mesh_gpu_instancing"));
    assert_true(size < 170000 * 12 * 12);
    free(bytes);
    world_free(world);
}

// A flattened one has no normals to turn: its copies are written out.
static void flattened_copies_are_written_out(void **state)
{
    World *world = make_world(true);
    ExportSource source = source_of(world);
    Transform *last = &world->geometry.part[1].instance[5];
    for (int i = 0; i < 3; i++) {
        last->m[i][1] = 0.0f;
    }
    const char *file = path_of(*state, "flattened.glb");
    write_format(&source, file);
    size_t size;
    char *bytes = read_file(file, &size);
    assert_null(strstr(bytes + 20, "{\"children\":[2],\"translation\":"));
    assert_non_null(strstr(bytes + 20, "\"name\":\"b plain one\",\"mesh\":1}"));
    free(bytes);
    world_free(world);
}

static void a_ply_holds_radius_birth_and_colours(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    source.options.colors = EXPORT_COLORS_GROWTH;
    const char *file = path_of(*state, "x.ply");
    write_format(&source, file);
    size_t size;
    char *bytes = read_file(file, &size), *end = strstr(bytes, "end_header\n");
    assert_non_null(end);
    assert_non_null(
        strstr(bytes, "property float radius\nproperty float birth\nproperty uchar red"));
    const char *row = end + strlen("end_header\n");
    for (int i = 0; i < 8; i++, row += 43) {
        float number[10];
        memcpy(number, row, sizeof number);
        const unsigned char *color = (const unsigned char *)row + 40;
        assert_float_equal(number[0], (i & 1 ? 1.0f : -1.0f), 0.0f);
        assert_float_equal(number[6], 0.1f * (float)i, 1e-7f);
        assert_float_equal(number[8], 0.25f + (float)i, 0.0f);
        assert_float_equal(number[9], 0.125f * (float)i, 0.0f);
        assert_int_equal(color[0], (int)(255.0f * 0.125f * (float)i + 0.5f));
        assert_int_equal(color[1], (int)(255.0f * (0.25f + (float)i) / 7.25f + 0.5f));
    }
    // the first face is a quad of the skin
    ExportTally tally = export_all_tally(&source);
    const char *face = end + strlen("end_header\n") + 43 * tally.vertices;
    int32_t corner[4];
    memcpy(corner, face + 1, sizeof corner);
    assert_int_equal(*face, 4);
    assert_int_equal(corner[1], 4);
    assert_int_equal(size, (size_t)(face - bytes) + 7 * 6 * 17 + 4800 * 13);
    free(bytes);
    world_free(world);
}

static void an_obj_names_objects_and_materials(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    write_format(&source, path_of(*state, "x.obj"));
    size_t size;
    char *text = read_file(path_of(*state, "x.obj"), &size);
    assert_non_null(strstr(text, "\nmtllib x.mtl\n"));
    assert_non_null(strstr(text, "\no a\ng a_bark_0\nusemtl bark\n"));
    assert_non_null(strstr(text, "\no b\ng b_plain_one_1\nusemtl plain_one\n"));
    assert_non_null(strstr(text, "\nf 1/1/1 5/5/5 7/7/7 3/3/3\n"));
    assert_non_null(strstr(text, "\nf 9 13 15 11\n")); // without normals or uv
    free(text);
    text = read_file(path_of(*state, "x.mtl"), &size);
    assert_non_null(strstr(text, "\nnewmtl plain_one\n"));
    free(text);
    world_free(world);
}

// "plain one" and "plain_one" are two materials.
static void materials_keep_apart_without_blanks(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    strcpy(world->material[0].name, "plain_one");
    write_format(&source, path_of(*state, "x.obj"));
    size_t size;
    char *text = read_file(path_of(*state, "x.obj"), &size);
    assert_non_null(strstr(text, "\no a\ng a_plain_one_0\nusemtl plain_one\n"));
    assert_non_null(strstr(text, "\nusemtl plain_one_2\n"));
    free(text);
    text = read_file(path_of(*state, "x.mtl"), &size);
    assert_non_null(strstr(text, "\nnewmtl plain_one\n"));
    assert_non_null(strstr(text, "\nnewmtl plain_one_2\n"));
    free(text);
    world_free(world);
}

static void any_number_of_threads_writes_the_same(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    const char *const endings[] = {"obj", "ply", "stl", "glb"};
    for (int i = 0; i < 4; i++) {
        char *bytes[2], name[16];
        size_t size[2];
        for (int k = 0; k < 2; k++) {
            Run run = run_default();
            run.threads = 1 + 3 * k;
            snprintf(name, sizeof name, "same.%s", endings[i]);
            const char *file = path_of(*state, name);
            assert_true(export_format(file)->write(&source, file, &run, NULL));
            bytes[k] = read_file(file, &size[k]);
        }
        assert_int_equal(size[0], size[1]);
        assert_memory_equal(bytes[0], bytes[1], size[0]);
        free(bytes[0]);
        free(bytes[1]);
    }
    world_free(world);
}

static int count_files(Fixture *fixture)
{
    DIR *folder = opendir(fixture->folder);
    int count = 0;
    while (readdir(folder)) {
        count++;
    }
    closedir(folder);
    return count;
}

static void an_interrupt_leaves_the_old_file(void **state)
{
    World *world = make_world(false);
    ExportSource source = source_of(world);
    const char *const names[] = {"old.obj", "old.mtl", "old.ply", "old.stl", "old.glb"};
    for (int i = 0; i < 5; i++) {
        FILE *stream = fopen(path_of(*state, names[i]), "wb");
        fputs("old", stream);
        fclose(stream);
    }
    int files = count_files(*state);
    volatile int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    for (int i = 0; i < 5; i++) {
        Error e = {0};
        size_t size;
        if (i != 1) {
            const char *file = path_of(*state, names[i]);
            assert_false(export_format(file)->write(&source, file, &run, &e));
            assert_int_equal(e.code, ERROR_CANCELLED);
        }
        char *text = read_file(path_of(*state, names[i]), &size);
        assert_string_equal(text, "old");
        free(text);
    }
    assert_int_equal(count_files(*state), files);
    world_free(world);
}

static void on_warning(void *user, const char *message)
{
    (void)message;
    ++*(int *)user;
}

// A grid of a million triangles at so many places that no file holds them.
static void too_much_is_refused_at_once(void **state)
{
    World *world = world_new(NULL);
    world->material = memory_alloc_zero(1, sizeof *world->material, NULL);
    world->material_count = 1;
    Part part = {.mesh = mesh_new(4, 500000, 500000, 0, NULL), .instance_count = 5000};
    part.instance = memory_alloc(part.instance_count, sizeof *part.instance, NULL);
    for (int64_t i = 0; i < part.instance_count; i++) {
        part.instance[i] = transform_identity();
    }
    assert_true(geometry_add(&world->geometry, part, NULL));
    ExportSource source = source_of(world);
    source.options.instances = EXPORT_INSTANCES_FLAT;
    const char *const names[] = {"much.stl", "much.ply", "much.glb"};
    const char *const says[] = {"an STL file holds at most", "readers of PLY", "at most 4.29"};
    double start = run_seconds();
    for (int i = 0; i < 3; i++) {
        Error e = {0};
        Run run = run_default();
        const char *file = path_of(*state, names[i]);
        assert_false(export_format(file)->write(&source, file, &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, says[i]));
        assert_non_null(strstr(e.message, "fewer objects"));
        assert_int_not_equal(access(file, F_OK), 0);
    }
    assert_true(run_seconds() - start < 5.0);
    // warned of before it is written: stopped there
    int warnings = 0;
    volatile int cancelled = 1;
    Run run = {.threads = 1, .cancelled = &cancelled, .warn = on_warning, .user = &warnings};
    world->geometry.part[0].instance_count = 30;
    assert_false(stl_format.write(&source, path_of(*state, "much.stl"), &run, NULL));
    assert_int_equal(warnings, 1);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(assimp_reads_everything_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(sheared_copies_are_read_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(small_copies_are_merged_into_one_mesh, set_up, tear_down),
        cmocka_unit_test_setup_teardown(flattened_copies_are_written_out, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ply_holds_radius_birth_and_colours, set_up, tear_down),
        cmocka_unit_test_setup_teardown(an_obj_names_objects_and_materials, set_up, tear_down),
        cmocka_unit_test_setup_teardown(materials_keep_apart_without_blanks, set_up, tear_down),
        cmocka_unit_test_setup_teardown(any_number_of_threads_writes_the_same, set_up, tear_down),
        cmocka_unit_test_setup_teardown(an_interrupt_leaves_the_old_file, set_up, tear_down),
        cmocka_unit_test_setup_teardown(too_much_is_refused_at_once, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
