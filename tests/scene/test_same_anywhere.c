// An object is the same thing wherever it stands, however it is turned about Y, and at twice or
// half the size: as many nodes, the same measures, every node and vertex where the motion takes it.
#include "testing.h"

#include "base/memory.h"
#include "objects/kinds.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/making.h"
#include "scene/place.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- motions ----

// Quarter turns about Y, then a scale, then a move.
typedef struct Motion {
    const char *name;
    int quarters;
    float scale;
    Vec3 move;
} Motion;

static Vec3 turned(const Motion *m, Vec3 v)
{
    for (int i = 0; i < m->quarters; i++) {
        v = vec3(v.z, v.y, -v.x);
    }
    return v;
}

static Vec3 moved(const Motion *m, Vec3 p)
{
    return vec3_madd(m->move, m->scale, turned(m, p));
}

// An object's text for a motion: @p(x y z) is a place, @v(x y z) a direction, @l(x) a length and
// @a(x) an angle about Y, as they are at rest.
static void put_object(const char *from, const Motion *m, char *to, size_t size)
{
    char *end = to + size;
    while (*from) {
        if (*from != '@') {
            *to++ = *from++;
            continue;
        }
        Vec3 v = {0, 0, 0};
        char what = from[1];
        assert_true(sscanf(from + 3, "%f %f %f", &v.x, &v.y, &v.z) == (strchr("pv", what) ? 3 : 1));
        from = strchr(from, ')') + 1;
        if (what == 'p' || what == 'v') {
            v = what == 'p' ? moved(m, v) : turned(m, v);
            to += snprintf(to, (size_t)(end - to), "[%.9g, %.9g, %.9g]", (double)v.x, (double)v.y,
                           (double)v.z);
        } else {
            float x = what == 'l' ? m->scale * v.x : v.x + 90.0f * (float)m->quarters;
            to += snprintf(to, (size_t)(end - to), "%.9g", (double)x);
        }
        assert_true(to < end);
    }
    *to = 0;
}

// ---- what came of it ----

typedef struct Thing {
    Scene *scene;
    OutTree *tree; // NULL where nothing grows
    MeasureList measures;
    World *world;
} Thing;

// Builds the world of a scene of one object, whose whole growth is kept in *grown if it grows.
static World *build(const Scene *scene, Grown *grown, Error *e)
{
    Run run = run_default();
    BuildStats stats = {0};
    Grown *growths = memory_alloc_zero(scene->object_count, sizeof *growths, e);
    World *world = world_new(e);
    if (!world || !growths || !scene_give_settings(scene, world, e) ||
        !scene_place_objects(world, scene, NULL, growths, true, &run, &stats, e)) {
        world_free(world);
        world = NULL;
    }
    *grown = growths[0];
    free(growths);
    return world;
}

// The out-tree of what has grown, where it stands.
static OutTree *placed_tree(const Scene *scene, Grown *grown, Error *e)
{
    Making m;
    Run run = run_default();
    OutTree *tree = NULL;
    bool done = making_begin(&m, scene, 0, &run, e) &&
                making_grow(&m, (Shared){.growths = grown}, e) &&
                own_space_carry_tree(&m.own, m.grown.tree, e);
    if (done) {
        tree = m.grown.tree;
        m.grown.tree = NULL;
    }
    making_end(&m, done, e);
    return tree;
}

static Thing make(const char *object, const Motion *m)
{
    char text[2048], line[1900];
    Error e = {0};
    Run run = run_default();
    Thing thing = {0};
    Grown grown = {0};
    put_object(object, m, line, sizeof line);
    snprintf(text, sizeof text, "seed: 3\nobjects:\n  - name: a\n    %s\n", line);
    thing.scene = scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    bool made = thing.scene && scene_measure(thing.scene, 0, &run, &thing.measures, &e) &&
                (thing.world = build(thing.scene, &grown, &e));
    if (made && thing.scene->objects[0].kind->grow) {
        made = (thing.tree = placed_tree(thing.scene, &grown, &e));
    }
    grown_clear(&grown);
    if (!made) {
        fail_msg("%s: %s", line, e.message);
    }
    return thing;
}

static void thing_free(Thing *thing)
{
    out_tree_free(thing->tree);
    measures_clear(&thing->measures);
    world_free(thing->world);
    scene_free(thing->scene);
}

// The largest distance of what moved from where the motion takes what rested, and the largest
// extent.
typedef struct Gap {
    float most, extent;
} Gap;

