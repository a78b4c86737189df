// Clouds against numerical integrals and a furnace.
#include "tiny_world.h"

#include "base/random.h"
#include "render/cloud/cloud_grid.h"
#include "render/cloud/clouds.h"
#include "render/cloud/heaps.h"

#include <stdlib.h>

#define assert_in_bounds(value, low, high)                                      \
    do {                                                                        \
        double v_ = (double)(value), a_ = (double)(low), b_ = (double)(high);   \
        if (!(v_ >= a_ && v_ <= b_)) {                                          \
            fail_msg("%s = %.6g, not within %.6g .. %.6g", #value, v_, a_, b_); \
        }                                                                       \
    } while (0)

static CloudSet *grow(Cloud cloud)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    CloudSet *clouds = clouds_new(&cloud, 1, 3, &run, &e);
    if (!clouds) {
        fail_msg("%s", e.message);
    }
    return clouds;
}

// Few voxels, where their number makes no difference to what is tested: growing them is most of it.
enum { COARSE = 128, MEDIUM = 256 };

static Cloud coarse(CloudKind kind)
{
    Cloud cloud = cloud_default(kind);
    cloud.resolution = COARSE;
    return cloud;
}

static Cloud small_heaps(void)
{
    Cloud cloud = cloud_default(CLOUD_CUMULUS);
    cloud.resolution = MEDIUM;
    cloud.size = 400.0f;
    cloud.thickness = 300.0f;
    cloud.cover = 0.5f;
    return cloud;
}

static Cloud thick_fog(void)
{
    Cloud fog = coarse(CLOUD_FOG);
    fog.thickness = 400.0f;
    return fog;
}

// Clouds that several tests look at; growing them takes seconds.
enum { SOFTNESSES = 3 };

typedef struct Grown {
    CloudSet *heaps[SOFTNESSES]; // small_heaps with softness 0, 0.5 and 1
    CloudSet *fog;               // thick_fog
    DetailNoise *detail;         // of all clouds
} Grown;

// The key of the clouds of seed 3, as grow makes them.
static uint64_t cloud_key(void)
{
    return random_key(3, 0xc10d);
}

// A cloud as grow makes it, with the detail that all share: making that takes a second. Release it
// with cloud_grid_clear.
static CloudGrid grow_grid(void **state, const Cloud *cloud)
{
    const Grown *sky = *state;
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    CloudGrid grid = {0};
    uint64_t own = random_key(random_key(cloud_key(), 0), (uint64_t)cloud->seed);
    if (!cloud_grid_new(&grid, cloud, sky->detail, own, &run, &e)) {
        fail_msg("%s", e.message);
    }
    return grid;
}

static float extinction_at(const CloudGrid *grid, Vec3 p)
{
    return cloud_grid_extinction(grid, p, true);
}

static int grow_sky(void **state)
{
    static Grown sky;
    for (int i = 0; i < SOFTNESSES; i++) {
        Cloud heaps = small_heaps();
        heaps.softness = 0.5f * (float)i;
        sky.heaps[i] = grow(heaps);
    }
    sky.fog = grow(thick_fog());
    Run run = run_default();
    sky.detail = detail_new(cloud_key(), &run, NULL);
    assert_non_null(sky.detail);
    *state = &sky;
    return 0;
}

static int free_sky(void **state)
{
    Grown *sky = *state;
    for (int i = 0; i < SOFTNESSES; i++) {
        clouds_free(sky->heaps[i]);
    }
    clouds_free(sky->fog);
    detail_free(sky->detail);
    return 0;
}

// A ray through the layer from below, oblique.
static CloudRay ray_number(uint64_t i)
{
    uint64_t key = random_key(11, i);
    Vec3 up = random_direction(random_key(key, 2));
    up.y = 0.4f + fabsf(up.y);
    return (CloudRay){.origin = vec3(random_range(random_key(key, 0), -9000, 9000), 900,
                                     random_range(random_key(key, 1), -9000, 9000)),
                      .direction = vec3_normalize(up),
                      .far = 2000.0f};
}

// Optical depth up to t by steps of half a metre.
static double depth_along(const CloudSet *clouds, const CloudRay *ray, double t)
{
    int steps = (int)(t / 0.5) + 1;
    double sum = 0.0;
    for (int i = 0; i < steps; i++) {
        float at = (float)(((double)i + 0.5) * t / steps);
        sum += (double)clouds_extinction(clouds, vec3_madd(ray->origin, at, ray->direction)) * t /
               steps;
    }
    return sum;
}

