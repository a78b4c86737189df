// Terrain (Tanaka et al., section 5.5). Out-trees on a plane give the heights: rivers by the
// slope-area law, with ridges where the slopes of two rivers meet, or ridges by a band swept along
// them that lifts the land. Sparse convolution noise makes fine erosion, or land alone. All but the
// last passes are functions of the place, not of a grid: more samples show the same land in more
// detail.
#ifndef RAMIFY_OBJECTS_TERRAIN_TERRAIN_H
#define RAMIFY_OBJECTS_TERRAIN_TERRAIN_H

#include "field/guide_field.h"
#include "land/height_field.h"
#include "land/jointing.h"
#include "objects/common/recipe.h"
#include "objects/terrain/landform.h"
#include "objects/terrain/lift.h"
#include "outtree/out_tree.h"
#include "render/material/material.h"

// One stroke of the user's brush: the land rises faster along a line. Places are shares of the
// terrain's size, (0, 0) in its middle, so they do not depend on it.
typedef struct UpliftStroke {
    float from[2], to[2]; // equal: a round spot
    float radius;         // distance at which the stroke ends
    float strength;       // added to `base` in the middle of the stroke; negative sinks land
} UpliftStroke;

typedef struct UpliftParams {
    float base;  // 1
    float noise; // 0..1: relative variation from place to place
    UpliftStroke *strokes;
    int stroke_count;
    char *image; // grey picture over the terrain, north up, a factor; NULL = none
} UpliftParams;

// What the land's heights come from.
typedef enum TerrainForm {
    TERRAIN_RIVERS,
    TERRAIN_RIDGES,
    TERRAIN_MAP,
    TERRAIN_NOISE,
    TERRAIN_SURVEY,
    TERRAIN_CANYON,  // a plateau that a river has cut
    TERRAIN_MESAS,   // what is left of one
    TERRAIN_ALPS,    // a rising block, cut by rivers and worn by glaciers
    TERRAIN_VOLCANO, // tephra and lava about a vent
    TERRAIN_DUNES,   // sand that the wind carries over a plain
    TERRAIN_HILLS,   // creeping soil and streams
    TERRAIN_COAST,   // cliffs that waves cut
    TERRAIN_BRAIDED, // a braided river in its valley
    TERRAIN_KARST,   // towers of dissolved limestone
    TERRAIN_MEANDER, // a winding river in its floodplain
    TERRAIN_DELTA,   // a river that builds land in a shallow sea
    TERRAIN_BADLANDS // soft beds that rills cut
} TerrainForm;

// What is drawn.
typedef enum TerrainShow {
    SHOW_LAND,
    SHOW_MAP, // the plane with the altitudes of the land, for materials that show them
    SHOW_TREE // the plane and the tree's lines
} TerrainShow;

// A tree that is not grown.
typedef struct TreeSource {
    char *file;  // SWC; NULL = none
    float scale; // m per unit of the file
    char *image; // painted lines, laid over the terrain, north up; NULL = none
    bool invert; // dark lines on bright
} TreeSource;

typedef struct RidgeStart {
    float at[2]; // shares of the size, as of strokes
} RidgeStart;

typedef struct RidgeParams {
    TreeSource source;
    RidgeStart *starts; // of grown ridges; none = the middle
    int start_count;
    float extent[2];     // of the ellipse that ridges grow in, shares of the size
    int64_t count;       // attractors of the finest level, if they covered the square
    float winding;       // as of rivers
    FieldParams *fields; // guide vector fields over the ridges' growth
    int field_count;
    float field_weight;
    float width;    // half width of the widest band, as a share of the size
    float tip;      // height and width at the tips of grown ridges, as a share of the start's
    LiftStop *lift; // NULL = the kind's own; all heights have one sign
    int lift_count;
} RidgeParams;

// A painted map, whose colours are heights.
typedef struct MapParams {
    char *image;       // laid over the terrain, north up
    ColorStop *colors; // NULL = terrain_altitudes
    int color_count;
} MapParams;

