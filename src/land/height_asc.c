// Reads Esri ASCII grids.
#include "land/height_measure.h"

#include "base/c_locale.h"
#include "base/exact_math.h"
#include "base/memory.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

typedef struct AscHeader {
    double columns, rows, x, y, dx, dy, missing;
    bool has_missing;
} AscHeader;

typedef struct AscText {
    const char *file;
    char *at;
    int line;
} AscText;

static bool fail_at(const AscText *asc, Error *e, const char *what, const char *word)
{
    error_set(e, ERROR_INPUT,
              "%s '%s'; an Esri ASCII grid has ncols, nrows, xllcorner, yllcorner, "
              "cellsize, perhaps NODATA_value, then rows of heights",
              what, word);
    error_locate(e, asc->file, asc->line, 0);
    return false;
}

// The next word, zero-terminated; NULL at the end.
static char *next_word(AscText *asc)
{
    while (isspace((unsigned char)*asc->at)) {
        asc->line += *asc->at++ == '\n';
    }
    if (!*asc->at) {
        return NULL;
    }
    char *word = asc->at;
    while (*asc->at && !isspace((unsigned char)*asc->at)) {
        asc->at++;
    }
    if (*asc->at) {
        asc->line += *asc->at == '\n';
        *asc->at++ = '\0';
    }
    return word;
}

static bool read_number(AscText *asc, const char *word, double *value, Error *e)
{
    char *end;
    if (!word) {
        return fail_at(asc, e, "the file ends early, after", "the last number");
    }
    *value = strtod(word, &end);
    return (*end == '\0' && end != word && fabs(*value) <= (double)FLT_MAX) ||
           fail_at(asc, e, "no number:", word);
}

static double *header_field(AscHeader *header, const char *key, double *half)
{
    const struct {
        const char *key;
        double *value;
    } fields[] = {{"ncols", &header->columns}, {"nrows", &header->rows},
                  {"xllcorner", &header->x},   {"yllcorner", &header->y},
                  {"xllcenter", &header->x},   {"yllcenter", &header->y},
                  {"cellsize", &header->dx},   {"dx", &header->dx},
                  {"dy", &header->dy},         {"nodata_value", &header->missing}};
    *half = strcasecmp(key, "yllcenter") == 0 ? 0.0 : 0.5;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        if (strcasecmp(key, fields[i].key) == 0) {
            header->has_missing |= fields[i].value == &header->missing;
            return fields[i].value;
        }
    }
    return NULL;
}

// Reads pairs of key and number; *first is set to the first word of the heights.
static bool read_header(AscText *asc, AscHeader *header, char **first, Error *e)
{
    double corner = 0.5, half;
    header->dx = header->dy = 0.0;
    for (;;) {
        char *word = next_word(asc);
        if (!word || !isalpha((unsigned char)*word)) {
            *first = word;
            break;
        }
        double *value = header_field(header, word, &half);
        if (!value) {
            return fail_at(asc, e, "unknown key", word);
        }
        if (value == &header->y) {
            corner = half;
        }
        if (!read_number(asc, next_word(asc), value, e)) {
            return false;
        }
    }
    header->dy = header->dy > 0.0 ? header->dy : header->dx;
    double most = HEIGHT_FIELD_MAX;
    if (!(header->columns >= 2 && header->rows >= 2 && header->columns <= most &&
          header->rows <= most && header->dx > 0.0)) {
        error_set(e, ERROR_INPUT,
                  "ncols %g, nrows %g, cellsize %g; it must be 2 to %d columns and "
                  "rows and a cellsize above 0",
                  header->columns, header->rows, header->dx, HEIGHT_FIELD_MAX);
        error_locate(e, asc->file, asc->line, 0);
        return false;
    }
    header->y += corner * header->dy; // centre of the lowest row
    return true;
}

