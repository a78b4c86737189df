// A stratovolcano: the form volcano. On a coarse grid it grows layer by layer: tephra that falls,
// which also stands for the many thin flows that no grid resolves, lobes of lava, rubble that
// slides to its angle of repose, rain that cuts gullies, and a crater that each eruption clears. On
// finer grids gullies go on, then come sector collapse, scoria cones and the youngest flows.
#include "objects/terrain/volcano.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/lava.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STAGES = 16, STAGE_FLOWS = 3 };

static Volcano volcano_of(const Terrain *terrain)
{
    Volcano v = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    const VolcanoParams *p = &v.params.volcano;
    v.size = (double)v.params.size;
    v.relief = (double)v.params.relief;
    double sine, cosine;
    exact_sincos_double((double)v.params.evolution.repose * 0.017453292519943295, &sine, &cosine);
    v.repose = sine / cosine;
    v.summit = (Vent){.x = (double)p->at[0] * v.size,
                      .z = (double)p->at[1] * v.size,
                      .rim = 0.5 * (double)p->crater};
    v.fall = volcano_fall(&v.params);
    // It blows from the azimuth, clockwise from north.
    exact_sincos_double((double)p->wind * 0.017453292519943295, &sine, &cosine);
    v.wind[0] = -sine;
    v.wind[1] = cosine;
    volcano_place_cones(&v);
    return v;
}

static void clear(Volcano *v)
{
    free(v->flow);
    free(v->weakness);
    free(v->lava);
    free(v->red);
    v->flow = NULL;
    v->weakness = v->lava = v->red = NULL;
}

static bool make_room(Volcano *v, const Landscape *land, Error *e)
{
    int64_t count = landscape_count(land);
    return (v->flow = memory_alloc_zero(count, sizeof *v->flow, e)) &&
           (v->weakness = memory_alloc(count, sizeof *v->weakness, e)) &&
           (v->lava = memory_alloc_zero(count, sizeof *v->lava, e)) &&
           (v->red = memory_alloc_zero(count, sizeof *v->red, e));
}

// ---- the plain, and what differs from place to place

static void lay_plain(const Volcano *v, Landscape *land)
{
    uint64_t key = random_key(v->terrain->seed, STREAM_PLATEAU);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &(Vent){0}, i);
        float x = (float)(away.dx / v->size), z = (float)(away.dz / v->size);
        float n = sparse_noise_fractal(4.0f * x, 4.0f * z, 6, 0.5f, 0.0f, key);
        land->rock[i] = 0.02 * v->relief * (2.0 + (double)n) - 0.004 * away.dz;
    }
}

// Everywhere on the border water leaves.
static void open_border(Landscape *land)
{
    int last = land->side - 1;
    for (int k = 0; k < land->side; k++) {
        int64_t at[4] = {k, (int64_t)last * land->side + k, (int64_t)k * land->side,
                         (int64_t)k * land->side + last};
        for (int j = 0; j < 4; j++) {
            landscape_set_base(land, at[j], land->rock[at[j]] + land->loose[at[j]]);
        }
    }
}

// Lava is cut slowly, the more so the younger it is.
static void set_weakness(const Volcano *v, Landscape *land)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->weakness[i] = v->weakness[i] * (1.0f - 0.92f * v->lava[i]);
    }
}

// ---- processes

// Loose ground becomes rock: the next layers lie on it.
static void consolidate(Landscape *land)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (!land->base[i]) {
            land->rock[i] += land->loose[i];
            land->loose[i] = 0.0;
        }
    }
}

