// What the reference of scene files says of one key, cell by cell, in Markdown.
#ifndef RAMIFY_SCENE_SCHEMA_CELLS_H
#define RAMIFY_SCENE_SCHEMA_CELLS_H

#include "scene/schema_outline.h"

// Length of the enum's name that `at`, a place in row->doc, begins with and that a colon ends;
// 0 = there is none.
size_t schema_label_length(const Key *row, const char *at);

// count bytes of documentation, with what Markdown would take for its own escaped and the names of
// the enum of row (NULL = none) as code.
void schema_put_doc(SchemaText *s, const Key *row, const char *doc, size_t count);

// A link to the section of this title.
void schema_put_link(SchemaText *s, const char *text, const char *title);

// What may stand there: "number, 0 to 90 degrees", or a link to the mapping.
void schema_put_value(SchemaText *s, const Outline *o, const Key *row);

// The default in each place and of each kind that has the key; equal ones are told together.
void schema_put_default(SchemaText *s, const OutlineSection *section, const Key *row);

#endif
