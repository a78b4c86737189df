#include "grow/light/season.h"

#include "grow/light/share.h"
#include "grow/light/shed.h"
#include "grow/light/shoots.h"

#define GROUND 1.0f       // internodes: branches do not sink below
#define LOW_BRANCHES 0.6f // of the bole: nor below this

static void catch_light(Plant *plant, const SeasonLight *light, const LightParams *params,
                        int season, int threads)
{
    bool many = plant->living_count >= 4000; // for fewer a team would cost more than it saves
#pragma omp parallel for num_threads(threads) schedule(static) if (many)
    for (int64_t i = 0; i < plant->living_count; i++) {
        Metamer *m = &plant->metamer[plant->living[i]];
        bool leaves = metamer_has_leaves(m, season, params->leaf_seasons);
        m->light = leaves ? season_light_at(light, m->position) : 0.0f;
    }
}

// Apical control in a season: it falls from the young tree's to the old one's.
static float control_at(const LightParams *params, int season)
{
    float share = (float)season / (float)params->seasons;
    float old =
        params->maturing.y > params->maturing.x
            ? clampf((share - params->maturing.x) / (params->maturing.y - params->maturing.x), 0.0f,
                     1.0f)
            : (share >= params->maturing.x ? 1.0f : 0.0f);
    return lerpf(params->apical_control.x, params->apical_control.y, old);
}

bool plant_grow_season(Plant *plant, const LightParams *params, const LightSite *site,
                       const SeasonLight *light, int season, int threads, Error *e)
{
    float control = control_at(params, season);
    float bole = params->bole * plant_bounds(plant).high.y;
    catch_light(plant, light, params, season, threads);
    plant_sum_light(plant, season, params->leaf_seasons);
    if (plant_shed(plant, params, season, bole) > 0) {
        plant_sum_light(plant, season, params->leaf_seasons);
    }
    plant_share_growth(plant, params->vigor, control);
    float low = LOW_BRANCHES * bole > GROUND ? LOW_BRANCHES * bole : GROUND;
    return plant_make_shoots(plant, params, site, light, season, control, low, e);
}