// A height takes at least a digit and a blank, so no memory is allocated for heights that cannot
// exist.
static bool heights_fit(const AscText *asc, const AscHeader *header, Error *e)
{
    double least = 2.0 * header->columns * header->rows - 3.0; // the first word is already consumed
    if ((double)strlen(asc->at) >= least) {
        return true;
    }
    error_set(e, ERROR_INPUT, "the file ends early: %g x %g heights are promised; all are needed",
              header->columns, header->rows);
    error_locate(e, asc->file, asc->line, 0);
    return false;
}

// Cell size in metres; degrees are converted on the WGS 84 spheroid at the middle row.
static Vec2 cell_metres(const AscHeader *header)
{
    bool degrees =
        header->dx < 0.1 && header->dy < 0.1 && fabs(header->x) <= 360.0 && fabs(header->y) <= 90.0;
    if (!degrees) {
        return (Vec2){(float)header->dx, (float)header->dy};
    }
    double to_radians = 0.017453292519943295;
    double latitude = (header->y + 0.5 * (header->rows - 1.0) * header->dy) * to_radians;
    float sine, cosine;
    exact_sincos((float)latitude, &sine, &cosine);
    double a = 6378137.0, e2 = 0.0066943799901413;
    double w = sqrt(1.0 - e2 * (double)sine * (double)sine);
    double meridian = a * (1.0 - e2) / (w * w * w);
    return (Vec2){(float)(header->dx * to_radians * a / w * (double)cosine),
                  (float)(header->dy * to_radians * meridian)};
}

static HeightField *read_heights(AscText *asc, Error *e)
{
    AscHeader header = {0};
    char *word;
    if (!read_header(asc, &header, &word, e) || !heights_fit(asc, &header, e)) {
        return NULL;
    }
    HeightField *field = height_field_new((int)header.columns, (int)header.rows,
                                          cell_metres(&header), (Vec2){0.0f, 0.0f}, e);
    bool done = field;
    for (int64_t i = 0; done && i < height_field_count(field); i++) {
        double value = 0.0;
        done = read_number(asc, word, &value, e);
        bool missing = header.has_missing && value == header.missing;
        field->height[i] = missing ? NAN : (float)value;
        word = next_word(asc);
    }
    if (done && word) {
        done = fail_at(asc, e, "more heights than ncols x nrows:", word);
    }
    if (!done) {
        height_field_free(field);
        return NULL;
    }
    return field;
}

static char *read_text(const char *file, Error *e)
{
    struct stat status;
    bool there = stat(file, &status) == 0;
    FILE *stream = there && S_ISREG(status.st_mode) ? fopen(file, "rb") : NULL;
    if (!stream) {
        error_set(e, ERROR_INPUT, "'%s' cannot be read: %s", file,
                  there && !S_ISREG(status.st_mode) ? "it is not a file" : strerror(errno));
        return NULL;
    }
    char *text = NULL;
    int64_t size = 0, capacity = 0;
    bool done = true;
    for (size_t got = 1; done && got > 0;) {
        done = memory_reserve(&text, &capacity, size + 65536, 1, e);
        got = done ? fread(text + size, 1, 65535, stream) : 0;
        size += (int64_t)got;
    }
    if (done && ferror(stream)) {
        done = error_set(e, ERROR_IO, "'%s' cannot be read: %s", file, strerror(errno));
    }
    fclose(stream);
    if (!done) {
        free(text);
        return NULL;
    }
    text[size] = '\0';
    return text;
}

HeightField *height_field_parse_asc(char *text, const char *file, Error *e)
{
    AscText asc = {.file = file, .at = text, .line = 1};
    CLocale locale;
    if (!c_locale_enter(&locale, e)) {
        return NULL;
    }
    HeightField *field = read_heights(&asc, e);
    c_locale_leave(&locale);
    return field;
}

HeightField *height_field_read_asc(const char *file, Error *e)
{
    char *text = read_text(file, e);
    HeightField *field = text ? height_field_parse_asc(text, file, e) : NULL;
    if (!field) {
        error_locate(e, file, 0, 0);
    }
    free(text);
    return field;
}
