// Writing the heights of land as pictures.
#ifndef RAMIFY_CLI_LAND_H
#define RAMIFY_CLI_LAND_H

#include "cli/options.h"

// How many objects of the scene are land.
int land_count(const RamifyScene *scene);

// Heights of every object that is land, from its out-tree (trees: one an object, NULL where none
// grew), to --output as ramify_export_lands does.
bool land_write(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                const RamifyRun *run, RamifyError *e);

#endif
