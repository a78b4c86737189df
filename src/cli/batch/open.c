// A batch's folder, opened: its plan and its scene.
#include "cli/batch/folder.h"
#include "cli/batch/plan.h"
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Reads the scene from text, with some more overrides.
static RamifyScene *scene_of_text(const Batch *batch, const char *text, const char *const *changes,
                                  int change_count, RamifyError *e)
{
    const char *overrides[MAX_OVERRIDES + MOST_CHANGES];
    int count = batch->plan.override_count;
    char name[BATCH_PATH + 64], folder[BATCH_PATH];
    snprintf(name, sizeof name, "%s/scene.yaml", batch->folder);
    snprintf(folder, sizeof folder, "%.*s",
             (int)(strrchr(batch->scene_file, '/') - batch->scene_file), batch->scene_file);
    memcpy(overrides, batch->plan.overrides, (size_t)count * sizeof *overrides);
    for (int i = 0; i < change_count; i++) {
        overrides[count++] = changes[i];
    }
    return ramify_scene_load_text(text, strlen(text), name, *folder ? folder : "/", overrides,
                                  count, e);
}

RamifyScene *batch_scene(const Batch *batch, const char *const *changes, int count, RamifyError *e)
{
    return scene_of_text(batch, ramify_scene_text(batch->scene), changes, count, e);
}

static bool load_scene(Batch *batch, RamifyError *e)
{
    char *text = folder_read(batch->folder, "scene.yaml", e);
    batch->scene = text ? scene_of_text(batch, text, NULL, 0, e) : NULL;
    free(text);
    return batch->scene;
}

Batch *batch_open(const char *folder, RamifyError *e)
{
    Batch *batch = allocate(1, sizeof *batch, e);
    bool done = batch && folder_absolute(folder, false, batch->folder, e);
    while (done && batch->folder[1] && batch->folder[strlen(batch->folder) - 1] == '/') {
        batch->folder[strlen(batch->folder) - 1] = 0;
    }
    done = done && plan_read(batch, e) && load_scene(batch, e) &&
           batch_settle(batch, &batch->plan, batch->plan.output, e);
    if (!done) {
        batch_free(batch);
        return NULL;
    }
    return batch;
}

void batch_free(Batch *batch)
{
    if (batch) {
        ramify_scene_free(batch->scene);
        free(batch->words);
        free(batch->text);
        free(batch);
    }
}
