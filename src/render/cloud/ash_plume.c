#include "render/cloud/ash_plume.h"

#include "base/random.h"

static const float ENTRAINMENT = 0.15f; // m of radius a metre of way
static const float BEND = 1.2f;         // m downwind at the top, a metre of height, at drift 1

Vec3 ash_plume_axis(const Cloud *cloud, float t, float *radius)
{
    float height = cloud->thickness, rise = t < 1.0f ? t : 1.0f + 0.15f * (t - 1.0f);
    float away = BEND * cloud->drift * height * t * sqrtf(t);
    float wind = cloud->wind * RADIANS_PER_DEGREE;
    float way = sqrtf(away * away + height * height * rise * rise);
    *radius = 0.5f * cloud->size + ENTRAINMENT * way;
    return vec3(cloud->center_x + away * sinf(wind), cloud->base + height * rise,
                cloud->center_z + away * cosf(wind));
}

Aabb ash_plume_box(const Cloud *cloud)
{
    enum { STEPS = 32 };
    Aabb box = aabb_empty();
    for (int i = 0; i <= STEPS; i++) {
        float radius;
        Vec3 p = ash_plume_axis(cloud, ASH_PLUME_END * (float)i / STEPS, &radius);
        Vec3 reach = vec3_splat(1.7f * radius); // billows on balls beside the axis
        box = aabb_union(box, (Aabb){vec3_sub(p, reach), vec3_add(p, reach)});
    }
    box.low.y = cloud->base;
    return box;
}

float ash_plume_billow(const Cloud *cloud)
{
    return 0.8f * cloud->size + 0.06f * cloud->thickness;
}

// As if all ash of one altitude were as old, but for what has drifted off beyond the top.
float ash_plume_share(const Cloud *cloud, Vec3 p)
{
    float wind = cloud->wind * RADIANS_PER_DEGREE, radius;
    float away = (p.x - cloud->center_x) * sinf(wind) + (p.z - cloud->center_z) * cosf(wind);
    float t = clampf((p.y - cloud->base) / cloud->thickness, 0.0f, 1.0f);
    ash_plume_axis(cloud, t, &radius);
    float past = away / fmaxf(BEND * cloud->drift * cloud->thickness, 0.1f * cloud->thickness);
    return clampf(0.5f * cloud->size / radius, 0.0f, 1.0f) *
           lerpf(1.0f, 0.3f, smoothstepf(1.0f, 2.2f, past));
}

// The puff at t: some balls beside each other, which bulge. Puffs are not alike: the vent throws up
// more or less at a time.
static bool add_puff(Puffs *p, const Cloud *cloud, float t, uint64_t key, Error *e)
{
    enum { BALLS = 3 };
    float radius;
    Vec3 axis = ash_plume_axis(cloud, t, &radius);
    radius *= random_range(random_key(key, 0), 0.8f, 1.2f);
    float torn = cloud->softness * smoothstepf(0.1f, ASH_PLUME_END, t);
    for (uint64_t i = 0; i < BALLS; i++) {
        uint64_t own = random_key(key, 1 + i);
        float off = random_range(random_key(own, 0), 0.15f, 0.6f);
        Puff ball = {
            .center = vec3_madd(axis, off * radius, random_direction(random_key(own, 1))),
            .radius = radius * random_range(random_key(own, 2), 0.45f, 0.72f),
            .flatness = 1.0f,
            .softness = puffs_worn(torn, 0.8f * torn * random_unit(random_key(own, 3))),
        };
        ball.center.y = fmaxf(ball.center.y, cloud->base);
        if (!puffs_add_bulging(p, ball, cloud->softness, PUFF_LEVELS, random_key(own, 4), e)) {
            return false;
        }
    }
    return true;
}

bool ash_plume_grow(Puffs *p, const Cloud *cloud, uint64_t key, Error *e)
{
    const float apart = 0.35f; // radii
    bool done = true;
    float t = 0.0f;
    for (uint64_t i = 0; done && t < ASH_PLUME_END; i++) {
        float radius, ahead;
        done = add_puff(p, cloud, t, random_key(key, i), e);
        Vec3 here = ash_plume_axis(cloud, t, &radius);
        Vec3 there = ash_plume_axis(cloud, t + 0.01f, &ahead);
        t += 0.01f * apart * radius / vec3_distance(here, there);
    }
    return done;
}
