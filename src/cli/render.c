// ramify render: renders a scene to a picture.
#include "base/json.h"
#include "base/save_clock.h"
#include "cli/command.h"
#include "cli/outputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROUGH_SAMPLES = 16 }; // previews of fewer samples are denoised

// A rendering and its statistics.
typedef struct Job {
    const RamifyScene *scene;
    const Outputs *outputs;
    RamifySceneInfo info;
    RamifyWorldInfo world;
    RamifyRenderInfo render;
    double noise;               // share of white; NAN = unknown
    double build, trace, write; // s
    bool resumed;               // from a film on disk
} Job;

// State of the callback that writes previews and checkpoints.
typedef struct Preview {
    const Job *job;
    const RamifyRun *run;
    Progress *progress;
    bool shows;         // previews are wanted
    double start, next; // clock_seconds, of previews
    SaveClock save;     // of checkpoints
    double spent;       // s, spent on writing
    bool failed;
} Preview;

static void write_early(Preview *p, const char *file, const RamifyFilm *film, bool denoise)
{
    double start = clock_seconds();
    RamifyError e = {0};
    RamifyRun quiet = *p->run; // what it warns of follows with the last picture
    quiet.warn = NULL;
    if (!ramify_film_write(film, p->job->scene, file, denoise, &quiet, &e) &&
        e.code != RAMIFY_CANCELLED) {
        char text[1200];
        ramify_error_format(&e, text, sizeof text);
        progress_warn(p->progress, text);
        p->failed = true;
    }
    p->spent += clock_seconds() - start;
}

// The film as it is, from which --resume goes on.
static void write_checkpoint(Preview *p, const RamifyFilm *film)
{
    double start = clock_seconds();
    write_early(p, p->job->outputs->exr, film, false);
    save_clock_saved(&p->save, start, clock_seconds());
}

// Writes a denoised preview after the first pass, then one at growing intervals: a picture is
// available soon, and writing takes a small part of the time.
static void preview_pass(void *user, const RamifyFilm *film, int samples)
{
    Preview *p = user;
    const RamifySceneInfo *info = &p->job->info;
    if (p->failed || samples >= info->samples) {
        return;
    }
    if (p->shows && samples > 0 && clock_seconds() >= p->next) {
        write_early(p, p->job->outputs->display, film, info->denoise || samples < ROUGH_SAMPLES);
        double written = clock_seconds();
        p->next = written + (written - p->start);
    }
    if (save_clock_is_due(&p->save, clock_seconds())) {
        write_checkpoint(p, film);
    }
}

// Writes a coarse picture before the first pass.
static bool first_look(Preview *p, RamifyRenderer *renderer, RamifyFilm *film, RamifyError *e)
{
    bool done = ramify_renderer_look(renderer, film, p->run, e);
    if (done) {
        write_early(p, p->job->outputs->display, film, false);
    }
    return done;
}

