#include "objects/venation/venation.h"

#include "base/random.h"
#include "grow/venation/venation.h"
#include "objects/venation/vein_curves.h"
#include "outtree/join.h"
#include "outtree/radii.h"

#include <math.h>
#include <stddef.h>

enum { STREAM_VEINS = 1, STREAM_PETIOLE = 7 }; // of the object's seed

enum { BLADE_ROWS = 160, BLADE_COLUMNS = 48, PETIOLE_PIECES = 12, AREA_ROWS = 1000 };

#define EXPONENT 3.0f // Murray's

VenationParams venation_params_default(void)
{
    return (VenationParams){.outline = {.length = 0.1f, .widest = 0.42f, .tip = 1.4f},
                            .closed = true,
                            .detail = 100,
                            .petiole = 0.02f,
                            .curl = 12.0f,
                            .fold = 6.0f,
                            .blade = true};
}

VenationParams venation_params_resolve(const VenationParams *given)
{
    VenationParams params = *given;
    float length = params.outline.length, mesh = length / (float)params.detail;
    params.outline.width = params.outline.width > 0.0f ? params.outline.width : 0.5f * length;
    params.midrib = params.midrib > 0.0f ? params.midrib : 0.008f * length;
    params.vein = params.vein > 0.0f ? params.vein : 0.06f * mesh;
    return params;
}

static VeinParams vein_params(const VenationParams *params, uint64_t seed)
{
    VeinParams veins = vein_params_default();
    veins.outline = params->outline;
    veins.closed = params->closed;
    veins.marginal = params->marginal;
    veins.secondaries = params->secondaries;
    veins.birth = params->outline.length / (float)params->detail;
    veins.kill = 0.5f * veins.birth;
    veins.step = 0.25f * veins.birth;
    veins.seed = seed;
    return veins;
}

static bool add_petiole(OutTree *tree, const VenationParams *params, uint64_t seed, Error *e)
{
    int64_t node = -1;
    for (int i = 0; i < PETIOLE_PIECES; i++) {
        float y = params->petiole * ((float)i / PETIOLE_PIECES - 1.0f);
        uint64_t id =
            node < 0 ? random_key(seed, STREAM_PETIOLE) : out_tree_child_id(tree->id[node], 0);
        node = out_tree_add_node(tree, vec3(0, y, 0), node, 0, 0, id, e);
        if (node < 0) {
            return false;
        }
        tree->normal[node] = vec3(0, 0, 1);
    }
    return true;
}

// The petiole followed by the veins, with shifted indices.
static OutTree *with_petiole(const OutTree *veins, const VenationParams *params, uint64_t seed,
                             Error *e)
{
    OutTree *tree = out_tree_new(e);
    bool done = tree && (params->petiole <= 0.0f || add_petiole(tree, params, seed, e));
    int32_t first = done ? (int32_t)tree->count : 0;
    for (int64_t i = 0; done && i < veins->count; i++) {
        int32_t parent = veins->parent[i] < 0 ? first - 1 : veins->parent[i] + first;
        int64_t node = out_tree_add_node(tree, veins->position[i], parent, veins->birth[i], 0,
                                         veins->id[i], e);
        done = node >= 0;
        if (done) {
            tree->normal[node] = veins->normal[i];
        }
    }
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

bool venation_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    VenationParams params = venation_params_resolve(given);
    VeinParams grow = vein_params(&params, random_key(recipe->seed, STREAM_VEINS));
    OutTree *veins = veins_grow(&grow, NULL, NULL, recipe->run, e);
    whole->tree = veins ? with_petiole(veins, &params, recipe->seed, e) : NULL;
    out_tree_free(veins);
    return whole->tree;
}

bool venation_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                     Error *e)
{
    (void)recipe, (void)whole, (void)e;
    VenationParams params = venation_params_resolve(given);
    out_tree_pipe_radii(grown->tree, EXPONENT, params.vein, params.midrib);
    return true;
}

// ---- geometry ----

static Mesh *blade_mesh(const VenationParams *params, const Transform *place, Error *e)
{
    Mesh *mesh = mesh_new(4, (BLADE_ROWS + 1) * (BLADE_COLUMNS + 1), BLADE_ROWS * BLADE_COLUMNS,
                          MESH_NORMAL | MESH_UV, e);
    if (!mesh) {
        return NULL;
    }
    uint32_t *corner = mesh->index;
    for (int r = 0; r <= BLADE_ROWS; r++) {
        float v = (float)r / BLADE_ROWS, y = v * params->outline.length;
        float half = leaf_half_width(&params->outline, y);
        for (int c = 0; c <= BLADE_COLUMNS; c++) {
            float u = (float)c / BLADE_COLUMNS;
            int i = r * (BLADE_COLUMNS + 1) + c;
            Vec3 flat = vec3((2.0f * u - 1.0f) * half, y, 0);
            mesh->position[i] = transform_point(place, venation_bend(params, flat));
            mesh->uv[i] = (Vec2){u, v};
            if (r < BLADE_ROWS && c < BLADE_COLUMNS) {
                uint32_t a = (uint32_t)i, b = a + BLADE_COLUMNS + 1;
                corner[0] = a, corner[1] = a + 1, corner[2] = b + 1, corner[3] = b;
                corner += 4;
            }
        }
    }
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

bool venation_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    VenationParams params = venation_params_resolve(given);
    Transform place = transform_compose(params.position, params.rotation, vec3_splat(1.0f));
    Part veins = {.curves = venation_curves(grown->tree, &params, &place, e)};
    if (!placing_add(placing, veins, VENATION_VEINS, e)) {
        return false;
    }
    return !params.blade ||
           placing_add(placing, (Part){.mesh = blade_mesh(&params, &place, e)}, VENATION_BLADE, e);
}

