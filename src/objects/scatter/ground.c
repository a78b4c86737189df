#include "objects/scatter/ground.h"

#include "base/memory.h"
#include "mesh/cover.h"

#include <math.h>
#include <stdlib.h>

struct ScatterGround {
    Cover *land, *water;
};

// The triangles of a mesh; of none if mesh is NULL.
static Cover *cover_of(const Mesh *mesh, Error *e)
{
    Cover *cover = cover_new(e);
    if (cover && !((!mesh || cover_add(cover, mesh, e)) && cover_finish(cover, e))) {
        cover_free(cover);
        return NULL;
    }
    return cover;
}

ScatterGround *scatter_ground_new(const ShapeSurface *surface, bool land, Error *e)
{
    ScatterGround *ground = memory_alloc_zero(1, sizeof *ground, e);
    bool done = ground && (ground->land = cover_of(land ? surface->mesh : NULL, e)) &&
                (ground->water = cover_of(surface->water, e));
    if (!done) {
        scatter_ground_free(ground);
        return NULL;
    }
    return ground;
}

void scatter_ground_free(ScatterGround *ground)
{
    if (ground) {
        cover_free(ground->land);
        cover_free(ground->water);
        free(ground);
    }
}

bool scatter_ground_find(const ScatterGround *ground, Vec3 *p, Vec3 *normal)
{
    return cover_top(ground->land, p->x, p->z, &p->y, normal);
}

float scatter_ground_water(const ScatterGround *ground, Vec3 p)
{
    Vec3 normal;
    float height;
    return cover_top(ground->water, p.x, p.z, &height, &normal) ? height : -INFINITY;
}
