// The sky for other programs: a picture of all directions, and the sun apart from it.
#ifndef RAMIFY_EXPORT_SKY_BAKE_H
#define RAMIFY_EXPORT_SKY_BAKE_H

#include "base/run.h"
#include "image/image.h"
#include "render/sky/sun_sky.h"

typedef struct BakedSky {
    Image *image; // owned; red, green, blue: radiance, latitude-longitude as OpenEXR has it (+Y up,
                  // +Z in the middle, +X left of it). NULL where the sky is black, of one colour,
                  // or a picture already (SKY_ENVIRONMENT)
    Sun sun;      // or the moon; radiance 0 where there is none
} BakedSky;

// Bakes daylight and night without clouds and stars, which only the camera sees. The picture is
// width x width / 2 pixels.
bool sky_bake(const Sky *sky, int width, const Run *run, BakedSky *baked, Error *e);
void baked_sky_clear(BakedSky *baked);

#endif
