#include "objects/fracture/crack_cells.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/fracture/crack_basins.h"

#include <stdlib.h>

enum {
    KEPT = 3,    // cells known at a node: as many as meet along a line
    OCTAVES = 3, // of the walls' roughness
    NEAR = 8 * KEPT
};

#define DISTANCE_SAFETY 0.5 // rough walls are off by less than this factor
#define NOISE_PEAK 1.2f     // of the sum of octaves over the largest one's height
#define ROUGH_SHARE 0.25f   // of a cell's inner radius: the largest height of its walls' bumps
#define LEAST_SLOPE 0.35f   // of the difference of two cells' values; walls deep inside go below
#define SHADOWED 1.5f       // spacings: sources nearer to the network say nothing new

struct CrackCells {
    CrackCellsParams params;
    BodyGrid grid;
    CrackBasins basins;
    SpreadSource *source;
    SpreadEntry *entry; // KEPT per node: costs are minus a cell's value
    float *rough;       // per node: m, height of the bumps
    Aabb *bounds;       // per cell
};

// ---- making ----

// Surface nodes spread their cell inward.
static int64_t add_sources(CrackCells *cells)
{
    const BodyGrid *grid = &cells->grid;
    int64_t count = 0;
    for (int32_t i = 0; i < grid->count; i++) {
        const CrackBasins *basins = &cells->basins;
        bool lone = basins->peak[basins->cell[i]] <= 2.0f * SHADOWED * grid->spacing;
        if (grid->surface[i] && (lone || basins->far[i] > SHADOWED * grid->spacing)) {
            cells->source[count++] = (SpreadSource){.at = grid->position[i],
                                                    .cost = -basins->far[i],
                                                    .label = basins->cell[i],
                                                    .node = i};
        }
    }
    return count;
}

static void choose_roughness(CrackCells *cells)
{
    for (int64_t i = 0; i < cells->grid.count; i++) {
        float height = cells->params.roughness;
        for (int k = 0; k < KEPT && cells->entry[KEPT * i + k].source >= 0; k++) {
            int32_t cell = cells->source[cells->entry[KEPT * i + k].source].label;
            float most = ROUGH_SHARE * cells->basins.peak[cell];
            height = most < height ? most : height;
        }
        cells->rough[i] = height;
    }
}

static void find_bounds(CrackCells *cells)
{
    float spacing = cells->grid.spacing;
    for (int32_t i = 0; i < cells->basins.count; i++) {
        cells->bounds[i] = aabb_empty();
    }
    for (int32_t i = 0; i < cells->grid.count; i++) {
        const SpreadEntry *entry = cells->entry + (int64_t)KEPT * i;
        float reach = entry[0].cost + 2.0f * (NOISE_PEAK * cells->rough[i] + spacing);
        Vec3 p = cells->grid.position[i], margin = vec3_splat(spacing);
        for (int k = 0; k < KEPT && entry[k].source >= 0 && entry[k].cost <= reach; k++) {
            Aabb *box = &cells->bounds[cells->source[entry[k].source].label];
            box->low = vec3_min(box->low, vec3_sub(p, margin));
            box->high = vec3_max(box->high, vec3_add(p, margin));
        }
    }
}

static bool fill(CrackCells *cells, const OutTree *network, const Run *run, Error *e)
{
    const CrackCellsParams *params = &cells->params;
    BodyGrid *grid = &cells->grid;
    if (!body_grid_new(grid, params->distance, params->body, params->box, params->spacing, run,
                       e) ||
        !crack_basins_new(&cells->basins, grid, network, params->least, run, e)) {
        return false;
    }
    cells->source = memory_alloc(grid->count, sizeof *cells->source, e);
    cells->entry = memory_alloc((int64_t)KEPT * grid->count, sizeof *cells->entry, e);
    cells->rough = memory_alloc(grid->count, sizeof *cells->rough, e);
    cells->bounds = memory_alloc(cells->basins.count, sizeof *cells->bounds, e);
    if (!cells->source || !cells->entry || !cells->rough || !cells->bounds ||
        !body_grid_spread(grid, cells->source, add_sources(cells), KEPT, cells->entry, NULL, NULL,
                          run, e)) {
        return false;
    }
    choose_roughness(cells);
    find_bounds(cells);
    return true;
}

