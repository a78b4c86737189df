// What a film costs beyond tracing: 72 frames of the oak against 72 times the tracing of one, in
// the same run. Frames show the same view, so that each has as much to trace.
//
//     bench_turntable [FRAMES [SCENE]]
#include "animate/shoot.h"
#include "render/world.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static void stop(const Error *e)
{
    fprintf(stderr, "bench_turntable: %s\n", e->message);
    exit(1);
}

// Seconds of tracing the scene as it is.
static double trace_one(const Scene *scene, const Run *run)
{
    Error e = {0};
    RenderStats stats;
    World *world = scene_build(scene, run, NULL, &e);
    Renderer *renderer = world ? renderer_new(world, NULL, run, &e) : NULL;
    Film *film = renderer ? film_new(scene->film.width, scene->film.height, &e) : NULL;
    if (!film || !renderer_render(renderer, film, run, NULL, NULL, &stats, &e)) {
        stop(&e);
    }
    film_free(film);
    renderer_free(renderer);
    world_free(world);
    return stats.seconds;
}

int main(int count, char **arguments)
{
    const char *const overrides[] = {"film.width=240", "film.height=135", "render.samples=16"};
    char folder[] = "/tmp/ramify_bench_XXXXXX", pattern[64];
    Error e = {0};
    Run run = run_default();
    run.threads = 2;
    ShootParams params = {.turntable = turntable_params_default(), .output = pattern, .end = -1};
    params.turntable.frames = count > 1 ? atoi(arguments[1]) : 72;
    params.turntable.turns = 0.0;
    Scene *scene = scene_read(count > 2 ? arguments[2] : "scenes/oak.yaml", overrides, 3, &e);
    if (!scene || !mkdtemp(folder)) {
        stop(&e);
    }
    snprintf(pattern, sizeof pattern, "%s/%%04d.png", folder);
    double one = trace_one(scene, &run), start = run_seconds();
    ShootStats stats;
    if (!shoot(scene, &params, &run, &stats, &e)) {
        stop(&e);
    }
    double all = run_seconds() - start, again = trace_one(scene, &run);
    double yardstick = (one < again ? one : again) * stats.frames;
    const StageStats *stage = &stats.stage;
    double once = stage->build.grow_seconds + stage->build.mesh_seconds + stage->build_seconds;
    printf("turntable: %d frames of the oak in %.2f s, of which %.2f s once; tracing one %.3f s; "
           "%.3f x without what is done once, %.3f x in all (at most 1.05)\n",
           stats.frames, all, once, yardstick / stats.frames, (all - once) / yardstick,
           all / yardstick);
    for (int i = 0; i < stats.frames; i++) {
        char file[96];
        snprintf(file, sizeof file, "%s/%04d.png", folder, i);
        unlink(file);
    }
    rmdir(folder);
    scene_free(scene);
    return 0;
}