// Shares that pass, by all ways of tracking, equal exp(-depth); collisions lie where they must.
// What is seen through clouds has less spread: also of small shares, of which a play makes 0 or 1.
static void tracking_has_the_mean_of_the_integral(void **state)
{
    const CloudSet *clouds = ((Grown *)*state)->heaps[1];
    enum { TRIALS = 4000, RAYS = 12 };
    const float scale = 0.14f;
    int met = 0;
    for (uint64_t i = 0; i < RAYS; i++) {
        CloudRay ray = ray_number(i);
        double wanted = exp(-(double)scale * depth_along(clouds, &ray, (double)ray.far));
        double passed = 0.0, missed = 0.0, early = 0.0, clear = 0.0, square = 0.0;
        uint64_t key = random_key(5, i);
        for (int k = 0; k < TRIALS; k++) {
            passed += (double)clouds_pass(clouds, &ray, scale, &key) / TRIALS;
            double seen = (double)clouds_clear(clouds, &ray, scale, &key);
            clear += seen / TRIALS;
            square += seen * seen / TRIALS;
            float t = clouds_collide(clouds, &ray, scale, &key);
            missed += isinf(t) ? 1.0 / TRIALS : 0.0;
            early += t < 700.0f ? 1.0 / TRIALS : 0.0;
        }
        double error = 4.5 * 0.5 / sqrt((double)TRIALS);
        assert_in_bounds(passed, wanted - error, wanted + error);
        assert_in_bounds(missed, wanted - error, wanted + error);
        double spread = sqrt(fmax(square - clear * clear, 0.0));
        assert_in_bounds(clear, 0.995 * wanted - 4.5 * spread / sqrt((double)TRIALS),
                         1.005 * wanted + 4.5 * spread / sqrt((double)TRIALS));
        assert_in_bounds(spread, 0.0, 0.25 * wanted);
        double before = 1.0 - exp(-(double)scale * depth_along(clouds, &ray, 700.0));
        assert_in_bounds(early, before - error, before + error);
        met += wanted < 0.9;
    }
    assert_true(met >= 4); // rays do meet clouds
}

// The share of vertical rays that meet an optical depth above `least`.
static double covered(const CloudGrid *clouds, double period, float least)
{
    enum { SIDE = 48 };
    int met = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        float x = (float)((i % SIDE + 0.5) * period / SIDE);
        float z = (float)((i / SIDE + 0.5) * period / SIDE);
        float depth = 0.0f, step = 15.0f;
        for (float y = 1100.0f; y < 3500.0f && depth <= least; y += step) {
            depth += step * extinction_at(clouds, vec3(x, y, z));
        }
        met += depth > least;
    }
    return (double)met / (SIDE * SIDE);
}

static void clouds_cover_their_share_of_the_sky(void **state)
{
    for (int i = 1; i <= 3; i += 2) {
        Cloud sheet = cloud_default(CLOUD_STRATUS);
        sheet.resolution = MEDIUM;
        sheet.cover = 0.3f * (float)i;
        CloudGrid clouds = grow_grid(state, &sheet);
        double share = covered(&clouds, 16.0 * (double)sheet.size, 0.0f);
        assert_in_bounds(share, (double)sheet.cover - 0.04, (double)sheet.cover + 0.04);
        cloud_grid_clear(&clouds);
    }
    for (int i = 1; i <= 3; i += 2) {
        Cloud heaps = cloud_default(CLOUD_CUMULUS);
        heaps.resolution = MEDIUM;
        heaps.cover = 0.15f * (float)i;
        CloudGrid clouds = grow_grid(state, &heaps);
        double share =
            covered(&clouds, 16.0 * (double)heaps.size, 0.3f); // fainter wisps hide nothing
        assert_in_bounds(share, 0.85 * (double)heaps.cover, 1.15 * (double)heaps.cover);
        cloud_grid_clear(&clouds);
    }
}

static void heaps_stand_on_one_base_and_no_higher_than_told(void **state)
{
    const CloudSet *clouds = ((Grown *)*state)->heaps[1];
    Cloud heaps = small_heaps();
    int below = 0, inside = 0, above = 0;
    for (uint64_t i = 0; i < 40000; i++) {
        Vec3 p = vec3(random_range(random_key(i, 0), 0, 6400), 0,
                      random_range(random_key(i, 1), 0, 6400));
        p.y = heaps.base - 60.0f * random_unit(random_key(i, 2));
        below += clouds_extinction(clouds, p) > 0.0f;
        p.y = heaps.base + 80.0f * random_unit(random_key(i, 3));
        inside += clouds_extinction(clouds, p) > 0.0f;
        p.y = heaps.base + heaps.thickness * random_range(random_key(i, 4), 1.35f, 2.0f);
        above += clouds_extinction(clouds, p) > 0.0f;
    }
    assert_int_equal(below, 0);
    assert_true(inside > 4000);
    assert_int_equal(above, 0);
}

// The bounds around a place: of its cell, or of the part of it.
static CloudBounds bounds_around(const CloudGrid *g, Vec3 p)
{
    int c[3], part[3];
    float at[3] = {p.x - g->low.x, p.y - g->low.y, p.z - g->low.z};
    for (int axis = 0; axis < 3; axis++) {
        float cells = at[axis] / (g->voxel * CELL);
        c[axis] = (int)floorf(cells);
        part[axis] = (int)((cells - (float)c[axis]) * PARTS);
        assert_in_range(c[axis], 0, g->cells[axis] - 1);
        assert_in_range(part[axis], 0, PARTS - 1);
    }
    const CloudCell *cell = &g->cell[cloud_grid_cell(g, c[0], c[1], c[2])];
    return cell->parts < 0
               ? cell->bounds
               : g->part[((cell->parts * PARTS + part[2]) * PARTS + part[0]) * PARTS + part[1]];
}

