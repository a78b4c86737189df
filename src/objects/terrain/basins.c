// Basins as glaciers leave them: dug into the flattest ground above a sill, the largest first.
// Areas follow the rank-size rule of lakes (Downing et al. 2006: an area is exceeded by a number of
// lakes in inverse proportion to it), mean depths that of mountain lakes, 0.104 m (area / m^2)^0.42
// (Huggel et al. 2002). Sites are looked for on a coarse grid, so that they do not depend on the
// resolution.
#include "base/exact_math.h"
#include "base/lowest_queue.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/terrain/lakes.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COARSE_CELLS = 256, LEAST_CELLS = 7, RIM = 5 };
enum { MARGIN = 3 }; // coarse cells about a basin that are dug as its banks, less than RIM

typedef struct Digging {
    const Terrain *terrain;
    TerrainLakeParams params;
    HeightField *coarse; // the land, filled
    Drainage *drainage;
    int32_t *first, *next; // donors of each sample as lists; -1 = end
    uint8_t *taken;        // 1 = in or near another basin
    uint32_t *mark;        // of each sample, the number of the last trial that reached it
    uint32_t trial;
    LowestQueue queue;
    int32_t *member; // of the region at hand
    int64_t members;
    float low, high;
} Digging;

static int64_t coarse_count(const Digging *d)
{
    return height_field_count(d->coarse);
}

// ---- sites

static bool is_off_rim(const Digging *d, int64_t i)
{
    int64_t columns = d->coarse->columns, column = i % columns, row = i / columns;
    return column >= RIM && row >= RIM && column < columns - RIM && row < d->coarse->rows - RIM;
}

// Gathers `cells` samples that drain through the sill, the lowest first. Returns the height of the
// highest above the sill, m; INFINITY if they are too few or not free.
static bool gather(Digging *d, int32_t sill, int64_t cells, float *rise, Error *e)
{
    const float *height = d->coarse->height;
    d->members = 0;
    d->queue.count = 0;
    *rise = INFINITY;
    for (int32_t n = d->first[sill]; n >= 0; n = d->next[n]) {
        if (!lowest_queue_push(&d->queue, height[n], n, e)) {
            return false;
        }
    }
    while (d->queue.count > 0 && d->members < cells) {
        int32_t i = lowest_queue_pop(&d->queue).index;
        if (d->taken[i] || !is_off_rim(d, i)) {
            return true;
        }
        d->member[d->members++] = i;
        for (int32_t n = d->first[i]; n >= 0; n = d->next[n]) {
            if (!lowest_queue_push(&d->queue, height[n], n, e)) {
                return false;
            }
        }
    }
    if (d->members == cells) {
        *rise = height[d->member[cells - 1]] - height[sill];
    }
    return true;
}

// How far the region reaches for its area: 1 for a disc, more for a winding one.
static float stretch(const Digging *d, int64_t cells)
{
    int64_t columns = d->coarse->columns;
    int64_t least[2] = {columns, columns}, most[2] = {0, 0};
    for (int64_t k = 0; k < d->members; k++) {
        int64_t at[2] = {d->member[k] % columns, d->member[k] / columns};
        for (int a = 0; a < 2; a++) {
            least[a] = at[a] < least[a] ? at[a] : least[a];
            most[a] = at[a] > most[a] ? at[a] : most[a];
        }
    }
    float x = (float)(most[0] - least[0] + 1), z = (float)(most[1] - least[1] + 1);
    return (x * x + z * z) / (2.5f * (float)cells);
}

// The sill above which a basin of so many cells is dug with the least cutting; -1 = there is none.
static bool find_site(Digging *d, int64_t cells, const Run *run, int32_t *best, Error *e)
{
    float least = INFINITY;
    double own = (double)d->coarse->cell.x * (double)d->coarse->cell.y;
    *best = -1;
    for (int32_t i = 0; i < coarse_count(d); i++) {
        if (!run_goes_on(run, i, e)) {
            return false;
        }
        float altitude = (d->coarse->height[i] - d->low) / (d->high - d->low), rise;
        if (d->drainage->area[i] < 2.0 * (double)cells * own || d->taken[i] || !is_off_rim(d, i) ||
            altitude < d->params.altitude[0] || altitude > d->params.altitude[1]) {
            continue;
        }
        if (!gather(d, i, cells, &rise, e)) {
            return false;
        }
        float cost =
            rise < INFINITY ? (rise + 0.02f * d->coarse->cell.x) * stretch(d, cells) : INFINITY;
        if (cost < least) {
            least = cost;
            *best = i;
        }
    }
    return true;
}

// ---- a basin

