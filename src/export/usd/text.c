#include "export/usd/text.h"

#include "base/number_text.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 1024, BATCH = 4096 };

// Other characters become _, and a leading digit gets one before it.
static void make_identifier(const char *text, char name[USDA_NAME])
{
    int length = 0;
    if (isdigit((unsigned char)text[0]) || !text[0]) {
        name[length++] = '_';
    }
    for (; *text && length < USDA_NAME - 1; text++) {
        unsigned char c = (unsigned char)*text;
        name[length++] = (char)(c < 128 && isalnum(c) ? c : '_');
    }
    name[length] = 0;
}

static bool is_taken(char (*name)[USDA_NAME], int count, const char *const *reserved)
{
    for (; reserved && *reserved; reserved++) {
        if (strcmp(*reserved, name[count]) == 0) {
            return true;
        }
    }
    for (int i = 0; i < count; i++) {
        if (strcmp(name[i], name[count]) == 0) {
            return true;
        }
    }
    return false;
}

void usda_unique_identifier(const char *text, char (*name)[USDA_NAME], int index,
                            const char *const *reserved)
{
    char own[USDA_NAME];
    make_identifier(text, own);
    memcpy(name[index], own, sizeof own);
    for (int k = 2; is_taken(name, index, reserved); k++) {
        snprintf(name[index], sizeof name[index], "%.80s_%d", own, k);
    }
}

static void indent(UsdaText *text)
{
    for (int i = 0; i < text->depth; i++) {
        file_writer_text(text->out, "    ");
    }
}

static void put_line(UsdaText *text, const char *format, va_list arguments)
{
    char line[LINE];
    vsnprintf(line, sizeof line, format, arguments);
    indent(text);
    file_writer_text(text->out, line);
    file_writer_text(text->out, "\n");
}

void usda_line(UsdaText *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    put_line(text, format, arguments);
    va_end(arguments);
}

void usda_begin(UsdaText *text, const char *metadata, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    put_line(text, format, arguments);
    va_end(arguments);
    if (metadata) {
        usda_line(text, "(");
        usda_line(text, "    %s", metadata);
        usda_line(text, ")");
    }
    usda_line(text, "{");
    text->depth++;
}

void usda_end(UsdaText *text)
{
    text->depth--;
    usda_line(text, "}");
}

void usda_quoted(UsdaText *text, const char *before, const char *value)
{
    indent(text);
    file_writer_text(text->out, before);
    file_writer_text(text->out, "\"");
    for (; *value; value++) {
        unsigned char c = (unsigned char)*value;
        if (c == '"' || c == '\\') {
            file_writer_print(text->out, "\\%c", c);
        } else if (c < 32) {
            file_writer_print(text->out, "\\x%02x", c);
        } else {
            file_writer_bytes(text->out, value, 1);
        }
    }
    file_writer_text(text->out, "\"\n");
}

void usda_asset(UsdaText *text, const char *declaration, const char *path)
{
    const char *mark = strchr(path, '@') ? "@@@" : "@";
    indent(text);
    const char *const pieces[] = {declaration, " = ", mark, path, mark, "\n"};
    for (size_t i = 0; i < sizeof pieces / sizeof pieces[0]; i++) {
        file_writer_text(text->out, pieces[i]);
    }
}

void usda_float(UsdaText *text, const char *declaration, float value)
{
    char number[FLOAT_TEXT_MOST + 1];
    *float_text(number, value) = 0;
    usda_line(text, "%s = %s", declaration, number);
}

void usda_vec3(UsdaText *text, const char *declaration, Vec3 value)
{
    usda_line(text, "%s = (%.9g, %.9g, %.9g)", declaration, (double)value.x, (double)value.y,
              (double)value.z);
}

void usda_array_begin(UsdaText *text, const char *declaration)
{
    indent(text);
    file_writer_text(text->out, declaration);
    file_writer_text(text->out, " = [");
}

