// The grid's own space has its axes along those of the samples and is measured in metres of the
// scene, so that a walk's distances are those along the ray. A part lies between eight samples, of
// which interpolation exceeds none: its bounds are theirs.
#include "render/cloud/cloud_voxels.h"

#include "base/memory.h"
#include "render/cloud/cloud_bounds.h"
#include "render/cloud/cloud_spray.h"
#include "shape/sparse_volume.h"

#include <math.h>

enum { ACROSS = CELL * 2 }; // samples along a cell's side; PARTS of them
enum {
    SPRAY_BYTES = 60000000, // about, of some falls or a kilometre of surf
    WATER_BYTES = 150000000 // about, of a fall's water
};

_Static_assert((int)PARTS == (int)ACROSS, "a part lies between samples");

static const float ROUNDING = 1e-4f; // of the highest value, in lookups

// Cells are counted from the sample before the first, since values fall to 0 up to there.
static int sample_of(int part)
{
    return part - 1;
}

static void bound_part(const CloudGrid *g, int x, int y, int z, CloudBounds *bounds)
{
    float low = INFINITY, high = 0.0f;
    for (int k = 0; k < 8; k++) {
        float value = sparse_volume_sample(g->voxels, sample_of(x) + (k & 1),
                                           sample_of(y) + (k >> 1 & 1), sample_of(z) + (k >> 2));
        low = fminf(low, value);
        high = fmaxf(high, value);
    }
    float scale = CELL_STEPS / g->voxels->highest;
    bounds->least = (uint8_t)floorf(fmaxf(low * scale - ROUNDING * CELL_STEPS, 0.0f));
    float most = high > 0.0f ? high * scale + ROUNDING * CELL_STEPS : 0.0f;
    bounds->most = (uint8_t)fminf(ceilf(most), CELL_STEPS);
}

static CloudBounds bound_parts(const CloudGrid *g, int cx, int cy, int cz, CloudBounds part[])
{
    CloudBounds all = {CELL_STEPS, 0};
    for (int i = 0; i < PARTS * PARTS * PARTS; i++) {
        int x = i / PARTS % PARTS, y = i % PARTS, z = i / (PARTS * PARTS);
        bound_part(g, cx * PARTS + x, cy * PARTS + y, cz * PARTS + z, &part[i]);
        all.least = part[i].least < all.least ? part[i].least : all.least;
        all.most = part[i].most > all.most ? part[i].most : all.most;
    }
    return all;
}

// Whether samples of blocks that the cell and the samples around it touch have values.
static bool may_hold_values(const CloudGrid *g, int cx, int cy, int cz)
{
    const SparseVolume *v = g->voxels;
    const int at[3] = {cx, cy, cz};
    int low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (at[axis] * PARTS - 1) / SPARSE_SIDE; // -1 belongs to no block
        high[axis] = (at[axis] + 1) * PARTS / SPARSE_SIDE;
        high[axis] = high[axis] < v->blocks[axis] ? high[axis] : v->blocks[axis] - 1;
    }
    for (int z = low[2]; z <= high[2]; z++) {
        for (int y = low[1]; y <= high[1]; y++) {
            for (int x = low[0]; x <= high[0]; x++) {
                if (v->block[((int64_t)z * v->blocks[1] + y) * v->blocks[0] + x] >= 0) {
                    return true;
                }
            }
        }
    }
    return false;
}

static void bound_cell(CloudGrid *g, int x, int y, int z)
{
    CloudCell *cell = &g->cell[cloud_grid_cell(g, x, y, z)];
    if (cell->parts < 0) {
        return;
    }
    cell->bounds = bound_parts(g, x, y, z, &g->part[(int64_t)cell->parts * PARTS * PARTS * PARTS]);
    cell->parts = cell->bounds.most > cell->bounds.least ? cell->parts : -1;
}

static bool fill_bounds(CloudGrid *g, const Run *run, Error *e)
{
    int64_t count = 0;
    for (int z = 0; z < g->cells[2]; z++) {
        for (int x = 0; x < g->cells[0]; x++) {
            for (int y = 0; y < g->cells[1]; y++) {
                bool held = may_hold_values(g, x, y, z);
                g->cell[cloud_grid_cell(g, x, y, z)] =
                    (CloudCell){.parts = held ? (int32_t)count++ : -1};
            }
        }
    }
    double bytes = (double)count * sizeof *g->part * PARTS * PARTS * PARTS;
    if (!memory_check(bytes, e, "bounds of %lld cells of a cloud's grid", (long long)count)) {
        return false;
    }
    g->part = memory_alloc_wide(count > 0 ? count : 1, sizeof *g->part * PARTS * PARTS * PARTS, e);
    if (!g->part) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int z = 0; z < g->cells[2]; z++) {
        for (int x = 0; x < g->cells[0]; x++) {
            for (int y = 0; y < g->cells[1]; y++) {
                bound_cell(g, x, y, z);
            }
        }
    }
    cloud_bounds_find_gaps(g);
    return true;
}

