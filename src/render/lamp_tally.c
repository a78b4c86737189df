#include "render/lamp_tally.h"

#include "base/memory.h"

#include <stdlib.h>

enum { LEVELS = 8 };

static const float QUANTUM = 1.0f / (1 << 24); // of lengths in a voxel, in shares of its side
static const float TRUSTED = 64.0f; // visits with which a voxel counts as much as those around it

int64_t lamp_box_voxels(const LampBox *box)
{
    return (int64_t)box->count[0] * box->count[1] * box->count[2];
}

static int64_t voxel_at(const LampBox *box, int x, int y, int z)
{
    return ((int64_t)z * box->count[1] + y) * box->count[0] + x;
}

// ---- the tally

static void count_visit(LampTally *tally, Vec3 color, float share)
{
    float c[3] = {color.x, color.y, color.z};
    for (int k = 0; k < 3; k++) {
        int64_t quanta = (int64_t)(c[k] * share / QUANTUM + 0.5f);
#pragma omp atomic
        tally->color[k] += quanta;
    }
#pragma omp atomic
    tally->visits += 1;
}

// Counts the lengths of a stretch within each voxel that it crosses (Amanatides and Woo 1987).
void lamp_tally_stretch(LampTally *tally, const LampBox *box, Vec3 from, Vec3 direction, float far,
                        Vec3 color)
{
    Vec3 start = vec3_scale(vec3_sub(from, box->low), 1.0f / box->voxel);
    float o[3] = {start.x, start.y, start.z}, d[3] = {direction.x, direction.y, direction.z};
    float near = 0.0f;
    far /= box->voxel;
    for (int axis = 0; axis < 3; axis++) {
        float inverse = 1.0f / d[axis]; // of 0: infinite, which the comparisons below take
        float a = -o[axis] * inverse, b = ((float)box->count[axis] - o[axis]) * inverse;
        near = fmaxf(near, fminf(a, b));
        far = fminf(far, fmaxf(a, b));
    }
    if (!(near < far)) {
        return;
    }
    int at[3], step[3];
    float next[3], delta[3];
    for (int axis = 0; axis < 3; axis++) {
        float place = o[axis] + near * d[axis];
        at[axis] = (int)clampf(floorf(place), 0.0f, (float)box->count[axis] - 1.0f);
        step[axis] = d[axis] > 0.0f ? 1 : -1;
        delta[axis] = fabsf(1.0f / d[axis]);
        float border = (float)at[axis] + (d[axis] > 0.0f ? 1.0f : 0.0f);
        next[axis] = d[axis] != 0.0f ? (border - o[axis]) / d[axis] : INFINITY;
    }
    while (near < far) {
        int axis = next[0] < next[1] ? 0 : 1;
        axis = next[2] < next[axis] ? 2 : axis;
        float out = fminf(next[axis], far);
        if (out > near) {
            count_visit(&tally[voxel_at(box, at[0], at[1], at[2])], color, out - near);
        }
        near = fmaxf(near, out);
        at[axis] += step[axis];
        next[axis] += delta[axis];
        if ((unsigned)at[axis] >= (unsigned)box->count[axis]) {
            return;
        }
    }
}

// ---- from visits to radiance

// A coarser box, whose voxels are eight of the finer one's.
static LampBox coarser(const LampBox *box)
{
    LampBox out = {.low = box->low, .voxel = 2.0f * box->voxel};
    for (int axis = 0; axis < 3; axis++) {
        out.count[axis] = (box->count[axis] + 1) / 2;
    }
    return out;
}

static void sum_eights(LampTally *to, const LampBox *coarse, const LampTally *from,
                       const LampBox *fine)
{
    for (int z = 0; z < fine->count[2]; z++) {
        for (int y = 0; y < fine->count[1]; y++) {
            for (int x = 0; x < fine->count[0]; x++) {
                const LampTally *t = &from[voxel_at(fine, x, y, z)];
                LampTally *sum = &to[voxel_at(coarse, x / 2, y / 2, z / 2)];
                for (int k = 0; k < 3; k++) {
                    sum->color[k] += t->color[k];
                }
                sum->visits += t->visits;
            }
        }
    }
}

