// Growth of corals: attractors, roots, the string's directions, thickness.
#include "objects/coral/coral.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "grow/colonize.h"
#include "objects/common/element.h"
#include "objects/coral/fan.h"
#include "outtree/join.h"
#include "outtree/radii.h"
#include "shape/points.h"

#include <stdlib.h>

enum { STREAM_LUMP_TURN = 1, STREAM_LUMP_SIZE = 2 };             // of a boulder's lump
enum { STREAM_TILT_X = 0, STREAM_TILT_Z = 1, STREAM_LOBES = 2 }; // of an uneven plate
enum { STREAM_LOBE_TURN = 0, STREAM_LOBE_WAY = 1, STREAM_LOBE_WIDTH = 2, STREAM_LOBE_RISE = 3 };
enum { STREAM_BRANCHLETS = 77 }; // of a node's id
// Of a node's branchlets; those of attractor k start at STREAMS_A_BRANCHLET * k.
enum { STREAM_RISE = 0, STREAM_X = 1, STREAM_Z = 2, STREAMS_A_BRANCHLET = 4 };

#define GOLDEN_ANGLE 2.39996323f

enum { STEM_NODES = 4, MOST_COLONIES = 256, PLATE_LOBES = 12 };

// State of a coral's growth.
typedef struct Growing {
    const CoralParams *params; // resolved
    const Recipe *recipe;
    OutTree *tree;
    GrowString string;
} Growing;

Vec3 coral_foot(const CoralParams *p, int colony)
{
    if (p->colonies == 1) {
        return p->position;
    }
    float s, c;
    exact_sincos(2.0f * PI_F * (float)colony / (float)p->colonies, &s, &c);
    if (p->form == CORAL_FAN) { // side by side in the plane
        float along = 2.0f * (float)colony / (float)(p->colonies - 1) - 1.0f;
        return vec3_madd(p->position, p->spread, vec3(along, 0, 0));
    }
    return vec3_madd(p->position, p->spread, vec3(c, 0, s));
}

static Shape ellipsoid(Vec3 center, Vec3 half)
{
    return (Shape){.kind = SHAPE_ELLIPSOID,
                   .op = SHAPE_UNION,
                   .size = half,
                   .transform = transform_compose(center, vec3_splat(0), vec3_splat(1))};
}

// Boulders: an ellipsoid sunk into the ground with smaller ones around it.
static int boulder(const CoralParams *p, uint64_t seed, Shape *shapes, int most)
{
    int lumps = p->form == CORAL_MASSIVE ? 9 : 12;
    float r = 0.5f * p->size, h = p->height;
    shapes[0] = ellipsoid(p->position, vec3(0.84f * r, 0.86f * h, 0.8f * r));
    int count = 1;
    for (int i = 0; i < lumps && count < most; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float s, c, y = ((float)i + 0.3f) / (float)lumps, across = sqrtf(1.0f - y * y);
        exact_sincos((float)i * GOLDEN_ANGLE +
                         random_range(random_key(key, STREAM_LUMP_TURN), -0.4f, 0.4f),
                     &s, &c);
        float size = random_range(random_key(key, STREAM_LUMP_SIZE), 0.3f, 0.5f) * r;
        Vec3 at =
            vec3(c * across * (r - 0.9f * size), y * 0.62f * h, s * across * (r - 0.9f * size));
        shapes[count++] = ellipsoid(vec3_add(p->position, at),
                                    vec3(size, 0.8f * size * h / r + 0.1f * size, size));
    }
    return count;
}

Envelope *coral_base(const CoralParams *p, uint64_t seed, const Run *run, Error *e)
{
    Shape shapes[16];
    EnvelopeParams params = {
        .shapes = p->base, .shape_count = p->base_count, .voxel = p->size / 110.0f};
    if (p->base_count == 0) {
        params.shapes = shapes;
        params.shape_count = boulder(p, random_key(seed, STREAM_CORAL_BOULDER), shapes, 16);
    }
    return envelope_new(&params, run, e);
}

