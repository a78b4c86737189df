// Blades of ice: each chain of the out-tree becomes a closed flat body with a raised rib.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/frost/frost.h"
#include "objects/frost/surface.h"
#include "outtree/chains.h"

#include <stdlib.h>

enum { STREAM_WIDTH = 77, STREAM_RING = 78, STREAM_RIME = 79 }; // of a node's id
enum { STREAM_RELIEF = 0, STREAM_SHIFT = 1 };                   // of a ring
// Of a variant of grains; corner i of its mesh uses the first three + i.
enum { STREAM_BASE_RADIUS = 0, STREAM_TOP_RADIUS = 10, STREAM_TOP_HEIGHT = 20, STREAM_PLACES = 99 };
enum { STREAM_CHANCE = 1, STREAM_TILT = 2, STREAM_TURN = 3, STREAM_SIZE = 4 }; // of a grain

// The section of a blade, across (in half-widths) and up (in heights of the rib), from its left
// edge over the rib to its right edge; the flat underside closes it.
enum { SECTION = 7 };
static const float SECTION_ACROSS[SECTION] = {-1.0f, -0.94f, -0.30f, 0.0f, 0.30f, 0.94f, 1.0f};
static const float SECTION_UP[SECTION] = {0.0f, 0.22f, 0.46f, 1.0f, 0.46f, 0.22f, 0.0f};

typedef struct BladeMesh {
    const OutTree *tree;
    const FrostParams *params;
    Mesh *mesh;
    int64_t vertex, face;
} BladeMesh;

static int64_t chain_length(const ChainSet *chains, int64_t chain)
{
    return chains->first[chain + 1] - chains->first[chain];
}

// Unit, along the chain at place k.
static Vec3 direction_at(const OutTree *tree, const int32_t *node, int64_t count, int64_t k)
{
    int64_t before = k > 0 ? k - 1 : 0, after = k + 1 < count ? k + 1 : k;
    return vec3_normalize(vec3_sub(tree->position[node[after]], tree->position[node[before]]));
}

// Half-width of a chain's blade: full where it begins, narrower toward its tip.
static float width_at(const OutTree *tree, const int32_t *node, int64_t count, int64_t k)
{
    float radius = tree->radius[node[k]];
    if (k == 0 && count > 1) { // the parent chain's node has a larger radius
        radius = tree->radius[node[1]];
    }
    float t = (float)k / (float)(count - 1);
    uint64_t key = random_key(tree->id[node[k]], STREAM_WIDTH);
    return radius * (1.0f - 0.6f * t * t) * random_range(key, 0.82f, 1.15f);
}

// Centre of the ring at place k. A side starts under its parent's flank, not under its rib.
static Vec3 ring_center(const OutTree *tree, const int32_t *node, int64_t k)
{
    Vec3 p = tree->position[node[k]];
    if (k > 0 || tree->parent[node[0]] < 0) {
        return p;
    }
    Vec3 next = tree->position[node[1]];
    float length = vec3_distance(p, next);
    float share = length > 0.0f ? 0.55f * tree->radius[node[0]] / length : 0.0f;
    return vec3_lerp(p, next, share < 0.8f ? share : 0.8f);
}

// Adds the corners of the ring at place k. Ribs are shifted to one side at random, for variety.
static void add_ring(BladeMesh *b, const int32_t *node, int64_t count, int64_t k)
{
    const OutTree *tree = b->tree;
    Vec3 normal = tree->normal[node[k]], along = direction_at(tree, node, count, k);
    Vec3 across = vec3_normalize(vec3_cross(along, normal));
    Vec3 center = ring_center(tree, node, k);
    uint64_t key = random_key(tree->id[node[k]], STREAM_RING);
    float width = width_at(tree, node, count, k);
    float height =
        width * b->params->relief * random_range(random_key(key, STREAM_RELIEF), 0.75f, 1.25f);
    float shift = random_range(random_key(key, STREAM_SHIFT), -0.12f, 0.12f);
    for (int i = 0; i < SECTION; i++) {
        float x = SECTION_ACROSS[i] + (i > 0 && i < SECTION - 1 ? shift : 0.0f);
        Vec3 p = vec3_madd(center, x * width, across);
        b->mesh->position[b->vertex++] = vec3_madd(p, SECTION_UP[i] * height, normal);
    }
}

