// Hoar frost on meshes. Faces are cut into cells about as long as the needles; each is judged once,
// at a random point, and bears the tufts of its area, so the frost does not depend on how the mesh
// is divided.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "mesh/mesh_rays.h"
#include "objects/common/hoar.h"
#include "objects/common/hoar_tufts.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

enum { SIDE_RAYS = 6, SKY_RAYS = 8 };
enum { STREAM_TURN_RAYS = 1, STREAM_NUMBER, STREAM_SKY, STREAM_TUFTS = 64 };      // of a cell
enum { STREAM_X, STREAM_Y, STREAM_TILT, STREAM_SIZE, STREAM_SHAPE, STREAM_TURN }; // of a tuft

typedef struct Cell {
    Vec3 corner[3];
    Vec3 normal; // unit
    float area;  // m2
    uint64_t key;
} Cell;

typedef struct Judged {
    float number; // of tufts
    float size;   // m, mean length of the needles
} Judged;

typedef struct HoarSurface {
    const HoarParams *params;
    const Run *run;
    const MeshRays *rays;
    Vec3 against;  // the wind
    float extent;  // m, of the mesh
    float longest; // m, of a cell
    uint64_t seed;
    Judged *judged; // of each cell, in the order of the walk
    int64_t count, capacity;
    bool unlimited; // the tufts are at most max_count in any case
    double tufts;   // sum
    float kept;     // share of the tufts that max_count allows
    HoarTufts out;
} HoarSurface;

typedef bool Visit(HoarSurface *on, const Cell *cell, Error *e);

static Vec3 point_in(const Cell *cell, uint64_t key)
{
    float root = sqrtf(random_unit(random_key(key, STREAM_X)));
    float across = random_unit(random_key(key, STREAM_Y));
    Vec3 far = vec3_lerp(cell->corner[1], cell->corner[2], across);
    return vec3_lerp(cell->corner[0], far, root);
}

// A unit vector at this angle, by its cosine, to n.
static Vec3 slanted(Vec3 n, float cosine, float turn)
{
    Vec3 u = vec3_perpendicular(n), v = vec3_cross(n, u);
    float s, c, sine = sqrtf(1.0f - cosine * cosine);
    exact_sincos(turn, &s, &c);
    return vec3_madd(vec3_madd(vec3_scale(n, cosine), sine * c, u), sine * s, v);
}

// Radius of the largest ball that touches the surface at p from inside: through p and the end of a
// chord goes one of radius chord / (2 cosine). The extent where the mesh has no inside.
static float radius_at(const HoarSurface *on, Vec3 p, Vec3 n, uint64_t key)
{
    const float cosine = 0.70710678f; // finds the other face of an edge
    float turn = random_range(random_key(key, STREAM_TURN_RAYS), 0.0f, 2.0f * PI_F);
    Vec3 in = vec3_neg(n);
    float chord = mesh_rays_way(on->rays, p, in, true, 2.0f * on->extent);
    float radius = 0.5f * chord;
    for (int i = 0; i < SIDE_RAYS; i++) {
        Vec3 d = slanted(in, cosine, turn + 2.0f * PI_F * (float)i / SIDE_RAYS);
        chord = mesh_rays_way(on->rays, p, d, true, 2.0f * on->extent);
        float ball = chord / (2.0f * cosine);
        radius = ball < radius ? ball : radius;
    }
    return radius < on->extent ? radius : on->extent;
}

// Share of the sky on the surface's side that the mesh itself leaves free.
static float open_at(const HoarSurface *on, Vec3 p, Vec3 n, uint64_t key)
{
    int up = 0, open = 0;
    Vec3 from = vec3_madd(p, 0.02f * on->params->length, n);
    for (int i = 0; i < SKY_RAYS; i++) {
        uint64_t own = random_key(random_key(key, STREAM_SKY), (uint64_t)i);
        float share = ((float)i + random_unit(own)) / SKY_RAYS;
        Vec3 d =
            slanted(n, sqrtf(1.0f - share), random_range(random_key(own, 1), 0.0f, 2.0f * PI_F));
        if (d.y > 0.0f) {
            up++;
            open += mesh_rays_way(on->rays, from, d, false, 2.0f * on->extent) == INFINITY;
        }
    }
    return up > 0 ? (float)open / (float)up : 1.0f;
}