// Interpolates between the middles of voxels.
Vec3 lamp_box_interpolate(const Vec3 *value, const LampBox *box, Vec3 p)
{
    Vec3 own = vec3_scale(vec3_sub(p, box->low), 1.0f / box->voxel);
    float place[3] = {own.x, own.y, own.z}, part[3];
    int at[3][2];
    for (int axis = 0; axis < 3; axis++) {
        float x = clampf(place[axis] - 0.5f, 0.0f, (float)box->count[axis] - 1.0f);
        at[axis][0] = (int)x;
        at[axis][1] = at[axis][0] + 1 < box->count[axis] ? at[axis][0] + 1 : at[axis][0];
        part[axis] = x - (float)at[axis][0];
    }
    Vec3 sum = vec3_splat(0.0f);
    for (int k = 0; k < 8; k++) {
        float weight = 1.0f;
        for (int axis = 0; axis < 3; axis++) {
            weight *= k >> axis & 1 ? part[axis] : 1.0f - part[axis];
        }
        sum = vec3_madd(sum, weight,
                        value[voxel_at(box, at[0][k & 1], at[1][k >> 1 & 1], at[2][k >> 2])]);
    }
    return sum;
}

// Fills value with means; few visits count little beside the values of the coarser box. scale: what
// a quantum is in a voxel of 1 m.
static void settle(Vec3 *value, const LampTally *tally, const LampBox *box, const Vec3 *coarse,
                   const LampBox *coarse_box, float scale)
{
    float quantum = scale / (box->voxel * box->voxel);
    for (int z = 0; z < box->count[2]; z++) {
        for (int y = 0; y < box->count[1]; y++) {
            for (int x = 0; x < box->count[0]; x++) {
                int64_t i = voxel_at(box, x, y, z);
                const LampTally *t = &tally[i];
                value[i] = vec3((float)t->color[0], (float)t->color[1], (float)t->color[2]);
                value[i] = vec3_scale(value[i], quantum);
                if (coarse) {
                    Vec3 middle =
                        vec3_madd(box->low, box->voxel,
                                  vec3((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f));
                    Vec3 around = lamp_box_interpolate(coarse, coarse_box, middle);
                    float trust = (float)t->visits / ((float)t->visits + TRUSTED);
                    value[i] =
                        vec3_add(vec3_scale(value[i], trust), vec3_scale(around, 1.0f - trust));
                }
            }
        }
    }
}

// The means of a level, with those of coarser ones where visits are few. The caller frees them.
// Lengths of coarser voxels are still counted in sides of the finest.
static Vec3 *means(const LampTally *tally, const LampBox *box, float scale, int level, Error *e)
{
    Vec3 *value = memory_alloc_wide(lamp_box_voxels(box), sizeof *value, e);
    LampBox next = coarser(box);
    bool last = level + 1 == LEVELS || lamp_box_voxels(box) == 1;
    LampTally *sums =
        value && !last ? memory_alloc_zero(lamp_box_voxels(&next), sizeof *sums, e) : NULL;
    Vec3 *coarse = NULL;
    if (sums) {
        sum_eights(sums, &next, tally, box);
        // eight times the volume, of which `settle` takes four
        coarse = means(sums, &next, 0.5f * scale, level + 1, e);
    }
    free(sums);
    if (!value || (!last && !coarse)) {
        free(value);
        return NULL;
    }
    settle(value, tally, box, coarse, &next, scale);
    free(coarse);
    return value;
}

Vec3 *lamp_tally_means(const LampTally *tally, const LampBox *box, float scale, Error *e)
{
    return means(tally, box, QUANTUM * scale, 0, e);
}
