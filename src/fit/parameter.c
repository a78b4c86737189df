#include "fit/parameter.h"

#include "config/scalar.h"
#include "config/yaml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The scene with one parameter changed; NULL and e if the scene does not accept the value.
static Scene *scene_with(const Scene *scene, const FitParameter *parameter, const char *text,
                         Error *e)
{
    SceneChange change = {.path = parameter->path, .value = text, .source = parameter->source};
    return scene_changed(scene, &change, 1, e);
}

// Reads the value that the scene really has at a path. *known: false if the scene does not tell.
static bool read_value(const Scene *scene, const FitParameter *parameter, double *value,
                       bool *known, Error *e)
{
    Arena *arena = arena_new(e);
    const Node *root =
        arena ? yaml_parse(arena, scene->resolved, strlen(scene->resolved), scene->file, NULL, e)
              : NULL;
    bool read = root;
    const char *rest = "";
    const Node *node = root ? node_follow(root, parameter->path, &rest) : NULL;
    node = *rest ? NULL : node;
    *known = node && node->kind == NODE_SCALAR && !node_is_null(node);
    if (*known && (node->quoted || !scalar_number(node->text, value))) {
        read = error_set(e, ERROR_INPUT, "its value is '%.60s'; only numbers can be varied",
                         node->text);
        error_locate(e, parameter->source, 0, 0);
    } else if (node && node->kind != NODE_SCALAR) {
        read = error_set(e, ERROR_INPUT, "it is not a number but a %s; name a number in it",
                         node->kind == NODE_MAP ? "mapping" : "list");
        error_locate(e, parameter->source, 0, 0);
    }
    arena_free(arena);
    return read;
}

// A number within the range that is not whole; NAN if none is found.
static double broken_number(double low, double high)
{
    double middle = 0.5 * (low + high);
    double tries[] = {floor(middle) + 0.5, middle, 0.5 * (middle + high)};
    for (size_t i = 0; i < sizeof tries / sizeof tries[0]; i++) {
        if (tries[i] >= low && tries[i] <= high && tries[i] != floor(tries[i])) {
            return tries[i];
        }
    }
    return (double)NAN;
}

// Does the key round numbers? Asks the scene, which knows the key's type.
static bool find_whole(const Scene *scene, FitParameter *parameter, Error *e)
{
    double asked = broken_number(parameter->low, parameter->high), got = asked;
    if (isnan(asked)) {
        return true;
    }
    char text[FIT_NUMBER_TEXT];
    bool known = false;
    snprintf(text, sizeof text, "%.17g", asked);
    Scene *changed = scene_with(scene, parameter, text, e);
    bool read = changed && read_value(changed, parameter, &got, &known, e);
    parameter->whole = read && known && got == floor(got);
    scene_free(changed);
    return read;
}

static bool check_end(const Scene *scene, const FitParameter *parameter, double at, Error *e)
{
    char text[FIT_NUMBER_TEXT];
    fit_parameter_value(parameter, at, text);
    Scene *changed = scene_with(scene, parameter, text, e);
    scene_free(changed);
    return changed;
}

static bool check_range(const FitParameter *p, Error *e)
{
    bool valid = true;
    if (!(p->low < p->high) || !isfinite(p->low) || !isfinite(p->high)) {
        valid =
            error_set(e, ERROR_INPUT, "the range is empty; its low end must be below its high one");
    } else if (p->logarithmic && p->low <= 0.0) {
        valid = error_set(e, ERROR_INPUT, "a logarithmic range begins above 0; raise %.9g", p->low);
    }
    if (!valid) {
        error_locate(e, p->source, 0, 0);
    }
    return valid;
}

// Whole numbers only: the range must hold two.
static bool check_whole(const FitParameter *p, Error *e)
{
    if (p->whole && !(ceil(p->low) < floor(p->high))) {
        error_set(e, ERROR_INPUT,
                  "the key takes whole numbers, and the range holds fewer than two; widen it");
        error_locate(e, p->source, 0, 0);
        return false;
    }
    return true;
}

// Where in the range a value is, 0..1.
static double place_of(const FitParameter *p, double value)
{
    double at = p->logarithmic ? (value > 0.0 ? log(value / p->low) / log(p->high / p->low) : 0.0)
                               : (value - p->low) / (p->high - p->low);
    return at < 0.0 ? 0.0 : (at > 1.0 ? 1.0 : at);
}

bool fit_parameter_read(const Scene *scene, const FitRange *range, Arena *arena,
                        FitParameter *parameter, Error *e)
{
    *parameter = (FitParameter){
        .low = range->low, .high = range->high, .logarithmic = range->logarithmic, .start = 0.5};
    parameter->path = arena_text(arena, range->path, strlen(range->path), e);
    parameter->source = arena_format(arena, e, "range %s=%.9g:%.9g%s", range->path, range->low,
                                     range->high, range->logarithmic ? ":log" : "");
    double value = 0.0;
    bool known = false;
    bool valid = parameter->path && parameter->source && check_range(parameter, e) &&
                 find_whole(scene, parameter, e) && check_whole(parameter, e) &&
                 check_end(scene, parameter, 0.0, e) && check_end(scene, parameter, 1.0, e) &&
                 read_value(scene, parameter, &value, &known, e);
    // a 0 below the range is a value that the program chooses
    if (valid && known && !(value == 0.0 && range->low > 0.0)) {
        parameter->start = place_of(parameter, value);
    }
    return valid;
}

static double clamp(double value, double low, double high)
{
    return value < low ? low : (value > high ? high : value);
}

double fit_parameter_value(const FitParameter *p, double at, char text[FIT_NUMBER_TEXT])
{
    double span = p->high - p->low;
    double value = p->logarithmic ? p->low * pow(p->high / p->low, at) : p->low + at * span;
    if (p->whole) {
        double first = ceil(p->low), last = floor(p->high);
        value = p->logarithmic ? round(value) : first + floor(at * (last - first + 1.0));
        value = clamp(value, first, last);
        snprintf(text, FIT_NUMBER_TEXT, "%.0f", value);
        return value;
    }
    // the last decimal is the same at both ends of a linear range
    int digits = p->logarithmic ? 0 : (int)(4.0 - floor(log10(span)));
    double unit = p->logarithmic ? 0.0 : pow(10.0, -digits);
    if (p->logarithmic) {
        snprintf(text, FIT_NUMBER_TEXT, "%.5g", value);
        value = strtod(text, NULL);
    } else {
        value = round(value / unit) * unit;
    }
    value = clamp(value, p->low, p->high);
    snprintf(text, FIT_NUMBER_TEXT, "%.9g", value);
    return strtod(text, NULL);
}

double fit_parameter_step(const FitParameter *p)
{
    return p->whole ? 1.0 / (floor(p->high) - ceil(p->low) + 1.0) : 0.0;
}