CrackCells *crack_cells_new(const OutTree *network, const CrackCellsParams *params, const Run *run,
                            Error *e)
{
    CrackCells *cells = memory_alloc_zero(1, sizeof *cells, e);
    if (!cells) {
        return NULL;
    }
    cells->params = *params;
    if (!fill(cells, network, run, e)) {
        crack_cells_free(cells);
        return NULL;
    }
    return cells;
}

void crack_cells_free(CrackCells *cells)
{
    if (cells) {
        body_grid_clear(&cells->grid);
        crack_basins_clear(&cells->basins);
        free(cells->source);
        free(cells->entry);
        free(cells->rough);
        free(cells->bounds);
        free(cells);
    }
}

int32_t crack_cells_count(const CrackCells *cells)
{
    return cells->basins.count;
}

int32_t crack_cells_small(const CrackCells *cells)
{
    return cells->basins.small;
}

Aabb crack_cells_bounds(const CrackCells *cells, int32_t cell)
{
    return cells->bounds[cell];
}

// ---- distances ----

// A cell of the grid about a point.
typedef struct Place {
    int32_t corner[8];
    float weight[8]; // 0 if there is no node; their sum is 1
    float t[3];
    bool whole; // every corner has a node
} Place;

static bool find_place(const CrackCells *cells, Vec3 p, Place *place)
{
    if (!body_grid_cell(&cells->grid, p, place->corner, place->t)) {
        return false;
    }
    float sum = 0.0f;
    place->whole = true;
    for (int i = 0; i < 8; i++) {
        float x = i >> 2 ? place->t[0] : 1.0f - place->t[0];
        float y = i >> 1 & 1 ? place->t[1] : 1.0f - place->t[1];
        float z = i & 1 ? place->t[2] : 1.0f - place->t[2];
        bool there = place->corner[i] >= 0;
        place->weight[i] = there ? x * y * z : 0.0f;
        place->whole = place->whole && there;
        sum += place->weight[i];
    }
    for (int i = 0; i < 8 && sum > 0.0f; i++) {
        place->weight[i] /= sum;
    }
    return sum > 0.0f;
}

// Value of a cell at a node; slightly below all known ones if it is not among them.
static float value_at(const CrackCells *cells, int32_t node, int32_t cell)
{
    const SpreadEntry *entry = cells->entry + (int64_t)KEPT * node;
    for (int k = 0; k < KEPT && entry[k].source >= 0; k++) {
        if (cells->source[entry[k].source].label == cell) {
            return -entry[k].cost;
        }
    }
    bool full = entry[KEPT - 1].source >= 0;
    return -(full ? entry[KEPT - 1].cost : entry[0].cost + 8.0f * cells->grid.spacing);
}

static void corner_values(const CrackCells *cells, const Place *place, int32_t cell, float v[8])
{
    for (int i = 0; i < 8; i++) {
        v[i] = place->corner[i] >= 0 ? value_at(cells, place->corner[i], cell) : 0.0f;
    }
}

static float weighted(const Place *place, const float v[8])
{
    float sum = 0.0f;
    for (int i = 0; i < 8; i++) {
        sum += place->weight[i] * v[i];
    }
    return sum;
}

static float roughness(const CrackCells *cells, const Place *place)
{
    float v[8];
    for (int i = 0; i < 8; i++) {
        v[i] = place->corner[i] >= 0 ? cells->rough[place->corner[i]] : 0.0f;
    }
    return weighted(place, v);
}

// A cell's own noise: a wall between two cells is displaced by half the difference of theirs.
static float bumps(const CrackCells *cells, int32_t cell, Vec3 p, float height)
{
    uint64_t key = random_key(cells->params.seed, (uint64_t)cell);
    float scale = 1.0f / cells->params.wavelength, sum = 0.0f;
    for (uint64_t k = 0; k < OCTAVES && height > 0.0f; k++) {
        sum += height * noise_space(vec3_scale(p, scale), random_key(key, k));
        scale *= 2.3f;
        height *= 0.45f;
    }
    return sum;
}

// The distinct cells known at the corners, without one.
static int others_near(const CrackCells *cells, const Place *place, int32_t cell,
                       int32_t other[NEAR])
{
    int count = 0;
    for (int i = 0; i < 8; i++) {
        const SpreadEntry *entry = cells->entry + (int64_t)KEPT * place->corner[i];
        for (int k = 0; place->corner[i] >= 0 && k < KEPT && entry[k].source >= 0; k++) {
            int32_t label = cells->source[entry[k].source].label;
            int at = 0;
            while (at < count && other[at] != label) {
                at++;
            }
            if (at == count && label != cell) {
                other[count++] = label;
            }
        }
    }
    return count;
}

