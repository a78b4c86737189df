// A batch: a picture's tiles or an animation's frames, rendered as tasks that need not know of each
// other, on one machine or many.
//
// A batch is a folder that all machines see:
//
//     plan        the command as it was given, a line an option; the scene's file; ramify's version
//     scene.yaml  the scene's text
//     parts/      000007.exr: a tile or frame that is finished; 000007.begun.exr: one that is not
//     logs/       what the tasks said
//     slurm/, template.yaml   the engine's files
//
// The state of a batch is which parts are there, and nothing else: they get their names when they
// are complete, and two tasks that render the same part write the same bits.
#ifndef RAMIFY_CLI_BATCH_H
#define RAMIFY_CLI_BATCH_H

#include "cli/options.h"

enum { BATCH_PATH = 4096 };

typedef struct Batch {
    char folder[BATCH_PATH];   // absolute
    char *text, **words;       // the plan's, which `plan` borrows; owned
    Options plan;              // the options that decide on the result
    const char *scene_file;    // absolute: as it was named when the batch was made
    RamifyScene *scene;        // owned
    int first, last;           // numbers of the parts, inclusive
    int columns, rows;         // of tiles; 0 = the parts are frames
    int ranges;                // of each tile's samples
    RamifyTurntable turntable; // of frames
    const char *ending;        // of the parts' files, ".exr"
} Batch;

// Plans a batch by the command line and makes its folder, or opens the folder if it holds the same
// plan already. RAMIFY_BAD_INPUT when it holds another. Free with batch_free.
Batch *batch_create(const Options *options, RamifyError *e); // create.c

// Opens a batch's folder. RAMIFY_BAD_INPUT when it is none, or of another version of ramify.
Batch *batch_open(const char *folder, RamifyError *e); // open.c
void batch_free(Batch *batch);

// Fills what follows from the options and the scene, which is loaded: the parts and the turntable.
// RAMIFY_BAD_INPUT when they make no batch. settle.c
bool batch_settle(Batch *batch, const Options *options, const char *output, RamifyError *e);

// The batch's scene with up to MOST_CHANGES more overrides, as "film.crop=[...]"; free it.
enum { MOST_CHANGES = 3 };
RamifyScene *batch_scene(const Batch *batch, const char *const *changes, int count, RamifyError *e);

// What its parts are: "tile", "frame" or, of a tile's ranges of samples, "part".
const char *batch_noun(const Batch *batch);

// ---- parts: parts.c

// Name of a finished part, and of an unfinished one; heap text.
char *batch_part_file(const Batch *batch, int part, RamifyError *e);
char *batch_begun_file(const Batch *batch, int part, RamifyError *e);

// The frames' files as ramify_turntable names them, "FOLDER/parts/%06d.png"; heap text.
char *batch_frame_pattern(const Batch *batch, RamifyError *e);

bool batch_part_done(const Batch *batch, int part);

// Crop of a part's tile in 0..1. Edges lie at multiples of 16 pixels, as the renderer's own tiles
// do.
void batch_tile_crop(const Batch *batch, int part, float crop[4]);

// Samples of a part of a picture: *first .. *end - 1. They end at multiples of 16, as far as there
// are so many, which the renderer traces together.
void batch_samples(const Batch *batch, int part, int *first, int *end);

// Writes the numbers first .. last for which wanted[i - first], as "3, 7, 9-12", into text; ends in
// "..." when they do not fit.
void batch_list(const bool *wanted, int first, int last, const char *separator, char *text,
                size_t size);

// Flags of the parts that are not done: last - first + 1, heap; *count (may be NULL): how many.
bool *batch_missing(const Batch *batch, int *count, RamifyError *e);

// Reads "A-B" or "A" within low .. high; false when it is none.
bool batch_read_range(const char *text, int low, int high, int *first, int *last);

// ---- what a task costs: estimate.c

typedef struct Estimate {
    double start;  // s, before the first part
    double part;   // s, each
    double memory; // bytes
    double merge;  // bytes of memory that the merge takes
} Estimate;

// For tasks of this many threads, by ramify_estimate, which grows the scene; its result is kept in
// the folder's file `estimate`.
bool batch_estimate(const Batch *batch, int threads, const Options *options, Estimate *cost,
                    RamifyError *e);

// Parts of one task: as --pack says, else so many that it takes some minutes.
int batch_pack(const Batch *batch, const Options *options, const Estimate *cost);

// Threads of a task: as --threads says, else the processors of this machine by --jobs.
int batch_threads(const Options *options);

// Writes "64 tiles, 4 a task; about 3 min and 1.2 GB a task" to stderr, unless --quiet is given.
void batch_print_estimate(const Batch *batch, const Options *options, int pack,
                          const Estimate *cost);

// ---- work

// Renders parts first .. last, as far as they are not done, one after another. RAMIFY_CANCELLED
// when interrupted: what was begun is saved, and the same call goes on with it.
bool batch_run(const Batch *batch, int first, int last, const Options *options,
               RamifyError *e); // run.c

// Makes the output of all parts. RAMIFY_DIFFERS, naming them, when some are missing.
bool batch_merge(const Batch *batch, const Options *options, RamifyError *e); // merge.c

bool batch_status(const Batch *batch, const Options *options, RamifyError *e); // status.c

// ---- engines: run or submit all tasks with missing parts, then the merge

bool batch_local(const Batch *batch, const Options *options, RamifyError *e);  // local.c
bool batch_slurm(const Batch *batch, const Options *options, RamifyError *e);  // slurm.c
bool batch_openjd(const Batch *batch, const Options *options, RamifyError *e); // openjd.c

#endif
