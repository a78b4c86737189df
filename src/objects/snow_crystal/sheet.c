// Outline and relief of a flat snow crystal, from the mass and the age of its cells.
#include "objects/snow_crystal/sheet.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <stdlib.h>
#include <string.h>

enum { CONTOUR_PASSES = 1, WORN_PASSES = 3, RELIEF_PASSES = 3, BEVEL_PASSES = 4 }; // of cells
enum { STREAM_RINGS = 3 };                                                         // of the seed

#define AGEING 2.0f      // thickness that the oldest ice gains, in that of new ice
#define THINNING 0.45f   // of the tips, against the middle
#define RING_WAVES 24.0f // slowest swings of the weather in a life
// Of rings 1 where a swing is strongest, relative to the half thickness: less than 1.
#define RING_HEIGHT 0.5f

void sheet_clear(Sheet *sheet)
{
    free(sheet->inside);
    free(sheet->height);
    free(sheet->ring);
    free(sheet->ridge);
    free(sheet->spare);
    free(sheet->vertex);
    for (int k = 0; k < 3; k++) {
        free(sheet->cut[k]);
    }
}

static bool sheet_init(Sheet *sheet, int radius, bool rings, Error *e)
{
    int width = 2 * radius + 1;
    *sheet = (Sheet){.radius = radius, .width = width, .cells = (int64_t)width * width};
    float **fields[5] = {&sheet->inside, &sheet->height, &sheet->ridge, &sheet->spare,
                         &sheet->ring};
    for (int i = 0; i < 4 + rings; i++) {
        *fields[i] = memory_alloc_zero(sheet->cells, sizeof(float), e);
        if (!*fields[i]) {
            return false;
        }
    }
    int32_t **numbers[4] = {&sheet->vertex, &sheet->cut[0], &sheet->cut[1], &sheet->cut[2]};
    for (int i = 0; i < 4; i++) {
        *numbers[i] = memory_alloc(sheet->cells, sizeof(int32_t), e);
        if (!*numbers[i]) {
            return false;
        }
        for (int64_t cell = 0; cell < sheet->cells; cell++) {
            (*numbers[i])[cell] = -1;
        }
    }
    return true;
}

// Means of each point and its six neighbours; the point itself counts twice.
static void smooth(Sheet *sheet, float **field, int passes)
{
    int64_t width = sheet->width;
    for (int pass = 0; pass < passes; pass++) {
        const float *from = *field;
        for (int64_t i = width; i < sheet->cells - width; i++) {
            // opposite neighbours first: the sum is the same from either side
            float around = (from[i - 1] + from[i + 1]) + (from[i - width] + from[i + width]) +
                           (from[i - width + 1] + from[i + width - 1]);
            sheet->spare[i] = 0.125f * (around + 2.0f * from[i]);
        }
        float *old = *field;
        *field = sheet->spare;
        sheet->spare = old;
    }
}

// Mean mass of a cell of ice.
static float mean_ice(const Snowfake *fake)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < (int64_t)fake->width * fake->width; i++) {
        sum += (double)fake->ice[i];
        count += fake->ice[i] > 0.0f;
    }
    return (float)(sum / (double)count);
}

// What a cell gives to a field.
typedef enum CellShare { SHARE_INSIDE, SHARE_RIDGE, SHARE_BORN } CellShare;

static float cell_share(const Snowfake *fake, CellShare share, float mean, int64_t cell)
{
    float ice = fake->ice[cell], born = fake->born[cell];
    if (!(ice > 0.0f)) {
        return 0.0f;
    }
    // ice is as thick as its boundary mass made it, and its faces go on growing
    return share == SHARE_INSIDE  ? 1.0f
           : share == SHARE_RIDGE ? ice / mean + AGEING * (1.0f - born)
                                  : born;
}

// The value at point (q, r) of a lattice with `detail` points to a cell: linear in each triangle of
// cells.
static float between_cells(const Snowfake *fake, CellShare share, float mean, int detail, int q,
                           int r)
{
    int last = fake->width - 1, from_q = q + fake->radius * detail,
        from_r = r + fake->radius * detail;
    int cell_q = from_q / detail, cell_r = from_r / detail;
    float u = (float)(from_q % detail) / (float)detail,
          v = (float)(from_r % detail) / (float)detail;
    int64_t right = cell_q < last, up = cell_r < last ? fake->width : 0;
    int64_t a = (int64_t)cell_r * fake->width + cell_q;
    float at_right = cell_share(fake, share, mean, a + right);
    float at_up = cell_share(fake, share, mean, a + up);
    if (u + v <= 1.0f) {
        float here = cell_share(fake, share, mean, a);
        return here + u * (at_right - here) + v * (at_up - here);
    }
    float across = cell_share(fake, share, mean, a + right + up);
    return across + (1.0f - u) * (at_up - across) + (1.0f - v) * (at_right - across);
}

