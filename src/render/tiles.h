// Passes over the tiles of a picture by all threads, with adaptive stopping, a time limit and
// progress.
#ifndef RAMIFY_RENDER_TILES_H
#define RAMIFY_RENDER_TILES_H

#include "render/integrator.h"
#include "render/renderer.h"

// renderer_resume with a filled tracer; does not set stats->memory.
bool tiles_render(const Tracer *tracer, Film *film, const Run *run, RenderPass *pass, double every,
                  void *user, RenderStats *stats, Error *e);

// renderer_look with a filled tracer.
bool tiles_look(const Tracer *tracer, Film *film, const Run *run, Error *e);

#endif
