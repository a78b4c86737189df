#include "config/yaml.h"

#include <string.h>
#include <yaml.h>

#define MAX_DEPTH 64
#define MAX_KEYS 1000 // in one mapping
#define MAX_ANCHORS 1000
#define MAX_NODES 1000000

typedef struct Anchor {
    const char *name;
    const Node *node;
    struct Anchor *before;
} Anchor;

typedef struct Composer {
    yaml_parser_t parser;
    Arena *arena;
    const char *name, *source;
    Anchor *anchor; // the last one
    int anchor_count;
    int budget; // nodes still allowed
    Error *e;
} Composer;

static bool fail_at(const Composer *c, yaml_mark_t mark)
{
    if (c->source) {
        error_locate(c->e, c->source, 0, 0);
    } else {
        error_locate(c->e, c->name, (int)mark.line + 1, (int)mark.column + 1);
    }
    return false;
}

static bool syntax_error(const Composer *c)
{
    const yaml_parser_t *p = &c->parser;
    if (p->error == YAML_MEMORY_ERROR) {
        return error_set(c->e, ERROR_MEMORY, "out of memory while parsing YAML");
    }
    if (p->error == YAML_READER_ERROR) {
        error_set(c->e, ERROR_INPUT,
                  "not a text file: %s at byte %zu; a scene is YAML text in UTF-8", p->problem,
                  p->problem_offset);
        error_locate(c->e, c->source ? c->source : c->name, 0, 0);
        return false;
    }
    bool token = p->problem && strstr(p->problem, "cannot start any token");
    error_set(c->e, ERROR_INPUT, "not valid YAML: %s%s%s%s",
              p->problem ? p->problem : "unknown error", p->context ? " " : "",
              p->context ? p->context : "",
              token ? "; indent with spaces, not tabs, and quote texts with special characters"
                    : "; check indentation, brackets and quotes here and just above");
    return fail_at(c, p->problem_mark);
}

static Node *start_node(Composer *c, NodeKind kind, const yaml_event_t *event)
{
    if (--c->budget < 0) {
        error_set(c->e, ERROR_INPUT, "more than a million values; this is the limit for a scene");
        fail_at(c, event->start_mark);
        return NULL;
    }
    Node *node = node_new(c->arena, kind, c->e);
    if (node) {
        node->line = (int)event->start_mark.line + 1;
        node->column = (int)event->start_mark.column + 1;
        node->source = c->source;
    }
    return node;
}

static bool check_tag(const Composer *c, const yaml_char_t *tag, const yaml_event_t *event)
{
    if (!tag) {
        return true;
    }
    error_set(c->e, ERROR_INPUT, "tag '%s'; tags are not supported, write the plain value",
              (const char *)tag);
    return fail_at(c, event->start_mark);
}

static bool remember(Composer *c, const yaml_char_t *anchor, const Node *node)
{
    if (!anchor) {
        return true;
    }
    if (c->anchor_count == MAX_ANCHORS) {
        error_set(c->e, ERROR_INPUT, "more than %d anchors; this is the limit for a scene",
                  MAX_ANCHORS);
        return fail_at(c, (yaml_mark_t){0, (size_t)node->line - 1, (size_t)node->column - 1});
    }
    const char *name = (const char *)anchor;
    Anchor *last = arena_alloc(c->arena, sizeof *last, c->e);
    const char *copy = last ? arena_text(c->arena, name, strlen(name), c->e) : NULL;
    if (!copy) {
        return false;
    }
    *last = (Anchor){copy, node, c->anchor};
    c->anchor = last;
    c->anchor_count++;
    return true;
}

static Node *copy_of_anchor(Composer *c, const yaml_event_t *event)
{
    const char *name = (const char *)event->data.alias.anchor;
    for (const Anchor *anchor = c->anchor; anchor; anchor = anchor->before) {
        if (strcmp(anchor->name, name) == 0) {
            Node *copy = node_copy(c->arena, anchor->node, &c->budget, c->e);
            if (!copy) {
                fail_at(c, event->start_mark);
            }
            return copy;
        }
    }
    error_set(c->e, ERROR_INPUT,
              "alias '*%s' has no anchor; write '&%s' before the value to repeat, above", name,
              name);
    fail_at(c, event->start_mark);
    return NULL;
}

