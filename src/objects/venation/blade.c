#include "objects/venation/blade.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/venation/blade_grid.h"
#include "objects/venation/blade_wave.h"
#include "objects/venation/vein_curves.h"

#include <math.h>
#include <stdlib.h>

enum { FLAT_ROWS = 160, FLAT_COLUMNS = 48, LEAST_ROWS = 160, MOST_ROWS = 1600 };

#define ROWS_PER_AREOLE 4
#define ROWS_OF_LINES 6 // per areole, where lines as fine as the finest veins are drawn
#define FURROW 6.0f     // half-width of a vein's furrow, in its radii
#define SHEATH 1.8f     // half-width of a vein in the blade with the sheath about it, in its radii
#define UNEVEN 0.3f     // how much paler than the greenest areole the palest is

// ---- painting ----

typedef struct Canvas {
    const VenationParams *params;
    int width, height;
    float *pixel;
} Canvas;

// A round bar, a furrow with soft edges, or a flat line.
typedef enum Profile { PROFILE_BAR, PROFILE_FURROW, PROFILE_LINE } Profile;

// How a vein is painted: half-width, value in its middle, and profile.
typedef struct Brush {
    float radius, peak;
    Profile profile;
} Brush;

// d: distance from the middle, in half-widths.
static float brush_value(const Brush *brush, float d)
{
    float inner = 1.0f - d * d;
    if (d >= 1.0f) {
        return 0.0f;
    }
    switch (brush->profile) {
    case PROFILE_BAR:
        return brush->peak * sqrtf(inner);
    case PROFILE_FURROW:
        return brush->peak * (inner * inner);
    case PROFILE_LINE:
        break;
    }
    return brush->peak * (1.0f - smoothstepf(0.4f, 1.0f, d));
}

// Paints the maximum of overlapping veins.
static void paint(const Canvas *canvas, Vec3 a, Vec3 b, const Brush *brush)
{
    const LeafOutline *outline = &canvas->params->outline;
    float shown = brush->radius;
    float high = (a.y > b.y ? a.y : b.y) + shown, low = (a.y < b.y ? a.y : b.y) - shown;
    int row0 = (int)((1.0f - high / outline->length) * (float)canvas->height);
    int row1 = (int)((1.0f - low / outline->length) * (float)canvas->height) + 1;
    for (int r = row0 > 0 ? row0 : 0; r <= row1 && r < canvas->height; r++) {
        BladeRow row = blade_pixel_row(outline, canvas->height, r);
        float columns = (float)canvas->width;
        float left = (a.x < b.x ? a.x : b.x) - shown, right = (a.x > b.x ? a.x : b.x) + shown;
        int c0 = (int)fminf(columns * blade_row_column(&row, left), columns - 1.0f);
        int c1 = (int)fminf(columns * blade_row_column(&row, right) + 1.0f, columns - 1.0f);
        for (int c = c0; c <= c1; c++) {
            Vec3 p = blade_pixel(&row, canvas->width, c), along = vec3_sub(b, a),
                 to = vec3_sub(p, a);
            float length2 = vec3_dot(along, along);
            float t = length2 > 0.0f ? clampf(vec3_dot(to, along) / length2, 0.0f, 1.0f) : 0.0f;
            float d = vec3_distance(to, vec3_scale(along, t)) / shown;
            float value = brush_value(brush, d);
            float *at = &canvas->pixel[(size_t)r * (size_t)canvas->width + (size_t)c];
            *at = value > *at ? value : *at;
        }
    }
}

// A vein's profile in textures is a round bar, blurred to a pixel.
static Brush bar_brush(const Canvas *canvas, float radius)
{
    float pixel = canvas->params->outline.length / (float)canvas->height;
    float shown = radius > 0.7f * pixel ? radius : 0.7f * pixel;
    return (Brush){shown, sqrtf(radius / canvas->params->midrib) * radius / shown, PROFILE_BAR};
}

// Furrows are as wide as their veins are thick, and somewhat less deep.
static Brush furrow_brush(const Canvas *canvas, float radius)
{
    float pixel = canvas->params->outline.length / (float)canvas->height;
    float share = radius / canvas->params->midrib;
    return (Brush){fmaxf(FURROW * radius, 1.5f * pixel), sqrtf(share * sqrtf(share)),
                   PROFILE_FURROW};
}

// Lines finer than the pixels are as much fainter as they are shown wider.
static Brush line_brush(const Canvas *canvas, float radius)
{
    float pixel = canvas->params->outline.length / (float)canvas->height;
    float width = SHEATH * radius, shown = fmaxf(width, 1.2f * pixel);
    return (Brush){shown, width / shown, PROFILE_LINE};
}

