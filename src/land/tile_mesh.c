#include "land/tile_mesh.h"

#include "base/memory.h"
#include "land/height_mesh.h"
#include "land/tile_detail.h"

#include <math.h>
#include <stdlib.h>

// A tile's samples, row by row.
typedef struct Tile {
    int column, row; // in the world's grid; may be negative
    int cells;       // a side
    Vec3 *position;
    Vec3 *normal;
    Vec2 *site;
    int64_t first_vertex, first_face; // in the mesh
} Tile;

typedef struct Tiling {
    const HeightField *world;
    const TileGrid *grid;
    const TileView *view;
    int first, side; // of the square of tiles: its first column and row; tiles a side
    float low, high; // m: of the world
    Tile *tile;
} Tiling;

static double cell_size(const Tiling *t)
{
    double cells = (double)t->grid->count * (double)t->grid->cells;
    return (double)t->world->cell.x * (double)(t->world->columns - 1) / cells;
}

// ---- how fine

static float outside(float x, float low, float high)
{
    return x < low ? low - x : x > high ? x - high : 0.0f;
}

// From the eye to the nearest place of a tile that the land may reach, m.
static float distance_to(const Tiling *t, int column, int row)
{
    Vec3 eye = *t->view->eye;
    float side = (float)(cell_size(t) * t->grid->cells);
    float x = t->world->origin.x + (float)column * side;
    float z = t->world->origin.y + (float)row * side;
    float dx = outside(eye.x, x, x + side), dz = outside(eye.z, z, z + side);
    float dy = outside(eye.y, t->low, t->high);
    return sqrtf(dx * dx + dy * dy + dz * dz);
}

// Is a tile to be drawn with the world's own cells at least?
static bool is_whole(const Tiling *t, int column, int row)
{
    const TileShaping *shaping = t->view->shaping;
    int64_t count = t->grid->count; // the tile's middle, in half tiles
    int64_t c = tile_folded(2 * (int64_t)column + 1, 2 * count, t->world->periodic) / 2;
    int64_t r = tile_folded(2 * (int64_t)row + 1, 2 * count, t->world->periodic) / 2;
    return shaping && shaping->whole[r * count + c] != 0;
}

static int cells_of(const Tiling *t, int column, int row)
{
    const TileGrid *grid = t->grid;
    int cells = grid->cells, own = (t->world->columns - 1) / grid->count;
    own = own > TILE_LEAST_DRAWN ? own : TILE_LEAST_DRAWN;
    if (!t->view->eye) {
        return own;
    }
    int least = is_whole(t, column, row) ? own : TILE_LEAST_DRAWN;
    double most = (double)t->view->cell * (double)distance_to(t, column, row);
    double cell = 2.0 * cell_size(t);
    while (cells > least && cell <= most) {
        cells /= 2;
        cell *= 2.0;
    }
    return cells;
}

static Tiling tiling_of(const HeightField *world, const TileGrid *grid, const TileView *view)
{
    Tiling t = {.world = world,
                .grid = grid,
                .view = view,
                .first = -view->beyond * grid->count,
                .side = (2 * view->beyond + 1) * grid->count};
    height_field_range(world, &t.low, &t.high);
    return t;
}

int tile_mesh_cells(const HeightField *world, const TileGrid *grid, const TileView *view,
                    int column, int row)
{
    Tiling t = tiling_of(world, grid, view);
    return cells_of(&t, column, row);
}

// ---- samples

static void tile_clear(Tile *tile)
{
    free(tile->position);
    free(tile->normal);
    free(tile->site);
}

static bool make_room(Tile *tile, Error *e)
{
    int64_t count = (int64_t)(tile->cells + 1) * (tile->cells + 1);
    return (tile->position = memory_alloc(count, sizeof *tile->position, e)) &&
           (tile->normal = memory_alloc(count, sizeof *tile->normal, e)) &&
           (tile->site = memory_alloc(count, sizeof *tile->site, e));
}

// x, z: in the finest cells from the world's corner, in doubles, so that a place has one position
// in all tiles.
static Vec3 place_at(const Tiling *t, int64_t x, int64_t z, float height)
{
    Vec3 p = vec3((float)((double)t->world->origin.x + cell_size(t) * (double)x), height,
                  (float)((double)t->world->origin.y + cell_size(t) * (double)z));
    p.y -= tile_view_sinks(t->view, p.x, p.z);
    return p;
}

