#include "objects/terrain/joints.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <math.h>

Joint joint_at(const JointSet *set, double across, double cell)
{
    double at = across / set->spacing, least_width = 0.8 * cell;
    double seen = set->width > least_width ? 1.0 : set->width / least_width;
    double width = set->width > least_width ? set->width : least_width;
    int64_t near = (int64_t)floor(at);
    Joint joint = {.block = near - 2};
    for (int64_t line = near - 1; line <= near + 1; line++) {
        uint64_t own = random_key(set->key, (uint64_t)line);
        float off = random_range(random_key(own, 1), -set->jitter, set->jitter);
        double place = (double)line + 0.5 + (double)off;
        double open = set->least + (1.0 - set->least) * (double)random_unit(random_key(own, 2));
        double d = (at - place) * set->spacing / width, share = open * exact_exp(-d * d) * seen;
        joint.share = share > joint.share ? share : joint.share;
        joint.block = at >= place ? line : joint.block;
    }
    return joint;
}
