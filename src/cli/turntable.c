// ramify turntable: renders a scene to an animation.
#include "base/json.h"
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>

bool command_turn(const Options *options, RamifyTurntable *turntable, RamifyError *e)
{
    *turntable = options->turntable;
    turntable->isa = options->isa;
    turntable->spin = options->spin;
    turntable->vary_noise = options->vary_noise;
    turntable->turns = options->turns;
    turntable->still = option_given(options, "turns") && options->turns == 0.0;
    double checkpoint = command_checkpoint(options);
    turntable->checkpoint = checkpoint > 0.0 ? checkpoint : -1.0; // 0 would be the default
    static const char *const eases[] = {"linear", "smooth"};
    int ease = command_choice("ease", options->ease, eases, 2, e);
    if (ease < 0) {
        return false;
    }
    turntable->ease = options->ease ? RAMIFY_EASE_LINEAR + ease : RAMIFY_EASE_USUAL;
    bool ends = option_given(options, "end");
    if (ends && options->end < turntable->start) {
        return fail(e, RAMIFY_BAD_INPUT, "--start %d comes after --end %d; swap them",
                    turntable->start, options->end);
    }
    turntable->count = ends ? options->end - turntable->start + 1 : 0;
    return true;
}

static void print_summary(const char *output, const RamifyTurntableInfo *i, double seconds)
{
    fprintf(stderr, "%s: %d of %d frames rendered, %d skipped, %.0f MB at most\n", output,
            i->rendered, i->frames, i->skipped, (double)ramify_memory_peak() * 1e-6);
    fprintf(stderr,
            "prepare %.2f s, grow %.2f s, mesh %.2f s, build %.2f s, trace %.2f s, finish %.2f s, "
            "film %.2f s; %.2f s in all\n",
            i->prepare_seconds, i->grow_seconds, i->mesh_seconds, i->build_seconds,
            i->trace_seconds, i->finish_seconds, i->video_seconds, seconds);
}

static void print_json(const char *output, const RamifyTurntableInfo *i, double seconds)
{
    printf("{\"output\": ");
    json_put_string(stdout, output);
    printf(", \"frames\": %d, \"rendered\": %d, \"skipped\": %d, \"geometries\": %d, "
           "\"structures\": %d, \"paths\": %lld, \"memory\": %lld, ",
           i->frames, i->rendered, i->skipped, i->geometries, i->structures, (long long)i->paths,
           (long long)ramify_memory_peak());
    printf("\"seconds\": {\"prepare\": %.3f, \"grow\": %.3f, \"mesh\": %.3f, \"build\": %.3f, "
           "\"trace\": %.3f, \"finish\": %.3f, \"film\": %.3f, \"all\": %.3f}}\n",
           i->prepare_seconds, i->grow_seconds, i->mesh_seconds, i->build_seconds, i->trace_seconds,
           i->finish_seconds, i->video_seconds, seconds);
}

static bool shoot(const Options *options, const RamifyScene *scene, const char *output,
                  const RamifyTurntable *turntable, RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    RamifyTurntableInfo info;
    double start = clock_seconds();
    bool done = ramify_turntable(scene, turntable, output, &run, &info, e);
    double seconds = clock_seconds() - start;
    progress_end(&progress);
    if (done && !options->quiet) {
        print_summary(output, &info, seconds);
    }
    if (done && options->json) {
        print_json(output, &info, seconds);
    }
    if (!done && e->code == RAMIFY_CANCELLED) {
        fail(e, RAMIFY_CANCELLED,
             "interrupted; %d frames of %s are finished; run the same command again to continue",
             info.skipped + info.rendered, output);
    }
    return done;
}

bool command_turntable(const Options *options, RamifyError *e)
{
    RamifyTurntable turntable;
    char *output = options->output ? copy_text(options->output, e)
                                   : output_with_ending(file_name(options->operand), ".mp4", e);
    bool sound = output && ramify_check_isa(options->isa, e) &&
                 command_turn(options, &turntable, e) && ramify_turntable_check(output, e);
    RamifyScene *scene = sound ? command_scene(options, e) : NULL;
    bool done = scene && command_check_memory(options, scene, e) &&
                shoot(options, scene, output, &turntable, e);
    ramify_scene_free(scene);
    free(output);
    return done;
}
