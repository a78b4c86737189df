#include "render/cloud/anvil.h"

#include "base/random.h"

// In shares of the storm's size, from its centre: how far the sheet reaches with the wind, against
// it and across.
static const float DOWN = 3.0f, UP = 1.15f, ASIDE = 1.45f, MIDDLE = 0.3f;

// In shares of the thickness of the storm: what the sheet has at its rim and at the tower, how far
// it flares down to the tower, what pouches hang below it (mammatus), and how deep grooves between
// fibres are.
static const float THIN = 0.045f, THICK = 0.1f, FLARE = 0.12f, POUCH = 0.045f, GROOVE = 0.022f;

// In shares of the greatest extinction: ice at the tower, and at the end of the veil downwind. Of
// 0.1 g/m^3 in crystals of 30 um it is 0.005 1/m.
static const float DENSE = 0.25f, VEIL = 0.03f;

Anvil anvil_of(const Cloud *cloud, const DetailNoise *detail, uint64_t key)
{
    Anvil a = {.frame = storm_frame(cloud), .detail = detail};
    a.origin = vec3_scale(random_direction(random_key(key, 0)), 1e4f);
    for (uint64_t i = 0; i < 3; i++) {
        a.phase[i] = 2.0f * PI_F * random_unit(random_key(key, 1 + i));
    }
    return a;
}

// How far the sheet reaches that way about its middle, in shares of its mean: lobes of outflow.
static float outflow(const Anvil *a, float angle)
{
    return 1.0f + 0.08f * sinf(2.0f * angle + a->phase[0]) +
           0.06f * sinf(5.0f * angle + a->phase[1]) + 0.03f * sinf(11.0f * angle + a->phase[2]);
}

// Noise with features `long_` m along the wind and `wide` m across. A plane that is oblique to the
// lattice of the detail does not repeat.
static Vec3 grain_at(float along, float aside, float long_, float wide)
{
    const float cells = DETAIL_CELLS;
    float u = along / (cells * long_), v = aside / (cells * wide);
    return vec3(u + 0.31f * v, 0.79f * v - 0.23f * u, 0.53f * v + 0.41f * u);
}

static float slow_noise(const Anvil *a, float x, float z, float wide)
{
    Vec3 p = vec3_scale(vec3_add(a->origin, vec3(x, 0.4f * z, z)), 1.0f / (DETAIL_CELLS * wide));
    return detail_at(a->detail, p).wisp;
}

// Pouches that hang from the underside in patches, 0 .. 1.
static float pouches(const Anvil *a, float x, float z)
{
    float size = a->frame.cloud->size;
    float patch = smoothstepf(-0.1f, 0.35f, slow_noise(a, z, -x, 0.5f * size));
    Vec3 p = vec3(x + 0.4f * z, 0.3f * (x - z), z - 0.4f * x);
    float billow = detail_at(a->detail, vec3_scale(vec3_sub(p, a->origin),
                                                   1.0f / (DETAIL_CELLS * 0.13f * size)))
                       .billow;
    return patch * clampf(0.5f + 0.9f * billow, 0.0f, 1.0f);
}

// Fibres at a place of their noise, -1.3 .. 1.3 as a rule: ice that falls out of the sheet in
// streaks.
static float fibres(const Anvil *a, Vec3 grain)
{
    Vec3 p = vec3_madd(grain, 1e-4f, a->origin);
    return 1.5f * detail_at(a->detail, vec3_scale(p, 0.37f)).wisp +
           1.1f * detail_at(a->detail, p).wisp;
}

// Fills the sides of the sheet where it has room: a lens with a blunt rim, which flares down to the
// tower, with pouches and grooves on its underside. rim: 1 at the rim; tower: from its axis, in
// sizes.
static void set_sides(const Anvil *a, AnvilColumn *c, float x, float z, float rim, float tower)
{
    float tall = a->frame.cloud->thickness, inner = clampf(1.0f - rim, 0.0f, 1.0f);
    float near = clampf(1.0f - (tower - 0.3f) / 0.6f, 0.0f, 1.0f); // 1 at the tower
    // beyond the rim, what is missing
    float deep = rim < 1.0f ? sqrtf(1.0f - rim * rim * rim * rim) : -6.0f * (rim - 1.0f);
    float slow = slow_noise(a, x, z, 0.45f * a->frame.cloud->size);
    c->high = a->frame.top - tall * (0.02f * rim * rim - 0.012f * slow - 0.015f * near);
    c->low = c->high - tall * lerpf(THIN, THICK, inner * sqrtf(inner)) * deep;
    if (rim < 1.0f) {
        float fade = smoothstepf(1.0f, 0.8f, rim), off = smoothstepf(0.35f, 0.8f, tower);
        float groove = GROOVE * fibres(a, vec3_madd(c->grain, a->frame.top, c->grain_slope));
        c->low -= tall * (FLARE * near * near + fade * off * (POUCH * pouches(a, x, z) + groove));
    }
}

AnvilColumn anvil_column(const Anvil *a, float x, float z)
{
    const StormFrame *f = &a->frame;
    float size = f->cloud->size;
    float dx = (x - f->cloud->center_x) / size, dz = (z - f->cloud->center_z) / size;
    float along = dx * f->sine + dz * f->cosine, aside = dx * f->cosine - dz * f->sine;
    float ahead = along - MIDDLE, down = fmaxf(ahead, 0.0f) / DOWN; // shares of the way downwind
    float u = ahead / (ahead > 0.0f ? DOWN : UP), v = aside / ASIDE;
    float sway = 0.1f * slow_noise(a, z, x, 0.8f * size); // fibres are not ruled lines
    AnvilColumn c = {.grain = grain_at(along, aside + sway, 1.1f, 0.055f),
                     .grain_slope = grain_at(1.2f / size, 0.06f / size, 1.1f, 0.055f)};
    float rim = sqrtf(u * u + v * v) / outflow(a, atan2f(v, u));
    rim += (0.05f + 0.1f * down) * slow_noise(a, x, z, 0.45f * size);
    rim += 0.15f * down * fibres(a, vec3_madd(c.grain, f->top, c.grain_slope));
    float tower = sqrtf(along * along + aside * aside);
    set_sides(a, &c, x, z, rim, tower);
    c.fibrous = smoothstepf(0.1f, 0.75f, rim * (0.5f + 0.5f * down) + 0.5f * down);
    c.softness = lerpf(0.1f, 0.4f, c.fibrous);
    c.share = lerpf(DENSE, VEIL, smoothstepf(0.0f, 0.9f, 0.3f * rim + 0.8f * down));
    c.share = lerpf(c.share, DENSE, smoothstepf(0.8f, 0.3f, tower));
    return c;
}

float anvil_share(const Anvil *a, const AnvilColumn *c, float altitude)
{
    float fibre = fibres(a, vec3_madd(c->grain, altitude, c->grain_slope));
    fibre = clampf(0.42f + fibre, 0.0f, 1.2f);
    return c->share * lerpf(1.0f, 1.5f * fibre * fibre, c->fibrous);
}

float anvil_depth(const AnvilColumn *c, float altitude)
{
    return fminf(c->high - altitude, altitude - c->low);
}
