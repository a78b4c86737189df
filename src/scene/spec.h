// The tables of scene files, one spec_*.c per subject.
#ifndef RAMIFY_SCENE_SPEC_H
#define RAMIFY_SCENE_SPEC_H

#include "config/table.h"

extern const Table scene_table; // the root

// Tables used by tables of other files.
extern const Table sky_table, cloud_table, shower_table, light_table, material_table, medium_table,
    object_table, deform_table, animation_table;

#endif
