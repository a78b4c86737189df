// ramify batch: a picture or an animation as tasks of a cluster.
#include "cli/batch/batch.h"

#include "cli/command.h"

#include <string.h>

static bool submit(const Batch *batch, const Options *options, RamifyError *e)
{
    static const char *const names[] = {"local", "slurm", "openjd"};
    bool (*const engines[])(const Batch *, const Options *,
                            RamifyError *) = {batch_local, batch_slurm, batch_openjd};
    int engine = command_choice("engine", options->engine, names, 3, e);
    return engine >= 0 && engines[engine](batch, options, e);
}

static bool run(const Batch *batch, const Options *options, RamifyError *e)
{
    int first = batch->first, last = batch->last;
    bool valid = !options->parts ||
                 batch_read_range(options->parts, batch->first, batch->last, &first, &last) ||
                 fail(e, RAMIFY_BAD_INPUT,
                      "--parts %.60s; it must be a number or a range A-B within %d-%d, the %ss of "
                      "the batch",
                      options->parts, batch->first, batch->last, batch_noun(batch));
    return valid && batch_run(batch, first, last, options, e);
}

typedef bool Action(const Batch *batch, const Options *options, RamifyError *e);

// The action of this name; NULL if there is none.
static Action *action_of(const char *name)
{
    static const struct {
        const char *name;
        Action *action;
    } actions[] = {
        {"status", batch_status}, {"run", run}, {"merge", batch_merge}, {"submit", submit}};
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++) {
        if (strcmp(name, actions[i].name) == 0) {
            return actions[i].action;
        }
    }
    return NULL;
}

// Options that would change what is rendered belong to the plan.
static bool check_second(const Options *options, RamifyError *e)
{
    return (!options->tiles && !options->range && options->override_count == 0 &&
            options->key_count == 0) ||
           fail(e, RAMIFY_BAD_INPUT,
                "ramify batch %s takes the scene and its options from the folder's plan; give "
                "them to ramify batch SCENE",
                options->operand);
}

bool command_batch(const Options *options, RamifyError *e)
{
    Action *action = options->operand ? action_of(options->operand) : submit;
    bool valid = true;
    if (!options->operand || (action && !options->second)) {
        valid = fail(e, RAMIFY_BAD_INPUT, "no %s is named; usage: ramify batch %s",
                     options->operand ? "folder of a batch" : "scene file",
                     options->operand ? "status|run|merge|submit FOLDER" : "SCENE --tiles CxR");
    } else if (!action && options->second) {
        valid = fail(e, RAMIFY_BAD_INPUT,
                     "'%.60s' is no action of batch; it must be status, run, merge or submit",
                     options->operand);
    } else if (action) {
        valid = check_second(options, e);
    }
    Batch *batch = !valid   ? NULL
                   : action ? batch_open(options->second, e)
                            : batch_create(options, e);
    bool done = batch && (action ? action : submit)(batch, options, e);
    batch_free(batch);
    return done;
}
