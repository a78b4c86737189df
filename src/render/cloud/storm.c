#include "render/cloud/storm.h"

#include "base/random.h"

static const float SHEAR = 0.07f; // m downwind that towers lean a metre of height

StormFrame storm_frame(const Cloud *cloud)
{
    float wind = cloud->wind * RADIANS_PER_DEGREE;
    return (StormFrame){cloud, sinf(wind), cosf(wind), cloud->base + 0.9f * cloud->thickness};
}

Vec3 storm_place(const StormFrame *f, float along, float aside, float y)
{
    along *= f->cloud->size;
    aside *= f->cloud->size;
    return vec3(f->cloud->center_x + along * f->sine + aside * f->cosine, y,
                f->cloud->center_z + along * f->cosine - aside * f->sine);
}

// What shoots over into the stratosphere above the strongest updraft.
static bool add_dome(Puffs *p, const StormFrame *f, uint64_t key, Error *e)
{
    enum { BALLS = 5 };
    const Cloud *cloud = f->cloud;
    for (uint64_t i = 0; i < BALLS; i++) {
        uint64_t own = random_key(key, i);
        float along = random_range(random_key(own, 0), -0.16f, 0.2f);
        float aside = random_range(random_key(own, 1), -0.2f, 0.2f);
        float radius = cloud->size * random_range(random_key(own, 2), 0.14f, 0.24f);
        Puff ball = {.center = storm_place(f, along, aside, f->top - 0.25f * radius),
                     .radius = radius,
                     .flatness = 1.3f};
        if (!puffs_add_bulging(p, ball, 0.5f * cloud->softness, PUFF_LEVELS, random_key(own, 3),
                               e)) {
            return false;
        }
    }
    return true;
}

// A tower of the storm whose foot lies there; shares of the storm's size and thickness.
static bool add_tower(Puffs *p, const StormFrame *f, Vec3 foot, float radius, float height,
                      uint64_t key, Error *e)
{
    const Cloud *cloud = f->cloud;
    Column tower = {.foot = foot,
                    .radius = cloud->size * radius,
                    .height = cloud->thickness * height,
                    .taper = height > 0.79f ? 0.05f : 0.3f,
                    .lean_x = SHEAR * f->sine,
                    .lean_z = SHEAR * f->cosine,
                    .wear = cloud->softness};
    return puffs_add_column(p, &tower, key, e);
}

// The main tower with turrets of all heights about it, and the flanking line: ever younger towers
// in steps down to the upwind side.
static bool add_towers(Puffs *p, const StormFrame *f, uint64_t key, Error *e)
{
    enum { TURRETS = 19, STEPS = 7 };
    float base = f->cloud->base;
    bool done =
        add_tower(p, f, storm_place(f, 0.0f, 0.0f, base), 0.34f, 0.8f, random_key(key, 0), e);
    for (uint64_t i = 0; done && i < TURRETS; i++) {
        uint64_t own = random_key(key, 1 + i);
        float angle = 2.0f * PI_F * ((float)i + random_unit(random_key(own, 0))) / TURRETS;
        float rank = random_unit(random_key(own, 1)); // small turrets stand farther out
        float off = lerpf(0.26f, 0.62f, rank);
        float height = random_range(random_key(own, 2), 0.2f, lerpf(0.8f, 0.55f, rank));
        done = add_tower(p, f, storm_place(f, off * cosf(angle), off * sinf(angle), base),
                         lerpf(0.27f, 0.1f, rank) * random_range(random_key(own, 3), 0.8f, 1.15f),
                         height, random_key(own, 4), e);
    }
    for (uint64_t i = 0; done && i < STEPS; i++) {
        uint64_t own = random_key(key, 100 + i);
        float step = ((float)i + random_unit(random_key(own, 0))) / STEPS;
        float off = 0.5f + 1.3f * step;
        float aside = 0.45f * off + random_range(random_key(own, 1), -0.1f, 0.1f);
        done = add_tower(p, f, storm_place(f, -off, aside, base), 0.22f - 0.12f * step,
                         0.6f - 0.48f * step, random_key(own, 2), e);
    }
    return done;
}

// Cold air that runs out below the storm lifts the air ahead of it: tiers of flat balls in an arc
// about the side that the wind blows to, the lowest farthest out, and a roof from them to the
// towers.
static bool add_shelf(Puffs *p, const Cloud *cloud, uint64_t key, Error *e)
{
    enum { TIERS = 4, BALLS = 60 };
    float wind = cloud->wind * RADIANS_PER_DEGREE;
    for (uint64_t i = 0; i < (uint64_t)TIERS * BALLS; i++) {
        uint64_t own = random_key(key, i);
        uint64_t above = i / BALLS; // tiers below it
        float tier = (float)above / (TIERS - 1);
        float turn = 2.0f * ((float)(i % BALLS) + random_unit(random_key(own, 0))) / BALLS - 1.0f;
        float angle = wind + 1.5f * turn;
        float out = 0.45f + cloud->shelf * (1.0f - 0.75f * tier) * (1.0f - 0.5f * turn * turn);
        out *= cloud->size * random_range(random_key(own, 1), 0.96f, 1.04f);
        float y = cloud->size * (0.03f + 0.13f * tier + 0.012f * random_unit(random_key(own, 2)));
        Puff ball = {.center = vec3(cloud->center_x + out * sinf(angle), cloud->base + y,
                                    cloud->center_z + out * cosf(angle)),
                     .radius = cloud->size * random_range(random_key(own, 3), 0.16f, 0.24f),
                     .flatness = 3.6f - tier,
                     .softness = 0.1f + 0.5f * random_unit(random_key(own, 4))};
        if (!puffs_add(p, ball, e)) {
            return false;
        }
    }
    return true;
}

float storm_freezing(const StormFrame *f, float altitude)
{
    float share = (altitude - f->cloud->base) / f->cloud->thickness;
    return lerpf(1.0f, 0.4f, smoothstepf(0.62f, 0.92f, share));
}

bool storm_grow(Puffs *p, const Cloud *cloud, uint64_t key, Error *e)
{
    StormFrame f = storm_frame(cloud);
    return add_towers(p, &f, random_key(key, 0), e) && add_dome(p, &f, random_key(key, 2), e) &&
           (cloud->shelf == 0.0f || add_shelf(p, cloud, random_key(key, 3), e));
}
