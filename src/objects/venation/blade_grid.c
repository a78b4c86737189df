#include "objects/venation/blade_grid.h"

#define INNER 0.5f // share of the half width that no tooth moves

BladeRow blade_row(const LeafOutline *outline, float y)
{
    BladeRow row = {.y = y, .half = leaf_half_width(outline, y)};
    if (leaf_has_margin(outline)) {
        row.more[0] = leaf_margin(outline, -1.0f, y) - row.half;
        row.more[1] = leaf_margin(outline, 1.0f, y) - row.half;
    }
    return row;
}

float blade_row_place(const BladeRow *row, float u)
{
    float across = 2.0f * u - 1.0f, more = row->more[across >= 0.0f];
    if (more == 0.0f) {
        return across * row->half;
    }
    float t = fmaxf(fabsf(across) - INNER, 0.0f) / (1.0f - INNER);
    return across * row->half + (across < 0.0f ? -more : more) * t * t;
}

float blade_row_column(const BladeRow *row, float x)
{
    float half = row->half, more = row->more[x >= 0.0f], beyond = fabsf(x) - INNER * half;
    if (!(half > 0.0f)) {
        return 0.5f;
    }
    if (more == 0.0f || beyond <= 0.0f) {
        return clampf(0.5f + 0.5f * x / half, 0.0f, 1.0f);
    }
    beyond = fminf(beyond, half + more - INNER * half);
    // beyond = half w + more (w / (1 - INNER))^2
    more /= (1.0f - INNER) * (1.0f - INNER);
    float w = 2.0f * beyond / (half + sqrtf(fmaxf(half * half + 4.0f * more * beyond, 0.0f)));
    return clampf(0.5f + 0.5f * (x < 0.0f ? -1.0f : 1.0f) * (INNER + w), 0.0f, 1.0f);
}

BladeRow blade_pixel_row(const LeafOutline *outline, int height, int r)
{
    return blade_row(outline, outline->length * (1.0f - ((float)r + 0.5f) / (float)height));
}

Vec3 blade_pixel(const BladeRow *row, int width, int column)
{
    return vec3(blade_row_place(row, ((float)column + 0.5f) / (float)width), row->y, 0);
}