static void assert_bounds_hold(const CloudGrid *g, Vec3 p, float extinction)
{
    CloudBounds bounds = bounds_around(g, p);
    float step = g->extinction / CELL_STEPS;
    assert_in_bounds(extinction, 0.99999f * step * bounds.least, 1.00001f * step * bounds.most);
}

// A hilly floor: waves, and a slope that the mirror image beyond the rim takes back.
enum { FLOOR_SIDE = 65 };

static float floor_height(float x, float z)
{
    return 60.0f * sinf(0.004f * x) * cosf(0.003f * z) + 0.05f * x;
}

// height: FLOOR_SIDE^2 samples, which it fills.
static CloudFloor hilly_floor(float *height)
{
    CloudFloor floor = {
        .side = FLOOR_SIDE, .x = -500.0f, .z = 300.0f, .cell = 40.0f, .height = height};
    floor.least = INFINITY;
    floor.most = -INFINITY;
    for (int i = 0; i < FLOOR_SIDE * FLOOR_SIDE; i++) {
        height[i] = floor_height(floor.cell * (float)(i % FLOOR_SIDE),
                                 floor.cell * (float)(i / FLOOR_SIDE));
        floor.least = fminf(floor.least, height[i]);
        floor.most = fmaxf(floor.most, height[i]);
    }
    return floor;
}

static Cloud pooled_fog(CloudFloor *floor)
{
    Cloud fog = cloud_default(CLOUD_FOG);
    fog.resolution = MEDIUM;
    fog.thickness = 150.0f;
    fog.size = 200.0f;
    fog.over = "land";
    fog.floor = floor;
    return fog;
}

// Tracking is right only where bounds bound, and fast only where they are tight.
static void no_cell_is_thinner_or_denser_than_its_bounds(void **state)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    const DetailNoise *detail = ((const Grown *)*state)->detail;
    static float height[FLOOR_SIDE * FLOOR_SIDE];
    CloudFloor floor = hilly_floor(height);
    for (int i = CLOUD_CUMULUS; i <= CLOUD_FOG + 3; i++) {
        Cloud cloud = cloud_default(i <= CLOUD_FOG ? (CloudKind)i : CLOUD_CUMULUS);
        cloud.softness = i == CLOUD_CUMULUS ? 0.0f : (i == CLOUD_FOG + 1 ? 1.0f : cloud.softness);
        cloud.shelf = i == CLOUD_STORM ? 0.6f : 0.0f;
        cloud = i == CLOUD_FOG + 2 ? pooled_fog(&floor) : cloud;
        cloud = i == CLOUD_FOG + 3 ? cloud_default(CLOUD_PLUME) : cloud;
        cloud.resolution = i > CLOUD_STRATUS && i != CLOUD_FOG + 1 ? MEDIUM : cloud.resolution;
        CloudGrid grid = {0};
        assert_true(cloud_grid_new(&grid, &cloud, detail, 6, &run, &e));
        int met = 0;
        double sum = 0.0, least = 0.0, most = 0.0;
        for (uint64_t k = 0; k < 50000; k++) {
            Vec3 u = vec3(random_unit(random_key(k, 0)), random_unit(random_key(k, 1)),
                          random_unit(random_key(k, 2)));
            Vec3 p = vec3_add(
                grid.low, vec3_mul(u, vec3_scale(vec3((float)grid.count[0], (float)grid.count[1],
                                                      (float)grid.count[2]),
                                                 0.999f * grid.voxel)));
            float fine = cloud_grid_extinction(&grid, p, true);
            assert_bounds_hold(&grid, p, fine);
            assert_bounds_hold(&grid, p, cloud_grid_extinction(&grid, p, false));
            met += fine > 0.0f;
            sum += (double)(fine / grid.extinction);
            least += bounds_around(&grid, p).least / (double)CELL_STEPS;
            most += bounds_around(&grid, p).most / (double)CELL_STEPS;
        }
        assert_true(met > 500);
        assert_in_bounds(most / sum, 1.0, 3.0 + 0.5 * (double)cloud.softness); // wisps vary more
        assert_in_bounds(least / sum, 0.2 - 0.1 * (double)cloud.softness, 1.0);
        cloud_grid_clear(&grid);
    }
}

// Voxels across are the least power of two from the resolution up, and their number tall follows.
static void resolution_sets_the_voxels(void **state)
{
    (void)state;
    Cloud cloud = small_heaps();
    int64_t bytes[3];
    for (int i = 0; i < 3; i++) {
        cloud.resolution = (const int[]){65, 128, 256}[i];
        bytes[i] = cloud_grid_bytes(&cloud);
    }
    assert_int_equal(bytes[0], bytes[1]);
    assert_in_bounds((double)bytes[2] / (double)bytes[1], 6.5, 8.5);
}

