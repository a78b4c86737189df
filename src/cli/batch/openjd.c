// The engine of other farms: a job as an Open Job Description template (version 2023-09), which
// schedulers such as AWS Deadline Cloud take.
#include "cli/batch/batch.h"

#include "base/file_replace.h"
#include "base/json.h"
#include "base/text_stream.h"
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MEMORY_FACTOR 1.25 // of the estimate
#define CHUNK_SECONDS 180  // that farms aim at once they know how long a part takes

static void put_parameters(FILE *stream, const Batch *batch)
{
    char name[100];
    snprintf(name, sizeof name, "%s", file_name(batch->folder));
    fprintf(stream, "# Made by ramify batch --engine openjd; docs/clusters.md tells more.\n"
                    "specificationVersion: jobtemplate-2023-09\n"
                    "extensions: [TASK_CHUNKING]\n");
    fputs("name: ", stream);
    json_put_string(stream, name); // as YAML has it, too
    fputc('\n', stream);
    fprintf(stream, "parameterDefinitions:\n"
                    "  - name: Folder\n"
                    "    description: The batch, which lies around this file. All machines read "
                    "and write it.\n"
                    "    type: PATH\n"
                    "    objectType: DIRECTORY\n"
                    "    dataFlow: INOUT\n"
                    "    default: .\n");
    fprintf(stream, "  - name: Ramify\n"
                    "    description: The program.\n"
                    "    type: STRING\n"
                    "    default: ramify\n");
}

static void put_requirements(FILE *stream, const Estimate *cost, int threads)
{
    fprintf(stream,
            "    hostRequirements:\n"
            "      amounts:\n"
            "        - {name: amount.worker.vcpu, min: %d}\n"
            "        - {name: amount.worker.memory, min: %.0f} # MiB\n",
            threads, ceil(MEMORY_FACTOR * cost->memory / 1048576.0));
}

static void put_steps(FILE *stream, const Batch *batch, const char *parts, int pack,
                      const Estimate *cost, int threads)
{
    fprintf(stream,
            "steps:\n"
            "  - name: Render\n"
            "    parameterSpace:\n"
            "      taskParameterDefinitions:\n"
            "        - name: Parts # %ss\n"
            "          type: CHUNK[INT]\n"
            "          range: \"%s\"\n"
            "          chunks: {defaultTaskCount: %d, targetRuntimeSeconds: %d, rangeConstraint: "
            "CONTIGUOUS}\n",
            batch_noun(batch), parts, pack, CHUNK_SECONDS);
    put_requirements(stream, cost, threads);
    fprintf(stream,
            "    script:\n"
            "      actions:\n"
            "        onRun:\n"
            "          command: \"{{Param.Ramify}}\"\n"
            "          args: [batch, run, \"{{Param.Folder}}\", --parts, \"{{Task.Param.Parts}}\", "
            "--threads, \"%d\"]\n"
            "          cancelation: {mode: NOTIFY_THEN_TERMINATE, notifyPeriodInSeconds: 120}\n"
            "  - name: Merge\n"
            "    dependencies: [{dependsOn: Render}]\n"
            "    script:\n"
            "      actions:\n"
            "        onRun:\n"
            "          command: \"{{Param.Ramify}}\"\n"
            "          args: [batch, merge, \"{{Param.Folder}}\"]\n",
            threads);
}

// The numbers of the missing parts, or of all if none is missing; heap text.
static char *list_parts(const Batch *batch, RamifyError *e)
{
    int count;
    size_t size = 8 * (size_t)(batch->last - batch->first + 1) + 64;
    bool *missing = batch_missing(batch, &count, e);
    char *text = missing ? allocate((int64_t)size, 1, e) : NULL;
    if (text && count == 0) {
        snprintf(text, size, "%d-%d", batch->first, batch->last);
    } else if (text) {
        batch_list(missing, batch->first, batch->last, ",", text, size);
    }
    free(missing);
    return text;
}

bool batch_openjd(const Batch *batch, const Options *options, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    Error why = {0};
    Estimate cost;
    int threads = batch_threads(options);
    char *parts = batch_estimate(batch, threads, options, &cost, e) ? list_parts(batch, e) : NULL;
    if (!parts) {
        return false;
    }
    int pack = batch_pack(batch, options, &cost);
    FILE *stream;
    TextStream *text = text_stream_new(&stream, NULL);
    if (!text) {
        free(parts);
        return fail(e, RAMIFY_MEMORY, "out of memory");
    }
    put_parameters(stream, batch);
    put_steps(stream, batch, parts, pack, &cost, threads);
    snprintf(path, sizeof path, "%s/template.yaml", batch->folder);
    char *template = text_stream_close(text, NULL, &why);
    bool done = (template && file_replace(path, template, strlen(template), &why)) ||
                fail(e, template ? RAMIFY_IO : RAMIFY_MEMORY, "%s", why.message);
    free(template);
    free(parts);
    if (done && !options->quiet) {
        batch_print_estimate(batch, options, pack, &cost);
        fprintf(stderr, "%s: written; submit it to a farm\n", path);
    }
    return done;
}
