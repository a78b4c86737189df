// Rendering so that nothing but a change of the program or the scene changes the picture: a pinned
// instruction set, seed and number of samples.
#ifndef RAMIFY_GOLDEN_PINNED_H
#define RAMIFY_GOLDEN_PINNED_H

#include "base/run.h"
#include "golden/noise.h"
#include "scene/scene.h"

#define PINNED_ISA "sse4.2" // runs on every machine that ramify runs on

// ERROR_INPUT when the scene stops by time or noise: then samples depend on the machine.
bool pinned_check(const Scene *scene, Error *e);

// The picture with the scene's own seed, linear: 3 channels where all is opaque, else 4
// (premultiplied). isa: NULL = this machine's best. ERROR_CANCELLED when the user interrupts.
Image *pinned_render(const Scene *scene, const char *isa, const Run *run, Error *e);

// A scene that is grown and built, to be rendered any number of times. It borrows from the scene.
// NULL and e as for pinned_render.
typedef struct Pinned Pinned;
Pinned *pinned_open(const Scene *scene, const char *isa, const Run *run, Error *e);
void pinned_close(Pinned *pinned); // NULL is fine

// The mean of `runs` renderings (at least 2) and its variance. Runs of different `series` share no
// random numbers of the renderer.
bool pinned_render_noisy(Pinned *pinned, uint64_t series, int runs, const Run *run,
                         NoisyPicture *picture, Error *e);

// As the scene's film shows it: display values, 3 channels, or 4 with straight alpha.
Image *pinned_develop(const Scene *scene, const Image *linear, Error *e);

#endif