static void add_gap(Gap *gap, const Motion *m, Vec3 rest, Vec3 motion)
{
    gap->most = fmaxf(gap->most, vec3_distance(moved(m, rest), motion) / m->scale);
    gap->extent = fmaxf(gap->extent, vec3_length(rest));
}

static int compare_trees(const OutTree *a, const OutTree *b, const Motion *m, Gap *gap)
{
    if (a->count != b->count) {
        print_error("    %lld nodes, not %lld\n", (long long)b->count, (long long)a->count);
        return 1;
    }
    int wrong = 0;
    for (int64_t i = 0; i < a->count; i++) {
        add_gap(gap, m, a->position[i], b->position[i]);
        wrong += a->parent[i] != b->parent[i] || a->birth[i] != b->birth[i] ||
                 fabsf(b->radius[i] - m->scale * a->radius[i]) > 1e-4f * m->scale * a->radius[i];
    }
    if (wrong > 0) {
        print_error("    %d nodes have another parent, birth or radius\n", wrong);
    }
    return wrong > 0;
}

// What a measure of this unit is multiplied by where lengths are.
static double unit_scale(const char *unit, double scale)
{
    if (strcmp(unit, "m") == 0 || strcmp(unit, "mm") == 0) {
        return scale;
    }
    // of flow at one velocity: a section's, a tube's resistance, a fall of pressure
    if (strcmp(unit, "mm^2") == 0 || strcmp(unit, "ml/min") == 0) {
        return scale * scale;
    }
    if (strcmp(unit, "Pa s/m3") == 0) {
        return 1.0 / (scale * scale * scale);
    }
    return strcmp(unit, "mm/mm^2") == 0 || strcmp(unit, "Pa") == 0 ? 1.0 / scale : 1.0;
}

// Measures of wood of 1 cm and more, at 1.3 m: a larger tree has more of it.
static bool is_of_wood(const char *name)
{
    static const char *const names[] = {
        "diameter",    "height_per_diameter", "crown_width_per_height", "branch_per_height",
        "tips",        "path_fraction",       "straightness",           "stem_share",
        "form_factor", "limb_straightness",   "height_above_ground"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(name, names[i]) == 0) {
            return true;
        }
    }
    return false;
}

static int compare_measures(const MeasureList *a, const MeasureList *b, const Motion *m)
{
    int wrong = 0;
    assert_int_equal(a->count, b->count);
    for (int64_t i = 0; i < a->count; i++) {
        const Measure *rest = &a->item[i], *motion = &b->item[i];
        if (m->quarters % 2 == 1 &&
            (strcmp(rest->name, "width") == 0 || strcmp(rest->name, "depth") == 0)) {
            continue; // of a box along the scene's axes
        }
        if (m->scale != 1.0f && is_of_wood(rest->name)) {
            continue;
        }
        double wanted = rest->value * unit_scale(rest->unit, (double)m->scale);
        double off = fabs(motion->value - wanted);
        if (isnan(wanted) != isnan(motion->value) || off > 1e-3 * fabs(wanted) + 1e-4) {
            print_error("    %s is %g, not %g %s\n", rest->name, motion->value, wanted, rest->unit);
            wrong = 1;
        }
    }
    return wrong;
}

static bool same_size(const Part *a, const Part *b)
{
    return a->instance_count == b->instance_count && !a->mesh == !b->mesh &&
           (!a->mesh || (a->mesh->vertex_count == b->mesh->vertex_count &&
                         a->mesh->face_count == b->mesh->face_count)) &&
           (!a->curves || a->curves->point_count == b->curves->point_count);
}

// Every vertex and point, or of instances every one's first.
static int compare_parts(const Geometry *a, const Geometry *b, const Motion *m, Gap *gap)
{
    if (a->count != b->count) {
        print_error("    %lld parts, not %lld\n", (long long)b->count, (long long)a->count);
        return 1;
    }
    for (int64_t i = 0; i < a->count; i++) {
        const Part *rest = &a->part[i], *motion = &b->part[i];
        if (!same_size(rest, motion)) {
            print_error("    part %lld has another number of vertices, points or instances\n",
                        (long long)i);
            return 1;
        }
        const Vec3 *p = rest->mesh ? rest->mesh->position : rest->curves->position;
        const Vec3 *q = motion->mesh ? motion->mesh->position : motion->curves->position;
        int64_t count = rest->mesh ? rest->mesh->vertex_count : rest->curves->point_count;
        for (int64_t k = 0; k < rest->instance_count; k++) {
            add_gap(gap, m, transform_point(&rest->instance[k], p[0]),
                    transform_point(&motion->instance[k], q[0]));
        }
        for (int64_t k = 0; rest->instance_count == 0 && k < count; k++) {
            add_gap(gap, m, p[k], q[k]);
        }
    }
    return 0;
}