// at: places of the nodes on the flat leaf.
static void paint_all(const Canvas *canvas, const OutTree *tree, const Vec3 *at, Profile profile)
{
    static Brush (*const brush_for[])(const Canvas *, float) = {bar_brush, furrow_brush,
                                                                line_brush};
    for (int64_t i = 0; i < (int64_t)canvas->width * canvas->height; i++) {
        canvas->pixel[i] = 0.0f;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            Brush brush = brush_for[profile](canvas, tree->radius[i]);
            paint(canvas, at[tree->parent[i]], at[i], &brush);
        }
    }
}

bool venation_paint(const void *given, const OutTree *tree, int width, int height, float *pixel,
                    Error *e)
{
    if (width < 1 || height < 1) {
        return error_set(e, ERROR_INPUT, "a picture of %d x %d; both must be above 0", width,
                         height);
    }
    VenationParams params = venation_params_of(given, tree);
    Canvas canvas = {&params, width, height, pixel};
    paint_all(&canvas, tree, tree->position, PROFILE_BAR);
    return true;
}

// ---- areoles ----

// Sets the pixels of the areole about `start`, which no line covers, to value. seen: pixels that a
// line covers or that are done. stack: room for all pixels.
static void fill_areole(const Canvas *canvas, int start, float value, bool *seen, int *stack)
{
    int depth = 0, width = canvas->width, size = width * canvas->height;
    seen[start] = true;
    stack[depth++] = start;
    while (depth > 0) {
        int at = stack[--depth], column = at % width;
        canvas->pixel[at] = fmaxf(canvas->pixel[at], value);
        const int near[4] = {column > 0 ? at - 1 : -1, column + 1 < width ? at + 1 : -1, at - width,
                             at + width};
        for (int k = 0; k < 4; k++) {
            int to = near[k];
            if (to >= 0 && to < size && !seen[to]) {
                seen[to] = true;
                stack[depth++] = to;
            }
        }
    }
}

// Gives every areole between painted lines a paleness of its own, 0 to UNEVEN.
static bool vary_areoles(const Canvas *canvas, Error *e)
{
    const float covered = 0.3f; // by a line, from here on
    int size = canvas->width * canvas->height;
    bool *seen = memory_alloc(size, sizeof *seen, e);
    int *stack = memory_alloc(size, sizeof *stack, e);
    bool done = seen && stack;
    for (int i = 0; done && i < size; i++) {
        seen[i] = canvas->pixel[i] > covered;
    }
    for (int i = 0; done && i < size; i++) {
        if (!seen[i]) {
            float value = UNEVEN * random_unit(random_key(0, (uint64_t)i));
            fill_areole(canvas, i, value, seen, stack);
        }
    }
    free(seen);
    free(stack);
    return done;
}

// ---- relief ----

// Rows and columns of the painted blade, about as wide as high on the leaf.
static void set_size(Relief *relief)
{
    const VenationParams *params = relief->params;
    int rows = params->detail * (params->embedded > 0.0f ? ROWS_OF_LINES : ROWS_PER_AREOLE);
    rows = rows < LEAST_ROWS ? LEAST_ROWS : rows > MOST_ROWS ? MOST_ROWS : rows;
    relief->height = params->rows > 0 ? params->rows : rows;
    float columns = (float)relief->height * params->outline.width / params->outline.length;
    relief->width = 8 + (int)fminf(columns, fmaxf((float)params->rows, (float)MOST_ROWS));
}

static bool paint_pale(Relief *relief, const OutTree *tree, Error *e)
{
    Canvas canvas = {relief->params, relief->width, relief->height, relief->pale};
    Vec3 *at = venation_smoothed(tree, relief->params->smoothing, e);
    if (at) {
        paint_all(&canvas, tree, at, PROFILE_LINE);
    }
    free(at);
    return at && vary_areoles(&canvas, e);
}

static float *new_picture(const Relief *relief, Error *e)
{
    return memory_alloc_zero((int64_t)relief->width * relief->height, sizeof(float), e);
}

// Yellow patches follow the areoles, each of which keeps some green of its own, and veins keep
// most.
static bool paint_withered(Relief *relief, Error *e)
{
    relief->withered = new_picture(relief, e);
    if (!relief->withered) {
        return false;
    }
    blade_wear_paint(&relief->wear, relief->width, relief->height, relief->withered);
    int64_t size = relief->pale ? (int64_t)relief->width * relief->height : 0;
    for (int64_t i = 0; i < size; i++) {
        float pale = relief->pale[i], keeps = pale < UNEVEN ? 0.7f * pale / UNEVEN : 0.7f;
        float value = relief->withered[i];
        relief->withered[i] =
            value * (1.0f - keeps * (1.0f - smoothstepf(0.0f, MESH_YELLOW, value)));
    }
    return true;
}

