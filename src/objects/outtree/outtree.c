// Growth of a general out-tree: start points, placed attractors, levels, further growths.
#include "objects/outtree/outtree.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/lsystem/lsystem.h"
#include "objects/common/on_surface.h"
#include "outtree/chains.h"
#include "outtree/crossings.h"
#include "outtree/jitter.h"

#include <stdlib.h>

// Horiuchi et al.: three ways on from every branch.
static const char STRING_AXIOM[] = "X";
static const char STRING_RULES[] = "X -> [+FX][-FX]FX";

OuttreeParams outtree_params_default(void)
{
    OuttreeParams params = {.starts = {.direction = {0, -1, 0}},
                            .string = {.generations = 7, .angle = 30.0f, .group = 60.0f},
                            .radii = {.model = OUTTREE_PIPE, .exponent = 2.5f, .ratio = 0.5f},
                            .jitter = {.hurst = 0.7f},
                            .skin = {.levels = 1, .ring_spacing = 1.0f},
                            .leaves = {.max_count = 0,
                                       .spacing = 0.03f,
                                       .twig_radius = 0.01f,
                                       .length = 0.06f,
                                       .width = 0.035f,
                                       .size_variation = 0.35f,
                                       .petiole = 0.008f,
                                       .fold = 22.0f,
                                       .curl = 25.0f,
                                       .wave = 0.05f,
                                       .lobe_depth = 0.42f,
                                       .crowding = 0.75f,
                                       .emergence = 1.0f,
                                       .angle = 55.0f,
                                       .droop = 0.3f,
                                       .phyllotaxis = 137.5f,
                                       .variants = 4,
                                       .detail = 1},
                            .crossings = true,
                            .blades = {.relief = 0.5f},
                            .lamps = {.radius = 0.02f},
                            .show = {.facing = {0, 0, 1}}};
    params.element.growth.max_children = 3;
    params.element.growth.noise = 0.2f;
    params.element.growth.field_weight = 1.0f;
    return params;
}

const GrowLevel *outtree_own_levels(int *count)
{
    static const GrowLevel OWN[2] = {{150, 0.2f, 0.6f, 4.0f, 1.0f, 0.2f, 1.0f, 0.5f},
                                     {2500, 0.35f, 0.9f, 2.2f, 1.0f, 0.2f, 1.0f, 0.5f}};
    *count = 2;
    return OWN;
}

static int placed_attractors(const OuttreeParams *params)
{
    int count = 0;
    for (int i = 0; i < params->placed.count; i++) {
        count += params->placed.points[i].group == GROUP_ATTRACTOR;
    }
    return count;
}

bool outtree_scatters(const OuttreeParams *params)
{
    return params->element.level_count > 0 || placed_attractors(params) == 0;
}

// The unit sphere, or a box about the placed points if attractors are among them.
static Shape own_shape(const OuttreeParams *params)
{
    Shape shape = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()};
    if (placed_attractors(params) > 0) {
        Aabb box = aabb_empty();
        for (int i = 0; i < params->placed.count; i++) {
            box = aabb_add(box, params->placed.points[i].position);
        }
        float room = 0.05f * vec3_distance(box.low, box.high) + 1e-6f;
        shape.kind = SHAPE_BOX;
        shape.size = vec3_add(vec3_scale(vec3_sub(box.high, box.low), 0.5f), vec3_splat(room));
        shape.transform = transform_compose(vec3_lerp(box.low, box.high, 0.5f), vec3_splat(0.0f),
                                            vec3_splat(1.0f));
    }
    return shape;
}

const char *outtree_over(const void *given)
{
    const OuttreeParams *params = given;
    const Shape *first = params->element.shape_count > 0 ? params->element.shapes : NULL;
    return first && first->kind == SHAPE_OBJECT ? first->object : NULL;
}

Envelope *outtree_envelope(const OuttreeParams *params, const Recipe *recipe, Error *e)
{
    ElementParams element = params->element;
    Shape own = own_shape(params);
    if (recipe->surface) {
        return envelope_of_surface(recipe->surface, e);
    }
    if (element.shape_count == 0) {
        element.shapes = &own;
        element.shape_count = 1;
    }
    return element_envelope(&element, recipe->run, e);
}

