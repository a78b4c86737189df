// The output of a batch, made of its parts.
#include "cli/batch/batch.h"

#include "base/file_replace.h"
#include "cli/command.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool check_complete(const Batch *batch, RamifyError *e)
{
    int count;
    char list[400];
    bool *missing = batch_missing(batch, &count, e);
    bool complete = missing && count == 0;
    if (missing && !complete) {
        batch_list(missing, batch->first, batch->last, ", ", list, sizeof list);
        fail(e, RAMIFY_DIFFERS,
             "%d of %d %ss are missing: %s; ramify batch submit '%s' renders them", count,
             batch->last - batch->first + 1, batch_noun(batch), list, batch->folder);
    }
    free(missing);
    return complete;
}

// ---- tiles

static bool merge_tiles(const Batch *batch, const Options *options, RamifyError *e)
{
    int count = batch->last - batch->first + 1;
    char **files = allocate(count, sizeof *files, e);
    bool done = files;
    for (int i = 0; done && i < count; i++) {
        files[i] = batch_part_file(batch, batch->first + i, e);
        done = files[i];
    }
    if (done) {
        Options merge = *options;
        merge.operands = (const char *const *)files;
        merge.operand = files[0];
        merge.operand_count = count;
        merge.output = batch->plan.output;
        done = command_join(&merge, batch->scene, e);
    }
    for (int i = 0; files && i < count; i++) {
        free(files[i]);
    }
    free(files);
    return done;
}

// ---- frames

static bool copy_file(const char *from, const char *to, RamifyError *e)
{
    Error why = {0};
    FILE *stream = fopen(from, "r");
    struct stat status;
    bool sized = stream && fstat(fileno(stream), &status) == 0;
    size_t size = sized ? (size_t)status.st_size : 0;
    char *bytes = sized ? allocate((int64_t)size, 1, e) : NULL;
    bool done = bytes && fread(bytes, 1, size, stream) == size;
    if (!done && !(sized && !bytes)) {
        fail(e, RAMIFY_IO, "'%s' cannot be read: %s", from, strerror(errno));
    }
    done = done && (file_replace(to, bytes, size, &why) || fail(e, RAMIFY_IO, "%s", why.message));
    free(bytes);
    if (stream) {
        fclose(stream);
    }
    return done;
}

// Gives the frame a further name, which replaces another file of that name; copies it where the
// file system has no such links.
static bool link_file(const char *from, const char *to, RamifyError *e)
{
    char beside[BATCH_PATH + 128];
    snprintf(beside, sizeof beside, "%s.ramify-%d.part", to, (int)getpid());
    bool linked = link(from, beside) == 0 && rename(beside, to) == 0;
    unlink(beside); // rename leaves it when both names are of one file
    return linked || copy_file(from, to, e);
}

// Name of a frame beside the other frames of a film, or as a pattern such as "oak-%04d.png" has it.
static void name_frame(const char *output, bool film, int frame, char name[BATCH_PATH + 64])
{
    if (film) {
        snprintf(name, BATCH_PATH + 64, "%s.frames/%06d.png", output, frame);
    } else {
        snprintf(name, BATCH_PATH + 64, output, frame); // checked by ramify_turntable_check
    }
}

static bool place_frames(const Batch *batch, bool film, RamifyError *e)
{
    bool done = true;
    for (int frame = batch->first; done && frame <= batch->last; frame++) {
        char name[BATCH_PATH + 64];
        char *part = batch_part_file(batch, frame, e);
        name_frame(batch->plan.output, film, frame, name);
        done = part && link_file(part, name, e);
        free(part);
    }
    return done;
}

// A film's frames lie in FILM.frames, from which the turntable goes on: all are done, so it only
// encodes them.
static bool encode_film(const Batch *batch, const Options *options, RamifyError *e)
{
    const char *film = batch->plan.output;
    char folder[BATCH_PATH + 16];
    snprintf(folder, sizeof folder, "%s.frames", film);
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        return fail(e, RAMIFY_IO, "folder '%s' cannot be made: %s", folder, strerror(errno));
    }
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    bool done = place_frames(batch, true, e) &&
                ramify_turntable(batch->scene, &batch->turntable, film, &run, NULL, e);
    progress_end(&progress);
    return done;
}

static bool merge_frames(const Batch *batch, const Options *options, RamifyError *e)
{
    const char *output = batch->plan.output;
    bool film = output_has_ending(output, ".mp4");
    bool done = film ? encode_film(batch, options, e) : place_frames(batch, false, e);
    if (done && !options->quiet) {
        fprintf(stderr, "%s: %d frames\n", output, batch->last - batch->first + 1);
    }
    return done;
}

bool batch_merge(const Batch *batch, const Options *options, RamifyError *e)
{
    return check_complete(batch, e) &&
           (batch->columns > 0 ? merge_tiles : merge_frames)(batch, options, e);
}
