// Reading meshes: what is right is read whole, what is broken is refused in words that help.
#include "base/run.h"
#include "shape/envelope.h"
#include "shape/import.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const Run quiet = {.threads = 1};
static char directory[] = "/tmp/ramify_import_XXXXXX";

// Writes a file of this name into the directory of the test; path is set to where it is.
static void write_file(const char *name, const void *data, size_t size, char path[256])
{
    snprintf(path, 256, "%s/%s", directory, name);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[300];
    snprintf(command, sizeof command, "rm -r %s", directory);
    return system(command);
}

static const char cube_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
                               "v 0 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                               "f 4 1 5 8\n";

static void reads_a_cube_of_quads(void **state)
{
    (void)state;
    char path[256];
    Error e = {0};
    write_file("cube.obj", cube_obj, sizeof cube_obj - 1, path);
    Mesh *mesh = mesh_import(path, &quiet, &e);
    assert_non_null(mesh);
    assert_int_equal(mesh->face_size, 3);
    assert_int_equal(mesh->face_count, 12);
    assert_int_equal(mesh->vertex_count, 8);
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, &e));
    assert_int_equal(topology.open_edges + topology.overused_edges + topology.misoriented_edges, 0);
    assert_int_equal(topology.euler_number, 2);
    mesh_free(mesh);
}

static void drops_degenerate_faces(void **state)
{
    (void)state;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n";
    char path[256];
    write_file("thin.obj", text, sizeof text - 1, path);
    Mesh *mesh = mesh_import(path, &quiet, NULL);
    assert_non_null(mesh);
    assert_int_equal(mesh->face_count, 1);
    mesh_free(mesh);
}

