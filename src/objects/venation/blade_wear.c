#include "objects/venation/blade_wear.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/venation/blade_grid.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_HOLES = 16, MOST_BITES = 3, BITE_PIECES = 3, MOST_SPOTS = 110, TRIES = 24 };
enum { STREAM_WEAR = 0x7765, STREAM_HOLES = 1, STREAM_BITES, STREAM_SPOTS }; // of the leaf's key
enum { DRAW_HEIGHT, DRAW_SIDE, DRAW_SIZE, DRAW_RIM, DRAW_NEAR, DRAW_PICK };

#define BUMPS 0.34f       // of a rim, by the radius
#define REACH 1.45f       // radii about the centre beyond which no rim lies
#define THICK 0.2f        // veins of at least this share of the midrib are left
#define CLEAR 0.003f      // of the length, between a hole and such a vein
#define PATCH 0.21f       // of the length: wavelength of yellow patches
#define DRY_MARGIN 0.003f // of the length: width of a margin that dries

// ---- places ----

// The mean rim's distance from p along the way from the centre, m: above 0 inside.
static float depth_in(const WornPlace *place, Vec3 p)
{
    Vec3 out = vec3_sub(p, place->center);
    float away = vec3_length(out);
    Vec3 way = vec3_scale(out, away > 0.0f ? 0.65f / away : 0.0f);
    way.z = 0.4f; // between the zeros of the noise
    return place->radius * (1.0f + BUMPS * noise_fractal(way, 3, place->seed)) - away;
}

// Is a disc clear of the thick veins?
static bool is_clear(const VenationParams *params, const OutTree *tree, Vec3 center, float radius)
{
    float thick = THICK * params->midrib, reach = radius + CLEAR * params->outline.length;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->radius[i] >= thick && vec3_distance(tree->position[i], center) < reach) {
            return false;
        }
    }
    return true;
}

static float draw(uint64_t key, int number, float low, float high)
{
    return random_range(random_key(key, (uint64_t)number), low, high);
}

// A random point of the blade.
static Vec3 any_place(const LeafOutline *outline, uint64_t key)
{
    float y = outline->length * draw(key, DRAW_HEIGHT, 0.05f, 0.97f);
    BladeRow row = blade_row(outline, y);
    return vec3(blade_row_place(&row, draw(key, DRAW_SIDE, 0.02f, 0.98f)), y, 0);
}

// Holes are many and small or few and large; half of them lie near the one before.
static bool find_hole(const BladeWear *wear, const OutTree *tree, uint64_t key, WornPlace *hole)
{
    const LeafOutline *outline = &wear->params->outline;
    float length = outline->length, large = draw(key, DRAW_SIZE, 0.0f, 1.0f);
    *hole = (WornPlace){.radius = length * (0.0035f + 0.02f * large * large * large),
                        .rim = length * draw(key, DRAW_RIM, 0.0008f, 0.0022f),
                        .seed = (uint32_t)key};
    bool near = wear->holes > 0 && draw(key, DRAW_NEAR, 0.0f, 1.0f) < 0.5f;
    for (int i = 0; i < TRIES; i++) {
        uint64_t pick = random_key(random_key(key, DRAW_PICK), (uint64_t)i);
        hole->center = any_place(outline, pick);
        if (near) {
            Vec3 other = wear->hole[wear->holes - 1].center;
            hole->center = vec3(other.x + length * draw(pick, 0, -0.07f, 0.07f),
                                other.y + length * draw(pick, 1, -0.07f, 0.07f), 0);
        }
        if (leaf_contains(outline, 1.0f, hole->center) &&
            is_clear(wear->params, tree, hole->center, hole->radius)) {
            return true;
        }
    }
    return false;
}

// A row of scallops along the margin, as caterpillars leave it, up to the thick veins.
static void add_bite(BladeWear *wear, const OutTree *tree, uint64_t key)
{
    const LeafOutline *outline = &wear->params->outline;
    float length = outline->length, side = draw(key, DRAW_SIDE, -1.0f, 1.0f) < 0.0f ? -1.0f : 1.0f;
    float y = length * draw(key, DRAW_HEIGHT, 0.18f, 0.88f);
    float rim = length * draw(key, DRAW_RIM, 0.0010f, 0.0026f);
    for (int i = 0; i < BITE_PIECES; i++) {
        uint64_t own = random_key(random_key(key, DRAW_PICK), (uint64_t)i);
        float radius = length * draw(own, DRAW_SIZE, 0.012f, 0.030f);
        float in = draw(own, DRAW_SIDE, -0.25f, 0.45f) * radius;
        Vec3 center = vec3(side * (leaf_margin(outline, side, y) - in), y, 0);
        if (is_clear(wear->params, tree, center, radius)) {
            wear->hole[wear->holes++] = (WornPlace){center, radius, rim, (uint32_t)own};
        }
        y += radius * draw(own, DRAW_HEIGHT, 0.9f, 1.6f);
    }
}

