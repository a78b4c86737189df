// What frames show: the camera's orbit, keys of the turntable, the sun's day, tracks of any value.
#include "film_fixture.h"
#include "render/material/material.h"

static void the_camera_orbits_its_target(void **state)
{
    (void)state;
    Scene *scene = read_scene("", BALL);
    TurntableParams params = turntable_params_default();
    params.frames = 8;
    Turntable *t = make_turntable(scene, &params);
    Vec3 offset = vec3_sub(scene->camera.position, scene->camera.target);
    double level = hypot((double)offset.x, (double)offset.z);
    double azimuth = atan2((double)offset.x, (double)offset.z);
    for (int i = 0; i < 8; i++) {
        Scene *now = frame_of(t, i);
        Vec3 p = vec3_sub(now->camera.position, now->camera.target);
        double turned = azimuth + i * (double)PI_F / 4.0;
        ASSERT_CLOSE(p.x, level * sin(turned), 1e-5);
        ASSERT_CLOSE(p.z, level * cos(turned), 1e-5);
        ASSERT_CLOSE(p.y, offset.y, 1e-6);
        assert_memory_equal(&now->camera.target, &scene->camera.target, sizeof(Vec3));
        if (i == 0) { // the first frame is the scene's own picture
            assert_memory_equal(&now->camera, &scene->camera, sizeof scene->camera);
        }
        scene_free(now);
    }
    turntable_free(t);
    scene_free(scene);
}

static void elevation_and_dolly_have_keys(void **state)
{
    (void)state;
    Scene *scene = read_scene("", BALL);
    TurntableParams params = turntable_params_default();
    params.frames = 5;
    params.turns = 0.0;
    params.elevation = (TurnValues){{10, 50}, 2}; // open: ends on its last value
    params.dolly = (TurnValues){{1, 0.5, 1}, 3};  // closed: frame 5 would be frame 0
    params.ease = EASE_LINEAR;
    Turntable *t = make_turntable(scene, &params);
    double distance = (double)vec3_distance(scene->camera.position, scene->camera.target);
    const double elevation[] = {10, 20, 30, 40, 50}, factor[] = {1, 0.8, 0.6, 0.6, 0.8};
    for (int i = 0; i < 5; i++) {
        Scene *now = frame_of(t, i);
        Vec3 p = vec3_sub(now->camera.position, now->camera.target);
        ASSERT_CLOSE(vec3_length(p), factor[i] * distance, 1e-5);
        ASSERT_CLOSE(asinf(p.y / vec3_length(p)) / RADIANS_PER_DEGREE, elevation[i], 1e-3);
        scene_free(now);
    }
    turntable_free(t);
    scene_free(scene);
}

static void the_sun_goes_its_way(void **state)
{
    (void)state;
    const double radian = 3.14159265358979323846 / 180.0;
    double elevation, azimuth, evening;
    sun_place(12.0, &elevation, &azimuth);
    ASSERT_CLOSE(elevation, 90.0 - 48.0 + 18.5, 1e-9); // culmination
    ASSERT_CLOSE(azimuth, 0.0, 1e-9);
    sun_place(6.0, &elevation, &azimuth);
    ASSERT_CLOSE(sin(elevation * radian), sin(48.0 * radian) * sin(18.5 * radian), 1e-9);
    assert_true(azimuth > 90.0 && azimuth < 115.0); // north of east, in May
    sun_place(18.0, &elevation, &evening);
    ASSERT_CLOSE(evening, -azimuth, 1e-9);
}

