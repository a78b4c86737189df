// Scenes that are right: defaults, overrides, anchors, merges, numbers, files, round trips.
#include "render/world.h"
#include "scene_fixture.h"

#include "base/hash.h"
#include "config/compare.h"
#include "config/hint.h"
#include "config/scalar.h"
#include "objects/kinds.h"
#include "objects/mesh/mesh.h"
#include "objects/shape/shape.h"
#include "objects/tree/tree.h"
#include "scene/builtin.h"
#include "scene/spec.h"

#include <locale.h>
#include <math.h>

static const char plain[] = "objects: [{name: oak, tree: }]\n";

static Scene *read_text(const char *text, const char *const *overrides, int count)
{
    Error e = {0};
    Scene *scene = scene_read_text(text, strlen(text), "s.yaml", "", overrides, count, &e);
    if (!scene) {
        char message[1200];
        error_format(&e, message, sizeof message);
        print_error("%s\n", message);
    }
    assert_non_null(scene);
    return scene;
}

static const void *params_of(const Scene *scene, int index, const Kind *kind)
{
    assert_ptr_equal(scene->objects[index].kind, kind);
    return scene->objects[index].params;
}

static const TreeParams *tree_of(const Scene *scene, int index)
{
    return params_of(scene, index, &kind_tree);
}

static void defaults_are_those_of_the_modules(void **state)
{
    (void)state;
    Scene *scene = read_text(plain, NULL, 0);
    World *world = world_new(NULL);
    TreeParams tree = tree_params_default();
    ToneParams tone = tone_params_default();
    assert_memory_equal(&scene->camera, &world->camera, sizeof scene->camera);
    assert_memory_equal(&scene->film, &world->film, sizeof scene->film);
    assert_int_equal(scene->sky.kind, world->sky.kind);
    assert_memory_equal(&scene->sky.sun_elevation, &world->sky.sun_elevation, sizeof(float));
    assert_int_equal(scene->render.samples, world->render.samples);
    assert_int_equal(scene->render.max_depth, world->render.max_depth);
    assert_int_equal(scene->seed, 1);
    assert_int_equal(scene->render.seed, 1);
    assert_memory_equal(&scene->tone.contrast, &tone.contrast, sizeof(float));
    assert_memory_equal(&scene->tone.bloom, &tone.bloom, sizeof(float));
    assert_int_equal(scene->object_count, 1);
    const TreeParams *read = tree_of(scene, 0);
    assert_memory_equal(&read->leaves, &tree.leaves, sizeof tree.leaves);
    assert_memory_equal(&read->radii, &tree.radii, sizeof tree.radii);
    assert_memory_equal(&read->skin, &tree.skin, sizeof tree.skin);
    assert_memory_equal(&read->crown.element.growth.noise, &tree.crown.element.growth.noise,
                        sizeof(float));
    assert_memory_equal(&read->crown.branch_angle, &tree.crown.branch_angle, sizeof(float));
    assert_null(read->crown.element.shapes);
    world_free(world);
    scene_free(scene);
}

static void overrides_reach_every_depth(void **state)
{
    (void)state;
    const char *const overrides[] = {"objects.oak.tree.leaves.max_count=0",
                                     "camera.position=[1, 2, 3]",
                                     "objects.0.tree.height=9",
                                     "film={width: 64, height: 32}",
                                     "film.exposure=-1.5",
                                     "seed=0x10"};
    Scene *scene = read_text(plain, overrides, 6);
    assert_int_equal(tree_of(scene, 0)->leaves.max_count, 0);
    assert_true(tree_of(scene, 0)->height == 9.0f);
    assert_true(scene->camera.position.z == 3.0f);
    assert_int_equal(scene->film.width, 64);
    assert_true(scene->tone.exposure == -1.5f);
    assert_int_equal(scene->seed, 16);
    scene_free(scene);
}

static void anchors_and_merge_keys_work(void **state)
{
    (void)state;
    Scene *scene = read_text("objects:\n"
                             "  - &first\n"
                             "    name: a\n"
                             "    seed: 5\n"
                             "    tree: &tree {height: 7, roots: &no_roots {count: 0}}\n"
                             "  - {<<: *first, name: b}\n"
                             "  - name: c\n"
                             "    tree: {<<: *tree, height: 8}\n"
                             "  - name: d\n"
                             "    tree: {height: 3, <<: [{height: 4, radii: {tip: 0.5}}, *tree]}\n",
                             NULL, 0);
    assert_int_equal(scene->object_count, 4);
    assert_string_equal(scene->objects[1].name, "b");
    assert_int_equal(scene->objects[1].seed, 5);
    assert_true(tree_of(scene, 1)->height == 7.0f);
    assert_true(tree_of(scene, 2)->height == 8.0f);
    assert_int_equal(tree_of(scene, 2)->roots.count, 0);
    assert_true(tree_of(scene, 3)->height == 3.0f); // its own key wins, wherever it stands
    assert_true(tree_of(scene, 3)->radii.tip == 0.5f);
    assert_int_equal(tree_of(scene, 3)->roots.count, 0);
    scene_free(scene);
}