// A gap is the chessboard distance to the nearest cell with droplets.
static void gaps_reach_to_the_next_cloud(void **state)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    const DetailNoise *detail = ((const Grown *)*state)->detail;
    Cloud cloud = small_heaps();
    cloud.cover = 0.03f;
    CloudGrid g = {0};
    assert_true(cloud_grid_new(&g, &cloud, detail, 6, &run, &e));
    int wide = 0;
    for (uint64_t i = 0; i < 3000; i++) {
        int x = (int)(random_unit(random_key(i, 0)) * (float)g.cells[0]);
        int y = (int)(random_unit(random_key(i, 1)) * (float)g.cells[1]);
        int z = (int)(random_unit(random_key(i, 2)) * (float)g.cells[2]);
        int wanted = MOST_GAP;
        for (int dz = -wanted; dz <= wanted; dz++) {
            for (int dx = -wanted; dx <= wanted; dx++) {
                for (int dy = -y; dy < g.cells[1] - y; dy++) {
                    int far = abs(dx) > abs(dz) ? abs(dx) : abs(dz);
                    far = abs(dy) > far ? abs(dy) : far;
                    if (far < wanted &&
                        g.cell[cloud_grid_cell(&g, x + dx, y + dy, z + dz)].bounds.most) {
                        wanted = far;
                    }
                }
            }
        }
        assert_int_equal(g.cell[cloud_grid_cell(&g, x, y, z)].gap, wanted);
        wide += wanted > 5;
    }
    assert_true(wide > 100);
    cloud_grid_clear(&g);
}

