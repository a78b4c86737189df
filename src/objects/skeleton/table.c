// Skeletons from SWC files.
#include "objects/common/tables.h"
#include "objects/skeleton/skeleton.h"

static const EnumName ORIGINS[] = {
    {"file", SKELETON_FILE}, {"root", SKELETON_ROOT}, {"middle", SKELETON_MIDDLE}, {NULL, 0}};

static const EnumName SOMAS[] = {
    {"round", SKELETON_ROUND}, {"as_is", SKELETON_AS_IS}, {"none", SKELETON_NO_SOMA}, {NULL, 0}};

static const Key SKELETON_KEYS[] = {
    {KEY_OF(SkeletonParams, file, "file", KEY_FILE), .flags = KEY_REQUIRED,
     .doc = "SWC file, relative to the scene's folder."},
    {KEY_OF(SkeletonParams, scale, "scale", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e9,
     .unit = "m",
     .doc = "Length of the file's unit, usually the micrometre: 1e-6 shows a neuron at its true "
            "size, 0.001 a thousand times larger."},
    {KEY_OF(SkeletonParams, origin, "origin", KEY_ENUM), .names = ORIGINS,
     .doc = "Point that is placed at position. file: the file's origin; root: its first root; "
            "middle: the centre of its bounding box."},
    {KEY_OF(SkeletonParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the origin."},
    {KEY_OF(SkeletonParams, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z, around the origin."},
    {KEY_OF(SkeletonParams, soma, "soma", KEY_ENUM), .names = SOMAS,
     .doc = "Display of nodes of type 1 at a root. round: one round body of about their size; "
            "as_is: as in the file; none: omitted."},
    {KEY_OF(SkeletonParams, axon, "axon", KEY_BOOL), .doc = "Show nodes of type 2, the axon."},
    {KEY_OF(SkeletonParams, basal, "basal", KEY_BOOL),
     .doc = "Show nodes of type 3, basal dendrites."},
    {KEY_OF(SkeletonParams, apical, "apical", KEY_BOOL),
     .doc = "Show nodes of type 4, apical dendrites."},
    {KEY_OF(SkeletonParams, rest, "rest", KEY_BOOL), .doc = "Show nodes of all other types."},
    {KEY_OF(SkeletonParams, radius_factor, "radius_factor", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 1000, .doc = "Multiplier of the radii in the file."},
    {KEY_OF(SkeletonParams, min_radius, "min_radius", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Minimum radius, which thinner branches get; 0 = only branches of radius 0 are "
            "thickened, to 0.0003 of the extent."},
    {KEY_OF(SkeletonParams, smoothing, "smoothing", KEY_INT), .high = 1000,
     .doc = "Number of passes that smooth the bends of traced branches."},
    {KEY_OF(SkeletonParams, flare, "flare", KEY_FLOAT), .high = 10,
     .doc = "How much wider branches are where they leave the soma, as a share of their radius, at "
            "most half as wide as the soma; 0 = as in the file."},
    {KEY_OF(SkeletonParams, spines, "spines", KEY_FLOAT), .high = 1000,
     .doc = "Number of spines per unit of the file along dendrites (types 3 and 4), beyond two and "
            "a half radii of the soma; branches thinner than a spine's head have none. Pyramidal "
            "cells have 1 to 3 per micrometre. Measures do not count them."},
    {KEY_OF(SkeletonParams, spine_length, "spine_length", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 1e6, .doc = "Mean length of spines, in units of the file."},
    {KEY_OF(SkeletonParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "Surface of the branches."},
    {0},
};

static void skeleton_defaults(void *out)
{
    *(SkeletonParams *)out = skeleton_params_default();
}

const Table skeleton_table = {
    .name = "skeleton",
    .doc = "A neuron, or another traced out-tree, from an SWC file.",
    .example =
        "objects:\n"
        "  - name: neuron\n"
        "    skeleton: {file: neuron.swc, scale: 0.001, origin: middle, position: [0, 1, 0]}\n",
    .size = sizeof(SkeletonParams),
    .keys = SKELETON_KEYS,
    .defaults = skeleton_defaults};
