// Scattering: places keep to what the parameters allow, and every copy is an instance.
#include "base/memory.h"
#include "base/random.h"
#include "land/height_field.h"
#include "mesh/ball.h"
#include "mesh/leaf/leaf.h"
#include "objects/common/instanced.h"
#include "objects/common/thinning.h"
#include "objects/kinds.h"
#include "objects/scatter/scatter.h"
#include "objects/stone/stone.h"
#include "testing.h"

static float slope_height(const void *user, float x, float z)
{
    (void)z;
    return *(const float *)user * x;
}

static ScatteringParams of_things(Thing *things, int count)
{
    ScatteringParams scatter = scattering_params_default();
    scatter.things.list = things;
    scatter.things.count = count;
    scatter.clumping = 0.0f;
    scatter.things.variants = 1;
    return scatter;
}

static ThingPlaces places_of(const ScatteringParams *scatter, const Recipe *recipe,
                             const Surroundings *around)
{
    ThingPlaces places;
    Error e = {0};
    int64_t settled;
    assert_true(scatter_places_init(&places, scatter, recipe, around, &settled, &e));
    assert_true(settled <= scatter->count && settled <= places.count);
    return places;
}

static Vec3 foot(const Transform *t)
{
    return transform_point(t, vec3(0, 0, 0));
}

static void keeps_distance_on_the_land(void **state)
{
    (void)state;
    float slope = 0.3f;
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 300;
    scatter.center = vec3(5, 0, -2);
    scatter.inner = 2.0f;
    scatter.radius = 10.0f;
    scatter.spacing = 0.5f;
    scatter.scale[0] = 0.5f;
    scatter.scale[1] = 2.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 11, .run = &run};
    Surroundings around = {.land = {slope_height, &slope}};
    ThingPlaces places = places_of(&scatter, &recipe, &around);
    assert_int_equal(places.count, 300);
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 p = foot(&places.place[i]);
        float distance = hypotf(p.x - 5.0f, p.z + 2.0f);
        assert_true(distance >= 1.999f && distance <= 10.001f);
        assert_true(fabsf(p.y - slope * p.x) < 1e-4f);
        Vec3 up = transform_vector(&places.place[i], vec3(0, 1, 0));
        assert_true(vec3_length(up) >= 0.499f && vec3_length(up) <= 2.001f);
        assert_true(fabsf(up.x) < 1e-5f && fabsf(up.z) < 1e-5f); // upright
        for (int64_t k = 0; k < i; k++) {
            assert_true(vec3_distance(p, foot(&places.place[k])) >= 0.4999f);
        }
    }
    thing_places_free(&places);
}

static void stops_where_there_is_no_room(void **state)
{
    (void)state;
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 1000;
    scatter.radius = 2.0f;
    scatter.spacing = 1.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 1, .run = &run};
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    // Discs of half the spacing about the places fit into one of 2.5 m: 25 at most, and about half
    // of that when they fall at random (jamming at a density of 0.547).
    assert_in_range(places.count, 10, 25);
    thing_places_free(&places);
}

static void keeps_to_slopes_and_shares(void **state)
{
    (void)state;
    Error e = {0};
    Mesh *ball = ball_mesh(40, &e);
    assert_non_null(ball);
    ShapeSurface surface = {.mesh = ball};
    Thing things[2] = {{.share = 3.0f}, {.share = 1.0f}};
    ScatteringParams scatter = of_things(things, 2);
    scatter.count = 2000;
    scatter.radius = 0.0f;
    scatter.slope[1] = 60.0f;
    scatter.align = 1.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run, .surface = &surface};
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    int64_t first = 0, upper = 0;
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 p = foot(&places.place[i]);
        float radius = vec3_length(p);
        assert_true(radius > 0.99f && radius < 1.001f);
        assert_true(p.y > 0.45f); // 60 degrees from level: cos 60 = 0.5, less a facet
        Vec3 up = vec3_normalize(transform_vector(&places.place[i], vec3(0, 1, 0)));
        assert_true(vec3_dot(up, vec3_scale(p, 1.0f / radius)) > 0.99f);
        first += places.thing[i] == 0;
        upper += p.y > 0.75f;
    }
    assert_int_equal(places.count, 2000);
    double share = (double)first / 2000.0, above = (double)upper / 2000.0;
    assert_true(fabs(share - 0.75) < 0.04); // 4 standard errors
    assert_true(fabs(above - 0.5) < 0.05);  // areas of a sphere go by height (Archimedes)
    thing_places_free(&places);
    mesh_free(ball);
}

// A patch of 1/400 of the surface is filled as if it were the whole. On a unit sphere the area
// within a distance r is pi r^2 (Archimedes).
static void fills_a_small_patch_of_a_surface(void **state)
{
    (void)state;
    Mesh *ball = ball_mesh(40, NULL);
    assert_non_null(ball);
    ShapeSurface surface = {.mesh = ball};
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 2000;
    scatter.center = vec3(0.6f, 0.8f, 0.0f);
    scatter.radius = 0.1f;
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run, .surface = &surface};
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    assert_int_equal(places.count, 2000);
    int64_t inner = 0;
    for (int64_t i = 0; i < places.count; i++) {
        float away = vec3_distance(foot(&places.place[i]), scatter.center);
        assert_true(away <= 0.1001f);
        inner += away < 0.1f * 0.70710678f;
    }
    assert_true(fabs((double)inner / 2000.0 - 0.5) < 0.05); // 4 standard errors
    thing_places_free(&places);
    mesh_free(ball);
}

