// Water and trees on land drawn of tiles: they meet the triangles that are drawn, near and far, in
// the square and in its copies.
#include "making.h"
#include "making_terrain.h"

#include "objects/terrain/drawn.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <string.h>

enum { SEED = 5 };

static const TerrainTileParams TILES = {.count = 16, .cells = 64, .detail = 1.0f, .drawn = true};

// A terrain with its parts, and the mesh of its tiles made by itself.
typedef struct Made {
    TerrainParams params;
    Run run;
    Grown grown;
    Geometry geometry;
    HeightField *field;
    TileGrid grid;
    TileView view;
    TileWater water;
    TilePlaces places;
    Mesh *mesh; // in the terrain's own space
    Vec3 eye;   // likewise
} Made;

static const Terrain *terrain_of(const Made *m)
{
    return m->grown.state;
}

// eye: in the terrain's own space; NULL = none.
static void make_seen(Made *m, const TerrainParams *params, const Vec3 *eye, int threads)
{
    Error e = {0};
    Vec3 from = eye ? *eye : vec3_splat(0.0f);
    *m = (Made){.params = *params, .run = run_default(), .eye = from};
    m->run.threads = threads;
    Recipe recipe = {.seed = SEED, .label = "land", .run = &m->run};
    assert_true(kind_grow(&kind_terrain, &m->params, &recipe, 1.0f, NULL, &m->grown, &e));
    Placing placing = placing_in(&m->geometry, &recipe);
    Vec3 there = vec3_add(from, params->position);
    placing.around.eye = eye ? &there : NULL;
    if (!terrain_geometry(&m->params, &m->grown, &placing, &e)) {
        fail_msg("%s", e.message);
    }
    m->field = terrain_heights(&m->params, &m->grown, &m->run, &e);
    m->grid = (TileGrid){
        .count = TILES.count, .cells = TILES.cells, .detail = TILES.detail, .seed = SEED};
    bool ends = terrain_tiles_end(params);
    m->view = (TileView){.eye = eye ? &m->eye : NULL,
                         .cell = 8.0f * params->mesh_error,
                         .beyond = ends ? 0 : params->beyond,
                         .seam = ends,
                         .curve = ends ? 0.0f : (float)(0.5 / 6371000.0)};
    assert_true(tile_water_init(&m->water, terrain_of(m), m->field, TILES.count, &e));
    m->view.shaping = &m->water.shaping;
    m->mesh = tile_mesh_new(m->field, &m->grid, &m->view, &m->places, &m->run, &e);
    assert_non_null(m->mesh);
}

static void make(Made *m, const TerrainParams *params, Vec3 eye, int threads)
{
    make_seen(m, params, &eye, threads);
}

static void drop(Made *m)
{
    mesh_free(m->mesh);
    tile_places_clear(&m->places);
    tile_water_clear(&m->water);
    height_field_free(m->field);
    geometry_clear(&m->geometry);
    grown_clear(&m->grown);
}

static TerrainParams land_of(TerrainForm form)
{
    TerrainParams params = terrain_params_default();
    params.form = form;
    params.size = 4000.0f;
    params.resolution = 128;
    params.beyond = 1;
    params.mesh_error = 0.004f;
    params.position = vec3(100.0f, 20.0f, -50.0f);
    params.tiles = TILES;
    params.forest.count = 0;
    return params;
}

static TerrainParams land_of_lakes(void)
{
    TerrainParams params = land_of(TERRAIN_NOISE);
    params.lakes.count = 1000;
    return params;
}

static TerrainParams land_of_rivers(void)
{
    TerrainParams params = land_of(TERRAIN_RIVERS);
    params.rivers.count = 300;
    params.rivers.water = 0.03f;
    params.rivers.fall_height = 0.0f;
    return params;
}

// The drawn land below a place of the scene.
static float land_below(const Made *m, Vec3 p)
{
    Vec3 place = m->params.position;
    return tile_places_height(&m->places, m->mesh, p.x - place.x, p.z - place.z) + place.y;
}

