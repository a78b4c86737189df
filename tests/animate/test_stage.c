// What of the geometry is made again from frame to frame, and that it is what a new build makes.
#include "film_fixture.h"

#include "animate/stage.h"
#include "render/world.h"

static Film *shoot_one(Stage *stage, Scene *scene)
{
    Run run = run_default();
    Error e = {0};
    RenderStats stats;
    Film *film = film_new(scene->film.width, scene->film.height, NULL);
    if (!stage_set(stage, scene, &run, &e) || !stage_render(stage, film, &run, &stats, &e)) {
        fail_msg("%s", e.message);
    }
    return film;
}

static Film *shoot_afresh(Scene *scene)
{
    Stage *stage = stage_new(&scene->camera, NULL, false, NULL);
    Film *film = shoot_one(stage, scene);
    stage_free(stage);
    return film;
}

static double mean_difference(const Film *a, const Film *b)
{
    double sum = 0.0;
    for (int i = 0; i < a->width * a->height; i++) {
        sum += (double)vec3_distance(a->color[i], b->color[i]);
    }
    return sum / (a->width * a->height);
}

// The table turns by 90 degrees: the picture is that of the scene with its object turned by hand.
static void spin_is_the_object_turned(void **state)
{
    (void)state;
    const char *sky = "sky: {kind: sun_sky, clouds: 0.5, sun_azimuth: 10}\n"
                      "lights: [{kind: quad, corner: [-2, 3, 1], radiance: 4}]\n";
    Scene *scene = read_scene(sky, BALL);
    // about the vertical x = 0.5: x - 0.5 = 0.5 becomes z = 0.5
    Scene *by_hand = read_scene(sky, "objects:\n"
                                     "  - name: ball\n"
                                     "    shape: {envelope: [{shape: box, size: [0.5, 1, 0.2], "
                                     "position: [0.5, 1, 0.5], rotation: [0, 90, 0]}]}\n");
    TurntableParams params = turntable_params_default();
    params.frames = 4;
    params.spin = true;
    Turntable *t = make_turntable(scene, &params);
    Stage *stage = stage_new(&scene->camera, NULL, false, NULL);
    Film *still = shoot_one(stage, frame_of(t, 0)), *wanted = shoot_afresh(by_hand);
    Film *turned = shoot_one(stage, frame_of(t, 1)); // the camera's way is against the table's
    stage_free(stage);
    double off = mean_difference(turned, wanted), moved = mean_difference(still, wanted);
    if (!(off < 0.15 * moved)) { // other voxels, and noise
        fail_msg("turned by the table: %g off, of %g that it moved", off, moved);
    }
    film_free(still);
    film_free(wanted);
    film_free(turned);
    turntable_free(t);
    scene_free(scene);
}

static void geometry_is_made_once(void **state)
{
    (void)state;
    Scene *scene = read_scene(
        "sky: {kind: sun_sky}\n"
        "materials: [{name: clay, color: 0.5}]\n"
        "animation:\n"
        "  frames: 6\n"
        "  tracks: [{path: materials.clay.color, keys: [{at: 0, value: 0.2}, {at: 0.9, value: "
        "0.6}]}]\n",
        "objects:\n"
        "  - name: bush\n"
        "    tree: {height: 2, crown: {lobes: 0, growth: {levels: [{attractors: 200}]}}, leaves: "
        "{max_count: 100}}\n"
        "  - name: stone\n"
        "    shape: {envelope: [{shape: sphere, size: 0.3}]}\n"
        "    material: clay\n");
    TurntableParams params = turntable_params_default();
    params.spin = true;
    params.sun = (TurnValues){{8, 12}, 2};
    Turntable *t = make_turntable(scene, &params);
    Stage *stage = stage_new(&scene->camera, NULL, false, NULL);
    film_free(shoot_one(stage, frame_of(t, 0)));
    for (int i = 2; i < 6; i += 3) {
        Film *film = shoot_one(stage, frame_of(t, i)), *fresh = shoot_afresh(frame_of(t, i));
        assert_memory_equal(film->color, fresh->color, sizeof(Vec3) * FILM_WIDTH * FILM_HEIGHT);
        film_free(film);
        film_free(fresh);
    }
    assert_int_equal(stage_stats(stage)->geometries, 1);
    assert_int_equal(stage_stats(stage)->structures, 1);
    stage_free(stage);
    turntable_free(t);
    scene_free(scene);
}