// A disc of 1/1400 of a slab of two triangles, on its diagonal: all copies are found, evenly spread
// over the disc on both triangles. Faces of the slab's side stand in the disc's ball, but too far.
static void fills_a_small_patch_of_a_wide_face(void **state)
{
    (void)state;
    Vec3 corner[8] = {{-50, 0, -50}, {50, 0, -50}, {50, 0, 50}, {-50, 0, 50},
                      {-50, -9, 50}, {50, -9, 50}, {50, 0, 50}, {-50, 0, 50}};
    uint32_t index[12] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};
    Mesh slab = {
        .face_size = 3, .vertex_count = 8, .face_count = 4, .index = index, .position = corner};
    ShapeSurface surface = {.mesh = &slab};
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 4000;
    scatter.radius = 1.5f;
    scatter.center = vec3(10.0f, 0.0f, 10.0f);
    Run run = run_default();
    Recipe recipe = {.seed = 3, .run = &run, .surface = &surface};
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    assert_int_equal(places.count, scatter.count);
    double one_side = 0.0, near = 0.0;
    Vec3 mean = {0};
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 p = vec3_sub(foot(&places.place[i]), scatter.center);
        assert_true(vec3_length(p) < 1.5001f && p.y == 0.0f);
        mean = vec3_madd(mean, 1.0f / 4000.0f, p);
        one_side += p.x > p.z;
        near += vec3_length(p) < 0.75f; // a quarter of the area
    }
    assert_true(fabs(one_side / 4000.0 - 0.5) < 0.03 && fabs(near / 4000.0 - 0.25) < 0.03);
    assert_true(vec3_length(mean) < 0.05f);
    thing_places_free(&places);
}

// Mean number of neighbours within half a metre.
static double crowd(const ThingPlaces *places)
{
    int64_t near = 0;
    for (int64_t i = 0; i < places->count; i++) {
        for (int64_t k = 0; k < i; k++) {
            near += vec3_distance(foot(&places->place[i]), foot(&places->place[k])) < 0.5f;
        }
    }
    return 2.0 * (double)near / (double)places->count;
}

// On copies of the surface within the rings asked for each place is met again, where the copy has
// it; another individual stands there.
static void goes_on_over_copies_of_the_surface(void **state)
{
    (void)state;
    Mesh *ball = ball_mesh(20, NULL);
    assert_non_null(ball);
    const Transform mirror =
        transform_from_axes(vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(4, 0, 0));
    const Transform below = transform_compose(vec3(0, -0.5f, 3), vec3(0, 0, 0), vec3(1, 1, 1));
    const SurfaceCopy copy[] = {
        {mirror, 1, false}, {below, 1, false}, {transform_identity(), 2, false}};
    ShapeSurface surface = {.mesh = ball, .copy = copy, .copy_count = 3};
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.things.variants = 10;
    scatter.count = 400;
    scatter.radius = 0.0f;
    scatter.align = 1.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run, .surface = &surface};
    ThingPlaces alone = places_of(&scatter, &recipe, &(Surroundings){0});
    assert_int_equal(alone.count, 400);
    scatter.beyond = 1;
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    assert_int_equal(places.count, 3 * 400);
    int others = 0;
    for (int64_t i = 0; i < 400; i++) {
        const Transform *at = &places.place[3 * i];
        assert_memory_equal(at, &alone.place[i], sizeof *at);
        assert_int_equal(places.thing[3 * i], alone.thing[i]);
        for (int k = 0; k < 2; k++) {
            const Transform *there = &at[1 + k];
            Vec3 up = vec3_normalize(transform_vector(at, vec3(0, 1, 0)));
            Vec3 up_there = vec3_normalize(transform_vector(there, vec3(0, 1, 0)));
            assert_true(vec3_distance(foot(there), transform_point(&copy[k].place, foot(at))) <
                        1e-5f);
            assert_true(vec3_distance(up_there, transform_vector(&copy[k].place, up)) < 1e-5f);
            others += places.thing[3 * i + 1 + k] != places.thing[3 * i];
        }
    }
    assert_in_range(others, 640, 790); // 9 of 10
    thing_places_free(&alone);
    thing_places_free(&places);
    mesh_free(ball);
}

// ---- land with copies in its mesh

enum { SQUARE = 20, SQUARE_CELLS = 8 }; // m; cells a side

// The land of the square (0, 0), and what its mirrored copies add to it.
static float land_of_square(int column, int row, float x, float z)
{
    float own = 0.4f * sinf(0.3f * x) + 0.2f * cosf(0.5f * z + 0.1f * x);
    return own + (float)(3 * row + column) * 0.7f + 0.05f * (float)(column * row) * sinf(x + z);
}

