#include "scene/sections.h"

#include <string.h>

static const char *next_line(const char *line, const char *end)
{
    const char *newline = memchr(line, '\n', (size_t)(end - line));
    return newline ? newline + 1 : end;
}

TextPart section_find(const char *resolved, const char *key)
{
    const char *end = resolved + strlen(resolved), *line = resolved;
    size_t length = strlen(key);
    while (line < end && !(strncmp(line, key, length) == 0 && line[length] == ':')) {
        line = next_line(line, end);
    }
    if (line == end) {
        return (TextPart){0};
    }
    const char *after = next_line(line, end);
    while (after < end && *after == ' ') {
        after = next_line(after, end);
    }
    return (TextPart){line, after - line};
}

static bool begins_entry(const char *line)
{
    return strncmp(line, "  - ", 4) == 0;
}

TextPart section_entry(TextPart section, int index)
{
    if (section.length == 0) {
        return section;
    }
    const char *end = section.text + section.length, *line = next_line(section.text, end);
    for (int i = 0; line < end; i++) {
        const char *after = next_line(line, end);
        while (after < end && !begins_entry(after)) {
            after = next_line(after, end);
        }
        if (i == index) {
            return (TextPart){line, after - line};
        }
        line = after;
    }
    return (TextPart){0};
}

bool section_same(TextPart a, TextPart b)
{
    return a.length == b.length && (a.length == 0 || memcmp(a.text, b.text, (size_t)a.length) == 0);
}

// The line of the key, two spaces in.
static TextPart find_line(TextPart section, const char *key)
{
    const char *end = section.text + section.length;
    size_t length = strlen(key);
    for (const char *line = section.text; line < end; line = next_line(line, end)) {
        if (strncmp(line, "  ", 2) == 0 && strncmp(line + 2, key, length) == 0 &&
            line[2 + length] == ':') {
            return (TextPart){line, next_line(line, end) - line};
        }
    }
    return (TextPart){end, 0};
}

bool section_same_but(TextPart a, TextPart b, const char *key)
{
    if (a.length == 0 || b.length == 0) {
        return a.length == b.length;
    }
    TextPart x = find_line(a, key), y = find_line(b, key);
    TextPart before[2] = {{a.text, x.text - a.text}, {b.text, y.text - b.text}};
    const char *p = x.text + x.length, *q = y.text + y.length;
    TextPart after[2] = {{p, a.text + a.length - p}, {q, b.text + b.length - q}};
    return section_same(before[0], before[1]) && section_same(after[0], after[1]);
}
