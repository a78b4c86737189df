// Maps the public types of ramify.h to internal ones: a RamifyScene is a Scene, a RamifyTree an
// OutTree and so on; public structs are copied member by member, so that internal ones may change.
#ifndef RAMIFY_API_HANDLES_H
#define RAMIFY_API_HANDLES_H

#include "base/run.h"
#include "fit/fit.h"
#include "ramify.h"
#include "render/renderer.h"
#include "scene/build.h"

struct RamifyWorld {
    World *world;       // owned
    const Scene *scene; // the scene it was built from, borrowed; for messages
    BuildStats stats;
};

// Copies an error to out (NULL = ignored) and returns false.
bool api_fail(RamifyError *out, const Error *e);

// Converts the caller's run parameters (NULL = the defaults of ramify.h).
Run api_run(const RamifyRun *run);

// ERROR_INPUT when the scene has no object with this index.
bool api_check_object(const RamifyScene *scene, int index, Error *e);

static inline const Scene *scene_of(const RamifyScene *scene)
{
    return (const Scene *)(const void *)scene;
}

static inline const OutTree *tree_of(const RamifyTree *tree)
{
    return (const OutTree *)(const void *)tree;
}

static inline const HeightField *land_of(const RamifyLand *land)
{
    return (const HeightField *)(const void *)land;
}

static inline const MeasureList *measures_of(const RamifyMeasures *measures)
{
    return (const MeasureList *)(const void *)measures;
}

static inline const Fit *fit_of(const RamifyFit *fit)
{
    return (const Fit *)(const void *)fit;
}

static inline const Film *film_of(const RamifyFilm *film)
{
    return (const Film *)(const void *)film;
}

#endif
