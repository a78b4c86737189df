#include "land/where.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

bool where_init(Where *where, const MapRange *ranges, int count, const HeightField *land,
                const Run *run, Error *e)
{
    *where = (Where){.range = ranges};
    where->map = memory_alloc_zero(count, sizeof(HeightField *), e);
    bool done = where->map;
    while (done && where->count < count) {
        const MapRange *range = &ranges[where->count];
        HeightMap map = {range->map, range->latitude, range->day};
        where->map[where->count] = height_map(land, &map, run, e);
        done = where->map[where->count++] || error_key(e, "where.%d", where->count - 1);
    }
    return done;
}

void where_free(Where *where)
{
    for (int i = 0; i < where->count; i++) {
        height_field_free(where->map[i]);
    }
    free(where->map);
    *where = (Where){0};
}

// How far a value lies outside of the range; 0 within it.
static float excess(const MapRange *range, float value)
{
    float below = range->range[0] - value, above = value - range->range[1];
    if (range->map != HEIGHT_MAP_ASPECT) {
        return fmaxf(fmaxf(below, above), 0.0f);
    }
    if (value < 0.0f) {
        return INFINITY; // level land faces nowhere
    }
    bool through_north = range->range[0] > range->range[1];
    bool within = through_north ? below <= 0.0f || above <= 0.0f : below <= 0.0f && above <= 0.0f;
    float to_low = fminf(fabsf(below), 360.0f - fabsf(below));
    float to_high = fminf(fabsf(above), 360.0f - fabsf(above));
    return within ? 0.0f : fminf(to_low, to_high);
}

float where_share_of(const Where *where, int64_t sample)
{
    float share = 1.0f;
    for (int i = 0; i < where->count; i++) {
        const MapRange *range = &where->range[i];
        float value = where->map[i]->height[sample];
        float off = isfinite(value) ? excess(range, value) : INFINITY;
        share *= range->fade > 0.0f ? fmaxf(1.0f - off / range->fade, 0.0f) : (float)(off <= 0.0f);
    }
    return share;
}

// Not interpolated: aspects cannot be, and what is missing should stay so.
float where_share(const Where *where, Vec3 p)
{
    if (where->count == 0) {
        return 1.0f;
    }
    const HeightField *field = where->map[0];
    float u = (p.x - field->origin.x) / field->cell.x, v = (p.z - field->origin.y) / field->cell.y;
    int column = (int)lrintf(clampf(u, 0.0f, (float)(field->columns - 1)));
    int row = (int)lrintf(clampf(v, 0.0f, (float)(field->rows - 1)));
    return where_share_of(where, (int64_t)row * field->columns + column);
}
