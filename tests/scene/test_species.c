// Species: what files add to an object, what the scene keeps, and what is refused where.
#include "objects/tree/tree.h"
#include "render/material/material.h"
#include "scene/build.h"
#include "scene/species_file.h"
#include "scene_fixture.h"

#define BIRCH                                                                 \
    "latin: Betula alba\n"                                                    \
    "tree:\n"                                                                 \
    "  height: 10\n"                                                          \
    "  trunk: {height: 5, radius: 0.1}\n"                                     \
    "  crown: {base: 2, envelope: [{shape: ellipsoid, size: [2, 4, 2]}]}\n"   \
    "  roots: {count: 0}\n"                                                   \
    "  leaves: {length: 0.05, max_count: 20}\n"                               \
    "material: bark\n"                                                        \
    "leaf_material: leaf\n"                                                   \
    "materials:\n"                                                            \
    "  - {name: bark, kind: diffuse, color: 0.8}\n"                           \
    "  - {name: leaf, kind: leaf, color: [0.1, 0.2, 0.05], roughness: 0.4}\n" \
    "targets:\n"                                                              \
    "  - {measure: height, low: 8, high: 12}\n"

static void write_file(Fixture *fixture, const char *name, const char *text)
{
    fixture_write(fixture, name, text, strlen(text));
}

static const TreeParams *tree_of(const Scene *scene, int index)
{
    return scene->objects[index].params;
}

static void a_file_gives_keys_materials_and_targets(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    Scene *scene = fixture_read(fixture, "objects:\n"
                                         "  - name: a\n"
                                         "    tree: {species: birch.yaml}\n"
                                         "  - name: b\n"
                                         "    tree: {species: ./birch.yaml, roots: {count: 3}}\n"
                                         "    leaf_material: clay\n"
                                         "targets: [{object: b, measure: height, low: 1}]\n");
    const TreeParams *a = tree_of(scene, 0), *b = tree_of(scene, 1);
    assert_float_equal(a->height, 10.0, 0.0);
    assert_float_equal(a->trunk.radius, 0.1f, 0.0);
    assert_float_equal(a->trunk.lean, tree_params_default().trunk.lean, 0.0); // neither gives it
    assert_int_equal(a->roots.count, 0);
    assert_int_equal(b->roots.count, 3); // the scene's
    assert_float_equal(b->leaves.length, 0.05f, 0.0);
    assert_string_equal(scene->objects[0].material[TREE_BARK], "birch_bark");
    assert_string_equal(scene->objects[0].material[TREE_LEAF], "birch_leaf");
    assert_string_equal(scene->objects[1].material[TREE_BARK], "birch_bark");
    assert_string_equal(scene->objects[1].material[TREE_LEAF], "clay");
    assert_int_equal(scene->material_count, 2); // once, not per tree
    assert_float_equal(scene_material(scene, "birch_leaf")->roughness, 0.4f, 0.0);
    assert_int_equal(scene->target_count, 2);
    assert_float_equal(scene->targets[0].low, 1.0, 0.0); // of b, the scene's
    assert_float_equal(scene->targets[0].high, 12.0, 0.0);
    assert_string_equal(scene->targets[1].object, "a");
    scene_free(scene);
}

// One that no longer stands has none of its species' targets, but keeps those of the scene and all
// else of the species; other objects of the species keep theirs.
static void targets_can_be_left_out(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    Scene *scene = fixture_read(fixture, "objects:\n"
                                         "  - {name: fallen, species_targets: false, tree: "
                                         "{species: birch.yaml}}\n"
                                         "  - {name: other, species_targets: no, tree: "
                                         "{species: birch.yaml}}\n"
                                         "  - {name: upright, species_targets: true, tree: "
                                         "{species: birch.yaml}}\n"
                                         "targets: [{object: other, measure: width, low: 1}]\n");
    assert_float_equal(tree_of(scene, 0)->height, 10.0, 0.0);
    assert_string_equal(scene->objects[0].material[TREE_BARK], "birch_bark");
    assert_int_equal(scene->target_count, 2);
    assert_string_equal(scene->targets[0].object, "other");
    assert_string_equal(scene->targets[0].measure, "width");
    assert_string_equal(scene->targets[1].object, "upright");
    scene_free(scene);
    fixture_refuse(fixture,
                   "objects:\n"
                   "  - name: a\n"
                   "    species_targets: 3\n"
                   "    tree: {species: birch.yaml}\n",
                   "must be true or false", 3);
}

