// The body to break: its envelope, weathered and hollowed, at a resolution that resolves thin
// parts.
#ifndef RAMIFY_OBJECTS_FRACTURE_BODY_H
#define RAMIFY_OBJECTS_FRACTURE_BODY_H

#include "objects/fracture/fracture.h"
#include "shape/depth_field.h"

// Streams of the object's seed, besides those of its network (see sculpture.c).
enum { STREAM_CELLS = 5, STREAM_PIECES = 6, STREAM_BODY = 7 };

typedef struct FractureBody {
    Envelope *envelope;
    const DepthField *depth; // the envelope's
    Aabb box;                // m: of the body with its bumps
    Vec3 center;
    float extent, voxel; // m: largest extent; voxel size of the level sets
    float hollow;
    float bumps, wavelength; // m, of the outside
    uint64_t seed;
} FractureBody;

// Warns if parts are too thin for the finest voxels. Zero on failure.
bool fracture_body_new(FractureBody *body, const FractureParams *params, const Recipe *recipe,
                       Error *e);
void fracture_body_clear(FractureBody *body);

// Signed distance, m, negative inside: to the outer surface, and to the hollow body.
double fracture_body_outer(const FractureBody *body, Vec3 p);
double fracture_body_distance(const FractureBody *body, Vec3 p);

#endif
