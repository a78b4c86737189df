// PLY files of the kind that is read by blocks, against what they hold and against Assimp.
#include "shape/ply_read.h"

#include "shape/import.h"
#include "testing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A unit cube's corners and its faces, counter-clockwise seen from outside.
static const float CORNER[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
static const int QUAD[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

typedef struct Cube {
    bool quads, wide, spare, apart; // doubles; further properties; every face has its own corners
    const char *list;               // type of the list's count
    int last_corners;               // of the last face
} Cube;

static void put_vertex(FILE *to, const Cube *cube, const float at[3])
{
    unsigned char flag = 9;
    if (cube->spare) {
        fwrite(&flag, 1, 1, to);
    }
    for (int k = 0; k < 3; k++) {
        double wide = (double)at[k];
        fwrite(cube->wide ? (const void *)&wide : &at[k], cube->wide ? 8 : 4, 1, to);
    }
    if (cube->spare) {
        fwrite(&flag, 1, 1, to);
    }
}

static void put_face(FILE *to, const Cube *cube, const int *corner, int count)
{
    unsigned char size = (unsigned char)count;
    unsigned short before = 77, wide_size = (unsigned short)count;
    float after = 3.0f;
    if (cube->spare) {
        fwrite(&before, sizeof before, 1, to);
    }
    bool narrow = strcmp(cube->list, "uchar") == 0;
    fwrite(narrow ? (const void *)&size : &wide_size, narrow ? 1 : 2, 1, to);
    fwrite(corner, sizeof *corner, (size_t)count, to);
    if (cube->spare) {
        fwrite(&after, sizeof after, 1, to);
    }
}

// Writes the cube and one vertex that no face uses.
static void write_cube(const char *name, const Cube *cube)
{
    FILE *to = fopen(name, "wb");
    assert_non_null(to);
    const char *type = cube->wide ? "double" : "float",
               *flag = cube->spare ? "property uchar a\n" : "";
    fprintf(to, "ply\nformat binary_little_endian 1.0\ncomment a cube\nelement vertex %d\n",
            (cube->apart ? 24 : 8) + 1);
    fprintf(to, "%sproperty %s x\nproperty %s y\nproperty %s z\n%s", flag, type, type, type,
            cube->spare ? "property uchar b\n" : "");
    fprintf(to, "element face %d\n%sproperty list %s int vertex_indices\n%send_header\n",
            cube->quads ? 6 : 12, cube->spare ? "property ushort c\n" : "", cube->list,
            cube->spare ? "property float d\n" : "");
    const float unused[3] = {50, 60, 70};
    put_vertex(to, cube, unused);
    for (int i = 0; i < (cube->apart ? 24 : 8); i++) {
        put_vertex(to, cube, CORNER[cube->apart ? QUAD[i / 4][i % 4] : i]);
    }
    for (int i = 0; i < 6; i++) {
        int at[5];
        for (int k = 0; k < 5; k++) {
            at[k] = 1 + (cube->apart ? 4 * i + k % 4 : QUAD[i][k % 4]);
        }
        int second[3] = {at[0], at[2], at[3]};
        if (cube->quads) {
            put_face(to, cube, at, i == 5 && cube->last_corners ? cube->last_corners : 4);
        } else {
            put_face(to, cube, at, 3);
            put_face(to, cube, second, 3);
        }
    }
    fclose(to);
}

static void check_cube(Mesh *mesh, const Error *e)
{
    if (!mesh) {
        fail_msg("%s", e->message);
    }
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, NULL));
    assert_int_equal(mesh->vertex_count, 8);
    assert_int_equal(mesh->face_count, 12);
    assert_true(topology.open_edges == 0 && topology.euler_number == 2);
    double volume = 0.0;
    for (int64_t i = 0; i < mesh->face_count; i++) {
        Vec3 a = mesh->position[mesh->index[3 * i]], b = mesh->position[mesh->index[3 * i + 1]];
        volume += (double)vec3_dot(a, vec3_cross(b, mesh->position[mesh->index[3 * i + 2]])) / 6.0;
    }
    assert_float_equal(volume, 1.0, 1e-6);
}

static char *temporary(char name[32])
{
    strcpy(name, "/tmp/ramify_test_XXXXXX.ply");
    int file = mkstemps(name, 4);
    assert_true(file >= 0);
    close(file);
    return name;
}

