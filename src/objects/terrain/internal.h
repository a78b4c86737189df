// Shared by the parts of the terrain. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_INTERNAL_H
#define RAMIFY_OBJECTS_TERRAIN_INTERNAL_H

#include "base/strata.h"
#include "land/braid.h"
#include "land/braid_level.h"
#include "land/dunes.h"
#include "land/landscape.h"
#include "land/meander.h"
#include "objects/terrain/envelope.h"
#include "objects/terrain/lift.h"
#include "objects/terrain/terrain.h"

// Streams of the object's seed.
enum {
    STREAM_OUTLETS = 1,
    STREAM_RIVER_GROWTH = 2,
    STREAM_FIELD = 4,
    STREAM_RIVER_POINTS = 12,
    STREAM_BROOK_POINTS = 13,
    STREAM_WARP_X = 21,
    STREAM_WARP_Z = 22,
    STREAM_NOISE = 23,
    STREAM_UPLIFT = 31,
    STREAM_TERRACES = 41,
    STREAM_WINDINGS = 42,
    STREAM_FOREST = 61,
    STREAM_COURSE = 71,
    STREAM_PLATEAU = 72,
    STREAM_WEAKNESS = 73,
    STREAM_WATER_WAYS = 74,
    STREAM_JOINTS = 75,
    STREAM_TEPHRA = 76,
    STREAM_LAVA = 77,
    STREAM_CRATER = 78,
    STREAM_BREACH = 79,
    STREAM_CONES = 80,
    STREAM_SAND = 81,
    STREAM_PLAIN = 82,
    STREAM_KARST = 83,
    STREAM_MEANDER = 84,
    STREAM_SCROLLS = 85,
    STREAM_LIPS = 86,
    STREAM_DELTA = 87,
    STREAM_BASINS = 88,
    STREAM_LUMPS = 89,
    STREAM_BLOCKS = 90,
    STREAM_BARRANCOS = 91
};

// The tree and everything derived from it.
typedef struct Terrain {
    const TerrainParams *params; // borrowed
    uint64_t seed;
    OutTree *tree;        // rivers or ridges, heights and radii filled in; owned by the Grown
    HeightField *map;     // of TERRAIN_MAP: lifts, shares of the relief; of TERRAIN_SURVEY: heights
    RidgeLift *lift;      // of TERRAIN_RIDGES; all that follows is of TERRAIN_RIVERS
    float *area;          // m^2, drainage area of each node
    float *uplift;        // factor on gradients at each node
    float gradient;       // of hillslopes at uplift 1
    TroughEnvelope *land; // heights of valleys and slopes
    Strata *strata;       // beds of rock, in the terrain's own space; NULL = none
    Landscape *evolved;   // of landforms; set by terrain_heights
    HeightField *ground;  // of TERRAIN_VOLCANO: HeightField.ground on the landscape's grid; of
                          // TERRAIN_COAST: m to the edge of what waves have reached
    Dunes *dunes;         // of TERRAIN_DUNES; set by terrain_heights
    Braid *braid;         // of TERRAIN_BRAIDED, with the two that follow; set by terrain_heights
    BraidLevel *level;
    float *lines;             // likewise: of its flow, see land/braid_lines.h
    struct DeltaLand *delta;  // of TERRAIN_DELTA; set by terrain_heights
    Meander *meander;         // of TERRAIN_MEANDER; set by terrain_heights
    HeightField *plain;       // likewise: its land, sample by sample
    HeightField *sides;       // m by which the slopes beside the valley are above its floor
    TroughEnvelope *distance; // m to the nearest river, in plan
    // The visible rivers on the finished heights, set by terrain_heights; NULL or without nodes if
    // none is wide enough.
    OutTree *water; // steps of at most half a cell; y = the water's level, radius = half width
    float *drop;    // m that water falls from each node to its parent; 0 = it flows
    struct RiverFlow *flow; // of each node
    TroughEnvelope *shore;  // m to the water's edge, negative in the water
    uint8_t *bank;          // of each sample: 1 = in a bed or at its edge
    struct Lakes *lakes;    // at their spill levels; NULL = none are wanted
    float *lake_depth;      // m of each sample, 0 = no lake; likewise
} Terrain;

