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

// Growth steps of all colonies. A colony has room for so many; few are as dense as that.
static double growth_steps(const CoralParams *p, double an_attractor, double density)
{
    double radius = 0.5 * (double)p->size, step = (double)p->length_tip;
    double room = p->form == CORAL_FAN // half an ellipse, else half an ellipsoid
                      ? 1.57 * radius * (double)p->height / (step * step)
                      : 2.09 * radius * radius * (double)p->height / (step * step * step);
    return p->colonies * fmin(an_attractor * (double)p->attractors, density * room);
}

// Triangles of the branches' skin.
static double skin_triangles(const CoralParams *p)
{
    static const struct {
        double an_attractor, density; // of growth_steps
        double faces;                 // of the cage, per tip radius of length
    } measured[] = {
        [CORAL_BRANCHING] = {0.57, 0.4, 12.5},
        [CORAL_TABLE] = {1.8, 0.95, 4.5},
        [CORAL_FAN] = {0.6, 1.0, 7.8},
        [CORAL_ENCRUSTING] = {0}, // these have no skin
        [CORAL_MASSIVE] = {0},
    };
    double length = 0.5 * (double)(p->length + p->length_tip);
    double faces = measured[p->form].faces * length / (double)p->tip_radius;
    return growth_steps(p, measured[p->form].an_attractor, measured[p->form].density) * faces *
           2.0 * exp2(2.0 * p->levels);
}

static void needs(const void *params, Needs *needs)
{
    enum {
        ATTRACTOR_BYTES = 5000,
        CUP_FACES = 75,
        CUPS = 30000 // as many as fit a colony of usual proportions
    };
    CoralParams p = coral_params_resolve(params);
    needs_add(needs, "attractors", (double)attractors(params), ATTRACTOR_BYTES);
    needs_add_skin(needs, "levels", skin_triangles(&p));
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
    .keeps_clear = true,
    .contends = true,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .settle = settle,
    .attractors = attractors,
    .copies = copies,
    .grow = coral_grow,
    .finish = coral_finish,
    .geometry = coral_geometry};
