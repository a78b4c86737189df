// The description of clouds: heaps, sheets, storms and fog of droplets that light passes through.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_H
#define RAMIFY_RENDER_CLOUD_CLOUD_H

#include "base/vec.h"

typedef enum CloudKind {
    CLOUD_CUMULUS, // heaps on one base, over all the land
    CLOUD_STRATUS, // a sheet, closed or torn
    CLOUD_STORM,   // one cumulonimbus with its anvil
    CLOUD_FOG,     // fills the air from its base up to a wavy top; dense below
    CLOUD_GRID     // a file's voxels
} CloudKind;

typedef struct Cloud {
    CloudKind kind;
    float base;       // m: altitude of the underside
    float thickness;  // m: of the tallest heap, of the sheet, of the storm with its anvil
    float cover;      // share of the sky, 0..1; not CLOUD_STORM
    float size;       // m: width of large heaps, of rolls of a sheet or fog, of a storm's towers
    float extinction; // 1/m, where droplets are dense
    float softness;   // 0..1: how far dry air has worn the borders; heaps and storms
    float wind;       // degrees from +Z toward +X: where the wind blows
    float center_x, center_z; // m; CLOUD_STORM
    int seed;                 // of these clouds beside the scene's
    const char *file, *grid;  // CLOUD_GRID: .vdb; NULL = its first grid of floats; borrowed
    Vec3 position, rotation;  // m, degrees: of the file's origin
    float scale;              // m a unit of the file
} Cloud;

Cloud cloud_default(CloudKind kind);

#endif
