#include "config/load_value.h"

#include "base/random.h"
#include "config/hint.h"
#include "config/scalar.h"
#include "config/text.h"

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

// A value to be stored in its member.
typedef struct Value {
    Loader *loader;
    const Key *row;
    const Node *given;
    const char *name; // "camera.position[2]"
} Value;

const char *node_describe(const Loader *loader, const Node *node)
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
        text = arena_format(loader->arena, loader->e, "the text \"%.60s\"", node->text);
    } else {
        text = arena_format(loader->arena, loader->e,
                            scalar_number(node->text, &number) ? "%.60s" : "'%.60s'", node->text);
    }
    return text ? text : "";
}

// The range of a number in words: "greater than 0 and at most 90 degrees", "a finite number".
static void key_range(const Key *row, char *text, int size)
{
    bool whole = row->type == KEY_INT || row->type == KEY_INT64 || row->type == KEY_UINT64;
    const char *unit = row->unit ? row->unit : "", *space = row->unit ? " " : "";
    char low[32], high[32];
    scalar_from_double(row->low, low);
    scalar_from_double(row->high, high);
    if (row->low == 0.0 && row->high == 0.0) {
        snprintf(text, (size_t)size, "a finite number%s%s%s", row->unit ? " (" : "", unit,
                 row->unit ? ")" : "");
    } else if (row->type == KEY_UINT64) {
        snprintf(text, (size_t)size, "a whole number, at least 0 and below 2^64");
    } else {
        snprintf(text, (size_t)size, "%s%s %s and %s %s%s%s", whole ? "a whole number, " : "",
                 row->flags & KEY_ABOVE ? "greater than" : "at least", low,
                 row->flags & KEY_BELOW ? "less than" : "at most", high, space, unit);
    }
}

