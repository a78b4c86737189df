#include "scene/schema_text.h"

#include "base/c_locale.h"
#include "config/write.h"

#include <string.h>

const char *schema_base(SchemaText *s, const Table *table, int kind, const char *base)
{
    char *fresh = arena_alloc(s->arena, table->size, s->text.e);
    s->text.failed |= !fresh;
    return fresh && table_defaults(table, NULL, kind, fresh) ? fresh : base;
}

const char *schema_default(SchemaText *s, const Key *row, const char *base)
{
    char text[WRITE_VALUE_SIZE];
    if (!base || row->flags & (KEY_REQUIRED | KEY_NO_DEFAULT)) {
        return NULL;
    }
    write_value(row, base + row->offset, text);
    if (!*text) {
        return NULL;
    }
    const char *kept = arena_text(s->arena, text, strlen(text), s->text.e);
    s->text.failed |= !kept;
    return kept;
}

char *schema_write(void (*write)(SchemaText *), Error *e)
{
    Arena *arena = arena_new(e);
    CLocale locale;
    if (!arena || !c_locale_enter(&locale, e)) {
        arena_free(arena);
        return NULL;
    }
    SchemaText s = {.text = {.e = e}, .arena = arena};
    write(&s);
    c_locale_leave(&locale);
    arena_free(arena);
    if (s.text.failed && (!e || e->code != ERROR_MEMORY)) {
        error_set(e, ERROR_INTERNAL, "the schema could not be written");
    }
    return text_take(&s.text);
}