// The middle of a table's plate, which its stalk may miss.
static Vec3 plate_middle(const CoralParams *p, int colony, uint64_t seed)
{
    Vec3 foot = coral_foot(p, colony);
    if (p->eccentric <= 0.0f) {
        return foot;
    }
    float s, c;
    exact_sincos(2.0f * PI_F * random_unit(random_key(seed, STREAM_CORAL_ASIDE + (uint64_t)colony)),
                 &s, &c);
    return vec3_madd(foot, 0.5f * p->size * p->eccentric, vec3(c, 0, s));
}

// An uneven plate about `middle`: a disc with lobes around it, all tilted together, each lobe at a
// height of its own. Shares below are of the half size, for an unevenness of 1.
static int uneven_plate(const CoralParams *p, Vec3 middle, uint64_t seed, Shape *shapes)
{
    float r = 0.5f * p->size, u = p->uneven, half = 0.5f * p->plate;
    float tilt_x = 9.0f * u * random_range(random_key(seed, STREAM_TILT_X), -1.0f, 1.0f);
    float tilt_z = 9.0f * u * random_range(random_key(seed, STREAM_TILT_Z), -1.0f, 1.0f);
    Transform tilt = transform_compose(vec3_splat(0), vec3(tilt_x, 0, tilt_z), vec3_splat(1));
    for (uint64_t i = 0; i < PLATE_LOBES; i++) {
        uint64_t key = random_key(random_key(seed, STREAM_LOBES), i);
        float s, c, wide = r * (1.0f - 0.4f * u);
        Vec3 off = vec3_splat(0);
        if (i > 0) {
            exact_sincos((float)i * GOLDEN_ANGLE +
                             random_range(random_key(key, STREAM_LOBE_TURN), -0.5f, 0.5f),
                         &s, &c);
            float lobe = u * r * random_range(random_key(key, STREAM_LOBE_WIDTH), 0.3f, 0.6f);
            float way = r - lobe - 0.25f * u * r * random_unit(random_key(key, STREAM_LOBE_WAY));
            float rise =
                0.05f * u * r * random_range(random_key(key, STREAM_LOBE_RISE), -0.4f, 1.0f);
            off = transform_vector(&tilt, vec3(way * c, rise, way * s));
            wide = lobe;
        }
        shapes[i] = (Shape){.kind = SHAPE_ELLIPSOID,
                            .op = SHAPE_UNION,
                            .size = vec3(wide, half, wide),
                            .transform = transform_compose(vec3_add(middle, off),
                                                           vec3(tilt_x, 0, tilt_z), vec3_splat(1))};
    }
    return PLATE_LOBES;
}

// A dome over each colony's foot, all joined; a disc for tables.
static Envelope *room(const CoralParams *p, uint64_t seed, const Run *run, Error *e)
{
    Shape *shapes = memory_alloc(p->colonies * PLATE_LOBES + 1, sizeof *shapes, e);
    if (!shapes) {
        return NULL;
    }
    float r = 0.5f * p->size;
    int count = 0;
    for (int i = 0; i < p->colonies; i++) {
        bool table = p->form == CORAL_TABLE;
        Vec3 foot = table ? plate_middle(p, i, seed) : coral_foot(p, i);
        float middle = (table ? 0.9f : 0.5f) * p->height;
        float half = table ? 0.5f * p->plate : 0.52f * p->height;
        foot.y += middle;
        if (table && p->uneven > 0.0f) {
            uint64_t own = random_key(seed, STREAM_CORAL_PLATE + (uint64_t)i);
            count += uneven_plate(p, foot, own, shapes + count);
        } else {
            shapes[count++] = ellipsoid(foot, vec3(r, half, r));
        }
    }
    if (p->form == CORAL_BRANCHING) { // nothing below the ground
        shapes[count] = (Shape){
            .kind = SHAPE_HALF_SPACE, .op = SHAPE_DIFFERENCE, .transform = transform_identity()};
        shapes[count++].transform.m[1][3] = p->position.y + 0.06f * p->size;
    }
    float voxel = p->size / 64.0f;
    if (p->form == CORAL_TABLE) { // a few across the plate
        voxel = fminf(voxel, 0.4f * p->plate);
    }
    EnvelopeParams params = {.shapes = shapes, .shape_count = count, .voxel = voxel};
    Envelope *envelope = envelope_new(&params, run, e);
    free(shapes);
    return envelope;
}

