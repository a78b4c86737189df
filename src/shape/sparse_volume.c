#include "shape/sparse_volume.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int64_t block_count(const SparseVolume *v)
{
    return (int64_t)v->blocks[0] * v->blocks[1] * v->blocks[2];
}

SparseVolume *sparse_volume_new(const int blocks[3], int32_t kept, Error *e)
{
    SparseVolume *v = memory_alloc_zero(1, sizeof *v, e);
    if (!v) {
        return NULL;
    }
    memcpy(v->blocks, blocks, sizeof v->blocks);
    v->kept = kept;
    v->to_index = transform_identity();
    v->block = memory_alloc(block_count(v), sizeof *v->block, e);
    v->value = v->block ? memory_alloc_zero((int64_t)kept * SPARSE_SAMPLES + 1, sizeof *v->value, e)
                        : NULL;
    if (!v->value) {
        sparse_volume_free(v);
        return NULL;
    }
    memset(v->block, 0xff, sizeof *v->block * (size_t)block_count(v)); // all -1
    return v;
}

void sparse_volume_free(SparseVolume *v)
{
    if (v) {
        free(v->block);
        free(v->value);
        free(v);
    }
}

int64_t sparse_volume_bytes(const SparseVolume *v)
{
    return block_count(v) * (int64_t)sizeof *v->block +
           (int64_t)v->kept * SPARSE_SAMPLES * (int64_t)sizeof *v->value;
}

float sparse_volume_at(const SparseVolume *v, Vec3 p)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    float s = p.x - fx, t = p.y - fy, u = p.z - fz, row[4];
    for (int k = 0; k < 4; k++) {
        int i = x + (k & 1), j = y + (k >> 1);
        row[k] = lerpf(sparse_volume_sample(v, i, j, z), sparse_volume_sample(v, i, j, z + 1), u);
    }
    return lerpf(lerpf(row[0], row[1], s), lerpf(row[2], row[3], s), t);
}
