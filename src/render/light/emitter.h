// One emitting piece of geometry: a triangle, the side of a segment of a round curve, or the
// rounded end of a curve. Each can be sampled from a point and evaluated where a ray hits it.
// Curves and closed bodies emit outward, sheets to both sides.
#ifndef RAMIFY_RENDER_LIGHT_EMITTER_H
#define RAMIFY_RENDER_LIGHT_EMITTER_H

#include "render/light/light_tree.h"

typedef enum EmitterKind { EMITTER_TRIANGLE, EMITTER_CONE, EMITTER_CAP } EmitterKind;

typedef struct Emitter {
    EmitterKind kind;
    bool two_sided;         // of a triangle; if not, it shines to the side of b x c
    int part;               // of the world's geometry
    Vec3 a;                 // a corner; the middle of the cone's first circle; the ball's centre
    Vec3 b;                 // edge from a; to the middle of the second circle; unit axis, outward
    Vec3 c;                 // the other edge from a; unused otherwise
    float radius0, radius1; // of the circles; of the ball
    float tilt;             // cone: sine by which its normals lean along b
    float glow0, glow1;     // factors on the radiance at both ends
} Emitter;

// If not two_sided, it emits to the side from which a, b, c turn counter-clockwise.
Emitter emitter_triangle(Vec3 a, Vec3 b, Vec3 c, bool two_sided, int part);

// The side of a segment between two balls as Embree draws it: the cone tangent to both. If one ball
// contains the other, the cone has no area and is never sampled.
Emitter emitter_cone(Vec3 from, Vec3 to, float radius0, float radius1, float glow0, float glow1,
                     int part);

// The half ball at a curve's end; axis: unit, out of the curve.
Emitter emitter_cap(Vec3 center, float radius, Vec3 axis, float glow, int part);

// luminance: of the material's radiance.
LightBounds emitter_bounds(const Emitter *emitter, float luminance);

typedef struct EmitterSample {
    Vec3 position;
    Vec3 normal;       // unit, of the surface there, on the side that is seen
    Vec3 direction;    // unit, toward it
    float distance;    // m
    float extent;      // m, of the emitter
    float slack;       // m: how far before it the curve that it lies on may be in between
    float glow;        // factor on the material's radiance
    float pdf;         // per steradian
    Vec3 pivot;        // as emitter_pivot gives it
    float pivot_ratio; // density of the pivot as emitter_pivot draws it over that of this sample
} EmitterSample;

// Does the emitter emit toward `from`? A curve does if the point is outside of it and in front of
// the side or end. An emitter that faces away is never sampled and shows no glow.
bool emitter_faces(const Emitter *emitter, Vec3 from);

// Samples a point of the emitter as seen from `from`; false if none is visible.
bool emitter_sample(const Emitter *emitter, Vec3 from, const float u[2], EmitterSample *sample);

// For scattering in a medium: a pivot on the emitter is drawn before the point that it lights is
// known, then the rest from that point. u must be the same in both calls.
Vec3 emitter_pivot(const Emitter *emitter, const float u[2]);
bool emitter_sample_pivoted(const Emitter *emitter, Vec3 from, const float u[2],
                            EmitterSample *sample);

// The density with which emitter_sample would draw `position`, where a ray from `from` hit the
// emitter from its front; 0 for a segment without a side, which is never drawn.
float emitter_pdf(const Emitter *emitter, Vec3 from, Vec3 position);

// A place on the emitter from which light leaves, drawn without regard to who sees it.
typedef struct EmissionSpot {
    Vec3 position, normal; // unit, of the side from which it leaves
    float extent;          // m, of the emitter
    float glow;            // factor on the material's radiance
    float area;            // m^2: 1 / density of the place, both sides of a sheet counted
} EmissionSpot;

// side: uniform; chooses the side of a sheet.
EmissionSpot emitter_emit(const Emitter *emitter, const float u[2], float side);

#endif
