// One child per step along the mean pull (Tanaka eq. (6)-(7)).
#include "grow/rules/rule.h"

#include <stddef.h>

static bool make_child(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    return growth_make_child(growth, grower, pull, NULL, growth->params->step, 0, child);
}

static int make_children(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    return growth_make_single(growth, grower, pull, child, make_child);
}

const Rule rule_mean = {.make_children = make_children};
