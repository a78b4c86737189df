#include "objects/coral/polyps.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/coral/polyp_forms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_BARYCENTRIC_A = 0, STREAM_BARYCENTRIC_B = 1 }; // of a place
enum { STREAM_ROUNDING = 0, STREAM_DRAWS = 1 };              // of a triangle; DRAWS + i: draw i

#define AXIAL_SIZE 1.5f      // diameter of an axial cup, in those of the others
#define AXIAL_RISE 0.7f      // of its foot above a branch's last node, in the branch's radii
#define AXIAL_NOSE_SIZE 1.9f // likewise, of noses
#define AXIAL_NOSE_RISE (-0.4f)

enum { TRIES = 6 };

#define FILL_GAP 0.58f  // of small cups from the others, in spacings
#define FILL_SIZE 0.55f // their diameter in those of the others

// The cups so far, in a hash table of cells a spacing wide.
#define POLYP_BYTES (1.5 * sizeof(PolypPlace) + 3.0 * sizeof(int32_t) + sizeof(Transform) + 100.0)

typedef struct Spread {
    PolypPlace *place;
    int64_t count, capacity;
    int32_t *bucket, *next; // heads of chains; next per place
    int64_t buckets, next_capacity;
    float spacing; // of the cells
    float gap;     // m, least distance between new cups and others; at most the spacing
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
            if (vec3_distance(s->place[i].position, p) < s->gap) {
                return false;
            }
        }
    }
    return true;
}

static bool put(Spread *s, PolypPlace place, Error *e)
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

static PolypPlace place_on(const Mesh *mesh, const Facet *f, uint64_t key)
{
    float a = sqrtf(random_unit(random_key(key, STREAM_BARYCENTRIC_A))),
          b = random_unit(random_key(key, STREAM_BARYCENTRIC_B));
    const float w[3] = {1.0f - a, a * (1.0f - b), a * b};
    PolypPlace place = {.along = f->along, .size = 1.0f};
    for (int i = 0; i < 3; i++) {
        place.position = vec3_madd(place.position, w[i], mesh->position[f->v[i]]);
        place.normal = vec3_madd(place.normal, w[i], mesh->normal[f->v[i]]);
        place.youth += w[i] * (mesh->birth ? mesh->birth[f->v[i]] : 0.0f);
    }
    place.normal = vec3_normalize(place.normal);
    return place;
}

// One round over a skin.
typedef struct Round {
    uint64_t number;
    float tries; // draws in the square of a gap, halved
    float size;  // of the cups, relative to the others
    int64_t most;
} Round;

// Dart throwing, face by face in a fixed order, each draw keyed by face and number.
static bool throw_round(Spread *s, const Mesh *mesh, Round round, const PolypPlaces *places,
                        const Run *run, Error *e)
{
    int64_t triangles = mesh->face_count * (mesh->face_size - 2);
    float per_area = round.tries / (s->gap * s->gap);
    for (int64_t t = 0; t < triangles; t++) {
        if (!run_goes_on(run, t, e)) {
            return false;
        }
        Facet f = facet_of(mesh, t);
        uint64_t key = random_key(random_key(places->seed, (uint64_t)t), round.number);
        float wanted = 0.5f * f.area * per_area;
        int64_t draws = (int64_t)wanted;
        draws += random_unit(random_key(key, STREAM_ROUNDING)) < wanted - (float)draws;
        for (int64_t i = 0; i < draws && s->count < round.most; i++) {
            if (!run_goes_on(run, i, e)) {
                return false;
            }
            PolypPlace place = place_on(mesh, &f, random_key(key, STREAM_DRAWS + (uint64_t)i));
            place.size = round.size;
            if (place.position.y > places->floor && is_free(s, place.position) &&
                !put(s, place, e)) {
                return false;
            }
        }
    }
    return true;
}

// Spreads the cups in two rounds, so that late faces get some too, then small ones between them.
static bool spread_over(Spread *s, const Mesh *mesh, const PolypPlaces *places, const Run *run,
                        Error *e)
{
    s->gap = s->spacing;
    for (uint64_t number = 0; number < 2; number++) {
        Round round = {number, TRIES, 1.0f, INT64_MAX};
        if (!throw_round(s, mesh, round, places, run, e)) {
            return false;
        }
    }
    s->gap = FILL_GAP * s->spacing;
    Round fill = {2, TRIES * places->fill, FILL_SIZE, places->max_count};
    return places->fill <= 0.0f || throw_round(s, mesh, fill, places, run, e);
}

// An axial cup at the end of each branch, from which the branch grows, at most max_count.
static bool put_axial(Spread *s, const PolypPlaces *places, const Run *run, Error *e)
{
    const OutTree *tree = places->tree;
    bool tube = places->shape == POLYP_TUBE;
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
        float rise = (tube ? AXIAL_RISE : AXIAL_NOSE_RISE) * tree->radius[i];
        PolypPlace place = {.position = vec3_madd(tree->position[i], rise, out),
                            .normal = out,
                            .youth = 1.0f,
                            .size = tube ? AXIAL_SIZE : AXIAL_NOSE_SIZE,
                            .axial = true};
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

// form_of: of each cup.
static bool add_form(const Spread *s, const int32_t *form_of, const PolypPlaces *places, int form,
                     const Placing *placing, int role, Error *e)
{
    Part part = {0};
    int64_t count = 0;
    for (int64_t i = 0; i < s->count; i++) {
        count += form_of[i] == form;
    }
    if (count == 0) {
        return true;
    }
    part.mesh = polyp_form_mesh(form, places, e);
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
        if (form_of[i] == form) {
            uint64_t key = random_key(places->seed, (uint64_t)i);
            part.instance[part.instance_count++] = polyp_frame(&s->place[i], places, key);
        }
    }
    return placing_add(placing, part, role, e);
}

static bool add_forms(const Spread *s, const PolypPlaces *places, const Placing *placing, int role,
                      Error *e)
{
    int32_t *form_of = memory_alloc(s->count, sizeof *form_of, e);
    for (int64_t i = 0; form_of && i < s->count; i++) {
        uint64_t key = random_key(places->seed, (uint64_t)i);
        form_of[i] = polyp_form(&s->place[i], places, key);
    }
    bool done = form_of;
    for (int form = 0; done && form < polyp_form_count(places); form++) {
        done = add_form(s, form_of, places, form, placing, role, e);
    }
    free(form_of);
    return done;
}

bool polyps_add(const Mesh *skin, const PolypPlaces *places, const Placing *placing, int role,
                Error *e)
{
    double area = area_of(skin), most = (double)places->max_count;
    // dart throwing fills about 0.7 of a plane's places
    double fitting = 0.7 * area / ((double)places->spacing * (double)places->spacing);
    Spread s = {.spacing = places->spacing * (float)(fitting > most ? sqrt(fitting / most) : 1.0)};
    s.gap = s.spacing;
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
               spread_over(&s, skin, places, placing->recipe->run, e) &&
               add_forms(&s, places, placing, role, e);
    }
    free(s.bucket);
    free(s.next);
    free(s.place);
    return done;
}
