// Skeletons from SWC files as a kind of object.
#include "scene/kinds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool own_space(OwnSpace *own, Error *e)
{
    SkeletonParams *skeleton = own_space_copy(own, own->object.skeleton, sizeof *skeleton, e);
    if (skeleton) {
        own->object.skeleton = skeleton;
        own_space_stand(own, skeleton->position, skeleton->rotation);
        skeleton->position = skeleton->rotation = vec3(0, 0, 0);
    }
    return skeleton;
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return skeleton_grow(object->skeleton, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    SkeletonMaterials materials = {.body = placing_material(p, p->object->material, "clay")};
    materials.axon = p->object->axon_material
                         ? placing_material(p, p->object->axon_material, "clay")
                         : materials.body;
    return skeleton_geometry(tree, p->object->skeleton, &materials, p->index, &p->world->geometry,
                             p->recipe.run, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    const char *slash = strrchr(object->skeleton->file, '/');
    snprintf(text, size, ", %s", slash ? slash + 1 : object->skeleton->file);
}

// A traced cell's skin at 36 bytes of file a node: mean of a pyramidal neuron, whose nodes stand
// some five rings apart.
static void needs(const SceneObject *object, Needs *needs)
{
    const double file_bytes = 36.0, node_bytes = 6500.0;
    const SkinningParams *skin = &object->skeleton->skin;
    double share = skin->curve_radius > 0.0f ? 0.5 : 1.0; // twigs are curves
    double rings = skin->ring_spacing > 0.0f ? 1.0 / (double)skin->ring_spacing : 1.0;
    needs_add_file(needs, "skin.levels", object->skeleton->file,
                   node_bytes / file_bytes * share * rings * exp2(2.0 * skin->levels));
}

const Kind kind_skeleton = {.key = "skeleton",
                            .offset = offsetof(SceneObject, skeleton),
                            .materials = {"material", "axon_material"},
                            .own_space = own_space,
                            .grow = grow,
                            .needs = needs,
                            .place = place,
                            .describe = describe};