// Gullies and screes for a share of a dissected cone's age.
static bool weather(const Volcano *v, Landscape *land, double share, int least, const Run *run,
                    Error *e)
{
    const EvolutionParams *evolution = &v->params.evolution;
    LandscapeRates rates = {.incision = 2.6 * (double)evolution->streams,
                            .loose = 3.0 * (double)evolution->streams,
                            .least_area = 1.2e4,
                            .deposition = 0.35 * (double)evolution->deposition,
                            .retreat = 30.0 * (double)evolution->weathering,
                            .rubble = (double)evolution->rubble,
                            .repose = v->repose,
                            .soil = 0.5 * (double)evolution->soil,
                            .creep = 300.0 * (double)evolution->soil,
                            .seed = random_key(v->terrain->seed, STREAM_WATER_WAYS)};
    double most = 0.3 * land->cell / fmax(rates.retreat, 1e-3);
    int steps = 1 + (int)(share / most);
    steps = steps > least ? steps : least;
    for (int i = 0; i < steps; i++) {
        run_progress(run, "erosion", (double)i / steps);
        if (!landscape_step(land, &rates, share / steps, i % 2 == 0, run, e)) {
            return false;
        }
    }
    return true;
}

static bool slide(const Volcano *v, Landscape *land, int times, const Run *run, Error *e)
{
    LandscapeRates rates = {.repose = v->repose};
    for (int k = 0; k < times; k++) {
        if (!landscape_slopes_only(land, &rates, 1.0, run, e)) {
            return false;
        }
    }
    return true;
}

// Basaltic andesite; a flow of this volume takes as long as it takes to reach the plain.
static LavaParams lava_of(const Volcano *v, double volume, uint64_t key)
{
    double rate = 120.0 * (double)random_range(random_key(key, 11), 0.7f, 1.5f);
    return (LavaParams){.volume = volume,
                        .rate = rate,
                        .yield = (double)random_range(random_key(key, 12), 1.6f, 3.6f),
                        .viscosity = 4.0,
                        .stiffening = 1.6,
                        .cooling = 6.0 * rate / volume, // cold after its own time of supply
                        .roughness = 0.6,
                        .seed = random_key(v->terrain->seed, STREAM_LAVA)};
}

// Marks what a flow has covered.
static void mark(Volcano *v, const Landscape *land, float fresh)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (v->flow[i] > 0.5) {
            v->lava[i] = fresh;
            v->red[i] = 0.0f;
        }
    }
}

// A flow from the crater's rim, from the breach, from a scoria cone's foot or from the flank.
static bool erupt(Volcano *v, Landscape *land, double volume, float fresh, uint64_t key,
                  const Run *run, Error *e)
{
    const VolcanoParams *p = &v->params.volcano;
    double turn = (double)random_range(random_key(key, 1), 0.0f, 6.2831853f), sine, cosine;
    double out = v->summit.rim * 1.12;
    float where = random_unit(random_key(key, 2));
    volume *= exact_exp((double)random_range(random_key(key, 3), -0.8f, 0.8f));
    if (p->breach > 0.0f && where < 0.5f) {
        turn = ((double)p->breach_azimuth - 90.0) * 0.017453292519943295;
        out = 0.3 * v->summit.rim;
    } else if (where > 0.6f) {
        out += v->fall * (double)random_range(random_key(key, 4), 0.2f, 1.3f);
    }
    exact_sincos_double(turn, &sine, &cosine);
    double x = v->summit.x + out * cosine, z = v->summit.z + out * sine;
    if (v->cones > 0 && where > 0.8f) {
        const Vent *cone =
            &v->cone[(int)(random_unit(random_key(key, 5)) * (float)v->cones) % v->cones];
        Away away = {cone->x - v->summit.x, cone->z - v->summit.z, 0.0};
        double far = sqrt(away.dx * away.dx + away.dz * away.dz);
        x = cone->x + 0.95 * cone->radius * away.dx / far;
        z = cone->z + 0.95 * cone->radius * away.dz / far;
    }
    LavaParams lava = lava_of(v, volume, key);
    if (!lava_erupt(land, &lava, x, z, v->flow, run, e)) {
        return false;
    }
    mark(v, land, fresh);
    return true;
}

