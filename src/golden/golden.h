// Golden images: every scene of a folder is rendered, pinned, and compared with its stored image:
// NAME.yaml with NAME.png, or with NAME.exr where the scene's golden.mode is statistical.
#ifndef RAMIFY_GOLDEN_GOLDEN_H
#define RAMIFY_GOLDEN_GOLDEN_H

#include "base/run.h"
#include "golden/comparison.h"
#include "scene/scene.h"

typedef enum GoldenStatus {
    GOLDEN_ALIKE,
    GOLDEN_DIFFERENT,
    GOLDEN_MISSING, // no stored image
    GOLDEN_FAILED,  // the scene or its stored image cannot be read, or rendering failed
    GOLDEN_STORED,  // by an update, because it was missing or different
    GOLDEN_ORPHAN   // a stored image without a scene
} GoldenStatus;

// "alike", "different", ...
const char *golden_status_name(GoldenStatus status);

typedef struct GoldenResult {
    char *name; // the scene's file without its ending; an orphan's with it. Owned
    GoldenStatus status;
    GoldenMode mode;
    char message[768];     // what is wrong, or why it was stored; "" = nothing
    Limits limits;         // what it was held to; all negative when statistical
    double alpha;          // when statistical
    bool compared;         // comparison is filled
    Comparison comparison; // ours, and stored as it was before
    double seconds;
} GoldenResult;

typedef struct GoldenOptions {
    bool update;        // store what differs or is missing
    bool pictures;      // keep PNGs in the results, for a report
    const char *filter; // names to take, with * and ?; NULL = all
    const char *isa;    // instruction set of the ray tracer; NULL = this machine's best
    int mode;           // a GoldenMode for all scenes; negative = the scene's own
    uint64_t series;    // GOLDEN_STATISTICAL: other numbers, other seeds for ours; not 0
    Limits limits;      // for all scenes; negative = the scene's own
    void (*each)(void *user, const GoldenResult *result); // after each one; NULL = not wanted
    void *user;
} GoldenOptions;

// Pinned to PINNED_ISA, the scenes' own modes and limits.
GoldenOptions golden_options_default(void);

typedef struct GoldenResults {
    GoldenResult *item; // owned: scenes by name, then orphans
    int64_t count, capacity;
    int counts[GOLDEN_ORPHAN + 1]; // by status
} GoldenResults;

// Works through the folder. What is wrong with a scene is part of its result; false and e when the
// folder cannot be read or has no scene that the filter takes (ERROR_INPUT), memory runs out, or
// the user interrupts; results hold what there is so far, in any case.
bool golden_run(const char *folder, const GoldenOptions *options, const Run *run,
                GoldenResults *results, Error *e);

void golden_results_clear(GoldenResults *results);

#endif
