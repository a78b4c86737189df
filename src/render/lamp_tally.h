// The ways of photons, counted in the voxels of a box: their lengths in a voxel, over its volume,
// are the fluence in it (a track-length estimate: Lux and Koblinger 1991).
#ifndef RAMIFY_RENDER_LAMP_TALLY_H
#define RAMIFY_RENDER_LAMP_TALLY_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

// Voxels lie x first, then y, z last.
typedef struct LampBox {
    Vec3 low;
    float voxel; // m
    int count[3];
} LampBox;

// Of a voxel, in whole quanta: their sum does not depend on the order of the photons. 0 at first.
typedef struct LampTally {
    int64_t color[3];
    int64_t visits;
} LampTally;

int64_t lamp_box_voxels(const LampBox *box);

// Interpolates between the values of voxels at their middles.
Vec3 lamp_box_interpolate(const Vec3 *value, const LampBox *box, Vec3 p);

// Counts a photon's stretch of `far` m from a place on. Called from several threads.
void lamp_tally_stretch(LampTally *tally, const LampBox *box, Vec3 from, Vec3 direction, float far,
                        Vec3 color);

// A value for each voxel: what is counted, where few photons came through mixed with what is
// counted around it. scale: value of a length of 1 m in a voxel of 1 m3. The caller frees them.
Vec3 *lamp_tally_means(const LampTally *tally, const LampBox *box, float scale, Error *e);

#endif
