// Writes GraphML.
#include "base/file_writer.h"
#include "base/markup.h"
#include "base/number_text.h"
#include "outtree/out_tree_io.h"

#include <inttypes.h>
#include <stddef.h>

static void write_data(FileWriter *out, const char *key, float value)
{
    char text[FLOAT_TEXT_MOST + 1];
    *float_text(text, value) = 0;
    file_writer_print(out, "<data key=\"%s\">%s</data>", key, text);
}

// Node names are unique in the file: the graph's number is part of them.
static void write_graph(FileWriter *out, const OutTree *tree, const char *name, int number)
{
    file_writer_print(out, "  <graph id=\"g%d\" edgedefault=\"directed\">\n", number);
    file_writer_text(out, "    <data key=\"name\">");
    markup_text(out, name);
    file_writer_text(out, "</data>\n");
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        file_writer_print(out, "    <node id=\"g%dn%" PRId64 "\">", number, i);
        write_data(out, "x", p.x);
        write_data(out, "y", p.y);
        write_data(out, "z", p.z);
        write_data(out, "radius", tree->radius[i]);
        file_writer_print(out,
                          "<data key=\"birth\">%" PRId32 "</data><data key=\"colony\">%" PRId32
                          "</data><data key=\"key\">%016" PRIx64 "</data></node>\n",
                          tree->birth[i], tree->colony[i], tree->id[i]);
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            file_writer_print(out,
                              "    <edge source=\"g%dn%" PRId32 "\" target=\"g%dn%" PRId64 "\">",
                              number, parent, number, i);
            write_data(out, "length", vec3_distance(tree->position[parent], tree->position[i]));
            file_writer_text(out, "</edge>\n");
        }
    }
    file_writer_text(out, "  </graph>\n");
}

bool out_trees_write_graphml(const OutTree *const *tree, const char *const *name, int count,
                             const char *file, Error *e)
{
    static const char *const keys[][3] = {
        {"name", "graph", "string"}, {"x", "node", "float"},      {"y", "node", "float"},
        {"z", "node", "float"},      {"radius", "node", "float"}, {"birth", "node", "int"},
        {"colony", "node", "int"},   {"key", "node", "string"},   {"length", "edge", "float"}};
    FileWriter *out = file_writer_open(file, e);
    if (!out) {
        return false;
    }
    file_writer_text(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                          "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\"\n"
                          "    xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
                          "    xsi:schemaLocation=\"http://graphml.graphdrawing.org/xmlns "
                          "http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd\">\n");
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        file_writer_print(out, "  <key id=\"%s\" for=\"%s\" attr.name=\"%s\" attr.type=\"%s\"/>\n",
                          keys[i][0], keys[i][1], keys[i][0], keys[i][2]);
    }
    for (int i = 0; i < count; i++) {
        if (tree[i]) {
            write_graph(out, tree[i], name[i], i);
        }
    }
    file_writer_text(out, "</graphml>\n");
    return file_writer_close(out, true, e);
}