// Surveyed heights.
typedef struct SurveyParams {
    char *file;         // a raster that GDAL reads
    int band;           // 1 = the first
    float center[2];    // m: the square's middle, to the east and to the south of the raster's
    float exaggeration; // factor on heights
} SurveyParams;

typedef struct RiverParams {
    TreeSource source;
    int outlets;         // on the border
    TerrainSide side;    // sides with outlets
    int64_t count;       // attractors of the finest level: about as many brooks
    float winding;       // noise of the growth's directions, 0..1
    float gradient;      // of brooks, as a share of the hillslopes' gradient, 0..0.9
    float concavity;     // exponent of the slope-area law; 0.42 in nature
    float valley;        // half width of valley floors, as a share of sqrt(drainage area)
    float water;         // half width of the water, likewise; 0 = no water
    float runoff;        // m^3/s for a km^2 of drainage area
    float foam;          // factor on the white water of rapids
    float shutter;       // s for which a picture shows falling water
    float fall_height;   // m: least height of a step over which the water falls; 0 = none
    float fall_slope;    // least slope of such a step, over two cells
    FieldParams *fields; // guide vector fields over the rivers' growth
    int field_count;
    float field_weight;
} RiverParams;

typedef struct TerrainNoiseParams {
    int iterations;   // octaves of sparse convolution noise, eq. (16); 0 = none
    float amplitude;  // height of the first octave as a share of its wavelength
    float wavelength; // of the first octave, as a share of the size; 0 = the brooks' spacing
    float gain;       // height of an octave as a share of the last one's
    float ridged;     // 0 = round, 1 = ridges with sharp crests
    float warp;       // displacement of slopes, as a share of the first wavelength
} TerrainNoiseParams;

typedef struct TerrainErosionParams {
    float streams; // 0..1: depth of gullies cut by water (stream power law)
    float thermal; // 0..1: how far slopes steeper than `talus` relax to it
    float talus;   // degrees
    float debris;  // debris flows and rockfall that cut couloirs; 0 = none, 1 = as in the Alps
} TerrainErosionParams;

typedef struct TerrainTerraceParams {
    int count;      // hard beds between the lowest and the highest point; 0 = none
    float strength; // 0..1: height of the steps
    float sheer;    // 0..1: 0 = steps are slopes, 1 = cliffs
} TerrainTerraceParams;

enum { TERRAIN_MOST_BEYOND = 8 }; // rings of copies

typedef struct TerrainForestParams {
    int count;       // conifers; 0 = none
    float height;    // m, of the tallest
    float low, high; // altitudes between which they stand, shares of the relief
    float slope;     // degrees: none on steeper land
    float clumping;  // 0 = even, 1 = in woods with clearings
    int beyond;      // rings of the square's copies on which they stand, too
} TerrainForestParams;

// Lakes at their spill levels.
typedef struct TerrainLakeParams {
    int count;         // at most so many, the largest; 0 = none
    float area;        // m^2, least; 0 = by the size
    float depth;       // m, least, of the deepest place; 0 = by the size
    float beach;       // m: width of a beach on each side of the shoreline; 0 = by the lake's size
    float silt;        // of TERRAIN_ALPS, 0..1: share of the basins that streams have filled
    int basins;        // that are dug; 0 = none
    float basin_area;  // m^2, of the largest; 0 = by the size
    float deepness;    // factor on the mean depth of mountain lakes of their areas
    float altitude[2]; // of the sills of dug basins, shares of the relief
} TerrainLakeParams;

// The world cut into tiles of finer ground (land/tiles.h).
typedef struct TerrainTileParams {
    int count;    // a side; 0 = none
    int cells;    // a side of a tile
    float detail; // TileGrid.detail
    bool drawn;   // the land is drawn of them
} TerrainTileParams;

