// What rendering a scene takes.
#include "scene/estimate.h"

#include "api/handles.h"
#include "scene/needs.h"

bool ramify_estimate(const RamifyScene *scene, const char *isa, int64_t memory,
                     const RamifyRun *run, RamifyEstimate *estimate, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    Estimate found;
    bool done = scene_estimate(scene_of(scene), isa, (double)memory, &own, &found, &e);
    *estimate = (RamifyEstimate){.memory = (int64_t)found.memory,
                                 .paths = found.paths,
                                 .grow_seconds = found.grow,
                                 .build_seconds = found.build,
                                 .trace_seconds = found.trace,
                                 .preview_seconds = found.preview,
                                 .write_seconds = found.write};
    return done || api_fail(error, &e);
}

bool ramify_check_memory(const RamifyScene *scene, int64_t memory, int32_t built,
                         RamifyError *error)
{
    Error e = {0};
    const Scene *own = scene_of(scene);
    double measured = built ? scene_memory_built(own) : 0.0;
    return scene_limit_memory(own, (double)memory, measured, &e) || api_fail(error, &e);
}
