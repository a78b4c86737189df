// The materials of a world made ready for shading. Private to the BSDF's files.
#ifndef RAMIFY_RENDER_MATERIAL_SET_H
#define RAMIFY_RENDER_MATERIAL_SET_H

#include "render/bsdf.h"

struct MaterialSet {
    int count;
    Material *material;
};

#endif
