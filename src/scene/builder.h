// One world for one scene after another: what two scenes have in common is grown, skinned and
// placed once.
#ifndef RAMIFY_SCENE_BUILDER_H
#define RAMIFY_SCENE_BUILDER_H

#include "scene/build.h"

typedef struct World World;

typedef struct SceneBuilder SceneBuilder;

// remember: keeps what objects have grown, so that another grow_to grows nothing anew.
SceneBuilder *scene_builder_new(bool remember, Error *e);
void scene_builder_free(SceneBuilder *builder); // NULL is fine; frees the world, too

// Has the world the geometry that this scene asks for? If not, who looks at the geometry (a
// renderer) must go before scene_builder_build.
bool scene_builder_fits(const SceneBuilder *builder, const Scene *scene);

// Makes the world that of the scene, bit for bit as scene_build does. It borrows strings from the
// scene: keep it until the next scene is built or the builder is gone. After a failure the builder
// can only be freed. Adds to stats what was done.
World *scene_builder_build(SceneBuilder *builder, const Scene *scene, const Run *run,
                           BuildStats *stats, Error *e);

#endif
