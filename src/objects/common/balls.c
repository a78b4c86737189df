#include "objects/common/balls.h"

#include "base/memory.h"
#include "mesh/ball.h"

enum { RINGS = 8 };

bool balls_add(const Vec3 *position, int64_t count, float radius, const Placing *placing, int role,
               Error *e)
{
    if (count == 0) {
        return true;
    }
    Part part = {.instance = memory_alloc(count, sizeof *part.instance, e)};
    part.mesh = part.instance ? ball_mesh(RINGS, e) : NULL;
    for (int64_t i = 0; part.mesh && i < count; i++) {
        part.instance[part.instance_count++] =
            transform_compose(position[i], vec3(0, 0, 0), vec3_splat(radius));
    }
    return placing_add(placing, part, role, e);
}
