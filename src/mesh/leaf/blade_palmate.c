// Palmately lobed blades: every lobe has a midrib of its own from the stalk's end, and neighbours
// share the line from there to the bay between them.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/leaf/blade.h"

enum { STREAM_LOBE_LENGTH = 10, STREAM_LOBE_TURN = 100 }; // + number of the lobe
enum { MOST_ROWS = 128, LEAST_LOBES = 3, MOST_LOBES = 15 };

// Of the whole blade; angles (radians) from +Y toward +X, lengths relative to the blade's.
typedef struct Palm {
    const LeafParams *params;
    int lobes;
    float turn[MOST_LOBES], length[MOST_LOBES];
    float bay_turn[MOST_LOBES + 1], bay[MOST_LOBES + 1]; // left of lobe i; the last right of all
    float stretch;                                       // of x, to the wanted width
    float phase;
} Palm;

static void palm_init(Palm *palm, const LeafParams *params, uint64_t seed)
{
    int n = params->lobes < LEAST_LOBES  ? LEAST_LOBES
            : params->lobes > MOST_LOBES ? MOST_LOBES
                                         : params->lobes;
    *palm = (Palm){.params = params, .lobes = n};
    float step = fminf(225.0f / (float)(n - 1), 62.0f) * RADIANS_PER_DEGREE;
    float middle = 0.5f * (float)(n - 1), widest = 0.0f;
    for (int i = 0; i < n; i++) {
        float from = fabsf((float)i - middle) / middle, sine, cosine;
        float vary = random_range(random_key(seed, STREAM_LOBE_LENGTH + (uint64_t)i), 0.95f, 1.05f);
        palm->turn[i] =
            ((float)i - middle) * step +
            random_range(random_key(seed, STREAM_LOBE_TURN + (uint64_t)i), -0.04f, 0.04f);
        palm->length[i] = (1.0f - 0.48f * exact_pow(from, 2.2f)) * (from > 0.0f ? vary : 1.0f);
        exact_sincos(palm->turn[i], &sine, &cosine);
        widest = fmaxf(widest, palm->length[i] * fabsf(sine));
    }
    float keep = 1.0f - params->lobe_depth;
    for (int i = 0; i <= n; i++) {
        bool inner = i > 0 && i < n;
        float base = fminf(fabsf(palm->turn[0]) + 0.6f * step, 2.95f);
        palm->bay_turn[i] = inner    ? 0.5f * (palm->turn[i - 1] + palm->turn[i])
                            : i == 0 ? -base
                                     : base;
        palm->bay[i] =
            inner ? keep * fminf(palm->length[i - 1], palm->length[i]) : 0.3f * palm->length[0];
    }
    palm->stretch = params->width / (2.0f * widest * params->length);
    palm->phase = random_unit(random_key(seed, STREAM_LOBE_LENGTH - 1));
}

// A point of a lobe in its own frame: `along` its midrib and `out` from it, relative to the blade's
// length; edge: 0 on the midrib, 1 on the margin. The line to the bay (v = 0) does not ripple,
// because the next lobe shares it.
static void add_point(Quads *quads, const Palm *palm, int lobe, Vec2 p, float edge, Vec2 uv)
{
    const LeafParams *params = palm->params;
    float sine, cosine, fold, fold_cosine, wave, unused;
    exact_sincos(palm->turn[lobe], &sine, &cosine);
    exact_sincos(params->fold * RADIANS_PER_DEGREE, &fold, &fold_cosine);
    exact_sincos(2.0f * PI_F * (2.0f * p.y + palm->phase + 0.37f * (float)lobe), &wave, &unused);
    float x = p.x * cosine + p.y * sine, y = p.y * cosine - p.x * sine;
    float lift = fabsf(p.x) * fold * params->length +
                 params->wave * params->width * wave * edge * edge * uv.y;
    LeafParams flat = *params;
    flat.fold = 0.0f;
    quads_vertex(quads, blade_point(&flat, x * params->length * palm->stretch, y, lift), uv);
}

// One half of a lobe, from the midrib to the margin: side -1 = left, 1 = right.
static void add_half(Quads *quads, const Palm *palm, int lobe, int side, BladeDetail detail)
{
    const LeafParams *params = palm->params;
    LeafParams toothed = *params;
    toothed.teeth = detail == BLADE_FINE ? params->teeth : 0;
    float s[MOST_ROWS];
    int rows = blade_rows(&toothed, detail == BLADE_FINE ? 9 : 4, s, MOST_ROWS);
    int columns = detail == BLADE_FINE ? 4 : 2;
    int at = lobe + (side > 0 ? 1 : 0);
    float sine, cosine, length = palm->length[lobe];
    exact_sincos(fabsf(palm->bay_turn[at] - palm->turn[lobe]), &sine, &cosine);
    Vec2 bay = {palm->bay[at] * sine, palm->bay[at] * cosine};
    float pinch = params->tip > 0.0f ? 0.5f * exact_pow(4.4f, params->tip) : 1.1f;
    float bulge = 0.35f * params->lobe_depth * length / (float)palm->lobes;
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        float end = fminf(s[r], 0.985f);
        float half = (bay.x + 4.0f * bulge * end * (1.0f - end)) *
                     exact_pow(1.0f - exact_pow(end, 1.5f), pinch);
        float tooth = toothed.teeth > 0
                          ? blade_tooth(&toothed, s[r]) * params->tooth_depth * (1.0f - 0.6f * s[r])
                          : 0.0f;
        half = fmaxf(half + tooth, 0.006f);
        float along = bay.y + (length - bay.y) * s[r] + 0.5f * tooth;
        float middle = length * s[r] * (0.8f + 0.2f * s[r]);
        for (int c = 0; c < columns; c++) {
            // Columns run left to right on both sides, so that all faces look up.
            float out = (float)(side < 0 ? columns - 1 - c : c) / (float)(columns - 1);
            Vec2 p = {(float)side * half * out, lerpf(middle, along, out)};
            add_point(quads, palm, lobe, p, out, (Vec2){0.5f + 0.5f * (float)side * out, s[r]});
        }
    }
    quads_grid(quads, first, rows, columns);
}

// A lobe as one quad: left bay, stalk's end, right bay, tip.
static void add_lobe_kite(Quads *quads, const Palm *palm, int lobe)
{
    Vec2 point[4] = {{0}};
    for (int side = 0; side < 2; side++) {
        float sine, cosine;
        exact_sincos(palm->bay_turn[lobe + side] - palm->turn[lobe], &sine, &cosine);
        point[2 * side] = (Vec2){palm->bay[lobe + side] * sine, palm->bay[lobe + side] * cosine};
    }
    point[3] = (Vec2){0.0f, palm->length[lobe]};
    static const Vec2 uv[4] = {{0, 0.4f}, {0.5f, 0}, {1, 0.4f}, {0.5f, 1}};
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int i = 0; i < 4; i++) {
        add_point(quads, palm, lobe, point[i], 0.0f, uv[i]);
    }
    quads_face(quads, first, first + 1, first + 2, first + 3);
}

void blade_palmate_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed)
{
    Palm palm;
    palm_init(&palm, params, seed);
    for (int i = 0; i < palm.lobes; i++) {
        if (detail == BLADE_SMOOTH) {
            add_lobe_kite(quads, &palm, i);
        } else {
            add_half(quads, &palm, i, -1, detail);
            add_half(quads, &palm, i, 1, detail);
        }
    }
}