// The square with `rings` around it, each copy with ground of its own.
static Mesh *mesh_of_squares(int rings)
{
    enum { SIDE = SQUARE_CELLS + 1 };
    int across = 2 * rings + 1, squares = across * across, face = 0;
    Mesh *mesh = mesh_new(3, (int64_t)squares * SIDE * SIDE,
                          2 * (int64_t)squares * SQUARE_CELLS * SQUARE_CELLS, 0, NULL);
    assert_non_null(mesh);
    for (int i = 0; i < squares * SIDE * SIDE; i++) {
        int square = i / (SIDE * SIDE), at = i % (SIDE * SIDE);
        int column = square % across - rings, row = square / across - rings;
        float x = (float)(at % SIDE - SQUARE_CELLS / 2) * SQUARE / SQUARE_CELLS;
        float z = (float)(at / SIDE - SQUARE_CELLS / 2) * SQUARE / SQUARE_CELLS;
        float own_x = column % 2 == 0 ? x : -x, own_z = row % 2 == 0 ? z : -z;
        mesh->position[i] =
            vec3((float)(column * SQUARE) + x, land_of_square(column, row, own_x, own_z),
                 (float)(row * SQUARE) + z);
        if (at % SIDE < SQUARE_CELLS && at / SIDE < SQUARE_CELLS) {
            uint32_t v = (uint32_t)i, *corner = mesh->index + 6 * face++;
            const uint32_t of[6] = {v, v + SIDE, v + SIDE + 1, v, v + SIDE + 1, v + 1};
            memcpy(corner, of, sizeof of);
        }
    }
    return mesh;
}

// A level sheet over the western half of the copy to the east.
static Mesh *sheet_over_the_east(float height)
{
    Mesh *mesh = mesh_new(4, 4, 1, 0, NULL);
    assert_non_null(mesh);
    for (uint32_t i = 0; i < 4; i++) {
        float x = i < 2 ? 0.5f * SQUARE : SQUARE, z = i % 3 == 0 ? -0.5f * SQUARE : 0.5f * SQUARE;
        mesh->position[i] = vec3(x, height, z);
        mesh->index[i] = i;
    }
    return mesh;
}

// Two copies, east and north of the square.
static void list_copies(SurfaceCopy copy[2], bool in_mesh)
{
    Vec3 x = vec3(1, 0, 0), y = vec3(0, 1, 0), z = vec3(0, 0, 1);
    Vec3 east = vec3(SQUARE, 0, 0), north = vec3(0, 0, -SQUARE);
    copy[0] = (SurfaceCopy){transform_from_axes(vec3_scale(x, -1), y, z, east), 1, in_mesh};
    copy[1] = (SurfaceCopy){transform_from_axes(x, y, vec3_scale(z, -1), north), 1, in_mesh};
}

static HeightField *field_of_square(void)
{
    float cell = (float)SQUARE / SQUARE_CELLS;
    HeightField *field = height_field_new(SQUARE_CELLS + 1, SQUARE_CELLS + 1, (Vec2){cell, cell},
                                          (Vec2){-0.5f * SQUARE, -0.5f * SQUARE}, NULL);
    assert_non_null(field);
    field->water = calloc((size_t)height_field_count(field), sizeof(float));
    assert_non_null(field->water);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        field->water[i] = -INFINITY;
    }
    return field;
}

static ScatteringParams over_squares(Thing *thing)
{
    ScatteringParams scatter = of_things(thing, 1);
    scatter.things.variants = 10;
    scatter.count = 300;
    scatter.radius = 0.0f;
    scatter.align = 1.0f;
    scatter.spacing = 0.3f;
    scatter.beyond = 1;
    return scatter;
}

// In plan, things stand where they do over copies that are the land itself, the same individuals
// with the same turn, but on the copies' own ground and out of their own water.
static void stands_on_the_ground_of_copies_in_the_mesh(void **state)
{
    (void)state;
    const float level = 0.8f;
    Mesh *alone = mesh_of_squares(0), *all = mesh_of_squares(1);
    Mesh *water = sheet_over_the_east(level);
    HeightField *field = field_of_square();
    SurfaceCopy same[2], own[2];
    list_copies(same, false);
    list_copies(own, true);
    ShapeSurface plain = {.mesh = alone, .copy = same, .copy_count = 2};
    ShapeSurface drawn = {.mesh = all, .copy = own, .copy_count = 2, .water = water};
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = over_squares(&thing);
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run, .surface = &plain, .land = field};
    ThingPlaces expected = places_of(&scatter, &recipe, &(Surroundings){0});
    recipe.surface = &drawn;
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    assert_int_equal(expected.count, 900);
    int64_t at = 0, wet = 0;
    for (int64_t i = 0; i < expected.count; i++) {
        Vec3 there = foot(&expected.place[i]);
        int column = there.x > 0.5f * SQUARE, row = -(there.z < -0.5f * SQUARE);
        float x = column ? (float)SQUARE - there.x : there.x;
        float z = row ? -(float)SQUARE - there.z : there.z;
        float ground = land_of_square(column, row, x, z);
        bool flooded = column && there.x < SQUARE && ground < level;
        Vec3 p = at < places.count ? foot(&places.place[at]) : vec3_splat(-1e9f);
        bool stands = fabsf(p.x - there.x) < 1e-5f && fabsf(p.z - there.z) < 1e-5f;
        wet += !stands;
        if (!stands) { // within what the cells' triangles are off
            assert_true(column && there.x < SQUARE && ground < level + 0.2f);
            continue;
        }
        assert_true(!flooded || ground > level - 0.2f);
        assert_true(fabsf(p.y - ground) < 0.2f);
        assert_true(column || row || fabsf(p.y - there.y) < 1e-6f);
        assert_true(!(column && p.x < SQUARE) || p.y >= level);
        assert_int_equal(places.thing[at], expected.thing[i]);
        at++;
    }
    assert_int_equal(at, places.count);
    print_message("%d of 300 things are left out in a copy's water\n", (int)wet);
    assert_in_range(wet, 20, 140);
    thing_places_free(&expected);
    thing_places_free(&places);
    height_field_free(field);
    mesh_free(water);
    mesh_free(alone);
    mesh_free(all);
}