// At least as many tufts as a cell of this area bears, known without a ray: were it an edge under
// open sky.
static float most_tufts(const HoarSurface *on, Vec3 n, float area)
{
    const HoarParams *params = on->params;
    float growth = hoar_wind_share(params, vec3_dot(n, on->against));
    growth *= hoar_sky_share(params, n.y, 1.0f);
    return 1.0001f * sqrtf(growth) * area * hoar_tufts_per_area(params, 0.0f);
}

// The part of a tuft that decides whether there is one more.
static float chance_of(const Cell *cell)
{
    return random_unit(random_key(cell->key, STREAM_NUMBER));
}

static Judged judge_cell(const HoarSurface *on, const Cell *cell)
{
    const HoarParams *params = on->params;
    const float least = 0.02f; // of the mean growth
    Vec3 p = point_in(cell, cell->key), n = cell->normal;
    Judged judged = {0};
    float growth = hoar_wind_share(params, vec3_dot(n, on->against));
    if (on->unlimited && most_tufts(on, n, cell->area) + chance_of(cell) < 1.0f) {
        growth = 0.0f; // a sliver of a wire bears none, and most cells of a wire are slivers
    }
    if (growth > least && params->sky > 0.0f) {
        growth *= hoar_sky_share(params, n.y, open_at(on, p, n, cell->key));
    }
    if (growth > least) {
        float radius = radius_at(on, p, n, cell->key), half = sqrtf(growth);
        judged.number = half * cell->area * hoar_tufts_per_area(params, radius);
        judged.size = half * params->length * params->thickest / (params->thickest + radius);
    }
    return judged;
}

static bool judge(HoarSurface *on, const Cell *cell, Error *e)
{
    Judged judged = judge_cell(on, cell);
    on->tufts += (double)judged.number;
    if (!memory_reserve(&on->judged, &on->capacity, on->count + 1, sizeof judged, e)) {
        return false;
    }
    on->judged[on->count++] = judged;
    return run_goes_on(on->run, on->count, e);
}

// Along the surface's normal in still air; against the wind as branches' tufts are; never inward.
static Vec3 growth_direction(const HoarSurface *on, Vec3 n, uint64_t key)
{
    const float scatter = 0.35f, least = 0.2f;
    Vec3 d = vec3_lerp(n, on->against, on->params->bias);
    d = vec3_madd(d, scatter, random_direction(random_key(key, STREAM_TILT)));
    float out = vec3_dot(d, n);
    d = out < least ? vec3_madd(d, least - out, n) : d;
    return vec3_normalize(d);
}

static bool grow_cell(HoarSurface *on, const Cell *cell, Judged judged, Error *e)
{
    float wanted = on->kept * judged.number;
    int64_t number = (int64_t)(wanted + chance_of(cell));
    bool done = run_goes_on(on->run, ++on->count, e);
    for (int64_t i = 0; done && i < number; i++) {
        uint64_t key = random_key(cell->key, STREAM_TUFTS + (uint64_t)i);
        Vec3 foot = point_in(cell, key);
        float share = hoar_size_share(on->params, foot, random_key(key, STREAM_SIZE));
        if (share == 0.0f) {
            continue;
        }
        Vec3 y = growth_direction(on, cell->normal, key);
        Vec3 u = vec3_perpendicular(y);
        float turn = random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F), s, c;
        exact_sincos(turn, &s, &c);
        Vec3 turned = vec3_add(vec3_scale(u, c), vec3_scale(vec3_cross(y, u), s));
        done = hoar_tufts_add(&on->out, foot, turned, y, share * judged.size,
                              random_key(key, STREAM_SHAPE), e);
    }
    return done;
}

static bool grow_judged(HoarSurface *on, const Cell *cell, Error *e)
{
    assert(on->judged); // every cell has been
    return grow_cell(on, cell, on->judged[on->count], e);
}

// No sum of all cells' tufts is needed.
static bool grow_at_once(HoarSurface *on, const Cell *cell, Error *e)
{
    return grow_cell(on, cell, judge_cell(on, cell), e);
}

// ---- cells ----

static float longest_edge(const Vec3 corner[3], int *from)
{
    float longest = 0.0f;
    for (int i = 0; i < 3; i++) {
        float length = vec3_distance(corner[i], corner[(i + 1) % 3]);
        if (length > longest) {
            longest = length;
            *from = i;
        }
    }
    return longest;
}

