// The sea and the old land around a delta's square: level sheets that meet its borders.
#include "base/memory.h"
#include "objects/terrain/delta.h"

#include <math.h>

// Lines of a grid along an axis.
enum { LINES = 4 };

typedef struct Sheet {
    float x[LINES], z[LINES]; // ascending
    float height;             // m
    uint32_t hole;            // the cell of the square itself
    Vec2 site;
} Sheet;

static Mesh *sheet_mesh(const Sheet *s, Vec3 move, Error *e)
{
    enum { CELLS = LINES - 1 };
    Mesh *mesh =
        mesh_new(4, LINES * LINES, CELLS * CELLS - 1, MESH_NORMAL | MESH_UV | MESH_SITE, e);
    for (int i = 0; mesh && i < LINES * LINES; i++) {
        Vec3 p = vec3(s->x[i % LINES], s->height, s->z[i / LINES]);
        mesh->position[i] = vec3_add(p, move);
        mesh->normal[i] = vec3(0, 1, 0);
        mesh->uv[i] = (Vec2){mesh->position[i].x, mesh->position[i].z};
        mesh->site[i] = s->site;
    }
    int64_t face = 0;
    for (uint32_t i = 0; mesh && i < CELLS * CELLS; i++) {
        if (i == s->hole) {
            continue;
        }
        uint32_t v = i / CELLS * LINES + i % CELLS, *corner = mesh->index + 4 * face++;
        corner[0] = v; // counter-clockwise from above
        corner[1] = v + LINES;
        corner[2] = v + LINES + 1;
        corner[3] = v + 1;
    }
    return mesh;
}

bool terrain_add_delta_beyond(const Terrain *terrain, const Placing *placing, Error *e)
{
    const TerrainParams *p = terrain->params;
    const DeltaLand *land = terrain->delta;
    const Delta *d = land->model;
    float half = 0.5f * p->size, far = half + p->size * (float)p->beyond;
    float water = (float)(d->sea - DELTA_FALL * d->depth), depth = (float)d->depth;
    Sheet sea = {.x = {-far, -half, half, far},
                 .z = {-far, -half, half, far},
                 .height = water,
                 .hole = 4,
                 .site = {depth / (1.0f + depth), 0.0f}};
    float shore = (float)(land->corner + (d->mouth[1] + 0.05 * d->rows) * d->cell);
    Sheet plain = {.x = {-far, -half, half, far},
                   .z = {-far, -0.5f * (far + half), -half, shore},
                   .height = water + 0.25f * depth,
                   .hole = 7,
                   .site = {1.0f, 0.2f}};
    Part surface = {.mesh = sheet_mesh(&sea, p->position, e), .is_water = true};
    return placing_add(placing, surface, TERRAIN_WATER, e) &&
           placing_add(placing, (Part){.mesh = sheet_mesh(&plain, p->position, e)}, TERRAIN_LAND,
                       e);
}
