#include "render/cloud/puffs.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

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

bool puffs_add_bulging(Puffs *p, Puff ball, float wear, int levels, uint64_t key, Error *e)
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
            !puffs_add_bulging(p, child, wear, levels - 1, random_key(own, 3), e)) {
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
        if (!puffs_add_bulging(p, ball, c->wear, PUFF_LEVELS, random_key(own, 2), e)) {
            return false;
        }
        y += 0.75f * r;
    }
    return true;
}

void puffs_clear(Puffs *puffs)
{
    free(puffs->puff);
    *puffs = (Puffs){0};
}
