#include "grow/light/attractors.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { TAKEN = -2, NOBODY = -1 }; // instead of a metamer

// The living metamers, sorted into cells no wider than the attractors' reach.
typedef struct Cells {
    Vec3 low;
    float edge; // internodes
    int size[3];
    int32_t *first; // of each cell, in item; one more at the end
    int32_t *item;  // metamers
} Cells;

bool attractors_init(Attractors *attractors, const LightSite *site, Error *e)
{
    *attractors = (Attractors){.params = site->attractors};
    if (!site->attractors) {
        return true;
    }
    attractors->count = site->attractors->count;
    attractors->position = memory_alloc(attractors->count, sizeof *attractors->position, e);
    for (int64_t i = 0; attractors->position && i < attractors->count; i++) {
        Vec3 from_foot = vec3_sub(site->attractors->position[i], site->foot);
        attractors->position[i] = vec3_scale(from_foot, 1.0f / site->internode);
    }
    return attractors->position;
}

void attractors_clear(Attractors *attractors)
{
    free(attractors->position);
    free(attractors->mean);
    free(attractors->drawn_by);
    *attractors = (Attractors){0};
}

static int coordinate(float p, float low, float edge, int size)
{
    float at = floorf((p - low) / edge);
    return at < 0.0f ? 0 : (at >= (float)size ? size - 1 : (int)at);
}

static int64_t cell_at(const Cells *cells, const int at[3])
{
    return ((int64_t)at[2] * cells->size[1] + at[1]) * cells->size[0] + at[0];
}

static int64_t cell_of(const Cells *cells, Vec3 p)
{
    int at[3] = {coordinate(p.x, cells->low.x, cells->edge, cells->size[0]),
                 coordinate(p.y, cells->low.y, cells->edge, cells->size[1]),
                 coordinate(p.z, cells->low.z, cells->edge, cells->size[2])};
    return cell_at(cells, at);
}

static void cells_clear(Cells *cells)
{
    free(cells->first);
    free(cells->item);
}

// Edge of the cells (internodes): a fraction of a far reach, as most of the metamers found are
// near.
static float cell_edge(float reach)
{
    const float least = 4.0f, share = 0.25f;
    return fminf(reach, fmaxf(least, share * reach));
}

static bool cells_init(Cells *cells, const Plant *plant, float edge, Error *e)
{
    Aabb box = plant_bounds(plant);
    Vec3 extent = vec3_sub(box.high, box.low);
    *cells = (Cells){.low = box.low,
                     .edge = edge,
                     .size = {1 + (int)(extent.x / edge), 1 + (int)(extent.y / edge),
                              1 + (int)(extent.z / edge)}};
    int64_t count = (int64_t)cells->size[0] * cells->size[1] * cells->size[2];
    cells->first = memory_alloc_zero(count + 1, sizeof *cells->first, e);
    cells->item = cells->first ? memory_alloc(plant->living_count, sizeof *cells->item, e) : NULL;
    if (!cells->item) {
        cells_clear(cells);
        return false;
    }
    for (int64_t i = 0; i < plant->living_count; i++) {
        cells->first[cell_of(cells, plant->metamer[plant->living[i]].position)]++;
    }
    for (int64_t i = 1; i <= count; i++) {
        cells->first[i] += cells->first[i - 1];
    }
    for (int64_t i = plant->living_count - 1; i >= 0; i--) { // ascending in each cell
        int32_t metamer = plant->living[i];
        cells->item[--cells->first[cell_of(cells, plant->metamer[metamer].position)]] = metamer;
    }
    return true;
}

// The reach that a search has left, and what it has found.
typedef struct Search {
    float taken2, least2; // squares
    int32_t found;
} Search;

static void search_cell(const Cells *cells, int64_t cell, const Plant *plant, const bool *has_buds,
                        Vec3 p, Search *search)
{
    for (int32_t k = cells->first[cell]; k < cells->first[cell + 1]; k++) {
        int32_t metamer = cells->item[k];
        Vec3 d = vec3_sub(plant->metamer[metamer].position, p);
        float distance2 = vec3_dot(d, d);
        if (distance2 < search->taken2) {
            search->found = TAKEN;
            return;
        }
        bool nearer =
            distance2 < search->least2 || (distance2 == search->least2 && metamer < search->found);
        if (nearer && has_buds[metamer]) {
            search->least2 = distance2;
            search->found = metamer;
        }
    }
}

// Searches the cells that are `ring` cells from `at` along at least one axis and no farther along
// any.
static void search_ring(const Cells *cells, const int at[3], int ring, const Plant *plant,
                        const bool *has_buds, Vec3 p, Search *search)
{
    int low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = at[axis] - ring > 0 ? at[axis] - ring : 0;
        int last = cells->size[axis] - 1;
        high[axis] = at[axis] + ring < last ? at[axis] + ring : last;
    }
    for (int z = low[2]; z <= high[2]; z++) {
        for (int y = low[1]; y <= high[1]; y++) {
            bool face = abs(z - at[2]) == ring || abs(y - at[1]) == ring;
            for (int x = low[0]; x <= high[0] && search->found != TAKEN; x++) {
                if (face || abs(x - at[0]) == ring) {
                    int near[3] = {x, y, z};
                    search_cell(cells, cell_at(cells, near), plant, has_buds, p, search);
                }
            }
        }
    }
}

