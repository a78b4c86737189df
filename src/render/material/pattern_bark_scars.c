// What a stem's life leaves on it: scars of shed limbs, ribs, holes of rot. They change its form
// where it is displaced, and its colour everywhere.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

static float bell(float t, float at, float width)
{
    float x = (t - at) / width;
    return expf(-x * x);
}

// A spot about the point of a cell: the distance from its middle over its radius, INFINITY where
// there is none. p: the place in units of the spots' spacing. share: of cells that have one.
typedef struct Spot {
    float t;
    float size;  // radius in those units
    float guard; // 0 at the border to another cell, which may have a spot of another size
    uint32_t hash;
} Spot;

static Spot spot_at(Vec3 p, float share, float least, float most, uint32_t seed)
{
    CellPoint cell = noise_cells(p, seed);
    Spot spot = {.t = INFINITY, .hash = cell.cell};
    if (noise_unit(cell.cell, 1) < share) {
        spot.size = lerpf(least, most, noise_unit(cell.cell, 2));
        spot.t = vec3_length(cell.point) / spot.size;
        spot.guard = clampf(cell.border / 0.06f, 0.0f, 1.0f);
    }
    return spot;
}

// Weakens the bark's own relief.
static void flatten(BarkSurface *bark, float by)
{
    bark->height *= 1.0f - by;
    bark->slope_u *= 1.0f - by;
    bark->slope_v *= 1.0f - by;
}

// A limb's scar: wood in the middle, closed by a ring of callus.
static void add_scar(const Material *m, const StemPlace *place, BarkSurface *bark)
{
    const float spacing = 0.34f; // m
    float thick = smoothstepf(0.04f, 0.10f, place->radius);
    Spot spot =
        spot_at(stem_lookup(place, spacing, 1.15f * spacing), 0.55f * m->scars, 0.10f, 0.26f, 81);
    if (spot.t > 1.6f || thick <= 0.0f) {
        return;
    }
    float wave = noise_fractal(vec3_scale(place->p, 40.0f), 2, 83);
    float t = spot.t + 0.08f * wave, guard = spot.guard * thick;
    float callus = bell(t, 0.78f, 0.24f), dent = 1.0f - smoothstepf(0.1f, 0.55f, t);
    bark->form += spot.size * spacing * guard * (0.32f * callus - 0.38f * dent);
    flatten(bark, guard * 0.75f * (1.0f - smoothstepf(0.7f, 1.2f, t)));
    // Rings of yearly callus, dark wood within.
    float rings = 0.5f + 0.5f * cosf(26.0f * t + 3.0f * wave);
    bark->color = vec3_scale(bark->color, 1.0f - guard * 0.25f * callus * rings);
    Vec3 wood = vec3_scale(vec3(0.085f, 0.066f, 0.050f), 1.0f + 0.4f * wave);
    bark->color = vec3_lerp(bark->color, wood, guard * 0.85f * dent);
}

