#include "grow/light/around.h"

#include "base/memory.h"

#include <stdlib.h>

#define MARGIN 0.3f   // of the plant's height: low light comes from so far beside it
#define MAP_CELL 1.5f // internodes
enum { MAP_BLOCK = 16 };

// A block of cells of a map: `cells` along each side, some perhaps beyond the map.
typedef struct Block {
    int at[3];
    int cells;
} Block;

static void set_block(TakenMap *map, const Block *block, bool taken)
{
    for (int y = block->at[1]; y < block->at[1] + block->cells && y < map->size[1]; y++) {
        for (int z = block->at[2]; z < block->at[2] + block->cells && z < map->size[2]; z++) {
            for (int x = block->at[0]; x < block->at[0] + block->cells && x < map->size[0]; x++) {
                map->taken[((int64_t)y * map->size[2] + z) * map->size[0] + x] = taken;
            }
        }
    }
}

// Blocks that lie wholly within or without obstacles need one query. A cell is taken if an obstacle
// is within a third of it, so that thin walls leave no gaps.
static void fill_block(TakenMap *map, const LightSite *site, Block block)
{
    float half = 0.5f * (float)block.cells;
    Vec3 middle =
        vec3((float)block.at[0] + half, (float)block.at[1] + half, (float)block.at[2] + half);
    middle = vec3_madd(map->low, map->cell, middle);
    middle = vec3_madd(site->foot, site->internode, middle);
    float edge = map->cell * site->internode, reach = 1.74f * half * edge; // sqrt 3 and more
    float clearance = site->room->obstacle(site->room->user, middle) - edge / 3.0f;
    if (block.cells == 1 || clearance > reach || clearance < -reach) {
        set_block(map, &block, clearance < 0.0f);
        return;
    }
    int cells = block.cells / 2;
    for (int i = 0; i < 8; i++) {
        Block part = {{block.at[0] + (i & 1) * cells, block.at[1] + (i >> 1 & 1) * cells,
                       block.at[2] + (i >> 2) * cells},
                      cells};
        bool within =
            part.at[0] < map->size[0] && part.at[1] < map->size[1] && part.at[2] < map->size[2];
        if (within) {
            fill_block(map, site, part);
        }
    }
}

static bool find_taken(TakenMap *map, const LightSite *site, int threads, Error *e)
{
    Vec3 size = vec3_sub(site->reach.high, site->reach.low);
    float margin = MARGIN * size.y;
    map->low = vec3_sub(site->reach.low, vec3(margin, MAP_CELL, margin));
    map->cell = MAP_CELL;
    map->size[0] = (int)((size.x + 2.0f * margin) / MAP_CELL) + 1;
    map->size[1] = (int)(size.y / MAP_CELL) + 3;
    map->size[2] = (int)((size.z + 2.0f * margin) / MAP_CELL) + 1;
    int blocks[3];
    for (int i = 0; i < 3; i++) {
        blocks[i] = (map->size[i] + MAP_BLOCK - 1) / MAP_BLOCK;
    }
    map->taken = memory_alloc_zero((int64_t)map->size[0] * map->size[1] * map->size[2],
                                   sizeof *map->taken, e);
    if (!map->taken) {
        return false;
    }
    int count = blocks[0] * blocks[1] * blocks[2];
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (int i = 0; i < count; i++) {
        Block block = {{i % blocks[0] * MAP_BLOCK, i / blocks[0] % blocks[1] * MAP_BLOCK,
                        i / blocks[0] / blocks[1] * MAP_BLOCK},
                       MAP_BLOCK};
        fill_block(map, site, block);
    }
    return true;
}

bool around_init(Around *around, const LightSite *site, int threads, Error *e)
{
    *around = (Around){.site = site};
    around->shown = out_tree_new(e);
    return around->shown &&
           (!site->room || !site->room->obstacle || find_taken(&around->map, site, threads, e));
}

void around_clear(Around *around)
{
    out_tree_free(around->shown);
    free(around->leaf);
    free(around->own_leaf);
    free(around->map.taken);
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
    if (around_shares_light(around)) {
        return true; // they give their leaves themselves
    }
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

bool around_shares_light(const Around *around)
{
    return around->site->room && around->site->room->give_leaves;
}

bool around_give_leaves(Around *around, const Plant *plant, const LightParams *params, float cell,
                        int season, Error *e)
{
    const LightSite *site = around->site;
    int64_t count = 0;
    if (!memory_reserve(&around->own_leaf, &around->own_capacity, plant->living_count,
                        sizeof *around->own_leaf, e)) {
        return false;
    }
    for (int64_t i = 0; i < plant->living_count; i++) {
        const Metamer *m = &plant->metamer[plant->living[i]];
        if (metamer_has_leaves(m, season, params->leaf_seasons)) {
            around->own_leaf[count++] = vec3_madd(site->foot, site->internode, m->position);
        }
    }
    float area = params->shade * site->internode * site->internode;
    return site->room->give_leaves(site->room->user, around->own_leaf, count, area,
                                   cell * site->internode, e);
}

float around_margin(const Around *around, Aabb plant)
{
    return around->site->room ? MARGIN * (plant.high.y - plant.low.y) : 0.0f;
}

// Marks the cells whose middles lie in taken ones.
static void mark_taken(const TakenMap *map, ShadeGrid *grid)
{
    int64_t at = 0;
    for (int y = 0; y < grid->size[1]; y++) {
        for (int z = 0; z < grid->size[2]; z++) {
            for (int x = 0; x < grid->size[0]; x++, at++) {
                Vec3 p = vec3((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f);
                p = vec3_sub(vec3_madd(grid->low, grid->cell, p), map->low);
                p = vec3_scale(p, 1.0f / map->cell);
                bool within = p.x >= 0.0f && p.y >= 0.0f && p.z >= 0.0f &&
                              p.x < (float)map->size[0] && p.y < (float)map->size[1] &&
                              p.z < (float)map->size[2];
                grid->taken[at] =
                    within &&
                    map->taken[((int64_t)p.y * map->size[2] + (int64_t)p.z) * map->size[0] +
                               (int64_t)p.x];
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

void around_shade(const Around *around, float leaf_area, ShadeGrid *grid)
{
    if (around->map.taken) {
        mark_taken(&around->map, grid);
    }
    for (int64_t i = 0; i < around->leaf_count; i++) {
        if (is_within(grid, around->leaf[i].position)) {
            shade_grid_add_leaves(grid, around->leaf[i].position, leaf_area);
        }
    }
}
