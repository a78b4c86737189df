// Water surfaces: a level lake, and ribbons along the rivers.
#include "base/memory.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/form.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

// ---- the lake

enum { LAKE_BLOCKS = 64 }; // a side

typedef struct Sheet {
    const HeightField *field;
    float level, over; // m; land up to this height above the level may be drawn lower
} Sheet;

// Is any land in a block of the field under water?
static bool is_wet(const Sheet *lake, int column, int row)
{
    const HeightField *field = lake->field;
    int first = column * (field->columns - 1) / LAKE_BLOCKS;
    int last = (column + 1) * (field->columns - 1) / LAKE_BLOCKS;
    int bottom = (row + 1) * (field->rows - 1) / LAKE_BLOCKS;
    for (int r = row * (field->rows - 1) / LAKE_BLOCKS; r <= bottom; r++) {
        for (int c = first; c <= last; c++) {
            if (field->height[(int64_t)r * field->columns + c] < lake->level + lake->over) {
                return true;
            }
        }
    }
    return false;
}

// Level squares over all blocks with land under water, so that no water is visible below mountains
// cut off at the border.
static Mesh *lake_mesh(const Sheet *lake, Vec3 move, Error *e)
{
    const HeightField *field = lake->field;
    enum { SIDE = LAKE_BLOCKS + 1 };
    bool wet[LAKE_BLOCKS * LAKE_BLOCKS];
    int64_t faces = 0;
    for (int i = 0; i < LAKE_BLOCKS * LAKE_BLOCKS; i++) {
        wet[i] = is_wet(lake, i % LAKE_BLOCKS, i / LAKE_BLOCKS);
        faces += wet[i];
    }
    Mesh *mesh = mesh_new(4, SIDE * SIDE, faces, MESH_NORMAL | MESH_UV, e);
    if (!mesh) {
        return NULL;
    }
    float width = field->cell.x * (float)(field->columns - 1) / LAKE_BLOCKS;
    float depth = field->cell.y * (float)(field->rows - 1) / LAKE_BLOCKS;
    for (int i = 0; i < SIDE * SIDE; i++) {
        int row = i / SIDE;
        float x = field->origin.x + (float)(i % SIDE) * width;
        float z = field->origin.y + (float)row * depth;
        mesh->position[i] = vec3(move.x + x, move.y + lake->level, move.z + z);
        mesh->normal[i] = vec3(0, 1, 0);
        mesh->uv[i] = (Vec2){x, z};
    }
    uint32_t *corner = mesh->index;
    for (uint32_t i = 0; i < LAKE_BLOCKS * LAKE_BLOCKS; i++) {
        uint32_t v = i / LAKE_BLOCKS * SIDE + i % LAKE_BLOCKS;
        if (wet[i]) { // counter-clockwise from above
            *corner++ = v;
            *corner++ = v + SIDE;
            *corner++ = v + SIDE + 1;
            *corner++ = v + 1;
        }
    }
    return mesh;
}

// ---- rivers

typedef struct Ribbons {
    const Terrain *terrain;
    const OutTree *water;
    const HeightField *field;
    const DrawnLand *land;
    const int32_t *main; // per node: the child with the most water; -1 = none
    float lake;          // level below which the lake's surface covers the river's
    float along;         // of the river's row: see terrain_drawn_out
    Mesh *mesh;          // NULL = only count
    int64_t vertices, faces;
} Ribbons;

// The land at a place of a shore; of tiles, whose cells may be finer than the river's rows, the
// lowest up to the rows beside it.
static float shore_at(const Ribbons *r, Vec3 p, Vec3 across)
{
    enum { EACH = 6 }; // places to each side; rows are up to a cell apart, outside of bends
    float lowest = drawn_land_at(r->land, p.x, p.z), step = r->field->cell.x / EACH;
    for (int k = 1; r->land->mesh && k <= EACH; k++) {
        float x = step * (float)k * across.z, z = -step * (float)k * across.x;
        lowest = fminf(lowest, drawn_land_at(r->land, p.x + x, p.z + z));
        lowest = fminf(lowest, drawn_land_at(r->land, p.x - x, p.z - z));
    }
    return lowest;
}