// A place of the scene, or of a copy, as that of the square in the terrain's own space.
static Vec2 in_square(const Made *m, Vec3 p)
{
    float half = 0.5f * m->params.size, x = p.x - m->params.position.x,
          z = p.z - m->params.position.z;
    x = x > half ? 2.0f * half - x : x < -half ? -2.0f * half - x : x;
    z = z > half ? 2.0f * half - z : z < -half ? -2.0f * half - z : z;
    return (Vec2){clampf(x, -half, half), clampf(z, -half, half)};
}

// Is a lake's sample within a cell of a place of the square?
static bool is_at_lake(const Made *m, Vec2 at)
{
    const HeightField *field = m->field;
    for (int k = 0; k < 9 && terrain_of(m)->lakes; k++) {
        float x = at.x + (float)(k % 3 - 1) * field->cell.x;
        float z = at.y + (float)(k / 3 - 1) * field->cell.y;
        if (terrain_lake_at(terrain_of(m), field, x, z) > -INFINITY) {
            return true;
        }
    }
    return false;
}

// Every face's middle has the height of that face, also in the rims that join tiles of many sizes.
static void places_tell_the_drawn_height(void **state)
{
    (void)state;
    Made m;
    TerrainParams params = land_of_lakes();
    make(&m, &params, vec3(300.0f, 200.0f, 500.0f), 2);
    for (int64_t i = 0; i < m.mesh->face_count; i++) {
        const uint32_t *corner = m.mesh->index + 3 * i;
        Vec3 middle =
            vec3_scale(vec3_add(m.mesh->position[corner[0]],
                                vec3_add(m.mesh->position[corner[1]], m.mesh->position[corner[2]])),
                       1.0f / 3.0f);
        float height = tile_places_height(&m.places, m.mesh, middle.x, middle.z);
        assert_true(fabsf(height - middle.y) < 0.01f);
    }
    drop(&m);
}

// The land that the scene has is this mesh, which these tests look water and trees up on.
static void check_land(const Made *m)
{
    const Mesh *land = m->geometry.part[0].mesh;
    assert_int_equal(land->vertex_count, m->mesh->vertex_count);
    for (int64_t i = 0; i < land->vertex_count; i++) {
        Vec3 p = vec3_add(m->mesh->position[i], m->params.position), q = land->position[i];
        assert_true(p.x == q.x && p.y == q.y && p.z == q.z);
    }
}

typedef struct Seen {
    int64_t places, under, beyond; // of the water; where it is over the land; of those in copies
    double most;                   // m: the highest water over the land at the water's outline
} Seen;

// The corners of quads at each vertex, in lists: -1 ends them.
typedef struct Corners {
    const Mesh *mesh;
    int64_t count;
    int32_t *first, *next; // by vertex and by corner; owned
} Corners;

static Corners corners_of(const Mesh *mesh)
{
    Corners at = {.mesh = mesh, .count = 4 * mesh->face_count};
    at.first = malloc(sizeof *at.first * (size_t)mesh->vertex_count);
    at.next = malloc(sizeof *at.next * (size_t)at.count);
    assert_true(at.first && at.next);
    memset(at.first, 0xff, sizeof *at.first * (size_t)mesh->vertex_count);
    for (int64_t c = 0; c < at.count; c++) {
        at.next[c] = at.first[mesh->index[c]];
        at.first[mesh->index[c]] = (int32_t)c;
    }
    return at;
}

static void free_corners(Corners *at)
{
    free(at->next);
    free(at->first);
}

// The ends of the edge that begins at a corner. Is it another quad's too?
static bool is_shared(const Corners *at, int64_t corner_at, uint32_t ends[2])
{
    const Mesh *mesh = at->mesh;
    uint32_t a = ends[0] = mesh->index[corner_at];
    uint32_t b = ends[1] = mesh->index[corner_at % 4 == 3 ? corner_at - 3 : corner_at + 1];
    int uses = 0;
    for (int32_t c = at->first[a]; c >= 0; c = at->next[c]) {
        uint32_t face = (uint32_t)c / 4, k = (uint32_t)c % 4;
        const uint32_t *corner = mesh->index + 4 * face;
        uses += corner[(k + 1) % 4] == b || corner[(k + 3) % 4] == b;
    }
    return uses > 1;
}

