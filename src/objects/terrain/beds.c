// The beds of the landforms, and those that the user gives.
#include "base/memory.h"
#include "objects/terrain/internal.h"

#include <string.h>

// A section of a plateau of limestone, sandstone and shale, from its rim down; thicknesses are
// shares of the relief. Hard beds stand as cliffs, shales as slopes, and the broad bench above the
// lowest sandstone is where a thick shale has weathered back.
static const StrataBed CANYON[] = {
    {0.077f, 0.85f, 0.0f, {0.56f, 0.46f, 0.34f}, 6.0f, 0.0f},  // limestone of the rim
    {0.054f, 0.30f, 0.0f, {0.50f, 0.36f, 0.24f}, 3.0f, 0.0f},  // marl
    {0.095f, 0.90f, 0.0f, {0.62f, 0.51f, 0.37f}, 12.0f, 0.0f}, // dune sandstone
    {0.068f, 0.06f, 0.0f, {0.38f, 0.135f, 0.07f}, 2.5f, 0.0f}, // red shale
    {0.036f, 0.70f, 0.0f, {0.44f, 0.20f, 0.115f}, 5.0f, 0.0f}, // red beds: ledges and slopes
    {0.032f, 0.15f, 0.0f, {0.39f, 0.15f, 0.08f}, 2.0f, 0.0f},
    {0.032f, 0.68f, 0.0f, {0.46f, 0.22f, 0.13f}, 5.0f, 0.0f},
    {0.034f, 0.15f, 0.0f, {0.39f, 0.16f, 0.09f}, 2.0f, 0.0f},
    {0.038f, 0.72f, 0.0f, {0.45f, 0.23f, 0.14f}, 5.0f, 0.0f},
    {0.027f, 0.20f, 0.0f, {0.40f, 0.17f, 0.10f}, 2.0f, 0.0f},
    {0.144f, 0.97f, 0.0f, {0.43f, 0.225f, 0.14f}, 14.0f, 0.0f}, // massive limestone, stained red
    {0.041f, 0.50f, 0.0f, {0.37f, 0.30f, 0.215f}, 3.0f, 0.0f},
    {0.108f, 0.03f, 22.0f, {0.30f, 0.27f, 0.19f}, 2.0f, 0.0f},   // green shale
    {0.045f, 0.88f, 0.0f, {0.31f, 0.20f, 0.125f}, 4.0f, 0.0f},   // brown sandstone
    {1.0f, 0.66f, 52.0f, {0.135f, 0.115f, 0.105f}, 0.0f, 0.0f}}; // dark schist

// A thick sandstone over shale on a hard floor.
static const StrataBed MESAS[] = {{0.06f, 0.80f, 0.0f, {0.42f, 0.19f, 0.11f}, 3.0f, 0.0f},
                                  {0.04f, 0.25f, 0.0f, {0.40f, 0.15f, 0.085f}, 2.0f, 0.0f},
                                  {0.44f, 0.93f, 83.0f, {0.48f, 0.215f, 0.115f}, 14.0f, 0.0f},
                                  {0.10f, 0.10f, 0.0f, {0.37f, 0.13f, 0.075f}, 2.5f, 0.0f},
                                  {0.035f, 0.60f, 0.0f, {0.44f, 0.18f, 0.105f}, 2.5f, 0.0f},
                                  {0.12f, 0.08f, 0.0f, {0.36f, 0.125f, 0.07f}, 2.5f, 0.0f},
                                  {0.03f, 0.60f, 0.0f, {0.44f, 0.19f, 0.11f}, 2.5f, 0.0f},
                                  {0.14f, 0.05f, 26.0f, {0.38f, 0.14f, 0.08f}, 2.5f, 0.0f},
                                  {1.0f, 0.92f, 0.0f, {0.45f, 0.24f, 0.15f}, 6.0f, 0.0f}};