// A vertex `side` times half the width from the middle: at the river's level, but in cascades,
// which the cells resolve poorly, always on the land; in pools, below the wall of a fall, under it.
// Outermost vertices, beyond 1, are below the shore.
static Vec3 water_vertex(const Ribbons *r, Vec3 middle, Vec3 across, float half, float side,
                         int32_t node)
{
    const float border = 0.5f * r->terrain->params->size;
    Vec3 p = vec3_madd(middle, side * half, across);
    p.x = clampf(p.x, -border, border);
    p.z = clampf(p.z, -border, border);
    float film = terrain_bed_depth(half, half);
    bool pool = r->terrain->flow[node].at_fall;
    if (fabsf(side) > 1.0f) {
        p.y = shore_at(r, p, across) - film;
        p.y = pool && p.y > middle.y ? middle.y : p.y;
        return p;
    }
    float land = drawn_land_at(r->land, p.x, p.z);
    float depth = terrain_bed_depth(half, fabsf(side) * half);
    float least = pool ? fminf(land + 0.5f * film, middle.y) : land + 0.5f * film;
    p.y = clampf(middle.y, least, land + depth + film);
    return p;
}

// Normal of the water surface from `above` to `below`.
static Vec3 water_normal(Vec3 below, Vec3 above)
{
    float dx = above.x - below.x, dz = above.z - below.z, squared = dx * dx + dz * dz;
    float slope = squared > 0.0f ? (above.y - below.y) / squared : 0.0f; // a metre, per metre
    return vec3_normalize(vec3(-slope * dx, 1.0f, -slope * dz));
}

// Adds one row of `columns` vertices across the river, which flows from `above` to `below`.
static void add_row(Ribbons *r, Vec3 middle, Vec3 below, Vec3 above, float half, int columns,
                    int32_t node)
{
    Vec3 across = vec3_normalize(vec3(above.z - below.z, 0.0f, below.x - above.x));
    Vec3 normal = water_normal(below, above);
    float cell = r->field->cell.x, under = 1.0f + (half > 5.0f * cell ? 0.5f * cell / half : 0.1f);
    for (int i = 0; i < columns; i++) {
        float side = 2.0f * (float)(i - 1) / (float)(columns - 3) - 1.0f;
        side = i == 0 ? -under : i == columns - 1 ? under : side;
        Vec3 p = water_vertex(r, middle, across, half, side, node);
        int64_t v = r->vertices + i;
        r->mesh->position[v] = vec3_add(p, r->terrain->params->position);
        r->mesh->normal[v] = normal;
        r->mesh->uv[v] = (Vec2){r->along, side * half};
        r->mesh->foam[v] = r->terrain->flow[node].foam;
    }
}

// Adds faces between the last two rows, counter-clockwise from above; also if rows cross at the
// inner bank of a sharp bend.
static void add_faces(Ribbons *r, int columns)
{
    for (int i = 0; i + 1 < columns; i++) {
        uint32_t *corner = r->mesh->index + (r->faces + i) * 4;
        uint32_t after = (uint32_t)(r->vertices + i), before = after - (uint32_t)columns;
        const Vec3 *p = r->mesh->position;
        bool folded =
            vec3_cross(vec3_sub(p[after + 1], p[before]), vec3_sub(p[before + 1], p[after])).y <
            0.0f;
        corner[0] = before;
        corner[1] = folded ? before + 1 : after;
        corner[2] = after + 1;
        corner[3] = folded ? after : before + 1;
    }
}

static float level_distance(Vec3 a, Vec3 b)
{
    return sqrtf((a.x - b.x) * (a.x - b.x) + (a.z - b.z) * (a.z - b.z));
}

