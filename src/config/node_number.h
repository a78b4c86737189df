// Numbers out of resolved nodes (whose scalars are known to be well formed), for checks.
#ifndef RAMIFY_CONFIG_NODE_NUMBER_H
#define RAMIFY_CONFIG_NODE_NUMBER_H

#include "base/vec.h"
#include "config/node.h"

double node_number(const Node *map, const char *key); // 0 when there is no such key
float node_component(const Node *list, int index);    // 0 when there are fewer
Vec3 node_vector(const Node *map, const char *key);

// Where a message about map's key points: at the key's value, else at map itself.
static inline const Node *node_place(const Node *given, const char *key)
{
    const Node *child = node_get(given, key);
    return child ? child : given;
}

#endif