// A scar on smooth bark, no two alike: a shallow oval, or wood laid bare in a rim of callus where
// it has not closed, under two dark lines that run down from its top to both sides, the ridge of
// bark that the limb and the stem pressed up between them. Few are large: most limbs fall thin.
static void add_eye(const Material *m, const StemPlace *place, BarkSurface *bark)
{
    const float around = 0.55f, along = 0.65f; // m
    float thick = smoothstepf(0.06f, 0.14f, place->radius);
    CellPoint cell = noise_cells(stem_lookup(place, around, along), 82);
    if (thick <= 0.0f || noise_unit(cell.cell, 1) > 0.6f * m->scars) {
        return;
    }
    float rank = noise_unit(cell.cell, 2), flat = lerpf(0.8f, 4.0f, noise_unit(cell.cell, 4));
    float size = lerpf(0.013f, 0.065f, rank * rank); // m: half its width
    float open = smoothstepf(0.55f, 0.85f, noise_unit(cell.cell, 3));
    float skew = lerpf(-0.4f, 0.4f, noise_unit(cell.cell, 5));
    float reach = lerpf(1.3f, 3.8f, noise_unit(cell.cell, 6));
    Vec3 torn;
    noise_solid(vec3_scale(place->p, 0.5f / size), 83, &torn);
    float u = (-around * vec3_dot(cell.point, place->along_u)) / size + 0.12f * torn.x;
    float v = -along * cell.point.z / size + skew * u + 0.12f * torn.z;
    float guard = thick * smoothstepf(0.0f, 0.06f, cell.border);
    float t = sqrtf(u * u + flat * v * v), side = fabsf(u);
    float arm = bell(v + 0.55f * side + 0.06f * side * side, 0.85f, 0.17f + 0.04f * side) *
                smoothstepf(reach, 0.35f * reach, side) * guard;
    float dent = guard * (1.0f - smoothstepf(0.4f, 0.95f, t)), rim = guard * bell(t, 1.15f, 0.25f);
    float deep = size * lerpf(0.08f, 0.32f, open);
    bark->form += fminf(deep, 0.014f) * (0.75f * rim - dent) + 0.05f * size * arm;
    float rings = 0.5f + 0.5f * cosf(16.0f * t + 5.0f * torn.y);
    bark->color = vec3_scale(bark->color, 1.0f - 0.15f * rim * rings - 0.4f * arm);
    Vec3 wood = vec3_scale(m->color2, 1.0f + 0.4f * torn.y);
    bark->color = vec3_lerp(bark->color, wood, lerpf(0.2f, 0.75f, open) * dent);
}

// Ribs run up from the roots; furrows lie between them, where the wood has died back.
static void add_ribs(const Material *m, const StemPlace *place, BarkSurface *bark)
{
    float thick = smoothstepf(0.04f, 0.14f, place->radius);
    if (thick <= 0.0f) {
        return;
    }
    float unit = 1.0f / fmaxf(place->radius, 1e-3f), length = 0.9f;
    Vec3 q = vec3(1.35f * unit * place->p.x, 1.35f * unit * place->p.y, place->p.z / length);
    float broad = noise_solid(q, 84, NULL);
    float fine = noise_solid(vec3(2.1f * q.x, 2.1f * q.y, 1.3f * q.z), 85, NULL);
    float valley = 1.0f - clampf(2.4f * fabsf(broad), 0.0f, 1.0f);
    float groove = 1.0f - clampf(2.8f * fabsf(fine), 0.0f, 1.0f);
    float in = 0.75f * valley * valley + 0.25f * groove * groove;
    bark->form += 0.5f * m->ribs * thick * place->radius * (0.3f - in);
    bark->color = vec3_scale(bark->color, 1.0f - 0.35f * thick * m->ribs * in);
}

// Wood that rot has eaten: soft strands along the grain with clefts between them, in places shrunk
// into cubes; grey where it weathers at the mouth, dark brown-grey within. place: where it really
// lies, below the stem's surface. deep: 0 at the mouth .. 1. Returns its relief, m.
static float add_rot(const StemPlace *place, float share, float deep, BarkSurface *bark)
{
    float fibre = noise_solid(stem_lookup(place, 0.004f, 0.07f), 88, NULL);
    float shred = noise_solid(stem_lookup(place, 0.013f, 0.21f), 96, NULL);
    float strand = noise_solid(stem_lookup(place, 0.032f, 0.40f), 89, NULL);
    float cleft = 1.0f - smoothstepf(0.0f, 0.16f, fabsf(strand + 0.25f * shred));
    Vec3 q = stem_lookup(place, 0.024f, 0.055f);
    float stain = noise_fractal(vec3_scale(q, 0.35f), 4, 97);
    CellPoint cube = noise_cells(vec3(q.x + 0.3f * shred, q.y + 0.3f * fibre, q.z), 90);
    float crack = 1.0f - smoothstepf(0.0f, 0.10f, cube.border);
    crack *= smoothstepf(-0.05f, 0.3f, stain);
    Vec3 grey = vec3(0.130f, 0.119f, 0.103f), brown = vec3(0.042f, 0.034f, 0.027f);
    float dark = clampf(1.3f * deep + 0.8f * stain, 0.0f, 1.0f);
    float value = (1.0f + 0.35f * fibre + 0.35f * shred) * (1.0f - 0.65f * cleft);
    Vec3 wood = vec3_scale(vec3_lerp(grey, brown, dark), value * (1.0f - 0.5f * crack));
    bark->color = vec3_lerp(bark->color, wood, share);
    return 0.0015f * fibre + 0.005f * shred + 0.006f * strand - 0.008f * cleft - 0.004f * crack;
}