static PointSet *scatter(const Envelope *envelope, const CoralParams *p, ScatterPlace place,
                         int64_t count, uint64_t seed, const Run *run, Error *e)
{
    ScatterParams params = scatter_params_default();
    params.place = place;
    params.count = count;
    params.seed = seed;
    params.gradient = p->light;
    return points_scatter(envelope, &params, run, e);
}

// ---- roots ----

static int64_t plant(OutTree *tree, Vec3 at, Vec3 normal, int colony, uint64_t seed, Error *e)
{
    int64_t node =
        out_tree_add_node(tree, at, -1, 0, colony, random_key(seed, (uint64_t)colony), e);
    if (node >= 0) {
        tree->normal[node] = normal;
    }
    return node;
}

// Plants a foot in the ground and a node above it (a table: a whole stem), which gives the heading.
static bool plant_upright(Growing *g, int colony, Error *e)
{
    const CoralParams *p = g->params;
    bool flat = p->form == CORAL_FAN;
    float stem = p->form == CORAL_TABLE ? 0.9f * p->height : (flat ? 0.02f : 0.05f) * p->size;
    int pieces = p->form == CORAL_TABLE ? STEM_NODES : 1;
    Vec3 at = coral_foot(p, colony);
    at.y -= flat ? 0.0f : 0.06f * p->size;
    stem += flat ? 0.0f : 0.06f * p->size;
    int64_t node = plant(g->tree, at, vec3(0, 0, 1), colony, g->recipe->seed, e);
    float s, c;
    exact_sincos(
        flat ? 0.0f
             : 2.0f * PI_F *
                   random_unit(random_key(g->recipe->seed, STREAM_CORAL_STEMS + (uint64_t)colony)),
        &s, &c);
    for (int i = 0; node >= 0 && i < pieces; i++) {
        at.y += stem / (float)pieces;
        uint64_t id = out_tree_child_id(g->tree->id[node], 0);
        node = out_tree_add_node(g->tree, at, node, 0, colony, id, e);
        if (node >= 0) {
            g->tree->normal[node] = vec3(s, 0, c);
        }
    }
    if (node >= 0 && p->form == CORAL_TABLE) {
        g->tree->normal[node] = vec3(0, 1, 0); // normal of the plate on it
    }
    return node >= 0;
}

// Plants on the rock, at the attractors nearest to the colonies' places on their circle, high up.
static bool plant_on_rock(Growing *g, const PointSet *points, Error *e)
{
    const CoralParams *p = g->params;
    for (int i = 0; i < p->colonies; i++) {
        Vec3 wanted = vec3_add(coral_foot(p, i), vec3(0, p->height, 0));
        int64_t best = 0;
        float least = INFINITY;
        for (int64_t k = 0; k < points->count; k++) {
            Vec3 d = vec3_sub(points->position[k], wanted);
            float d2 = vec3_dot(d, d);
            if (d2 < least) {
                least = d2;
                best = k;
            }
        }
        if (plant(g->tree, points->position[best], points->normal[best], i, g->recipe->seed, e) <
            0) {
            return false;
        }
    }
    return true;
}

// ---- growth ----

static ColonizeParams colonize_params(const Growing *g, double spacing)
{
    const CoralParams *p = g->params;
    ColonizeParams c = colonize_params_default();
    c.seed = random_key(g->recipe->seed, STREAM_CORAL_GROWTH);
    c.room = g->recipe->room;
    c.noise = p->noise;
    c.tropism = vec3(0, p->form == CORAL_BRANCHING ? 0.12f * p->light : 0.0f, 0);
    // a level plate acts as a surface: its attractors' normals point up
    c.on_surface = (p->form == CORAL_TABLE && p->uneven <= 0.0f) || p->form == CORAL_ENCRUSTING ||
                   p->form == CORAL_MASSIVE;
    c.length_near = p->length;
    c.length_far = p->length_tip;
    c.sector_angle = p->group;
    c.regularity = p->regularity;
    c.rule = p->rule == CORAL_STRING ? GROW_STRING : GROW_MEAN;
    c.string = &g->string;
    c.step = 0.5f * (p->length + p->length_tip);
    // slightly less than a step, so that attractors remain for a node's children
    c.kill = (p->form == CORAL_FAN ? 0.55f : 0.85f) * c.step;
    c.influence = 5.0f * c.step;
    float reach = (float)(3.0 * spacing);
    c.influence = c.influence > reach ? c.influence : reach;
    return c;
}