static int compare_extinctions(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

// Extinction in the cores of heaps, h m above their base: a high quantile of what is met there.
static float core_at(const CloudSet *clouds, float altitude)
{
    enum { TRIALS = 40000 };
    float *met = malloc(TRIALS * sizeof *met);
    assert_non_null(met);
    size_t count = 0;
    for (uint64_t i = 0; i < TRIALS; i++) {
        Vec3 p = vec3(random_range(random_key(i, 0), 0, 6400), altitude,
                      random_range(random_key(i, 1), 0, 6400));
        float extinction = clouds_extinction(clouds, p);
        if (extinction > 0.0f) {
            met[count++] = extinction;
        }
    }
    assert_true(count > 1000);
    qsort(met, count, sizeof *met, compare_extinctions);
    float core = met[count * 95 / 100];
    free(met);
    return core;
}

// Share of the droplets' border where the extinction is less than half of what it is at that
// altitude in a core: dry air has been mixed in.
static double worn_share(const CloudSet *clouds, const Cloud *heaps, float from, float to)
{
    int worn = 0, met = 0;
    for (uint64_t i = 0; i < 150000; i++) {
        float share = random_range(random_key(i, 2), from, to);
        Vec3 p =
            vec3(random_range(random_key(i, 0), 0, 6400), heaps->base + heaps->thickness * share,
                 random_range(random_key(i, 1), 0, 6400));
        float extinction = clouds_extinction(clouds, p);
        met += extinction > 0.0f;
        worn += extinction > 0.0f && extinction < 0.5f * heaps->extinction;
    }
    assert_true(met > 300);
    return (double)worn / met;
}

// Above the height where water no longer grows, what is thin is border: the more of it, the softer,
// and more on flanks than at tops.
static void softness_wears_borders_from_below(void **state)
{
    const Grown *sky = *state;
    Cloud heaps = small_heaps();
    double flank[SOFTNESSES], top[SOFTNESSES];
    for (int i = 0; i < SOFTNESSES; i++) {
        flank[i] = worn_share(sky->heaps[i], &heaps, 0.26f, 0.45f);
        top[i] = worn_share(sky->heaps[i], &heaps, 0.5f, 0.8f);
    }
    assert_true(flank[1] > flank[0] + 0.1 && flank[2] > flank[1] + 0.05);
    assert_true(top[1] > top[0] && top[2] > top[1]);
    assert_true(flank[1] > top[1] + 0.05);
}

// As many droplets share water that grows with height: extinction grows with the power 2/3, up to
// where dry air is mixed in as fast.
static void liquid_water_rises_from_one_base(void **state)
{
    const CloudSet *clouds = ((Grown *)*state)->heaps[0]; // worn feet have few cores
    Cloud heaps = small_heaps();
    float low = core_at(clouds, heaps.base + 25.0f), middle = core_at(clouds, heaps.base + 50.0f);
    float high = core_at(clouds, heaps.base + 100.0f);
    assert_in_bounds(middle / low, 0.93 * pow(2.0, 2.0 / 3.0), 1.07 * pow(2.0, 2.0 / 3.0));
    assert_in_bounds(high, 0.97 * (double)heaps.extinction, 1.0001 * (double)heaps.extinction);
}

// Deep in it fog thins out evenly, from its extinction at the base by half of it up to the top:
// over a height h the optical depth is extinction (h - h^2 / (4 thickness)).
static void fog_is_dense_below(void **state)
{
    const CloudSet *clouds = ((Grown *)*state)->fog;
    Cloud fog = thick_fog();
    const double height = 0.12 * (double)fog.thickness;
    const double wanted =
        (double)fog.extinction * (height - height * height / (4.0 * (double)fog.thickness));
    const float scale = 1.0f;
    for (uint64_t i = 0; i < 20; i++) {
        CloudRay up = {.origin = vec3(random_range(random_key(i, 0), -9000, 9000), fog.base,
                                      random_range(random_key(i, 1), -9000, 9000)),
                       .direction = vec3(0, 1, 0),
                       .far = (float)height};
        double depth = depth_along(clouds, &up, height);
        assert_in_bounds(depth, 0.999 * wanted, 1.001 * wanted);
        enum { TRIALS = 2000 };
        double passed = 0.0;
        uint64_t key = random_key(7, i);
        for (int k = 0; k < TRIALS; k++) {
            passed += (double)clouds_pass(clouds, &up, scale, &key) / TRIALS;
        }
        double error = 4.5 * 0.5 / sqrt((double)TRIALS);
        assert_in_bounds(passed, exp(-wanted) - error, exp(-wanted) + error);
    }
}

// Nothing is below its base or above its swells and wisps; a closed one has no hole; its top waves.
static void fog_fills_the_air_up_to_a_wavy_top(void **state)
{
    const CloudSet *clouds = ((Grown *)*state)->fog;
    Cloud fog = thick_fog();
    CloudGrid again = grow_grid(state, &fog);
    double low = 1e9, high = -1e9;
    for (uint64_t i = 0; i < 1500; i++) {
        Vec3 p = vec3(random_range(random_key(i, 0), -9000, 9000), 0,
                      random_range(random_key(i, 1), -9000, 9000));
        p.y = fog.base - 50.0f * random_unit(random_key(i, 2));
        assert_true(clouds_extinction(clouds, p) <= 0.0f);
        p.y = fog.base + 0.5f * fog.thickness * random_unit(random_key(i, 3)) + 0.01f;
        assert_true(clouds_extinction(clouds, p) > 0.25f * fog.extinction);
        p.y = fog.base + fog.thickness + 0.09f * fog.size;
        assert_true(clouds_extinction(clouds, p) <= 0.0f);
        float extinction = 0.0f;
        while (extinction <= 0.0f) { // down to the top
            p.y -= 3.0f;
            extinction = clouds_extinction(clouds, p);
        }
        assert_true(extinction_at(&again, p) == extinction);
        low = fmin(low, (double)p.y);
        high = fmax(high, (double)p.y);
    }
    assert_in_bounds(high - low, 0.12 * (double)fog.thickness, 0.5 * (double)fog.thickness);
    cloud_grid_clear(&again);
}

// Of its area, holes leave the cover; at half its height banks are narrower by their slopes.
static void fog_has_holes_by_its_cover(void **state)
{
    double before = 0.0;
    for (int i = 1; i <= 3; i++) {
        Cloud fog = thick_fog();
        fog.cover = 0.25f * (float)i;
        fog.resolution = MEDIUM;
        CloudGrid clouds = grow_grid(state, &fog);
        int low = 0, middle = 0, tries = 20000;
        for (uint64_t k = 0; k < (uint64_t)tries; k++) {
            Vec3 p = vec3(random_range(random_key(k, 0), 0, 16.0f * fog.size), fog.base + 1.0f,
                          random_range(random_key(k, 1), 0, 16.0f * fog.size));
            low += extinction_at(&clouds, p) > 0.0f;
            p.y = fog.base + 0.5f * fog.thickness;
            middle += extinction_at(&clouds, p) > 0.0f;
        }
        assert_in_bounds((double)low / tries, (double)fog.cover - 0.05, (double)fog.cover + 0.05);
        assert_true(middle < low);
        assert_true((double)middle / tries > before + 0.1);
        before = (double)middle / tries;
        cloud_grid_clear(&clouds);
    }
}

// Fog on a floor fills the air above it up to its thickness, and above its mirror image beyond the
// rim. In depth it gets denser by half of its extinction over its thickness, evenly, so that the
// optical depth of a part of a vertical line follows from its ends.
static void fog_lies_on_its_floor(void **state)
{
    (void)state;
    static float height[FLOOR_SIDE * FLOOR_SIDE];
    CloudFloor floor = hilly_floor(height);
    Cloud fog = pooled_fog(&floor);
    CloudSet *clouds = grow(fog);
    const float side = floor.cell * (FLOOR_SIDE - 1);
    for (uint64_t i = 0; i < 300; i++) {
        float u = side * random_unit(random_key(i, 0)), v = side * random_unit(random_key(i, 1));
        bool beyond = i % 2;
        float ground = floor_height(u, v); // between samples about 1 m off
        Vec3 p = vec3(floor.x + (beyond ? 2.0f * side - u : u), 0,
                      floor.z + (beyond ? 4.0f * side + v : v));
        p.y = ground + fog.thickness + 0.09f * fog.size + 2.0f;
        assert_true(clouds_extinction(clouds, p) <= 0.0f);
        p.y = ground + 0.02f * fog.thickness;
        float low = clouds_extinction(clouds, p), rise = 0.08f * fog.thickness;
        assert_in_bounds(low, 0.7 * (double)fog.extinction, (double)fog.extinction);
        CloudRay up = {.origin = p, .direction = vec3(0, 1, 0), .far = rise};
        p.y += rise;
        float high = clouds_extinction(clouds, p);
        assert_in_bounds((low - high) / fog.extinction, 0.04 - 2e-3, 0.04 + 2e-3);
        double wanted = 0.5 * (double)(low + high) * (double)rise, passed = 0.0;
        assert_in_bounds(depth_along(clouds, &up, (double)rise), 0.999 * wanted, 1.001 * wanted);
        enum { TRIALS = 400 };
        uint64_t key = random_key(8, i);
        for (int k = 0; k < TRIALS; k++) {
            passed += (double)clouds_pass(clouds, &up, 1.0f, &key) / TRIALS;
        }
        double error = 4.5 * 0.5 / sqrt((double)TRIALS);
        assert_in_bounds(passed, exp(-wanted) - error, exp(-wanted) + error);
    }
    clouds_free(clouds);
}

// Mean square of the change of the fog's top over a number of nodes along x or z.
static double roughness_along(const CloudGrid *g, int x, int z)
{
    double sum = 0.0;
    int y = g->count[1] / 2;
    for (int i = 0; i < COARSE * COARSE; i++) {
        int a = i % COARSE, b = i / COARSE, wrap = COARSE - 1;
        double change = g->node[cloud_grid_node(g, a, y, b)].distance -
                        g->node[cloud_grid_node(g, (a + x) & wrap, y, (b + z) & wrap)].distance;
        sum += change * change;
    }
    return sum / (COARSE * COARSE);
}

// Calm swells are alike in all directions; those in wind are longer along it.
static void wind_draws_fog_out(void **state)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    const DetailNoise *detail = ((const Grown *)*state)->detail;
    for (int i = 0; i < 3; i++) { // calm, toward +x, toward +z
        Cloud fog = coarse(CLOUD_FOG);
        fog.drift = i == 0 ? 0.0f : 1.0f;
        fog.wind = i == 1 ? 90.0f : 0.0f;
        CloudGrid g = {0};
        assert_true(cloud_grid_new(&g, &fog, detail, 6, &run, &e));
        double ratio = roughness_along(&g, 1, 0) / roughness_along(&g, 0, 1);
        assert_in_bounds(ratio, i == 0 ? 0.2 : (i == 1 ? 0.0 : 3.0),
                         i == 0 ? 1.5 : (i == 1 ? 0.33 : 1e9));
        cloud_grid_clear(&g);
    }
}

