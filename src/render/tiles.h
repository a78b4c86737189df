// Passes over the tiles of a picture, by all threads: adaptive stopping, limits of time, progress.
#ifndef RAMIFY_RENDER_TILES_H
#define RAMIFY_RENDER_TILES_H

#include "render/integrator.h"
#include "render/renderer.h"

// renderer_render for a tracer that is ready; leaves stats->memory 0.
bool tiles_render(const Tracer *tracer, Film *film, const Run *run, RenderPass *pass, void *user,
                  RenderStats *stats, Error *e);

#endif