static Node *compose(Composer *c, yaml_event_t *event, int depth);

static bool next_event(Composer *c, yaml_event_t *event)
{
    return yaml_parser_parse(&c->parser, event) || syntax_error(c);
}

static bool compose_list(Composer *c, Node *list, int depth)
{
    for (;;) {
        yaml_event_t event;
        if (!next_event(c, &event)) {
            return false;
        }
        bool ended = event.type == YAML_SEQUENCE_END_EVENT;
        Node *item = ended ? NULL : compose(c, &event, depth);
        yaml_event_delete(&event);
        if (!item) {
            return ended;
        }
        node_append(list, item, NULL);
    }
}

// Reads the scalar event as a key of map.
static const char *compose_key(Composer *c, const Node *map, const yaml_event_t *event)
{
    if (event->type != YAML_SCALAR_EVENT) {
        error_set(c->e, ERROR_INPUT, "a key is not text; keys must be plain words");
        fail_at(c, event->start_mark);
        return NULL;
    }
    const char *text = (const char *)event->data.scalar.value;
    const Node *same = strcmp(text, "<<") == 0 ? NULL : node_get(map, text);
    if (same) {
        error_set(c->e, ERROR_INPUT, "duplicate key '%s'; it is already in line %d, remove one",
                  text, same->key_line);
        fail_at(c, event->start_mark);
        return NULL;
    }
    if (map->count >= MAX_KEYS) {
        error_set(c->e, ERROR_INPUT, "more than %d keys in one mapping", MAX_KEYS);
        fail_at(c, event->start_mark);
        return NULL;
    }
    return arena_text(c->arena, text, event->data.scalar.length, c->e);
}

// Adds the entries of from that map does not have.
static bool merge_map(Composer *c, Node *map, const Node *from)
{
    for (const Node *entry = from->first; entry; entry = entry->next) {
        if (node_get(map, entry->key)) {
            continue;
        }
        Node *copy = node_copy(c->arena, entry, &c->budget, c->e);
        if (!copy) {
            return fail_at(c, (yaml_mark_t){0, (size_t)map->line - 1, (size_t)map->column - 1});
        }
        node_append(map, copy, entry->key);
    }
    return true;
}

static bool merge_value(Composer *c, Node *map, const Node *value)
{
    if (value->kind == NODE_MAP) {
        return merge_map(c, map, value);
    }
    bool merged = value->kind == NODE_LIST;
    for (const Node *item = value->first; merged && item; item = item->next) {
        merged = item->kind == NODE_MAP;
        if (merged && !merge_map(c, map, item)) {
            return false;
        }
    }
    if (!merged) {
        error_set(c->e, ERROR_INPUT,
                  "the merge key '<<' needs a mapping or a list of mappings, usually an alias");
        return fail_at(c, (yaml_mark_t){0, (size_t)value->line - 1, (size_t)value->column - 1});
    }
    return true;
}

// Own keys win over merged ones wherever the merge key stands.
static bool carry_out_merges(Composer *c, Node *map)
{
    for (Node *merge; (merge = node_get(map, "<<"));) {
        node_remove(map, merge);
        if (!merge_value(c, map, merge)) {
            return false;
        }
    }
    return true;
}

static bool compose_map(Composer *c, Node *map, int depth)
{
    for (;;) {
        yaml_event_t event;
        if (!next_event(c, &event)) {
            return false;
        }
        if (event.type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(&event);
            return carry_out_merges(c, map);
        }
        int line = (int)event.start_mark.line + 1, column = (int)event.start_mark.column + 1;
        const char *key = compose_key(c, map, &event);
        yaml_event_delete(&event);
        if (!key || !next_event(c, &event)) {
            return false;
        }
        Node *value = compose(c, &event, depth);
        yaml_event_delete(&event);
        if (!value) {
            return false;
        }
        value->key_line = line;
        value->key_column = column;
        node_append(map, value, key);
    }
}