// ---- layout ----

static float row_length(const Transform *t, int row)
{
    return vec3_length(vec3(t->m[row][0], t->m[row][1], t->m[row][2]));
}

// From the scene to the grid's own space; false if the file's map or the scale makes no sense.
static bool lay_out(CloudGrid *g, const Cloud *cloud)
{
    const SparseVolume *v = g->voxels;
    Transform placed =
        transform_compose(cloud->position, cloud->rotation, vec3_splat(cloud->scale));
    Transform to_file;
    if (!transform_inverse(&placed, &to_file)) {
        return false;
    }
    Transform to_index = transform_multiply(&v->to_index, &to_file);
    float size = cbrtf(fabsf(transform_determinant(&to_index))); // samples a metre
    if (!(size > 0.0f && isfinite(size) && row_length(&to_index, 0) < 1e6f * size)) {
        return false;
    }
    float sample = 1.0f / size;
    g->sample = sample;
    g->voxel = sample * (float)ACROSS / CELL;
    g->low = vec3_splat(-sample);
    for (int axis = 0; axis < 3; axis++) {
        int parts = v->blocks[axis] * SPARSE_SIDE + 1; // from the sample before the first
        g->cells[axis] = (parts + PARTS - 1) / PARTS;
        g->count[axis] = g->cells[axis] * CELL;
        for (int column = 0; column < 4; column++) {
            g->to_own.m[axis][column] = to_index.m[axis][column] * sample;
        }
    }
    return true;
}

// Voxels of spray; before it is known, of none.
static bool sum_spray(CloudGrid *g, const Cloud *cloud, Error *e)
{
    const SprayParcels none = {0};
    *g = (CloudGrid){.voxels = cloud_spray_volume(cloud->spray ? cloud->spray : &none, e)};
    if (g->voxels && !(g->voxels->highest > 0.0f)) {
        g->voxels->highest = 1.0f; // the scale of its bounds
    }
    return g->voxels;
}

static bool bound(CloudGrid *g, const Cloud *cloud, const Run *run, Error *e)
{
    g->extinction = cloud->extinction * g->voxels->highest;
    g->rough.edge[1] = 4.0f * g->voxel; // over which its guiding normals turn
    g->cell = memory_alloc_wide(cloud_grid_cells(g), sizeof *g->cell, e);
    return g->cell && fill_bounds(g, run, e);
}

bool cloud_voxels_new(CloudGrid *g, const Cloud *cloud, const Run *run, Error *e)
{
    if (cloud->kind == CLOUD_SPRAY) {
        Cloud own = *cloud; // its samples are in the scene
        own.scale = 1.0f;
        own.position = own.rotation = vec3_splat(0.0f);
        return sum_spray(g, cloud, e) && lay_out(g, &own) && bound(g, cloud, run, e);
    }
    *g = (CloudGrid){.voxels = sparse_volume_read(cloud->file, cloud->grid, run, e)};
    if (!g->voxels) {
        return e && e->key[0] ? false : error_key(e, "file"); // or it blames the grid
    }
    bool placed = lay_out(g, cloud);
    if (!placed || !(g->voxels->highest > 0.0f)) {
        error_set(e, ERROR_INPUT, "the grid of '%s' has %s", cloud->file,
                  placed ? "no density above 0; a fog volume or a level set is needed"
                         : "a map that cannot be inverted; resample the grid");
        return error_key(e, "file");
    }
    return bound(g, cloud, run, e);
}

// Parts of cells that hold values take 2 bytes a sample beside its 4, cells 8 bytes each.
int64_t cloud_voxels_bytes(const Cloud *cloud)
{
    if (cloud->kind == CLOUD_SPRAY) {
        return cloud->of == SPRAY_WATER ? WATER_BYTES : SPRAY_BYTES;
    }
    Run run = run_default();
    int64_t bytes = cloud->file ? sparse_volume_estimate(cloud->file, cloud->grid, &run) : 0;
    return bytes + bytes / 2 + bytes / 4;
}

float cloud_voxels_extinction(const CloudGrid *g, Vec3 p)
{
    Vec3 own = transform_point(&g->to_own, p);
    Vec3 at = vec3_scale(own, 1.0f / g->sample);
    const float place[3] = {at.x, at.y, at.z};
    for (int axis = 0; axis < 3; axis++) {
        if (!(place[axis] > -1.0f &&
              place[axis] < (float)(g->voxels->blocks[axis] * SPARSE_SIDE))) {
            return 0.0f;
        }
    }
    return g->extinction / g->voxels->highest * sparse_volume_at(g->voxels, at);
}
