// A cascade as a kind of object.
#include "objects/kind.h"
#include "objects/cascade/cascade.h"

#include <stdio.h>

static const char *over(const void *params)
{
    const CascadeParams *p = params;
    return p->over;
}

static void describe(const void *params, char *text, size_t size)
{
    const CascadeParams *p = params;
    snprintf(text, size, ", over '%s', %g l/s", p->over, 1000.0 * (double)p->discharge);
}

static void needs(const void *params, Needs *needs)
{
    enum { STRAND_BYTES = 16000 }; // of the parcels of its white water
    const CascadeParams *p = params;
    needs_add(needs, "strands", (double)p->strands, STRAND_BYTES);
}

static const Key MATERIALS[] = {
    WATER_MATERIAL_ROW(0),
    {0},
};

const Kind kind_cascade = {
    .variant = {KIND_ROW("cascade", &cascade_table,
                         "A small fall of water over another object, as a long exposure shows it."),
                MATERIALS},
    .materials = {"lake"},
    .sprays = true,
    .over = over,
    .over_key = "over",
    .needs = needs,
    .describe = describe,
    .geometry = cascade_geometry};
