// The mesh of a sea: spokes and rings about a centre, whose cells grow with their distance from it,
// so that they look alike from above the centre and no crack can open between sizes.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/sea/sea.h"

#include <math.h>
#include <stdlib.h>

#define EARTH_RADIUS 6371000.0f // m
#define DRY 1.5f                // m above the calm surface that no wave reaches where land is

// Radii of the rings, the first is 0. *count: how many. The caller frees them.
static float *ring_radii(const SeaParams *params, int *count, Error *e)
{
    double turn = 2.0 * 3.14159265358979323846 / params->spokes;
    int64_t capacity = 0;
    float *radius = NULL;
    double r = 0.0;
    *count = 0;
    while (memory_reserve(&radius, &capacity, *count + 2, sizeof *radius, e)) {
        radius[(*count)++] = (float)r;
        if (r >= (double)params->extent) {
            return radius;
        }
        double step = r * turn;
        r += step > (double)params->finest ? step : (double)params->finest;
        r = r > 0.98 * (double)params->extent ? (double)params->extent : r;
    }
    free(radius);
    return NULL;
}

typedef struct SeaSheet {
    const SeaParams *params;
    const Waves *waves;
    Mesh *mesh;
    float *radius;
    int rings;
    Vec2 center;
    float *clear; // per vertex: m by which the land rises above the calm surface; -INFINITY = none
} SeaSheet;

static void set_vertex(const SeaSheet *sheet, int64_t vertex, float cosine, float sine, int ring)
{
    const SeaParams *params = sheet->params;
    float r = sheet->radius[ring];
    float x = sheet->center.x + r * cosine, z = sheet->center.y + r * sine;
    float next =
        ring + 1 < sheet->rings ? sheet->radius[ring + 1] - r : r - sheet->radius[ring - 1];
    WavePoint point;
    waves_at(sheet->waves, x, z, next, &point);
    Vec3 at =
        vec3_add(vec3(x, params->level - r * r / (2.0f * EARTH_RADIUS), z), point.displacement);
    sheet->mesh->position[vertex] = at;
    sheet->mesh->normal[vertex] = point.normal;
    sheet->mesh->uv[vertex] = (Vec2){x, z};
    sheet->clear[vertex] = -point.depth;
}

static void set_vertices(const SeaSheet *sheet, const Run *run)
{
    int spokes = sheet->params->spokes;
    set_vertex(sheet, 0, 1.0f, 0.0f, 0);
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int spoke = 0; spoke < spokes; spoke++) {
        double sine, cosine;
        exact_sincos_double(6.28318530717958647692 * spoke / spokes, &sine, &cosine);
        for (int ring = 1; ring < sheet->rings; ring++) {
            set_vertex(sheet, 1 + (int64_t)(ring - 1) * spokes + spoke, (float)cosine, (float)sine,
                       ring);
        }
    }
}

static bool is_dry(const SeaSheet *sheet, const uint32_t *vertex)
{
    for (int i = 0; i < 3; i++) {
        if (sheet->clear[vertex[i]] < DRY) {
            return false;
        }
    }
    return true;
}

// Appends a triangle unless it lies under land.
static void add_face(const SeaSheet *sheet, uint32_t a, uint32_t b, uint32_t c)
{
    Mesh *mesh = sheet->mesh;
    uint32_t *vertex = mesh->index + 3 * mesh->face_count;
    vertex[0] = a;
    vertex[1] = b;
    vertex[2] = c;
    mesh->face_count += is_dry(sheet, vertex) ? 0 : 1;
}

static void set_faces(const SeaSheet *sheet)
{
    uint32_t spokes = (uint32_t)sheet->params->spokes;
    sheet->mesh->face_count = 0;
    for (uint32_t spoke = 0; spoke < spokes; spoke++) {
        add_face(sheet, 0, 1 + (spoke + 1) % spokes, 1 + spoke);
    }
    for (int ring = 2; ring < sheet->rings; ring++) {
        uint32_t inner = 1 + (uint32_t)(ring - 2) * spokes, outer = inner + spokes;
        for (uint32_t spoke = 0; spoke < spokes; spoke++) {
            uint32_t next = (spoke + 1) % spokes;
            add_face(sheet, inner + spoke, inner + next, outer + spoke);
            add_face(sheet, inner + next, outer + next, outer + spoke);
        }
    }
}

static bool make(SeaSheet *sheet, const Run *run, Error *e)
{
    int64_t vertices = 1 + (int64_t)(sheet->rings - 1) * sheet->params->spokes;
    int64_t faces = (int64_t)sheet->params->spokes * (2 * (sheet->rings - 2) + 1);
    sheet->mesh = mesh_new(3, vertices, faces, MESH_NORMAL | MESH_UV, e);
    sheet->clear = sheet->mesh ? memory_alloc(vertices, sizeof *sheet->clear, e) : NULL;
    if (!sheet->clear) {
        mesh_free(sheet->mesh);
        return false;
    }
    set_vertices(sheet, run);
    set_faces(sheet);
    free(sheet->clear);
    return true;
}

Vec2 sea_center(const SeaParams *params, const Vec3 *eye)
{
    if (params->center_given) {
        return (Vec2){params->center[0], params->center[1]};
    }
    return eye ? (Vec2){eye->x, eye->z} : (Vec2){0.0f, 0.0f};
}

Mesh *sea_mesh(const SeaParams *params, const Vec3 *eye, Waves *waves, const Run *run, Error *e)
{
    SeaSheet sheet = {.params = params, .waves = waves};
    sheet.center = sea_center(params, eye);
    sheet.radius = ring_radii(params, &sheet.rings, e);
    bool done = sheet.radius && make(&sheet, run, e);
    free(sheet.radius);
    if (!done) {
        waves_free(waves);
        return NULL;
    }
    sheet.mesh->waves = waves;
    return sheet.mesh;
}
