// Reads the cylinder tables that TreeQSM (Raumonen 2013) writes as text; untrusted.
#include "base/c_locale.h"
#include "base/memory.h"
#include "outtree/out_tree_io.h"
#include "outtree/qsm.h"
#include "outtree/text_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// Of the columns of a row, the first USED are the same in every version.
enum { RADIUS, LENGTH, START, AXIS = START + 3, PARENT = AXIS + 3, EXTENSION, USED, MOST = 17 };
enum { MAX_CYLINDERS = 1 << 29 };
#define LARGEST 1e12        // m
#define AXIS_TOLERANCE 0.05 // files round the axis
#define COLUMNS "radius, length, start (x y z), axis (x y z), parent, extension and 4, 5 or 7 more"

static const TableFormat QSM = {"QSM", "a QSM file (TreeQSM's cylinder table)",
                                "14, 15 or 17 numbers a line"};

typedef struct QsmFile {
    const char *file;
    Cylinder *cylinder;
    int64_t count, capacity;
    int columns; // of the first row; 0 before it
} QsmFile;

// One line of the table.
typedef struct Row {
    const char *text;
    int64_t line;
    double value[MOST];
    int column[MOST]; // in the text, from 1
    int count;
} Row;

// Takes the error that was just set to a place in a line.
static bool fail_at(const QsmFile *qsm, int64_t line, int column, Error *e)
{
    error_locate(e, qsm->file, (int)line, column);
    return false;
}

// ---- numbers ----

// Past blanks and at most one comma.
static const char *skip_separator(const char *at)
{
    at += strspn(at, " \t");
    at += *at == ',';
    return at + strspn(at, " \t");
}

static bool split_row(const QsmFile *qsm, const char *start, Row *row, Error *e)
{
    for (const char *at = start; *at && *at != '#'; at = skip_separator(at)) {
        char *end;
        int column = (int)(at - row->text) + 1;
        if (row->count == MOST) {
            error_set(e, ERROR_INPUT, "'%.20s' after %d numbers; a line must hold " COLUMNS, at,
                      MOST);
            return fail_at(qsm, row->line, column, e);
        }
        row->value[row->count] = strtod(at, &end);
        if (end == at || (*end && !strchr(" \t,", *end))) {
            error_set(e, ERROR_INPUT, "'%.20s' is no number; a line must hold " COLUMNS, at);
            return fail_at(qsm, row->line, column, e);
        }
        row->column[row->count++] = column;
        at = end;
    }
    return true;
}

static bool check_count(QsmFile *qsm, const Row *row, Error *e)
{
    int n = row->count;
    if (n != 14 && n != 15 && n != MOST) {
        error_set(e, ERROR_INPUT, "%d number%s in the line; it must hold " COLUMNS, n,
                  n == 1 ? "" : "s");
    } else if (qsm->columns && n != qsm->columns) {
        error_set(e, ERROR_INPUT, "%d numbers in the line; it must hold %d, as the lines before it",
                  n, qsm->columns);
    } else {
        qsm->columns = n;
        return true;
    }
    return fail_at(qsm, row->line, row->column[n - 1], e);
}

// Row number of column i, which counts from 1; -1 for 0 = none. The upper bound is checked when all
// rows are known.
static bool take_link(const QsmFile *qsm, const Row *row, int i, int64_t *link, Error *e)
{
    double value = row->value[i];
    if (!(value >= 0.0 && value <= (double)MAX_CYLINDERS && floor(value) == value)) {
        error_set(e, ERROR_INPUT, "%s %g; it must be the number of a line of the table, or 0",
                  i == PARENT ? "parent" : "extension", value);
        return fail_at(qsm, row->line, row->column[i], e);
    }
    *link = (int64_t)value - 1;
    return true;
}

static bool take_axis(const QsmFile *qsm, const Row *row, Cylinder *c, Error *e)
{
    const double *axis = &row->value[AXIS];
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    bool none = length == 0.0 && c->length == 0.0; // a cylinder without length needs no direction
    if (!none && !(fabs(length - 1.0) <= AXIS_TOLERANCE)) {
        error_set(e, ERROR_INPUT, "axis %g %g %g of length %g; its length must be 1", axis[0],
                  axis[1], axis[2], length);
        return fail_at(qsm, row->line, row->column[AXIS], e);
    }
    for (int i = 0; i < 3; i++) {
        c->axis[i] = none ? i == 2 : axis[i] / length;
    }
    return true;
}

