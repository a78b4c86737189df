// Shared by the parts of the form volcano. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_VOLCANO_H
#define RAMIFY_OBJECTS_TERRAIN_VOLCANO_H

#include "objects/terrain/internal.h"

// A vent: the summit's crater, or a scoria cone on the flanks.
typedef struct Vent {
    double x, z;   // m
    double rim;    // m: mean radius of the rim
    double radius; // m: of a scoria cone's foot
} Vent;

enum { VOLCANO_FIRST_CELLS = 256 }; // a side, of the coarsest grid
#define VOLCANO_STEEPEST 0.625      // 32 degrees: the upper flanks

typedef struct Volcano {
    const Terrain *terrain;
    TerrainParams params; // resolved
    double size, relief, repose;
    Vent summit;
    double fall;    // m: distance over which a layer of tephra gets thinner by e
    double wind[2]; // unit: where it blows
    Vent cone[VOLCANO_MOST_CONES];
    int cones;
    // Of each sample of the present grid:
    double *flow;    // m of the last flow
    float *weakness; // of tephra: what differs from place to place
    float *lava;     // freshness of the lava on it: 1 = the last flow, 0 = none or long covered
    float *red;      // 0..1: scoria that hot gas has oxidised
} Volcano;

// The distance over which tephra gets thinner by e, for flanks of 32 degrees below the rim.
static inline double volcano_fall(const TerrainParams *resolved)
{
    return (double)resolved->relief / VOLCANO_STEEPEST;
}

// Distance and direction from a vent.
typedef struct Away {
    double dx, dz, r;
} Away;
Away volcano_away(const Landscape *land, const Vent *vent, int64_t i);

// volcano_rock.c: fills v->weakness: what differs from place to place.
void volcano_find_weakness(Volcano *v, const Landscape *land, const Run *run);

// volcano_ash.c: a cone of ash on the plain, its flanks at repose, its rim lower here than there.
void volcano_heap_ash(const Volcano *v, Landscape *land);
// Radius at which the cone has half its height, m.
double volcano_half_radius(const Volcano *v);

// volcano_barrancos.c

// On the first grid that resolves barrancos, or the finest: grooves in which the first rain
// gathers. Returns the share of their depth that is this grid's part; 0 before, and if none are
// asked for.
double volcano_find_barrancos(const Volcano *v, Landscape *land, bool finest);
// Rain cuts a share of their depth in steps, and walls fall to what ash bears. Nothing if none are
// asked for or the share is 0.
bool volcano_cut_barrancos(const Volcano *v, Landscape *land, double share, int steps,
                           const Run *run, Error *e);

// volcano_vent.c: tephra, craters, scoria cones, sector collapse, caldera.

// A layer of tephra, `thick` m at the crater's rim.
void volcano_tephra(const Volcano *v, Landscape *land, double thick, uint64_t key);
// Blows the crater open. What flies out is gone.
void volcano_open_crater(const Volcano *v, Landscape *land);
// Mean height at a distance from the summit's middle.
double volcano_ring(const Volcano *v, const Landscape *land, double radius);
// Part of the cone slides off and runs out as a debris avalanche.
bool volcano_breach(Volcano *v, Landscape *land, const Run *run, Error *e);
// The roof of the magma chamber sinks.
void volcano_sink_caldera(const Volcano *v, Landscape *land);
// Places the scoria cones; builds them.
void volcano_place_cones(Volcano *v);
void volcano_build_cones(Volcano *v, Landscape *land);

#endif
