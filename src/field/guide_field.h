// Guide vector fields (Tanaka et al., eq. (9)-(13)): position and node -> vector. Built once,
// before growth.
#ifndef RAMIFY_FIELD_GUIDE_FIELD_H
#define RAMIFY_FIELD_GUIDE_FIELD_H

#include "base/run.h"
#include "shape/envelope.h"

#include <stdint.h>

typedef struct GuideField GuideField; // immutable once made; safe to evaluate from many threads

// Each is a unit vector (times a falloff for FIELD_POINT; zero where no direction is defined).
typedef enum FieldKind {
    FIELD_UNIFORM, // along `vector` everywhere: a tropism
    FIELD_RADIAL,  // away from `center`
    FIELD_VORTEX,  // about the axis `vector` through `center`
    FIELD_NUCLEI,  // the papers': away from the nearest initial node, turned about the normal by
                   // `turn`
    FIELD_GRID,    // FIELD_NUCLEI sampled on a sparse voxel grid, trilinear between voxels
                   // (Tanaka 4.4)
    FIELD_CURL,    // direction of divergence-free noise of wavelength `scale`
    FIELD_POINT    // control point: along `vector` at `center`, falling to 0 at distance `scale`
} FieldKind;

typedef enum FieldProfile {
    PROFILE_SWEPT,   // local angle grows so that a streamline sweeps `turn` from nucleus to rim
                     // (design section 3)
    PROFILE_CONSTANT // the literal quaternion: every vector is turned by `turn`
} FieldProfile;

// A field turned about an axis (nuclei, grid) takes it from the surface normal when `surface` is
// set, else from `vector`, else, when that is zero, from the nearest nucleus. The axis need not be
// unit: a longer one turns further.
typedef struct FieldParams {
    FieldKind kind;
    float weight; // share in a sum of fields
    Vec3 vector, center;
    bool centered; // center is a place that the scene names, not just the object's origin
    float turn;    // degrees
    float scale; // m; nuclei and grid: distance of the rim from the nucleus, 0 = the farthest side
                 // of the attractors' bounds
    FieldProfile profile;
    bool spherical; // swept angle by polar angle on the sphere about `center`, atan(t sin(phi) /
                    // pi), instead of by distance, atan(t r / rim)
    bool surface; // keep to the tangent plane of the attractors' surface and turn about its normal
    uint64_t seed;
    int resolution; // FIELD_GRID: voxels along the longest side; 0 = 48, at most 2048
} FieldParams;

// Weight 1, vector +Y, swept; scale 1, for nuclei and grid 0.
FieldParams field_params_default(FieldKind kind);

// nuclei: positions and unit normals of the initial type-0 nodes, copied. bounds: the region of the
// attractors. params: `count` fields, summed with their weights. ERROR_INPUT for numbers that are
// not finite, a scale that is not positive where one is needed, nuclei fields without nuclei.
GuideField *guide_field_new(const FieldParams *params, int count, const Vec3 *nuclei,
                            const Vec3 *nucleus_normals, int64_t nucleus_count, Aabb bounds,
                            const Run *run, Error *e);
void guide_field_free(GuideField *field); // NULL is fine

// X_f at p for a node whose (surface) normal is n; unit for a single field of weight 1, the
// weighted sum otherwise.
Vec3 guide_field_at(const GuideField *field, Vec3 p, Vec3 n);

// Adds the field as vectors to the grids of a file: within the envelope and a little about it, at
// `resolution` voxels along its longest side. Fields that keep to a surface are sampled for nodes
// whose normal is the gradient of the envelope's distance.
bool guide_field_add_to(const GuideField *field, const Envelope *envelope, int resolution,
                        const char *name, GridFile *grids, const Run *run, Error *e);

#endif