static bool take_row(const QsmFile *qsm, const Row *row, Cylinder *c, Error *e)
{
    for (int i = 0; i < PARENT; i++) {
        bool size = i == RADIUS || i == LENGTH;
        if (!(fabs(row->value[i]) <= LARGEST)) {
            error_set(e, ERROR_INPUT, "%g in column %d; it must be finite, at most %g m",
                      row->value[i], i + 1, LARGEST);
            return fail_at(qsm, row->line, row->column[i], e);
        }
        if (size && row->value[i] < 0.0) {
            error_set(e, ERROR_INPUT, "%s %g; it must be 0 or more",
                      i == RADIUS ? "radius" : "length", row->value[i]);
            return fail_at(qsm, row->line, row->column[i], e);
        }
    }
    *c = (Cylinder){.radius = row->value[RADIUS],
                    .length = row->value[LENGTH],
                    .line = (int32_t)row->line,
                    .parent_column = row->column[PARENT],
                    .extension_column = row->column[EXTENSION]};
    memcpy(c->start, &row->value[START], sizeof c->start);
    return take_axis(qsm, row, c, e) && take_link(qsm, row, PARENT, &c->parent, e) &&
           take_link(qsm, row, EXTENSION, &c->extension, e);
}

// ---- lines ----

// TreeQSM 2.4 writes the names of the columns into the first line.
static bool is_header(const char *start)
{
    start += *start == '"';
    return strncasecmp(start, "radius", 6) == 0;
}

static bool add_row(QsmFile *qsm, Row *row, const char *start, Error *e)
{
    if (qsm->count >= MAX_CYLINDERS) {
        error_set(e, ERROR_INPUT, "more than %d cylinders", MAX_CYLINDERS);
        return fail_at(qsm, row->line, 0, e);
    }
    if (!memory_reserve(&qsm->cylinder, &qsm->capacity, qsm->count + 1, sizeof *qsm->cylinder, e)) {
        return false;
    }
    return split_row(qsm, start, row, e) && check_count(qsm, row, e) &&
           take_row(qsm, row, &qsm->cylinder[qsm->count++], e);
}

static bool read_rows(QsmFile *qsm, FILE *stream, Error *e)
{
    char text[TABLE_MAX_LINE];
    bool more = true, begun = false;
    for (int64_t line = 1; more; line++) {
        if (!table_read_line(stream, &QSM, text, &more, e)) {
            return fail_at(qsm, line, 0, e);
        }
        const char *start = table_line_start(text, line);
        bool blank = !*start || *start == '#';
        bool header = !blank && !begun && is_header(start);
        begun = begun || !blank;
        Row row = {.text = text, .line = line};
        if (!blank && !header && !add_row(qsm, &row, start, e)) {
            return false;
        }
    }
    if (qsm->count == 0) {
        error_set(e, ERROR_INPUT, "no cylinder in it; a QSM has one a line: " COLUMNS);
        return fail_at(qsm, 0, 0, e);
    }
    return true;
}

static bool check_links(const QsmFile *qsm, Error *e)
{
    for (int64_t i = 0; i < qsm->count; i++) {
        const Cylinder *c = &qsm->cylinder[i];
        bool parent = c->parent >= qsm->count;
        if (parent || c->extension >= qsm->count) {
            error_set(e, ERROR_INPUT, "%s %lld; the table has %lld cylinders, 0 = none",
                      parent ? "parent" : "extension",
                      (long long)(parent ? c->parent : c->extension) + 1, (long long)qsm->count);
            return fail_at(qsm, c->line, parent ? c->parent_column : c->extension_column, e);
        }
    }
    return true;
}

OutTree *out_tree_parse_qsm(FILE *stream, const char *file, Error *e)
{
    QsmFile qsm = {.file = file};
    OutTree *tree = NULL;
    CLocale locale;
    if (c_locale_enter(&locale, e)) {
        bool read = read_rows(&qsm, stream, e) && check_links(&qsm, e);
        tree = read ? qsm_make_tree(qsm.cylinder, qsm.count, file, e) : NULL;
        c_locale_leave(&locale);
    }
    free(qsm.cylinder);
    return tree;
}

OutTree *out_tree_read_qsm(const char *file, Error *e)
{
    return table_read(file, &QSM, out_tree_parse_qsm, e);
}