// ---- texture ----

typedef struct Canvas {
    const VenationParams *params;
    int width, height;
    float *pixel;
} Canvas;

// Position of a pixel's middle on the flat leaf.
static Vec3 pixel_place(const Canvas *canvas, int column, int row)
{
    float y = canvas->params->outline.length * (1.0f - ((float)row + 0.5f) / (float)canvas->height);
    float u = ((float)column + 0.5f) / (float)canvas->width;
    return vec3((2.0f * u - 1.0f) * leaf_half_width(&canvas->params->outline, y), y, 0);
}

// Paints the maximum of overlapping veins; a vein's profile is a round bar, blurred to a pixel.
static void paint_bar(const Canvas *canvas, Vec3 a, Vec3 b, float radius)
{
    const LeafOutline *outline = &canvas->params->outline;
    float pixel = outline->length / (float)canvas->height;
    float shown = radius > 0.7f * pixel ? radius : 0.7f * pixel;
    float peak = sqrtf(radius / canvas->params->midrib) * radius / shown;
    float high = (a.y > b.y ? a.y : b.y) + shown, low = (a.y < b.y ? a.y : b.y) - shown;
    int row0 = (int)((1.0f - high / outline->length) * (float)canvas->height);
    int row1 = (int)((1.0f - low / outline->length) * (float)canvas->height) + 1;
    for (int r = row0 > 0 ? row0 : 0; r <= row1 && r < canvas->height; r++) {
        float half = leaf_half_width(outline, pixel_place(canvas, 0, r).y);
        float left = (a.x < b.x ? a.x : b.x) - shown, right = (a.x > b.x ? a.x : b.x) + shown;
        float scale = half > 0.0f ? 0.5f * (float)canvas->width / half : 0.0f;
        int c0 = (int)clampf((left + half) * scale, 0.0f, (float)(canvas->width - 1));
        int c1 = (int)clampf((right + half) * scale + 1.0f, 0.0f, (float)(canvas->width - 1));
        for (int c = c0; c <= c1; c++) {
            Vec3 p = pixel_place(canvas, c, r), along = vec3_sub(b, a), to = vec3_sub(p, a);
            float length2 = vec3_dot(along, along);
            float t = length2 > 0.0f ? clampf(vec3_dot(to, along) / length2, 0.0f, 1.0f) : 0.0f;
            float d = vec3_distance(to, vec3_scale(along, t)) / shown;
            float value = d < 1.0f ? peak * sqrtf(1.0f - d * d) : 0.0f;
            float *at = &canvas->pixel[(size_t)r * (size_t)canvas->width + (size_t)c];
            *at = value > *at ? value : *at;
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
    VenationParams params = venation_params_resolve(given);
    Canvas canvas = {&params, width, height, pixel};
    for (int64_t i = 0; i < (int64_t)width * height; i++) {
        pixel[i] = 0.0f;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            paint_bar(&canvas, tree->position[tree->parent[i]], tree->position[i], tree->radius[i]);
        }
    }
    return true;
}

// ---- measures ----

// Area of the flat leaf, m^2.
static double blade_area(const LeafOutline *outline)
{
    double row = (double)outline->length / AREA_ROWS, sum = 0.0;
    for (int i = 0; i < AREA_ROWS; i++) {
        sum += 2.0 * row * (double)leaf_half_width(outline, ((float)i + 0.5f) * (float)row);
    }
    return sum;
}

bool venation_measure(const void *given, const Grown *grown, const Recipe *recipe,
                      MeasureList *list, Error *e)
{
    (void)recipe;
    const OutTree *tree = grown->tree;
    VenationParams params = venation_params_resolve(given);
    int64_t pieces, loops;
    double length = 0.0, area = 1e6 * blade_area(&params.outline), none = (double)NAN;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && tree->position[i].y > 0.0f) { // beyond the petiole
            length += (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
        }
    }
    return out_tree_count_pieces(tree, &pieces, &loops, e) &&
           measures_add(list, "areoles", (double)loops, "", none, none, e) &&
           measures_add(list, "areole_area", loops > 0 ? area / (double)loops : none, "mm^2", none,
                        none, e) &&
           measures_add(list, "vein_density", 1000.0 * length / area, "mm/mm^2", none, none, e);
}