// A material's layers and its scale of colours are still those of the first frame when a later one
// shows the same materials, although each frame is a scene of its own.
static void layers_and_colours_last(void **state)
{
    (void)state;
    Scene *scene = read_scene(
        "sky: {kind: sun_sky}\n"
        "materials:\n"
        "  - {name: turf, kind: diffuse, color: [0.02, 0.7, 0.02]}\n"
        "  - {name: rock, color: 0.3, layers: [{material: turf, fray: 2, where: [{map: slope, "
        "range: [0, 20], fade: 5}]}]}\n"
        "  - {name: map, pattern: altitude, colors: [{at: 0, color: 0.1}, {at: 1, color: [0.9, 0, "
        "0]}]}\n",
        "objects:\n"
        "  - name: land\n"
        "    material: rock\n"
        "    terrain: {form: noise, size: 8, relief: 2, resolution: 32, beyond: 0}\n"
        "  - name: chart\n"
        "    material: map\n"
        "    terrain: {form: noise, size: 8, relief: 2, resolution: 32, beyond: 0, position: [0, "
        "4, "
        "-4], show: map}\n");
    TurntableParams params = turntable_params_default();
    params.frames = 4;
    params.turns = 0.0; // detail of land is that of the first view
    Turntable *t = make_turntable(scene, &params);
    Stage *stage = stage_new(&scene->camera, NULL, false, NULL);
    film_free(shoot_one(stage, frame_of(t, 0)));
    for (int i = 1; i < 4; i++) {
        Film *film = shoot_one(stage, frame_of(t, i)), *fresh = shoot_afresh(frame_of(t, i));
        assert_memory_equal(film->color, fresh->color, sizeof(Vec3) * FILM_WIDTH * FILM_HEIGHT);
        film_free(film);
        film_free(fresh);
    }
    assert_int_equal(stage_stats(stage)->geometries, 1);
    stage_free(stage);
    turntable_free(t);
    scene_free(scene);
}

// ---- growth

static bool same_array(const void *a, const void *b, size_t size, int64_t count)
{
    return (!a && !b) || (a && b && memcmp(a, b, size * (size_t)count) == 0);
}

static bool same_mesh(const Mesh *a, const Mesh *b)
{
    int64_t n = a->vertex_count;
    return n == b->vertex_count && a->face_count == b->face_count && a->face_size == b->face_size &&
           same_array(a->index, b->index, sizeof *a->index, a->face_count * a->face_size) &&
           same_array(a->position, b->position, sizeof(Vec3), n) &&
           same_array(a->radius, b->radius, sizeof(float), n) &&
           same_array(a->birth, b->birth, sizeof(float), n);
}

static bool same_curves(const CurveSet *a, const CurveSet *b)
{
    int64_t n = a->point_count;
    return n == b->point_count && a->curve_count == b->curve_count &&
           same_array(a->position, b->position, sizeof(Vec3), n) &&
           same_array(a->radius, b->radius, sizeof(float), n) &&
           same_array(a->birth, b->birth, sizeof(float), n) &&
           same_array(a->glow, b->glow, sizeof(float), n);
}

static bool same_part(const Part *p, const Part *q)
{
    return p->kind == q->kind && p->object == q->object && p->material == q->material &&
           p->instance_count == q->instance_count &&
           same_array(p->instance, q->instance, sizeof *p->instance, p->instance_count) &&
           (p->mesh ? same_mesh(p->mesh, q->mesh) : same_curves(p->curves, q->curves));
}

static bool same_geometry(const Geometry *a, const Geometry *b)
{
    bool same = a->count == b->count;
    for (int64_t i = 0; same && i < a->count; i++) {
        same = same_part(&a->part[i], &b->part[i]);
    }
    return same;
}

// Counts what is told while something grows.
static void count_growth(void *user, const char *stage, double done)
{
    static const char *const stages[] = {"grow", "aggregate", "veins", "vessels"};
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++) {
        *(int *)user += strcmp(stage, stages[i]) == 0;
    }
    (void)done;
}

