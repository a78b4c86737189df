// What the parts of a batch are, by its options and its scene.
#include "cli/batch/batch.h"

#include "cli/command.h"

#include <stdio.h>
#include <string.h>

enum { MOST_PARTS = 1000000 };

static bool settle_tiles(Batch *batch, const char *text, RamifyError *e)
{
    int width, height, length = 0, most_columns, most_rows;
    ramify_scene_size(batch->scene, &width, &height);
    most_columns = (width + 15) / 16;
    most_rows = (height + 15) / 16;
    bool valid = sscanf(text, "%5dx%5d%n", &batch->columns, &batch->rows, &length) == 2 &&
                 text[length] == 0 && batch->columns >= 1 && batch->rows >= 1 &&
                 batch->columns <= most_columns && batch->rows <= most_rows;
    batch->last = batch->columns * batch->rows - 1;
    batch->ending = ".exr";
    return valid || fail(e, RAMIFY_BAD_INPUT,
                         "--tiles %.60s; it must be COLUMNSxROWS, at most %dx%d for a picture of "
                         "%d x %d pixels, because a tile has at least 16 x 16",
                         text, most_columns, most_rows, width, height);
}

// Divides the samples of each tile.
static bool settle_ranges(Batch *batch, const Options *options, RamifyError *e)
{
    int first, end, samples;
    RamifySceneInfo info;
    ramify_scene_info(batch->scene, &info);
    ramify_scene_sample_range(batch->scene, &first, &end, &samples);
    int ranges = option_given(options, "sample-ranges") ? options->sample_ranges : 1,
        most = (samples + 15) / 16;
    if (ranges > most) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "--sample-ranges %d; it must be at most %d for %d samples, because a range has "
                    "at least 16",
                    ranges, most, samples);
    }
    if (ranges > 1 && info.max_noise > 0.0) {
        return fail_in(e, info.file, RAMIFY_BAD_INPUT,
                       "render.noise is %g, which decides on the number of samples; "
                       "--sample-ranges needs it known: --set render.noise=0",
                       info.max_noise);
    }
    batch->ranges = ranges;
    batch->last = batch->columns * batch->rows * ranges - 1;
    return batch->last < MOST_PARTS ||
           fail(e, RAMIFY_BAD_INPUT,
                "%d tiles of %d ranges of samples; at most %d parts are needed",
                batch->columns * batch->rows, ranges, MOST_PARTS);
}

// Reads "A-B" or "A-B/N".
static bool settle_frames(Batch *batch, const char *text, const char *output, RamifyError *e)
{
    char range[64];
    const char *slash = strchr(text, '/');
    int whole = 0, ignored;
    snprintf(range, sizeof range, "%.*s", (int)(slash ? slash - text : 63), text);
    bool valid =
        batch_read_range(range, 0, MOST_PARTS - 1, &batch->first, &batch->last) &&
        (!slash || batch_read_range(slash + 1, batch->last + 1, MOST_PARTS, &whole, &ignored));
    if (!valid) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "--frames %.60s; it must be A-B, or A-B/N of N frames, with A <= B < N <= %d",
                    text, MOST_PARTS);
    }
    int scene_frames = ramify_scene_frames(batch->scene);
    batch->turntable.frames = whole ? whole : (scene_frames ? scene_frames : batch->last + 1);
    const char *dot = strrchr(output, '.');
    bool film = output_has_ending(output, ".mp4");
    batch->ending = film || !dot ? ".png" : dot;
    RamifyScene *last = ramify_turntable_check(output, e)
                            ? ramify_scene_at_frame(batch->scene, &batch->turntable, batch->last, e)
                            : NULL;
    ramify_scene_free(last);
    return last && (!film || (batch->first == 0 && batch->last == batch->turntable.frames - 1) ||
                    fail(e, RAMIFY_BAD_INPUT,
                         "--frames %.60s are not all %d frames, which a film needs; name single "
                         "frames as in -o frame-%%04d.png",
                         text, batch->turntable.frames));
}

// A part must not depend on how fast a machine is, nor on other crops.
static bool check_scene(const RamifyScene *scene, RamifyError *e)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    bool whole = info.crop[0] <= 0.0f && info.crop[1] <= 0.0f && info.crop[2] >= 1.0f &&
                 info.crop[3] >= 1.0f;
    int first, end, samples;
    ramify_scene_sample_range(scene, &first, &end, &samples);
    if (first > 0 || end < samples) {
        return fail_in(e, info.file, RAMIFY_BAD_INPUT,
                       "render.first_sample and render.end_sample leave samples out; a batch needs "
                       "all: --set render.first_sample=0 --set render.end_sample=0");
    }
    return (info.max_seconds <= 0.0 ||
            fail_in(e, info.file, RAMIFY_BAD_INPUT,
                    "render.seconds is %g, which makes each part depend on its machine; a batch "
                    "needs --set render.seconds=0, with --samples or --noise to end it",
                    info.max_seconds)) &&
           (whole || fail_in(e, info.file, RAMIFY_BAD_INPUT,
                             "film.crop leaves a part of the picture out; a batch needs the "
                             "whole: --set 'film.crop=[0, 0, 1, 1]'"));
}

bool batch_settle(Batch *batch, const Options *options, const char *output, RamifyError *e)
{
    if (!options->tiles == !options->range) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "%s; give --tiles CxR for a picture or --frames A-B for "
                    "an animation",
                    options->tiles ? "both --tiles and --frames" : "neither --tiles nor --frames");
    }
    if (options->range && option_given(options, "sample-ranges")) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "both --frames and --sample-ranges; ranges divide the samples of --tiles");
    }
    return ramify_check_isa(options->isa, e) && check_scene(batch->scene, e) &&
           command_turn(options, &batch->turntable, e) &&
           (options->tiles
                ? settle_tiles(batch, options->tiles, e) && settle_ranges(batch, options, e)
                : settle_frames(batch, options->range, output, e)) &&
           ramify_develop_check(batch->scene, e);
}