// Spots are most where the first of them are; most are specks.
static void add_spot(BladeWear *wear, uint64_t key)
{
    const LeafOutline *outline = &wear->params->outline;
    float length = outline->length, large = draw(key, DRAW_SIZE, 0.0f, 1.0f);
    Vec3 center = any_place(outline, random_key(key, DRAW_PICK));
    float crowd =
        noise_fractal(vec3_scale(center, 1.0f / (PATCH * length)), 2, (uint32_t)outline->key + 5);
    if (crowd < draw(key, DRAW_NEAR, -0.5f, 0.4f)) {
        return;
    }
    large *= large * large;
    float radius = length * (0.0009f + 0.0065f * large * large);
    wear->spot[wear->spots++] =
        (WornPlace){center, radius, radius * draw(key, DRAW_RIM, 0.3f, 1.2f), (uint32_t)key};
}

static uint64_t wear_key(const VenationParams *params, int stream, int number)
{
    uint64_t key = random_key(params->outline.key, STREAM_WEAR);
    return random_key(random_key(key, (uint64_t)stream), (uint64_t)number);
}

bool blade_wear_init(BladeWear *wear, const VenationParams *params, const OutTree *tree, Error *e)
{
    *wear = (BladeWear){.params = params};
    int holes = (int)(params->wear * MOST_HOLES + 0.5f);
    int bites = (int)(params->wear * MOST_BITES + 0.5f);
    int spots = (int)(params->spots * MOST_SPOTS + 0.5f);
    wear->hole = memory_alloc(holes + BITE_PIECES * bites + 1, sizeof *wear->hole, e);
    wear->spot = memory_alloc(spots + 1, sizeof *wear->spot, e);
    if (!wear->hole || !wear->spot) {
        return false;
    }
    for (int i = 0; i < holes; i++) {
        WornPlace hole;
        if (find_hole(wear, tree, wear_key(params, STREAM_HOLES, i), &hole)) {
            wear->hole[wear->holes++] = hole;
        }
    }
    for (int i = 0; i < bites; i++) {
        add_bite(wear, tree, wear_key(params, STREAM_BITES, i));
    }
    for (int i = 0; i < spots; i++) {
        add_spot(wear, wear_key(params, STREAM_SPOTS, i));
    }
    return true;
}

void blade_wear_clear(BladeWear *wear)
{
    free(wear->hole);
    free(wear->spot);
    *wear = (BladeWear){0};
}

float blade_wear_depth(const BladeWear *wear, Vec3 p)
{
    float depth = 0.0f;
    for (int i = 0; i < wear->holes; i++) {
        const WornPlace *hole = &wear->hole[i];
        if (vec3_distance(p, hole->center) < REACH * hole->radius) {
            depth = fmaxf(depth, depth_in(hole, p));
        }
    }
    return depth;
}

// ---- painting ----

typedef struct WearCanvas {
    const LeafOutline *outline;
    int width, height;
    float *pixel;
} WearCanvas;

// Beside a hole, at so many widths of its rim: dry, then brown, then yellow.
static float rim_value(float widths)
{
    return widths < 1.0f ? 1.0f - (1.0f - MESH_BROWN) * fmaxf(widths, 0.0f)
                         : MESH_BROWN * (1.0f - smoothstepf(1.0f, 2.6f, widths));
}

// In a spot and its halo. Specks are brown, larger ones dry out in the middle.
static float spot_value(const WornPlace *spot, float depth, float length)
{
    float top = lerpf(MESH_BROWN + 0.02f, 1.0f,
                      smoothstepf(0.002f * length, 0.007f * length, spot->radius));
    float inside = depth / spot->radius;
    if (inside > 0.0f) {
        return lerpf(MESH_BROWN, top, smoothstepf(0.1f, 0.45f, inside));
    }
    return 0.6f * (1.0f - smoothstepf(0.0f, 1.0f, -depth / spot->rim));
}

static void paint_place(const WearCanvas *canvas, const WornPlace *place, bool is_hole)
{
    const LeafOutline *outline = canvas->outline;
    float reach = REACH * place->radius + 2.6f * place->rim;
    float rows = (float)canvas->height / outline->length;
    int row0 = (int)((outline->length - place->center.y - reach) * rows);
    int row1 = (int)((outline->length - place->center.y + reach) * rows) + 1;
    for (int r = row0 > 0 ? row0 : 0; r <= row1 && r < canvas->height; r++) {
        BladeRow row = blade_pixel_row(outline, canvas->height, r);
        float columns = (float)canvas->width;
        int c0 = (int)(columns * blade_row_column(&row, place->center.x - reach));
        int c1 = (int)(columns * blade_row_column(&row, place->center.x + reach));
        for (int c = c0; c <= c1 && c < canvas->width; c++) {
            Vec3 p = blade_pixel(&row, canvas->width, c);
            float depth = depth_in(place, p);
            float value = is_hole ? rim_value(-depth / place->rim)
                                  : spot_value(place, depth, outline->length);
            float *at = &canvas->pixel[(size_t)r * (size_t)canvas->width + (size_t)c];
            *at = fmaxf(*at, value);
        }
    }
}

