// Reads untrusted files of trees in a child process.
#include "base/child.h"
#include "base/file_name.h"
#include "outtree/out_tree_io.h"

#include <sys/stat.h>

// Limits of the process. Reading needs about 20 bytes per byte of the file and a second per 20 MB.
#define MIN_SECONDS 60.0
#define SECONDS_PER_BYTE 5e-6
#define MIN_MEMORY 1000000000
#define MEMORY_PER_BYTE 200

static bool write_tree(const OutTree *tree, ChildOutput *output, Error *e)
{
    int64_t n = tree->count;
    return child_write(output, tree->position, n, sizeof *tree->position, e) &&
           child_write(output, tree->parent, n, sizeof *tree->parent, e) &&
           child_write(output, tree->birth, n, sizeof *tree->birth, e) &&
           child_write(output, tree->colony, n, sizeof *tree->colony, e) &&
           child_write(output, tree->radius, n, sizeof *tree->radius, e) &&
           child_write(output, tree->normal, n, sizeof *tree->normal, e) &&
           child_write(output, tree->id, n, sizeof *tree->id, e);
}

typedef struct Reader {
    OutTree *(*read)(const char *file, Error *e);
    const char *wanted;
    bool typed, scanned; // the trees are (see OutTree)
} Reader;

static const Reader SWC = {out_tree_read_swc, "a whole SWC file", true, false};
static const Reader QSM = {out_tree_read_qsm, "a whole QSM file", false, true};

typedef struct Import {
    const Reader *reader;
    const char *file;
} Import;

static bool read_in_child(const void *data, ChildOutput *output, Error *e)
{
    const Import *import = data;
    OutTree *tree = import->reader->read(import->file, e);
    bool done = tree && write_tree(tree, output, e);
    out_tree_free(tree);
    return done;
}

static bool check_births(const OutTree *tree, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->birth[i] < 0) {
            return error_set(e, ERROR_INTERNAL, "node %lld has birth %d", (long long)i,
                             tree->birth[i]);
        }
    }
    return true;
}

static bool take_tree(OutTree *tree, ChildOutput *output, Error *e)
{
    int64_t a_node = (int64_t)(sizeof *tree->position + sizeof *tree->parent + sizeof *tree->birth +
                               sizeof *tree->colony + sizeof *tree->radius + sizeof *tree->normal +
                               sizeof *tree->id);
    int64_t n = output->left / a_node;
    bool done = out_tree_reserve(tree, n, e) &&
                child_read(output, tree->position, n, sizeof *tree->position, e) &&
                child_read(output, tree->parent, n, sizeof *tree->parent, e) &&
                child_read(output, tree->birth, n, sizeof *tree->birth, e) &&
                child_read(output, tree->colony, n, sizeof *tree->colony, e) &&
                child_read(output, tree->radius, n, sizeof *tree->radius, e) &&
                child_read(output, tree->normal, n, sizeof *tree->normal, e) &&
                child_read(output, tree->id, n, sizeof *tree->id, e);
    tree->count = done ? n : 0;
    return done && out_tree_check(tree, e) && check_births(tree, e);
}

static OutTree *import_tree(const Reader *reader, const char *file, const Run *run, Error *e)
{
    Import import = {reader, file};
    struct stat status;
    int64_t size = stat(file, &status) == 0 && S_ISREG(status.st_mode) ? status.st_size : 0;
    size = size < INT64_MAX / 1000 ? size : INT64_MAX / 1000;
    ChildJob job = {.task = read_in_child,
                    .data = &import,
                    .file = file,
                    .wanted = reader->wanted,
                    .seconds = MIN_SECONDS + SECONDS_PER_BYTE * (double)size,
                    .memory = MIN_MEMORY + MEMORY_PER_BYTE * size};
    ChildOutput output;
    if (!child_run(&job, run, &output, e)) {
        return NULL;
    }
    OutTree *tree = out_tree_new(e);
    bool done = tree && take_tree(tree, &output, e);
    child_output_close(&output);
    if (!done) {
        error_locate(e, file, 0, 0);
        out_tree_free(tree);
        return NULL;
    }
    tree->typed = reader->typed;
    tree->scanned = reader->scanned;
    return tree;
}

OutTree *out_tree_import_swc(const char *file, const Run *run, Error *e)
{
    return import_tree(&SWC, file, run, e);
}

OutTree *out_tree_import(const char *file, const Run *run, Error *e)
{
    bool qsm = file_name_ends(file, ".qsm") || file_name_ends(file, ".txt") ||
               file_name_ends(file, ".csv");
    return import_tree(qsm ? &QSM : &SWC, file, run, e);
}
