// Rays of light that leave lamps and glowing geometry, drawn in proportion to their power.
#ifndef RAMIFY_RENDER_LIGHT_EMISSION_H
#define RAMIFY_RENDER_LIGHT_EMISSION_H

#include "render/light/lights.h"

typedef struct EmissionTable EmissionTable;

typedef struct Emission {
    Vec3 origin;    // just off the surface
    Vec3 direction; // unit
    Vec3 color;     // its flux over the power of them all, per channel; the mean over all draws is
                    // the flux of all lamps over that power
} Emission;

// A table over all near lights; lights is borrowed and must outlive it. NULL with ERROR_MEMORY, or
// without an error where none shines.
EmissionTable *emission_table_new(const Lights *lights, Error *e);
void emission_table_free(EmissionTable *table); // NULL is fine

float emission_power(const EmissionTable *table); // W, luminous

Emission emission_draw(const EmissionTable *table, uint64_t key);

#endif
