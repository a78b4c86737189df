#include "objects/coral/polyps.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_BARYCENTRIC_A = 0, STREAM_BARYCENTRIC_B = 1 };  // of a place
enum { STREAM_ROUNDING = 0, STREAM_DRAWS = 1 };               // of a triangle; DRAWS + i: draw i
enum { STREAM_LEAN = 2, STREAM_SIZE = 3, STREAM_HEIGHT = 4 }; // of a cup

#define AXIAL_SIZE 1.5f // diameter of an axial cup, in those of the others
#define AXIAL_RISE 0.7f // of its foot above a branch's last node, in the branch's radii

enum { AGES = 5, SIDES = 10, TRIES = 6 };

// A foot that widens into the tissue, outer wall, rim, inner wall, floor: radius and height as
// shares of the rim's radius and of the cup's height; offset of its youth from the skin's.
static const float PROFILE[][3] = {
    {1.50f, -0.25f, 0.0f}, {1.24f, 0.06f, 0.0f}, {1.06f, 0.28f, 0.0f}, {0.97f, 0.58f, 0.05f},
    {0.98f, 0.86f, 0.15f}, {0.91f, 0.98f, 0.3f}, {0.80f, 1.00f, 0.3f}, {0.66f, 0.90f, 0.1f},
    {0.54f, 0.55f, -0.3f}, {0.24f, 0.35f, -0.5f}};
enum { RINGS = sizeof PROFILE / sizeof PROFILE[0] };

Mesh *polyp_cup(float height, float youth, Error *e)
{
    Mesh *cup = mesh_new(4, RINGS * SIDES + 1, (RINGS - 1) * SIDES + SIDES / 2, MESH_BIRTH, e);
    if (!cup) {
        return NULL;
    }
    for (int r = 0; r < RINGS; r++) {
        for (int k = 0; k < SIDES; k++) {
            float s, c, radius = 0.5f * PROFILE[r][0];
            exact_sincos(2.0f * PI_F * (float)k / SIDES, &s, &c);
            cup->position[r * SIDES + k] = vec3(radius * c, height * PROFILE[r][1], -radius * s);
            cup->birth[r * SIDES + k] = clampf(youth + PROFILE[r][2], 0.0f, 1.0f);
        }
    }
    cup->position[RINGS * SIDES] = vec3(0, height * 0.4f, 0);
    cup->birth[RINGS * SIDES] = clampf(youth - 0.5f, 0.0f, 1.0f);
    uint32_t *index = cup->index;
    for (int r = 0; r + 1 < RINGS; r++) {
        for (int k = 0; k < SIDES; k++) {
            uint32_t a = (uint32_t)(r * SIDES + k), b = (uint32_t)(r * SIDES + (k + 1) % SIDES);
            const uint32_t quad[4] = {a, b, b + SIDES, a + SIDES};
            memcpy(index, quad, sizeof quad);
            index += 4;
        }
    }
    for (uint32_t k = 0; k < SIDES; k += 2) { // the floor, two sides a quad
        const uint32_t last = (RINGS - 1) * SIDES;
        const uint32_t quad[4] = {last + k, last + k + 1, last + (k + 2) % SIDES, RINGS * SIDES};
        memcpy(index, quad, sizeof quad);
        index += 4;
    }
    if (!mesh_compute_normals(cup, e)) {
        mesh_free(cup);
        return NULL;
    }
    return cup;
}

// A place for a cup.
typedef struct Place {
    Vec3 position, normal, along; // along: toward the tip; zero when unknown
    float youth;
    float size; // relative to the other cups
} Place;

// The cups so far, in a hash table of cells a spacing wide.
#define POLYP_BYTES (1.5 * sizeof(Place) + 3.0 * sizeof(int32_t) + sizeof(Transform) + 100.0)

typedef struct Spread {
    Place *place;
    int64_t count, capacity;
    int32_t *bucket, *next; // heads of chains; next per place
    int64_t buckets, next_capacity;
    float spacing;
} Spread;

static int64_t bucket_of(const Spread *s, int64_t x, int64_t y, int64_t z)
{
    uint64_t key = random_key(random_key((uint64_t)x, (uint64_t)y), (uint64_t)z);
    return (int64_t)(key % (uint64_t)s->buckets);
}

static int64_t cell_of(float x, float spacing)
{
    float q = x / spacing;
    int64_t i = (int64_t)q;
    return (float)i > q ? i - 1 : i;
}

static bool is_free(const Spread *s, Vec3 p)
{
    int64_t x = cell_of(p.x, s->spacing), y = cell_of(p.y, s->spacing),
            z = cell_of(p.z, s->spacing);
    for (int64_t k = 0; k < 27; k++) {
        int64_t b = bucket_of(s, x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1);
        for (int32_t i = s->bucket[b]; i >= 0 && s->next; i = s->next[i]) {
            if (vec3_distance(s->place[i].position, p) < s->spacing) {
                return false;
            }
        }
    }
    return true;
}

