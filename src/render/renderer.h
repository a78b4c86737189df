// The path tracer: a World becomes a Film. Same world, same seed: same bits for any number of
// threads.
#ifndef RAMIFY_RENDER_RENDERER_H
#define RAMIFY_RENDER_RENDERER_H

#include "base/run.h"
#include "render/film.h"

typedef struct World World;
typedef struct Renderer Renderer;

// Builds the acceleration structures (Embree); progress stage "build". The world and isa are
// borrowed and must outlive the renderer, and so must what its materials borrow (layers, colours,
// names of files), until an update with RENDERER_MATERIALS takes others. isa: NULL for the best
// instruction set of this machine; "sse4.2" (sse2, avx, avx2, avx512) pins it, for golden images.
// Fails with ERROR_MEMORY when the structures do not fit.
Renderer *renderer_new(const World *world, const char *isa, const Run *run, Error *e);
void renderer_free(Renderer *renderer); // NULL is fine

// Flags: what changed since the last update. Camera, film and RenderParams may change between two
// pictures without a flag; geometry must not change.
enum {
    RENDERER_SKY_TURNED = 1, // only sky.rotation: costs nothing
    RENDERER_LIGHT = 2,      // any other value of sky and medium
    RENDERER_MATERIALS = 4,  // values of materials; number and order must stay
    RENDERER_LAMPS = 8,      // lamps: rebuilds the acceleration structures, which hold them
    RENDERER_CLOUDS = 16     // clouds: grows them anew
};

// Updates what depends on the changed flags. After a failure the renderer can only be freed.
bool renderer_update(Renderer *renderer, unsigned changed, const Run *run, Error *e);

typedef struct RenderStats {
    int64_t paths, rays;
    double seconds;
    int64_t memory; // bytes held by the acceleration structures
    int samples;    // per pixel, the least of all pixels; 0 = some have none
} RenderStats;

// Called after every pass with the film so far. They end at 1, 4, 16, 32, 64, ... samples: a first
// picture appears at once. May be NULL.
typedef void RenderPass(void *user, const Film *film, int samples);

// A first look: one path for each 4 x 4 pixels, whose result all of them get, in a sixteenth of the
// time of one sample per pixel. It counts as no sample, so that a rendering starts anew. Fails with
// ERROR_CANCELLED when run->cancelled is set.
bool renderer_look(Renderer *renderer, Film *film, const Run *run, Error *e);

// Renders into film, which film_new made with the world's size; pixels outside the crop keep their
// values. Progress stage "trace". When max_seconds is over it leaves a complete image of
// stats->samples samples and returns true. When run->cancelled is set it does the same within
// milliseconds; pixels that the first pass did not reach are then black and transparent and
// stats->samples is 0; if no pixel was rendered it fails with ERROR_CANCELLED.
bool renderer_render(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, void *user,
                     RenderStats *stats, Error *e);

// Goes on with the samples that the film holds, such as those of a film that was cut short
// anywhere: the film becomes what renderer_render would have made of it, to the bit. pass is also
// called within a pass after every `every` seconds of tracing (0 = not), with the film's least
// samples; no thread then writes to the film.
bool renderer_resume(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, double every,
                     void *user, RenderStats *stats, Error *e);

// Measures what paths of this picture cost (render/probe.h), in about a second of processor time.
struct PathCosts;
bool renderer_probe(const Renderer *renderer, const Run *run, struct PathCosts *costs, Error *e);

// Traces one sample of a pixel again and fills the first `most` of its rays (render/integrator.h)
// and what it adds to the picture; returns their number. -1 with ERROR_INPUT when the picture has
// no such pixel or sample.
struct PathStep;
int renderer_replay(const Renderer *renderer, int x, int y, int sample, struct PathStep *step,
                    int most, Vec3 *color, Error *e);

#endif