// Gradient magnitude of the difference of two cells' values: 2 at a wall on the surface, less if
// both come from the same side.
static float slope(const CrackCells *cells, const Place *place, const float own[8],
                   const float other[8])
{
    if (!place->whole) {
        return 2.0f;
    }
    Vec3 g = vec3(0, 0, 0);
    for (int i = 0; i < 8; i++) {
        float x = i >> 2 ? place->t[0] : 1.0f - place->t[0], d = other[i] - own[i];
        float y = i >> 1 & 1 ? place->t[1] : 1.0f - place->t[1];
        float z = i & 1 ? place->t[2] : 1.0f - place->t[2];
        g = vec3_madd(
            g, d,
            vec3(i >> 2 ? y * z : -y * z, i >> 1 & 1 ? x * z : -x * z, i & 1 ? x * y : -x * y));
    }
    return clampf(vec3_length(g) / cells->grid.spacing, LEAST_SLOPE, 2.0f);
}

// A point with the values of the cells around it, without bumps. cell[0] is the queried cell.
typedef struct Rivals {
    Place place;
    int32_t cell[NEAR + 1];
    float value[NEAR + 1];
    int count;
} Rivals;

static float fill_rivals(const CrackCells *cells, int32_t cell, Rivals *r)
{
    float best = -INFINITY, v[8];
    r->cell[0] = cell;
    r->count = 1 + others_near(cells, &r->place, cell, r->cell + 1);
    for (int i = 0; i < r->count; i++) {
        corner_values(cells, &r->place, r->cell[i], v);
        r->value[i] = weighted(&r->place, v);
        best = i > 0 && r->value[i] > best ? r->value[i] : best;
    }
    return best;
}

static float slope_between(const CrackCells *cells, const Rivals *r, int i, int k)
{
    float a[8], b[8];
    corner_values(cells, &r->place, r->cell[i], a);
    corner_values(cells, &r->place, r->cell[k], b);
    return slope(cells, &r->place, a, b);
}

// Between the two greatest values, whichever cell is queried.
static float main_slope(const CrackCells *cells, const Rivals *r)
{
    int first = 0, second = -1;
    for (int i = 1; i < r->count; i++) {
        if (r->value[i] > r->value[first]) {
            second = first;
            first = i;
        } else if (second < 0 || r->value[i] > r->value[second]) {
            second = i;
        }
    }
    return slope_between(cells, r, first, second);
}

// Distance to the rough wall, near it. Bumps scale with the gradient, so that they displace a wall
// equally everywhere and cut no chips off.
static double rough_distance(const CrackCells *cells, const Rivals *r, Vec3 p, float height,
                             double *bound)
{
    float best = -INFINITY, bump = 0.5f * height * main_slope(cells, r);
    int nearest = 1;
    for (int i = 1; i < r->count; i++) {
        if (r->value[i] + NOISE_PEAK * bump > best) {
            float there = r->value[i] + bumps(cells, r->cell[i], p, bump);
            nearest = there > best ? i : nearest;
            best = there > best ? there : best;
        }
    }
    float half = 0.5f * (best - r->value[0] - bumps(cells, r->cell[0], p, bump));
    *bound = DISTANCE_SAFETY * (double)fabsf(half);
    return 2.0 * (double)(half / slope_between(cells, r, 0, nearest));
}

double crack_cells_distance(const CrackCells *cells, int32_t cell, Vec3 p, double *bound)
{
    Rivals r;
    *bound = 0.0;
    if (!find_place(cells, p, &r.place)) {
        return (double)cells->grid.spacing; // outside of the body
    }
    float best = fill_rivals(cells, cell, &r);
    if (r.count == 1) { // no other cell in reach
        *bound = (double)(4.0f * cells->grid.spacing);
        return -*bound;
    }
    float height = roughness(cells, &r.place), half = 0.5f * (best - r.value[0]);
    float clear = fabsf(half) - NOISE_PEAK * height;
    if (clear > cells->params.known) {
        *bound = (double)clear;
        return (double)half;
    }
    return rough_distance(cells, &r, p, height, bound);
}
