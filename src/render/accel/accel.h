// The world's surfaces in Embree: what does a ray meet, and what is it like there?
// Single meshes and curve sets go straight into the scene; instances are one level deep, and parts
// of few corners in many copies are copied out, because Embree then traces them faster.
#ifndef RAMIFY_RENDER_ACCEL_ACCEL_H
#define RAMIFY_RENDER_ACCEL_ACCEL_H

#include "base/run.h"
#include "render/light/emitter_set.h"
#include "render/material/bsdf.h"

typedef struct World World;
typedef struct Accel Accel;

// Small meshes (leaves, grass) copied out trace 1.3 times as fast as instanced one by one, but cost
// about 130 bytes a face, so the copies of all parts together are bounded. A large mesh is traced
// as well through its instances.
enum { ACCEL_COPY_FACES_LIMIT = 4000000, ACCEL_COPY_MESH_LIMIT = 256 };

typedef struct Ray {
    Vec3 origin, direction; // unit direction
    float far;              // m
    float slack;            // m: how far before `far` the glowing curves of `part`, toward which a
    int part;               // shadow ray goes, are not met; 0 = everything is
    uint32_t key;           // random: decides whether the ray passes half-transparent surfaces
} Ray;

typedef struct Hit {
    float t, u, v;
    Vec3 normal; // Embree's, in the part's own space, not unit
    uint32_t geometry, primitive;
} Hit;

// Is there an instruction set of this name? NULL is fine. ERROR_INPUT names those that there are.
bool accel_check_isa(const char *isa, Error *e);

// Builds. world and materials are borrowed. ERROR_MEMORY instead of a crash when Embree runs out.
// isa as for renderer_new.
Accel *accel_new(const World *world, const MaterialSet *materials, const char *isa, const Run *run,
                 Error *e);
void accel_free(Accel *accel); // NULL is fine

// The world's materials have other values, made ready as `materials`; their number is the same.
void accel_use_materials(Accel *accel, const MaterialSet *materials);

// Do rays still have to pass the same parts? If not, it must be built anew.
bool accel_fits_materials(const Accel *accel);

int64_t accel_bytes(const Accel *accel); // held by Embree
Aabb accel_bounds(const Accel *accel);   // of everything; empty when there is nothing

// To be called around tracing in every thread: denormal numbers as zero. Returns the old state.
unsigned accel_thread_begin(void);
void accel_thread_end(unsigned state);

bool accel_intersect(const Accel *accel, const Ray *ray, Hit *hit);

// The same for up to PACKET_SIZE rays that start and go nearly alike, together: faster. They have
// no slack, and there is at least one. met[i] is false where ray i meets nothing.
enum { PACKET_SIZE = 8 };
void accel_intersect_packet(const Accel *accel, const Ray *const ray[], int count, Hit hit[],
                            bool met[]);

bool accel_occluded(const Accel *accel, const Ray *ray);

// Index of the light that was hit; -1 when it was a part.
int accel_light(const Accel *accel, const Hit *hit);

// Which piece of the geometry was hit.
SurfacePlace accel_place(const Accel *accel, const Hit *hit);

// Fills everything but footprint.
void accel_surface(const Accel *accel, const Ray *ray, const Hit *hit, SurfacePoint *point);

#endif
