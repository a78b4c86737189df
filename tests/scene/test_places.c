// Whatever is refused only after a scene was read (while it grows, is built, measured or prepared
// for rendering) names file, line and column: of the key that is wrong, else of the object.
#include "scene_fixture.h"

#include "ramify.h"

typedef struct BadFile {
    const char *name, *text;
} BadFile;

static const BadFile files[] = {
    {"triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"},
    {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"junk.glb", "glTFjunk"},
    {"junk.gltf", "junk"},
    {"junk.png", "junk"},
    {"junk.hdr", "junk"},
    {"empty.swc", "# nothing\n"},
    {"word.swc", "1 1 0 0 0 1 -1\n2 3 0 0 zz 1 1\n"},
    {"short.swc", "1 1 0 0 0 1 -1\n2 3 0 0\n"},
    {"orphan.swc", "1 1 0 0 0 1 -1\n2 3 0 0 1 1 7\n"},
    {"far.swc", "1 3 0 0 0 1 -1\n2 3 0 0 1e5 1 1\n"},
    {"away.swc", "1 3 900 0 0 1 -1\n2 3 950 0 0 1 1\n"},
};

typedef struct Place {
    const char *kind, *keys; // of object 'x': "  kind: {keys}" in line 4
    int line, column;        // 0 = any
    const char *says;
} Place;

#define BALL "envelope: [{shape: sphere, size: 1}]"
#define GONE "envelope: [{shape: sphere, size: 1}, {shape: sphere, op: difference, size: 3}]"
#define ROUGH "envelope: [{shape: sphere, size: 1}, {shape: box, size: [1, 1, 1]}], voxel: 10"
#define LINE "envelope: [{shape: mesh, file: line.obj}]"
#define JUNK "envelope: [{shape: sphere, size: 1}, {shape: mesh, file: junk.glb}]"

