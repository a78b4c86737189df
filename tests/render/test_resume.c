// A rendering that is cut short anywhere and goes on later makes the bits of one without a break,
// with any number of threads, with and without a limit of noise; calls within a pass change
// nothing.
#include "render/integrator.h"
#include "tiny_world.h"

#include <math.h>

enum { WIDTH = 50, HEIGHT = 37, SAMPLES = 40 };

// Cancels when it has been asked a number of times: at another pixel in every run.
typedef struct Breaks {
    volatile int cancelled;
    int reports, limit;
} Breaks;

static void break_off(void *user, const char *stage, double done)
{
    Breaks *breaks = user;
    (void)stage, (void)done;
    breaks->cancelled = ++breaks->reports >= breaks->limit;
}

static World *scene(float max_noise)
{
    World *world = tiny_world(WIDTH, HEIGHT, SAMPLES, 0.6f);
    world->sky.kind = SKY_SUN_SKY;
    world->render.max_noise = max_noise;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 0.8f, 12, true), 0, 0);
    add_mesh(world, quad_mesh(vec3(-4, -1, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 1);
    return world;
}

static void assert_same_planes(const Film *a, const Film *b)
{
    FilmPlane of_a[FILM_PLANES], of_b[FILM_PLANES];
    film_planes(a, of_a);
    film_planes(b, of_b);
    for (int i = 0; i < FILM_PLANES; i++) {
        size_t bytes = sizeof(float) * strlen(of_a[i].channels) * WIDTH * HEIGHT;
        if (memcmp(of_a[i].value, of_b[i].value, bytes) != 0) {
            fail_msg("plane %s differs", of_a[i].layer);
        }
    }
}

static Film *render_at_once(Renderer *renderer)
{
    Run run = run_default();
    RenderStats stats;
    Film *film = film_new(WIDTH, HEIGHT, NULL);
    assert_non_null(film);
    assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, NULL));
    return film;
}

// As many runs as it takes, each cut short after some reports. Tiles that earlier runs have
// finished report too, so the limit grows: the last runs reach the end without help by other
// threads. Returns their number.
static int render_in_pieces(Renderer *renderer, Film *film)
{
    int runs = 0;
    for (bool done = false; !done; runs++) {
        assert_true(runs < 1000);
        Breaks breaks = {.limit = 1 + runs * 7 % 5 + runs / 4};
        Run run = run_default();
        run.threads = 1 + runs % 3;
        run.cancelled = &breaks.cancelled;
        run.progress = break_off;
        run.user = &breaks;
        RenderStats stats;
        Error e = {0};
        if (!renderer_resume(renderer, film, &run, NULL, 0.0, NULL, &stats, &e)) {
            assert_int_equal(e.code, ERROR_CANCELLED);
        }
        done = !breaks.cancelled;
    }
    return runs;
}

static void breaks_change_no_bit(void **state)
{
    (void)state;
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        World *world = scene(adaptive ? 0.06f : 0.0f);
        Run run = run_default();
        Renderer *renderer = renderer_new(world, "sse4.2", &run, NULL);
        assert_non_null(renderer);
        Film *whole = render_at_once(renderer), *pieces = film_new(WIDTH, HEIGHT, NULL);
        assert_non_null(pieces);
        assert_true(render_in_pieces(renderer, pieces) > 5);
        assert_same_planes(whole, pieces);
        film_free(whole);
        film_free(pieces);
        renderer_free(renderer);
        world_free(world);
    }
}

static void count_call(void *user, const Film *film, int samples)
{
    int *calls = user;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(film->samples[i] >= (float)samples && film->samples[i] <= SAMPLES);
    }
    (*calls)++;
}

