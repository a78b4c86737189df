// Checks of tracks: keys in order of time, all of one type.
#include "config/scalar.h"
#include "scene/spec_check.h"

#include <stdio.h>
#include <string.h>

// "[1, 2]"
static int read_list(const char *text, double numbers[SCENE_KEY_MOST_NUMBERS])
{
    int count = 0;
    for (const char *at = text + 1; *at && count < SCENE_KEY_MOST_NUMBERS; count++) {
        char number[64];
        at += strspn(at, " ");
        size_t length = strcspn(at, ",]");
        snprintf(number, sizeof number, "%.*s", (int)length, at);
        if (!scalar_number(number, &numbers[count])) {
            return 0;
        }
        at += length + (at[length] != 0);
    }
    return count;
}

int scene_key_numbers(const SceneKey *key, double numbers[SCENE_KEY_MOST_NUMBERS])
{
    float rgb[3];
    if (scalar_color(key->value, rgb)) {
        for (int i = 0; i < 3; i++) {
            numbers[i] = (double)rgb[i];
        }
        return 3;
    }
    if (key->quoted) {
        return 0;
    }
    return *key->value == '[' ? read_list(key->value, numbers) : scalar_number(key->value, numbers);
}

static void describe(int numbers, char text[32])
{
    if (numbers == 0) {
        snprintf(text, 32, "a word");
    } else {
        snprintf(text, 32, "%d number%s", numbers, numbers == 1 ? "" : "s");
    }
}

static bool check_keys(const Mapping *mapping, const SceneTrack *track)
{
    double numbers[SCENE_KEY_MOST_NUMBERS];
    int wanted = scene_key_numbers(&track->keys[0], numbers);
    const Node *given = node_get(mapping->given, "keys")->first;
    for (int i = 0; i < track->key_count; i++, given = given->next) {
        const SceneKey *key = &track->keys[i];
        int count = scene_key_numbers(key, numbers);
        if (i > 0 && !(key->at > key[-1].at)) {
            return load_fail(
                mapping->loader, node_get(given, "at"),
                "%s: the key at %g follows one at %g; times must increase from key to key",
                mapping_path(mapping, NULL), key->at, key[-1].at);
        }
        if (count != wanted) {
            char is[32], was[32];
            describe(count, is);
            describe(wanted, was);
            return load_fail(mapping->loader, node_get(given, "value"),
                             "%s: this key is %s, the first one is %s; all must be of one type",
                             mapping_path(mapping, NULL), is, was);
        }
    }
    return true;
}

bool check_track(const Mapping *mapping, void *params)
{
    SceneTrack *track = params;
    const Node *named = node_get(mapping->given, "path");
    track->line = named->source ? 0 : named->line;
    track->column = named->source ? 0 : named->column;
    if (strcmp(track->path, "animation") == 0 || strncmp(track->path, "animation.", 10) == 0) {
        return load_fail(mapping->loader, named,
                         "%s: the animation cannot change itself; use another path",
                         mapping_path(mapping, NULL));
    }
    return check_keys(mapping, track);
}
