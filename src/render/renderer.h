// The path tracer: a World becomes a Film. Same world, same seed: same bits for any number of
// threads.
#ifndef RAMIFY_RENDER_RENDERER_H
#define RAMIFY_RENDER_RENDERER_H

#include "base/run.h"
#include "render/film.h"

typedef struct World World;
typedef struct Renderer Renderer;

// Builds the acceleration structures (Embree). The world is borrowed and must outlive the renderer.
// isa: NULL for the best of this machine, or "sse4.2" (sse2, avx, avx2, avx512) to pin it (golden
// images). ERROR_MEMORY, not a crash, when the structures do not fit; progress stage "build".
// isa is borrowed, too.
Renderer *renderer_new(const World *world, const char *isa, const Run *run, Error *e);
void renderer_free(Renderer *renderer); // NULL is fine

// What of the world is another than when the renderer was made or last updated. Camera, film and
// RenderParams may change at any time between two pictures without a word; geometry never.
enum {
    RENDERER_SKY_TURNED = 1, // sky.rotation alone: costs nothing
    RENDERER_LIGHT = 2,      // anything else of sky and medium
    RENDERER_MATERIALS = 4,  // their values; number and order are the same
    RENDERER_LAMPS = 8       // builds the acceleration structures anew, as lamps are part of them
};

// Brings up to date what was made from what changed (bits of the above). After a failure the
// renderer can only be freed.
bool renderer_update(Renderer *renderer, unsigned changed, const Run *run, Error *e);

typedef struct RenderStats {
    int64_t paths, rays;
    double seconds;
    int64_t memory; // bytes held by the acceleration structures
    int samples;    // taken per pixel (least over the pixels); 0 = some have none
} RenderStats;

// Called after every pass over the image with what there is so far (passes double: 1, 2, 4, ...
// samples, so a first picture is there at once). May be NULL.
typedef void RenderPass(void *user, const Film *film, int samples);

// Renders into film (made by film_new with the world's size; what was in it is replaced, but for
// pixels outside the crop); progress stage "trace". Out of max_seconds it leaves a complete image
// of fewer samples and returns true; stats->samples tells. Interrupted by run->cancelled it does
// the same within some milliseconds; pixels that the first pass had not reached by then are black
// and transparent, stats->samples is 0 then, and with no pixel at all it fails (ERROR_CANCELLED).
bool renderer_render(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, void *user,
                     RenderStats *stats, Error *e);

#endif