// The metamer that an attractor draws, NOBODY or TAKEN: what lies beyond a ring of cells is farther
// than the nearest found, so the rings' width does not change what is found.
static int32_t find_drawn(const Cells *cells, const Plant *plant, const bool *has_buds,
                          const LightAttractors *params, Vec3 p)
{
    const float rounding = 0.999f;
    int at[3] = {(int)floorf((p.x - cells->low.x) / cells->edge),
                 (int)floorf((p.y - cells->low.y) / cells->edge),
                 (int)floorf((p.z - cells->low.z) / cells->edge)};
    Search search = {params->occupied * params->occupied, params->reach * params->reach, NOBODY};
    for (int ring = 0; search.found != TAKEN; ring++) {
        float nearest = rounding * cells->edge * (float)(ring - 1);
        if (nearest > 0.0f && nearest * nearest > search.least2) {
            break;
        }
        search_ring(cells, at, ring, plant, has_buds, p, &search);
    }
    return search.found;
}

// Marks the metamers whose buds may be drawn.
static bool *mark_buds(const Plant *plant, int season, int leaf_seasons, Error *e)
{
    bool *has_buds = memory_alloc_zero(plant->count, sizeof *has_buds, e);
    for (int64_t i = 0; has_buds && i < plant->living_count; i++) {
        const Metamer *m = &plant->metamer[plant->living[i]];
        has_buds[plant->living[i]] =
            (m->terminal || m->buds) && metamer_has_leaves(m, season, leaf_seasons);
    }
    return has_buds;
}

// Sums the attractors by the metamers that they draw, and keeps those that are not taken.
static void allot(Attractors *attractors, const int32_t *drawn)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < attractors->count; i++) {
        if (drawn[i] >= 0) {
            Vec3 *mean = &attractors->mean[drawn[i]];
            *mean = vec3_add(*mean, attractors->position[i]);
            attractors->drawn_by[drawn[i]]++;
        }
        if (drawn[i] != TAKEN) {
            attractors->position[kept++] = attractors->position[i];
        }
    }
    attractors->count = kept;
}

// Until the first bud is drawn, the plant grows by light alone.
static void set_claims(Attractors *attractors, Plant *plant)
{
    for (int64_t i = 0; i < plant->living_count && !attractors->found; i++) {
        attractors->found = attractors->drawn_by[plant->living[i]] > 0;
    }
    float least = attractors->found ? 1.0f - attractors->params->weight : 1.0f;
    for (int64_t i = 0; i < plant->living_count; i++) {
        int32_t k = plant->living[i];
        int32_t number = attractors->drawn_by[k];
        plant->metamer[k].claim = number > 0 ? 1.0f : least;
        if (number > 0) {
            attractors->mean[k] = vec3_scale(attractors->mean[k], 1.0f / (float)number);
        }
    }
}

static bool reserve(Attractors *attractors, const Plant *plant, Error *e)
{
    attractors->metamers = plant->count;
    if (!memory_reserve(&attractors->mean, &attractors->mean_capacity, plant->count,
                        sizeof *attractors->mean, e) ||
        !memory_reserve(&attractors->drawn_by, &attractors->drawn_capacity, plant->count,
                        sizeof *attractors->drawn_by, e)) {
        return false;
    }
    for (int64_t i = 0; i < plant->count; i++) {
        attractors->mean[i] = vec3(0, 0, 0);
        attractors->drawn_by[i] = 0;
    }
    return true;
}

bool attractors_draw(Attractors *attractors, Plant *plant, int season, int leaf_seasons,
                     int threads, Error *e)
{
    if (!attractors->params) {
        return true;
    }
    Cells cells;
    if (!reserve(attractors, plant, e) ||
        !cells_init(&cells, plant, cell_edge(attractors->params->reach), e)) {
        return false;
    }
    bool *has_buds = mark_buds(plant, season, leaf_seasons, e);
    int32_t *drawn = has_buds ? memory_alloc(attractors->count, sizeof *drawn, e) : NULL;
    if (drawn) {
#pragma omp parallel for num_threads(threads) schedule(dynamic, 256)
        for (int64_t i = 0; i < attractors->count; i++) {
            drawn[i] =
                find_drawn(&cells, plant, has_buds, attractors->params, attractors->position[i]);
        }
        allot(attractors, drawn);
        set_claims(attractors, plant);
    }
    bool done = drawn;
    cells_clear(&cells);
    free(has_buds);
    free(drawn);
    return done;
}

Vec3 attractors_pull(const Attractors *attractors, int64_t base, Vec3 at)
{
    if (!attractors->params || base >= attractors->metamers || attractors->drawn_by[base] == 0) {
        return vec3(0, 0, 0);
    }
    Vec3 d = vec3_sub(attractors->mean[base], at);
    return vec3_scale(vec3_normalize(d), attractors->params->pull);
}
