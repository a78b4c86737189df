// Bentonite swells to several times its volume, and shrinks when it dries: the skin of a slope
// breaks into polygons of a decimetre or two and these into crumbs of one to a few centimetres,
// like popcorn; mud that stood level into plates whose edges curl up. Where rain has sealed the
// skin, crumbs are fewer.
#include "render/material/pattern_clay.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

enum { SEED_CLAY = 1301, SEED_BEND = 1311, SEED_SEALED = 1317, SIZES = 4 };

typedef struct Pieces {
    float size;         // m, of a piece
    float width;        // of its rim, in sizes: to where its top is level
    float crumb, plate; // heights of it as a crumb and as a plate, in sizes
} Pieces;

static const Pieces PIECES[SIZES] = {{0.23f, 0.10f, 0.12f, 0.10f},
                                     {0.088f, 0.30f, 0.34f, 0.07f},
                                     {0.036f, 0.42f, 0.45f, 0.0f},
                                     {0.015f, 0.45f, 0.40f, 0.0f}};

// Cracks wander: the place bent by noise of about a piece.
static Vec3 bent(Vec3 p, float size, uint32_t seed)
{
    Vec3 q = vec3_scale(p, 1.0f / size), broad, fine;
    noise_solid(vec3_scale(q, 0.7f), seed, &broad);
    noise_solid(vec3_scale(q, 2.3f), seed + 1, &fine);
    return vec3_madd(vec3_madd(q, 0.13f, broad), 0.035f, fine);
}

// A crumb: a dome, some higher than others. A plate: its rim curls up, on some sides more.
static float piece_height(const Pieces *k, const CellPoint *cell, float level)
{
    float in = smoothstepf(0.0f, k->width, cell->border), own = noise_unit(cell->cell, 3);
    float crumb = k->crumb * (in * (0.45f + 0.9f * own) - 0.7f);
    float curl = 1.0f - smoothstepf(0.05f, 0.32f, cell->border);
    float side = 0.5f + 0.5f * noise_unit(cell->cell ^ cell->next, 4);
    float gap = 1.0f - smoothstepf(0.02f, 0.07f, cell->border);
    float plate = k->plate * (1.4f * own * side * curl - 2.2f * gap);
    return lerpf(crumb, plate, level);
}

DriedClay pattern_dried_clay(const SurfacePoint *point, float amount, float level)
{
    DriedClay clay = {0};
    Vec3 normal = surface_smooth_normal(point);
    if (amount <= 0.0f || pattern_detail(PIECES[0].size, point->footprint) <= 0.0f) {
        return clay;
    }
    float sealed = pattern_octaves(point, 1.9f, 5, 0.6f, 1.0f, SEED_SEALED).value;
    for (uint32_t k = 0; k < SIZES; k++) {
        const Pieces *pieces = &PIECES[k];
        // The finest crumbs go first where the skin is sealed.
        float loose = smoothstepf(-0.9f + 0.25f * (float)k, 0.3f + 0.2f * (float)k, sealed + 0.45f);
        float seen = amount * loose * pattern_detail(pieces->size, point->footprint);
        if (seen <= 0.0f) {
            continue;
        }
        CellPoint cell = noise_cells_on(
            bent(point->object_position, pieces->size, SEED_BEND + 2 * k), normal, SEED_CLAY + k);
        float crack = 1.0f - smoothstepf(0.0f, 0.5f * pieces->width + 0.03f, cell.border);
        float shown = pieces->plate > 0.0f ? seen : seen * (1.0f - level);
        clay.height += shown * pieces->size * piece_height(pieces, &cell, level);
        clay.shade = fmaxf(clay.shade, 0.8f * shown * crack);
        clay.tone += 0.7f * shown * (noise_unit(cell.cell, 5) - 0.5f);
    }
    return clay;
}
