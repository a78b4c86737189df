#include "objects/ground/ground.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "mesh/grass.h"
#include "objects/ground/grove.h"
#include "objects/ground/litter.h"

#include <stdlib.h>

enum { STREAM_TUFT_PLACES = 1 }; // of a variant of grass
// Of a tuft.
enum {
    STREAM_TUFT_RADIUS = 1,
    STREAM_TUFT_AZIMUTH = 2,
    STREAM_TUFT_CHANCE = 3,
    STREAM_TUFT_SIZE = 4,
    STREAM_TUFT_VARIATION = 5,
    STREAM_TUFT_TURN = 6
};
GroundParams ground_params_default(void)
{
    return (GroundParams){.radius = 2000.0f,
                          .relief = 22.0f,
                          .wavelength = 420.0f,
                          .flat_radius = 40.0f,
                          .grass_tufts = 60000,
                          .grass_radius = 45.0f,
                          .grass_height = 0.32f,
                          .grass_clumping = 0.5f,
                          .grass_variants = 6,
                          .fallen_leaves = 0,
                          .fallen_radius = 9.0f,
                          .trees = {.count = 0,
                                    .inner = 150.0f,
                                    .outer = 900.0f,
                                    .height = 16.0f,
                                    .clumping = 0.9f,
                                    .variants = 5}};
}

// Height of the land without ponds.
static float relief_height(const GroundParams *params, uint64_t seed, float x, float z)
{
    float r = sqrtf(x * x + z * z), scale = 1.0f / params->wavelength;
    float hills =
        noise_plane_fractal(x * scale, z * scale, 4, random_key(seed, STREAM_GROUND_HILLS));
    float bumps =
        noise_plane_fractal(x * 0.35f, z * 0.35f, 2, random_key(seed, STREAM_GROUND_BUMPS));
    float flat = params->flat_radius > 1e-3f ? params->flat_radius : 1e-3f; // 0 would be a step
    float near = smoothstepf(flat, 8.0f * flat, r);
    return params->relief * hills * near + 0.07f * bumps * smoothstepf(0.5f, 4.0f, r);
}

static uint64_t pond_seed(uint64_t seed, int index)
{
    return random_key(random_key(seed, STREAM_GROUND_PONDS), (uint64_t)index);
}

PondSite ground_pond(const GroundParams *params, uint64_t seed, int index)
{
    enum { AROUND = 12 };
    const Pond *pond = &params->ponds[index];
    float x = pond->position[0], z = pond->position[1];
    float lowest = relief_height(params, seed, x, z);
    for (int i = 0; i < AROUND; i++) {
        float sine, cosine;
        exact_sincos(2.0f * PI_F * (float)i / AROUND, &sine, &cosine);
        float h = relief_height(params, seed, x + pond->radius * sine, z + pond->radius * cosine);
        lowest = h < lowest ? h : lowest;
    }
    return (PondSite){pond, lowest - pond->bank, pond_seed(seed, index)};
}

// The pond whose basin or banks are at the place, possibly; -1 = none. They do not overlap.
static int pond_near(const GroundParams *params, float x, float z, float margin)
{
    for (int i = 0; i < params->pond_count; i++) {
        const Pond *pond = &params->ponds[i];
        float dx = x - pond->position[0], dz = z - pond->position[1];
        float reach = pond_reach(pond) + margin;
        if (dx * dx + dz * dz < reach * reach) {
            return i;
        }
    }
    return -1;
}

float ground_height(const GroundParams *params, uint64_t seed, float x, float z)
{
    float land = relief_height(params, seed, x, z);
    int near = pond_near(params, x, z, 0.0f);
    if (near < 0) {
        return land;
    }
    PondSite site = ground_pond(params, seed, near);
    return pond_height(&site, x, z, land);
}

bool ground_in_pond(const GroundParams *params, uint64_t seed, float x, float z)
{
    int near = pond_near(params, x, z, 0.0f);
    return near >= 0 && pond_share(&params->ponds[near], pond_seed(seed, near), x, z) < 1.0f;
}

