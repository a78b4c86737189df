// Foam is parted size by size, from patches of metres to bubbles of centimetres: at each size a
// share of it is moved from holes into what is left between them. The rank of a place, 0..1, tells
// how far inside a hole it is; since ranks are evenly distributed, each step keeps the mean, and a
// size that the pixel does not show can be left out.
#include "render/material/foam.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

// The rank of a value of noise_solid in a plane; its distribution is that of Gauss.
static float noise_rank(float value)
{
    float x = value / 0.252f;
    return 1.0f / (1.0f + expf(-x * (1.5976f + 0.07056f * x * x)));
}

// How far inside of a hole a place is not: the least distance to random points, one in each unit
// square, over the reach of each, so that borders of holes are arcs, as those of bubbles are. 0 in
// the middle of a hole, greatest where three strands meet; no farther than points of the squares
// around are looked at.
static float beyond_holes(Vec2 p, uint32_t seed)
{
    float column = floorf(p.x), row = floorf(p.y), least = 1.06f * 1.06f;
    for (int n = 0; n < 9; n++) {
        int across = n % 3 - 1, down = n / 3 - 1;
        float x = column + (float)across, y = row + (float)down;
        uint32_t square = (uint32_t)(int32_t)x * 0x8da6b343u + (uint32_t)(int32_t)y * 0xd8163841u;
        float dx = x + 0.06f + 0.88f * noise_unit(square, seed) - p.x;
        float dy = y + 0.06f + 0.88f * noise_unit(square, seed + 1) - p.y;
        float reach = 0.58f + 0.42f * noise_unit(square, seed + 2);
        least = fminf(least, (dx * dx + dy * dy) / (reach * reach));
    }
    return least;
}

// The rank of the square of that distance: fitted to 400,000 places, within 0.014.
static float strand_rank(float squared)
{
    float fourth = squared * squared;
    return expf(-2.032f * squared - 1.7603f * fourth + 0.1162f * fourth * fourth);
}

// Foam at a place of this rank, where its mean is `share`: it lies on the lowest ranks. `least` is
// the share that thin foam gathers to, but the thinnest, which would make hairs, stays a veil;
// `soft` the ranks over which its edge fades.
static float gathered(float share, float rank, float least, float soft)
{
    if (share <= 0.0f) {
        return 0.0f;
    }
    const float veil = 0.03f;
    float peak = share * (1.0f + (1.0f - share) * least / (share + veil)), covered = share / peak;
    float width = fminf(soft, 2.0f * fminf(covered, 1.0f - covered));
    float from = covered - 0.5f * width;
    return peak * (1.0f - smoothstepf(from, from + fmaxf(width, 1e-6f), rank));
}

// Loose patches, wind-blown: of sizes in m.
static float patches(float share, Vec2 at, float width)
{
    static const float size[] = {9.0f, 3.7f, 1.4f};
    for (uint32_t i = 0; i < 3; i++) {
        float seen = pattern_detail(size[i], width);
        if (seen > 0.0f) {
            Vec3 p = {at.x / size[i], 0.37f, 1.35f * at.y / size[i]};
            float rank = noise_rank(noise_solid(p, 831 + i, NULL));
            share = lerpf(share, gathered(share, rank, 0.25f, 1.0f), 0.5f * seen);
        }
    }
    return share;
}

// Sizes of holes, m; those from STILL on lie still.
static const float HOLE[] = {2.6f, 0.95f, 0.34f, 0.12f};
static const float GATHERS[] = {0.45f, 0.5f, 0.4f, 0.25f}; // what is left at each size does so much
enum { STILL = 1 };

// Lumps of a roller: of sizes in m. Between them it is thinner.
static float roller_share(float cover, Vec2 at, float width)
{
    static const float size[] = {1.1f, 0.45f, 0.19f, 0.08f};
    float share = cover;
    for (uint32_t i = 0; i < sizeof size / sizeof size[0]; i++) {
        float seen = pattern_detail(size[i], width);
        if (seen <= 0.0f) {
            break;
        }
        float rank =
            noise_rank(noise_solid(vec3(at.x / size[i], 0.7f, at.y / size[i]), 871 + i, NULL));
        share = lerpf(share, gathered(share, rank, 0.5f, 1.0f), 0.8f * seen);
    }
    return share;
}

