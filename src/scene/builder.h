// Builds the worlds of successive scenes in one world. Objects that a scene shares with the
// previous one are not grown, skinned or placed again.
#ifndef RAMIFY_SCENE_BUILDER_H
#define RAMIFY_SCENE_BUILDER_H

#include "scene/build.h"

typedef struct World World;

typedef struct SceneBuilder SceneBuilder;

// remember: keep the whole growth of objects, so that a change of grow_to does not grow them again.
SceneBuilder *scene_builder_new(bool remember, Error *e);
void scene_builder_free(SceneBuilder *builder); // NULL is fine; frees the world, too

// Does the world already have the geometry of this scene? If not, free everything that borrows the
// geometry (a renderer) before scene_builder_build.
bool scene_builder_fits(const SceneBuilder *builder, const Scene *scene);

// Updates the world to the scene, with the same bits as scene_build. It borrows strings from the
// scene: keep the scene until the next one is built or the builder is freed. After a failure the
// builder can only be freed. Adds the work done to stats.
World *scene_builder_build(SceneBuilder *builder, const Scene *scene, const Run *run,
                           BuildStats *stats, Error *e);

#endif
