// Renders a scene step by step: prints the progress, writes a preview after every pass, and keeps
// the picture on Ctrl-C.
//
//     cc render_progress.c -o render_progress $(pkg-config --cflags --libs ramify)
//     ./render_progress oak.yaml oak.png
#include <ramify.h>

#include <signal.h>
#include <stdio.h>
#include <string.h>

static volatile int cancelled; // the handler may set nothing else

static void on_interrupt(int number)
{
    (void)number;
    cancelled = 1;
}

static int report(const RamifyError *error)
{
    char text[1200];
    ramify_error_format(error, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    return error->code == RAMIFY_BAD_INPUT ? 2 : 1;
}

// Shared with the callbacks.
typedef struct Job {
    const RamifyScene *scene;
    const char *file;
    char stage[32]; // last reported
    int percent;
} Job;

static void on_progress(void *user, const char *stage, double done)
{
    Job *job = user;
    int percent = (int)(100.0 * done);
    if (strcmp(stage, job->stage) != 0 || percent >= job->percent + 10) {
        snprintf(job->stage, sizeof job->stage, "%s", stage);
        job->percent = percent;
        fprintf(stderr, "%s %d %%\n", stage, percent);
    }
}

static void on_pass(void *user, const RamifyFilm *film, int samples)
{
    const Job *job = user;
    if (ramify_film_write(film, job->scene, job->file, false, NULL, NULL)) {
        fprintf(stderr, "%s has %d samples a pixel\n", job->file, samples);
    }
}

static bool render(Job *job, const RamifyRun *run, RamifyRenderInfo *info, RamifyError *error)
{
    int width, height;
    ramify_scene_size(job->scene, &width, &height);
    RamifyWorld *world = ramify_build(job->scene, run, error);
    RamifyRenderer *renderer = world ? ramify_renderer_new(world, NULL, run, error) : NULL;
    RamifyFilm *film = renderer ? ramify_film_new(width, height, error) : NULL;
    // Cancelling while tracing is not a failure: the film has fewer samples. It is then denoised
    // and written without checking the flag again (NULL: run to the end).
    bool done = film && ramify_renderer_render(renderer, film, on_pass, job, run, info, error) &&
                ramify_film_write(film, job->scene, job->file, true, NULL, error);
    ramify_film_free(film);
    ramify_renderer_free(renderer); // before the world that it borrows
    ramify_world_free(world);       // before the scene
    return done;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: render_progress SCENE FILE.png|FILE.jpg|FILE.exr\n");
        return 2;
    }
    signal(SIGINT, on_interrupt);
    RamifyError error = {0};
    RamifyRenderInfo info = {0};
    if (!ramify_image_check(argv[2], &error)) {
        return report(&error); // fail before the work, not after it
    }
    RamifyScene *scene = ramify_scene_load(argv[1], NULL, 0, &error);
    Job job = {.scene = scene, .file = argv[2]};
    RamifyRun run = {.cancelled = &cancelled, .progress = on_progress, .user = &job};
    bool done = scene && render(&job, &run, &info, &error);
    ramify_scene_free(scene);
    if (!done) {
        return error.code == RAMIFY_CANCELLED ? 130 : report(&error);
    }
    fprintf(stderr, "%s: %d samples a pixel, %lld paths in %.1f s\n", argv[2], info.samples,
            (long long)info.paths, info.seconds);
    return cancelled ? 130 : 0;
}