static bool colonize_points(Growing *g, const PointSet *points, ColonizeParams *c, Error *e)
{
    GrowReport report;
    if (!colonize(g->tree, points, c, g->recipe->run, &report, e)) {
        return false;
    }
    c->first_step += (int32_t)report.steps;
    if (report.stop == STOP_OUT_OF_REACH) {
        char text[256];
        grow_report_format(&report, c, text, sizeof text);
        recipe_warn(g->recipe, NULL, "%s", text);
    }
    return true;
}

// The attractor of a plate's node that leads branchlet `which`; unit: m, of which a branchlet is at
// most 0.05 high.
static Vec3 branchlet_end(Vec3 foot, float unit, uint64_t key, uint64_t which)
{
    uint64_t first = STREAMS_A_BRANCHLET * which;
    float rise = unit * random_range(random_key(key, first + STREAM_RISE), 0.016f, 0.05f);
    Vec3 d = vec3(random_range(random_key(key, first + STREAM_X), -0.012f, 0.012f) * unit, rise,
                  random_range(random_key(key, first + STREAM_Z), -0.012f, 0.012f) * unit);
    return vec3_add(foot, d);
}

// Grows upright branchlets on a table's plate, toward attractors just above it.
static bool grow_branchlets(Growing *g, int32_t first_step, Error *e)
{
    const CoralParams *p = g->params;
    float unit = p->branchlet > 0.0f ? p->branchlet / 0.05f : p->size;
    PointSet *points = points_new(e);
    int64_t plate = g->tree->count;
    bool done = points;
    for (int64_t i = 0; done && i < plate; i++) {
        uint64_t key = random_key(g->tree->id[i], STREAM_BRANCHLETS);
        if (g->tree->birth[i] == 0) {
            continue;
        }
        for (uint64_t k = 0; done && k < 4; k++) {
            Vec3 end = branchlet_end(g->tree->position[i], unit, key, k);
            done = points_add(points, end, vec3(0, 1, 0), key + k, e);
        }
    }
    if (done) {
        points->dimension = 3;
        points->measure = 0.2 * (double)(p->size * p->size * p->size);
        ColonizeParams c = colonize_params_default();
        c.seed = random_key(g->recipe->seed, STREAM_CORAL_BRANCHLETS);
        c.room = g->recipe->room;
        c.first_step = first_step;
        c.step = 0.011f * unit;
        c.kill = 0.0125f * unit;
        c.influence = 0.045f * unit;
        c.tropism = vec3(0, 0.7f, 0);
        c.noise = 0.07f;
        c.max_children = 2;
        done = colonize_points(g, points, &c, e);
    }
    points_free(points);
    return done;
}

// Fuses tips with the branches ahead of them. A loop is at least as long around as a round mesh
// that is `fuse` wide.
static bool fuse_tips(Growing *g, int32_t *last_step, Error *e)
{
    float reach = g->params->fuse;
    if (reach <= 0.0f) {
        return true;
    }
    JoinParams join = {.reach = reach,
                       .least_path = 2.2f * reach,
                       .least_cosine = -0.2f,
                       .spacing = g->params->bridge};
    bool done = out_tree_join_tips(g->tree, &join, NULL, g->recipe->run, e);
    int32_t last = out_tree_last_birth(g->tree);
    *last_step = last > *last_step ? last : *last_step;
    return done;
}

static bool grow_in_room(Growing *g, const PointSet *points, Error *e)
{
    ColonizeParams c = colonize_params(g, points_spacing(points));
    return colonize_points(g, points, &c, e) && fuse_tips(g, &c.first_step, e) &&
           (g->params->form != CORAL_TABLE || grow_branchlets(g, c.first_step, e));
}

