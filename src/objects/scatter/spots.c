// Random spots on the land or on a surface.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/scatter/search.h"

#define STEP 0.05f // m, of the land's slope

bool scatter_spot_on_land(const Search *s, uint64_t key, Spot *spot)
{
    const ScatteringParams *params = s->params;
    float u = random_unit(random_key(key, STREAM_RADIUS)), sine, cosine;
    float r = sqrtf(lerpf(params->inner * params->inner, params->radius * params->radius, u));
    exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine, &cosine);
    float x = params->center.x + r * sine, z = params->center.z + r * cosine;
    const Land *land = &s->around->land;
    float height = land_height(land, x, z);
    Vec3 normal = vec3(height - land_height(land, x + STEP, z), STEP,
                       height - land_height(land, x, z + STEP));
    *spot = (Spot){vec3(x, height, z), vec3_normalize(normal), key};
    return true;
}

static Vec3 corner(const Mesh *mesh, int64_t face, int number)
{
    return mesh->position[mesh->index[face * mesh->face_size + number]];
}

// Where the ball about the centre cuts a face's plane.
typedef struct Disc {
    Vec3 center, normal;
    float radius; // m; 0 = it does not
    bool smaller; // than the face: places are drawn in the disc then, so that a small patch of a
                  // wide face is found
} Disc;

static Disc disc_in_face(const ScatteringParams *params, const Vec3 c[3])
{
    Vec3 across = vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0]));
    Disc disc = {.normal = vec3_normalize(across)};
    float away = vec3_dot(vec3_sub(params->center, c[0]), disc.normal);
    float square = params->radius * params->radius - away * away;
    disc.center = vec3_madd(params->center, -away, disc.normal);
    disc.radius = params->radius > 0.0f && square > 0.0f ? sqrtf(square) : 0.0f;
    disc.smaller = disc.radius > 0.0f && PI_F * square < 0.5f * vec3_length(across);
    return disc;
}

// May the triangle reach into the shell where copies stand?
static bool may_be_near(const ScatteringParams *params, const Vec3 corner[3])
{
    Vec3 middle = vec3_scale(vec3_add(vec3_add(corner[0], corner[1]), corner[2]), 1.0f / 3.0f);
    float reach = 0.0f;
    for (int k = 0; k < 3; k++) {
        float r = vec3_distance(corner[k], middle);
        reach = r > reach ? r : reach;
    }
    float distance = vec3_distance(middle, params->center);
    if (reach > params->radius && params->radius > 0.0f &&
        !(disc_in_face(params, corner).radius > 0.0f)) {
        return false; // the sides of a wide slab
    }
    return distance + reach >= params->inner &&
           (params->radius == 0.0f || distance - reach <= params->radius);
}

// Where copies are in the mesh, they are no places of their own if things go on over them.
static bool is_own(const Search *s, const Vec3 corner[3])
{
    const HeightField *land = s->land;
    if (!s->ground || !land || s->copies == 0) {
        return true;
    }
    Vec3 middle = vec3_scale(vec3_add(vec3_add(corner[0], corner[1]), corner[2]), 1.0f / 3.0f);
    float x = (middle.x - land->origin.x) / land->cell.x;
    float z = (middle.z - land->origin.y) / land->cell.y;
    return x >= 0.0f && z >= 0.0f && x <= (float)(land->columns - 1) &&
           z <= (float)(land->rows - 1);
}

double *scatter_sum_areas(const Search *s, Error *e)
{
    const Mesh *mesh = s->surface->mesh;
    const ScatteringParams *params = s->params;
    double *area = memory_alloc(mesh->face_count, sizeof *area, e), sum = 0.0;
    for (int64_t i = 0; area && i < mesh->face_count; i++) {
        Vec3 c[3] = {corner(mesh, i, 0), corner(mesh, i, 1), corner(mesh, i, 2)};
        Vec3 across = vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0]));
        Disc disc = disc_in_face(params, c);
        double drawn = disc.smaller ? (double)(PI_F * disc.radius * disc.radius)
                                    : 0.5 * (double)vec3_length(across);
        sum += may_be_near(params, c) && is_own(s, c) ? drawn : 0.0;
        area[i] = sum;
    }
    return area;
}

static int64_t find_face(const double *area, int64_t count, double wanted)
{
    int64_t low = 0, high = count - 1;
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        if (area[middle] > wanted) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static Vec3 point_in_disc(const Disc *disc, float u, float v)
{
    float sine, cosine, r = disc->radius * sqrtf(u);
    exact_sincos(2.0f * PI_F * v, &sine, &cosine);
    Vec3 x = vec3_perpendicular(disc->normal), z = vec3_cross(disc->normal, x);
    return vec3_madd(vec3_madd(disc->center, r * cosine, x), r * sine, z);
}

static bool is_in_face(const Vec3 c[3], Vec3 normal, Vec3 p)
{
    for (int k = 0; k < 3; k++) {
        Vec3 edge = vec3_sub(c[(k + 1) % 3], c[k]);
        if (vec3_dot(vec3_cross(edge, vec3_sub(p, c[k])), normal) < 0.0f) {
            return false;
        }
    }
    return true;
}

bool scatter_spot_on_surface(const Search *s, uint64_t key, Spot *spot)
{
    const Mesh *mesh = s->surface->mesh;
    double all = s->area[mesh->face_count - 1];
    double wanted = all * (double)random_unit(random_key(key, STREAM_FACE));
    int64_t face = find_face(s->area, mesh->face_count, wanted);
    float u = random_unit(random_key(key, STREAM_ACROSS));
    float v = random_unit(random_key(key, STREAM_ALONG));
    Vec3 c[3] = {corner(mesh, face, 0), corner(mesh, face, 1), corner(mesh, face, 2)};
    Disc disc = disc_in_face(s->params, c);
    *spot = (Spot){.normal = disc.normal, .key = key};
    if (disc.smaller) {
        spot->p = point_in_disc(&disc, u, v);
        return is_in_face(c, disc.normal, spot->p);
    }
    float across = sqrtf(u);
    spot->p = vec3_add(vec3_scale(c[0], 1.0f - across),
                       vec3_lerp(vec3_scale(c[1], across), vec3_scale(c[2], across), v));
    return true;
}
