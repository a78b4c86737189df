// An oak's blade: a grid of rows along the midrib and columns across.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/leaf/blade.h"

enum { STREAM_LOBE_PHASE = 1, STREAM_LOBE_SHIFT = 2 }; // of a leaf

float blade_oak_half(const LeafParams *params, float t, float phase)
{
    const float a = 0.9f, b = 0.55f, peak = a / (a + b);
    float oval = exact_pow(t / peak, a) * exact_pow((1.0f - t) / (1.0f - peak), b);
    if (params->lobes == 0) {
        return oval;
    }
    float sine, cosine;
    exact_sincos(2.0f * PI_F * ((float)params->lobes * t + phase), &sine, &cosine);
    // The squared raised cosine makes bays narrow and lobes broad.
    float bay = 0.5f + 0.5f * cosine;
    float reach = smoothstepf(0.02f, 0.25f, t) * smoothstepf(1.02f, 0.8f, t);
    return oval * (1.0f - params->lobe_depth * bay * bay * reach);
}

void blade_oak_add(Quads *quads, const LeafParams *given, BladeDetail detail, uint64_t seed)
{
    LeafParams smooth = *given;
    smooth.lobes = 0;
    const LeafParams *params = detail == BLADE_SMOOTH ? &smooth : given;
    bool fine = detail == BLADE_FINE;
    int rows = detail == BLADE_SMOOTH ? 5
               : params->lobes == 0   ? (fine ? 12 : 6)
                                      : (fine ? 6 : 2) * params->lobes + 1;
    int columns = fine ? 5 : 3;
    float phase = random_range(random_key(seed, STREAM_LOBE_PHASE), -0.15f, 0.15f);
    float side_shift = random_range(random_key(seed, STREAM_LOBE_SHIFT), 0.1f, 0.35f);
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        float t = (float)r / (float)(rows - 1);
        for (int c = 0; c < columns; c++) {
            float across = (float)c / (float)(columns - 1) * 2.0f - 1.0f;
            // The lobes of the two sides are slightly offset.
            float half = blade_oak_half(params, clampf(t, 0.012f, 0.985f),
                                        phase + (across < 0.0f ? side_shift : 0.0f));
            float x = 0.5f * params->width * half * across;
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (3.0f * t + phase + 0.3f * across), &sine, &cosine);
            float ripple = params->wave * params->width * sine * across * across * half;
            quads_vertex(quads, blade_point(params, x, t, ripple), (Vec2){0.5f + 0.5f * across, t});
        }
    }
    quads_grid(quads, first, rows, columns);
}
