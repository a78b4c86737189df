#include "grow/light/light.h"

#include "grow/light/season_light.h"
#include "grow/light/share.h"
#include "grow/light/shed.h"
#include "grow/light/shoots.h"

#define GROUND 1.0f       // internodes: branches do not sink below
#define LOW_BRANCHES 0.6f // of the bole: nor below this
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

static void catch_light(Plant *plant, const SeasonLight *light, const LightParams *params,
                        int season, int threads)
{
    threads = plant->living_count < 4000 ? 1 : threads; // a team would cost more than it saves
#pragma omp parallel for num_threads(threads) schedule(static)
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

static bool grow_season(Plant *plant, const LightParams *params, const LightSite *site,
                        Around *around, int season, const Run *run, Error *e)
{
    SeasonLight light;
    if (!season_light_init(&light, plant, params, around, season, run, e)) {
        return false;
    }
    float control = control_at(params, season);
    float bole = params->bole * plant_bounds(plant).high.y;
    catch_light(plant, &light, params, season, run->threads);
    plant_sum_light(plant, season, params->leaf_seasons);
    if (plant_shed(plant, params, season, bole) > 0) {
        plant_sum_light(plant, season, params->leaf_seasons);
    }
    plant_share_growth(plant, params->vigor, control);
    float low = LOW_BRANCHES * bole > GROUND ? LOW_BRANCHES * bole : GROUND;
    bool done = plant_make_shoots(plant, params, site, &light, season, control, low, e);
    season_light_clear(&light);
    return done;
}

static bool grow_seasons(Plant *plant, const LightParams *params, const LightSite *site,
                         const Run *run, Error *e)
{
    Around around;
    int64_t most = site->metamers > 0 ? site->metamers : MOST_METAMERS;
    bool done = around_init(&around, site, run->threads, e);
    for (int season = 0; done && season < site->seasons && plant->count < most; season++) {
        run_progress(run, "growing by light", (double)season / (double)site->seasons);
        done = (!run_is_cancelled(run) || run_cancel_error(e)) &&
               grow_season(plant, params, site, &around, season, run, e);
    }
    around_clear(&around);
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
