// Reproducible rendering for golden images: pinned instruction set, seed and number of samples, so
// that only a change of the program or the scene changes the picture.
#ifndef RAMIFY_GOLDEN_PINNED_H
#define RAMIFY_GOLDEN_PINNED_H

#include "base/run.h"
#include "golden/noise.h"
#include "scene/scene.h"

#define PINNED_ISA "sse4.2" // supported by every machine that runs ramify

// ERROR_INPUT when the scene stops by time or noise, which makes the sample count
// machine-dependent.
bool pinned_check(const Scene *scene, Error *e);

// Renders with the scene's own seed, linear: 3 channels if all is opaque, else 4 (premultiplied).
// isa: NULL = this machine's best. ERROR_CANCELLED when cancelled. The caller frees the image.
Image *pinned_render(const Scene *scene, const char *isa, const Run *run, Error *e);

// A scene grown and built, to be rendered repeatedly. Borrows the scene. NULL and e as for
// pinned_render.
typedef struct Pinned Pinned;
Pinned *pinned_open(const Scene *scene, const char *isa, const Run *run, Error *e);
void pinned_close(Pinned *pinned); // NULL is fine

// Mean of `runs` renderings (at least 2) and its variance. Different `series` share no random
// numbers of the renderer.
bool pinned_render_noisy(Pinned *pinned, uint64_t series, int runs, const Run *run,
                         NoisyPicture *picture, Error *e);

// Develops with the scene's film settings: display values, 3 channels, or 4 with straight alpha.
Image *pinned_develop(const Scene *scene, const Image *linear, Error *e);

#endif