static void an_override_changes_one_copy_of_an_anchor(void **state)
{
    (void)state;
    const char *const overrides[] = {"objects.a.tree.height=5"};
    Scene *scene =
        read_text("objects: [{name: a, tree: &t {height: 7}}, {name: b, tree: *t}]", overrides, 1);
    assert_true(tree_of(scene, 0)->height == 5.0f);
    assert_true(tree_of(scene, 1)->height == 7.0f);
    scene_free(scene);
}

static void growth_fills_in_its_levels(void **state)
{
    (void)state;
    Scene *scene = read_text("objects:\n"
                             "  - name: a\n"
                             "    tree:\n"
                             "      crown:\n"
                             "        growth:\n"
                             "          noise: 0.7\n"
                             "          levels: [{attractors: 1_000}, {attractors: 1e6, noise: 0, "
                             "tropism: 2}]\n"
                             "      trunk: {growth: {tropism: [0, 1, 0], levels: [{attractors: "
                             "9}]}}\n",
                             NULL, 0);
    const ElementParams *crown = &tree_of(scene, 0)->crown.element;
    assert_int_equal(crown->level_count, 2);
    assert_int_equal(crown->levels[0].attractors, 1000);
    assert_int_equal(crown->levels[1].attractors, 1000000);
    assert_true(crown->levels[0].noise == 0.7f && crown->levels[1].noise == 0.0f);
    assert_true(crown->levels[0].tropism == 0.0f && crown->levels[1].tropism == 2.0f);
    assert_true(tree_of(scene, 0)->trunk.element.levels[0].tropism == 1.0f);
    scene_free(scene);
}

static void shapes_and_fields_are_placed(void **state)
{
    (void)state;
    Scene *scene = read_text("objects:\n"
                             "  - name: a\n"
                             "    shape:\n"
                             "      envelope:\n"
                             "        - {shape: sphere, size: 2, position: [1, 2, 3]}\n"
                             "        - {shape: half_space, op: difference, rotation: [0, 0, 90]}\n"
                             "  - name: b\n"
                             "    tree: {crown: {fields: [{kind: nuclei, turn: 360}, {kind: "
                             "point, weight: 2}]}}\n",
                             NULL, 0);
    const SolidParams *solid = params_of(scene, 0, &kind_shape);
    const Shape *shape = solid->shapes;
    assert_int_equal(solid->shape_count, 2);
    assert_true(shape[0].transform.m[0][0] == 2.0f && shape[0].transform.m[2][3] == 3.0f);
    assert_int_equal(shape[1].op, SHAPE_DIFFERENCE);
    assert_true(fabsf(shape[1].transform.m[1][0] - 1.0f) < 1e-6f); // y <= 0 became x >= 0
    const ElementParams *crown = &tree_of(scene, 1)->crown.element;
    assert_int_equal(crown->field_count, 2);
    assert_true(crown->fields[0].turn == 360.0f && crown->fields[1].weight == 2.0f);
    FieldParams point = field_params_default(FIELD_POINT);
    assert_true(crown->fields[1].scale == point.scale);
    scene_free(scene);
}

static void materials_begin_from_their_kind_or_the_built_in_one(void **state)
{
    (void)state;
    Scene *scene = read_text("materials:\n"
                             "  - {name: leaf, variation: 0.9}\n"
                             "  - {name: gold, kind: conductor, color: \"#ffff00\"}\n"
                             "  - {name: stone, color: 0.3}\n"
                             "objects: [{name: a, tree: , material: gold}]\n",
                             NULL, 0);
    Material conductor = material_default(MATERIAL_CONDUCTOR);
    assert_int_equal(scene->materials[0].kind, MATERIAL_LEAF);
    assert_true(scene->materials[0].variation == 0.9f);
    assert_true(scene->materials[0].transmittance.y > 0.05f);
    assert_true(scene->materials[1].roughness == conductor.roughness);
    assert_true(scene->materials[1].color.x == 1.0f && scene->materials[1].color.z == 0.0f);
    assert_int_equal(scene->materials[2].kind, MATERIAL_DIFFUSE);
    assert_true(scene->materials[2].color.y == 0.3f);
    assert_string_equal(scene->objects[0].material[0], "gold");
    scene_free(scene);
}

