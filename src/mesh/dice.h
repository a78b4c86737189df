// Dices a mesh where a rule asks for short edges, and displaces it along its normals. Between its
// vertices the surface is taken as the smooth one that their normals tell of, so the dice of a
// limit surface lie on it to fourth order. An edge is halved by what lies at its two ends alone,
// and a vertex is displaced once for all faces around it: there are no cracks, wherever rates
// differ.
#ifndef RAMIFY_MESH_DICE_H
#define RAMIFY_MESH_DICE_H

#include "base/mesh.h"
#include "base/run.h"

// A point of the smooth surface.
typedef struct DicePoint {
    Vec3 position, normal;
    Vec3 along; // unit: the way in which v of the UVs grows; 0 = unknown
    Vec2 uv, site;
    float shore;
    float radius, birth;
} DicePoint;

// What is wanted where. The functions must be symmetric and pure; they are called by several
// threads.
typedef struct DiceRule {
    // m: edges between such points that are longer are halved. INFINITY = none.
    float (*longest)(const void *user, const DicePoint *a, const DicePoint *b);
    // m along the normal. coarsening: edges are so many times as long as wanted, so relief that is
    // finer than they can show has to stay out. *share: how much of the relief that is, 0..1; 0 =
    // none, height 0.
    float (*height)(const void *user, const DicePoint *point, float coarsening, float *share);
    const void *user;
    int64_t most_faces; // beyond it, edges stay longer everywhere
} DiceRule;

// Arrays of mesh->vertex_count.
typedef struct DicedMesh {
    Mesh *mesh;      // of triangles, on the smooth surface, with the arrays of the given one; owned
    Vec3 *displaced; // position
    Vec3 *normal;    // unit, of the displaced surface
    Vec3 *along;     // see DicePoint
    float *share;    // see DiceRule
    float coarsening; // factor by which edges are longer than wanted, because of most_faces; >= 1
} DicedMesh;

// Fills *diced; diced->mesh stays NULL where the rule asks for nothing. The mesh needs normals.
// Clear *diced after a failure, too. Quads are split as the ray tracer does.
bool mesh_dice(const Mesh *mesh, const DiceRule *rule, const Run *run, DicedMesh *diced, Error *e);
void diced_mesh_clear(DicedMesh *diced);

// The middle of the smooth surface's edge between two points (a cubic by their normals).
DicePoint dice_middle(const DicePoint *a, const DicePoint *b);

#endif