// What all steps of one growth share.
typedef struct Growing {
    const OuttreeParams *params;
    const Recipe *recipe;
    const Envelope *envelope;
    OutTree *tree;
    OnSurface on; // of the envelope
    AttractorLog *log;
    GrowString string;
    int64_t starts; // number of start points, the tree's first nodes
} Growing;

static bool prepare_string(Growing *g, Error *e)
{
    const StringParams *p = &g->params->string;
    LSystemParams params = {.axiom = p->axiom ? p->axiom : STRING_AXIOM,
                            .rules = p->rules ? p->rules : (p->axiom ? "" : STRING_RULES),
                            .generations = p->generations,
                            .seed = random_key(g->recipe->seed, STREAM_OUTTREE_STRING)};
    ModuleString modules;
    bool done = lsystem_derive(&params, g->recipe->run, &modules, e) &&
                (grow_string_init(&g->string, &modules, p->angle, e) || error_key(e, "axiom"));
    module_string_clear(&modules);
    return done || error_key(e, "string");
}

// What the element's growth takes from the rest of the object.
static ElementParams complete(const Growing *g, const ElementParams *given)
{
    ElementParams element = *given;
    element.points = g->params->element.points;
    element.density = g->params->element.density;
    element.growth.log = g->log;
    element.growth.project = element.points.place == SCATTER_SURFACE ? surface_project : NULL;
    element.growth.surface = &g->on;
    if (element.growth.rule == GROW_STRING) {
        const StringParams *string = &g->params->string;
        element.growth.string = &g->string;
        element.growth.sector_angle = string->group;
        element.growth.regularity = string->regularity;
        element.growth.length_near = string->length;
        element.growth.length_far = string->length_tip > 0.0f ? string->length_tip : string->length;
    }
    return element;
}

// Grows toward the placed attractors.
static bool grow_placed(Growing *g, Error *e)
{
    if (placed_attractors(g->params) == 0) {
        return true;
    }
    const PlacedParams *placed = &g->params->placed;
    ElementParams element = complete(g, &g->params->element);
    uint64_t seed = random_key(g->recipe->seed, STREAM_OUTTREE_PLACED);
    PointSet *points = outtree_placed_attractors(g->params, g->envelope, seed, e);
    GuideField *field = NULL;
    bool done = points && element_guide_field(g->tree, g->starts, &element, g->envelope, seed,
                                              g->recipe->run, &field, e);
    if (done) {
        ColonizeParams params = element_colonize_params(g->tree, &element, field, seed);
        GrowReport report;
        params.room = g->recipe->room;
        params.step = placed->step;
        params.kill = placed->kill;
        params.influence = placed->influence;
        colonize_auto(&params, points_spacing(points), 0.5f, 1.0f, 6.0f);
        done = growth_observe(g->recipe, NULL, g->envelope, field, e) &&
               colonize(g->tree, points, &params, g->recipe->run, &report, e);
        if (done && report.stop == STOP_OUT_OF_REACH) {
            char text[256];
            grow_report_format(&report, &params, text, sizeof text);
            recipe_warn(g->recipe, "placed", "%s", text);
        }
        done = done || error_key(e, "placed");
    }
    guide_field_free(field);
    points_free(points);
    return done;
}

static bool settle(Growing *g, Error *e)
{
    return g->params->element.points.place != SCATTER_SURFACE || surface_settle(&g->on, g->tree, e);
}

static bool resample(Growing *g, float segment, Error *e)
{
    OutTree *fine = out_tree_resample(g->tree, segment, e);
    out_tree_free(g->tree);
    g->tree = fine;
    return (fine && settle(g, e)) || error_key(e, "segment");
}

static bool grow_first(Growing *g, Error *e)
{
    if (!outtree_scatters(g->params)) {
        return true;
    }
    ElementParams element = complete(g, &g->params->element);
    int own;
    const GrowLevel *levels = outtree_own_levels(&own);
    if (element.level_count == 0) {
        element.levels = (GrowLevel *)levels;
        element.level_count = own;
    }
    return element_grow_in(g->tree, g->starts, &element, g->envelope,
                           random_key(g->recipe->seed, STREAM_OUTTREE_GROWTH), g->recipe, NULL, e);
}