static Node *compose_scalar(Composer *c, const yaml_event_t *event)
{
    Node *node = start_node(c, NODE_SCALAR, event);
    if (!node || !check_tag(c, event->data.scalar.tag, event)) {
        return NULL;
    }
    const char *text = (const char *)event->data.scalar.value;
    if (strlen(text) != event->data.scalar.length) {
        error_set(c->e, ERROR_INPUT, "text contains a NUL character; remove it");
        fail_at(c, event->start_mark);
        return NULL;
    }
    node->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    node->text = arena_text(c->arena, text, event->data.scalar.length, c->e);
    return node->text && remember(c, event->data.scalar.anchor, node) ? node : NULL;
}

static void too_deep(const Composer *c, const yaml_event_t *event)
{
    error_set(c->e, ERROR_INPUT, "nested deeper than %d levels; a scene needs about ten",
              MAX_DEPTH);
    fail_at(c, event->start_mark);
}

// The node that starts with this event; NULL and e on failure.
static Node *compose(Composer *c, yaml_event_t *event, int depth)
{
    if (event->type == YAML_ALIAS_EVENT) {
        return copy_of_anchor(c, event);
    }
    if (event->type == YAML_SCALAR_EVENT) {
        return compose_scalar(c, event);
    }
    if (depth >= MAX_DEPTH) {
        too_deep(c, event);
        return NULL;
    }
    bool map = event->type == YAML_MAPPING_START_EVENT;
    Node *node = start_node(c, map ? NODE_MAP : NODE_LIST, event);
    const yaml_char_t *tag = map ? event->data.mapping_start.tag : event->data.sequence_start.tag;
    const yaml_char_t *anchor =
        map ? event->data.mapping_start.anchor : event->data.sequence_start.anchor;
    bool done = node && check_tag(c, tag, event) &&
                (map ? compose_map(c, node, depth + 1) : compose_list(c, node, depth + 1));
    if (done && node->height > MAX_DEPTH) { // aliases can add depth
        too_deep(c, event);
        return NULL;
    }
    return done && remember(c, anchor, node) ? node : NULL;
}

// Skips events up to the document's first; *end is true when there is none.
static bool find_document(Composer *c, yaml_event_t *event, bool *end)
{
    for (;;) {
        if (!next_event(c, event)) {
            return false;
        }
        *end = event->type == YAML_STREAM_END_EVENT;
        bool skip = event->type == YAML_STREAM_START_EVENT ||
                    event->type == YAML_DOCUMENT_START_EVENT ||
                    event->type == YAML_DOCUMENT_END_EVENT;
        if (!skip) {
            return true;
        }
        yaml_event_delete(event);
    }
}

static Node *compose_document(Composer *c)
{
    yaml_event_t event;
    bool end;
    if (!find_document(c, &event, &end)) {
        return NULL;
    }
    if (end) {
        yaml_event_delete(&event);
        error_set(c->e, ERROR_INPUT,
                  "the file is empty; a scene needs at least 'objects:' with one object");
        error_locate(c->e, c->source ? c->source : c->name, 0, 0);
        return NULL;
    }
    Node *root = compose(c, &event, 0);
    yaml_event_delete(&event);
    if (!root || !find_document(c, &event, &end)) {
        return NULL;
    }
    if (!end) {
        error_set(c->e, ERROR_INPUT, "a second YAML document; a scene file must hold one document");
        fail_at(c, event.start_mark);
        root = NULL;
    }
    yaml_event_delete(&event);
    return root;
}

Node *yaml_parse(Arena *arena, const char *text, size_t length, const char *name,
                 const char *source, Error *e)
{
    Composer *c = arena_alloc(arena, sizeof *c, e);
    if (!c) {
        return NULL;
    }
    c->arena = arena;
    c->name = name;
    c->source = source;
    c->budget = MAX_NODES;
    c->e = e;
    if (!yaml_parser_initialize(&c->parser)) {
        error_set(e, ERROR_MEMORY, "out of memory while parsing YAML");
        return NULL;
    }
    yaml_parser_set_input_string(&c->parser, (const unsigned char *)text, length);
    Node *root = compose_document(c);
    yaml_parser_delete(&c->parser);
    return root;
}
