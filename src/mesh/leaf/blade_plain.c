// Blades with one midrib and an undivided outline, smooth or saw-toothed. Ribs run from the midrib
// obliquely to the margin, as side veins do.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/leaf/blade.h"

enum { STREAM_WAVE_PHASE = 1, STREAM_SIDE = 2 }; // of a blade
enum { MOST_ROWS = 512 };

// Half width to both sides of the widest place: (1 - x^bend)^pinch, x = 0 there and 1 at the end.
// bend near 1 makes a corner at the widest place, a pinch of 0.5 a rounded end, 1 a pointed one.
typedef struct Outline {
    float widest;
    float base_bend, base_pinch, tip_bend, tip_pinch;
    float heart; // depth of the base's lobes, relative to the length
} Outline;

static Outline outline_of(const LeafParams *params)
{
    Outline outline = {0.42f, 2.0f, 0.6f, 2.0f, 1.1f, 0.0f}; // ovate
    switch (params->shape) {
    case LEAF_OBOVATE:
        outline = (Outline){0.66f, 1.5f, 1.15f, 2.3f, 0.8f, 0.0f};
        break;
    case LEAF_LANCEOLATE:
        outline = (Outline){0.36f, 2.0f, 0.9f, 1.6f, 1.4f, 0.0f};
        break;
    case LEAF_LINEAR:
        outline = (Outline){0.28f, 2.5f, 0.6f, 2.1f, 1.1f, 0.0f};
        break;
    case LEAF_CORDATE:
        outline = (Outline){0.3f, 2.2f, 0.32f, 1.9f, 1.25f, 0.2f};
        break;
    case LEAF_RHOMBIC:
        outline = (Outline){0.3f, 1.5f, 0.62f, 1.2f, 1.12f, 0.0f};
        break;
    default:
        break;
    }
    if (params->widest > 0.0f) {
        outline.widest = clampf(params->widest, 0.05f, 0.95f);
    }
    if (params->tip > 0.0f) {
        outline.tip_pinch = 0.5f * exact_pow(4.4f, params->tip);
    }
    return outline;
}

static Vec2 margin(const Outline *outline, float s)
{
    bool base = s < outline->widest;
    float x = base ? (outline->widest - s) / outline->widest
                   : (s - outline->widest) / (1.0f - outline->widest);
    float inside = 1.0f - exact_pow(x, base ? outline->base_bend : outline->tip_bend);
    float half = exact_pow(inside, base ? outline->base_pinch : outline->tip_pinch);
    // The lobes of a heart: back from the stalk's end, deepest at q.
    const float q = 0.07f, rise = 0.55f, fall = rise * (1.0f - q) / q;
    float back = outline->heart > 0.0f
                     ? exact_pow(s / q, rise) * exact_pow((1.0f - s) / (1.0f - q), fall)
                     : 0.0f;
    return (Vec2){half, s - outline->heart * back};
}

Vec2 blade_margin(const LeafParams *params, float s)
{
    Outline outline = outline_of(params);
    return margin(&outline, s);
}

// A saw that rises over the first share of each tooth and falls over the rest.
static float saw(float x)
{
    const float point = 0.72f;
    float phase = x - floorf(x);
    return (phase < point ? phase / point : (1.0f - phase) / (1.0f - point)) - 0.5f;
}

float blade_tooth(const LeafParams *params, float s)
{
    float x = s * (float)params->teeth;
    float tooth = params->double_teeth ? 0.7f * saw(x) + 0.3f * saw(3.0f * x) : saw(x);
    return tooth * smoothstepf(0.02f, 0.16f, s) * smoothstepf(1.0f, 0.9f, s);
}

int blade_rows(const LeafParams *params, int plain_rows, float *s, int most)
{
    bool close = params->detail > 2 && !params->double_teeth;
    int each = params->double_teeth || close ? 6 : 2;
    int rows = params->teeth * each + 1;
    // Notches at 0, points at 0.72 of every tooth; the small teeth likewise.
    static const float at_one[2] = {0.0f, 0.72f};
    static const float at_close[6] = {0.0f, 0.25f, 0.5f, 0.72f, 0.81f, 0.91f};
    static const float at_three[6] = {0.0f, 0.24f, 0.333333f, 0.573333f, 0.72f, 0.906667f};
    if (params->teeth == 0 || rows > most) {
        for (int r = 0; r < plain_rows; r++) {
            float t = (float)r / (float)(plain_rows - 1);
            // seen from near, rows lie closer at the ends, where the outline bends
            s[r] = params->detail > 2 ? t * t * (3.0f - 2.0f * t) : t;
        }
        return plain_rows;
    }
    for (int r = 0; r + 1 < rows; r++) {
        int tooth = r / each;
        float within = params->double_teeth ? at_three[r % each]
                       : close              ? at_close[r % each]
                                            : at_one[r % each];
        s[r] = ((float)tooth + within) / (float)params->teeth;
    }
    s[rows - 1] = 1.0f;
    return rows;
}

void blade_plain_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed)
{
    bool fine = detail == BLADE_FINE, close = fine && params->detail > 2;
    Outline outline = outline_of(params);
    LeafParams toothed = *params;
    toothed.teeth = fine ? params->teeth : 0;
    float s[MOST_ROWS];
    bool heart = outline.heart > 0.0f;
    int rows = blade_rows(&toothed,
                          detail == BLADE_SMOOTH ? 5
                          : close                ? 61
                          : fine                 ? 15
                          : heart                ? 9
                                                 : 7,
                          s, MOST_ROWS);
    int columns = close ? 15 : fine ? 7 : 3;
    float phase = random_range(random_key(seed, STREAM_WAVE_PHASE), -0.5f, 0.5f);
    float side = random_range(random_key(seed, STREAM_SIDE), -0.04f, 0.04f); // one half is wider
    const float lean = 0.3f;                                                 // of the ribs
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        // Ends are narrow but not of no width; rows of a heart's lobes lie closer.
        float at = clampf(heart && toothed.teeth == 0 ? s[r] * (0.45f + 0.55f * s[r]) : s[r],
                          0.006f, 0.99f);
        Vec2 edge = margin(&outline, at);
        float middle = s[r] - lean * s[r] * (1.0f - s[r]);
        float tooth = toothed.teeth > 0 ? blade_tooth(&toothed, s[r]) * params->tooth_depth : 0.0f;
        for (int c = 0; c < columns; c++) {
            float across = (float)c / (float)(columns - 1) * 2.0f - 1.0f;
            float out = fabsf(across), sine, cosine;
            float half = 0.5f * edge.x * (1.0f + (across < 0.0f ? side : -side)) +
                         (out == 1.0f ? tooth : 0.0f);
            float t = lerpf(middle, edge.y + (out == 1.0f ? 0.3f * tooth : 0.0f), out);
            // A sickle leaves the line of its base with the square of the way along it.
            float x = params->width * fmaxf(half, 0.004f) * across +
                      0.5f * params->sickle * RADIANS_PER_DEGREE * params->length * t * t;
            exact_sincos(2.0f * PI_F * (2.6f * t + phase + 0.3f * across), &sine, &cosine);
            float ripple = params->wave * params->width * sine * out * out * edge.x;
            quads_vertex(quads, blade_point(params, x, t, ripple),
                         (Vec2){0.5f + 0.5f * across, s[r]});
        }
    }
    quads_grid(quads, first, rows, columns);
}