static void lengths_follow_the_height(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    Scene *scene = fixture_read(
        fixture,
        "objects: [{name: a, tree: {species: birch.yaml, height: 5, trunk: {height: 4}}}]\n");
    const TreeParams *a = tree_of(scene, 0);
    assert_float_equal(a->trunk.height, 4.0, 0.0); // the scene's
    assert_float_equal(a->trunk.radius, 0.05f, 0.0);
    assert_float_equal(a->crown.base, 1.0, 0.0);
    assert_float_equal(a->crown.element.shapes[0].size.y, 2.0, 0.0);
    assert_float_equal(a->leaves.length, 0.05f, 0.0);
    scene_free(scene);
}

static void envelopes_follow_the_position(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    const char *text = "objects: [{name: a, tree: {species: birch.yaml, height: 5}}]\n";
    const char *path = fixture_write(fixture, "scene.yaml", text, strlen(text));
    const char *set = "objects.a.tree.position=[3, 1, -2.5]";
    Error e = {0};
    Scene *scene = scene_read(path, &set, 1, &e);
    assert_non_null(scene);
    const Vec3 at = tree_of(scene, 0)->crown.element.shapes[0].position;
    assert_float_equal(at.x, 3.0, 0.0);
    assert_float_equal(at.y, 1.0, 0.0);
    assert_float_equal(at.z, -2.5, 0.0);
    scene_free(scene);
}

// Attractors that buds reach for are of the tree's size and about its foot, as the crown is; other
// lengths of light are not.
static void attractors_of_light_follow_the_tree(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "fan.yaml",
               "tree: {light: {mature_height: 8, attractors: {count: 9, envelope: [{shape: "
               "ellipsoid, size: [2, 1, 2], position: [1, 6, 0]}]}}}\n");
    Scene *scene = fixture_read(fixture, "objects: [{name: a, tree: {species: fan.yaml, height: 4, "
                                         "position: [10, 2, -3]}}]\n");
    const TreeParams *a = tree_of(scene, 0);
    const Shape *shape = &a->light.attractors.element.shapes[0];
    assert_float_equal(a->light.mature_height, 8.0, 0.0);
    assert_float_equal(shape->size.x, 1.0, 0.0);
    assert_float_equal(shape->position.x, 10.5, 0.0);
    assert_float_equal(shape->position.y, 5.0, 0.0);
    assert_float_equal(shape->position.z, -3.0, 0.0);
    scene_free(scene);
}

static void the_scene_changes_materials_by_key(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    const char *text = "objects: [{name: a, tree: {species: birch.yaml}}]\n"
                       "materials: [{name: birch_leaf, roughness: 0.9}]\n";
    const char *path = fixture_write(fixture, "scene.yaml", text, strlen(text));
    const char *set[] = {"materials.birch_bark.color=0.3", "objects.a.tree.crown.envelope.0.size=3",
                         "objects.a.tree.height=20"};
    Error e = {0};
    Scene *scene = scene_read(path, set, 3, &e);
    assert_non_null(scene);
    assert_int_equal(scene_material(scene, "birch_leaf")->kind, MATERIAL_LEAF);
    assert_float_equal(scene_material(scene, "birch_leaf")->roughness, 0.9f, 0.0);
    assert_float_equal(scene_material(scene, "birch_leaf")->color.y, 0.2f, 0.0);
    assert_float_equal(scene_material(scene, "birch_bark")->color.x, 0.3f, 0.0);
    assert_float_equal(tree_of(scene, 0)->crown.element.shapes[0].size.x, 3.0, 0.0);
    assert_float_equal(tree_of(scene, 0)->crown.base, 4.0, 0.0); // twice the height
    scene_free(scene);
}

