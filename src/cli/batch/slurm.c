// The engine of clusters: Slurm runs an array of tasks, then the merge.
#include "cli/batch/batch.h"

#include "base/file_replace.h"
#include "base/text_stream.h"
#include "cli/batch/program.h"
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Embedded while building: what a task and the merge run.
extern const char slurm_task_sh[], slurm_merge_sh[];

enum {
    ARRAY = 1000,    // tasks of one array; Slurm's MaxArraySize is 1001 by default
    MOST_WORDS = 16, // of a call of sbatch
    LIST = 4096,     // bytes of an array's list
    JOBS = 16384,
    WARNING_SECONDS = 120 // before the end of a task's time, to save what it has begun
};

#define TIME_FACTOR 2.0 // of the estimate: other machines are slower
#define LEAST_MINUTES 10.0
#define MEMORY_FACTOR 1.25
#define LEAST_MEMORY 5e8 // bytes

// A submission.
typedef struct Submission {
    const Batch *batch;
    const Options *options;
    Estimate cost;
    int threads, pack;
    char jobs[JOBS]; // numbers of the arrays, ":123:124"
} Submission;

// ---- scripts

// Within '...' of a shell.
static void put_quoted(FILE *stream, const char *text)
{
    fputc('\'', stream);
    for (; *text; text++) {
        if (*text == '\'') {
            fputs("'\\'", stream); // ends, gives one, begins again with the next
        }
        fputc(*text, stream);
    }
    fputc('\'', stream);
}

static void put_directives(FILE *stream, const Submission *s, bool merge)
{
    const Options *o = s->options;
    double seconds = merge ? 0.0 : s->cost.start + s->pack * s->cost.part;
    double memory = fmax(LEAST_MEMORY, MEMORY_FACTOR * (merge ? s->cost.merge : s->cost.memory));
    fprintf(stream, "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=%d\n#SBATCH --mem=%.0fM\n",
            s->threads, ceil(memory * 1e-6));
    fprintf(stream, "#SBATCH --time=%.0f\n",
            ceil(fmax(LEAST_MINUTES, TIME_FACTOR * seconds / 60.0 + WARNING_SECONDS / 60.0)));
    fprintf(stream, "#SBATCH --requeue\n#SBATCH --open-mode=append\n");
    if (!merge) {
        fprintf(stream, "#SBATCH --signal=B:USR1@%d\n", WARNING_SECONDS);
    }
    if (o->partition) {
        fprintf(stream, "#SBATCH --partition=%s\n", o->partition);
    }
    if (o->account) {
        fprintf(stream, "#SBATCH --account=%s\n", o->account);
    }
    for (int i = 0; i < o->directive_count; i++) {
        fprintf(stream, "#SBATCH %s\n", o->directives[i]);
    }
}

// Writes FOLDER/slurm/NAME: directives, what differs between batches, and the script's fixed text.
static bool write_script(const Submission *s, const char *name, const char *text, bool merge,
                         RamifyError *e)
{
    char path[BATCH_PATH + 64], program[BATCH_PATH];
    Error why = {0};
    FILE *stream;
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0) {
        return fail(e, RAMIFY_IO, "the path of this program cannot be found");
    }
    TextStream *lines = text_stream_new(&stream, NULL);
    if (!lines) {
        return fail(e, RAMIFY_MEMORY, "out of memory");
    }
    program[length] = 0;
    fprintf(stream, "#!/bin/sh\n");
    put_directives(stream, s, merge);
    fprintf(stream, "ramify=${RAMIFY:-");
    put_quoted(stream, program);
    fprintf(stream, "}\nfolder=");
    put_quoted(stream, s->batch->folder);
    if (!merge) {
        fprintf(stream, "\nfirst=%d last=%d pack=%d", s->batch->first, s->batch->last, s->pack);
    }
    fprintf(stream, "\n%s", text);
    snprintf(path, sizeof path, "%s/slurm/%s", s->batch->folder, name);
    char *script = text_stream_close(lines, NULL, &why);
    bool done = (script && file_replace(path, script, strlen(script), &why)) ||
                fail(e, script ? RAMIFY_IO : RAMIFY_MEMORY, "%s", why.message);
    free(script);
    return done;
}

// ---- submission