static const Place places[] = {
    // meshes
    {"mesh", "file: line.obj", 4, 18, "degenerate"},
    {"mesh", "file: nan.obj", 4, 18, "not finite"},
    {"mesh", "file: junk.glb", 4, 18, "junk.glb"},
    {"mesh", "file: junk.gltf", 4, 18, "junk.gltf"},
    {"mesh", "scale: 1e30, file: triangle.obj", 4, 5, "flattens"},
    // envelopes
    {"shape", GONE, 4, 13, "the envelope is empty"},
    {"shape", ROUGH, 4, 89, "voxel 10 m is too coarse"},
    {"shape", "envelope: [{shape: sphere}, {shape: box}], voxel: 0.000001", 4, 63, "voxel"},
    {"shape", LINE, 4, 44, "degenerate"},
    {"shape", JUNK, 4, 70, "shape 2 (mesh)"},
    {"sculpture", GONE, 4, 17, "the envelope is empty"},
    {"sculpture", ROUGH, 0, 0, "voxel 10 m is too coarse"},
    {"sculpture", LINE, 0, 0, "degenerate"},
    {"sculpture", BALL ", thickness: 1e-12", 4, 5, "details of"},
    {"vessels", GONE, 4, 15, "the envelope is empty"},
    {"vessels", ROUGH, 0, 0, "voxel 10 m is too coarse"},
    {"vessels", LINE, 0, 0, "degenerate"},
    {"vessels", JUNK, 0, 0, "junk.glb"},
    {"fracture", GONE, 4, 16, "the envelope is empty"},
    {"fracture", ROUGH, 0, 0, "voxel 10 m is too coarse"},
    {"fracture", LINE, 0, 0, "degenerate"},
    {"fracture", JUNK, 0, 0, "junk.glb"},
    {"lightning", "points: {place: surface}, " GONE, 4, 43, "the envelope is empty"},
    {"lightning", "points: {place: surface}, " LINE, 0, 0, "degenerate"},
    {"lightning", "points: {place: surface}, " JUNK, 0, 0, "junk.glb"},
    {"lightning", "envelope: [{shape: mesh, file: triangle.obj}]", 4, 17, "bolt 1"},
    {"lightning", GONE, 4, 17, "the envelope is empty"},
    {"forest", GONE, 4, 14, "the envelope is empty"},
    {"forest", ROUGH, 0, 0, "voxel 10 m is too coarse"},
    {"forest", LINE, 0, 0, "degenerate"},
    {"tree", "height: 5, crown: {" GONE "}", 4, 31, "crown: the envelope is empty"},
    {"tree", "height: 5, crown: {" ROUGH "}", 0, 0, "crown: voxel 10 m"},
    {"tree", "height: 5, crown: {" LINE "}", 4, 62, "crown: shape 1 (mesh)"},
    {"tree", "height: 5, crown: {" JUNK "}", 0, 0, "crown: shape 2 (mesh)"},
    {"tree", "grown_by: attractors, height: 5, trunk: {" GONE "}", 4, 53,
     "trunk: the envelope is empty"},
    {"tree", "grown_by: attractors, height: 5, trunk: {" LINE "}", 0, 0, "degenerate"},
    {"tree", "height: 5, roots: {count: 3, " GONE "}", 4, 41, "roots: the envelope is empty"},
    {"tree", "height: 5, roots: {count: 3, " LINE "}", 0, 0, "degenerate"},
    // sizes that numbers cannot hold
    {"tree", "position: [1e30, 0, 0]", 4, 5, "move it closer"},
    {"tree", "grown_by: attractors, height: 1e-30", 4, 5, "capsule of radius 0"},
    {"tree",
     "height: 5, crown: {growth: {levels: [{attractors: 99}, {attractors: 99, kill: 1e-30}]}}", 4,
     90, "level 2: kill is "},
    {"lightning", "height: 1e-30", 4, 5, "step is "},
    {"lightning", "step: 1e-30", 4, 23, "segments of 1e-30 m"},
    {"lightning", "segment: 1e-9", 4, 26, "segments of 1e-09 m"},
    {"terrain", "size: 1e-30", 4, 5, "step is "},
    {"terrain", "uplift: {image: junk.png}", 4, 31, "junk.png"},
    // trees of rivers and ridges; in SWC files the line there
    {"terrain", "rivers: {image: junk.png}", 4, 31, "junk.png"},
    {"terrain", "form: ridges, ridges: {image: junk.png}", 4, 45, "junk.png"},
    {"terrain", "form: map, map: {image: junk.png}", 4, 39, "junk.png"},
    {"terrain", "form: ridges, ridges: {file: word.swc}", 2, 0, "is no number"},
    {"terrain", "form: ridges, ridges: {file: junk.png}", 1, 0, "is no number"},
    {"terrain", "rivers: {file: short.swc}", 2, 0, "has only 4 numbers"},
    {"terrain", "size: 100, rivers: {file: away.swc}", 4, 41, "has no node within"},
    {"dla", "size: 1e-30", 4, 5, "a voxel of"},
    // L-systems
    {"lsystem", "axiom: A", 4, 5, "draws nothing"},
    {"lsystem", "axiom: F, rules: 'F -> FF', generations: 60", 4, 56, "generation 22"},
    {"lsystem", "axiom: F, rules: 'F -> '", 4, 5, "draws nothing"},
    {"coral", "axiom: 'f'", 4, 20, "jumps"},
    {"coral", "axiom: ']'", 4, 20, "closes no"},
    {"coral", "axiom: '['", 4, 20, "is not closed"},
    {"coral", "axiom: '$'", 4, 20, "asks for the vertical"},
    {"coral", "axiom: 'F(0)'", 4, 20, "must be above 0"},
    {"coral", "axiom: A", 4, 20, "has no F"},
    {"coral", "axiom: F, rules: 'F -> FF', generations: 40", 4, 54, "generation 22"},
    // traced skeletons: the line in their own file, where there is one
    {"skeleton", "file: empty.swc", 4, 22, "no node in it"},
    {"skeleton", "file: word.swc", 2, 0, "is no number"},
    {"skeleton", "file: short.swc", 2, 0, "has only 4 numbers"},
    {"skeleton", "file: orphan.swc", 2, 0, "is no node"},
    {"skeleton", "file: far.swc, scale: 1e9", 4, 38, "reaches farther"},
    {"skeleton", "file: far.swc, basal: false", 4, 5, "are hidden"},
    // maps that the land does not have
    {"scatter", "things: [{stone: {}}], where: [{map: snow, range: [0, 1]}]", 4, 46,
     "no map 'snow'; it needs a terrain of form alps or volcano"},
};

typedef struct SceneText {
    const char *text; // after an object `ball` in line 1
    int line, column;
    const char *says;
} SceneText;

static const SceneText scenes[] = {
    {"materials: [{name: m, texture: junk.png}]\n", 2, 32, "junk.png"},
    {"materials: [{name: l}, {name: m, alpha_texture: junk.png}]\n", 2, 49, "junk.png"},
    {"materials: [{name: x}, {name: m, layers: [{material: x, where: [{map: slope, range: [0, "
     "9]},\n"
     "  {map: deposit, range: [0, 1]}]}]}]\n",
     3, 3, "layer 1 of material 'm' on object 'ball': the land has no map 'deposit'; it needs a"},
    {"sky: {kind: environment, file: junk.hdr}\n", 2, 32, "junk.hdr"},
    {"sky: {kind: environment, file: junk.png}\n", 2, 32, "junk.png"},
};

