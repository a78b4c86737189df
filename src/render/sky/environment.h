// An HDR environment map as a dome.
#ifndef RAMIFY_RENDER_SKY_ENVIRONMENT_H
#define RAMIFY_RENDER_SKY_ENVIRONMENT_H

#include "base/run.h"
#include "render/sky/dome.h"
#include "render/sky/sky.h"

// Reads sky->file (latitude-longitude, linear Rec. 709) and applies the strength, but not the
// rotation. The middle of the picture lies at +Z. ERROR_INPUT names the file and the fault.
Dome *environment_dome(const Sky *sky, const Run *run, Error *e);

#endif
