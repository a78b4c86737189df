// The description of clouds: heaps, sheets, storms, fog and spray of droplets, and plumes of ash,
// that light passes through.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_H
#define RAMIFY_RENDER_CLOUD_CLOUD_H

#include "base/vec.h"
#include "mesh/spray.h"

#include <stdbool.h>

typedef enum CloudKind {
    CLOUD_CUMULUS, // heaps on one base, over all the land
    CLOUD_STRATUS, // a sheet, closed or torn
    CLOUD_STORM,   // one cumulonimbus with its anvil
    CLOUD_FOG,     // fills the air from its base up to a wavy top; dense below
    CLOUD_PLUME,   // ash that rises from a vent; bends with the wind
    CLOUD_GRID,    // a file's voxels
    CLOUD_SPRAY    // what falls and breakers throw up
} CloudKind;

// What of spray a cloud shows.
typedef enum SprayOf {
    SPRAY_MIST, // the drops that air carries off
    SPRAY_WATER // falling water itself, which air has made white
} SprayOf;

// The level on which the fog of a terrain lies, over a square: samples row by row, x first.
typedef struct CloudFloor {
    int side;          // samples along x and z
    float x, z, cell;  // m: of the first sample, and between samples
    bool periodic;     // beyond its rim it repeats; else its mirror image follows
    float least, most; // m: altitudes of the lowest and of the highest sample
    float *height;     // m; owned; NULL where only memory is estimated
} CloudFloor;

typedef struct Cloud {
    CloudKind kind;
    float base;       // m: altitude of the underside
    float thickness;  // m: of the tallest heap, of the sheet, of the storm with its anvil
    float cover;      // share of the sky, 0..1; not CLOUD_STORM
    float size;       // m: width of large heaps, of rolls of a sheet or fog, of a storm's towers
    float extinction; // 1/m, where droplets are dense
    Vec3 albedo;      // share of the light that one particle scatters; it absorbs the rest
    float softness;   // 0..1: how far dry air has worn the borders; heaps and storms
    float wind;       // degrees from +Z toward +X: where the wind blows
    float center_x, center_z; // m; CLOUD_STORM, CLOUD_PLUME
    float shelf;              // CLOUD_STORM: how far one overhangs, in shares of the size; 0 = none
    const char *over;    // CLOUD_FOG: terrain whose low ground it lies on; CLOUD_SPRAY: object that
                         // throws it up; NULL = none; borrowed
    SprayOf of;          // CLOUD_SPRAY
    float pool;          // m: with over, radius within which the lowest land is its ground
    float drift;         // CLOUD_FOG, 0..1: how far the wind has drawn it out; CLOUD_PLUME: bent it
    SprayParcels *spray; // CLOUD_SPRAY: owned; NULL = not known yet
    CloudFloor *floor;   // with over: the level that it lies on; NULL = not known yet
    int seed;            // of these clouds beside the scene's
    int resolution;      // voxels across their grid, rounded up to a power of two; grown kinds
    const char *file, *grid; // CLOUD_GRID: .vdb; NULL = its first grid of floats; borrowed
    Vec3 position, rotation; // m, degrees: of the file's origin
    float scale;             // m a unit of the file
} Cloud;

Cloud cloud_default(CloudKind kind);

// Frees what clouds have from the objects that they lie over: floors of fog, spray.
void cloud_grounds_free(Cloud *cloud, int count);

#endif