// grow_plane.c: how a tree grows on the plane.
typedef struct PlaneGrowth {
    float size;      // m, side of the square
    bool ellipse;    // attractors lie within an ellipse about the middle, not in the whole square
    float extent[2]; // m, of the ellipse along x and z
    int64_t count;   // attractors of the finest level, if they covered the square
    float winding;
    const FieldParams *fields;
    int field_count;
    float field_weight;
} PlaneGrowth;

// Grows a tree that has its roots. *tree is replaced.
bool terrain_grow_plane(OutTree **tree, const PlaneGrowth *growth, const Recipe *recipe, Error *e);

// source.c: the tree of a file or a picture, on the plane y = 0, radii those of the source (those
// of rivers 0). TREE_DRAINS leads its roots to the terrain's border. The caller frees the tree.
typedef enum TreeUse { TREE_RISES, TREE_DRAINS } TreeUse;
OutTree *terrain_read_tree(const TerrainParams *params, const TreeSource *source, TreeUse use,
                           const Recipe *recipe, Error *e);

static inline bool tree_source_given(const TreeSource *source)
{
    return source->file || source->image;
}

// roughness.c: wavelength of the noise's first octave, m.
float terrain_noise_wavelength(const TerrainParams *params);
// Most displacement of places by the noise, m.
float terrain_warp_reach(const TerrainParams *params);
// Moves a place by the noise, at most by `share` of what the parameters allow.
void terrain_warp(const Terrain *terrain, float share, float *x, float *z);
// All octaves of the noise, m, for slopes of gradient 1.
float terrain_noise_at(const Terrain *terrain, float x, float z);

// rivers.c, ridges.c: the tree of the form, on the plane y = 0. *tree may be set on failure.
bool terrain_grow_rivers(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                         Error *e);
bool terrain_grow_ridges(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                         Error *e);

// ridges.c: heights of the crests, radii = half widths of their bands.
bool terrain_raise_ridges(Terrain *terrain, const Run *run, Error *e);
// The height at a place that ridges or a map lift. The noise is in proportion to the slopes and
// fades toward the plain.
float terrain_lifted_at(const Terrain *terrain, float x, float z);
// Of land lifted by ridges or a map: m, and the width (share of the size) over which it falls.
float terrain_lift_relief(const TerrainParams *params);
float terrain_lift_width(const TerrainParams *params);
float terrain_lift_sign(const TerrainParams *params);      // -1 = the land is lowered
LiftCurve terrain_lift_curve(const TerrainParams *params); // absolute heights
RidgeLift *terrain_ridge_lift(const Terrain *terrain, float margin, const Run *run, Error *e);

enum { TERRAIN_MOST_COLORS = 64 };

// color_map.c: the lifts that the picture's colours tell. The caller frees the field.
HeightField *terrain_read_map(const TerrainParams *params, const Run *run, Error *e);

// survey.c: the square of the survey, lowest height 0. The caller frees the field.
HeightField *terrain_read_survey(const TerrainParams *params, const Run *run, Error *e);
// The rivers that drain it, y = their level; none if they have no water. *tree may be set on
// failure.
bool terrain_find_rivers(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                         Error *e);
// Fills terrain->area, ->uplift (1) and the tree's radii.
bool terrain_finish_survey(Terrain *terrain, const Run *run, Error *e);
// The height at a place: terrain->map's, with detail finer than its cells.
float terrain_surveyed_at(const Terrain *terrain, float x, float z);

// uplift.c: fills terrain->uplift, at least 0.02 at each node. Reads the user's picture.
bool terrain_uplift(Terrain *terrain, const Run *run, Error *e);
// What the strokes alone make of an uplift of 1 at a place in shares of the size; at least 0.02.
float terrain_stroke_uplift(const UpliftParams *uplift, float u, float v);

