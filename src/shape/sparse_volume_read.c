// Reads sparse volumes in a child process and checks its result.
#include "base/child.h"
#include "base/memory.h"
#include "base/plugin.h"
#include "shape/vdb.h"

#include <math.h>
#include <string.h>

#define WANTED "an OpenVDB file with a grid of floats"
#define SECONDS 300.0
#define MEMORY 16e9 // so large are the largest clouds that are published

typedef struct Request {
    const char *file, *name;
    const VdbReaders *vdb;
} Request;

// What the child sends before blocks and values, or alone.
typedef struct Header {
    int blocks[3];
    int32_t kept;
    Transform to_index;
} Header;

static int64_t count_of(const int blocks[3])
{
    return (int64_t)blocks[0] * blocks[1] * blocks[2];
}

static bool read_in_child(const void *data, ChildOutput *output, Error *e)
{
    const Request *request = data;
    SparseVolume *v = request->vdb->sparse(request->file, request->name, e);
    if (!v) {
        return false;
    }
    Header h = {.kept = v->kept, .to_index = v->to_index};
    memcpy(h.blocks, v->blocks, sizeof h.blocks);
    bool done =
        child_write(output, &h, 1, sizeof h, e) &&
        child_write(output, v->block, count_of(v->blocks), sizeof *v->block, e) &&
        child_write(output, v->value, (int64_t)v->kept * SPARSE_SAMPLES, sizeof *v->value, e);
    sparse_volume_free(v);
    return done;
}

static bool measure_in_child(const void *data, ChildOutput *output, Error *e)
{
    const Request *request = data;
    int64_t bytes = request->vdb->sparse_bytes(request->file, request->name, e);
    return bytes > 0 && child_write(output, &bytes, 1, sizeof bytes, e);
}

static bool is_sane(const Header *h, int64_t left)
{
    for (int i = 0; i < 3; i++) {
        if (h->blocks[i] < 1 || h->blocks[i] > SPARSE_MOST) {
            return false;
        }
    }
    int64_t count = count_of(h->blocks);
    if (count > SPARSE_MOST_ALL || h->kept < 0 || h->kept > count) {
        return false;
    }
    for (int i = 0; i < 12; i++) {
        if (!isfinite(h->to_index.m[i / 4][i % 4])) {
            return false;
        }
    }
    return left == count * (int64_t)sizeof(int32_t) +
                       (int64_t)h->kept * SPARSE_SAMPLES * (int64_t)sizeof(float);
}

// Replaces what is no density, and finds the highest; false where a block has no values.
static bool mend(SparseVolume *v)
{
    for (int64_t i = 0; i < count_of(v->blocks); i++) {
        if (v->block[i] < -1 || v->block[i] >= v->kept) {
            return false;
        }
    }
    v->highest = 0.0f;
    for (int64_t i = 0; i < (int64_t)v->kept * SPARSE_SAMPLES; i++) {
        v->value[i] = isfinite(v->value[i]) && v->value[i] > 0.0f ? v->value[i] : 0.0f;
        v->highest = fmaxf(v->highest, v->value[i]);
    }
    return true;
}

static SparseVolume *take(ChildOutput *output, Error *e)
{
    Header h;
    if (!child_read(output, &h, 1, sizeof h, e)) {
        return NULL;
    }
    bool sane = is_sane(&h, output->left);
    SparseVolume *v = sane ? sparse_volume_new(h.blocks, h.kept, e) : NULL;
    if (v) {
        v->to_index = h.to_index;
        if (!child_read(output, v->block, count_of(v->blocks), sizeof *v->block, e) ||
            !child_read(output, v->value, (int64_t)v->kept * SPARSE_SAMPLES, sizeof *v->value, e)) {
            sparse_volume_free(v);
            return NULL;
        }
        sane = mend(v);
    }
    if (!sane) {
        error_set(e, ERROR_INPUT, "the reader's result makes no sense; " WANTED " is needed");
        sparse_volume_free(v);
        return NULL;
    }
    return v;
}

static bool run_job(ChildTask *task, const Request *request, const Run *run, ChildOutput *output,
                    Error *e)
{
    ChildJob job = {.task = task,
                    .data = request,
                    .file = request->file,
                    .wanted = WANTED,
                    .seconds = SECONDS,
                    .memory = (int64_t)MEMORY};
    return child_run(&job, run, output, e);
}

SparseVolume *sparse_volume_read(const char *file, const char *name, const Run *run, Error *e)
{
    const VdbReaders *vdb = plugin_table(VDB_PLUGIN, VDB_READERS, sizeof *vdb, e);
    if (!vdb) {
        return NULL;
    }
    Request request = {file, name && name[0] ? name : NULL, vdb};
    ChildOutput output;
    if (!run_job(read_in_child, &request, run, &output, e)) {
        return NULL;
    }
    SparseVolume *v = take(&output, e);
    child_output_close(&output);
    if (!v) {
        error_locate(e, file, 0, 0);
    }
    return v;
}

int64_t sparse_volume_estimate(const char *file, const char *name, const Run *run)
{
    const VdbReaders *vdb = plugin_table(VDB_PLUGIN, VDB_READERS, sizeof *vdb, NULL);
    Request request = {file, name && name[0] ? name : NULL, vdb};
    ChildOutput output;
    if (!vdb || !run_job(measure_in_child, &request, run, &output, NULL)) {
        return 0;
    }
    int64_t bytes = 0;
    bool known = child_read(&output, &bytes, 1, sizeof bytes, NULL) && bytes > 0;
    child_output_close(&output);
    return known && bytes < INT64_MAX / 8 ? bytes : 0;
}
