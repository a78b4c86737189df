// The surface of a snow crystal: two faces over the lattice, joined along its outline. The outline
// is the contour of the smoothed cells, so that it is finer than a cell.
#include "base/memory.h"
#include "objects/snow_crystal/snow_crystal.h"

#include <stdlib.h>

enum { CONTOUR_PASSES = 1, RELIEF_PASSES = 3, BEVEL_PASSES = 4 };

#define CONTOUR 0.42f  // of the smoothed cells: less than half, so that branches of one cell hold
#define AGEING 2.0f    // thickness that the oldest ice gains, in that of new ice
#define THINNING 0.45f // of the tips, against the middle

// Fields over the lattice, with a margin of empty cells.
typedef struct Sheet {
    int radius, width;
    int64_t cells;
    float *inside; // smoothed cells: the crystal's outline is at CONTOUR
    float *height; // half its thickness, m
    float *ridge;  // smoothed mass
    float *spare;
    int32_t *vertex; // of a cell's upper face; -1 = outside
    int32_t *cut[3]; // vertex where the outline cuts the way to a neighbour; -1 = nowhere
} Sheet;

static const int TOWARD[3][2] = {{1, 0}, {0, 1}, {-1, 1}}; // the ways that a cell owns

static int64_t at(const Sheet *sheet, int q, int r)
{
    return (int64_t)(r + sheet->radius) * sheet->width + q + sheet->radius;
}

static void sheet_clear(Sheet *sheet)
{
    free(sheet->inside);
    free(sheet->height);
    free(sheet->ridge);
    free(sheet->spare);
    free(sheet->vertex);
    for (int k = 0; k < 3; k++) {
        free(sheet->cut[k]);
    }
}

static bool sheet_init(Sheet *sheet, int radius, Error *e)
{
    int width = 2 * radius + 1;
    *sheet = (Sheet){.radius = radius, .width = width, .cells = (int64_t)width * width};
    float **fields[4] = {&sheet->inside, &sheet->height, &sheet->ridge, &sheet->spare};
    for (int i = 0; i < 4; i++) {
        *fields[i] = memory_alloc_zero(sheet->cells, sizeof(float), e);
        if (!*fields[i]) {
            return false;
        }
    }
    int32_t **numbers[4] = {&sheet->vertex, &sheet->cut[0], &sheet->cut[1], &sheet->cut[2]};
    for (int i = 0; i < 4; i++) {
        *numbers[i] = memory_alloc(sheet->cells, sizeof(int32_t), e);
        if (!*numbers[i]) {
            return false;
        }
        for (int64_t cell = 0; cell < sheet->cells; cell++) {
            (*numbers[i])[cell] = -1;
        }
    }
    return true;
}

// Means of each cell and its six neighbours; the cell itself counts twice.
static void smooth(Sheet *sheet, float **field, int passes)
{
    int64_t width = sheet->width;
    for (int pass = 0; pass < passes; pass++) {
        const float *from = *field;
        for (int64_t i = width; i < sheet->cells - width; i++) {
            // opposite neighbours first: the sum is the same from either side
            float around = (from[i - 1] + from[i + 1]) + (from[i - width] + from[i + width]) +
                           (from[i - width + 1] + from[i + width - 1]);
            sheet->spare[i] = 0.125f * (around + 2.0f * from[i]);
        }
        float *old = *field;
        *field = sheet->spare;
        sheet->spare = old;
    }
}

// Mean mass of a cell of ice.
static float mean_ice(const Snowfake *fake)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < (int64_t)fake->width * fake->width; i++) {
        sum += (double)fake->ice[i];
        count += fake->ice[i] > 0.0f;
    }
    return (float)(sum / (double)count);
}

static void fill_fields(Sheet *sheet, const Snowfake *fake)
{
    float mean = mean_ice(fake);
    for (int r = -fake->radius; r <= fake->radius; r++) {
        for (int q = -fake->radius; q <= fake->radius; q++) {
            float ice = fake->ice[snowfake_cell(fake, q, r)];
            int64_t cell = at(sheet, q, r);
            sheet->inside[cell] = sheet->height[cell] = ice > 0.0f ? 1.0f : 0.0f;
            // ice is as thick as its boundary mass made it, and its faces go on growing
            float age = 1.0f - fake->born[snowfake_cell(fake, q, r)];
            sheet->ridge[cell] = ice > 0.0f ? ice / mean + AGEING * age : 0.0f;
        }
    }
    smooth(sheet, &sheet->inside, CONTOUR_PASSES);
    smooth(sheet, &sheet->height, BEVEL_PASSES);
    smooth(sheet, &sheet->ridge, RELIEF_PASSES);
}

// Half the thickness: it falls toward the tips, swells on ridges, and is bevelled along the
// outline.
static void fill_heights(Sheet *sheet, const SnowCrystalParams *params)
{
    for (int r = -sheet->radius; r <= sheet->radius; r++) {
        for (int q = -sheet->radius; q <= sheet->radius; q++) {
            int64_t cell = at(sheet, q, r);
            float bevel = clampf((sheet->height[cell] - 0.2f) / 0.75f, 0.0f, 1.0f);
            float swell = sheet->ridge[cell];
            float away = (float)snowfake_distance(q, r) / (float)params->cells;
            float taper = 1.0f - THINNING * clampf(away, 0.0f, 1.0f);
            float height = lerpf(1.0f, swell < 3.0f ? swell : 3.0f, params->relief);
            sheet->height[cell] =
                0.5f * params->thickness * taper * (0.15f + height * sqrtf(bevel));
        }
    }
}