// areas.c: fills terrain->area: land drains through its nearest node.
bool terrain_areas(Terrain *terrain, const Run *run, Error *e);

// profile.c: one pass over the rivers: areas, then heights for hillslopes of gradient
// uplift * 1, from the outlets up. A river that would run below another's slope is captured by it,
// and river ends on another's slope are dropped: *captures counts both. Nodes are sorted by height.
bool terrain_profile(Terrain *terrain, const Run *run, int64_t *captures, Error *e);

// valleys.c: fills terrain->area, ->uplift and ->gradient; the tree's heights and radii.
bool terrain_fill_rivers(Terrain *terrain, const Run *run, Error *e);
// The envelope of all troughs. flat: envelope of distances, with each river at height 0. The caller
// frees it.
TroughEnvelope *terrain_envelope(const Terrain *terrain, bool flat, const Run *run, Error *e);
// The height and the wetness at a place of the land between rivers.
float terrain_valleys_at(const Terrain *terrain, float x, float z, float *wetness);
// The wetness beside surveyed rivers.
float terrain_wetness_at(const Terrain *terrain, float x, float z);
// No sample along a river is above it.
void terrain_carve_rivers(HeightField *field, const OutTree *rivers);

// Half the width of a valley floor with this drainage area, m.
static inline float terrain_valley(const TerrainParams *params, float area)
{
    return params->rivers.valley * sqrtf(area);
}

// The trough of node i's piece of river (to its parent), for hillslopes of `gradient` times uplift.
Trough terrain_trough(const Terrain *terrain, int64_t i, float gradient);

// Reach of beds beyond the water's edge, in cells: the corners of every cell that water touches.
#define TERRAIN_STRAND 2.0f

// How deep the bed of water of half width `half` lies under the water's level, d from its middle:
// a quarter of that width in the middle, a little at its edge and beside it.
static inline float terrain_bed_depth(float half, float d)
{
    float share = d < half ? d / half : 1.0f;
    return half * (0.03f + 0.25f * (1.0f - share * share));
}

// levels.c: sets the heights of the nodes to the water's level, as high as the land allows. Returns
// the drop of each node, m: 0, or how far the water falls from it to its parent. Between the lip of
// a fall and its foot all levels are the foot's. The caller frees the array.
float *terrain_find_levels(OutTree *water, const RiverParams *rivers, const HeightField *field,
                           Error *e);

// flow.c: what flows at a node.
typedef struct RiverFlow {
    float discharge; // m^3/s
    float slope;     // of the water's surface along its way
    float depth;     // m, and
    float speed;     // m/s, of a channel of this slope and the water's width
    float foam;      // 0..1: share of the surface that is white
    bool at_fall;    // is it within a few steps of a lip?
} RiverFlow;

// m^3/s in a river of this half width, m.
float terrain_discharge(const TerrainParams *params, float half);
// The flow of this discharge in a channel of this half width and slope; foam as nature's.
RiverFlow terrain_flow_of(float discharge, float half, float slope);
// The flow at each node; foam drifts on below rapids and falls. The caller frees the array.
RiverFlow *terrain_find_flow(const TerrainParams *params, const OutTree *water, const float *drop,
                             Error *e);
// What is left of foam, 0..1, after some seconds of drifting.
float terrain_foam_left(float foam, float seconds);

// Length that a metre along the flow has in the coordinates of foam (Mesh.uv), which a metre across
// has as it is.
float terrain_drawn_out(float speed);

// Widens the river at the feet of falls, where the water has dug a pool.
void terrain_widen_pools(OutTree *water, const float *drop);

// fall_path.c: speed of a river's water where it leaves a lip, m/s.
float terrain_lip_speed(float discharge, float half);

