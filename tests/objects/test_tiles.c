// Tiles of a world: made alone, they match the world made whole, bit for bit.
#include "base/noise.h"
#include "land/height_drainage.h"
#include "land/tile_mesh.h"
#include "land/tiles.h"
#include "making.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <string.h>

enum { WORLD = 64, TILES = 4, CELLS = 64 };

static const TileGrid GRID = {.count = TILES, .cells = CELLS, .detail = 1.0f, .seed = 11};

static Run run_with(int threads)
{
    Run run = run_default();
    run.threads = threads;
    return run;
}

static HeightField *make_world(bool periodic)
{
    HeightField *world =
        height_field_new(WORLD + 1, WORLD + 1, (Vec2){16, 16}, (Vec2){-512, -512}, NULL);
    world->loose = malloc(sizeof(float) * (size_t)height_field_count(world));
    world->periodic = periodic;
    for (int i = 0; i < height_field_count(world); i++) {
        float x = (float)(i % (WORLD + 1)) / 17.0f, z = (float)(i / (WORLD + 1)) / 17.0f;
        world->height[i] = 120.0f * noise_plane_fractal(x, z, 4, 5) + 0.4f * x;
        world->loose[i] = (float)(i % 7);
    }
    return world;
}

static HeightField *cut(const HeightField *world, const TileGrid *grid, int column, int row,
                        int threads)
{
    Error e = {0};
    Run run = run_with(threads);
    HeightField *tile = tile_land(world, grid, column, row, &run, &e);
    if (!tile) {
        fail_msg("%s", e.message);
    }
    return tile;
}

static void check_tiles(bool periodic)
{
    HeightField *world = make_world(periodic);
    TileGrid one = GRID;
    one.count = 1;
    one.cells = TILES * CELLS;
    HeightField *whole = cut(world, &one, 0, 0, 2);
    for (int t = 0; t < TILES * TILES; t++) {
        int column = t % TILES, row = t / TILES;
        HeightField *tile = cut(world, &GRID, column, row, 1 + t % 3);
        assert_int_equal(tile->columns, CELLS + 1);
        for (int r = 0; r <= CELLS; r++) {
            int64_t from = (int64_t)(row * CELLS + r) * whole->columns + column * CELLS;
            assert_memory_equal(whole->height + from, tile->height + r * (CELLS + 1),
                                sizeof(float) * (CELLS + 1));
            assert_memory_equal(whole->loose + from, tile->loose + r * (CELLS + 1),
                                sizeof(float) * (CELLS + 1));
        }
        assert_true(tile->origin.x == whole->origin.x + (float)(column * CELLS) * whole->cell.x);
        height_field_free(tile);
    }
    height_field_free(whole);
    height_field_free(world);
}

static void tiles_are_the_world_made_whole(void **state)
{
    (void)state;
    check_tiles(false);
    check_tiles(true);
}

static void without_detail_samples_stay(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    TileGrid plain = GRID;
    plain.detail = 0.0f;
    HeightField *tile = cut(world, &plain, 1, 2, 2);
    for (int r = 0; r <= CELLS; r += 4) {
        for (int c = 0; c <= CELLS; c += 4) {
            int64_t i = (int64_t)(2 * CELLS + r) / 4 * world->columns + (CELLS + c) / 4;
            assert_true(tile->height[r * (CELLS + 1) + c] == world->height[i]);
        }
    }
    height_field_free(tile);
    height_field_free(world);
}