typedef struct Basin {
    HeightField *shore; // m to the shoreline, positive within, on a part of the coarse grid
    float level;        // m, of the sill
    float deepest;      // m
    float widest;       // m: the largest distance to the shoreline
} Basin;

static float bowl(float share)
{
    return share * (2.0f - share);
}

// The distance from each sample of the part to the nearest one on the other side, less half a cell.
static void measure_distances(const Digging *d, HeightField *shore, int64_t corner)
{
    enum { FARTHEST = 12 }; // cells
    int64_t columns = d->coarse->columns;
    float cell = d->coarse->cell.x;
    for (int64_t i = 0; i < height_field_count(shore); i++) {
        int64_t column = i % shore->columns, row = i / shore->columns;
        int64_t at = corner + row * columns + column;
        bool within = d->mark[at] == d->trial;
        float best = FARTHEST * FARTHEST;
        for (int64_t r = row - FARTHEST; r <= row + FARTHEST; r++) {
            for (int64_t c = column - FARTHEST; c <= column + FARTHEST; c++) {
                if (c < 0 || r < 0 || c >= shore->columns || r >= shore->rows) {
                    continue;
                }
                int64_t dx = c - column, dz = r - row;
                float apart = (float)(dx * dx + dz * dz);
                if (apart < best && (d->mark[corner + r * columns + c] == d->trial) != within) {
                    best = apart;
                }
            }
        }
        float distance = cell * (sqrtf(best) - 0.5f);
        shore->height[i] = within ? distance : -distance;
    }
}

// The basin of the region at hand. mean: m, its mean depth.
static bool shape_basin(Digging *d, int32_t sill, float mean, Basin *basin, Error *e)
{
    int64_t columns = d->coarse->columns;
    int64_t least[2] = {columns, columns}, most[2] = {0, 0};
    d->trial++;
    for (int64_t k = 0; k < d->members; k++) {
        int64_t at[2] = {d->member[k] % columns, d->member[k] / columns};
        d->mark[d->member[k]] = d->trial;
        for (int a = 0; a < 2; a++) {
            least[a] = at[a] < least[a] ? at[a] : least[a];
            most[a] = at[a] > most[a] ? at[a] : most[a];
        }
    }
    int wide = (int)(most[0] - least[0]) + 2 * MARGIN + 1;
    int tall = (int)(most[1] - least[1]) + 2 * MARGIN + 1;
    int64_t corner = (least[1] - MARGIN) * columns + least[0] - MARGIN;
    Vec2 origin = {d->coarse->origin.x + d->coarse->cell.x * (float)(least[0] - MARGIN),
                   d->coarse->origin.y + d->coarse->cell.y * (float)(least[1] - MARGIN)};
    *basin = (Basin){.shore = height_field_new(wide, tall, d->coarse->cell, origin, e),
                     .level = d->coarse->height[sill]};
    if (!basin->shore) {
        return false;
    }
    measure_distances(d, basin->shore, corner);
    int64_t count = height_field_count(basin->shore), within = 0;
    float sum = 0.0f;
    for (int64_t i = 0; i < count; i++) {
        basin->widest = fmaxf(basin->widest, basin->shore->height[i]);
    }
    for (int64_t i = 0; i < count; i++) {
        if (basin->shore->height[i] > 0.0f) {
            sum += bowl(basin->shore->height[i] / basin->widest);
            within++;
        }
    }
    basin->deepest = mean * (float)within / sum;
    return true;
}

// Digs it into the land: a bowl below the level, and banks above it that stand no steeper than
// rubble. Where the land behind them is higher, they end in it well before the part does, whose
// straight sides would stand as walls.
static void dig(const Digging *d, const Basin *basin, HeightField *field)
{
    const float bank = 0.62f; // slope
    const HeightField *shore = basin->shore;
    float coarse = shore->cell.x, wavelength = 5.0f * coarse;
    uint64_t key = random_key(d->terrain->seed, STREAM_BASINS);
    float x0 = shore->origin.x, x1 = x0 + coarse * (float)(shore->columns - 1);
    float z0 = shore->origin.y, z1 = z0 + shore->cell.y * (float)(shore->rows - 1);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        int64_t column = i % field->columns, row = i / field->columns;
        float x = field->origin.x + (float)column * field->cell.x;
        float z = field->origin.y + (float)row * field->cell.y;
        if (x < x0 || x > x1 || z < z0 || z > z1) {
            continue;
        }
        float uneven = sparse_noise_fractal(x / wavelength, z / wavelength, 5, 0.55f, 0.0f, key);
        float s = height_field_smooth_at(shore, x, z) + 0.45f * coarse * uneven;
        float share = clampf(s / basin->widest, 0.0f, 1.0f);
        float most = s > 0.0f ? basin->level - basin->deepest * bowl(share) *
                                                   (1.0f + 0.25f * clampf(uneven, -1.0f, 1.0f))
                              : basin->level - bank * s;
        float cut = fminf(field->height[i], most);
        field->height[i] =
            lerpf(cut, field->height[i], smoothstepf(0.8f * coarse, 2.3f * coarse, -s));
    }
}