static Vec3 place_of(const Tiling *t, const Tile *tile, int column, int row, float height)
{
    int64_t each = t->grid->cells / tile->cells;
    int64_t x = (int64_t)tile->column * t->grid->cells + column * each;
    int64_t z = (int64_t)tile->row * t->grid->cells + row * each;
    return place_at(t, x, z, height);
}

float tile_view_sinks(const TileView *view, float x, float z)
{
    float dx = view->eye ? x - view->eye->x : 0.0f, dz = view->eye ? z - view->eye->z : 0.0f;
    return view->curve * (dx * dx + dz * dz);
}

// Shapes the samples of a tile and of its margin of one, made with `cells` a side.
static void shape_field(const Tiling *t, const Tile *tile, int cells, HeightField *field)
{
    const HeightField *world = t->world;
    const TileShaping *shaping = t->view->shaping;
    int64_t own = world->columns - 1, all = (int64_t)t->grid->count * cells;
    double cell = (double)world->cell.x * (double)own / (double)all;
    for (int64_t i = 0; shaping && i < height_field_count(field); i++) {
        int64_t x = (int64_t)tile->column * cells + i % field->columns - 1;
        int64_t z = (int64_t)tile->row * cells + i / field->columns - 1;
        double u = (double)tile_folded(x, all, world->periodic);
        double v = (double)tile_folded(z, all, world->periodic);
        TileSample sample = {.at = {(float)((double)world->origin.x + cell * u),
                                    (float)((double)world->origin.y + cell * v)},
                             .u = u * (double)own / (double)all,
                             .v = v * (double)own / (double)all,
                             .cell = (float)cell};
        field->height[i] = shaping->height(shaping->data, &sample, field->height[i]);
    }
}

// Tiles coarser than the world leave some of its samples out.
static bool fill_tile(const Tiling *t, Tile *tile, const Run *run, Error *e)
{
    int own = (t->world->columns - 1) / t->grid->count;
    TileGrid grid = *t->grid;
    grid.cells = tile->cells > own ? tile->cells : own;
    HeightField *field = tile_land_around(t->world, &grid, tile->column, tile->row, 1, run, e);
    bool done = field && make_room(tile, e);
    if (done) {
        shape_field(t, tile, grid.cells, field);
    }
    int each = grid.cells / tile->cells, side = tile->cells + 1;
    for (int i = 0; done && i < side * side; i++) {
        int column = i % side, row = i / side;
        int at[2] = {1 + column * each, 1 + row * each};
        int64_t sample = (int64_t)at[1] * field->columns + at[0];
        tile->position[i] = place_of(t, tile, column, row, field->height[sample]);
        tile->normal[i] = height_mesh_normal(field, at[0], at[1]);
        tile->site[i] = height_mesh_site(field, sample, t->low, t->high);
    }
    height_field_free(field);
    return done;
}

// Tiles are filled side by side, each by one thread: most are small.
static bool fill_tiles(Tiling *t, const Run *run, Error *e)
{
    int64_t count = (int64_t)t->side * t->side;
    Run alone = *run;
    alone.threads = 1;
    bool done = (t->tile = memory_alloc_zero(count, sizeof *t->tile, e));
#pragma omp parallel for schedule(dynamic) num_threads(run->threads)
    for (int64_t i = 0; i < (done ? count : 0); i++) {
        Error own = {0};
        Tile *tile = &t->tile[i];
        tile->column = t->first + (int)(i % t->side);
        tile->row = t->first + (int)(i / t->side);
        tile->cells = cells_of(t, tile->column, tile->row);
        if (!fill_tile(t, tile, &alone, &own)) {
#pragma omp critical
            {
                done = false;
                *e = own;
            }
        }
    }
    return done;
}

static void tiling_clear(Tiling *t)
{
    for (int64_t i = 0; t->tile && i < (int64_t)t->side * t->side; i++) {
        tile_clear(&t->tile[i]);
    }
    free(t->tile);
}

static const Tile *tile_at(const Tiling *t, int column, int row)
{
    int c = column - t->first, r = row - t->first;
    bool inside = c >= 0 && r >= 0 && c < t->side && r < t->side;
    return inside ? &t->tile[(int64_t)r * t->side + c] : NULL;
}

// ---- the mesh