// Maps: those that look at neighbours are those of the world made whole, those that reach far are
// the world's own.
static void maps_match(void **state)
{
    (void)state;
    Run run = run_with(2);
    HeightField *world = make_world(false);
    TileGrid one = GRID;
    one.count = 1;
    one.cells = TILES * CELLS;
    HeightMap slope = {.kind = HEIGHT_MAP_SLOPE}, flow = {.kind = HEIGHT_MAP_FLOW};
    HeightField *whole = tile_map(world, &one, 0, 0, &slope, &run, NULL);
    HeightField *tile = tile_map(world, &GRID, 2, 1, &slope, &run, NULL);
    HeightField *far = height_map(world, &flow, &run, NULL);
    HeightField *gathered = tile_map(world, &GRID, 2, 1, &flow, &run, NULL);
    for (int r = 0; r <= CELLS; r++) {
        int64_t from = (int64_t)(CELLS + r) * whole->columns + 2 * CELLS;
        assert_memory_equal(whole->height + from, tile->height + r * (CELLS + 1),
                            sizeof(float) * (CELLS + 1));
    }
    assert_true(gathered->height[0] == far->height[16 * far->columns + 32]);
    height_field_free(gathered);
    height_field_free(far);
    height_field_free(tile);
    height_field_free(whole);
    height_field_free(world);
}

// Detail stays near the world's land, is rough where that is steep, and drains.
static void detail_is_land(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    TileGrid one = GRID, plain = GRID;
    one.count = plain.count = 1;
    one.cells = plain.cells = TILES * CELLS;
    plain.detail = 0.0f;
    HeightField *rough = cut(world, &one, 0, 0, 2), *smooth = cut(world, &plain, 0, 0, 2);
    double square = 0.0, mean = 0.0, count = (double)height_field_count(rough);
    for (int64_t i = 0; i < height_field_count(rough); i++) {
        double d = (double)rough->height[i] - (double)smooth->height[i];
        square += d * d / count;
        mean += d / count;
    }
    double share = (double)height_field_pits(rough) / count;
    print_message("detail: %.2f m rms, mean %.2f m, cells of 4 m; pits %.5f of the samples\n",
                  sqrt(square), mean, share);
    assert_true(sqrt(square) > 0.2 && sqrt(square) < 4.0 && fabs(mean) < 1.0);
    assert_true(share < 0.004);
    height_field_free(rough);
    height_field_free(smooth);
    height_field_free(world);
}

static void flat_land_stays_flat(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    memset(world->height, 0, sizeof(float) * (size_t)height_field_count(world));
    HeightField *tile = cut(world, &GRID, 0, 3, 2);
    for (int64_t i = 0; i < height_field_count(tile); i++) {
        assert_true(tile->height[i] == 0.0f);
    }
    height_field_free(tile);
    height_field_free(world);
}

static void wrong_tiles_are_refused(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    Run run = run_with(1);
    Error e = {0};
    assert_null(tile_land(world, &GRID, TILES, 0, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    TileGrid coarse = {.count = 2, .cells = 16};
    assert_null(tile_land(world, &coarse, 0, 0, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    height_field_free(world);
}

// ---- one mesh of many tiles

static const TileGrid DRAWN = {.count = 8, .cells = 64, .detail = 1.0f, .seed = 3};
static const Vec3 EYE = {37.0f, 60.0f, -110.0f};
static const TileView NEAR = {.eye = &EYE, .cell = 0.03f, .beyond = 1};

static Mesh *draw(const HeightField *world, const TileView *view, int threads)
{
    Error e = {0};
    Run run = run_with(threads);
    Mesh *mesh = tile_mesh_new(world, &DRAWN, view, NULL, &run, &e);
    if (!mesh) {
        fail_msg("%s", e.message);
    }
    return mesh;
}

static const Vec3 *sorted_by; // positions, for qsort

static int by_position(const void *a, const void *b)
{
    return memcmp(&sorted_by[*(const uint32_t *)a], &sorted_by[*(const uint32_t *)b], sizeof(Vec3));
}

// The mesh's vertices in the order of the bits of their positions.
static uint32_t *sort_vertices(const Mesh *mesh)
{
    uint32_t *order = malloc(sizeof *order * (size_t)mesh->vertex_count);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        order[i] = (uint32_t)i;
    }
    sorted_by = mesh->position;
    qsort(order, (size_t)mesh->vertex_count, sizeof *order, by_position);
    return order;
}

// Vertices whose positions have the same bits become one.
static void weld(Mesh *mesh)
{
    uint32_t *order = sort_vertices(mesh), *one = malloc(sizeof *one * (size_t)mesh->vertex_count);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        bool same = i > 0 && by_position(&order[i - 1], &order[i]) == 0;
        one[order[i]] = same ? one[order[i - 1]] : order[i];
    }
    for (int64_t i = 0; i < 3 * mesh->face_count; i++) {
        mesh->index[i] = one[mesh->index[i]];
    }
    free(one);
    free(order);
}

// Twice the area of a face in plan; positive if it is seen from above.
static double plan_area(const Mesh *mesh, int64_t face)
{
    const uint32_t *corner = mesh->index + 3 * face;
    Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]],
         c = mesh->position[corner[2]];
    return (double)(b.z - a.z) * (double)(c.x - a.x) - (double)(b.x - a.x) * (double)(c.z - a.z);
}