// Halves the longest edge until all are short. Halves carry half of the area, without rounding.
static bool visit_cells(HoarSurface *on, Cell cell, int depth, Visit *visit, Error *e)
{
    enum { DEEPEST = 60 };
    int i = 0;
    if (longest_edge(cell.corner, &i) <= on->longest || depth == DEEPEST) {
        return visit(on, &cell, e);
    }
    Vec3 a = cell.corner[i], b = cell.corner[(i + 1) % 3], c = cell.corner[(i + 2) % 3];
    Vec3 middle = vec3_lerp(a, b, 0.5f);
    Cell half = {{a, middle, c}, cell.normal, 0.5f * cell.area, random_key(cell.key, 0)};
    Cell other = {{middle, b, c}, cell.normal, half.area, random_key(cell.key, 1)};
    return visit_cells(on, half, depth + 1, visit, e) &&
           visit_cells(on, other, depth + 1, visit, e);
}

static int64_t triangles_of(const Mesh *mesh)
{
    return mesh->face_count * (mesh->face_size - 2);
}

// false = the triangle has no area.
static bool cell_of(const HoarSurface *on, const Mesh *mesh, int64_t triangle, Cell *cell)
{
    int64_t each = mesh->face_size - 2, part = triangle % each;
    const uint32_t *face = mesh->index + triangle / each * mesh->face_size;
    cell->corner[0] = mesh->position[face[0]];
    cell->corner[1] = mesh->position[face[1 + part]];
    cell->corner[2] = mesh->position[face[2 + part]];
    Vec3 across = vec3_cross(vec3_sub(cell->corner[1], cell->corner[0]),
                             vec3_sub(cell->corner[2], cell->corner[0]));
    float twice = vec3_length(across);
    if (!(twice > 0.0f)) {
        return false;
    }
    cell->normal = vec3_scale(across, 1.0f / twice);
    cell->area = 0.5f * twice;
    cell->key = random_key(on->seed, (uint64_t)triangle);
    return true;
}

static bool visit_all(HoarSurface *on, const Mesh *mesh, Visit *visit, Error *e)
{
    on->count = 0;
    bool done = true;
    for (int64_t i = 0; done && i < triangles_of(mesh); i++) {
        Cell cell;
        done = run_goes_on(on->run, i, e) &&
               (!cell_of(on, mesh, i, &cell) || visit_cells(on, cell, 0, visit, e));
    }
    return done;
}

// Returns the length of cells: that of the needles, or so long that there are about as many as
// tufts are allowed. Tells whether that limit can matter.
static float measure_mesh(HoarSurface *on, const Mesh *mesh)
{
    double area = 0.0, edges = 0.0, tufts = 0.0, most = (double)on->params->max_count;
    for (int64_t i = 0; i < triangles_of(mesh); i++) {
        Cell cell;
        int from;
        if (cell_of(on, mesh, i, &cell)) {
            area += (double)cell.area;
            edges += (double)longest_edge(cell.corner, &from);
            tufts += (double)most_tufts(on, cell.normal, cell.area);
        }
    }
    on->unlimited = tufts <= most;
    double length = fmax((double)on->params->length, sqrt(2.0 * area / most));
    return (float)fmax(length, 2.0 * edges / most);
}

static bool place(HoarSurface *on, const Mesh *mesh, Error *e)
{
    on->longest = measure_mesh(on, mesh);
    on->kept = 1.0f;
    if (on->unlimited) {
        return visit_all(on, mesh, grow_at_once, e);
    }
    if (!visit_all(on, mesh, judge, e)) {
        return false;
    }
    double most = (double)on->params->max_count;
    on->kept = on->tufts > most ? (float)(most / on->tufts) : 1.0f;
    if (on->kept < 1.0f) {
        run_warn(on->run, "hoar frost of %.0f tufts is thinned out to hoar.max_count, %.0f",
                 on->tufts, most);
    }
    return visit_all(on, mesh, grow_judged, e);
}

bool hoar_add_on_mesh(const Mesh *mesh, const HoarParams *params, const Placing *placing, int role,
                      Error *e)
{
    if (params->length <= 0.0f || mesh->face_count == 0) {
        return true;
    }
    MeshRays *rays = mesh_rays_new(mesh, e);
    if (!rays) {
        return false;
    }
    Aabb box = mesh_bounds(mesh);
    HoarSurface on = {.params = params,
                      .run = placing->recipe->run,
                      .rays = rays,
                      .against = hoar_against(params),
                      .extent = vec3_length(vec3_sub(box.high, box.low)),
                      .seed = random_key(placing->recipe->seed, 0x40a8)};
    bool done = place(&on, mesh, e);
    free(on.judged);
    mesh_rays_free(rays);
    if (!done) {
        hoar_tufts_clear(&on.out);
        return false;
    }
    return hoar_tufts_place(&on.out, params->habit, on.seed, placing, role, e);
}
