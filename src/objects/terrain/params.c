// What a terrain is made by if the scene does not say.
#include "base/exact_math.h"
#include "objects/terrain/form.h"

#include <math.h>

TerrainParams terrain_params_default(void)
{
    return (TerrainParams){
        .size = 12000.0f,
        .resolution = 1024,
        .uplift = {.base = 1.0f, .noise = 0.4f},
        .ridges = {.source = {.scale = 1.0f},
                   .extent = {0.8f, 0.8f},
                   .count = 900,
                   .winding = 0.4f,
                   .field_weight = 1.0f,
                   .width = 0.12f},
        .rivers = {.source = {.scale = 1.0f},
                   .outlets = 7,
                   .count = 2500,
                   .winding = 0.4f,
                   .gradient = 0.6f,
                   .concavity = 0.42f,
                   .valley = 0.03f,
                   .water = 0.0025f,
                   .runoff = 0.15f,
                   .foam = 1.0f,
                   .fall_height = 2.0f,
                   .fall_slope = 1.0f,
                   .field_weight = 1.0f},
        .survey = {.band = 1, .exaggeration = 1.0f},
        .noise = {.iterations = 6, .amplitude = 0.11f, .gain = 0.5f, .ridged = 0.7f, .warp = 0.35f},
        .erosion = {.talus = 38.0f},
        .joints = {.azimuth = 16.0f, // as the largest of pattern_crags.c
                   .angle = 75.0f,
                   .scales = 3,
                   .bends = 0.1f,
                   .facets = 0.8f,
                   .relief = 0.2f,
                   .gullies = 0.25f,
                   .bedding = 0.5f,
                   .slope = 42.0f},
        .forest = {.height = 28.0f, .low = 0.02f, .high = 0.4f, .slope = 36.0f, .clumping = 0.7f},
        .canyon = {.sinuosity = 1.35f, .meander = 0.42f, .river = 70.0f, .side_canyons = 1.0f},
        .mesas = {.streams = 6, .remaining = 0.12f},
        .alps = {.ice = 1.0f, .ice_line = 0.4f, .outlets = 5, .wind = 270.0f},
        .volcano = {.flows = 16, .cones = 5, .wind = 270.0f, .age = 0.15f},
        .hills = {.outlets = 4},
        .badlands = {.depth = 1.0f, .slope = 45.0f, .wash = 0.05f, .outlets = 4},
        .coast = {.sea = SIDE_SOUTH,
                  .wave_height = 2.0f,
                  .tide = 3.0f,
                  .sand = 0.006f,
                  .grain = 0.4f,
                  .joints = 1.0f},
        .braided = {.slope = 0.006f,
                    .threads = 6.0f,
                    .stage = 0.35f,
                    .age = 1.0f,
                    .terraces = 2,
                    .terrace_height = 7.0f},
        .karst = {.stage = 0.75f, .focus = 1.0f},
        .meander = {.plain = 0.7f, .slope = 0.0005f, .age = 1.0f},
        .delta = {.sand = 0.3f, .age = 1.0f, .plain = 0.14f},
        .dunes = {.kind = DUNE_TRANSVERSE, .wind = 270.0f, .spread = 120.0f, .age = 1.0f},
        .evolution = {.streams = 1.0f,
                      .debris = 1.0f,
                      .weathering = 1.0f,
                      .rubble = 0.25f,
                      .repose = 34.0f,
                      .deposition = 1.0f,
                      .soil = 1.0f,
                      .cells = 1024},
        .lakes = {.silt = 0.5f, .deepness = 1.0f, .altitude = {0.0f, 1.0f}},
        .tiles = {.cells = 512, .detail = 1.0f},
        .mesh_error = 0.0006f};
}

static void resolve_dunes(DuneParams *dunes, float size)
{
    static const float depth[] = {[DUNE_BARCHAN] = 0.02f,
                                  [DUNE_TRANSVERSE] = 0.07f,
                                  [DUNE_LINEAR] = 0.08f,
                                  [DUNE_STAR] = 0.12f};
    dunes->spacing = dunes->spacing > 0.0f ? dunes->spacing : 0.25f * size;
    dunes->sand = dunes->sand > 0.0f ? dunes->sand : depth[dunes->kind] * dunes->spacing;
}