// A call is due after every tile.
static void calls_within_passes_change_no_bit(void **state)
{
    (void)state;
    World *world = scene(0.0f);
    Run run = run_default();
    run.threads = 2;
    Renderer *renderer = renderer_new(world, "sse4.2", &run, NULL);
    assert_non_null(renderer);
    Film *whole = render_at_once(renderer), *film = film_new(WIDTH, HEIGHT, NULL);
    assert_non_null(film);
    int calls = 0;
    RenderStats stats;
    assert_true(renderer_resume(renderer, film, &run, count_call, 1e-9, &calls, &stats, NULL));
    assert_true(calls > 10);
    assert_same_planes(whole, film);
    // nothing is left to do
    calls = 0;
    assert_true(renderer_resume(renderer, film, &run, count_call, 0.0, &calls, &stats, NULL));
    assert_int_equal(stats.paths, 0);
    assert_int_equal(calls, 0);
    assert_same_planes(whole, film);
    film_free(whole);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

// Samples added later are others than the first: the mean moves, the error shrinks.
static void added_samples_go_on(void **state)
{
    (void)state;
    World *world = scene(0.0f);
    Run run = run_default();
    Renderer *renderer = renderer_new(world, "sse4.2", &run, NULL);
    assert_non_null(renderer);
    Film *film = render_at_once(renderer);
    double before = 0.0, after = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        before += (double)film->variance[i];
    }
    world->render.planned_samples = SAMPLES;
    world->render.samples = 3 * SAMPLES;
    RenderStats stats;
    assert_true(renderer_resume(renderer, film, &run, NULL, 0.0, NULL, &stats, NULL));
    assert_int_equal(stats.paths, 2 * SAMPLES * WIDTH * HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        after += (double)film->variance[i];
        assert_true(film->samples[i] == 3.0f * SAMPLES);
    }
    assert_true(after > 0.2 * before && after < 0.5 * before); // a third
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

// Replayed samples are those of the picture, and a path's rays bring together what it adds.
static void replayed_paths_make_the_picture(void **state)
{
    (void)state;
    enum { MOST = 64, PIXEL_X = 24, PIXEL_Y = 20 };
    World *world = scene(0.0f);
    Run run = run_default();
    Renderer *renderer = renderer_new(world, "sse4.2", &run, NULL);
    assert_non_null(renderer);
    Film *film = render_at_once(renderer);
    double sum[3] = {0};
    for (int k = 0; k < SAMPLES; k++) {
        PathStep step[MOST];
        Vec3 color, light = vec3_splat(0.0f);
        int steps = renderer_replay(renderer, PIXEL_X, PIXEL_Y, k, step, MOST, &color, NULL);
        assert_true(steps >= 1 && steps < MOST);
        assert_int_equal(step[0].end, STEP_SURFACE);
        assert_int_equal(step[0].object, 0); // the ball, in the middle
        for (int i = 0; i < steps; i++) {
            light = vec3_add(light, step[i].light);
            if (i + 1 < steps) { // one ray begins where the last has ended
                assert_true(vec3_distance(step[i].position, step[i + 1].origin) < 0.05f);
            }
        }
        assert_true(vec3_distance(light, color) <= 1e-4f * (1.0f + vec3_length(color)));
        sum[0] += (double)color.x;
        sum[1] += (double)color.y;
        sum[2] += (double)color.z;
    }
    Vec3 mean = film->color[PIXEL_Y * WIDTH + PIXEL_X];
    assert_true(fabs(sum[0] / SAMPLES - (double)mean.x) < 1e-6 * (1.0 + (double)mean.x));
    assert_true(fabs(sum[1] / SAMPLES - (double)mean.y) < 1e-6 * (1.0 + (double)mean.y));
    assert_true(fabs(sum[2] / SAMPLES - (double)mean.z) < 1e-6 * (1.0 + (double)mean.z));
    Vec3 color;
    Error e = {0};
    assert_int_equal(renderer_replay(renderer, WIDTH, 0, 0, NULL, 0, &color, &e), -1);
    assert_int_equal(e.code, ERROR_INPUT);
    assert_int_equal(renderer_replay(renderer, 0, 0, SAMPLES, NULL, 0, &color, NULL), -1);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(breaks_change_no_bit),
        cmocka_unit_test(calls_within_passes_change_no_bit),
        cmocka_unit_test(added_samples_go_on),
        cmocka_unit_test(replayed_paths_make_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
