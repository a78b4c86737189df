// Converts option arguments to members of Options.
#include "cli/fail.h"
#include "cli/option_table.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Parses numbers within the option's range, separated by `separator`, into value. Returns their
// count; 0 if one is invalid or there are more than `most`.
static int read_numbers(const char *text, const Option *option, char separator, double *value,
                        int most)
{
    int count = 0;
    bool valid = true, more = true;
    while (valid && more && count < most) {
        char *end;
        value[count] = strtod(text, &end);
        valid = end != text && value[count] >= option->low && value[count] <= option->high;
        more = *end != 0;
        valid = valid && (!more || tolower((unsigned char)*end) == separator);
        text = end + more;
        count++;
    }
    return valid && !more ? count : 0;
}

// Sets `key=value`, replacing an earlier setting of the key.
static void set_key(Options *options, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void set_key(Options *options, const char *key, const char *format, ...)
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

static bool append(const char **list, int *count, int most, const char *text)
{
    bool fits = *count < most;
    if (fits) {
        list[(*count)++] = text;
    }
    return fits;
}

static bool bad_value(const Option *option, const char *text, RamifyError *e)
{
    char message[256];
    switch (option->type) {
    case OPTION_TEXT:
        snprintf(message, sizeof message, " is empty; it must be a %s", option->value);
        break;
    case OPTION_SIZE:
        snprintf(message, sizeof message,
                 " %.60s; it must be WIDTHxHEIGHT, each 1 to 65536, at most 100 "
                 "million pixels",
                 text);
        break;
    case OPTION_CROP:
        snprintf(message, sizeof message,
                 " %.60s; it must be x0,y0,x1,y1 in 0..1 with x0 < x1 and y0 < y1", text);
        break;
    case OPTION_SAMPLES:
        snprintf(message, sizeof message,
                 " %.60s; it must be A:B, samples A to B - 1, with 0 <= A < B <= %.9g", text,
                 option->high);
        break;
    case OPTION_KEYS:
        snprintf(message, sizeof message,
                 " %.60s; it must be 1 to %d numbers of %.9g to %.9g with colons "
                 "between",
                 text, (int)RAMIFY_MOST_KEYS, option->low, option->high);
        break;
    case OPTION_BYTES:
        snprintf(message, sizeof message,
                 " %.60s; it must be a number of bytes, as in 512M or 8G, from 1 to 1000T", text);
        break;
    case OPTION_SET:
        snprintf(message, sizeof message,
                 " is given more than %d times; set some keys in the scene file", MAX_OVERRIDES);
        break;
    case OPTION_VARY:
        snprintf(message, sizeof message, " is given more than %d times; vary fewer numbers",
                 MAX_VARIED);
        break;
    case OPTION_OBJECT:
        snprintf(message, sizeof message,
                 " is given more than %d times; without it, all objects are written", MAX_OBJECTS);
        break;
    case OPTION_DIRECTIVE:
        snprintf(message, sizeof message, " is given more than %d times; give fewer",
                 MAX_DIRECTIVES);
        break;
    default:
        snprintf(message, sizeof message, " %.60s; it must be a %s of %.9g to %.9g", text,
                 option->type == OPTION_INT ? "whole number" : "number", option->low, option->high);
    }
    return fail(e, RAMIFY_BAD_INPUT, "--%s%s", option->name, message);
}

// Reads a number of bytes; 0 if it is none.
static double read_bytes(const char *text, const Option *option)
{
    static const char units[] = "KMGT";
    char *end;
    double value = strtod(text, &end);
    const char *unit = end != text && *end ? strchr(units, toupper((unsigned char)*end)) : NULL;
    if (unit) {
        value *= pow(1000.0, (double)(unit - units + 1));
        end++;
    }
    bool valid = end != text && !*end && value >= option->low && value <= option->high;
    return valid ? value : 0.0;
}

// Takes the value of an option that has one or more numbers; returns whether it is valid.
static bool take_numbers(Options *options, const Option *option, const char *text)
{
    void *at = (char *)options + option->offset;
    RamifyKeys keys = {0};
    double *v = keys.value;
    bool valid;
    if (option->type == OPTION_SIZE) {
        valid = read_numbers(text, option, 'x', v, 2) == 2 && floor(v[0]) == v[0] &&
                floor(v[1]) == v[1] && v[0] * v[1] <= 1e8;
        set_key(options, "film.width", "%.0f", v[0]);
        set_key(options, "film.height", "%.0f", v[1]);
    } else if (option->type == OPTION_CROP) {
        valid = read_numbers(text, option, ',', v, 4) == 4 && (float)v[0] < (float)v[2] &&
                (float)v[1] < (float)v[3];
        set_key(options, option->scene_key, "[%.9g, %.9g, %.9g, %.9g]", v[0], v[1], v[2], v[3]);
    } else if (option->type == OPTION_SAMPLES) {
        valid = read_numbers(text, option, ':', v, 2) == 2 && v[0] < v[1] && v[0] == floor(v[0]) &&
                v[1] == floor(v[1]);
        set_key(options, "render.first_sample", "%.0f", v[0]);
        set_key(options, "render.end_sample", "%.0f", v[1]);
    } else if (option->type == OPTION_KEYS) {
        keys.count = read_numbers(text, option, ':', v, RAMIFY_MOST_KEYS);
        valid = keys.count > 0;
        memcpy(at, &keys, sizeof keys);
    } else {
        int whole = 0;
        valid = read_numbers(text, option, 0, v, 1) == 1;
        if (valid && option->type == OPTION_INT) {
            whole = (int)v[0];
            valid = (double)whole == v[0];
        }
        if (option->scene_key) {
            set_key(options, option->scene_key, "%.17g", v[0]);
        } else {
            memcpy(at, option->type == OPTION_INT ? (void *)&whole : (void *)v,
                   option->type == OPTION_INT ? sizeof whole : sizeof *v);
        }
    }
    return valid;
}

bool option_take(Options *options, const Option *option, const char *text, RamifyError *e)
{
    void *at = (char *)options + option->offset;
    bool flag = option->type == OPTION_YES, valid = true;
    switch (option->type) {
    case OPTION_YES:
    case OPTION_NO:
        if (option->scene_key) {
            set_key(options, option->scene_key, "%s", flag ? "true" : "false");
        } else {
            memcpy(at, &flag, sizeof flag);
        }
        break;
    case OPTION_TEXT:
        valid = *text;
        memcpy(at, &text, sizeof text);
        break;
    case OPTION_SET:
        valid = append(options->overrides, &options->override_count, MAX_OVERRIDES, text);
        break;
    case OPTION_BYTES: {
        double bytes = read_bytes(text, option);
        valid = bytes > 0.0;
        memcpy(at, &bytes, sizeof bytes);
        break;
    }
    case OPTION_VARY:
        valid = append(options->varied, &options->vary_count, MAX_VARIED, text);
        break;
    case OPTION_OBJECT:
        valid = append(options->objects, &options->object_count, MAX_OBJECTS, text);
        break;
    case OPTION_DIRECTIVE:
        valid = append(options->directives, &options->directive_count, MAX_DIRECTIVES, text);
        break;
    default:
        valid = take_numbers(options, option, text);
    }
    return valid || bad_value(option, text, e);
}
