#include "animate/timeline.h"

#include "animate/keys.h"
#include "base/memory.h"

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

static bool fill_lane(Lane *lane, const SceneTrack *track, bool loop, Error *e)
{
    double numbers[SCENE_KEY_MOST_NUMBERS];
    int width = scene_key_numbers(&track->keys[0], numbers);
    lane->track = track;
    lane->times = memory_alloc(track->key_count, sizeof(double), e);
    lane->value =
        memory_alloc((int64_t)track->key_count * SCENE_KEY_MOST_NUMBERS, sizeof(double), e);
    if (!lane->times || !lane->value) {
        return false;
    }
    for (int i = 0; i < track->key_count; i++) {
        lane->times[i] = track->keys[i].at;
        scene_key_numbers(&track->keys[i], numbers);
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
