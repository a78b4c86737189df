// Networks of vessels as JSON, for solvers of blood flow: lumped elements (0D), and tubes with
// their centre lines (1D). docs/formats.md describes the keys.
#include "export/formats.h"

#include "base/number_text.h"
#include "export/networks.h"

#include <inttypes.h>

// Nodes of the segment with their radii, from the root's side; the first has that of the next.
static void write_points(FileWriter *out, const Network *network, int64_t index)
{
    const OutTree *tree = network->tree;
    int64_t start = network->line_start[index], end = network->line_start[index + 1];
    for (int64_t k = start; k < end; k++) {
        int32_t node = network->line[k], thick = network->line[k > start ? k : k + 1];
        float point[4] = {tree->position[node].x, tree->position[node].y, tree->position[node].z,
                          tree->radius[thick]};
        char text[4 * (FLOAT_TEXT_MOST + 1)];
        char *text_end = floats_text(text, point, 4, ',');
        file_writer_text(out, k > start ? ",[" : "[");
        file_writer_bytes(out, text, (size_t)(text_end - text));
        file_writer_text(out, "]");
    }
}

static void write_segment(FileWriter *out, const Network *network, int64_t index)
{
    const double *row = network->row[index];
    for (int k = 0; k < NETWORK_COLUMNS; k++) {
        file_writer_print(out, "%s\"%s\": %.9g", k > 0 ? ", " : "\n    {", network_column[k],
                          row[k]);
    }
    file_writer_text(out, ", \"points\": [");
    write_points(out, network, index);
    file_writer_text(out, "]}");
}

// The table of orders by diameter, and the connectivity matrix: row m, column n, both from 1.
static void write_orders(FileWriter *out, const DiameterOrders *orders)
{
    for (int32_t n = 1; n <= orders->highest; n++) {
        const OrderClass *of = &orders->of[n];
        file_writer_print(out,
                          "%s\n    {\"order\": %" PRId32 ", \"segments\": %" PRId64
                          ", \"elements\": %" PRId64
                          ", \"diameter\": %.9g, \"diameter_spread\": %.9g, \"length\": %.9g}",
                          n > 1 ? "," : "", n, of->segments, of->elements, of->diameter,
                          of->diameter_spread, of->length);
    }
    file_writer_text(out, "],\n   \"connectivity\": [");
    for (int32_t m = 1; m <= orders->highest; m++) {
        file_writer_text(out, m > 1 ? ",\n    [" : "\n    [");
        for (int32_t n = 1; n <= orders->highest; n++) {
            file_writer_print(out, "%s%.9g", n > 1 ? ", " : "", orders->connectivity[m][n]);
        }
        file_writer_text(out, "]");
    }
}

static void write_network(FileWriter *out, const ExportSource *source, const Network *network)
{
    // names of objects need no escapes
    file_writer_print(out, "\n  {\"object\": \"%s\", \"colony\": %" PRId32 ",\n   \"orders\": [",
                      source->object_name[network->object], network->colony);
    write_orders(out, &network->orders);
    file_writer_text(out, "],\n   \"segments\": [");
    for (int64_t i = 0; i < network->segments.count; i++) {
        file_writer_text(out, i > 0 ? "," : "");
        write_segment(out, network, i);
    }
    file_writer_text(out, "]}");
}

static void write_list(FileWriter *out, const NetworkList *list)
{
    file_writer_print(out,
                      "{\"format\": \"ramify network\", \"version\": 1, \"unit\": \"SI\", "
                      "\"density\": %g,\n \"networks\": [",
                      BLOOD_DENSITY);
    for (int64_t i = 0; i < list->count; i++) {
        file_writer_text(out, i > 0 ? "," : "");
        write_network(out, list->source, &list->network[i]);
    }
    file_writer_text(out, "]}\n");
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    return networks_write(source, file, run, write_list, e);
}

const ExportFormat network_format = {".network.json",
                                     "vessels as lumped elements (0D) and tubes (1D), with flow", 0,
                                     EXPORT_TREES, write};
