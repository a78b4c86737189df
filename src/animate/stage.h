// What is set up to be filmed: the world and its renderer, which frame after frame change only as
// much as the scene does.
#ifndef RAMIFY_ANIMATE_STAGE_H
#define RAMIFY_ANIMATE_STAGE_H

#include "render/renderer.h"
#include "scene/builder.h"

typedef struct StageStats {
    BuildStats build;     // of everything so far, geometry as it is now
    double build_seconds; // acceleration structures and lights
    int geometries;       // how often there was geometry to be grown or skinned
    int structures;       // how often acceleration structures were built from nothing
} StageStats;

typedef struct Stage Stage;

// camera: of the scene as it is when nothing moves. What is made for one point of view (the detail
// of land, the sun's network under water) is made for this one, so that it stays still and a frame
// does not depend on those before. isa: as for renderer_new, borrowed. remember: as for
// scene_builder_new.
Stage *stage_new(const Camera *camera, const char *isa, bool remember, Error *e);
void stage_free(Stage *stage); // NULL is fine

// Sets up a scene, which it takes (also when it fails). After a failure the stage can only be
// freed.
bool stage_set(Stage *stage, Scene *scene, const Run *run, Error *e);

// Renders what is set up; see renderer_render.
bool stage_render(Stage *stage, Film *film, const Run *run, RenderStats *stats, Error *e);

const StageStats *stage_stats(const Stage *stage);

#endif