// Adds a river from its root, or a tributary from the river that it enters (the parent of `first`).
static void add_stem(Ribbons *r, int32_t first)
{
    enum { MOST_PIECES = 16 }; // to each side
    const OutTree *water = r->water;
    float pieces = water->radius[first] / r->field->cell.x;
    int columns = 2 * (1 + (int)(pieces < MOST_PIECES ? pieces : MOST_PIECES)) + 3;
    int32_t below = -1, here = water->parent[first] >= 0 ? water->parent[first] : first;
    r->along = 0.0f;
    while (here >= 0) {
        int32_t above = below < 0 && here != first ? first : r->main[here];
        bool falls = below >= 0 && r->terrain->drop[here] > 0.0f; // see falls.c
        Vec3 at = water->position[here];
        bool covered = terrain_lake_at(r->terrain, r->field, at.x, at.z) > -INFINITY;
        bool shows = below >= 0 && !falls && !covered && at.y >= r->lake;
        if (r->mesh) {
            Vec3 from = water->position[below >= 0 ? below : here];
            Vec3 to = water->position[above >= 0 ? above : here];
            // Water is as level at a lip, and at a foot, as beside it.
            from.y = r->terrain->drop[here] > 0.0f ? at.y : from.y;
            to.y = above >= 0 && r->terrain->drop[above] > 0.0f ? at.y : to.y;
            r->along += terrain_drawn_out(r->terrain->flow[here].speed) * level_distance(from, at);
            // A brook enters a wider river with its own width.
            float half = below < 0 ? water->radius[first] : water->radius[here];
            add_row(r, water->position[here], from, to, half, columns, here);
            if (shows) {
                add_faces(r, columns);
            }
        }
        r->vertices += columns;
        r->faces += shows ? columns - 1 : 0;
        below = here;
        here = above;
    }
}

static void add_stems(Ribbons *r)
{
    r->vertices = r->faces = 0;
    for (int64_t i = 0; i < r->water->count; i++) {
        int32_t parent = r->water->parent[i];
        if (parent < 0 ? r->main[i] >= 0 : r->main[parent] != i) {
            add_stem(r, (int32_t)i);
        }
    }
}

static bool add_rivers(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Terrain *terrain = land->terrain;
    Ribbons r = {.terrain = terrain,
                 .water = terrain->water,
                 .field = land->field,
                 .land = land,
                 .lake = -INFINITY};
    if (terrain->params->water_level > 0.0f) {
        r.lake = terrain_water_height(terrain->params, land->field);
    }
    int32_t *main = terrain_main_children(r.water, e);
    if (!main) {
        return false;
    }
    r.main = main;
    add_stems(&r);
    bool done = true;
    if (r.faces > 0) {
        r.mesh = mesh_new(4, r.vertices, r.faces, MESH_NORMAL | MESH_UV | MESH_FOAM, e);
        if (r.mesh) {
            add_stems(&r);
        }
        done = drawn_add_water(land, r.mesh, placing, e);
    }
    free(main);
    return done;
}

// The water of the square, or of its copy.
static bool add_water_of(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Terrain *terrain = land->terrain;
    const TerrainParams *params = terrain->params;
    if (params->water_level > 0.0f) {
        Sheet lake = {land->field, terrain_water_height(params, land->field),
                      params->mesh_error * params->size};
        if (!drawn_add_water(land, lake_mesh(&lake, params->position, e), placing, e)) {
            return false;
        }
    }
    if (terrain_form(params)->water && !terrain_add_flow(terrain, land->field, placing, e)) {
        return false;
    }
    return terrain_add_lakes(land, placing, e) &&
           (!terrain->water ||
            (add_rivers(land, placing, e) && terrain_add_falls(land, placing, e)));
}

bool terrain_add_water(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Terrain *terrain = land->terrain;
    bool copied = land->mesh && !terrain_tiles_end(terrain->params);
    int rings = copied ? terrain->params->beyond : 0;
    DrawnLand copy = *land;
    bool done = add_water_of(land, placing, e);
    for (copy.row = -rings; done && copy.row <= rings; copy.row++) {
        for (copy.column = -rings; done && copy.column <= rings; copy.column++) {
            done = !drawn_is_copy(&copy) || add_water_of(&copy, placing, e);
        }
    }
    return done;
}
