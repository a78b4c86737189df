// The table of forms, and what links them to the files that make them.
#include "objects/terrain/coast.h"
#include "objects/terrain/form.h"
#include "objects/terrain/karst.h"

#include "base/memory.h"
#include "land/height_drainage.h"

#include <math.h>

// ---- what the heights are looked up in

static bool prepare_rivers(Terrain *terrain, const Run *run, Error *e)
{
    terrain->land = terrain_envelope(terrain, false, run, e);
    terrain->distance = terrain->land ? terrain_envelope(terrain, true, run, e) : NULL;
    return terrain->distance;
}

static bool prepare_ridges(Terrain *terrain, const Run *run, Error *e)
{
    terrain->lift = terrain_ridge_lift(terrain, terrain_warp_reach(terrain->params), run, e);
    return terrain->lift;
}

static bool prepare_map(Terrain *terrain, const Run *run, Error *e)
{
    terrain->map = terrain_read_map(terrain->params, run, e);
    return terrain->map;
}

static bool prepare_survey(Terrain *terrain, const Run *run, Error *e)
{
    terrain->map = terrain_read_survey(terrain->params, run, e);
    if (terrain->map && terrain->tree->count > 0) {
        terrain->distance = terrain_envelope(terrain, true, run, e);
        return terrain->distance;
    }
    return terrain->map;
}

static bool prepare_dunes(Terrain *terrain, const Run *run, Error *e)
{
    terrain->dunes = terrain_blow_dunes(terrain, run, e);
    return terrain->dunes;
}

// ---- what a field records beside heights and wetness

static bool record_loose(HeightField *field, Error *e)
{
    field->loose = memory_alloc_zero(height_field_count(field), sizeof(float), e);
    return field->loose;
}

// Only a plateau tells what has been worn; before the other landforms rose there was no land.
static bool record_change(HeightField *field, Error *e)
{
    field->change = memory_alloc_zero(height_field_count(field), sizeof(float), e);
    return field->change && record_loose(field, e);
}

static bool record_ground(HeightField *field, Error *e)
{
    field->ground = memory_alloc_zero(height_field_count(field), sizeof(float), e);
    return field->ground && record_loose(field, e);
}

static bool record_wind(HeightField *field, Error *e)
{
    field->periodic = true;
    field->wind = memory_alloc_zero(height_field_count(field), sizeof(Vec2), e);
    return field->wind && record_loose(field, e);
}

static bool record_braided(HeightField *field, Error *e)
{
    int64_t count = height_field_count(field);
    return record_loose(field, e) &&
           (field->age = memory_alloc_zero(count, sizeof *field->age, e)) &&
           (field->water = memory_alloc_zero(count, sizeof *field->water, e));
}

// ---- a sample

static void sample_valleys(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    field->height[i] = terrain_valleys_at(terrain, x, z, &field->wetness[i]);
}

static void sample_lifted(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    field->height[i] = terrain_lifted_at(terrain, x, z);
}

static void sample_survey(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    field->wetness[i] = terrain_wetness_at(terrain, x, z);
    field->height[i] = terrain_surveyed_at(terrain, x, z);
}

static void sample_noise(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    field->height[i] = terrain_noise_at(terrain, x, z);
}

// Wetness is how much of the ground is loose.
static void sample_evolved(const Terrain *terrain, HeightField *field, int64_t i, const float *x,
                           float z, int count)
{
    EvolvedPlace places[FORM_MOST_SAMPLES];
    terrain_evolved_along(terrain, x, z, count, places);
    for (int k = 0; k < count; k++, i++) {
        field->height[i] = places[k].height;
        field->wetness[i] = (float)((double)places[k].loose / ((double)places[k].loose + 1.0));
        field->loose[i] = places[k].loose;
        if (field->change) {
            field->change[i] = places[k].change;
        }
        if (field->ground) {
            field->ground[i] = height_field_at(terrain->ground, x[k], z);
        }
    }
}

// ---- after erosion and terraces

static bool drain(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)run;
    terrain_carve_rivers(field, terrain->tree);
    return height_field_fill(field, 1e-5f, e);
}

static bool drain_survey(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    return terrain->tree->count == 0 || drain(terrain, field, run, e);
}

