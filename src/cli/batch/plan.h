// Plans of batches: the options that decide on the result, a line each.
#ifndef RAMIFY_CLI_BATCH_PLAN_H
#define RAMIFY_CLI_BATCH_PLAN_H

#include "cli/batch/batch.h"

// The plan's text; heap. given: the options, without overrides if the scene is a picture. output:
// absolute. RAMIFY_BAD_INPUT when a value has several lines.
char *plan_text(const Options *given, const char *output, RamifyError *e);

// Reads FOLDER/plan into the batch's text, words, plan and scene_file. RAMIFY_BAD_INPUT when it is
// damaged, or of another version of ramify.
bool plan_read(Batch *batch, RamifyError *e);

#endif
