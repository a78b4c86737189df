// Between the public types of ramify.h and ours: a RamifyScene is a Scene, a RamifyTree an OutTree
// and so on, under a name of their own; the public structs mirror ours, so that ours may change.
#ifndef RAMIFY_API_HANDLES_H
#define RAMIFY_API_HANDLES_H

#include "base/run.h"
#include "ramify.h"
#include "render/renderer.h"
#include "scene/build.h"

struct RamifyWorld {
    World *world;       // owned
    const Scene *scene; // what it was built from, borrowed: for messages
    BuildStats stats;
};

// Hands an error out (to NULL, if the caller does not care) and returns false.
bool api_fail(RamifyError *out, const Error *e);

// How to run, from what the caller says (NULL = the defaults of ramify.h).
Run api_run(const RamifyRun *run);

// ERROR_INPUT when the scene has no object of this number.
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

static inline const Film *film_of(const RamifyFilm *film)
{
    return (const Film *)(const void *)film;
}

#endif
