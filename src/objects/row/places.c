// Where the copies of a row stand: even steps along its line, each displaced a little.
#include "base/random.h"
#include "base/turn.h"
#include "land/height_raster.h"
#include "objects/row/row.h"

// Of the object's seed and a place's number.
enum {
    STREAM_GAP = 1,
    STREAM_THING,
    STREAM_VARIANT,
    STREAM_SIZE,
    STREAM_TURN,
    STREAM_LEAN,
    STREAM_LEAN_AZIMUTH,
    STREAM_JITTER // and the next two
};

// What the copies stand on.
typedef struct Footing {
    const HeightField *field; // of the object under them; NULL = the scene's land
    const Land *land;
} Footing;

static float length_of(const RowParams *params)
{
    float length = 0.0f;
    for (int i = 1; i < params->point_count; i++) {
        length += vec3_distance(params->points[i - 1].at, params->points[i].at);
    }
    return length;
}

int64_t row_count(const RowParams *params)
{
    return (int64_t)(length_of(params) / params->spacing + 0.5f) + 1;
}

// The point at a distance along the line, and the line's direction there.
static Vec3 point_along(const RowParams *params, float distance, Vec3 *direction)
{
    int last = params->point_count - 1;
    for (int i = 1; i <= last; i++) {
        Vec3 from = params->points[i - 1].at, to = params->points[i].at;
        float length = vec3_distance(from, to);
        if (length > 0.0f && (distance <= length || i == last)) {
            *direction = vec3_scale(vec3_sub(to, from), 1.0f / length);
            return vec3_madd(from, fminf(distance, length), *direction);
        }
        distance -= length;
    }
    *direction = vec3(0, 0, 1);
    return params->points[last].at;
}

static float height_below(const Footing *footing, float x, float z)
{
    return footing->field ? height_field_at(footing->field, x, z)
                          : land_height(footing->land, x, z);
}

static float random_within(uint64_t key, int stream, float most)
{
    return random_range(random_key(key, (uint64_t)stream), -most, most);
}

// The line's direction, which rises with what is below it.
static Vec3 rise(const RowParams *params, const Footing *footing, Vec3 p, Vec3 direction)
{
    const float step = 0.1f; // m
    if (!params->on_land) {
        return direction;
    }
    Vec3 level = vec3(direction.x, 0.0f, direction.z);
    float length = vec3_length(level);
    if (!(length > 0.0f)) {
        return direction;
    }
    level = vec3_scale(level, 1.0f / length);
    level.y = (height_below(footing, p.x + step * level.x, p.z + step * level.z) -
               height_below(footing, p.x - step * level.x, p.z - step * level.z)) /
              (2.0f * step);
    return vec3_normalize(level);
}

static Transform stand(const RowParams *params, const Footing *footing, float distance,
                       uint64_t key)
{
    Vec3 direction, p = point_along(params, distance, &direction);
    Vec3 forward = rise(params, footing, p, direction);
    float up_part = vec3_length(vec3(forward.x, 0.0f, forward.z));
    Vec3 level =
        up_part > 1e-6f ? vec3(forward.x / up_part, 0.0f, forward.z / up_part) : vec3(0, 0, 1);
    Vec3 z = vec3_normalize(vec3_lerp(level, forward, up_part > 1e-6f ? params->align : 0.0f));
    Vec3 x = vec3_normalize(vec3_cross(vec3(0, 1, 0), z));
    p = vec3_madd(p, random_within(key, STREAM_JITTER, params->jitter[0]), x);
    p = vec3_madd(p, random_within(key, STREAM_JITTER + 2, params->jitter[2]), z);
    p.y = params->on_land ? height_below(footing, p.x, p.z) : p.y;
    Vec3 y = vec3_cross(z, x);
    x = vec3_turn(x, y, random_within(key, STREAM_TURN, params->turn));
    Vec3 lean = vec3_turn(x, y, random_within(key, STREAM_LEAN_AZIMUTH, 180.0f));
    float tilt = random_within(key, STREAM_LEAN, params->tilt);
    x = vec3_turn(x, lean, tilt);
    y = vec3_turn(y, lean, tilt);
    float size = random_range(random_key(key, STREAM_SIZE), params->scale[0], params->scale[1]);
    p.y += random_within(key, STREAM_JITTER + 1, params->jitter[1]);
    return transform_from_axes(vec3_scale(x, size), vec3_scale(y, size),
                               vec3_scale(vec3_cross(x, y), size),
                               vec3_madd(p, -size * params->sink, y));
}

bool row_places_init(ThingPlaces *places, const RowParams *params, const Recipe *recipe,
                     const Surroundings *around, Error *e)
{
    int64_t count = row_count(params);
    HeightField *seen = NULL;
    bool done = thing_places_alloc(places, count, e);
    if (done && params->on_land && recipe->surface && !recipe->land) {
        seen = height_field_of_mesh(recipe->surface->mesh, HEIGHT_MAP_SIDE, e);
        done = seen != NULL;
    }
    Footing footing = {recipe->land ? recipe->land : seen, &around->land};
    float step = count > 1 ? length_of(params) / (float)(count - 1) : 0.0f;
    for (int64_t i = 0; done && i < count; i++) {
        uint64_t key = random_key(recipe->seed, (uint64_t)i);
        if (random_unit(random_key(key, STREAM_GAP)) < params->gaps) {
            continue;
        }
        int thing = things_choose(&params->things, random_unit(random_key(key, STREAM_THING)));
        float variant = random_unit(random_key(key, STREAM_VARIANT));
        places->thing[places->count] =
            thing * params->things.variants + (int)(variant * (float)params->things.variants);
        places->place[places->count++] = stand(params, &footing, (float)i * step, key);
    }
    height_field_free(seen);
    return done;
}