static void add_face(BladeMesh *b, int64_t u, int64_t v, int64_t w)
{
    uint32_t *corner = b->mesh->index + 3 * b->face++;
    corner[0] = (uint32_t)u;
    corner[1] = (uint32_t)v;
    corner[2] = (uint32_t)w;
}

// Every node of the chain but the last has a ring; the last is the tip.
static void add_blade(BladeMesh *b, const int32_t *node, int64_t count)
{
    int64_t first = b->vertex;
    for (int64_t k = 0; k + 1 < count; k++) {
        add_ring(b, node, count, k);
    }
    int64_t point = b->vertex;
    b->mesh->position[b->vertex++] = b->tree->position[node[count - 1]];
    for (int64_t k = 0; k + 1 < count; k++) {
        int64_t here = first + k * SECTION, next = here + SECTION;
        for (int i = 0; i < SECTION; i++) {
            int j = (i + 1) % SECTION;
            if (next < point) {
                add_face(b, here + i, here + j, next + j);
                add_face(b, here + i, next + j, next + i);
            } else {
                add_face(b, here + i, here + j, point);
            }
        }
    }
    for (int i = 1; i + 1 < SECTION; i++) { // where it begins
        add_face(b, first, first + i + 1, first + i);
    }
}

// Is the chain rime? Otherwise it is clear ice, as all spines are.
static bool is_rime(const OutTree *tree, const FrostParams *params, const ChainSet *chains,
                    int64_t chain)
{
    uint64_t id = tree->id[chains->node[chains->first[chain + 1] - 1]];
    return chains->order[chain] > 0 && random_unit(random_key(id, STREAM_RIME)) < params->rime;
}

static Mesh *blade_mesh(const OutTree *tree, const FrostParams *params, const ChainSet *chains,
                        bool rime, const Run *run, Error *e)
{
    int64_t vertices = 0, faces = 0;
    for (int64_t c = 0; c < chains->count; c++) {
        int64_t rings = chain_length(chains, c) - 1;
        if (rings > 0 && is_rime(tree, params, chains, c) == rime) {
            vertices += rings * SECTION + 1;
            faces += (rings - 1) * 2 * SECTION + SECTION + SECTION - 2;
        }
    }
    BladeMesh b = {.tree = tree, .params = params, .mesh = mesh_new(3, vertices, faces, 0, e)};
    for (int64_t c = 0; b.mesh && c < chains->count; c++) {
        if ((c & 1023) == 0 && run_is_cancelled(run)) {
            run_cancel_error(e);
            mesh_free(b.mesh);
            return NULL;
        }
        if (chain_length(chains, c) > 1 && is_rime(tree, params, chains, c) == rime) {
            add_blade(&b, chains->node + chains->first[c], chain_length(chains, c));
        }
    }
    return b.mesh;
}

// A grain: a low truncated six-sided pyramid of unit half-width, closed.
static Mesh *grain_mesh(uint64_t seed, Error *e)
{
    enum { SIDES = 6 };
    Mesh *mesh = mesh_new(3, 2 * SIDES, 2 * SIDES + 2 * (SIDES - 2), 0, e);
    if (!mesh) {
        return NULL;
    }
    uint32_t *corner = mesh->index;
    for (uint32_t i = 0; i < SIDES; i++) {
        float s, c, r = random_range(random_key(seed, STREAM_BASE_RADIUS + i), 0.75f, 1.1f);
        exact_sincos(2.0f * PI_F * (float)i / SIDES, &s, &c);
        float top = random_range(random_key(seed, STREAM_TOP_RADIUS + i), 0.25f, 0.6f);
        mesh->position[i] = vec3(r * c, r * s, 0.0f);
        mesh->position[SIDES + i] =
            vec3(top * r * c, top * r * s,
                 random_range(random_key(seed, STREAM_TOP_HEIGHT + i), 0.4f, 0.75f));
        uint32_t j = (i + 1) % SIDES;
        const uint32_t sides[6] = {i, j, SIDES + j, i, SIDES + j, SIDES + i};
        for (int k = 0; k < 6; k++) {
            *corner++ = sides[k];
        }
    }
    for (uint32_t i = 1; i + 1 < SIDES; i++) {
        const uint32_t caps[6] = {0, i + 1, i, SIDES, SIDES + i, SIDES + i + 1};
        for (int k = 0; k < 6; k++) {
            *corner++ = caps[k];
        }
    }
    return mesh;
}

