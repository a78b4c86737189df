#include "objects/venation/vein_paint.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

#define FURROW 6.0f // half-width of a vein's furrow, in its radii
#define SHEATH 1.8f // half-width of a vein in the blade with the sheath about it, in its radii
#define GREEN_BAND 0.032f // of the length: half-width of the midrib's green band
#define GREEN_LEAST 0.07f // of the midrib: radius of the thinnest vein that has one

bool canvas_init(Canvas *canvas, const VenationParams *params, int width, int height, float *pixel,
                 Error *e)
{
    *canvas = (Canvas){params, width, height, pixel, memory_alloc(height, sizeof(BladeRow), e)};
    for (int r = 0; canvas->rows && r < height; r++) {
        canvas->rows[r] = blade_pixel_row(&params->outline, height, r);
    }
    return canvas->rows;
}

void canvas_clear(Canvas *canvas)
{
    free(canvas->rows);
    canvas->rows = NULL;
}

// ---- painting ----

// How a vein is painted: half-width, value in its middle, and profile.
typedef struct Brush {
    float radius, peak;
    VeinProfile profile;
} Brush;

// d: distance from the middle, in half-widths.
static float brush_value(const Brush *brush, float d)
{
    float inner = 1.0f - d * d;
    if (d >= 1.0f) {
        return 0.0f;
    }
    switch (brush->profile) {
    case VEIN_BAR:
        return brush->peak * sqrtf(inner);
    case VEIN_FURROW:
    case VEIN_GREEN:
        return brush->peak * (inner * inner);
    case VEIN_LINE:
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
        const BladeRow *row = &canvas->rows[r];
        float columns = (float)canvas->width;
        float left = (a.x < b.x ? a.x : b.x) - shown, right = (a.x > b.x ? a.x : b.x) + shown;
        int c0 = (int)fminf(columns * blade_row_column(row, left), columns - 1.0f);
        int c1 = (int)fminf(columns * blade_row_column(row, right) + 1.0f, columns - 1.0f);
        for (int c = c0; c <= c1; c++) {
            Vec3 p = blade_pixel(row, canvas->width, c), along = vec3_sub(b, a),
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
    return (Brush){shown, sqrtf(radius / canvas->params->midrib) * radius / shown, VEIN_BAR};
}

// Furrows are as wide as their veins are thick, and somewhat less deep.
static Brush furrow_brush(const Canvas *canvas, float radius)
{
    float pixel = canvas->params->outline.length / (float)canvas->height;
    float share = radius / canvas->params->midrib;
    return (Brush){fmaxf(FURROW * radius, 1.5f * pixel), sqrtf(share * sqrtf(share)), VEIN_FURROW};
}

// Lines finer than the pixels are as much fainter as they are shown wider.
static Brush line_brush(const Canvas *canvas, float radius)
{
    float pixel = canvas->params->outline.length / (float)canvas->height;
    float width = SHEATH * radius, shown = fmaxf(width, 1.2f * pixel);
    return (Brush){shown, width / shown, VEIN_LINE};
}

// The thicker a vein, the wider and greener is the band.
static Brush green_brush(const Canvas *canvas, float radius)
{
    float share = radius / canvas->params->midrib, root = sqrtf(share);
    return (Brush){GREEN_BAND * canvas->params->outline.length * root,
                   fminf(1.6f * root, 1.0f) * smoothstepf(GREEN_LEAST, 2.0f * GREEN_LEAST, share),
                   VEIN_GREEN};
}

void canvas_paint_veins(const Canvas *canvas, const OutTree *tree, const Vec3 *at,
                        VeinProfile profile)
{
    static Brush (*const brush_for[])(const Canvas *, float) = {bar_brush, furrow_brush, line_brush,
                                                                green_brush};
    float least = profile == VEIN_GREEN ? GREEN_LEAST * canvas->params->midrib : 0.0f;
    for (int64_t i = 0; i < (int64_t)canvas->width * canvas->height; i++) {
        canvas->pixel[i] = 0.0f;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && tree->radius[i] >= least) {
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
    Canvas canvas;
    bool done = canvas_init(&canvas, &params, width, height, pixel, e);
    if (done) {
        canvas_paint_veins(&canvas, tree, tree->position, VEIN_BAR);
    }
    canvas_clear(&canvas);
    return done;
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

bool canvas_vary_areoles(const Canvas *canvas, Error *e)
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
            float value = VEIN_UNEVEN * random_unit(random_key(0, (uint64_t)i));
            fill_areole(canvas, i, value, seen, stack);
        }
    }
    free(seen);
    free(stack);
    return done;
}
