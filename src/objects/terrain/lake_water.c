// The water of lakes: cell by cell where a corner is under water, all at one level. No corner of
// such a cell lies below the level beside the lake, or the water would leave there, so the
// shoreline is where the land's own mesh rises through the surface.
#include "base/memory.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

typedef struct LakeMesher {
    const Terrain *terrain;
    const HeightField *field;
    int32_t *vertex; // of each sample; -1 = none
    int64_t vertices, faces;
} LakeMesher;

// The lake of a cell, by its first wet corner; -1 = it is dry. Corners counter-clockwise from
// above.
static int32_t lake_of(const LakeMesher *m, int64_t cell, int64_t corner[4])
{
    const HeightField *field = m->field;
    int64_t columns = field->columns;
    if (cell % columns + 1 >= columns || cell / columns + 1 >= field->rows) {
        return -1;
    }
    corner[0] = cell;
    corner[1] = cell + columns;
    corner[2] = cell + columns + 1;
    corner[3] = cell + 1;
    int32_t lake = -1;
    for (int k = 0; k < 4; k++) {
        int32_t label = m->terrain->lakes->label[corner[k]];
        lake = lake < 0 ? label : lake;
    }
    return lake;
}

// The samples of the cells that a lake may wet, row by row: the first of `at`, and the next.
typedef struct Box {
    int64_t columns; // of the field
    int first, last; // columns of the box
    int64_t at, end;
} Box;

static Box box_of(const LakeMesher *m, int32_t lake)
{
    const Lake *own = &m->terrain->lakes->lake[lake];
    int64_t columns = m->field->columns;
    int first = own->columns[0] > 0 ? own->columns[0] - 1 : 0;
    int last = own->columns[1] + 1 < m->field->columns ? own->columns[1] + 1 : own->columns[1];
    int top = own->rows[0] > 0 ? own->rows[0] - 1 : 0;
    int bottom = own->rows[1] + 1 < m->field->rows ? own->rows[1] + 1 : own->rows[1];
    return (Box){columns, first, last, top * columns + first, bottom * columns + last};
}

static void box_advance(Box *box)
{
    bool ends = box->at % box->columns == box->last;
    box->at += ends ? box->columns - box->last + box->first : 1;
}

static void count_parts(LakeMesher *m, int32_t lake)
{
    int64_t corner[4];
    m->vertices = m->faces = 0;
    for (Box box = box_of(m, lake); box.at <= box.end; box_advance(&box)) {
        m->vertex[box.at] = -1;
    }
    for (Box box = box_of(m, lake); box.at <= box.end; box_advance(&box)) {
        if (lake_of(m, box.at, corner) != lake) {
            continue;
        }
        m->faces++;
        for (int k = 0; k < 4; k++) {
            if (m->vertex[corner[k]] < 0) {
                m->vertex[corner[k]] = (int32_t)m->vertices++;
            }
        }
    }
}

static void place_vertex(const LakeMesher *m, Mesh *mesh, int64_t i, float level)
{
    const HeightField *field = m->field;
    int64_t column = i % field->columns, row = i / field->columns;
    float x = field->origin.x + (float)column * field->cell.x;
    float z = field->origin.y + (float)row * field->cell.y;
    Vec3 p = vec3_add(vec3(x, level, z), m->terrain->params->position);
    int32_t v = m->vertex[i];
    mesh->position[v] = p;
    mesh->normal[v] = vec3(0, 1, 0);
    mesh->uv[v] = (Vec2){p.x, p.z};
}

static Mesh *lake_mesh(const LakeMesher *m, int32_t lake, Error *e)
{
    Mesh *mesh = mesh_new(4, m->vertices, m->faces, MESH_NORMAL | MESH_UV, e);
    int64_t face = 0, corner[4];
    float level = m->terrain->lakes->lake[lake].level;
    for (Box box = box_of(m, lake); mesh && box.at <= box.end; box_advance(&box)) {
        if (m->vertex[box.at] >= 0) {
            place_vertex(m, mesh, box.at, level);
        }
        if (lake_of(m, box.at, corner) == lake) {
            for (int k = 0; k < 4; k++) {
                mesh->index[4 * face + k] = (uint32_t)m->vertex[corner[k]];
            }
            face++;
        }
    }
    return mesh;
}

static bool add_lake(LakeMesher *m, int32_t lake, const DrawnLand *land, const Placing *placing,
                     Error *e)
{
    count_parts(m, lake);
    if (!drawn_add_water(land, lake_mesh(m, lake, e), placing, e)) {
        return false;
    }
    if (m->terrain->params->beyond <= 0 || land->mesh) {
        return true;
    }
    Mesh *mesh = lake_mesh(m, lake, e);
    return mesh && terrain_add_copies(mesh, m->terrain->params, placing, TERRAIN_WATER, e);
}

bool terrain_add_lakes(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Lakes *lakes = land->terrain->lakes;
    if (!lakes) {
        return true;
    }
    LakeMesher m = {.terrain = land->terrain, .field = land->field};
    m.vertex = memory_alloc(height_field_count(land->field), sizeof *m.vertex, e);
    bool done = m.vertex;
    for (int32_t i = 0; done && i < lakes->count; i++) {
        done = add_lake(&m, i, land, placing, e);
    }
    free(m.vertex);
    return done;
}

bool terrain_measure_lakes(const Terrain *terrain, MeasureList *list, Error *e)
{
    const Lakes *lakes = terrain->lakes;
    double nan = (double)NAN;
    if (!lakes || lakes->count == 0) {
        return true;
    }
    const Lake *largest = &lakes->lake[0];
    double cell = (double)terrain->params->size / terrain->params->resolution;
    double area = (double)largest->samples * cell * cell;
    int64_t columns = terrain->params->resolution + 1;
    int64_t column = largest->outlet % columns, row = largest->outlet / columns;
    double corner = -0.5 * (double)terrain->params->size;
    Vec3 at = terrain->params->position;
    double x = corner + cell * (double)column + (double)at.x;
    double z = corner + cell * (double)row + (double)at.z;
    return measures_add(list, "lakes", lakes->count, "", nan, nan, e) &&
           measures_add(list, "lake_area", area, "m2", nan, nan, e) &&
           measures_add(list, "lake_depth", (double)largest->depth, "m", nan, nan, e) &&
           measures_add(list, "lake_mean_depth", largest->volume / area, "m", nan, nan, e) &&
           measures_add(list, "lake_level", (double)(largest->level + at.y), "m", nan, nan, e) &&
           measures_add(list, "lake_outlet_x", x, "m", nan, nan, e) &&
           measures_add(list, "lake_outlet_z", z, "m", nan, nan, e);
}