// ---- the objects ----

enum { MOVE = 1, TURN = 2, SCALE = 4, ALL = MOVE | TURN | SCALE, OWN_TREE = 8 };

// motions: those that the kind's keys can tell. OWN_TREE: the out-tree stays in the object's own
// space, only its geometry is placed.
static const struct {
    const char *object;
    unsigned motions;
} OBJECTS[] = {
    {"tree: {position: @p(0 0 0), height: @l(8), trunk: {radius: @l(0.2)}, roots: {count: 3}, "
     "crown: {lobes: 2, voxel: @l(0.25), growth: {levels: [{attractors: 60}, {attractors: 500}]}}, "
     "radii: {tip: @l(0.004)}, "
     "leaves: {max_count: 300, spacing: @l(0.05), twig_radius: @l(0.02), length: @l(0.1), "
     "width: @l(0.06), petiole: @l(0.01)}, skin: {curve_radius: @l(0.02), levels: 0}}",
     MOVE | SCALE},
    {"tree: {position: @p(0 0 0), height: @l(8), trunk: {radius: @l(0.2)}, crown: {envelope: "
     "[{shape: sphere, size: @l(3), position: @p(0 5 0)}, {shape: box, size: @l(2), position: "
     "@p(1 6 0)}], voxel: @l(0.125), fields: [{kind: vortex}, {kind: curl, scale: @l(3)}, {kind: "
     "radial, center: @p(1 4 0)}, {kind: nuclei, spherical: true, turn: 40}], growth: {levels: "
     "[{attractors: 500}]}}, radii: {tip: @l(0.004)}, leaves: {max_count: 0}, "
     "skin: {curve_radius: @l(0.02), levels: 0}}",
     MOVE | SCALE},
    {"tree: {position: @p(0 0 0), height: @l(8), trunk: {radius: @l(0.2), stems: 3, fields: "
     "[{kind: nuclei, turn: 90, rim: @l(2), nuclei: [{kind: line, position: @p(0 -1 0), end: "
     "@p(0 4 0)}]}]}, crown: {lobes: 0, growth: {levels: [{attractors: 300}]}, fields: [{kind: "
     "nuclei, turn: 60, profile: grown, nuclei: [{kind: point, position: @p(1 4 0), normal: [0, 2, "
     "0]}, {kind: surface, envelope: [{shape: box, size: @l(0.5), position: @p(0 5 0)}]}]}]}, "
     "radii: {tip: @l(0.004)}, leaves: {max_count: 0}, skin: {curve_radius: @l(0.02), levels: 0}}",
     MOVE | SCALE},
    {"sculpture: {envelope: [{shape: sphere, size: @l(1), position: @p(0 0 0), rotation: [0, "
     "@a(0), 0]}], clusters: 1, thickness: 0.9, attractors: 100, fields: [{kind: nuclei, turn: "
     "120, spherical: "
     "true, surface: true}]}",
     ALL},
    {"sculpture: {envelope: [{shape: ellipsoid, size: [@l(1), @l(0.5), @l(0.7)], position: "
     "@p(0.25 0.125 0), rotation: [0, @a(0), 0]}, {shape: box, size: @l(0.4), position: "
     "@p(0.75 0.25 0), rotation: [0, @a(20), 0]}], voxel: @l(0.03), clusters: 4, thickness: 0.9, "
     "attractors: 100, "
     "fields: [{kind: curl, scale: @l(0.5)}, {kind: radial}, {kind: uniform, vector: "
     "@v(0.3 0.1 0)}, {kind: grid, turn: 90}]}",
     ALL},
    {"lightning: {position: @p(0 0 0), height: @l(10), bolts: 2, streamers: 2, "
     "fields: [{kind: vortex}, {kind: curl, scale: @l(3)}]}",
     MOVE | SCALE},
    {"lightning: {points: {place: surface}, bolts: 3, lean: 30, lean_azimuth: @a(40), branching: "
     "0.2, segment: @l(0.03), step: @l(0.1), envelope: [{shape: box, size: @l(1), position: @p(0 0 "
     "0), rotation: [0, @a(0), 0]}, "
     "{shape: sphere, size: @l(1), position: @p(1 0 0)}]}",
     ALL},
    {"vessels: {terminals: 200, inlet: @p(0.1 0.1 0), skin_levels: 0, curve_radius: @l(0.005), "
     "envelope: [{shape: ellipsoid, size: [@l(0.2), @l(0.1), @l(0.15)], position: @p(0.1 0 0), "
     "rotation: [0, @a(0), 0]}]}",
     ALL},
    {"vessels: {terminals: 100, great: [{from: @p(0.1 -0.2 0), to: @p(0.1 0 0)}, {from: @p(0.1 "
     "-0.05 "
     "0), to: @p(0.25 0 0), by: @p(0.2 0.03 0)}, {vein: true, from: @p(0.1 -0.2 0.05), to: @p(0.1 "
     "0 "
     "0.05)}], envelope: [{shape: ellipsoid, size: [@l(0.2), @l(0.1), @l(0.15)], position: @p(0.1 "
     "0 "
     "0), rotation: [0, @a(0), 0]}]}",
     ALL},
    {"shape: {envelope: [{shape: box, size: [@l(0.1), @l(0.2), @l(0.05)], position: @p(0 0 0)}], "
     "hoar: {length: @l(0.02), thickest: @l(0.01), sky: 0.5}}",
     MOVE | SCALE},
    {"fracture: {attractors: 40, resolution: 32, envelope: [{shape: sphere, size: @l(1), "
     "position: @p(0 0 0), rotation: [0, @a(0), 0]}]}",
     ALL},
    {"coral: {attractors: 100, colonies: 2, position: @p(0 0 0), size: @l(0.6), levels: 0, "
     "polyps: {max_count: 200}}",
     MOVE | SCALE},
    {"coral: {attractors: 100, position: @p(0 0 0), size: @l(0.6), taper: @l(0.1), levels: 0, "
     "polyps: {max_count: 200, shape: nose, fill: 0.5, tentacles: 0.5}}",
     MOVE | SCALE},
    {"coral: {form: table, attractors: 60, position: @p(0 0 0), size: @l(0.6), levels: 0, "
     "polyps: {max_count: 200}}",
     MOVE | SCALE},
    {"coral: {form: fan, attractors: 100, position: @p(0 0 0), size: @l(0.6), levels: 0, "
     "polyps: {max_count: 200}}",
     MOVE | SCALE},
    {"coral: {form: encrusting, attractors: 100, position: @p(0 0 0), size: @l(0.6), polyps: "
     "{max_count: 50}, base: [{shape: ellipsoid, size: [@l(0.3), @l(0.2), @l(0.3)], position: "
     "@p(0 0 0)}, {shape: sphere, size: @l(0.1), position: @p(0.25 0.125 0)}]}",
     MOVE | SCALE},
    {"lsystem: {generations: 4, position: @p(0 0 0), height: @l(6), radii: {tip: @l(0.004)}, "
     "radius: @l(0.1), leaves: {max_count: 0}, skin: {curve_radius: @l(0.02), levels: 0}}",
     MOVE | SCALE},
    {"frost: {surface: pane, spines: 60, sides: 900, grains: 200, position: @p(0 0 0), width: "
     "@l(0.6), height: @l(0.45), nucleus: [{position: @p(0.1 0.1 0)}, {position: @p(-0.2 0 0)}]}",
     MOVE | SCALE},
    {"frost: {surface: bubble, spines: 60, sides: 900, grains: 200, position: @p(0 0 0), radius: "
     "@l(0.03)}",
     MOVE | SCALE},
    {"frost: {habit: ferns, spines: 20, sides: 3000, grains: 200, position: @p(0 0 0), width: "
     "@l(0.6), height: @l(0.45), nucleus: [{position: @p(0.1 0.1 0)}, {position: @p(-0.2 0 0)}]}",
     MOVE | SCALE},
    {"dla: {particles: 200, position: @p(0 0 0), rotation: [0, @a(0), 0], size: @l(1)}", ALL},
    {"venation: {position: @p(0 0 0), rotation: [0, @a(0), 0], length: @l(0.1), petiole: @l(0.02), "
     "detail: 12}",
     ALL | OWN_TREE},
    {"skeleton: {file: scenes/neuron.swc, scale: @l(0.001), position: @p(0 0 0), rotation: [0, "
     "@a(0), 0], axon: false, skin: {levels: 0, curve_radius: @l(0.01)}}",
     ALL},
    {"shape: {envelope: [{shape: capsule, size: [@l(0.3), @l(1), 0], position: @p(0 0 0), "
     "rotation: "
     "[0, @a(0), 0]}, {shape: box, size: @l(0.5), position: @p(0.25 0 0), rotation: [0, @a(10), "
     "0]}], voxel: @l(0.05)}",
     ALL},
    {"mesh: {file: tests/cross/sheet.obj, position: @p(0 0 0), rotation: [0, @a(0), 0], scale: "
     "@l(1)}",
     ALL},
    {"outtree: {envelope: [{shape: sphere, size: @l(1), position: @p(0 0 0), rotation: [0, @a(0), "
     "0]}], starts: {count: 2, direction: @v(0.3 -1 0.2)}, fields: [{kind: nuclei, turn: 60}], "
     "growth: {levels: [{attractors: 300}]}, leaves: {max_count: 40, spacing: @l(0.05), "
     "twig_radius: @l(0.05), length: @l(0.1), width: @l(0.06), petiole: @l(0.01)}, "
     "skin: {levels: 0, curve_radius: @l(0.02)}}",
     ALL},
    {"outtree: {envelope: [{shape: ellipsoid, size: [@l(1), @l(0.5), @l(0.7)], position: @p(0.25 "
     "0.125 0), rotation: [0, @a(0), 0]}], points: {place: surface}, lift: @l(0.01), placed: "
     "{points: [{position: @p(1 0 0)}, {position: @p(0 1 0), group: 1}, {position: @p(0 1 0.25), "
     "group: 1}, {position: @p(0 0.5 1), group: 1, normal: @v(0 0.2 1)}]}, growth: {levels: "
     "[{attractors: 100}]}, further: [{growth: {rule: sectors, levels: [{attractors: 300}]}, "
     "fields: [{kind: uniform, vector: @v(1 0 0)}]}], radii: {model: birth}, skin: {levels: 0}}",
     MOVE | SCALE},
    {"outtree: {placed: {points: [{position: @p(0 0 0)}, {position: @p(0.5 0 0), normal: @v(0 0 "
     "1)}, {position: @p(0.25 0.5 0.25), group: 1}, {position: @p(0.25 1 0), group: 1}]}, "
     "skin: {levels: 0}}",
     MOVE | SCALE},
    {"forest: {stands: 2, stand_trees: 2, height: @l(8), radius: @l(60), center: @p(0 0 0), "
     "glade_center: @p(3 0 0), glade: @l(5), ferns: 20, fern_radius: @l(8), fern_height: @l(1), "
     "leaves: {max_count: 0}, radii: {tip: @l(0.01)}, skin: {curve_radius: @l(0.1), levels: 0}, "
     "fields: [{kind: vortex}], growth: {levels: [{attractors: 300}]}}",
     MOVE | OWN_TREE},
    {"forest: {stands: 2, stand_trees: 2, height: @l(8), radius: @l(60), clumping: 0, glade: 0, "
     "ferns: 0, leaves: {max_count: 0}, radii: {tip: @l(0.01)}, skin: {curve_radius: @l(0.1), "
     "levels: 0}, growth: {levels: [{attractors: 300}]}}",
     SCALE},
    // Grows in the scene's space, because the wall is there: no motion gives the same bits.
    {"climber: {climbs: wall, starts: [{position: [0, 0, 0.2]}], height: 1, spread: 0.5, spacing: "
     "0.15, leaves: {max_count: 100}}\n  - name: wall\n    shape: {voxel: 0.05, envelope: [{shape: "
     "box, size: [1, 1, 0.2], position: [0, 1, 0]}]}",
     0},
    {"terrain: {resolution: 64, size: @l(30000), rivers: {count: 200}}", SCALE},
    {"stone: {position: @p(1 0 0.5), rotation: [0, @a(20), 0], size: @l(0.5), resolution: 8}", ALL},
    {"snow_crystal: {position: @p(1 0 0.5), rotation: [0, @a(20), 0], size: @l(0.5), thickness: "
     "@l(0.01), cells: 30}",
     ALL},
    {"snow_crystal: {position: @p(1 0 0.5), rotation: [0, @a(20), 0], size: @l(0.5), thickness: "
     "@l(0.01), cells: 20, life: [{at: 0.4, temperature: -6, supersaturation: 0.1}, {at: 0.5, "
     "temperature: -15, supersaturation: 0.1}]}",
     ALL},
    {"frost_flower: {position: @p(1 0 0.5), rotation: [0, @a(20), 0], size: @l(0.5), feathers: 8, "
     "barbs: 8}",
     ALL},
    {"ice_cracks: {position: @p(1 0 0.5), rotation: [0, @a(20), 0], size: @l(2), spacing: @l(0.5), "
     "depth: @l(0.2), grain: @l(0.03)}",
     ALL},
    {"sea: {spokes: 32, extent: 30}", 0},                            // waves lie in the scene
    {"scatter: {count: 20, things: [{stone: {resolution: 4}}]}", 0}, // patches lie in the scene
    {"eruption: {on: cone, bombs: 4, streams: [{at: [300, 0], length: 100}]}\n  - name: cone\n"
     "    terrain: {form: volcano, size: 9000, relief: 900, resolution: 64}",
     0}, // it lies on its terrain
    {"cascade: {over: rock, from: [-0.2, 1.5, 0.2], to: [0.2, 1.5, 0.2]}\n  - name: rock\n"
     "    shape: {envelope: [{shape: sphere}]}",
     0}, // it runs over its rock
    {"swarm: {count: 20, envelope: [{shape: sphere}], things: [{stone: {resolution: 4}}]}",
     0}, // its envelope and headings lie in the scene
    {"row: {points: [{at: [0, 0, 0]}, {at: [3, 0, 1]}], things: [{stone: {resolution: 4}}]}",
     0},               // its line lies in the scene
    {"ground: {}", 0}, // it stands about the origin, and its bumps are as large as nature's
};