static void a_species_begins_with_another(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    write_file(fixture, "dwarf.yaml",
               "tree: {species: birch.yaml, height: 1, leaves: {length: 0.01}}\n"
               "materials: [{name: bark, color: 0.1}]\n"
               "targets: [{measure: height, low: 0.5, high: 2}]\n");
    Scene *scene = fixture_read(fixture, "objects: [{name: a, tree: {species: dwarf.yaml}}]\n");
    const TreeParams *a = tree_of(scene, 0);
    assert_float_equal(a->height, 1.0, 0.0);
    assert_float_equal(a->trunk.height, 0.5, 0.0);
    assert_float_equal(a->leaves.length, 0.01f, 0.0);
    assert_int_equal(a->leaves.max_count, 20);
    assert_string_equal(scene->objects[0].material[TREE_BARK], "dwarf_bark");
    assert_float_equal(scene_material(scene, "dwarf_bark")->color.x, 0.1f, 0.0);
    assert_int_equal(scene_material(scene, "dwarf_bark")->kind, MATERIAL_DIFFUSE);
    assert_int_equal(scene->target_count, 1);
    assert_float_equal(scene->targets[0].high, 2.0, 0.0);
    scene_free(scene);
}

static void a_folder_beside_the_scene_comes_first(void **state)
{
    Fixture *fixture = *state;
    char command[128];
    snprintf(command, sizeof command, "mkdir -p %s/species", fixture->folder);
    assert_int_equal(system(command), 0);
    write_file(fixture, "species/silver_birch.yaml", "tree: {height: 3}\n");
    Scene *scene = fixture_read(fixture, "objects: [{name: a, tree: {species: silver_birch}}]\n");
    assert_float_equal(tree_of(scene, 0)->height, 3.0, 0.0);
    scene_free(scene);
}

static OutTree *grow(const Scene *scene)
{
    Error e = {0};
    Run run = {.threads = 1};
    OutTree *tree = scene_grow_object(scene, 0, &run, &e);
    assert_non_null(tree);
    return tree;
}

// The resolved text is complete: it needs no species file.
static void resolved_text_gives_the_same_bits(void **state)
{
    Fixture *fixture = *state;
    write_file(fixture, "birch.yaml", BIRCH);
    Scene *scene = fixture_read(fixture, "objects: [{name: a, tree: {species: birch.yaml, seed: 3, "
                                         "crown: {growth: {levels: [{attractors: 200}]}}}}]\n");
    remove(fixture_write(fixture, "birch.yaml", "", 0));
    Error e = {0};
    Scene *again =
        scene_read_text(scene->resolved, strlen(scene->resolved), "again", "", NULL, 0, &e);
    assert_non_null(again);
    assert_string_equal(again->resolved, scene->resolved);
    OutTree *one = grow(scene), *two = grow(again);
    assert_int_equal(one->count, two->count);
    assert_memory_equal(one->position, two->position, sizeof *one->position * (size_t)one->count);
    out_tree_free(one);
    out_tree_free(two);
    scene_free(again);
    scene_free(scene);
}

static void a_tree_has_a_seed_of_its_own(void **state)
{
    Fixture *fixture = *state;
    Scene *scene = fixture_read(fixture, "objects: [{name: a, seed: 5, tree: {seed: 9}},\n"
                                         "          {name: b, seed: 5, tree: }]\n");
    assert_int_equal(scene_object_seed(scene, 0), 9);
    assert_int_equal(scene_object_seed(scene, 1), 5);
    scene_free(scene);
}

static LeavesParams leaves_in(Fixture *fixture, const char *season)
{
    char text[256];
    snprintf(text, sizeof text,
             "objects: [{name: a, tree: {%s, phenology: {leafing: [4, 5], turning: [10, 11], "
             "falling: [10.5, 11.5]}}}]\n",
             season);
    Scene *scene = fixture_read(fixture, text);
    LeavesParams leaves = tree_of(scene, 0)->leaves;
    scene_free(scene);
    return leaves;
}

