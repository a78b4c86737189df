// ramify render: renders a scene to a picture.
#include "base/json.h"
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUGH_SAMPLES = 16 }; // previews of fewer samples are denoised

// Output files; both owned.
typedef struct Outputs {
    char *display, *exr;
} Outputs;

// A rendering and its statistics.
typedef struct Job {
    const RamifyScene *scene;
    const Outputs *outputs;
    RamifySceneInfo info;
    RamifyWorldInfo world;
    RamifyRenderInfo render;
    double build, trace, write; // s
} Job;

// State of the preview callback.
typedef struct Preview {
    const Job *job;
    const RamifyRun *run;
    Progress *progress;
    double start, next; // clock_seconds
    double spent;       // s, spent on writing previews
    bool failed;
} Preview;

static void clear_outputs(Outputs *outputs)
{
    free(outputs->display);
    free(outputs->exr);
    *outputs = (Outputs){0};
}

static bool plan_outputs(const Options *options, Outputs *outputs, RamifyError *e)
{
    const char *named = options->output ? options->output : file_name(options->operand);
    bool exr = output_has_ending(named, ".exr"),
         jpeg = output_has_ending(named, ".jpg") || output_has_ending(named, ".jpeg");
    bool valid =
        !options->output || exr || jpeg || output_has_ending(named, ".png") ||
        fail(e, RAMIFY_BAD_INPUT, "--output %s; its ending must be .png, .jpg or .exr", named);
    bool as_named = options->output && !exr;
    outputs->display = as_named ? copy_text(named, e) : output_with_ending(named, ".png", e);
    outputs->exr = exr ? copy_text(named, e) : output_with_ending(named, ".exr", e);
    return valid && outputs->display && outputs->exr && output_check(outputs->display, e) &&
           output_check(outputs->exr, e);
}

static void write_preview(Preview *p, const RamifyFilm *film, bool denoise)
{
    double start = clock_seconds();
    RamifyError e = {0};
    RamifyRun quiet = *p->run; // what it warns of follows with the last picture
    quiet.warn = NULL;
    if (!ramify_film_write(film, p->job->scene, p->job->outputs->display, denoise, &quiet, &e) &&
        e.code != RAMIFY_CANCELLED) {
        char text[1200];
        ramify_error_format(&e, text, sizeof text);
        progress_warn(p->progress, text);
        p->failed = true;
    }
    p->spent += clock_seconds() - start;
}

// Writes a denoised preview after the first pass, then one at growing intervals: a picture is
// available soon, and writing takes a small part of the time.
static void preview_pass(void *user, const RamifyFilm *film, int samples)
{
    Preview *p = user;
    const RamifySceneInfo *info = &p->job->info;
    if (p->failed || clock_seconds() < p->next || samples >= info->samples) {
        return;
    }
    write_preview(p, film, info->denoise || samples < ROUGH_SAMPLES);
    double written = clock_seconds();
    p->next = written + (written - p->start);
}

// Writes a coarse picture before the first pass.
static bool first_look(Preview *p, RamifyRenderer *renderer, RamifyFilm *film, RamifyError *e)
{
    bool done = ramify_renderer_look(renderer, film, p->run, e);
    if (done) {
        write_preview(p, film, false);
    }
    return done;
}

static bool trace(Job *job, const RamifyWorld *world, const Options *options, RamifyFilm *film,
                  Progress *progress, const RamifyRun *run, RamifyError *e)
{
    double start = clock_seconds();
    RamifyRenderer *renderer = ramify_renderer_new(world, options->isa, run, e);
    double built = clock_seconds();
    bool previews = !options->no_preview && job->info.samples > 1;
    Preview preview = {.job = job, .run = run, .progress = progress, .start = built};
    const float *crop = job->info.crop;
    progress->work = (double)job->info.width * job->info.height * (double)(crop[2] - crop[0]) *
                     (double)(crop[3] - crop[1]) * job->info.samples;
    bool done = renderer && (!previews || first_look(&preview, renderer, film, e)) &&
                ramify_renderer_render(renderer, film, previews ? preview_pass : NULL, &preview,
                                       run, &job->render, e);
    job->build = built - start;
    job->trace = clock_seconds() - built - preview.spent;
    job->write += preview.spent;
    ramify_renderer_free(renderer);
    return done;
}

static void print_summary(const Job *job)
{
    double rate = job->trace > 0.0 ? (double)job->render.paths / job->trace : 0.0;
    fprintf(stderr, "%s and %s: %d x %d pixels, %d samples\n", job->outputs->display,
            job->outputs->exr, job->info.width, job->info.height, job->render.samples);
    fprintf(stderr,
            "%lld nodes, %lld triangles, %lld curve segments, %lld instances, %.0f MB at most\n",
            (long long)job->world.nodes, (long long)job->world.triangles,
            (long long)job->world.curve_segments, (long long)job->world.instances,
            (double)ramify_memory_peak() * 1e-6);
    fprintf(stderr,
            "grow %.2f s, mesh %.2f s, build %.2f s, trace %.2f s (%.2f M samples/s), write "
            "%.2f s\n",
            job->world.grow_seconds, job->world.mesh_seconds, job->build, job->trace, rate * 1e-6,
            job->write);
}