// Welds the mesh: it is a disc whose rim has so many edges.
static void assert_is_disc(Mesh *mesh, int64_t rim)
{
    MeshTopology topology;
    weld(mesh);
    assert_true(mesh_topology(mesh, &topology, NULL));
    assert_int_equal(topology.open_edges, rim);
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    assert_int_equal(topology.degenerate_faces, 0);
    assert_int_equal(topology.component_count, 1);
    assert_int_equal(topology.euler_number, 1);
}

// Welded by the bits of positions, tiles of many sizes are one sheet without holes, open at the rim
// alone; every face is seen from above and all together cover the square once. So they do on the
// Earth's curve, with a periodic world, and with no eye.
static void tiles_meet_without_cracks(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        HeightField *world = make_world(k == 2);
        TileView view = NEAR;
        view.curve = k == 1 ? 1.0f / (2.0f * 6371000.0f) : 0.0f;
        view.eye = k == 3 ? NULL : &EYE;
        Mesh *mesh = draw(world, &view, 2);
        int rim = 0, least = DRAWN.cells, most = 0;
        for (int t = -8; t < 16; t++) {
            for (int u = -8; u < 16; u++) {
                int cells = tile_mesh_cells(world, &DRAWN, &view, t, u);
                int sides = (t == -8) + (t == 15) + (u == -8) + (u == 15);
                rim += sides * cells;
                least = cells < least ? cells : least;
                most = cells > most ? cells : most;
            }
        }
        assert_true(k == 3 ? least == 8 && most == 8 : least <= 4 && most == 64);
        double area = 0.0;
        for (int64_t i = 0; i < mesh->face_count; i++) {
            double own = plan_area(mesh, i);
            assert_true(own > 0.0);
            area += 0.5 * own;
        }
        assert_true(fabs(area / (3072.0 * 3072.0) - 1.0) < 1e-9);
        assert_is_disc(mesh, rim);
        mesh_free(mesh);
        height_field_free(world);
    }
}

// With a seam the tiles are a disc too, whose rim is the world's own samples: where its tiles are
// finer, coarser, or as fine.
static void a_seam_has_the_worlds_samples(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    TileView view = NEAR;
    view.beyond = 0;
    view.seam = true;
    Vec3 eye = vec3(500.0f, 60.0f, -300.0f);
    view.eye = &eye;
    Mesh *mesh = draw(world, &view, 2);
    int rim = 0;
    for (int t = 0; t < 8; t++) {
        int along[4][2] = {{t, 0}, {t, 7}, {0, t}, {7, t}};
        for (int k = 0; k < 4; k++) {
            int cells = tile_mesh_cells(world, &DRAWN, &view, along[k][0], along[k][1]);
            rim += cells < WORLD / 8 ? cells : WORLD / 8;
        }
    }
    int64_t found = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        if (fabsf(p.x) == 512.0f || fabsf(p.z) == 512.0f) {
            int64_t column = (int64_t)((p.x + 512.0f) / 16.0f),
                    row = (int64_t)((p.z + 512.0f) / 16.0f);
            assert_true(p.x == 16.0f * (float)column - 512.0f &&
                        p.z == 16.0f * (float)row - 512.0f);
            assert_true(p.y == world->height[row * world->columns + column]);
            found++;
        }
    }
    assert_true(found >= rim);
    assert_is_disc(mesh, rim);
    mesh_free(mesh);
    height_field_free(world);
}

