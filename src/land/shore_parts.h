// Shared by the parts of the shore. Private to this folder.
#ifndef RAMIFY_LAND_SHORE_PARTS_H
#define RAMIFY_LAND_SHORE_PARTS_H

#include "land/shore.h"

// shore_waves.c
bool shore_waves_init(ShoreWaves *waves, const Landscape *land, Error *e);
void shore_waves_clear(ShoreWaves *waves);
// Finds the energy everywhere for the present front.
bool shore_find_waves(Shore *shore, const Landscape *land, Error *e);
// The waves at a place, in samples from the first; outside, those of the border.
typedef struct WavesAt {
    double energy, flux[2];
    double shore; // energy * focus where the shore is nearest
    double focus; // factor by which refraction gathers them: 1 on a straight shore
} WavesAt;
WavesAt shore_waves_at(const Shore *shore, const Landscape *land, double column, double row);

// shore_front.c: makes the front a distance again. room: of all samples.
void shore_measure_front(Shore *shore, const Landscape *land, double *room);

// shore_beach.c: fills shore->sand with the pool's sand, by so many halvings.
bool shore_find_beach(Shore *shore, const Landscape *land, int rounds, const Run *run, Error *e);
// m: width of the beach between the cliff and the berm; negative where there is none.
double shore_beach_width(const Shore *shore, const WavesAt *waves);

#endif
