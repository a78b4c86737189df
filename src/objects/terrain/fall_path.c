// The path of falling water: a jet that gravity alone bends. Where it meets rock it slides and
// leaps on.
//
// The speed at the lip is that of a free overfall, whose depth is 0.715 of the critical one (Rouse,
// "Discharge Characteristics of the Free Overfall", Civil Eng. 6, 1936).
#include "base/exact_math.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/fall.h"

float terrain_lip_speed(float discharge, float half)
{
    float wide = discharge / (2.0f * half);
    float critical = exact_pow(wide * wide / FALL_GRAVITY, 1.0f / 3.0f);
    return critical > 0.0f ? wide / (0.715f * critical) : 0.0f;
}

// Unit normal of the land.
static Vec3 land_normal(const DrawnLand *land, float x, float z)
{
    float step = 0.25f * land->field->cell.x;
    float dx = drawn_land_at(land, x + step, z) - drawn_land_at(land, x - step, z);
    float dz = drawn_land_at(land, x, z + step) - drawn_land_at(land, x, z - step);
    return vec3_normalize(vec3(-dx, 2.0f * step, -dz));
}

// Lays what has come below the surface back on it, and takes away the speed across it.
static void slide(const FallPath *path, Vec3 *p, Vec3 *v)
{
    const float rubs = 1.5f, least = 0.4f; // 1/s: how fast rock slows it; m/s
    float land = drawn_land_at(path->land, p->x, p->z) + path->film;
    if (p->y >= land) {
        return;
    }
    p->y = land;
    Vec3 normal = land_normal(path->land, p->x, p->z);
    float into = vec3_dot(*v, normal);
    *v = vec3_scale(into < 0.0f ? vec3_madd(*v, -into, normal) : *v,
                    1.0f / (1.0f + rubs * path->step));
    float ahead = vec3_dot(*v, path->way); // it never rests on a ledge
    *v = ahead < least ? vec3_madd(*v, least - ahead, path->way) : *v;
}

int terrain_fall_path(const FallPath *path, Vec3 start, Vec3 velocity, Vec3 *place, int most)
{
    Vec3 p = start, v = velocity;
    float t = path->step;
    int count = 0;
    place[count++] = p;
    while (count < most && p.y > path->level) {
        Vec3 last = p;
        p = vec3_madd(p, t, v);
        p.y -= 0.5f * FALL_GRAVITY * t * t;
        v.y -= FALL_GRAVITY * t;
        if (path->land) {
            slide(path, &p, &v);
        }
        if (p.y < path->level) {
            p = vec3_lerp(last, p, (last.y - path->level) / (last.y - p.y));
            p.y = path->level;
        }
        place[count++] = p;
    }
    return count;
}