static bool sbatch(const Submission *s, char *const given[], char job[64], RamifyError *e)
{
    char *argv[MOST_WORDS + 1], name[128], folder[BATCH_PATH + 16], said[700];
    int count = 0;
    snprintf(name, sizeof name, "--job-name=%.100s", file_name(s->batch->folder));
    snprintf(folder, sizeof folder, "--chdir=%s", s->batch->folder);
    argv[count++] = "sbatch";
    argv[count++] = "--parsable";
    argv[count++] = name;
    argv[count++] = folder;
    while (*given) {
        argv[count++] = *given++;
    }
    argv[count] = NULL;
    if (!program_run(argv, said, sizeof said, e)) {
        return false;
    }
    const char *last = strrchr(said, '\n'); // warnings come first
    size_t digits = strspn(last ? last + 1 : said, "0123456789");
    snprintf(job, 64, "%.*s", (int)digits, last ? last + 1 : said);
    return digits > 0 || fail(e, RAMIFY_IO, "sbatch gave no number of a job but '%s'", said);
}

// Submits the tasks among offset .. offset + ARRAY - 1 that are wanted, as one array.
static bool submit_array(Submission *s, const bool *wanted, int count, int offset, RamifyError *e)
{
    char list[LIST], array[LIST + 16], log[64], start[16], script[] = "slurm/task.sh", job[64];
    batch_list(wanted + offset, 0, count - 1, ",", list, sizeof list);
    snprintf(array, sizeof array, "--array=%s", list);
    snprintf(log, sizeof log, "--output=logs/task-%d%%3a.log", offset / ARRAY);
    snprintf(start, sizeof start, "%d", offset);
    char *const words[] = {array, log, script, start, NULL};
    if (!*list) {
        return true;
    }
    size_t used = strlen(s->jobs);
    bool done = sbatch(s, words, job, e);
    if (done) {
        snprintf(s->jobs + used, sizeof s->jobs - used, ":%s", job);
    }
    return done;
}

// afterany: the merge also runs when tasks have failed, and names what is missing.
static bool submit_merge(const Submission *s, RamifyError *e)
{
    char after[JOBS + 32], log[] = "--output=logs/merge.log", script[] = "slurm/merge.sh", job[64];
    snprintf(after, sizeof after, "--dependency=afterany%s", s->jobs);
    char *const words[] = {log, *s->jobs ? after : script, *s->jobs ? script : NULL, NULL};
    bool done = sbatch(s, words, job, e);
    if (done && !s->options->quiet) {
        fprintf(stderr, "submitted: tasks %s, merge %s; ramify batch status '%s'\n",
                *s->jobs ? s->jobs + 1 : "none", job, s->batch->folder);
    }
    return done;
}

static bool submit_tasks(Submission *s, RamifyError *e)
{
    const Batch *batch = s->batch;
    int parts = batch->last - batch->first + 1, tasks = (parts + s->pack - 1) / s->pack;
    bool *missing = batch_missing(batch, NULL, e);
    bool *wanted = missing ? allocate(tasks, sizeof *wanted, e) : NULL;
    bool done = wanted;
    for (int i = 0; done && i < parts; i++) {
        wanted[i / s->pack] = wanted[i / s->pack] || missing[i];
    }
    for (int offset = 0; done && offset < tasks; offset += ARRAY) {
        int count = tasks - offset < ARRAY ? tasks - offset : ARRAY;
        done = submit_array(s, wanted, count, offset, e);
    }
    free(missing);
    free(wanted);
    return done && submit_merge(s, e);
}

bool batch_slurm(const Batch *batch, const Options *options, RamifyError *e)
{
    char folder[BATCH_PATH + 16], said[256], sbatch_name[] = "sbatch", version[] = "--version";
    char *const probe[] = {sbatch_name, version, NULL};
    Submission s = {.batch = batch, .options = options, .threads = batch_threads(options)};
    if (!program_run(probe, said, sizeof said, e)) {
        RamifyError why = *e;
        return fail(e, why.code,
                    "%s; --engine slurm needs a machine that submits to a cluster, --engine local "
                    "runs the same here",
                    why.message);
    }
    if (!batch_estimate(batch, s.threads, options, &s.cost, e)) {
        return false;
    }
    s.pack = batch_pack(batch, options, &s.cost);
    batch_print_estimate(batch, options, s.pack, &s.cost);
    snprintf(folder, sizeof folder, "%s/slurm", batch->folder);
    mkdir(folder, 0777); // writing tells what is wrong
    return write_script(&s, "task.sh", slurm_task_sh, false, e) &&
           write_script(&s, "merge.sh", slurm_merge_sh, true, e) && submit_tasks(&s, e);
}
