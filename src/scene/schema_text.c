#include "scene/schema_text.h"

#include "base/c_locale.h"
#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void schema_put(SchemaText *s, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int count = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (count < 0 ||
        !memory_reserve(&s->text, &s->capacity, s->length + count + 1, 1, s->resolver.e)) {
        s->failed = true;
    } else {
        s->length += vsnprintf(s->text + s->length, (size_t)count + 1, format, again);
    }
    va_end(again);
}

const char *schema_base(SchemaText *s, const Table *table, int kind, const char *base)
{
    if (!table->defaults) {
        return base;
    }
    size_t size = table->defaults_size ? table->defaults_size : table->size;
    char *fresh = arena_alloc(s->resolver.arena, size, s->resolver.e);
    if (fresh) {
        table->defaults(NULL, kind, fresh);
    }
    s->failed |= !fresh;
    return fresh;
}

const Node *schema_default(SchemaText *s, const Key *row, const char *base)
{
    Node *node = NULL;
    bool has = base && !(row->flags & (KEY_REQUIRED | KEY_NO_DEFAULT));
    if (has && !resolve_default(&s->resolver, row, base, &node)) {
        s->failed = true;
    }
    return node;
}

char *schema_write(void (*write)(SchemaText *), Error *e)
{
    Arena *arena = arena_new(e);
    CLocale locale;
    if (!arena || !c_locale_enter(&locale, e)) {
        arena_free(arena);
        return NULL;
    }
    SchemaText s = {.resolver = {.arena = arena, .file = "", .folder = "", .e = e}};
    write(&s);
    c_locale_leave(&locale);
    arena_free(arena);
    if (s.failed) {
        free(s.text);
        if (!e || e->code != ERROR_MEMORY) {
            error_set(e, ERROR_INTERNAL, "the schema could not be written");
        }
        return NULL;
    }
    return s.text;
}
