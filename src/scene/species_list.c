#include "scene/species_list.h"

#include "config/text.h"
#include "config/yaml.h"
#include "scene/species_file.h"

#include <string.h>

static bool is_text(const Node *map, const char *key, const char *wanted)
{
    const char *text = node_get_text(map, key);
    return text && strcmp(text, wanted) == 0;
}

static bool is_more_than_one(const Node *map, const char *key)
{
    const char *text = node_get_text(map, key);
    return text && strcmp(text, "1") != 0;
}

static const char *form_of(const Node *root, const Node *plant)
{
    static const char *const CONIFER_LEAVES[] = {"needles", "tuft", "scales"};
    const Node *leaves = node_get(plant, "leaves"), *trunk = node_get(plant, "trunk");
    if (node_get(root, "climber")) {
        return "climber";
    }
    if (is_more_than_one(trunk, "stems")) {
        return "many stems";
    }
    if (is_more_than_one(trunk, "ribs")) {
        return "column";
    }
    if (is_text(leaves, "arrangement", "rosette")) {
        return "rosette";
    }
    for (size_t i = 0; i < sizeof CONIFER_LEAVES / sizeof *CONIFER_LEAVES; i++) {
        if (is_text(leaves, "shape", CONIFER_LEAVES[i])) {
            return "conifer";
        }
    }
    return "broadleaf";
}

// Low and high end of the height that the species' targets give.
static void put_height(Text *text, const Node *root)
{
    const Node *targets = node_get(root, "targets");
    for (const Node *t = targets ? targets->first : NULL; t; t = t->next) {
        if (is_text(t, "measure", "height") || is_text(t, "measure", "height_above_ground")) {
            const char *low = node_get_text(t, "low"), *high = node_get_text(t, "high");
            text_put(text, "%3s..%-3s m  ", low ? low : "", high ? high : "");
            return;
        }
    }
    text_put(text, "%10s", "");
}

// "leafing 4.5 to 5.4" from a list of two months; nothing for other values.
static void put_months(Text *text, const char *name, const Node *months, bool *first)
{
    if (months && months->kind == NODE_LIST && months->count == 2) {
        text_put(text, "%s%s %s to %s", *first ? "" : ", ", name, months->first->text,
                 months->last->text);
        *first = false;
    }
}

static void put_year(Text *text, const Node *plant)
{
    static const char *const LEAVES[] = {"leafing", "turning", "falling"};
    const Node *year = node_get(plant, "phenology"), *organs = node_get(plant, "organs");
    bool first = true;
    if (!year || is_text(year, "evergreen", "true")) {
        text_put(text, "evergreen");
        first = false;
    } else {
        for (size_t i = 0; i < sizeof LEAVES / sizeof *LEAVES; i++) {
            put_months(text, LEAVES[i], node_get(year, LEAVES[i]), &first);
        }
    }
    for (const Node *organ = organs ? organs->first : NULL; organ; organ = organ->next) {
        const char *kind = node_get_text(organ, "kind");
        put_months(text, kind ? kind : "", node_get(organ, "season"), &first);
    }
}

static bool put_species(Text *text, const char *name, const char *file, Error *e)
{
    Arena *arena = arena_new(e);
    const Node *root = arena ? yaml_parse(arena, file, strlen(file), name, NULL, e) : NULL;
    if (root) {
        const Node *tree = node_get(root, "tree");
        const Node *plant = tree ? tree : node_get(root, "climber");
        const char *latin = node_get_text(root, "latin");
        text_put(text, "%-17s %-27s %-11s", name, latin ? latin : "", form_of(root, plant));
        put_height(text, root);
        put_year(text, plant);
        text_put(text, "\n");
    }
    arena_free(arena);
    return root;
}

char *species_list(Error *e)
{
    Text text = {.e = e};
    const char *name, *file;
    bool done = true;
    for (int i = 0; done && (name = species_builtin(i, &file)); i++) {
        done = put_species(&text, name, file, e);
    }
    text.failed = text.failed || !done;
    return text_take(&text);
}