static void write_files(Fixture *fixture)
{
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        fixture_write(fixture, files[i].name, files[i].text, strlen(files[i].text));
    }
}

// All that `ramify render` does before the first pixel.
static bool prepare(const RamifyScene *scene, RamifyError *e)
{
    RamifyRun run = {.threads = 1};
    RamifyWorld *world = ramify_build(scene, &run, e);
    RamifyRenderer *renderer = world ? ramify_renderer_new(world, NULL, &run, e) : NULL;
    bool done = renderer;
    ramify_renderer_free(renderer);
    ramify_world_free(world);
    return done;
}

// 1 with complaints when the error has no place, or another one.
static int judge(const char *text, const RamifyError *e, int line, int column, const char *says)
{
    bool placed = e->file[0] && e->line > 0;
    bool there = line == 0 || (e->line == line && e->column == column);
    if (placed && there && strstr(e->message, says)) {
        return 0;
    }
    char said[1200];
    ramify_error_format(e, said, sizeof said);
    print_error("%s\n  said   %s\n  wanted line %d, column %d, %s\n", text, said, line, column,
                says);
    return 1;
}

static int refuse(Fixture *fixture, const char *text, int line, int column, const char *says)
{
    RamifyError e = {0};
    RamifyScene *scene =
        ramify_scene_load_text(text, strlen(text), "s.yaml", fixture->folder, NULL, 0, &e);
    if (!scene) {
        print_error("%s\n  refused when read: %s\n", text, e.message);
        return 1;
    }
    int wrong = 1;
    if (prepare(scene, &e)) {
        print_error("%s\n  not refused\n", text);
    } else {
        wrong = judge(text, &e, line, column, says);
    }
    ramify_scene_free(scene);
    return wrong;
}

static void late_refusals_name_their_place(void **state)
{
    int wrong = 0;
    write_files(*state);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        char text[512];
        const Place *p = &places[i];
        snprintf(text, sizeof text, "seed: 3\nobjects:\n  - name: x\n    %s: {%s}\n", p->kind,
                 p->keys);
        wrong += refuse(*state, text, p->line, p->column, p->says);
    }
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "objects: [{name: ball, shape: {envelope: [{shape: sphere}]}%s}]\n%s",
                 strstr(scenes[i].text, "name: m") ? ", material: m" : "", scenes[i].text);
        wrong += refuse(*state, text, scenes[i].line, scenes[i].column, scenes[i].says);
    }
    assert_int_equal(wrong, 0);
}

// What an override says is blamed on the override.
static void overrides_are_blamed(void **state)
{
    (void)state;
    static const char text[] = "objects:\n  - name: x\n    dla: {particles: 5}\n";
    const char *set = "objects.x.dla.size=1e-30";
    RamifyError e = {0};
    RamifyScene *scene = ramify_scene_load_text(text, strlen(text), "s.yaml", "", &set, 1, &e);
    assert_non_null(scene);
    assert_false(prepare(scene, &e));
    assert_string_equal(e.file, "s.yaml"); // no key of its own: the object
    assert_int_equal(e.line, 3);
    ramify_scene_free(scene);

    set = "objects.x={name: x, skeleton: {file: /nope.swc}}";
    assert_null(ramify_scene_load_text(text, strlen(text), "s.yaml", "", &set, 1, &e));
    set = "objects.x.dla={size: 1e-30}";
    scene = ramify_scene_load_text(text, strlen(text), "s.yaml", "", &set, 1, &e);
    assert_non_null(scene);
    assert_false(prepare(scene, &e));
    assert_string_equal(e.file, "override objects.x.dla={size: 1e-30}");
    ramify_scene_free(scene);
}

// Measures and growth alone, too.
static void measures_name_their_place(void **state)
{
    (void)state;
    static const char text[] = "objects:\n  - name: x\n    lsystem: {axiom: A}\n";
    RamifyError e = {0};
    RamifyScene *scene = ramify_scene_load_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    assert_non_null(scene);
    assert_null(ramify_measure(scene, 0, NULL, &e));
    assert_int_equal(judge(text, &e, 3, 5, "object 'x': the string draws nothing"), 0);
    e = (RamifyError){0};
    assert_null(ramify_grow(scene, 0, NULL, &e));
    assert_int_equal(judge(text, &e, 3, 5, "object 'x': the string draws nothing"), 0);
    ramify_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(late_refusals_name_their_place, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test(overrides_are_blamed),
        cmocka_unit_test(measures_name_their_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
