// Writing the heights of land as pictures.
#ifndef RAMIFY_CLI_LAND_H
#define RAMIFY_CLI_LAND_H

#include "cli/options.h"
#include "scene/build.h"

// How many objects of the scene are land.
int land_count(const Scene *scene);

// Heights of every object that is land, from its out-tree: 16-bit PNG, black at the lowest and
// white at the highest point, or float EXR in metres (channel Y). Both say in their metadata
// (ramify:low, ramify:high, ramify:cell, all in metres) what they hold. One goes to FILE, several
// to FILE-name.
bool land_write(const Options *options, const Scene *scene, OutTree *const *trees, const Run *run,
                Error *e);

#endif