static void the_season_sets_the_leaves(void **state)
{
    Fixture *fixture = *state;
    LeavesParams none = leaves_in(fixture, "leaves: {autumn: 0.3}");
    assert_float_equal(none.autumn, 0.3f, 0.0); // no season: as the leaves have it
    LeavesParams winter = leaves_in(fixture, "season: 2.5"),
                 spring = leaves_in(fixture, "season: 4.25");
    LeavesParams summer = leaves_in(fixture, "season: 7, leaves: {autumn: 0.3}");
    LeavesParams autumn = leaves_in(fixture, "season: 10.75");
    assert_float_equal(winter.fall, 1.0, 0.0);
    assert_float_equal(winter.litter, 0.5, 1e-6);
    assert_float_equal(spring.emergence, 0.25, 1e-6);
    assert_float_equal(spring.fall, 0.0, 0.0);
    assert_float_equal(summer.emergence, 1.0, 0.0);
    assert_float_equal(summer.autumn, 0.0, 0.0);
    assert_float_equal(autumn.autumn, 0.75, 1e-6);
    assert_float_equal(autumn.fall, 0.25, 1e-6);
    assert_float_equal(autumn.litter, 1.0, 0.0);
    // later in the north, earlier in its autumn; half a year apart in the south
    assert_true(leaves_in(fixture, "season: 4.25, latitude: 51").emergence < 0.25f);
    assert_true(leaves_in(fixture, "season: 10.75, latitude: 52").autumn > 0.75f);
    assert_float_equal(leaves_in(fixture, "season: 10.25, latitude: -50").emergence, 0.25, 1e-5);
    fixture_refuse(fixture, "objects: [{name: a, tree: {season: 0.5}}]\n",
                   "season is 0.5; months begin at 1", 1);
    fixture_refuse(fixture, "objects: [{name: a, tree: {phenology: {leafing: [5, 4]}}}]\n",
                   "leafing must begin before it ends", 1);
    fixture_refuse(fixture, "objects: [{name: a, tree: {phenology: {turning: [3, 4]}}}]\n",
                   "turning begins too early", 1);
}

// Species files that are wrong, and the exact words and places.
static void errors_name_the_species_file(void **state)
{
    Fixture *fixture = *state;
    static const struct {
        const char *text, *file, *message;
        int line, column;
    } cases[] = {
        {"tree: {heigth: 3}\n", "oak.yaml",
         "unknown key 'heigth' in objects.a.tree; did you mean 'height'?", 1, 8},
        {"tree:\n  leaves:\n    length: long\n", "oak.yaml",
         "objects.a.tree.leaves.length is 'long'; it must be a number", 3, 13},
        {"tree: {height: 5, crown: {base: 7}}\n", "oak.yaml",
         "objects.a.tree.crown.base is 7 m; it must be below the tree's height, 5 m", 1, 33},
        {"tree: {}\nmaterial: brak\nmaterials: [{name: bark}]\n", "oak.yaml",
         "objects.a.material: there is no material 'brak'; did you mean 'bark'?", 2, 11},
        {"tree: {}\nmaterials: [{name: bark, colour: 1}]\n", "oak.yaml",
         "unknown key 'colour' in materials.oak_bark; did you mean 'color'?", 2, 26},
        {"tree: {}\nmaterials: {name: bark}\n", "oak.yaml",
         "materials must be a list of mappings ('- ' before each)", 2, 12},
        {"tree: [\n", "oak.yaml", NULL, 2, 1},
        {"tree: {}\nroots: {}\n", "oak.yaml", NULL, 2, 1},
        {"tree: {species: oak.yaml}\n", "oak.yaml",
         "species 'oak.yaml' begins with a species, and so on, more than 8 times; end the circle",
         1, 17},
        {"coral: {}\n", "scene.yaml", "species 'oak' is no tree; write coral: {species: oak.yaml}",
         1, 37},
        {"height: 3\n", "scene.yaml", NULL, 1, 37},
        {"- tree\n", "oak.yaml",
         "not a species; a species file is a mapping of keys of an object, materials and targets",
         1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_file(fixture, "oak.yaml", cases[i].text);
        const char *text = "objects: [{name: a, tree: {species: oak.yaml}}]\n";
        Error e = {0};
        assert_null(
            scene_read(fixture_write(fixture, "scene.yaml", text, strlen(text)), NULL, 0, &e));
        char file[128];
        snprintf(file, sizeof file, "%s/%s", fixture->folder, cases[i].file);
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, file);
        if (cases[i].message) {
            assert_string_equal(e.message, cases[i].message);
        }
        assert_int_equal(e.line, cases[i].line);
        assert_int_equal(e.column, cases[i].column);
    }
}

