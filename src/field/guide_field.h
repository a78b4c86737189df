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
    FIELD_UNIFORM,   // along `vector` everywhere: a tropism
    FIELD_RADIAL,    // away from `center`
    FIELD_VORTEX,    // about the axis `vector` through `center`
    FIELD_NUCLEI,    // away from the nearest nucleus, rotated about the normal by `turn` (Tanaka
                     // eq. (9)-(12))
    FIELD_GRID,      // FIELD_NUCLEI sampled on a sparse voxel grid, trilinear between voxels
                     // (Tanaka 4.4)
    FIELD_CURL,      // direction of divergence-free noise of wavelength `scale`
    FIELD_CURVATURE, // along the envelope's lines of curvature, on the side of `vector`
    FIELD_VOLUME,    // the vectors of a grid in a file, or the way up the values of a scalar one
    FIELD_POINT      // control point: along `vector` at `center`, falling to 0 at distance `scale`
} FieldKind;

typedef enum FieldProfile {
    PROFILE_SWEPT,    // local angle grows so that a streamline sweeps `turn` from nucleus to rim
    PROFILE_CONSTANT, // every vector is rotated by `turn`, as Tanaka eq. (10) is written
    PROFILE_GROWN     // rotated further than PROFILE_SWEPT, so that growth, which attractors pull
                      // outward, sweeps `turn`
} FieldProfile;

typedef enum NucleusKind { NUCLEUS_POINT, NUCLEUS_LINE, NUCLEUS_SURFACE } NucleusKind;

// A nucleus named by the user, in place of the initial nodes.
typedef struct Nucleus {
    NucleusKind kind;
    Vec3 position; // m; of a line: its start
    Vec3 end;      // m, of a line
    Vec3 normal;   // rotation axis, any length; zero = a line's direction, otherwise +Y
    Shape *shapes; // of a surface
    int shape_count;
} Nucleus;

typedef struct FieldParams {
    FieldKind kind;
    float weight; // share in a sum of fields

    Vec3 vector, center;
    bool centered; // center was given explicitly, not taken from the object's origin
    float scale;   // m: FIELD_CURL: wavelength; FIELD_POINT: falloff distance; FIELD_VOLUME: the
                   // file's unit
    uint64_t seed; // FIELD_CURL

    // FIELD_NUCLEI and FIELD_GRID. The rotation axis is the surface normal if `surface` is set,
    // otherwise `vector`, otherwise (if that is zero) the normal of the nearest nucleus. It need
    // not be unit: a longer one rotates further.
    Nucleus *nucleus;  // borrowed
    int nucleus_count; // 0 = the initial nodes
    float turn;        // degrees
    FieldProfile profile;
    float pull;     // PROFILE_GROWN: outward pull of the attractors relative to this field's
    float rim;      // m: distance of the rim from the nucleus; 0 = the farthest side of the
                    // attractors' bounds
    bool spherical; // swept angle depends on the polar angle on the sphere about `center`,
                    // atan(t sin(phi) / pi), instead of on the distance, atan(t r / rim)
    bool surface;   // stay in the tangent plane of the attractors' surface and rotate about its
                    // normal; a grid has no normals where it is sampled: it rotates as without
                    // `surface`, and its vectors are projected into the tangent plane
    int resolution; // FIELD_GRID: voxels along the longest side; 0 = 48, at most 2048

    // FIELD_CURVATURE
    bool least; // along the least principal curvature, not the greatest

    // FIELD_VOLUME
    const char *file, *grid; // .vdb, and a name in it (NULL = the first); borrowed
    Vec3 position, rotation; // m, degrees: of the file's space, scaled by `scale`
    Transform from_file;     // made of them
} FieldParams;

// Where fields act. Used by guide_field_new alone, which copies what fields need later.
typedef struct FieldSite {
    const Vec3 *nuclei;  // positions of the initial type-0 nodes; not for fields that name nuclei
    const Vec3 *normals; // of them, unit; NULL = +Y
    int64_t nucleus_count;
    Aabb bounds;              // region of the attractors
    const Envelope *envelope; // FIELD_CURVATURE: its surface; NULL = none
} FieldSite;

// The `pull` of a field in growth with this ColonizeParams.field_weight, where the attractors' pull
// has the length 1; 0 if the field does not lead outward.
static inline float field_params_pull(const FieldParams *params, float field_weight)
{
    float weight = field_weight * params->weight;
    return weight > 0.0f ? 1.0f / weight : 0.0f;
}

// Weight 1, vector +Y (0 for nuclei and grid), swept profile, scale 1.
FieldParams field_params_default(FieldKind kind);

// The sum of `count` fields with their weights. ERROR_INPUT for non-finite numbers, a scale that is
// not positive where one is needed, a nuclei field without nuclei, a curvature field without an
// envelope, or a file that cannot be read. Free with guide_field_free.
GuideField *guide_field_new(const FieldParams *params, int count, const FieldSite *site,
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