// Objects that are shown at another time of their growth remember it, do not grow again, and are
// bit for bit what growing them anew gives.
static void growth_is_remembered(void **state)
{
    (void)state;
    const char *const objects[] = {
        "tree: {height: 2, crown: {lobes: 0, growth: {levels: [{attractors: 120}]}}, roots: "
        "{count: "
        "3}, leaves: {max_count: 50}}",
        "forest: {stands: 2, stand_trees: 2, height: 8, ferns: 10, leaves: {max_count: 50}}",
        "lightning: {height: 10, bolts: 2}",
        "lightning: {points: {place: surface}, envelope: [{shape: sphere, size: 1}]}",
        "coral: {attractors: 60}",
        "lsystem: {generations: 3}",
        "frost: {surface: pane, spines: 40, sides: 200}",
        "dla: {particles: 150}",
        "sculpture: {attractors: 20}",
        "venation: {}",
        "vessels: {terminals: 30, envelope: [{shape: sphere, size: 0.1}]}",
        "terrain: {resolution: 64, rivers: {count: 200}}"};
    const float shares[] = {0.6f, 1.0f, 0.3f};
    int tell = 0; // builds from nothing that said so
    for (size_t i = 0; i < sizeof objects / sizeof objects[0]; i++) {
        char text[1024];
        snprintf(text, sizeof text, "objects:\n  - name: a\n    %s\n", objects[i]);
        Scene *scene = read_scene("", text);
        SceneBuilder *builder = scene_builder_new(true, NULL);
        Run run = run_default();
        int told = 0, told_first = 0;
        run.progress = count_growth;
        run.user = &told;
        for (int k = 0; k < 3; k++) {
            Error e = {0};
            BuildStats stats = {0}, fresh = {0};
            scene->grow_to = shares[k];
            const World *world = scene_builder_build(builder, scene, &run, &stats, &e);
            told_first = k == 0 ? told : told_first;
            if (told != told_first) {
                fail_msg("%s grows again", objects[i]);
            }
            World *anew = scene_build(scene, &run, &fresh, &e);
            if (!world || !anew) {
                fail_msg("%s: %s", objects[i], e.message);
            }
            if (!same_geometry(&world->geometry, &anew->geometry)) {
                fail_msg("%s at %g is not what a new build makes", objects[i], (double)shares[k]);
            }
            tell += told > told_first;
            told = told_first;
            assert_int_equal(stats.nodes, fresh.nodes);
            assert_true(stats.nodes > 0);
            assert_true(scene_builder_fits(builder, scene));
            world_free(anew);
        }
        scene_builder_free(builder);
        scene_free(scene);
    }
    assert_true(tell >= 20);
}

static void only_the_changed_object_is_made_again(void **state)
{
    (void)state;
    Scene *scene = read_scene("", "objects:\n"
                                  "  - name: a\n"
                                  "    shape: {envelope: [{shape: sphere, size: 1}]}\n"
                                  "  - name: b\n"
                                  "    lsystem: {generations: 3}\n");
    SceneBuilder *builder = scene_builder_new(false, NULL);
    Run run = run_default();
    BuildStats stats = {0};
    const World *world = scene_builder_build(builder, scene, &run, &stats, NULL);
    assert_non_null(world);
    const Mesh *ball = world->geometry.part[0].mesh;
    int64_t nodes = stats.nodes;
    SceneChange change = {"objects.b.lsystem.generations", "4", "a test", 0, 0};
    Scene *later = scene_changed(scene, &change, 1, NULL);
    assert_non_null(later);
    assert_false(scene_builder_fits(builder, later));
    world = scene_builder_build(builder, later, &run, &stats, NULL);
    assert_ptr_equal(world->geometry.part[0].mesh, ball); // moved, not made
    assert_true(stats.nodes > 2 * nodes);
    scene_builder_free(builder);
    scene_free(scene);
    scene_free(later);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spin_is_the_object_turned),
        cmocka_unit_test(geometry_is_made_once),
        cmocka_unit_test(layers_and_colours_last),
        cmocka_unit_test(growth_is_remembered),
        cmocka_unit_test(only_the_changed_object_is_made_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