static bool is_inside(const Sheet *sheet, int64_t cell)
{
    return sheet->inside[cell] > CONTOUR;
}

// Numbers the vertices: two for a cell inside, one for a cut of the outline. Returns their number.
static int64_t number_vertices(Sheet *sheet)
{
    int64_t count = 0;
    for (int64_t cell = 0; cell < sheet->cells; cell++) {
        if (is_inside(sheet, cell)) {
            sheet->vertex[cell] = (int32_t)count;
            count += 2;
        }
    }
    int64_t width = sheet->width;
    for (int64_t cell = 0; cell < sheet->cells - width - 1; cell++) {
        for (int k = 0; k < 3; k++) {
            int64_t to = cell + TOWARD[k][0] + TOWARD[k][1] * width;
            if (to >= 0 && is_inside(sheet, cell) != is_inside(sheet, to)) {
                sheet->cut[k][cell] = (int32_t)count++;
            }
        }
    }
    return count;
}

static Vec3 place(const Sheet *sheet, int64_t cell, float step)
{
    float q = (float)((int)(cell % sheet->width) - sheet->radius);
    float r = (float)((int)(cell / sheet->width) - sheet->radius);
    return vec3(step * (q + 0.5f * r), 0.0f, -step * 0.8660254f * r);
}

static void place_vertices(const Sheet *sheet, float step, Mesh *mesh)
{
    for (int64_t cell = 0; cell < sheet->cells; cell++) {
        Vec3 p = place(sheet, cell, step);
        if (sheet->vertex[cell] >= 0) {
            float height = sheet->height[cell];
            mesh->position[sheet->vertex[cell]] = vec3(p.x, height, p.z);
            mesh->position[sheet->vertex[cell] + 1] = vec3(p.x, -height, p.z);
        }
        for (int k = 0; k < 3; k++) {
            if (sheet->cut[k][cell] >= 0) {
                int64_t to = cell + TOWARD[k][0] + TOWARD[k][1] * (int64_t)sheet->width;
                float a = sheet->inside[cell], b = sheet->inside[to];
                float t = (CONTOUR - a) / (b - a);
                t = clampf(t, 0.02f, 0.98f); // no sliver of no width
                mesh->position[sheet->cut[k][cell]] = vec3_lerp(p, place(sheet, to, step), t);
            }
        }
    }
}

// The cut between two neighbouring cells.
static int32_t cut_between(const Sheet *sheet, int64_t a, int64_t b)
{
    for (int k = 0; k < 3; k++) {
        int64_t way = TOWARD[k][0] + TOWARD[k][1] * (int64_t)sheet->width;
        if (a + way == b) {
            return sheet->cut[k][a];
        }
        if (b + way == a) {
            return sheet->cut[k][b];
        }
    }
    return -1;
}

// Where the faces go: without an index they are only counted.
typedef struct Faces {
    uint32_t *index;
    int64_t count;
} Faces;

static void add_face(Faces *faces, uint32_t a, uint32_t b, uint32_t c)
{
    if (faces->index) {
        uint32_t *face = faces->index + 3 * faces->count;
        face[0] = a;
        face[1] = b;
        face[2] = c;
    }
    faces->count++;
}

// The part of a triangle of cells (counter-clockwise seen from above) that is inside, above and
// below.
static void add_triangle(const Sheet *sheet, const int64_t cell[3], Faces *faces)
{
    uint32_t corner[2][4];
    int corners = 0;
    for (int i = 0; i < 3; i++) {
        int64_t here = cell[i], next = cell[(i + 1) % 3];
        if (sheet->vertex[here] >= 0) {
            corner[0][corners] = (uint32_t)sheet->vertex[here];
            corner[1][corners++] = (uint32_t)sheet->vertex[here] + 1;
        }
        if ((sheet->vertex[here] >= 0) != (sheet->vertex[next] >= 0)) {
            uint32_t cut = (uint32_t)cut_between(sheet, here, next);
            corner[0][corners] = corner[1][corners] = cut;
            corners++;
        }
    }
    for (int i = 2; i < corners; i++) {
        add_face(faces, corner[0][0], corner[0][i - 1], corner[0][i]);
        add_face(faces, corner[1][0], corner[1][i], corner[1][i - 1]);
    }
}

static void add_faces(const Sheet *sheet, Faces *faces)
{
    int64_t width = sheet->width;
    for (int r = -sheet->radius; r < sheet->radius; r++) {
        for (int q = -sheet->radius; q < sheet->radius; q++) {
            int64_t a = at(sheet, q, r), b = a + 1, c = a + width, d = c + 1;
            add_triangle(sheet, (const int64_t[]){a, b, c}, faces);
            add_triangle(sheet, (const int64_t[]){b, d, c}, faces);
        }
    }
}

static Mesh *make_mesh(Sheet *sheet, float step, Error *e)
{
    int64_t vertices = number_vertices(sheet);
    Faces faces = {0};
    add_faces(sheet, &faces);
    Mesh *mesh = mesh_new(3, vertices, faces.count, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    place_vertices(sheet, step, mesh);
    faces = (Faces){.index = mesh->index};
    add_faces(sheet, &faces);
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

Mesh *snow_crystal_mesh(const SnowCrystalParams *params, const Snowfake *fake, Error *e)
{
    Sheet sheet;
    Mesh *mesh = NULL;
    if (sheet_init(&sheet, fake->radius + BEVEL_PASSES + 2, e)) {
        fill_fields(&sheet, fake);
        fill_heights(&sheet, params);
        mesh = make_mesh(&sheet, 0.5f * params->size / (float)fake->radius, e);
    }
    sheet_clear(&sheet);
    return mesh;
}
