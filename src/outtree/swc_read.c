// Reads SWC files (Cannon 1998), written by many programs and untrusted.
#include "base/c_locale.h"
#include "base/memory.h"
#include "base/random.h"
#include "outtree/out_tree_io.h"
#include "outtree/text_table.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 7, MAX_NODES = 1 << 30 };
#define SEED 0x737763ull // of the node ids

static const TableFormat SWC = {"SWC", "an SWC file", "seven numbers"};

typedef struct Row {
    int64_t number, parent;
    int32_t type;
    int32_t line;
    int32_t above; // the parent's row; -1 at a root
    int32_t node;  // index in the tree; -1 = not added yet
    Vec3 position;
    float radius;
} Row;

typedef struct RowName {
    int64_t number;
    int32_t row;
} RowName;

typedef struct SwcFile {
    const char *file;
    Row *row;
    int64_t count, capacity;
    RowName *name; // sorted by number
} SwcFile;

static bool fail_at(const SwcFile *swc, int64_t line, Error *e)
{
    error_locate(e, swc->file, (int)line, 0);
    return false;
}

// ---- lines ----

static bool read_whole(double value, int64_t low, int64_t high, int64_t *out)
{
    bool valid = value >= (double)low && value <= (double)high && floor(value) == value;
    *out = valid ? (int64_t)value : 0;
    return valid;
}

// Parses the seven numbers of a line into column.
static bool read_columns(const char *text, double column[COLUMNS], Error *e)
{
    for (int i = 0; i < COLUMNS; i++) {
        char *end;
        column[i] = strtod(text, &end);
        if (end == text || (*end && !strchr(" \t", *end))) {
            text += strspn(text, " \t");
            return error_set(e, ERROR_INPUT,
                             *text ? "'%.20s' is no number; a line must hold seven: number type x "
                                     "y z radius parent"
                                   : "%s only %d numbers; a line must hold seven: number type x y "
                                     "z radius parent",
                             *text ? text : "has", i);
        }
        text = end;
    }
    text += strspn(text, " \t");
    return !*text || *text == '#' ||
           error_set(e, ERROR_INPUT,
                     "'%.20s' after seven numbers; a line must hold number type x y z "
                     "radius parent and no more",
                     text);
}

static bool read_row(const char *text, Row *row, Error *e)
{
    double c[COLUMNS] = {0};
    int64_t type;
    if (!read_columns(text, c, e)) {
        return false;
    }
    if (!read_whole(c[0], 0, INT64_C(1) << 53, &row->number) ||
        !read_whole(c[6], -1, INT64_C(1) << 53, &row->parent)) {
        return error_set(e, ERROR_INPUT,
                         "number %g with parent %g; numbers must be whole and not negative, a "
                         "parent a node's number, or -1 at a root",
                         c[0], c[6]);
    }
    if (!read_whole(c[1], INT32_MIN, INT32_MAX, &type)) {
        return error_set(e, ERROR_INPUT, "type %g; it must be a whole number", c[1]);
    }
    for (int i = 2; i < 6; i++) {
        if (!(fabs(c[i]) <= (double)FLT_MAX)) {
            return error_set(e, ERROR_INPUT, "%g is too large; coordinates must be finite", c[i]);
        }
    }
    if (c[5] < 0.0) {
        return error_set(e, ERROR_INPUT, "radius %g; it must be 0 or more", c[5]);
    }
    row->type = (int32_t)type;
    row->position = vec3((float)c[2], (float)c[3], (float)c[4]);
    row->radius = (float)c[5];
    return true;
}

static bool read_rows(SwcFile *swc, FILE *stream, Error *e)
{
    char text[TABLE_MAX_LINE];
    bool more = true;
    for (int64_t line = 1; more; line++) {
        if (!table_read_line(stream, &SWC, text, &more, e)) {
            return fail_at(swc, line, e);
        }
        const char *start = table_line_start(text, line);
        if (!*start || *start == '#') {
            continue;
        }
        if (swc->count >= MAX_NODES) {
            return error_set(e, ERROR_INPUT, "'%s' has more than %d nodes", swc->file, MAX_NODES);
        }
        if (!memory_reserve(&swc->row, &swc->capacity, swc->count + 1, sizeof *swc->row, e)) {
            return false;
        }
        Row *row = &swc->row[swc->count++];
        *row = (Row){.line = (int32_t)line, .above = -1, .node = -1};
        if (!read_row(start, row, e)) {
            return fail_at(swc, line, e);
        }
    }
    return swc->count > 0 ||
           (error_set(e, ERROR_INPUT, "no node in it; SWC has one a line"), fail_at(swc, 0, e));
}

