// A plateau of beds that rivers cut: a large river through it (canyon), or streams that have worn
// most of it away (mesas). The large rivers are the base level: they cut down at the rate that is
// given and carry off whatever reaches them. All else follows from the processes of
// land/landscape.h, first on a coarse grid, then on finer ones, each for a later part of the time.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/form.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Plateau {
    const Terrain *terrain;
    TerrainParams params; // resolved
    LandscapeRates rates; // per unit of time, which is the whole age of the landform
    double cut;           // share of the time at which the rivers have reached their depth
    float size;
} Plateau;

// ---- the rivers

// Height of the course at a share of its length from the outlet up, with the rivers at a share of
// their depth.
static float course_height(const TerrainParams *params, float way, float depth)
{
    float fall = params->form == TERRAIN_CANYON ? 0.0022f * params->size : 0.03f * params->relief;
    return (1.0f - depth) * params->relief + (depth < 1.0f ? depth : 1.0f) * fall * way;
}

static int last_birth(const OutTree *tree)
{
    int last = 1;
    for (int64_t i = 0; i < tree->count; i++) {
        last = tree->birth[i] > last ? tree->birth[i] : last;
    }
    return last;
}

float terrain_course_height(const TerrainParams *given, const OutTree *tree, int64_t i)
{
    TerrainParams params = terrain_params_resolve(given);
    return course_height(&params, (float)tree->birth[i] / (float)last_birth(tree), 1.0f);
}

// Makes the samples within `half` of a place the base.
static void set_base(Landscape *land, double x, double z, double half, double height)
{
    int reach = 1 + (int)(half / land->cell);
    int column = (int)((x - land->corner) / land->cell + 0.5);
    int row = (int)((z - land->corner) / land->cell + 0.5);
    for (int r = row - reach; r <= row + reach; r++) {
        for (int c = column - reach; c <= column + reach; c++) {
            if (r < 0 || c < 0 || r >= land->side || c >= land->side) {
                continue;
            }
            double dx = land->corner + c * land->cell - x, dz = land->corner + r * land->cell - z;
            if (dx * dx + dz * dz <= half * half) {
                landscape_set_base(land, (int64_t)r * land->side + c, height);
            }
        }
    }
}

// Moves the rivers to where they are at this time. Their bends have grown while they cut down.
static void set_rivers(const Plateau *p, Landscape *land, double time)
{
    const OutTree *tree = p->terrain->tree;
    float depth = time < p->cut ? (float)(time / p->cut) : 1.0f, grown = 0.8f + 0.2f * depth;
    float last = (float)last_birth(tree);
    memset(land->base, 0, (size_t)landscape_count(land));
    for (int64_t i = 0; i < tree->count; i++) {
        float way = (float)tree->birth[i] / last;
        Vec3 at = tree->position[i];
        at.x *= p->params.form == TERRAIN_CANYON ? grown : 1.0f;
        double half = fmax((double)tree->radius[i], 0.75 * land->cell);
        int64_t below = tree->parent[i] >= 0 ? tree->parent[i] : i;
        Vec3 to = tree->position[below];
        to.x *= p->params.form == TERRAIN_CANYON ? grown : 1.0f;
        int steps = 1 + (int)(vec3_distance(vec3(at.x, 0, at.z), vec3(to.x, 0, to.z)) /
                              (0.7f * (float)land->cell));
        for (int k = 0; k < steps; k++) {
            float t = (float)k / (float)steps;
            set_base(land, (double)lerpf(at.x, to.x, t), (double)lerpf(at.z, to.z, t), half,
                     (double)course_height(&p->params, way, depth));
        }
    }
}

// ---- the plateau

// Two sets of joints cut the plateau, as everywhere where it was bent: in their crushed zones,
// which are long and narrow, streams and faces get ahead, so that side canyons and alcoves follow
// them.
typedef struct JointSet {
    float x, z; // unit: along the joints
    uint64_t key;
} JointSet;

static JointSet joint_set(const Terrain *terrain, int number)
{
    uint64_t key = random_key(random_key(terrain->seed, STREAM_WEAKNESS), 1);
    float turn = random_range(key, 0.0f, 3.1415927f) + 1.3f * (float)number;
    JointSet set = {.key = random_key(key, (uint64_t)number + 1)};
    exact_sincos(turn, &set.z, &set.x);
    return set;
}

// Mean 0; high in crushed zones. Places in shares of the size.
static float crushed(const JointSet *set, float x, float z)
{
    float along = 7.0f * (x * set->x + z * set->z), across = 30.0f * (z * set->x - x * set->z);
    return sparse_noise_fractal(along, across, 3, 0.7f, 0.7f, set->key);
}

