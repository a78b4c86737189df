#include "config/resolve_value.h"

#include "base/random.h"
#include "config/hint.h"
#include "config/scalar.h"

#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define MAX_NAMES 32

const char *node_describe(Resolver *r, const Node *node)
{
    double number;
    const char *text = "";
    if (node->kind != NODE_SCALAR) {
        return node->kind == NODE_LIST ? "a list" : "a mapping";
    }
    if (node_is_null(node)) {
        return "empty";
    }
    if (node->quoted) {
        text = arena_format(r->arena, r->e, "the text \"%.60s\"", node->text);
    } else {
        text = arena_format(r->arena, r->e,
                            scalar_number(node->text, &number) ? "%.60s" : "'%.60s'", node->text);
    }
    return text ? text : "";
}

// "greater than 0 and at most 90 degrees", "a finite number": what a number must be.
static void key_range(const Key *row, char *text, int size)
{
    bool whole = row->type == KEY_INT || row->type == KEY_INT64 || row->type == KEY_UINT64;
    const char *unit = row->unit ? row->unit : "", *space = row->unit ? " " : "";
    if (row->low == 0.0 && row->high == 0.0) {
        snprintf(text, (size_t)size, "a finite number%s%s%s", row->unit ? " (" : "", unit,
                 row->unit ? ")" : "");
        return;
    }
    if (row->type == KEY_UINT64) {
        snprintf(text, (size_t)size, "a whole number, at least 0 and below 2^64");
        return;
    }
    char low[32], high[32];
    scalar_from_double(row->low, low);
    scalar_from_double(row->high, high);
    snprintf(text, (size_t)size, "%s%s %s and %s %s%s%s", whole ? "a whole number, " : "",
             row->flags & KEY_ABOVE ? "greater than" : "at least", low,
             row->flags & KEY_BELOW ? "less than" : "at most", high, space, unit);
}

static Node *out_of_range(Resolver *r, const Key *row, const Node *given, const char *name)
{
    char range[160];
    key_range(row, range, sizeof range);
    resolver_fail(r, given, "%s is %s; it must be %s", name, node_describe(r, given), range);
    return NULL;
}

static bool in_range(const Key *row, double value)
{
    if (row->low == 0.0 && row->high == 0.0) {
        return isfinite(value);
    }
    bool low = row->flags & KEY_ABOVE ? value > row->low : value >= row->low;
    bool high = row->flags & KEY_BELOW ? value < row->high : value <= row->high;
    return low && high;
}

static Node *wrong_type(Resolver *r, const Node *given, const char *name, const char *right)
{
    resolver_fail(r, given, "%s is %s; it must be %s", name, node_describe(r, given), right);
    return NULL;
}

static bool is_plain(const Node *given)
{
    return given->kind == NODE_SCALAR && !given->quoted && !node_is_null(given);
}

static Node *resolve_real(Resolver *r, const Key *row, const Node *given, const char *name)
{
    double value;
    if (!is_plain(given) || !scalar_number(given->text, &value)) {
        return wrong_type(r, given, name, "a number");
    }
    bool fits = row->type == KEY_DOUBLE || fabs(value) <= (double)FLT_MAX || isnan(value);
    if (!fits || !in_range(row, value)) {
        return out_of_range(r, row, given, name);
    }
    char text[32];
    if (row->type == KEY_DOUBLE) {
        scalar_from_double(value, text);
    } else {
        scalar_from_float((float)value, text);
    }
    return node_scalar(r->arena, arena_text(r->arena, text, strlen(text), r->e), r->e);
}

static Node *resolve_integer(Resolver *r, const Key *row, const Node *given, const char *name)
{
    bool negative = false, too_large = false;
    uint64_t magnitude = 0;
    double between;
    if (given->animated && is_plain(given) && scalar_number(given->text, &between) &&
        fabs(between) < 1e15) {
        Node rounded = *given;
        rounded.animated = false;
        rounded.text = arena_format(r->arena, r->e, "%.0f", round(between));
        return rounded.text ? resolve_integer(r, row, &rounded, name) : NULL;
    }
    if (!is_plain(given) ||
        (!scalar_integer(given->text, &negative, &magnitude, &too_large) && !too_large)) {
        return wrong_type(r, given, name, "a whole number");
    }
    double value = negative ? -(double)magnitude : (double)magnitude;
    if (too_large || !in_range(row, value)) {
        return out_of_range(r, row, given, name);
    }
    return node_scalar(
        r->arena,
        arena_format(r->arena, r->e, "%s%" PRIu64, negative && magnitude ? "-" : "", magnitude),
        r->e);
}

static Node *resolve_truth(Resolver *r, const Node *given, const char *name)
{
    bool value;
    if (!is_plain(given) || !scalar_truth(given->text, &value)) {
        return wrong_type(r, given, name, "true or false");
    }
    return node_scalar(r->arena, value ? "true" : "false", r->e);
}