// Sandstones and mudstones that dip along the shore, so that hard beds stand out as headlands.
static const StrataBed COAST[] = {{0.20f, 0.74f, 0.0f, {0.225f, 0.170f, 0.118f}, 1.6f, 0.0f},
                                  {0.08f, 0.50f, 0.0f, {0.088f, 0.080f, 0.074f}, 0.5f, 0.0f},
                                  {0.15f, 0.68f, 0.0f, {0.275f, 0.222f, 0.160f}, 1.2f, 0.0f},
                                  {0.05f, 0.44f, 0.0f, {0.072f, 0.067f, 0.064f}, 0.4f, 0.0f},
                                  {0.27f, 0.80f, 0.0f, {0.190f, 0.136f, 0.100f}, 2.2f, 0.0f},
                                  {0.10f, 0.55f, 0.0f, {0.108f, 0.097f, 0.088f}, 0.6f, 0.0f},
                                  {0.11f, 0.70f, 0.0f, {0.262f, 0.200f, 0.138f}, 1.0f, 0.0f},
                                  {0.04f, 0.46f, 0.0f, {0.076f, 0.071f, 0.068f}, 0.4f, 0.0f}};

// As many as the dip needs, from above the highest land on one side to below the sea on the other.
static int coast_beds(const TerrainParams *params, StrataBed *beds)
{
    const int kinds = (int)(sizeof COAST / sizeof *COAST), count = 6 * kinds;
    float height = 2.0f * (params->strata.top - params->relief) + 1.5f * params->relief;
    for (int i = 0; i < count; i++) {
        beds[i] = COAST[i % kinds];
        beds[i].thickness *= height / 6.0f;
    }
    return count;
}

// Thick beds of pure limestone that stand as cliffs, with thin ones between them that make ledges.
static const StrataBed KARST[] = {{0.13f, 0.80f, 74.0f, {0.30f, 0.295f, 0.28f}, 3.0f, 0.0f},
                                  {0.012f, 0.60f, 34.0f, {0.25f, 0.24f, 0.215f}, 0.8f, 0.0f},
                                  {0.17f, 0.85f, 79.0f, {0.32f, 0.31f, 0.285f}, 4.0f, 0.0f},
                                  {0.009f, 0.60f, 38.0f, {0.26f, 0.245f, 0.22f}, 0.8f, 0.0f},
                                  {0.21f, 0.90f, 81.0f, {0.31f, 0.305f, 0.29f}, 6.0f, 0.0f},
                                  {0.014f, 0.60f, 33.0f, {0.25f, 0.24f, 0.22f}, 0.8f, 0.0f},
                                  {0.24f, 0.90f, 80.0f, {0.33f, 0.32f, 0.295f}, 5.0f, 0.0f},
                                  {0.010f, 0.60f, 40.0f, {0.26f, 0.25f, 0.225f}, 0.8f, 0.0f},
                                  {1.0f, 0.90f, 85.0f, {0.32f, 0.315f, 0.30f}, 5.0f, 0.0f}};

// Their thicknesses are shares of the relief.
static int copy_beds(StrataBed *beds, const StrataBed *from, size_t count, float relief)
{
    for (size_t i = 0; i < count; i++) {
        beds[i] = from[i];
        beds[i].thickness *= relief;
    }
    return (int)count;
}