static void errors_name_the_scene(void **state)
{
    Fixture *fixture = *state;
    fixture_refuse(fixture, "objects: [{name: a, tree: {species: silver_brich}}]\n",
                   "there is no species 'silver_brich'; did you mean 'silver_birch'?", 1);
    fixture_refuse(fixture, "objects: [{name: a, tree: {species: [oak]}}]\n",
                   "species must be a name or the path of a species file", 1);
    fixture_refuse(fixture, "objects: [{name: a, tree: {species: none.yaml}}]\n",
                   "none.yaml: cannot read it: No such file or directory; name a species file", 1);
    fixture_refuse(fixture, "objects: [{name: a, tree: {species: 'b c.yaml'}}]\n",
                   "species: 'b c' is no name of a species; use letters, digits, _ and -", 1);
    fixture_refuse(fixture, "objects: [{name: a, coral: {species: oak}}]\n",
                   "unknown key 'species'", 1);
    char command[192];
    snprintf(command, sizeof command, "mkdir -p %s/x", fixture->folder);
    assert_int_equal(system(command), 0);
    write_file(fixture, "birch.yaml", BIRCH);
    write_file(fixture, "x/birch.yaml", "tree: {}\n");
    fixture_refuse(fixture,
                   "objects:\n  - {name: a, tree: {species: birch.yaml}}\n"
                   "  - {name: b, tree: {species: x/birch.yaml}}\n",
                   "two species files are called 'birch'", 3);
}

static void the_library_loads(void **state)
{
    Fixture *fixture = *state;
    const char *name;
    int count = 0;
    for (; (name = species_builtin(count, NULL)); count++) {
        char text[256];
        bool climbs = strcmp(name, "ivy") == 0 || strcmp(name, "wisteria") == 0;
        snprintf(text, sizeof text,
                 climbs ? "objects: [{name: a, climber: {species: %s, climbs: b, starts: "
                          "[{position: [0, 0, 0]}]}}, {name: b, ground: {}}]\n"
                        : "objects: [{name: a, tree: {species: %s}}]\n",
                 name);
        Scene *scene = fixture_read(fixture, text);
        assert_true(scene->target_count > 0);
        assert_true(scene->material_count > 0);
        assert_non_null(scene->objects[0].material[TREE_BARK]);
        scene_free(scene);
    }
    assert_true(count >= 32);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_set_up, fixture_tear_down)
    const struct CMUnitTest tests[] = {
        TEST(a_file_gives_keys_materials_and_targets),
        TEST(targets_can_be_left_out),
        TEST(lengths_follow_the_height),
        TEST(envelopes_follow_the_position),
        TEST(attractors_of_light_follow_the_tree),
        TEST(the_scene_changes_materials_by_key),
        TEST(a_species_begins_with_another),
        TEST(a_folder_beside_the_scene_comes_first),
        TEST(resolved_text_gives_the_same_bits),
        TEST(a_tree_has_a_seed_of_its_own),
        TEST(the_season_sets_the_leaves),
        TEST(errors_name_the_species_file),
        TEST(errors_name_the_scene),
        TEST(the_library_loads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
