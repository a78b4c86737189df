#include "render/cloud/puffs.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

enum { FLANK_LEVELS = 3 };

static const float UNDER = 0.35f; // share of the wear by which a bulge's underside is softer

bool puffs_add(Puffs *p, Puff puff, Error *e)
{
    if (!memory_reserve(&p->puff, &p->capacity, p->count + 1, sizeof *p->puff, e)) {
        return false;
    }
    puff.radius = fmaxf(puff.radius, p->smallest);
    p->puff[p->count++] = puff;
    return true;
}

float puffs_worn(float softness, float share)
{
    return share > 0.0f ? lerpf(softness, 1.0f, fminf(share, 1.0f)) : fmaxf(softness + share, 0.0f);
}

// A ball and the smaller ones on its flanks, more of them above than below: what rises bulges.
// Dry air that the bulge pushes aside is mixed in below it, not into its top.
static bool add_bulging(Puffs *p, Puff ball, float wear, int levels, uint64_t key, Error *e)
{
    if (!puffs_add(p, ball, e)) {
        return false;
    }
    if (levels == 0 || 0.4f * ball.radius < p->smallest) {
        return true;
    }
    enum { CHILDREN = 8 };
    for (uint64_t i = 0; i < CHILDREN; i++) {
        uint64_t own = random_key(key, i);
        Vec3 d = random_direction(random_key(own, 0));
        d = vec3_normalize(vec3(d.x, d.y + 0.4f, d.z));
        float off = ball.radius * random_range(random_key(own, 2), 0.72f, 0.95f);
        Puff child = ball;
        child.center = vec3_madd(ball.center, off, vec3(d.x, d.y / ball.flatness, d.z));
        child.radius = ball.radius * random_range(random_key(own, 1), 0.3f, 0.58f);
        child.softness = puffs_worn(ball.softness, UNDER * wear * (0.4f - d.y));
        if (child.center.y > p->floor &&
            !add_bulging(p, child, wear, levels - 1, random_key(own, 3), e)) {
            return false;
        }
    }
    return true;
}

bool puffs_add_column(Puffs *p, const Column *c, uint64_t key, Error *e)
{
    float y = 0.35f * c->radius;
    for (uint64_t i = 0; i == 0 || y < c->height - 0.5f * c->radius; i++) {
        uint64_t own = random_key(key, i);
        float share = clampf(y / fmaxf(c->height, 1.0f), 0.0f, 1.0f);
        float r =
            c->radius * (1.0f - c->taper * share) * random_range(random_key(own, 0), 0.8f, 1.15f);
        Vec3 off = vec3_scale(random_direction(random_key(own, 1)), 0.3f * c->radius);
        Puff ball = {.center = vec3(c->foot.x + off.x + c->lean_x * y, c->foot.y + y,
                                    c->foot.z + off.z + c->lean_z * y),
                     .radius = r,
                     .flatness = 1.0f,
                     .softness = puffs_worn(c->softness, c->wear * (1.0f - share))};
        if (!add_bulging(p, ball, c->wear, FLANK_LEVELS, random_key(own, 2), e)) {
            return false;
        }
        y += 0.75f * r;
    }
    return true;
}

// ---- a storm ----

// Directions of a storm: along its wind and across it.
typedef struct StormFrame {
    const Cloud *cloud;
    float sine, cosine; // of the wind's azimuth
    float top;          // m: altitude of the anvil's upper side
} StormFrame;

static StormFrame storm_frame(const Cloud *cloud)
{
    float wind = cloud->wind * RADIANS_PER_DEGREE;
    return (StormFrame){cloud, sinf(wind), cosf(wind), cloud->base + 0.9f * cloud->thickness};
}

// A place in shares of the storm's size downwind of its centre and beside it; y: altitude, m.
static Vec3 storm_place(const StormFrame *f, float along, float aside, float y)
{
    along *= f->cloud->size;
    aside *= f->cloud->size;
    return vec3(f->cloud->center_x + along * f->sine + aside * f->cosine, y,
                f->cloud->center_z + along * f->cosine - aside * f->sine);
}