static void files_are_found_beside_the_scene(void **state)
{
    Fixture *fixture = *state;
    char wanted[160];
    Error e = {0};
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fixture_write(fixture, "stone.obj", mesh, sizeof mesh - 1);
    snprintf(wanted, sizeof wanted, "%s/stone.obj", fixture->folder);
    const char text[] = "objects: [{name: a, mesh: {file: stone.obj}}]";
    Scene *scene = scene_read(fixture_write(fixture, "s.yaml", text, sizeof text - 1), NULL, 0, &e);
    assert_non_null(scene);
    const MeshParams *stone = params_of(scene, 0, &kind_mesh);
    assert_string_equal(stone->file, wanted);
    assert_string_equal(scene->text, text);
    scene_free(scene);
}

// Of every type of key, on every level.
static const char *const CHANGES[] = {
    "seed=2",
    "camera.fov=30",
    "camera.focal_length=31",
    "film.crop=[0, 0, 0.5, 1]",
    "film.denoise=true",
    "sky.kind=night",
    "lights.0.radiance=0.5",
    "lights=[]",
    "medium={}",
    "materials.0.name=b",
    "materials.0.pattern=noise",
    "objects.0.name=c",
    "objects.0.material=bark",
    "objects.0.tree.crown.growth.levels.0.noise=0.25",
    "objects.0.tree.crown.growth.levels=[{attractors: 5}, {attractors: 6}]",
    "objects.0.tree.crown.fields.0.center=[0, 0, 0]",
    "objects.0.tree.crown.fields.0.weight=2",
    "objects.1.lsystem.rules=F -> FF",
    "objects.1={name: plant, shape: {envelope: [{shape: sphere}]}}",
    "render.seconds=0.1",
    "animation.tracks.0.keys.1.value=4",
};

static void scenes_are_compared_as_values(void **state)
{
    (void)state;
    static const char text[] =
        "lights: [{kind: sphere}]\n"
        "materials: [{name: a}]\n"
        "objects:\n"
        "  - name: oak\n"
        "    tree: {crown: {growth: {levels: [{attractors: 5}]}, fields: [{kind: radial}]}}\n"
        "  - {name: plant, lsystem: }\n"
        "animation: {tracks: [{path: seed, keys: [{at: 0, value: 1}, {at: 1, value: 3}]}]}\n";
    Scene *scene = read_text(text, NULL, 0), *again = read_text(text, NULL, 0);
    uint64_t hash = table_hash(HASH_START, &scene_table, scene, NULL);
    assert_true(table_equal(&scene_table, scene, again, NULL));
    assert_true(table_hash(HASH_START, &scene_table, again, NULL) == hash);
    for (size_t i = 0; i < sizeof CHANGES / sizeof CHANGES[0]; i++) {
        Scene *other = read_text(text, &CHANGES[i], 1);
        if (table_equal(&scene_table, scene, other, NULL) ||
            table_hash(HASH_START, &scene_table, other, NULL) == hash) {
            fail_msg("%s makes no difference", CHANGES[i]);
        }
        bool only_animation = strncmp(CHANGES[i], "animation", 9) == 0;
        assert_int_equal(table_equal(&scene_table, scene, other, "animation"), only_animation);
        scene_free(other);
    }
    scene_free(again);
    scene_free(scene);
}

