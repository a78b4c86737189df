// Writes the table cells of one key in the reference of scene files, as Markdown.
#ifndef RAMIFY_SCENE_SCHEMA_CELLS_H
#define RAMIFY_SCENE_SCHEMA_CELLS_H

#include "scene/schema_outline.h"

// Length of the label at `at`, a position in row->doc: an enum name followed by a colon. 0 = no
// label.
size_t schema_label_length(const Key *row, const char *at);

// Puts count bytes of documentation, with Markdown's special characters escaped and enum labels of
// row (NULL = none) as code.
void schema_put_doc(SchemaText *s, const Key *row, const char *doc, size_t count);

// Puts a link to the section of this title.
void schema_put_link(SchemaText *s, const char *text, const char *title);

// Puts the type and range of the value, "number, 0 to 90 degrees", or a link to the mapping.
void schema_put_value(SchemaText *s, const Outline *o, const Key *row);

// Puts the default for each place and kind that has the key; equal defaults are merged.
void schema_put_default(SchemaText *s, const OutlineSection *section, const Key *row);

#endif