// How far the anvil reaches about its middle, in shares of its mean: lobes of outflow.
static float outflow(float angle, uint64_t key)
{
    float a = 2.0f * PI_F * random_unit(random_key(key, 0));
    float b = 2.0f * PI_F * random_unit(random_key(key, 1));
    return 1.0f + 0.12f * sinf(2.0f * angle + a) + 0.1f * sinf(5.0f * angle + b);
}

// The anvil: air that has risen to the tropopause spreads below it in one sheet, thick about the
// tower, from which it flares, and thinner outward; drawn out downwind, where it dissolves to
// veils, and firm as knuckles upwind.
static bool add_anvil(Puffs *p, const StormFrame *f, uint64_t key, Error *e)
{
    enum { BALLS = 320 };
    const Cloud *cloud = f->cloud;
    for (uint64_t i = 0; i < BALLS; i++) {
        uint64_t own = random_key(key, i);
        float share = sqrtf(random_unit(random_key(own, 0)));
        float angle = random_range(random_key(own, 1), 0.0f, 2.0f * PI_F), down = cosf(angle);
        float far = share * outflow(angle, key);
        float radius = cloud->size * (0.44f - 0.2f * share);
        radius *= random_range(random_key(own, 2), 0.8f, 1.15f);
        float flatness = 1.7f + 2.0f * share + 0.8f * share * fmaxf(down, 0.0f);
        float y = f->top - 0.95f * radius / flatness;
        y -= 0.03f * cloud->thickness * random_unit(random_key(own, 3)) * (1.0f - share);
        float soft = 0.15f * share + 0.7f * share * fmaxf(0.25f + 0.75f * down, 0.0f);
        Puff ball = {.center =
                         storm_place(f, 0.65f + 1.85f * far * down, 1.45f * far * sinf(angle), y),
                     .radius = radius,
                     .flatness = flatness,
                     .softness = puffs_worn(0.05f, soft)};
        int bulges = down < 0.4f || share < 0.5f ? 2 : 0;
        if (!add_bulging(p, ball, cloud->softness, bulges, random_key(own, 4), e)) {
            return false;
        }
    }
    return true;
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
        if (!add_bulging(p, ball, 0.5f * cloud->softness, FLANK_LEVELS, random_key(own, 3), e)) {
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
                    .wear = cloud->softness};
    return puffs_add_column(p, &tower, key, e);
}

// The main tower with turrets of all heights about it, and the flanking line: ever younger towers
// in steps down to the upwind side.
static bool add_towers(Puffs *p, const StormFrame *f, uint64_t key, Error *e)
{
    enum { TURRETS = 11, STEPS = 7 };
    float base = f->cloud->base;
    bool done =
        add_tower(p, f, storm_place(f, 0.0f, 0.0f, base), 0.38f, 0.8f, random_key(key, 0), e);
    for (uint64_t i = 0; done && i < TURRETS; i++) {
        uint64_t own = random_key(key, 1 + i);
        float angle = 2.0f * PI_F * ((float)i + random_unit(random_key(own, 0))) / TURRETS;
        float off = random_range(random_key(own, 1), 0.3f, 0.52f);
        float height = random_range(random_key(own, 2), 0.3f, 0.78f);
        done = add_tower(p, f, storm_place(f, off * cosf(angle), off * sinf(angle), base),
                         random_range(random_key(own, 3), 0.17f, 0.27f), height, random_key(own, 4),
                         e);
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

bool puffs_grow_storm(Puffs *p, const Cloud *cloud, uint64_t key, Error *e)
{
    StormFrame f = storm_frame(cloud);
    return add_towers(p, &f, random_key(key, 0), e) && add_anvil(p, &f, random_key(key, 1), e) &&
           add_dome(p, &f, random_key(key, 2), e) &&
           (cloud->shelf == 0.0f || add_shelf(p, cloud, random_key(key, 3), e));
}

void puffs_clear(Puffs *puffs)
{
    free(puffs->puff);
    *puffs = (Puffs){0};
}