// Radii of a polar grid's rings: half a metre apart near the middle, then in geometric progression
// to the horizon.
enum { GROUND_SECTORS = 256 };
#define FIRST_RING 0.3f // m
#define RING_GROWTH 0.02f

static int64_t ground_rings(const GroundParams *params, float *radius, int64_t most)
{
    int64_t count = 0;
    for (float r = 0.5f; r < params->radius && count + 1 < most;
         r += FIRST_RING + RING_GROWTH * r) {
        radius[count++] = r;
    }
    radius[count++] = params->radius;
    return count;
}

// No face of the land's mesh is longer than `face` here, so one that reaches over the pond has all
// vertices in the inner margin, and one that has any of them there ends within the outer.
PondMargin ground_pond_margin(const Pond *pond)
{
    float x = pond->position[0], z = pond->position[1];
    float r = sqrtf(x * x + z * z) + pond_reach(pond);
    float along = FIRST_RING + RING_GROWTH * r, across = 2.0f * PI_F / GROUND_SECTORS * r;
    float face = 1.1f * sqrtf(along * along + across * across);
    face += 0.5f; // of the innermost fan
    return (PondMargin){face, 2.3f * face};
}

// Height of the snow's surface above the land at (x, z), m; below 0 where the land is bare.
static float snow_height(const GroundParams *params, uint64_t seed, float x, float z)
{
    uint64_t key = random_key(seed, STREAM_GROUND_DRIFTS);
    float drifts = noise_plane_fractal(x * 0.22f, z * 0.22f, 3, key);
    return params->snow + (0.04f + 0.25f * params->snow) * drifts;
}

static Vec3 ground_point(const GroundParams *params, uint64_t seed, float x, float z)
{
    return vec3(x, ground_height(params, seed, x, z), z);
}

// The land's surface or that of the snow on it.
static Vec3 surface_point(const GroundParams *params, uint64_t seed, bool snow, float x, float z)
{
    Vec3 p = ground_point(params, seed, x, z);
    if (snow) { // it melts in the water
        p.y += ground_in_pond(params, seed, x, z) ? -0.05f : snow_height(params, seed, x, z);
    }
    return p;
}

// Lowers the mesh of the land below the finer ones of its ponds.
static void hide_under_ponds(Mesh *mesh, const GroundParams *params)
{
    for (int i = 0; i < params->pond_count; i++) {
        const Pond *pond = &params->ponds[i];
        float reach = pond_reach(pond) + ground_pond_margin(pond).inner;
        for (int64_t v = 0; v < mesh->vertex_count; v++) {
            Vec3 *p = &mesh->position[v];
            float dx = p->x - pond->position[0], dz = p->z - pond->position[1];
            p->y -= dx * dx + dz * dz < reach * reach ? 1.0f + pond->depth + 0.2f * reach : 0.0f;
        }
    }
}

static void ground_vertices(Mesh *mesh, const GroundParams *params, uint64_t seed, bool snow,
                            const float *radius, int64_t rings)
{
    for (int64_t ring = 0; ring < rings; ring++) {
        for (int s = 0; s < GROUND_SECTORS; s++) {
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (float)s / GROUND_SECTORS, &sine, &cosine);
            Vec3 p = surface_point(params, seed, snow, radius[ring] * sine, radius[ring] * cosine);
            mesh->position[ring * GROUND_SECTORS + s] = p;
            mesh->uv[ring * GROUND_SECTORS + s] = (Vec2){p.x, p.z};
        }
    }
}