static bool grow_upright(Growing *g, Error *e)
{
    const CoralParams *p = g->params;
    uint64_t seed = random_key(g->recipe->seed, STREAM_CORAL_POINTS);
    bool planted = true;
    for (int i = 0; planted && i < p->colonies; i++) {
        planted = plant_upright(g, i, e);
    }
    if (!planted) {
        return false;
    }
    PointSet *points = NULL;
    if (p->form == CORAL_FAN) {
        points = fan_room(p, seed, e);
    } else {
        Envelope *envelope = room(p, g->recipe->seed, g->recipe->run, e);
        bool seen = envelope && growth_observe(g->recipe, NULL, envelope, NULL, e);
        points = seen ? scatter(envelope, p, SCATTER_VOLUME, p->attractors * p->colonies, seed,
                                g->recipe->run, e)
                      : NULL;
        envelope_free(envelope);
    }
    bool done = points && grow_in_room(g, points, e);
    points_free(points);
    return done;
}

static bool grow_on_rock(Growing *g, Error *e)
{
    const CoralParams *p = g->params;
    Envelope *rock = coral_base(p, g->recipe->seed, g->recipe->run, e);
    bool seen = rock && growth_observe(g->recipe, NULL, rock, NULL, e);
    PointSet *points =
        seen ? scatter(rock, p, SCATTER_SURFACE, p->attractors,
                       random_key(g->recipe->seed, STREAM_CORAL_POINTS), g->recipe->run, e)
             : NULL;
    bool done = points && plant_on_rock(g, points, e) && grow_in_room(g, points, e);
    points_free(points);
    envelope_free(rock);
    return done;
}

static bool prepare_string(Growing *g, Error *e)
{
    const CoralParams *p = g->params;
    LSystemParams params = {.axiom = p->axiom,
                            .rules = p->rules,
                            .generations = p->generations,
                            .seed = random_key(g->recipe->seed, STREAM_CORAL_STRING)};
    ModuleString modules;
    bool done = lsystem_derive(&params, g->recipe->run, &modules, e) &&
                (grow_string_init(&g->string, &modules, p->angle, e) || error_key(e, "axiom"));
    module_string_clear(&modules);
    return done;
}

// Tapers the growing ends: the last stretch of every branch narrows toward its axial corallite.
static bool narrow_tips(OutTree *tree, Error *e)
{
    const float share = 0.72f;
    bool *bears = memory_alloc_zero(tree->count, sizeof *bears, e);
    for (int64_t i = tree->count - 1; bears && i > 0; i--) {
        if (!bears[i]) {
            tree->radius[i] *= share;
        }
        if (tree->parent[i] >= 0) {
            bears[tree->parent[i]] = true;
        }
    }
    bool done = bears;
    free(bears);
    return done;
}

// Thickens every branch over `length` metres from its farthest tip, where it is as thin as its
// axial corallite.
static bool taper_branches(OutTree *tree, float length, Error *e)
{
    const float share = 0.42f;
    float *way = memory_alloc_zero(tree->count, sizeof *way, e);
    for (int64_t i = tree->count - 1; way && i >= 0; i--) {
        float t = fminf(way[i] / length, 1.0f);
        tree->radius[i] *= share + (1.0f - share) * t * (2.0f - t);
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            float longer = way[i] + vec3_distance(tree->position[i], tree->position[parent]);
            way[parent] = longer > way[parent] ? longer : way[parent];
        }
    }
    bool done = way;
    free(way);
    return done;
}

bool coral_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e)
{
    CoralParams p = coral_params_resolve(params);
    Growing g = {.params = &p, .recipe = recipe, .tree = out_tree_new(e)};
    bool upright = p.form == CORAL_BRANCHING || p.form == CORAL_TABLE || p.form == CORAL_FAN;
    bool done =
        g.tree && prepare_string(&g, e) && (upright ? grow_upright(&g, e) : grow_on_rock(&g, e));
    grow_string_clear(&g.string);
    whole->tree = g.tree;
    return done;
}

bool coral_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                  Error *e)
{
    (void)recipe, (void)whole;
    CoralParams p = coral_params_resolve(params);
    out_tree_pipe_radii(grown->tree, p.exponent, p.tip_radius, 0.0f);
    return p.taper > 0.0f ? taper_branches(grown->tree, p.taper, e) : narrow_tips(grown->tree, e);
}
