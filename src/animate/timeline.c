#include "animate/timeline.h"

#include "animate/keys.h"
#include "base/memory.h"
#include "config/scalar.h"

#include <stdlib.h>
#include <string.h>

typedef struct Lane {
    const SceneTrack *track;
    Keys keys;             // width 0 = words
    double *times, *value; // owned
} Lane;

struct Timeline {
    Lane *lane;
    int count;
};

// Parses a key's numbers: "3", "[1, 2]", "#rrggbb" as linear light. Returns their count; 0 = a
// word.
static int read_numbers(const char *text, double numbers[SCENE_KEY_MOST_NUMBERS])
{
    float rgb[3];
    if (scalar_color(text, rgb)) {
        for (int i = 0; i < 3; i++) {
            numbers[i] = (double)rgb[i];
        }
        return 3;
    }
    if (*text != '[') {
        return scalar_number(text, numbers) ? 1 : 0;
    }
    int count = 0;
    for (const char *at = text + 1; *at && count < SCENE_KEY_MOST_NUMBERS; count++) {
        char number[64];
        at += strspn(at, " ");
        size_t length = strcspn(at, ",]");
        if (length >= sizeof number) {
            return 0;
        }
        memcpy(number, at, length);
        number[length] = 0;
        if (!scalar_number(number, &numbers[count])) {
            return 0;
        }
        at += length + (at[length] != 0);
    }
    return count;
}

static bool fill_lane(Lane *lane, const SceneTrack *track, bool loop, Error *e)
{
    double numbers[SCENE_KEY_MOST_NUMBERS];
    int width = read_numbers(track->keys[0].value, numbers);
    lane->track = track;
    lane->times = memory_alloc(track->key_count, sizeof(double), e);
    lane->value =
        memory_alloc((int64_t)track->key_count * SCENE_KEY_MOST_NUMBERS, sizeof(double), e);
    if (!lane->times || !lane->value) {
        return false;
    }
    for (int i = 0; i < track->key_count; i++) {
        lane->times[i] = track->keys[i].at;
        read_numbers(track->keys[i].value, numbers);
        memcpy(lane->value + (size_t)i * (size_t)width, numbers, sizeof(double) * (size_t)width);
    }
    lane->keys = (Keys){track->ease, loop, track->key_count, width, lane->times, lane->value};
    return true;
}

Timeline *timeline_new(const SceneAnimation *animation, Error *e)
{
    Timeline *timeline = memory_alloc_zero(1, sizeof *timeline, e);
    int count = animation ? animation->track_count : 0;
    if (timeline) {
        timeline->lane = memory_alloc_zero(count, sizeof *timeline->lane, e);
    }
    bool done = timeline && timeline->lane;
    for (int i = 0; done && i < count; i++) {
        timeline->count = i + 1;
        done = fill_lane(&timeline->lane[i], &animation->tracks[i], animation->loop, e);
    }
    if (!done) {
        timeline_free(timeline);
        return NULL;
    }
    return timeline;
}

void timeline_free(Timeline *timeline)
{
    if (timeline) {
        for (int i = 0; timeline->lane && i < timeline->count; i++) {
            free(timeline->lane[i].times);
            free(timeline->lane[i].value);
        }
        free(timeline->lane);
        free(timeline);
    }
}

bool timeline_add(const Timeline *timeline, double time, Changes *changes, Error *e)
{
    for (int i = 0; i < timeline->count; i++) {
        const Lane *lane = &timeline->lane[i];
        const SceneTrack *track = lane->track;
        SceneChange change = {.path = track->path,
                              .source = track->path,
                              .line = track->line,
                              .column = track->column};
        bool done;
        if (lane->keys.width == 0) {
            change.value = track->keys[keys_step(&lane->keys, time)].value;
            done = changes_add(changes, &change, e);
        } else {
            double value[SCENE_KEY_MOST_NUMBERS];
            keys_at(&lane->keys, time, value);
            done = changes_add_numbers(changes, &change, value, lane->keys.width, e);
        }
        if (!done) {
            return false;
        }
    }
    return true;
}

double frame_time(int frame, int frames, bool loop)
{
    int span = loop ? frames : frames - 1;
    return span > 0 ? (double)frame / (double)span : 0.0;
}
