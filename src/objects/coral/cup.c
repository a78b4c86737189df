#include "objects/coral/cup.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <string.h>

// Walls of rings of vertices under construction.
typedef struct Cup {
    Mesh *mesh;
    int64_t vertices, faces; // so far
} Cup;

static uint32_t add_vertex(Cup *cup, Vec3 position, float youth)
{
    cup->mesh->position[cup->vertices] = position;
    cup->mesh->birth[cup->vertices] = clampf(youth, 0.0f, 1.0f);
    return (uint32_t)cup->vertices++;
}

static void add_quad(Cup *cup, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t quad[4] = {a, b, c, d};
    memcpy(cup->mesh->index + 4 * cup->faces++, quad, sizeof quad);
}

// Joins rings of `sides` vertices that follow each other from `first` on, and closes the last one
// with the vertex after it, two sides a quad.
static void join_rings(Cup *cup, uint32_t first, uint32_t rings, uint32_t sides)
{
    for (uint32_t r = 0; r + 1 < rings; r++) {
        for (uint32_t k = 0; k < sides; k++) {
            uint32_t a = first + r * sides + k, b = first + r * sides + (k + 1) % sides;
            add_quad(cup, a, b, b + sides, a + sides);
        }
    }
    uint32_t last = first + (rings - 1) * sides, middle = last + sides;
    for (uint32_t k = 0; k < sides; k += 2) {
        add_quad(cup, last + k, last + k + 1, last + (k + 2) % sides, middle);
    }
}

static int64_t faces_of(int rings, int sides)
{
    return (rings - 1) * sides + sides / 2;
}

