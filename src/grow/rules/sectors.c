#include "grow/rules/sectors.h"

#include "base/exact_math.h"

// Rounds half up; the arguments here are small.
static int nearest_int(float x)
{
    return x < 0.0f ? -(int)(0.5f - x) : (int)(x + 0.5f);
}

static bool too_many(float degrees, Error *e)
{
    return error_set(e, ERROR_INPUT,
                     "sector angle %g makes more than %d sectors; use a larger angle",
                     (double)degrees, MAX_SECTORS);
}

static bool add_ring(SectorTable *table, int ring, float degrees, Error *e)
{
    float polar = table->angle * (float)ring, s, c;
    bool pole = ring == 0 || (float)ring * degrees >= 180.0f - 1e-3f;
    exact_sincos(pole && ring > 0 ? PI_F : polar, &s, &c);
    int sectors = nearest_int(360.0f * s / degrees);
    if (table->planar) {
        sectors = pole ? 1 : 2;
    }
    sectors = pole || sectors < 1 ? 1 : sectors;
    if (table->count + sectors > MAX_SECTORS) {
        return too_many(degrees, e);
    }
    table->ring_start[ring] = table->count;
    table->ring_sectors[ring] = sectors;
    for (int i = 0; i < sectors; i++) {
        float side, up;
        float azimuth = 2.0f * PI_F * (float)i / (float)sectors;
        exact_sincos(table->planar ? azimuth + 0.5f * PI_F : azimuth, &side, &up);
        table->axis[table->count++] = pole ? vec3(ring == 0 ? 1.0f : -1.0f, 0, 0)
                                           : vec3(c, table->planar ? 0.0f : s * up, s * side);
    }
    return true;
}

bool sectors_init(SectorTable *table, float degrees, bool planar, Error *e)
{
    *table = (SectorTable){.planar = planar, .angle = degrees * RADIANS_PER_DEGREE};
    if (!(degrees > 0.0f && degrees <= 180.0f)) {
        return error_set(e, ERROR_INPUT, "sector angle %g; it must be above 0 and at most 180",
                         (double)degrees);
    }
    int rings = nearest_int(180.0f / degrees);
    if (rings >= MAX_SECTOR_RINGS) {
        return too_many(degrees, e);
    }
    for (int ring = 0; ring <= rings; ring++) {
        if (!add_ring(table, ring, degrees, e)) {
            return false;
        }
        table->rings = ring;
    }
    return true;
}

int sectors_find(const SectorTable *table, Vec3 local)
{
    float across = table->planar ? fabsf(local.z) : sqrtf(local.y * local.y + local.z * local.z);
    int ring = nearest_int(exact_atan2(across, local.x) / table->angle);
    ring = ring > table->rings ? table->rings : ring;
    int sectors = table->ring_sectors[ring], i = 0;
    if (table->planar) {
        i = sectors == 2 && local.z < 0.0f;
    } else if (sectors > 1) {
        float azimuth = exact_atan2(local.z, local.y);
        i = nearest_int(azimuth * (float)sectors / (2.0f * PI_F));
        i = i < 0 ? i + sectors : i;
        i = i >= sectors ? i - sectors : i;
    }
    return table->ring_start[ring] + i;
}
