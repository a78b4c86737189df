// What the tasks of a batch cost.
#include "cli/batch/batch.h"

#include "base/file_replace.h"
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define START_SECONDS 0.3   // until a scene is read
#define TILE_SECONDS 1.2e-6 // per pixel of the picture, to write a tile
#define MERGE_BYTES 1.5e8   // of the program
#define MERGE_PIXEL 600.0   // bytes per pixel: the picture's film, a part's and the file's

#define TASK_SECONDS 120.0 // what a task should take at least
#define START_SHARE 0.1    // of its time, at most, before its first part

// For printf and scanf.
#define LINES                                                                          \
    "# What rendering the scene takes: seconds of a processor, and bytes of memory.\n" \
    "grow %lf\nbuild %lf\ntrace %lf\nwrite %lf\nmemory %lf\n"

static bool read_estimate(const char *file, RamifyEstimate *found)
{
    double memory = 0.0;
    FILE *stream = fopen(file, "r");
    int count = stream ? fscanf(stream, LINES, &found->grow_seconds, &found->build_seconds,
                                &found->trace_seconds, &found->write_seconds, &memory)
                       : 0;
    if (stream) {
        fclose(stream);
    }
    found->memory = (int64_t)memory;
    return count == 5;
}

static bool make_estimate(const Batch *batch, const Options *options, const char *file,
                          RamifyEstimate *found, RamifyError *e)
{
    Progress progress;
    Error why = {0};
    char text[512];
    RamifyRun run = command_run(options, &progress);
    bool done = ramify_estimate(batch->scene, batch->plan.isa, 0, &run, found, e);
    progress_end(&progress);
    snprintf(text, sizeof text, LINES, found->grow_seconds, found->build_seconds,
             found->trace_seconds, found->write_seconds, (double)found->memory);
    return done &&
           (file_replace(file, text, strlen(text), &why) || fail(e, RAMIFY_IO, "%s", why.message));
}

bool batch_estimate(const Batch *batch, int threads, const Options *options, Estimate *cost,
                    RamifyError *e)
{
    RamifyEstimate found = {0};
    char file[BATCH_PATH + 64];
    int width, height;
    ramify_scene_size(batch->scene, &width, &height);
    snprintf(file, sizeof file, "%s/estimate", batch->folder);
    if (!read_estimate(file, &found) && !make_estimate(batch, options, file, &found, e)) {
        return false;
    }
    double pixels = (double)width * height, trace = found.trace_seconds / threads;
    bool tiles = batch->columns > 0;
    // an animation may make the scene anew in each frame; growth is taken as if by one thread
    bool anew =
        !tiles && (batch->turntable.grow.count > 0 || ramify_scene_frames(batch->scene) > 0);
    double scene = found.grow_seconds + found.build_seconds / threads;
    *cost = (Estimate){.start = START_SECONDS + scene,
                       .part = tiles ? trace / (batch->last + 1) + TILE_SECONDS * pixels
                                     : trace + found.write_seconds / threads + (anew ? scene : 0.0),
                       .memory = (double)found.memory,
                       .merge = MERGE_BYTES + MERGE_PIXEL * pixels};
    return true;
}

int batch_pack(const Batch *batch, const Options *options, const Estimate *cost)
{
    double wanted = fmax(TASK_SECONDS, cost->start / START_SHARE) / cost->part;
    int most = batch->last - batch->first + 1;
    int pack = wanted < (double)most ? (int)ceil(wanted) : most;
    return options->pack > 0 ? options->pack : pack;
}

int batch_threads(const Options *options)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int jobs = options->jobs > 0 ? options->jobs : 1;
    int threads = processors > jobs ? (int)(processors / jobs) : 1;
    return options->threads > 0 ? options->threads : threads;
}

void batch_print_estimate(const Batch *batch, const Options *options, int pack,
                          const Estimate *cost)
{
    double seconds = cost->start + pack * cost->part;
    if (!options->quiet) {
        fprintf(stderr, "%s: %d %ss, %d a task; about %.0f %s and %.1f GB a task\n", batch->folder,
                batch->last - batch->first + 1, batch_noun(batch), pack,
                seconds < 100.0 ? seconds : seconds / 60.0, seconds < 100.0 ? "s" : "min",
                cost->memory * 1e-9);
    }
}
