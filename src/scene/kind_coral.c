// Corals as a kind of object.
#include "objects/coral/coral.h"
#include "scene/kinds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool own_space(OwnSpace *own, Error *e)
{
    CoralParams *coral = own_space_copy(own, own->object.coral, sizeof *coral, e);
    if (!coral) {
        return false;
    }
    own->object.coral = coral;
    own_space_stand(own, coral->position, vec3(0, 0, 0));
    coral->position = vec3(0, 0, 0);
    return own_space_take_shapes(own, &coral->base, coral->base_count, e);
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return coral_grow(object->coral, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    CoralMaterials materials = {.coral = placing_material(p, p->object->material, "coral"),
                                .polyp =
                                    placing_material(p, p->object->polyp_material, "coral_polyp"),
                                .rock = placing_material(p, p->object->rock_material, "reef_rock")};
    return coral_geometry(tree, p->object->coral, &materials, p->index, p->recipe.seed,
                          &p->world->geometry, p->recipe.run, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    CoralParams p = coral_params_resolve(object->coral);
    CoralMeasures m;
    return coral_measure(tree, &m, e) &&
           // Madracis: branches 7 to 14 mm thick, corallites 1.0 to 1.4 mm wide, 0.5 to 0.8 apart
           measures_add(list, "branch_thickness", 1000.0 * m.branch_thickness, "mm", 7, 14, e) &&
           measures_add(list, "branch_spacing", 1000.0 * m.branch_spacing, "mm", NAN, NAN, e) &&
           measures_add(list, "colony_seam", 1000.0 * m.seam, "mm", NAN, NAN, e) &&
           measures_add(list, "corallite_diameter", 1000.0 * (double)p.polyps.diameter, "mm", 1.0,
                        1.4, e) &&
           measures_add(list, "corallite_gap",
                        1000.0 * (double)(p.polyps.spacing - p.polyps.diameter), "mm", 0.5, 0.8, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %g m, %d %s", (double)object->coral->size, object->coral->colonies,
             object->coral->colonies == 1 ? "colony" : "colonies");
}

static void settle(const SceneObject *object, void *params)
{
    CoralParams p = coral_params_resolve(object->coral);
    memcpy(params, &p, sizeof p);
}

static int64_t attractors(const SceneObject *object)
{
    CoralParams p = coral_params_resolve(object->coral);
    return p.attractors * p.colonies;
}

static int64_t copies(const SceneObject *object)
{
    return object->coral->polyps.max_count;
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum {
        ATTRACTOR_BYTES = 5000,
        SKIN_BYTES = 940, // at level 0; each level has four times as much
        CUP_FACES = 75,
        CUPS = 30000 // as many as fit a colony of usual proportions
    };
    CoralParams p = coral_params_resolve(object->coral);
    bool crust = p.form == CORAL_ENCRUSTING || p.form == CORAL_MASSIVE; // no thick branches
    needs_add(needs, "attractors", (double)attractors(object),
              ATTRACTOR_BYTES + (crust ? 0.0 : SKIN_BYTES * exp2(2.0 * p.levels)));
    needs_add_copies(needs, "polyps.max_count", fmin((double)p.polyps.max_count, CUPS), CUP_FACES);
}

const Kind kind_coral = {.key = "coral",
                         .offset = offsetof(SceneObject, coral),
                         .materials = {"material", "polyp_material", "rock_material"},
                         .own_space = own_space,
                         .grow = grow,
                         .needs = needs,
                         .place = place,
                         .measure = measure,
                         .describe = describe,
                         .settle = settle,
                         .attractors = attractors,
                         .copies = copies};
