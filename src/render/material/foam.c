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

// How much farther the second nearest of random points, one in each unit square, is than the
// nearest: 0 on the borders of their cells (Worley 1996). noise_cells has steps inside of cells.
static float beyond_border(Vec2 p, uint32_t seed)
{
    float column = floorf(p.x), row = floorf(p.y), nearest = INFINITY, second = INFINITY;
    for (int n = 0; n < 9; n++) {
        int across = n % 3 - 1, down = n / 3 - 1;
        float x = column + (float)across, y = row + (float)down;
        uint32_t square = (uint32_t)(int32_t)x * 0x8da6b343u + (uint32_t)(int32_t)y * 0xd8163841u;
        float dx = x + 0.06f + 0.88f * noise_unit(square, seed) - p.x;
        float dy = y + 0.06f + 0.88f * noise_unit(square, seed + 1) - p.y;
        float squared = dx * dx + dy * dy;
        second = fminf(second, fmaxf(nearest, squared));
        nearest = fminf(nearest, squared);
    }
    return sqrtf(second) - sqrtf(nearest);
}

// The rank of what it tells: fitted to 400,000 places, within 0.01.
static float border_rank(float beyond)
{
    return 1.0f - expf(-beyond * (2.42f + beyond * (1.1f + 3.0f * beyond)));
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
enum { STILL = 1 };

float foam_share(float cover, FoamPlace place, float width)
{
    float share = patches(clampf(cover, 0.0f, 1.0f), place.drift, width);
    for (uint32_t i = 0; share > 0.0f && i < sizeof HOLE / sizeof HOLE[0]; i++) {
        float seen = pattern_detail(HOLE[i], width);
        if (seen <= 0.0f) {
            break;
        }
        Vec2 at = i < STILL ? place.drift : place.still;
        Vec2 p = {0.72f * at.x / HOLE[i], 1.3f * at.y / HOLE[i]};
        Vec3 bend = {1.3f * p.x, 0.5f, 1.3f * p.y};
        p.x += 0.38f * noise_solid(bend, 841 + i, NULL);
        p.y += 0.38f * noise_solid(bend, 851 + i, NULL);
        float rank = border_rank(beyond_border(p, 821 + 2 * i));
        share = lerpf(share, gathered(share, rank, 0.24f, 0.8f), 0.9f * seen);
    }
    return share;
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

static Vec2 lumps_slope(Vec2 at, float width)
{
    static const float size[] = {0.31f, 0.13f, 0.055f, 0.023f}; // m
    const float steep = 0.18f;                                  // of each size
    Vec2 slope = {0.0f, 0.0f};
    for (uint32_t i = 0; i < sizeof size / sizeof size[0]; i++) {
        float seen = pattern_detail(size[i], width);
        if (seen <= 0.0f) {
            break;
        }
        Vec3 gradient;
        (void)noise_solid(vec3(at.x / size[i], 0.3f, at.y / size[i]), 861 + i, &gradient);
        slope.x += seen * steep * gradient.x;
        slope.y += seen * steep * gradient.z;
    }
    return slope;
}

Vec2 foam_slope(float cover, float share, Vec2 at, float width)
{
    const float thick = 0.02f, steepest = 0.6f; // m; slope
    float step = fmaxf(width, 0.012f);
    Vec2 along = {at.x + step, at.y}, aside = {at.x, at.y + step};
    float x = foam_share(cover, (FoamPlace){along, along}, width) - share;
    float y = foam_share(cover, (FoamPlace){aside, aside}, width) - share;
    Vec2 lumps = lumps_slope(at, width);
    return (Vec2){clampf(thick * x / step + share * lumps.x, -steepest, steepest),
                  clampf(thick * y / step + share * lumps.y, -steepest, steepest)};
}
