// One task of a batch: renders some of its parts in this process, one after another.
#include "cli/batch/batch.h"

#include "base/save_clock.h"
#include "cli/command.h"
#include "cli/interrupt.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// A tile that is being rendered.
typedef struct Tile {
    RamifyScene *scene; // the batch's, with the tile's crop; owned
    RamifyFilm *film;
    char *file, *begun;
    RamifyRun run;
    SaveClock save; // of checkpoints
} Tile;

// Writes the film so far, now and then. What cannot be written now perhaps can the next time.
static void checkpoint(void *user, const RamifyFilm *film, int samples)
{
    Tile *tile = user;
    double start = clock_seconds();
    (void)film;
    (void)samples;
    if (!save_clock_is_due(&tile->save, start)) {
        return;
    }
    RamifyError e = {0};
    if (!ramify_film_write_part(tile->film, tile->scene, tile->begun, &e)) {
        tile->run.warn(tile->run.user, e.message);
    }
    save_clock_saved(&tile->save, start, clock_seconds());
}

// The batch's scene with the crop and the samples of a part.
static RamifyScene *part_scene(const Batch *batch, int part, const float crop[4], RamifyError *e)
{
    int first_sample, end_sample;
    char change[160], first[64], end[64];
    const char *const changes[MOST_CHANGES] = {change, first, end};
    batch_samples(batch, part, &first_sample, &end_sample);
    snprintf(change, sizeof change, "film.crop=[%.9g, %.9g, %.9g, %.9g]", (double)crop[0],
             (double)crop[1], (double)crop[2], (double)crop[3]);
    snprintf(first, sizeof first, "render.first_sample=%d", first_sample);
    snprintf(end, sizeof end, "render.end_sample=%d", end_sample);
    return batch_scene(batch, changes, batch->ranges > 1 ? 3 : 1, e);
}

// Sets the world to a part.
static bool choose_part(const Batch *batch, int part, const float crop[4], RamifyWorld *world,
                        RamifyError *e)
{
    int first, end;
    batch_samples(batch, part, &first, &end);
    return ramify_world_crop(world, crop, e) &&
           (batch->ranges == 1 || ramify_world_samples(world, first, end, e));
}

// The film of a checkpoint, or an empty one. A checkpoint that cannot be read is no loss of bits.
static RamifyFilm *start_film(const Tile *tile, RamifyError *e)
{
    int width, height;
    RamifyError why = {0};
    ramify_scene_size(tile->scene, &width, &height);
    if (access(tile->begun, F_OK) == 0) {
        RamifyFilm *film = ramify_film_read(tile->begun, tile->scene, &tile->run, &why);
        if (film) {
            return film;
        }
        tile->run.warn(tile->run.user, why.message);
    }
    return ramify_film_new(width, height, e);
}

static bool trace_tile(Tile *tile, RamifyRenderer *renderer, RamifyError *e)
{
    RamifyRenderInfo info;
    tile->save = save_clock_start(tile->save.every, clock_seconds());
    if (!ramify_renderer_resume(renderer, tile->film, checkpoint, tile->save.every, tile,
                                &tile->run, &info, e)) {
        return false;
    }
    if (*tile->run.cancelled) {
        return ramify_film_write_part(tile->film, tile->scene, tile->begun, e) &&
               fail(e, RAMIFY_CANCELLED, "interrupted");
    }
    if (!ramify_film_write_part(tile->film, tile->scene, tile->file, e)) {
        return false;
    }
    unlink(tile->begun);
    return true;
}

static bool run_tile(const Batch *batch, int part, RamifyWorld *world, RamifyRenderer *renderer,
                     const RamifyRun *run, RamifyError *e)
{
    float crop[4];
    batch_tile_crop(batch, part, crop);
    Tile tile = {.run = *run,
                 .save.every = command_checkpoint(&batch->plan),
                 .file = batch_part_file(batch, part, e),
                 .begun = batch_begun_file(batch, part, e)};
    tile.scene = tile.file && tile.begun ? part_scene(batch, part, crop, e) : NULL;
    tile.film = tile.scene ? start_film(&tile, e) : NULL;
    bool done =
        tile.film && choose_part(batch, part, crop, world, e) && trace_tile(&tile, renderer, e);
    ramify_film_free(tile.film);
    ramify_scene_free(tile.scene);
    free(tile.file);
    free(tile.begun);
    return done;
}

// Grows the scene once for all its tiles.
static bool run_tiles(const Batch *batch, int first, int last, const RamifyRun *run, int *finished,
                      RamifyError *e)
{
    RamifyWorld *world = NULL;
    RamifyRenderer *renderer = NULL;
    bool done = true;
    for (int part = first; done && part <= last; part++) {
        if (batch_part_done(batch, part)) {
            continue;
        }
        if (!world) {
            world = ramify_build(batch->scene, run, e);
            renderer = world ? ramify_renderer_new(world, batch->plan.isa, run, e) : NULL;
        }
        done = renderer && run_tile(batch, part, world, renderer, run, e);
        *finished += done;
    }
    ramify_renderer_free(renderer);
    ramify_world_free(world);
    return done;
}

// A range of frames that are not done, as one turntable: what does not move is built once.
static bool run_frames(const Batch *batch, int first, int last, const RamifyRun *run, int *finished,
                       RamifyError *e)
{
    char *pattern = batch_frame_pattern(batch, e);
    bool done = pattern;
    for (int frame = first; done && frame <= last; frame++) {
        if (batch_part_done(batch, frame)) {
            continue;
        }
        RamifyTurntable turntable = batch->turntable;
        RamifyTurntableInfo info;
        turntable.start = frame;
        while (frame < last && !batch_part_done(batch, frame + 1)) {
            frame++;
        }
        turntable.count = frame - turntable.start + 1;
        done = ramify_turntable(batch->scene, &turntable, pattern, run, &info, e);
        *finished += info.rendered + info.skipped;
    }
    free(pattern);
    return done;
}

bool batch_run(const Batch *batch, int first, int last, const Options *options, RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    const char *noun = batch_noun(batch);
    int finished = 0;
    double start = clock_seconds();
    bool done =
        (batch->columns > 0 ? run_tiles : run_frames)(batch, first, last, &run, &finished, e);
    progress_end(&progress);
    if (done && !options->quiet) {
        fprintf(stderr, "%ss %d-%d: %d rendered in %.2f s, %.0f MB at most\n", noun, first, last,
                finished, clock_seconds() - start, (double)ramify_memory_peak() * 1e-6);
    }
    if (!done && e->code == RAMIFY_CANCELLED) {
        fail(e, RAMIFY_CANCELLED,
             "interrupted; %d of the %ss %d-%d are finished now; run it again to go on", finished,
             noun, first, last);
    }
    return done;
}