// Is a place of the scene beside a river, not where it begins, enters another or leaves the square?
// Everywhere without rivers.
static bool is_beside(const Made *m, Vec3 p)
{
    Vec2 at = in_square(m, p);
    float rim = 0.5f * m->params.size - fmaxf(fabsf(at.x), fabsf(at.y));
    return !terrain_of(m)->shore || (terrain_shore(terrain_of(m), at.x, at.y) > 0.5f && rim > 0.5f);
}

// Looks a sheet of water up, its outline and its faces, at places this many to an edge.
static void look_at(const Made *m, const Mesh *mesh, Seen *seen)
{
    enum { PLACES = 8 };
    Corners corners = corners_of(mesh);
    for (int64_t c = 0; c < corners.count; c++) {
        uint32_t ends[2];
        bool shared = is_shared(&corners, c, ends);
        Vec3 a = mesh->position[ends[0]], b = mesh->position[ends[1]];
        bool outline = !shared && is_beside(m, a) && is_beside(m, b);
        for (int k = 0; k <= PLACES; k++) {
            Vec3 p = vec3_lerp(a, b, (float)k / PLACES);
            float over = p.y - land_below(m, p);
            Vec2 at = in_square(m, p);
            seen->places++;
            bool rim = outline && is_beside(m, p);
            if (rim) {
                seen->most = fmax(seen->most, (double)over);
            }
            if (over > 0.02f) {
                bool river = terrain_shore(terrain_of(m), at.x, at.y) < 0.5f * m->field->cell.x;
                assert_true(river || is_at_lake(m, at));
                seen->under++;
                seen->beyond += fabsf(p.x - m->params.position.x) > 0.51f * m->params.size;
            }
        }
    }
    free_corners(&corners);
}

// Lakes end on the drawn land, and what lies deep in the world's lakes lies under the drawn water.
static void lakes_end_at_drawn_shores(void **state)
{
    (void)state;
    Made m;
    TerrainParams params = land_of_lakes();
    make(&m, &params, vec3(300.0f, 200.0f, 500.0f), 2);
    check_land(&m);
    const Lakes *lakes = terrain_of(&m)->lakes;
    assert_int_equal(m.geometry.count, 1 + 9 * lakes->count);
    Seen seen = {0};
    for (int64_t i = 1; i < m.geometry.count; i++) {
        look_at(&m, m.geometry.part[i].mesh, &seen);
    }
    print_message("%d lakes: %d of %d places over the land, %d beyond; rim %.4f m\n", lakes->count,
                  (int)seen.under, (int)seen.places, (int)seen.beyond, seen.most);
    assert_true(seen.most < 0.001 && seen.under > 10000 && seen.beyond > 2000);
    int64_t deep = 0, columns = m.field->columns;
    for (int64_t i = columns + 1; i + columns + 1 < height_field_count(m.field); i++) {
        int32_t label = lakes->label[i];
        int64_t c = i % columns;
        if (label < 0 || c == 0 || c + 1 == columns || lakes->label[i + 1] < 0 ||
            lakes->label[i - 1] < 0 || lakes->label[i + columns] < 0 ||
            lakes->label[i - columns] < 0 || lakes->label[i - columns - 1] < 0 ||
            lakes->label[i - columns + 1] < 0 || lakes->label[i + columns - 1] < 0 ||
            lakes->label[i + columns + 1] < 0) {
            continue;
        }
        float x = m.field->origin.x + (float)c * m.field->cell.x;
        float z = m.field->origin.y + (float)(i / columns) * m.field->cell.y;
        float bed = tile_places_height(&m.places, m.mesh, x, z) + tile_view_sinks(&m.view, x, z);
        assert_true(bed < lakes->lake[label].level);
        deep++;
    }
    assert_true(deep > 100);
    drop(&m);
}