// A tile's sides in the order north, east, south, west, each followed clockwise, seen from above
// with x to the right and z down.
static const int BESIDE[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};

// Column and row of the sample `along` a side, `in` from it; all are counted in `cells` a side.
static void side_place(int side, int cells, int along, int in, int place[2])
{
    place[0] = side == 0 ? along : side == 1 ? cells - in : side == 2 ? cells - along : in;
    place[1] = side == 0 ? in : side == 1 ? along : side == 2 ? cells - in : cells - along;
}

// The edges of a side: as many as cells of the coarser of the tiles that meet there.
static int side_edges(const Tiling *t, const Tile *tile, int side)
{
    const Tile *other = tile_at(t, tile->column + BESIDE[side][0], tile->row + BESIDE[side][1]);
    int own = (t->world->columns - 1) / t->grid->count;
    int beside = other ? other->cells : t->view->seam ? own : tile->cells;
    return beside < tile->cells ? beside : tile->cells;
}

static void count_parts(Tiling *t, int64_t *vertices, int64_t *faces)
{
    *vertices = *faces = 0;
    for (int64_t i = 0; i < (int64_t)t->side * t->side; i++) {
        Tile *tile = &t->tile[i];
        int64_t n = tile->cells;
        tile->first_vertex = *vertices;
        tile->first_face = *faces;
        *vertices += (n - 1) * (n - 1);
        *faces += 2 * (n - 2) * (n - 2);
        for (int side = 0; side < 4; side++) {
            int edges = side_edges(t, tile, side);
            *vertices += edges;
            *faces += edges + n - 2;
        }
    }
}

static void set_vertex(Mesh *mesh, int64_t vertex, const Tile *from, int column, int row)
{
    int64_t i = (int64_t)row * (from->cells + 1) + column;
    mesh->position[vertex] = from->position[i];
    mesh->normal[vertex] = from->normal[i];
    mesh->site[vertex] = from->site[i];
    mesh->uv[vertex] = (Vec2){from->position[i].x, from->position[i].z};
}

// A vertex of the tiles' rim at x, z (in the finest cells from the world's corner), if they end
// there at the world's own samples.
static bool set_seam_vertex(const Tiling *t, int64_t x, int64_t z, Mesh *mesh, int64_t vertex)
{
    const HeightField *world = t->world;
    int64_t all = (int64_t)t->grid->count * t->grid->cells, each = all / (world->columns - 1);
    if (!t->view->seam || t->view->beyond > 0 || (x > 0 && x < all && z > 0 && z < all)) {
        return false;
    }
    int column = (int)(x / each), row = (int)(z / each);
    int64_t i = (int64_t)row * world->columns + column;
    Vec3 p = place_at(t, x, z, world->height[i]);
    mesh->position[vertex] = p;
    mesh->normal[vertex] = height_mesh_normal(world, column, row);
    mesh->site[vertex] = height_mesh_site(world, i, t->low, t->high);
    mesh->uv[vertex] = (Vec2){p.x, p.z};
    return true;
}

// A vertex where tiles meet, from the coarsest of them. place: in the finest cells from the tile.
static void set_border_vertex(const Tiling *t, const Tile *tile, const int place[2], Mesh *mesh,
                              int64_t vertex)
{
    const Tile *coarsest = tile;
    int cells = t->grid->cells;
    if (set_seam_vertex(t, (int64_t)tile->column * cells + place[0],
                        (int64_t)tile->row * cells + place[1], mesh, vertex)) {
        return;
    }
    for (int k = 0; k < 9; k++) {
        int dx = k % 3 - 1, dz = k / 3 - 1;
        bool touches = (dx == 0 || place[0] == (dx < 0 ? 0 : cells)) &&
                       (dz == 0 || place[1] == (dz < 0 ? 0 : cells));
        const Tile *other = touches ? tile_at(t, tile->column + dx, tile->row + dz) : NULL;
        coarsest = other && other->cells < coarsest->cells ? other : coarsest;
    }
    int each = cells / coarsest->cells;
    set_vertex(mesh, vertex, coarsest,
               (place[0] - (coarsest->column - tile->column) * cells) / each,
               (place[1] - (coarsest->row - tile->row) * cells) / each);
}

static uint32_t *add_face(uint32_t *index, int64_t a, int64_t b, int64_t c)
{
    index[0] = (uint32_t)a;
    index[1] = (uint32_t)b;
    index[2] = (uint32_t)c;
    return index + 3;
}

