// Skeletons from SWC files as a kind of object.
#include "objects/kind.h"
#include "objects/skeleton/skeleton.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    SkeletonParams *skeleton = params;
    own_space_stand(own, skeleton->position, skeleton->rotation);
    skeleton->position = skeleton->rotation = vec3(0, 0, 0);
    return true;
}

static void describe(const void *params, char *text, size_t size)
{
    const SkeletonParams *skeleton = params;
    const char *slash = strrchr(skeleton->file, '/');
    snprintf(text, size, ", %s", slash ? slash + 1 : skeleton->file);
}

// Skin of a traced cell at 36 bytes of file per node: mean of a pyramidal neuron, with about five
// rings between nodes.
static void needs(const void *params, Needs *needs)
{
    const double file_bytes = 36.0, node_bytes = 6500.0;
    const SkeletonParams *skeleton = params;
    const SkinningParams *skin = &skeleton->skin;
    double share = skin->curve_radius > 0.0f ? 0.5 : 1.0; // twigs are curves
    double rings = skin->ring_spacing > 0.0f ? 1.0 / (double)skin->ring_spacing : 1.0;
    needs_add_file(needs, "skin.levels", skeleton->file,
                   node_bytes / file_bytes * share * rings * exp2(2.0 * skin->levels));
    // five nodes a spine, at about 4.4 micrometres between nodes of the file
    double spine_bytes =
        skin->curve_radius > 0.0f ? 500.0 : 5.0 * node_bytes * rings * exp2(2.0 * skin->levels);
    if (skeleton->spines > 0.0f) {
        needs_add_file(needs, "spines", skeleton->file,
                       4.4 * (double)skeleton->spines * spine_bytes / file_bytes);
    }
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    MATERIAL_ROW(1, "axon_material", "Material of a skeleton's axon; default: that of the rest."),
    {0},
};

const Kind kind_skeleton = {.variant = {KIND_ROW("skeleton", &skeleton_table,
                                                 "A neuron or another out-tree from an SWC file."),
                                        MATERIALS},
                            .carried = true,
                            .materials = {"clay"},
                            .own_space = own_space,
                            .describe = describe,
                            .needs = needs,
                            .grow = skeleton_grow,
                            .tip_radius = skeleton_tip_radius,
                            .geometry = skeleton_geometry};
