// Blades: each chain of the out-tree becomes a closed flat body with a raised rib.
#include "objects/common/blades.h"

#include "base/memory.h"
#include "base/random.h"
#include "outtree/chains.h"

enum { STREAM_WIDTH = 77, STREAM_RING = 78, STREAM_WHITE = 79 }; // of a node's id
enum { STREAM_RELIEF = 0, STREAM_SHIFT = 1 };                    // of a ring

// The section of a blade, across (in half-widths) and up (in heights of the rib), from its left
// edge over the rib to its right edge; the flat underside closes it.
enum { SECTION = 7 };
static const float SECTION_ACROSS[SECTION] = {-1.0f, -0.94f, -0.30f, 0.0f, 0.30f, 0.94f, 1.0f};
static const float SECTION_UP[SECTION] = {0.0f, 0.22f, 0.46f, 1.0f, 0.46f, 0.22f, 0.0f};

typedef struct BladeMesh {
    const OutTree *tree;
    const BladeParams *params;
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

// Is the chain white? Otherwise it is clear.
static bool is_white(const OutTree *tree, const BladeParams *params, const ChainSet *chains,
                     int64_t chain)
{
    uint64_t id = tree->id[chains->node[chains->first[chain + 1] - 1]];
    float share = chains->order[chain] > 0 ? params->white : params->white_spines;
    return random_unit(random_key(id, STREAM_WHITE)) < share;
}

static Mesh *blade_mesh(const OutTree *tree, const BladeParams *params, const ChainSet *chains,
                        bool white, const Run *run, Error *e)
{
    int64_t vertices = 0, faces = 0;
    for (int64_t c = 0; c < chains->count; c++) {
        int64_t rings = chain_length(chains, c) - 1;
        if (rings > 0 && is_white(tree, params, chains, c) == white) {
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
        if (chain_length(chains, c) > 1 && is_white(tree, params, chains, c) == white) {
            add_blade(&b, chains->node + chains->first[c], chain_length(chains, c));
        }
    }
    return b.mesh;
}

bool blades_add(const OutTree *tree, const BladeParams *params, const Placing *placing,
                const int role[2], Error *e)
{
    ChainSet *chains = out_tree_chains(tree, e);
    bool done = chains != NULL;
    for (int white = 0; done && white < 2; white++) {
        Mesh *mesh = blade_mesh(tree, params, chains, white, placing->recipe->run, e);
        done = placing_add(placing, (Part){.mesh = mesh}, role[white], e);
    }
    chains_free(chains);
    return done;
}
