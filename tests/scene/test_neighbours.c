// Objects that share a world: obstacles, contests for space, and what is refused.
#include "outtree/segment_grid.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/builder.h"
#include "scene/export_grids.h"
#include "scene/surfaces.h"
#include "shape/mesh_nearest.h"

#include "scene_fixture.h"

#define TREE(NAME, X, MORE)                                                              \
    "  - name: " NAME "\n"                                                               \
    "    tree: {position: [" X ", 0, 0], height: 6, roots: {count: 0}, crown: {growth: " \
    "{levels: [{attractors: 150}, {attractors: 700}]}}, leaves: {max_count: 0}, skin: "  \
    "{levels: 0}}\n" MORE
#define ROCK                                                                                 \
    "  - name: rock\n    shape: {envelope: [{shape: sphere, scale: 1.2, position: [0, 3.5, " \
    "0]}]}\n"
#define CONTEST(GAP) "    contest: {group: grove, gap: " GAP "}\n"
#define CLEAR "    clear_of: [{object: rock, distance: 0.1}]\n"

static void assert_same(const OutTree *a, const OutTree *b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->position, b->position, (size_t)a->count * sizeof *a->position);
    assert_memory_equal(a->parent, b->parent, (size_t)a->count * sizeof *a->parent);
}

static float least_to(const OutTree *tree, Vec3 p)
{
    float least = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        least = fminf(least, vec3_distance(tree->position[i], p));
    }
    return least;
}

// Least distance between the axes of two trees, by brute force.
static float least_between(const OutTree *a, const OutTree *b)
{
    float least = INFINITY;
    for (int64_t i = 0; i < a->count; i++) {
        for (int64_t k = 0; a->parent[i] >= 0 && k < b->count; k++) {
            if (b->parent[k] >= 0) {
                least = fminf(least, segment_distance(a->position[a->parent[i]], a->position[i],
                                                      b->position[b->parent[k]], b->position[k]));
            }
        }
    }
    return least;
}

static void test_obstacle_is_kept_clear(void **state)
{
    Scene *free_scene = fixture_read(*state, "objects:\n" ROCK TREE("oak", "0.9", ""));
    Scene *scene = fixture_read(*state, "objects:\n" TREE("oak", "0.9", CLEAR) ROCK);
    OutTree *alone = fixture_grow(free_scene, "oak", 2), *tree = fixture_grow(scene, "oak", 2);
    Vec3 rock = vec3(0, 3.5f, 0);
    assert_true(least_to(alone, rock) < 1.0f); // it would grow through the rock
    // a level's nodes move toward their parents when it is done: a chord instead of an arc
    assert_true(least_to(tree, rock) > 1.3f - 0.05f);
    assert_true(tree->count > alone->count / 3); // and still be a tree, beyond the rock too
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < tree->count; i++) {
        box = aabb_add(box, tree->position[i]);
    }
    assert_true(box.low.x < -0.2f && box.high.y > 5.0f);
    out_tree_free(alone);
    out_tree_free(tree);
    scene_free(free_scene);
    scene_free(scene);
}

// A pane of frost around a boss, and vessels around a cyst: both would grow through it.
static void test_frost_and_vessels_keep_clear(void **state)
{
    static const struct {
        const char *object, *obstacle, *clear;
        Vec3 center;
        float radius, distance, tolerance;
    } one[] = {
        {"  - name: a\n    frost: {width: 0.5, height: 0.4, nuclei: 5, spines: 60, sides: 3000}\n",
         "  - {name: rock, shape: {envelope: [{shape: sphere, scale: 0.08, position: [0.1, 0, "
         "0]}]}}\n",
         "    clear_of: [{object: rock, distance: 0.01}]\n",
         {0.1f, 0.0f, 0.0f},
         0.08f,
         0.01f,
         0.001f},
        {"  - name: a\n    vessels: {terminals: 300, envelope: [{shape: ellipsoid, size: [0.04, "
         "0.05, 0.04]}]}\n",
         "  - {name: rock, shape: {envelope: [{shape: sphere, scale: 0.012, position: [0, 0.02, "
         "0]}]}}\n",
         "    clear_of: [{object: rock, distance: 0.002}]\n",
         {0.0f, 0.02f, 0.0f},
         0.012f,
         0.002f,
         1e-6f},
    };
    for (size_t i = 0; i < sizeof one / sizeof one[0]; i++) {
        char text[2][1024];
        snprintf(text[0], sizeof text[0], "objects:\n%s%s", one[i].object, one[i].obstacle);
        snprintf(text[1], sizeof text[1], "objects:\n%s%s%s", one[i].object, one[i].clear,
                 one[i].obstacle);
        Scene *free_scene = fixture_read(*state, text[0]), *scene = fixture_read(*state, text[1]);
        OutTree *alone = fixture_grow(free_scene, "a", 2), *tree = fixture_grow(scene, "a", 1);
        OutTree *again = fixture_grow(scene, "a", 2);
        assert_same(tree, again);
        assert_true(least_to(alone, one[i].center) < 0.8f * one[i].radius);
        float kept = least_to(tree, one[i].center);
        assert_true(kept > one[i].radius + one[i].distance - one[i].tolerance);
        assert_true(tree->count > alone->count / 2);
        out_tree_free(alone);
        out_tree_free(tree);
        out_tree_free(again);
        scene_free(free_scene);
        scene_free(scene);
    }
}

