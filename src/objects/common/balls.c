#include "objects/common/balls.h"

#include "base/memory.h"
#include "mesh/ball.h"

enum { RINGS = 8 };

// `stride` from one radius to the next: 0 = the same for all.
static bool add(const Vec3 *position, const float *radius, int stride, int64_t count,
                const Placing *placing, int role, Error *e)
{
    if (count == 0) {
        return true;
    }
    Part part = {.instance = memory_alloc(count, sizeof *part.instance, e)};
    part.mesh = part.instance ? ball_mesh(RINGS, e) : NULL;
    for (int64_t i = 0; part.mesh && i < count; i++) {
        part.instance[part.instance_count++] =
            transform_compose(position[i], vec3(0, 0, 0), vec3_splat(radius[i * stride]));
    }
    return placing_add(placing, part, role, e);
}

bool balls_add(const Vec3 *position, int64_t count, float radius, const Placing *placing, int role,
               Error *e)
{
    return add(position, &radius, 0, count, placing, role, e);
}

bool balls_add_each(const Vec3 *position, const float *radius, int64_t count,
                    const Placing *placing, int role, Error *e)
{
    return add(position, radius, 1, count, placing, role, e);
}
