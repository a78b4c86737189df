// Joints of a terrain's rock.
#include "objects/common/tables.h"
#include "objects/terrain/terrain.h"

static const Key JOINT_KEYS[] = {
    {KEY_OF(JointingParams, spacing, "spacing", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Mean distance between the joints of a set that part the largest blocks, such as 150; "
            "0 = the rock does not break. Half of it to nearly three times as much occurs."},
    {KEY_OF(JointingParams, azimuth, "azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees",
     .doc = "Strike of the first set, clockwise from north (-z): the direction in which its joints "
            "run."},
    {KEY_OF(JointingParams, angle, "angle", KEY_FLOAT), .low = 30, .high = 150, .unit = "degrees",
     .doc = "Angle from it, clockwise, to the strike of the second set, whose joints end at those "
            "of the first."},
    {KEY_OF(JointingParams, scales, "scales", KEY_INT), .low = 1, .high = JOINTING_MOST,
     .doc = "Sizes of blocks, each 0.38 of the one before. Blocks of fewer than about three cells "
            "are not made, so a finer resolution shows more of them."},
    {KEY_OF(JointingParams, bends, "bends", KEY_FLOAT), .high = 0.5f, .unit = "spacings",
     .doc = "How far joints wander from straight lines."},
    {KEY_OF(JointingParams, facets, "facets", KEY_FLOAT), .high = 1,
     .doc = "How far the face of a block turns into the joint that is nearest to it: 0 = faces "
            "follow the wall, 1 = walls are made of joints and corners alone."},
    {KEY_OF(JointingParams, relief, "relief", KEY_FLOAT), .high = 1, .unit = "spacings",
     .doc = "How far blocks and their beds stand out of the wall or back, at most."},
    {KEY_OF(JointingParams, gullies, "gullies", KEY_FLOAT), .high = 1, .unit = "spacings",
     .doc = "How far gullies and chimneys reach back into the wall along open joints, at most."},
    {KEY_OF(JointingParams, bedding, "bedding", KEY_FLOAT), .low = 0.05f, .high = 10,
     .unit = "spacings",
     .doc = "Mean thickness of what breaks along bedding planes, which follow dip, folds and "
            "faults of `strata`: ledges that end at joints."},
    {KEY_OF(JointingParams, throws, "throws", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "How far the largest blocks have slipped up or down along their joints, at most, so "
            "that ledges do not go on from one to the next."},
    {KEY_OF(JointingParams, slope, "slope", KEY_FLOAT), .low = 10, .high = 80, .unit = "degrees",
     .doc = "Rock breaks where the land is steeper, and a third of a spacing around it."},
    {0},
};

const Table joint_table = {
    .name = "joints",
    .doc = "Upright joints in two sets that cut steep rock into blocks, with the bedding planes. "
           "The land is read from aside, so mass is not kept; gentle land stays as it is.",
    .example = "objects:\n"
               "  - name: alps\n"
               "    terrain:\n"
               "      form: alps\n"
               "      joints: {spacing: 150, azimuth: 40}\n",
    .size = sizeof(JointingParams),
    .keys = JOINT_KEYS};