#define FROST(NAME, MORE) \
    "  - name: " NAME     \
    "\n    frost: {width: 0.4, height: 0.3, nuclei: 2, spines: 20, sides: 800}\n" MORE

// Crystals of two objects on one pane do not grow through each other.
static void test_frost_contends(void **state)
{
    const char *text[2] = {"objects:\n" FROST("a", "") FROST("b", ""),
                           "objects:\n" FROST("a", "    contest: {group: pane, gap: 0.004}\n")
                               FROST("b", "    contest: {group: pane, gap: 0.004}\n")};
    for (int i = 0; i < 2; i++) {
        Scene *scene = fixture_read(*state, text[i]);
        OutTree *a = fixture_grow(scene, "a", 2), *b = fixture_grow(scene, "b", 1);
        float least = least_between(a, b);
        assert_true(i == 0 ? least < 1e-4f : least > 0.002f);
        assert_true(a->count > 100 && b->count > 100);
        out_tree_free(a);
        out_tree_free(b);
        scene_free(scene);
    }
}

static void test_growth_stays_within(void **state)
{
    const char *text = "objects:\n" ROCK TREE(
        "ivy", "0.2", "    clear_of: [{object: rock, distance: 0.02, within: 0.3}]\n");
    Scene *scene = fixture_read(*state, text);
    OutTree *tree = fixture_grow(scene, "ivy", 1);
    int64_t near = 0, tips = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->birth[i] > 0 && tree->position[i].y > 3.0f) {
            float height = vec3_distance(tree->position[i], vec3(0, 3.5f, 0)) - 1.2f;
            tips++;
            near += height < 0.35f;
        }
    }
    assert_true(tips > 50 && near == tips);
    out_tree_free(tree);
    scene_free(scene);
}

// A terrain is named as any other object: growth creeps over it, out of the hill that it starts in.
static void test_growth_creeps_over_a_terrain(void **state)
{
    Scene *scene = fixture_read(
        *state,
        "objects:\n"
        "  - {name: land, terrain: {size: 12, relief: 2.5, resolution: 64, rivers: {count: 100}}}\n"
        "  - name: lichen\n"
        "    outtree:\n"
        "      envelope: [{shape: box, size: [1.5, 1.4, 1.5], position: [0, 1.4, 0]}]\n"
        "      placed: {points: [{position: [0, 2, 0]}]}\n"
        "      growth: {levels: [{attractors: 20000, influence: 3}]}\n"
        "    clear_of: [{object: land, distance: 0.02, within: 0.2}]\n");
    Run run = run_default();
    OutTree *rivers = fixture_grow(scene, "land", 2), *tree = fixture_grow(scene, "lichen", 2);
    HeightField *land = scene_heights(scene, 0, rivers, &run, NULL);
    int64_t over = 0, near = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        float height = p.y - height_field_at(land, p.x, p.z);
        over += height > 0.0f;
        near += height > 0.0f && height < 0.45f; // measured upward, on slopes
    }
    assert_true(tree->count > 300 && 50 * over > 49 * tree->count && 50 * near > 49 * tree->count);
    height_field_free(land);
    out_tree_free(rivers);
    out_tree_free(tree);
    scene_free(scene);
}

#define LAND(RELIEF)                                       \
    "  - {name: land, terrain: {size: 12, relief: " RELIEF \
    ", resolution: 64, rivers: {count: 100}}}\n"
#define CREEPER(NAME, OVER, MORE)                                                                  \
    "  - name: " NAME "\n    outtree:\n      envelope: [{shape: object, object: " OVER "}]\n"      \
    "      points: {place: surface}\n      growth: {levels: [{attractors: 3000, influence: 3}]}\n" \
    "      starts: {count: 5}\n" MORE

