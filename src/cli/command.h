// What the commands share: the run's surroundings, and the commands themselves.
#ifndef RAMIFY_CLI_COMMAND_H
#define RAMIFY_CLI_COMMAND_H

#include "cli/fail.h"
#include "cli/options.h"
#include "cli/progress.h"

// Each reads its scene, does its work and prints its data; false and e when it failed.
bool command_render(const Options *options, RamifyError *e);     // render.c
bool command_turntable(const Options *options, RamifyError *e);  // turntable.c
bool command_grow(const Options *options, RamifyError *e);       // grow.c
bool command_measure(const Options *options, RamifyError *e);    // measure.c
bool command_export(const Options *options, RamifyError *e);     // export.c
bool command_compare(const Options *options, RamifyError *e);    // compare.c
bool command_golden(const Options *options, RamifyError *e);     // golden.c
bool command_info(const Options *options, RamifyError *e);       // info.c
bool command_schema(const Options *options, RamifyError *e);     // schema.c
bool command_completion(const Options *options, RamifyError *e); // completion.c

// Threads as asked, progress and warnings to stderr, Ctrl-C and SIGTERM to cancel.
RamifyRun command_run(const Options *options, Progress *progress);

// The scene with --set and the render options carried out.
RamifyScene *command_scene(const Options *options, RamifyError *e);

// What pictures may differ by; negative where the command line does not say.
RamifyLimits command_limits(const Options *options);

// The scene's file without its folders.
const char *file_name(const char *path);

// Can FILE be written when the time comes? RAMIFY_IO when its folder is missing or may not be
// written to, or when FILE is a folder; RAMIFY_BAD_INPUT when its name is too long.
bool output_check(const char *file, RamifyError *e);

// FILE with its ending (".png") replaced; heap text.
char *output_with_ending(const char *file, const char *ending, RamifyError *e);

// Does the file's name end in this, in any case?
bool output_has_ending(const char *file, const char *ending);

// Writes text as a JSON string, quotes included, to stdout.
void json_print_string(const char *text);

#endif
