#include "mesh/dice_budget.h"

#include "mesh/dice_split.h"

#include <math.h>

enum { MOST_DEPTH = 24, SHARE = 16 }; // see dice_coarsening

#define COARSEST 32.0f

typedef struct Census {
    const DiceRule *rule;
    float coarsening;
} Census;

typedef struct Corner {
    DicePoint point;
    Vec3 displaced;
} Corner;

static Corner middle_of(const Census *census, const Corner *a, const Corner *b)
{
    const DiceRule *rule = census->rule;
    Corner middle = {.point = dice_middle(&a->point, &b->point)};
    float share, height = rule->height(rule->user, &middle.point, census->coarsening, &share);
    middle.displaced = vec3_madd(middle.point.position, height, middle.point.normal);
    return middle;
}

// Faces that become of a triangle.
static int64_t count_faces(const Census *census, const Corner corner[3], int depth)
{
    Corner all[6] = {corner[0], corner[1], corner[2]};
    Vec3 position[6];
    unsigned mark = 0;
    for (int k = 0; k < 3; k++) {
        const Corner *a = &all[k], *b = &all[(k + 1) % 3];
        position[k] = a->point.position;
        if (dice_is_long(census->rule, census->coarsening, &a->point, a->displaced, &b->point,
                         b->displaced)) {
            mark |= 1u << k;
            all[3 + k] = middle_of(census, a, b);
            position[3 + k] = all[3 + k].point.position;
        }
    }
    if (!mark || depth == 0) {
        return 1;
    }
    DiceSplit split = dice_split(mark, position);
    int64_t faces = 0;
    for (int i = 0; i < split.count; i++) {
        const uint8_t *c = split.corner[i];
        faces += count_faces(census, (Corner[3]){all[c[0]], all[c[1]], all[c[2]]}, depth - 1);
    }
    return faces;
}

// Faces of all triangles, with edges so many times as long as wanted.
static int64_t count_all(const DiceTriangles *triangles, const DiceRule *rule, float coarsening,
                         const Run *run)
{
    const Census census = {rule, coarsening};
    int64_t faces = 0;
#pragma omp parallel for num_threads(run->threads) schedule(dynamic, 64) reduction(+ : faces)
    for (int64_t i = 0; i < triangles->count; i++) {
        Corner corner[3];
        for (int k = 0; k < 3; k++) {
            uint32_t v = triangles->index[3 * i + k];
            corner[k] = (Corner){triangles->point[v], triangles->displaced[v]};
        }
        faces += count_faces(&census, corner, MOST_DEPTH);
    }
    return faces;
}

float dice_coarsening(const DiceTriangles *triangles, const DiceRule *rule, const Run *run)
{
    int64_t room = rule->most_faces - triangles->count, more = 0;
    float coarsening = 2.0f * COARSEST;
    while (coarsening > 1.0f && more < room / SHARE && !run_is_cancelled(run)) {
        coarsening *= 0.5f;
        more = count_all(triangles, rule, coarsening, run) - triangles->count;
    }
    return room > 0 ? fmaxf(1.0f, coarsening * sqrtf((float)more / (float)room)) : 1.0f;
}
