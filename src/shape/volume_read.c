// Reads volumes in a child process and checks its result.
#include "base/child.h"
#include "base/plugin.h"
#include "shape/vdb.h"

#include <math.h>

#define WANTED "an OpenVDB file with a grid of floats or of float vectors"
#define SECONDS 120.0
#define MEMORY 2e9

typedef struct Request {
    const char *file, *name;
    const VdbReaders *vdb;
} Request;

static int64_t count_of(const Volume *v)
{
    return (int64_t)v->size[0] * v->size[1] * v->size[2] * v->components;
}

static bool read_in_child(const void *data, ChildOutput *output, Error *e)
{
    const Request *request = data;
    Volume *volume = request->vdb->volume(request->file, request->name, e);
    bool done = volume && child_write(output, volume, 1, sizeof *volume, e) &&
                child_write(output, volume->value, count_of(volume), sizeof *volume->value, e);
    volume_free(volume);
    return done;
}

static bool is_sane(const Volume *v, int64_t left)
{
    for (int i = 0; i < 3; i++) {
        if (v->size[i] < 1 || v->size[i] > VOLUME_MOST) {
            return false;
        }
    }
    return (v->components == 1 || v->components == 3) &&
           left == count_of(v) * (int64_t)sizeof *v->value;
}

// Replaces numbers that are not finite, and finds the range.
static void mend(Volume *v)
{
    v->lowest = INFINITY;
    v->highest = -INFINITY;
    for (int64_t i = 0; i < count_of(v); i++) {
        v->value[i] = isfinite(v->value[i]) ? v->value[i] : 0.0f;
        v->lowest = fminf(v->lowest, v->value[i]);
        v->highest = fmaxf(v->highest, v->value[i]);
    }
    for (int i = 0; i < 3; i++) {
        v->background[i] = isfinite(v->background[i]) ? v->background[i] : 0.0f;
    }
}

static Volume *take(ChildOutput *output, Error *e)
{
    Volume header;
    if (!child_read(output, &header, 1, sizeof header, e)) {
        return NULL;
    }
    if (!is_sane(&header, output->left)) {
        error_set(e, ERROR_INPUT, "the reader's result makes no sense; " WANTED " is needed");
        return NULL;
    }
    Volume *volume = volume_new(header.size, header.components, e);
    if (volume) {
        float *value = volume->value;
        *volume = header;
        volume->value = value;
    }
    if (!volume || !child_read(output, volume->value, count_of(volume), sizeof(float), e)) {
        volume_free(volume);
        return NULL;
    }
    mend(volume);
    return volume;
}

Volume *volume_read(const char *file, const char *name, const Run *run, Error *e)
{
    const VdbReaders *vdb = plugin_table(VDB_PLUGIN, VDB_READERS, sizeof *vdb, e);
    if (!vdb) {
        return NULL;
    }
    Request request = {file, name && name[0] ? name : NULL, vdb};
    ChildJob job = {.task = read_in_child,
                    .data = &request,
                    .file = file,
                    .wanted = WANTED,
                    .seconds = SECONDS,
                    .memory = (int64_t)MEMORY};
    ChildOutput output;
    if (!child_run(&job, run, &output, e)) {
        return NULL;
    }
    Volume *volume = take(&output, e);
    child_output_close(&output);
    if (!volume) {
        error_locate(e, file, 0, 0);
    }
    return volume;
}
