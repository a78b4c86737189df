// Which parts of two complete scenes (Scene.resolved) say the same.
#ifndef RAMIFY_SCENE_SECTIONS_H
#define RAMIFY_SCENE_SECTIONS_H

#include <stdbool.h>
#include <stdint.h>

// A stretch of a text; length 0 = not there.
typedef struct TextPart {
    const char *text;
    int64_t length;
} TextPart;

// What stands under a key of the scene itself, the line with the key included.
TextPart section_find(const char *resolved, const char *key);

// Entry number index of the list of mappings under such a key.
TextPart section_entry(TextPart section, int index);

bool section_same(TextPart a, TextPart b);

// The same but for the line of one key of the section's own: `key: ...`.
bool section_same_but(TextPart a, TextPart b, const char *key);

#endif
