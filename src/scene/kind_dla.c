// A diffusion-limited aggregate as a kind of object.
#include "grow/aggregate/dla.h"
#include "scene/kinds.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, Error *e)
{
    DlaModel *dla = own_space_copy(own, own->object.dla, sizeof *dla, e);
    if (dla) {
        own->object.dla = dla;
        own_space_stand(own, dla->position, dla->rotation);
        dla->position = dla->rotation = vec3(0, 0, 0);
    }
    return dla;
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return dla_model_grow(object->dla, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    return dla_model_geometry(tree, placing_material(p, p->object->material, "copper"), p->index,
                              &p->world->geometry, p->recipe.run, e);
}

// 1.71 and 2.5 for ever larger clusters (Meakin 1983; Davidovitch et al. 2000).
static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    double dimension = dla_dimension(tree), low = object->dla->dimension == 2 ? 1.66 : 2.4;
    return measures_add(list, "gyration_dimension", dimension > 0.0 ? dimension : (double)NAN, "",
                        low, low + 0.2, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %lld particles in %dD", (long long)object->dla->particles,
             object->dla->dimension);
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum { PARTICLE_BYTES = 20000 }; // of the level set through it, at its thinnest
    needs_add(needs, "particles", (double)object->dla->particles, PARTICLE_BYTES);
}

const Kind kind_dla = {.key = "dla",
                       .offset = offsetof(SceneObject, dla),
                       .materials = {"material"},
                       .own_space = own_space,
                       .grow = grow,
                       .needs = needs,
                       .place = place,
                       .measure = measure,
                       .describe = describe};
