// The waves of a sea's tile: each has its amplitude by the spectrum, a random phase and its
// frequency. Private to objects/sea.
#ifndef RAMIFY_OBJECTS_SEA_TILE_MODES_H
#define RAMIFY_OBJECTS_SEA_TILE_MODES_H

#include "base/fft.h"
#include "objects/sea/tile.h"

// A wave of a tile at time 0, and its frequency. Waves beyond the band have no amplitude.
typedef struct WaveMode {
    Complex amplitude; // m
    double omega;      // rad/s
    double kx, kz, k;  // 1/m
    double breaks;     // 0..1: share of it in what breaks
} WaveMode;

enum { SEA_MOST_NUMBER = SEA_TILE_SIDE / 4, SEA_MODES = 2 * SEA_MOST_NUMBER + 1 };

// The waves of a tile whose size and angle are set, with those of the great wave if it has them:
// SEA_MODES a side, of numbers -SEA_MOST_NUMBER .. SEA_MOST_NUMBER, row by row. To be freed. The
// same bits for any number of threads.
WaveMode *sea_modes(const SeaTile *with, const WaveTile *tile, Error *e);

// The coefficient of exp(i k x) at a time: that wave and the one that runs against it.
Complex wave_coefficient(const WaveMode *with, const WaveMode *against, double time);

// The factor on that coefficient for a channel.
Complex wave_factor(const WaveMode *mode, int channel);

// Standard deviation of the crowding of all modes of a tile.
double wave_modes_crowding(const WaveMode *modes);

#endif
