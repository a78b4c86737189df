// Participating media: absorption and scattering, density along a ray, and the Henyey-Greenstein
// phase function.
//
// Lengths along a ray are counted in metres, and as metres at density 1 ("length" below), by which
// every medium is homogeneous.
#ifndef RAMIFY_RENDER_MEDIUM_MEDIUM_H
#define RAMIFY_RENDER_MEDIUM_MEDIUM_H

#include "base/vec.h"

typedef enum MediumKind {
    MEDIUM_NONE,
    MEDIUM_EVERYWHERE, // in a ball about the scene
    MEDIUM_WATER,      // under the plane y = height: water
    MEDIUM_LAYER       // density 1 under that plane, falling off exponentially above: fog
} MediumKind;

// The medium of a scene: everything outside of bodies.
typedef struct Medium {
    MediumKind kind;
    Vec3 scattering, absorption; // per metre, where the density is 1
    float anisotropy;            // mean cosine of scattering, -1..1
    float height;                // m; MEDIUM_WATER and MEDIUM_LAYER
    float falloff;               // m over which the density falls to 1/e; MEDIUM_LAYER
    float caustics;              // MEDIUM_WATER: strength of the sun's network of light, 0..1
    float wavelength;            // MEDIUM_WATER: m, of the waves; 0 = a third of the depth
    float swell;                 // MEDIUM_WATER: m, length of the longest waves; 0 = no longer ones
    float extent;                // m, radius; MEDIUM_EVERYWHERE; 0 = three times the scene's
} Medium;

Medium medium_default(MediumKind kind);

// The medium around a path.
typedef struct Filling {
    Vec3 extinction, scattering; // per metre
    float anisotropy;
    bool present, scatters; // any extinction; any scattering
} Filling;

Filling filling_of(Vec3 scattering, Vec3 absorption, float anisotropy);

// Density rho0 exp(-rate (t - near)) between near and far.
typedef struct MediumPiece {
    float near, far, rho0, rate;
    float length; // of all of it
} MediumPiece;

// The density along a ray: up to two consecutive pieces; zero before and after them.
typedef struct MediumLine {
    MediumPiece piece[2];
    int count;
    float length;
} MediumLine;

enum { MEDIUM_LONGEST = 1000000000 }; // no length is greater

// Inside a body: density 1 from 0 to far, which may be INFINITY.
MediumLine medium_line_inside(float far);

// In the scene's medium; center, radius: of MEDIUM_EVERYWHERE. No pieces if the ray misses it.
MediumLine medium_line(const Medium *medium, Vec3 center, float radius, Vec3 origin, Vec3 direction,
                       float far);

float medium_line_near(const MediumLine *line); // m; of a line with pieces
float medium_line_far(const MediumLine *line);

// Length from the ray's origin to t, the density at t, and the t of a length.
float medium_line_length(const MediumLine *line, float t);
float medium_line_density(const MediumLine *line, float t);
float medium_line_at(const MediumLine *line, float length);

Vec3 medium_transmittance(Vec3 extinction, float length);

// Draws the length to the next scattering event, with channels of these weights (sum 1). A length
// past `longest` means that the ray passes. *pdf: with respect to length, or the probability of
// passing.
float medium_draw_length(Vec3 extinction, Vec3 weight, float longest, float choice, float u,
                         float *pdf);

// The same, limited to `longest`; the pdf is a function of its own.
float medium_draw_within(Vec3 extinction, Vec3 weight, float longest, float choice, float u);
float medium_density_within(Vec3 extinction, Vec3 weight, float longest, float length);

// Henyey and Greenstein 1941, per steradian; cosine between the directions of travel.
float phase_density(float anisotropy, float cosine);
Vec3 phase_draw(float anisotropy, Vec3 direction, float u, float v);

#endif