// Patches lose their green, more toward the margin, which dries here and there.
static float patch_value(const VenationParams *params, const BladeRow *row, Vec3 p)
{
    if (!(row->half > 0.0f)) {
        return 0.0f;
    }
    const LeafOutline *outline = &params->outline;
    float length = outline->length, out = fabsf(p.x) / row->half;
    uint32_t seed = (uint32_t)outline->key;
    float patch = noise_fractal(vec3_scale(p, 1.0f / (PATCH * length)), 3, seed + 1);
    float yellow = 0.4f * smoothstepf(0.0f, 0.8f, patch + 0.25f * out * out * out);
    float side = p.x < 0.0f ? -1.0f : 1.0f;
    float inward = (row->half + row->more[p.x >= 0.0f] - fabsf(p.x)) / (DRY_MARGIN * length);
    float along = noise_fractal(vec3(9.0f * side, 8.0f * p.y / length, 0.0f), 3, seed + 2);
    float width = clampf(2.2f * along - 0.2f, 0.0f, 1.0f);
    float dry = width > 0.0f ? rim_value(2.0f * inward / width) : 0.0f;
    return params->spots * fmaxf(yellow, dry);
}

void blade_wear_paint(const BladeWear *wear, int width, int height, float *withered)
{
    WearCanvas canvas = {&wear->params->outline, width, height, withered};
    for (int r = 0; wear->params->spots > 0.0f && r < height; r++) {
        BladeRow row = blade_pixel_row(canvas.outline, height, r);
        for (int c = 0; c < width; c++) {
            float value = patch_value(wear->params, &row, blade_pixel(&row, width, c));
            float *at = &withered[(size_t)r * (size_t)width + (size_t)c];
            *at = fmaxf(*at, value);
        }
    }
    for (int i = 0; i < wear->spots; i++) {
        paint_place(&canvas, &wear->spot[i], false);
    }
    for (int i = 0; i < wear->holes; i++) {
        paint_place(&canvas, &wear->hole[i], true);
    }
}

// ---- cutting ----

// Moves a point that lies in a hole out to the rim.
static Vec3 moved_out(const BladeWear *wear, Vec3 p)
{
    for (int pass = 0; pass < 3; pass++) { // where holes overlap, out of one may be in another
        for (int i = 0; i < wear->holes; i++) {
            float depth = depth_in(&wear->hole[i], p);
            if (depth > 0.0f) { // along the ray from the centre, where bumps do not matter
                Vec3 out = vec3_normalize(vec3_sub(p, wear->hole[i].center));
                p = vec3_madd(p, depth, out);
            }
        }
    }
    return p;
}

// Drops vertices that no face uses. number: room for all vertices.
static void drop_unused(Mesh *mesh, int64_t *number)
{
    int64_t corners = mesh->face_count * mesh->face_size, kept = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        number[i] = -1;
    }
    for (int64_t i = 0; i < corners; i++) {
        number[mesh->index[i]] = 0;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        if (number[i] == 0) {
            mesh->position[kept] = mesh->position[i];
            mesh->uv[kept] = mesh->uv[i];
            number[i] = kept++;
        }
    }
    mesh->vertex_count = kept;
    for (int64_t i = 0; i < corners; i++) {
        mesh->index[i] = (uint32_t)number[mesh->index[i]];
    }
}

bool blade_wear_cut(const BladeWear *wear, Mesh *flat, Error *e)
{
    int64_t n = flat->vertex_count, kept = 0;
    int64_t *number = memory_alloc(n, sizeof *number, e);
    bool *gone = memory_alloc(n, sizeof *gone, e);
    if (!number || !gone) {
        free(number);
        free(gone);
        return false;
    }
    for (int64_t i = 0; i < n; i++) {
        gone[i] = blade_wear_depth(wear, flat->position[i]) > 0.0f;
    }
    for (int64_t f = 0; f < flat->face_count; f++) {
        const uint32_t *corner = flat->index + 4 * f;
        if (gone[corner[0]] && gone[corner[1]] && gone[corner[2]] && gone[corner[3]]) {
            continue;
        }
        for (int k = 0; k < 4; k++) {
            flat->index[4 * kept + k] = corner[k];
        }
        kept++;
    }
    flat->face_count = kept;
    for (int64_t i = 0; i < n; i++) {
        flat->position[i] = gone[i] ? moved_out(wear, flat->position[i]) : flat->position[i];
    }
    drop_unused(flat, number);
    free(number);
    free(gone);
    return true;
}
