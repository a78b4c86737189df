// The form of a stone: in every direction the nearest of its planes, which is a convex block, with
// bumps. Where planes meet, a smooth minimum rounds the edge.
#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/stone/stone.h"

enum { STREAM_PLANES = 10, STREAM_BUMPS = 1, STREAM_GRAIN = 2 }; // of the seed; PLANES + i
enum { STREAM_NORMAL = 1, STREAM_DISTANCE = 2 };                 // of a plane
enum { MOST_FACES = 64, SIDES = 6 };

typedef struct Block {
    Vec3 normal[MOST_FACES];
    float distance[MOST_FACES]; // of the plane from the middle, of a block of about unit radius
    int count;
    float sharpness; // exponent of the smooth minimum
    float roughness;
    uint64_t seed;
} Block;

// Planes in well spread directions: those of a spiral, disturbed.
static Block make_block(const StoneParams *params, uint64_t seed)
{
    Block block = {.count = params->faces,
                   .sharpness =
                       4.0f + 60.0f * (1.0f - params->roundness) * (1.0f - params->roundness),
                   .roughness = params->roughness,
                   .seed = seed};
    for (int i = 0; i < block.count; i++) {
        uint64_t key = random_key(seed, STREAM_PLANES + (uint64_t)i);
        float y = 1.0f - 2.0f * ((float)i + 0.5f) / (float)block.count, sine, cosine;
        exact_sincos(2.39996323f * (float)i, &sine, &cosine);
        float r = sqrtf(1.0f - y * y);
        Vec3 even = vec3(r * cosine, y, r * sine);
        Vec3 aside = random_direction(random_key(key, STREAM_NORMAL));
        block.normal[i] = vec3_normalize(vec3_madd(even, 0.45f, aside));
        block.distance[i] = random_range(random_key(key, STREAM_DISTANCE), 0.68f, 1.0f);
    }
    return block;
}

// Distance of the surface from the middle.
static float block_radius(const Block *block, Vec3 direction)
{
    float sum = 0.0f;
    for (int i = 0; i < block->count; i++) {
        float facing = vec3_dot(block->normal[i], direction) / block->distance[i];
        if (facing > 0.0f) {
            sum += exact_pow(facing, block->sharpness);
        }
    }
    float radius = exact_pow(sum, -1.0f / block->sharpness);
    Vec3 p = vec3_scale(direction, radius);
    float bumps = noise_space(vec3_scale(p, 2.2f), random_key(block->seed, STREAM_BUMPS)) +
                  0.4f * noise_space(vec3_scale(p, 7.0f), random_key(block->seed, STREAM_GRAIN));
    return radius + 2.0f * block->roughness * bumps;
}

// Axes of the cube's sides: across, along, outward.
static void side_axes(int side, Vec3 *u, Vec3 *v, Vec3 *out)
{
    static const float AXES[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const float *a = AXES[(side + 1) % 3], *b = AXES[(side + 2) % 3], *c = AXES[side % 3];
    float sign = side < 3 ? 1.0f : -1.0f;
    *u = vec3_scale(vec3(a[0], a[1], a[2]), sign);
    *v = vec3(b[0], b[1], b[2]);
    *out = vec3_scale(vec3(c[0], c[1], c[2]), sign);
}

// Direction of a corner of the cube's lattice, spread so that the faces are of equal size.
static Vec3 corner_direction(Vec3 lattice)
{
    float c[3] = {lattice.x, lattice.y, lattice.z};
    for (int i = 0; i < 3; i++) {
        float sine, cosine;
        exact_sincos(0.25f * PI_F * c[i], &sine, &cosine);
        c[i] = sine / cosine;
    }
    return vec3_normalize(vec3(c[0], c[1], c[2]));
}

// Number of the vertex at lattice place (x, y, z), each 0 .. n, on the surface of the cube: those
// of a lower layer first.
static uint32_t vertex_at(int x, int y, int z, int n)
{
    int full = (n + 1) * (n + 1), ring = 4 * n;
    if (y == 0) {
        return (uint32_t)(z * (n + 1) + x);
    }
    if (y == n) {
        return (uint32_t)(full + (n - 1) * ring + z * (n + 1) + x);
    }
    int along = z == 0 ? x : x == n ? n + z : z == n ? 2 * n + (n - x) : 3 * n + (n - z);
    return (uint32_t)(full + (y - 1) * ring + along);
}

static uint32_t lattice_vertex(Vec3 p, int n)
{
    return vertex_at((int)(0.5f * (p.x + 1.0f) * (float)n + 0.5f),
                     (int)(0.5f * (p.y + 1.0f) * (float)n + 0.5f),
                     (int)(0.5f * (p.z + 1.0f) * (float)n + 0.5f), n);
}

static void add_side(Mesh *mesh, const Block *block, int side, int n)
{
    Vec3 u, v, out;
    side_axes(side, &u, &v, &out);
    uint32_t *face = mesh->index + (int64_t)side * n * n * 4;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            static const int STEPS[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            for (int k = 0; k < 4; k++) {
                float s = 2.0f * (float)(i + STEPS[k][0]) / (float)n - 1.0f;
                float t = 2.0f * (float)(j + STEPS[k][1]) / (float)n - 1.0f;
                Vec3 p = vec3_madd(vec3_madd(out, s, u), t, v);
                uint32_t vertex = lattice_vertex(p, n);
                if (mesh->position[vertex].x == 0.0f && mesh->position[vertex].y == 0.0f &&
                    mesh->position[vertex].z == 0.0f) {
                    Vec3 d = corner_direction(p);
                    mesh->position[vertex] = vec3_scale(d, block_radius(block, d));
                }
                *face++ = vertex;
            }
        }
    }
}

// Scales the block to the stone's extents and puts its underside at height 0, less what is sunk.
static void fit(Mesh *mesh, const StoneParams *params)
{
    Aabb box = mesh_bounds(mesh);
    Vec3 size = vec3_sub(box.high, box.low);
    Vec3 scale = vec3(params->size / size.x, params->height * params->size / size.y,
                      params->width * params->size / size.z);
    float foot = box.low.y + params->sink * size.y;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 *p = &mesh->position[i];
        *p = vec3_mul(scale, vec3(p->x - 0.5f * (box.low.x + box.high.x), p->y - foot,
                                  p->z - 0.5f * (box.low.z + box.high.z)));
    }
}

Mesh *stone_mesh(const StoneParams *params, uint64_t seed, Error *e)
{
    int n = params->resolution;
    int64_t vertices = (int64_t)6 * n * n + 2;
    Mesh *mesh = mesh_new(4, vertices, (int64_t)SIDES * n * n, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    Block block = make_block(params, seed);
    for (int side = 0; side < SIDES; side++) {
        add_side(mesh, &block, side, n);
    }
    fit(mesh, params);
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
