// All emitting pieces of a world's geometry (parts whose material is TRAIT_EMISSIVE), with a light
// tree over them.
#ifndef RAMIFY_RENDER_LIGHT_EMITTER_SET_H
#define RAMIFY_RENDER_LIGHT_EMITTER_SET_H

#include "base/run.h"
#include "render/light/emitter.h"

typedef struct World World;

typedef struct EmitterSet {
    Emitter *emitter; // owned
    int64_t count;
    int64_t *first;  // owned: of each part, its first emitter; -1 where it does not glow
    LightTree *tree; // owned; NULL where nothing glows
    Aabb box;        // of all of them
} EmitterSet;

// The place of a hit on a part.
typedef struct SurfacePlace {
    int part;
    uint32_t instance;  // 0 of a part that is drawn once
    uint32_t primitive; // face, or segment of curves
    uint32_t point;     // curves: the segment's first point
    float u, v;         // within the primitive, as Embree has them
} SurfacePlace;

bool emitter_set_fill(EmitterSet *set, const World *world, const Run *run, Error *e);
void emitter_set_clear(EmitterSet *set);

// The emitter at that place; position: the point hit, world.
int64_t emitter_set_find(const EmitterSet *set, const World *world, const SurfacePlace *place,
                         Vec3 position);

// Factor on the material's radiance at that place.
float emitter_set_glow(const World *world, const SurfacePlace *place);

#endif