// Keeps other basins away from the region at hand.
static void take_region(Digging *d)
{
    enum { APART = 4 }; // cells
    int64_t columns = d->coarse->columns;
    for (int64_t k = 0; k < d->members; k++) {
        int64_t column = d->member[k] % columns, row = d->member[k] / columns;
        for (int64_t r = row - APART; r <= row + APART; r++) {
            for (int64_t c = column - APART; c <= column + APART; c++) {
                if (c >= 0 && r >= 0 && c < columns && r < d->coarse->rows) {
                    d->taken[r * columns + c] = 1;
                }
            }
        }
    }
}

static bool dig_number(Digging *d, int number, HeightField *field, const Run *run, bool *found,
                       Error *e)
{
    double own = (double)d->coarse->cell.x * (double)d->coarse->cell.y;
    double area = (double)d->params.basin_area / (number + 1);
    int64_t cells = (int64_t)(area / own + 0.5);
    cells = cells > LEAST_CELLS ? cells : LEAST_CELLS;
    int32_t sill;
    float rise;
    if (!find_site(d, cells, run, &sill, e)) {
        return false;
    }
    *found = sill >= 0;
    if (!*found) {
        return true;
    }
    float mean = d->params.deepness * 0.104f * exact_pow((float)((double)cells * own), 0.42f);
    Basin basin = {0};
    bool done = gather(d, sill, cells, &rise, e) && shape_basin(d, sill, mean, &basin, e);
    if (done) {
        dig(d, &basin, field);
        take_region(d);
    }
    height_field_free(basin.shore);
    return done;
}

// ----

static bool list_donors(Digging *d, Error *e)
{
    int64_t count = coarse_count(d);
    d->first = memory_alloc(count, sizeof *d->first, e);
    d->next = memory_alloc(count, sizeof *d->next, e);
    d->taken = memory_alloc_zero(count, 1, e);
    d->mark = memory_alloc_zero(count, sizeof *d->mark, e);
    d->member = memory_alloc(count, sizeof *d->member, e);
    if (!d->first || !d->next || !d->taken || !d->mark || !d->member) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        d->first[i] = -1;
    }
    for (int32_t i = (int32_t)count - 1; i >= 0; i--) {
        int32_t to = d->drainage->receiver[i];
        d->next[i] = -1;
        if (to != i) {
            d->next[i] = d->first[to];
            d->first[to] = i;
        }
    }
    return true;
}

static HeightField *look_coarsely(const HeightField *field, Error *e)
{
    int cells = field->columns - 1 < COARSE_CELLS ? field->columns - 1 : COARSE_CELLS;
    float cell = field->cell.x * (float)(field->columns - 1) / (float)cells;
    HeightField *coarse =
        height_field_new(cells + 1, cells + 1, (Vec2){cell, cell}, field->origin, e);
    for (int64_t i = 0; coarse && i < height_field_count(coarse); i++) {
        int64_t column = i % coarse->columns, row = i / coarse->columns;
        coarse->height[i] = height_field_at(field, coarse->origin.x + cell * (float)column,
                                            coarse->origin.y + cell * (float)row);
    }
    return coarse;
}

static void clear(Digging *d)
{
    height_field_free(d->coarse);
    drainage_free(d->drainage);
    free(d->first);
    free(d->next);
    free(d->taken);
    free(d->mark);
    free(d->member);
    free(d->queue.item);
}

bool terrain_dig_basins(const Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    Digging d = {.terrain = terrain, .params = terrain_lake_params(terrain->params)};
    if (d.params.basins <= 0) {
        return true;
    }
    d.coarse = look_coarsely(field, e);
    if (d.coarse) {
        height_field_range(d.coarse, &d.low, &d.high);
    }
    bool done = d.coarse && height_field_fill(d.coarse, 0.0f, e) &&
                (d.drainage = drainage_new(d.coarse, e)) && list_donors(&d, e),
         found = true;
    for (int i = 0; done && found && i < d.params.basins; i++) {
        run_progress(run, "lakes", (double)i / d.params.basins);
        done = dig_number(&d, i, field, run, &found, e);
    }
    clear(&d);
    return done;
}