// The least of the cells a side of the tiles that touch a tile, itself among them.
static int coarsest_around(const HeightField *world, int column, int row)
{
    int least = DRAWN.cells;
    for (int k = 0; k < 9; k++) {
        int cells = tile_mesh_cells(world, &DRAWN, &NEAR, column + k % 3 - 1, row + k / 3 - 1);
        least = cells < least ? cells : least;
    }
    return least;
}

// Every sample of a tile that is made by itself is a vertex, to the bit: inside the tile, and at
// its border where no coarser tile is beside it.
static void drawn_tiles_are_the_tiles(void **state)
{
    (void)state;
    Error e = {0};
    HeightField *world = make_world(false);
    Mesh *mesh = draw(world, &NEAR, 2);
    uint32_t *order = sort_vertices(mesh);
    int64_t checked = 0, sizes = 0;
    Run run = run_with(1);
    for (int t = 0; t < 64; t++) {
        int column = t % 8, row = t / 8;
        TileGrid grid = DRAWN;
        grid.cells = tile_mesh_cells(world, &DRAWN, &NEAR, column, row);
        if (grid.cells < WORLD / 8) {
            continue;
        }
        HeightField *tile = tile_land(world, &grid, column, row, &run, &e);
        assert_non_null(tile);
        sizes |= grid.cells;
        int margin = coarsest_around(world, column, row) < grid.cells ? 1 : 0;
        for (int r = margin; r <= grid.cells - margin; r++) {
            for (int c = margin; c <= grid.cells - margin; c++, checked++) {
                Vec3 at[] = {vec3(tile->origin.x + (float)c * tile->cell.x,
                                  tile->height[r * tile->columns + c],
                                  tile->origin.y + (float)r * tile->cell.y)};
                int64_t low = 0, high = mesh->vertex_count; // the first that is not before it
                while (low < high) {
                    int64_t middle = (low + high) / 2;
                    bool before = memcmp(&mesh->position[order[middle]], at, sizeof *at) < 0;
                    low = before ? middle + 1 : low;
                    high = before ? high : middle;
                }
                assert_true(low < mesh->vertex_count);
                assert_memory_equal(&mesh->position[order[low]], at, sizeof *at);
            }
        }
        height_field_free(tile);
    }
    print_message("%d samples, cells a side: %d\n", (int)checked, (int)sizes);
    assert_true(sizes == (8 | 16 | 32 | 64));
    free(order);
    mesh_free(mesh);
    height_field_free(world);
}

// Cells grow with the distance, as the view allows, and the land sinks by the square of it.
static void far_land_is_coarse_and_sinks(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    TileView curved = NEAR;
    curved.curve = 1.0f / (2.0f * 6371000.0f);
    Mesh *flat = draw(world, &NEAR, 2), *bent = draw(world, &curved, 3);
    float most = 0.0f;
    for (int64_t i = 0; i < flat->vertex_count; i++) {
        Vec3 p = flat->position[i], q = bent->position[i];
        float dx = p.x - EYE.x, dz = p.z - EYE.z, sinks = (dx * dx + dz * dz) / 12742000.0f;
        assert_true(p.x == q.x && p.z == q.z && fabsf(p.y - q.y - sinks) < 2e-5f);
        most = sinks > most ? sinks : most;
    }
    assert_true(most > 0.2f);
    for (int row = 0; row < 8; row++) {
        float z = -512.0f + 128.0f * (float)row;
        float dz = EYE.z < z ? z - EYE.z : EYE.z > z + 128.0f ? EYE.z - z - 128.0f : 0.0f;
        int cells = tile_mesh_cells(world, &DRAWN, &NEAR, 4, row); // below or beside the eye
        float cell = 128.0f / (float)cells;
        assert_true(cells == 64 || cell <= NEAR.cell * (dz + 60.0f));
        assert_true(cells == 2 || 2.0f * cell > NEAR.cell * dz);
    }
    mesh_free(flat);
    mesh_free(bent);
    height_field_free(world);
}

