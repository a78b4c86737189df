// Writes the heights of land as pictures.
#ifndef RAMIFY_CLI_LAND_H
#define RAMIFY_CLI_LAND_H

#include "cli/options.h"

// Number of objects that are land.
int land_count(const RamifyScene *scene);

// Writes the heights of every object that is land, from its out-tree (trees: one per object, NULL
// where none grew), to --output as ramify_export_lands does.
bool land_write(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                const RamifyRun *run, RamifyError *e);

#endif