// ---- growth

// One eruptive period: the cone grows to this height above the plain.
static bool grow_stage(Volcano *v, Landscape *land, int stage, const Run *run, Error *e)
{
    uint64_t key = random_key(random_key(v->terrain->seed, STREAM_TEPHRA), (uint64_t)stage);
    double height = v->relief * (stage + 1) / STAGES;
    double layer = height - volcano_ring(v, land, v->summit.rim);
    volcano_tephra(v, land, layer > 0.0 ? layer : 0.0, key);
    if (!slide(v, land, 3, run, e)) {
        return false;
    }
    consolidate(land);
    double volume = 14.0 * v->relief * v->relief; // lobes that a coarse grid resolves
    float fresh = stage > STAGES / 2 ? 0.12f * (float)(stage + 1) / STAGES : 0.0f;
    for (int k = 0; k < STAGE_FLOWS; k++) {
        if (!erupt(v, land, volume, fresh, random_key(key, (uint64_t)k + 100), run, e)) {
            return false;
        }
    }
    set_weakness(v, land);
    volcano_open_crater(v, land);
    return weather(v, land, 0.03, 3, run, e);
}

static bool grow(Volcano *v, Landscape *land, const Run *run, Error *e)
{
    const double built = 0.7; // share of the growth before a caldera sinks
    double relief = v->relief, fall = v->fall;
    for (int stage = 0; stage < STAGES; stage++) {
        run_progress(run, "growth", (double)stage / STAGES);
        bool sinks = v->params.volcano.caldera > 0.0f && stage == (int)(built * STAGES);
        if (sinks) { // a smaller cone grows within
            volcano_sink_caldera(v, land);
            v->fall = 0.4 * (double)v->params.volcano.caldera;
            v->relief =
                volcano_ring(v, land, 0.5 * v->params.volcano.caldera) + VOLCANO_STEEPEST * v->fall;
            v->relief = v->relief < relief ? v->relief : relief;
        }
        if (!grow_stage(v, land, stage, run, e)) {
            return false;
        }
    }
    v->relief = relief;
    v->fall = fall;
    return true;
}

// The cone as it was built, before rain has cut it.
static bool pile(Volcano *v, Landscape *land, const Run *run, Error *e)
{
    if (v->params.volcano.kind == VOLCANO_ASH) {
        volcano_heap_ash(v, land);
        return true;
    }
    return grow(v, land, run, e);
}

// A grid's part in what rain does. Ash drinks all water but that of barrancos.
static bool wear(const Volcano *v, Landscape *land, double share, int steps, bool finest,
                 const Run *run, Error *e)
{
    bool ash = v->params.volcano.kind == VOLCANO_ASH;
    return (ash || weather(v, land, share, steps, run, e)) &&
           volcano_cut_barrancos(v, land, volcano_find_barrancos(v, land, finest), steps, run, e);
}

// ---- the finest grid

static bool young_flows(Volcano *v, Landscape *land, const Run *run, Error *e)
{
    const VolcanoParams *p = &v->params.volcano;
    uint64_t key = random_key(v->terrain->seed, STREAM_LAVA);
    for (int k = 0; k < p->flows; k++) {
        run_progress(run, "lava", (double)k / p->flows);
        float late = (float)(k + 1) / (float)p->flows;
        float fresh = (0.15f + 0.85f * late * late) * (1.0f - 0.8f * p->age);
        if (!erupt(v, land, 7.0 * v->relief * v->relief, fresh, random_key(key, (uint64_t)k), run,
                   e)) {
            return false;
        }
    }
    return true;
}

// Scoria about the crater that hot gas has reddened.
static void redden(Volcano *v, const Landscape *land)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &v->summit, i);
        double beyond = (away.r - v->summit.rim) / (1.2 * v->summit.rim);
        float red = (float)(beyond > 0.0 ? exact_exp(-beyond * beyond) : 1.0);
        v->red[i] = fmaxf(v->red[i], red);
    }
}

