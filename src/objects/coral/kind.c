// Corals as a kind of object.
#include "objects/kind.h"
#include "objects/coral/coral.h"
#include "render/material/material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    CoralParams *coral = params;
    own_space_stand(own, coral->position, vec3(0, 0, 0));
    coral->position = vec3(0, 0, 0);
    return own_space_take_shapes(own, &coral->base, coral->base_count, e);
}

static bool measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    (void)recipe;
    CoralParams p = coral_params_resolve(params);
    CoralMeasures m;
    return coral_measure(grown->tree, &m, e) &&
           // Madracis: branches 7 to 14 mm thick, corallites 1.0 to 1.4 mm wide, 0.5 to 0.8 apart
           measures_add(list, "branch_thickness", 1000.0 * m.branch_thickness, "mm", 7, 14, e) &&
           measures_add(list, "branch_spacing", 1000.0 * m.branch_spacing, "mm", NAN, NAN, e) &&
           measures_add(list, "colony_seam", 1000.0 * m.seam, "mm", NAN, NAN, e) &&
           measures_add(list, "corallite_diameter", 1000.0 * (double)p.polyps.diameter, "mm", 1.0,
                        1.4, e) &&
           measures_add(list, "corallite_gap",
                        1000.0 * (double)(p.polyps.spacing - p.polyps.diameter), "mm", 0.5, 0.8, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const CoralParams *coral = params;
    snprintf(text, size, ", %g m, %d %s", (double)coral->size, coral->colonies,
             coral->colonies == 1 ? "colony" : "colonies");
}

static void settle(const void *params, void *settled)
{
    CoralParams p = coral_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

static int64_t attractors(const void *params)
{
    CoralParams p = coral_params_resolve(params);
    return p.attractors * p.colonies;
}

static int64_t copies(const void *params)
{
    const CoralParams *coral = params;
    return coral->polyps.max_count;
}

static void needs(const void *params, Needs *needs)
{
    enum {
        ATTRACTOR_BYTES = 5000,
        SKIN_BYTES = 940, // at level 0; each level has four times as much
        CUP_FACES = 75,
        CUPS = 30000 // as many as fit a colony of usual proportions
    };
    CoralParams p = coral_params_resolve(params);
    bool crust = p.form == CORAL_ENCRUSTING || p.form == CORAL_MASSIVE; // has no thick branches
    needs_add(needs, "attractors", (double)attractors(params),
              ATTRACTOR_BYTES + (crust ? 0.0 : SKIN_BYTES * exp2(2.0 * p.levels)));
    needs_add_copies(needs, "polyps.max_count", fmin((double)p.polyps.max_count, CUPS), CUP_FACES);
}

static const Material BUILTIN[] = {
    {.name = "coral",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.36f, 0.22f, 0.10f},
     .color2 = {0.80f, 0.72f, 0.60f}, // of growing tips and margins
     .roughness = 0.7f,
     .specular = 0.2f,
     .ior = 1.5f,
     .pattern = PATTERN_CORALLITE,
     .pattern_scale = 0.0024f,
     .pattern_depth = 0.0007f},
    {.name = "coral_polyp",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.40f, 0.25f, 0.12f},
     .color2 = {0.86f, 0.79f, 0.68f},
     .roughness = 0.65f,
     .specular = 0.25f,
     .ior = 1.5f,
     .pattern = PATTERN_YOUTH},
    {.name = "reef_rock",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.24f, 0.20f, 0.16f},
     .color2 = {0.16f, 0.09f, 0.10f}, // coralline algae
     .roughness = 0.9f,
     .specular = 0.15f,
     .ior = 1.5f,
     .pattern = PATTERN_NOISE,
     .pattern_scale = 0.05f,
     .pattern_depth = 0.01f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    MATERIAL_ROW(1, "polyp_material", "Material of a coral's cups; default: coral_polyp."),
    MATERIAL_ROW(2, "rock_material",
                 "Material of the rock on which a coral grows; default: reef_rock."),
    {0},
};

const Kind kind_coral = {
    .variant = {KIND_ROW("coral", &coral_table,
                         "Corals, grown by an L-system and competition for space."),
                MATERIALS},
    .materials = {"coral", "coral_polyp", "reef_rock"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .settle = settle,
    .attractors = attractors,
    .copies = copies,
    .grow = coral_grow,
    .finish = coral_finish,
    .geometry = coral_geometry};