static void set_weakness(const Plateau *p, Landscape *land, const Run *run)
{
    uint64_t key = random_key(p->terrain->seed, STREAM_WEAKNESS);
    JointSet set[] = {joint_set(p->terrain, 0), joint_set(p->terrain, 1)};
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            float x = (float)(land->corner + column * land->cell) / p->size;
            float z = (float)(land->corner + row * land->cell) / p->size;
            float n = sparse_noise_fractal(14.0f * x, 14.0f * z, 5, 0.7f, 0.0f, key);
            float zone = fmaxf(crushed(&set[0], x, z), crushed(&set[1], x, z));
            land->weakness[(int64_t)row * land->side + column] =
                clampf(0.85f + 0.3f * n + 0.35f * zone, 0.25f, 2.2f);
        }
    }
}

// Heights of the plateau before rivers cut it at `count` <= FORM_MOST_SAMPLES places.
static void plateau_along(const Terrain *terrain, const TerrainParams *params, const float *x,
                          const float *z, int count, float *height)
{
    uint64_t key = random_key(terrain->seed, STREAM_PLATEAU);
    float tilt = params->form == TERRAIN_CANYON ? 0.008f : 0.0f;
    float u[FORM_MOST_SAMPLES], v[FORM_MOST_SAMPLES], n[FORM_MOST_SAMPLES];
    for (int k = 0; k < count; k++) {
        u[k] = 7.0f * x[k] / params->size;
        v[k] = 7.0f * z[k] / params->size;
    }
    sparse_noise_fractal_along(u, v, count, 6, 0.5f, 0.0f, key, n);
    for (int k = 0; k < count; k++) {
        height[k] = params->relief + tilt * fabsf(x[k]) + 0.0014f * params->size * n[k];
    }
}

static void raise_part(const Plateau *p, Landscape *land, int row, int first)
{
    float x[FORM_MOST_SAMPLES] = {0}, z[FORM_MOST_SAMPLES] = {0}, height[FORM_MOST_SAMPLES];
    int left = land->side - first, count = left < FORM_MOST_SAMPLES ? left : FORM_MOST_SAMPLES;
    for (int k = 0; k < count; k++) {
        x[k] = (float)(land->corner + (first + k) * land->cell);
        z[k] = (float)(land->corner + row * land->cell);
    }
    plateau_along(p->terrain, &p->params, x, z, count, height);
    double *rock = land->rock + (int64_t)row * land->side + first;
    for (int k = 0; k < count; k++) {
        rock[k] = (double)height[k];
    }
}

static void raise_plateau(const Plateau *p, Landscape *land, const Run *run)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int first = 0; first < land->side; first += FORM_MOST_SAMPLES) {
            raise_part(p, land, row, first);
        }
    }
}

// The distance that the beds' stable profile takes from the rivers to the plateau.
static float profile_width(const Plateau *p)
{
    const Strata *strata = p->terrain->strata;
    float middle = strata_base(strata, 0.0f, 0.0f);
    return (float)(strata_run(strata, (double)(p->params.relief - middle)) -
                   strata_run(strata, (double)-middle));
}

// m: the width of the belt in which the river winds, three times the deviation from its middle.
static float winding_belt(const OutTree *tree)
{
    double sum = 0.0, squares = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        double x = (double)tree->position[i].x;
        sum += x;
        squares += x * x;
    }
    double mean = sum / (double)tree->count;
    return 3.0f * sqrtf((float)(squares / (double)tree->count - mean * mean));
}

// m by which faces of soft rock weather back in all.
static float retreat_of(const Plateau *p)
{
    const TerrainParams *params = &p->params;
    float profile = profile_width(p);
    if (params->form == TERRAIN_CANYON) {
        float belt = params->canyon.river + winding_belt(p->terrain->tree);
        float beyond = 0.5f * (params->canyon.width - belt) - profile;
        return 2.0f * (beyond > 0.0f ? beyond : 0.0f);
    }
    float spacing = params->size / (0.5f * (float)params->mesas.streams);
    float reach = 0.5f * spacing * (1.0f - sqrtf(params->mesas.remaining)) - profile;
    return 1.5f * (reach > 0.0f ? reach : 0.0f);
}

static float tangent(float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * 0.017453292f, &sine, &cosine);
    return sine / cosine;
}

static Plateau plateau_of(const Terrain *terrain)
{
    Plateau p = {.terrain = terrain, .params = terrain_params_resolve(terrain->params)};
    const EvolutionParams *evolution = &p.params.evolution;
    bool canyon = p.params.form == TERRAIN_CANYON;
    double size = (double)p.params.size,
           reach = canyon ? (double)p.params.canyon.side_canyons : 0.6;
    p.size = p.params.size;
    p.cut = canyon ? 0.8 : 0.3;
    p.rates = (LandscapeRates){.incision = 8.0 * reach * (double)evolution->streams,
                               .loose = 30.0 * (double)evolution->streams,
                               .least_area = 2e-5 * size * size,
                               .deposition = (double)evolution->deposition,
                               .retreat = (double)(retreat_of(&p) * evolution->weathering),
                               .rubble = (double)evolution->rubble,
                               .repose = (double)tangent(evolution->repose),
                               .wash = 8.0,
                               .soil = 1e-4 * size * (double)evolution->soil,
                               .creep = 3e-7 * size * size * (double)evolution->soil,
                               .seed = random_key(terrain->seed, STREAM_WATER_WAYS)};
    return p;
}

