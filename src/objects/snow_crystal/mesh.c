// The surface of a snow crystal: two faces over the lattice, joined along its outline. The outline
// is the contour of the smoothed cells, so that it is finer than a cell.
#include "objects/snow_crystal/sheet.h"

#include <stdlib.h>

static const int TOWARD[3][2] = {{1, 0}, {0, 1}, {-1, 1}}; // the ways that a cell owns

static bool is_inside(const Sheet *sheet, int64_t cell)
{
    return sheet->inside[cell] > SHEET_CONTOUR;
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
            float ring = sheet->ring ? sheet->ring[cell] : 0.0f;
            mesh->position[sheet->vertex[cell]] = vec3(p.x, height + ring, p.z);
            mesh->position[sheet->vertex[cell] + 1] = vec3(p.x, -height, p.z);
        }
        for (int k = 0; k < 3; k++) {
            if (sheet->cut[k][cell] >= 0) {
                int64_t to = cell + TOWARD[k][0] + TOWARD[k][1] * (int64_t)sheet->width;
                float a = sheet->inside[cell], b = sheet->inside[to];
                float t = (SHEET_CONTOUR - a) / (b - a);
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
            int64_t a = sheet_at(sheet, q, r), b = a + 1, c = a + width, d = c + 1;
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

Mesh *snow_crystal_mesh(const SnowCrystalParams *params, const Snowfake *fake, uint64_t seed,
                        Error *e)
{
    Sheet sheet;
    Mesh *mesh = NULL;
    if (sheet_make(&sheet, params, fake, seed, e)) {
        float cells = (float)fake->radius * (float)params->detail;
        mesh = make_mesh(&sheet, 0.5f * params->size / cells, e);
    }
    sheet_clear(&sheet);
    return mesh;
}
