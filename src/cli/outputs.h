// The two files of a picture: developed, and the .exr beside it.
#ifndef RAMIFY_CLI_OUTPUTS_H
#define RAMIFY_CLI_OUTPUTS_H

#include "cli/options.h"

typedef struct Outputs {
    char *display, *exr; // owned
} Outputs;

// Names them by --output, else by the operand in the current folder, and checks that they can be
// written. The caller clears them in any case.
bool outputs_plan(const Options *options, Outputs *outputs, RamifyError *e);
void outputs_clear(Outputs *outputs);

// Writes both, denoised if the scene says so. A film that was interrupted is written too, without
// denoising if that is what was interrupted.
bool outputs_write(const Outputs *outputs, RamifyFilm *film, const RamifyScene *scene,
                   const RamifyRun *run, RamifyError *e);

#endif