static Mesh *finished(Mesh *mesh, Error *e)
{
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

// ---- tubes

// A foot that widens into the tissue, outer wall, rim, inner wall, floor: radius and height as
// shares of the rim's radius and of the cup's height; offset of its youth from the skin's.
static const float PROFILE[][3] = {
    {1.50f, -0.25f, 0.0f}, {1.24f, 0.06f, 0.0f}, {1.06f, 0.28f, 0.0f}, {0.97f, 0.58f, 0.05f},
    {0.98f, 0.86f, 0.15f}, {0.91f, 0.98f, 0.3f}, {0.80f, 1.00f, 0.3f}, {0.66f, 0.90f, 0.1f},
    {0.54f, 0.55f, -0.3f}, {0.24f, 0.35f, -0.5f}};
enum { RINGS = sizeof PROFILE / sizeof PROFILE[0], SIDES = 10 };

Mesh *polyp_cup(float height, float youth, Error *e)
{
    Cup cup = {.mesh = mesh_new(4, RINGS * SIDES + 1, faces_of(RINGS, SIDES), MESH_BIRTH, e)};
    if (!cup.mesh) {
        return NULL;
    }
    for (int r = 0; r < RINGS; r++) {
        for (int k = 0; k < SIDES; k++) {
            float s, c, radius = 0.5f * PROFILE[r][0];
            exact_sincos(2.0f * PI_F * (float)k / SIDES, &s, &c);
            add_vertex(&cup, vec3(radius * c, height * PROFILE[r][1], -radius * s),
                       youth + PROFILE[r][2]);
        }
    }
    add_vertex(&cup, vec3(0, height * 0.4f, 0), youth - 0.5f);
    join_rings(&cup, 0, RINGS, SIDES);
    return finished(cup.mesh, e);
}

// ---- noses

// Likewise, of rounder walls, whose foot runs out along the skin; last: share of the septa.
static const float NOSE[][4] = {
    {2.10f, -0.16f, 0.00f, 0.0f}, {1.78f, -0.03f, 0.00f, 0.0f}, {1.50f, 0.04f, 0.00f, 0.0f},
    {1.28f, 0.11f, 0.00f, 0.0f},  {1.13f, 0.21f, 0.01f, 0.0f},  {1.05f, 0.36f, 0.03f, 0.0f},
    {1.02f, 0.56f, 0.08f, 0.0f},  {1.01f, 0.76f, 0.18f, 0.0f},  {0.98f, 0.89f, 0.30f, 0.0f},
    {0.92f, 0.96f, 0.38f, 0.0f},  {0.83f, 1.00f, 0.40f, 0.1f},  {0.73f, 0.98f, 0.34f, 0.3f},
    {0.65f, 0.91f, 0.08f, 0.7f},  {0.59f, 0.78f, -0.10f, 1.0f}, {0.53f, 0.58f, -0.30f, 1.0f},
    {0.34f, 0.44f, -0.42f, 0.6f}, {0.14f, 0.38f, -0.45f, 0.2f}};
enum { NOSE_RINGS = sizeof NOSE / sizeof NOSE[0], NOSE_SIDES = 36 };
enum { TENTACLES = 12, TENTACLE_RINGS = 6, TENTACLE_SIDES = 6 };

enum { STREAM_OVAL = 0, STREAM_LUMP = 1, STREAM_RIM = 2, STREAM_TENTACLE = 3 }; // of a nose's seed
enum { STREAM_LENGTH = 0, STREAM_TURN = 1, STREAM_SPREAD = 2 };                 // of a tentacle

// A point of the cup's axis and the directions across it.
typedef struct Bend {
    Vec3 middle, axis, side; // side: away from the branch's tip, as far as the bend allows
} Bend;

// The axis is an arc that leaves the foot along the normal.
static Bend bend_at(const NoseCup *nose, float along)
{
    float whole = nose->lean * RADIANS_PER_DEGREE, s, c;
    float up = fmaxf(along, 0.0f), angle = whole * fminf(up / nose->height, 1.2f);
    exact_sincos(angle, &s, &c);
    Bend bend = {.axis = vec3(0, c, -s), .side = vec3(0, s, c)};
    if (angle > 1e-3f) {
        float radius = nose->height / whole;
        bend.middle = vec3(0, radius * s, -radius * (1.0f - c));
    } else {
        bend.middle = vec3(0, along, 0);
    }
    return bend;
}

// Irregular outline: a factor on the radius, from -1 to 1 times `amount` off a circle.
static float outline(uint64_t seed, float turn, float amount)
{
    float oval, lump, s;
    exact_sincos(2.0f * turn + 2.0f * PI_F * random_unit(random_key(seed, STREAM_OVAL)), &s, &oval);
    exact_sincos(3.0f * turn + 2.0f * PI_F * random_unit(random_key(seed, STREAM_LUMP)), &s, &lump);
    return 1.0f + amount * (0.65f * oval + 0.35f * lump);
}

static Vec3 nose_point(const NoseCup *nose, int ring, float turn)
{
    const float *row = NOSE[ring];
    float s, c, six, wave;
    exact_sincos(turn, &s, &c);
    exact_sincos(6.0f * turn, &six, &wave);
    float wide = row[0] > 1.0f ? 1.0f + (row[0] - 1.0f) * nose->flare : row[0];
    float radius = 0.5f * wide * outline(nose->seed, turn, 0.11f);
    radius *= 1.0f - 0.3f * row[3] * smoothstepf(0.2f, 1.0f, wave); // septa
    // s: -1 on the inner side, +1 on the outer side
    float share = smoothstepf(0.1f, 0.9f, row[1]);
    float uneven = outline(random_key(nose->seed, STREAM_RIM), turn, 0.07f);
    float along = nose->height * row[1] *
                  (1.0f - share * (nose->oblique * 0.5f * (1.0f - s) + (1.0f - uneven)));
    Bend bend = bend_at(nose, along);
    Vec3 p = vec3_add(bend.middle, vec3_madd(vec3(radius * c, 0, 0), radius * s, bend.side));
    float foot = 1.0f - smoothstepf(-0.1f, 0.5f, row[1]);
    if (along < 0.0f) {
        p.y = along;
    }
    if (nose->girth > 0.0f) {
        p.y -= foot * 0.5f * p.x * p.x / nose->girth;
    }
    return p;
}

// A tentacle: it leaves the mouth along the axis and bends outward, with a round tip.
static void add_tentacle(Cup *cup, const NoseCup *nose, int number)
{
    uint64_t key = random_key(random_key(nose->seed, STREAM_TENTACLE), (uint64_t)number);
    float turn = 2.0f * PI_F / TENTACLES *
                 ((float)number + random_range(random_key(key, STREAM_TURN), -0.3f, 0.3f));
    float length = nose->reach * random_range(random_key(key, STREAM_LENGTH), 0.55f, 1.15f);
    float spread = random_range(random_key(key, STREAM_SPREAD), 0.5f, 1.3f);
    float s, c;
    exact_sincos(turn, &s, &c);
    float inner = 1.0f - nose->oblique * 0.5f * (1.0f - s);
    Bend bend = bend_at(nose, nose->height * inner);
    Vec3 out = vec3_madd(vec3(c, 0, 0), s, bend.side);
    Vec3 across = vec3_cross(out, bend.axis);
    uint32_t first = (uint32_t)cup->vertices;
    for (int r = 0; r < TENTACLE_RINGS; r++) {
        float t = (float)r / (TENTACLE_RINGS - 1), bow = spread * t;
        float radius = 0.085f * (r == TENTACLE_RINGS - 1 ? 0.45f : 1.0f - 0.45f * t);
        Vec3 middle = vec3_madd(bend.middle, 0.26f + length * 0.62f * bow * t, out);
        middle = vec3_madd(middle, length * t * (1.0f - 0.4f * bow) - 0.15f, bend.axis);
        for (int k = 0; k < TENTACLE_SIDES; k++) {
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (float)k / TENTACLE_SIDES, &sine, &cosine);
            Vec3 p = vec3_madd(middle, radius * cosine, out);
            add_vertex(cup, vec3_madd(p, -radius * sine, across), nose->youth + 0.5f * t * t);
        }
        if (r == TENTACLE_RINGS - 1) {
            add_vertex(cup, vec3_madd(middle, 0.4f * radius, bend.axis), nose->youth + 0.5f);
        }
    }
    join_rings(cup, first, TENTACLE_RINGS, TENTACLE_SIDES);
}