// The number of heaps wider than w falls off like w^-0.9, as long as none is too wide.
enum { MAP = 128 }; // places along a side of a storm's section

// Marks what hangs together with place `start`; returns how many places.
static int flood(bool filled[MAP * MAP], int start)
{
    int stack[MAP * MAP], top = 0, count = 0;
    stack[top++] = start;
    filled[start] = false;
    while (top > 0) {
        int at = stack[--top], x = at % MAP, z = at / MAP;
        count++;
        const int next[4] = {x > 0 ? at - 1 : -1, x + 1 < MAP ? at + 1 : -1, z > 0 ? at - MAP : -1,
                             z + 1 < MAP ? at + MAP : -1};
        for (int k = 0; k < 4; k++) {
            if (next[k] >= 0 && filled[next[k]]) {
                filled[next[k]] = false;
                stack[top++] = next[k];
            }
        }
    }
    return count;
}

// Places of a level section that hold droplets or ice, and how many of them the largest piece has.
static void section(const CloudGrid *clouds, const Cloud *cloud, float share, int *all,
                    int *largest)
{
    bool filled[MAP * MAP];
    float side = 8.0f * cloud->size / MAP;
    *all = *largest = 0;
    for (int i = 0; i < MAP * MAP; i++) {
        Vec3 p = vec3(side * (float)(i % MAP - MAP / 2), cloud->base + share * cloud->thickness,
                      side * (float)(i / MAP - MAP / 2));
        filled[i] = extinction_at(clouds, p) > 0.003f; // dims to 1/e over 330 m
        *all += filled[i];
    }
    for (int i = 0; i < MAP * MAP; i++) {
        int count = filled[i] ? flood(filled, i) : 0;
        *largest = count > *largest ? count : *largest;
    }
}

// One anvil, far wider than the tower that bears it; nothing above what the thickness allows.
static void a_storm_has_one_anvil_on_one_tower(void **state)
{
    Cloud cloud = cloud_default(CLOUD_STORM);
    cloud.softness = 0.2f;
    cloud.resolution = MEDIUM;
    for (int seed = 0; seed < 2; seed++) {
        cloud.seed = seed;
        CloudGrid clouds = grow_grid(state, &cloud);
        int tower, anvil, largest;
        section(&clouds, &cloud, 0.4f, &tower, &largest);
        assert_true(tower > 0 && largest > 0.8f * (float)tower);
        section(&clouds, &cloud, 0.865f, &anvil, &largest); // in the thin sheet
        assert_true(largest > 0.95f * (float)anvil);
        assert_true(anvil > 4 * tower);
        section(&clouds, &cloud, 1.1f, &anvil, &largest);
        assert_int_equal(anvil, 0);
        cloud_grid_clear(&clouds);
    }
}

static void small_heaps_are_many(void **state)
{
    (void)state;
    enum { COUNT = 20000 };
    int wider[4] = {0};
    for (int i = 0; i < COUNT; i++) {
        float width = heaps_width(((float)i + 0.5f) / COUNT);
        assert_in_bounds(width, 0.0799, 1.6001);
        for (int k = 0; k < 4; k++) {
            wider[k] += width > 0.1f * (float)(1 << k);
        }
    }
    double first = (double)(wider[0] - wider[1]) / (wider[1] - wider[2]);
    double second = (double)(wider[1] - wider[2]) / (wider[2] - wider[3]);
    assert_in_bounds(first, 1.8, 1.93); // 2^0.9 = 1.866
    assert_in_bounds(second, 1.8, 1.93);
}