// Rivers run in their beds at the terrain's levels, their edges below the drawn banks.
static void rivers_run_in_drawn_beds(void **state)
{
    (void)state;
    Made m;
    TerrainParams params = land_of_rivers();
    make(&m, &params, vec3(300.0f, 200.0f, 500.0f), 2);
    check_land(&m);
    assert_int_equal(m.geometry.count, 1 + 9);
    Seen seen = {0};
    for (int64_t i = 1; i < m.geometry.count; i++) {
        look_at(&m, m.geometry.part[i].mesh, &seen);
    }
    print_message("rivers: %d of %d places over the land, %d beyond; rim %.4f m\n", (int)seen.under,
                  (int)seen.places, (int)seen.beyond, seen.most);
    assert_true(seen.most < 0.1 && seen.under > 10000 && seen.beyond > 2000);
    const OutTree *water = terrain_of(&m)->water;
    for (int64_t i = 0; i < water->count; i++) {
        Vec3 p = water->position[i];
        float bed =
            tile_places_height(&m.places, m.mesh, p.x, p.z) + tile_view_sinks(&m.view, p.x, p.z);
        assert_true(bed < p.y);
    }
    drop(&m);
}

static TerrainParams land_of_falls(void)
{
    TerrainParams params = land_of_rivers();
    params.rivers.fall_height = 2.0f;
    params.rivers.fall_slope = 0.4f;
    return params;
}

// Falling water, with its highest vertex.
typedef struct Fall {
    const Mesh *mesh;
    Vec3 top;
} Fall;

enum { MOST_FALLS = 256 };

static Vec3 top_of(const Mesh *mesh)
{
    Vec3 top = mesh->position[0];
    for (int64_t i = 1; i < mesh->vertex_count; i++) {
        top = mesh->position[i].y > top.y ? mesh->position[i] : top;
    }
    return top;
}

// The parts of falling water, which reach less far than a network of rivers.
static int list_falls(const Made *m, Fall fall[MOST_FALLS])
{
    int count = 0;
    for (int64_t k = 1; k < m->geometry.count; k++) {
        const Part *part = &m->geometry.part[k];
        Aabb box = mesh_bounds(part->mesh);
        if (part->is_water && box.high.x - box.low.x < 0.1f * m->params.size) {
            assert_true(count < MOST_FALLS);
            fall[count++] = (Fall){part->mesh, top_of(part->mesh)};
        }
    }
    return count;
}

// Where the scene has a place of the square again, on a flat Earth: mirrored by odd columns and
// rows.
static Vec3 place_in_copy(const Made *m, Vec3 own, int column, int row)
{
    float x = column % 2 == 0 ? own.x : -own.x, z = row % 2 == 0 ? own.z : -own.z;
    Vec3 there = vec3((float)column * m->params.size + x, own.y, (float)row * m->params.size + z);
    return vec3_add(there, m->params.position);
}

// The fall whose highest vertex is within reach (m) of a place; NULL = none.
static const Mesh *fall_at(const Fall *fall, int count, Vec3 place, float reach)
{
    for (int k = 0; k < count; k++) {
        if (vec3_distance(fall[k].top, place) < reach) {
            return fall[k].mesh;
        }
    }
    return NULL;
}

// Vertices of falling water under the drawn land.
static int64_t count_under(const Made *m, const Mesh *mesh)
{
    int64_t under = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        under += mesh->position[i].y < land_below(m, mesh->position[i]) - 0.5f;
    }
    return under;
}

typedef struct FallsSeen {
    int drawn, coarser;
    int64_t vertices, under;
} FallsSeen;

// The falls of a lip in the square and in its copies; only those too small to be seen are missing.
static void look_at_falls(const Made *m, const Fall *fall, int count, int64_t lip, FallsSeen *seen)
{
    const Terrain *terrain = terrain_of(m);
    Vec3 place = terrain->water->position[lip], eye = vec3_add(m->eye, m->params.position);
    float reach = 2.0f * m->field->cell.x + 2.0f * terrain->water->radius[lip];
    const Mesh *own = fall_at(fall, count, vec3_add(place, m->params.position), reach);
    assert_non_null(own);
    for (int k = 0; k < 9; k++) {
        Vec3 there = place_in_copy(m, place, k % 3 - 1, k / 3 - 1);
        const Mesh *mesh = fall_at(fall, count, there, reach);
        float least = 0.0004f * vec3_distance(there, eye), high = terrain->drop[lip];
        assert_true(mesh ? high > 0.98f * least : high < 1.02f * least);
        if (mesh) {
            seen->drawn++;
            seen->coarser += 2 * mesh->vertex_count < own->vertex_count;
            seen->vertices += mesh->vertex_count;
            seen->under += count_under(m, mesh);
        }
    }
}