static float distance_to(const World *world, int object, Vec3 p)
{
    float least = INFINITY;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        Vec3 nearest = p, normal;
        const Part *part = &world->geometry.part[i];
        if (part->object == object && part->mesh && mesh_nearest(part->mesh, &nearest, &normal)) {
            least = fminf(least, vec3_distance(p, nearest));
        }
    }
    return least;
}

// An envelope that names another object is its surface, whether a sheet or a body: every node lies
// on it, nodes are all over it, and the result does not depend on threads.
static void test_growth_over_an_object(void **state)
{
    Scene *scene = fixture_read(*state, "objects:\n" CREEPER("frost", "land", "") LAND("2.5")
                                            ROCK CREEPER("moss", "rock", ""));
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, NULL);
    OutTree *frost = fixture_grow(scene, "frost", 1), *moss = fixture_grow(scene, "moss", 2);
    assert_non_null(world);
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < frost->count; i++) {
        assert_true(distance_to(world, 1, frost->position[i]) < 1e-4f);
        assert_true(frost->normal[i].y > 0.0f);
        box = aabb_add(box, frost->position[i]);
    }
    assert_true(frost->count > 2000 && box.low.x < -5.7f && box.high.z > 5.7f);
    box = aabb_empty();
    for (int64_t i = 0; i < moss->count; i++) {
        Vec3 p = vec3_sub(moss->position[i], vec3(0, 3.5f, 0));
        assert_true(fabsf(vec3_length(p) - 1.2f) < 0.005f); // facets
        box = aabb_add(box, p);
    }
    assert_true(moss->count > 2000 && box.low.y < -1.1f && box.high.y > 1.1f);
    OutTree *again = fixture_grow(scene, "frost", 3);
    assert_same(frost, again);
    world_free(world);
    out_tree_free(frost);
    out_tree_free(again);
    out_tree_free(moss);
    scene_free(scene);
}

// What is grown over is built first, and a builder regrows what grows over a changed object.
static void test_surface_is_placed_first(void **state)
{
    Scene *scene = fixture_read(*state, "objects:\n" CREEPER("moss", "frost", "")
                                            CREEPER("frost", "land", "") LAND("2.5"));
    int order[3], wanted[3] = {2, 1, 0};
    assert_true(surfaces_order(scene, order, NULL));
    assert_memory_equal(order, wanted, sizeof order);
    scene_free(scene);
    scene = fixture_read(*state, "objects:\n" CREEPER("frost", "land", "") LAND("2.5"));
    Scene *higher = fixture_read(*state, "objects:\n" CREEPER("frost", "land", "") LAND("4"));
    const Scene *const scenes[2] = {scene, higher};
    Run run = run_default();
    SceneBuilder *builder = scene_builder_new(true, NULL);
    for (int i = 0; i < 2; i++) {
        BuildStats stats = {0}, fresh;
        assert_false(scene_builder_fits(builder, scenes[i]));
        assert_non_null(scene_builder_build(builder, scenes[i], &run, &stats, NULL));
        World *anew = scene_build(scenes[i], &run, &fresh, NULL);
        assert_non_null(anew);
        assert_int_equal(stats.nodes, fresh.nodes);
        assert_int_equal(stats.geometry.triangles, fresh.geometry.triangles);
        world_free(anew);
    }
    scene_builder_free(builder);
    scene_free(scene);
    scene_free(higher);
}

// The surface of an object is no region of space, which grids are written of.
static void test_surface_is_no_grid(void **state)
{
    Scene *scene = fixture_read(*state, "objects:\n" ROCK CREEPER("moss", "rock", ""));
    Run run = run_default();
    Error e = {0};
    assert_null(scene_grids(scene, &run, &e));
    assert_non_null(strstr(e.message, "grows in an envelope"));
    scene_free(scene);
}

// Each object's grids are its own: trunk, crown and their fields, not those of its rivals.
static void test_rivals_have_grids_of_their_own(void **state)
{
    Scene *alone = fixture_read(*state, "objects:\n" TREE("a", "-0.7", ""));
    Scene *pair = fixture_read(*state, "objects:\n" TREE("a", "-0.7", CONTEST("0.15"))
                                           TREE("b", "0.7", CONTEST("0.15")));
    Run run = run_default();
    GridFile *one = scene_grids(alone, &run, NULL), *two = scene_grids(pair, &run, NULL);
    assert_true(one && two && grid_file_count(one) > 0);
    assert_int_equal(grid_file_count(two), 2 * grid_file_count(one));
    grid_file_free(one);
    grid_file_free(two);
    scene_free(alone);
    scene_free(pair);
}

