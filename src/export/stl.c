// Binary STL: 80 bytes of header, the number of triangles, then 50 bytes a triangle: its normal,
// three corners, two zeros. Little-endian. Instances are written out, curves as tubes.
#include "export/formats.h"

#include "base/file_writer.h"
#include "export/pieces.h"

#include <string.h>

enum { HEADER = 80, RECORD = 50 };

static void write_triangle(FileWriter *writer, const Vec3 p[3])
{
    Vec3 across = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    Vec3 numbers[4] = {vec3_normalize(across), p[0], p[1], p[2]};
    char *room = file_writer_room(writer, RECORD);
    if (room) {
        memcpy(room, numbers, sizeof numbers);
        memset(room + sizeof numbers, 0, RECORD - sizeof numbers);
    }
}

static bool write_piece(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    const Mesh *mesh = piece->surface->mesh;
    bool mirrored = piece->place && export_is_mirror(piece->place);
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t corner[6];
        int count = export_face_triangles(mesh, f, mirrored, corner);
        for (int i = 0; i < count; i++) {
            Vec3 p[3];
            for (int k = 0; k < 3; k++) {
                p[k] = mesh->position[corner[3 * i + k]];
                p[k] = piece->place ? transform_point(piece->place, p[k]) : p[k];
            }
            write_triangle(user, p);
        }
    }
    return true;
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    int64_t count = export_all_tally(source).triangles;
    if (count > UINT32_MAX) {
        return error_set(e, ERROR_INPUT,
                         "%lld triangles; an STL file holds at most %u: export fewer objects, or "
                         "a .glb file, which keeps instances",
                         (long long)count, UINT32_MAX);
    }
    export_warn_of_instances(source, run);
    FileWriter *writer = file_writer_open(file, e);
    if (!writer) {
        return false;
    }
    char header[HEADER] = "binary STL written by ramify";
    uint32_t triangles = (uint32_t)count;
    file_writer_bytes(writer, header, sizeof header);
    file_writer_bytes(writer, &triangles, sizeof triangles);
    bool whole = export_all_pieces(source, 0, 0.0f, 1.0f, run, write_piece, writer, e);
    return file_writer_close(writer, whole, e);
}

const ExportFormat stl_format = {".stl", "triangles alone, binary", 0, EXPORT_WORLD, write};