// Without `beyond` the whole mesh is where things may stand, but not under the copies' water; with
// in_water nowhere else.
static void knows_the_water_of_copies_in_the_mesh(void **state)
{
    (void)state;
    const float level = 0.8f;
    Mesh *all = mesh_of_squares(1), *water = sheet_over_the_east(level);
    HeightField *field = field_of_square();
    SurfaceCopy own[2];
    list_copies(own, true);
    ShapeSurface drawn = {.mesh = all, .copy = own, .copy_count = 2, .water = water};
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = over_squares(&thing);
    scatter.count = 2000;
    scatter.beyond = 0;
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run, .surface = &drawn, .land = field};
    for (int in = 0; in < 2; in++) {
        scatter.in_water = in;
        scatter.afloat = in;
        scatter.count = in ? 100 : 2000;
        ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
        int64_t beside = 0;
        for (int64_t i = 0; i < places.count; i++) {
            Vec3 p = foot(&places.place[i]);
            bool below = p.x > 0.5f * SQUARE && p.x < SQUARE && fabsf(p.z) < 0.5f * SQUARE;
            assert_true(in ? below && fabsf(p.y - level) < 1e-3f : !below || p.y >= level);
            beside += !below;
        }
        assert_true(in ? places.count > 30 : places.count == 2000); // tries are limited
        assert_true(in ? beside == 0 : beside > 1600);
        thing_places_free(&places);
    }
    height_field_free(field);
    mesh_free(water);
    mesh_free(all);
}

static void clumps(void **state)
{
    (void)state;
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 1500;
    scatter.radius = 15.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 2, .run = &run};
    ThingPlaces even = places_of(&scatter, &recipe, &(Surroundings){0});
    scatter.clumping = 1.0f;
    ThingPlaces clumped = places_of(&scatter, &recipe, &(Surroundings){0});
    double expected = 1500.0 * 0.25 / (15.0 * 15.0); // of uniform places
    assert_true(fabs(crowd(&even) / expected - 1.0) < 0.15);
    assert_true(crowd(&clumped) > 1.4 * crowd(&even));
    thing_places_free(&even);
    thing_places_free(&clumped);
}

static bool is_flooded(const void *user, Vec3 p)
{
    (void)user;
    return p.x > 1.0f;
}

static void keeps_to_its_side_of_the_shore(void **state)
{
    (void)state;
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 200;
    Run run = run_default();
    Recipe recipe = {.seed = 4, .run = &run};
    Flood flood = {is_flooded, NULL};
    for (int wet = 0; wet < 2; wet++) {
        scatter.in_water = wet;
        ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){.flood = &flood});
        assert_int_equal(places.count, 200);
        for (int64_t i = 0; i < places.count; i++) {
            assert_int_equal(foot(&places.place[i]).x > 1.0f, wet);
        }
        thing_places_free(&places);
    }
}

// Land that rises to the east by the slope, with water at a level of 1 m.
static HeightField *wet_slope(float slope)
{
    enum { SIDE = 257 };
    const float cell = 0.25f;
    HeightField *land = height_field_new(SIDE, SIDE, (Vec2){cell, cell}, (Vec2){-32, -32}, NULL);
    assert_non_null(land);
    land->water = memory_alloc(height_field_count(land), sizeof *land->water, NULL);
    assert_non_null(land->water);
    for (int64_t i = 0; i < height_field_count(land); i++) {
        float x = -32.0f + cell * (float)(i % SIDE), z = -32.0f + cell * (float)(i / SIDE);
        land->height[i] = slope_height(&slope, x, z);
        land->water[i] = 1.0f;
    }
    return land;
}

// Reeds stand at the edge of the water, on both sides of it: a condition on the depth decides
// alone.
static void a_depth_decides_alone(void **state)
{
    (void)state;
    float slope = 0.3f;
    HeightField *land = wet_slope(slope);
    Thing thing = {.share = 1.0f};
    MapRange range = {.map = HEIGHT_MAP_WATER_DEPTH, .range = {-0.25f, 0.12f}};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 100;
    scatter.radius = 20.0f;
    scatter.where = &range;
    scatter.where_count = 1;
    Run run = run_default();
    Recipe recipe = {.seed = 8, .run = &run, .land = land};
    for (int in_water = 0; in_water < 2; in_water++) {
        scatter.in_water = in_water;
        ThingPlaces places =
            places_of(&scatter, &recipe, &(Surroundings){.land = {slope_height, &slope}});
        int under = 0;
        assert_int_equal(places.count, 100);
        for (int64_t i = 0; i < places.count; i++) {
            float depth = 1.0f - foot(&places.place[i]).y;
            assert_true(depth > -0.33f && depth < 0.20f); // the map knows it to a cell
            under += depth > 0.0f;
        }
        assert_true(under > 15 && under < 50); // of 0.37 m a third are under water
        thing_places_free(&places);
    }
    height_field_free(land);
}

