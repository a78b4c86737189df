// Networks of vessels as VTK PolyData (XML, ASCII): a line for each segment, with radius and
// pressure at its points and the segment's numbers as cell data.
#include "export/formats.h"

#include "base/number_text.h"
#include "export/networks.h"

#include <inttypes.h>

typedef struct Vtp {
    FileWriter *out;
    const NetworkList *list;
} Vtp;

static void begin_array(const Vtp *v, const char *type, const char *name, int components)
{
    file_writer_print(v->out, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
    if (components > 1) {
        file_writer_print(v->out, " NumberOfComponents=\"%d\"", components);
    }
    file_writer_text(v->out, " format=\"ascii\">\n");
}

static void end_array(const Vtp *v)
{
    file_writer_text(v->out, "\n</DataArray>\n");
}

static void put_floats(const Vtp *v, const float *value, int count)
{
    char text[4 * (FLOAT_TEXT_MOST + 1)], *end = floats_text(text, value, count, ' ');
    *end++ = '\n';
    file_writer_bytes(v->out, text, (size_t)(end - text));
}

static void write_points(const Vtp *v)
{
    file_writer_text(v->out, "<Points>\n");
    begin_array(v, "Float32", "Points", 3);
    for (int64_t n = 0; n < v->list->count; n++) {
        const OutTree *tree = v->list->network[n].tree;
        for (int64_t i = 0; i < tree->count; i++) {
            put_floats(v, &tree->position[i].x, 3);
        }
    }
    end_array(v);
    file_writer_text(v->out, "</Points>\n<PointData Scalars=\"radius\">\n");
    begin_array(v, "Float32", "radius", 1);
    for (int64_t n = 0; n < v->list->count; n++) {
        const OutTree *tree = v->list->network[n].tree;
        for (int64_t i = 0; i < tree->count; i++) {
            put_floats(v, &tree->radius[i], 1);
        }
    }
    end_array(v);
    begin_array(v, "Float64", "pressure", 1);
    for (int64_t n = 0; n < v->list->count; n++) {
        const Network *network = &v->list->network[n];
        for (int64_t i = 0; i < network->tree->count; i++) {
            file_writer_print(v->out, "%.17g\n", network->flow.pressure[i]);
        }
    }
    end_array(v);
    file_writer_text(v->out, "</PointData>\n");
}

static void write_lines(const Vtp *v)
{
    file_writer_text(v->out, "<Lines>\n");
    begin_array(v, "Int64", "connectivity", 1);
    for (int64_t n = 0, base = 0; n < v->list->count; n++) {
        const Network *network = &v->list->network[n];
        for (int64_t i = 0; i < network->segments.count; i++) {
            int64_t start = network->line_start[i], end = network->line_start[i + 1];
            for (int64_t k = start; k < end; k++) {
                file_writer_print(v->out, "%s%" PRId64, k > start ? " " : "",
                                  base + network->line[k]);
            }
            file_writer_text(v->out, "\n");
        }
        base += network->tree->count;
    }
    end_array(v);
    begin_array(v, "Int64", "offsets", 1);
    for (int64_t n = 0, before = 0; n < v->list->count; n++) {
        const Network *network = &v->list->network[n];
        for (int64_t i = 0; i < network->segments.count; i++) {
            file_writer_print(v->out, "%" PRId64 "\n", before + network->line_start[i + 1]);
        }
        before += network->line_start[network->segments.count];
    }
    end_array(v);
    file_writer_text(v->out, "</Lines>\n");
}

static void write_column(const Vtp *v, int column)
{
    begin_array(v, network_column_is_whole(column) ? "Int32" : "Float64", network_column[column],
                1);
    for (int64_t n = 0; n < v->list->count; n++) {
        const Network *network = &v->list->network[n];
        for (int64_t i = 0; i < network->segments.count; i++) {
            file_writer_print(v->out, "%.17g\n", network->row[i][column]);
        }
    }
    end_array(v);
}

// Numbers of the object and of the network that each line belongs to.
static void write_origins(const Vtp *v)
{
    for (int k = 0; k < 3; k++) {
        begin_array(v, "Int32", k == 0 ? "object" : (k == 1 ? "colony" : "network"), 1);
        for (int64_t n = 0; n < v->list->count; n++) {
            const Network *network = &v->list->network[n];
            int64_t value = k == 0 ? network->object : (k == 1 ? network->colony : n);
            for (int64_t i = 0; i < network->segments.count; i++) {
                file_writer_print(v->out, "%" PRId64 "\n", value);
            }
        }
        end_array(v);
    }
}

static void write_list(FileWriter *out, const NetworkList *list)
{
    const Vtp *v = &(Vtp){out, list};
    int64_t points = 0, lines = 0;
    for (int64_t n = 0; n < v->list->count; n++) {
        points += list->network[n].tree->count;
        lines += v->list->network[n].segments.count;
    }
    file_writer_print(v->out,
                      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece "
                      "NumberOfPoints=\"%" PRId64 "\" NumberOfVerts=\"0\" NumberOfLines=\"%" PRId64
                      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                      points, lines);
    write_points(v);
    file_writer_text(v->out, "<CellData Scalars=\"flow\">\n");
    for (int k = NETWORK_LENGTH; k < NETWORK_COLUMNS; k++) {
        write_column(v, k);
    }
    write_origins(v);
    file_writer_text(v->out, "</CellData>\n");
    write_lines(v);
    file_writer_text(v->out, "</Piece>\n</PolyData>\n</VTKFile>\n");
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    return networks_write(source, file, run, write_list, e);
}

const ExportFormat vtp_format = {".vtp", "vessels as VTK lines with radius, flow and pressure", 0,
                                 EXPORT_TREES, write};
