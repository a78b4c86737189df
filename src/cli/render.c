// ramify render: a scene file becomes a picture.
#include "cli/command.h"

#include "base/memory.h"
#include "cli/picture.h"
#include "render/accel.h"
#include "render/renderer.h"
#include "scene/build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_PREVIEW_WAIT 5.0 // s between the first preview and the second

// Where the pictures go; both owned.
typedef struct Outputs {
    char *display, *exr;
} Outputs;

typedef struct Seconds {
    double build, trace, write;
} Seconds;

// What the render callback needs for previews.
typedef struct Preview {
    const Scene *scene;
    const Run *run;
    Progress *progress;
    const char *file;
    double start, next; // run_seconds
    double spent;       // s, on writing previews
    bool failed;
} Preview;

static void clear_outputs(Outputs *outputs)
{
    free(outputs->display);
    free(outputs->exr);
    *outputs = (Outputs){0};
}

static const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool plan_outputs(const Options *options, Outputs *outputs, Error *e)
{
    const char *named = options->output ? options->output : file_name(options->operand);
    bool exr = output_has_ending(named, ".exr"),
         jpeg = output_has_ending(named, ".jpg") || output_has_ending(named, ".jpeg");
    if (options->output && !exr && !jpeg && !output_has_ending(named, ".png")) {
        return error_set(e, ERROR_INPUT, "--output %s; its ending must be .png, .jpg or .exr",
                         named);
    }
    bool as_named = options->output && !exr;
    outputs->display =
        as_named ? memory_copy_string(named, e) : output_with_ending(named, ".png", e);
    outputs->exr = exr ? memory_copy_string(named, e) : output_with_ending(named, ".exr", e);
    return outputs->display && outputs->exr && output_check(outputs->display, e) &&
           output_check(outputs->exr, e);
}

// After the first pass, then at growing intervals: a picture to look at is soon there, and writing
// it stays a small part of the time.
static void preview_pass(void *user, const Film *film, int samples)
{
    Preview *p = user;
    double now = run_seconds();
    if (p->failed || now < p->next || samples >= p->scene->render.samples) {
        return;
    }
    Error e = {0};
    if (!picture_write_display(p->file, p->scene, film, false, p->run, &e)) {
        char text[1200];
        error_format(&e, text, sizeof text);
        progress_warn(p->progress, text);
        p->failed = true;
    }
    double written = run_seconds();
    p->spent += written - now;
    p->next = written + (samples > 1 ? written - p->start : FIRST_PREVIEW_WAIT);
}

static double crop_share(const float *crop)
{
    return (double)(crop[2] - crop[0]) * (double)(crop[3] - crop[1]);
}

static bool trace(const Options *options, const Scene *scene, const World *world, Film *film,
                  const Outputs *outputs, Progress *progress, const Run *run, RenderStats *stats,
                  Seconds *seconds, Error *e)
{
    double start = run_seconds();
    Renderer *renderer = renderer_new(world, options->isa, run, e);
    if (!renderer) {
        return false;
    }
    double built = run_seconds();
    Preview preview = {
        .scene = scene, .run = run, .progress = progress, .file = outputs->display, .start = built};
    progress->work =
        (double)film->width * film->height * crop_share(scene->film.crop) * scene->render.samples;
    bool done = renderer_render(renderer, film, run, preview_pass, &preview, stats, e);
    seconds->build = built - start;
    seconds->trace = run_seconds() - built - preview.spent;
    seconds->write += preview.spent;
    renderer_free(renderer);
    return done;
}

