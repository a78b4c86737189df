// What of a batch is done, and what is missing.
#include "cli/batch/batch.h"

#include "base/json.h"
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// Flags of the missing parts that have a checkpoint; *count: how many.
static bool *begun_parts(const Batch *batch, const bool *missing, int *count, RamifyError *e)
{
    bool *begun = allocate(batch->last - batch->first + 1, sizeof *begun, e);
    *count = 0;
    for (int part = batch->first; begun && part <= batch->last; part++) {
        char *file = missing[part - batch->first] ? batch_begun_file(batch, part, e) : NULL;
        begun[part - batch->first] = file && access(file, F_OK) == 0;
        *count += begun[part - batch->first];
        free(file);
    }
    return begun;
}

static void print_json(const Batch *batch, const bool *missing, int missing_count, int begun_count)
{
    int count = batch->last - batch->first + 1;
    printf("{\"folder\": ");
    json_put_string(stdout, batch->folder);
    printf(", \"scene\": ");
    json_put_string(stdout, batch->scene_file);
    printf(", \"output\": ");
    json_put_string(stdout, batch->plan.output);
    printf(", \"of\": \"%ss\", \"parts\": %d, \"done\": %d, \"begun\": %d, \"missing\": [",
           batch_noun(batch), count, count - missing_count, begun_count);
    const char *before = "";
    for (int i = 0; i < count; i++) {
        if (missing[i]) {
            printf("%s%d", before, batch->first + i);
            before = ", ";
        }
    }
    printf("]}\n");
}

// Is the output there: the picture, the film, or the last frame?
static bool output_there(const Batch *batch)
{
    char name[BATCH_PATH + 64];
    const char *output = batch->plan.output;
    if (batch->columns > 0 || output_has_ending(output, ".mp4")) {
        return access(output, F_OK) == 0;
    }
    snprintf(name, sizeof name, output, batch->last); // checked by ramify_turntable_check
    return access(name, F_OK) == 0;
}

static void print_text(const Batch *batch, const bool *missing, int missing_count,
                       const bool *begun, int begun_count)
{
    int count = batch->last - batch->first + 1;
    char list[1000];
    printf("%s: %d of %d %ss done\n", batch->folder, count - missing_count, count,
           batch_noun(batch));
    if (begun_count > 0) {
        batch_list(begun, batch->first, batch->last, ", ", list, sizeof list);
        printf("begun: %s\n", list);
    }
    if (missing_count > 0) {
        batch_list(missing, batch->first, batch->last, ", ", list, sizeof list);
        printf("missing: %s\n", list);
    } else {
        printf("%s: %s\n", batch->plan.output, output_there(batch) ? "there" : "not merged yet");
    }
}

bool batch_status(const Batch *batch, const Options *options, RamifyError *e)
{
    int missing_count, begun_count;
    bool *missing = batch_missing(batch, &missing_count, e);
    bool *begun = missing ? begun_parts(batch, missing, &begun_count, e) : NULL;
    if (begun && options->json) {
        print_json(batch, missing, missing_count, begun_count);
    } else if (begun) {
        print_text(batch, missing, missing_count, begun, begun_count);
    }
    bool done = begun;
    free(missing);
    free(begun);
    return done;
}