// ---- rows to tree ----

static int compare_names(const void *a, const void *b)
{
    const RowName *p = a, *q = b;
    if (p->number != q->number) {
        return p->number < q->number ? -1 : 1;
    }
    return (p->row > q->row) - (p->row < q->row);
}

static int compare_number(const void *key, const void *name)
{
    int64_t a = *(const int64_t *)key, b = ((const RowName *)name)->number;
    return (a > b) - (a < b);
}

// Resolves every row's parent.
static bool link_rows(SwcFile *swc, Error *e)
{
    swc->name = memory_alloc(swc->count, sizeof *swc->name, e);
    if (!swc->name) {
        return false;
    }
    for (int64_t i = 0; i < swc->count; i++) {
        swc->name[i] = (RowName){swc->row[i].number, (int32_t)i};
    }
    qsort(swc->name, (size_t)swc->count, sizeof *swc->name, compare_names);
    for (int64_t i = 1; i < swc->count; i++) {
        if (swc->name[i].number == swc->name[i - 1].number) {
            error_set(e, ERROR_INPUT,
                      "number %lld is already used in line %d; each point must have its own number",
                      (long long)swc->name[i].number, swc->row[swc->name[i - 1].row].line);
            return fail_at(swc, swc->row[swc->name[i].row].line, e);
        }
    }
    for (int64_t i = 0; i < swc->count; i++) {
        Row *row = &swc->row[i];
        if (row->parent == -1) {
            continue;
        }
        const RowName *found =
            bsearch(&row->parent, swc->name, (size_t)swc->count, sizeof *swc->name, compare_number);
        if (!found) {
            error_set(e, ERROR_INPUT, "parent %lld is no node; it must be a node's number, or -1",
                      (long long)row->parent);
            return fail_at(swc, row->line, e);
        }
        row->above = found->row;
    }
    return true;
}

static bool add_row(OutTree *tree, Row *row, const Row *above, Error *e)
{
    int64_t parent = above ? above->node : -1;
    int32_t birth = above ? tree->birth[parent] + 1 : 0;
    uint64_t id = random_key(above ? tree->id[parent] : SEED, (uint64_t)row->number);
    int64_t node = out_tree_add_node(tree, row->position, parent, birth, row->type, id, e);
    if (node < 0) {
        return false;
    }
    tree->radius[node] = row->radius;
    row->node = (int32_t)node;
    return true;
}

// Adds a row after its missing ancestors, whose chain is kept in way[].
static bool add_with_ancestors(SwcFile *swc, OutTree *tree, int32_t index, int32_t *way, Error *e)
{
    int64_t length = 0;
    for (int32_t i = index; i >= 0 && swc->row[i].node < 0; i = swc->row[i].above) {
        if (length == swc->count) {
            error_set(e, ERROR_INPUT, "node %lld is its own ancestor; parents must lead to a root",
                      (long long)swc->row[index].number);
            return fail_at(swc, swc->row[index].line, e);
        }
        way[length++] = i;
    }
    while (length > 0) {
        Row *row = &swc->row[way[--length]];
        if (!add_row(tree, row, row->above >= 0 ? &swc->row[row->above] : NULL, e)) {
            return false;
        }
    }
    return true;
}

static OutTree *make_tree(SwcFile *swc, Error *e)
{
    OutTree *tree = out_tree_new(e);
    int32_t *way = memory_alloc(swc->count, sizeof *way, e);
    bool done = tree && way && out_tree_reserve(tree, swc->count, e);
    for (int64_t i = 0; done && i < swc->count; i++) {
        done = add_with_ancestors(swc, tree, (int32_t)i, way, e);
    }
    free(way);
    if (done) {
        tree->typed = true;
    } else {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

OutTree *out_tree_parse_swc(FILE *stream, const char *file, Error *e)
{
    SwcFile swc = {.file = file};
    OutTree *tree = NULL;
    CLocale locale;
    if (c_locale_enter(&locale, e)) {
        bool read = read_rows(&swc, stream, e) && link_rows(&swc, e);
        tree = read ? make_tree(&swc, e) : NULL;
        c_locale_leave(&locale);
    }
    free(swc.row);
    free(swc.name);
    return tree;
}

OutTree *out_tree_read_swc(const char *file, Error *e)
{
    return table_read(file, &SWC, out_tree_parse_swc, e);
}
