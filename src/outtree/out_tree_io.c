#include "outtree/out_tree_io.h"

#include "base/file_name.h"
#include "base/file_writer.h"
#include "base/number_text.h"

#include <inttypes.h>
#include <stdio.h>

// Room for a line of SWC or a node of an array.
enum { LONGEST = 5 * (INTEGER_TEXT_MOST + FLOAT_TEXT_MOST) };

bool out_tree_write_swc(const OutTree *tree, const char *file, Error *e)
{
    FileWriter *out = file_writer_open(file, e);
    if (!out) {
        return false;
    }
    file_writer_text(out, "# out-tree grown by ramify; lengths in metres\n"
                          "# number type x y z radius parent\n");
    for (int64_t i = 0; i < tree->count; i++) {
        char line[LONGEST], *at = integer_text(line, i + 1);
        *at++ = ' ';
        at = integer_text(at, tree->typed ? tree->colony[i] : SWC_UNDEFINED);
        *at++ = ' ';
        at = floats_text(at, &tree->position[i].x, 3, ' ');
        *at++ = ' ';
        at = float_text(at, tree->radius[i]);
        *at++ = ' ';
        at = integer_text(at, tree->parent[i] < 0 ? -1 : tree->parent[i] + (int64_t)1);
        *at++ = '\n';
        file_writer_bytes(out, line, (size_t)(at - line));
    }
    return file_writer_close(out, true, e);
}

static void write_integers(FileWriter *out, const char *name, const int32_t *value, int64_t count)
{
    file_writer_print(out, ",\n\"%s\": [", name);
    for (int64_t i = 0; i < count; i++) {
        char text[LONGEST] = ",", *start = i > 0 ? text + 1 : text;
        file_writer_bytes(out, text, (size_t)(integer_text(start, value[i]) - text));
    }
    file_writer_text(out, "]");
}

// Writes tuples of `size` floats, in brackets if size > 1.
static void write_floats(FileWriter *out, const char *name, const float *value, int size,
                         int64_t count)
{
    file_writer_print(out, ",\n\"%s\": [", name);
    for (int64_t i = 0; i < count; i++) {
        char text[LONGEST], *at = text;
        if (i > 0) {
            *at++ = ',';
        }
        if (size > 1) {
            *at++ = '[';
        }
        at = floats_text(at, value + i * size, size, ',');
        if (size > 1) {
            *at++ = ']';
        }
        file_writer_bytes(out, text, (size_t)(at - text));
    }
    file_writer_text(out, "]");
}

// One object with the arrays position ([x, y, z] in metres), parent (-1 at roots), birth, colony,
// radius (metres) and id (hexadecimal strings). Numbers read back to the same bits.
static bool write_json(const OutTree *tree, const char *file, Error *e)
{
    FileWriter *out = file_writer_open(file, e);
    if (!out) {
        return false;
    }
    file_writer_text(out, "{\"format\": \"ramify out-tree\", \"version\": 1, \"unit\": \"m\",\n");
    file_writer_print(out, "\"count\": %" PRId64, tree->count);
    write_floats(out, "position", &tree->position->x, 3, tree->count);
    write_integers(out, "parent", tree->parent, tree->count);
    write_integers(out, "birth", tree->birth, tree->count);
    write_integers(out, "colony", tree->colony, tree->count);
    write_floats(out, "radius", tree->radius, 1, tree->count);
    file_writer_text(out, ",\n\"id\": [");
    for (int64_t i = 0; i < tree->count; i++) {
        file_writer_print(out, "%s\"%016" PRIx64 "\"", i ? "," : "", tree->id[i]);
    }
    file_writer_text(out, "]}\n");
    return file_writer_close(out, true, e);
}

bool out_tree_write(const OutTree *tree, const char *file, Error *e)
{
    if (file_name_ends(file, ".swc")) {
        return out_tree_write_swc(tree, file, e);
    }
    if (file_name_ends(file, ".json")) {
        return write_json(tree, file, e);
    }
    if (file_name_ends(file, ".graphml")) {
        return out_trees_write_graphml(&tree, &(const char *){"tree"}, 1, file, e);
    }
    return error_set(e, ERROR_INPUT,
                     "cannot tell what kind of file '%s' is to be; .swc, .json and .graphml are "
                     "possible",
                     file);
}