static Node *resolve_enum(Resolver *r, const Key *row, const Node *given, const char *name)
{
    const char *known[MAX_NAMES];
    int count = 0;
    for (const cyaml_strval_t *s = row->names; s->str && count < MAX_NAMES; s++) {
        known[count++] = s->str;
    }
    // YAML 1.1 reads a bare `none` as text, but people write it with quotes or without.
    const cyaml_strval_t *found =
        given->kind == NODE_SCALAR ? enum_by_name(row->names, given->text) : NULL;
    if (!found) {
        char hint[512];
        hint_format(given->kind == NODE_SCALAR ? given->text : "", known, count, hint, sizeof hint);
        resolver_fail(r, given, "%s is %s; %s", name, node_describe(r, given), hint);
        return NULL;
    }
    return node_scalar(r->arena, found->str, r->e);
}

static Node *resolve_text(Resolver *r, const Key *row, const Node *given, const char *name)
{
    if (given->kind != NODE_SCALAR || node_is_null(given) || !*given->text) {
        return wrong_type(r, given, name, "a text");
    }
    if (row->type == KEY_NAME && strlen(given->text) >= (size_t)row->count) {
        resolver_fail(r, given, "%s has %zu bytes; it must have fewer than %d", name,
                      strlen(given->text), row->count);
        return NULL;
    }
    Node *node = node_scalar(r->arena, given->text, r->e);
    if (node) {
        node->quoted = true;
    }
    return node;
}

static bool check_file(Resolver *r, const Node *given, const char *name, const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0 || (S_ISREG(status.st_mode) && access(path, R_OK) != 0)) {
        return resolver_fail(r, given,
                             "%s: cannot read '%s': %s; paths are relative to the scene's folder",
                             name, given->text, strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) {
        return resolver_fail(r, given, "%s: '%s' is a %s; it must be a file", name, given->text,
                             S_ISDIR(status.st_mode) ? "folder" : "device");
    }
    for (const char *c = path; *c; c++) {
        r->files = random_key(r->files, (unsigned char)*c);
    }
    r->files = random_key(r->files, (uint64_t)status.st_size);
    r->files = random_key(r->files, (uint64_t)status.st_mtim.tv_sec);
    r->files = random_key(r->files, (uint64_t)status.st_mtim.tv_nsec);
    return true;
}

static Node *resolve_file(Resolver *r, const Key *row, const Node *given, const char *name)
{
    Node *node = resolve_text(r, row, given, name);
    if (!node) {
        return NULL;
    }
    node->resolved = *node->text == '/' || !*r->folder
                         ? node->text
                         : arena_format(r->arena, r->e, "%s/%s", r->folder, node->text);
    return node->resolved && check_file(r, given, name, node->resolved) ? node : NULL;
}

Node *resolver_number_list(Resolver *r, const float *values, int count)
{
    Node *list = node_new(r->arena, NODE_LIST, r->e);
    for (int i = 0; list && i < count; i++) {
        char text[32];
        scalar_from_float(values[i], text);
        Node *item = node_scalar(r->arena, arena_text(r->arena, text, strlen(text), r->e), r->e);
        if (!item) {
            return NULL;
        }
        node_append(list, item, NULL);
    }
    return list;
}

// One number for all components.
static Node *resolve_splat(Resolver *r, const Key *row, const Node *given, const char *name,
                           int count)
{
    const Node *number = resolve_real(r, row, given, name);
    if (!number) {
        return NULL;
    }
    float value = strtof(number->text, NULL), values[4] = {value, value, value, value};
    return resolver_number_list(r, values, count);
}

static Node *resolve_vector(Resolver *r, const Key *row, const Node *given, const char *name,
                            int count)
{
    if ((row->flags & KEY_SPLAT || row->type == KEY_COLOR) && is_plain(given)) {
        return resolve_splat(r, row, given, name, count);
    }
    char right[96];
    snprintf(right, sizeof right, "a list of %d numbers", count);
    if (given->kind != NODE_LIST) {
        return wrong_type(r, given, name, right);
    }
    if (given->count != count) {
        resolver_fail(r, given, "%s has %d entries; it must be %s", name, given->count, right);
        return NULL;
    }
    Node *list = node_new(r->arena, NODE_LIST, r->e);
    int index = 0;
    for (const Node *item = given->first; list && item; item = item->next) {
        const char *item_name = arena_format(r->arena, r->e, "%s[%d]", name, index++);
        Node *number = item_name ? resolve_real(r, row, item, item_name) : NULL;
        if (!number) {
            return NULL;
        }
        node_append(list, number, NULL);
    }
    return list;
}

static Node *resolve_color(Resolver *r, const Key *row, const Node *given, const char *name)
{
    double number;
    if (given->kind == NODE_LIST || (is_plain(given) && scalar_number(given->text, &number))) {
        return resolve_vector(r, row, given, name, 3);
    }
    float values[3];
    if (given->kind != NODE_SCALAR || !scalar_color(given->text, values)) {
        return wrong_type(r, given, name,
                          "[red, green, blue], one number for a grey, or \"#rrggbb\" in quotes");
    }
    return resolver_number_list(r, values, 3);
}