// Each river that drops in the square drops in its copies, too, the coarser the farther, over the
// drawn land and as far down as it.
static void water_falls_over_drawn_land(void **state)
{
    (void)state;
    Made m;
    TerrainParams params = land_of_falls();
    make(&m, &params, vec3(300.0f, 200.0f, 500.0f), 2);
    check_land(&m);
    Fall fall[MOST_FALLS];
    int count = list_falls(&m, fall);
    FallsSeen seen = {0};
    for (int64_t i = 0; i < terrain_of(&m)->water->count; i++) {
        if (terrain_of(&m)->drop[i] > 0.0f) {
            look_at_falls(&m, fall, count, i, &seen);
        }
    }
    print_message("%d falls, %d of them much coarser: %d of %d vertices under the land\n",
                  seen.drawn, seen.coarser, (int)seen.under, (int)seen.vertices);
    assert_int_equal(seen.drawn, count);
    assert_true(seen.drawn > 30 && seen.coarser > 10 && seen.under < seen.vertices / 50);
    drop(&m);
}

// Without an eye the Earth is flat and land and falls are drawn alike everywhere: in the second
// ring a fall is the square's own, moved, and in the first one its mirror image, up to the
// triangles that the land's cells are cut into.
static void falls_of_copies_are_the_squares(void **state)
{
    (void)state;
    Made m;
    TerrainParams params = land_of_falls();
    params.beyond = 2;
    params.rivers.fall_height = 40.0f; // of few
    make_seen(&m, &params, NULL, 2);
    const Terrain *terrain = terrain_of(&m);
    const OutTree *water = terrain->water;
    Fall fall[MOST_FALLS];
    int count = list_falls(&m, fall);
    int64_t moved = 0, vertices = 0;
    for (int64_t i = 0; i < water->count; i++) {
        if (terrain->drop[i] <= 0.0f) {
            continue;
        }
        float reach = 2.0f * m.field->cell.x + 2.0f * water->radius[i];
        const Mesh *own =
            fall_at(fall, count, vec3_add(water->position[i], params.position), reach);
        assert_non_null(own);
        for (int k = 0; k < 25; k++) {
            int column = k % 5 - 2, row = k / 5 - 2;
            const Mesh *there =
                fall_at(fall, count, place_in_copy(&m, water->position[i], column, row), reach);
            assert_non_null(there);
            assert_int_equal(there->vertex_count, own->vertex_count);
            assert_memory_equal(there->foam, own->foam, sizeof(float));
            for (int64_t v = 0; v < own->vertex_count; v++) {
                Vec3 p = vec3_sub(own->position[v], params.position);
                float off = vec3_distance(there->position[v], place_in_copy(&m, p, column, row));
                bool translated = column % 2 == 0 && row % 2 == 0;
                assert_true(off < (translated ? 1e30f : 4.0f * reach));
                vertices += translated;
                moved += translated && off > 0.05f;
            }
        }
    }
    print_message("%d of %d vertices are elsewhere\n", (int)moved, (int)vertices);
    assert_true(vertices > 500000 && moved < vertices / 30);
    drop(&m);
}

// The land of lakes with trees nearly everywhere.
static TerrainParams land_of_trees(int beyond)
{
    TerrainParams params = land_of_lakes();
    params.forest.count = 20000;
    params.forest.slope = 60.0f;
    params.forest.high = 1.0f;
    params.forest.beyond = beyond;
    return params;
}

typedef struct Trees {
    int64_t own, beyond; // in the square and in its copies
    double coarse;       // m by which the land is off that its samples tell
} Trees;

// Each tree's foot is 0.06 of its height below the drawn land, and none stands in water.
static void look_at_tree(const Made *m, const Transform *tree, Trees *trees)
{
    Vec3 foot = transform_point(tree, vec3(0, 0, 0)), top = transform_point(tree, vec3(0, 1, 0));
    float ground = land_below(m, foot), sunk = 0.06f * (top.y - foot.y);
    assert_true(fabsf(foot.y + sunk - ground) < 0.005f);
    Vec2 at = in_square(m, foot);
    float x = foot.x - m->params.position.x, z = foot.z - m->params.position.z;
    float flat = ground - m->params.position.y + tile_view_sinks(&m->view, x, z);
    trees->coarse =
        fmax(trees->coarse, fabs((double)(height_field_at(m->field, at.x, at.y) - flat)));
    assert_true(flat > m->field->water[terrain_sample_at(m->field, at.x, at.y)]);
    bool own = fmaxf(fabsf(x), fabsf(z)) <= 0.5f * m->params.size;
    trees->own += own;
    trees->beyond += !own;
}