static void test_object_without_a_surface(void **state)
{
    Scene *scene = fixture_read(
        *state, "objects:\n  - {name: bolt, lightning: {}}\n" CREEPER("moss", "bolt", ""));
    Run run = run_default();
    Error e = {0};
    assert_null(scene_grow_object(scene, 1, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "object 'bolt' has no surface to grow over"));
    assert_int_equal(e.line, 5);
    assert_int_equal(e.column, 42);
    scene_free(scene);
}

static void test_rivals_keep_apart(void **state)
{
    Scene *alone = fixture_read(*state, "objects:\n" TREE("a", "-0.7", "") TREE("b", "0.7", ""));
    Scene *scene = fixture_read(*state, "objects:\n" TREE("a", "-0.7", CONTEST("0.15"))
                                            TREE("b", "0.7", CONTEST("0.15")));
    OutTree *a0 = fixture_grow(alone, "a", 2), *b0 = fixture_grow(alone, "b", 2);
    OutTree *a = fixture_grow(scene, "a", 2), *b = fixture_grow(scene, "b", 2);
    assert_true(least_between(a0, b0) < 0.02f); // they interpenetrate without the contest
    assert_true(least_between(a, b) > 0.12f);   // less than the gap: relaxed levels, see above
    // crowns interlock: neither is pushed back to its own half
    Aabb mine = aabb_empty(), other = aabb_empty();
    for (int64_t i = 0; i < a->count; i++) {
        mine = aabb_add(mine, a->position[i]);
    }
    for (int64_t i = 0; i < b->count; i++) {
        other = aabb_add(other, b->position[i]);
    }
    assert_true(mine.high.x > other.low.x + 0.2f);
    assert_true(a->count + b->count > (a0->count + b0->count) / 2);
    assert_true(a->count < a0->count && b->count < b0->count);
    out_tree_free(a0);
    out_tree_free(b0);
    out_tree_free(a);
    out_tree_free(b);
    scene_free(alone);
    scene_free(scene);
}

#define BATTLE                                                                    \
    "objects:\n" ROCK TREE("a", "-0.7", CONTEST("0.15") CLEAR) TREE("c", "5", "") \
        TREE("b", "0.7", CONTEST("0.1"))

static void test_threads_and_neighbours_do_not_show(void **state)
{
    Scene *scene = fixture_read(*state, BATTLE), *other = fixture_read(*state, BATTLE);
    OutTree *one = fixture_grow(scene, "b", 1), *three = fixture_grow(other, "b", 3);
    assert_same(one, three);
    // an object outside the contest grows as it does alone
    Scene *alone = fixture_read(*state, "objects:\n" TREE("c", "5", ""));
    OutTree *c = fixture_grow(scene, "c", 1), *lone = fixture_grow(alone, "c", 1);
    assert_same(c, lone);
    out_tree_free(one);
    out_tree_free(three);
    out_tree_free(c);
    out_tree_free(lone);
    scene_free(scene);
    scene_free(other);
    scene_free(alone);
}

static int64_t nodes_built(const Scene *scene)
{
    Run run = run_default();
    BuildStats stats;
    Error e = {0};
    World *world = scene_build(scene, &run, &stats, &e);
    if (!world) {
        fail_msg("%s", e.message);
    }
    world_free(world);
    return stats.nodes;
}

// A builder that changes one rival or the obstacle regrows all that depend on it.
static void test_builder_regrows_neighbours(void **state)
{
    Scene *first = fixture_read(*state, BATTLE);
    Error e = {0};
    SceneChange change = {.path = "objects.a.seed", .value = "77", .source = "test"};
    Scene *second = scene_changed(first, &change, 1, &e);
    SceneChange moved = {
        .path = "objects.rock.shape.envelope.0.position", .value = "[0, 4.6, 0]", .source = "test"};
    Scene *third = scene_changed(second, &moved, 1, &e);
    assert_non_null(third);
    const Scene *const scenes[3] = {first, second, third};
    Run run = run_default();
    SceneBuilder *builder = scene_builder_new(true, &e);
    for (int i = 0; i < 3; i++) {
        BuildStats stats = {0};
        assert_true(i == 0 || !scene_builder_fits(builder, scenes[i]));
        World *world = scene_builder_build(builder, scenes[i], &run, &stats, &e);
        assert_non_null(world);
        BuildStats fresh;
        World *anew = scene_build(scenes[i], &run, &fresh, &e);
        assert_int_equal(world->geometry.count, anew->geometry.count);
        assert_int_equal(stats.geometry.triangles, fresh.geometry.triangles);
        world_free(anew);
    }
    assert_int_not_equal(nodes_built(first), nodes_built(second));
    assert_int_not_equal(nodes_built(second), nodes_built(third));
    scene_builder_free(builder);
    scene_free(third);
    scene_free(second);
    scene_free(first);
}