enum { OBJECT_COUNT = (int)(sizeof OBJECTS / sizeof OBJECTS[0]) };

static const Motion AT_REST = {.name = "at rest", .scale = 1.0f};
static const struct {
    Motion motion;
    unsigned bit;
} MOTIONS[] = {{{"moved by 5 m", 0, 1.0f, {3, 0, -4}}, MOVE},
               {{"turned by 90 degrees", 1, 1.0f, {0, 0, 0}}, TURN},
               {{"twice as large", 0, 2.0f, {0, 0, 0}}, SCALE},
               {{"half as large", 0, 0.5f, {0, 0, 0}}, SCALE},
               {{"all of it", 3, 2.0f, {-2, 0, 7}}, ALL}};

// A float at 10 m has steps of 1e-6 m.
#define ROUNDING 2e-5f

static int compare(const char *object, const Thing *rest, const Motion *m, bool own_tree)
{
    Thing thing = make(object, m);
    Gap gap = {0};
    const Motion in_place = {.scale = m->scale};
    int wrong = rest->tree && compare_trees(rest->tree, thing.tree, own_tree ? &in_place : m, &gap);
    wrong |= compare_parts(&rest->world->geometry, &thing.world->geometry, m, &gap);
    wrong |= compare_measures(&rest->measures, &thing.measures, m);
    if (gap.most > ROUNDING * gap.extent + ROUNDING * vec3_length(m->move) / m->scale) {
        print_error("    off by %g m of %g m\n", (double)gap.most, (double)gap.extent);
        wrong = 1;
    }
    if (wrong) {
        print_error("%s:\n    %s\n", m->name, object);
    }
    thing_free(&thing);
    return wrong;
}