static bool is_below_5(const void *user, Vec3 p)
{
    (void)user;
    return p.y < 5.0f;
}

// Over a sloping bed, what floats is level with the water, as far as the bed is as deep as altitude
// asks for.
static void afloat_is_on_the_surface(void **state)
{
    (void)state;
    float slope = 1.0f;
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 100;
    scatter.in_water = scatter.afloat = true;
    scatter.altitude[0] = 2.0f;
    scatter.align = 1.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 4, .run = &run};
    Flood flood = {is_below_5, NULL};
    Surroundings around = {.flood = &flood, .land = {slope_height, &slope}};
    ThingPlaces places = places_of(&scatter, &recipe, &around);
    assert_int_equal(places.count, 100);
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 p = foot(&places.place[i]);
        float bed = slope_height(&slope, p.x, p.z);
        assert_true(fabsf(p.y - 5.0f) < 1e-4f && bed >= 2.0f && bed < 5.0f);
        assert_true(places.place[i].m[0][1] == 0.0f && places.place[i].m[2][1] == 0.0f); // upright
    }
    thing_places_free(&places);
}

static void land_of_one_slope_meets_its_range_alone(void **state)
{
    (void)state;
    float slope = 0.3f; // 16.7 degrees, falling to the west
    Thing thing = {.share = 1.0f};
    MapRange ranges[2] = {{.map = HEIGHT_MAP_SLOPE, .range = {16.0f, 17.0f}},
                          {.map = HEIGHT_MAP_ASPECT, .range = {265.0f, 275.0f}}};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 50;
    scatter.where = ranges;
    scatter.where_count = 2;
    Run run = run_default();
    Recipe recipe = {.seed = 6, .run = &run};
    Surroundings around = {.land = {slope_height, &slope}};
    ThingPlaces places = places_of(&scatter, &recipe, &around);
    assert_int_equal(places.count, 50);
    thing_places_free(&places);
    ranges[0].range[1] = 16.5f;
    places = places_of(&scatter, &recipe, &around);
    assert_int_equal(places.count, 0);
    thing_places_free(&places);
}

// Of a ball seen from above, the slope at a distance r from the axis is asin r.
static void copies_become_fewer_beyond_a_range(void **state)
{
    (void)state;
    Error e = {0};
    Mesh *ball = ball_mesh(80, &e);
    assert_non_null(ball);
    ShapeSurface surface = {.mesh = ball};
    Thing thing = {.share = 1.0f};
    MapRange ranges[2] = {{.map = HEIGHT_MAP_SLOPE, .range = {0.0f, 20.0f}, .fade = 20.0f},
                          {.map = HEIGHT_MAP_ASPECT, .range = {315.0f, 45.0f}}}; // through north
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 20000;
    scatter.radius = 0.0f;
    scatter.slope[1] = 80.0f; // the lower half lies under the map too
    scatter.where = ranges;
    scatter.where_count = 2;
    Run run = run_default();
    Recipe recipe = {.seed = 7, .run = &run, .surface = &surface};
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    double in = 0.0, fading = 0.0;
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 p = foot(&places.place[i]);
        float slope = asinf(fminf(hypotf(p.x, p.z), 1.0f)) / RADIANS_PER_DEGREE;
        assert_true(slope < 41.5f && -p.z > fabsf(p.x) - 0.03f);
        in += slope < 20.0f;
        fading += slope >= 20.0f;
    }
    // Area goes by sin(slope): the integral of sin s (1 - (s - 20) / 20) from 20 to 40 degrees,
    // over 1 - cos 20.
    double a = 20.0 * (double)RADIANS_PER_DEGREE, b = 2.0 * a;
    double wanted = (cos(a) - (sin(b) - sin(a)) / (b - a)) / (1.0 - cos(a));
    assert_true(in > 100.0 && fabs(fading / in / wanted - 1.0) < 0.15);
    thing_places_free(&places);
    mesh_free(ball);
}

static void copies_every_thing(void **state)
{
    (void)state;
    StoneParams small = stone_params_default(), large = small;
    small.resolution = large.resolution = 6;
    large.size = 3.0f;
    Thing things[2] = {{.object = {.kind = &kind_stone, .params = &small}, .share = 1.0f},
                       {.object = {.kind = &kind_stone, .params = &large}, .share = 1.0f}};
    ScatteringParams scatter = of_things(things, 2);
    scatter.count = 100;
    scatter.things.variants = 2;
    Run run = run_default();
    Recipe recipe = {.seed = 9, .run = &run, .label = "object 'stones'"};
    Geometry geometry = {0};
    const int further[2 * OBJECT_MOST_MATERIALS] = {[0] = 4, [OBJECT_MOST_MATERIALS] = 5};
    Placing placing = {.recipe = &recipe, .geometry = &geometry, .further = further, .object = 3};
    Error e = {0};
    assert_true(scatter_geometry(&scatter, NULL, &placing, &e));
    assert_int_equal(geometry.count, 4);
    int64_t copies = 0;
    for (int64_t i = 0; i < geometry.count; i++) {
        const Part *part = &geometry.part[i];
        Aabb box = mesh_bounds(part->mesh);
        float wanted = i < 2 ? 0.5f : 3.0f;
        assert_true(fabsf(box.high.x - box.low.x - wanted) < 1e-3f);
        assert_int_equal(part->material, i < 2 ? 4 : 5);
        assert_int_equal(part->object, 3);
        copies += part->instance_count;
    }
    assert_int_equal(copies, 100);
    geometry_clear(&geometry);
}