// A surface is made once, from the parts of an object that is placed; only otherwise the object is
// built. The square that stands for the rock's parts here is at height 7, the rock below 4.7.
static void test_surfaces_are_shared(void **state)
{
    Scene *scene = fixture_read(*state, "objects:\n" TREE("oak", "0.9", CLEAR) ROCK);
    Geometry placed = {0};
    Mesh *square = mesh_new(4, 4, 1, 0, NULL);
    for (uint32_t i = 0; i < 4; i++) {
        square->position[i] = vec3(i == 1 || i == 2 ? 1.0f : -1.0f, 7.0f, i < 2 ? 1.0f : -1.0f);
        square->index[i] = i;
    }
    assert_true(geometry_add(&placed, (Part){.mesh = square, .object = 1}, NULL));
    Run run = run_default();
    for (int i = 0; i < 2; i++) {
        Surfaces *surfaces = surfaces_new(scene, i == 0 ? &placed : NULL, NULL);
        float size;
        Vec3 away;
        const Nearest *rock = surfaces_of(surfaces, 1, &size, &run, NULL);
        assert_non_null(rock);
        assert_ptr_equal(rock, surfaces_of(surfaces, 1, &size, &run, NULL));
        float distance = nearest_distance(rock, vec3(0, 8, 0), 9.0f, &away);
        assert_true(fabsf(distance - (i == 0 ? 1.0f : 3.3f)) < 0.01f);
        assert_true(fabsf(size - (i == 0 ? sqrtf(8.0f) : 2.4f * sqrtf(3.0f))) < 0.02f);
        surfaces_free(surfaces);
    }
    geometry_clear(&placed);
    scene_free(scene);
}

// Obstacles are placed first, and parts are in the order of the scene all the same.
static void test_obstacles_are_placed_first(void **state)
{
    Scene *scene = fixture_read(
        *state, "objects:\n" TREE("a", "-2", CONTEST("0.2")) TREE("b", "2", CONTEST("0.2") CLEAR)
                    TREE("oak", "9", "    clear_of: [{object: a}]\n") ROCK);
    int order[4], wanted[4] = {3, 0, 1, 2};
    assert_true(surfaces_order(scene, order, NULL));
    assert_memory_equal(order, wanted, sizeof order);
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, NULL);
    assert_non_null(world);
    int last = 0, changes = 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        int object = world->geometry.part[i].object;
        assert_true(object == last || object == last + 1);
        changes += object != last;
        last = object;
    }
    assert_int_equal(changes, 3);
    world_free(world);
    scene_free(scene);
}

