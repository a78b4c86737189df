// When to save work in progress: at intervals, such that saving takes a small share of the time.
#ifndef RAMIFY_BASE_SAVE_CLOCK_H
#define RAMIFY_BASE_SAVE_CLOCK_H

#include <stdbool.h>

#define SAVE_CLOCK_USUAL 60.0 // s between savings
#define SAVE_CLOCK_SHARE 0.03 // of the time, at most, is spent on saving

typedef struct SaveClock {
    double every; // s between savings; 0 = never
    double next;  // time of the next
} SaveClock;

// now, and all times below: seconds of one monotonic clock.
static inline SaveClock save_clock_start(double every, double now)
{
    return (SaveClock){every, now + every};
}

static inline bool save_clock_is_due(const SaveClock *clock, double now)
{
    return clock->every > 0.0 && now >= clock->next;
}

// Work was saved from start to end.
static inline void save_clock_saved(SaveClock *clock, double start, double end)
{
    double rest = (end - start) / SAVE_CLOCK_SHARE;
    clock->next = end + (rest > clock->every ? rest : clock->every);
}

#endif
