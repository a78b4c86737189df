// Land lifted by a painted map (Tanaka et al., section 5.5): each colour of the picture is a
// height.
#include "base/exact_math.h"
#include "image/image.h"
#include "objects/terrain/internal.h"

// From the plain to the summit.
ColorStop terrain_altitudes[TERRAIN_ALTITUDES] = {
    {0.0f, {0.030f, 0.085f, 0.30f}}, {0.12f, {0.020f, 0.26f, 0.30f}},
    {0.35f, {0.10f, 0.42f, 0.07f}},  {0.6f, {0.72f, 0.55f, 0.05f}},
    {0.82f, {0.66f, 0.10f, 0.03f}},  {1.0f, {0.85f, 0.80f, 0.78f}}};

// The sRGB curve; colours are compared as they look.
static float displayed(float x)
{
    x = clampf(x, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * exact_pow(x, 1.0f / 2.4f) - 0.055f;
}

static Vec3 display_color(Vec3 c)
{
    return vec3(displayed(c.x), displayed(c.y), displayed(c.z));
}

// The height whose colour is nearest to c, on the line through the stops.
static float height_of(Vec3 c, const ColorStop *stop, int count)
{
    float best = 3e38f, height = stop[0].at;
    for (int i = 0; i < count; i++) {
        const ColorStop *next = &stop[i + 1 < count ? i + 1 : i];
        Vec3 along = vec3_sub(next->color, stop[i].color), from = vec3_sub(c, stop[i].color);
        float squared = vec3_dot(along, along);
        float t = squared > 0.0f ? clampf(vec3_dot(from, along) / squared, 0.0f, 1.0f) : 0.0f;
        Vec3 off = vec3_madd(from, -t, along);
        float away = vec3_dot(off, off);
        if (away < best) {
            best = away;
            height = lerpf(stop[i].at, next->at, t);
        }
    }
    return height;
}

HeightField *terrain_read_map(const TerrainParams *params, const Run *run, Error *e)
{
    const MapParams *map = &params->map;
    ColorStop stops[TERRAIN_MOST_COLORS];
    int count = map->color_count > 0 ? map->color_count : TERRAIN_ALTITUDES;
    for (int i = 0; i < count; i++) {
        stops[i] = map->color_count > 0 ? map->colors[i] : terrain_altitudes[i];
        stops[i].color = display_color(stops[i].color);
    }
    bool linear;
    Image *image = image_read_color(map->image, &linear, run, e);
    if (!image) {
        error_key(e, "map.image");
        return NULL;
    }
    Vec2 cell = {params->size / (float)image->width, params->size / (float)image->height};
    Vec2 origin = {0.5f * (cell.x - params->size), 0.5f * (cell.y - params->size)};
    HeightField *field = height_field_new(image->width, image->height, cell, origin, e);
    for (int64_t i = 0; field && i < height_field_count(field); i++) {
        const float *p = image->pixel + i * image->channels;
        Vec3 c = vec3(p[0], p[1], p[2]);
        float height = height_of(linear ? display_color(c) : c, stops, count);
        field->height[i] = image->channels > 3 ? height * clampf(p[3], 0.0f, 1.0f) : height;
    }
    image_free(image);
    if (!field) {
        error_key(e, "map.image");
    }
    return field;
}
