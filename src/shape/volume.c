#include "shape/volume.h"

#include "base/child.h"
#include "base/memory.h"
#include "shape/vdb_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WANTED "an OpenVDB file with a grid of floats or of float vectors"
#define SECONDS 120.0
#define MEMORY 2e9

typedef struct Request {
    const char *file, *name;
} Request;

Volume *volume_new(const int size[3], int components, Error *e)
{
    Volume *volume = memory_alloc_zero(1, sizeof *volume, e);
    int64_t count = (int64_t)size[0] * size[1] * size[2] * components;
    if (volume && (volume->value = memory_alloc_zero(count, sizeof *volume->value, e))) {
        memcpy(volume->size, size, sizeof volume->size);
        volume->components = components;
        return volume;
    }
    free(volume);
    return NULL;
}

void volume_free(Volume *volume)
{
    if (volume) {
        free(volume->value);
        free(volume);
    }
}

static int64_t count_of(const Volume *v)
{
    return (int64_t)v->size[0] * v->size[1] * v->size[2] * v->components;
}

// ---- reading

static bool read_in_child(const void *data, ChildOutput *output, Error *e)
{
    const Request *request = data;
    Volume *volume = vdb_volume(request->file, request->name, e);
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
    Request request = {file, name && name[0] ? name : NULL};
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

// ---- sampling

void volume_at(const Volume *v, Vec3 p, float *value)
{
    Vec3 at = transform_point(&v->to_index, p);
    const float place[3] = {at.x, at.y, at.z};
    int low[3];
    float share[3];
    for (int i = 0; i < 3; i++) {
        if (!(place[i] > -1.0f && place[i] < (float)v->size[i])) {
            memcpy(value, v->background, sizeof(float) * (size_t)v->components);
            return;
        }
        float floor = floorf(place[i]);
        low[i] = (int)floor;
        share[i] = place[i] - floor;
    }
    for (int c = 0; c < v->components; c++) {
        value[c] = 0.0f;
    }
    for (int corner = 0; corner < 8; corner++) {
        const float *found = v->background;
        int64_t index = 0;
        float weight = 1.0f;
        for (int i = 2; i >= 0; i--) {
            int k = low[i] + (corner >> i & 1);
            weight *= corner >> i & 1 ? share[i] : 1.0f - share[i];
            index = k < 0 || k >= v->size[i] || index < 0 ? -1 : index * v->size[i] + k;
        }
        found = index >= 0 ? v->value + index * v->components : found;
        for (int c = 0; c < v->components; c++) {
            value[c] += weight * found[c];
        }
    }
}
