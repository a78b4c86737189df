// A climbing plant as a kind of object.
#include "objects/kind.h"
#include "objects/climber/climber.h"

#include <math.h>
#include <stdio.h>

static const char *over(const void *params)
{
    const ClimberParams *climber = params;
    return climber->climbs;
}

static void describe(const void *params, char *text, size_t size)
{
    const ClimberParams *climber = params;
    snprintf(text, size, ", on '%s', up to %g m", climber->climbs, (double)climber->height);
}

// Squares of the finest spacing within reach, if the surface is a plane.
static int64_t attractors(const void *params)
{
    const ClimberParams *c = params;
    double squares =
        1.6 * (double)c->height * (double)c->spread / (double)(c->spacing * c->spacing);
    return (int64_t)fmin(squares * c->start_count, 1e15);
}

static int64_t copies(const void *params)
{
    const ClimberParams *climber = params;
    int64_t count = climber->leaves.max_count;
    for (int i = 0; i < climber->organ_count; i++) {
        count += climber->organs[i].max_count;
    }
    return count;
}

static void needs(const void *params, Needs *needs)
{
    enum { LEAF_FACES = 40 };
    const ClimberParams *c = params;
    double thin = (double)(c->skin.curve_radius / fmaxf(c->radii.tip, 1e-6f));
    needs_add_skinned_growth(needs, "spacing", (double)attractors(params), c->skin.levels, thin);
    needs_add_copies(needs, "leaves.max_count", (double)c->leaves.max_count, LEAF_FACES);
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(CLIMBER_BARK),
    TWIG_MATERIAL_ROW(CLIMBER_TWIG),
    LEAF_MATERIAL_ROW(CLIMBER_LEAF),
    ORGAN_MATERIAL_ROWS(CLIMBER_BLOSSOM, CLIMBER_FRUIT, CLIMBER_CONE, CLIMBER_STALK),
    ANTHER_MATERIAL_ROW(CLIMBER_ANTHER),
    {0},
};

const Kind kind_climber = {
    .variant = {KIND_ROW("climber", &climber_table,
                         "A climbing plant on another object, such as ivy on a wall."),
                MATERIALS},
    .materials = {"bark", "twig", "leaf", "blossom", "fruit", "cone", "stalk", "tree/anther"},
    .over = over,
    .over_key = "climbs",
    .keeps_clear = true,
    .needs = needs,
    .describe = describe,
    .attractors = attractors,
    .copies = copies,
    .grow = climber_grow,
    .finish = climber_finish,
    .geometry = climber_geometry};