// A branchlet as a spruce's: 14 side shoots with about 2600 needles in all.
static Part sprays(int64_t count)
{
    const LeafParams form = {.shape = LEAF_NEEDLES,
                             .length = 0.018f,
                             .width = 0.0016f,
                             .needles = 800,
                             .needle_angle = 58.0f,
                             .side_shoots = 14,
                             .shoot = 0.5f,
                             .comb = 0.6f,
                             .curl = 25.0f};
    Part part = {.kind = PART_MESH, .mesh = leaf_mesh_new(&form, 3, NULL)};
    for (int i = 0; i < leaf_coarse_levels(&form); i++) {
        part.coarse[i].mesh = leaf_mesh_coarse(&form, 3, i, &part.coarse[i].error, NULL);
    }
    part.instance = memory_alloc(count, sizeof *part.instance, NULL);
    for (int64_t i = 0; i < count; i++) {
        uint64_t key = random_key(1, (uint64_t)i);
        Vec3 p = vec3_scale(random_direction(random_key(key, 1)), 5.0f);
        part.instance[i] = transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), p);
    }
    part.instance_count = count;
    return part;
}

// A conifer's copy has as many sprays of the same size as the tree, each of fewer faces. When they
// were fewer and larger instead, trees lost their tiers and tops.
static void many_sprays_keep_their_size(void **state)
{
    (void)state;
    enum { SPRAYS = 50000, FACES = 1000000 };
    Geometry model = {0}, geometry = {0};
    assert_true(geometry_add(&model, sprays(SPRAYS), NULL));
    const Mesh *fine = model.part[0].mesh;
    Aabb one = mesh_bounds(fine);
    assert_true(fine->face_count > 4000);
    Transform place =
        transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 0, 0));
    Instanced how = {.place = &place, .count = 1, .most_leaves = SPRAYS, .most_faces = FACES};
    Run run = run_default();
    Recipe recipe = {.seed = 9, .run = &run};
    Placing placing = {.recipe = &recipe, .geometry = &geometry};
    assert_true(instanced_add(&model, &how, &placing, NULL));
    int64_t faces = 0;
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < geometry.count; i++) {
        faces += geometry.part[i].mesh->face_count;
        box = aabb_union(box, mesh_bounds(geometry.part[i].mesh));
    }
    assert_in_range(faces, 10 * SPRAYS, FACES);
    assert_true(box.high.y < 5.0f + one.high.y + 0.02f && box.low.y > -5.0f + one.low.y - 0.06f);
    assert_true(box.high.x < 5.0f + one.high.x + 0.06f);
    geometry_clear(&model);
    geometry_clear(&geometry);
}

// What thinning_shares makes least: the variance of the area that is seen, of leaves kept by
// chance.
static double variance_of(const ThinnedLeaves *kind, const double *share, int kinds)
{
    double sum = 0.0;
    for (int i = 0; i < kinds; i++) {
        sum += kind[i].area * kind[i].area / (share[i] * (double)kind[i].count);
    }
    return sum;
}

// No other shares of the same faces have less variance: random exchanges between two kinds.
static void no_other_shares_are_better(void **state)
{
    (void)state;
    enum { KINDS = 4 };
    ThinnedLeaves kind[KINDS] = {{.count = 1000, .area = 40.0, .faces = 50.0},
                                 {.count = 200000, .area = 1.0, .faces = 20.0},
                                 {.count = 30000, .area = 25.0, .faces = 400.0},
                                 {.count = 5000, .area = 0.01, .faces = 2.0}};
    const double most = 5e5;
    thinning_shares(kind, KINDS, 1e9, most);
    double share[KINDS], faces = 0.0;
    for (int i = 0; i < KINDS; i++) {
        share[i] = kind[i].share;
        assert_true(share[i] > 0.0 && share[i] <= 1.0);
        faces += share[i] * kind[i].faces * (double)kind[i].count;
    }
    assert_true(fabs(faces / most - 1.0) < 1e-9);
    assert_true(share[0] == 1.0); // it is cheap for its area: none is left out
    double least = variance_of(kind, share, KINDS);
    for (uint64_t i = 0; i < 2000; i++) {
        int a = (int)(random_key(21, i) % KINDS), b = (int)(random_key(22, i) % KINDS);
        double other[KINDS];
        memcpy(other, share, sizeof other);
        double part = 0.2 * (double)random_unit(random_key(23, i)) * share[a];
        other[a] -= part;
        other[b] +=
            part * kind[a].faces * (double)kind[a].count / (kind[b].faces * (double)kind[b].count);
        assert_true(a == b || other[b] > 1.0 ||
                    variance_of(kind, other, KINDS) > least * (1.0 - 1e-12));
    }
    thinning_shares(kind, KINDS, 36000.0, 1e12);
    double kept = 0.0;
    for (int i = 0; i < KINDS; i++) {
        kept += kind[i].share * (double)kind[i].count;
    }
    assert_true(fabs(kept / 36000.0 - 1.0) < 1e-9);
    thinning_shares(kind, KINDS, 1e9, 1e12);
    assert_true(kind[2].share == 1.0 && kind[1].share == 1.0);
}