static bool put(Spread *s, Place place, Error *e)
{
    if (!memory_reserve(&s->place, &s->capacity, s->count + 1, sizeof *s->place, e) ||
        !memory_reserve(&s->next, &s->next_capacity, s->count + 1, sizeof *s->next, e)) {
        return false;
    }
    int64_t b =
        bucket_of(s, cell_of(place.position.x, s->spacing), cell_of(place.position.y, s->spacing),
                  cell_of(place.position.z, s->spacing));
    s->next[s->count] = s->bucket[b];
    s->bucket[b] = (int32_t)s->count;
    s->place[s->count++] = place;
    return true;
}

// One triangle of the skin.
typedef struct Facet {
    uint32_t v[3];
    float area;
    Vec3 along; // dP/dv, unit; zero without uv
} Facet;

static Facet facet_of(const Mesh *mesh, int64_t triangle)
{
    int per_face = mesh->face_size - 2;
    const uint32_t *corner = mesh->index + triangle / per_face * mesh->face_size;
    int64_t k = triangle % per_face;
    Facet f = {.v = {corner[0], corner[k + 1], corner[k + 2]}};
    Vec3 a = mesh->position[f.v[0]];
    Vec3 u = vec3_sub(mesh->position[f.v[1]], a), v = vec3_sub(mesh->position[f.v[2]], a);
    f.area = 0.5f * vec3_length(vec3_cross(u, v));
    if (mesh->uv) {
        Vec2 o = mesh->uv[f.v[0]], p = mesh->uv[f.v[1]], q = mesh->uv[f.v[2]];
        float du1 = p.x - o.x, dv1 = p.y - o.y, du2 = q.x - o.x, dv2 = q.y - o.y;
        float det = du1 * dv2 - du2 * dv1;
        Vec3 along = vec3_sub(vec3_scale(v, du1), vec3_scale(u, du2));
        f.along = det < 0.0f ? vec3_neg(vec3_normalize(along)) : vec3_normalize(along);
    }
    return f;
}

static Place place_on(const Mesh *mesh, const Facet *f, uint64_t key)
{
    float a = sqrtf(random_unit(random_key(key, STREAM_BARYCENTRIC_A))),
          b = random_unit(random_key(key, STREAM_BARYCENTRIC_B));
    const float w[3] = {1.0f - a, a * (1.0f - b), a * b};
    Place place = {.along = f->along, .size = 1.0f};
    for (int i = 0; i < 3; i++) {
        place.position = vec3_madd(place.position, w[i], mesh->position[f->v[i]]);
        place.normal = vec3_madd(place.normal, w[i], mesh->normal[f->v[i]]);
        place.youth += w[i] * (mesh->birth ? mesh->birth[f->v[i]] : 0.0f);
    }
    place.normal = vec3_normalize(place.normal);
    return place;
}

// Dart throwing, face by face in a fixed order, each draw keyed by face and number.
static bool spread_over(Spread *s, const Mesh *mesh, const PolypPlaces *places, const Run *run,
                        Error *e)
{
    int64_t triangles = mesh->face_count * (mesh->face_size - 2);
    float per_area = (float)TRIES / (s->spacing * s->spacing);
    for (uint64_t round = 0; round < 2; round++) { // twice, so that late faces get cups too
        for (int64_t t = 0; t < triangles; t++) {
            if (!run_goes_on(run, t, e)) {
                return false;
            }
            Facet f = facet_of(mesh, t);
            uint64_t key = random_key(random_key(places->seed, (uint64_t)t), round);
            float wanted = 0.5f * f.area * per_area;
            int64_t draws = (int64_t)wanted;
            draws += random_unit(random_key(key, STREAM_ROUNDING)) < wanted - (float)draws;
            for (int64_t i = 0; i < draws; i++) {
                if (!run_goes_on(run, i, e)) {
                    return false;
                }
                Place place = place_on(mesh, &f, random_key(key, STREAM_DRAWS + (uint64_t)i));
                if (place.position.y > places->floor && is_free(s, place.position) &&
                    !put(s, place, e)) {
                    return false;
                }
            }
        }
    }
    return true;
}

