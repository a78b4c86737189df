#include "land/jointing_parts.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

static bool break_scale(const JointScale *s, float *out, const Run *run)
{
    const HeightField *field = s->field;
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < field->rows; row++) {
        if (run_is_cancelled(run)) {
            continue;
        }
        float z = field->origin.y + (float)row * field->cell.y;
        for (int column = 0; column < field->columns; column++) {
            int64_t i = (int64_t)row * field->columns + column;
            float x = field->origin.x + (float)column * field->cell.x;
            float mask = s->shown * s->mask[i];
            out[i] = mask > 0.0f ? jointing_height(s, x, z, mask) : s->rock[i];
        }
    }
    return !run_is_cancelled(run);
}

float jointing_reach(const JointingParams *params)
{
    float spacing = params->spacing, sum = 0.0f;
    for (int k = 0; k < params->scales; k++, spacing *= JOINTING_RATIO) {
        float block = JOINT_LONGEST * (0.5f + 0.5f + 0.4f) + JOINT_MASK;
        sum += spacing * (block + params->relief + 2.0f * params->gullies);
    }
    return sum;
}

static Vec2 toward(float azimuth)
{
    float sine, cosine;
    exact_sincos(azimuth * 0.017453292f, &sine, &cosine);
    return (Vec2){sine, -cosine};
}

static JointScale scale_of(const JointingParams *params, const HeightField *field, int number)
{
    JointScale s = {.params = params, .field = field, .spacing = params->spacing};
    for (int k = 0; k < number; k++) {
        s.spacing *= JOINTING_RATIO;
    }
    s.thick = params->bedding * s.spacing;
    s.throws = number == 0 ? params->throws : 0.0f;
    s.shown = smoothstepf(1.8f, 3.2f, s.spacing / field->cell.x);
    s.key = random_key(params->seed, (uint64_t)number);
    float turn = random_range(random_key(s.key, 99), -7.0f, 7.0f) * (number > 0 ? 1.0f : 0.0f);
    for (int set = 0; set < JOINT_SETS; set++) {
        Vec2 strike = toward(params->azimuth + (float)set * params->angle + turn);
        s.along[set] = strike;
        s.normal[set] = (Vec2){-strike.y, strike.x};
    }
    return s;
}

// Loose ground stays where rock has gone from under it, up to a few times its depth: scree fills
// gullies, but no thin soil stands as a wall.
static void cover_again(HeightField *field, const float *rock, const float *touched)
{
    for (int64_t i = 0; i < height_field_count(field); i++) {
        if (!(touched[i] > 0.0f)) {
            continue;
        }
        float before = field->height[i], loose = field->loose ? field->loose[i] : 0.0f;
        float left = clampf(before - rock[i], 0.0f, 3.0f * loose);
        field->height[i] = rock[i] + left;
        if (field->loose) {
            field->loose[i] = left;
            if (field->wetness) {
                field->wetness[i] = left / (left + 1.0f);
            }
        }
        if (field->change) {
            field->change[i] += field->height[i] - before;
        }
    }
}

bool jointing_break(HeightField *field, const JointingParams *params, const Strata *strata,
                    const Run *run, Error *e)
{
    enum { ARRAYS = 6 };
    int64_t count = height_field_count(field);
    float *all = memory_alloc(ARRAYS * count, sizeof *all, e);
    if (!all) {
        return false;
    }
    float *rock = all, *next = all + count, *mask = all + 2 * count, *dx = all + 3 * count,
          *dz = all + 4 * count, *touched = all + 5 * count;
    for (int64_t i = 0; i < count; i++) {
        rock[i] = field->height[i] - (field->loose ? field->loose[i] : 0.0f);
        touched[i] = 0.0f;
    }
    bool done = true;
    for (int k = 0; done && k < params->scales; k++) {
        JointScale s = scale_of(params, field, k);
        if (s.shown <= 0.0f) {
            break;
        }
        run_progress(run, "joints", (double)k / params->scales);
        s.strata = strata;
        s.rock = rock;
        s.mask = mask;
        s.dx = dx;
        s.dz = dz;
        jointing_find_steep(&s, mask, dx, dz, next, run->threads);
        done = break_scale(&s, next, run);
        for (int64_t i = 0; i < count; i++) {
            touched[i] = fmaxf(touched[i], mask[i]);
        }
        float *swap = rock;
        rock = next;
        next = swap;
    }
    if (done) {
        cover_again(field, rock, touched);
    }
    free(all);
    return done || run_cancel_error(e);
}
