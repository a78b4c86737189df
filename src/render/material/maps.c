#include "render/material/maps.h"

#include "render/material/pattern.h"

// One way to lay a picture on the surface: its coordinates, the world directions in which they
// grow, and the size of a pixel's footprint in them.
typedef struct Projection {
    Vec2 uv;
    Vec3 along_u, along_v; // unit
    float du, dv;
    float weight;
} Projection;

enum { MOST_PROJECTIONS = 3 };

bool maps_are_given(const Material *m)
{
    const char *const files[] = {m->texture, m->normal_texture, m->roughness_texture,
                                 m->transmittance_texture, m->displacement_texture};
    bool given = false;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        given = given || (files[i] && files[i][0]);
    }
    return given;
}

static float repeats(const Material *m)
{
    return m->texture_scale > 0.0f ? 1.0f / m->texture_scale : 1.0f;
}

static Projection by_uv(const Material *m, const SurfacePoint *point)
{
    float u = vec3_length(point->tangent_u), v = vec3_length(point->tangent_v);
    float repeat = repeats(m);
    return (Projection){{point->uv.x * repeat, point->uv.y * repeat},
                        vec3_normalize(point->tangent_u),
                        vec3_normalize(point->tangent_v),
                        u > 0.0f ? repeat * point->footprint / u : 0.0f,
                        v > 0.0f ? repeat * point->footprint / v : 0.0f,
                        1.0f};
}

static Vec3 axis_of(const Transform *t, int i)
{
    Vec3 axis = vec3(i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f);
    return t ? vec3_normalize(transform_vector(t, axis)) : axis;
}

// Along x, y and z of the object's own space, by the fourth power of the normal's components: sharp
// enough that few points mix pictures. Upright where the surface is.
static int along_axes(const Material *m, const SurfacePoint *point,
                      Projection projection[MOST_PROJECTIONS])
{
    static const int across[3] = {2, 0, 0}, upward[3] = {1, 2, 1};
    const float least = 0.01f;
    const Vec3 p = point->object_position;
    const float at[3] = {p.x, p.y, p.z};
    Vec3 axis[3];
    float weight[3], sum = 0.0f;
    for (int i = 0; i < 3; i++) {
        axis[i] = axis_of(point->transform, i);
        float n = vec3_dot(axis[i], surface_smooth_normal(point));
        weight[i] = n * n * n * n;
        sum += weight[i];
    }
    float repeat = repeats(m);
    int count = 0;
    for (int i = 0; i < 3; i++) {
        if (weight[i] > least * sum) {
            projection[count++] = (Projection){{at[across[i]] * repeat, at[upward[i]] * repeat},
                                               axis[across[i]],
                                               axis[upward[i]],
                                               point->footprint * repeat,
                                               point->footprint * repeat,
                                               weight[i]};
        }
    }
    sum = 0.0f;
    for (int i = 0; i < count; i++) {
        sum += projection[i].weight;
    }
    for (int i = 0; i < count; i++) {
        projection[i].weight /= sum;
    }
    return count;
}

typedef Vec3 Lookup(const Texture *texture, Vec2 uv, float du, float dv);

static Vec3 mean_of(Lookup *lookup, const Texture *texture, const Projection p[], int count)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < count; i++) {
        sum = vec3_madd(sum, p[i].weight, lookup(texture, p[i].uv, p[i].du, p[i].dv));
    }
    return sum;
}

// The slope of the bumps whose normals the picture tells: red along u, green along v, blue out of
// the surface, 0..1 for -1..1.
static Vec3 slope_of(const Texture *texture, const Projection p[], int count)
{
    Vec3 slope = vec3_splat(0.0f);
    for (int i = 0; i < count; i++) {
        Vec3 value = texture_data(texture, p[i].uv, p[i].du, p[i].dv);
        Vec3 n = vec3_madd(vec3_splat(-1.0f), 2.0f, value);
        float share = -p[i].weight / fmaxf(n.z, 0.05f);
        slope = vec3_madd(slope, share * n.x, p[i].along_u);
        slope = vec3_madd(slope, share * n.y, p[i].along_v);
    }
    return slope;
}

