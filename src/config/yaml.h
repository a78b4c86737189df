// Parses YAML 1.1 text to nodes with libyaml's event parser, which gives lines and columns. Aliases
// are replaced by copies of their values, and merge keys (<<) are applied.
#ifndef RAMIFY_CONFIG_YAML_H
#define RAMIFY_CONFIG_YAML_H

#include "config/node.h"

// Parses one document. source: as in Node. name: the file's name for errors. ERROR_INPUT with line
// and column for text that is not YAML, is empty, repeats a key, nests deeper than 64 levels, or
// expands to more than a million values.
Node *yaml_parse(Arena *arena, const char *text, size_t length, const char *name,
                 const char *source, Error *e);

#endif
