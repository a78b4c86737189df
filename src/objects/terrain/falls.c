// Waterfalls: where a river drops over a step of the land, with what clouds show of them.
#include "base/memory.h"
#include "objects/terrain/fall.h"
#include "objects/terrain/spray.h"
#include "objects/terrain/white_water.h"

#include <math.h>
#include <stdlib.h>

enum {
    ROWS = 96, // of a strand, or in the distance at least
    FEWEST_ROWS = 6,
    SHEET = 28, // rows of the sheet in which water leaves the lip, and likewise
    FEWEST_SHEET = 4,
    MANY = 26, // up to so many falls have FALL_ACROSS strands a layer, more falls fewer, but never
    FEWEST = 12,   // fewer than this,
    FEWEST_FAR = 3 // or in copies of the square this
};

static int strand_in_scene(const Fall *fall, int strand, Vec3 place[FALL_STEPS], float *step)
{
    int count = fall_strand_path(fall, strand, place, step);
    for (int i = 0; i < count; i++) {
        place[i] = drawn_in_scene(fall->land, vec3_add(place[i], fall->terrain->params->position));
    }
    return count;
}

// What it throws up, in the scene.
static SprayParcels *fall_spray(const Fall *fall, Error *e)
{
    SprayParcels *spray = memory_alloc_zero(1, sizeof *spray, e);
    FallSpray thrown = {.way = fall->way,
                        .across = fall->across,
                        .half = fall->half,
                        .height = fall->terrain->water->position[fall->lip].y - fall->level,
                        .cover = fall->cover,
                        .strands = fall_strand_count(fall),
                        .key = fall_stream(fall, FALL_STREAM_SPRAY)};
    bool done = spray;
    for (int strand = 0; done && strand < thrown.strands; strand++) {
        Vec3 place[FALL_STEPS];
        int count = strand_in_scene(fall, strand, place, &(float){0});
        done = count < 2 || terrain_spray_strand(&thrown, strand, place, count, spray, e);
    }
    if (!done) {
        spray_free(spray);
        return NULL;
    }
    return spray;
}

// Its white water, in the scene.
static SprayParcels *fall_water(const Fall *fall, Error *e)
{
    SprayParcels *water = memory_alloc_zero(1, sizeof *water, e);
    int strands = fall_strand_count(fall);
    WhiteWater white = {.across = fall->across,
                        .way = fall->way,
                        .spacing = 2.0f * fall->half / (float)fall->detail.columns,
                        .discharge = fall->terrain->flow[fall->lip].discharge,
                        .shutter = fall->terrain->params->rivers.shutter,
                        .key = fall_stream(fall, FALL_STREAM_WATER)};
    bool done = water;
    for (int strand = 0; done && strand < strands; strand++) {
        Vec3 place[FALL_STEPS];
        WhiteStrand part = {.number = strand,
                            .side = fall->half * fall_strand_side(fall, strand),
                            .place = place,
                            .width = fall_strand_width(fall, strand)};
        part.count = strand_in_scene(fall, strand, place, &part.step);
        done = part.count < 2 || white_water_strand(&white, &part, water, e);
    }
    if (!done) {
        spray_free(water);
        return NULL;
    }
    white_water_settle(&white, water);
    return water;
}

// So many that up to 400 falls take at most about 100 MB together.
static int strands_across(const Terrain *terrain)
{
    int64_t falls = 0;
    for (int64_t i = 0; i < terrain->water->count; i++) {
        falls += terrain->drop[i] > 0.0f;
    }
    int64_t columns = falls > MANY ? (int64_t)FALL_ACROSS * MANY / falls : FALL_ACROSS;
    return columns > FEWEST ? (int)columns : FEWEST;
}

static int clamped(float value, int least, int most)
{
    return value < (float)least ? least : value > (float)most ? most : (int)value;
}

// As finely as can be seen, in copies of the square; the square's own falls are all drawn alike.
static FallDetail detail_of(const DrawnLand *land, int32_t lip, float height, int columns)
{
    const float seen = 0.0004f; // of the distance, m; see also objects/common/near_copies.h
    const OutTree *water = land->terrain->water;
    FallDetail full = {columns, ROWS, SHEET};
    float fine = drawn_is_copy(land) ? seen * drawn_away(land, water->position[lip]) : 0.0f;
    if (fine <= 0.0f) {
        return full;
    }
    if (height < fine) {
        return (FallDetail){0};
    }
    return (FallDetail){clamped(2.0f * water->radius[lip] / fine, FEWEST_FAR, full.columns),
                        clamped(height / fine, FEWEST_ROWS, full.rows),
                        clamped(height / fine, FEWEST_SHEET, full.sheet)};
}

// Adds a fall with what clouds may show of it. Those of copies have nothing for clouds, whose grids
// would reach as far.
static bool add_fall(Fall *fall, const Placing *placing, Error *e)
{
    bool spray = placing->keep_spray && !drawn_is_copy(fall->land);
    fall->breaks = placing->keep_water && !drawn_is_copy(fall->land);
    Part part = {.mesh = fall_mesh(fall, e), .is_water = true};
    if (part.mesh && ((spray && !(part.spray = fall_spray(fall, e))) ||
                      (fall->breaks && !(part.water = fall_water(fall, e))))) {
        part_free_meshes(&part);
    }
    return placing_add(placing, part, TERRAIN_WATER, e);
}

bool terrain_add_falls(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Terrain *terrain = land->terrain;
    const OutTree *water = terrain->water;
    int32_t *main = terrain_main_children(water, e);
    float lake = terrain->params->water_level > 0.0f
                     ? terrain_water_height(terrain->params, land->field)
                     : -INFINITY;
    int columns = strands_across(terrain);
    bool done = main;
    for (int64_t i = 0; done && i < water->count; i++) {
        float top = water->position[i].y;
        if (terrain->drop[i] <= 0.0f || top <= lake) {
            continue;
        }
        Fall fall = {.terrain = terrain, .land = land, .lip = (int32_t)i};
        fall.level = fmaxf(water->position[water->parent[i]].y, lake);
        fall.detail = detail_of(land, fall.lip, top - fall.level, columns);
        fall_init(&fall, main);
        done = fall.detail.columns == 0 || add_fall(&fall, placing, e);
    }
    free(main);
    return done;
}

bool terrain_measure_falls(const Terrain *terrain, MeasureList *list, Error *e)
{
    const OutTree *water = terrain->water;
    int64_t highest = -1;
    double count = 0.0, nan = (double)NAN;
    for (int64_t i = 0; water && terrain->drop && i < water->count; i++) {
        count += terrain->drop[i] > 0.0f;
        bool higher = highest < 0 || terrain->drop[i] > terrain->drop[highest];
        highest = terrain->drop[i] > 0.0f && higher ? i : highest;
    }
    if (highest < 0) {
        return true;
    }
    Vec3 lip = vec3_add(water->position[highest], terrain->params->position);
    return measures_add(list, "waterfalls", count, "", nan, nan, e) &&
           measures_add(list, "fall_height", (double)terrain->drop[highest], "m", nan, nan, e) &&
           measures_add(list, "fall_discharge", (double)terrain->flow[highest].discharge, "m^3/s",
                        nan, nan, e) &&
           measures_add(list, "fall_x", (double)lip.x, "m", nan, nan, e) &&
           measures_add(list, "fall_y", (double)lip.y, "m", nan, nan, e) &&
           measures_add(list, "fall_z", (double)lip.z, "m", nan, nan, e);
}