static void ground_faces(Mesh *mesh, int64_t rings)
{
    uint32_t *corner = mesh->index;
    for (int64_t ring = 0; ring + 1 < rings; ring++) {
        for (int s = 0; s < GROUND_SECTORS; s++) {
            uint32_t inner = (uint32_t)(ring * GROUND_SECTORS);
            uint32_t next = (uint32_t)((s + 1) % GROUND_SECTORS), here = (uint32_t)s;
            *corner++ = inner + here;
            *corner++ = inner + GROUND_SECTORS + here;
            *corner++ = inner + GROUND_SECTORS + next;
            *corner++ = inner + next;
        }
    }
    // The innermost ring is closed by a fan of quads, two sectors each.
    uint32_t middle = (uint32_t)(rings * GROUND_SECTORS);
    for (uint32_t s = 0; s < GROUND_SECTORS; s += 2) {
        *corner++ = middle;
        *corner++ = s;
        *corner++ = s + 1;
        *corner++ = (s + 2) % GROUND_SECTORS;
    }
}

static Mesh *ground_mesh(const GroundParams *params, uint64_t seed, bool snow, Error *e)
{
    enum { MOST_RINGS = 1024 };
    float radius[MOST_RINGS];
    int64_t rings = ground_rings(params, radius, MOST_RINGS);
    Mesh *mesh =
        mesh_new(4, rings * GROUND_SECTORS + 1, (rings - 1) * GROUND_SECTORS + GROUND_SECTORS / 2,
                 MESH_NORMAL | MESH_UV, e);
    if (!mesh) {
        return NULL;
    }
    ground_vertices(mesh, params, seed, snow, radius, rings);
    mesh->position[rings * GROUND_SECTORS] = surface_point(params, seed, snow, 0.0f, 0.0f);
    ground_faces(mesh, rings);
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    hide_under_ponds(mesh, params);
    return mesh;
}

// An upright instance at (x, z), rotated and scaled.
static Transform upright(const GroundParams *params, uint64_t seed, float x, float z, float turn,
                         float scale)
{
    float sine, cosine;
    exact_sincos(turn, &sine, &cosine);
    return transform_from_axes(vec3(scale * cosine, 0, -scale * sine), vec3(0, scale, 0),
                               vec3(scale * sine, 0, scale * cosine),
                               ground_point(params, seed, x, z));
}

