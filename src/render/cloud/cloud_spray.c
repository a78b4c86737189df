// A parcel's density is (1 - d^2 / R^2)^3 to its radius R: smooth, and nothing beyond. Of one that
// is drawn out, distances along that direction are measured in shares of its longer half axis.
#include "render/cloud/cloud_spray.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define RESOLVED 4.0f // voxels of the mean radius
#define LEAST 1.5f    // and at least of any: it widens to that
enum { MOST_ACROSS = 1536, MOST_SAMPLES = 30000000 };

typedef struct Splat {
    SparseVolume *volume;
    Vec3 low;    // m, of sample (0, 0, 0)
    float voxel; // m
} Splat;

static Aabb box_of(const SprayParcels *spray, float least)
{
    Aabb box = {vec3_splat(INFINITY), vec3_splat(-INFINITY)};
    for (int64_t i = 0; i < spray->count; i++) {
        const SprayParcel *parcel = &spray->parcel[i];
        Vec3 reach = {spray_reach(parcel, 0, least), spray_reach(parcel, 1, least),
                      spray_reach(parcel, 2, least)};
        box.low = vec3_min(box.low, vec3_sub(parcel->center, reach));
        box.high = vec3_max(box.high, vec3_add(parcel->center, reach));
    }
    return box;
}

// m: the harmonic mean radius by content, which small parcels lower; 0 without parcels.
static float small_radius(const SprayParcels *spray)
{
    double contents = 0.0, inverse = 0.0;
    for (int64_t i = 0; i < spray->count; i++) {
        const SprayParcel *parcel = &spray->parcel[i];
        contents += (double)parcel->content;
        inverse += (double)parcel->content / (double)parcel->radius;
    }
    return contents > 0.0 ? (float)(contents / inverse) : 0.0f;
}

float cloud_spray_voxel(const SprayParcels *spray)
{
    float voxel = small_radius(spray) / RESOLVED;
    if (!(voxel > 0.0f)) {
        return 1.0f;
    }
    Aabb box = box_of(spray, 0.0f);
    Vec3 size = vec3_sub(box.high, box.low);
    voxel = fmaxf(voxel, aabb_extent(box) / MOST_ACROSS);
    double samples = 0.0; // about, if none overlap
    for (int64_t i = 0; i < spray->count; i++) {
        double each = 1.0;
        for (int axis = 0; axis < 3; axis++) {
            float reach = spray_reach(&spray->parcel[i], axis, 0.0f);
            each *= 2.0 * (double)(reach / voxel) + SPARSE_SIDE;
        }
        samples += each;
    }
    double all = (double)size.x * (double)size.y * (double)size.z / pow((double)voxel, 3.0);
    double most = fmin(samples, all) / MOST_SAMPLES;
    return most > 1.0 ? voxel * (float)cbrt(most) : voxel;
}

// The samples of a parcel along an axis.
static void range_of(const Splat *s, const SprayParcel *parcel, int axis, int *first, int *last)
{
    float reach = spray_reach(parcel, axis, LEAST * s->voxel) / s->voxel;
    float at = (vec3_axis(parcel->center, axis) - vec3_axis(s->low, axis)) / s->voxel;
    *first = (int)ceilf(at - reach);
    *last = (int)floorf(at + reach);
}

// Calls for all blocks that parcels touch: gives them numbers if they have none.
static int32_t mark_blocks(const Splat *s, const SprayParcels *spray, const int blocks[3],
                           int32_t *block)
{
    int32_t kept = 0;
    for (int64_t i = 0; i < spray->count; i++) {
        int first[3], last[3];
        for (int axis = 0; axis < 3; axis++) {
            range_of(s, &spray->parcel[i], axis, &first[axis], &last[axis]);
        }
        for (int z = first[2] >> 3; z <= last[2] >> 3; z++) {
            for (int y = first[1] >> 3; y <= last[1] >> 3; y++) {
                for (int x = first[0] >> 3; x <= last[0] >> 3; x++) {
                    int32_t *at = &block[((int64_t)z * blocks[1] + y) * blocks[0] + x];
                    *at = *at < 0 ? kept++ : *at;
                }
            }
        }
    }
    return kept;
}