static void trees_stand_on_drawn_land(void **state)
{
    (void)state;
    for (int beyond = 0; beyond < 2; beyond++) {
        Made m;
        TerrainParams params = land_of_trees(beyond);
        make(&m, &params, vec3(300.0f, 200.0f, 500.0f), 2);
        check_land(&m);
        Trees trees = {0};
        for (int64_t k = 1; k < m.geometry.count; k++) {
            const Part *part = &m.geometry.part[k];
            for (int64_t i = 0; i < part->instance_count; i++) {
                look_at_tree(&m, &part->instance[i], &trees);
            }
        }
        print_message("%d trees, %d beyond; the coarse land is up to %.1f m off\n", (int)trees.own,
                      (int)trees.beyond, trees.coarse);
        assert_true(trees.own > 1000 && trees.coarse > 1.0);
        assert_true(beyond ? trees.beyond > 500 : trees.beyond == 0);
        drop(&m);
    }
}

// Trees within 1 km of the eye, beyond the square's eastern border or before it.
static int64_t trees_about(const Made *m, bool beyond)
{
    int64_t count = 0;
    for (int64_t k = 1; k < m->geometry.count; k++) {
        const Part *part = &m->geometry.part[k];
        for (int64_t i = 0; i < part->instance_count; i++) {
            Vec3 foot = transform_point(&part->instance[i], vec3(0, 0, 0));
            Vec3 own = vec3_sub(foot, m->params.position);
            float x = own.x - m->eye.x, z = own.z - m->eye.z;
            bool there = own.x > 0.5f * m->params.size;
            count += there == beyond && x * x + z * z < 1e6f;
        }
    }
    return count;
}

// The woods of the square are the same with those of its copies beside them; seen from its border
// both sides are alike, tiles or not.
static void woods_go_on_beyond_the_square(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        TerrainParams params = land_of_trees(0);
        params.forest.count = 8000;
        params.tiles.drawn = k > 0;
        Made alone, all;
        Vec3 eye = vec3(2000.0f, 300.0f, 200.0f);
        make(&alone, &params, eye, 2);
        params.forest.beyond = 1;
        make(&all, &params, eye, 2);
        assert_int_equal(alone.geometry.count, all.geometry.count);
        for (int64_t i = 1; i < alone.geometry.count; i++) {
            const Part *a = &alone.geometry.part[i], *b = &all.geometry.part[i];
            bool woods = !a->is_water && a->mesh->face_count < 1000;
            assert_true(woods ? b->instance_count > a->instance_count + 50
                              : b->instance_count == a->instance_count);
            if (woods) {
                assert_memory_equal(a->instance, b->instance,
                                    sizeof *a->instance * (size_t)a->instance_count);
            }
        }
        int64_t near = trees_about(&all, false), far = trees_about(&all, true);
        print_message("%d trees west of the border, %d east of it\n", (int)near, (int)far);
        // 5 standard errors of the difference
        assert_true(near > 300 && (near - far) * (near - far) < 25 * (near + far));
        drop(&alone);
        drop(&all);
    }
}

// ---- forms whose tiles end at the square's border

static TerrainParams land_that_ends(int k)
{
    static const TerrainForm FORMS[] = {TERRAIN_MEANDER, TERRAIN_BRAIDED, TERRAIN_DELTA,
                                        TERRAIN_COAST};
    TerrainParams params = land_of(FORMS[k]);
    params.meander.width = 100.0f;
    params.meander.age = 0.4f;
    params.braided.age = 0.02f;
    params.delta.width = 250.0f;
    params.delta.age = 0.3f;
    params.evolution.cells = params.form == TERRAIN_BRAIDED ? 32 : 64;
    params.resolution = k == 0 ? 128 : 64;
    return params;
}

