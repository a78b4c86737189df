// Growth of a climber over a surface.
#include "objects/climber/climber.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "grow/colonize.h"
#include "objects/common/on_surface.h"
#include "outtree/radii.h"

#include <stdlib.h>

static Phenology evergreen(void)
{
    Phenology year = phenology_default();
    year.evergreen = true;
    return year;
}

ClimberParams climber_params_default(void)
{
    return (ClimberParams){.height = 3.0f,
                           .spread = 1.5f,
                           .spacing = 0.05f,
                           .patchiness = 0.25f,
                           .climb = 0.5f,
                           .wander = 0.35f,
                           .offset = 0.002f,
                           .hanging = {150, 0.5f, 0.5f, .clump_size = 0.8f},
                           .rootlets = {.length = 0.012f, .radius = 0.0003f},
                           .radii = {.model = RADIUS_PIPE, .exponent = 2.6f, .tip = 0.0012f},
                           .root_radius = 0.02f,
                           .leaves = {.max_count = 200000,
                                      .spacing = 0.02f,
                                      .twig_radius = 0.012f,
                                      .arrangement = ARRANGE_DISTICHOUS,
                                      .phyllotaxis = 137.5f,
                                      .angle = 75.0f,
                                      .droop = 0.85f,
                                      .shape = LEAF_PALMATE,
                                      .length = 0.065f,
                                      .width = 0.08f,
                                      .size_variation = 0.5f,
                                      .petiole = 0.05f,
                                      .fold = 8.0f,
                                      .curl = 15.0f,
                                      .wave = 0.03f,
                                      .widest = 0.5f,
                                      .tip = 0.5f,
                                      .lobes = 5,
                                      .lobe_depth = 0.33f,
                                      .variants = 5,
                                      .detail = 1,
                                      .emergence = 1.0f},
                           .skin = {.curve_radius = 0.004f, .levels = 1, .ring_spacing = 1.0f},
                           .latitude = 50.0f,
                           .phenology = evergreen()};
}

// What the stages of one growth share.
typedef struct Climb {
    const ClimberParams *params;
    const Recipe *recipe;
    OnSurface on;
    OutTree *tree;
} Climb;

static bool plant(const Climb *climb, Error *e)
{
    const ShapeSurface *surface = climb->recipe->surface;
    for (int i = 0; i < climb->params->start_count; i++) {
        Vec3 position = climb->params->starts[i].position, normal;
        surface->nearest(surface->user, &position, &normal);
        uint64_t id =
            random_key(random_key(climb->recipe->seed, STREAM_CLIMBER_ROOTS), (uint64_t)i);
        int64_t node = out_tree_add_node(climb->tree, position, -1, 0, i, id, e);
        if (node < 0) {
            return false;
        }
        climb->tree->normal[node] = normal;
    }
    return true;
}

// Does the climber reach p? An arch above some start, its outline and patches ragged by noise.
static bool reaches(const Climb *climb, Vec3 p, Vec3 normal)
{
    const ClimberParams *params = climb->params;
    uint64_t key = random_key(climb->recipe->seed, STREAM_CLIMBER_PATCHES);
    Vec3 at = vec3_scale(p, 2.5f / params->spread);
    float rough = noise_space(at, key) + 0.5f * noise_space(vec3_scale(at, 2.3f), key + 1);
    bool near = false;
    for (int64_t i = 0; i < params->start_count && !near; i++) {
        Vec3 way = vec3_sub(p, climb->tree->position[i]);
        float up = way.y / params->height;
        float across = (way.x * way.x + way.z * way.z) / (params->spread * params->spread);
        float least = (normal.y < -0.5f ? 1.0f : -0.5f) * params->spacing; // not under its foot
        near = way.y > least && up * up + across < 1.0f + 0.8f * rough;
    }
    float patch = noise_space(vec3_scale(at, 1.7f), key + 2);
    return near && patch > -0.7f + 0.7f * params->patchiness;
}

// About one attractor in each square of this side (m), where the climber reaches.
static PointSet *scatter(const Climb *climb, float side, uint64_t seed, Error *e)
{
    ScatterParams wanted = scatter_params_default();
    wanted.place = SCATTER_SURFACE;
    wanted.seed = seed;
    wanted.count = (int64_t)(envelope_area(climb->on.envelope) / ((double)side * (double)side)) + 1;
    PointSet *all = points_scatter(climb->on.envelope, &wanted, climb->recipe->run, e);
    for (int64_t i = 0, kept = 0; all; i++) {
        if (i == all->count) {
            all->count = kept;
            break;
        }
        if (reaches(climb, all->position[i], all->normal[i])) {
            all->position[kept] = all->position[i];
            all->normal[kept] = all->normal[i];
            all->id[kept++] = all->id[i];
        }
    }
    return all;
}