// Old foam: a net about holes of some sizes.
static float lace_share(float cover, FoamPlace place, float width)
{
    float share = patches(cover, place.drift, width);
    for (uint32_t i = 0; share > 0.0f && i < sizeof HOLE / sizeof HOLE[0]; i++) {
        float seen = pattern_detail(HOLE[i], width);
        if (seen <= 0.0f) {
            break;
        }
        Vec2 at = i < STILL ? place.drift : place.still;
        Vec2 p = {0.72f * at.x / HOLE[i], 1.3f * at.y / HOLE[i]};
        Vec3 bend = {0.9f * p.x, 0.5f, 0.9f * p.y};
        p.x += 0.3f * noise_solid(bend, 841 + i, NULL);
        p.y += 0.3f * noise_solid(bend, 851 + i, NULL);
        float rank = strand_rank(beyond_holes(p, 821 + 3 * i));
        share = lerpf(share, gathered(share, rank, GATHERS[i], 1.0f), 0.9f * seen);
    }
    return share;
}

float foam_share(FoamCover foam, FoamPlace place, float width)
{
    float cover = clampf(foam.cover, 0.0f, 1.0f);
    float old = foam.fresh < 1.0f ? lace_share(cover, place, width) : 0.0f;
    float roller = foam.fresh > 0.0f ? roller_share(cover, place.still, width) : 0.0f;
    return lerpf(old, roller, clampf(foam.fresh, 0.0f, 1.0f));
}

// One eddy in each square of the spacing, within it, some of them turning the other way.
Vec2 foam_stirred(Vec2 at, float spacing, float turns, uint32_t seed)
{
    float column = floorf(at.x / spacing), row = floorf(at.y / spacing);
    uint32_t square =
        (uint32_t)(int32_t)column * 0x8da6b343u + (uint32_t)(int32_t)row * 0xd8163841u;
    float reach = lerpf(0.28f, 0.5f, noise_unit(square, seed));
    float x = at.x / spacing - column - lerpf(reach, 1.0f - reach, noise_unit(square, seed + 1));
    float y = at.y / spacing - row - lerpf(reach, 1.0f - reach, noise_unit(square, seed + 2));
    float inside = 1.0f - (x * x + y * y) / (reach * reach);
    if (inside <= 0.0f) {
        return at;
    }
    float turned = turns * (2.0f * noise_unit(square, seed + 3) - 1.0f) * inside * inside;
    float s = sinf(turned), c = cosf(turned) - 1.0f;
    return (Vec2){at.x + spacing * (c * x - s * y), at.y + spacing * (s * x + c * y)};
}

// Lumps of froth, and of lace, which is far flatter. Finer ones do not show: light wanders by
// centimetres within foam.
static Vec2 lumps_slope(float fresh, Vec2 at, float width)
{
    static const float size[] = {1.1f, 0.45f, 0.19f, 0.08f}; // m: as in roller_share
    static const float froth[] = {0.30f, 0.26f, 0.20f, 0.12f}, lace[] = {0.0f, 0.0f, 0.08f, 0.08f};
    Vec2 slope = {0.0f, 0.0f};
    for (uint32_t i = 0; i < sizeof size / sizeof size[0]; i++) {
        float seen = pattern_detail(size[i], width);
        if (seen <= 0.0f) {
            break;
        }
        Vec3 gradient;
        (void)noise_solid(vec3(at.x / size[i], 0.7f, at.y / size[i]), 871 + i, &gradient);
        float steep = seen * lerpf(lace[i], froth[i], fresh);
        slope.x -= steep * gradient.x; // roller_share gathers on the lowest values
        slope.y -= steep * gradient.z;
    }
    return slope;
}

Vec2 foam_slope(FoamCover foam, float share, FoamPlace at, float drawn, float width)
{
    const float thick = 0.02f, steepest = 0.7f; // m; slope
    float step = fmaxf(width, 0.012f);
    FoamPlace along = {{at.drift.x + drawn * step, at.drift.y}, {at.still.x + step, at.still.y}};
    FoamPlace aside = {{at.drift.x, at.drift.y + step}, {at.still.x, at.still.y + step}};
    float x = foam_share(foam, along, width) - share, y = foam_share(foam, aside, width) - share;
    Vec2 lumps = lumps_slope(foam.fresh, at.still, width);
    return (Vec2){clampf(thick * x / step + share * lumps.x, -steepest, steepest),
                  clampf(thick * y / step + share * lumps.y, -steepest, steepest)};
}