// The resolved text says everything: read again, it resolves to itself.
static void the_resolved_scene_reads_back_to_itself(void **state)
{
    (void)state;
    Scene *scene = read_text("seed: 18446744073709551615\n"
                             "camera: {focal_length: 35, position: [0.1, 1.0e-3, 30]}\n"
                             "sky: {kind: constant, color: [1, 2, 3]}\n"
                             "lights: [{kind: quad}, {kind: sphere, radius: 0.3}]\n"
                             "materials: [{name: \"a b\", kind: dielectric}]\n"
                             "objects:\n"
                             "  - {name: oak, tree: {crown: {envelope: [{shape: cone, size: [3, 9, "
                             "0]}], growth: {levels: [{attractors: 5}]}}}}\n"
                             "  - {name: land, ground: }\n"
                             "  - {name: ball, shape: {envelope: [{shape: sphere}]}, material: \"a "
                             "b\"}\n",
                             NULL, 0);
    Scene *again = read_text(scene->resolved, NULL, 0);
    assert_string_equal(again->resolved, scene->resolved);
    // 0 stands for what follows from other keys: what is used is noted
    Scene *grown = read_text("objects:\n"
                             "  - {name: a, tree: {height: 10, trunk: {radius: 0.5}}}\n"
                             "  - {name: b, lightning: {height: 400}}\n"
                             "  - {name: c, venation: {length: 0.2}}\n"
                             "  - {name: d, coral: {size: 1}}\n"
                             "  - {name: e, forest: {height: 10}}\n"
                             "  - {name: f, terrain: {rivers: {count: 36}}}\n"
                             "  - {name: g, vessels: {envelope: [{shape: body, size: 1.8}]}}\n"
                             "camera: {position: [0, 0, 3], target: [0, 0, 0]}\n",
                             NULL, 0);
    assert_non_null(strstr(grown->resolved, "      stem_circle: 0 # used: 0.5\n"));
    assert_non_null(
        strstr(grown->resolved, "      step: 0 # used: 10\n      segment: 0 # used: 1\n"));
    assert_non_null(strstr(grown->resolved, "      width: 0 # used: 0.1\n"));
    assert_non_null(strstr(grown->resolved, "      height: 0 # used: 0.62\n"));
    assert_non_null(strstr(grown->resolved, "      spacing: 0 # used: 2.3999999\n"));
    assert_non_null(strstr(grown->resolved, "        wavelength: 0 # used: 1\n"));
    assert_non_null(strstr(grown->resolved, "  focus_distance: 0 # used: 3\n"));
    assert_non_null(strstr(grown->resolved, "    seed: 0 # used: "));
    assert_non_null(strstr(grown->resolved, "      root_radius: 0 # used: 0.0"));
    assert_non_null(strstr(grown->resolved, "      voxel: 0\n")); // nothing is known of it yet
    scene_free(grown);
    assert_memory_equal(&again->camera, &scene->camera, sizeof scene->camera);
    assert_int_equal(again->light_count, 2);
    assert_memory_equal(again->lights, scene->lights, 2 * sizeof(Light));
    assert_true(again->seed == UINT64_MAX);
    scene_free(again);
    scene_free(scene);
}

static void the_language_of_the_caller_does_not_matter(void **state)
{
    (void)state;
    const char *const languages[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}; // where installed
    for (int i = 0; i < 3; i++) {
        setlocale(LC_ALL, languages[i]);
        const char *const overrides[] = {"camera.fov=33.25"};
        Scene *scene = read_text(plain, overrides, 1);
        assert_true(scene->camera.fov == 33.25f);
        scene_free(scene);
    }
    setlocale(LC_ALL, "C");
}

static void numbers_are_those_of_yaml(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool valid;
        double value;
    } cases[] = {{"1", true, 1},
                 {"-1.5", true, -1.5},
                 {"+2e3", true, 2000},
                 {".5", true, 0.5},
                 {"1_000", true, 1000},
                 {"0x1F", true, 31},
                 {"-0x10", true, -16},
                 {"1.", true, 1},
                 {"", false, 0},
                 {"1__0", false, 0},
                 {"_1", false, 0},
                 {"010", false, 0},
                 {"1:30", false, 0},
                 {"1e", false, 0},
                 {"0x", false, 0},
                 {"nano", false, 0},
                 {"-", false, 0},
                 {"1 2", false, 0},
                 {".inf", true, (double)INFINITY},
                 {"1e999", true, (double)INFINITY}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double value = 0.0;
        bool valid = scalar_number(cases[i].text, &value);
        if (valid != cases[i].valid || (valid && value != cases[i].value)) {
            fail_msg("'%s' was %s, %g", cases[i].text, valid ? "read" : "refused", value);
        }
    }
}

static void floats_keep_their_bits_as_text(void **state)
{
    (void)state;
    char text[32];
    for (uint32_t i = 0; i < 20000; i++) {
        uint32_t bits = i * 214013u + 0x3a83126fu;
        float value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) {
            scalar_from_float(value, text);
            assert_true(strtof(text, NULL) == value);
        }
    }
    scalar_from_float(0.1f, text);
    assert_string_equal(text, "0.1");
}

