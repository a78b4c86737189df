#include "objects/venation/blade.h"

#include "base/memory.h"
#include "objects/venation/blade_autumn.h"
#include "objects/venation/blade_grid.h"
#include "objects/venation/blade_wave.h"
#include "objects/venation/vein_curves.h"
#include "objects/venation/vein_paint.h"

#include <math.h>
#include <stdlib.h>

enum { FLAT_ROWS = 160, FLAT_COLUMNS = 48, LEAST_ROWS = 160, MOST_ROWS = 1600 };

#define ROWS_PER_AREOLE 4
#define ROWS_OF_LINES 6 // per areole, where lines as fine as the finest veins are drawn

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

static float *new_picture(const Relief *relief, Error *e)
{
    return memory_alloc_zero((int64_t)relief->width * relief->height, sizeof(float), e);
}

// Into pixel; lines with areoles that differ.
static bool paint_veins(const Relief *relief, const OutTree *tree, const Vec3 *at,
                        VeinProfile profile, float *pixel, Error *e)
{
    Canvas canvas;
    bool done = canvas_init(&canvas, relief->params, relief->width, relief->height, pixel, e);
    if (done) {
        canvas_paint_veins(&canvas, tree, at, profile);
        done = profile != VEIN_LINE || canvas_vary_areoles(&canvas, e);
    }
    canvas_clear(&canvas);
    return done;
}

static bool paint_pale(Relief *relief, const OutTree *tree, Error *e)
{
    Vec3 *at = venation_smoothed(tree, relief->params->smoothing, e);
    bool done = at && paint_veins(relief, tree, at, VEIN_LINE, relief->pale, e);
    free(at);
    return done;
}

// Yellow patches follow the areoles, each of which keeps some green of its own, and veins keep
// most.
static bool paint_withered(Relief *relief, const OutTree *tree, Error *e)
{
    relief->withered = new_picture(relief, e);
    if (!relief->withered || (relief->params->autumn > 0.0f &&
                              !blade_autumn_paint(relief->params, tree, relief->pale, relief->width,
                                                  relief->height, relief->withered, e))) {
        return false;
    }
    blade_wear_paint(&relief->wear, relief->width, relief->height, relief->withered);
    int64_t size = relief->pale ? (int64_t)relief->width * relief->height : 0;
    for (int64_t i = 0; i < size; i++) {
        float pale = relief->pale[i], keeps = pale < VEIN_UNEVEN ? 0.7f * pale / VEIN_UNEVEN : 0.7f;
        float value = relief->withered[i];
        relief->withered[i] =
            value * (1.0f - keeps * (1.0f - smoothstepf(0.0f, MESH_YELLOW, value)));
    }
    return true;
}

bool relief_init(Relief *relief, const VenationParams *params, const OutTree *tree, Error *e)
{
    *relief = (Relief){.params = params, .width = FLAT_COLUMNS, .height = FLAT_ROWS};
    bool worn = params->wear > 0.0f || params->spots > 0.0f || params->autumn > 0.0f;
    if (params->relief != 0.0f || params->embedded > 0.0f || params->wave != 0.0f || worn ||
        params->rows > 0 || leaf_has_margin(&params->outline)) {
        set_size(relief);
    }
    if (params->relief != 0.0f) {
        relief->depth = new_picture(relief, e);
        if (!relief->depth ||
            !paint_veins(relief, tree, tree->position, VEIN_FURROW, relief->depth, e)) {
            return false;
        }
    }
    if (params->embedded > 0.0f) {
        relief->pale = new_picture(relief, e);
        if (!relief->pale || !paint_pale(relief, tree, e)) {
            return false;
        }
    }
    return !worn ||
           (blade_wear_init(&relief->wear, params, tree, e) && paint_withered(relief, tree, e));
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
