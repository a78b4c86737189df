#include "objects/venation/blade_grid.h"

#define INNER 0.5f // share of the half width that no tooth moves

float blade_column_place(const LeafOutline *outline, float u, float y)
{
    float across = 2.0f * u - 1.0f, half = leaf_half_width(outline, y);
    if (!leaf_has_margin(outline)) {
        return across * half;
    }
    float side = across < 0.0f ? -1.0f : 1.0f;
    float t = fmaxf(fabsf(across) - INNER, 0.0f) / (1.0f - INNER);
    float more = leaf_margin(outline, side, y) - half;
    return across * half + side * more * t * t;
}

float blade_column(const LeafOutline *outline, float x, float y)
{
    float half = leaf_half_width(outline, y);
    if (!(half > 0.0f)) {
        return 0.5f;
    }
    float side = x < 0.0f ? -1.0f : 1.0f, beyond = fabsf(x) - INNER * half;
    if (!leaf_has_margin(outline) || beyond <= 0.0f) {
        return clampf(0.5f + 0.5f * x / half, 0.0f, 1.0f);
    }
    float edge = leaf_margin(outline, side, y);
    beyond = fminf(beyond, edge - INNER * half);
    // beyond = half w + more (w / (1 - INNER))^2
    float more = (edge - half) / ((1.0f - INNER) * (1.0f - INNER));
    float w = 2.0f * beyond / (half + sqrtf(fmaxf(half * half + 4.0f * more * beyond, 0.0f)));
    return clampf(0.5f + 0.5f * side * (INNER + w), 0.0f, 1.0f);
}

Vec3 blade_pixel(const LeafOutline *outline, int width, int height, int column, int row)
{
    float y = outline->length * (1.0f - ((float)row + 0.5f) / (float)height);
    float u = ((float)column + 0.5f) / (float)width;
    return vec3(blade_column_place(outline, u, y), y, 0);
}
