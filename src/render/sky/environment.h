// An HDR picture of the surroundings as a dome.
#ifndef RAMIFY_RENDER_SKY_ENVIRONMENT_H
#define RAMIFY_RENDER_SKY_ENVIRONMENT_H

#include "render/sky/dome.h"
#include "render/sky/sky.h"

// Reads sky->file (latitude-longitude, linear Rec. 709) and applies the strength, not the
// rotation. The picture's middle lies at +Z. ERROR_INPUT names the file and what is wrong.
Dome *environment_dome(const Sky *sky, Error *e);

#endif
