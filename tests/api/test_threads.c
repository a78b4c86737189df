// The library from several threads at once: scenes of their own, and one scene that all read, give
// what they give alone; callbacks get their own user; one can be cancelled without the others.
#include "ramify.h"
#include "testing.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { THREADS = 2, WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT };

static const char text[] =
    "camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}\n"
    "film: {width: 24, height: 16}\n"
    "render: {samples: 2, max_depth: 2}\n"
    "sky: {kind: constant, color: 1}\n"
    "objects:\n"
    "  - name: bush\n"
    "    tree: {height: 3, leaves: {max_count: 100}, crown: {lobes: 1, growth: {levels: "
    "[{attractors: 60}, {attractors: 300}]}}}\n";

static RamifyScene *load(int seed, RamifyError *error)
{
    char override[40];
    snprintf(override, sizeof override, "seed=%d", seed);
    const char *const overrides[] = {override};
    return ramify_scene_load_text(text, strlen(text), "threads", "", overrides, 1, error);
}

// What one thread is to do, and what came of it.
typedef struct Work {
    RamifyScene *scene; // shared; NULL = one of its own
    int seed, reports;
    const volatile int *cancelled;
    bool done;
    RamifyError error;
    uint64_t hash;
    float rgba[4 * PIXELS];
} Work;

static void count_report(void *user, const char *stage, double done)
{
    (void)stage;
    (void)done;
    ((Work *)user)->reports++;
}

static void *work(void *user)
{
    Work *w = user;
    RamifyRun run = {.threads = 2, .cancelled = w->cancelled, .progress = count_report, .user = w};
    RamifyScene *own = w->scene ? NULL : load(w->seed, &w->error);
    const RamifyScene *scene = own ? own : w->scene;
    RamifyTree *tree = scene ? ramify_grow(scene, 0, &run, &w->error) : NULL;
    w->hash = tree ? ramify_tree_hash(tree) : 0;
    w->done = tree && ramify_render(scene, w->rgba, NULL, &run, &w->error);
    ramify_tree_free(tree);
    ramify_scene_free(own);
    return NULL;
}

static void work_at_once(Work *all, int count)
{
    pthread_t thread[THREADS];
    for (int i = 0; i < count; i++) {
        assert_int_equal(pthread_create(&thread[i], NULL, work, &all[i]), 0);
    }
    for (int i = 0; i < count; i++) {
        assert_int_equal(pthread_join(thread[i], NULL), 0);
    }
}

static void assert_same(const Work *a, const Work *b)
{
    assert_true(a->done && b->done);
    assert_true(a->hash == b->hash);
    assert_memory_equal(a->rgba, b->rgba, sizeof a->rgba);
}

static void scenes_of_their_own(void **state)
{
    (void)state;
    static Work alone[THREADS], together[THREADS];
    for (int i = 0; i < THREADS; i++) {
        alone[i].seed = together[i].seed = i + 1;
        work(&alone[i]);
    }
    work_at_once(together, THREADS);
    for (int i = 0; i < THREADS; i++) {
        assert_same(&alone[i], &together[i]);
        assert_true(together[i].reports > 0);
    }
    assert_true(alone[0].hash != alone[1].hash);
}

static void one_scene_read_by_all(void **state)
{
    (void)state;
    static Work all[THREADS];
    RamifyScene *scene = load(7, NULL);
    for (int i = 0; i < THREADS; i++) {
        all[i].scene = scene;
    }
    work_at_once(all, THREADS);
    for (int i = 1; i < THREADS; i++) {
        assert_same(&all[0], &all[i]);
    }
    ramify_scene_free(scene);
}

static void cancelled_without_the_others(void **state)
{
    (void)state;
    static Work all[2];
    const volatile int cancelled = 1;
    all[0].seed = all[1].seed = 1;
    all[0].cancelled = &cancelled;
    work_at_once(all, 2);
    assert_false(all[0].done);
    assert_int_equal(all[0].error.code, RAMIFY_CANCELLED);
    assert_true(all[1].done);
    assert_int_equal(all[1].error.code, RAMIFY_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_of_their_own),
        cmocka_unit_test(one_scene_read_by_all),
        cmocka_unit_test(cancelled_without_the_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
