// The light of lamps and glowing geometry among clouds: mean radiance on a grid, made once by
// photons. A path from the camera finds a lamp deep in a cloud once in hundreds of times; photons
// from the lamp find all that it lights, by way of a medium that fills the scene, too.
//
// The field holds the light where the phase function of droplets has widened to an even one
// (path_clouds.c): what such a droplet scatters is the mean of the radiance around it. Its error
// falls with the size of its voxels and with the number of photons (a density estimate by the
// lengths of their ways: Lux and Koblinger 1991; as a cache of what is diffuse: Jensen, "Global
// Illumination using Photon Maps", 1996). The first scatterings, which are not even, remain those
// of paths.
#ifndef RAMIFY_RENDER_LAMP_FIELD_H
#define RAMIFY_RENDER_LAMP_FIELD_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

struct Tracer;

typedef struct LampField LampField;

// Makes the field of the tracer's lamps, clouds and geometry; key: of the photons' random numbers.
// *field is NULL, and no error, where there is little to gain: no lamps, or no clouds that they
// light. The caller frees it. Errors: ERROR_MEMORY, ERROR_CANCELLED. The same bits for any number
// of threads.
bool lamp_field_make(LampField **field, const struct Tracer *tracer, uint64_t key, const Run *run,
                     Error *e);
void lamp_field_free(LampField *field); // NULL is fine

// Bytes of memory that making a field takes, at most but for its rim.
int64_t lamp_field_bytes(void);

// Mean over all directions of the lamps' radiance at a place. False beyond the field, or where it
// is NULL.
bool lamp_field_at(const LampField *field, Vec3 p, Vec3 *mean);

// Luminance of that mean, about; beyond the field as at its nearest place, but falling with the
// square of the distance from its middle. 0 where it is NULL.
float lamp_field_around(const LampField *field, Vec3 p);

#endif
