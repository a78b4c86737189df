// Hostile mesh files: whatever is in them, the importer gives a mesh or an error with their name.
#include "mutate.h"
#include "testing.h"

#include "shape/import.h"
#include "shape/import_read.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const Run quiet = {.threads = 1};
static char directory[] = "/tmp/ramify_hostile_XXXXXX";

static void name_file(const char *name, char path[256])
{
    snprintf(path, 256, "%s/%s", directory, name);
}

static void write_file(const char *name, const void *data, size_t size, char path[256])
{
    name_file(name, path);
    unlink(path); // cut to nothing instead, some file systems wait for the disk
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

static void refused(const char *path, const char *words)
{
    Error e = {0};
    Mesh *mesh = mesh_import(path, &quiet, &e);
    assert_null(mesh);
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, path);
    assert_non_null(strstr(e.message, "; ")); // what would be right
    if (words && !strstr(e.message, words)) {
        fail_msg("no '%s' in '%s'", words, e.message);
    }
}

// A mesh that can be relied on, or an error with the file's name.
static void mesh_or_error(const char *path)
{
    Error e = {0};
    Mesh *mesh = mesh_import(path, &quiet, &e);
    if (!mesh) {
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, path);
        assert_true(strlen(e.message) > 20);
        return;
    }
    assert_true(mesh->face_count > 0);
    for (int64_t i = 0; i < 3 * mesh->face_count; i++) {
        assert_true(mesh->index[i] < mesh->vertex_count);
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        assert_true(vec3_finite(mesh->position[i]));
        assert_true(!mesh->normal || fabsf(vec3_length(mesh->normal[i]) - 1.0f) < 1e-3f);
        assert_true(!mesh->uv || (isfinite(mesh->uv[i].x) && isfinite(mesh->uv[i].y)));
    }
    mesh_free(mesh);
}

// ---- readers that lie ----

typedef struct Lie {
    ImportHeader header;
    uint32_t index[3];
    float position[9], normal[9], uv[6];
    size_t size; // of what is handed back
    const char *words;
} Lie;

// The reader has to be a ChildTask that is told the file's name alone; the child sees this as it
// was when it was started.
static const Lie *told;

static bool tell_lie(const void *data, ChildOutput *output, Error *e)
{
    (void)data;
    return child_write(output, told, 1, told->size, e);
}

#define SOUND                     \
    {0, 1, 2},                    \
    {                             \
        0, 0, 0, 1, 0, 0, 0, 1, 0 \
    }
#define GOOD_SIZE offsetof(Lie, normal)