// What a strand of falling water meets.
typedef struct FallPath {
    const struct DrawnLand *land; // NULL = nothing
    Vec3 way;                     // unit, level: downstream
    float level;                  // m, of the pool in which the path ends
    float film;                   // m over the land at which water slides
    float step;                   // s
} FallPath;

// Places on the path, `step` apart but for the last, at most `most`; returns their number.
int terrain_fall_path(const FallPath *path, Vec3 start, Vec3 velocity, Vec3 *place, int most);

// Their number, and the height and place of the highest; nothing without falls.
bool terrain_measure_falls(const Terrain *terrain, MeasureList *list, Error *e);

// bed.c: lays the rivers that the grid resolves on the finished heights: fills terrain->water,
// ->shore and ->bank and digs the beds.
bool terrain_lay_rivers(Terrain *terrain, HeightField *field, const Run *run, Error *e);

// The bed of the river that a place is in or beside, `away` from the water's edge (negative: in
// it), by the river's node next to it. Beside the water the land is as low as at its edge. cell: of
// the terrain, m.
float terrain_bed_at(const Terrain *terrain, int32_t node, float x, float z, float away,
                     float cell);

// Fills field->water from the lake and the rivers, if there are any: the level of the water over
// the land or beside it, the lake's everywhere.
bool terrain_record_water(const Terrain *terrain, HeightField *field, const Run *run, Error *e);

// The widest child of each node of terrain->water, -1 at the ends; the caller frees the array.
int32_t *terrain_main_children(const OutTree *water, Error *e);

// m from a place to the nearest river's water, negative in it; infinite without water.
float terrain_shore(const Terrain *terrain, float x, float z);

// erosion.c: thermal and stream erosion of a field; its changes are added to field->change.
bool terrain_erode(HeightField *field, const TerrainErosionParams *params, const Run *run,
                   Error *e);

enum { WALLS_COARSE_CELLS = 512, WALLS_FINE_CELLS = 1024 }; // a side
// weakness.c: how weak the rock of a landscape is: up to 2.5, with a mean of 1.
typedef struct WeaknessNoise {
    double unit;          // m
    float scale;          // waves of the first octave in a unit
    int octaves;          // each of half the length of the one before
    float gain, strength; // of each octave beside the one before; of all
    float least;
} WeaknessNoise;
void terrain_set_weakness(Landscape *land, const WeaknessNoise *noise, uint64_t key,
                          const Run *run);

// row_noise.c: samples `first` .. `first + count - 1` of a row, and noise of mean 0 and variance 1
// at them (n: `count` of it).
enum { ROW_PART = 256 };
typedef struct RowPart {
    const Landscape *land; // borrowed
    int row, first, count; // at most ROW_PART
} RowPart;
typedef struct RowNoise {
    double unit, scale; // m; waves of the first octave in a unit
    int octaves;        // each of half the length of the one before
    float gain;         // of each octave beside the one before
    uint64_t key;
} RowNoise;
RowPart row_part(const Landscape *land, int row, int first);
void row_noise(const RowNoise *noise, const RowPart *part, float *n);

// Land that rises while streams cut it down and soil creeps away, of the forms hills and badlands:
// K per lifetime where evolution.streams is 1, and, measured (tests/objects/test_hills.c), the
// distance from valley to valley over sqrt(D / K).
#define TERRAIN_INCISION 45.0
#define TERRAIN_VALLEY_SPACING 15.5
// roughen.c: the low ground on which that begins: a twenty-fifth of the relief high, and up and
// down by `bumps` of half of that. wavelength: m.
void terrain_roughen(Landscape *land, float relief, double wavelength, float bumps, uint64_t key);
// roughen.c: lumps of a few cells, which turn the water of even walls to each other: without them
// it would run down side by side along the grid. They leave, or add, what they are.
void terrain_add_lumps(Landscape *land, double height, double wavelength, uint64_t seed,
                       const Run *run);