static World *cloudy_world(int samples)
{
    World *world = tiny_world(24, 16, samples, 0.5f);
    world->camera.position = vec3(0, 10, 0);
    world->camera.target = vec3(300, 500, 1000);
    world->camera.fov = 60;
    world->cloud = memory_alloc(1, sizeof *world->cloud, NULL);
    assert_non_null(world->cloud);
    world->cloud[0] = small_heaps();
    world->cloud_count = 1;
    world->cloud_seed = 3;
    add_mesh(world, quad_mesh(vec3(-1, -5, -1), vec3(0, 0, 2), vec3(2, 0, 0)), 0, 0);
    return world;
}

// Droplets absorb nothing, so under an even sky clouds cannot be seen. With lamps, light is sampled
// apart and must add up to the same.
static void an_even_sky_hides_clouds(void **state)
{
    (void)state;
    for (int lamps = 0; lamps < 2; lamps++) {
        World *world = cloudy_world(16);
        world->cloud[0].resolution = COARSE;
        world->sky =
            (Sky){.kind = SKY_CONSTANT, .color = {1, 1, 1}, .strength = 1, .visible = true};
        if (lamps) { // behind the camera and dark
            add_light(world, (Light){.kind = LIGHT_SPHERE,
                                     .center = {0, -50, -400},
                                     .radius = 1,
                                     .radiance = {1e-6f, 1e-6f, 1e-6f}});
        }
        Film *film = trace(world, 2, NULL);
        double mean = mean_luminance(film), error = 4.0 * mean_error(film) + 1e-3;
        assert_in_bounds(mean, 0.99 - error, 1.0 + error); // 1 % goes with the last scatterings
        film_free(film);
        world_free(world);
    }
}

static World *foggy_world(int samples)
{
    World *world = cloudy_world(samples);
    world->cloud[0] = coarse(CLOUD_FOG);
    world->camera.position.y = 0.8f * (world->cloud[0].base + world->cloud[0].thickness);
    return world;
}

// Nor can fog, from within.
static void an_even_sky_hides_fog(void **state)
{
    (void)state;
    World *world = foggy_world(16);
    world->sky = (Sky){.kind = SKY_CONSTANT, .color = {1, 1, 1}, .strength = 1, .visible = true};
    Film *film = trace(world, 2, NULL);
    double mean = mean_luminance(film), error = 4.0 * mean_error(film) + 1e-3;
    assert_in_bounds(mean, 0.99 - error, 1.0 + error);
    film_free(film);
    world_free(world);
}

// The noise of fog in the sun is that of a bounded estimate: its error halves with four times the
// samples, and no pixel is far from the others. Rare paths of great weight, which leave bright
// specks, would do neither.
static void fog_in_the_sun_converges_without_specks(void **state)
{
    (void)state;
    double error[2];
    for (int i = 0; i < 2; i++) {
        World *world = foggy_world(i == 0 ? 32 : 128);
        world->sky = world_default().sky;
        world->sky.sun_elevation = 15.0f;
        world->camera.position.y = world->cloud[0].base + world->cloud[0].thickness + 200.0f;
        world->camera.target = vec3(0, world->cloud[0].base, 1000);
        world->camera.fov = 4;
        Film *film = trace(world, 2, NULL);
        double mean = mean_luminance(film), most = 0.0;
        for (int k = 0; k < film->width * film->height; k++) {
            most = fmax(most, (double)luminance(film->color[k]));
        }
        assert_true(most < 2.5 * mean);
        error[i] = mean_error(film) / mean;
        film_free(film);
        world_free(world);
    }
    assert_in_bounds(error[0] / error[1], 1.6, 2.5);
}

// Albedo, which guides a denoiser, tells how much fog hides of the land below, in every pixel
// alike: no chance of the few paths that get there.
static void guides_see_through_fog_without_chance(void **state)
{
    (void)state;
    World *world = cloudy_world(2);
    Cloud fog = world->cloud[0] = thick_fog();
    const float height = 0.12f * fog.thickness; // see fog_is_dense_below
    world->camera.position = vec3(0, fog.base + height, 0);
    world->camera.target = vec3(0, fog.base, 0.01f);
    world->camera.fov = 4;
    add_mesh(world, quad_mesh(vec3(-50, fog.base, -50), vec3(0, 0, 100), vec3(100, 0, 0)), 0, 0);
    Film *film = trace(world, 2, NULL);
    double depth =
        (double)fog.extinction * (double)(height - height * height / (4.0f * fog.thickness));
    double wanted = 1.0 - 0.5 * exp(-depth);
    for (int i = 0; i < film->width * film->height; i++) {
        assert_in_bounds(film->albedo[i].x, wanted - 0.005, wanted + 0.005);
    }
    film_free(film);
    world_free(world);
}

