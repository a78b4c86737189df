// Pillows of snow: the thickness over a bed, and the closed mesh of it.
//
// The square of the thickness solves a screened Poisson equation with 0 at the outline, as surfaces
// of drawings are inflated (Baran and Lehtinen 2009, "Notes on inflating curves"): a narrow pillow
// is a half circle across, a wide one is round at its rim and `depth` thick inside, without creases
// between.
#include "mesh/snow/snow_bed.h"

#include "base/memory.h"
#include "mesh/snow/snow_crumbs.h"

#include <math.h>
#include <stdlib.h>

enum { SWEEPS = 40, MOST_LAYERS = 4 };

#define RELAXATION 1.4f
#define RESOLVED 7.0f // cells of the depth from which on more sweeps are needed
#define NEAREST 0.05f // of a cell: how near the outline may pass by a point
#define BELOW 0.6f    // share of the snow that comes to what lies below a pillow
#define SAG 0.25f     // how far snow reaches down between what bears it, in thicknesses

void snow_pile_clear(SnowPile *pile)
{
    free(pile->position);
    free(pile->index);
    free(pile->crumbs.crumb);
}

// ---- thickness ----

// Where the outline crosses the way from a point inside to one outside: 0 .. 1.
static float crossing(float inside, float outside)
{
    return clampf(inside / (inside - outside), NEAREST, 1.0f - NEAREST);
}

// One relaxation at a point inside: in its row and column it goes to 0 at the outline.
static void relax(const SnowBed *bed, float *square, int64_t i, float screen, float source)
{
    const int64_t beside[4] = {-1, 1, -bed->across, bed->across};
    float sum = source, weight = 4.0f + screen;
    for (int k = 0; k < 4; k++) {
        int64_t other = i + beside[k];
        if (bed->outline[other] > 0.0f) {
            sum += square[other];
        } else { // goes on linearly beyond the outline
            float way = crossing(bed->outline[i], bed->outline[other]);
            weight += (1.0f - way) / way;
        }
    }
    square[i] += RELAXATION * (sum / weight - square[i]);
}

float *snow_thickness(const SnowBed *bed, float depth, Error *e)
{
    int64_t count = (int64_t)bed->across * bed->along;
    float *thick = memory_alloc_zero(count, sizeof *thick, e);
    float cells = depth / bed->cell; // the equation in cells: lap u - u / L2 = -1, L2 = depth2 / 2
    float screen = 2.0f / (cells * cells);
    for (int64_t i = 0; thick && i < count; i++) {
        float far = bed->outline[i] / bed->cell;
        thick[i] = far > 0.0f ? fminf(1.0f / screen, 0.7f * cells * far) : 0.0f;
    }
    int sweeps = (int)((float)SWEEPS * fmaxf(1.0f, cells / RESOLVED));
    for (int sweep = 0; thick && sweep < sweeps; sweep++) {
        for (int64_t i = 0; i < count; i++) {
            if (bed->outline[i] > 0.0f) {
                relax(bed, thick, i, screen, 1.0f);
            }
        }
    }
    for (int64_t i = 0; thick && i < count; i++) {
        thick[i] = bed->cell * sqrtf(2.0f * fmaxf(0.0f, thick[i])) * bed->share[i];
    }
    return thick;
}

// ---- mesh ----

enum { NEXT_ACROSS, NEXT_ALONG, EDGES };

// Vertices of a pillow, -1 = none: the lower and, next to it, the upper one of a point, and those
// of the rim between a point and the next.
typedef struct PillowMesh {
    const SnowBed *bed;
    const float *thick;
    int64_t *low;
    int64_t (*rim)[EDGES];
    SnowPile *pile;
} PillowMesh;

static bool add_vertex(SnowPile *pile, Vec3 p, Error *e)
{
    if (!memory_reserve(&pile->position, &pile->vertex_capacity, pile->vertex_count + 1, sizeof p,
                        e)) {
        return false;
    }
    pile->position[pile->vertex_count++] = p;
    return true;
}

static Vec3 place_of(const SnowBed *bed, int64_t i)
{
    int64_t x = i % bed->across, z = i / bed->across;
    return vec3(bed->low_x + (float)x * bed->cell, bed->height[i],
                bed->low_z + (float)z * bed->cell);
}

// The vertices of point i and of the edges that begin there.
static bool add_vertices(PillowMesh *mesh, int64_t i, Error *e)
{
    const SnowBed *bed = mesh->bed;
    const float *outline = bed->outline;
    const int64_t next[EDGES] = {i + 1, i + bed->across};
    SnowPile *pile = mesh->pile;
    mesh->low[i] = -1;
    if (outline[i] > 0.0f) {
        Vec3 p = place_of(bed, i), up = vec3(0.0f, mesh->thick[i], 0.0f);
        mesh->low[i] = pile->vertex_count;
        if (!add_vertex(pile, vec3_madd(p, -SAG, up), e) || !add_vertex(pile, vec3_add(p, up), e)) {
            return false;
        }
    }
    for (int k = 0; k < EDGES; k++) {
        int64_t other = next[k];
        bool in = outline[i] > 0.0f;
        mesh->rim[i][k] = -1;
        if (in == (outline[other] > 0.0f)) {
            continue;
        }
        float way =
            in ? crossing(outline[i], outline[other]) : 1.0f - crossing(outline[other], outline[i]);
        mesh->rim[i][k] = pile->vertex_count;
        if (!add_vertex(pile, vec3_lerp(place_of(bed, i), place_of(bed, other), way), e)) {
            return false;
        }
    }
    return true;
}