// ---- time

// Evolves the land from one time to another, in steps in which no face moves by half a cell.
static bool evolve(const Plateau *p, Landscape *land, double from, double to, const Run *run,
                   Error *e)
{
    enum { REROUTE = 2, LEAST_STEPS = 12 };
    double most = 0.3 * land->cell / fmax(p->rates.retreat, 1e-6 * (double)p->size);
    most = fmin(most, 0.01);
    int steps = (int)((to - from) / most) + 1;
    steps = steps > LEAST_STEPS ? steps : LEAST_STEPS;
    double step = (to - from) / steps;
    for (int i = 0; i < steps; i++) {
        double time = from + step * (i + 1);
        run_progress(run, "erosion", time);
        set_rivers(p, land, time);
        if (!landscape_step(land, &p->rates, step, i % REROUTE == 0, run, e)) {
            return false;
        }
    }
    return true;
}

Landscape *terrain_evolve_plateau(Terrain *terrain, const Run *run, Error *e)
{
    enum { FIRST_CELLS = 256 };
    static const double until[] = {0.7, 0.9, 0.97, 0.99}; // time at which a finer grid takes over
    Plateau p = plateau_of(terrain);
    int last = p.params.resolution < p.params.evolution.cells ? p.params.resolution
                                                              : p.params.evolution.cells;
    int cells = last < FIRST_CELLS ? last : FIRST_CELLS;
    Landscape *land = landscape_new(cells, (double)p.size, terrain->strata, e);
    if (land) {
        raise_plateau(&p, land, run);
    }
    double time = 0.0;
    for (int level = 0; land; level++, cells *= 2) {
        double end = cells < last && level < 4 ? until[level] : 1.0;
        set_weakness(&p, land, run);
        Landscape *finer = NULL;
        bool done = evolve(&p, land, time, end, run, e);
        if (done && cells >= last) {
            return land;
        }
        finer = done ? landscape_refined(land, run, e) : NULL;
        landscape_free(land);
        land = finer;
        time = end;
    }
    return NULL;
}

// Faces follow joints: they are not as smooth in plan as the grid of the processes makes them.
// Moves places, all of row z.
static void move_to_joints(const Terrain *terrain, bool worn, float *x, float *z, int count)
{
    const float wavelength = (worn ? 0.009f : 0.006f) * terrain->params->size;
    uint64_t key = random_key(terrain->seed, STREAM_JOINTS);
    // Places that move must not pass each other: rock would stand in needles where they do.
    float reach = 0.05f * wavelength;
    float u[FORM_MOST_SAMPLES], v[FORM_MOST_SAMPLES], n[2][FORM_MOST_SAMPLES];
    for (int axis = 0; axis < 2; axis++) {
        for (int k = 0; k < count; k++) {
            u[k] = x[k] / wavelength;
            v[k] = z[k] / wavelength;
        }
        sparse_noise_fractal_along(u, v, count, 4, 0.55f, 0.0f, key + (uint64_t)axis, n[axis]);
    }
    for (int k = 0; k < count; k++) {
        x[k] += reach * n[0][k];
        z[k] += reach * n[1][k];
    }
}

void terrain_evolved_along(const Terrain *terrain, const float *x, float z, int count,
                           EvolvedPlace *place)
{
    bool worn = terrain_form(terrain->params)->plateau;
    float at_x[FORM_MOST_SAMPLES], at_z[FORM_MOST_SAMPLES], whole[FORM_MOST_SAMPLES];
    for (int k = 0; k < count; k++) {
        at_x[k] = x[k];
        at_z[k] = z;
    }
    move_to_joints(terrain, worn, at_x, at_z, count);
    if (worn) {
        TerrainParams params = terrain_params_resolve(terrain->params);
        plateau_along(terrain, &params, at_x, at_z, count, whole);
    }
    for (int k = 0; k < count; k++) {
        double loose;
        double height = landscape_at(terrain->evolved, (double)at_x[k], (double)at_z[k], &loose);
        place[k] = (EvolvedPlace){.height = (float)height, .loose = (float)loose};
        // Between samples rock may lie a little above the plateau: it was not worn there.
        place[k].change = worn ? fminf(place[k].height - whole[k], place[k].loose) : 0.0f;
    }
}