void usda_array_add(UsdaText *text, bool first, const float *value, int size, int64_t count)
{
    char batch[BATCH], *at = batch;
    for (int64_t i = 0; i < count; i++) {
        if (at - batch > BATCH - 4 * (FLOAT_TEXT_MOST + 2) - 8) {
            file_writer_bytes(text->out, batch, (size_t)(at - batch));
            at = batch;
        }
        if (i > 0 || !first) {
            *at++ = ',';
            *at++ = ' ';
        }
        if (size > 1) {
            *at++ = '(';
        }
        at = floats_text(at, value + i * size, size, ',');
        if (size > 1) {
            *at++ = ')';
        }
    }
    file_writer_bytes(text->out, batch, (size_t)(at - batch));
}

void usda_array_end(UsdaText *text, const char *interpolation)
{
    if (interpolation) {
        file_writer_text(text->out, "] (\n");
        usda_line(text, "    interpolation = \"%s\"", interpolation);
        usda_line(text, ")");
    } else {
        file_writer_text(text->out, "]\n");
    }
}

static void put_floats(UsdaText *text, const char *declaration, const float *value, int size,
                       int64_t count, const char *interpolation)
{
    usda_array_begin(text, declaration);
    usda_array_add(text, true, value, size, count);
    usda_array_end(text, interpolation);
}

void usda_floats(UsdaText *text, const char *declaration, const float *value, int64_t count,
                 const char *interpolation)
{
    put_floats(text, declaration, value, 1, count, interpolation);
}

void usda_vec2s(UsdaText *text, const char *declaration, const Vec2 *value, int64_t count,
                const char *interpolation)
{
    put_floats(text, declaration, &value->x, 2, count, interpolation);
}

void usda_vec3s(UsdaText *text, const char *declaration, const Vec3 *value, int64_t count,
                const char *interpolation)
{
    put_floats(text, declaration, &value->x, 3, count, interpolation);
}

void usda_indices(UsdaText *text, const char *declaration, const uint32_t *value, int64_t count)
{
    usda_array_begin(text, declaration);
    char batch[BATCH], *at = batch;
    for (int64_t i = 0; i < count; i++) {
        if (at - batch > BATCH - INTEGER_TEXT_MOST - 2) {
            file_writer_bytes(text->out, batch, (size_t)(at - batch));
            at = batch;
        }
        if (i > 0) {
            *at++ = ',';
            *at++ = ' ';
        }
        at = integer_text(at, value[i]);
    }
    file_writer_bytes(text->out, batch, (size_t)(at - batch));
    usda_array_end(text, NULL);
}

void usda_repeated(UsdaText *text, const char *declaration, int value, int64_t count)
{
    char number[INTEGER_TEXT_MOST + 1];
    *integer_text(number, value) = 0;
    usda_array_begin(text, declaration);
    for (int64_t i = 0; i < count; i++) {
        file_writer_text(text->out, i > 0 ? ", " : "");
        file_writer_text(text->out, number);
    }
    usda_array_end(text, NULL);
}

void usda_extent(UsdaText *text, Aabb box)
{
    const Vec3 corners[2] = {box.low, box.high};
    usda_vec3s(text, "float3[] extent", corners, 2, NULL);
}

void usda_transform(UsdaText *text, const Transform *t)
{
    // row vectors: the rows are the images of the axes and of the origin
    char rows[4][96];
    for (int i = 0; i < 4; i++) {
        snprintf(rows[i], sizeof rows[i], "(%.9g, %.9g, %.9g, %d)", (double)t->m[0][i],
                 (double)t->m[1][i], (double)t->m[2][i], i == 3);
    }
    usda_line(text, "matrix4d xformOp:transform = ( %s, %s, %s, %s )", rows[0], rows[1], rows[2],
              rows[3]);
    usda_line(text, "uniform token[] xformOpOrder = [\"xformOp:transform\"]");
}