static void cubes_of_all_kinds_are_read(void **state)
{
    (void)state;
    char name[32];
    temporary(name);
    for (int kind = 0; kind < 16; kind++) {
        Cube cube = {.quads = kind & 1,
                     .wide = kind & 2,
                     .spare = kind & 4,
                     .apart = kind & 8,
                     .list = "uchar"};
        write_cube(name, &cube);
        bool declined = true;
        Error e = {0};
        Mesh *mesh = ply_read(name, &declined, &e);
        assert_false(declined);
        check_cube(mesh, &e);
        mesh_free(mesh);
    }
    unlink(name);
}

// Files of other kinds are left to the general reader, which reads them.
static void other_kinds_are_declined(void **state)
{
    (void)state;
    char name[32];
    temporary(name);
    const Cube kinds[] = {{.quads = true, .list = "ushort"},
                          {.quads = true, .list = "uchar", .last_corners = 5}};
    for (int i = 0; i < 2; i++) {
        write_cube(name, &kinds[i]);
        bool declined = false;
        Error e = {0};
        assert_null(ply_read(name, &declined, &e));
        assert_true(declined && e.code == ERROR_NONE);
        Run run = run_default();
        Mesh *mesh = mesh_import(name, &run, &e);
        assert_non_null(mesh);
        assert_true(mesh->face_count >= 12);
        mesh_free(mesh);
    }
    unlink(name);
}

// The two halves of a quad with a corner that points inward lie inside of it.
static void a_concave_quad_is_split_inside(void **state)
{
    (void)state;
    char name[32];
    FILE *to = fopen(temporary(name), "wb");
    assert_non_null(to);
    const float at[4][3] = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}};
    for (int turn = 0; turn < 4; turn++) {
        rewind(to);
        fprintf(to, "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
                    "property float y\nproperty float z\nelement face 1\n"
                    "property list uchar int vertex_index\nend_header\n");
        fwrite(at, sizeof at, 1, to);
        int corner[4] = {turn, (turn + 1) % 4, (turn + 2) % 4, (turn + 3) % 4};
        put_face(to, &(Cube){.list = "uchar"}, corner, 4);
        fflush(to);
        bool declined;
        Error e = {0};
        Mesh *mesh = ply_read(name, &declined, &e);
        assert_non_null(mesh);
        assert_int_equal(mesh->face_count, 2);
        for (int i = 0; i < 2; i++) {
            const uint32_t *c = mesh->index + 3 * i;
            Vec3 a = mesh->position[c[0]];
            Vec3 n =
                vec3_cross(vec3_sub(mesh->position[c[1]], a), vec3_sub(mesh->position[c[2]], a));
            assert_true(n.z > 0.0f);
        }
        mesh_free(mesh);
    }
    fclose(to);
    unlink(name);
}

static void normals_and_texture_coordinates_are_kept(void **state)
{
    (void)state;
    char name[32];
    FILE *to = fopen(temporary(name), "wb");
    assert_non_null(to);
    fprintf(to, "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                "property float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                "property float nz\nproperty float s\nproperty float t\nelement face 1\n"
                "property list uint8 uint32 vertex_indices\nend_header\n");
    const float at[3][8] = {
        {0, 0, 0, 0, 0, 2, 0.25f, 0.5f}, {1, 0, 0, 0, 0, 2, 1, 0.5f}, {0, 1, 0, 0, 3, 0, 0.25f, 1}};
    fwrite(at, sizeof at, 1, to);
    const int corner[3] = {0, 1, 2};
    put_face(to, &(Cube){.list = "uchar"}, corner, 3);
    fclose(to);
    bool declined;
    Error e = {0};
    Mesh *mesh = ply_read(name, &declined, &e);
    assert_non_null(mesh);
    assert_true(mesh->normal && mesh->uv && mesh->vertex_count == 3);
    assert_float_equal(mesh->normal[2].y, 1.0f, 1e-6f);
    assert_float_equal(mesh->uv[0].x, 0.25f, 0);
    assert_float_equal(mesh->uv[2].y, 1.0f, 0);
    mesh_free(mesh);
    unlink(name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubes_of_all_kinds_are_read),
        cmocka_unit_test(other_kinds_are_declined),
        cmocka_unit_test(a_concave_quad_is_split_inside),
        cmocka_unit_test(normals_and_texture_coordinates_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
