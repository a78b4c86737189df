// Cached world and renderer, updated per frame.
#ifndef RAMIFY_ANIMATE_STAGE_H
#define RAMIFY_ANIMATE_STAGE_H

#include "render/renderer.h"
#include "scene/builder.h"

typedef struct StageStats {
    BuildStats build;     // totals so far; geometry as it is now
    double build_seconds; // acceleration structures and lights
    int geometries;       // number of times geometry was grown or skinned
    int structures;       // number of times acceleration structures were built from scratch
} StageStats;

typedef struct Stage Stage;

// camera: of the scene at rest. View-dependent geometry and light (level of detail of land, the
// sun's caustics under water) use it for all frames, so that they do not flicker and frames do not
// depend on earlier ones. isa: as for renderer_new, borrowed. remember: as for scene_builder_new.
Stage *stage_new(const Camera *camera, const char *isa, bool remember, Error *e);
void stage_free(Stage *stage); // NULL is fine

// views: of all frames, so that the detail of leaves, grass and twigs suits each of them and stays
// the same; borrowed. Without this call, detail suits the first scene that is set up.
void stage_see_from(Stage *stage, const Views *views);

// Sets up a scene. Takes ownership of it, even on failure, after which the stage can only be freed.
bool stage_set(Stage *stage, Scene *scene, const Run *run, Error *e);

// Renders the current scene; see renderer_render.
bool stage_render(Stage *stage, Film *film, const Run *run, RenderStats *stats, Error *e);

// Goes on with the samples that the film holds; see renderer_resume.
bool stage_resume(Stage *stage, Film *film, const Run *run, RenderPass *pass, double every,
                  void *user, RenderStats *stats, Error *e);

const StageStats *stage_stats(const Stage *stage);

#endif