// An axial cup at the end of each branch, from which the branch grows, at most max_count.
static bool put_axial(Spread *s, const PolypPlaces *places, const Run *run, Error *e)
{
    const OutTree *tree = places->tree;
    bool *is_parent = memory_alloc_zero(tree->count, sizeof *is_parent, e);
    bool done = is_parent;
    for (int64_t i = 0; done && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            is_parent[tree->parent[i]] = true;
        }
    }
    for (int64_t i = 0; done && i < tree->count && s->count < places->max_count; i++) {
        int32_t parent = tree->parent[i];
        done = run_goes_on(run, i, e);
        if (!done || is_parent[i] || parent < 0) {
            continue;
        }
        Vec3 out = vec3_normalize(vec3_sub(tree->position[i], tree->position[parent]));
        Place place = {.position = vec3_madd(tree->position[i], AXIAL_RISE * tree->radius[i], out),
                       .normal = out,
                       .youth = 1.0f,
                       .size = AXIAL_SIZE};
        done = !is_free(s, place.position) || put(s, place, e);
    }
    free(is_parent);
    return done;
}

static double area_of(const Mesh *mesh)
{
    double sum = 0.0;
    for (int64_t t = 0; t < mesh->face_count * (mesh->face_size - 2); t++) {
        sum += (double)facet_of(mesh, t).area;
    }
    return sum;
}

// The cup's frame: axis +Y, leaned from the normal toward the tip, random size.
static Transform cup_frame(const Place *place, const PolypPlaces *places, uint64_t key)
{
    float s, c;
    float lean = places->lean * (1.0f - 0.7f * place->youth) *
                 random_range(random_key(key, STREAM_LEAN), 0.8f, 1.15f);
    exact_sincos(lean * RADIANS_PER_DEGREE, &s, &c);
    Vec3 along = vec3_madd(place->along, -vec3_dot(place->along, place->normal), place->normal);
    bool known = vec3_dot(along, along) > 1e-6f;
    along = known ? vec3_normalize(along) : vec3_perpendicular(place->normal);
    Vec3 y = known ? vec3_madd(vec3_scale(place->normal, c), s, along) : place->normal;
    Vec3 x = vec3_normalize(vec3_cross(along, place->normal)), z = vec3_cross(x, y);
    float size =
        place->size * places->diameter * random_range(random_key(key, STREAM_SIZE), 0.75f, 1.15f);
    float tall = size * random_range(random_key(key, STREAM_HEIGHT), 0.6f, 1.25f);
    return transform_from_axes(vec3_scale(x, size), vec3_scale(y, tall), vec3_scale(z, size),
                               place->position);
}

static bool add_age(const Spread *s, const PolypPlaces *places, int age, const Placing *placing,
                    int role, Error *e)
{
    Part part = {0};
    int64_t count = 0;
    for (int64_t i = 0; i < s->count; i++) {
        count += (int)(s->place[i].youth * ((float)AGES - 0.01f)) == age;
    }
    if (count == 0) {
        return true;
    }
    float height = places->height / places->diameter;
    part.mesh = polyp_cup(height, ((float)age + 0.5f) / AGES, e);
    part.instance = part.mesh ? memory_alloc(count, sizeof *part.instance, e) : NULL;
    if (!part.instance) {
        mesh_free(part.mesh);
        return false;
    }
    for (int64_t i = 0; i < s->count; i++) {
        if (!run_goes_on(placing->recipe->run, i, e)) {
            mesh_free(part.mesh);
            free(part.instance);
            return false;
        }
        if ((int)(s->place[i].youth * ((float)AGES - 0.01f)) == age) {
            part.instance[part.instance_count++] =
                cup_frame(&s->place[i], places, random_key(places->seed, (uint64_t)i));
        }
    }
    return placing_add(placing, part, role, e);
}

bool polyps_add(const Mesh *skin, const PolypPlaces *places, const Placing *placing, int role,
                Error *e)
{
    double area = area_of(skin), most = (double)places->max_count;
    // dart throwing fills about 0.7 of a plane's places
    double fitting = 0.7 * area / ((double)places->spacing * (double)places->spacing);
    Spread s = {.spacing = places->spacing * (float)(fitting > most ? sqrt(fitting / most) : 1.0)};
    s.buckets = (int64_t)(fitting > most ? most : fitting) * 2 + 64;
    double count = fitting > most ? most : fitting;
    if (!memory_check(count * POLYP_BYTES, e, "%.0f cups (polyps.max_count allows %.0f)", count,
                      most)) {
        return false;
    }
    s.bucket = memory_alloc(s.buckets, sizeof *s.bucket, e);
    bool done = s.bucket;
    if (done) {
        memset(s.bucket, -1, (size_t)s.buckets * sizeof *s.bucket);
        done = (!places->tree || put_axial(&s, places, placing->recipe->run, e)) &&
               spread_over(&s, skin, places, placing->recipe->run, e);
    }
    for (int age = 0; done && age < AGES; age++) {
        done = add_age(&s, places, age, placing, role, e);
    }
    free(s.bucket);
    free(s.next);
    free(s.place);
    return done;
}
