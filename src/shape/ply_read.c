#include "shape/ply_read.h"

#include "base/hash.h"
#include "base/memory.h"
#include "shape/import_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINES = 64, LINE_SIZE = 256, MOST_STRIDE = 1024, MOST_CORNERS = 4 };
enum { BUFFER_SIZE = 1 << 20 };

// ---- the header

typedef enum PlyType { PLY_NO_TYPE, PLY_U8, PLY_I32, PLY_F32, PLY_F64, PLY_OTHER } PlyType;

static PlyType type_of(const char *name, int *size)
{
    static const struct {
        const char *name;
        PlyType type;
        int size;
    } known[] = {
        {"float", PLY_F32, 4},    {"float32", PLY_F32, 4}, {"double", PLY_F64, 8},
        {"float64", PLY_F64, 8},  {"uchar", PLY_U8, 1},    {"uint8", PLY_U8, 1},
        {"int", PLY_I32, 4},      {"int32", PLY_I32, 4},   {"uint", PLY_I32, 4},
        {"uint32", PLY_I32, 4},   {"char", PLY_OTHER, 1},  {"int8", PLY_OTHER, 1},
        {"short", PLY_OTHER, 2},  {"int16", PLY_OTHER, 2}, {"ushort", PLY_OTHER, 2},
        {"uint16", PLY_OTHER, 2},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i].name) == 0) {
            *size = known[i].size;
            return known[i].type;
        }
    }
    *size = 0;
    return PLY_NO_TYPE;
}

enum { FIELD_X, FIELD_Y, FIELD_Z, FIELD_NX, FIELD_NY, FIELD_NZ, FIELD_U, FIELD_V, FIELD_COUNT };

// A property of a vertex: where it lies in the record.
typedef struct Field {
    PlyType type; // PLY_NO_TYPE = absent
    int offset;
} Field;

typedef struct PlyLayout {
    int64_t vertices, faces;
    int stride; // bytes of a vertex
    Field field[FIELD_COUNT];
    int before, after; // bytes of a face around its list of corners
    bool has_list;
} PlyLayout;

static int field_of(const char *name)
{
    static const struct {
        const char *name;
        int field;
    } known[] = {{"x", FIELD_X},   {"y", FIELD_Y},         {"z", FIELD_Z},
                 {"nx", FIELD_NX}, {"ny", FIELD_NY},       {"nz", FIELD_NZ},
                 {"u", FIELD_U},   {"v", FIELD_V},         {"s", FIELD_U},
                 {"t", FIELD_V},   {"texture_u", FIELD_U}, {"texture_v", FIELD_V}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i].name) == 0) {
            return known[i].field;
        }
    }
    return -1;
}

static bool add_vertex_property(PlyLayout *layout, const char *type, const char *name)
{
    int size, field = field_of(name);
    PlyType kind = type_of(type, &size);
    if (kind == PLY_NO_TYPE || layout->stride + size > MOST_STRIDE) {
        return false;
    }
    if (field >= 0) {
        layout->field[field] = (Field){kind, layout->stride};
    }
    layout->stride += size;
    return field < 0 || kind == PLY_F32 || kind == PLY_F64;
}

static bool add_face_property(PlyLayout *layout, const char *type)
{
    int size, *side = layout->has_list ? &layout->after : &layout->before;
    bool known = type_of(type, &size) != PLY_NO_TYPE;
    *side += size;
    return known && *side <= MOST_STRIDE;
}

// One line of the header; *element: 0 before the first, then 1 for vertices and 2 for faces. False
// if the file is of another kind.
static bool add_line(PlyLayout *layout, const char *line, int *element)
{
    char a[32] = "", b[32] = "", c[32] = "", d[32] = "", name[32] = "";
    int words = sscanf(line, "%31s %31s %31s %31s %31s", a, b, c, d, name);
    if (words < 1 || strcmp(a, "comment") == 0 || strcmp(a, "obj_info") == 0) {
        return true;
    }
    if (strcmp(a, "format") == 0) {
        return strcmp(b, "binary_little_endian") == 0;
    }
    if (strcmp(a, "element") == 0 && words == 3) {
        char *end;
        int64_t count = strtoll(c, &end, 10);
        bool vertices = *element == 0 && strcmp(b, "vertex") == 0;
        bool faces = *element == 1 && strcmp(b, "face") == 0;
        *(vertices ? &layout->vertices : &layout->faces) = count;
        ++*element;
        return (vertices || faces) && *end == '\0' && count > 0 && count <= INT32_MAX;
    }
    if (strcmp(a, "property") != 0) {
        return false;
    }
    if (*element == 1 && words == 3) {
        return add_vertex_property(layout, b, c);
    }
    if (*element == 2 && words == 3) {
        return add_face_property(layout, b);
    }
    int size;
    bool list = *element == 2 && words == 5 && strcmp(b, "list") == 0 && !layout->has_list &&
                type_of(c, &size) == PLY_U8 && type_of(d, &size) == PLY_I32 &&
                (strcmp(name, "vertex_indices") == 0 || strcmp(name, "vertex_index") == 0);
    layout->has_list = true;
    return list;
}