static void print_json(const Job *job)
{
    printf("{\"images\": [");
    json_put_string(stdout, job->outputs->display);
    printf(", ");
    json_put_string(stdout, job->outputs->exr);
    printf("], \"width\": %d, \"height\": %d, \"samples\": %d, \"nodes\": %lld, "
           "\"triangles\": %lld, \"curve_segments\": %lld, \"instances\": %lld, "
           "\"paths\": %lld, \"rays\": %lld, \"memory\": %lld, \"scene_memory\": %lld, ",
           job->info.width, job->info.height, job->render.samples, (long long)job->world.nodes,
           (long long)job->world.triangles, (long long)job->world.curve_segments,
           (long long)job->world.instances, (long long)job->render.paths,
           (long long)job->render.rays, (long long)ramify_memory_peak(),
           (long long)job->world.bytes + (long long)job->render.bytes);
    printf("\"seconds\": {\"grow\": %.3f, \"mesh\": %.3f, \"build\": %.3f, \"trace\": %.3f, "
           "\"write\": %.3f}}\n",
           job->world.grow_seconds, job->world.mesh_seconds, job->build, job->trace, job->write);
}

static bool write_pictures(Job *job, RamifyFilm *film, const RamifyRun *run, RamifyError *e)
{
    double start = clock_seconds();
    RamifyRun patient = *run; // does not cancel: an interrupted picture is still written
    patient.cancelled = NULL;
    bool cut_short = *run->cancelled; // cancelled before writing started
    bool denoise =
        job->info.denoise && ramify_film_denoise(film, job->scene, cut_short ? &patient : run, e);
    // cancelled while denoising: write without
    bool done = denoise || !job->info.denoise || (!cut_short && *run->cancelled);
    done = done && ramify_film_write(film, job->scene, job->outputs->display, denoise, &patient, e);
    // the rendering itself is saved even if developing fails, e.g. in the denoiser's library
    done = ramify_film_write(film, job->scene, job->outputs->exr, denoise, &patient,
                             done ? e : NULL) &&
           done;
    job->write += clock_seconds() - start;
    return done;
}

static bool render_scene(const Options *options, const RamifyScene *scene, const Outputs *outputs,
                         RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    Job job = {.scene = scene, .outputs = outputs};
    ramify_scene_info(scene, &job.info);
    bool sound = ramify_image_check(outputs->display, e) && ramify_develop_check(scene, e);
    RamifyWorld *world = sound ? ramify_build(scene, &run, e) : NULL;
    RamifyFilm *film = world ? ramify_film_new(job.info.width, job.info.height, e) : NULL;
    bool done = film && trace(&job, world, options, film, &progress, &run, e);
    progress_end(&progress);
    done = done && write_pictures(&job, film, &run, e);
    if (done) {
        ramify_world_info(world, &job.world);
    }
    if (done && !options->quiet) {
        print_summary(&job);
    }
    if (done && options->json) {
        print_json(&job);
    }
    ramify_film_free(film);
    ramify_world_free(world);
    if (done && *run.cancelled) {
        done = job.render.samples > 0
                   ? fail(e, RAMIFY_CANCELLED, "interrupted; %s has %d samples per pixel",
                          outputs->display, job.render.samples)
                   : fail(e, RAMIFY_CANCELLED, "interrupted in the first pass; %s is incomplete",
                          outputs->display);
    }
    return done;
}

bool command_render(const Options *options, RamifyError *e)
{
    bool frame = option_given(options, "frame"), time = option_given(options, "time");
    Outputs outputs = {0};
    bool valid = ramify_check_isa(options->isa, e) && plan_outputs(options, &outputs, e);
    RamifyScene *scene = valid ? command_scene(options, e) : NULL;
    if (scene && (frame || time)) { // one moment of its animation
        RamifyScene *whole = scene;
        scene = NULL;
        if (frame && time) {
            fail(e, RAMIFY_BAD_INPUT, "both --frame and --time; give one");
        } else {
            scene = frame ? ramify_scene_at_frame(whole, NULL, options->frame, e)
                          : ramify_scene_at(whole, NULL, options->time, e);
        }
        ramify_scene_free(whole);
    }
    bool done = scene && render_scene(options, scene, &outputs, e);
    ramify_scene_free(scene);
    clear_outputs(&outputs);
    return done;
}