// Is a place of the scene at the square's border?
static bool is_at_border(const Made *m, Vec3 p)
{
    float half = 0.5f * m->params.size - 0.01f;
    return fabsf(p.x - m->params.position.x) > half || fabsf(p.z - m->params.position.z) > half;
}

static bool has_vertex(const Mesh *mesh, Vec3 p)
{
    bool found = false;
    for (int64_t i = 0; !found && i < mesh->vertex_count; i++) {
        Vec3 q = mesh->position[i];
        found = p.x == q.x && p.y == q.y && p.z == q.z;
    }
    return found;
}

// All samples of the rim are vertices of both the tiles and the land that is copied around them;
// what the tiles have there beside those is nothing. Near the eye their cells are smaller.
static void tiles_end_at_the_lands_own_samples(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        Made m;
        TerrainParams params = land_that_ends(k);
        make(&m, &params, vec3(1500.0f, 80.0f, 1990.0f), 2);
        check_land(&m);
        const Mesh *land = m.geometry.part[0].mesh, *around = m.geometry.part[1].mesh;
        bool copied = params.form != TERRAIN_DELTA;
        int64_t rim = 0;
        for (int64_t i = 0; i < land->vertex_count; i++) {
            Vec3 p = land->position[i];
            if (!is_at_border(&m, p)) {
                continue;
            }
            Vec3 own = vec3_sub(p, params.position);
            double c = (double)(own.x - m.field->origin.x) / (double)m.field->cell.x;
            double r = (double)(own.z - m.field->origin.y) / (double)m.field->cell.y;
            assert_true(fabs(c - round(c)) < 1e-3 && fabs(r - round(r)) < 1e-3);
            int64_t sample = (int64_t)round(r) * m.field->columns + (int64_t)round(c);
            Vec3 there = vec3(own.x, m.field->height[sample], own.z);
            assert_true(p.y == vec3_add(there, params.position).y);
            assert_true(!copied || has_vertex(around, p));
            rim++;
        }
        int finest = tile_mesh_cells(m.field, &m.grid, &m.view, 14, 15);
        print_message("form %d: %d vertices at the rim, %d cells a tile near the eye\n", k,
                      (int)rim, finest);
        // Tiles meet each other there in two vertices of the same bits; coarse tiles have fewer.
        assert_true(rim <= 4 * params.resolution + 4 * 16 && rim > 4 * 16);
        assert_true(finest > 2 * params.resolution / TILES.count);
        assert_true(!copied || m.geometry.part[1].instance_count > 0);
        drop(&m);
    }
}

// Is all the water around a sample, on it and on the eight beside it, known and over the ground?
static bool is_deep(const HeightField *f, int64_t i)
{
    int64_t column = i % f->columns, row = i / f->columns;
    bool deep = column > 0 && row > 0 && column + 1 < f->columns && row + 1 < f->rows;
    for (int k = 0; deep && k < 9; k++) {
        int64_t n = i + (int64_t)(k / 3 - 1) * f->columns + k % 3 - 1;
        deep = f->water[n] > f->height[n];
    }
    return deep;
}

// The square's own sheet of broad water: the largest.
static const Mesh *broad_water(const Made *m)
{
    const Mesh *water = NULL;
    for (int64_t i = 0; i < m->geometry.count; i++) {
        const Part *part = &m->geometry.part[i];
        bool larger = !water || part->mesh->vertex_count > water->vertex_count;
        water = part->is_water && part->instance_count == 0 && larger ? part->mesh : water;
    }
    return water;
}

typedef struct Shores {
    int64_t outline, cut, deep; // places of the outline; edges of it that lie over the land's own
                                // samples, where no shore is; samples under deep water
    double over;                // m: the highest water over the drawn land at shores
} Shores;

// m by which the water stands over the land's own samples at a vertex.
static float stands_over(const Made *m, Vec3 p)
{
    Vec3 own = vec3_sub(p, m->params.position);
    return own.y - height_field_at(m->field, own.x, own.z);
}

