// Ray queries against the world's surfaces, with Embree. Single meshes and curve sets go straight
// into the scene. Instances are one level deep; parts of an object with the same instances, as a
// tree's bark and leaves in a forest, are instanced together. Small meshes with many instances are
// copied out, because Embree then traces them faster.
#ifndef RAMIFY_RENDER_ACCEL_ACCEL_H
#define RAMIFY_RENDER_ACCEL_ACCEL_H

#include "base/run.h"
#include "render/light/emitter_set.h"
#include "render/material/bsdf.h"

typedef struct World World;
typedef struct Accel Accel;

// Small meshes (leaves, grass) trace 1.3 times as fast copied out as instanced, but cost about 130
// bytes a face, so the total of all copies is bounded. Large meshes trace as fast instanced.
enum { ACCEL_COPY_FACES_LIMIT = 6000000, ACCEL_COPY_MESH_LIMIT = 256 };

typedef struct Ray {
    Vec3 origin, direction; // unit direction
    float far;              // m
    float slack;            // m: how far before `far` the glowing curves of `part`, toward which a
    int part;               // shadow ray goes, are not met; 0 = everything is
    uint32_t key;           // random: decides whether the ray passes half-transparent surfaces
} Ray;

// A ray from the point in this direction, offset to the side of the surface that it leaves on.
static inline Ray ray_leaving(const SurfacePoint *point, Vec3 direction, uint32_t key)
{
    bool outside = vec3_dot(direction, point->geometric_normal) > 0.0f;
    Vec3 start = outside ? point->lifted : point->position;
    float step = outside ? point->epsilon : -point->epsilon;
    return (Ray){.origin = vec3_madd(start, step, point->facet_normal),
                 .direction = direction,
                 .far = INFINITY,
                 .key = key};
}

typedef struct Hit {
    float t, u, v;
    Vec3 normal; // Embree's, in the part's own space, not unit
    uint32_t geometry, primitive;
    uint32_t member; // of an instance's parts; 0 without instance
} Hit;

// Is isa NULL or the name of an instruction set? Else ERROR_INPUT, which lists them.
bool accel_check_isa(const char *isa, Error *e);

// Leaves, grass and thin curves are drawn as coarsely as world->views (or the camera) cannot tell,
// and relief that they see becomes geometry. Without views, later cameras get the first one's
// detail. world and materials are borrowed; isa as for renderer_new. Fails with ERROR_MEMORY when
// Embree runs out.
Accel *accel_new(const World *world, const MaterialSet *materials, const char *isa, const Run *run,
                 Error *e);
void accel_free(Accel *accel); // NULL is fine

// Replaces the materials after a change of their values; their number must stay.
void accel_use_materials(Accel *accel, const MaterialSet *materials);

// False if a part now needs other filters or another form: accel must be rebuilt.
bool accel_fits_materials(const Accel *accel);

int64_t accel_bytes(const Accel *accel); // held by Embree
Aabb accel_bounds(const Accel *accel);   // of everything; empty when there is nothing

// Every tracing thread calls these around its work: denormal numbers are flushed to zero. begin
// returns the old state.
unsigned accel_thread_begin(void);
void accel_thread_end(unsigned state);

bool accel_intersect(const Accel *accel, const Ray *ray, Hit *hit);

bool accel_occluded(const Accel *accel, const Ray *ray);

// The same for `count` rays, in packets where that is faster; met[i], blocked[i]: whether ray i
// hits. The last bits of a hit, and what a ray meets that grazes an edge, depend on the rays that
// it is traced with; so callers must always put the same rays together.
void accel_intersect_many(const Accel *accel, const Ray ray[], int count, Hit hit[], bool met[]);
void accel_occluded_many(const Accel *accel, const Ray ray[], int count, bool blocked[]);

// Index of the lamp that was hit; -1 for a part.
int accel_light(const Accel *accel, const Hit *hit);

// The piece of the geometry that was hit.
SurfacePlace accel_place(const Accel *accel, const Hit *hit);

// Fills all members but footprint.
void accel_surface(const Accel *accel, const Ray *ray, const Hit *hit, SurfacePoint *point);

#endif
