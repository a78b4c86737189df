// Shared by accel.c and accel_geometry.c (building) and accel_trace.c (tracing).
#ifndef RAMIFY_RENDER_ACCEL_ACCEL_INTERNAL_H
#define RAMIFY_RENDER_ACCEL_ACCEL_INTERNAL_H

#include "render/accel/accel.h"
#include "render/accel/accel_pairs.h"
#include "render/accel/accel_relief.h"
#include "render/world.h"

#include <embree3/rtcore.h>
#include <pthread.h>
#include <stdatomic.h>

enum AccelFilter { ACCEL_FILTER_ALPHA = 1, ACCEL_FILTER_THIN = 2, ACCEL_FILTER_GLOW = 4 };

// What one Embree geometry draws: a part, or those instances of it that have the same form.
typedef struct AccelPiece {
    const Accel *accel;
    const Part *part;
    int32_t number;          // of the part in the world
    const Mesh *mesh;        // that is drawn; NULL = round curves
    Mesh *tubes;             // owned: `mesh`, of thin curves; else NULL
    DicedMesh diced;         // its mesh is `mesh` if that is displaced
    uint64_t relief;         // of its material: see relief_key
    int64_t count;           // instances; 0 = drawn once
    uint32_t *which;         // owned: their numbers; NULL = all
    Pairs pairs;             // triangles that are drawn as quads
    RTCScene scene;          // of the first of a group (see build_group); NULL otherwise
    bool grouped;            // is in one
    const uint32_t *segment; // curves: first point of each segment; Embree's buffer
    float base_variation;    // of a part that is drawn once
    bool plain;              // a mesh without vertex attributes
    unsigned filters;        // that Embree calls: bits of AccelFilter
    unsigned traits;         // of its material; see form_traits
    bool copied;             // instances were copied out: primitive = instance * faces + face
} AccelPiece;

// Number in the part of the piece's i-th instance.
static inline uint32_t accel_instance(const AccelPiece *piece, int64_t i)
{
    return piece->which ? piece->which[i] : (uint32_t)i;
}

// The piece (of a group: the first) or lamp of an Embree geometry in the top scene.
typedef struct AccelEntry {
    int32_t piece;     // -1 = a light
    uint32_t instance; // or the light's index
} AccelEntry;

struct Accel {
    const World *world;
    const MaterialSet *materials;
    RTCDevice device;
    RTCScene scene;
    AccelPiece *piece;
    int32_t piece_count;
    bool has_quads;     // in some mesh
    Views views;        // these two only while building
    CameraFrame camera; // the only view, unless world->views has others
    AccelEntry *entry;
    int64_t entry_count, entry_capacity;
    int64_t copied_faces; // of instances copied out so far
    _Atomic int64_t bytes;
    int64_t bytes_limit;
    pthread_mutex_t lock; // of failure
    Error failure;        // the first that Embree reported
    const Run *run;       // only while building
    pthread_t builder;
};

// Corner vertices and weights at (u, v) of a face. Embree splits a quad into the triangles (0, 1,
// 3) and (2, 3, 1).
typedef struct Corners {
    uint32_t vertex[3];
    float weight[3];
} Corners;

static inline Corners accel_corners(const Mesh *mesh, int64_t face, float u, float v)
{
    const uint32_t *corner = mesh->index + face * mesh->face_size;
    if (mesh->face_size == 3) {
        return (Corners){{corner[0], corner[1], corner[2]}, {1.0f - u - v, u, v}};
    }
    if (u + v <= 1.0f) {
        return (Corners){{corner[0], corner[1], corner[3]}, {1.0f - u - v, u, v}};
    }
    return (Corners){{corner[2], corner[3], corner[1]}, {u + v - 1.0f, 1.0f - u, 1.0f - v}};
}

static inline Vec2 accel_uv(const Mesh *mesh, const Corners *c)
{
    Vec2 uv = {0.0f, 0.0f};
    for (int i = 0; i < 3 && mesh->uv; i++) {
        uv.x += c->weight[i] * mesh->uv[c->vertex[i]].x;
        uv.y += c->weight[i] * mesh->uv[c->vertex[i]].y;
    }
    return uv;
}

// Embree's geometry of the piece, not committed; sets piece->segment.
RTCGeometry accel_piece_geometry(AccelPiece *piece);
RTCGeometry accel_light_geometry(const Accel *accel, const Light *light);

// Embree filter: accepts or rejects hits at random by the alpha texture.
void accel_alpha_filter(const struct RTCFilterFunctionNArguments *arguments);

// Embree filter for shadow rays: lets a ray pass a thin film at random, with probability 1 -
// material_shadow_opacity.
void accel_thin_filter(const struct RTCFilterFunctionNArguments *arguments);

// Embree filter for rays toward a glowing curve: rejects hits of its part within the ray's slack.
// Light samples lie on the cone of one segment, which overlaps its neighbours at bends, and Embree
// reports hits of slender segments early (by about 1e-7 length^2 / radius).
void accel_glow_filter(const struct RTCFilterFunctionNArguments *arguments);

// Data of a ray for the filters.
typedef struct AccelContext {
    struct RTCIntersectContext embree; // first: Embree hands its address on
    float from;                        // m along the ray: from there its part is not met
    int part;
} AccelContext;

#endif