static void threads_change_no_bit_of_the_mesh(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    Mesh *one = draw(world, &NEAR, 1), *three = draw(world, &NEAR, 3);
    assert_int_equal(one->vertex_count, three->vertex_count);
    assert_int_equal(one->face_count, three->face_count);
    size_t count = (size_t)one->vertex_count;
    assert_memory_equal(one->position, three->position, sizeof(Vec3) * count);
    assert_memory_equal(one->normal, three->normal, sizeof(Vec3) * count);
    assert_memory_equal(one->index, three->index, sizeof(uint32_t) * 3 * (size_t)one->face_count);
    mesh_free(one);
    mesh_free(three);
    height_field_free(world);
}

// A terrain that is drawn of tiles is one part: the mesh of its heights, moved to its position.
static void a_terrain_is_drawn_of_its_tiles(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_with(2);
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_NOISE;
    params.size = 2048.0f;
    params.resolution = 64;
    params.beyond = 1;
    params.mesh_error = 0.004f;
    params.position = vec3(100.0f, 20.0f, -50.0f);
    params.tiles = (TerrainTileParams){.count = 8, .cells = 32, .detail = 1.0f, .drawn = true};
    Recipe recipe = {.seed = 4, .label = "land", .run = &run};
    Grown grown;
    assert_true(kind_grow(&kind_terrain, &params, &recipe, 1.0f, NULL, &grown, &e));
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    Vec3 eye = vec3(300.0f, 700.0f, 200.0f), own_eye = vec3_sub(eye, params.position);
    placing.around.eye = &eye;
    assert_true(terrain_geometry(&params, &grown, &placing, &e));
    assert_int_equal(geometry.count, 1);
    HeightField *world = terrain_heights(&params, &grown, &run, &e);
    TileGrid grid = {.count = 8, .cells = 32, .detail = 1.0f, .seed = 4};
    TileView view = {
        .eye = &own_eye, .cell = 0.032f, .beyond = 1, .curve = (float)(0.5 / 6371000.0)};
    Mesh *mesh = tile_mesh_new(world, &grid, &view, NULL, &run, &e), *drawn = geometry.part[0].mesh;
    assert_int_equal(drawn->vertex_count, mesh->vertex_count);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = vec3_add(mesh->position[i], params.position), q = drawn->position[i];
        assert_true(p.x == q.x && p.y == q.y && p.z == q.z);
    }
    mesh_free(mesh);
    height_field_free(world);
    geometry_clear(&geometry);
    grown_clear(&grown);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_are_the_world_made_whole),
        cmocka_unit_test(without_detail_samples_stay),
        cmocka_unit_test(maps_match),
        cmocka_unit_test(detail_is_land),
        cmocka_unit_test(flat_land_stays_flat),
        cmocka_unit_test(wrong_tiles_are_refused),
        cmocka_unit_test(tiles_meet_without_cracks),
        cmocka_unit_test(a_seam_has_the_worlds_samples),
        cmocka_unit_test(drawn_tiles_are_the_tiles),
        cmocka_unit_test(far_land_is_coarse_and_sinks),
        cmocka_unit_test(threads_change_no_bit_of_the_mesh),
        cmocka_unit_test(a_terrain_is_drawn_of_its_tiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
