// A sea as a kind of object.
#include "objects/kind.h"
#include "land/height_raster.h"
#include "objects/sea/drops.h"
#include "objects/sea/sea.h"
#include "objects/sea/spray.h"
#include "render/material/material.h"
#include "shape/envelope.h"

#include <math.h>
#include <stdio.h>

enum { BED_SIDE = 1024 };
enum { SEA_WATER, SEA_DROPS }; // roles

static const char *over(const void *params)
{
    return ((const SeaParams *)params)->bed;
}

// Waves with their shore, if they have one. The caller frees them.
static Waves *make_waves(const SeaParams *params, const Recipe *recipe, Error *e)
{
    Waves *waves = sea_waves(params, recipe->seed, recipe->run, e);
    if (!waves || !recipe->surface) {
        return waves;
    }
    HeightField *seen = NULL;
    const HeightField *land = recipe->land;
    if (!land) {
        land = seen = height_field_of_mesh(recipe->surface->mesh, BED_SIDE, e);
    }
    waves->shore = land ? sea_shore(params, land, waves, recipe->run, e) : NULL;
    height_field_free(seen);
    if (!waves->shore) {
        waves_free(waves);
        return NULL;
    }
    return waves;
}

// Adds what the waves throw up as drops, if that is wanted.
static bool add_drops(const SeaParams *params, const Waves *waves, const Placing *placing, Error *e)
{
    bool none;
    Vec2 center = sea_center(params, placing->around.eye);
    Mesh *mesh = sea_drops(params, waves, center, placing->recipe->seed, &none, e);
    return none || placing_add(placing, (Part){.mesh = mesh}, SEA_DROPS, e);
}

bool sea_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const SeaParams *params = given;
    Waves *waves = make_waves(params, placing->recipe, e);
    Part part = {0};
    if (waves && ((placing->keep_spray &&
                   !(part.spray = sea_spray(params, waves, placing->recipe->seed, e))) ||
                  !add_drops(params, waves, placing, e))) {
        spray_free(part.spray);
        waves_free(waves);
        return false;
    }
    part.mesh =
        waves ? sea_mesh(params, placing->around.eye, waves, placing->recipe->run, e) : NULL;
    return placing_add(placing, part, 0, e);
}

// The calm surface.
static bool cover(const void *given, uint64_t seed, Cover *cover, const Run *run, Error *e)
{
    (void)seed;
    (void)run;
    const SeaParams *params = given;
    Mesh *mesh = mesh_new(4, 4, 1, 0, e);
    if (!mesh) {
        return false;
    }
    for (uint32_t i = 0; i < 4; i++) {
        float x = i == 0 || i == 3 ? -params->extent : params->extent;
        float z = i < 2 ? params->extent : -params->extent;
        mesh->position[i] = vec3(params->center[0] + x, params->level, params->center[1] + z);
        mesh->index[i] = i;
    }
    bool done = cover_add(cover, mesh, e);
    mesh_free(mesh);
    return done;
}

static void needs(const void *given, Needs *needs)
{
    const double vertex_bytes = 32.0 + 2.0 * 12.0 + 2.0 * 60.0, tile_bytes = 16e6;
    const SeaParams *params = given;
    double spokes = (double)params->spokes;
    double growing =
        log(fmax((double)params->extent * 6.28 / (spokes * (double)params->finest), 1.0));
    needs_add(needs, "spokes", spokes * spokes * (1.0 + growing) / 6.28, vertex_bytes);
    needs_add(needs, "sea", WAVES_TILES, tile_bytes);
    // A gale's are a tenth of that; each is 8 triangles.
    needs_add_skin(needs, "drops", 8.0 * 1e5 * (double)params->drops);
}

static void describe(const void *given, char *text, size_t size)
{
    const SeaParams *params = given;
    WaveSpectrum spectrum = sea_spectrum(params);
    snprintf(text, size, ", waves of %.1f m by %.0f m",
             4.0 * sqrt(wave_spectrum_variance(&spectrum)),
             6.283185307 / wave_number(spectrum.peak, spectrum.depth));
}

// Absorption of pure water (Pope and Fry 1997) at 610, 550 and 460 nm with some dissolved matter,
// and scattering of a clear coastal sea by its backward share: see references.md.
static const Material BUILTIN[] = {
    {.name = "sea/water",
     .kind = MATERIAL_WATER,
     .color = {1.0f, 1.0f, 1.0f},
     .color2 = {0.88f, 0.90f, 0.92f},
     .absorption = {0.270f, 0.070f, 0.045f},
     .scattering = {0.045f, 0.050f, 0.055f},
     .anisotropy = 0.75f,
     .ior = 1.34f,
     .calm = 0.5f},
    // A drop passes what it does not mirror on in other directions; too small to be seen as a lens.
    {.name = "sea/drops",
     .kind = MATERIAL_LEAF,
     .color = {0.42f, 0.43f, 0.44f},
     .color2 = {0.42f, 0.43f, 0.44f},
     .transmittance = {0.48f, 0.49f, 0.49f},
     .roughness = 0.2f,
     .specular = 0.5f,
     .ior = 1.34f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(SEA_WATER),
    MATERIAL_ROW(SEA_DROPS, "drop_material",
                 "Material of the drops above a sea's breakers; default: sea/drops."),
    {0},
};

const Kind kind_sea = {
    .variant = {KIND_ROW("sea", &sea_table, "The sea with waves by the spectrum of the wind."),
                MATERIALS},
    .reads_scene = true, // the bed
    .materials = {"sea/water", "sea/drops"},
    .builtin = BUILTIN,
    .over = over,
    .over_key = "bed",
    .cover = cover,
    .needs = needs,
    .describe = describe,
    .measure = sea_measure,
    .sprays = true,
    .geometry = sea_geometry};
