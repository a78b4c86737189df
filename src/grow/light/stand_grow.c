// Growth of several plants that share one grid of light.
#include "grow/light/light.h"

#include "base/memory.h"
#include "grow/light/season.h"
#include "grow/light/stand.h"

#include <stdlib.h>

typedef struct Growing {
    Plant plant;
    Vec3 *leaf; // m
    int64_t leaf_capacity;
    Error error;
} Growing;

static int most_seasons(const StandPlant *plant, int count)
{
    int most = 0;
    for (int i = 0; i < count; i++) {
        most = plant[i].site.seasons > most ? plant[i].site.seasons : most;
    }
    return most;
}

static bool give_leaves(Growing *one, const StandPlant *of, int number, int season,
                        LightStand *stand, Error *e)
{
    const Plant *plant = &one->plant;
    float internode = of->site.internode;
    int64_t count = 0;
    if (!memory_reserve(&one->leaf, &one->leaf_capacity, plant->living_count, sizeof *one->leaf,
                        e)) {
        return false;
    }
    for (int64_t i = 0; season >= 0 && i < plant->living_count; i++) {
        const Metamer *m = &plant->metamer[plant->living[i]];
        if (metamer_has_leaves(m, season, of->params.leaf_seasons)) {
            one->leaf[count++] = vec3_madd(of->site.foot, internode, m->position);
        }
    }
    return light_stand_give(stand, number, one->leaf, count,
                            of->params.shade * internode * internode, SEASON_LIGHT_CELL * internode,
                            e);
}

// One season of all; the last of those that grow longest is number `most` - 1.
static bool grow_season(Growing *growing, const StandPlant *plant, int count, int season, int most,
                        LightStand *stand, const Run *run, Error *e)
{
    for (int i = 0; i < count; i++) {
        int own = season - (most - plant[i].site.seasons);
        if (!give_leaves(&growing[i], &plant[i], i, own, stand, e)) {
            return false;
        }
    }
    if (!light_stand_solve(stand, run->threads, e)) {
        return false;
    }
#pragma omp parallel for num_threads(run->threads) schedule(dynamic)
    for (int i = 0; i < count; i++) {
        int own = season - (most - plant[i].site.seasons);
        SeasonLight light = {.site = &plant[i].site, .stand = stand};
        if (own >= 0) {
            plant_grow_season(&growing[i].plant, &plant[i].params, &plant[i].site, &light, own, 1,
                              &growing[i].error);
        }
    }
    for (int i = 0; i < count; i++) {
        if (growing[i].error.code != ERROR_NONE) {
            *e = growing[i].error;
            return false;
        }
    }
    return true;
}

static bool begin(Growing *growing, const StandPlant *plant, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        if (plant[i].start->count < 1 || !(plant[i].site.internode > 0.0f)) {
            return error_set(e, ERROR_INPUT,
                             "growth by light needs a start and an internode above 0");
        }
        if (!plant_init(&growing[i].plant, plant[i].start, &plant[i].params, &plant[i].site, e)) {
            return false;
        }
    }
    return true;
}

static bool hand_out(const Growing *growing, StandPlant *plant, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        plant[i].grown = plant_out_tree(&growing[i].plant, &plant[i].params, &plant[i].site, e);
        if (!plant[i].grown) {
            for (int k = 0; k < i; k++) {
                out_tree_free(plant[k].grown);
                plant[k].grown = NULL;
            }
            return false;
        }
    }
    return true;
}

bool light_grow_stand(StandPlant *plant, int count, const Vec3 *copy, int copies, const Run *run,
                      Error *e)
{
    Error own = {0};
    e = e ? e : &own;
    Growing *growing = memory_alloc_zero(count, sizeof *growing, e);
    LightStand *stand = growing ? light_stand_new(count, e) : NULL;
    bool done = stand && begin(growing, plant, count, e);
    int most = most_seasons(plant, count);
    if (stand) {
        light_stand_repeat(stand, copy, copies);
    }
    for (int season = 0; done && season < most; season++) {
        run_progress(run, "growing a stand by light", (double)season / (double)most);
        done = (!run_is_cancelled(run) || run_cancel_error(e)) &&
               grow_season(growing, plant, count, season, most, stand, run, e);
    }
    done = done && hand_out(growing, plant, count, e);
    for (int i = 0; growing && i < count; i++) {
        plant_clear(&growing[i].plant);
        free(growing[i].leaf);
    }
    free(growing);
    light_stand_free(stand);
    return done;
}