bool relief_init(Relief *relief, const VenationParams *params, const OutTree *tree, Error *e)
{
    *relief = (Relief){.params = params, .width = FLAT_COLUMNS, .height = FLAT_ROWS};
    bool worn = params->wear > 0.0f || params->spots > 0.0f;
    if (params->relief != 0.0f || params->embedded > 0.0f || params->wave != 0.0f || worn ||
        params->rows > 0 || leaf_has_margin(&params->outline)) {
        set_size(relief);
    }
    if (params->relief != 0.0f) {
        relief->depth = new_picture(relief, e);
        if (!relief->depth) {
            return false;
        }
        Canvas canvas = {params, relief->width, relief->height, relief->depth};
        paint_all(&canvas, tree, tree->position, PROFILE_FURROW);
    }
    if (params->embedded > 0.0f) {
        relief->pale = new_picture(relief, e);
        if (!relief->pale || !paint_pale(relief, tree, e)) {
            return false;
        }
    }
    return !worn || (blade_wear_init(&relief->wear, params, tree, e) && paint_withered(relief, e));
}

void relief_clear(Relief *relief)
{
    free(relief->depth);
    free(relief->pale);
    free(relief->withered);
    blade_wear_clear(&relief->wear);
    relief->depth = relief->pale = relief->withered = NULL;
}

// The two pixels about a place along one axis, and the second one's share.
static float between(float at, int size, int pixel[2])
{
    float inside = clampf(at * (float)size - 0.5f, 0.0f, (float)(size - 1));
    pixel[0] = (int)inside;
    pixel[1] = pixel[0] + 1 < size ? pixel[0] + 1 : pixel[0];
    return inside - (float)pixel[0];
}

// The value painted at p; 0 beyond the blade or without a picture.
static float painted_at(const Relief *relief, const float *pixel, Vec3 p)
{
    const LeafOutline *outline = &relief->params->outline;
    if (!pixel) {
        return 0.0f;
    }
    BladeRow row = blade_row(outline, p.y);
    if (!(row.half > 0.0f)) {
        return 0.0f;
    }
    int x[2], y[2];
    float s = between(blade_row_column(&row, p.x), relief->width, x);
    float t = between(1.0f - p.y / outline->length, relief->height, y);
    const float *low = pixel + (size_t)y[0] * (size_t)relief->width;
    const float *high = pixel + (size_t)y[1] * (size_t)relief->width;
    return lerpf(lerpf(low[x[0]], low[x[1]], s), lerpf(high[x[0]], high[x[1]], s), t);
}

float relief_at(const Relief *relief, Vec3 p)
{
    float wave = blade_wave(relief->params, p);
    return relief->depth ? wave - relief->params->relief * painted_at(relief, relief->depth, p)
                         : wave;
}

// ---- mesh ----

// The grid of the flat blade. Its faces see the front.
static void fill_grid(Mesh *mesh, const LeafOutline *outline, int rows, int columns)
{
    uint32_t *corner = mesh->index;
    for (int r = 0; r <= rows; r++) {
        float v = (float)r / (float)rows;
        BladeRow row = blade_row(outline, v * outline->length);
        for (int c = 0; c <= columns; c++) {
            float u = (float)c / (float)columns;
            int i = r * (columns + 1) + c;
            mesh->position[i] = vec3(blade_row_place(&row, u), row.y, 0);
            mesh->uv[i] = (Vec2){u, v};
            if (r < rows && c < columns) {
                uint32_t a = (uint32_t)i, b = a + (uint32_t)columns + 1;
                corner[0] = a, corner[1] = a + 1, corner[2] = b + 1, corner[3] = b;
                corner += 4;
            }
        }
    }
}

Mesh *venation_blade(const VenationParams *params, const Relief *relief, const Transform *place,
                     Error *e)
{
    int rows = relief->height, columns = relief->width;
    int arrays = MESH_NORMAL | MESH_UV | (relief->pale ? (int)MESH_YOUNG : 0) |
                 (relief->withered ? (int)MESH_WITHERED : 0);
    Mesh *mesh =
        mesh_new(4, (int64_t)(rows + 1) * (columns + 1), (int64_t)rows * columns, arrays, e);
    if (!mesh) {
        return NULL;
    }
    fill_grid(mesh, &params->outline, rows, columns);
    bool done = relief->wear.holes == 0 || blade_wear_cut(&relief->wear, mesh, e);
    for (int64_t i = 0; done && i < mesh->vertex_count; i++) {
        Vec3 flat = mesh->position[i];
        if (mesh->young) {
            mesh->young[i] = painted_at(relief, relief->pale, flat);
        }
        if (mesh->withered) {
            mesh->withered[i] = painted_at(relief, relief->withered, flat);
        }
        flat.z = relief_at(relief, flat);
        mesh->position[i] = transform_point(place, venation_bend(params, flat));
    }
    if (!done || !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
