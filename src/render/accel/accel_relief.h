// Relief as geometry: a part's mesh diced where the views see its material's relief.
#ifndef RAMIFY_RENDER_ACCEL_ACCEL_RELIEF_H
#define RAMIFY_RENDER_ACCEL_ACCEL_RELIEF_H

#include "mesh/dice.h"
#include "mesh/geometry.h"
#include "render/camera.h"
#include "render/material/bsdf.h"

typedef struct ReliefView {
    const Views *views;
    const CameraFrame *frame; // of the only view: what it does not show is coarse; NULL = unknown
    int width, height;        // of its picture, in pixels
    const Material *material; // by number
    const MaterialSet *set;
} ReliefView;

// Fills *diced; its mesh is NULL if the part is instanced, has no relief or no view sees it. A
// warning tells if the limit on faces makes it coarse. Clear *diced after a failure, too.
bool accel_relief_dice(const ReliefView *view, const Part *part, const Run *run, DicedMesh *diced,
                       Error *e);

#endif