typedef struct TerrainParams {
    Vec3 position;     // m: of the middle, at the height of the outlets
    float size;        // m, side of the square
    float relief;      // m from the outlets (of ridges: from the plain) to the highest point; 0 =
                       // natural slopes
    int resolution;    // cells a side
    float water_level; // share of the relief under water (a lake or the sea); 0 = none
    TerrainForm form;
    TerrainShow show;
    UpliftParams uplift;
    RiverParams rivers;
    RidgeParams ridges;
    MapParams map;
    SurveyParams survey;
    TerrainNoiseParams noise;
    TerrainErosionParams erosion;
    TerrainTerraceParams terraces;
    JointingParams joints; // spacing 0 = rock does not break; the seed is the terrain's
    TerrainForestParams forest;
    TerrainLakeParams lakes;
    StrataParams strata; // top: 0 = the plateau's height
    CanyonParams canyon;
    MesaParams mesas;
    AlpsParams alps;
    VolcanoParams volcano;
    DuneParams dunes;
    HillParams hills;
    BadlandParams badlands;
    CoastParams coast;
    BraidedParams braided;
    KarstParams karst;
    MeanderParams meander;
    DeltaParams delta;
    EvolutionParams evolution;
    TerrainTileParams tiles;
    int beyond;       // rings of mirrored copies around the square
    float mesh_error; // largest error of the mesh, as a share of its distance to the camera
} TerrainParams;

TerrainParams terrain_params_default(void); // 12 km of mountains

// Fills in numbers that are 0 from the other parameters. Borrows the arrays of params.
TerrainParams terrain_params_resolve(const TerrainParams *params);

// The stops of the ridges' lift: the user's, or the kind's own.
const LiftStop *terrain_lift_stops(const TerrainParams *params, int *count);

// The recipe (see recipe.h). Grows the tree in the plane y = 0, roots of rivers at their outlets;
// none for TERRAIN_MAP and TERRAIN_NOISE. After finish, y is the river's height before erosion and
// terraces, and radii are half the width of the water; of ridges the crest's height before noise,
// and half the width of the band. In the terrain's own space, position not added. The state is a
// Terrain.
bool terrain_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool terrain_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e);

// Heights and wetness; square, resolution + 1 samples per side. Of TERRAIN_RIVERS and
// TERRAIN_SURVEY with rivers every sample off
// the rim drains, and beds of rivers wide enough for the grid are dug last. The same bits for any
// number of threads.
HeightField *terrain_heights(const void *params, const Grown *grown, const Run *run, Error *e);

// The map's own scale of colours, also that of the material `altitude`.
enum { TERRAIN_ALTITUDES = 6 };
extern ColorStop terrain_altitudes[TERRAIN_ALTITUDES];

// May there be lakes at their spill levels?
bool terrain_holds_lakes(const TerrainParams *params);

// May it be drawn of tiles? A map is no land.
bool terrain_can_be_tiled(const TerrainParams *params);
// Do its tiles end at the square's border? Surroundings of a form's own, copies that fall with the
// valley or lie along the shore alone, and broad water, which the copies share with the square, are
// drawn as those of land that is not tiled, all on a flat Earth.
bool terrain_tiles_end(const TerrainParams *params);

// Does the land come from processes that wear it?
bool terrain_evolves(const TerrainParams *params);

// Cells a side of the grid of those processes.
int terrain_evolved_cells(const TerrainParams *params);

// Height of the lake, in the field's own space.
float terrain_water_height(const TerrainParams *params, const HeightField *field);

enum { TERRAIN_LAND, TERRAIN_WATER, TERRAIN_FOLIAGE, TERRAIN_LINES }; // roles of materials

// Adds land (finer toward the eye, no cracks; even without one), water and forest.
bool terrain_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Of landforms: incision, cliffs, talus, what is left of the plateau, the canyon's width; of
// dunes heights, slopes and distances; of braided rivers threads and bars. After terrain_heights.
bool terrain_measure(const void *params, const Grown *grown, const Recipe *recipe,
                     MeasureList *list, Error *e);

extern const struct Table terrain_table; // of its parameters

#endif
