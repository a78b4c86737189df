#include "mesh/dice_split.h"

// Steep walls of the relief are halved further, but not without end.
bool dice_is_long(const DiceRule *rule, float coarsening, const DicePoint *a, Vec3 a_displaced,
                  const DicePoint *b, Vec3 b_displaced)
{
    float longest = rule->longest(rule->user, a, b) * coarsening;
    float smooth = vec3_distance(a->position, b->position);
    return smooth > longest ||
           (vec3_distance(a_displaced, b_displaced) > longest && smooth > longest * (1.0f / 3.0f));
}

DiceSplit dice_split(unsigned mark, const Vec3 position[6])
{
    // Turned so that the halved edges come first.
    static const unsigned TURN[8] = {0, 0, 1, 0, 2, 2, 1, 0};
    static const int HALVED[8] = {0, 1, 1, 2, 1, 2, 2, 3};
    static const DiceSplit SPLIT[4] = {
        {2, {{0, 3, 2}, {3, 1, 2}}},
        {3, {{3, 1, 4}, {0, 3, 2}, {3, 4, 2}}},
        {4, {{0, 3, 5}, {3, 4, 5}, {3, 1, 4}, {5, 4, 2}}},
        {3, {{3, 1, 4}, {0, 3, 4}, {0, 4, 2}}}, // two edges, the other diagonal
    };
    unsigned turn = TURN[mark];
    uint8_t of[6];
    for (unsigned k = 0; k < 3; k++) {
        of[k] = (uint8_t)((k + turn) % 3);
        of[3 + k] = (uint8_t)(3 + of[k]);
    }
    int kind = HALVED[mark] - 1;
    if (kind == 1 && vec3_distance(position[of[0]], position[of[4]]) <
                         vec3_distance(position[of[3]], position[of[2]])) {
        kind = 3;
    }
    DiceSplit split = SPLIT[kind];
    for (int i = 0; i < split.count; i++) {
        for (int k = 0; k < 3; k++) {
            split.corner[i][k] = of[split.corner[i][k]];
        }
    }
    return split;
}
