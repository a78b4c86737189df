#include "grow/light/shed.h"

// Takenaka's criterion (1994): the light of a branch by its size.
static bool is_starving(const Metamer *m, const LightParams *params)
{
    float bare = (float)(m->size - m->leafy);
    float kept = (float)m->leafy + params->upkeep * bare;
    return m->leafy == 0 || m->income < params->light_need * kept;
}

int64_t plant_shed(Plant *plant, const LightParams *params, int season, float bole)
{
    int64_t shed = 0;
    for (int64_t k = 0; k < plant->living_count; k++) {
        int32_t i = plant->living[k];
        Metamer *m = &plant->metamer[i];
        if (m->parent < 0) {
            continue;
        }
        const Metamer *base = &plant->metamer[m->parent];
        if (base->died != PLANT_ALIVE) {
            m->died = base->died;
            continue;
        }
        bool low = base->order == 0 && base->position.y < bole;
        bool branch = base->next != i; // not what continues the axis
        if (branch && (low || is_starving(m, params))) {
            m->died = season;
            shed++;
        }
        if ((m->order == 0 && m->position.y < bole) ||
            !metamer_has_leaves(m, season, params->leaf_seasons)) {
            m->buds = 0;
        }
    }
    if (shed > 0) {
        plant_bury(plant);
    }
    return shed;
}
