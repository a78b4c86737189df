// The path tracer: a World becomes a Film. Same world, same seed: same bits for any number of
// threads.
#ifndef RAMIFY_RENDER_RENDERER_H
#define RAMIFY_RENDER_RENDERER_H

#include "base/run.h"
#include "render/film.h"
#include "render/world.h"

typedef struct Renderer Renderer;

// Builds the acceleration structures (Embree). The world is borrowed and must outlive the renderer.
// isa: NULL for the best of this machine, or "sse4.2" (sse2, avx, avx2, avx512) to pin it (golden
// images). ERROR_MEMORY, not a crash, when the structures do not fit; progress stage "build".
Renderer *renderer_new(const World *world, const char *isa, const Run *run, Error *e);
void renderer_free(Renderer *renderer); // NULL is fine

typedef struct RenderStats {
    int64_t paths, rays;
    double seconds;
    int64_t memory; // bytes held by the acceleration structures
    int samples;    // taken per pixel (least over the pixels)
} RenderStats;

// Called after every pass over the image with what there is so far (passes double: 1, 2, 4, ...
// samples, so a first picture is there at once). May be NULL.
typedef void RenderPass(void *user, const Film *film, int samples);

// Renders into film (made by film_new with the world's size; what was in it is replaced, but for
// pixels outside the crop); progress stage "trace". Interrupted by run->cancelled or by
// max_seconds it leaves a complete image of fewer samples and returns true; stats->samples tells.
bool renderer_render(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, void *user,
                     RenderStats *stats, Error *e);

#endif