// Holes in a roll of callus with a ragged edge; rot from their rims on.
static void add_hollow(const Material *m, const StemPlace *place, BarkSurface *bark)
{
    float thick = smoothstepf(0.10f, 0.20f, place->radius);
    if (thick <= 0.0f) {
        return;
    }
    const float spacing = 0.46f; // m
    Vec3 torn, q = stem_lookup(place, spacing, 1.7f * spacing);
    noise_solid(stem_lookup(place, 0.11f, 0.2f), 86, &torn);
    Spot spot = spot_at(vec3_madd(q, 0.035f, torn), 0.9f * m->hollows, 0.18f, 0.38f, 87);
    if (spot.t > 1.8f) {
        return;
    }
    // Fibres and splinters make the edge ragged along the grain.
    float splinter = noise_solid(stem_lookup(place, 0.013f, 0.15f), 98, NULL);
    float rag = noise_fractal(stem_lookup(place, 0.05f, 0.11f), 3, 99);
    float edge = spot.t + 0.10f * rag + 0.05f * splinter, guard = spot.guard * thick;
    float within = 1.0f - smoothstepf(0.52f, 0.94f, edge);
    float roll = bell(spot.t + 0.06f * rag, 1.13f, 0.15f);
    float depth = guard * place->radius * 0.6f * within,
          rot = guard * smoothstepf(0.96f, 0.84f, edge);
    bark->form += guard * place->radius * (0.10f + 0.05f * rag) * roll - depth;
    flatten(bark, fmaxf(rot, 0.45f * guard * smoothstepf(1.35f, 1.1f, spot.t)));
    // Callus is a smooth young skin.
    float callus = guard * smoothstepf(1.4f, 1.15f, spot.t + 0.2f * rag);
    Vec3 skin = vec3_scale(m->color, 0.95f + 0.25f * rag + 0.12f * splinter);
    bark->color = vec3_lerp(bark->color, skin, 0.45f * callus);
    if (rot <= 0.0f) {
        return;
    }
    StemPlace inner = *place;
    float in = 1.0f - depth / place->radius;
    inner.p = vec3(in * place->p.x, in * place->p.y, place->p.z);
    bark->form += rot * add_rot(&inner, rot, within, bark);
}

void bark_scars(const Material *m, const SurfacePoint *point, const StemPlace *place,
                BarkSurface *bark)
{
    (void)point;
    if (m->ribs > 0.0f) {
        add_ribs(m, place, bark);
    }
    if (m->scars > 0.0f && m->bark == BARK_SMOOTH) {
        add_eye(m, place, bark);
    } else if (m->scars > 0.0f) {
        add_scar(m, place, bark);
    }
    if (m->hollows > 0.0f) {
        add_hollow(m, place, bark);
    }
}

float bark_form_size(const Material *m, float radius)
{
    return (m->ribs > 0.0f ? 0.35f * m->ribs * radius : 0.0f) + (m->scars > 0.0f ? 0.02f : 0.0f) +
           (m->hollows > 0.0f ? 0.6f * radius : 0.0f) + (m->moss > 0.0f ? 0.01f : 0.0f);
}