static void hints_are_near(void **state)
{
    (void)state;
    const char *const known[] = {"height", "width", "samples"};
    assert_int_equal(hint_nearest("heigth", known, 3), 0);
    assert_int_equal(hint_nearest("sample", known, 3), 2);
    assert_int_equal(hint_nearest("colour", known, 3), -1);
    assert_int_equal(hint_distance("abcd", "acbd"), 1);
    assert_int_equal(hint_distance("", "abc"), 3);
}

// ---- the JSON Schema ----

// Skips one JSON value; NULL when it is malformed.
static const char *skip_json(const char *at, int depth);

static const char *skip_space(const char *at)
{
    return at + strspn(at, " \n\r\t");
}

static const char *skip_string(const char *at)
{
    if (*at != '"') {
        return NULL;
    }
    for (at++; *at && *at != '"'; at++) {
        if ((unsigned char)*at < 0x20 || (*at == '\\' && !*++at)) {
            return NULL;
        }
    }
    return *at ? at + 1 : NULL;
}

static const char *skip_members(const char *at, char end, int depth)
{
    at = skip_space(at + 1);
    if (*at == end) {
        return at + 1;
    }
    for (;;) {
        if (end == '}') {
            at = skip_string(skip_space(at));
            at = at ? skip_space(at) : NULL;
            if (!at || *at++ != ':') {
                return NULL;
            }
        }
        at = skip_json(at, depth + 1);
        at = at ? skip_space(at) : NULL;
        if (!at || (*at != ',' && *at != end)) {
            return NULL;
        }
        if (*at++ == end) {
            return at;
        }
    }
}

static const char *skip_json(const char *at, int depth)
{
    at = skip_space(at);
    if (depth > 40) {
        return NULL;
    }
    if (*at == '{' || *at == '[') {
        return skip_members(at, *at == '{' ? '}' : ']', depth);
    }
    if (*at == '"') {
        return skip_string(at);
    }
    if (strncmp(at, "true", 4) == 0 || strncmp(at, "null", 4) == 0) {
        return at + 4;
    }
    if (strncmp(at, "false", 5) == 0) {
        return at + 5;
    }
    char *end;
    strtod(at, &end);
    return end > at ? end : NULL;
}

static void the_schema_is_json(void **state)
{
    (void)state;
    Error e = {0};
    char *schema = scene_schema_json(&e);
    assert_non_null(schema);
    const char *end = skip_json(schema, 0);
    assert_non_null(end);
    assert_int_equal(*skip_space(end), 0);
    assert_non_null(
        strstr(schema, "\"$schema\": \"https://json-schema.org/draft/2020-12/schema\""));
    assert_null(strstr(schema, "\"description\": \"\""));
    free(schema);
}

// Counts keys of a table and those below, and looks each up in the schema.
static int look_up_keys(const Table *table, const char *schema)
{
    int count = 0;
    const Key *row;
    for (int i = 0; (row = table_row(table, i)); i++) {
        char quoted[80];
        snprintf(quoted, sizeof quoted, "\"%s\": {\"description\": \"%.20s", row->key, row->doc);
        if (!strstr(schema, quoted)) {
            fail_msg("the schema lacks %s of %s", row->key, table->name);
        }
        count += 1 + (row->table ? look_up_keys(row->table, schema) : 0);
    }
    return count;
}

static void check_no_key_twice(const Table *table)
{
    const Key *row, *other;
    for (int i = 0; (row = table_row(table, i)); i++) {
        for (int k = i + 1; (other = table_row(table, k)); k++) {
            if (strcmp(row->key, other->key) == 0) {
                fail_msg("%s has two rows for %s", table->name, row->key);
            }
        }
        if (row->table) {
            check_no_key_twice(row->table);
        }
    }
}

static void no_table_has_a_key_twice(void **state)
{
    (void)state;
    check_no_key_twice(&scene_table);
}

static void the_schema_has_every_key(void **state)
{
    (void)state;
    Error e = {0};
    char *schema = scene_schema_json(&e);
    assert_non_null(schema);
    assert_true(look_up_keys(&scene_table, schema) > 200);
    free(schema);
}

// Replaces every "NAME" by a and every "N" between dots by 0.
static void name_path(const char *path, size_t length, char *out)
{
    size_t used = 0;
    for (size_t i = 0; i < length; i++) {
        bool name = strncmp(path + i, "NAME", 4) == 0, number = !name && path[i] == 'N';
        out[used++] = name ? 'a' : number ? '0' : path[i];
        i += name ? 3 : 0;
    }
    out[used] = 0;
}

