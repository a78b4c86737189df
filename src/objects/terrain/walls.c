// Couloirs, ribs and scree of land whose form has none of its own: debris flows and rockfall
// (land/landscape.h) cut its steep walls, on grids of their own, the same for every resolution, so
// that more samples show the same walls. Rivers and the border's low places stay as they are.
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/internal.h"

#include <math.h>
#include <stdlib.h>

typedef struct Walls {
    const Terrain *terrain;
    const HeightField *field;
    const Strata *strata; // of the rock
    double repose;        // tangent
    float water;          // height of the lake; below it nothing moves
} Walls;

// The field's heights on a grid of the walls.
static Landscape *walls_on(const Walls *w, int cells, Error *e)
{
    const HeightField *field = w->field;
    double size = (double)field->cell.x * (field->columns - 1);
    Landscape *land = landscape_new(cells, size, w->strata, e);
    for (int64_t i = 0; land && i < landscape_count(land); i++) {
        int64_t row = i / land->side;
        float x = (float)(land->corner + (double)(i % land->side) * land->cell);
        float z = (float)(land->corner + (double)row * land->cell);
        land->rock[i] = (double)height_field_at(field, x, z);
    }
    return land;
}

// Joints and crushed zones, down to two cells.
static void set_joints(const Walls *w, Landscape *land, const Run *run)
{
    const double longest = 1600.0; // m
    int octaves = 1;
    for (double wave = longest; wave > 3.0 * land->cell && octaves < 9; wave *= 0.5) {
        octaves++;
    }
    const WeaknessNoise noise = {longest, 1.0f, octaves, 0.62f, 1.0f, 0.2f};
    terrain_set_weakness(land, &noise, random_key(w->terrain->seed, STREAM_JOINTS), run);
}

// Debris leaves where water does: at low places of the border, in rivers and in lakes.
static void open_bases(const Walls *w, Landscape *land)
{
    int last = land->side - 1;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int column = (int)(i % land->side), row = (int)(i / land->side);
        bool border = column == 0 || row == 0 || column == last || row == last;
        int64_t step = row == 0 || row == last ? 1 : land->side;
        int along = step == 1 ? column : row;
        bool low = border && (along == 0 || land->rock[i - step] >= land->rock[i]) &&
                   (along == last || land->rock[i + step] >= land->rock[i]);
        float x = (float)(land->corner + column * land->cell);
        float z = (float)(land->corner + row * land->cell);
        bool wet = terrain_wetness_at(w->terrain, x, z) > 0.9f || land->rock[i] < (double)w->water;
        if (low || wet) {
            landscape_set_base(land, i, land->rock[i]);
        }
    }
}

// strength: of debris flows; time: 1 = since the ice has gone.
static bool carve(const Walls *w, Landscape *land, double strength, double time, const Run *run,
                  Error *e)
{
    enum { STEPS = 14 };
    LandscapeRates rates = {.incision = 0.03,
                            .loose = 0.3,
                            .least_area = 2.0e4,
                            .debris = 40.0 * strength,
                            .least_debris = 4.0e3,
                            .joints = 0.8,
                            .deposition = 1.0,
                            .retreat = 12.0,
                            .rubble = 0.6,
                            .repose = w->repose,
                            .soil = 0.3,
                            .creep = 30.0};
    uint64_t ways = random_key(w->terrain->seed, STREAM_WATER_WAYS);
    set_joints(w, land, run);
    open_bases(w, land);
    for (int i = 0; i < STEPS; i++) {
        run_progress(run, "walls", (double)i / STEPS);
        rates.seed = random_key(ways, (uint64_t)i / 2);
        if (!landscape_step(land, &rates, time / STEPS, i % 2 == 0, run, e)) {
            return false;
        }
    }
    return true;
}

// Turns the land into what has changed: its rock becomes the change of the surface.
static void subtract(const Walls *w, Landscape *land)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int64_t row = i / land->side;
        float x = (float)(land->corner + (double)(i % land->side) * land->cell);
        float z = (float)(land->corner + (double)row * land->cell);
        land->rock[i] += land->loose[i] - (double)height_field_at(w->field, x, z);
    }
}

// The fine land, after the changes of the coarse one, whose rock they are.
static Landscape *walls_after(const Walls *w, const Landscape *coarse, Error *e)
{
    Landscape *land = walls_on(w, WALLS_FINE_CELLS, e);
    for (int64_t i = 0; land && i < landscape_count(land); i++) {
        int64_t row = i / land->side;
        double x = land->corner + (double)(i % land->side) * land->cell, loose;
        double change = landscape_at(coarse, x, land->corner + (double)row * land->cell, &loose);
        // landscape_at tells the surface; the loose cover is part of the change already.
        land->rock[i] += change - 2.0 * loose;
        land->loose[i] = loose;
    }
    return land;
}

static void add_to_field(const Landscape *land, HeightField *field, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns; column++) {
            int64_t i = (int64_t)row * field->columns + column;
            double x = (double)field->origin.x + column * (double)field->cell.x, loose;
            double z = (double)field->origin.y + row * (double)field->cell.y;
            float change = (float)landscape_at(land, x, z, &loose);
            change -= (float)loose;
            field->height[i] += change;
            if (field->change) {
                field->change[i] += change;
            }
            float cover = 0.85f * (float)(loose / (loose + 1.0));
            if (field->wetness && field->wetness[i] < cover) {
                field->wetness[i] = cover;
            }
        }
    }
}

bool terrain_carve_walls(const Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    double strength = (double)params->erosion.debris;
    if (strength <= 0.0) {
        return true;
    }
    StrataBed rock = {.thickness = 1.0f, .hardness = 0.6f, .slope = 61.0f};
    StrataParams alike = {.beds = &rock, .bed_count = 1};
    Strata *own = terrain->strata ? NULL : strata_new(&alike, vec3_splat(0.0f), params->size, e);
    if (!terrain->strata && !own) {
        return false;
    }
    Walls w = {.terrain = terrain,
               .field = field,
               .strata = terrain->strata ? terrain->strata : own,
               .repose = 0.69,
               .water =
                   params->water_level > 0.0f ? terrain_water_height(params, field) : -INFINITY};
    Landscape *coarse = walls_on(&w, WALLS_COARSE_CELLS, e), *fine = NULL;
    bool done = coarse && carve(&w, coarse, strength, 1.0, run, e);
    if (done) {
        subtract(&w, coarse);
        coarse->strata = NULL;
        done = (fine = walls_after(&w, coarse, e)) && carve(&w, fine, strength, 0.5, run, e);
    }
    if (done) {
        subtract(&w, fine);
        fine->strata = NULL;
        add_to_field(fine, field, run->threads);
    }
    landscape_free(coarse);
    landscape_free(fine);
    strata_free(own);
    return done;
}
