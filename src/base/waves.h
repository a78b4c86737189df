// The waves of a sea as periodic tiles of displacement, summed at any place: for the mesh of its
// surface and for the pattern that shows what is finer than the mesh.
//
// A place is that of a parcel of water at rest (x, z); its displacement is horizontal and vertical
// (Tessendorf, "Simulating Ocean Water", SIGGRAPH 2001). Tiles hold bands of wavelengths of their
// own, so that their sum counts none twice, and lie at angles of their own, so that no repetition
// falls together. Near a shore the waves are refracted by a shift along their way, shoal and break
// (WavesShore).
#ifndef RAMIFY_BASE_WAVES_H
#define RAMIFY_BASE_WAVES_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

enum { WAVES_TILES = 3, WAVES_LEVELS = 8, WAVES_BANDS = 96 };

// What a tile tells at a texel.
enum {
    WAVE_HEIGHT,  // m
    WAVE_ASIDE_X, // m, horizontal displacement
    WAVE_ASIDE_Z,
    WAVE_SLOPE_X, // of the height
    WAVE_SLOPE_Z,
    WAVE_STRETCH_XX, // derivatives of the horizontal displacement
    WAVE_STRETCH_ZZ,
    WAVE_STRETCH_XZ,
    WAVE_CROWDING, // by how much the waves that break draw water together
    WAVE_TRAIL,    // the greatest crowding of the last seconds, less its age
    WAVE_SPILL, // that of the next moments, less the time until then: a crest is about to roll in
    WAVE_FOAM,  // 0..1: what is left of the foam of the last crest that broke there
    WAVE_CHANNELS
};

// One band of wavelengths on a square that repeats. Level l has side >> l samples a side and waves
// of four samples or more.
typedef struct WaveTile {
    float size;         // m
    float cosine, sine; // of the angle of its rows with x
    float longest;      // m: the longest wave of its band
    int side;           // samples, a power of two
    int levels;
    float *texel[WAVES_LEVELS]; // owned; WAVE_CHANNELS a sample, row by row
} WaveTile;

// What the bed makes of the waves, on a grid over it; beyond the grid, as on its rim.
typedef struct WavesShore {
    int columns, rows;
    float cell;      // m
    Vec2 origin;     // m: x and z of sample (0, 0)
    float *depth;    // m of still water; negative on land
    float *share;    // of the height that each tile has in deep water: WAVES_TILES a sample
    float *shift;    // m along the way of the waves, by which they lag: WAVES_TILES a sample
    float *breaking; // 0..1: share of the waves that break
    float *drift;    // 0..1: the same, spread as far as old foam drifts from the surf
} WavesShore;

typedef struct Waves {
    WaveTile tile[WAVES_TILES];
    Vec2 way;         // unit: whereto the waves run, in plan
    float choppiness; // of the horizontal displacement; 1 = that of the water
    float foam;       // crowding from which waves break
    float spread;     // of the crowding: its standard deviation
    float shortest;   // m: the shortest wave of all tiles
    float breakers;   // 0..: by how much of their height crests that break fall forward
    float streaks;    // share of the sea that foam covers in lines along the wind
    float swash;      // 0..1: how white the edge of the water on its shore is
    // Variance of the slopes of all waves shorter than 2^(WAVES_BAND_FIRST + i / 4) m, summed over
    // both axes: what a surface without these has as roughness.
    float hidden[WAVES_BANDS];
    WavesShore *shore; // owned; NULL = deep water everywhere
} Waves;

#define WAVES_BAND_FIRST (-10.0f)

void waves_free(Waves *waves); // NULL is fine
void waves_shore_free(WavesShore *shore);

// Mean square of a channel (WAVE_*) over the tile.
double waves_mean_square(const WaveTile *tile, int channel);

// The surface at a parcel's place.
typedef struct WavePoint {
    Vec3 displacement; // m; y = the height above the calm surface
    Vec3 normal;       // unit
    Vec2 place;        // m: x and z of the parcel at rest
    float width;       // m: as asked for
    float crowding;    // of the waves, of the last seconds, and of the next moments
    float trail;
    float spill;
    float left;       // 0..1: what is left of the foam of the last crest that broke there
    float breaking;   // 0..1: of the surf
    float drift;      // 0..1: how near the surf is
    float depth;      // m of still water; INFINITY without a shore
    float roughness2; // variance of the slopes that are left out, summed over both axes
} WavePoint;

// What a crest that breaks adds to the displacement at a parcel's place: water that is thrown ahead
// along the way of the waves, falls, and boils in lumps of no less than twice `width` m. sum: the
// channels (WAVE_*) there. Zero where the crowding is below that from which waves break.
Vec3 waves_thrown(const Waves *waves, float x, float z, float width,
                  const float sum[WAVE_CHANNELS]);

// Leaves out waves shorter than twice `width` m.
void waves_at(const Waves *waves, float x, float z, float width, WavePoint *point);

// Foam about a point, before its lace; each 0..1.
typedef struct WaveFoam {
    float cover;   // share of the surface that it hides
    float fresh;   // how much of it is the thick roller of a crest that breaks now; the rest is old
    float bubbles; // how full of bubbles the water below it is
} WaveFoam;

// A roller lies on the front of its crest down to a ragged edge; behind it foam thins out with its
// age; in a strong wind some of it drifts in lines along the wind (Langmuir 1938). Where water runs
// out on a shore, a lip of froth lies on its edge and lace on the sheet behind it.
WaveFoam waves_foam(const Waves *waves, const WavePoint *point);

// Depth of still water (m) by the grid; negative on land.
float waves_depth(const WavesShore *shore, float x, float z);

#endif
