// Water whose level the heights record, as of braided and meandering rivers: a surface that meets
// the ground of the land's own mesh at its shores.
#include "base/memory.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/form.h"

#include <math.h>
#include <stdlib.h>

static const float POOL_FALL = 0.05f; // m: how far below the ground the water of a drained pool is

static bool is_known(const HeightField *field, int64_t i)
{
    return field->water[i] > -INFINITY;
}

// ---- pools

// Labels: of samples, by what has been found of them.
enum { DRY, STANDING, SEEN };

// Levels are continued beside the flow as far as shores need. Where they lie above the ground there
// without an end, as in the hollows of bars, the water would be cut off along the grid.
typedef struct PoolSearch {
    HeightField *field;
    uint8_t *label;
    int32_t *stack; // of the samples of a pool; all that were found stay on it
    int64_t count;
    bool cut; // it reaches where no level is known
} PoolSearch;

static void visit(PoolSearch *s, int64_t i)
{
    if (!is_known(s->field, i)) {
        s->cut = true;
    } else if (s->label[i] == STANDING) {
        s->label[i] = SEEN;
        s->stack[s->count++] = (int32_t)i;
    }
}

static void find_pool(PoolSearch *s, int64_t from)
{
    int64_t columns = s->field->columns, rows = s->field->rows;
    s->count = 0;
    s->cut = false;
    visit(s, from);
    for (int64_t k = 0; k < s->count; k++) {
        int64_t i = s->stack[k], column = i % columns, row = i / columns;
        for (int n = 0; n < 9; n++) {
            int64_t c = column + n % 3 - 1, r = row + n / 3 - 1;
            if (c >= 0 && r >= 0 && c < columns && r < rows) {
                visit(s, r * columns + c);
            }
        }
    }
}

bool terrain_drain_pools(HeightField *field, Error *e)
{
    int64_t count = height_field_count(field);
    PoolSearch s = {.field = field,
                    .label = memory_alloc(count, 1, e),
                    .stack = memory_alloc(count, sizeof *s.stack, e)};
    bool done = s.label && s.stack;
    for (int64_t i = 0; done && i < count; i++) {
        // Of what is under water, wetness is 1 where it flows.
        bool standing =
            is_known(field, i) && field->water[i] > field->height[i] && field->wetness[i] < 1.0f;
        s.label[i] = standing ? STANDING : DRY;
    }
    for (int64_t i = 0; done && i < count; i++) {
        if (s.label[i] != STANDING) {
            continue;
        }
        find_pool(&s, i);
        for (int64_t k = 0; s.cut && k < s.count; k++) {
            field->water[s.stack[k]] = field->height[s.stack[k]] - POOL_FALL;
        }
    }
    free(s.stack);
    free(s.label);
    return done;
}

// ---- the mesh

// Where water is near, every sample is a vertex of the land: its depth is less than the mesh's
// error far away.
bool terrain_keep_shores(Terrain *terrain, const HeightField *field, float reach, Error *e)
{
    terrain->bank = memory_alloc_zero(height_field_count(field), 1, e);
    for (int64_t i = 0; terrain->bank && i < height_field_count(field); i++) {
        terrain->bank[i] = is_known(field, i) && field->height[i] < field->water[i] + reach;
    }
    return terrain->bank;
}

// The surface of the water on the samples of the land.
typedef struct WaterMesher {
    const Terrain *terrain;
    const HeightField *field;
    int32_t *vertex; // of each sample; -1 = none
    int64_t vertices, faces;
} WaterMesher;

// Is there water at a corner of the cell, and a level at all of them?
static bool is_wet(const HeightField *field, const int64_t *corner)
{
    bool wet = false;
    for (int k = 0; k < 4; k++) {
        if (!is_known(field, corner[k])) {
            return false;
        }
        wet = wet || field->water[corner[k]] > field->height[corner[k]];
    }
    return wet;
}

static bool cell_corners(const HeightField *field, int64_t cell, int64_t corner[4])
{
    int64_t columns = field->columns, column = cell % columns;
    if (column + 1 >= columns || cell / columns + 1 >= field->rows) {
        return false;
    }
    corner[0] = cell; // counter-clockwise from above
    corner[1] = cell + columns;
    corner[2] = cell + columns + 1;
    corner[3] = cell + 1;
    return is_wet(field, corner);
}

