#include "animate/stage.h"

#include "base/memory.h"
#include "config/compare.h"
#include "render/world.h"
#include "scene/place.h"
#include "scene/spec.h"

#include <stdlib.h>

struct Stage {
    Camera camera; // see stage_new
    Views views;   // see stage_see_from
    const char *isa;
    SceneBuilder *builder;
    Scene *scene;  // the current scene; owned, because the world borrows from it; NULL at first
    Scene *lender; // owned: whose materials the renderer borrows from; often `scene` itself
    World *world;  // owned by the builder
    Renderer *renderer;
    StageStats stats;
};

Stage *stage_new(const Camera *camera, const char *isa, bool remember, Error *e)
{
    Stage *stage = memory_alloc_zero(1, sizeof *stage, e);
    if (stage) {
        stage->camera = *camera;
        stage->isa = isa;
        stage->builder = scene_builder_new(remember, e);
    }
    if (!stage || !stage->builder) {
        free(stage);
        return NULL;
    }
    return stage;
}

void stage_free(Stage *stage)
{
    if (stage) {
        renderer_free(stage->renderer);
        scene_builder_free(stage->builder);
        scene_free(stage->lender == stage->scene ? NULL : stage->lender);
        scene_free(stage->scene);
        free(stage);
    }
}

void stage_see_from(Stage *stage, const Views *views)
{
    stage->views = *views;
}

// Is the value of a key of the scene the same?
static bool same(const Scene *a, const Scene *b, const char *key)
{
    return key_equal(table_find(&scene_table, key), a, b);
}

// Flags for renderer_update.
static unsigned find_changes(const Scene *old, const Scene *now)
{
    unsigned changed = 0;
    if (!same(old, now, "sky")) {
        bool turned = table_equal(&sky_table, &old->sky, &now->sky, "rotation");
        changed |= turned ? RENDERER_SKY_TURNED : RENDERER_LIGHT;
    }
    if (!same(old, now, "medium") || !same(old, now, "seed")) {
        changed |= RENDERER_LIGHT; // the seed: of clouds and waves
    }
    if (!same(old, now, "showers")) {
        changed |= RENDERER_LIGHT;
    }
    if (!same(old, now, "clouds") || !same(old, now, "seed")) {
        changed |= RENDERER_CLOUDS;
    }
    if (!same(old, now, "materials")) {
        changed |= RENDERER_MATERIALS;
    }
    if (!same(old, now, "lights")) {
        changed |= RENDERER_LAMPS;
    }
    return changed;
}

// Builds or updates with the stage's camera for view-dependent geometry, not the scene's.
static bool set_up(Stage *stage, Scene *scene, bool fits, unsigned changed, const Run *run,
                   Error *e)
{
    Camera own = scene->camera;
    scene->camera = stage->camera;
    stage->stats.geometries += !fits;
    stage->world = scene_builder_build(stage->builder, scene, run, &stage->stats.build, e);
    double start = run_seconds();
    bool done = stage->world;
    if (done) {
        stage->world->views = stage->views;
    }
    if (done && stage->renderer) {
        done = renderer_update(stage->renderer, changed, run, e) || scene_fail_at(scene, "", e);
        stage->stats.structures += (changed & RENDERER_LAMPS) != 0;
    } else if (done) {
        stage->renderer = renderer_new(stage->world, stage->isa, run, e);
        stage->stats.structures++;
        done = stage->renderer || scene_fail_at(scene, "", e);
    }
    stage->stats.build_seconds += run_seconds() - start;
    scene->camera = own;
    if (done) {
        stage->world->camera = own;
    }
    return done;
}

// Frees what neither the world nor the renderer borrows from any more.
static void take_over(Stage *stage, Scene *scene, Scene *lender)
{
    if (stage->lender != stage->scene && stage->lender != lender) {
        scene_free(stage->lender);
    }
    if (stage->scene != lender) {
        scene_free(stage->scene);
    }
    stage->scene = scene;
    stage->lender = lender;
}

bool stage_set(Stage *stage, Scene *scene, const Run *run, Error *e)
{
    bool fits = stage->scene && scene_builder_fits(stage->builder, scene);
    if (!fits) { // before the geometry is freed
        renderer_free(stage->renderer);
        stage->renderer = NULL;
    }
    unsigned changed = stage->scene ? find_changes(stage->scene, scene) : 0;
    bool lends = !stage->renderer || changed & RENDERER_MATERIALS;
    bool done = set_up(stage, scene, fits, changed, run, e);
    take_over(stage, scene, lends ? scene : stage->lender); // only now: the builder has compared
    return done;
}

bool stage_render(Stage *stage, Film *film, const Run *run, RenderStats *stats, Error *e)
{
    return renderer_render(stage->renderer, film, run, NULL, NULL, stats, e);
}

bool stage_resume(Stage *stage, Film *film, const Run *run, RenderPass *pass, double every,
                  void *user, RenderStats *stats, Error *e)
{
    return renderer_resume(stage->renderer, film, run, pass, every, user, stats, e);
}

const StageStats *stage_stats(const Stage *stage)
{
    return &stage->stats;
}
