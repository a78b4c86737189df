// Floating pads of water plants: nearly round about the stalk's end, with a notch that reaches it;
// afloat, hence flat, but for a rim that waves and here and there turns up. uv: the pad seen from
// above, the stalk's end at (0.5, 0.5), the rim about 0.5 away.
#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "mesh/leaf/blade.h"

// Of a blade.
enum { STREAM_NOTCH = 1, STREAM_RIM = 2, STREAM_WAVE = 3, STREAM_TURNED = 4, STREAM_LOBE = 5 };

#define RIM 0.22f     // share of the radius that may turn up
#define CORNER 24.0f  // degrees beside the notch within which the lobes are rounded
#define ROUNDED 0.14f // of the radius, at the lobes' corners

typedef struct Pad {
    const LeafParams *params;
    uint64_t seed;
    float notch; // degrees between its edge and the middle of the notch, at the rim
    float lobe;  // by how much one lobe is lifted over the other, in widths
} Pad;

// Noise that is even all round the pad, about `lumps` features.
static float around(const Pad *pad, int stream, float lumps, float sine, float cosine)
{
    float k = lumps / (2.0f * PI_F);
    return noise_plane_fractal(k * sine, k * cosine, 2, random_key(pad->seed, (uint64_t)stream));
}

// The point at `along` (0..1) of the way from the stalk to the rim and `across` (-1..1) from one
// edge of the notch to the other.
static Vec3 pad_point(const Pad *pad, float along, float across, Vec2 *uv)
{
    const LeafParams *p = pad->params;
    float notch = pad->notch * (0.35f + 0.65f * along), from_edge = (1.0f - fabsf(across)) * 180.0f;
    float sine, cosine, up, in;
    exact_sincos(across * (180.0f - notch) * RADIANS_PER_DEGREE, &sine, &cosine);
    float corner = 1.0f - fminf(from_edge / CORNER, 1.0f);
    float reach = along * (1.0f - ROUNDED * corner * corner) *
                  (0.96f + 0.038f * around(pad, STREAM_RIM, 9.0f, sine, cosine));
    // The rim bends up along an arc where it does.
    float turned = smoothstepf(-0.12f, 0.3f, around(pad, STREAM_TURNED, 5.0f, sine, cosine));
    float outer = fmaxf(along - (1.0f - RIM), 0.0f) / RIM;
    exact_sincos(0.5f * p->curl * RADIANS_PER_DEGREE * turned * outer, &up, &in);
    float flat = reach - RIM * outer * (1.0f - in);
    float lift = 0.5f * p->width * RIM * outer * up;
    lift += p->wave * p->width * along * along * around(pad, STREAM_WAVE, 16.0f, sine, cosine);
    lift += pad->lobe * p->width * along * corner * (across < 0.0f ? -1.0f : 1.0f);
    float x = 0.5f * p->width * flat * sine, fold_sine, fold_cosine;
    exact_sincos(p->fold * RADIANS_PER_DEGREE, &fold_sine, &fold_cosine);
    lift += fabsf(x) * fold_sine;
    *uv = (Vec2){0.5f + 0.5f * reach * sine, 0.5f + 0.5f * reach * cosine};
    return vec3(x * fold_cosine, p->petiole + 0.5f * p->length * flat * cosine, lift);
}

// One quad of about the pad's area.
static void add_square(Quads *quads, const LeafParams *p)
{
    const float half = 0.44f, side[4] = {-half, half, half, -half},
                end[4] = {-half, -half, half, half};
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        v[i] = quads_vertex(quads, vec3(side[i] * p->width, p->petiole + end[i] * p->length, 0.0f),
                            (Vec2){0.5f + side[i], 0.5f + end[i]});
    }
    quads_face(quads, v[0], v[1], v[2], v[3]);
}

void blade_pad_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed)
{
    if (detail == BLADE_KITE) {
        add_square(quads, params);
        return;
    }
    bool fine = detail == BLADE_FINE, close = fine && params->detail > 2;
    int rows = close ? 33 : fine ? 12 : detail == BLADE_PLAIN ? 4 : 2;
    int columns = close ? 161 : fine ? 49 : detail == BLADE_PLAIN ? 15 : 9;
    Pad pad = {.params = params,
               .seed = seed,
               .notch = random_range(random_key(seed, STREAM_NOTCH), 2.0f, 15.0f),
               .lobe = random_range(random_key(seed, STREAM_LOBE), -0.02f, 0.02f)};
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        // rows are closer toward the rim, which bends
        float along = fmaxf(exact_pow((float)r / (float)(rows - 1), 0.6f), 0.01f);
        for (int c = 0; c < columns; c++) {
            float across = (float)c / (float)(columns - 1) * 2.0f - 1.0f;
            Vec2 uv;
            Vec3 p = pad_point(&pad, along, across, &uv);
            quads_vertex(quads, p, uv);
        }
    }
    quads_grid(quads, first, rows, columns);
}
