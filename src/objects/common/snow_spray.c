#include "objects/common/snow_spray.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define SPRAY_LEAST 0.08f  // m: snow does not settle on smaller leaves
#define BEARER_SIZE 0.012f // m: needles nearer to each other bear snow as one

bool snow_spray_of(const Part *part, Spray *spray)
{
    if (part->kind != PART_MESH || part->instance_count == 0 || part->mesh->vertex_count == 0) {
        return false;
    }
    Aabb box = mesh_bounds(part->mesh);
    *spray = (Spray){.part = part,
                     .size = vec3_sub(box.high, box.low),
                     .middle = vec3_scale(vec3_add(box.low, box.high), 0.5f)};
    spray->length = vec3_largest(spray->size);
    return spray->length >= SPRAY_LEAST;
}

Vec3 snow_spray_middle(const Spray *spray, int64_t instance)
{
    return transform_point(&spray->part->instance[instance], spray->middle);
}

// ---- what bears snow ----

static void cube_of(const SnowBearer *bearer, int cube[3])
{
    cube[0] = (int)floorf(bearer->p.x / BEARER_SIZE);
    cube[1] = (int)floorf(bearer->p.y / BEARER_SIZE);
    cube[2] = (int)floorf(bearer->p.z / BEARER_SIZE);
}

static bool same_cube(const SnowBearer *a, const SnowBearer *b)
{
    int s[3], t[3];
    cube_of(a, s);
    cube_of(b, t);
    return s[0] == t[0] && s[1] == t[1] && s[2] == t[2];
}

static int compare_floats(float a, float b)
{
    return (a > b) - (a < b);
}

// By cubes; within one by place and area, so that sums do not depend on how the library sorts.
static int compare_bearers(const void *a, const void *b)
{
    const SnowBearer *left = a, *right = b;
    int s[3], t[3];
    cube_of(left, s);
    cube_of(right, t);
    int order[7] = {s[0] - t[0],
                    s[1] - t[1],
                    s[2] - t[2],
                    compare_floats(left->p.x, right->p.x),
                    compare_floats(left->p.y, right->p.y),
                    compare_floats(left->p.z, right->p.z),
                    compare_floats(left->area, right->area)};
    int k = 0;
    while (k < 6 && order[k] == 0) {
        k++;
    }
    return order[k];
}

// Each run of bearers of one cube becomes one of them.
static void merge_bearers(SprayBearers *all)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < all->count;) {
        SnowBearer sum = {{0, 0, 0}, 0.0f};
        int64_t first = i;
        for (; i < all->count && same_cube(&all->bearer[first], &all->bearer[i]); i++) {
            sum.p = vec3_madd(sum.p, all->bearer[i].area, all->bearer[i].p);
            sum.area += all->bearer[i].area;
        }
        if (sum.area > 0.0f) {
            sum.p = vec3_scale(sum.p, 1.0f / sum.area);
            all->bearer[kept++] = sum;
        }
    }
    all->count = kept;
}

bool snow_spray_bearers(const Mesh *mesh, SprayBearers *all, Error *e)
{
    *all = (SprayBearers){.bearer = memory_alloc(mesh->face_count, sizeof(SnowBearer), e)};
    for (int64_t f = 0; all->bearer && f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]];
        Vec3 c = mesh->position[corner[2]], d = mesh->position[corner[mesh->face_size - 1]];
        Vec3 sum = vec3_add(vec3_add(a, b), vec3_add(c, d));
        all->bearer[all->count++] = (SnowBearer){
            vec3_scale(sum, 0.25f), 0.5f * vec3_length(vec3_cross(vec3_sub(c, a), vec3_sub(d, b)))};
    }
    if (all->bearer) {
        qsort(all->bearer, (size_t)all->count, sizeof *all->bearer, compare_bearers);
        merge_bearers(all);
    }
    return all->bearer;
}
