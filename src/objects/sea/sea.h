// A sea: waves by the spectrum of the wind, as one mesh to the horizon.
#ifndef RAMIFY_OBJECTS_SEA_SEA_H
#define RAMIFY_OBJECTS_SEA_SEA_H

#include "base/waves.h"
#include "land/height_field.h"
#include "objects/common/recipe.h"
#include "objects/sea/spectrum.h"

typedef struct SeaParams {
    float wind;         // m/s, 10 m above the water
    float wind_azimuth; // degrees clockwise from north (-z): where the wind comes from
    float fetch;        // m over which it has blown
    float depth;        // m, of the open sea; 0 = deep
    float level;        // m: y of the calm surface
    float choppiness;   // of the horizontal displacement
    float foam;         // factor on what whitecaps and surf cover
    float swash;        // 0..1: foam where water runs out on the shore
    float breakers;     // how far crests that break fall forward, in their heights
    float drops;        // factor on the drops that these throw up
    float time;         // s
    float crest[2];     // m: x and z of a great wave's crest at rest ...
    float crest_height; // m, above the calm surface; 0 = none ...
    float crest_time;   // s: ... and when it is there
    char *bed;          // name of the object that is the sea's bed and shore; NULL = none
    float center[2];    // m: x and z of the mesh's finest place
    bool center_given;  // else under the camera
    float extent;       // m: radius of the mesh
    float finest;       // m: its cells at the center
    int spokes;         // cells around the center
} SeaParams;

SeaParams sea_params_default(void);

extern const struct Table sea_table; // of its parameters

// Unit, in plan (x, z): whereto the waves run.
Vec2 sea_way(const SeaParams *params);

// The spectrum and the waves of a sea without a shore. The caller frees them with waves_free. The
// same bits for any number of threads.
WaveSpectrum sea_spectrum(const SeaParams *params);
Waves *sea_waves(const SeaParams *params, uint64_t seed, const Run *run, Error *e);

// What the bed makes of these waves. land: heights of the bed. Owned by the caller, as
// Waves.shore.
WavesShore *sea_shore(const SeaParams *params, const HeightField *land, const Waves *waves,
                      const Run *run, Error *e);

// The surface, without what lies well above water. eye: the camera, or NULL. Takes ownership of the
// waves, also on failure.
Mesh *sea_mesh(const SeaParams *params, const Vec3 *eye, Waves *waves, const Run *run, Error *e);

// In plan: about which place the mesh is finest. eye: the camera, or NULL.
Vec2 sea_center(const SeaParams *params, const Vec3 *eye);

bool sea_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
bool sea_measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                 Error *e);

#endif