static void look_at_edge(const Made *m, Vec3 a, Vec3 b, Shores *s)
{
    if (is_at_border(m, a) && is_at_border(m, b)) {
        return;
    }
    if (stands_over(m, a) > 0.001f || stands_over(m, b) > 0.001f) {
        s->cut++;
        return;
    }
    for (int n = 0; n <= 8; n++) {
        Vec3 p = vec3_lerp(a, b, (float)n / 8.0f);
        if (!is_at_border(m, p)) {
            s->over = fmax(s->over, (double)(p.y - land_below(m, p)));
            s->outline++;
        }
    }
}

static void look_at_shores(const Made *m, const Mesh *water, Shores *s)
{
    Corners corners = corners_of(water);
    for (int64_t c = 0; c < corners.count; c++) {
        uint32_t ends[2];
        if (!is_shared(&corners, c, ends)) {
            look_at_edge(m, water->position[ends[0]], water->position[ends[1]], s);
        }
    }
    free_corners(&corners);
}

// The broad water's outline lies on the drawn ground or under it, and where the land's samples are
// deep under water, the drawn ground is, too.
static void broad_water_ends_at_drawn_shores(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        Made m;
        TerrainParams params = land_that_ends(k);
        make(&m, &params, vec3(300.0f, 150.0f, 500.0f), 2);
        const Mesh *water = broad_water(&m);
        assert_non_null(water);
        Shores s = {0};
        look_at_shores(&m, water, &s);
        for (int64_t i = 0; i < height_field_count(m.field); i++) {
            if (is_deep(m.field, i)) {
                float x = m.field->origin.x + (float)(i % m.field->columns) * m.field->cell.x;
                int64_t row = i / m.field->columns;
                float z = m.field->origin.y + (float)row * m.field->cell.y;
                assert_true(tile_places_height(&m.places, m.mesh, x, z) < m.field->water[i]);
                s.deep++;
            }
        }
        print_message("form %d: outline at %d places, over the land by %.4f m; %d edges are cut; "
                      "%d deep samples\n",
                      k, (int)s.outline, s.over, (int)s.cut, (int)s.deep);
        assert_true(s.outline > 500 && s.over < 0.011 && s.deep > 20);
        assert_int_equal(s.cut, 0);
        drop(&m);
    }
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) { // rivers, a meander, a coast
        TerrainParams params = k == 0 ? land_of_rivers() : land_that_ends(k == 1 ? 0 : 3);
        params.forest.count = 2000;
        params.forest.beyond = k == 1 ? 0 : 1;
        params.rivers.fall_height = 2.0f;
        params.rivers.fall_slope = 0.4f;
        Made one, three;
        make(&one, &params, vec3(300.0f, 200.0f, 500.0f), 1);
        make(&three, &params, vec3(300.0f, 200.0f, 500.0f), 3);
        assert_int_equal(one.geometry.count, three.geometry.count);
        for (int64_t i = 0; i < one.geometry.count; i++) {
            const Part *a = &one.geometry.part[i], *b = &three.geometry.part[i];
            assert_int_equal(a->mesh->vertex_count, b->mesh->vertex_count);
            assert_int_equal(a->instance_count, b->instance_count);
            assert_memory_equal(a->mesh->position, b->mesh->position,
                                sizeof(Vec3) * (size_t)a->mesh->vertex_count);
            assert_memory_equal(a->mesh->normal, b->mesh->normal,
                                sizeof(Vec3) * (size_t)a->mesh->vertex_count);
            if (a->instance_count > 0) {
                assert_memory_equal(a->instance, b->instance,
                                    sizeof *a->instance * (size_t)a->instance_count);
            }
        }
        drop(&one);
        drop(&three);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_tell_the_drawn_height),
        cmocka_unit_test(lakes_end_at_drawn_shores),
        cmocka_unit_test(rivers_run_in_drawn_beds),
        cmocka_unit_test(trees_stand_on_drawn_land),
        cmocka_unit_test(woods_go_on_beyond_the_square),
        cmocka_unit_test(water_falls_over_drawn_land),
        cmocka_unit_test(falls_of_copies_are_the_squares),
        cmocka_unit_test(tiles_end_at_the_lands_own_samples),
        cmocka_unit_test(broad_water_ends_at_drawn_shores),
        cmocka_unit_test(threads_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