static const char *message_of(const char *text, const char *path)
{
    static Error e;
    e = (Error){0};
    char override[300];
    snprintf(override, sizeof override, "%s={}", path);
    const char *overrides[] = {override};
    scene_free(scene_read_text(text, strlen(text), "scene", "", overrides, 1, &e));
    return e.message;
}

// A path that --set does not know would be completed by shells and then refused.
static void every_path_can_be_set(void **state)
{
    (void)state;
    Error e = {0};
    char *paths = scene_schema_paths(&e);
    assert_non_null(paths);
    int count = 0;
    for (const char *line = paths; *line; line = strchr(line, '\n') + 1) {
        char path[200], text[300];
        name_path(line, strcspn(line, "\n"), path);
        const char *kind = "tree";
        int length = 4;
        if (strncmp(path, "objects.a.", 10) == 0 && strchr(path + 10, '.')) {
            kind = path + 10;
            length = (int)strcspn(kind, ".");
        }
        snprintf(text, sizeof text,
                 "lights: [{kind: quad}]\nmaterials: [{name: a}]\n"
                 "targets: [{object: a, measure: m}]\nobjects: [{name: a, %.*s: {}}]",
                 length, kind);
        const char *message = message_of(text, path);
        if (strstr(message, "unknown key")) {
            fail_msg("%s: %s", path, message);
        }
        count++;
    }
    assert_true(count > 500);
    assert_non_null(
        strstr(message_of("objects: [{name: a, tree: {}}]", "camera.fvo"), "unknown key"));
    free(paths);
}

// A new built-in material changes no scene: the names that a scene's own material can have are
// complete, and in order of the alphabet here.
static void built_in_materials_take_no_further_names(void **state)
{
    (void)state;
    static const char names[] =
        " altitude artery attractor badlands bark blossom broken clay cone conifer copper coral "
        "coral_polyp deadwood fallen fieldstone fruit grass ground ice lake lamp leaf "
        "leaf_vein "
        "lightning mistletoe moss mountain node reef_rock rime snow soap_film stalk twig vein ";
    int count = 0;
    for (int i = 0; builtin_material_at(i); i++) {
        char name[80];
        snprintf(name, sizeof name, " %s ", builtin_material_at(i)->name);
        if (!strchr(name, '/') && !strstr(names, name)) {
            fail_msg("the new built-in material%smust be called KIND/NAME: scene/builtin.h", name);
        }
        count += !strchr(name, '/');
    }
    for (const char *c = names + 1; (c = strchr(c, ' ')); c++) {
        count--;
    }
    assert_int_equal(count, 0);
}

// A scene's material of a name that is not built in starts from its kind alone.
static void own_materials_are_their_own(void **state)
{
    (void)state;
    Scene *scene =
        read_text("materials: [{name: gravel, kind: principled}, {name: bark, color: 0.5}]\n"
                  "objects: [{name: oak, tree: }]\n",
                  NULL, 0);
    Material plain_one = material_default(MATERIAL_PRINCIPLED), *own = &scene->materials[0];
    assert_true(own->color.x == plain_one.color.x && own->roughness == plain_one.roughness &&
                own->pattern == plain_one.pattern);
    assert_ptr_equal(scene_material(scene, "gravel"), own);
    const Material *bark = scene_material(scene, "bark");
    assert_true(bark->color.x == 0.5f && bark->pattern == PATTERN_BARK);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_modules),
        cmocka_unit_test(built_in_materials_take_no_further_names),
        cmocka_unit_test(own_materials_are_their_own),
        cmocka_unit_test(overrides_reach_every_depth),
        cmocka_unit_test(anchors_and_merge_keys_work),
        cmocka_unit_test(an_override_changes_one_copy_of_an_anchor),
        cmocka_unit_test(growth_fills_in_its_levels),
        cmocka_unit_test(shapes_and_fields_are_placed),
        cmocka_unit_test(materials_begin_from_their_kind_or_the_built_in_one),
        cmocka_unit_test_setup_teardown(files_are_found_beside_the_scene, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test(the_resolved_scene_reads_back_to_itself),
        cmocka_unit_test(the_language_of_the_caller_does_not_matter),
        cmocka_unit_test(numbers_are_those_of_yaml),
        cmocka_unit_test(floats_keep_their_bits_as_text),
        cmocka_unit_test(hints_are_near),
        cmocka_unit_test(no_table_has_a_key_twice),
        cmocka_unit_test(scenes_are_compared_as_values),
        cmocka_unit_test(the_schema_is_json),
        cmocka_unit_test(the_schema_has_every_key),
        cmocka_unit_test(every_path_can_be_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