static void every_object_is_the_same_anywhere(void **state)
{
    (void)state;
    int wrong = 0;
    for (int i = 0; i < OBJECT_COUNT; i++) {
        if (OBJECTS[i].motions == 0) {
            continue;
        }
        Thing rest = make(OBJECTS[i].object, &AT_REST);
        for (size_t k = 0; k < sizeof MOTIONS / sizeof MOTIONS[0]; k++) {
            if ((OBJECTS[i].motions & MOTIONS[k].bit) == MOTIONS[k].bit) {
                wrong += compare(OBJECTS[i].object, &rest, &MOTIONS[k].motion,
                                 OBJECTS[i].motions & OWN_TREE);
            }
        }
        thing_free(&rest);
    }
    assert_int_equal(wrong, 0);
}

static void every_kind_is_looked_at(void **state)
{
    (void)state;
    const Kind *kind;
    for (int i = 0; (kind = kind_at(i)); i++) {
        bool found = false;
        size_t length = strlen(kind_name(kind));
        for (int k = 0; k < OBJECT_COUNT && !found; k++) {
            found = strncmp(OBJECTS[k].object, kind_name(kind), length) == 0 &&
                    OBJECTS[k].object[length] == ':';
        }
        if (!found) {
            fail_msg("no object of the kind %s", kind_name(kind));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_object_is_the_same_anywhere),
        cmocka_unit_test(every_kind_is_looked_at),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