// A square of this size (m) at `count` places.
static Part squares(float size, int64_t count, uint64_t key)
{
    Part part = {.kind = PART_MESH, .mesh = mesh_new(4, 4, 1, 0, NULL)};
    static const Vec3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (uint32_t i = 0; i < 4; i++) {
        part.mesh->position[i] = vec3_scale(corner[i], size);
        part.mesh->index[i] = i;
    }
    part.instance = memory_alloc(count, sizeof *part.instance, NULL);
    for (int64_t i = 0; i < count; i++) {
        Vec3 p = vec3_scale(random_direction(random_key(key, (uint64_t)i)), 5.0f);
        part.instance[i] = transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), p);
    }
    part.instance_count = count;
    return part;
}

// Blossom among ten times as many leaves just out of their buds: the buds are what is left out, so
// that no blossom grows. All parts in proportion were enlarged until petals were as large as hands.
static void buds_do_not_enlarge_blossom(void **state)
{
    (void)state;
    enum { BLOSSOMS = 2000, BUDS = 20000 };
    Geometry model = {0}, geometry = {0};
    assert_true(geometry_add(&model, squares(0.05f, BLOSSOMS, 31), NULL));
    assert_true(geometry_add(&model, squares(0.004f, BUDS, 32), NULL));
    double area = BLOSSOMS * 0.05 * 0.05 + BUDS * 0.004 * 0.004, left = 0.0, largest = 0.0;
    Transform place =
        transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 0, 0));
    Instanced how = {.place = &place, .count = 1, .most_leaves = 2300, .most_faces = 1000000};
    Run run = run_default();
    Recipe recipe = {.seed = 9, .run = &run};
    Placing placing = {.recipe = &recipe, .geometry = &geometry};
    assert_true(instanced_add(&model, &how, &placing, NULL));
    int64_t faces = 0;
    for (int64_t i = 0; i < geometry.count; i++) {
        const Mesh *mesh = geometry.part[i].mesh;
        faces += mesh->face_count;
        for (int64_t f = 0; f < mesh->face_count; f++) {
            double side = (double)vec3_distance(mesh->position[mesh->index[4 * f]],
                                                mesh->position[mesh->index[4 * f + 1]]);
            left += side * side;
            largest = fmax(largest, side);
        }
    }
    assert_in_range(faces, 2000, 2600);
    assert_true(fabs(left / area - 1.0) < 0.05);
    if (largest > 0.0501) {
        fail_msg("blossoms of 5 cm became %g cm wide", 100.0 * largest);
    }
    geometry_clear(&model);
    geometry_clear(&geometry);
}

// Number of places within `reach` of the eye, each counted by itself.
static int64_t count_within(const Transform *place, int64_t count, Vec3 eye, float reach)
{
    int64_t within = 0;
    for (int64_t i = 0; i < count; i++) {
        within += vec3_distance(transform_point(&place[i], vec3(0, 0, 0)), eye) < reach;
    }
    return within;
}

// Copies of sprays at 50 places on a line away from the eye at the origin.
static void copies_in_a_row(int64_t leaves, const Vec3 *eye, Geometry *geometry,
                            Transform place[50])
{
    for (int i = 0; i < 50; i++) {
        place[i] = transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1),
                                       vec3(0, 0, -3.0f * (float)((i * 7) % 50)));
    }
    Geometry model = {0};
    assert_true(geometry_add(&model, sprays(leaves), NULL));
    Instanced how = {
        .place = place, .count = 50, .most_leaves = leaves, .most_faces = 20 * leaves, .eye = eye};
    Run run = run_default();
    Recipe recipe = {.seed = 9, .run = &run};
    Placing placing = {.recipe = &recipe, .geometry = geometry};
    assert_true(instanced_add(&model, &how, &placing, NULL));
    geometry_clear(&model);
}

