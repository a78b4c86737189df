#include "mesh/grass.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <stddef.h>

enum { BLADE_ROWS = 4, BLADE_ROWS_COARSE = 3 };

// Random streams of a blade.
enum {
    STREAM_AZIMUTH = 1,
    STREAM_DISTANCE = 2,
    STREAM_TURN = 3,
    STREAM_HEIGHT = 4,
    STREAM_WIDTH = 5,
    STREAM_LEAN = 6,
    STREAM_BEND = 7
};

typedef struct Blade {
    Vec3 out, side, base;
    float height, width; // m
    float lean, bend;    // degrees
} Blade;

static Blade blade_of(const GrassParams *params, uint64_t key)
{
    Blade blade;
    float sine, cosine;
    exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine, &cosine);
    blade.out = vec3(cosine, 0, sine);
    blade.side = vec3(-sine, 0, cosine);
    float place = params->spread * sqrtf(random_unit(random_key(key, STREAM_DISTANCE)));
    float turn = random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F);
    exact_sincos(turn, &sine, &cosine);
    blade.base = vec3(place * cosine, 0, place * sine);
    blade.height = params->height * random_range(random_key(key, STREAM_HEIGHT), 0.45f, 1.0f);
    blade.width = params->width * random_range(random_key(key, STREAM_WIDTH), 0.6f, 1.0f);
    blade.lean = params->lean * random_unit(random_key(key, STREAM_LEAN));
    blade.bend = params->bend * random_unit(random_key(key, STREAM_BEND));
    return blade;
}

// Blade number `number` of the mesh: `rows` pairs of vertices along an arc that leaves the ground
// at angle `lean` and bends over.
static void add_grass_blade(Mesh *mesh, const Blade *blade, int rows, int64_t number)
{
    Vec3 p = blade->base;
    int64_t first = number * rows * 2;
    for (int r = 0; r < rows; r++) {
        float t = (float)r / (float)(rows - 1), sine, cosine;
        float half = 0.5f * blade->width * (1.0f - 0.92f * t * t);
        mesh->position[first + 2 * r] = vec3_madd(p, -half, blade->side);
        mesh->position[first + 2 * r + 1] = vec3_madd(p, half, blade->side);
        mesh->uv[first + 2 * r] = (Vec2){0, t};
        mesh->uv[first + 2 * r + 1] = (Vec2){1, t};
        exact_sincos((blade->lean + blade->bend * t * t) * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 d = vec3_madd(vec3(0, cosine, 0), sine, blade->out);
        p = vec3_madd(p, blade->height / (float)(rows - 1), d);
    }
    for (int r = 0; r + 1 < rows; r++) {
        uint32_t v = (uint32_t)(first + (int64_t)2 * r);
        uint32_t *face = mesh->index + (number * (rows - 1) + r) * 4;
        face[0] = v;
        face[1] = v + 1;
        face[2] = v + 3;
        face[3] = v + 2;
    }
}

// One blade of every `stride`, as wide as to have the area of all of them. *width: their mean
// width.
static Mesh *tuft_new(const GrassParams *params, uint64_t seed, int rows, int stride, float *width,
                      Error *e)
{
    int64_t blades = (params->blades + stride - 1) / stride;
    Mesh *mesh = mesh_new(4, blades * rows * 2, blades * (rows - 1), MESH_NORMAL | MESH_UV, e);
    float widths = 0.0f;
    for (int i = 0; mesh && i < blades; i++) {
        Blade blade = blade_of(params, random_key(seed, (uint64_t)i * (uint64_t)stride));
        float area = blade.width * blade.height;
        for (int k = i * stride + 1; k < (i + 1) * stride && k < params->blades; k++) {
            Blade other = blade_of(params, random_key(seed, (uint64_t)k));
            area += other.width * other.height;
        }
        blade.width = stride > 1 ? area / blade.height : blade.width;
        widths += blade.width;
        add_grass_blade(mesh, &blade, rows, i);
    }
    *width = widths / (float)blades;
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

Mesh *grass_tuft_new(const GrassParams *params, uint64_t seed, Error *e)
{
    float width;
    return tuft_new(params, seed, BLADE_ROWS, 1, &width, e);
}

Mesh *grass_tuft_coarse(const GrassParams *params, uint64_t seed, int level, float *error, Error *e)
{
    return tuft_new(params, seed, BLADE_ROWS_COARSE, level > 0 ? 4 : 2, error, e);
}