// walls.c: couloirs and scree by erosion.debris; also what is loose then, to field->wetness.
bool terrain_carve_walls(const Terrain *terrain, HeightField *field, const Run *run, Error *e);

// beds.c: the beds that the parameters give, or the landform's own, with their top in the plateau;
// *strata stays NULL without any.
bool terrain_lay_beds(const TerrainParams *params, Strata **strata, Error *e);

// course.c: the courses of the rivers that cut a plateau, from their outlets up, on the plane y =
// 0, radius = half the water's width.
bool terrain_grow_courses(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                          Error *e);

// Heights of the courses, and areas that tell a river's main stem.
bool terrain_fill_courses(Terrain *terrain, const Run *run, Error *e);

// plateau.c: the plateau as it is now, on a grid of its own. The caller frees it.
Landscape *terrain_evolve_plateau(Terrain *terrain, const Run *run, Error *e);
// outlets.c: makes gaps in the border bases at height 0. The rest of it is a divide, so that
// mirrored land goes on.
void terrain_open_outlets(const Terrain *terrain, int outlets, Landscape *land);
// alps.c: the same of the form alps.
Landscape *terrain_evolve_alps(Terrain *terrain, const Run *run, Error *e);
// hills.c: the same of the form hills.
Landscape *terrain_evolve_hills(Terrain *terrain, const Run *run, Error *e);
// hills.c: cells a side that resolve what creeping soil leaves; nothing is smaller, so the land is
// the same at any resolution.
int terrain_hill_cells(const TerrainParams *params);
// hills_measure.c: after terrain_evolve_hills.
bool terrain_measure_hills(const Terrain *terrain, MeasureList *list, Error *e);
// hills.c: fills in the wetness: 1 where the water of a hollow gathers, 0 on crests.
bool terrain_wet_hollows(HeightField *field, Error *e);
// badlands.c: the same of the form badlands.
Landscape *terrain_evolve_badlands(Terrain *terrain, const Run *run, Error *e);
// badlands.c: cells a side that resolve the rills, at most as fine as the land is sampled.
int terrain_badland_cells(const TerrainParams *params);
// badlands.c: fills in the wetness: 0 on crests, up to 0.5 in rills and gullies, 1 on washes.
bool terrain_wet_washes(HeightField *field, Error *e);
// badlands_measure.c: after terrain_evolve_badlands.
bool terrain_measure_badlands(const Terrain *terrain, MeasureList *list, Error *e);
// volcano.c: the same of the form volcano. terrain->ground: HeightField.ground on its grid, as
// heights.
Landscape *terrain_evolve_volcano(Terrain *terrain, const Run *run, Error *e);
// volcano_pits.c: raises the ground of pits of less than this depth, m, so that they drain.
bool terrain_fill_shallow_pits(HeightField *field, float depth, Error *e);
// volcano_measure.c: after terrain_evolve_volcano.
bool terrain_measure_volcano(const Terrain *terrain, MeasureList *list, Error *e);
// alps_climate.c: fills field->climate: altitudes as snow feels them. It drifts with a wind from
// this azimuth, degrees clockwise from north. hollow: share of the relief by which snow lies lower
// in a deep hollow.
bool terrain_find_climate(const TerrainParams *params, float wind, float hollow, HeightField *field,
                          const Run *run, Error *e);

// measure.c: the exponent of the valleys' profiles.
bool terrain_measure_alps(const Terrain *terrain, MeasureList *list, Error *e);

// dunes.c: the sand sea as it is now, with the last wind over it. The caller frees it.
Dunes *terrain_blow_dunes(const Terrain *terrain, const Run *run, Error *e);
// The wind that blows last.
DuneWind terrain_last_wind(const TerrainParams *params);
// Fills sample i of a field at a place.
void terrain_sample_dunes(const Terrain *terrain, HeightField *field, int64_t i, float x, float z);

