// Estimates the time and memory of a rendering by doing a small part of it: the scene is grown and
// built, some thousand of its paths are traced, a small picture is developed. So the estimate
// follows the machine, and what depends on the scene in ways that no count tells.
#ifndef RAMIFY_SCENE_ESTIMATE_H
#define RAMIFY_SCENE_ESTIMATE_H

#include "base/run.h"
#include "scene/scene.h"

typedef struct Estimate {
    double memory; // bytes resident at most, that of this process before included
    int64_t paths; // as if adaptive stopping took effect nowhere
    // Processor seconds, of all threads and of child processes.
    double grow;    // growing and meshing all objects
    double build;   // the ray tracer's structures
    double trace;   // all paths
    double preview; // previews at growing intervals, as ramify render writes them
    double write;   // denoising, developing and writing the picture
} Estimate;

// limit: bytes of memory; 0 = that of the machine. isa: as for renderer_new. Fails as scene_build,
// and with ERROR_INPUT as scene_limit_memory.
bool scene_estimate(const Scene *scene, const char *isa, double limit, const Run *run,
                    Estimate *estimate, Error *e);

// Bytes resident at most if the picture is rendered now, with its world and renderer in memory.
double scene_memory_built(const Scene *scene);

#endif