// Vertex of a sample inside a tile.
static int64_t inner(const Tile *tile, int column, int row)
{
    return tile->first_vertex + (int64_t)(row - 1) * (tile->cells - 1) + column - 1;
}

// The strip between a side, whose vertices are first .. first + edges - 1 and `last`, and the
// samples one cell in: whichever line has its next edge's middle first goes on.
static uint32_t *add_strip(const Tile *tile, int side, int edges, int64_t first, int64_t last,
                           uint32_t *index)
{
    int n = tile->cells, each = n / edges, a = 0, b = 1;
    while (a < edges || b < n - 1) {
        int place[2];
        side_place(side, n, b, 1, place);
        int64_t here = inner(tile, place[0], place[1]);
        int64_t outer = a < edges ? first + a : last;
        if (b == n - 1 || (a < edges && (2 * a + 1) * each <= 2 * b + 1)) {
            index = add_face(index, outer, here, a + 1 < edges ? first + a + 1 : last);
            a++;
        } else {
            side_place(side, n, b + 1, 1, place);
            index = add_face(index, outer, here, inner(tile, place[0], place[1]));
            b++;
        }
    }
    return index;
}

static void add_tile(const Tiling *t, const Tile *tile, Mesh *mesh)
{
    int n = tile->cells;
    uint32_t *index = mesh->index + 3 * tile->first_face;
    for (int row = 1; row < n; row++) {
        for (int column = 1; column < n; column++) {
            int64_t nw = inner(tile, column, row), sw = nw + n - 1;
            set_vertex(mesh, nw, tile, column, row);
            if (row < n - 1 && column < n - 1) {
                index = add_face(index, nw, sw + 1, nw + 1);
                index = add_face(index, nw, sw, sw + 1);
            }
        }
    }
    int64_t loop = inner(tile, 1, 1) + (int64_t)(n - 1) * (n - 1), vertex = loop;
    for (int side = 0; side < 4; side++) {
        int edges = side_edges(t, tile, side);
        for (int k = 0; k < edges; k++) {
            int place[2];
            side_place(side, t->grid->cells, k * (t->grid->cells / edges), 0, place);
            set_border_vertex(t, tile, place, mesh, vertex + k);
        }
        int64_t last = side < 3 ? vertex + edges : loop;
        index = add_strip(tile, side, edges, vertex, last, index);
        vertex += edges;
    }
}

static Mesh *make_mesh(Tiling *t, const Run *run, Error *e)
{
    int64_t vertices, faces;
    count_parts(t, &vertices, &faces);
    Mesh *mesh = mesh_new(3, vertices, faces, MESH_NORMAL | MESH_UV | MESH_SITE, e);
    if (mesh) {
#pragma omp parallel for schedule(dynamic, 16) num_threads(run->threads)
        for (int64_t i = 0; i < (int64_t)t->side * t->side; i++) {
            add_tile(t, &t->tile[i], mesh);
        }
    }
    return mesh;
}

static bool tell_places(const Tiling *t, const Mesh *mesh, TilePlaces *places, Error *e)
{
    int64_t count = (int64_t)t->side * t->side;
    double side = cell_size(t) * (double)t->grid->cells, first = (double)t->first;
    *places = (TilePlaces){.origin = {(double)t->world->origin.x + side * first,
                                      (double)t->world->origin.y + side * first},
                           .side = side,
                           .count = t->side,
                           .tile = memory_alloc(count, sizeof *places->tile, e)};
    for (int64_t i = 0; places->tile && i < count; i++) {
        const Tile *tile = &t->tile[i];
        int64_t end = i + 1 < count ? tile[1].first_face : mesh->face_count;
        places->tile[i] = (DrawnTile){tile->cells, tile->first_face, end - tile->first_face};
    }
    return places->tile;
}

Mesh *tile_mesh_new(const HeightField *world, const TileGrid *grid, const TileView *view,
                    TilePlaces *places, const Run *run, Error *e)
{
    Tiling t = tiling_of(world, grid, view);
    Mesh *mesh = fill_tiles(&t, run, e) ? make_mesh(&t, run, e) : NULL;
    if (mesh && places && !tell_places(&t, mesh, places, e)) {
        mesh_free(mesh);
        mesh = NULL;
    }
    tiling_clear(&t);
    return mesh;
}