static bool finish_rivers(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    return (terrain->params->terraces.count <= 0 || height_field_fill(field, 0.0f, e)) &&
           terrain_lay_rivers(terrain, field, run, e);
}

static bool finish_survey(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    return terrain->tree->count == 0 || finish_rivers(terrain, field, run, e);
}

// Sampling leaves pits in the flat floors of valleys.
static bool finish_alps(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    // Avalanches fill couloirs.
    float hollow = params->evolution.debris > 0.0f ? 0.09f : 0.055f;
    return height_field_fill(field, 1e-4f, e) &&
           terrain_find_climate(params, params->alps.wind, hollow, field, run, e);
}

// A volcano stands in warmer air than alps do: snow stays on its upper fifth.
static bool finish_volcano(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    bool done = terrain_fill_shallow_pits(field, 12.0f, e) &&
                terrain_find_climate(params, params->volcano.wind, 0.055f, field, run, e);
    for (int64_t i = 0; done && i < height_field_count(field); i++) {
        field->climate[i] *= 0.6f;
    }
    return done;
}

static bool finish_hills(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)terrain;
    (void)run;
    return height_field_fill(field, 1e-4f, e) && terrain_wet_hollows(field, e);
}

static bool finish_badlands(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)terrain;
    (void)run;
    return height_field_fill(field, 1e-4f, e) && terrain_wet_washes(field, e);
}

// Altitudes are km above the sea, or above the water table of karst.
static bool finish_coast(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)terrain;
    (void)run;
    field->climate = memory_alloc(height_field_count(field), sizeof *field->climate, e);
    for (int64_t i = 0; field->climate && i < height_field_count(field); i++) {
        field->climate[i] = 0.001f * field->height[i];
    }
    return field->climate;
}

// Between samples the feet of cliffs may swing below the plain: nothing is lower than the river's
// bed.
static bool finish_karst(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    TerrainParams params = terrain_params_resolve(terrain->params);
    float low = -(float)KARST_BED * params.relief;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        field->height[i] = fmaxf(field->height[i], params.karst.river > 0.0f ? low : 0.0f);
    }
    return finish_coast(terrain, field, run, e);
}

static bool finish_braided(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)run;
    float reach = 0.3f * (float)terrain->braid->mean;
    return terrain_drain_pools(field, e) && terrain_keep_shores(terrain, field, reach, e);
}

static bool finish_meander(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)run;
    if (!terrain_keep_shores(terrain, field, 0.5f, e)) {
        return false;
    }
    // Scrolls and the borders of old ground are lower than the mesh's error.
    for (int64_t i = 0; i < height_field_count(field); i++) {
        terrain->bank[i] |= field->age[i] < 0.735f;
    }
    return true;
}

// ---- the table