// braided.c: fills terrain->braid, ->level and ->sides.
bool terrain_grow_braided(Terrain *terrain, const Run *run, Error *e);
// Mean depth of the forming flow, m.
double terrain_braid_depth(const TerrainParams *params);
// Fills sample i of a field at a place.
void terrain_sample_braided(const Terrain *terrain, HeightField *field, int64_t i, float x,
                            float z);
// braided.c: of the flow at a place, from 0 in still water to 1.
float terrain_braid_roughness(const Terrain *terrain, float x, float z);
// braided.c: the streamline at a place: m across the plain if the water flowed evenly over it.
float terrain_braid_line(const Terrain *terrain, float x, float z);
// flow_water.c: takes away standing water that ends where its level is not known.
bool terrain_drain_pools(HeightField *field, Error *e);
// Fills terrain->bank where the ground is less than `reach` m above water near it.
bool terrain_keep_shores(Terrain *terrain, const HeightField *field, float reach, Error *e);
// braided_measure.c: after terrain_heights.
bool terrain_measure_braided(const Terrain *terrain, MeasureList *list, Error *e);

// meander.c: fills terrain->meander and ->plain.
bool terrain_grow_meander(Terrain *terrain, const Run *run, Error *e);
void terrain_sample_meander(const Terrain *terrain, HeightField *field, int64_t i, float x,
                            float z);
float terrain_meander_roughness(const Terrain *terrain, float x, float z);
// After terrain_heights.
bool terrain_measure_meander(const Terrain *terrain, MeasureList *list, Error *e);

// delta.c: fills terrain->delta.
bool terrain_grow_delta(Terrain *terrain, const Run *run, Error *e);
void terrain_sample_delta(const Terrain *terrain, HeightField *field, int64_t i, float x, float z);
bool terrain_finish_delta(Terrain *terrain, HeightField *field, const Run *run, Error *e);
// Mud in the water at a place, of that in the river, 0..1.
float terrain_delta_load(const Terrain *terrain, float x, float z);
// After terrain_heights.
bool terrain_measure_delta(const Terrain *terrain, MeasureList *list, Error *e);
// delta_beyond.c: the sea and the old land around the square, level and bare.
bool terrain_add_delta_beyond(const Terrain *terrain, const Placing *placing, Error *e);

// The land at a place.
typedef struct EvolvedPlace {
    float height; // m
    float loose;  // m of loose ground on the rock
    float change; // m since the plateau was whole; of alps and volcanoes, which had none, 0
} EvolvedPlace;
// At `count` <= FORM_MOST_SAMPLES places, whose x are given, of a row.
void terrain_evolved_along(const Terrain *terrain, const float *x, float z, int count,
                           EvolvedPlace *place);
// Height of the river at a node of the tree of courses, m.
float terrain_course_height(const TerrainParams *params, const OutTree *tree, int64_t i);

// The sample nearest to a place.
static inline int64_t terrain_sample_at(const HeightField *field, float x, float z)
{
    float u = (x - field->origin.x) / field->cell.x, v = (z - field->origin.y) / field->cell.y;
    int64_t column = (int64_t)(clampf(u, 0.0f, (float)(field->columns - 1)) + 0.5f);
    int64_t row = (int64_t)(clampf(v, 0.0f, (float)(field->rows - 1)) + 0.5f);
    return row * field->columns + column;
}

// geometry.c: the square's copy number (column, row) away: odd ones are mirrored, so that borders
// meet, unless the form repeats by itself.
Transform terrain_copy(const TerrainParams *params, int column, int row);

// Has the square a copy of itself there? Not where it is itself, nor if the form has surroundings
// of its own.
bool terrain_has_copy(const TerrainParams *params, int column, int row);

// Kind.surface_copies: those of the square's land.
int terrain_surface_copies(const void *params, SurfaceCopy *copy);
// Adds copies of a part around the square. Takes ownership of the mesh.
bool terrain_add_copies(Mesh *mesh, const TerrainParams *params, const Placing *placing, int role,
                        Error *e);

#endif
