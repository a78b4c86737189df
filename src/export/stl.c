// Binary STL: 80 bytes of header, the number of triangles, then 50 bytes a triangle: its normal,
// three corners, two zeros. Little-endian. Instances are written out; curves are left out.
#include "export/formats.h"

#include "base/file_writer.h"

#include <string.h>

enum { HEADER = 80, RECORD = 50 };

static void write_triangle(FileWriter *writer, Vec3 a, Vec3 b, Vec3 c)
{
    Vec3 across = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    float length = vec3_length(across);
    Vec3 normal = length > 0.0f ? vec3_scale(across, 1.0f / length) : vec3(0, 0, 0);
    Vec3 numbers[4] = {normal, a, b, c};
    char *room = file_writer_room(writer, RECORD);
    if (room) {
        memcpy(room, numbers, sizeof numbers);
        memset(room + sizeof numbers, 0, RECORD - sizeof numbers);
    }
}

static void write_mesh(FileWriter *writer, const Mesh *mesh, const Transform *place)
{
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        Vec3 p[4];
        for (int k = 0; k < mesh->face_size; k++) {
            p[k] = place ? transform_point(place, mesh->position[corner[k]])
                         : mesh->position[corner[k]];
        }
        for (int k = 2; k < mesh->face_size; k++) {
            write_triangle(writer, p[0], p[k - 1], p[k]);
        }
    }
}

static int64_t count_triangles(const Geometry *geometry)
{
    int64_t count = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        if (part->mesh) {
            count += part->mesh->face_count * (part->mesh->face_size - 2) *
                     (part->instance ? part->instance_count : 1);
        }
    }
    return count;
}

static void write_parts(FileWriter *writer, const Geometry *geometry, const Run *run)
{
    for (int64_t i = 0; i < geometry->count && !run_is_cancelled(run); i++) {
        const Part *part = &geometry->part[i];
        if (part->mesh && !part->instance) {
            write_mesh(writer, part->mesh, NULL);
        }
        for (int64_t k = 0; part->mesh && part->instance && k < part->instance_count; k++) {
            write_mesh(writer, part->mesh, &part->instance[k]);
        }
    }
}

bool export_stl(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    int64_t count = count_triangles(&source->world->geometry);
    if (count > UINT32_MAX) {
        return error_set(e, ERROR_INPUT,
                         "%lld triangles; an STL file holds at most %u: export to .ply or .glb",
                         (long long)count, UINT32_MAX);
    }
    FileWriter *writer = file_writer_open(file, e);
    if (!writer) {
        return false;
    }
    char header[HEADER] = "binary STL written by ramify";
    uint32_t triangles = (uint32_t)count;
    file_writer_bytes(writer, header, sizeof header);
    file_writer_bytes(writer, &triangles, sizeof triangles);
    write_parts(writer, &source->world->geometry, run);
    bool whole = !run_is_cancelled(run);
    return file_writer_close(writer, whole, e) || (whole ? false : run_cancel_error(e));
}