// What gives the surface its last form.
static bool finish(Volcano *v, Landscape *land, const Run *run, Error *e)
{
    if (v->params.volcano.kind == VOLCANO_ASH) {
        return volcano_breach(v, land, run, e);
    }
    double age = (double)v->params.volcano.age;
    bool breached = v->params.volcano.breach > 0.0f;
    volcano_open_crater(v, land);
    if (!volcano_breach(v, land, run, e)) {
        return false;
    }
    redden(v, land);
    volcano_build_cones(v, land);
    if (!slide(v, land, 2, run, e) || !young_flows(v, land, run, e)) {
        return false;
    }
    if (!breached) {
        volcano_open_crater(v, land);
    }
    set_weakness(v, land);
    return weather(v, land, 0.006 + 0.3 * age, 6, run, e) &&
           volcano_cut_barrancos(v, land, 0.3, 12, run, e);
}

// ---- grids

// The land on a grid of twice as many cells, with what lies on it. Frees the old one, and both on
// failure.
static Landscape *refine(Volcano *v, Landscape *land, const Run *run, Error *e)
{
    Landscape *finer = landscape_refined(land, run, e);
    Volcano old = *v;
    v->flow = NULL;
    v->weakness = v->lava = v->red = NULL;
    if (finer && make_room(v, finer, e)) {
        for (int64_t i = 0; i < landscape_count(finer); i++) {
            int64_t column = i % finer->side, row = i / finer->side;
            int64_t at = row / 2 * land->side + column / 2;
            int64_t right = column % 2, down = row % 2 == 0 ? 0 : land->side;
            v->lava[i] = 0.25f * (old.lava[at] + old.lava[at + right] + old.lava[at + down] +
                                  old.lava[at + right + down]);
            v->red[i] = 0.25f * (old.red[at] + old.red[at + right] + old.red[at + down] +
                                 old.red[at + right + down]);
        }
        open_border(finer);
        volcano_find_weakness(v, finer, run);
        set_weakness(v, finer);
    } else {
        landscape_free(finer);
        finer = NULL;
    }
    clear(&old);
    landscape_free(land);
    return finer;
}

// What the surface is, for materials: HeightField.ground.
static HeightField *ground_of(const Volcano *v, const Landscape *land, Error *e)
{
    HeightField *ground = landscape_heights(land, e);
    for (int64_t i = 0; ground && i < landscape_count(land); i++) {
        ground->height[i] = v->lava[i] > 0.02f ? v->lava[i] : -v->red[i];
    }
    return ground;
}

Landscape *terrain_evolve_volcano(Terrain *terrain, const Run *run, Error *e)
{
    Volcano v = volcano_of(terrain);
    int most = v.params.resolution < v.params.evolution.cells ? v.params.resolution
                                                              : v.params.evolution.cells;
    int cells = most < VOLCANO_FIRST_CELLS ? most : VOLCANO_FIRST_CELLS;
    Landscape *land = landscape_new(cells, v.size, terrain->strata, e);
    bool done = land && make_room(&v, land, e);
    if (done) {
        lay_plain(&v, land);
        open_border(land);
        volcano_find_weakness(&v, land, run);
        set_weakness(&v, land);
        done = pile(&v, land, run, e);
    }
    double share = 0.10 + 0.35 * (double)v.params.volcano.age;
    done = done && wear(&v, land, share, 16, cells >= most, run, e);
    while (done && cells < most) {
        land = refine(&v, land, run, e);
        cells *= 2;
        share *= 0.5;
        done = land && wear(&v, land, share, 12, cells >= most, run, e);
    }
    done = done && finish(&v, land, run, e) && (terrain->ground = ground_of(&v, land, e));
    clear(&v);
    if (!done) {
        landscape_free(land);
        return NULL;
    }
    return land;
}
