// YAML 1.1 text to nodes, through libyaml's event parser, which tells lines and columns. Aliases
// are replaced by copies of what they name and merge keys (<<) are carried out.
#ifndef RAMIFY_CONFIG_YAML_H
#define RAMIFY_CONFIG_YAML_H

#include "config/node.h"

// Parses one document. source: as in Node. name: the file's name for errors; ERROR_INPUT with line
// and column for text that is no YAML, is empty, repeats a key, nests deeper than 64, or unfolds to
// more than a million values.
Node *yaml_parse(Arena *arena, const char *text, size_t length, const char *name,
                 const char *source, Error *e);

#endif
