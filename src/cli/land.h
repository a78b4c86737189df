// Writes the heights of land, whole or by tiles.
#ifndef RAMIFY_CLI_LAND_H
#define RAMIFY_CLI_LAND_H

#include "cli/options.h"

// Number of objects that are land.
int land_count(const RamifyScene *scene);

// Writes the heights of every object that is land, from its out-tree (trees: one per object, NULL
// where none grew), to --output as ramify_export_lands does.
bool land_write(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                const RamifyRun *run, RamifyError *e);

// Prints what was written to the standard error; map: NULL = heights.
void land_describe(const RamifyScene *scene, int index, const char *map, const RamifyLand *land);

// land_tiles.c: is --tile a range of the scene's tiles, and --output a file for them?
bool land_check_tiles(const Options *options, const RamifyScene *scene, RamifyError *e);

// Writes the tiles of --tile: one to --output, several to FILE-X-Y.
bool land_write_tiles(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                      const RamifyRun *run, RamifyError *e);

#endif