// One growth toward attractors `side` m apart.
static bool spread_out(const Climb *climb, float side, uint64_t number, Error *e)
{
    const ClimberParams *params = climb->params;
    uint64_t seed = random_key(climb->recipe->seed, STREAM_CLIMBER_ATTRACTORS + 100u * number);
    PointSet *points = scatter(climb, side, seed, e);
    if (!points) {
        return error_key(e, "spacing");
    }
    ColonizeParams growth = colonize_params_default();
    growth.step = 0.4f * side;
    growth.kill = 0.9f * side;
    growth.influence = 3.0f * side;
    growth.max_children = 3;
    growth.noise = params->wander;
    growth.tropism = vec3(0, params->climb, 0);
    growth.on_surface = true;
    growth.project = surface_project;
    growth.surface = &climb->on;
    growth.room = climb->recipe->room;
    growth.seed = random_key(climb->recipe->seed, STREAM_CLIMBER_GROWTH + 100u * number);
    growth.first_step = out_tree_last_birth(climb->tree);
    bool done =
        points->count == 0 || colonize(climb->tree, points, &growth, climb->recipe->run, NULL, e);
    points_free(points);
    return done && surface_settle(&climb->on, climb->tree, e);
}

// Few long stems first, then finer ones between them.
static bool climb_up(const Climb *climb, Error *e)
{
    static const float coarseness[] = {6.0f, 2.5f, 1.0f};
    for (uint64_t i = 0; i < sizeof coarseness / sizeof *coarseness; i++) {
        if (!spread_out(climb, coarseness[i] * climb->params->spacing, i, e)) {
            return false;
        }
    }
    return true;
}

// Notes which nodes of the whole growth hang free: those from number `clinging` on.
static bool note_hanging(Grown *whole, int64_t clinging, Error *e)
{
    bool *hangs = memory_alloc_zero(whole->tree->count, sizeof *hangs, e);
    whole->state = hangs;
    whole->free_state = free;
    for (int64_t i = clinging; hangs && i < whole->tree->count; i++) {
        hangs[i] = true;
    }
    return hangs;
}

// The same of what is left of it after it was cut, in the same order.
static bool copy_hanging(const Grown *whole, Grown *grown, Error *e)
{
    bool *hangs = memory_alloc_zero(grown->tree->count, sizeof *hangs, e);
    const bool *all = whole->state;
    grown->state = hangs;
    grown->free_state = free;
    for (int64_t i = 0, node = 0; hangs && i < grown->tree->count; i++, node++) {
        while (whole->tree->id[node] != grown->tree->id[i]) {
            node++;
        }
        hangs[i] = all[node];
    }
    return hangs;
}

bool climber_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const ClimberParams *params = given;
    Envelope *envelope = envelope_of_surface(recipe->surface, e);
    whole->tree = envelope ? out_tree_new(e) : NULL;
    bool done = whole->tree;
    if (done) {
        Climb climb = {params, recipe, on_surface(envelope), whole->tree};
        done = plant(&climb, e) && climb_up(&climb, e);
        int64_t clinging = whole->tree->count;
        done = done && climber_add_hanging(whole->tree, params, recipe, e) &&
               note_hanging(whole, clinging, e);
        if (done && whole->tree->count == params->start_count) {
            recipe_warn(recipe, NULL,
                        "nothing grew: no point of '%s' lies within height %g m and spread %g m of "
                        "a start",
                        params->climbs, (double)params->height, (double)params->spread);
        }
    }
    envelope_free(envelope);
    return done;
}

// Radii, and stems lifted off the surface by theirs.
bool climber_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e)
{
    (void)recipe;
    const ClimberParams *params = given;
    OutTree *tree = grown->tree;
    out_tree_pipe_radii(tree, params->radii.exponent, params->radii.tip, params->root_radius);
    for (int64_t i = 0; i < tree->count; i++) {
        float lift = params->offset + tree->radius[i];
        tree->position[i] = vec3_madd(tree->position[i], lift, tree->normal[i]);
    }
    return copy_hanging(whole, grown, e);
}
