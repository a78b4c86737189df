#include "grow/venation/secondaries.h"

#include "base/random.h"

#define LOWEST 0.02f    // v of the first base
#define HIGHEST 0.90f   // v up to which bases lie
#define STAGGER 0.22f   // of their distance: the sides alternate
#define UNEVEN 0.14f    // of their distance: random
#define ARCH_LEAD 0.10f // u that an arch goes on toward the margin before it bends back

static float height_at(const Secondary *vein, float u)
{
    return vein->base + vein->rise * u * (0.62f + 0.38f * u);
}

// What a vein with this base would gain up to the margin, at most.
static float mean_rise(const LeafOutline *outline, float base)
{
    float full = leaf_half_width(outline, base * outline->length) / (0.5f * outline->width);
    return 0.07f + 0.16f * full;
}

// Without its arch.
static Secondary make_course(const LeafOutline *outline, int number, int count, float side,
                             uint64_t key)
{
    uint64_t own = random_key(key, 2 * (uint64_t)number + (side > 0.0f));
    float place =
        (float)number + 0.5f + STAGGER * side + random_range(random_key(own, 0), -UNEVEN, UNEVEN);
    Secondary vein = {.side = side, .base = LOWEST + (HIGHEST - LOWEST) * place / (float)count};
    vein.rise = mean_rise(outline, vein.base) * random_range(random_key(own, 1), 0.92f, 1.08f);
    float room = 0.97f - vein.base;
    vein.rise = vein.rise < room ? vein.rise : room;
    return vein;
}

Secondary secondary_make(const LeafOutline *outline, int number, int count, float side,
                         uint64_t key)
{
    Secondary vein = make_course(outline, number, count, side, key);
    vein.has_arch = number + 1 < count;
    if (vein.has_arch) {
        Secondary next = make_course(outline, number + 1, count, side, key);
        float slope = vein.rise * (0.62f + 0.76f * SECONDARY_TURN);
        vein.arch[0] = (Vec2){SECONDARY_TURN, height_at(&vein, SECONDARY_TURN)};
        vein.arch[1] =
            (Vec2){vein.arch[0].x + ARCH_LEAD, vein.arch[0].y + ARCH_LEAD * slope + 0.01f};
        vein.arch[2] = (Vec2){SECONDARY_JOIN, height_at(&next, SECONDARY_JOIN)};
    }
    return vein;
}

static Vec3 on_blade(const LeafOutline *outline, const Secondary *vein, Vec2 at)
{
    float y = at.y * outline->length;
    return vec3(vein->side * at.x * leaf_half_width(outline, y), y, 0);
}

Vec3 secondary_point(const LeafOutline *outline, const Secondary *vein, float t)
{
    float u = SECONDARY_TURN * t;
    return on_blade(outline, vein, (Vec2){u, height_at(vein, u)});
}

Vec3 secondary_arch_point(const LeafOutline *outline, const Secondary *vein, float t)
{
    const Vec2 *p = vein->arch;
    float a = (1.0f - t) * (1.0f - t), b = 2.0f * t * (1.0f - t), c = t * t;
    return on_blade(
        outline, vein,
        (Vec2){a * p[0].x + b * p[1].x + c * p[2].x, a * p[0].y + b * p[1].y + c * p[2].y});
}

float secondary_number(const LeafOutline *outline, int count, Vec3 p)
{
    float half = leaf_half_width(outline, p.y), v = p.y / outline->length, base = v;
    float u = half > 0.0f ? fminf(fabsf(p.x) / half, 1.0f) : 0.0f;
    for (int i = 0; i < 2; i++) { // the rise depends a little on the base
        base = v - mean_rise(outline, base) * u * (0.62f + 0.38f * u);
    }
    return (base - LOWEST) / (HIGHEST - LOWEST) * (float)count - 0.5f -
           STAGGER * (p.x < 0.0f ? -1.0f : 1.0f);
}
