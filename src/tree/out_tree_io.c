#include "tree/out_tree_io.h"

#include "base/file_replace.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// A file on its way: written to memory first, then put in place whole.
typedef struct NewFile {
    const char *file;
    FILE *stream;
    char *bytes;
    size_t size;
} NewFile;

static bool new_file_open(NewFile *out, const char *file, Error *e)
{
    *out = (NewFile){.file = file};
    out->stream = open_memstream(&out->bytes, &out->size);
    return out->stream || error_set(e, ERROR_MEMORY, "out of memory for '%s'", file);
}

static bool new_file_close(NewFile *out, Error *e)
{
    bool good = !ferror(out->stream);
    good = fclose(out->stream) == 0 && good;
    if (!good) {
        error_set(e, ERROR_MEMORY, "out of memory for '%s'", out->file);
    }
    good = good && file_replace(out->file, out->bytes, out->size, e);
    free(out->bytes);
    return good;
}

bool out_tree_write_swc(const OutTree *tree, const char *file, Error *e)
{
    NewFile out;
    if (!new_file_open(&out, file, e)) {
        return false;
    }
    fprintf(out.stream, "# out-tree grown by ramify; lengths in metres\n"
                        "# number type x y z radius parent\n");
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        int64_t parent = tree->parent[i] < 0 ? -1 : tree->parent[i] + (int64_t)1;
        fprintf(out.stream, "%" PRId64 " %" PRId32 " %.9g %.9g %.9g %.9g %" PRId64 "\n", i + 1,
                tree->typed ? tree->colony[i] : SWC_UNDEFINED, (double)p.x, (double)p.y,
                (double)p.z, (double)tree->radius[i], parent);
    }
    return new_file_close(&out, e);
}

static void write_integers(FILE *stream, const char *name, const int32_t *value, int64_t count)
{
    fprintf(stream, ",\n\"%s\": [", name);
    for (int64_t i = 0; i < count; i++) {
        fprintf(stream, "%s%" PRId32, i ? "," : "", value[i]);
    }
    fputs("]", stream);
}

bool out_tree_write_json(const OutTree *tree, const char *file, Error *e)
{
    NewFile out;
    if (!new_file_open(&out, file, e)) {
        return false;
    }
    fprintf(out.stream, "{\"format\": \"ramify out-tree\", \"version\": 1, \"unit\": \"m\",\n");
    fprintf(out.stream, "\"count\": %" PRId64 ",\n\"position\": [", tree->count);
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        fprintf(out.stream, "%s[%.9g,%.9g,%.9g]", i ? "," : "", (double)p.x, (double)p.y,
                (double)p.z);
    }
    fputs("]", out.stream);
    write_integers(out.stream, "parent", tree->parent, tree->count);
    write_integers(out.stream, "birth", tree->birth, tree->count);
    write_integers(out.stream, "colony", tree->colony, tree->count);
    fputs(",\n\"radius\": [", out.stream);
    for (int64_t i = 0; i < tree->count; i++) {
        fprintf(out.stream, "%s%.9g", i ? "," : "", (double)tree->radius[i]);
    }
    fputs("],\n\"id\": [", out.stream);
    for (int64_t i = 0; i < tree->count; i++) {
        fprintf(out.stream, "%s\"%016" PRIx64 "\"", i ? "," : "", tree->id[i]);
    }
    fputs("]}\n", out.stream);
    return new_file_close(&out, e);
}

static bool ends_with(const char *text, const char *end)
{
    size_t a = strlen(text), b = strlen(end);
    return a >= b && strcasecmp(text + a - b, end) == 0;
}

bool out_tree_write(const OutTree *tree, const char *file, Error *e)
{
    if (ends_with(file, ".swc")) {
        return out_tree_write_swc(tree, file, e);
    }
    if (ends_with(file, ".json")) {
        return out_tree_write_json(tree, file, e);
    }
    return error_set(e, ERROR_INPUT,
                     "cannot tell what kind of file '%s' is to be; .swc and .json are possible",
                     file);
}
