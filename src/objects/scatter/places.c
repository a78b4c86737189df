// Where copies stand: random places, of which those are kept that the parameters allow.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "land/height_raster.h"
#include "objects/scatter/ground.h"
#include "objects/scatter/scatter.h"
#include "shape/point_hash.h"

#include <stdlib.h>

// Of the object's seed; PATCHES + i: of thing i.
enum { STREAM_PLACES = 1, STREAM_PATCHES = 10 };
// Of a place.
enum {
    STREAM_RADIUS = 1,
    STREAM_AZIMUTH = 2,
    STREAM_FACE = 3,
    STREAM_ACROSS = 4,
    STREAM_ALONG = 5,
    STREAM_THING = 6,
    STREAM_VARIANT = 7,
    STREAM_PATCH = 8,
    STREAM_SIZE = 9,
    STREAM_TURN = 10,
    STREAM_WHERE = 11,
    STREAM_TILT = 12,
    STREAM_TILT_AZIMUTH = 13,
    STREAM_STRETCH = 14,
    STREAM_COPIES = 15 // + i: of the place on copy i of the surface
};

enum { TRIES = 40 }; // for each copy, at most
#define STEP 0.05f   // m, of the land's slope

typedef struct Search {
    const ScatteringParams *params;
    const Surroundings *around;
    const ShapeSurface *surface; // NULL = the land
    double *area;                // m^2, of the surface's faces 0 .. i; NULL with the land
    PointHash *taken;            // NULL = places may be as near as they like
    const HeightField *land;     // of the terrain they stand on; NULL = none, or not known
    Where where;                 // maps that places are chosen by
    const HeightField *wet; // the land that tells where its water is; NULL = unknown, or by_depth
    bool by_depth;          // conditions on the water's depth decide
    int copies;             // of the surface, on which they stand, too
    ScatterGround *ground;  // of a surface with copies in its mesh; else NULL
    uint64_t seed;
} Search;

typedef struct Spot {
    Vec3 p, normal;
    uint64_t key;
} Spot;

// ---- candidates

static bool spot_on_land(const Search *s, uint64_t key, Spot *spot)
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

// Sums of the areas in which places are drawn for the surface's faces, 0 for those too far away.
static double *sum_areas(const Search *s, Error *e)
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

// False if the place that was drawn is beside the face.
static bool spot_on_surface(const Search *s, uint64_t key, Spot *spot)
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

// ---- which are kept

static bool within(float value, const float range[2])
{
    return value >= range[0] && value <= range[1];
}

// Is the place under the water of the land itself, a lake or a river? With copies in its mesh,
// which the record of levels does not reach, under the water that is drawn.
static bool is_under_water(const Search *s, const HeightField *land, Vec3 p)
{
    if (!land || !land->water) {
        return false;
    }
    if (s->ground) {
        return p.y < scatter_ground_water(s->ground, p);
    }
    float u = (p.x - land->origin.x) / land->cell.x, v = (p.z - land->origin.y) / land->cell.y;
    int64_t column = (int64_t)(clampf(u, 0.0f, (float)(land->columns - 1)) + 0.5f);
    int64_t row = (int64_t)(clampf(v, 0.0f, (float)(land->rows - 1)) + 0.5f);
    return p.y < land->water[row * land->columns + column];
}

static bool covered(const Search *s, const HeightField *land, Vec3 p)
{
    return flood_covers(s->around->flood, p) || is_under_water(s, land, p);
}

// The surface of the water at a place under it, m.
static float surface_over(const Search *s, Vec3 p)
{
    enum { HALVINGS = 30 };
    float low = p.y, wide = 0.1f; // covered; and this far above it perhaps not
    for (int i = 0; i < HALVINGS && covered(s, s->land, vec3(p.x, low + wide, p.z)); i++) {
        low += wide;
        wide *= 2.0f;
    }
    for (int i = 0; i < HALVINGS; i++) {
        wide *= 0.5f;
        low += covered(s, s->land, vec3(p.x, low + wide, p.z)) ? wide : 0.0f;
    }
    return low;
}

static bool suits_water(const Search *s, Vec3 p)
{
    bool in_water = s->params->in_water;
    return (s->by_depth && in_water) || covered(s, s->wet, p) == in_water;
}

static bool is_allowed(const Search *s, const Spot *spot)
{
    const ScatteringParams *params = s->params;
    float distance = vec3_distance(spot->p, params->center);
    float slope = exact_acos(clampf(spot->normal.y, -1.0f, 1.0f)) / RADIANS_PER_DEGREE;
    bool near = !s->surface || (distance >= params->inner &&
                                (params->radius == 0.0f || distance <= params->radius));
    return near && within(slope, params->slope) && within(spot->p.y, params->altitude) &&
           suits_water(s, spot->p) &&
           random_unit(random_key(spot->key, STREAM_WHERE)) < where_share(&s->where, spot->p);
}

