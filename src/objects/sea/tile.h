// Synthesis of one of a sea's tiles. Private to objects/sea.
#ifndef RAMIFY_OBJECTS_SEA_TILE_H
#define RAMIFY_OBJECTS_SEA_TILE_H

#include "objects/sea/sea.h"

enum { SEA_TILE_SIDE = 512 }; // samples

typedef struct SeaTile {
    const SeaParams *params;
    WaveSpectrum spectrum;
    double low, high; // 1/m: the band of wave numbers
    double breaker;   // m: the shortest wave that breaks
    double breaking;  // standard deviations of the crowding from which they do
    bool trails;      // does its foam last?
    bool has_crest;   // are its waves those of the great wave?
    uint64_t key;
    const Run *run;
} SeaTile;

// Fills the levels of a tile whose size, angle and side are set. They belong to the tile, also on
// failure. The same bits for any number of threads.
bool sea_tile_fill(const SeaTile *with, WaveTile *tile, Error *e);

#endif
