// What is drawn as it is: imported meshes and envelopes.
#ifndef RAMIFY_SCENE_DRAWN_H
#define RAMIFY_SCENE_DRAWN_H

#include "shape/envelope.h"

typedef struct SceneMesh { // of another program
    char *file;
    Vec3 position, rotation, scale; // scaled, then turned (degrees), then moved
    bool smooth;                    // make smooth normals when the file has none
} SceneMesh;

typedef struct SceneShape { // spheres, boxes, ...
    Shape *shapes;
    int shape_count;
    float voxel;
} SceneShape;

#endif