// Each thing has patches of its own.
static bool is_in_patch(const Search *s, const Spot *spot, int thing)
{
    uint64_t key = random_key(s->seed, STREAM_PATCHES + (uint64_t)thing);
    float scale = 1.0f / s->params->clump_size;
    float patch = noise_plane_fractal(spot->p.x * scale, spot->p.z * scale, 3, key);
    float keep = 1.0f - s->params->clumping * smoothstepf(0.25f, -0.05f, patch);
    return random_unit(random_key(spot->key, STREAM_PATCH)) < keep;
}

// Takes the place if no other is too near.
static bool take(const Search *s, const Spot *spot, bool *taken, Error *e)
{
    float least = s->params->spacing;
    Vec3 nearest;
    *taken = !s->taken || !point_hash_nearest(s->taken, spot->p, &least, &nearest);
    return !s->taken || !*taken || point_hash_add(s->taken, spot->p, e);
}

// Leans a direction to any side, at most by the tilt.
static Vec3 leaning(const ScatteringParams *params, const Spot *spot, Vec3 up)
{
    float lean = random_range(random_key(spot->key, STREAM_TILT), 0.0f, params->tilt);
    float azimuth = random_range(random_key(spot->key, STREAM_TILT_AZIMUTH), 0.0f, 2.0f * PI_F);
    float sine, cosine;
    exact_sincos(azimuth, &sine, &cosine);
    Vec3 axis = vec3_rotate(vec3_perpendicular(up), up, cosine, sine);
    exact_sincos(lean * RADIANS_PER_DEGREE, &sine, &cosine);
    return vec3_rotate(up, axis, cosine, sine);
}

static Transform stand(const ScatteringParams *params, const Spot *spot)
{
    float size =
        random_range(random_key(spot->key, STREAM_SIZE), params->scale[0], params->scale[1]);
    float sine, cosine;
    exact_sincos(random_range(random_key(spot->key, STREAM_TURN), 0.0f, 2.0f * PI_F), &sine,
                 &cosine);
    Vec3 up = vec3_lerp(vec3(0, 1, 0), spot->normal, params->align);
    up = vec3_dot(up, up) > 1e-6f ? vec3_normalize(up) : spot->normal;
    up = params->tilt > 0.0f ? leaning(params, spot, up) : up;
    float stretch =
        random_range(random_key(spot->key, STREAM_STRETCH), params->stretch[0], params->stretch[1]);
    Vec3 x = vec3_cross(up, vec3(sine, 0.0f, cosine));
    x = vec3_dot(x, x) > 1e-6f ? vec3_normalize(x) : vec3_perpendicular(up);
    return transform_from_axes(vec3_scale(x, size), vec3_scale(up, size * stretch),
                               vec3_scale(vec3_cross(x, up), size),
                               vec3_madd(spot->p, -size * params->sink, up));
}

// ---- maps

// The land under the disc, with a margin for what the maps look at around a sample.
static HeightField *sample_land(const ScatteringParams *params, const Land *land, Error *e)
{
    float half = 1.05f * params->radius, cell = 2.0f * half / (float)(HEIGHT_MAP_SIDE - 1);
    Vec2 origin = {params->center.x - half, params->center.z - half};
    HeightField *field =
        height_field_new(HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, (Vec2){cell, cell}, origin, e);
    for (int64_t i = 0; field && i < height_field_count(field); i++) {
        int column = (int)(i % HEIGHT_MAP_SIDE), row = (int)(i / HEIGHT_MAP_SIDE);
        field->height[i] =
            land_height(land, origin.x + (float)column * cell, origin.y + (float)row * cell);
    }
    return field;
}

static bool draw_maps(Search *s, const Recipe *recipe, Error *e)
{
    const ScatteringParams *params = s->params;
    if (params->where_count == 0) {
        return true;
    }
    HeightField *own = NULL;
    if (!recipe->land) {
        own = s->surface ? height_field_of_mesh(s->surface->mesh, HEIGHT_MAP_SIDE, e)
                         : sample_land(params, &s->around->land, e);
    }
    const HeightField *land = recipe->land ? recipe->land : own;
    bool done =
        land && where_init(&s->where, params->where, params->where_count, land, recipe->run, e);
    height_field_free(own);
    return done;
}

static bool has_depth_condition(const ScatteringParams *params)
{
    bool any = false;
    for (int i = 0; i < params->where_count; i++) {
        any |= params->where[i].map == HEIGHT_MAP_WATER_DEPTH;
    }
    return any;
}