static void count_parts(WaterMesher *w)
{
    int64_t corner[4];
    for (int64_t i = 0; i < height_field_count(w->field); i++) {
        w->vertex[i] = -1;
    }
    for (int64_t i = 0; i < height_field_count(w->field); i++) {
        if (!cell_corners(w->field, i, corner)) {
            continue;
        }
        w->faces++;
        for (int k = 0; k < 4; k++) {
            if (w->vertex[corner[k]] < 0) {
                w->vertex[corner[k]] = (int32_t)w->vertices++;
            }
        }
    }
}

static Vec3 water_normal(const HeightField *field, int64_t i)
{
    int64_t column = i % field->columns, row = i / field->columns;
    int64_t west = column > 0 ? i - 1 : i, east = column + 1 < field->columns ? i + 1 : i;
    int64_t north = row > 0 ? i - field->columns : i;
    int64_t south = row + 1 < field->rows ? i + field->columns : i;
    float dx = 0.0f, dz = 0.0f;
    if (is_known(field, west) && is_known(field, east)) {
        float cells = (float)(east - west);
        dx = (field->water[east] - field->water[west]) / (field->cell.x * cells);
    }
    if (is_known(field, north) && is_known(field, south)) {
        int64_t rows = (south - north) / field->columns;
        float cells = (float)rows;
        dz = (field->water[south] - field->water[north]) / (field->cell.y * cells);
    }
    return vec3_normalize(vec3(-dx, 1.0f, -dz));
}

// site.x: depth over 1 m + itself; site.y: how rough the water is. uv.x: its streamline, or x.
static void fill_vertices(const WaterMesher *w, Mesh *mesh)
{
    const HeightField *field = w->field;
    const Form *form = terrain_form(w->terrain->params);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        int32_t v = w->vertex[i];
        if (v < 0) {
            continue;
        }
        int64_t column = i % field->columns, row = i / field->columns;
        Vec2 at = {field->origin.x + (float)column * field->cell.x,
                   field->origin.y + (float)row * field->cell.y};
        float depth = field->water[i] - field->height[i];
        depth = depth > 0.0f ? depth : 0.0f;
        mesh->position[v] =
            vec3_add(vec3(at.x, field->water[i], at.y), w->terrain->params->position);
        mesh->normal[v] = water_normal(field, i);
        mesh->uv[v] = (Vec2){mesh->position[v].x, mesh->position[v].z};
        if (form->line) {
            mesh->uv[v].x = form->line(w->terrain, at.x, at.y);
        }
        mesh->site[v] = (Vec2){depth / (1.0f + depth), form->roughness(w->terrain, at.x, at.y)};
    }
}

static Mesh *water_mesh(const WaterMesher *w, Error *e)
{
    Mesh *mesh = mesh_new(4, w->vertices, w->faces, MESH_NORMAL | MESH_UV | MESH_SITE, e);
    int64_t face = 0, corner[4];
    for (int64_t i = 0; mesh && i < height_field_count(w->field); i++) {
        if (cell_corners(w->field, i, corner)) {
            for (int k = 0; k < 4; k++) {
                mesh->index[4 * face + k] = (uint32_t)w->vertex[corner[k]];
            }
            face++;
        }
    }
    if (mesh) {
        fill_vertices(w, mesh);
    }
    return mesh;
}

bool terrain_add_flow(const Terrain *terrain, const HeightField *field, const Placing *placing,
                      Error *e)
{
    WaterMesher w = {.terrain = terrain, .field = field};
    w.vertex = memory_alloc(height_field_count(field), sizeof *w.vertex, e);
    if (!w.vertex) {
        return false;
    }
    count_parts(&w);
    bool done =
        w.faces == 0 ||
        placing_add(placing, (Part){.mesh = water_mesh(&w, e), .is_water = true}, TERRAIN_WATER, e);
    bool copied = terrain->params->beyond > 0 && !terrain_form(terrain->params)->beyond;
    if (done && w.faces > 0 && copied) {
        Mesh *mesh = water_mesh(&w, e);
        done = mesh && terrain_add_copies(mesh, terrain->params, placing, TERRAIN_WATER, e);
    }
    free(w.vertex);
    return done;
}
