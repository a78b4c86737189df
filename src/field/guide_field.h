// Guide vector fields (Tanaka eq. (9)-(13)): position and normal -> vector. Built once, before
// growth.
#ifndef RAMIFY_FIELD_GUIDE_FIELD_H
#define RAMIFY_FIELD_GUIDE_FIELD_H

#include "base/run.h"
#include "shape/envelope.h"

#include <stdint.h>

typedef struct GuideField GuideField; // immutable; evaluated from many threads

// Each kind gives a unit vector (FIELD_POINT: times a falloff; zero where no direction is defined).
typedef enum FieldKind {
    FIELD_UNIFORM, // along `vector` everywhere: a tropism
    FIELD_RADIAL,  // away from `center`
    FIELD_VORTEX,  // about the axis `vector` through `center`
    FIELD_NUCLEI,  // away from the nearest initial node, rotated about the normal by `turn` (Tanaka
                   // eq. (9)-(12))
    FIELD_GRID,    // FIELD_NUCLEI sampled on a sparse voxel grid, trilinear between voxels
                   // (Tanaka 4.4)
    FIELD_CURL,    // direction of divergence-free noise of wavelength `scale`
    FIELD_POINT    // control point: along `vector` at `center`, falling to 0 at distance `scale`
} FieldKind;

typedef enum FieldProfile {
    PROFILE_SWEPT,   // local angle grows so that a streamline sweeps `turn` from nucleus to rim
    PROFILE_CONSTANT // every vector is rotated by `turn`, as Tanaka eq. (10) is written
} FieldProfile;

// Rotation axis of nuclei and grid fields: the surface normal if `surface` is set, else `vector`,
// else (if that is zero) the axis from the nearest nucleus. The axis need not be unit: a longer one
// rotates further.
typedef struct FieldParams {
    FieldKind kind;
    float weight; // share in a sum of fields
    Vec3 vector, center;
    bool centered; // center was given explicitly, not taken from the object's origin
    float turn;    // degrees
    float scale; // m; wavelength or falloff distance; nuclei and grid: distance of the rim from the
                 // nucleus, 0 = the farthest side of the attractors' bounds
    FieldProfile profile;
    bool spherical; // swept angle depends on the polar angle on the sphere about `center`, atan(t
                    // sin(phi) / pi), instead of on the distance, atan(t r / rim)
    bool surface;   // stay in the tangent plane of the attractors' surface and rotate about its
                    // normal
    uint64_t seed;
    int resolution; // FIELD_GRID: voxels along the longest side; 0 = 48, at most 2048
} FieldParams;

// Weight 1, vector +Y, swept profile; scale 1 (0 for nuclei and grid).
FieldParams field_params_default(FieldKind kind);

// nuclei: positions and unit normals of the initial type-0 nodes, copied. bounds: the region of the
// attractors. params: `count` fields, summed with their weights. ERROR_INPUT for non-finite
// numbers, a scale that is not positive where one is needed, or a nuclei field without nuclei. Free
// with guide_field_free.
GuideField *guide_field_new(const FieldParams *params, int count, const Vec3 *nuclei,
                            const Vec3 *nucleus_normals, int64_t nucleus_count, Aabb bounds,
                            const Run *run, Error *e);
void guide_field_free(GuideField *field); // NULL is fine

// X_f at p for a node with (surface) normal n: unit for a single field of weight 1, otherwise the
// weighted sum.
Vec3 guide_field_at(const GuideField *field, Vec3 p, Vec3 n);

// Adds the field to the file's grids as vectors, sampled within the envelope and a small margin
// with `resolution` voxels along its longest side. Fields on a surface are sampled with the
// gradient of the envelope's distance as normal.
bool guide_field_add_to(const GuideField *field, const Envelope *envelope, int resolution,
                        const char *name, GridFile *grids, const Run *run, Error *e);

#endif
