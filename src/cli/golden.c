// ramify golden: compares a folder's scenes with their stored images.
#include "base/json.h"
#include "cli/command.h"
#include "cli/difference.h"

#include <stdio.h>
#include <string.h>

enum { NAME_WIDTH = 24 };

// State of the printed list of results.
typedef struct Listing {
    const Options *options;
    Progress *progress;
    int count; // lines printed so far
} Listing;

static void print_line(const RamifyGoldenScene *scene)
{
    printf("%-*s %-9s", NAME_WIDTH, scene->name, ramify_golden_status_name(scene->status));
    const RamifyDifference *d = scene->difference;
    bool compared = d && d->width == d->other_width && d->height == d->other_height;
    if (compared) {
        printf(" ");
        difference_print(d, scene->limits->threshold);
    }
    if (scene->message[0]) {
        printf("%s%s", compared ? "; " : " ", scene->message);
    }
    if (scene->status != RAMIFY_GOLDEN_ORPHAN) {
        printf(" (%.2f s)", scene->seconds);
    }
    printf("\n");
}

static void print_scene_json(const RamifyGoldenScene *scene, bool first)
{
    printf("%s\n  {\"name\": ", first ? "" : ",");
    json_put_string(stdout, scene->name);
    printf(", \"status\": \"%s\", \"message\": ", ramify_golden_status_name(scene->status));
    json_put_string(stdout, scene->message);
    printf(", \"seconds\": %.3f", scene->seconds);
    if (scene->difference) {
        printf(", ");
        difference_print_json(scene->difference);
    }
    printf("}");
}

static void print_scene(void *user, const RamifyGoldenScene *scene)
{
    Listing *listing = user;
    progress_end(listing->progress);
    if (listing->options->json) {
        print_scene_json(scene, listing->count == 0);
    } else {
        print_line(scene);
    }
    listing->count++;
    fflush(stdout); // one line per scene, also into a pipe
}

static void print_counts(const Options *options, const RamifyGoldenCounts *n)
{
    if (options->json) {
        printf("\n], \"alike\": %d, \"different\": %d, \"missing\": %d, \"failed\": %d, "
               "\"stored\": %d, \"orphans\": %d}\n",
               n->alike, n->different, n->missing, n->failed, n->stored, n->orphans);
    } else {
        printf("%d alike, %d different, %d missing, %d failed, %d stored, %d orphans\n", n->alike,
               n->different, n->missing, n->failed, n->stored, n->orphans);
    }
}

static bool check_files(const Options *options, RamifyError *e)
{
    if (options->exact && options->statistical) {
        return fail(e, RAMIFY_BAD_INPUT, "--exact and --statistical; give one of them");
    }
    bool native = options->isa && strcmp(options->isa, "native") == 0;
    return (native || ramify_check_isa(options->isa, e)) &&
           (!options->report || output_check(options->report, e)) &&
           (!options->junit || output_check(options->junit, e));
}

static bool conclude(const RamifyGoldenCounts *n, RamifyError *e)
{
    int bad = n->different + n->missing + n->failed;
    return bad == 0 || fail(e, RAMIFY_DIFFERS, "%d of %d scenes are not as stored%s", bad,
                            bad + n->alike + n->stored,
                            n->missing > 0 ? "; --update stores what is missing" : "");
}

bool command_golden(const Options *options, RamifyError *e)
{
    if (!check_files(options, e)) {
        return false;
    }
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    Listing listing = {.options = options, .progress = &progress};
    RamifyLimits limits = command_limits(options);
    RamifyGoldenOptions golden = {
        .update = options->update,
        .mode = options->statistical
                    ? RAMIFY_GOLDEN_STATISTICAL
                    : (options->exact ? RAMIFY_GOLDEN_EXACT : RAMIFY_GOLDEN_AS_SCENE),
        .series = (uint64_t)options->series,
        .filter = options->filter,
        .isa = options->isa,
        .limits = &limits,
        .report = options->report,
        .junit = options->junit,
        .each = print_scene,
        .user = &listing,
        .memory = (int64_t)options->memory};
    if (options->json) {
        printf("{\"scenes\": [");
    }
    RamifyGoldenCounts counts;
    bool done = ramify_golden(options->operand, &golden, &run, &counts, e);
    progress_end(&progress);
    if (done || options->json) {
        print_counts(options, &counts);
    }
    return done && conclude(&counts, e);
}
