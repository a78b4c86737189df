// Which spots are kept.
#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/scatter/search.h"

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

float scatter_surface_over(const Search *s, Vec3 p)
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

bool scatter_suits_water(const Search *s, Vec3 p)
{
    bool in_water = s->params->in_water;
    return (s->by_depth && in_water) || covered(s, s->wet, p) == in_water;
}

bool scatter_allows(const Search *s, const Spot *spot)
{
    const ScatteringParams *params = s->params;
    float distance = vec3_distance(spot->p, params->center);
    float slope = exact_acos(clampf(spot->normal.y, -1.0f, 1.0f)) / RADIANS_PER_DEGREE;
    bool near = !s->surface || (distance >= params->inner &&
                                (params->radius == 0.0f || distance <= params->radius));
    return near && within(slope, params->slope) && within(spot->p.y, params->altitude) &&
           scatter_suits_water(s, spot->p) &&
           random_unit(random_key(spot->key, STREAM_WHERE)) < where_share(&s->where, spot->p);
}

// Each thing has patches of its own.
bool scatter_in_patch(const Search *s, const Spot *spot, int thing)
{
    uint64_t key = random_key(s->seed, STREAM_PATCHES + (uint64_t)thing);
    float scale = 1.0f / s->params->clump_size;
    float patch = noise_plane_fractal(spot->p.x * scale, spot->p.z * scale, 3, key);
    return random_unit(random_key(spot->key, STREAM_PATCH)) <
           things_clump_share(s->params->clumping, patch);
}

bool scatter_take(const Search *s, const Spot *spot, bool *taken, Error *e)
{
    float least = s->params->spacing;
    Vec3 nearest;
    *taken = !s->taken || !point_hash_nearest(s->taken, spot->p, &least, &nearest);
    return !s->taken || !*taken || point_hash_add(s->taken, spot->p, e);
}