// False if the file is of another kind.
static bool read_layout(FILE *stream, PlyLayout *layout)
{
    char line[LINE_SIZE];
    int element = 0;
    *layout = (PlyLayout){.stride = 0};
    if (!fgets(line, sizeof line, stream) || strncmp(line, "ply", 3) != 0) {
        return false;
    }
    for (int i = 0; i < MOST_LINES && fgets(line, sizeof line, stream); i++) {
        if (strncmp(line, "end_header", 10) == 0) {
            const Field *f = layout->field;
            return layout->has_list && f[FIELD_X].type && f[FIELD_Y].type && f[FIELD_Z].type;
        }
        if (!strchr(line, '\n') || !add_line(layout, line, &element)) {
            return false;
        }
    }
    return false;
}

// ---- vertices

static float number_at(const unsigned char *record, Field field)
{
    if (field.type == PLY_F32) {
        float x;
        memcpy(&x, record + field.offset, sizeof x);
        return x + 0.0f; // no negative zero, which would keep equal vertices apart
    }
    double x;
    memcpy(&x, record + field.offset, sizeof x);
    return (float)x + 0.0f;
}

static Vec3 vector_at(const unsigned char *record, const Field field[3])
{
    return vec3(number_at(record, field[0]), number_at(record, field[1]),
                number_at(record, field[2]));
}

static bool cut_off(Error *e)
{
    return error_set(e, ERROR_INPUT, "truncated while it was read; the whole file is needed");
}

static bool read_vertices(FILE *stream, const PlyLayout *layout, Mesh *mesh, Error *e)
{
    unsigned char record[MOST_STRIDE];
    for (int64_t i = 0; i < layout->vertices; i++) {
        if (fread(record, (size_t)layout->stride, 1, stream) != 1) {
            return cut_off(e);
        }
        mesh->position[i] = vector_at(record, layout->field + FIELD_X);
        if (mesh->normal) {
            mesh->normal[i] = vec3_normalize(vector_at(record, layout->field + FIELD_NX));
        }
        if (mesh->uv) {
            mesh->uv[i] = (Vec2){number_at(record, layout->field[FIELD_U]),
                                 number_at(record, layout->field[FIELD_V])};
        }
    }
    return true;
}

// ---- equal vertices

static uint64_t vertex_hash(const Mesh *mesh, int64_t i)
{
    uint64_t hash = hash_bytes(HASH_START, &mesh->position[i], sizeof(Vec3));
    hash = mesh->normal ? hash_bytes(hash, &mesh->normal[i], sizeof(Vec3)) : hash;
    return mesh->uv ? hash_bytes(hash, &mesh->uv[i], sizeof(Vec2)) : hash;
}

static bool vectors_equal(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool vertices_equal(const Mesh *mesh, int64_t a, int64_t b)
{
    return vectors_equal(mesh->position[a], mesh->position[b]) &&
           (!mesh->normal || vectors_equal(mesh->normal[a], mesh->normal[b])) &&
           (!mesh->uv || (mesh->uv[a].x == mesh->uv[b].x && mesh->uv[a].y == mesh->uv[b].y));
}

// For every vertex the first that equals it; NULL and e when out of memory.
static uint32_t *find_equal(const Mesh *mesh, Error *e)
{
    int64_t slots = 1;
    while (slots < 2 * mesh->vertex_count) {
        slots *= 2;
    }
    uint32_t *first = memory_alloc(mesh->vertex_count, sizeof *first, e);
    uint32_t *slot = first ? memory_alloc_zero(slots, sizeof *slot, e) : NULL; // vertex + 1
    if (!slot) {
        free(first);
        return NULL;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        uint64_t at = vertex_hash(mesh, i);
        at ^= at >> 32;
        for (at &= (uint64_t)slots - 1; slot[at] && !vertices_equal(mesh, i, slot[at] - 1);) {
            at = (at + 1) & ((uint64_t)slots - 1);
        }
        slot[at] = slot[at] ? slot[at] : (uint32_t)i + 1;
        first[i] = slot[at] - 1;
    }
    free(slot);
    return first;
}

// ---- faces

static Vec3 face_normal(const Mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    Vec3 p = mesh->position[a];
    return vec3_cross(vec3_sub(mesh->position[b], p), vec3_sub(mesh->position[c], p));
}

static void add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    Vec3 across = face_normal(mesh, a, b, c);
    if (a != b && b != c && c != a && vec3_dot(across, across) != 0.0f) {
        uint32_t *corner = mesh->index + 3 * mesh->face_count++;
        corner[0] = a;
        corner[1] = b;
        corner[2] = c;
    }
}

