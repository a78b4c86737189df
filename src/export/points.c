// Attractors as points: text, one line each, with the object's name, position (m) and normal.
#include "export/formats.h"

#include "base/file_writer.h"
#include "base/number_text.h"

static bool any_points(const ExportSource *source, Error *e)
{
    for (int i = 0; i < source->object_count; i++) {
        if (source->points[i]) {
            return true;
        }
    }
    return error_set(e, ERROR_INPUT, "no object of '%s' keeps its attractors; an outtree does",
                     source->title);
}

// A field of CSV (RFC 4180) and its comma: quoted, with quotes doubled.
static void write_name(FileWriter *writer, const char *name)
{
    file_writer_text(writer, "\"");
    for (; *name; name++) {
        file_writer_bytes(writer, name, 1);
        if (*name == '"') {
            file_writer_bytes(writer, name, 1);
        }
    }
    file_writer_text(writer, "\",");
}

static bool write_points(FileWriter *writer, const char *name, const PointSet *points,
                         const Run *run, Error *e)
{
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = points->position[i], n = points->normal[i];
        const float numbers[6] = {p.x, p.y, p.z, n.x, n.y, n.z};
        char line[6 * (FLOAT_TEXT_MOST + 1) + 2];
        if (!run_goes_on(run, i, e)) {
            return false;
        }
        char *end = floats_text(line, numbers, 6, ',');
        *end++ = '\n';
        write_name(writer, name);
        file_writer_bytes(writer, line, (size_t)(end - line));
    }
    return true;
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    FileWriter *writer = any_points(source, e) ? file_writer_open(file, e) : NULL;
    if (!writer) {
        return false;
    }
    bool done = true;
    file_writer_text(writer, "object,x,y,z,nx,ny,nz\n");
    for (int i = 0; done && i < source->object_count; i++) {
        done = !source->points[i] ||
               write_points(writer, source->object_name[i], source->points[i], run, e);
    }
    return file_writer_close(writer, done, e) && done;
}

const ExportFormat csv_format = {".csv", "the attractors left, as points", 0, EXPORT_POINTS, write};