// ---- all of them

int scatter_copies(const ScatteringParams *params, const ShapeSurface *surface)
{
    int count = 0;
    while (surface && count < surface->copy_count && surface->copy[count].ring <= params->beyond) {
        count++;
    }
    return count;
}

static bool search_begin(Search *s, const Recipe *recipe, Error *e)
{
    const ShapeSurface *surface = s->surface;
    bool grounded = surface && surface->copy_count > 0 && surface->copy->in_mesh;
    s->ground = grounded ? scatter_ground_new(surface, s->copies > 0, e) : NULL;
    s->area = surface ? sum_areas(s, e) : NULL;
    bool spaced = s->params->spacing > 0.0f;
    s->taken = spaced ? point_hash_new(s->params->spacing, e) : NULL;
    return (s->ground || !grounded) && (s->area || !surface) && (s->taken || !spaced) &&
           draw_maps(s, recipe, e);
}

// One of the thing's individuals.
static int variant_of(const Search *s, int thing, uint64_t key)
{
    int variants = s->params->things.variants;
    return thing * variants + (int)(random_unit(random_key(key, STREAM_VARIANT)) * (float)variants);
}

static void add_place(ThingPlaces *places, const ScatteringParams *params, const Spot *spot,
                      int thing)
{
    places->thing[places->count] = thing;
    places->place[places->count++] = stand(params, spot);
}

// Lifts what floats to the water's surface.
static void let_float(const Search *s, Spot *spot)
{
    if (s->params->afloat) {
        spot->p.y = surface_over(s, spot->p);
        spot->normal = vec3(0, 1, 0);
    }
}

// The same place on copy i of the surface. False: the copy has ground and water of its own, which
// do not suit what stands there.
static bool spot_on_copy(const Search *s, int i, const Spot *spot, Spot *there)
{
    const Transform *copy = &s->surface->copy[i].place;
    uint64_t key = random_key(spot->key, STREAM_COPIES + (uint64_t)i);
    // a mirror keeps lengths, so that it carries normals as it does directions
    *there = (Spot){transform_point(copy, spot->p), transform_vector(copy, spot->normal), key};
    if (!s->ground) {
        return true;
    }
    if (!scatter_ground_find(s->ground, &there->p, &there->normal) || !suits_water(s, there->p)) {
        return false;
    }
    let_float(s, there);
    return true;
}

// On the surface's copies another individual stands.
static void add_beyond(ThingPlaces *places, const Search *s, const Spot *spot, int thing)
{
    for (int i = 0; i < s->copies; i++) {
        Spot there;
        if (spot_on_copy(s, i, spot, &there)) {
            add_place(places, s->params, &there, variant_of(s, thing, there.key));
        }
    }
}

static bool search(const Search *s, ThingPlaces *places, int64_t *settled, const Run *run, Error *e)
{
    const ScatteringParams *params = s->params;
    uint64_t seed = random_key(s->seed, STREAM_PLACES);
    for (int64_t i = 0; i < TRIES * params->count && *settled < params->count; i++) {
        if (!run_goes_on(run, i, e)) {
            return false;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        Spot spot;
        bool found = s->surface ? spot_on_surface(s, key, &spot) : spot_on_land(s, key, &spot);
        int thing = things_choose(&params->things, random_unit(random_key(key, STREAM_THING)));
        bool taken = false;
        if (!found || !is_allowed(s, &spot) || !is_in_patch(s, &spot, thing)) {
            continue;
        }
        if (!take(s, &spot, &taken, e)) {
            return false;
        }
        if (taken) {
            let_float(s, &spot);
            add_place(places, params, &spot, variant_of(s, thing, key));
            add_beyond(places, s, &spot, thing);
            ++*settled;
        }
    }
    return true;
}

bool scatter_places_init(ThingPlaces *places, const ScatteringParams *params, const Recipe *recipe,
                         const Surroundings *around, int64_t *settled, Error *e)
{
    *settled = 0;
    Search s = {
        .params = params, .around = around, .surface = recipe->surface, .seed = recipe->seed};
    s.land = recipe->land;
    s.by_depth = has_depth_condition(params);
    s.copies = scatter_copies(params, s.surface);
    s.wet = recipe->land && recipe->land->water && !s.by_depth ? recipe->land : NULL;
    bool done = thing_places_alloc(places, params->count * (1 + s.copies), e) &&
                search_begin(&s, recipe, e) && search(&s, places, settled, recipe->run, e);
    point_hash_free(s.taken);
    where_free(&s.where);
    scatter_ground_free(s.ground);
    free(s.area);
    return done;
}
