// Golden images: renders every scene of a folder, pinned, and compares it with its stored image:
// NAME.yaml with NAME.png, or with NAME.exr if the scene's golden.mode is statistical.
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
    char *name; // the scene's file name without its extension; an orphan's with it. Owned
    GoldenStatus status;
    GoldenMode mode;
    char message[768];     // what is wrong, or why it was stored; "" = nothing
    Limits limits;         // limits applied; all negative if statistical
    double alpha;          // if statistical
    bool compared;         // whether comparison is filled
    Comparison comparison; // ours, and the stored image before an update
    double seconds;
} GoldenResult;

typedef struct GoldenOptions {
    bool update;        // store different and missing images
    bool pictures;      // keep PNGs in the results, for a report
    const char *filter; // pattern of names to take, with * and ?; NULL = all
    const char *isa;    // instruction set of the ray tracer; NULL = this machine's best
    int mode;           // a GoldenMode for all scenes; negative = the scene's own
    uint64_t series;    // GOLDEN_STATISTICAL: other values give other seeds for ours; not 0
    Limits limits;      // for all scenes; negative = the scene's own
    int64_t memory;     // bytes; scenes that certainly need more fail; 0 = no limit
    void (*each)(void *user, const GoldenResult *result); // called after each result; NULL = none
    void *user;
} GoldenOptions;

// Pinned to PINNED_ISA, with the scenes' own modes and limits.
GoldenOptions golden_options_default(void);

typedef struct GoldenResults {
    GoldenResult *item; // owned: scenes by name, then orphans
    int64_t count, capacity;
    int counts[GOLDEN_ORPHAN + 1]; // by status
} GoldenResults;

// Runs all scenes of the folder. A failing scene is part of the results; false and e when the
// folder cannot be read or no scene matches the filter (ERROR_INPUT), when out of memory, or when
// cancelled. results hold what was done so far, in any case.
bool golden_run(const char *folder, const GoldenOptions *options, const Run *run,
                GoldenResults *results, Error *e);

void golden_results_clear(GoldenResults *results);

#endif
