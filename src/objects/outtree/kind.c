// A general out-tree as a kind of object.
#include "objects/kind.h"
#include "objects/common/balls.h"
#include "objects/outtree/outtree.h"
#include "render/material/material.h"

#include <math.h>
#include <stdio.h>

// Origin at the envelope's; without one, at the first placed point.
static bool take_points(OwnSpace *own, PlacedParams *placed, Error *e)
{
    size_t size = sizeof *placed->points * (size_t)placed->count;
    placed->points = size > 0 ? own_space_copy(own, placed->points, size, e) : NULL;
    for (int i = 0; placed->points && i < placed->count; i++) {
        placed->points[i].position = own_space_place(own, placed->points[i].position);
        placed->points[i].normal = own_space_direction(own, placed->points[i].normal);
    }
    return placed->points || size == 0;
}

static bool take_further(OwnSpace *own, OuttreeParams *p, Error *e)
{
    size_t size = sizeof *p->further * (size_t)p->further_count;
    p->further = size > 0 ? own_space_copy(own, p->further, size, e) : NULL;
    bool done = p->further || size == 0;
    for (int i = 0; done && i < p->further_count; i++) {
        done = own_space_take_element(own, &p->further[i].element, e);
    }
    return done;
}

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    OuttreeParams *p = params;
    if (p->element.shape_count > 0) {
        own_space_of_element(own, &p->element);
    } else if (p->placed.count > 0 && !p->element.points.anchored) {
        own_space_stand(own, p->placed.points[0].position, vec3(0, 0, 0));
    }
    p->show.facing = own_space_direction(own, p->show.facing);
    p->starts.direction = own_space_direction(own, p->starts.direction);
    return take_points(own, &p->placed, e) && own_space_take_element(own, &p->element, e) &&
           take_further(own, p, e);
}

static int64_t attractors(const void *params)
{
    const OuttreeParams *p = params;
    int64_t sum = element_attractors(&p->element);
    int own;
    const GrowLevel *levels = outtree_own_levels(&own);
    for (int i = 0; p->element.level_count == 0 && outtree_scatters(p) && i < own; i++) {
        sum += levels[i].attractors;
    }
    for (int i = 0; i < p->further_count; i++) {
        sum += element_attractors(&p->further[i].element);
    }
    for (int i = 0; i < p->placed.count; i++) {
        sum += p->placed.points[i].group == GROUP_ATTRACTOR;
    }
    return sum;
}

static void describe(const void *params, char *text, size_t size)
{
    const OuttreeParams *p = params;
    snprintf(text, size, ", %s",
             p->element.points.place == SCATTER_SURFACE ? "over a surface" : "in a volume");
}

static int64_t copies(const void *params)
{
    const OuttreeParams *p = params;
    return p->leaves.max_count + p->lamps.max_count;
}

static void needs(const void *params, Needs *needs)
{
    const OuttreeParams *p = params;
    enum { LEAF_FACES = 25, LEAVES_AN_ATTRACTOR = 6, BLADE_BYTES = 2400 };
    double count = (double)attractors(params), leaves = (double)p->leaves.max_count;
    double thin = p->radii.tip > 0.0f ? (double)(p->skin.curve_radius / p->radii.tip)
                                      : (p->skin.curve_radius > 0.0f ? 4.0 : 0.0);
    if (p->form == OUTTREE_BLADES) {
        needs_add(needs, "growth.levels", count, BLADE_BYTES);
    } else {
        needs_add_skinned_growth(needs, "growth.levels", count, p->skin.levels, thin);
        needs_add_copies(needs, "leaves.max_count", fmin(leaves, LEAVES_AN_ATTRACTOR * count),
                         LEAF_FACES);
    }
    needs_add_copies(needs, "lamps.max_count", fmin((double)p->lamps.max_count, count), BALL_FACES);
    needs_add_copies(needs, "show.attractors", p->show.attractors > 0.0f ? count : 0.0, BALL_FACES);
    needs_add_copies(needs, "show.nodes", p->show.nodes > 0.0f ? count : 0.0, BALL_FACES);
}

static const Material BUILTIN[] = {
    // A flame's hue, 2,700 K.
    {.name = "lamp", .kind = MATERIAL_EMISSION, .radiance = {60.0f, 32.0f, 11.0f}},
    // The colours of Tanaka et al., figure 5.
    {.name = "attractor", .kind = MATERIAL_DIFFUSE, .color = {0.02f, 0.07f, 0.45f}},
    {.name = "node", .kind = MATERIAL_DIFFUSE, .color = {0.55f, 0.02f, 0.02f}},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(OUTTREE_SKIN),
    TWIG_MATERIAL_ROW(OUTTREE_TWIG),
    LEAF_MATERIAL_ROW(OUTTREE_LEAF),
    MATERIAL_ROW(OUTTREE_LAMP, "lamp_material", "Material of lamps on an outtree; default: lamp."),
    MATERIAL_ROW(OUTTREE_ATTRACTOR, "attractor_material",
                 "Material of an outtree's attractors that are shown; default: attractor, blue."),
    MATERIAL_ROW(OUTTREE_NODE, "node_material",
                 "Material of an outtree's nodes that are shown; default: node, red."),
    RIME_MATERIAL_ROW(OUTTREE_WHITE),
    {0},
};

const Kind kind_outtree = {
    .variant = {KIND_ROW("outtree", &outtree_table,
                         "A general out-tree: any envelope, start points, rules and fields."),
                MATERIALS},
    .carried = true,
    .materials = {"clay", NULL, "leaf", "lamp", "attractor", "node", "rime"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .over = outtree_over,
    .over_key = "envelope.0.object",
    .keeps_clear = true,
    .contends = true,
    .needs = needs,
    .describe = describe,
    .attractors = attractors,
    .copies = copies,
    .grow = outtree_grow,
    .tip_radius = outtree_tip_radius,
    .finish = outtree_finish,
    .points = outtree_points,
    .geometry = outtree_geometry};