// A triangle in a node that is mirrored in x and moved by 10 in y.
static void applies_node_transforms(void **state)
{
    (void)state;
    static const char text[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"children\":[1],\"translation\":[0,10,0]},{\"mesh\":0,\"scale\":[-1,1,1]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]}]}";
    char path[256];
    Error e = {0};
    write_file("node.gltf", text, sizeof text - 1, path);
    Mesh *mesh = mesh_import(path, &quiet, &e);
    assert_non_null(mesh);
    Aabb box = mesh_bounds(mesh);
    assert_true(box.low.x == -1.0f && box.high.x == 0.0f);
    assert_true(box.low.y == 10.0f && box.high.y == 11.0f);
    // still counter-clockwise seen from +z: the mirror turned it round once, the import back again
    Vec3 a = mesh->position[mesh->index[0]];
    Vec3 across = vec3_cross(vec3_sub(mesh->position[mesh->index[1]], a),
                             vec3_sub(mesh->position[mesh->index[2]], a));
    assert_true(across.z > 0.0f);
    mesh_free(mesh);
}

typedef struct BrokenFile {
    const char *name, *text;
    const char *message;
} BrokenFile;

#define PLY_HEAD(format, vertices, faces)                                         \
    "ply\nformat " format " 1.0\nelement vertex " vertices                        \
    "\nproperty float x\nproperty float y\nproperty float z\nelement face " faces \
    "\nproperty list uchar int vertex_indices\nend_header\n"

static const BrokenFile broken[] = {
    {"empty.obj", "", "the file is empty; a mesh is needed"},
    {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
     "the file holds no triangles; a surface of triangles or polygons is needed"},
    {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n",
     "vertex 1 has a coordinate that is not finite; coordinates must be numbers in metres"},
    {"far.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n",
     "vertex 1 lies at 1e+09, 0, 0 m; at most 1e+07 m from the origin is possible"},
    {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
     "all faces of the file are degenerate; triangles with an area are needed"},
    {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
     "not readable as a mesh: OBJ: vertex index out of range; a whole OBJ, PLY, STL, glTF, GLB or "
     "VDB "
     "file is needed"},
    {"cut.ply", PLY_HEAD("ascii", "3", "1") "0 0 0\n1 0 0\n",
     "truncated: the header promises 3 vertices and 1 faces, which need 4 lines, but 2 follow; the "
     "whole file is needed"},
    {"cut_binary.ply", PLY_HEAD("binary_little_endian", "3", "1") "abcdefgh",
     "truncated: the header promises 3 vertices and 1 faces, which need 49 bytes, but 8 follow; "
     "the whole file is needed"},
    {"absurd.ply", PLY_HEAD("binary_little_endian", "1000000000000", "1") "abcd",
     "the header promises 1000000000000 vertices and 1 faces; at most 1000000000 of each are "
     "possible"},
    {"head.ply", "ply\nformat ascii 1.0\nelement ver",
     "not a PLY file, or its header is cut off; a header from 'ply' to 'end_header' is needed"},
    {"cut.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0",
     "truncated: no 'endsolid' at its end; the whole STL file is needed"},
    {"json.gltf", "{\"asset\":", NULL},
    {"noise.glb", "\x01\x02\x03\x04garbage", NULL},
    {"mesh.txt", "v 0 0 0\n",
     "the name does not end in a mesh format that can be read; .obj, .ply, .stl, .gltf, .glb or "
     ".vdb "
     "would be right"},
};

static void refuses_broken_files(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        const BrokenFile *b = &broken[i];
        char path[256];
        Error e = {0};
        write_file(b->name, b->text, strlen(b->text), path);
        assert_null(mesh_import(path, &quiet, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, path);
        if (b->message) {
            assert_string_equal(e.message, b->message);
        } else { // the library's own words in between
            assert_non_null(strstr(e.message, "; "));
            assert_true(strlen(e.message) > 20);
        }
    }
}

static void refuses_truncated_binary_stl(void **state)
{
    (void)state;
    unsigned char data[84 + 50] = "binary";
    char path[256];
    Error e = {0};
    data[80] = 7;
    write_file("cut_binary.stl", data, sizeof data, path);
    assert_null(mesh_import(path, &quiet, &e));
    assert_string_equal(e.message, "truncated: the header promises 7 facets, which need 434 bytes, "
                                   "but the file has 134; the whole STL file is needed");
}

static void refuses_missing_files(void **state)
{
    (void)state;
    Error e = {0};
    assert_null(mesh_import("/nowhere/at/all.obj", &quiet, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    char text[1200];
    error_format(&e, text, sizeof text);
    assert_string_equal(text, "/nowhere/at/all.obj: cannot be read: No such file or directory; "
                              "give the path of a mesh file");
    assert_null(mesh_import(directory, &quiet, &e));
    assert_string_equal(e.message, "is not a file; give the path of a mesh file");
    assert_null(mesh_import(NULL, &quiet, &e));
    assert_string_equal(e.message, "no mesh file is named; give the path of one");
}

typedef struct Heard {
    int count;
    char message[768];
} Heard;

static void hear(void *user, const char *message)
{
    Heard *heard = user;
    heard->count++;
    snprintf(heard->message, sizeof heard->message, "%s", message);
}

// The cube without its lid: the hole is closed again and it is said.
static void open_mesh_warns(void **state)
{
    (void)state;
    char text[sizeof cube_obj], path[256], expected[600];
    strcpy(text, cube_obj);
    char *face = strstr(text, "f 5 6 7 8\n");
    memset(face, ' ', 9);
    write_file("lidless.obj", text, strlen(text), path);
    Heard heard = {0};
    Run run = run_default();
    run.warn = hear;
    run.user = &heard;
    Shape shape = {.kind = SHAPE_MESH, .transform = transform_identity(), .file = path};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1};
    Error e = {0};
    Envelope *envelope = envelope_new(&params, &run, &e);
    assert_non_null(envelope);
    assert_int_equal(heard.count, 1);
    snprintf(expected, sizeof expected,
             "%s: the mesh is open: 4 edges have a face on one side only; its holes were closed as "
             "well as possible, close them in the file to be sure of the inside",
             path);
    assert_string_equal(heard.message, expected);
    assert_true(fabs(envelope_volume(envelope) - 1.0) < 0.02);
    assert_true(fabs(envelope_area(envelope) - 5.0) < 1e-6);
    assert_true(envelope_contains(envelope, vec3(0.5f, 0.5f, 0.9f)));
    assert_false(envelope_contains(envelope, vec3(0.5f, 0.5f, 1.1f)));
    envelope_free(envelope);
}

// A closed mesh turned inside out fills the same space and its surface looks outward.
static void inverted_mesh_is_turned(void **state)
{
    (void)state;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                               "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    char path[256];
    write_file("inverted.obj", text, sizeof text - 1, path);
    Run run = run_default();
    Shape shape = {.kind = SHAPE_MESH, .transform = transform_identity(), .file = path};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1};
    Envelope *envelope = envelope_new(&params, &run, NULL);
    assert_non_null(envelope);
    assert_true(fabs(envelope_volume(envelope) - 1.0 / 6.0) < 1e-6);
    assert_true(envelope_contains(envelope, vec3(0.2f, 0.2f, 0.2f)));
    const Mesh *mesh = envelope_surface(envelope);
    for (int64_t f = 0; f < mesh->face_count; f++) {
        Vec3 a = mesh->position[mesh->index[3 * f]];
        Vec3 across = vec3_cross(vec3_sub(mesh->position[mesh->index[3 * f + 1]], a),
                                 vec3_sub(mesh->position[mesh->index[3 * f + 2]], a));
        assert_true(vec3_dot(across, vec3_sub(a, vec3(0.2f, 0.2f, 0.2f))) > 0.0f);
    }
    envelope_free(envelope);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_a_cube_of_quads),   cmocka_unit_test(drops_degenerate_faces),
        cmocka_unit_test(applies_node_transforms), cmocka_unit_test(refuses_broken_files),
        cmocka_unit_test(refuses_missing_files),   cmocka_unit_test(refuses_truncated_binary_stl),
        cmocka_unit_test(open_mesh_warns),         cmocka_unit_test(inverted_mesh_is_turned),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
