// The fan of a ginkgo: rays from the stalk's end to a wavy rim with a notch in its middle. u runs
// along the rim, v along the rays.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/leaf/blade.h"

enum { STREAM_NOTCH = 1, STREAM_RIM = 2 }; // of a blade

void blade_fan_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed)
{
    bool fine = detail == BLADE_FINE;
    int rows = fine ? 8 : detail == BLADE_PLAIN ? 4 : 2;
    int columns = fine ? 41 : detail == BLADE_PLAIN ? 9 : 5;
    float notch = random_range(random_key(seed, STREAM_NOTCH), 0.15f, 0.5f);
    float phase = random_range(random_key(seed, STREAM_RIM), 0.0f, 6.0f);
    // The rim's ends point this far from the midrib, by the wanted width.
    float sine_most = clampf(0.5f * params->width / params->length, 0.2f, 0.99f);
    float most = exact_atan2(sine_most, sqrtf(1.0f - sine_most * sine_most));
    LeafParams flat = *params;
    flat.fold = 0.0f;
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        float v = (float)r / (float)(rows - 1);
        for (int c = 0; c < columns; c++) {
            float across = (float)c / (float)(columns - 1) * 2.0f - 1.0f, sine, cosine, wave, ray;
            exact_sincos(most * across, &sine, &cosine);
            float cut = fine ? notch / (1.0f + across * across * 260.0f) : 0.0f;
            exact_sincos(9.0f * across + phase, &wave, &ray);
            float rim = 1.0f - cut + (fine ? 0.025f * wave : 0.0f) - 0.06f * across * across;
            // The sides are hollow near the stalk.
            float reach = fmaxf(v, 0.03f) * rim * params->length;
            float spread = 0.55f + 0.45f * smoothstepf(0.0f, 0.8f, v);
            exact_sincos(5.0f * across + phase, &wave, &ray);
            float lift = fabsf(across) * reach * 0.5f * params->fold * RADIANS_PER_DEGREE +
                         params->wave * params->width * wave * v * v;
            quads_vertex(
                quads,
                blade_point(&flat, reach * sine * spread, reach * cosine / params->length, lift),
                (Vec2){0.5f + 0.5f * across, v});
        }
    }
    quads_grid(quads, first, rows, columns);
}
