// Shared by the parts of the landscape. Private to this folder.
#ifndef RAMIFY_LAND_LANDSCAPE_PARTS_H
#define RAMIFY_LAND_LANDSCAPE_PARTS_H

#include "land/landscape.h"

// Where the water of each sample goes.
typedef struct Routing {
    int64_t count;
    int32_t *order;    // every receiver before its donors
    int32_t *receiver; // itself at a base
    double *area;      // m^2
} Routing;

void routing_free(Routing *route);

// landscape_route.c: finds the ways of the water. Pits overflow at their lowest pass.
bool landscape_find_route(Landscape *land, uint64_t seed, const Run *run, Error *e);

// landscape_streams.c
bool landscape_streams(Landscape *land, const LandscapeRates *rates, double time, Error *e);

// landscape_debris.c
bool landscape_debris(Landscape *land, const LandscapeRates *rates, double time, const Run *run,
                      Error *e);

// landscape_slopes.c
bool landscape_slopes(Landscape *land, const LandscapeRates *rates, double time, const Run *run,
                      Error *e);

// Of rock at a height of sample i.
static inline int landscape_bed(const Landscape *land, int64_t i, double height)
{
    return land->strata ? strata_bed(land->strata, (float)height - land->stack[i]) : 0;
}

static inline double landscape_hardness(const Landscape *land, int bed)
{
    return land->strata ? (double)land->strata->bed[bed].hardness : 0.5;
}

#endif
