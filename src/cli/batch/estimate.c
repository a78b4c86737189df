// What the tasks of a batch cost, as far as that can be told before they run.
#include "cli/batch/batch.h"

#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

// Of x86-64 at 3 GHz, geometric means over the scenes of scenes/: the truth may be three times as
// much or as little, so tasks are asked for with a margin and go on when their time was too short.
#define BUILD_BYTES 4e7      // grown, skinned and built per second
#define PATH_SECONDS 6e-6    // of one thread
#define PIXEL_SECONDS 1.5e-6 // to write a picture
#define START_SECONDS 1.0

#define TASK_SECONDS 180.0 // what a task should take at least
#define START_SHARE 0.1    // of its time, at most, before its first part

Estimate batch_estimate(const Batch *batch, int threads)
{
    RamifySceneInfo info;
    ramify_scene_info(batch->scene, &info);
    double pixels = (double)info.width * info.height;
    double tiles = batch->columns > 0 ? (double)batch->columns * batch->rows : 1.0;
    return (Estimate){.start = START_SECONDS + (double)info.memory / BUILD_BYTES,
                      .part = pixels * info.samples * PATH_SECONDS / tiles / threads +
                              pixels * PIXEL_SECONDS,
                      .bytes = (double)info.memory};
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

void batch_print_estimate(const Batch *batch, int pack, const Estimate *cost)
{
    double seconds = cost->start + pack * cost->part;
    fprintf(stderr, "%s: %d %ss, %d a task; about %.0f %s and %.1f GB a task\n", batch->folder,
            batch->last - batch->first + 1, batch_noun(batch), pack,
            seconds < 100.0 ? seconds : seconds / 60.0, seconds < 100.0 ? "s" : "min",
            cost->bytes * 1e-9);
}
