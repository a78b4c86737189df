// Writes USD's text format (usda), value by value. Private to export/usd.
#ifndef RAMIFY_EXPORT_USD_TEXT_H
#define RAMIFY_EXPORT_USD_TEXT_H

#include "base/file_writer.h"
#include "base/vec.h"

#include <stdbool.h>

typedef struct UsdaText {
    FileWriter *out;
    int depth; // of nested prims
} UsdaText;

enum { USDA_NAME = 96 };

// Fills name[index] with `text` as a USD identifier, numbered if it equals one of name[0 .. index -
// 1] or of reserved (NULL, or ending in NULL).
void usda_unique_identifier(const char *text, char (*name)[USDA_NAME], int index,
                            const char *const *reserved);

// A line of its own, indented.
void usda_line(UsdaText *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

// A prim: the line that defines it, its metadata in parentheses (NULL = none); its contents follow
// up to usda_end.
void usda_begin(UsdaText *text, const char *metadata, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void usda_end(UsdaText *text);

// A quoted string, escaped.
void usda_quoted(UsdaText *text, const char *before, const char *value);

// The path of another file: "asset inputs:file".
void usda_asset(UsdaText *text, const char *declaration, const char *path);

// `declaration` is the type and name: "float inputs:radius".
void usda_float(UsdaText *text, const char *declaration, float value);
void usda_vec3(UsdaText *text, const char *declaration, Vec3 value);

// Arrays; interpolation: "vertex", "constant", ..., or NULL for none.
void usda_floats(UsdaText *text, const char *declaration, const float *value, int64_t count,
                 const char *interpolation);
void usda_vec2s(UsdaText *text, const char *declaration, const Vec2 *value, int64_t count,
                const char *interpolation);
void usda_vec3s(UsdaText *text, const char *declaration, const Vec3 *value, int64_t count,
                const char *interpolation);
void usda_indices(UsdaText *text, const char *declaration, const uint32_t *value, int64_t count);
void usda_repeated(UsdaText *text, const char *declaration, int value, int64_t count);
void usda_extent(UsdaText *text, Aabb box);

// An array piece by piece: its beginning, `count` elements of `size` floats (in parentheses if
// several), its end.
void usda_array_begin(UsdaText *text, const char *declaration);
void usda_array_add(UsdaText *text, bool first, const float *value, int size, int64_t count);
void usda_array_end(UsdaText *text, const char *interpolation);

// The only transform of a prim.
void usda_transform(UsdaText *text, const Transform *t);

#endif