Mesh *polyp_nose(const NoseCup *nose, Error *e)
{
    int tentacles = nose->reach > 0.0f ? TENTACLES : 0;
    int64_t vertices =
        NOSE_RINGS * NOSE_SIDES + 1 + tentacles * (TENTACLE_RINGS * TENTACLE_SIDES + 1);
    int64_t faces =
        faces_of(NOSE_RINGS, NOSE_SIDES) + tentacles * faces_of(TENTACLE_RINGS, TENTACLE_SIDES);
    Cup cup = {.mesh = mesh_new(4, vertices, faces, MESH_BIRTH, e)};
    if (!cup.mesh) {
        return NULL;
    }
    for (int r = 0; r < NOSE_RINGS; r++) {
        for (int k = 0; k < NOSE_SIDES; k++) {
            float turn = -2.0f * PI_F * (float)k / NOSE_SIDES;
            add_vertex(&cup, nose_point(nose, r, turn), nose->youth + NOSE[r][2]);
        }
    }
    float floor = nose->height * NOSE[NOSE_RINGS - 1][1] * (1.0f - 0.5f * nose->oblique * 0.5f);
    add_vertex(&cup, bend_at(nose, floor).middle, nose->youth - 0.45f);
    join_rings(&cup, 0, NOSE_RINGS, NOSE_SIDES);
    for (int i = 0; i < tentacles; i++) {
        add_tentacle(&cup, nose, i);
    }
    return finished(cup.mesh, e);
}