static const Form FORMS[] = {
    [TERRAIN_RIVERS] = {.grow = terrain_grow_rivers,
                        .finish_tree = terrain_fill_rivers,
                        .prepare = prepare_rivers,
                        .sample = sample_valleys,
                        .drain = drain,
                        .finish = finish_rivers},
    [TERRAIN_RIDGES] = {.grow = terrain_grow_ridges,
                        .finish_tree = terrain_raise_ridges,
                        .prepare = prepare_ridges,
                        .sample = sample_lifted},
    [TERRAIN_MAP] = {.wavelength = 0.125f, .prepare = prepare_map, .sample = sample_lifted},
    [TERRAIN_NOISE] = {.wavelength = 0.125f, .sample = sample_noise},
    [TERRAIN_SURVEY] = {.hollows = true,
                        .grow = terrain_find_rivers,
                        .finish_tree = terrain_finish_survey,
                        .prepare = prepare_survey,
                        .sample = sample_survey,
                        .drain = drain_survey,
                        .finish = finish_survey},
    [TERRAIN_CANYON] = {.relief = 0.09f,
                        .wavelength = 0.125f,
                        .plateau = true,
                        .grow = terrain_grow_courses,
                        .finish_tree = terrain_fill_courses,
                        .evolve = terrain_evolve_plateau,
                        .record = record_change,
                        .sample_part = sample_evolved,
                        .finish = terrain_lay_rivers},
    [TERRAIN_MESAS] = {.relief = 0.04f,
                       .wavelength = 0.125f,
                       .plateau = true,
                       .grow = terrain_grow_courses,
                       .finish_tree = terrain_fill_courses,
                       .evolve = terrain_evolve_plateau,
                       .record = record_change,
                       .sample_part = sample_evolved,
                       .finish = terrain_lay_rivers},
    [TERRAIN_ALPS] = {.material = "terrain/alps",
                      .relief = 0.16f,
                      .wavelength = 0.125f,
                      .evolve = terrain_evolve_alps,
                      .record = record_loose,
                      .sample_part = sample_evolved,
                      .finish = finish_alps,
                      .measure = terrain_measure_alps},
    [TERRAIN_VOLCANO] = {.material = "terrain/volcano",
                         .relief = 0.13f,
                         .wavelength = 0.125f,
                         .evolve = terrain_evolve_volcano,
                         .record = record_ground,
                         .sample_part = sample_evolved,
                         .finish = finish_volcano,
                         .measure = terrain_measure_volcano},
    [TERRAIN_DUNES] = {.material = "terrain/dunes",
                       .repeat = REPEAT_PERIODIC,
                       .wavelength = 0.125f,
                       .prepare = prepare_dunes,
                       .record = record_wind,
                       .sample = terrain_sample_dunes},
    [TERRAIN_HILLS] = {.material = "terrain/hills",
                       .relief = 0.04f,
                       .wavelength = 0.125f,
                       .evolve = terrain_evolve_hills,
                       .cells = terrain_hill_cells,
                       .record = record_loose,
                       .sample_part = sample_evolved,
                       .finish = finish_hills,
                       .measure = terrain_measure_hills},
    [TERRAIN_BADLANDS] = {.material = "badlands",
                          .relief = 0.1f,
                          .wavelength = 0.125f,
                          .shows_beds = true,
                          .evolve = terrain_evolve_badlands,
                          .cells = terrain_badland_cells,
                          .record = record_loose,
                          .sample_part = sample_evolved,
                          .finish = finish_badlands,
                          .measure = terrain_measure_badlands},
    [TERRAIN_COAST] = {.material = "terrain/coast",
                       .repeat = REPEAT_SHORE,
                       .relief = 0.04f,
                       .wavelength = 0.125f,
                       .shows_beds = true,
                       .evolve = terrain_evolve_coast,
                       .record = record_loose,
                       .sample_part = sample_evolved,
                       .finish = finish_coast,
                       .measure = terrain_measure_coast},
    [TERRAIN_BRAIDED] = {.material = "terrain/braided",
                         .water = "terrain/glacial",
                         .relief = 0.1f,
                         .wavelength = 0.125f,
                         .prepare = terrain_grow_braided,
                         .record = record_braided,
                         .sample = terrain_sample_braided,
                         .finish = finish_braided,
                         .roughness = terrain_braid_roughness,
                         .line = terrain_braid_line},
    [TERRAIN_KARST] = {.material = "terrain/karst",
                       .relief = 0.05f,
                       .wavelength = 0.125f,
                       .shows_beds = true,
                       .evolve = terrain_evolve_karst,
                       .record = record_loose,
                       .sample_part = sample_evolved,
                       .finish = finish_karst,
                       .measure = terrain_measure_karst},
    [TERRAIN_MEANDER] = {.material = "terrain/floodplain",
                         .water = "terrain/river",
                         .repeat = REPEAT_ALONG,
                         .relief = 0.03f,
                         .wavelength = 0.125f,
                         .prepare = terrain_grow_meander,
                         .record = record_braided,
                         .sample = terrain_sample_meander,
                         .finish = finish_meander,
                         .roughness = terrain_meander_roughness},
    [TERRAIN_DELTA] = {.material = "terrain/delta",
                       .water = "terrain/silt",
                       .wavelength = 0.125f,
                       .prepare = terrain_grow_delta,
                       .record = record_braided,
                       .sample = terrain_sample_delta,
                       .finish = terrain_finish_delta,
                       .roughness = terrain_delta_load,
                       .beyond = terrain_add_delta_beyond},
};

const Form *terrain_form(const TerrainParams *params)
{
    return &FORMS[params->form];
}