static void print_summary(const Outputs *outputs, const Scene *scene, const BuildStats *build,
                          const RenderStats *render, const Seconds *seconds)
{
    double rate = seconds->trace > 0.0 ? (double)render->paths / seconds->trace : 0.0;
    fprintf(stderr, "%s and %s: %d x %d pixels, %d samples\n", outputs->display, outputs->exr,
            scene->film.width, scene->film.height, render->samples);
    fprintf(stderr,
            "%lld nodes, %lld triangles, %lld curve segments, %lld instances, %.0f MB at most\n",
            (long long)build->nodes, (long long)build->geometry.triangles,
            (long long)build->geometry.curve_segments, (long long)build->geometry.instances,
            (double)memory_peak() * 1e-6);
    fprintf(stderr,
            "grow %.2f s, mesh %.2f s, build %.2f s, trace %.2f s (%.2f M samples/s), write "
            "%.2f s\n",
            build->grow_seconds, build->mesh_seconds, seconds->build, seconds->trace, rate * 1e-6,
            seconds->write);
}

static void print_json(const Outputs *outputs, const Scene *scene, const BuildStats *build,
                       const RenderStats *render, const Seconds *seconds)
{
    printf("{\"images\": [");
    json_print_string(outputs->display);
    printf(", ");
    json_print_string(outputs->exr);
    printf("], \"width\": %d, \"height\": %d, \"samples\": %d, \"nodes\": %lld, "
           "\"triangles\": %lld, \"curve_segments\": %lld, \"instances\": %lld, "
           "\"paths\": %lld, \"rays\": %lld, \"memory\": %lld, \"scene_memory\": %lld, ",
           scene->film.width, scene->film.height, render->samples, (long long)build->nodes,
           (long long)build->geometry.triangles, (long long)build->geometry.curve_segments,
           (long long)build->geometry.instances, (long long)render->paths, (long long)render->rays,
           (long long)memory_peak(), (long long)build->geometry.bytes + (long long)render->memory);
    printf("\"seconds\": {\"grow\": %.3f, \"mesh\": %.3f, \"build\": %.3f, \"trace\": %.3f, "
           "\"write\": %.3f}}\n",
           build->grow_seconds, build->mesh_seconds, seconds->build, seconds->trace,
           seconds->write);
}

static bool write_pictures(const Outputs *outputs, const Scene *scene, const Film *film,
                           const Run *run, Seconds *seconds, Error *e)
{
    double start = run_seconds();
    Run patient = *run; // an interrupted picture is still to be written
    patient.cancelled = NULL;
    bool denoise = scene->denoise && !run_is_cancelled(run);
    bool done = picture_write_display(outputs->display, scene, film, denoise, &patient, e) &&
                picture_write_exr(outputs->exr, scene, film, e);
    seconds->write += run_seconds() - start;
    return done;
}

static bool render_scene(const Options *options, const Scene *scene, const Outputs *outputs,
                         Error *e)
{
    Progress progress;
    Run run = command_run(options, &progress);
    BuildStats build;
    RenderStats stats = {0};
    Seconds seconds = {0};
    World *world = scene_build(scene, &run, &build, e);
    Film *film = world ? film_new(world->film.width, world->film.height, e) : NULL;
    bool done =
        film && trace(options, scene, world, film, outputs, &progress, &run, &stats, &seconds, e);
    progress_end(&progress);
    done = done && write_pictures(outputs, scene, film, &run, &seconds, e);
    if (done && !options->quiet) {
        print_summary(outputs, scene, &build, &stats, &seconds);
    }
    if (done && options->json) {
        print_json(outputs, scene, &build, &stats, &seconds);
    }
    film_free(film);
    world_free(world);
    if (done && run_is_cancelled(&run)) {
        return error_set(e, ERROR_CANCELLED, "interrupted; %s has %d samples a pixel",
                         outputs->display, stats.samples);
    }
    return done;
}

bool command_render(const Options *options, Error *e)
{
    Outputs outputs = {0};
    bool sound = accel_check_isa(options->isa, e) && plan_outputs(options, &outputs, e);
    Scene *scene = sound ? command_scene(options, e) : NULL;
    bool done = scene && render_scene(options, scene, &outputs, e);
    scene_free(scene);
    clear_outputs(&outputs);
    return done;
}
