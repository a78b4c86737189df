#include "land/height_field.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>
#include <string.h>

HeightField *height_field_new(int columns, int rows, Vec2 cell, Vec2 origin, Error *e)
{
    if (columns < 2 || rows < 2 || columns > HEIGHT_FIELD_MAX || rows > HEIGHT_FIELD_MAX) {
        error_set(e, ERROR_INPUT, "a height field of %d x %d samples; 2 to %d a side are possible",
                  columns, rows, HEIGHT_FIELD_MAX);
        return NULL;
    }
    if (!(cell.x > 0.0f) || !(cell.y > 0.0f)) {
        error_set(e, ERROR_INPUT, "cells of %g x %g m; both must be greater than 0", (double)cell.x,
                  (double)cell.y);
        return NULL;
    }
    HeightField *field = memory_alloc_zero(1, sizeof *field, e);
    if (!field) {
        return NULL;
    }
    *field = (HeightField){.columns = columns, .rows = rows, .cell = cell, .origin = origin};
    field->height = memory_alloc_zero(height_field_count(field), sizeof(float), e);
    if (!field->height) {
        height_field_free(field);
        return NULL;
    }
    return field;
}

static void free_place(GeoPlace *place)
{
    if (place) {
        free(place->reference);
        free(place);
    }
}

bool height_field_take_place(HeightField *field, const HeightField *from, double x, double z,
                             Error *e)
{
    if (!from->place) {
        return true;
    }
    free_place(field->place);
    field->place = memory_alloc(1, sizeof *field->place, e);
    if (!field->place) {
        return false;
    }
    *field->place = *from->place;
    field->place->east += x * from->place->unit_x;
    field->place->north -= z * from->place->unit_z;
    const char *reference = from->place->reference;
    if (reference) {
        int64_t size = (int64_t)strlen(reference) + 1;
        field->place->reference = memory_alloc(size, 1, e);
        if (!field->place->reference) {
            return false;
        }
        memcpy(field->place->reference, reference, (size_t)size);
    }
    return true;
}

void height_field_free(HeightField *field)
{
    if (field) {
        free(field->height);
        free(field->wetness);
        free(field->ground);
        free(field->climate);
        free(field->change);
        free(field->loose);
        free(field->age);
        free(field->water);
        free(field->wind);
        free_place(field->place);
        free(field);
    }
}

int64_t height_field_bytes(const HeightField *field)
{
    const float *const given[] = {field->height, field->wetness, field->climate, field->change,
                                  field->loose,  field->ground,  field->age,     field->water};
    int64_t bytes = sizeof *field;
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        bytes += given[i] ? height_field_count(field) * (int64_t)sizeof(float) : 0;
    }
    return bytes + (field->wind ? height_field_count(field) * (int64_t)sizeof(Vec2) : 0);
}

void height_field_range(const HeightField *field, float *low, float *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float h = field->height[i];
        *low = isfinite(h) ? fminf(h, *low) : *low;
        *high = isfinite(h) ? fmaxf(h, *high) : *high;
    }
    if (*low > *high) {
        *low = *high = 0.0f;
    }
}

// Index of the cell that contains a coordinate, and the fraction inside it, 0..1.
static int locate(float x, float origin, float cell, int count, float *share)
{
    float t = clampf((x - origin) / cell, 0.0f, (float)(count - 1));
    int i = (int)t;
    i = i > count - 2 ? count - 2 : i;
    *share = t - (float)i;
    return i;
}

float height_field_at(const HeightField *field, float x, float z)
{
    float u, v;
    int column = locate(x, field->origin.x, field->cell.x, field->columns, &u);
    int row = locate(z, field->origin.y, field->cell.y, field->rows, &v);
    const float *h = field->height + (int64_t)row * field->columns + column;
    return lerpf(lerpf(h[0], h[1], u), lerpf(h[field->columns], h[field->columns + 1], u), v);
}

static float catmull_rom(const float h[4], float t)
{
    float a = 0.5f * (h[2] - h[0]), b = h[0] - 2.5f * h[1] + 2.0f * h[2] - 0.5f * h[3];
    float c = 0.5f * (h[3] - h[0]) + 1.5f * (h[1] - h[2]);
    return h[1] + t * (a + t * (b + t * c));
}

static int clamp_index(int i, int count)
{
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

float height_field_smooth_at(const HeightField *field, float x, float z)
{
    float u, v, line[4];
    int column = locate(x, field->origin.x, field->cell.x, field->columns, &u);
    int row = locate(z, field->origin.y, field->cell.y, field->rows, &v);
    for (int j = 0; j < 4; j++) {
        const float *h =
            field->height + (int64_t)clamp_index(row + j - 1, field->rows) * field->columns;
        float four[4];
        for (int i = 0; i < 4; i++) {
            four[i] = h[clamp_index(column + i - 1, field->columns)];
        }
        line[j] = catmull_rom(four, u);
    }
    return catmull_rom(line, v);
}

uint64_t height_field_hash(const HeightField *field)
{
    uint64_t hash = random_key((uint64_t)field->columns, (uint64_t)field->rows);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        uint32_t bits;
        memcpy(&bits, &field->height[i], sizeof bits);
        hash = random_key(hash, bits);
    }
    return hash;
}
