// Converts option arguments to members of Options.
#include "cli/fail.h"
#include "cli/option_table.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool read_number(const char **text, double low, double high, double *value)
{
    char *end;
    errno = 0;
    *value = strtod(*text, &end);
    bool valid = end != *text && *value >= low && *value <= high;
    *text = end;
    return valid;
}

// Sets `key=value`, replacing an earlier setting of the key.
static void put_key(Options *options, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void put_key(Options *options, const char *key, const char *format, ...)
{
    int at = 0, length = (int)strlen(key);
    while (at < options->key_count && (strncmp(options->keys[at], key, (size_t)length) != 0 ||
                                       options->keys[at][length] != '=')) {
        at++;
    }
    options->key_count += at == options->key_count;
    va_list arguments;
    va_start(arguments, format);
    snprintf(options->keys[at], MAX_KEY_TEXT, "%s=", key);
    vsnprintf(options->keys[at] + length + 1, (size_t)(MAX_KEY_TEXT - length - 1), format,
              arguments);
    va_end(arguments);
}

static bool take_size(const char *text, const Option *option, Options *options)
{
    double width, height;
    if (!read_number(&text, option->low, option->high, &width) || (*text != 'x' && *text != 'X')) {
        return false;
    }
    text++;
    if (!read_number(&text, option->low, option->high, &height) || *text || floor(width) != width ||
        floor(height) != height || width * height > 1e8) {
        return false;
    }
    put_key(options, "film.width", "%.0f", width);
    put_key(options, "film.height", "%.0f", height);
    return true;
}

static bool take_crop(const char *text, const Option *option, Options *options)
{
    double crop[4];
    for (int i = 0; i < 4; i++) {
        if (!read_number(&text, option->low, option->high, &crop[i]) ||
            *text != (i < 3 ? ',' : 0)) {
            return false;
        }
        text += i < 3;
    }
    put_key(options, option->scene_key, "[%.9g, %.9g, %.9g, %.9g]", crop[0], crop[1], crop[2],
            crop[3]);
    return (float)crop[0] < (float)crop[2] && (float)crop[1] < (float)crop[3];
}

static bool read_keys(const char *text, const Option *option, RamifyKeys *keys)
{
    keys->count = 0;
    do {
        if (keys->count == RAMIFY_MOST_KEYS ||
            !read_number(&text, option->low, option->high, &keys->value[keys->count])) {
            return false;
        }
        keys->count++;
    } while (*text++ == ':');
    return text[-1] == 0;
}

static bool bad_value(const Option *option, const char *text, RamifyError *e)
{
    switch (option->type) {
    case OPTION_SIZE:
        return fail(e, RAMIFY_BAD_INPUT,
                    "--size %.60s; it must be WIDTHxHEIGHT, each 1 to 65536, at most 100 "
                    "million pixels",
                    text);
    case OPTION_CROP:
        return fail(e, RAMIFY_BAD_INPUT,
                    "--crop %.60s; it must be x0,y0,x1,y1 in 0..1 with x0 < x1 and y0 < y1", text);
    case OPTION_KEYS:
        return fail(e, RAMIFY_BAD_INPUT,
                    "--%s %.60s; it must be 1 to %d numbers of %.9g to %.9g with colons between",
                    option->name, text, (int)RAMIFY_MOST_KEYS, option->low, option->high);
    default:
        return fail(e, RAMIFY_BAD_INPUT, "--%s %.60s; it must be a %s of %.9g to %.9g",
                    option->name, text, option->type == OPTION_INT ? "whole number" : "number",
                    option->low, option->high);
    }
}

static bool add_override(Options *options, const char *text, RamifyError *e)
{
    if (options->override_count == MAX_OVERRIDES) {
        return fail(e, RAMIFY_BAD_INPUT, "more than %d --set; put some into the scene file",
                    MAX_OVERRIDES);
    }
    options->overrides[options->override_count++] = text;
    return true;
}

static bool add_object(Options *options, const char *text, RamifyError *e)
{
    if (options->object_count == MAX_OBJECTS) {
        return fail(e, RAMIFY_BAD_INPUT, "more than %d --object; leave it out to write all of them",
                    MAX_OBJECTS);
    }
    options->objects[options->object_count++] = text;
    return true;
}

bool option_take(Options *options, const Option *option, const char *text, RamifyError *e)
{
    char *at = (char *)options + option->offset;
    const char *rest = text;
    double value;
    switch (option->type) {
    case OPTION_TEXT:
        if (!*text) {
            return fail(e, RAMIFY_BAD_INPUT, "--%s is empty; it must be a %s", option->name,
                        option->value);
        }
        memcpy(at, &text, sizeof text);
        return true;
    case OPTION_SET:
        return add_override(options, text, e);
    case OPTION_OBJECT:
        return add_object(options, text, e);
    case OPTION_SIZE:
        return take_size(text, option, options) || bad_value(option, text, e);
    case OPTION_CROP:
        return take_crop(text, option, options) || bad_value(option, text, e);
    case OPTION_KEYS:
        return read_keys(text, option, (RamifyKeys *)(void *)at) || bad_value(option, text, e);
    default:
        break;
    }
    if (!read_number(&rest, option->low, option->high, &value) || *rest) {
        return bad_value(option, text, e);
    }
    int whole = (int)value;
    if (option->type == OPTION_INT && (double)whole != value) {
        return bad_value(option, text, e);
    }
    if (option->scene_key) {
        put_key(options, option->scene_key, "%.17g", value);
    } else if (option->type == OPTION_REAL) {
        memcpy(at, &value, sizeof value);
    } else {
        memcpy(at, &whole, sizeof whole);
    }
    return true;
}

void option_take_flag(Options *options, const Option *option)
{
    bool value = option->type == OPTION_YES;
    if (option->scene_key) {
        put_key(options, option->scene_key, "%s", value ? "true" : "false");
    } else {
        memcpy((char *)options + option->offset, &value, sizeof value);
    }
}