static void params_out_of_range_are_refused(void **state)
{
    (void)state;
    Scene *scene = read_scene("sky: {kind: constant}\n", BALL);
    const struct {
        TurntableParams params;
        const char *says;
    } cases[] = {{{.elevation = {{0, 90}, 2}}, "elevation has 90"},
                 {{.dolly = {{0}, 1}}, "dolly has 0"},
                 {{.grow = {{0, 1.5}, 2}}, "grow has 1.5"},
                 {{.sun = {{5, 19}, 2}}, "kind must be sun_sky"},
                 {{.turns = 1e9}, "turns"},
                 {{.frames = -3}, "-3 frames"},
                 {{.fps = -1}, "frames a second"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Error e = {0};
        assert_null(turntable_new(scene, &cases[i].params, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        if (!strstr(e.message, cases[i].says)) {
            fail_msg("'%s' does not say '%s'", e.message, cases[i].says);
        }
    }
    scene_free(scene);
}

static void tracks_change_any_value(void **state)
{
    (void)state;
    Scene *scene = read_scene(
        "sky: {kind: sun_sky}\n"
        "materials: [{name: paint, color: [1, 0, 0]}]\n"
        "animation:\n"
        "  frames: 4\n"
        "  tracks:\n"
        "    - {path: camera.position, keys: [{at: 0, value: [0, 0, 4]}, {at: 0.5, value: [0, 2, "
        "8]}]}\n"
        "    - {path: materials.paint.color, keys: [{at: 0, value: \"#ff0000\"}, {at: 0.5, value: "
        "\"#0000ff\"}]}\n"
        "    - {path: film.view, keys: [{at: 0, value: standard}, {at: 0.5, value: filmic}]}\n"
        "    - {path: render.samples, keys: [{at: 0, value: 4}, {at: 0.5, value: 7}]}\n"
        "    - {path: sky.visible, keys: [{at: 0, value: false}, {at: 0.5, value: true}]}\n",
        BALL);
    TurntableParams params = turntable_params_default();
    Turntable *t = make_turntable(scene, &params);
    assert_int_equal(turntable_frames(t), 4);
    Scene *now = frame_of(t, 1); // half way to the second keys; no orbit beside an animation
    ASSERT_CLOSE(now->camera.position.y, 1.0, 1e-6);
    ASSERT_CLOSE(now->camera.position.z, 6.0, 1e-6);
    ASSERT_CLOSE(now->materials[0].color.x, 0.5, 1e-6);
    ASSERT_CLOSE(now->materials[0].color.z, 0.5, 1e-6);
    assert_int_equal(now->tone.view, VIEW_STANDARD);
    assert_int_equal(now->render.samples, 6); // 5.5, and samples are whole
    assert_false(now->sky.visible);
    scene_free(now);
    now = frame_of(t, 3); // and half way back
    ASSERT_CLOSE(now->camera.position.z, 6.0, 1e-6);
    assert_int_equal(now->tone.view, VIEW_FILMIC);
    assert_true(now->sky.visible);
    scene_free(now);
    now = turntable_scene_at(t, 0.5, NULL);
    ASSERT_CLOSE(now->camera.position.z, 8.0, 1e-6);
    scene_free(now);
    turntable_free(t);
    scene_free(scene);
}

static void tracks_that_ask_for_nonsense_name_their_line(void **state)
{
    (void)state;
    const struct {
        const char *track, *says;
    } cases[] = {{"{path: camera.fow, keys: [{at: 0, value: 3}]}", "unknown key 'fow'"},
                 {"{path: camera.fov, keys: [{at: 0, value: 300}]}", "camera.fov is 300"},
                 {"{path: camera.position, keys: [{at: 0, value: 2}]}", "a list of 3 numbers"},
                 {"{path: objects.tree.shape, keys: [{at: 0, value: 2}]}", "no entry named 'tree'"},
                 {"{path: camera..fov, keys: [{at: 0, value: 2}]}", "empty name"},
                 {"{path: film.view, keys: [{at: 0, value: soft}]}", "film.view is 'soft'"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char middle[512];
        snprintf(middle, sizeof middle, "animation:\n  tracks:\n    - %s\n", cases[i].track);
        Scene *scene = read_scene(middle, BALL);
        TurntableParams params = turntable_params_default();
        Turntable *t = make_turntable(scene, &params);
        Error e = {0};
        assert_null(turntable_scene(t, 2, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, "s.yaml");
        assert_int_equal(e.line, 8);
        assert_int_equal(strncmp(e.message, "frame 2: ", 9), 0);
        if (!strstr(e.message, cases[i].says)) {
            fail_msg("'%s' does not say '%s'", e.message, cases[i].says);
        }
        turntable_free(t);
        scene_free(scene);
    }
}

static void a_frame_says_all_of_itself(void **state)
{
    (void)state;
    Scene *scene = read_scene("sky: {kind: sun_sky, sun_azimuth: 5}\n", BALL);
    TurntableParams params = turntable_params_default();
    params.spin = true;
    params.grow = (TurnValues){{0, 1}, 2};
    Turntable *t = make_turntable(scene, &params);
    Scene *now = frame_of(t, 18); // its settings, read as a scene of its own, are the same scene
    Scene *again =
        scene_read_text(now->resolved, strlen(now->resolved), "again.yaml", "", NULL, 0, NULL);
    assert_non_null(again);
    assert_string_equal(now->resolved, again->resolved);
    ASSERT_CLOSE(again->sky.rotation, 90.0, 1e-4);
    ASSERT_CLOSE(again->grow_to, 18.0 / 71.0, 1e-6);
    scene_free(now);
    scene_free(again);
    turntable_free(t);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_camera_orbits_its_target),
        cmocka_unit_test(elevation_and_dolly_have_keys),
        cmocka_unit_test(the_sun_goes_its_way),
        cmocka_unit_test(params_out_of_range_are_refused),
        cmocka_unit_test(tracks_change_any_value),
        cmocka_unit_test(tracks_that_ask_for_nonsense_name_their_line),
        cmocka_unit_test(a_frame_says_all_of_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