static bool grow_further(Growing *g, int number, Error *e)
{
    const FurtherParams *further = &g->params->further[number];
    ElementParams element = complete(g, &further->element);
    uint64_t stream = STREAM_OUTTREE_FURTHER + (uint64_t)number;
    bool done = (further->segment <= 0.0f || resample(g, further->segment, e)) &&
                element_grow_in(g->tree, g->tree->count, &element, g->envelope,
                                random_key(g->recipe->seed, stream), g->recipe, NULL, e) &&
                settle(g, e);
    return done || error_key(e, "further.%d", number);
}

static bool grow_all(Growing *g, Error *e)
{
    if (!outtree_plant(g->tree, g->params, g->envelope, g->recipe, e)) {
        return false;
    }
    g->starts = g->tree->count;
    bool done = grow_placed(g, e) && grow_first(g, e) && settle(g, e);
    for (int i = 0; done && i < g->params->further_count; i++) {
        done = grow_further(g, i, e);
    }
    return done;
}

// ---- after growth ----

// Takes the tree and returns it with jittered branches.
static OutTree *wander(OutTree *tree, const OuttreeParams *params, const OnSurface *on,
                       const Recipe *recipe, Error *e)
{
    const WanderParams *given = &params->jitter;
    if (given->segment > 0.0f) {
        OutTree *fine = out_tree_resample(tree, given->segment, e);
        out_tree_free(tree);
        tree = fine;
        if (!tree) {
            error_key(e, "jitter.segment");
            return NULL;
        }
    }
    JitterParams jitter = jitter_params_default();
    jitter.hurst = given->hurst;
    jitter.amplitude = given->amplitude * on->extent;
    jitter.reference = on->extent;
    jitter.pin_forks = given->pin_forks;
    jitter.seed = random_key(recipe->seed, STREAM_OUTTREE_JITTER);
    if (params->element.points.place == SCATTER_SURFACE) {
        jitter.project = surface_project;
        jitter.surface = on;
        jitter.stride = on->stride;
    }
    if (given->amplitude > 0.0f && !out_tree_jitter(tree, &jitter, recipe->run, e)) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

static bool finish_growth(Growing *g, Error *e)
{
    const OuttreeParams *params = g->params;
    bool over_surface = params->element.points.place == SCATTER_SURFACE;
    if (over_surface && !params->crossings &&
        !out_tree_drop_crossings(g->tree, g->recipe->run, e)) {
        return false;
    }
    ThicknessParams radii = outtree_resolve_radii(g->tree, &params->radii);
    if (!outtree_radii(g->tree, &radii, e)) { // jitter follows the thickest branches
        return false;
    }
    g->tree = wander(g->tree, params, &g->on, g->recipe, e);
    if (!g->tree || (over_surface && !surface_drop_strays(&g->on, g->tree, INFINITY, e)) ||
        !outtree_radii(g->tree, &radii, e)) {
        return false;
    }
    for (int64_t i = 0; params->lift > 0.0f && i < g->tree->count; i++) {
        g->tree->position[i] = vec3_madd(g->tree->position[i], params->lift, g->tree->normal[i]);
    }
    return true;
}

bool outtree_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    Growing g = {.params = given, .recipe = recipe};
    Envelope *envelope = outtree_envelope(given, recipe, e);
    g.envelope = envelope;
    g.on = envelope ? on_surface(envelope) : (OnSurface){0};
    g.tree = envelope ? out_tree_new(e) : NULL;
    whole->state = g.log = g.tree ? memory_alloc_zero(1, sizeof *g.log, e) : NULL;
    whole->free_state = outtree_free_attractors;
    bool done = g.log && prepare_string(&g, e) && grow_all(&g, e) && finish_growth(&g, e);
    whole->tree = g.tree;
    grow_string_clear(&g.string);
    envelope_free(envelope);
    return done;
}

float outtree_tip_radius(const void *params, const OutTree *whole)
{
    (void)params;
    float least = whole->count > 0 ? whole->radius[0] : 0.0f;
    for (int64_t i = 1; i < whole->count; i++) {
        least = whole->radius[i] < least ? whole->radius[i] : least;
    }
    return least;
}
