#include "grow/light/around.h"

#include "base/memory.h"

#include <stdlib.h>

#define MARGIN 0.3f // of the plant's height: low light comes from so far beside it

bool around_init(Around *around, const LightSite *site, Error *e)
{
    *around = (Around){.site = site};
    around->shown = out_tree_new(e);
    return around->shown;
}

void around_clear(Around *around)
{
    out_tree_free(around->shown);
    free(around->leaf);
}

static bool has_rivals(const Around *around)
{
    return around->site->room && around->site->room->meet;
}

// Appends the metamers that are new since the last time.
static bool show(Around *around, const Plant *plant, Error *e)
{
    const LightSite *site = around->site;
    for (int64_t i = around->shown->count; i < plant->count; i++) {
        const Metamer *m = &plant->metamer[i];
        Vec3 at = vec3_madd(site->foot, site->internode, m->position);
        if (out_tree_add_node(around->shown, at, m->parent, m->birth, 0, m->id, e) < 0) {
            return false;
        }
    }
    return true;
}

static void drop_old(Around *around, int oldest)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < around->leaf_count; i++) {
        if (around->leaf[i].season >= oldest) {
            around->leaf[kept++] = around->leaf[i];
        }
    }
    around->leaf_count = kept;
}

bool around_meet(Around *around, const Plant *plant, int season, int leaf_seasons, Error *e)
{
    const Vec3 *rival = NULL;
    int64_t count = 0;
    if (!has_rivals(around)) {
        return true;
    }
    const Room *room = around->site->room;
    int64_t first = around->told;
    if (!show(around, plant, e) ||
        !room->meet(room->user, around->shown, first, &rival, &count, e)) {
        return false;
    }
    around->told = around->shown->count;
    if (count > 0) {
        drop_old(around, season - leaf_seasons);
    }
    if (!memory_reserve(&around->leaf, &around->leaf_capacity, around->leaf_count + count,
                        sizeof *around->leaf, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        Vec3 at = vec3_sub(rival[i], around->site->foot);
        around->leaf[around->leaf_count++] =
            (Leaf){vec3_scale(at, 1.0f / around->site->internode), season};
    }
    return true;
}

float around_margin(const Around *around, Aabb plant)
{
    return around->site->room ? MARGIN * (plant.high.y - plant.low.y) : 0.0f;
}

// Marks the cells that obstacles or the axes of rivals take.
static void mark_taken(const LightSite *site, ShadeGrid *grid, int threads)
{
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (int y = 0; y < grid->size[1]; y++) {
        int64_t at = (int64_t)y * grid->size[0] * grid->size[2];
        for (int z = 0; z < grid->size[2]; z++) {
            for (int x = 0; x < grid->size[0]; x++, at++) {
                Vec3 away, middle = vec3((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f);
                middle = vec3_madd(grid->low, grid->cell, middle);
                middle = vec3_madd(site->foot, site->internode, middle);
                grid->taken[at] = site->room->clearance(site->room->user, middle, &away) < 0.0f;
            }
        }
    }
}

static bool is_within(const ShadeGrid *grid, Vec3 p)
{
    Vec3 at = vec3_scale(vec3_sub(p, grid->low), 1.0f / grid->cell);
    return at.x >= 0.0f && at.y >= 0.0f && at.z >= 0.0f && at.x <= (float)grid->size[0] &&
           at.y <= (float)grid->size[1] && at.z <= (float)grid->size[2];
}

void around_shade(const Around *around, float leaf_area, ShadeGrid *grid, int threads)
{
    if (around->site->room) {
        mark_taken(around->site, grid, threads);
    }
    for (int64_t i = 0; i < around->leaf_count; i++) {
        if (is_within(grid, around->leaf[i].position)) {
            shade_grid_add_leaves(grid, around->leaf[i].position, leaf_area);
        }
    }
}
