#include "grow/light/share.h"

#define SIDE_BUD 0.5f // light that a side bud has of that of a terminal bud on the same metamer

static int count_bits(uint32_t bits)
{
    int count = 0;
    for (; bits; bits &= bits - 1u) {
        count++;
    }
    return count;
}

static float bud_weights(const Metamer *m)
{
    return (m->terminal ? 1.0f : 0.0f) + SIDE_BUD * (float)count_bits(m->buds);
}

float metamer_terminal_light(const Metamer *m)
{
    return m->terminal ? m->claim * m->light / bud_weights(m) : 0.0f;
}

float metamer_bud_light(const Metamer *m)
{
    return m->buds ? SIDE_BUD * m->claim * m->light / bud_weights(m) : 0.0f;
}

void plant_sum_light(Plant *plant, int season, int leaf_seasons)
{
    for (int64_t i = 0; i < plant->living_count; i++) {
        Metamer *m = &plant->metamer[plant->living[i]];
        bool leaves = metamer_has_leaves(m, season, leaf_seasons);
        m->leafy = leaves;
        m->size = 1;
        m->income = leaves ? m->light : 0.0f;
        m->claims = m->claim * m->income;
    }
    for (int64_t i = plant->living_count - 1; i >= 0; i--) {
        const Metamer *m = &plant->metamer[plant->living[i]];
        if (m->parent >= 0) {
            plant->metamer[m->parent].income += m->income;
            plant->metamer[m->parent].claims += m->claims;
            plant->metamer[m->parent].leafy += m->leafy;
            plant->metamer[m->parent].size += m->size;
        }
    }
}

// Shares a fork's growth: *axis, and *per_light of each side branch or bud.
static void share_fork(const Plant *plant, const Metamer *m, float control, float *axis,
                       float *per_light)
{
    float ahead = m->next >= 0 ? plant->metamer[m->next].claims : metamer_terminal_light(m);
    float beside = (float)count_bits(m->buds) * metamer_bud_light(m);
    for (int32_t k = m->lateral; k >= 0; k = plant->metamer[k].sibling) {
        const Metamer *side = &plant->metamer[k];
        beside += side->died == PLANT_ALIVE ? side->vigor * side->claims : 0.0f;
    }
    float all = control * ahead + (1.0f - control) * beside;
    *axis = all > 0.0f ? m->growth * control * ahead / all : 0.0f;
    *per_light = all > 0.0f ? m->growth * (1.0f - control) / all : 0.0f;
}

void plant_share_growth(Plant *plant, float vigor, float control)
{
    for (int64_t i = 0; i < plant->living_count; i++) {
        Metamer *m = &plant->metamer[plant->living[i]];
        if (m->parent < 0) {
            m->growth = vigor * m->claims;
        }
        float axis, per_light;
        share_fork(plant, m, control, &axis, &per_light);
        if (m->next >= 0) {
            plant->metamer[m->next].growth = axis;
        }
        for (int32_t k = m->lateral; k >= 0; k = plant->metamer[k].sibling) {
            Metamer *side = &plant->metamer[k];
            side->growth = per_light * side->vigor * side->claims;
        }
    }
}

float metamer_bud_growth(const Plant *plant, const Metamer *m, float control, float *each_bud)
{
    float axis, per_light;
    share_fork(plant, m, control, &axis, &per_light);
    *each_bud = m->buds ? per_light * metamer_bud_light(m) : 0.0f;
    return m->terminal ? axis : 0.0f;
}
