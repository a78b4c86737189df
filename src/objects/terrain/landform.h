// Landforms that processes make out of a plateau of beds of rock: rivers cut it, slopes weather
// back. What they differ by is where the rivers run, how far the work has gone, and the beds.
#ifndef RAMIFY_OBJECTS_TERRAIN_LANDFORM_H
#define RAMIFY_OBJECTS_TERRAIN_LANDFORM_H

#include "base/strata.h"

typedef struct CanyonParams {
    float width;        // m, from rim to rim; 0 = by the relief
    float sinuosity;    // length of the river over that of its valley, 1..4
    float meander;      // wavelength of its bends along the valley, share of the size
    float river;        // m, width of the water; 0 = dry
    float side_canyons; // how far they reach back, 0..; 1 = well into the plateau
} CanyonParams;

typedef struct MesaParams {
    int streams;     // that cross the plain
    float remaining; // share of the plateau that still stands, 0..1
} MesaParams;

typedef struct AlpsParams {
    float ice;      // how much glaciers have worn; 0 = never, 1 = as in the Alps
    float ice_line; // altitude of their equilibrium line, share of the relief
    float age;      // 0 = sharp and young, 1 = old, rounded hills
    int outlets;    // of the rivers, on the border
    float wind;     // degrees from north, clockwise: where the wind comes from that drifts snow
} AlpsParams;

// A stratovolcano, or a cone of ash alone.
enum { VOLCANO_MOST_CONES = 64, VOLCANO_MOST_BARRANCOS = 200 };

typedef enum VolcanoKind {
    VOLCANO_STRATO, // tephra and lava in turn: concave flanks
    VOLCANO_ASH     // one vent's ash and scoria at their angle of repose
} VolcanoKind;

typedef struct VolcanoParams {
    VolcanoKind kind;
    float at[2];          // the summit's middle, shares of the size
    float crater;         // m, width of the crater's rim; 0 = by the relief
    float breach;         // 0 = a closed rim; 1 = a horseshoe that a collapse has left
    float breach_azimuth; // degrees from north, clockwise: where it opens
    float caldera;        // m, radius of an older, collapsed summit; 0 = none
    int flows;            // youngest flows of lava
    int cones;            // scoria cones on the flanks
    float wind;           // degrees from north, clockwise: where the wind comes from
    float age;            // 0 = active, 1 = long extinct, deeply dissected
    int barrancos;        // radial gullies about the cone at half its height; 0 = as rain cuts them
} VolcanoParams;

// What makes the kinds of dunes: how many winds blow, and how much sand there is.
typedef enum DuneKind {
    DUNE_BARCHAN,    // one wind, little sand
    DUNE_TRANSVERSE, // one wind, much sand
    DUNE_LINEAR,     // two winds at an obtuse angle in turn
    DUNE_STAR        // winds from all around in turn
} DuneKind;

typedef struct DuneParams {
    DuneKind kind;
    float wind;    // degrees from north, clockwise: where it comes from, the mean of linear dunes'
    float spread;  // degrees between the two winds of linear dunes
    float spacing; // m: about from crest to crest; 0 = a quarter of the size
    float sand;    // m: mean depth over the land; 0 = by the kind
    float age;     // 1 = grown up, more = fewer and larger
} DuneParams;

typedef enum TerrainSide {
    SIDE_ALL,
    SIDE_NORTH, // -z
    SIDE_EAST,  // +x
    SIDE_SOUTH,
    SIDE_WEST
} TerrainSide;

// A coast that waves cut.
typedef struct CoastParams {
    TerrainSide sea;     // not SIDE_ALL
    float waves;         // degrees: where they come from, clockwise from the sea's side
    float wave_height;   // m
    float tide;          // m from low to high water
    float retreat;       // m; 0 = 0.2 of the size
    float sand;          // share of the worn rock
    float grain;         // mm
    float joints;        // contrast of the rock's strength: 0 = all alike
    float joint_spacing; // m; 0 = 0.03 of the size
} CoastParams;

// Rounded hills under soil.
typedef struct HillParams {
    float spacing; // m: about from valley to valley; 0 = a tenth of the size
    int outlets;   // of the streams, on the border
    float rills;   // 0 = none, under grass; 1 = deep ones in bare ground
} HillParams;

// Soft bare beds that rills cut.
typedef struct BadlandParams {
    float rills; // m: from rill to rill at least; 0 = as the cells allow
    float depth; // m, of a rill that drains 50 m^2
    float slope; // degrees: the steepest wall
    float wash;  // fall of the floor of a wash that drains a hectare; 0 = none
    int outlets; // on the border
} BadlandParams;

// A river that braids on a plain of gravel.
typedef struct BraidedParams {
    float width;          // m, of the plain; 0 = half of the size
    float slope;          // fall of the valley
    float threads;        // about how many run side by side
    float stage;          // the discharge now, share of that which forms the bed
    float age;            // 1 = grown up, more = fewer and larger threads
    int terraces;         // on each side of the plain
    float terrace_height; // m, of the lowest riser
} BraidedParams;

// Limestone that water has dissolved.
typedef struct KarstParams {
    float stage;   // 0 = a plateau, 0.4 = cones about cockpits, 1 = towers on a plain
    float spacing; // m: about from hollow to hollow; 0 = 0.09 of the size
    float focus;   // how much recharge gathers in hollows
    float river;   // m, width of a river from elsewhere; 0 = none
} KarstParams;

// A river that meanders in its floodplain.
typedef struct MeanderParams {
    float width; // m, of the channel; 0 = a sixtieth of the size
    float plain; // width of the floodplain, share of the size
    float slope; // fall of the valley
    float age;   // 1 = many bends have been cut off
} MeanderParams;

// A river that enters a shallow sea.
typedef struct DeltaParams {
    float width;   // m, of the river; 0 = a fortieth of the size
    float depth;   // m, of the river and of the sea; 0 = by the river's width
    float sand;    // share of what it brings
    float age;     // what it has brought: 1 = the delta reaches the middle of the square and beyond
    float rise;    // of the sea meanwhile, share of its depth
    float plain;   // width of the old land, share of the size
    float creeks;  // density of those that drain the marsh; 0 = shallow ones by noise alone
    float stirred; // how much eddies and the flow stir what the water carries
} DeltaParams;

// How the land evolves; factors on the landform's own rates.
typedef struct EvolutionParams {
    float streams;    // incision by tributaries
    float debris;     // incision of steep rock by debris flows and rockfall
    float weathering; // retreat of faces
    float rubble;     // share of fallen rock that stays as rubble, 0..1
    float repose;     // degrees, of rubble
    float deposition; // of the streams' load: 0 = none
    float soil;       // creeping soil
    int cells;        // a side, at most
} EvolutionParams;

extern const struct Table strata_table, canyon_table, mesa_table, alps_table, volcano_table,
    dune_table, hill_table, badland_table, coast_table, braided_table, karst_table, meander_table,
    delta_table, evolution_table, terrain_lake_table, terrain_forest_table, joint_table;

#endif
