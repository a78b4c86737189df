// The commands, and what they share.
#ifndef RAMIFY_CLI_COMMAND_H
#define RAMIFY_CLI_COMMAND_H

#include "cli/fail.h"
#include "cli/options.h"
#include "cli/progress.h"

// Each command reads its scene, does its work and prints its output; false and e on failure.
bool command_render(const Options *options, RamifyError *e);     // render.c
bool command_turntable(const Options *options, RamifyError *e);  // turntable.c
bool command_grow(const Options *options, RamifyError *e);       // grow.c
bool command_measure(const Options *options, RamifyError *e);    // measure.c
bool command_fit(const Options *options, RamifyError *e);        // fit.c
bool command_export(const Options *options, RamifyError *e);     // export.c
bool command_merge(const Options *options, RamifyError *e);      // merge.c
bool command_develop(const Options *options, RamifyError *e);    // develop.c
bool command_batch(const Options *options, RamifyError *e);      // batch/batch.c
bool command_replay(const Options *options, RamifyError *e);     // replay.c
bool command_compare(const Options *options, RamifyError *e);    // compare.c
bool command_golden(const Options *options, RamifyError *e);     // golden.c
bool command_info(const Options *options, RamifyError *e);       // info.c
bool command_species(const Options *options, RamifyError *e);    // species.c
bool command_schema(const Options *options, RamifyError *e);     // schema.c
bool command_completion(const Options *options, RamifyError *e); // completion.c
bool command_help(const Options *options, RamifyError *e);       // help.c

// Threads as requested, progress and warnings on stderr, cancelled by Ctrl-C and SIGTERM.
RamifyRun command_run(const Options *options, Progress *progress);

// Loads the scene with the overrides of --set and the render options applied.
RamifyScene *command_scene(const Options *options, RamifyError *e);

// The settings of a picture (ramify_scene_load_settings) with the same.
RamifyScene *command_settings(const Options *options, RamifyError *e);

// The turntable of the options; ramify_turntable's number of frames and range are as given there.
bool command_turn(const Options *options, RamifyTurntable *turntable, RamifyError *e);

// Joins the operands, pictures of parts of this scene's picture, and writes it to --output.
bool command_join(const Options *options, const RamifyScene *scene, RamifyError *e);

// Refuses a scene that certainly needs more than --memory, before any work.
bool command_check_memory(const Options *options, const RamifyScene *scene, RamifyError *e);

// Seconds between checkpoints of a picture; 0 = none.
double command_checkpoint(const Options *options);

// Limits for comparing pictures; negative if not given.
RamifyLimits command_limits(const Options *options);

// Index of an option's word in a list; -1 and e when it is not there. NULL gives 0.
int command_choice(const char *option, const char *word, const char *const known[], int count,
                   RamifyError *e);

// The path without its folders.
const char *file_name(const char *path);

// Checks early that FILE can be written. RAMIFY_IO when its folder is missing or not writable, or
// when FILE is a folder; RAMIFY_BAD_INPUT when its name is too long.
bool output_check(const char *file, RamifyError *e);

// Replaces FILE's extension (".png"); heap text.
char *output_with_ending(const char *file, const char *ending, RamifyError *e);

// Whether the file's name has this extension, in any case.
bool output_has_ending(const char *file, const char *ending);

#endif
