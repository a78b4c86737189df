// Shared by light_tree_build.c and light_tree.c; private to them.
#ifndef RAMIFY_RENDER_LIGHT_LIGHT_TREE_INTERNAL_H
#define RAMIFY_RENDER_LIGHT_LIGHT_TREE_INTERNAL_H

#include "render/light/light_tree.h"

enum { LIGHT_LANES = 4 };

// The bounds of up to four children, a lane each, so that their importance is computed at once.
typedef struct LightNode {
    float center[3][LIGHT_LANES], radius_squared[LIGHT_LANES]; // of the balls around their boxes
    float axis[3][LIGHT_LANES], cos_normal[LIGHT_LANES], sin_normal[LIGHT_LANES];
    float power[LIGHT_LANES];       // 0 = no child
    int32_t two_sided[LIGHT_LANES]; // 0 or 1
    int32_t child[LIGHT_LANES];     // index of a node; of a light its complement
    int32_t parent;                 // -1 at the root
    int32_t lane;                   // of this node in its parent
} LightNode;

// Where a light is a child.
typedef struct LightPlace {
    int32_t node, lane;
} LightPlace;

struct LightTree {
    LightNode *node;
    LightPlace *place; // of each light
    int32_t count;     // of lights
    float power;
};

#endif