// Land in the shade of a closed sheet gets less light than in the open, but some.
static void clouds_shade_the_land(void **state)
{
    (void)state;
    double light[2];
    for (int clouds = 0; clouds < 2; clouds++) {
        World *world = cloudy_world(64);
        world->cloud[0] = coarse(CLOUD_STRATUS);
        world->cloud[0].cover = 1.0f;
        world->cloud_count = clouds;
        world->camera.target = vec3(0, 0, 0.01f);
        world->camera.fov = 4;
        world->sky = world_default().sky;
        Film *film = trace(world, 2, NULL);
        light[clouds] = mean_luminance(film);
        film_free(film);
        world_free(world);
    }
    assert_in_bounds(light[1] / light[0], 0.05, 0.6);
}

static void assert_same_by_one_thread(const World *world, const Film *film)
{
    Film *one = trace(world, 1, NULL);
    size_t pixels = (size_t)(film->width * film->height);
    assert_memory_equal(one->color, film->color, sizeof *one->color * pixels);
    assert_memory_equal(one->normal, film->normal, sizeof *one->normal * pixels);
    film_free(one);
}

// Like haze, clouds have no place; but they have normals, which guide denoisers. For any number of
// threads.
static void clouds_have_normals_but_no_depth(void **state)
{
    (void)state;
    World *world = cloudy_world(8);
    world->sky = world_default().sky;
    Film *film = trace(world, 3, NULL);
    assert_same_by_one_thread(world, film);
    int seen = 0;
    for (int i = 0; i < film->width * film->height; i++) {
        double length = (double)vec3_length(film->normal[i]);
        assert_in_bounds(length, 0.0, 1.0001);
        seen += length > 0.2 && isinf(film->depth[i]);
    }
    assert_true(seen > 20);
    film_free(film);
    world_free(world);
}

// Forms that rain hides do not guide denoisers: normals keep their directions and get shorter, by
// the exponential of minus the rain's extinction, which is in proportion to rate^0.67.
static void rain_hides_forms(void **state)
{
    (void)state;
    const float rate[] = {0.0f, 10.0f, 20.0f};
    Film *film[3];
    for (int n = 0; n < 3; n++) {
        World *world = cloudy_world(2);
        if (n > 0) {
            world->shower = memory_alloc(1, sizeof *world->shower, NULL);
            assert_non_null(world->shower);
            world->shower[0] = shower_default();
            world->shower[0].radius = 30000.0f; // all that is seen is in it
            world->shower[0].base = 9000.0f;
            world->shower[0].rate = rate[n];
            world->shower[0].streaks = 0.0f;
            world->shower_count = 1;
        }
        film[n] = trace(world, 2, NULL);
        world_free(world);
    }
    int seen = 0;
    for (int i = 0; i < film[0]->width * film[0]->height; i++) {
        Vec3 dry = film[0]->normal[i];
        float share[3], square = vec3_dot(dry, dry);
        if (square > 0.04f && isinf(film[0]->depth[i])) {
            for (int n = 1; n < 3; n++) {
                share[n] = vec3_dot(dry, film[n]->normal[i]) / square;
                assert_true(vec3_length(vec3_madd(film[n]->normal[i], -share[n], dry)) < 1e-4f);
            }
            assert_in_bounds((double)share[1], 0.0, 0.95);
            if (share[1] < 0.05f) {
                continue; // far clouds
            }
            double power = log((double)share[2]) / log((double)share[1]);
            assert_in_bounds(power, 0.995 * pow(2.0, 0.67), 1.005 * pow(2.0, 0.67));
            seen++;
        }
    }
    assert_true(seen > 20);
    for (int n = 0; n < 3; n++) {
        film_free(film[n]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tracking_has_the_mean_of_the_integral),
        cmocka_unit_test(clouds_cover_their_share_of_the_sky),
        cmocka_unit_test(heaps_stand_on_one_base_and_no_higher_than_told),
        cmocka_unit_test(no_cell_is_thinner_or_denser_than_its_bounds),
        cmocka_unit_test(resolution_sets_the_voxels),
        cmocka_unit_test(gaps_reach_to_the_next_cloud),
        cmocka_unit_test(softness_wears_borders_from_below),
        cmocka_unit_test(liquid_water_rises_from_one_base),
        cmocka_unit_test(fog_is_dense_below),
        cmocka_unit_test(fog_fills_the_air_up_to_a_wavy_top),
        cmocka_unit_test(fog_has_holes_by_its_cover),
        cmocka_unit_test(fog_lies_on_its_floor),
        cmocka_unit_test(wind_draws_fog_out),
        cmocka_unit_test(small_heaps_are_many),
        cmocka_unit_test(a_storm_has_one_anvil_on_one_tower),
        cmocka_unit_test(an_even_sky_hides_clouds),
        cmocka_unit_test(an_even_sky_hides_fog),
        cmocka_unit_test(fog_in_the_sun_converges_without_specks),
        cmocka_unit_test(guides_see_through_fog_without_chance),
        cmocka_unit_test(clouds_shade_the_land),
        cmocka_unit_test(clouds_have_normals_but_no_depth),
        cmocka_unit_test(rain_hides_forms),
    };
    return cmocka_run_group_tests(tests, grow_sky, free_sky);
}