static void fill_field(const Sheet *sheet, const Snowfake *fake, CellShare share, int detail,
                       float *field)
{
    float mean = mean_ice(fake);
    int reach = fake->radius * detail;
    for (int r = -reach; r <= reach; r++) {
        for (int q = -reach; q <= reach; q++) {
            field[sheet_at(sheet, q, r)] = between_cells(fake, share, mean, detail, q, r);
        }
    }
}

// Passes that smooth over so many cells as this number of them does where points are cells: the
// variance of a pass is a constant of the lattice.
static int passes_of(float passes, int detail)
{
    return (int)(passes * (float)(detail * detail) + 0.5f);
}

// Heights above the face that follow the time at which each point froze. Former outlines are lines
// of equal time, so that changes of the weather stand as ridges and grooves parallel to them.
static void fill_rings(Sheet *sheet, const SnowCrystalParams *params, const Snowfake *fake,
                       uint64_t seed)
{
    int detail = params->detail, passes = passes_of(1.0f, detail);
    uint64_t key = random_key(seed, STREAM_RINGS);
    fill_field(sheet, fake, SHARE_BORN, detail, sheet->ring);
    fill_field(sheet, fake, SHARE_INSIDE, detail, sheet->ridge);
    smooth(sheet, &sheet->ring, passes);
    smooth(sheet, &sheet->ridge, passes);
    for (int64_t i = 0; i < sheet->cells; i++) {
        float ice = sheet->ridge[i];
        float born = ice > 0.0f ? sheet->ring[i] / ice : 0.0f;
        sheet->ring[i] = ice > 0.0f ? noise_plane_fractal(RING_WAVES * born, 0.5f, 3, key) : 0.0f;
    }
    smooth(sheet, &sheet->ring, passes_of(0.25f, detail));
    memset(sheet->ridge, 0, (size_t)sheet->cells * sizeof *sheet->ridge);
}

static void fill_fields(Sheet *sheet, const SnowCrystalParams *params, const Snowfake *fake)
{
    int detail = params->detail;
    fill_field(sheet, fake, SHARE_INSIDE, detail, sheet->inside);
    fill_field(sheet, fake, SHARE_INSIDE, detail, sheet->height);
    fill_field(sheet, fake, SHARE_RIDGE, detail, sheet->ridge);
    float contour = (float)CONTOUR_PASSES + (float)WORN_PASSES * params->worn;
    smooth(sheet, &sheet->inside, passes_of(contour, detail));
    smooth(sheet, &sheet->height, passes_of((float)BEVEL_PASSES, detail));
    smooth(sheet, &sheet->ridge, passes_of((float)RELIEF_PASSES, detail));
}

// How far the face has risen from the outline, 0 .. 1: new edges are steep, worn ones are round.
static float edge_at(const Sheet *sheet, const SnowCrystalParams *params, int64_t point)
{
    float steep = clampf((sheet->height[point] - 0.2f) / 0.75f, 0.0f, 1.0f);
    float round = (sheet->inside[point] - SHEET_CONTOUR) / (1.0f - SHEET_CONTOUR);
    return sqrtf(lerpf(steep, clampf(round, 0.0f, 1.0f) * steep, params->worn));
}

// Half the thickness: it falls toward the tips, swells on ridges, and is bevelled along the
// outline.
static void fill_heights(Sheet *sheet, const SnowCrystalParams *params)
{
    float step = 0.15f * (1.0f - params->worn); // of the bevel, at the outline
    for (int r = -sheet->radius; r <= sheet->radius; r++) {
        for (int q = -sheet->radius; q <= sheet->radius; q++) {
            int64_t point = sheet_at(sheet, q, r);
            float edge = edge_at(sheet, params, point), swell = sheet->ridge[point];
            float cells = (float)params->cells * (float)params->detail;
            float away = (float)snowfake_distance(q, r) / cells;
            float taper = 1.0f - THINNING * clampf(away, 0.0f, 1.0f);
            float height = lerpf(1.0f, swell < 3.0f ? swell : 3.0f, params->relief);
            float half = 0.5f * params->thickness * taper;
            sheet->height[point] = half * (step + height * edge);
            if (sheet->ring) {
                float swing = clampf(sheet->ring[point], -1.0f, 1.0f);
                sheet->ring[point] = half * height * edge * RING_HEIGHT * params->rings * swing;
            }
        }
    }
}

bool sheet_make(Sheet *sheet, const SnowCrystalParams *params, const Snowfake *fake, uint64_t seed,
                Error *e)
{
    bool rings = params->rings > 0.0f;
    int margin = (BEVEL_PASSES + 2) * params->detail;
    if (!sheet_init(sheet, fake->radius * params->detail + margin, rings, e)) {
        return false;
    }
    if (rings) {
        fill_rings(sheet, params, fake, seed);
    }
    fill_fields(sheet, params, fake);
    fill_heights(sheet, params);
    return true;
}