void maps_set_roughness(const MaterialEntry *entry, float roughness, Bsdf *b)
{
    b->roughness = clampf(roughness, 0.0f, 1.0f);
    if (entry->rough_tables) {
        int level = (int)(b->roughness * (float)(ROUGH_TABLES - 1) + 0.5f);
        b->table = &entry->rough_tables[level];
        b->alpha = fmaxf(b->roughness * b->roughness, LEAST_ALPHA);
    }
}

static int projections(const Material *m, const SurfacePoint *point, Projection p[MOST_PROJECTIONS])
{
    bool axes = m->texture_mapping == MAPPING_TRIPLANAR ||
                (m->texture_mapping == MAPPING_AUTO && !point->has_uv);
    if (axes) {
        return along_axes(m, point, p);
    }
    p[0] = by_uv(m, point);
    return 1;
}

float maps_height(const MaterialEntry *entry, const SurfacePoint *point)
{
    if (!entry->displacement) {
        return 0.0f;
    }
    Projection p[MOST_PROJECTIONS];
    int count = projections(&entry->material, point, p);
    float value = mean_of(texture_data, entry->displacement, p, count).x;
    return entry->material.displacement_depth * (value - 0.5f);
}

// The slope of the heights that displacement_texture gives, by differences over a pixel.
static Vec3 slope_of_heights(const MaterialEntry *entry, const SurfacePoint *point,
                             const Projection p[], int count)
{
    Vec3 slope = vec3_splat(0.0f);
    for (int i = 0; i < count && point->footprint > 0.0f; i++) {
        float share = entry->material.displacement_depth * p[i].weight / point->footprint;
        for (int k = 0; k < 2; k++) {
            float step = 0.5f * (k == 0 ? p[i].du : p[i].dv);
            Vec2 back = p[i].uv, ahead = p[i].uv;
            *(k == 0 ? &back.x : &back.y) -= step;
            *(k == 0 ? &ahead.x : &ahead.y) += step;
            float rise = texture_data(entry->displacement, ahead, p[i].du, p[i].dv).x -
                         texture_data(entry->displacement, back, p[i].du, p[i].dv).x;
            slope = vec3_madd(slope, share * rise, k == 0 ? p[i].along_u : p[i].along_v);
        }
    }
    return slope;
}

void maps_apply(const MaterialEntry *entry, const SurfacePoint *point, Bsdf *b)
{
    const Material *m = &entry->material;
    Projection p[MOST_PROJECTIONS];
    int count = projections(m, point, p);
    if (entry->color) {
        Vec3 texel = mean_of(texture_color, entry->color, p, count);
        b->color = vec3_mul(b->color, texel);
        b->transmittance =
            vec3_mul(b->transmittance, texel); // pigment absorbs transmitted light too
    }
    if (entry->transmittance) {
        Vec3 texel = mean_of(texture_color, entry->transmittance, p, count);
        b->transmittance = vec3_mul(b->transmittance, texel);
    }
    if (entry->roughness) {
        float factor = mean_of(texture_data, entry->roughness, p, count).x;
        maps_set_roughness(entry, b->roughness * factor, b);
    }
    if (entry->normal) {
        float side = point->backface ? -1.0f : 1.0f;
        Vec3 slope = vec3_scale(slope_of(entry->normal, p, count), side);
        b->normal = pattern_tilt(b->normal, slope);
    }
    if (entry->displacement && point->displaced < 1.0f) {
        float side = point->backface ? -1.0f : 1.0f;
        Vec3 slope = slope_of_heights(entry, point, p, count);
        b->normal = pattern_tilt(b->normal, vec3_scale(slope, side * (1.0f - point->displaced)));
    }
}
