#include "grow/light/light.h"

#include "grow/light/attractors.h"
#include "grow/light/season.h"

enum { MOST_METAMERS = 8000000 };

LightParams light_params_default(void)
{
    return (LightParams){.seasons = 50,
                         .apical_control = {0.56f, 0.45f},
                         .maturing = {0.12f, 0.35f},
                         .vigor = 2.75f,
                         .shoot = {6.0f, 6.0f, 6.0f},
                         .shade = 0.5f,
                         .leaf_seasons = 2,
                         .light_need = 0.3f,
                         .branch_angle = {66.0f, 58.0f, 52.0f},
                         .angle_spread = 8.0f,
                         .phyllotaxis = 137.5f,
                         .buds = 1,
                         .tropism = {0.04f, 0.0f, 0.0f},
                         .phototropism = 0.05f,
                         .zigzag = 26.0f,
                         .noise = 0.2f,
                         .bole = 0.14f,
                         .snags = 0.25f};
}

static bool grow_season(Plant *plant, const LightParams *params, const LightSite *site,
                        Around *around, Attractors *attractors, int season, const Run *run,
                        Error *e)
{
    SeasonLight light;
    if (!attractors_draw(attractors, plant, season, params->leaf_seasons, run->threads, e) ||
        !season_light_init(&light, plant, params, around, season, run, e)) {
        return false;
    }
    light.attractors = attractors;
    bool done = plant_grow_season(plant, params, site, &light, season, run->threads, e);
    season_light_clear(&light);
    return done;
}

static bool grow_seasons(Plant *plant, const LightParams *params, const LightSite *site,
                         const Run *run, Error *e)
{
    Around around = {0};
    Attractors attractors;
    int64_t most = site->metamers > 0 ? site->metamers : MOST_METAMERS;
    bool done =
        attractors_init(&attractors, site, e) && around_init(&around, site, run->threads, e);
    for (int season = 0; done && season < site->seasons && plant->count < most; season++) {
        run_progress(run, "growing by light", (double)season / (double)site->seasons);
        done = (!run_is_cancelled(run) || run_cancel_error(e)) &&
               grow_season(plant, params, site, &around, &attractors, season, run, e);
    }
    around_clear(&around);
    attractors_clear(&attractors);
    return done;
}

OutTree *light_grow(const OutTree *start, const LightParams *params, const LightSite *site,
                    const Run *run, Error *e)
{
    Plant plant;
    if (start->count < 1 || !(site->internode > 0.0f)) {
        error_set(e, ERROR_INPUT, "growth by light needs a start and an internode above 0");
        return NULL;
    }
    if (!plant_init(&plant, start, params, site, e)) {
        return NULL;
    }
    OutTree *tree =
        grow_seasons(&plant, params, site, run, e) ? plant_out_tree(&plant, params, site, e) : NULL;
    plant_clear(&plant);
    return tree;
}