// Massive beds that stand as walls, thin ones between them that make ledges; shares of a cycle.
static const StrataBed ALPS[] = {{0.21f, 0.64f, 66.0f, {0.30f, 0.29f, 0.27f}, 0.0f, 0.0f},
                                 {0.035f, 0.54f, 47.0f, {0.27f, 0.26f, 0.24f}, 0.0f, 0.0f},
                                 {0.13f, 0.61f, 63.0f, {0.30f, 0.29f, 0.27f}, 0.0f, 0.0f},
                                 {0.022f, 0.55f, 49.0f, {0.27f, 0.26f, 0.24f}, 0.0f, 0.0f},
                                 {0.27f, 0.64f, 67.0f, {0.30f, 0.29f, 0.27f}, 0.0f, 0.0f},
                                 {0.050f, 0.53f, 46.0f, {0.27f, 0.26f, 0.24f}, 0.0f, 0.0f},
                                 {0.10f, 0.60f, 62.0f, {0.30f, 0.29f, 0.27f}, 0.0f, 0.0f},
                                 {0.028f, 0.55f, 48.0f, {0.27f, 0.26f, 0.24f}, 0.0f, 0.0f},
                                 {0.155f, 0.62f, 65.0f, {0.30f, 0.29f, 0.27f}, 0.0f, 0.0f}};

// Age makes them rotten, all alike. Land that no debris carves is of one rock.
static int alps_beds(const TerrainParams *params, StrataBed *beds)
{
    if (params->evolution.debris <= 0.0f) {
        beds[0] = (StrataBed){.thickness = 1.0f,
                              .hardness = 0.6f,
                              .slope = lerpf(53.0f, 34.0f, params->alps.age),
                              .color = {0.3f, 0.29f, 0.27f}};
        return 1;
    }
    enum { CYCLES = 5 };
    const int kinds = (int)(sizeof ALPS / sizeof *ALPS), count = CYCLES * kinds;
    float height = 2.0f * (params->strata.top - params->relief) + 1.4f * params->relief;
    float age = smoothstepf(0.0f, 0.7f, params->alps.age);
    for (int i = 0; i < count; i++) {
        beds[i] = ALPS[i % kinds];
        beds[i].thickness *= height / CYCLES;
        beds[i].hardness = lerpf(beds[i].hardness, 0.6f, age);
        beds[i].slope = lerpf(beds[i].slope, 34.0f, age);
    }
    return count;
}

static int own_beds(const TerrainParams *params, StrataBed *beds)
{
    if (params->form == TERRAIN_ALPS) {
        return alps_beds(params, beds);
    }
    if (params->form == TERRAIN_VOLCANO) { // tephra and lava, baked
        beds[0] = (StrataBed){
            .thickness = 1.0f, .hardness = 0.4f, .slope = 52.0f, .color = {0.1f, 0.09f, 0.085f}};
        return 1;
    }
    if (params->form == TERRAIN_HILLS) { // soft rock
        beds[0] = (StrataBed){.thickness = 1.0f, .slope = 45.0f, .color = {0.3f, 0.26f, 0.2f}};
        return 1;
    }
    if (params->form == TERRAIN_BADLANDS) { // mudstone
        beds[0] = (StrataBed){
            .thickness = 1.0f, .hardness = 0.2f, .slope = 45.0f, .color = {0.38f, 0.28f, 0.2f}};
        return 1;
    }
    if (params->form == TERRAIN_COAST) {
        return coast_beds(params, beds);
    }
    if (params->form == TERRAIN_CANYON) {
        return copy_beds(beds, CANYON, sizeof CANYON / sizeof *CANYON, params->relief);
    }
    if (params->form == TERRAIN_KARST) {
        return copy_beds(beds, KARST, sizeof KARST / sizeof *KARST, params->relief);
    }
    return copy_beds(beds, MESAS, sizeof MESAS / sizeof *MESAS, params->relief);
}

bool terrain_lay_beds(const TerrainParams *given, Strata **strata, Error *e)
{
    TerrainParams params = terrain_params_resolve(given);
    StrataBed own[STRATA_MOST_BEDS];
    if (params.strata.bed_count == 0) {
        if (!terrain_evolves(&params)) {
            return true;
        }
        params.strata.beds = own;
        params.strata.bed_count = own_beds(&params, own);
    }
    float top = params.strata.top != 0.0f ? params.strata.top : params.relief;
    *strata = strata_new(&params.strata, vec3(0.0f, top, 0.0f), params.size, e);
    return *strata;
}
