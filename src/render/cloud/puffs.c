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
        child.center = vec3_madd(ball.center, off, d);
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
            c->radius * (1.0f - 0.35f * share) * random_range(random_key(own, 0), 0.8f, 1.15f);
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

// A disc of flattened balls under the tropopause, drawn out downwind and thinner there.
static bool add_anvil(Puffs *p, const Cloud *cloud, uint64_t key, Error *e)
{
    enum { BALLS = 220 };
    float wind = cloud->wind * RADIANS_PER_DEGREE, sine = sinf(wind), cosine = cosf(wind);
    float top = cloud->base + 0.88f * cloud->thickness;
    for (uint64_t i = 0; i < BALLS; i++) {
        uint64_t own = random_key(key, i);
        float share = sqrtf(random_unit(random_key(own, 0)));
        float angle = random_range(random_key(own, 1), 0.0f, 2.0f * PI_F);
        float along = cloud->size * (0.9f + 2.4f * share * cosf(angle));
        float aside = cloud->size * 1.7f * share * sinf(angle);
        float radius = cloud->size * random_range(random_key(own, 2), 0.22f, 0.42f);
        float y = top + 0.02f * cloud->thickness * (random_unit(random_key(own, 3)) - 0.5f);
        Puff disc = {.center = vec3(cloud->center_x + along * sine + aside * cosine, y,
                                    cloud->center_z + along * cosine - aside * sine),
                     .radius = radius * (1.1f - 0.5f * share),
                     .flatness = 2.6f + 1.5f * share,
                     .softness = 0.4f + 0.6f * share};
        if (!puffs_add(p, disc, e)) {
            return false;
        }
    }
    return true;
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
    enum { TOWERS = 9 };
    for (uint64_t i = 0; i < TOWERS; i++) {
        uint64_t own = random_key(key, i);
        float share = (float)i / TOWERS; // the main tower first, the flanking line after it
        float angle = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float off = cloud->size * (0.1f + 0.75f * share);
        Column tower = {.foot = vec3(cloud->center_x + off * sinf(angle), cloud->base,
                                     cloud->center_z + off * cosf(angle)),
                        .radius = cloud->size * (0.34f - 0.17f * share),
                        .height = cloud->thickness * (0.95f - 0.75f * share),
                        .wear = cloud->softness};
        if (!puffs_add_column(p, &tower, random_key(own, 1), e)) {
            return false;
        }
    }
    return add_anvil(p, cloud, random_key(key, TOWERS), e) &&
           (cloud->shelf == 0.0f || add_shelf(p, cloud, random_key(key, TOWERS + 1), e));
}

void puffs_clear(Puffs *puffs)
{
    free(puffs->puff);
    *puffs = (Puffs){0};
}