static bool trace(Job *job, const RamifyWorld *world, const Options *options, RamifyFilm *film,
                  Progress *progress, const RamifyRun *run, RamifyError *e)
{
    double start = clock_seconds();
    RamifyRenderer *renderer = ramify_renderer_new(world, options->isa, run, e);
    double built = clock_seconds();
    Preview preview = {.job = job,
                       .run = run,
                       .progress = progress,
                       .shows = !options->no_preview && job->info.samples > 1,
                       .start = built,
                       .save = save_clock_start(command_checkpoint(options), built)};
    const float *crop = job->info.crop;
    progress->work = (double)job->info.width * job->info.height * (double)(crop[2] - crop[0]) *
                     (double)(crop[3] - crop[1]) * job->info.samples;
    bool look = preview.shows && !job->resumed;
    bool done = renderer && ramify_check_memory(job->scene, (int64_t)options->memory, 1, e) &&
                (!look || first_look(&preview, renderer, film, e)) &&
                ramify_renderer_resume(renderer, film, preview_pass, preview.save.every, &preview,
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
    fprintf(stderr, "%s and %s: %d x %d pixels, %d samples", job->outputs->display,
            job->outputs->exr, job->info.width, job->info.height, job->render.samples);
    if (!isnan(job->noise)) {
        fprintf(stderr, ", noise %.2f %%", 100.0 * job->noise);
    }
    fprintf(stderr, "\n");
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
    isnan(job->noise) ? printf("\"noise\": null, ") : printf("\"noise\": %.6f, ", job->noise);
    printf("\"seconds\": {\"grow\": %.3f, \"mesh\": %.3f, \"build\": %.3f, \"trace\": %.3f, "
           "\"write\": %.3f}}\n",
           job->world.grow_seconds, job->world.mesh_seconds, job->build, job->trace, job->write);
}

// The film to render into: that of --add-samples or, if it exists, of --resume, else an empty one.
static RamifyFilm *start_film(const Options *options, Job *job, const RamifyRun *run,
                              RamifyError *e)
{
    bool added = option_given(options, "add-samples");
    const char *file = added ? options->operand : job->outputs->exr;
    job->resumed = added || (options->resume && access(file, F_OK) == 0);
    return job->resumed ? ramify_film_read(file, job->scene, run, e)
                        : ramify_film_new(job->info.width, job->info.height, e);
}

static bool render_scene(const Options *options, const RamifyScene *scene, const Outputs *outputs,
                         RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    Job job = {.scene = scene, .outputs = outputs};
    ramify_scene_info(scene, &job.info);
    bool sound = ramify_image_check(outputs->display, e) && ramify_develop_check(scene, e);
    RamifyFilm *film = sound ? start_film(options, &job, &run, e) : NULL;
    RamifyWorld *world = film ? ramify_build(scene, &run, e) : NULL;
    bool done = world && trace(&job, world, options, film, &progress, &run, e);
    progress_end(&progress);
    double start = clock_seconds();
    done = done && outputs_write(outputs, film, scene, &run, e);
    job.write += clock_seconds() - start;
    done = done &&
           ((options->quiet && !options->json) || ramify_film_noise(film, scene, &job.noise, e));
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
                   ? fail(e, RAMIFY_CANCELLED,
                          "interrupted; %s has %d samples per pixel; --resume goes on",
                          outputs->display, job.render.samples)
                   : fail(e, RAMIFY_CANCELLED,
                          "interrupted in the first pass; %s is incomplete; --resume goes on",
                          outputs->display);
    }
    return done;
}

// The scene of a picture with more samples. The pattern of its noise stays laid out as it was.
static RamifyScene *scene_with_samples(const Options *options, RamifyScene *scene, RamifyError *e)
{
    int first, end, samples;
    Options more = *options;
    ramify_scene_sample_range(scene, &first, &end, &samples);
    if (first > 0 || end < samples) {
        fail(e, RAMIFY_BAD_INPUT,
             "'%s' has samples %d to %d of %d alone; ramify merge it with the others before adding "
             "samples",
             options->operand, first, end - 1, samples);
        return NULL;
    }
    snprintf(more.keys[more.key_count++], MAX_KEY_TEXT, "render.samples=%d",
             samples + options->add_samples);
    snprintf(more.keys[more.key_count++], MAX_KEY_TEXT, "render.planned_samples=%d",
             ramify_scene_planned_samples(scene));
    return command_scene(&more, e);
}

static bool check_continuation(const Options *options, RamifyError *e)
{
    bool adds = option_given(options, "add-samples");
    bool picture = options->operand && output_has_ending(options->operand, ".exr");
    if (adds && option_given(options, "sample-range")) {
        return fail(
            e, RAMIFY_BAD_INPUT,
            "both --sample-range and --add-samples; a range is of all samples of a picture: "
            "add samples to the picture that merge makes of its ranges");
    }
    return !adds || ((picture || fail(e, RAMIFY_BAD_INPUT,
                                      "--add-samples needs a picture: ramify render PICTURE.exr "
                                      "--add-samples N")) &&
                     (!option_given(options, "samples") ||
                      fail(e, RAMIFY_BAD_INPUT, "both --samples and --add-samples; give one")));
}

bool command_render(const Options *options, RamifyError *e)
{
    bool frame = option_given(options, "frame"), time = option_given(options, "time");
    Outputs outputs = {0};
    bool valid = check_continuation(options, e) && ramify_check_isa(options->isa, e) &&
                 outputs_plan(options, &outputs, e);
    RamifyScene *scene = valid ? command_scene(options, e) : NULL;
    if (scene && option_given(options, "add-samples")) {
        RamifyScene *given = scene;
        scene = scene_with_samples(options, given, e);
        ramify_scene_free(given);
    }
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
    bool done = scene && command_check_memory(options, scene, e) &&
                render_scene(options, scene, &outputs, e);
    ramify_scene_free(scene);
    outputs_clear(&outputs);
    return done;
}
