#include "scene/schema_text.h"

#include "base/memory.h"

#include <locale.h>
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
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", NULL);
    if (!arena || !c_locale) {
        error_set(e, ERROR_MEMORY, "out of memory for the schema");
        arena_free(arena);
        if (c_locale) {
            freelocale(c_locale);
        }
        return NULL;
    }
    locale_t before = uselocale(c_locale);
    SchemaText s = {.resolver = {.arena = arena, .file = "", .folder = "", .e = e}};
    write(&s);
    uselocale(before);
    freelocale(c_locale);
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