// Places grains densely near the border (on a bubble: near the nucleus), sparsely elsewhere. -1 and
// e on failure.
static int64_t place_grains(const FrostParams *params, uint64_t seed, int64_t wanted, float size,
                            Transform *instance, const Run *run, Error *e)
{
    PointSet *points = frost_points(params, wanted, seed, run, e);
    int64_t count = points ? 0 : -1;
    for (int64_t i = 0; points && i < points->count && count < wanted; i++) {
        if (!run_goes_on(run, i, e)) {
            count = -1;
            break;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        float depth = frost_depth(params, points->position[i]) / 0.3f;
        float chance = 0.06f + 0.94f / (1.0f + depth * depth * depth);
        if (random_unit(random_key(key, STREAM_CHANCE)) > chance) {
            continue;
        }
        Vec3 z = vec3_normalize(
            vec3_madd(points->normal[i], 0.25f, random_direction(random_key(key, STREAM_TILT))));
        Vec3 x = vec3_normalize(vec3_cross(random_direction(random_key(key, STREAM_TURN)), z));
        float u = random_unit(random_key(key, STREAM_SIZE)), s = size * (0.35f + 1.1f * u * u * u);
        instance[count++] =
            transform_from_axes(vec3_scale(x, s), vec3_scale(vec3_cross(z, x), s), vec3_scale(z, s),
                                vec3_madd(points->position[i], -0.1f * s, points->normal[i]));
    }
    points_free(points);
    return count;
}

static bool add_grains(const FrostParams *params, float size, int variant, int64_t wanted,
                       const Placing *placing, Error *e)
{
    const Recipe *recipe = placing->recipe;
    uint64_t key = random_key(random_key(recipe->seed, STREAM_FROST_GRAINS), (uint64_t)variant);
    Mesh *mesh = grain_mesh(key, e);
    Transform *instance = memory_alloc(wanted, sizeof *instance, e);
    int64_t count = mesh && instance ? place_grains(params, random_key(key, STREAM_PLACES), wanted,
                                                    size, instance, recipe->run, e)
                                     : -1;
    if (count <= 0) {
        mesh_free(mesh);
        free(instance);
        return count == 0;
    }
    Part part = {.mesh = mesh, .instance = instance, .instance_count = count};
    return placing_add(placing, part, variant % 2 ? FROST_RIME : FROST_ICE, e);
}

static bool add_blades(const OutTree *tree, const FrostParams *params, const Placing *placing,
                       Error *e)
{
    ChainSet *chains = out_tree_chains(tree, e);
    bool done = chains != NULL;
    for (int role = FROST_ICE; done && role <= FROST_RIME; role++) {
        Mesh *mesh = blade_mesh(tree, params, chains, role == FROST_RIME, placing->recipe->run, e);
        done = placing_add(placing, (Part){.mesh = mesh}, role, e);
    }
    chains_free(chains);
    return done;
}

bool frost_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    enum { VARIANTS = 6 };
    const FrostParams *params = given;
    const OutTree *tree = grown->tree;
    bool done = add_blades(tree, params, placing, e);
    float size = 0.0f; // as wide as the finest blades
    for (int64_t i = 0; i < tree->count; i++) {
        size = size == 0.0f || tree->radius[i] < size ? tree->radius[i] : size;
    }
    for (int v = 0; done && params->grains >= VARIANTS && v < VARIANTS; v++) {
        done = add_grains(params, size, v, params->grains / VARIANTS, placing, e);
    }
    return done;
}