static bool out_of_range(const Value *v)
{
    char range[160];
    key_range(v->row, range, sizeof range);
    return load_fail(v->loader, v->given, "%s is %s; it must be %s", v->name,
                     node_describe(v->loader, v->given), range);
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

static bool wrong_type(const Value *v, const char *right)
{
    return load_fail(v->loader, v->given, "%s is %s; it must be %s", v->name,
                     node_describe(v->loader, v->given), right);
}

static bool is_plain(const Node *given)
{
    return given->kind == NODE_SCALAR && !given->quoted && !node_is_null(given);
}

// ---- numbers ----

static bool load_real(const Value *v, double *value)
{
    if (!is_plain(v->given) || !scalar_number(v->given->text, value)) {
        return wrong_type(v, "a number");
    }
    bool fits = v->row->type == KEY_DOUBLE || fabs(*value) <= (double)FLT_MAX || isnan(*value);
    return (fits && in_range(v->row, *value)) || out_of_range(v);
}

static bool load_float(const Value *v, float *member)
{
    double value = 0.0;
    bool done = load_real(v, &value);
    *member = done ? (float)value : 0.0f;
    return done;
}

// A whole number as sign and magnitude.
static bool load_integer(const Value *v, bool *negative, uint64_t *magnitude)
{
    const Node *given = v->given;
    bool too_large = false;
    double between;
    if (given->animated && is_plain(given) && scalar_number(given->text, &between) &&
        fabs(between) < 1e15) { // interpolated between two keys
        between = round(between);
        *negative = between < 0.0;
        *magnitude = (uint64_t)fabs(between);
    } else if (!is_plain(given) ||
               (!scalar_integer(given->text, negative, magnitude, &too_large) && !too_large)) {
        return wrong_type(v, "a whole number");
    }
    double value = *negative ? -(double)*magnitude : (double)*magnitude;
    return (!too_large && in_range(v->row, value)) || out_of_range(v);
}

static bool load_whole(const Value *v, void *member)
{
    bool negative = false;
    uint64_t magnitude = 0;
    bool done = load_integer(v, &negative, &magnitude);
    uint64_t bits = negative ? 0 - magnitude : magnitude; // two's complement
    int whole = (int)(int64_t)bits;
    memcpy(member, v->row->type == KEY_INT ? (void *)&whole : (void *)&bits, key_size(v->row));
    return done;
}

// ---- words ----

static bool load_truth(const Value *v, bool *member)
{
    return (is_plain(v->given) && scalar_truth(v->given->text, member)) ||
           wrong_type(v, "true or false");
}

static bool load_enum(const Value *v, int *member)
{
    const Node *given = v->given;
    // YAML 1.1 reads a plain `none` as text; it is accepted with or without quotes.
    const char *text = given->kind == NODE_SCALAR ? given->text : "";
    const EnumName *found = enum_find(v->row->names, text);
    if (!found) {
        const char *known[MAX_NAMES];
        int count = 0;
        for (const EnumName *n = v->row->names; n->name && count < MAX_NAMES; n++) {
            known[count++] = n->name;
        }
        char hint[512];
        hint_format(text, known, count, hint, sizeof hint);
        return load_fail(v->loader, given, "%s is %s; %s", v->name, node_describe(v->loader, given),
                         hint);
    }
    *member = found->value;
    return true;
}

static bool check_text(const Value *v)
{
    const Node *given = v->given;
    return (given->kind == NODE_SCALAR && !node_is_null(given) && *given->text) ||
           wrong_type(v, "a text");
}

static bool keep_text(const Value *v, const char *text, char **member)
{
    *member = arena_text(v->loader->arena, text, strlen(text), v->loader->e);
    return *member;
}

static bool load_name(const Value *v, char *member)
{
    size_t length = strlen(v->given->text), size = (size_t)v->row->count;
    if (length >= size) {
        return load_fail(v->loader, v->given, "%s has %zu bytes; it must have fewer than %d",
                         v->name, length, v->row->count);
    }
    memset(member, 0, size);
    memcpy(member, v->given->text, length);
    return true;
}

// ---- files ----

static bool check_file(const Value *v, const char *path)
{
    struct stat status;
    const char *text = v->given->text;
    if (stat(path, &status) != 0 || (S_ISREG(status.st_mode) && access(path, R_OK) != 0)) {
        return load_fail(v->loader, v->given,
                         "%s: cannot read '%s': %s; paths are relative to the scene's folder",
                         v->name, text, strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) {
        return load_fail(v->loader, v->given, "%s: '%s' is a %s; it must be a file", v->name, text,
                         S_ISDIR(status.st_mode) ? "folder" : "device");
    }
    uint64_t hash = v->loader->hash;
    for (const char *c = path; *c; c++) {
        hash = random_key(hash, (unsigned char)*c);
    }
    hash = random_key(hash, (uint64_t)status.st_size);
    hash = random_key(hash, (uint64_t)status.st_mtim.tv_sec);
    v->loader->hash = random_key(hash, (uint64_t)status.st_mtim.tv_nsec);
    return true;
}

// The path from the folder of the file that has the value.
static char *join_path(const Value *v)
{
    const Loader *loader = v->loader;
    const char *text = v->given->text, *folder = loader->folder;
    const char *slash = v->given->file ? strrchr(v->given->file, '/') : NULL;
    int length = slash ? (int)(slash - v->given->file) : (int)strlen(folder);
    return *text == '/' || length == 0 ? arena_text(loader->arena, text, strlen(text), loader->e)
                                       : arena_format(loader->arena, loader->e, "%.*s/%s", length,
                                                      slash ? v->given->file : folder, text);
}

static bool load_file(const Value *v, char **member)
{
    Loader *loader = v->loader;
    const char *text = v->given->text;
    if (v->row->flags & KEY_OR_URI && strstr(text, "://")) {
        return keep_text(v, text, member);
    }
    char *path = join_path(v);
    size_t length = strlen(loader->folder);
    bool below = path && *text != '/' && length > 0 && strncmp(path, loader->folder, length) == 0 &&
                 path[length] == '/';
    FileName *file = arena_alloc(loader->arena, sizeof *file, loader->e);
    if (!path || !file || !(loader->without_files || check_file(v, path))) {
        return false;
    }
    *file = (FileName){loader->files, path, below ? path + length + 1 : path};
    loader->files = file;
    *member = path;
    return true;
}

// ---- several numbers ----

static bool load_vector(const Value *v, float *member, int count)
{
    const Node *given = v->given;
    if ((v->row->flags & KEY_SPLAT || v->row->type == KEY_COLOR) && is_plain(given)) {
        bool done = load_float(v, member);
        for (int i = 1; i < count; i++) {
            member[i] = member[0];
        }
        return done;
    }
    char right[96];
    snprintf(right, sizeof right, "a list of %d numbers", count);
    if (given->kind != NODE_LIST) {
        return wrong_type(v, right);
    }
    if (given->count != count) {
        return load_fail(v->loader, given, "%s has %d entries; it must be %s", v->name,
                         given->count, right);
    }
    bool done = true;
    int index = 0;
    for (const Node *item = given->first; done && item; item = item->next, index++) {
        char name[256];
        snprintf(name, sizeof name, "%s[%d]", v->name, index);
        done = load_float(&(Value){v->loader, v->row, item, name}, &member[index]);
    }
    return done;
}

static bool load_color(const Value *v, float *member)
{
    const Node *given = v->given;
    double number;
    if (given->kind == NODE_LIST || (is_plain(given) && scalar_number(given->text, &number))) {
        return load_vector(v, member, 3);
    }
    return (given->kind == NODE_SCALAR && scalar_color(given->text, member)) ||
           wrong_type(v, "[red, green, blue], one number for a grey, or \"#rrggbb\" in quotes");
}

// "[1, 2]"
static bool keep_list(const Value *v, char **member)
{
    Text text = {.e = v->loader->e};
    for (const Node *item = v->given->first; item; item = item->next) {
        text_put(&text, "%s%s", item == v->given->first ? "[" : ", ", item->text);
    }
    text_put(&text, "]");
    char *heap = text_take(&text);
    bool done = heap && keep_text(v, heap, member);
    free(heap);
    return done;
}

// A number, a word or a list of numbers, as YAML.
static bool load_any(const Value *v, char **member)
{
    const char *right = "a number, a list of numbers, a colour or a word";
    const Node *given = v->given;
    bool scalar = given->kind == NODE_SCALAR;
    if (scalar ? node_is_null(given) || !*given->text
               : given->kind != NODE_LIST || given->count == 0) {
        return wrong_type(v, right);
    }
    if (given->count > v->row->count) {
        return load_fail(v->loader, given, "%s has %d numbers; it must have at most %d", v->name,
                         given->count, v->row->count);
    }
    for (const Node *item = given->first; item; item = item->next) {
        double value;
        if (!is_plain(item) || !scalar_number(item->text, &value)) {
            return wrong_type(&(Value){v->loader, v->row, item, v->name}, right);
        }
    }
    return scalar ? keep_text(v, given->text, member) : keep_list(v, member);
}

bool load_value(const Mapping *mapping, const Key *row, const Node *given, void *member)
{
    Value v = {mapping->loader, row, given, mapping_path(mapping, row->key)};
    switch (row->type) {
    case KEY_BOOL:
        return load_truth(&v, member);
    case KEY_ENUM:
        return load_enum(&v, member);
    case KEY_TEXT:
        return check_text(&v) && keep_text(&v, given->text, member);
    case KEY_NAME:
        return check_text(&v) && load_name(&v, member);
    case KEY_FILE:
        return check_text(&v) && load_file(&v, member);
    case KEY_VECTOR:
        return load_vector(&v, member, row->count);
    case KEY_COLOR:
        return load_color(&v, member);
    case KEY_ANY:
        return load_any(&v, member);
    case KEY_FLOAT:
        return load_float(&v, member);
    case KEY_DOUBLE:
        return load_real(&v, member);
    default:
        return load_whole(&v, member);
    }
}