// The beds' top in the middle, so that a stack that dips reaches over the land's high side.
static float top_over(const TerrainParams *resolved, float reach)
{
    float sine, cosine;
    exact_sincos(resolved->strata.dip * 0.017453292f, &sine, &cosine);
    return resolved->relief + reach * resolved->size * sine / cosine;
}

static void resolve_alps(const TerrainParams *params, TerrainParams *resolved)
{
    StrataParams *strata = &resolved->strata;
    if (strata->bed_count > 0 || params->evolution.debris <= 0.0f) {
        return;
    }
    if (strata->dip == 0.0f) {
        strata->dip = 7.0f;
        strata->dip_azimuth = 115.0f;
    }
    strata->top = params->strata.top != 0.0f ? params->strata.top : top_over(resolved, 0.6f);
}

// A coast's own beds dip obliquely to the shore; their stack reaches over the land's high side.
static void resolve_coast(const TerrainParams *params, TerrainParams *resolved)
{
    CoastParams *coast = &resolved->coast;
    coast->retreat = coast->retreat > 0.0f ? coast->retreat : 0.2f * params->size;
    coast->joint_spacing =
        coast->joint_spacing > 0.0f ? coast->joint_spacing : 0.03f * params->size;
    StrataParams *strata = &resolved->strata;
    if (strata->bed_count > 0) {
        return;
    }
    if (strata->dip == 0.0f) {
        strata->dip = 8.0f;
        strata->dip_azimuth = 90.0f * (float)(coast->sea - SIDE_NORTH) + 65.0f;
    }
    strata->top = params->strata.top != 0.0f ? params->strata.top : top_over(resolved, 0.65f);
}

TerrainParams terrain_params_resolve(const TerrainParams *params)
{
    TerrainParams resolved = *params;
    const Form *form = terrain_form(params);
    if (resolved.noise.wavelength == 0.0f) {
        switch (params->form) {
        case TERRAIN_RIVERS: // brooks
            resolved.noise.wavelength = 6.0f / sqrtf((float)params->rivers.count);
            break;
        case TERRAIN_RIDGES: // spurs
            resolved.noise.wavelength = 3.0f / sqrtf((float)params->ridges.count);
            break;
        default: // 0 of surveyed land: two cells of the raster
            resolved.noise.wavelength = form->wavelength;
        }
    }
    if (params->form == TERRAIN_DUNES) {
        resolve_dunes(&resolved.dunes, params->size);
    }
    if (params->form == TERRAIN_BRAIDED) {
        float width = params->braided.width;
        resolved.braided.width = width > 0.0f ? width : 0.5f * params->size;
        resolved.relief = params->relief > 0.0f ? params->relief : params->size * form->relief;
    }
    if (params->form == TERRAIN_MEANDER) {
        float width = params->meander.width;
        resolved.meander.width = width > 0.0f ? width : params->size / 60.0f;
        resolved.relief = params->relief > 0.0f ? params->relief : params->size * form->relief;
    }
    if (params->form == TERRAIN_DELTA) {
        float width = params->delta.width, depth = params->delta.depth;
        resolved.delta.width = width > 0.0f ? width : params->size / 40.0f;
        // Bankfull widths and depths of rivers: Leopold and Maddock 1953.
        float tenth = sqrtf(0.1f * resolved.delta.width);
        resolved.delta.depth = depth > 0.0f ? depth : tenth;
        resolved.relief = params->relief > 0.0f ? params->relief : resolved.delta.depth;
    }
    if (form->evolve) {
        resolved.relief = params->relief > 0.0f ? params->relief : params->size * form->relief;
        resolved.hills.spacing =
            params->hills.spacing > 0.0f ? params->hills.spacing : 0.1f * params->size;
        resolved.karst.spacing =
            params->karst.spacing > 0.0f ? params->karst.spacing : 0.09f * params->size;
        resolved.volcano.crater =
            params->volcano.crater > 0.0f ? params->volcano.crater : 0.26f * resolved.relief;
        resolved.canyon.width =
            params->canyon.width > 0.0f ? params->canyon.width : 6.0f * resolved.relief;
        resolved.strata.top = params->strata.top != 0.0f ? params->strata.top : resolved.relief;
    }
    if (params->form == TERRAIN_ALPS) {
        resolve_alps(params, &resolved);
    }
    if (params->form == TERRAIN_COAST) {
        resolve_coast(params, &resolved);
    }
    return resolved;
}