// Near the eye every leaf is an instance of the full mesh at its place; the other copies, and only
// they, have baked ones. Every leaf's place is that of the copy times that in the model.
static void near_copies_keep_every_leaf(void **state)
{
    (void)state;
    enum { LEAVES = 40 };
    Transform place[50];
    Vec3 eye = vec3(0, 0, 0);
    Geometry geometry = {0};
    copies_in_a_row(LEAVES, &eye, &geometry, place);
    Part model = sprays(LEAVES);
    float reach = model.coarse[2].error / 4e-4f;
    int64_t near = count_within(place, 50, eye, reach), full = 0;
    assert_in_range(near, 5, 45);
    for (int64_t i = 0; i < geometry.count; i++) {
        const Part *part = &geometry.part[i];
        if (!part->coarse[0].mesh) {
            assert_int_equal(part->instance_count, 50 - near);
            continue;
        }
        full++;
        assert_int_equal(part->mesh->face_count, model.mesh->face_count);
        assert_int_equal(part->instance_count, near * LEAVES);
        assert_int_equal(count_within(part->instance, part->instance_count, eye, reach + 5.0f),
                         near * LEAVES);
        double z[2] = {0.0, 0.0}; // sums of the leaves' places, in two ways
        for (int64_t k = 0; k < part->instance_count; k++) {
            z[0] += (double)part->instance[k].m[2][3];
        }
        for (int p = 0; p < 50; p++) {
            bool is_near = -place[p].m[2][3] < reach;
            for (int k = 0; is_near && k < LEAVES; k++) {
                z[1] += (double)(place[p].m[2][3] + model.instance[k].m[2][3]);
            }
        }
        assert_true(fabs(z[0] - z[1]) < 1e-4 * fabs(z[1]));
    }
    assert_int_equal(full, 1);
    geometry_clear(&geometry);
    Geometry owner = {0};
    assert_true(geometry_add(&owner, model, NULL));
    geometry_clear(&owner);
}

// Without a camera all copies are baked; of many leaves only the copies next to it stay whole.
static void near_copies_are_limited(void **state)
{
    (void)state;
    Transform place[50];
    Geometry alone = {0}, crowd = {0};
    copies_in_a_row(40, NULL, &alone, place);
    for (int64_t i = 0; i < alone.count; i++) {
        assert_int_equal(alone.part[i].instance_count, 50);
    }
    Vec3 eye = vec3(0, 0, 0);
    enum { LEAVES = 70000 };
    copies_in_a_row(LEAVES, &eye, &crowd, place);
    for (int64_t i = 0; i < crowd.count; i++) {
        const Part *part = &crowd.part[i];
        assert_int_equal(part->instance_count, part->coarse[0].mesh ? 4 * LEAVES : 46);
        assert_true(!part->coarse[0].mesh || count_within(part->instance, part->instance_count, eye,
                                                          9.0f + 5.01f) == 4 * LEAVES);
    }
    geometry_clear(&alone);
    geometry_clear(&crowd);
}

// Copies of one tree differ in slenderness and lean: the axes keep to the bounds, and many come
// near to them.
static void copies_lean_and_stretch_within_bounds(void **state)
{
    (void)state;
    Thing thing = {.share = 1.0f};
    ScatteringParams scatter = of_things(&thing, 1);
    scatter.count = 2000;
    scatter.scale[0] = scatter.scale[1] = 0.5f;
    scatter.stretch[0] = 0.8f;
    scatter.stretch[1] = 1.4f;
    scatter.tilt = 8.0f;
    Run run = run_default();
    Recipe recipe = {.seed = 4, .run = &run};
    ThingPlaces places = places_of(&scatter, &recipe, &(Surroundings){0});
    assert_int_equal(places.count, 2000);
    float least = 9.0f, most = 0.0f, lean = 0.0f;
    Vec3 sum = {0};
    for (int64_t i = 0; i < places.count; i++) {
        const Transform *t = &places.place[i];
        Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
        Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
        assert_true(fabsf(vec3_length(x) - 0.5f) < 1e-5f && fabsf(vec3_dot(x, y)) < 1e-5f);
        float stretch = vec3_length(y) / 0.5f;
        least = fminf(least, stretch);
        most = fmaxf(most, stretch);
        lean = fmaxf(lean, acosf(fminf(y.y / vec3_length(y), 1.0f)) / RADIANS_PER_DEGREE);
        sum = vec3_add(sum, vec3_normalize(y));
    }
    assert_true(least >= 0.799f && least < 0.81f && most <= 1.401f && most > 1.39f);
    assert_true(lean <= 8.05f && lean > 7.9f);
    sum = vec3_scale(sum, 1.0f / 2000.0f); // to all sides alike
    assert_true(fabsf(sum.x) < 0.01f && fabsf(sum.z) < 0.01f);
    thing_places_free(&places);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_distance_on_the_land),
        cmocka_unit_test(stops_where_there_is_no_room),
        cmocka_unit_test(keeps_to_slopes_and_shares),
        cmocka_unit_test(fills_a_small_patch_of_a_surface),
        cmocka_unit_test(fills_a_small_patch_of_a_wide_face),
        cmocka_unit_test(goes_on_over_copies_of_the_surface),
        cmocka_unit_test(stands_on_the_ground_of_copies_in_the_mesh),
        cmocka_unit_test(knows_the_water_of_copies_in_the_mesh),
        cmocka_unit_test(clumps),
        cmocka_unit_test(keeps_to_its_side_of_the_shore),
        cmocka_unit_test(a_depth_decides_alone),
        cmocka_unit_test(afloat_is_on_the_surface),
        cmocka_unit_test(land_of_one_slope_meets_its_range_alone),
        cmocka_unit_test(copies_become_fewer_beyond_a_range),
        cmocka_unit_test(copies_every_thing),
        cmocka_unit_test(many_sprays_keep_their_size),
        cmocka_unit_test(no_other_shares_are_better),
        cmocka_unit_test(buds_do_not_enlarge_blossom),
        cmocka_unit_test(near_copies_keep_every_leaf),
        cmocka_unit_test(near_copies_are_limited),
        cmocka_unit_test(copies_lean_and_stretch_within_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
