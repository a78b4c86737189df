#include "grow/light/season_light.h"

#include "grow/light/stand.h"

#define BORDER 2.5f // cells about the plant
enum { MOST_CELLS = 400000 };

// Low corners lie on a lattice about the foot, so that a plant's growth shifts no cell borders.
static Vec3 snapped(Vec3 p, float cell)
{
    return vec3(cell * floorf(p.x / cell), cell * floorf(p.y / cell), cell * floorf(p.z / cell));
}

static ShadeGrid *make_grid(const Plant *plant, const LightParams *params, const LightSite *site,
                            const Around *around, int season, const Run *run, Error *e)
{
    Aabb box = plant_bounds(plant);
    float margin = around_margin(around, box);
    Vec3 border = vec3_splat(BORDER * SEASON_LIGHT_CELL);
    border.x += margin;
    border.z += margin;
    box.low = snapped(vec3_sub(box.low, border), SEASON_LIGHT_CELL);
    box.high = vec3_add(box.high, border);
    ShadeGrid *grid =
        shade_grid_new(box, SEASON_LIGHT_CELL, site->cells > 0 ? site->cells : MOST_CELLS, e);
    if (!grid) {
        return NULL;
    }
    around_shade(around, params->shade, grid);
    for (int64_t i = 0; i < plant->living_count; i++) {
        const Metamer *m = &plant->metamer[plant->living[i]];
        if (metamer_has_leaves(m, season, params->leaf_seasons)) {
            shade_grid_add_leaves(grid, m->position, params->shade);
        }
    }
    if (!shade_grid_solve(grid, run->threads, e)) {
        shade_grid_free(grid);
        return NULL;
    }
    return grid;
}

bool season_light_init(SeasonLight *light, const Plant *plant, const LightParams *params,
                       Around *around, int season, const Run *run, Error *e)
{
    const LightSite *site = around->site;
    *light = (SeasonLight){.site = site};
    if (around_shares_light(around)) {
        return around_give_leaves(around, plant, params, SEASON_LIGHT_CELL, season, e) &&
               around_meet(around, plant, season, params->leaf_seasons, e) &&
               site->room->carry_light(site->room->user, run->threads, e);
    }
    if (around_meet(around, plant, season, params->leaf_seasons, e)) {
        light->grid = make_grid(plant, params, site, around, season, run, e);
    }
    return light->grid;
}

void season_light_clear(SeasonLight *light)
{
    shade_grid_free(light->grid);
    light->grid = NULL;
}

static Vec3 place(const SeasonLight *light, Vec3 p)
{
    return vec3_madd(light->site->foot, light->site->internode, p);
}

float season_light_at(const SeasonLight *light, Vec3 p)
{
    const Room *room = light->site->room;
    if (light->grid) {
        return shade_grid_light(light->grid, p);
    }
    p = place(light, p);
    return light->stand ? light_stand_light(light->stand, p) : room->light(room->user, p);
}

Vec3 season_light_brightest(const SeasonLight *light, Vec3 p)
{
    const Room *room = light->site->room;
    if (light->grid) {
        return shade_grid_brightest(light->grid, p);
    }
    p = place(light, p);
    return light->stand ? light_stand_brightest(light->stand, p) : room->brightest(room->user, p);
}