// A list of numbers as one text, "[1, 2]".
static const char *list_text(Resolver *r, const Node *list)
{
    size_t length = 3;
    for (const Node *item = list->first; item; item = item->next) {
        length += strlen(item->text) + 2;
    }
    char *text = arena_alloc(r->arena, length, r->e), *at = text;
    for (const Node *item = list->first; text && item; item = item->next) {
        at = stpcpy(at, item == list->first ? "[" : ", ");
        at = stpcpy(at, item->text);
    }
    if (text) {
        stpcpy(at, "]");
    }
    return text;
}

// A number, a word or a list of numbers, kept as it is written; loaded as text.
static Node *resolve_any(Resolver *r, const Key *row, const Node *given, const char *name)
{
    const char *right = "a number, a list of numbers, a colour or a word";
    if (given->kind == NODE_SCALAR && !node_is_null(given) && *given->text) {
        Node *copy = node_scalar(r->arena, given->text, r->e);
        if (copy) {
            copy->quoted = given->quoted;
        }
        return copy;
    }
    if (given->kind != NODE_LIST || given->count == 0) {
        return wrong_type(r, given, name, right);
    }
    if (given->count > row->count) {
        resolver_fail(r, given, "%s has %d numbers; it must have at most %d", name, given->count,
                      row->count);
        return NULL;
    }
    Node *list = node_new(r->arena, NODE_LIST, r->e);
    for (const Node *item = given->first; list && item; item = item->next) {
        double value;
        if (item->kind != NODE_SCALAR || !is_plain(item) || !scalar_number(item->text, &value)) {
            return wrong_type(r, item, name, right);
        }
        Node *copy = node_scalar(r->arena, item->text, r->e);
        if (!copy) {
            return NULL;
        }
        node_append(list, copy, NULL);
    }
    if (list) {
        list->resolved = list_text(r, list);
    }
    return list && list->resolved ? list : NULL;
}

Node *resolve_value(Resolver *r, const Key *row, const Node *given, const Path *up)
{
    const char *name = resolver_path(r, up, row->key);
    switch (row->type) {
    case KEY_BOOL:
        return resolve_truth(r, given, name);
    case KEY_INT:
    case KEY_INT64:
    case KEY_UINT64:
        return resolve_integer(r, row, given, name);
    case KEY_FLOAT:
    case KEY_DOUBLE:
        return resolve_real(r, row, given, name);
    case KEY_ENUM:
        return resolve_enum(r, row, given, name);
    case KEY_TEXT:
    case KEY_NAME:
        return resolve_text(r, row, given, name);
    case KEY_FILE:
        return resolve_file(r, row, given, name);
    case KEY_VECTOR:
        return resolve_vector(r, row, given, name, row->count);
    case KEY_COLOR:
        return resolve_color(r, row, given, name);
    case KEY_ANY:
        return resolve_any(r, row, given, name);
    default:
        error_set(r->e, ERROR_INTERNAL, "key '%s' has no values of its own", row->key);
        return NULL;
    }
}

// The default number as text.
static void default_text(const Key *row, const char *at, char *text)
{
    union {
        int i;
        int64_t i64;
        uint64_t u64;
        float f;
        double d;
        bool b;
    } v = {0};
    switch (row->type) {
    case KEY_BOOL:
        memcpy(&v.b, at, sizeof v.b);
        snprintf(text, 32, "%s", v.b ? "true" : "false");
        break;
    case KEY_INT:
        memcpy(&v.i, at, sizeof v.i);
        snprintf(text, 32, "%d", v.i);
        break;
    case KEY_INT64:
        memcpy(&v.i64, at, sizeof v.i64);
        snprintf(text, 32, "%" PRId64, v.i64);
        break;
    case KEY_UINT64:
        memcpy(&v.u64, at, sizeof v.u64);
        snprintf(text, 32, "%" PRIu64, v.u64);
        break;
    case KEY_FLOAT:
        memcpy(&v.f, at, sizeof v.f);
        scalar_from_float(v.f, text);
        break;
    case KEY_DOUBLE:
        memcpy(&v.d, at, sizeof v.d);
        scalar_from_double(v.d, text);
        break;
    case KEY_ENUM:
        memcpy(&v.i, at, sizeof v.i);
        snprintf(text, 32, "%s", enum_name(row->names, v.i));
        break;
    default:
        text[0] = 0;
    }
}

bool resolve_default(Resolver *r, const Key *row, const char *base, Node **node)
{
    const char *at = base + row->offset;
    float values[4];
    char text[32];
    switch (row->type) {
    case KEY_TEXT:
    case KEY_FILE:
    case KEY_NAME:
    case KEY_ANY:
        return true; // no text of ours has a default other than none
    case KEY_VECTOR:
    case KEY_COLOR:
        memcpy(values, at, sizeof(float) * (size_t)(row->type == KEY_COLOR ? 3 : row->count));
        *node = resolver_number_list(r, values, row->type == KEY_COLOR ? 3 : row->count);
        return *node;
    default:
        default_text(row, at, text);
        *node = node_scalar(r->arena, arena_text(r->arena, text, strlen(text), r->e), r->e);
        return *node;
    }
}