static float kernel(const Splat *s, const SprayParcel *parcel, int x, int y, int z)
{
    float reach = fmaxf(parcel->radius, LEAST * s->voxel), drawn = vec3_length(parcel->drawn);
    Vec3 p = vec3_madd(s->low, s->voxel, vec3((float)x, (float)y, (float)z));
    Vec3 off = vec3_scale(vec3_sub(p, parcel->center), 1.0f / reach);
    float left = 1.0f - vec3_dot(off, off);
    if (drawn > 0.0f) {
        float along = vec3_dot(off, parcel->drawn) / drawn, share = reach / (reach + drawn);
        left += along * along * (1.0f - share * share);
    }
    return left > 0.0f ? left * left * left : 0.0f;
}

// Adds the parcel's kernel times a factor, or with factor 0 only sums it. Returns the sum.
static double sweep(const Splat *s, const SprayParcel *parcel, float factor)
{
    int first[3], last[3];
    for (int axis = 0; axis < 3; axis++) {
        range_of(s, parcel, axis, &first[axis], &last[axis]);
    }
    SparseVolume *v = s->volume;
    double sum = 0.0;
    for (int z = first[2]; z <= last[2]; z++) {
        for (int y = first[1]; y <= last[1]; y++) {
            for (int x = first[0]; x <= last[0]; x++) {
                float value = kernel(s, parcel, x, y, z);
                sum += (double)value;
                if (factor > 0.0f && value > 0.0f) {
                    int64_t at = ((int64_t)(z >> 3) * v->blocks[1] + (y >> 3)) * v->blocks[0];
                    int64_t place = (int64_t)v->block[at + (x >> 3)] * SPARSE_SAMPLES;
                    v->value[place + ((x & 7) * 8 + (y & 7)) * 8 + (z & 7)] += factor * value;
                }
            }
        }
    }
    return sum;
}

static void fill(const Splat *s, const SprayParcels *spray)
{
    double volume = pow((double)s->voxel, 3.0);
    for (int64_t i = 0; i < spray->count; i++) {
        const SprayParcel *parcel = &spray->parcel[i];
        double sum = sweep(s, parcel, 0.0f) * volume;
        if (sum > 0.0) {
            sweep(s, parcel, (float)((double)parcel->content / sum));
        }
    }
    SparseVolume *v = s->volume;
    for (int64_t i = 0; i < (int64_t)v->kept * SPARSE_SAMPLES; i++) {
        v->highest = fmaxf(v->highest, v->value[i]);
    }
}

SparseVolume *cloud_spray_volume(const SprayParcels *spray, Error *e)
{
    if (spray->count == 0) {
        const int one[3] = {1, 1, 1};
        return sparse_volume_new(one, 0, e);
    }
    float voxel = cloud_spray_voxel(spray);
    Aabb box = box_of(spray, LEAST * voxel);
    Splat s = {.low = vec3_sub(box.low, vec3_splat(voxel)), .voxel = voxel};
    int blocks[3];
    int64_t all = 1;
    for (int axis = 0; axis < 3; axis++) {
        float size = vec3_axis(box.high, axis) - vec3_axis(s.low, axis);
        blocks[axis] = (int)(size / voxel) / SPARSE_SIDE + 2;
        all *= blocks[axis];
    }
    int32_t *block = memory_alloc(all, sizeof *block, e);
    for (int64_t i = 0; block && i < all; i++) {
        block[i] = -1;
    }
    s.volume = block ? sparse_volume_new(blocks, mark_blocks(&s, spray, blocks, block), e) : NULL;
    if (s.volume) {
        for (int64_t i = 0; i < all; i++) {
            s.volume->block[i] = block[i];
        }
        Transform *t = &s.volume->to_index;
        for (int axis = 0; axis < 3; axis++) {
            t->m[axis][axis] = 1.0f / voxel;
            t->m[axis][3] = -vec3_axis(s.low, axis) / voxel;
        }
        fill(&s, spray);
    }
    free(block);
    return s.volume;
}