static const Lie lies[] = {
    {{3, 1, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE, NULL},
    {{3, 1, 0, 0}, {0, 1, 3}, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0}, {0}, GOOD_SIZE, "no vertex 3"},
    {{3, 1, 0, 0}, {0, 1, 2}, {0, 0, NAN, 1, 0, 0, 0, 1, 0}, {0}, {0}, GOOD_SIZE, "not finite"},
    {{3, 1, 0, 0}, {0, 1, 2}, {0, 0, 0, -INFINITY, 0, 0, 0, 1}, {0}, {0}, GOOD_SIZE, "not finite"},
    {{3, 1, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE - 1, "makes no sense"},
    {{3, 1, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE + 4, "makes no sense"},
    {{3, 1, 1, 0}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{3, 1, 2, 0}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{3, 1, 0, -1}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{-1, 1, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{3, INT64_MAX, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{INT64_MAX, INT64_MAX, 1, 1}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{4000000000, 1, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE, "makes no sense"},
    {{4, 0, 0, 0}, SOUND, {0}, {0}, GOOD_SIZE, "degenerate"},
    {{0, 0, 0, 0}, SOUND, {0}, {0}, sizeof(ImportHeader), "degenerate"},
    {{3, 1, 0, 0}, SOUND, {0}, {0}, sizeof(ImportHeader) - 1, "broke off"},
    {{3, 1, 0, 0}, SOUND, {0}, {0}, 0, "broke off"},
};

static void believes_no_result_unchecked(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        Error e = {0};
        told = &lies[i];
        Mesh *mesh = mesh_import_by(tell_lie, "lie.obj", &quiet, &e);
        assert_int_equal(mesh == NULL, told->words != NULL);
        if (told->words) {
            assert_int_equal(e.code, ERROR_INPUT);
            assert_string_equal(e.file, "lie.obj");
            if (!strstr(e.message, told->words)) {
                fail_msg("lie %zu: no '%s' in '%s'", i, told->words, e.message);
            }
        }
        mesh_free(mesh);
    }
}

// Numbers that are none in what a mesh can do without are mended.
static void mends_normals_and_uvs(void **state)
{
    (void)state;
    const Lie lie = {{3, 1, 1, 1},
                     SOUND,
                     {0, 0, 1, NAN, 0, 1, 0, 0, 1},
                     {0, 1, NAN, 1, INFINITY, 2},
                     offsetof(Lie, uv) + 6 * sizeof(float),
                     NULL};
    told = &lie;
    Mesh *mesh = mesh_import_by(tell_lie, "lie.obj", &quiet, NULL);
    assert_non_null(mesh);
    assert_null(mesh->normal);
    assert_true(mesh->uv[0].y == 1.0f && mesh->uv[1].x == 0.0f && mesh->uv[2].y == 0.0f);
    mesh_free(mesh);
}

// ---- bombs and traps ----

static char *repeat(const char *what, int64_t times, const char *before, const char *after)
{
    size_t length = strlen(what);
    char *text = malloc(strlen(before) + length * (size_t)times + strlen(after) + 1);
    assert_non_null(text);
    char *at = stpcpy(text, before);
    for (int64_t i = 0; i < times; i++) {
        at = stpcpy(at, what);
    }
    strcpy(at, after);
    return text;
}

static void refuses_bombs(void **state)
{
    (void)state;
    char path[256];
    const char ply[] =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
        "property float y\nproperty float z\nelement face 4000000000\n"
        "property list uchar int vertex_indices\nend_header\nabcd";
    write_file("claims.ply", ply, sizeof ply - 1, path);
    refused(path, "promises 4000000000 vertices");
    char *line = repeat("9", 100000000, "v 0 0 0\nv 1 0 0\nv ", " 0 0\nf 1 2 3\n");
    write_file("line.obj", line, strlen(line), path);
    free(line);
    refused(path, NULL);
    unlink(path);
    char *deep = repeat("[", 200000, "{\"asset\":{\"version\":\"2.0\"},\"x\":", "");
    write_file("deep.gltf", deep, strlen(deep), path);
    free(deep);
    refused(path, NULL);
}

#define TRIANGLE_GLTF(nodes, uri)                                                                 \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[" nodes \
    "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"                        \
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"" uri "\"}],"                                      \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"                                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]}"
#define TRIANGLE_URI \
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"

static void survives_circles_and_depth(void **state)
{
    (void)state;
    static const char circle[] =
        TRIANGLE_GLTF("{\"mesh\":0,\"children\":[1]},{\"children\":[0]}", TRIANGLE_URI);
    static const char itself[] = TRIANGLE_GLTF("{\"mesh\":0,\"children\":[0]}", TRIANGLE_URI);
    char path[256];
    write_file("circle.gltf", circle, sizeof circle - 1, path);
    mesh_or_error(path);
    write_file("itself.gltf", itself, sizeof itself - 1, path);
    mesh_or_error(path);
    enum { DEPTH = 100000 };
    char *text = malloc(DEPTH * 30 + 1000), *at = text;
    assert_non_null(text);
    at = stpcpy(at, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                    "\"nodes\":[");
    for (int i = 1; i < DEPTH; i++) {
        at += sprintf(at, "{\"children\":[%d]},", i);
    }
    static const char last[] = TRIANGLE_GLTF("{\"mesh\":0}", TRIANGLE_URI);
    stpcpy(at, strstr(last, "{\"mesh\":0}"));
    write_file("deep_nodes.gltf", text, strlen(text), path);
    free(text);
    mesh_or_error(path);
}

// Bytes that would make a triangle stand outside of the mesh's folder, and a pipe inside of it.
static void opens_nothing_outside_its_folder(void **state)
{
    (void)state;
    static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const char inside[] = TRIANGLE_GLTF("{\"mesh\":0}", "sub/triangle.bin");
    static const char outside[] = TRIANGLE_GLTF("{\"mesh\":0}", "../triangle.bin");
    static const char around[] = TRIANGLE_GLTF("{\"mesh\":0}", "sub/../../triangle.bin");
    static const char absolute[] = TRIANGLE_GLTF("{\"mesh\":0}", "/etc/passwd");
    static const char web[] = TRIANGLE_GLTF("{\"mesh\":0}", "http://127.0.0.1/triangle.bin");
    static const char pipe_there[] = TRIANGLE_GLTF("{\"mesh\":0}", "pipe.bin");
    char path[256];
    name_file("mesh", path);
    assert_int_equal(mkdir(path, 0700), 0);
    name_file("mesh/sub", path);
    assert_int_equal(mkdir(path, 0700), 0);
    write_file("triangle.bin", triangle, sizeof triangle, path);
    write_file("mesh/sub/triangle.bin", triangle, sizeof triangle, path);
    write_file("mesh/inside.gltf", inside, sizeof inside - 1, path);
    Mesh *mesh = mesh_import(path, &quiet, NULL);
    assert_non_null(mesh);
    mesh_free(mesh);
    write_file("mesh/outside.gltf", outside, sizeof outside - 1, path);
    refused(path, "not readable");
    write_file("mesh/around.gltf", around, sizeof around - 1, path);
    refused(path, "not readable");
    write_file("mesh/absolute.gltf", absolute, sizeof absolute - 1, path);
    refused(path, "not readable");
    write_file("mesh/web.gltf", web, sizeof web - 1, path);
    refused(path, "not readable");
    name_file("mesh/pipe.bin", path);
    assert_int_equal(mkfifo(path, 0600), 0);
    write_file("mesh/pipe.gltf", pipe_there, sizeof pipe_there - 1, path);
    refused(path, "not readable");
}

// ---- broken copies of sound files ----

typedef struct Seed {
    const char *name;
    unsigned char data[2048];
    size_t size;
} Seed;

#ifdef __SANITIZE_ADDRESS__ // forks slowly
enum { SEEDS = 6, BROKEN = 50 };
#else
enum { SEEDS = 6, BROKEN = 250 };
#endif

static void put(Seed *seed, const void *data, size_t size)
{
    assert_true(seed->size + size <= sizeof seed->data);
    memcpy(seed->data + seed->size, data, size);
    seed->size += size;
}

static void put_word(Seed *seed, uint32_t word)
{
    put(seed, &word, sizeof word);
}

static const float TETRAHEDRON[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const uint32_t FACES[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

static void make_stl(Seed *seed)
{
    static const char comment[80] = "made by a test";
    put(seed, comment, sizeof comment);
    put_word(seed, 4);
    for (int f = 0; f < 4; f++) {
        static const float normal[3] = {0, 0, 1};
        put(seed, normal, sizeof normal);
        for (int k = 0; k < 3; k++) {
            put(seed, TETRAHEDRON + 3 * FACES[3 * f + k], 3 * sizeof(float));
        }
        put(seed, "\0\0", 2);
    }
}

static void make_ply(Seed *seed)
{
    static const char head[] =
        "ply\nformat binary_little_endian 1.0\ncomment x\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nelement face 4\n"
        "property list uchar int vertex_indices\nend_header\n";
    put(seed, head, sizeof head - 1);
    put(seed, TETRAHEDRON, sizeof TETRAHEDRON);
    for (int f = 0; f < 4; f++) {
        put(seed, "\3", 1);
        put(seed, FACES + (ptrdiff_t)3 * f, 3 * sizeof(uint32_t));
    }
}

static void make_glb(Seed *seed)
{
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
        "\"mesh\":0,\"rotation\":[0,0,0,1]}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
        "\"POSITION\":0},\"indices\":1,\"mode\":4}]}],\"buffers\":[{\"byteLength\":96}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,"
        "\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,"
        "\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5125,\"count\":12,\"type\":"
        "\"SCALAR\"}]}";
    uint32_t length = (sizeof json - 1 + 3) / 4 * 4;
    put_word(seed, 0x46546c67);
    put_word(seed, 2);
    put_word(seed, 12 + 8 + length + 8 + 96);
    put_word(seed, length);
    put_word(seed, 0x4e4f534a);
    put(seed, json, sizeof json - 1);
    put(seed, "   ", length - (sizeof json - 1));
    put_word(seed, 96);
    put_word(seed, 0x4e4942);
    put(seed, TETRAHEDRON, sizeof TETRAHEDRON);
    put(seed, FACES, sizeof FACES);
}

static void make_seeds(Seed seeds[SEEDS])
{
    static const char obj[] =
        "mtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\nusemtl m\n"
        "s 1\nf 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\ng more\nf -4 -1 -2\nf 2 3 4\n";
    static const char ply[] =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0 1\n"
        "1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    static const char gltf[] = TRIANGLE_GLTF("{\"mesh\":0,\"scale\":[1,2,3]}", TRIANGLE_URI);
    memset(seeds, 0, SEEDS * sizeof *seeds);
    seeds[0].name = "seed.obj";
    put(&seeds[0], obj, sizeof obj - 1);
    seeds[1].name = "ascii.ply";
    put(&seeds[1], ply, sizeof ply - 1);
    seeds[2].name = "binary.ply";
    make_ply(&seeds[2]);
    seeds[3].name = "seed.stl";
    make_stl(&seeds[3]);
    seeds[4].name = "seed.glb";
    make_glb(&seeds[4]);
    seeds[5].name = "seed.gltf";
    put(&seeds[5], gltf, sizeof gltf - 1);
}

static void survives_broken_copies(void **state)
{
    (void)state;
    static Seed seeds[SEEDS];
    make_seeds(seeds);
    for (int i = 0; i < SEEDS; i++) {
        char path[256];
        Error e = {0};
        write_file(seeds[i].name, seeds[i].data, seeds[i].size, path);
        Mesh *mesh = mesh_import(path, &quiet, &e);
        if (!mesh) {
            fail_msg("%s", e.message);
        }
        mesh_free(mesh);
        for (uint64_t k = 0; k < BROKEN; k++) {
            Seed copy = seeds[i];
            copy.size = mutate(copy.data, copy.size, sizeof copy.data,
                               random_key(random_key(7, (uint64_t)i), k));
            write_file(seeds[i].name, copy.data, copy.size, path);
            mesh_or_error(path);
        }
    }
    assert_true(waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD);
}

// ---- many at once ----

static int open_files(void)
{
    DIR *folder = opendir("/proc/self/fd");
    int count = 0;
    while (readdir(folder)) {
        count++;
    }
    closedir(folder);
    return count;
}

static void *import_often(void *path)
{
    intptr_t right = 0;
    for (int i = 0; i < 5; i++) {
        Mesh *mesh = mesh_import(path, &quiet, NULL);
        right += mesh && mesh->face_count == 4;
        mesh_free(mesh);
    }
    return (void *)right;
}

static void imports_in_parallel(void **state)
{
    (void)state;
    enum { THREADS = 6 };
    static Seed seeds[SEEDS];
    char path[SEEDS][256];
    pthread_t thread[THREADS];
    int before = open_files();
    make_seeds(seeds);
    for (int i = 0; i < THREADS; i++) {
        int s = i % 5; // those of four faces
        if (i == s) {
            write_file(seeds[s].name, seeds[s].data, seeds[s].size, path[s]);
        }
        assert_int_equal(pthread_create(&thread[i], NULL, import_often, path[s]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        void *right;
        pthread_join(thread[i], &right);
        assert_int_equal((intptr_t)right, 5);
    }
    assert_int_equal(open_files(), before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(believes_no_result_unchecked),
        cmocka_unit_test(mends_normals_and_uvs),
        cmocka_unit_test(refuses_bombs),
        cmocka_unit_test(survives_circles_and_depth),
        cmocka_unit_test(opens_nothing_outside_its_folder),
        cmocka_unit_test(survives_broken_copies),
        cmocka_unit_test(imports_in_parallel),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
