// Binary PLY, little-endian: vertices with normal, texture coordinate, radius, birth and colour (8
// bits, sRGB), then faces of three or four corners. Instances are written out, curves as tubes.
#include "export/formats.h"

#include "base/file_writer.h"
#include "base/memory.h"
#include "export/pieces.h"

#include <stdlib.h>
#include <string.h>

enum { FLOATS = 10, BARE = FLOATS * (int)sizeof(float), COLORED = BARE + 3 };

typedef struct PlyWriter {
    FileWriter *writer;
    const Run *run;
    ExportColors colors;
    ExportVertex *block; // EXPORT_BLOCK
    int64_t vertices;    // of the pieces before
} PlyWriter;

static void write_vertex(const PlyWriter *ply, const ExportVertex *v)
{
    bool colored = ply->colors != EXPORT_COLORS_NONE;
    char *room = file_writer_room(ply->writer, colored ? COLORED : BARE);
    if (!room) {
        return;
    }
    float numbers[FLOATS] = {v->position.x, v->position.y, v->position.z, v->normal.x, v->normal.y,
                             v->normal.z,   v->uv.x,       v->uv.y,       v->radius,   v->birth};
    memcpy(room, numbers, sizeof numbers);
    if (ply->colors == EXPORT_COLORS_GROWTH) { // data, not encoded as sRGB
        Vec3 c = vec3_scale(v->growth, 255.0f);
        uint8_t bytes[3] = {(uint8_t)(c.x + 0.5f), (uint8_t)(c.y + 0.5f), (uint8_t)(c.z + 0.5f)};
        memcpy(room + sizeof numbers, bytes, sizeof bytes);
    } else if (colored) {
        uint8_t bytes[3] = {export_srgb8(v->color.x), export_srgb8(v->color.y),
                            export_srgb8(v->color.z)};
        memcpy(room + sizeof numbers, bytes, sizeof bytes);
    }
}

static bool write_vertices(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    PlyWriter *ply = user;
    int64_t all = piece->surface->mesh->vertex_count;
    for (int64_t first = 0; first < all && !run_is_cancelled(ply->run); first += EXPORT_BLOCK) {
        int64_t count = all - first < EXPORT_BLOCK ? all - first : EXPORT_BLOCK;
        export_surface_vertices(piece->surface, piece->place, piece->look, first, count,
                                ply->run->threads, ply->block);
        for (int64_t i = 0; i < count; i++) {
            write_vertex(ply, &ply->block[i]);
        }
    }
    return true;
}

static bool write_faces(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    PlyWriter *ply = user;
    const Mesh *mesh = piece->surface->mesh;
    bool mirrored = piece->place && export_is_mirror(piece->place);
    int size = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        int32_t corner[4];
        for (int k = 0; k < size; k++) {
            corner[k] =
                (int32_t)(ply->vertices + mesh->index[f * size + (mirrored ? size - 1 - k : k)]);
        }
        size_t bytes = (size_t)size * sizeof *corner;
        char *room = file_writer_room(ply->writer, 1 + bytes);
        if (room) {
            *room = (char)size;
            memcpy(room + 1, corner, bytes);
        }
    }
    ply->vertices += mesh->vertex_count;
    return true;
}

static void write_header(const PlyWriter *ply, const ExportTally *tally)
{
    file_writer_text(ply->writer, "ply\nformat binary_little_endian 1.0\n"
                                  "comment written by ramify; metres, Y up\n");
    file_writer_print(ply->writer, "element vertex %lld\n", (long long)tally->vertices);
    const char *const names[FLOATS] = {"x",  "y", "z", "nx",     "ny",
                                       "nz", "s", "t", "radius", "birth"};
    for (int i = 0; i < FLOATS; i++) {
        file_writer_print(ply->writer, "property float %s\n", names[i]);
    }
    if (ply->colors != EXPORT_COLORS_NONE) {
        file_writer_text(ply->writer,
                         "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    }
    file_writer_print(ply->writer, "element face %lld\n", (long long)tally->faces);
    file_writer_text(ply->writer, "property list uchar int vertex_indices\nend_header\n");
}

static bool write_all(const ExportSource *source, PlyWriter *ply, const ExportTally *tally,
                      Error *e)
{
    bool patterned = ply->colors == EXPORT_COLORS_ALL || ply->colors == EXPORT_COLORS_PATTERN;
    unsigned wants = EXPORT_WANTS_NORMALS | (patterned ? EXPORT_WANTS_COLORS : 0);
    write_header(ply, tally);
    return export_all_pieces(source, wants, 0.0f, 0.7f, ply->run, write_vertices, ply, e) &&
           export_all_pieces(source, 0, 0.7f, 1.0f, ply->run, write_faces, ply, e);
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    ExportTally tally = export_all_tally(source);
    if (tally.vertices > INT32_MAX) {
        return error_set(e, ERROR_INPUT,
                         "%lld vertices; readers of PLY take at most %d: export fewer objects, or "
                         "a .glb file, which keeps instances",
                         (long long)tally.vertices, INT32_MAX);
    }
    export_warn_of_instances(source, run);
    PlyWriter ply = {.run = run, .colors = source->options.colors};
    ply.block = memory_alloc(EXPORT_BLOCK, sizeof *ply.block, e);
    ply.writer = ply.block ? file_writer_open(file, e) : NULL;
    bool done = ply.writer && write_all(source, &ply, &tally, e);
    done = file_writer_close(ply.writer, done, e);
    free(ply.block);
    return done;
}

const ExportFormat ply_format = {".ply", "meshes with radius and birth, binary", 0, EXPORT_WORLD,
                                 write};