// A quad is split along the diagonal that lies inside of it.
static void add_quad(Mesh *mesh, const uint32_t c[4])
{
    Vec3 one = face_normal(mesh, c[0], c[1], c[2]), two = face_normal(mesh, c[0], c[2], c[3]);
    int turn = vec3_dot(one, two) < 0.0f ? 1 : 0;
    add_triangle(mesh, c[turn], c[turn + 1], c[turn + 2]);
    add_triangle(mesh, c[turn], c[turn + 2], c[(turn + 3) % 4]);
}

// False and *declined, or e.
static bool read_face(FILE *stream, const PlyLayout *layout, const uint32_t *first, Mesh *mesh,
                      bool *declined, Error *e)
{
    unsigned char record[MOST_STRIDE + MOST_CORNERS * sizeof(uint32_t)];
    uint32_t corner[MOST_CORNERS];
    if (fread(record, (size_t)layout->before + 1, 1, stream) != 1) {
        return cut_off(e);
    }
    unsigned count = record[layout->before];
    *declined = count < 3 || count > MOST_CORNERS;
    if (*declined) {
        return false;
    }
    if (fread(record, count * sizeof *corner + (size_t)layout->after, 1, stream) != 1) {
        return cut_off(e);
    }
    memcpy(corner, record, count * sizeof *corner);
    for (unsigned i = 0; i < count; i++) {
        if (corner[i] >= (uint32_t)mesh->vertex_count) {
            return true; // left out, as by the general reader
        }
        corner[i] = first[corner[i]];
    }
    if (count == 3) {
        add_triangle(mesh, corner[0], corner[1], corner[2]);
    } else {
        add_quad(mesh, corner);
    }
    return true;
}

// Keeps the vertices that faces use, in their order.
static bool drop_unused(Mesh *mesh, uint32_t *place, Error *e)
{
    memset(place, 0, (size_t)mesh->vertex_count * sizeof *place);
    for (int64_t i = 0; i < 3 * mesh->face_count; i++) {
        place[mesh->index[i]] = 1;
    }
    uint32_t kept = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        if (place[i]) {
            mesh->position[kept] = mesh->position[i];
            if (mesh->normal) {
                mesh->normal[kept] = mesh->normal[i];
            }
            if (mesh->uv) {
                mesh->uv[kept] = mesh->uv[i];
            }
            place[i] = kept++;
        }
    }
    for (int64_t i = 0; i < 3 * mesh->face_count; i++) {
        mesh->index[i] = place[mesh->index[i]];
    }
    mesh->vertex_count = kept;
    return mesh->face_count > 0 || error_set(e, ERROR_INPUT, IMPORT_NO_TRIANGLES);
}

// Most triangles that the faces can make: four bytes of corners each, three corners a face.
static int64_t most_triangles(FILE *stream, const PlyLayout *layout)
{
    long here = ftell(stream);
    if (here < 0 || fseek(stream, 0, SEEK_END) != 0) {
        return 0;
    }
    int64_t body = ftell(stream) - here - layout->vertices * layout->stride;
    int64_t corners = (body - layout->faces * (layout->before + layout->after + 1)) / 4;
    bool back = fseek(stream, here, SEEK_SET) == 0;
    return back ? corners - 2 * layout->faces : 0;
}

static bool read_body(FILE *stream, const PlyLayout *layout, Mesh *mesh, bool *declined, Error *e)
{
    if (!read_vertices(stream, layout, mesh, e)) {
        return false;
    }
    uint32_t *first = find_equal(mesh, e);
    bool done = first != NULL;
    int64_t room = mesh->face_count - 2; // a quad adds two
    mesh->face_count = 0;
    for (int64_t i = 0; done && i < layout->faces; i++) {
        *declined = mesh->face_count > room;
        done = !*declined && read_face(stream, layout, first, mesh, declined, e);
    }
    done = done && drop_unused(mesh, first, e);
    free(first);
    return done;
}

// NULL and *declined, or e.
static Mesh *read_stream(FILE *stream, bool *declined, Error *e)
{
    PlyLayout layout;
    int64_t triangles = read_layout(stream, &layout) ? most_triangles(stream, &layout) : 0;
    *declined = triangles <= 0 || triangles > 2 * layout.faces;
    if (*declined) {
        return NULL;
    }
    const Field *f = layout.field;
    bool normals = f[FIELD_NX].type && f[FIELD_NY].type && f[FIELD_NZ].type;
    bool uvs = f[FIELD_U].type && f[FIELD_V].type;
    Mesh *mesh = mesh_new(3, layout.vertices, triangles + 2,
                          (normals ? (int)MESH_NORMAL : 0) | (uvs ? (int)MESH_UV : 0), e);
    if (mesh && !read_body(stream, &layout, mesh, declined, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

Mesh *ply_read(const char *file, bool *declined, Error *e)
{
    FILE *stream = fopen(file, "rb");
    *declined = !stream;
    if (!stream) {
        return NULL;
    }
    setvbuf(stream, NULL, _IOFBF, BUFFER_SIZE); // only a matter of speed
    Mesh *mesh = read_stream(stream, declined, e);
    fclose(stream);
    return mesh;
}
