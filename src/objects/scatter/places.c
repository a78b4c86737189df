// Where copies stand: random spots, of which those are kept that the parameters allow.
#include "base/exact_math.h"
#include "base/random.h"
#include "land/height_raster.h"
#include "objects/scatter/search.h"

#include <stdlib.h>

enum { TRIES = 40 }; // for each copy, at most

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
    s->area = surface ? scatter_sum_areas(s, e) : NULL;
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
        spot->p.y = scatter_surface_over(s, spot->p);
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
    if (!scatter_ground_find(s->ground, &there->p, &there->normal) ||
        !scatter_suits_water(s, there->p)) {
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
        bool found = s->surface ? scatter_spot_on_surface(s, key, &spot)
                                : scatter_spot_on_land(s, key, &spot);
        int thing = things_choose(&params->things, random_unit(random_key(key, STREAM_THING)));
        bool taken = false;
        if (!found || !scatter_allows(s, &spot) || !scatter_in_patch(s, &spot, thing)) {
            continue;
        }
        if (!scatter_take(s, &spot, &taken, e)) {
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