// The part of the cell that begins at point i that is inside: its vertices in order, the first one
// that of a point; upper ones are marked by `upper`. Returns their number.
static int cell_polygon(const PillowMesh *mesh, int64_t i, int64_t vertex[8], bool rim[8])
{
    int64_t across = mesh->bed->across;
    const int64_t point[4] = {i, i + 1, i + 1 + across, i + across};
    const int64_t edge[4] = {mesh->rim[i][NEXT_ACROSS], mesh->rim[i + 1][NEXT_ALONG],
                             mesh->rim[i + across][NEXT_ACROSS], mesh->rim[i][NEXT_ALONG]};
    int first = 0, count = 0;
    while (first < 4 && mesh->low[point[first]] < 0) {
        first++;
    }
    for (int k = first; k < first + 4 && first < 4; k++) {
        if (mesh->low[point[k % 4]] >= 0) {
            vertex[count] = mesh->low[point[k % 4]];
            rim[count++] = false;
        }
        if (edge[k % 4] >= 0) {
            vertex[count] = edge[k % 4];
            rim[count++] = true;
        }
    }
    return count;
}

// Triangles from the polygon's first vertex, which is not of the rim, so that upper and lower ones
// share edges of the rim alone.
static bool add_cell(const PillowMesh *mesh, int64_t i, Error *e)
{
    SnowPile *pile = mesh->pile;
    int64_t vertex[8];
    bool rim[8];
    int count = cell_polygon(mesh, i, vertex, rim);
    if (count > 2 && !memory_reserve(&pile->index, &pile->index_capacity,
                                     pile->index_count + 6 * (count - 2), sizeof *pile->index, e)) {
        return false;
    }
    for (int k = 1; k + 1 < count; k++) {
        uint32_t *corner = pile->index + pile->index_count;
        const int used[3] = {0, k, k + 1};
        for (int c = 0; c < 3; c++) {
            int64_t low = vertex[used[c]];
            corner[c] = (uint32_t)low;
            corner[5 - c] = (uint32_t)(low + !rim[used[c]]);
        }
        pile->index_count += 6;
    }
    return true;
}

static bool add_mesh(PillowMesh *mesh, Error *e)
{
    int64_t across = mesh->bed->across, inner = across * (mesh->bed->along - 1);
    for (int64_t i = 0; i < inner; i++) { // the border bears nothing
        bool last = i % across == across - 1;
        mesh->low[i] = -1;
        mesh->rim[i][NEXT_ACROSS] = mesh->rim[i][NEXT_ALONG] = -1;
        if (!last && !add_vertices(mesh, i, e)) {
            return false;
        }
    }
    for (int64_t i = inner; i < inner + across; i++) {
        mesh->low[i] = mesh->rim[i][NEXT_ACROSS] = mesh->rim[i][NEXT_ALONG] = -1;
    }
    for (int64_t i = 0; i < inner; i++) {
        if (i % across < across - 1 && !add_cell(mesh, i, e)) {
            return false;
        }
    }
    return true;
}

static bool add_pillow(SnowPile *pile, const SnowBed *bed, float depth, Error *e)
{
    int64_t count = (int64_t)bed->across * bed->along;
    float *thick = snow_thickness(bed, depth, e);
    PillowMesh mesh = {.bed = bed,
                       .thick = thick,
                       .low = memory_alloc(count, sizeof *mesh.low, e),
                       .rim = memory_alloc(count, sizeof *mesh.rim, e),
                       .pile = pile};
    bool done = thick && mesh.low && mesh.rim && add_mesh(&mesh, e);
    free(thick);
    free(mesh.low);
    free(mesh.rim);
    return done;
}

// Moves the bearers that lie far below others to the front; returns their number.
static int64_t deeper(const SnowBed *bed, SnowBearer *bearer, int64_t count)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < count; i++) {
        if (snow_bed_passes(bed, bearer[i].p)) {
            bearer[kept++] = bearer[i];
        }
    }
    return kept;
}

typedef struct Sheltered {
    const SnowReach *reach;
    float share; // that what lies above lets through
} Sheltered;

static float sheltered_share(const void *user, Vec3 p)
{
    const Sheltered *sheltered = user;
    return sheltered->share * sheltered->reach->share(sheltered->reach->user, p);
}

bool snow_add_pillows(SnowPile *pile, SnowBearer *bearer, int64_t count, const SnowParams *params,
                      const SnowReach *reach, uint64_t seed, Error *e)
{
    Sheltered sheltered = {reach, 1.0f};
    const SnowReach below = {sheltered_share, &sheltered};
    bool done = true;
    for (int layer = 0; done && count > 0 && layer < MOST_LAYERS; layer++) {
        SnowBed bed;
        if (!snow_bed_init(&bed, bearer, count, params, &below, seed + (uint64_t)layer, e)) {
            return false;
        }
        uint64_t layer_seed = seed + (uint64_t)layer;
        done = add_pillow(pile, &bed, params->depth, e) &&
               (params->crumbs <= 0.0f ||
                snow_add_crumbs(&pile->crumbs, &bed, bearer, count, params, &below, layer_seed, e));
        count = deeper(&bed, bearer, count);
        snow_bed_clear(&bed);
        sheltered.share *= BELOW;
    }
    return done;
}

Mesh *snow_pile_mesh(const SnowPile *pile, Error *e)
{
    Mesh *mesh = mesh_new(3, pile->vertex_count, pile->index_count / 3, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    for (int64_t i = 0; i < pile->vertex_count; i++) {
        mesh->position[i] = pile->position[i];
    }
    for (int64_t i = 0; i < pile->index_count; i++) {
        mesh->index[i] = pile->index[i];
    }
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