// Tufts of one variant: dense in the middle, sparse but larger toward the rim, in patches. -1 if
// interrupted.
static int64_t place_tufts(const GroundParams *params, uint64_t ground_seed, uint64_t seed,
                           const Flood *flood, int64_t wanted, Transform *instance,
                           float *variation, const Run *run, Error *e)
{
    int64_t count = 0;
    for (int64_t i = 0; i < wanted; i++) {
        if (!run_goes_on(run, i, e)) {
            return -1;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        float share = exact_pow(random_unit(random_key(key, STREAM_TUFT_RADIUS)), 0.75f), sine,
              cosine;
        exact_sincos(random_range(random_key(key, STREAM_TUFT_AZIMUTH), 0.0f, 2.0f * PI_F), &sine,
                     &cosine);
        float x = params->grass_center.x + params->grass_radius * share * sine;
        float z = params->grass_center.z + params->grass_radius * share * cosine;
        float patch = noise_plane_fractal(x * 0.55f, z * 0.55f, 3,
                                          random_key(ground_seed, STREAM_GROUND_PATCHES));
        float keep = 1.0f - params->grass_clumping * smoothstepf(0.25f, -0.35f, patch);
        keep *= smoothstepf(1.0f, 0.55f, share); // soft edge of the grass
        if (random_unit(random_key(key, STREAM_TUFT_CHANCE)) > keep ||
            flood_covers(flood, ground_point(params, ground_seed, x, z))) {
            continue;
        }
        float scale =
            random_range(random_key(key, STREAM_TUFT_SIZE), 0.55f, 1.0f) * (1.0f + 0.35f * patch);
        variation[count] = clampf(
            0.5f + 0.6f * patch + 0.4f * random_unit(random_key(key, STREAM_TUFT_VARIATION)) - 0.2f,
            0.0f, 1.0f);
        instance[count++] =
            upright(params, ground_seed, x, z,
                    random_range(random_key(key, STREAM_TUFT_TURN), 0.0f, 2.0f * PI_F), scale);
    }
    return count;
}

// Sets the tuft's mesh and its coarse forms; after a failure none.
static void tuft_meshes(const GrassParams *tuft, uint64_t seed, Part *part, Error *e)
{
    part->mesh = grass_tuft_new(tuft, seed, e);
    for (int i = 0; part->mesh && i < GRASS_COARSE_LEVELS; i++) {
        CoarseMesh *coarse = &part->coarse[i];
        coarse->mesh = grass_tuft_coarse(tuft, seed, i, &coarse->error, e);
        if (!coarse->mesh) {
            part_free_meshes(part);
        }
    }
}

static bool add_grass_variant(const GroundParams *params, int variant, const Placing *placing,
                              Error *e)
{
    const Recipe *recipe = placing->recipe;
    uint64_t key = random_key(random_key(recipe->seed, STREAM_GROUND_GRASS), (uint64_t)variant);
    GrassParams tuft = {.blades = 22,
                        .height = params->grass_height,
                        .width = 0.0065f,
                        .spread = 0.09f,
                        .lean = 32.0f,
                        .bend = 85.0f};
    int64_t wanted = grove_share(params->grass_tufts, params->grass_variants, variant);
    Part part = {.instance = memory_alloc(wanted, sizeof(Transform), e),
                 .variation = memory_alloc(wanted, sizeof(float), e)};
    tuft_meshes(&tuft, key, &part, e);
    int64_t count = part.mesh && part.instance && part.variation
                        ? place_tufts(params, recipe->seed, random_key(key, STREAM_TUFT_PLACES),
                                      placing->around.flood, wanted, part.instance, part.variation,
                                      recipe->run, e)
                        : -1;
    if (count <= 0) { // an instance count of 0 would draw the tuft once, at the origin
        part_free_meshes(&part);
        free(part.instance);
        free(part.variation);
        return count == 0;
    }
    part.instance_count = count;
    return placing_add(placing, part, GROUND_GRASS, e);
}

typedef struct DrawnLand {
    const GroundParams *params;
    uint64_t seed;
    bool snow;
} DrawnLand;

static Vec3 drawn_point(const void *user, float x, float z)
{
    const DrawnLand *drawn = user;
    return surface_point(drawn->params, drawn->seed, drawn->snow, x, z);
}

static bool add_pond(const GroundParams *params, int index, const Placing *placing, Error *e)
{
    uint64_t seed = placing->recipe->seed;
    PondSite site = ground_pond(params, seed, index);
    PondMargin margin = ground_pond_margin(site.pond);
    DrawnLand bare = {params, seed, false}, white = {params, seed, true};
    PondLand land = {drawn_point, &bare}, snow = {drawn_point, &white};
    return placing_add(placing, (Part){.mesh = pond_bank_mesh(&site, &land, &margin, e)},
                       GROUND_LAND, e) &&
           placing_add(placing, (Part){.mesh = pond_bed_mesh(&site, &land, e)}, GROUND_BED, e) &&
           (params->snow <= 0.0f ||
            placing_add(placing, (Part){.mesh = pond_bank_mesh(&site, &snow, &margin, e)},
                        GROUND_SNOW, e)) &&
           placing_add(placing, (Part){.mesh = pond_water_mesh(&site, e), .is_water = true},
                       GROUND_WATER, e);
}

bool ground_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const GroundParams *params = given;
    uint64_t seed = placing->recipe->seed;
    Part land = {.mesh = ground_mesh(params, seed, false, e)};
    bool done = placing_add(placing, land, GROUND_LAND, e);
    if (done && params->snow > 0.0f) {
        done = placing_add(placing, (Part){.mesh = ground_mesh(params, seed, true, e)}, GROUND_SNOW,
                           e);
    }
    for (int i = 0; done && i < params->pond_count; i++) {
        done = add_pond(params, i, placing, e);
    }
    for (int v = 0; done && params->grass_tufts > 0 && v < params->grass_variants; v++) {
        done = add_grass_variant(params, v, placing, e);
    }
    return done && litter_add(params, placing, e) &&
           (params->trees.count == 0 || grove_add(params, placing, e));
}