static void test_failure_and_cancel_end_all(void **state)
{
    Scene *scene = fixture_read(
        *state, "objects:\n" TREE("a", "-0.7",
                                  CONTEST("0.15")) "  - name: b\n"
                                                   "    coral: {axiom: 'F('}\n" CONTEST("0.15"));
    Run run = run_default();
    Error e = {0};
    assert_null(scene_grow_object(scene, 0, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "object 'b'")); // whose fault it is
    assert_int_equal(e.line, 6);
    volatile int cancelled = 1;
    run.cancelled = &cancelled;
    Scene *fine = fixture_read(*state, BATTLE);
    e = (Error){0};
    assert_null(scene_grow_object(fine, 1, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    scene_free(fine);
    scene_free(scene);
}

static void test_refusals(void **state)
{
    fixture_refuse(*state,
                   "objects:\n  - name: a\n    tree: {}\n    clear_of: [{object: rack}]\n" ROCK,
                   "there is no object 'rack'; did you mean 'rock'", 4);
    fixture_refuse(*state, "objects:\n  - name: a\n    tree: {}\n    clear_of: [{object: a}]\n",
                   "leads back to 'a' itself", 4);
    fixture_refuse(*state,
                   "objects:\n  - name: a\n    tree: {}\n    clear_of: [{object: b}]\n"
                   "  - name: b\n    tree: {}\n    clear_of: [{object: a}]\n",
                   "leads back to 'a' itself", 4);
    fixture_refuse(
        *state,
        "objects:\n  - name: a\n    tree: {}\n    contest: {group: g}\n    clear_of: [{object: "
        "b}]\n  - name: b\n    tree: {}\n    contest: {group: g}\n",
        "leads back to 'a' itself", 5);
    fixture_refuse(*state, "objects:\n" ROCK "    contest: {group: g}\n",
                   "kind shape ignore it; only these take it: tree, coral, frost,", 4);
    fixture_refuse(*state,
                   "objects:\n  - name: v\n    vessels: {envelope: [{shape: sphere}]}\n"
                   "    contest: {group: g}\n",
                   "objects of kind vessels ignore it", 4);
    fixture_refuse(*state,
                   "objects:\n" ROCK
                   "  - name: a\n    lightning: {}\n    clear_of: [{object: rock}]\n",
                   "only these take it: tree, coral, vessels, frost,", 6);
    fixture_refuse(*state,
                   "objects:\n" ROCK
                   "  - name: a\n    tree: {}\n    clear_of:\n      - {object: rock, "
                   "distance: 0.2, within: 0.1}\n",
                   "it must be above distance", 7);
}

#define OVER_ROCK "  - name: a\n    outtree:\n      envelope: [{shape: object, object: rock}]\n"
#define ON_ROCK OVER_ROCK "      points: {place: surface}\n"

static void test_surface_refusals(void **state)
{
    fixture_refuse(
        *state, "objects:\n" ROCK CREEPER("a", "rack", ""),
        "objects.a.outtree.envelope.0.object: there is no object 'rack'; did you mean 'rock'", 6);
    fixture_refuse(*state, "objects:\n" CREEPER("a", "a", ""),
                   "objects.a.outtree.envelope.0.object leads back to 'a' itself", 4);
    fixture_refuse(*state,
                   "objects:\n" ROCK CREEPER("a", "b", "    clear_of: [{object: rock}]\n")
                       CREEPER("b", "a", ""),
                   "objects.a.outtree.envelope.0.object leads back to 'a' itself", 6);
    fixture_refuse(*state, "objects:\n" ROCK OVER_ROCK, "has no inside; it must be surface", 6);
    fixture_refuse(*state, "objects:\n" ROCK ON_ROCK "      show: {band: 0.1}\n",
                   "show.band needs an envelope with an inside", 8);
    fixture_refuse(*state,
                   "objects:\n" ROCK OVER_ROCK "      points: {place: surface, anchored: true}\n",
                   "points.anchored needs an envelope with an inside", 7);
    fixture_refuse(*state,
                   "objects:\n" ROCK "  - name: a\n    outtree:\n      points: {place: surface}\n"
                   "      envelope:\n        - {shape: object, object: rock}\n"
                   "        - {shape: sphere, op: difference}\n",
                   "it must be the only shape", 9);
    fixture_refuse(*state,
                   "objects:\n" ROCK "  - name: a\n    outtree:\n      points: {place: surface}\n"
                   "      envelope:\n        - shape: object\n          object: rock\n"
                   "          position: [0, 1, 0]\n",
                   "position", 10);
    fixture_refuse(*state,
                   "objects:\n" ROCK "  - name: a\n    outtree:\n      points: {place: surface}\n"
                   "      envelope:\n        - {shape: sphere}\n"
                   "        - {shape: object, object: rock}\n",
                   "only an outtree with points: {place: surface} takes it, as its only shape", 9);
    fixture_refuse(*state,
                   "objects:\n" ROCK
                   "  - name: a\n    sculpture: {envelope: [{shape: object, object: rock}]}\n",
                   "only an outtree with points: {place: surface} takes it", 5);
    fixture_refuse(*state,
                   "objects:\n" ROCK
                   "  - name: a\n    coral: {base: [{shape: object, object: rock}]}\n",
                   "base: the surface of an object has no inside; only an outtree", 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_obstacle_is_kept_clear, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_frost_and_vessels_keep_clear, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_frost_contends, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_growth_stays_within, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_growth_creeps_over_a_terrain, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_growth_over_an_object, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_surface_is_placed_first, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_surface_is_no_grid, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_rivals_have_grids_of_their_own, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_object_without_a_surface, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_surface_refusals, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_rivals_keep_apart, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_threads_and_neighbours_do_not_show, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_builder_regrows_neighbours, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_surfaces_are_shared, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_obstacles_are_placed_first, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_failure_and_cancel_end_all, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_refusals, fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
